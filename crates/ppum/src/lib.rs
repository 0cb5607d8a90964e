//! Particle-partition of unity fields, evaluated exactly.
//!
//! Overlapping boxes ω_i, the patches, cover a rectangle. Each has a weight W_i, and the weights
//! make a partition of unity; each has a local field, a sum of function × polynomial:
//!
//! ```text
//! v = Σ_i φ_i v_i        φ_i = W_i / Σ W        v_i(x) = Σ_b f_b(x) Σ_k c_{b,k} ξ^k
//! ```
//!
//! - [`dataset`] is the data model: all that is needed to evaluate a field, and nothing more.
//! - [`cover`] makes patches, [`weight`] their weights, [`crack`] and [`function`] the f_b, for
//!   which [`formula`] is the language and [`library`] the built-in ones as texts; [`equation`] is
//!   the material.
//! - [`field`] evaluates values, gradients and Hessians at `anchor + offset`; [`quantity`] makes
//!   stresses and the like of them.
//! - [`real`] is the number type of all kernels: f64, f32, vectors of both.
//! - [`sample`] evaluates along lines and cracks and on grids; [`sides`] knows which points lie on
//!   a crack.
//! - [`progress`] is how long calls are followed and stopped.
//! - [`printable`](mod@printable) is how texts of files may be shown.
//! - [`text`] writes numbers and places for people, and finds the words that they meant.
//!
//! No files, no threads, no graphics.
//!
//! ```
//! use ppum::prelude::*;
//!
//! // one patch, u = 1 + 2ξ
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 0)?.partition(1.25, WeightFunction::Linear)?;
//! let mut potential = FieldData::new("potential", &["u"]);
//! potential.push_patch(&[(0, 1)]); // function 0 times a polynomial of degree 1
//! potential.coefficients_mut(0).for_each(|c| c.copy_from_slice(&[1.0, 2.0, 0.0]));
//! let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
//! let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
//! let field = Field::new(&dataset, 0)?;
//! let slope = Quantity::parse("du_dx", &field)?;
//! assert_eq!(slope.at(&mut field.at(vec2(0.5, 0.0)), Vec2::ZERO, Side::Above), 2.0 / 1.25);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Definitions
//!
//! A **cover** of the domain consists of **patches** ω_i: boxes that overlap, one around each leaf
//! cell of a quadtree ([`cover`]). Each has a **weight** W_i, a tensor product of B-splines
//! ([`weight`]), and a **partition function** φ_i = W_i / Σ W_l. On a patch the field is a **local
//! field**, a sum of **blocks** function × polynomial ([`dataset`], [`function`]); φ glues them
//! together:
//!
//! ```text
//! v_i(x) = Σ_b f_b(x) Σ_{|k| ≤ d_b} c_{b,k} ξ^k        v = Σ_i φ_i v_i        ∇v = Σ_i (∇φ_i) v_i + φ_i ∇v_i
//! ```
//!
//! The functions are 1 (the smooth part), the side ±1 of a **crack** (a jump), the Westergaard
//! functions of a crack **tip** (a singularity), or any [`formula`]. Nothing is interpolated: every
//! point is evaluated from the representation itself.
//!
//! # A tour
//!
//! A [`Dataset`](dataset::Dataset) holds everything. Here is a small one, a square with a crack
//! from the left edge to its middle. Its displacement is u_y = √r sin(θ/2) in the frame of the tip,
//! the opening of the crack, and u_x = 0.
//!
//! ```
//! use ppum::prelude::*;
//! use ppum::crack::{CrackEnd, End, TipId};
//! use ppum::function::{Frame, WESTERGAARD};
//! use ppum::jet::Jet;
//!
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 3)?.partition(1.3, WeightFunction::Linear)?;
//! assert_eq!(partition.len(), 64);
//!
//! let crack = Crack::polyline(vec![vec2(-1.0, 0.0), vec2(0.0, 0.0)], [CrackEnd::Mouth, CrackEnd::Tip]);
//! let tip = Frame::Tip(TipId { crack: 0, end: End::Last });
//! let opening = FunctionKind::formula(WESTERGAARD[1], tip); // sqrt(r)*sin(theta/2)
//! // One block per patch: function 0 times a polynomial of degree 0, that is one coefficient.
//! let mut displacement = FieldData::new("displacement", &["ux", "uy"]);
//! (0..64).for_each(|_| displacement.push_patch(&[(0, 0)]));
//! displacement.coefficients[1].fill(1.0);
//! let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
//! let step = Step::new(partition).with_crack(crack).with_function("opening", opening);
//! let mut dataset = Dataset::new(domain, Equation::elasticity(material));
//! dataset.title = "Opening of an edge crack".into();
//! dataset.steps = vec![step.with_field(displacement)];
//! dataset.check()?;
//!
//! // A field is compiled once, then seen from an anchor; points are anchor + offset.
//! let field = Field::new(&dataset, 0)?;
//! let mut local = field.at(vec2(0.0, 0.0));
//!
//! // Value and gradient (1 derivative) on the crack: the caller chooses the side.
//! let mut u = [Jet::constant(0.0); 2];
//! assert!(local.evaluate::<1>(vec2(-0.25, 0.0), Side::Above, &mut u));
//! assert_eq!(u[1].v, 0.5);
//! assert!((u[1].x + 1.0).abs() < 1e-14);
//! local.evaluate::<0>(vec2(-0.25, 0.0), Side::Below, &mut u);
//! assert_eq!(u[1].v, -0.5);
//!
//! // Outside the domain there is nothing.
//! assert!(!local.evaluate::<0>(vec2(2.0, 0.0), Side::Above, &mut u));
//!
//! // Ahead of the tip ε_yy = 1/(2√r) is the only strain, and von Mises' stress is 2μ ε_yy.
//! let mises = Quantity::parse("von-mises", &field)?;
//! let value = mises.at(&mut local, vec2(0.25, 0.0), Side::Above);
//! assert!((value - 1.0 / 1.3).abs() < 1e-14);
//! // The same a trillion times closer.
//! let value = mises.at(&mut local, vec2(0.25e-24, 0.0), Side::Above);
//! assert!((value * 1e-12 - 1.0 / 1.3).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Many points at once, on the lanes of the processor, are evaluated by
//! [`LocalField::evaluate_into`](field::LocalField::evaluate_into).
//!
//! # Scope and simplifications
//!
//! - Two dimensions, boxes as patches, even functions of |ξ| as weights, polynomials up to degree
//!   [`MAX_DEGREE`](dataset::MAX_DEGREE). The domain is a box minus
//!   circles and polygons.
//! - This crate only represents and evaluates: no files (`ppum-format`), no solver
//!   (`ppum-fracture`), no images (`ppum-render`), no threads.
//! - Boundaries of cells and patches belong to the right and upper side; on a crack the left side
//!   of its direction is taken unless the other is asked for. Outside the domain scalar evaluation
//!   returns false or `None`, evaluation of many points and quantities NaN.
//! - At a tip values are finite and gradients do not exist; quantities of the gradient are
//!   +∞ there.
//! - The evaluator is exact up to rounding at any magnification if the anchor is near. Rounding
//!   errors of the gradient are about 10⁻¹⁶ |u| / h for patches of size h: below 10⁻¹² of the
//!   stresses on covers of up to some 10⁵ patches where |u| is comparable with |∇u| × the size of
//!   the domain.
//! - Formulas are interpreted, functions of the plane in blocks of points on lanes; the Westergaard
//!   functions, recognised by their text, have a kernel of their own.

pub mod anisotropy;
pub mod arc_spline;
pub mod border;
pub mod box_tree;
pub mod check;
mod compensated;
pub mod complex;
pub mod cover;
pub mod crack;
pub mod dataset;
pub mod decompose;
pub mod domain;
pub mod edge;
pub mod equation;
pub mod expression;
pub mod field;
pub mod function;
pub mod growth;
pub mod jet;
pub mod library;
pub mod line;
pub mod mesh;
mod morton;
pub mod polynomial;
pub mod prelude;
pub mod progress;
pub mod quantity;
pub mod replace;
pub mod sample;
pub mod segment;
mod side_index;
pub mod sides;
pub mod smooth_curve;
pub mod spline;
pub mod text;
pub mod vec2;
pub mod weight;

pub use ppum_formula as formula;
pub use ppum_formula::{printable, real};
