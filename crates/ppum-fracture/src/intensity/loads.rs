//! Loads at the tips of a field.

use ppum::crack::{Side, TipId};
use ppum::vec2::Vec2;
use ppum_problem::{Problem, Symmetry};
use ppum_solve::terms::{FaceLaw, face_law, symmetry_of_field};

/// The loads where the interaction integral looks, and what is known of the field there. Nothing
/// acts unless it is said.
pub trait TipLoads: Sync {
    /// The body force per area at a point; none if there is none anywhere.
    fn body_force(&self, _: Vec2) -> Option<[f64; 2]> {
        None
    }

    /// The traction on a face of a crack, given by its index, at a point; none if there is none on
    /// any face.
    fn traction(&self, _crack: u32, _side: Side, _: Vec2) -> Option<[f64; 2]> {
        None
    }

    /// Returns the law between the faces of a crack, given by its index.
    fn face_law(&self, _crack: u32) -> Option<FaceLaw> {
        None
    }

    /// The symmetry of the field at a tip on the boundary, which has no factors without.
    fn symmetry(&self, _: TipId) -> Option<Symmetry> {
        None
    }
}

/// A multiple of the loads of a problem; without a problem none act.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadCase<'a> {
    /// The problem.
    pub problem: Option<&'a Problem>,
    /// The factor of its loads.
    pub factor: f64,
}

impl LoadCase<'_> {
    fn acting(&self) -> Option<&Problem> {
        self.problem.filter(|_| self.factor != 0.0)
    }

    fn times(&self, load: [f64; 2]) -> [f64; 2] {
        load.map(|part| self.factor * part)
    }
}

impl TipLoads for LoadCase<'_> {
    fn body_force(&self, x: Vec2) -> Option<[f64; 2]> {
        let is_zero = |problem: &Problem| problem.source.iter().all(|e| e.constant() == Some(0.0));
        let problem = self.acting().filter(|problem| !is_zero(problem))?;
        Some(self.times(problem.source_at(x)))
    }

    fn traction(&self, crack: u32, side: Side, x: Vec2) -> Option<[f64; 2]> {
        let problem = self.acting().filter(|problem| problem.loads_faces())?;
        Some(self.times(problem.face_load(crack as usize, side, x)))
    }

    fn face_law(&self, crack: u32) -> Option<FaceLaw> {
        face_law(self.problem?, crack)
    }

    fn symmetry(&self, tip: TipId) -> Option<Symmetry> {
        symmetry_of_field(self.problem?, tip)
    }
}
