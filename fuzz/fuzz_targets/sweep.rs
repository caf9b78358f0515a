#![no_main]
fuzz::target!(sweep);
