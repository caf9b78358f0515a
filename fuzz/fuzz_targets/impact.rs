#![no_main]
fuzz::target!(impact);
