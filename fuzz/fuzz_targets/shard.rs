#![no_main]
fuzz::target!(shard);
