//! The whole system in the stable basis, summed over the cells.

use super::border::BorderPiece;
use super::cell::CellAssembler;
use super::cell_system::CellSystem;
use super::given::Given;
use super::reaction::Reactions;
use crate::basis::{Penalty, StableBasis};
use crate::batch::in_batches;
use crate::geometry::Around;
use crate::law::Law;
use crate::linear::{BlockMatrix, BlockPattern};
use crate::problem::Problem;
use crate::quadrature::{Doubt, EdgeRule, Rule};
use crate::space::Space;
use ppum::vec2::{Rect, Vec2};

/// The assembled system.
pub(crate) struct System {
    pub(crate) matrix: BlockMatrix,
    /// Right-hand side, in the order of the matrix.
    pub(crate) load: Vec<f64>,
    /// The largest Nitsche's β of a cell, times the cell's width over λ + 2μ or the conductivity.
    pub(crate) nitsche: f64,
    /// What the supports exert on the plate.
    pub(crate) reactions: Reactions,
    /// Number of quadrature points, those of loads that have their own among them.
    pub(crate) points: usize,
    /// Loads and data, functions and coefficients that are not resolved.
    pub(crate) unresolved: Vec<Unresolved>,
}

/// Something that quadrature does not resolve.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unresolved {
    /// What it is, in words of the problem; functions of the space and coefficients if there are none.
    pub(crate) load: Option<String>,
    /// Estimated error: of a load that of its resultant as a part of its magnitude, of functions that of
    /// their integrals over a piece of a cell.
    pub(crate) error: f64,
    /// Where most of it is.
    pub(crate) at: Vec2,
}

/// Nitsche's β in units of (λ + 2μ) / width from which on a cell's border is cut into slivers; whole cells
/// have 3 to 36.
const SLIVER: f64 = 50.0;

/// The cells with a β so large that the basis should see it.
///
/// # Errors
/// Where data are not finite.
pub(crate) fn slivers(
    problem: &Problem,
    space: &Space<'_>,
    basis: &StableBasis,
    law: &Law<'_>,
) -> Result<Vec<Penalty>, Around> {
    let quadrature = space.quadrature(0);
    let given = Given::supports(problem);
    let mut found = Ok(Vec::new());
    in_batches(
        if given.is_empty() { 0 } else { space.partition.len() },
        || CellAssembler::new(space, basis, law),
        |assembler, cell| {
            let on_border = given.border(space, &quadrature, cell);
            if on_border.is_empty() {
                return Ok(None);
            }
            let rules = space.rules(&quadrature, cell);
            let part = assembler.assemble(cell, &rules, None, &on_border);
            let part = part.map_err(|_| space.partition.cell[cell])?;
            let rules = on_border.into_iter().flat_map(|piece| piece.rules).collect();
            let is_large = part.penalty * width(&space.partition.cell[cell]) > SLIVER;
            Ok(is_large.then_some(Penalty { rules, weight: part.penalty }))
        },
        |_, part: Result<Option<Penalty>, Around>| match (&mut found, part) {
            (Ok(all), Ok(part)) => all.extend(part),
            (Ok(_), Err(error)) => found = Err(error),
            (Err(_), _) => {}
        },
    );
    found
}

fn width(cell: &Rect) -> f64 {
    cell.size().x.max(cell.size().y)
}

/// Assembles the system of what is given on a space. `progress` is told the cells that are done.
///
/// # Errors
/// Where data are not finite.
pub(crate) fn assemble(
    given: &Given<'_>,
    space: &Space<'_>,
    basis: &StableBasis,
    law: &Law<'_>,
    progress: &mut dyn FnMut(usize),
) -> Result<System, Around> {
    let quadrature = space.quadrature(0);
    let mut system = System::new(space, basis, law.components);
    system.unresolved = given.unresolved();
    let (mut failed, mut doubt) = (None, Doubt::default());
    in_batches(
        space.partition.len(),
        || CellAssembler::new(space, basis, law),
        |assembler, cell| {
            let rules = space.rules(&quadrature, cell);
            let pieces = given.border(space, &quadrature, cell);
            let source = given.source(cell);
            let own = source.and_then(|source| source.rules);
            let points = n_points(&rules, &pieces) + own.map_or(0, n_cell_points);
            let part = assembler.assemble(cell, &rules, source, &pieces);
            (part, points, doubt_of(&rules, &pieces))
        },
        |cell, (part, points, left)| {
            system.points += points;
            doubt.add(&left);
            match part {
                Ok(part) => {
                    system.nitsche =
                        system.nitsche.max(part.penalty * width(&space.partition.cell[cell]));
                    system.add(&part, law.components);
                    system.reactions.push(part);
                }
                Err(_) => failed = failed.or(Some(space.partition.cell[cell].into())),
            }
            progress(cell + 1);
        },
    );
    if doubt.functions > 0.0 {
        system.unresolved.push(Unresolved { load: None, error: doubt.functions, at: doubt.at });
    }
    failed.map_or(Ok(system), Err)
}

fn n_cell_points(rules: &[Rule]) -> usize {
    rules.iter().map(|rule| rule.weights.len()).sum()
}

fn n_points(rules: &[Rule], pieces: &[BorderPiece<'_>]) -> usize {
    let own = |piece: &BorderPiece<'_>| piece.own.map_or(0, n_edge_points);
    let border = pieces.iter().map(|piece| n_edge_points(&piece.rules) + own(piece));
    n_cell_points(rules) + border.sum::<usize>()
}

fn n_edge_points(rules: &[EdgeRule]) -> usize {
    rules.iter().map(|rule| rule.weights.len()).sum()
}

/// What the rules of a cell and of its border do not resolve.
fn doubt_of(rules: &[Rule], pieces: &[BorderPiece<'_>]) -> Doubt {
    let border = pieces.iter().flat_map(|piece| &piece.rules).map(|rule| &rule.doubt);
    let mut sum = Doubt::default();
    rules.iter().map(|rule| &rule.doubt).chain(border).for_each(|doubt| sum.add(doubt));
    sum
}

impl System {
    fn new(space: &Space<'_>, basis: &StableBasis, components: usize) -> Self {
        let sizes: Vec<_> = basis.sizes.iter().map(|n| n * components).collect();
        let matrix = BlockMatrix::new(&sizes, pattern(space));
        Self {
            load: vec![0.0; matrix.n_unknowns()],
            matrix,
            nitsche: 0.0,
            reactions: Reactions::default(),
            points: 0,
            unresolved: Vec::new(),
        }
    }

    fn add(&mut self, part: &CellSystem, components: usize) {
        part.functions.add_to(&self.matrix, components, &part.load, &mut self.load);
        let patches = &part.functions.patches;
        for (k, &p) in patches.iter().enumerate() {
            let p = p as usize;
            for (l, &q) in patches.iter().enumerate().skip(k) {
                // both meet the cell, but not each other
                if !self.matrix.couples(p, q as usize) {
                    continue;
                }
                let block = part.block(k, l, components);
                self.matrix.add_block(p, q as usize, block.as_ref());
            }
        }
    }
}

/// Two patches are coupled when their open supports meet.
pub(crate) fn pattern(space: &Space<'_>) -> BlockPattern {
    let support = |p: u32| space.partition.support(p as usize);
    let mut rows = vec![Vec::new(); space.partition.len()];
    for patches in &space.coverers {
        for (k, &p) in patches.iter().enumerate() {
            let meets = |q: &&u32| support(p).overlaps(&support(**q));
            rows[p as usize].extend(patches[k..].iter().filter(meets));
        }
    }
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for row in &mut rows {
        row.sort_unstable();
        row.dedup();
        columns.extend_from_slice(row);
        starts.push(columns.len());
    }
    BlockPattern::new(starts, columns)
}
