//! Command line of jostle.

fn main() {}
