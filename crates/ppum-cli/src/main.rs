//! The `ppum` program.
fn main() {}
