//! Computes `docs/validation.md` and its images, in some minutes:
//!
//! ```text
//! cargo run --release -p ppum-bench --example validation
//! cargo run --release -p ppum-bench --example validation -- growth     its last part alone
//! ```

mod adaptive;
mod benchmarks;
mod convergence;
mod growth;
mod page;
mod picture;
mod series;
#[path = "../../../ppum-fracture/tests/studies/mod.rs"]
mod studies;

use page::Page;
use std::path::Path;

const HEAD: &str = "\
# Validation

Results of the solver beside references. A program computes this page and its images:

```text
cargo run --release -p ppum-bench --example validation
```

Errors are relative; a positive error means that the value is too large. Unless stated otherwise, E = 1, ν = 0.3, plane
strain, order 2, α = 1.3, linear weights, and all other settings have their defaults. Each benchmark is solved on three
covers. Each has cells half as large as the one before, which the program further refines at tips. The images show the
von Mises stress (for Laplace's equation: the gradient) on the middle cover. F = K/(σ√(πa)).
The set-ups are in `crates/ppum-fracture/tests/studies`; the tests in `crates/ppum-fracture/tests/solver` bound the errors of
most of these benchmarks, mostly on the coarser covers.

Errors are differences from references. The `error` that `ppum sif` and `ppum info` print is an estimate, which is
compared with them below. Their `spread` is the difference between three radii of one integral: a check, not an estimate
of the error.

## Summary

Numbers of this page are those of version 0.1.0 on Linux on x86-64, computed up to 29 November 2026; another processor
changes them by rounding only. *Largest error* is the largest one of the finest cover of each section.

| problem | reference | value | unknowns | largest error |
| --- | --- | --- | --- | --- |
| [12 plates with a centre crack](#centre-crack-ends-pulled) | complex potentials, three programs ([one](../tests/references/README.md) in the tree) | F_I | 6720 to 38832 | 6.3e-5 |
| [6 plates with an edge crack](#single-edge-crack-ends-pulled) | the same | F_I | 12696 to 37680 | 3.2e-5 |
| [slanted cracks, 15° and 45°](#slanted-centre-crack-ends-pulled) | the same | F_I, F_II | 25728, 25812 | 1.5e-5 |
| [edge crack under end shear](#edge-crack-under-end-shear) | complex potentials, two programs | K_I, K_II | 22536 | 1.8e-5 |
| [collinear cracks](#two-collinear-cracks-in-the-infinite-plane) | closed form | F_I | 26496 | 1.9e-4 |
| [kinked crack](#kinked-crack-in-the-infinite-plane) | dislocations, good to 1e-4 | F_I, F_II of the kinked end | 128948 | 3.6e-5 |
| [field of a tip](#the-field-of-a-tip) | closed form | strain energy | | 7.0e-9 |
| [slit square, Laplace](#laplaces-equation-on-a-slit-square) | closed form | energy | | 7.4e-6 |
| [requested accuracies, 1e-2 to 1e-6, 21 plates](#requested-accuracies-of-k) | the plates above | K | 912 to 12498 | 103 of 105 reached |
| [estimated errors of K, random problems](#estimated-errors-of-k) | finite elements of high order | estimate over error | | 1 to 30 at nine of ten tips |
| [200 random problems](../tests/random/README.md) | finite elements of high order, NGSolve | K, energy | | K within 0.5 %, energy 0.1 %, or a warning |

## What tests hold

| quantity | bound |
| --- | --- |
| pixels of an image, against the evaluation point by point | 1e-12 of the local stress scale; 1e-11 in views down to 1e-12 wide |
| von Mises stress at 1e-13 to 1 from tips, kinks and oblique cracks, against 31 digits | 1e-12, relative |
| a dataset read by independent Python code, against 40 digits | 1e-12 of the local size |
| error in the energy norm, field of a tip, every patch enriched, level 2, orders 1 and 2 | 1e-7 |
| rates of convergence in the energy norm, smooth field, order p = 1, 2, 3 | p ± 0.15 |
| results with one and with several threads | equal to the last bit |";

fn main() -> anyhow::Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    if std::env::args().nth(1).is_some_and(|part| part == "growth") {
        let mut page = Page::before(&docs, "validation.md", growth::HEADING)?;
        growth::write(&mut page)?;
        return page.save("validation.md");
    }
    let mut page = Page::new(&docs, HEAD);
    benchmarks::write(&mut page)?;
    convergence::write(&mut page);
    adaptive::write(&mut page)?;
    growth::write(&mut page)?;
    page.save("validation.md")
}
