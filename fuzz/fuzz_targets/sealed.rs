#![no_main]
fuzz::target!(sealed);
