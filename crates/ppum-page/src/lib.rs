//! Pages: a dataset, and what evaluates it, in one HTML file that a browser opens from disk.
//!
//! [`html`] writes the page: the dataset's own bytes, the [`Evaluator`] compiled to WebAssembly,
//! and a script that asks it for images of views. The evaluator reads the bytes by `ppum-format`
//! and evaluates, colours and draws by the crates that `ppum render` uses, in f64, so there is no
//! second evaluator in another language. The script only moves the view, shares the rows of an
//! image among workers, and shows the result.
//!
//! ```text
//! page.html   start (JSON), dataset (base64), evaluator (gzip, base64)
//!     page.js     view, controls, pointer, keys          one thread, the page's
//!     worker.js   one evaluator each: rows of values     several threads, from a Blob
//!     abi         what a worker calls, in `evaluator.wasm.gz`
//! ```
//!
//! `tools/page.sh` compiles the evaluator. Its result is kept in the repository, so that the
//! program is built without WebAssembly; `tests/page` holds it to the program pixel by pixel.

#[cfg(target_arch = "wasm32")]
mod abi;
pub mod evaluator;
mod messages;
#[cfg(not(target_arch = "wasm32"))]
mod page;

pub use evaluator::Evaluator;
pub use messages::{
    Description, ImageRows, PageChoice, PageFrame, PageLegend, PageTick, PageView, PointQuestion,
    PointReading, SideReading,
};
#[cfg(not(target_arch = "wasm32"))]
pub use page::{LARGEST, PageStart, SHAPE, StartError, html};
