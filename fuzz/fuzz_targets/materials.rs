#![no_main]
fuzz::target!(materials);
