//! Meshes: patches that are elements, images of a triangle or a square under polynomial maps.
//!
//! On an element every field of finite elements, enriched, cut or discontinuous, is a sum of
//! function × polynomial of the reference coordinate ξ:
//!
//! ```text
//! v(x) = Σ_b f_b(x) P_b(ξ)        x = origin + M(ξ)        ξ in the reference shape
//! ```
//!
//! A cut element is two patches with the same map and opposite clips: one where a level field is ≥
//! 0, one where it is < 0.

mod element;
mod elements;
mod evaluate;
mod frame;
pub mod grid;
mod local;
mod many;
mod map;
mod shape;
mod taylor;

pub use element::{ElementField, ElementPoint};
pub use elements::{Clip, Mesh};
pub(crate) use local::LocalMesh;
pub use shape::Shape;
