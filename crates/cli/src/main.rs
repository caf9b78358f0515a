//! The hertzlamb command.

fn main() {}
