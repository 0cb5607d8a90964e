//! Particle-partition of unity fields, evaluated exactly.
//!
//! Overlapping boxes ω_i, the patches, cover a rectangle. Each has a weight W_i, and the weights make
//! a partition of unity; each has a local field, a sum of function × polynomial:
//!
//! ```text
//! v = Σ_i φ_i v_i        φ_i = W_i / Σ W        v_i(x) = Σ_b f_b(x) Σ_k c_{b,k} ξ^k
//! ```
//!
//! - [`dataset`] is the data model: all that is needed to evaluate a field, and nothing more.
//! - [`cover`] makes patches, [`weight`] their weights, [`crack`] and [`function`] the f_b, for which
//!   [`formula`] is the language.
//! - [`field`] evaluates values, gradients and Hessians at `anchor + offset`; [`quantity`] makes
//!   stresses and the like of them.
//! - [`real`] is the number type of all kernels: f64, f32, vectors of both.
//!
//! No files, no threads, no graphics.
//!
//! ```
//! use ppum::cover::Cover;
//! use ppum::crack::Side;
//! use ppum::dataset::{Dataset, Equation, FieldData, Step};
//! use ppum::field::Field;
//! use ppum::function::{Function, FunctionKind};
//! use ppum::quantity::Quantity;
//! use ppum::vec2::{Rect, Vec2, vec2};
//! use ppum::weight::WeightFunction;
//!
//! // one patch, u = 1 + 2ξ
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let potential = FieldData {
//!     name: "potential".into(),
//!     unit: String::new(),
//!     components: vec!["u".into()],
//!     patch_blocks: vec![0, 1],
//!     block_function: vec![0],
//!     block_degree: vec![1],
//!     block_offset: vec![0],
//!     coefficients: vec![vec![1.0, 2.0, 0.0]],
//!     exact: Vec::new(),
//! };
//! let step = Step {
//!     load: 1.0,
//!     partition: Cover::uniform(domain, 0)?.partition(1.25, WeightFunction::Linear)?,
//!     cracks: Vec::new(),
//!     functions: vec![Function { name: "one".into(), kind: FunctionKind::One }],
//!     fields: vec![potential],
//!     attributes: Vec::new(),
//!     intensities: Vec::new(),
//!     history: Vec::new(),
//! };
//! let dataset = Dataset {
//!     title: "A slope".into(),
//!     program: "by hand".into(),
//!     problem: None,
//!     domain,
//!     equation: Equation::Poisson { conductivity: 1.0 },
//!     steps: vec![step],
//! };
//! dataset.check()?;
//! let field = Field::new(&dataset, 0)?;
//! let slope = Quantity::from_name("du_dx", dataset.equation, &field.data.components)?;
//! let mut local = field.at(vec2(0.5, 0.0));
//! assert_eq!(slope.at(&mut local, Vec2::ZERO, Side::Above), 2.0 / 1.25);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
pub mod box_tree;
pub mod check;
pub mod cover;
pub mod crack;
pub mod dataset;
pub mod field;
pub mod formula;
pub mod function;
pub mod jet;
mod morton;
pub mod polynomial;
pub mod quantity;
#[cfg(test)]
mod random;
pub mod real;
pub mod vec2;
pub mod weight;
