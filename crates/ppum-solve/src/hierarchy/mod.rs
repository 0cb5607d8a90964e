//! Coarser levels of a system, for its multilevel solver: coarser meshes, the same problem on them,
//! and the way up.
//!
//! A level is discretised again \[Griebel & Schweitzer 2002\]: its patches have the enrichments
//! that the problem gives patches of their size, its matrix is integrated on its own cells. Pᵀ K P
//! would keep what a prolongation between different enrichments gets wrong
//! (`docs/decisions/0020-multilevel.md`).

mod transfer;

use crate::assembly::{
    Assembly, DualLoads, FreeModes, Functionals, PrescribedData, System, slivers,
};
use crate::basis::StableBasis;
use crate::equilibrium::BodyEquilibrium;
use crate::law::Law;
use crate::space::{CoverMesh, SpaceError, TrialSpace, discretise_on};
use crate::watched::{Halt, WorkPhase};
use ppum::progress::Cancelled;
use ppum_linear::CoarseLevel;
use ppum_problem::Problem;
use transfer::{SpaceWithBasis, transfer};

/// Unknowns up to which a level is solved directly: in less time than the levels above it take.
const DIRECT: usize = 3_000;

/// Part of the cells of a level up to which the next one may have them: where the cover is deep and
/// narrow, several steps to coarser cells are taken at once.
const FEWER: f64 = 0.7;

/// A system to find coarser levels of.
#[derive(Clone, Copy)]
pub struct FinestLevel<'a> {
    /// The problem that it belongs to.
    pub problem: &'a Problem,
    /// The pieces of the body.
    pub plate: &'a BodyEquilibrium,
    /// The cells.
    pub mesh: &'a CoverMesh,
    /// The patches of the cells.
    pub space: &'a TrialSpace<'a>,
    /// The unknowns of each patch.
    pub basis: &'a StableBasis,
}

/// A level while the next coarser one is made.
struct FinerLevel<'p> {
    space: TrialSpace<'p>,
    basis: StableBasis,
}

/// Why a level cannot be made.
enum LevelError {
    Cancelled(Cancelled),
    /// A cover so coarse that the problem makes no sense on it: the level before it is
    /// the coarsest.
    TooCoarse,
}

impl FinestLevel<'_> {
    /// The coarser levels, the finest of them first, without the penalties of a constraint.
    ///
    /// # Errors
    /// Cancelled.
    pub fn coarser(&self, stage: &WorkPhase<'_>) -> Result<Vec<CoarseLevel>, Cancelled> {
        let components = self.problem.components();
        let mut levels: Vec<CoarseLevel> = Vec::new();
        let mut last: Option<FinerLevel<'_>> = None;
        let mut mesh = self.mesh.clone();
        loop {
            let (space, basis) = last
                .as_ref()
                .map_or((self.space, self.basis), |level| (&level.space, &level.basis));
            if basis.unknowns(components).sum::<usize>() <= DIRECT {
                return Ok(levels);
            }
            let Some(coarser) = fewer(&mesh) else { return Ok(levels) };
            mesh = coarser;
            match self.level(&mesh, (space, basis), stage) {
                Ok((level, coarse)) => {
                    levels.push(coarse);
                    last = Some(level);
                }
                Err(LevelError::Cancelled(cancelled)) => return Err(cancelled),
                Err(LevelError::TooCoarse) => return Ok(levels),
            }
        }
    }

    /// The problem on a mesh, and its system with the transfer to the next finer level.
    fn level(
        &self,
        mesh: &CoverMesh,
        finer: SpaceWithBasis<'_>,
        stage: &WorkPhase<'_>,
    ) -> Result<(FinerLevel<'_>, CoarseLevel), LevelError> {
        let problem = self.problem;
        let step = discretise_on(problem, mesh, stage)?;
        let space =
            TrialSpace::of_problem(problem, step, None).map_err(|_| LevelError::TooCoarse)?;
        let mut basis = StableBasis::new(&space, stage)?;
        let law = &Law::new(&problem.equation);
        let found = slivers(Assembly { problem, space: &space, basis: &basis, law }, stage)?;
        basis.rescale(&space, &found)?;
        let assembly = Assembly { problem, space: &space, basis: &basis, law };
        let (free, duals) = (&FreeModes::none(self.plate), &DualLoads::new(Vec::new(), &space));
        let given = PrescribedData::restraints(problem);
        let system = System::new(assembly, &given, Functionals { free, duals }, stage)?;
        let transfer = transfer(finer, (&space, &basis), stage)?;
        Ok((FinerLevel { space, basis }, CoarseLevel { matrix: system.matrix, transfer }))
    }
}

/// The next coarser mesh with clearly fewer cells.
fn fewer(mesh: &CoverMesh) -> Option<CoverMesh> {
    let few = |coarse: &CoverMesh| coarse.n_cells() as f64 <= FEWER * mesh.n_cells() as f64;
    std::iter::successors(mesh.coarser(), CoverMesh::coarser).find(few)
}

impl From<Halt> for LevelError {
    fn from(halt: Halt) -> Self {
        match halt {
            Halt::Cancelled(cancelled) => Self::Cancelled(cancelled),
            Halt::NotFinite(_) => Self::TooCoarse,
        }
    }
}

impl From<SpaceError> for LevelError {
    fn from(error: SpaceError) -> Self {
        match error {
            SpaceError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            _ => Self::TooCoarse,
        }
    }
}
