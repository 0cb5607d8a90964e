//! Development tools of `ppum`, for tests only.
//!
//! - [`synthetic`] makes datasets that no solver has to make, [`costly`] small ones that ask for
//!   much.
//! - [`exact`] holds exact solutions of fracture mechanics, [`extended`] evaluates with 31 digits.
//! - [`corpus`] are the cases that every back end of formulas is held to, [`fields`] the images
//!   that every renderer is held to; `wgsl`, a feature, runs shaders without a device.
//! - [`meshes`] makes elements with fields that are known.
//! - [`random`] numbers are the same on every machine; [`processor`] measures processor time.
//!
//! ```
//! use ppum::prelude::*;
//! use ppum_testkit::random::Random;
//! use ppum_testkit::synthetic::Recipe;
//!
//! let dataset = Recipe::default().dataset();
//! let field = Field::new(&dataset, 0)?;
//! let (mut random, mises) = (Random(1), Quantity::parse("von-mises", &field)?);
//! let point = random.point(&dataset.domain.bounds);
//! assert!(mises.at(&mut field.at(point), Vec2::ZERO, Side::Above) > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod corpus;
pub mod costly;
pub mod exact;
pub mod extended;
pub mod fields;
pub mod meshes;
pub mod processor;
pub mod random;
pub mod skipped;
pub mod synthetic;
#[cfg(feature = "wgsl")]
pub mod wgsl;

/// A test that error types can be sent to other threads and kept for ever.
#[macro_export]
macro_rules! errors_cross_threads {
    ($($error:ty),+ $(,)?) => {
        #[test]
        fn errors_cross_threads() {
            fn check<E: std::error::Error + Send + Sync + 'static>() {}
            $(check::<$error>();)+
        }
    };
}
