#![no_main]
fuzz::target!(scene);
