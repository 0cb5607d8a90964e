//! Computes `docs/validation.md`:
//!
//! ```text
//! cargo run --release -p ppum-solve --example validation > docs/validation.md
//! ```

mod document;
#[path = "../../tests/studies/mod.rs"]
mod studies;
mod table;

fn main() {
    document::print();
}
