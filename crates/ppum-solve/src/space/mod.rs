//! The trial space: a step whose coefficients are still to be found, and the lists the solver needs
//! to walk over it.

mod congruence;
mod congruent;
mod discretise;
mod enrichment;
mod error;
mod inspect;
mod known;
mod mesh;
mod trial;
mod williams;

pub use crate::refine::RefineError;
pub(crate) use congruence::CongruentCell;
pub use discretise::{discretise, discretise_on};
pub use error::SpaceError;
pub use inspect::InspectError;
pub(crate) use known::KnownFunction;
pub use mesh::{CellChange, CoverMesh};
pub use trial::TrialSpace;
pub(crate) use williams::{ANGULAR, Origin, SeriesFunctions};
