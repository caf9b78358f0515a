#![no_main]
fuzz::target!(grid);
