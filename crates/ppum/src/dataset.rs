//! The dataset: everything needed to evaluate a solution exactly, nothing of the solver's
//! inner state.
//!
//! A dataset is a series of quasi-static [`Step`]s over one domain. Each step has its own cover,
//! cracks, functions and fields. On patch ω_i a field is a sum of function × polynomial,
//!
//! ```text
//! v_i(x) = Σ_b f_b(x) Σ_{|k| ≤ d_b} c_{b,k} ξ^k        v = Σ_i φ_i v_i        ξ = (x − origin_i) / scale_i
//! ```
//!
//! so that smooth parts (f = 1), jumps (f = side of a crack) and tip functions differ in nothing
//! but the function their [blocks](FieldData) name. `ppum-format` stores this structure,
//! `ppum-solve` makes it, [`Field`](crate::field::Field) evaluates it.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use crate::crack::{Crack, TipId};
use crate::domain::Domain;
pub use crate::equation::{Elasticity, Equation, Material, StressState};
use crate::function::{Function, FunctionKind};
pub use crate::growth::{Advance, Fate, Growth, GrowthStop};
use crate::mesh::Mesh;
use crate::polynomial::PolynomialSpace;
use crate::vec2::{Rect, Vec2};
use crate::weight::WeightFunction;
use ppum_formula::Table;

/// A solved problem, or a field from elsewhere in the same representation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Dataset {
    /// One line that names the problem.
    pub title: String,
    /// Name and version of the program that made it, e.g. `ppum 0.1.0`.
    pub program: String,
    /// The text that the problem was read from, if there was one.
    pub problem: Option<String>,
    /// The box minus holes Ω. Outside it nothing is defined.
    pub domain: Domain,
    /// The equation that was solved; decides which quantities have a meaning.
    pub equation: Equation,
    /// Quantities the dataset names, beside the built-in ones.
    pub quantities: Vec<NamedQuantity>,
    /// Tables its formulas may read.
    pub tables: Vec<Arc<Table>>,
    /// Quasi-static series, at least one.
    pub steps: Vec<Step>,
}

impl Dataset {
    /// A dataset without steps, titles and names.
    #[must_use]
    pub fn new(domain: impl Into<Domain>, equation: Equation) -> Self {
        Self {
            title: String::new(),
            program: String::new(),
            problem: None,
            domain: domain.into(),
            equation,
            quantities: Vec::new(),
            tables: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// The dataset with one more step at its end.
    #[must_use]
    pub fn with_step(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }
}

/// One state of a quasi-static series.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Step {
    /// Load factor or pseudo-time of the step.
    pub load: f64,
    /// The patches.
    pub partition: Partition,
    /// The cracks.
    pub cracks: Vec<Crack>,
    /// The functions f_b that the fields' blocks name.
    pub functions: Vec<Function>,
    /// The fields; a solver's dataset has one, `displacement` or `potential`.
    pub fields: Vec<FieldData>,
    /// Named values, one per patch.
    pub attributes: Vec<Attribute>,
    /// Stress intensity factors found by the solver.
    pub intensities: Vec<TipIntensity>,
    /// The report of the solver: residual, unknowns, functions cut off, seconds per phase.
    pub history: Vec<Record>,
    /// Warnings of the diagnostics.
    pub warnings: Vec<Warning>,
    /// Resultants of the forces the supports exert on the plate, one per boundary condition that
    /// gives values.
    pub reactions: Vec<Reaction>,
    /// How the cracks grow on from here, in a series of growth.
    pub growth: Option<Growth>,
}

impl Step {
    /// A step of load factor 1 with a partition and nothing else.
    #[must_use]
    pub fn new(partition: impl Into<Partition>) -> Self {
        Self {
            load: 1.0,
            partition: partition.into(),
            cracks: Vec::new(),
            functions: Vec::new(),
            fields: Vec::new(),
            attributes: Vec::new(),
            intensities: Vec::new(),
            history: Vec::new(),
            warnings: Vec::new(),
            reactions: Vec::new(),
            growth: None,
        }
    }

    /// The value of a record of the history.
    #[must_use]
    pub fn record(&self, name: &str) -> Option<f64> {
        self.history.iter().find(|record| record.name == name).map(|record| record.value)
    }

    /// Number of unknowns of the solution: those that the solver reports, else the coefficients of
    /// the first field. Where the components of functions are tied, there are more coefficients
    /// than unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        let coefficients =
            || self.fields.first().map_or(0, |f| f.coefficients.iter().map(Vec::len).sum());
        self.record("unknowns").map_or_else(coefficients, |unknowns| unknowns as usize)
    }

    /// The level fields of a mesh, those that clips and functions name, as indices of the fields in
    /// rising order.
    #[must_use]
    pub fn level_fields(&self) -> Vec<usize> {
        let clips = self.partition.mesh().map_or(&[][..], |mesh| &mesh.clips);
        let of_functions = self.functions.iter().flat_map(|function| function.kind.levels());
        let all: BTreeSet<u32> = clips.iter().map(|clip| clip.field).chain(of_functions).collect();
        all.into_iter().map(|field| field as usize).collect()
    }

    /// The step with one more crack.
    #[must_use]
    pub fn with_crack(mut self, crack: Crack) -> Self {
        self.cracks.push(crack);
        self
    }

    /// The step with one more function, which blocks name by its place in the list.
    #[must_use]
    pub fn with_function(mut self, name: &str, kind: FunctionKind) -> Self {
        self.functions.push(Function { name: name.into(), kind });
        self
    }

    /// The step with one more field.
    #[must_use]
    pub fn with_field(mut self, field: FieldData) -> Self {
        self.fields.push(field);
        self
    }
}

/// The patches of a step, and how their local fields make one field.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Partition {
    /// Boxes that overlap, with weights.
    Boxes(BoxPartition),
    /// Elements of a mesh, or parts of them: φ_i is 1 in patch i and 0 elsewhere.
    Mesh(Mesh),
}

impl From<BoxPartition> for Partition {
    fn from(boxes: BoxPartition) -> Self {
        Self::Boxes(boxes)
    }
}

impl From<Mesh> for Partition {
    fn from(mesh: Mesh) -> Self {
        Self::Mesh(mesh)
    }
}

/// The boxes of a mesh: none.
static NO_BOXES: BoxPartition = BoxPartition::EMPTY;

impl Partition {
    /// Number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Boxes(boxes) => boxes.len(),
            Self::Mesh(mesh) => mesh.len(),
        }
    }

    /// True if there is no patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The boxes; of a mesh an empty list of them.
    #[must_use]
    #[inline]
    pub fn boxes(&self) -> &BoxPartition {
        match self {
            Self::Boxes(boxes) => boxes,
            Self::Mesh(_) => &NO_BOXES,
        }
    }

    /// The boxes, to be changed; `None` for a mesh.
    pub fn boxes_mut(&mut self) -> Option<&mut BoxPartition> {
        match self {
            Self::Boxes(boxes) => Some(boxes),
            Self::Mesh(_) => None,
        }
    }

    /// The mesh; `None` for boxes.
    #[must_use]
    #[inline]
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Boxes(_) => None,
            Self::Mesh(mesh) => Some(mesh),
        }
    }

    /// The centre of a box, or the origin of an element.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn center(&self, patch: usize) -> Vec2 {
        match self {
            Self::Boxes(boxes) => boxes.center[patch],
            Self::Mesh(mesh) => mesh.origin[patch],
        }
    }

    /// The half-extents of a box, or of one that holds an element.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn half(&self, patch: usize) -> Vec2 {
        match self {
            Self::Boxes(boxes) => boxes.half[patch],
            Self::Mesh(mesh) => mesh.bounds(patch).size() * 0.5,
        }
    }

    /// A box of each patch: the cell that it comes from, if it comes from none its support, or a
    /// box that holds the element.
    #[must_use]
    pub fn cells(&self) -> Cow<'_, [Rect]> {
        match self {
            Self::Boxes(boxes) if boxes.has_cells() => Cow::Borrowed(&boxes.cell),
            Self::Boxes(boxes) => (0..boxes.len()).map(|patch| boxes.support(patch)).collect(),
            Self::Mesh(mesh) => (0..mesh.len()).map(|patch| mesh.bounds(patch)).collect(),
        }
    }

    /// A box that holds the patch.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn support(&self, patch: usize) -> Rect {
        match self {
            Self::Boxes(boxes) => boxes.support(patch),
            Self::Mesh(mesh) => mesh.bounds(patch),
        }
    }
}

/// A Shepard partition of unity over boxes (`kind = "shepard-box"`): φ_i = W_i / Σ_l W_l with
/// W_i(x) = w(|x − center_i,x| / half_i,x) · w(|y − center_i,y| / half_i,y).
///
/// Structure of arrays; all vectors have one entry per patch. The polynomial frame (`origin`,
/// `scale`) is kept apart from the support (`center`, `half`); the solver makes them equal.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxPartition {
    /// The weight function w of t = |ξ|.
    pub weight: WeightFunction,
    /// Centre of the support box.
    pub center: Vec<Vec2>,
    /// Half-extent of the support box, positive.
    pub half: Vec<Vec2>,
    /// Origin of the polynomial coordinates ξ.
    pub origin: Vec<Vec2>,
    /// Scale of the polynomial coordinates ξ, positive.
    pub scale: Vec<Vec2>,
    /// The leaf cell C_i that generated the patch; the cells tile the domain's box, but
    /// for cells in holes, which may be missing. Empty if the boxes come from no cells.
    pub cell: Vec<Rect>,
    /// Level of the cell in its tree, 0 at the root; empty without cells.
    pub level: Vec<u8>,
    /// Index into `points` of the point that generated the patch, if one did.
    pub point: Vec<Option<u32>>,
    /// The scattered points the cover was made from; empty for uniform covers.
    pub points: Vec<Vec2>,
}

impl BoxPartition {
    /// No patches.
    pub const EMPTY: Self = Self {
        weight: WeightFunction::Linear,
        center: Vec::new(),
        half: Vec::new(),
        origin: Vec::new(),
        scale: Vec::new(),
        cell: Vec::new(),
        level: Vec::new(),
        point: Vec::new(),
        points: Vec::new(),
    };

    /// Number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.center.len()
    }

    /// True if there is no patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.center.is_empty()
    }

    /// True if the patches come from cells, which tile the domain.
    #[must_use]
    pub fn has_cells(&self) -> bool {
        !self.cell.is_empty()
    }

    /// How far apart patches stand: the size of the patch's cell, without cells half that of its
    /// support.
    #[must_use]
    pub fn spacing(&self, patch: usize) -> Vec2 {
        self.cell.get(patch).map_or(self.half[patch], Rect::size)
    }

    /// The support ω_i as a box.
    #[must_use]
    pub fn support(&self, patch: usize) -> Rect {
        Rect::around(self.center[patch], self.half[patch])
    }
}

/// A field's blocks and coefficients in compressed rows.
///
/// Patch `i` owns blocks `patch_blocks[i] .. patch_blocks[i + 1]`. Block `b` is function
/// `block_function[b]` times a polynomial of degree `block_degree[b]` whose coefficients start at
/// `block_offset[b]` in each component's array. Monomials are ordered by total degree, then by
/// descending power of x: 1, ξ, η, ξ², ξη, η², …
#[derive(Clone, Debug, PartialEq)]
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
    /// Polynomial degree of each block, at most [`MAX_DEGREE`].
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

/// Highest polynomial degree of a block.
pub const MAX_DEGREE: usize = 8;

/// Most tables of a dataset. Each formula knows all of them.
pub const MAX_TABLES: usize = 256;

/// Most quantities that a dataset may name. Each is read with all before it, so time grows as
/// the square.
pub const MAX_QUANTITIES: usize = 256;

/// Longest the formulas of these quantities may be together, in bytes.
pub const MAX_QUANTITY_TEXT: usize = 1 << 16;

/// Number of monomials of total degree at most `degree`: (d + 1)(d + 2)/2.
#[must_use]
pub const fn monomials(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

impl FieldData {
    /// A field without patches.
    #[must_use]
    pub fn new(name: &str, components: &[&str]) -> Self {
        Self {
            name: name.into(),
            unit: String::new(),
            components: components.iter().map(|&component| component.into()).collect(),
            patch_blocks: vec![0],
            block_function: Vec::new(),
            block_degree: Vec::new(),
            block_space: Vec::new(),
            block_offset: Vec::new(),
            coefficients: vec![Vec::new(); components.len()],
            exact: Vec::new(),
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

    /// The coefficients of a patch, component by component, where its blocks have theirs behind
    /// one another.
    pub fn coefficients_of(&self, patch: usize) -> impl Iterator<Item = &[f64]> {
        let range = self.range(patch);
        self.coefficients.iter().map(move |component| &component[range.clone()])
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

/// A quantity that a dataset names: the text of
/// a [`QuantityFormula`](crate::quantity::QuantityFormula).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedQuantity {
    /// Its name, a word that no built-in quantity has.
    pub name: String,
    /// The formula.
    pub text: String,
    /// Unit for labels; may be empty.
    pub unit: String,
}

/// Named values, one per patch: order, enrichment, functions cut off, …
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name, e.g. `unknowns`.
    pub name: String,
    /// One value per patch.
    pub values: Vec<f64>,
}

/// One number of the solver's report.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Name, e.g. `residual` or `assembly`.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Unit, e.g. `s`; empty for plain numbers.
    pub unit: String,
}

/// A finding about a solution that does not make it wrong to have, but wrong to trust unread.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// A word for its kind, e.g. `faces-overlap`.
    pub kind: String,
    /// The place, if it is about one.
    pub at: Option<Vec2>,
    /// The number that gave rise to it.
    pub value: f64,
    /// The bound that the number passes.
    pub limit: f64,
    /// The mistake and its remedy, on one line, with the place.
    pub message: String,
}

/// The resultant of what a support exerts on the plate: R_i = ∫ t_i, M = ∫ (x − c) × t over the
/// part of the border where values are given. For elasticity t are the tractions of the components
/// that are held, c the centre of the domain's box; for a potential t is the flow κ ∂u/∂n into
/// the plate.
///
/// The solver's t is the conservative one, (σ n)_i − β (u_i − g_i) with Nitsche's β (Hughes et al.
/// 2000): the reactions and the loads on a plate add up to zero, to rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The place in words, e.g. `bottom`, `top from -0.1 to 0.1`, `hole 0`.
    pub on: String,
    /// Of each component of the first field, whether the support holds it.
    pub held: Vec<bool>,
    /// Force per thickness \[stress·length\], one per component, zero where not held; of a
    /// potential the flow into the plate.
    pub force: Vec<f64>,
    /// Moment per thickness about the centre of the domain's box, counter-clockwise
    /// \[stress·length²\]; zero for a potential.
    pub moment: f64,
}

/// The leading terms of the field at one tip: stress intensity factors, from interaction integrals
/// over several discs, and what stands beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct TipIntensity {
    /// The tip.
    pub tip: TipId,
    /// Value of the preferred ring, K_I \[stress·length^½\].
    pub k1: f64,
    /// Value of the preferred ring, K_II.
    pub k2: f64,
    /// T: of the stress along the crack at the tip the part that is finite there, σ_11 = K terms +
    /// T \[stress\]. None where it is not known, or has no value.
    pub t_stress: Option<f64>,
    /// The J-integral, found without the factors: the energy released per length of growth and
    /// thickness, which is [G](Self::energy_release) \[stress·length\]. None where it is not known.
    pub j: Option<f64>,
    /// Estimated error of (K_I, K_II), the length of the difference \[stress·length^½\]. None where
    /// it is not known.
    pub error: Option<f64>,
    /// All rings. That they agree is a check of the integrals, no estimate of the error of K.
    pub rings: Vec<Ring>,
}

/// Part of |K| that K_I may be negative by where it should be zero.
const NOISE: f64 = 1e-3;

impl TipIntensity {
    /// The factors of a tip of which nothing else is known.
    #[must_use]
    pub fn new(tip: TipId, k1: f64, k2: f64) -> Self {
        Self { tip, k1, k2, t_stress: None, j: None, error: None, rings: Vec::new() }
    }

    /// G = (K_I² + K_II²) / E′, the energy released per length of growth and thickness, in the
    /// material at the tip.
    #[must_use]
    pub fn energy_release(&self, material: &Material) -> f64 {
        (self.k1 * self.k1 + self.k2 * self.k2) / material.effective_young()
    }

    /// The angle from the crack's direction in which the hoop stress beside the tip is largest, and
    /// in which a crack in a brittle material grows (Erdogan & Sih 1963), in [−70.53°, 70.53°] as
    /// radians: 2 arctan(−2 K_II / (K_I + √(K_I² + 8 K_II²))).
    ///
    /// None where K_I is negative, so that the faces overlap, or where there are no factors.
    #[must_use]
    pub fn growth_angle(&self) -> Option<f64> {
        let (k1, k2) = (self.k1, self.k2);
        let opens = k1 >= -NOISE * k1.hypot(k2) && k1.hypot(k2) > 0.0;
        let k1 = k1.max(0.0);
        let root = k1.hypot(8f64.sqrt() * k2);
        opens.then(|| 2.0 * (-2.0 * k2).atan2(k1 + root))
    }

    /// The largest difference of two rings, |ΔK| / |K| with K = (K_I, K_II) and the preferred
    /// ring's in the denominator; NaN where that is zero, or without rings.
    ///
    /// A check that the integrals agree, and no estimate of the error of K: all radii see the same
    /// field, and most of its error enters them alike. Errors a hundred times as large are common.
    #[must_use]
    pub fn spread(&self) -> f64 {
        self.largest_difference() / self.k1.hypot(self.k2)
    }

    /// The same, not in parts of K.
    #[must_use]
    pub fn largest_difference(&self) -> f64 {
        let difference = |a: &Ring, b: &Ring| (a.k1 - b.k1).hypot(a.k2 - b.k2);
        let pairs =
            self.rings.iter().flat_map(|a| self.rings.iter().map(move |b| difference(a, b)));
        pairs.fold(f64::NAN, f64::max)
    }
}

/// One evaluation of the interaction integral: the cut-off is one inside `r1` and zero outside
/// `r2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner radius (0 when the cut-off falls from the tip on).
    pub r1: f64,
    /// Outer radius.
    pub r2: f64,
    /// K_I.
    pub k1: f64,
    /// K_II.
    pub k2: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::End;

    fn factors(k1: f64, k2: f64) -> TipIntensity {
        TipIntensity::new(TipId { crack: 0, end: End::Last }, k1, k2)
    }

    /// The angles of Erdogan and Sih's criterion (1963), to 1e-7 degrees.
    #[test]
    fn angles_of_growth() {
        let angle = |k1, k2| factors(k1, k2).growth_angle().map(f64::to_degrees);
        for (k1, k2, degrees) in [
            (1.0, 0.0, 0.0),
            (1.0, 0.1, -11.2028777),
            (2.0, 1.0, -40.2078187),
            (3.0, 3.0, -53.1301024),
            (0.0, 1.0, -70.5287794),
        ] {
            for scale in [1e-200, 1.0, 1e150] {
                let found = angle(scale * k1, scale * k2).expect("an open crack");
                assert!((found - degrees).abs() < 1e-7, "{k1} {k2}: {found}");
                assert!(
                    (angle(scale * k1, -scale * k2).expect("its mirror image") + found).abs()
                        < 1e-12
                );
            }
        }
        // a K_I that is rounding of nothing is none; faces that overlap, and no field, have
        // no angle
        assert!((angle(-1e-9, 1.0).expect("shear") + 70.5287794).abs() < 1e-7);
        for (k1, k2) in [(-1.0, 0.0), (-0.1, 1.0), (0.0, 0.0), (f64::NAN, f64::NAN)] {
            assert_eq!(angle(k1, k2), None, "{k1} {k2}");
        }
    }

    /// The hoop stress √(2πr) σ_θθ = cos(θ/2) (K_I cos²(θ/2) − 3/2 K_II sin θ) is largest there.
    #[test]
    fn the_hoop_stress_is_largest_there() {
        for k in 0..40 {
            let phase = std::f64::consts::PI * (f64::from(k) / 39.0 - 0.5);
            let (k1, k2) = (phase.cos(), phase.sin());
            let hoop =
                |t: f64| (0.5 * t).cos() * (k1 * (0.5 * t).cos().powi(2) - 1.5 * k2 * t.sin());
            let found = hoop(factors(k1, k2).growth_angle().expect("an open crack"));
            let most = (-1000..=1000).map(|i| hoop(3.1e-3 * f64::from(i))).fold(0.0, f64::max);
            assert!(found >= most - 1e-12 && most > found - 1e-5, "{phase}: {found} {most}");
        }
    }

    #[test]
    fn energy_released() {
        let material = Material { young: 2.0, poisson: 0.25, state: StressState::PlaneStrain };
        assert!((factors(3.0, 4.0).energy_release(&material) - 25.0 * 0.9375 / 2.0).abs() < 1e-14);
    }

    #[test]
    fn the_spread_is_that_of_both_factors() {
        let ring = |k1, k2| Ring { r1: 0.0, r2: 1.0, k1, k2 };
        let rings = vec![ring(3.0, 4.03), ring(3.04, 4.0), ring(3.0, 4.0)];
        let intensity = TipIntensity { rings, ..factors(3.0, 4.0) };
        assert!((intensity.spread() - 0.01).abs() < 1e-15);
        assert!(factors(3.0, 4.0).spread().is_nan());
    }
}
