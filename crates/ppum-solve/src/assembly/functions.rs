//! A system that is to be assembled, the functions that live in a cell, and the places of their
//! unknowns in the system.

use super::cell_matrix::CellMatrix;
use crate::basis::StableBasis;
use crate::law::Law;
use crate::space::TrialSpace;
use faer::{Mat, MatRef};
use ppum_linear::{BlockMatrix, add_at, product, taken};
use ppum_problem::Problem;

/// A system that is to be assembled: the problem, the functions, and the law of its equation.
#[derive(Clone, Copy)]
pub struct Assembly<'a> {
    /// Its body, loads and material.
    pub problem: &'a Problem,
    /// The patches with their local spaces.
    pub space: &'a TrialSpace<'a>,
    /// The unknowns of each patch in terms of its local functions.
    pub basis: &'a StableBasis,
    /// Stress or flux of a gradient.
    pub law: &'a Law<'a>,
}

impl Assembly<'_> {
    /// Components of the unknown field.
    pub(crate) fn components(&self) -> usize {
        self.law.components
    }

    /// Number of cells.
    pub fn n_cells(&self) -> usize {
        self.space.partition().len()
    }
}

/// The functions of a cell's patches, numbered patch after patch.
#[derive(Clone, Debug)]
pub(crate) struct CellFunctions {
    /// The patches that meet the cell, ascending.
    pub(crate) patches: Vec<u32>,
    /// First function of each patch, and the number of all at the end.
    pub(crate) first: Vec<usize>,
}

impl CellFunctions {
    /// Those of the basis.
    pub(crate) fn new(assembly: &Assembly<'_>, cell: usize) -> Self {
        Self::of(&assembly.space.covering_patches[cell], |patch| assembly.basis.sizes[patch])
    }

    /// Those that are evaluated, of which the basis is made.
    pub(crate) fn plain(assembly: &Assembly<'_>, cell: usize) -> Self {
        Self::of(&assembly.space.covering_patches[cell], |patch| assembly.space.evaluated(patch))
    }

    fn of(patches: &[u32], size: impl Fn(usize) -> usize) -> Self {
        let mut first = vec![0];
        patches.iter().for_each(|&p| first.push(first[first.len() - 1] + size(p as usize)));
        Self { patches: patches.to_vec(), first }
    }

    /// Number of functions.
    pub(crate) fn len(&self) -> usize {
        self.first[self.patches.len()]
    }

    /// For functions of some of the patches, in order, their numbers in the cell.
    pub(crate) fn numbers(&self, patches: &[u32]) -> Vec<usize> {
        let range = |patch: &u32| {
            let k = self.position(*patch);
            self.first[k]..self.first[k + 1]
        };
        patches.iter().flat_map(range).collect()
    }

    /// The places of some of the patches.
    pub(crate) fn positions(&self, patches: &[u32]) -> Vec<usize> {
        patches.iter().map(|&patch| self.position(patch)).collect()
    }

    /// A matrix of zeros over all unknowns, or over all functions in each component where these are
    /// not tied, in the memory of an earlier one.
    pub(super) fn zero(&self, assembly: &Assembly<'_>, tied: bool, memory: Vec<f64>) -> CellMatrix {
        let fields = assembly.fields(&self.patches, tied);
        let sizes = fields.iter().map(|fields| fields.len(assembly.components()));
        CellMatrix::new(sizes, |k, l| self.overlap(assembly, k, l), memory)
    }

    /// True if patches `k` and `l` overlap, in the cell or elsewhere.
    fn overlap(&self, assembly: &Assembly<'_>, k: usize, l: usize) -> bool {
        let [a, b] = [k, l].map(|k| assembly.space.partition().support(self.patches[k] as usize));
        a.overlaps(&b)
    }

    /// The whole matrix over all functions in each component, component i of function a at a ·
    /// components + i, of its blocks of pairs of patches.
    pub(super) fn free_matrix<'m>(
        &self,
        assembly: &Assembly<'_>,
        block: &dyn Fn(usize, usize) -> MatRef<'m, f64>,
    ) -> Mat<f64> {
        let components = assembly.components();
        let n = self.len() * components;
        let mut matrix = Mat::zeros(n, n);
        for (k, l) in self.pairs(assembly) {
            let [rows, columns] = [k, l].map(|k| self.free(k, components));
            let block = block(k, l);
            add_at(&mut matrix, &rows, &columns, &block.to_owned());
            if k != l {
                add_at(&mut matrix, &columns, &rows, &block.transpose().to_owned());
            }
        }
        matrix
    }

    /// The matrix over the unknowns from the one over all functions.
    pub(super) fn tied_matrix(&self, assembly: &Assembly<'_>, free: &Mat<f64>) -> CellMatrix {
        let mut matrix = self.zero(assembly, true, Vec::new());
        for (k, l) in self.pairs(assembly) {
            let [rows, columns] = [k, l].map(|k| self.free(k, assembly.components()));
            let block = taken(free, &rows, &columns);
            let [left, right] = [k, l].map(|k| assembly.basis.tie(self.patches[k]));
            let half = left.map(|tie| product(tie.as_ref(), block.as_ref())).unwrap_or(block);
            let whole = right.map(|tie| product(half.as_ref(), tie.transpose())).unwrap_or(half);
            matrix.block_mut(k, l).copy_from(&whole);
        }
        matrix
    }

    /// The pairs of patches that overlap, in the order of the system: of patch 0 and those from 0
    /// on, of patch 1 and those from 1 on, …
    pub(super) fn pairs(&self, assembly: &Assembly<'_>) -> impl Iterator<Item = (usize, usize)> {
        let n = self.patches.len();
        let all = (0..n).flat_map(move |k| (k..n).map(move |l| (k, l)));
        all.filter(|&(k, l)| self.overlap(assembly, k, l))
    }

    /// The cell's unknowns of patch `k` in the order of the system, component-major; ties are still
    /// to come.
    pub(crate) fn free(&self, k: usize, components: usize) -> Vec<usize> {
        let functions = self.first[k]..self.first[k + 1];
        (0..components).flat_map(|i| functions.clone().map(move |a| a * components + i)).collect()
    }

    /// Adds numbers of the cell's unknowns, component i of function a at a · components + i, to
    /// those of all unknowns.
    pub(crate) fn add_to(
        &self,
        basis: &StableBasis,
        matrix: &BlockMatrix,
        components: usize,
        part: &[f64],
        sum: &mut [f64],
    ) {
        for (k, &patch) in self.patches.iter().enumerate() {
            let sum = &mut sum[matrix.unknowns(patch as usize)];
            let own = self.free(k, components).into_iter().map(|from| part[from]);
            let Some(tie) = basis.tie(patch) else {
                sum.iter_mut().zip(own).for_each(|(sum, part)| *sum += part);
                continue;
            };
            for (j, part) in own.enumerate() {
                sum.iter_mut().zip(tie.col(j).iter()).for_each(|(sum, tie)| *sum += tie * part);
            }
        }
    }

    /// The cell's unknowns out of all: the way back of [`CellFunctions::add_to`].
    pub(crate) fn take_from(
        &self,
        basis: &StableBasis,
        matrix: &BlockMatrix,
        components: usize,
        all: &[f64],
    ) -> Vec<f64> {
        let mut part = vec![0.0; self.len() * components];
        for (k, &patch) in self.patches.iter().enumerate() {
            let own = &all[matrix.unknowns(patch as usize)];
            for (j, to) in self.free(k, components).into_iter().enumerate() {
                part[to] = match basis.tie(patch) {
                    Some(tie) => tie.col(j).iter().zip(own).map(|(tie, u)| tie * u).sum(),
                    None => own[j],
                };
            }
        }
        part
    }

    fn position(&self, patch: u32) -> usize {
        self.patches.binary_search(&patch).expect("a rule's patches meet its cell")
    }
}
