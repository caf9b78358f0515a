#![no_main]
fuzz::target!(part);
