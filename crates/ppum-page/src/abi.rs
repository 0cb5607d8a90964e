//! Functions that a worker of a page calls.
//!
//! A worker writes into the memory of the evaluator and reads from it, at addresses that the
//! functions here return; an address is good until the next call. A question is the bytes of
//! [`input`], most often JSON. Functions that answer return 1, or 0 if [`text`] is the reason why
//! there is no answer. Nothing here is unsafe but that the names are those that the worker knows.
#![allow(unsafe_code, reason = "names that are exported are unsafe attributes")]

use std::cell::RefCell;
use std::fmt::Display;

use ppum::dataset::Dataset;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::evaluator::Evaluator;
use crate::evaluator::paint::PageImage;

/// The evaluator of a worker, with what is handed over.
struct Exchange {
    input: Vec<u8>,
    values: Vec<f64>,
    pixels: Vec<u8>,
    text: String,
    evaluator: Option<Evaluator<'static>>,
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> = const {
        RefCell::new(Exchange {
            input: Vec::new(),
            values: Vec::new(),
            pixels: Vec::new(),
            text: String::new(),
            evaluator: None,
        })
    };
}

/// Where so many bytes of a question go.
#[unsafe(no_mangle)]
extern "C" fn input(length: usize) -> *mut u8 {
    EXCHANGE.with_borrow_mut(|exchange| {
        exchange.input.clear();
        exchange.input.resize(length, 0);
        exchange.input.as_mut_ptr()
    })
}

/// Where so many values go, one for each pixel.
#[unsafe(no_mangle)]
extern "C" fn reserve(length: usize) -> *mut f64 {
    EXCHANGE.with_borrow_mut(|exchange| {
        exchange.values.resize(length, 0.0);
        exchange.values.as_mut_ptr()
    })
}

/// The values of the last rows.
#[unsafe(no_mangle)]
extern "C" fn values() -> *const f64 {
    EXCHANGE.with_borrow(|exchange| exchange.values.as_ptr())
}

/// The number of these values.
#[unsafe(no_mangle)]
extern "C" fn value_count() -> usize {
    EXCHANGE.with_borrow(|exchange| exchange.values.len())
}

/// The pixels of the last image, four bytes each.
#[unsafe(no_mangle)]
extern "C" fn pixels() -> *const u8 {
    EXCHANGE.with_borrow(|exchange| exchange.pixels.as_ptr())
}

/// The number of these bytes.
#[unsafe(no_mangle)]
extern "C" fn pixel_bytes() -> usize {
    EXCHANGE.with_borrow(|exchange| exchange.pixels.len())
}

/// The last answer in JSON, or the reason why there is none.
#[unsafe(no_mangle)]
extern "C" fn text() -> *const u8 {
    EXCHANGE.with_borrow(|exchange| exchange.text.as_ptr())
}

/// The number of its bytes.
#[unsafe(no_mangle)]
extern "C" fn text_length() -> usize {
    EXCHANGE.with_borrow(|exchange| exchange.text.len())
}

/// Reads a dataset from the bytes of its file. It stays as long as the worker does.
#[unsafe(no_mangle)]
extern "C" fn open() -> u32 {
    answer(|exchange| {
        let bytes = std::mem::take(&mut exchange.input);
        let dataset: &'static Dataset = Box::leak(Box::new(ppum_format::from_bytes(bytes)?));
        exchange.evaluator = Some(Evaluator::new(dataset));
        json(&())
    })
}

/// Describes the dataset, and the step of a number.
#[unsafe(no_mangle)]
extern "C" fn describe() -> u32 {
    answer(|exchange| {
        let (evaluator, step) = exchange.question()?;
        json(&evaluator.describe(step)?)
    })
}

/// The values of some rows.
#[unsafe(no_mangle)]
extern "C" fn rows() -> u32 {
    answer(|exchange| {
        let (evaluator, rows) = exchange.question()?;
        exchange.values = evaluator.rows(&rows)?;
        json(&())
    })
}

/// The image of all values, with its colour bar.
#[unsafe(no_mangle)]
extern "C" fn paint() -> u32 {
    answer(|exchange| {
        let values = std::mem::take(&mut exchange.values);
        let (evaluator, frame) = exchange.question()?;
        let PageImage { image, legend, values } = evaluator.paint(&frame, values)?;
        (exchange.pixels, exchange.values) = (image.rgba, values);
        json(&legend)
    })
}

/// The values at a point.
#[unsafe(no_mangle)]
extern "C" fn probe() -> u32 {
    answer(|exchange| {
        let (evaluator, question) = exchange.question()?;
        json(&evaluator.probe(&question)?)
    })
}

impl Exchange {
    /// The evaluator, and the question that it is asked.
    fn question<Q: DeserializeOwned>(&mut self) -> Result<(&mut Evaluator<'static>, Q), ErrorText> {
        let evaluator =
            self.evaluator.as_mut().ok_or_else(|| ErrorText("no dataset".to_owned()))?;
        Ok((evaluator, serde_json::from_slice(&self.input)?))
    }
}

/// The text of an error.
struct ErrorText(String);

impl<E: Display> From<E> for ErrorText {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

fn json(answer: &impl Serialize) -> Result<String, ErrorText> {
    Ok(serde_json::to_string(answer)?)
}

fn answer(work: impl FnOnce(&mut Exchange) -> Result<String, ErrorText>) -> u32 {
    EXCHANGE.with_borrow_mut(|exchange| {
        let (is_answer, text) = match work(exchange) {
            Ok(text) => (1, text),
            Err(ErrorText(text)) => (0, text),
        };
        exchange.text = text;
        is_answer
    })
}
