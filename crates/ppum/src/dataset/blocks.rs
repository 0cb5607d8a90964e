//! The blocks of a field.

use crate::polynomial::{PolynomialSpace, monomials};

/// A field's blocks and coefficients in compressed rows.
///
/// Patch `i` owns blocks `patch_blocks[i] .. patch_blocks[i + 1]`. Block `b` is function
/// `block_function[b]` times a polynomial of degree `block_degree[b]` whose coefficients start at
/// `block_offset[b]` in each component's array. Monomials are ordered by total degree, then by
/// descending power of x: 1, ξ, η, ξ², ξη, η², …
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FieldData {
    /// Name, e.g. `displacement`.
    pub name: String,
    /// Unit of the values, for labels; may be empty.
    pub unit: String,
    /// Names of the components as used by quantities, e.g. `ux`, `uy`.
    pub components: Vec<String>,
    /// Compressed rows: patch → blocks; one entry more than there are patches.
    pub patch_blocks: Vec<u32>,
    /// Function of each block.
    pub block_function: Vec<u32>,
    /// Polynomial degree of each block, at most [`MAX_DEGREE`](crate::polynomial::MAX_DEGREE).
    pub block_degree: Vec<u8>,
    /// Monomials of each block, empty if all are [`Total`](PolynomialSpace::Total); those of boxes
    /// are.
    pub block_space: Vec<PolynomialSpace>,
    /// First coefficient of each block.
    pub block_offset: Vec<u64>,
    /// Coefficients, one array per component.
    pub coefficients: Vec<Vec<f64>>,
    /// Formulas of x and y of the exact solution, one per component; empty if unknown.
    pub exact: Vec<String>,
}

impl FieldData {
    /// A field without patches.
    #[must_use]
    pub fn new(name: &str, components: &[&str]) -> Self {
        Self {
            name: name.into(),
            components: components.iter().map(|&component| component.into()).collect(),
            patch_blocks: vec![0],
            coefficients: vec![Vec::new(); components.len()],
            ..Self::default()
        }
    }

    /// The monomials of a block.
    #[must_use]
    #[inline]
    pub fn space(&self, block: usize) -> PolynomialSpace {
        self.block_space.get(block).copied().unwrap_or_default()
    }

    /// Number of coefficients of a block, for each component.
    #[must_use]
    #[inline]
    pub fn block_size(&self, block: usize) -> usize {
        self.space(block).size(self.block_degree[block].into())
    }

    /// Adds a patch with blocks of these functions and degrees. Its coefficients are zero, and lie
    /// behind all others.
    pub fn push_patch(&mut self, blocks: &[(u32, u8)]) {
        for &(function, degree) in blocks {
            let start = self.coefficients.first().map_or(0, Vec::len);
            self.block_function.push(function);
            self.block_degree.push(degree);
            self.block_offset.push(start as u64);
            for component in &mut self.coefficients {
                component.resize(start + monomials(degree.into()), 0.0);
            }
        }
        self.patch_blocks.push(self.block_function.len() as u32);
    }

    /// The coefficients of a patch, one slice per component, block after block, where these follow
    /// each other as [`push_patch`](Self::push_patch) lays them.
    pub fn coefficients_mut(&mut self, patch: usize) -> impl Iterator<Item = &mut [f64]> {
        let range = self.range(patch);
        self.coefficients.iter_mut().map(move |component| &mut component[range.clone()])
    }

    /// From the first coefficient of a patch's first block to the last one of its last.
    fn range(&self, patch: usize) -> std::ops::Range<usize> {
        let blocks = self.blocks(patch);
        let end = |b: usize| self.block_offset[b] as usize + self.block_size(b);
        match blocks.clone().last() {
            Some(last) => self.block_offset[blocks.start] as usize..end(last),
            None => 0..0,
        }
    }

    /// The blocks of a patch as a range of block indices.
    #[must_use]
    pub fn blocks(&self, patch: usize) -> std::ops::Range<usize> {
        self.patch_blocks[patch] as usize..self.patch_blocks[patch + 1] as usize
    }

    /// The coefficients of one block and component.
    #[must_use]
    pub fn block_coefficients(&self, block: usize, component: usize) -> &[f64] {
        let start = self.block_offset[block] as usize;
        let count = self.block_size(block);
        &self.coefficients[component][start..start + count]
    }
}
