#![no_main]
fuzz::target!(results);
