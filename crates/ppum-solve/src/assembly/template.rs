//! The stiffness of cells that are alike, with patches that are alike: one matrix serves all
//! of them.

use super::Assembly;
use super::cell::CellAssembler;
use super::cell_matrix::{CellMatrix, Stiffness};
use crate::space::CongruentCell;
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::OnceLock;

/// Cells from which on a matrix is kept: all that are kept, of 29 blocks each, take about as much
/// memory as the system then, five blocks a cell. For fewer cells it is made each time, with the
/// same bits.
const MANY: usize = 6;

/// The templates of a system.
pub(super) struct Templates<'a> {
    assembly: Assembly<'a>,
    /// The template of each cell that has one.
    of_cell: Vec<Option<u32>>,
    all: Vec<Template<'a>>,
}

/// The stiffness of some cells.
struct Template<'a> {
    /// One of the cells.
    member: &'a CongruentCell,
    cells: usize,
    matrix: OnceLock<CellMatrix>,
}

impl<'a> Templates<'a> {
    /// None where the material varies.
    pub(super) fn new(assembly: Assembly<'a>) -> Self {
        let n = if assembly.law.is_uniform() { assembly.n_cells() } else { 0 };
        let (alike, mut known) = (assembly.space.alike(), HashMap::new());
        let mut all: Vec<Template<'a>> = Vec::new();
        let template = |cell: usize| {
            let member = alike.cell(cell)?;
            let kinds = member.patches.iter().map(|&patch| assembly.basis.kind(patch));
            let kinds: Vec<usize> = kinds.collect::<Option<_>>()?;
            let place = *known.entry((member.kind, kinds)).or_insert_with(|| {
                all.push(Template { member, cells: 0, matrix: OnceLock::new() });
                all.len() - 1
            });
            all[place].cells += 1;
            Some(place as u32)
        };
        let of_cell = (0..n).map(template).collect();
        Self { assembly, of_cell, all }
    }

    /// The stiffness of a cell that has a template.
    pub(super) fn of(&self, cell: usize) -> Option<Stiffness<'_>> {
        let template = &self.all[(*self.of_cell.get(cell)?)? as usize];
        let matrix = match template.cells {
            MANY.. => Cow::Borrowed(template.matrix.get_or_init(|| self.made(template))),
            _ => Cow::Owned(self.made(template)),
        };
        let seated = &self.assembly.space.alike().cell(cell)?.patches;
        let seat = |patch: &u32| seated.iter().position(|p| p == patch);
        let seats =
            self.assembly.space.covering_patches[cell].iter().map(seat).collect::<Option<_>>()?;
        Some(Stiffness { matrix, seats: Some(seats) })
    }

    /// Points of the rules on a cell that has a template.
    pub(super) fn points(&self, cell: usize) -> Option<usize> {
        let template = &self.all[(*self.of_cell.get(cell)?)? as usize];
        let rules = &self.assembly.space.alike().kinds[template.member.kind as usize].rules;
        Some(rules.iter().map(|rule| rule.weights.len()).sum())
    }

    fn made(&self, template: &Template<'_>) -> CellMatrix {
        let Assembly { space, basis, .. } = self.assembly;
        let kind = &space.alike().kinds[template.member.kind as usize];
        let (space, basis) = (kind.space(space), basis.of_patches(&template.member.patches));
        let assembly = Assembly { space: &space, basis: &basis, ..self.assembly };
        CellAssembler::new(assembly, None).stiffness(0, &kind.rules)
    }
}

#[cfg(test)]
mod tests {
    use super::super::functions::CellFunctions;
    use super::*;
    use crate::basis::StableBasis;
    use crate::law::Law;
    use crate::space::{TrialSpace, discretise};
    use crate::watched::WorkPhase;
    use ppum::progress::{Phase, unwatched};
    use ppum_problem::Problem;
    use ppum_testkit::random::Random;
    use std::path::Path;

    /// A body with an edge crack somewhere, at a place that no coordinate is exact at.
    fn plate(random: &mut Random, young: &str, cells: &str) -> Problem {
        let [x, y] = [random.between(0.5, 0.8), random.between(0.3, 0.7)];
        let text = format!(
            r#"
            domain = {{ min = [0.1, -0.3], max = [1.3, 0.9] }}
            material = {{ young = {young}, poisson = 0.3, state = "plane-strain" }}
            crack = [{{ points = [[0.1, 0.2], [{x}, {y}]] }}]
            discretization = {{ {cells} }}
            boundary = [{{ on = "bottom", displacement = [0, 0] }}]
            "#
        );
        Problem::parse(&text, "plate.toml", Path::new(".")).expect("a problem in order")
    }

    /// Calls `look` with the assembly of a problem.
    fn with_assembly(problem: &Problem, look: &mut dyn FnMut(Assembly<'_>)) {
        let step = discretise(problem, unwatched()).expect("a cover");
        let space = &TrialSpace::of_problem(problem, step, None).expect("a space");
        let stage = WorkPhase::uncounted(unwatched(), Phase::Basis).expect("nobody stops it");
        let basis = &StableBasis::new(space, &stage).expect("a basis");
        look(Assembly { problem, space, basis, law: &Law::new(&problem.equation) });
    }

    const COVERS: [&str; 3] = [
        "cells = [20, 20], order = 2",
        "level = 3, order = 1, refine = true",
        "cells = [9, 7], order = 3",
    ];

    /// Templates give the same stiffness as integration on the cell itself.
    #[test]
    fn templates_are_the_stiffness_of_their_cells() {
        let (mut random, mut all) = (Random(8), 0);
        for cells in COVERS {
            with_assembly(&plate(&mut random, "1", cells), &mut |assembly| {
                let templates = Templates::new(assembly);
                let quadrature = assembly.space.quadrature(0);
                let mut assembler = CellAssembler::new(assembly, None);
                let (mut found, mut worst) = (0, 0.0_f64);
                for cell in 0..assembly.n_cells() {
                    let Some(template) = templates.of(cell) else { continue };
                    let covered = assembly.space.cell(cell);
                    let own = assembler.stiffness(cell, &quadrature.cell(covered));
                    let n = covered.patches.len();
                    let largest = (0..n).map(|k| own.block(k, k).norm_max()).fold(0.0, f64::max);
                    let functions = CellFunctions::new(&assembly, cell);
                    for (k, l) in functions.pairs(&assembly) {
                        let apart = (own.block(k, l) - template.block(k, l)).norm_max();
                        worst = worst.max(apart / largest);
                    }
                    found += 1;
                }
                // a small cover that is graded may have no two cells that are alike
                all += found;
                assert!(worst < 1e-11, "{cells}: {worst:e}");
            });
        }
        assert!(all > 50, "{all} cells have templates");
    }

    /// Most of the cells of a uniform cover have one template, whatever rounding does to its
    /// coordinates, and none does where the material varies.
    #[test]
    fn cells_of_a_uniform_cover_are_alike() {
        let cover = "cells = [20, 20], order = 1";
        with_assembly(&plate(&mut Random(2), "1", cover), &mut |assembly| {
            let templates = Templates::new(assembly);
            let most = templates.all.iter().map(|template| template.cells).max();
            assert!(most.is_some_and(|most| most > 50), "{most:?}");
            assert!(templates.all.len() < 40, "{}", templates.all.len());
        });
        with_assembly(&plate(&mut Random(2), "\"1 + x\"", cover), &mut |assembly| {
            let templates = Templates::new(assembly);
            assert!((0..assembly.n_cells()).all(|cell| templates.of(cell).is_none()));
        });
    }
}
