//! Evaluation of a field: v = Σ_i φ_i v_i with gradient and Hessian.
//!
//! A [`Field`] is a dataset's field at one step, compiled. [`Field::at`] looks at it from an anchor;
//! points are `anchor + offset`. The weights, weight gradients and weighted local fields of the
//! covering patches are summed and divided once (Üffinger et al. 2011, equations (4), (9), (10)):
//!
//! ```text
//! S = Σ W_i     U = Σ W_i v_i     u = U / S     ∇u = (∇U − u ∇S) / S
//! ```

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::box_tree::BoxTree;
use crate::crack::{SegmentId, Side};
use crate::dataset::{Dataset, Equation, FieldData, NamedQuantity, Step};
use crate::domain::{Domain, LocalDomain};
use crate::formula::{Formula, FormulaError, Scope, ScopeError, Table};
use crate::function::{FunctionError, FunctionTable, GROUP, LocalFunctions, Slot};
use crate::jet::Jet;
use crate::polynomial::polynomial;
use crate::quantity::Vocabulary;
use crate::real::{Job, Real, Scalar};
use crate::vec2::Vec2;

/// A field of a dataset at one step, ready to be evaluated.
#[derive(Debug)]
pub struct Field<'d> {
    /// The domain; outside nothing is defined.
    pub domain: &'d Domain,
    /// The equation the field solves.
    pub equation: &'d Equation,
    /// Quantities the dataset names.
    pub quantities: &'d [NamedQuantity],
    /// Tables that formulas may read.
    pub tables: &'d [Arc<Table>],
    /// The step.
    pub step: &'d Step,
    /// Blocks and coefficients.
    pub data: &'d FieldData,
    /// The compiled functions of the step.
    pub functions: FunctionTable,
    /// Finds the patches that cover a point or meet a box.
    pub tree: BoxTree,
    exact: Vec<Formula>,
}

/// The field asked for is not there or cannot be evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// No such step.
    #[error("there is no step {step}; the dataset has {count} (numbered from 0)")]
    Step {
        /// The step asked for.
        step: usize,
        /// Number of steps.
        count: usize,
    },
    /// The step has no field at all.
    #[error("step {step} has no field: there is nothing to evaluate")]
    NoField {
        /// The step asked for.
        step: usize,
    },
    /// No such field.
    #[error("there is no field `{name}`; the step has {known}")]
    Name {
        /// The field asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// A function of the step is wrong.
    #[error(transparent)]
    Function(#[from] FunctionError),
    /// A table has a name that formulas cannot use.
    #[error("the tables of the dataset: {0}")]
    Tables(#[from] ScopeError),
    /// A formula of the exact solution is wrong.
    #[error("exact solution of field `{name}`: {source}")]
    Exact {
        /// The field.
        name: String,
        /// What is wrong.
        source: Box<FormulaError>,
    },
}

impl<'d> Field<'d> {
    /// Compiles the first field of a step.
    ///
    /// # Errors
    /// See [`FieldError`].
    pub fn new(dataset: &'d Dataset, step: usize) -> Result<Self, FieldError> {
        let first = dataset.steps.get(step).map(|s| s.fields.first());
        let Some(name) = first.map(|field| field.map(|f| f.name.as_str())) else {
            return Self::named(dataset, step, "");
        };
        Self::named(dataset, step, name.ok_or(FieldError::NoField { step })?)
    }

    /// Compiles the field called `name`.
    ///
    /// # Errors
    /// See [`FieldError`].
    pub fn named(dataset: &'d Dataset, step: usize, name: &str) -> Result<Self, FieldError> {
        let count = dataset.steps.len();
        let step = dataset.steps.get(step).ok_or(FieldError::Step { step, count })?;
        let data = step.fields.iter().find(|f| f.name == name).ok_or_else(|| FieldError::Name {
            name: name.into(),
            known: step.fields.iter().map(|f| f.name.as_str()).collect::<Vec<_>>().join(", "),
        })?;
        let supports: Vec<_> =
            (0..step.partition.len()).map(|i| step.partition.support(i)).collect();
        Ok(Self {
            domain: &dataset.domain,
            equation: &dataset.equation,
            quantities: &dataset.quantities,
            tables: &dataset.tables,
            step,
            data,
            functions: FunctionTable::new(&step.functions, step.cracks.len(), &dataset.tables)?,
            tree: BoxTree::new(&supports),
            exact: exact(data, &dataset.tables)?,
        })
    }

    /// Number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.data.coefficients.len()
    }

    /// What formulas of quantities may name.
    #[must_use]
    pub fn vocabulary(&self) -> Vocabulary<'d> {
        Vocabulary {
            equation: self.equation,
            components: &self.data.components,
            tables: self.tables,
            named: self.quantities,
        }
    }

    /// True if the exact solution is known.
    #[must_use]
    pub fn has_exact(&self) -> bool {
        !self.exact.is_empty()
    }

    /// The exact value of a component at a point; NaN if it is not known.
    #[must_use]
    pub fn exact(&self, component: usize, p: Vec2) -> f64 {
        self.exact.get(component).map_or(f64::NAN, |formula| formula.evaluate(&[p.x, p.y]))
    }

    /// The field as seen from an anchor.
    #[must_use]
    pub fn at(&self, anchor: Vec2) -> LocalField<'_> {
        self.seen(anchor, self.functions.at(&self.step.cracks, anchor))
    }

    /// The field as seen from an anchor, for points on a segment of a crack: there an evaluation takes
    /// the side of this crack that it is told, wherever rounding has put the points.
    ///
    /// # Panics
    /// If there is no such segment.
    #[must_use]
    pub fn on(&self, segment: SegmentId, anchor: Vec2) -> LocalField<'_> {
        self.seen(anchor, self.functions.on(&self.step.cracks, segment, anchor))
    }

    fn seen<'f>(&'f self, anchor: Vec2, functions: LocalFunctions<'f>) -> LocalField<'f> {
        let domain = self.domain.at(anchor);
        LocalField { field: self, anchor, domain, functions, patches: Vec::new() }
    }
}

fn exact(data: &FieldData, tables: &[Arc<Table>]) -> Result<Vec<Formula>, FieldError> {
    let scope = Scope::cartesian().with_tables(tables)?;
    let formulas: Result<_, _> = data.exact.iter().map(|t| Formula::parse(t, &scope)).collect();
    formulas.map_err(|error| FieldError::Exact { name: data.name.clone(), source: Box::new(error) })
}

/// A field seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalField<'f> {
    /// The field.
    pub field: &'f Field<'f>,
    /// The anchor.
    pub anchor: Vec2,
    domain: LocalDomain,
    functions: LocalFunctions<'f>,
    patches: Vec<u32>,
}

/// The partition of unity at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covering {
    /// S = Σ W_i with derivatives.
    pub weight_sum: Jet<f64>,
    /// Number of patches that cover the point.
    pub overlap: usize,
}

impl<'f> LocalField<'f> {
    /// The functions as seen from the anchor.
    #[must_use]
    pub fn functions(&self) -> &LocalFunctions<'f> {
        &self.functions
    }

    /// True if `anchor + offset` lies in the closed domain; exact also where the sum would round.
    #[must_use]
    pub fn contains(&self, offset: Vec2) -> bool {
        self.domain.contains(offset)
    }

    /// Evaluates all components at `anchor + offset` with `D` derivatives (0, 1 or 2).
    ///
    /// On a crack the field of the given side is taken. Returns false, and leaves `out` alone,
    /// outside the domain. Cost: O(log N) to find the patches, then a few hundred operations a patch.
    ///
    /// # Panics
    /// If `out` is shorter than the number of components.
    pub fn evaluate<const D: usize>(
        &mut self,
        offset: Vec2,
        side: Side,
        out: &mut [Jet<f64>],
    ) -> bool {
        if !self.contains(offset) {
            return false;
        }
        let patches = self.covering_any(&[offset]);
        self.over_patches::<f64, D>([offset.x, offset.y], side, &patches, out);
        self.patches = patches;
        true
    }

    /// The partition of unity at `anchor + offset`; `None` outside the domain.
    pub fn covering<const D: usize>(&mut self, offset: Vec2) -> Option<Covering> {
        if !self.contains(offset) {
            return None;
        }
        let patches = self.covering_any(&[offset]);
        let weight = |&p: &u32| self.partition_weight::<f64, D>(p as usize, [offset.x, offset.y]);
        let zero = Jet::constant(0.0);
        let weight_sum = patches.iter().map(weight).fold(zero, Jet::plus::<D>);
        let overlap = patches.len();
        self.patches = patches;
        Some(Covering { weight_sum, overlap })
    }

    /// Evaluates at many points, vectorised over lanes: `out` holds the components of the first
    /// point, then those of the second, and so on; points outside the domain give NaN.
    ///
    /// Points that follow each other should be near each other: lanes share the patches of all.
    ///
    /// # Panics
    /// If `out` is shorter than points × components.
    pub fn evaluate_into<const D: usize>(
        &mut self,
        offsets: &[Vec2],
        side: Side,
        out: &mut [Jet<f64>],
    ) {
        f64::dispatch(Many::<D> { local: self, offsets, side, out });
    }

    /// Evaluates at many points over a given list of patches, which must hold all that cover one of
    /// them: like [`evaluate_into`](Self::evaluate_into), without looking for patches and borders.
    ///
    /// # Panics
    /// If `out` is shorter than points × components.
    pub fn evaluate_over<const D: usize>(
        &self,
        offsets: &[Vec2],
        side: Side,
        patches: &[u32],
        out: &mut [Jet<f64>],
    ) {
        f64::dispatch(Over::<D> { local: self, offsets, side, patches, out });
    }

    /// Evaluates over a given list of patches, which must hold all that cover the point.
    #[inline(always)]
    pub fn over_patches<R: Real, const D: usize>(
        &self,
        offset: [R; 2],
        side: Side,
        patches: &[u32],
        out: &mut [Jet<R>],
    ) {
        let zero = Jet::constant(offset[0].lit(0.0));
        let mut functions = FunctionJets::new(&self.functions, offset, side);
        let components = self.field.components();
        out[..components].fill(zero);
        let mut weight_sum = zero;
        for &patch in patches {
            let patch = patch as usize;
            let weight = self.weight::<R, D>(patch, offset, patches.len() == 1);
            weight_sum = weight_sum.plus::<D>(weight);
            for (component, sum) in out[..components].iter_mut().enumerate() {
                let v = self.local_field::<R, D>(patch, component, offset, &mut functions);
                *sum = sum.plus::<D>(self.shared::<R, D>(patch, offset, weight.times::<D>(v)));
            }
        }
        for sum in &mut out[..components] {
            *sum = sum.over::<D>(weight_sum);
        }
    }

    /// The part W_i v_i of a sum, zero on the lanes that the patch does not cover: there v_i need not
    /// have a value.
    #[inline(always)]
    fn shared<R: Real, const D: usize>(
        &self,
        patch: usize,
        offset: [R; 2],
        part: Jet<R>,
    ) -> Jet<R> {
        if R::LANES == 1 {
            return part;
        }
        let support = self.field.step.partition.support(patch);
        let (lo, hi) = (support.min - self.anchor, support.max - self.anchor);
        let [x, y] = offset;
        let part = part.only::<D>(x.ge(x.lit(lo.x))).only::<D>(x.lit(hi.x).gt(x));
        part.only::<D>(y.ge(y.lit(lo.y))).only::<D>(y.lit(hi.y).gt(y))
    }

    /// W_i; constant 1 where the patch is alone, since φ_i = 1 there whatever W_i is.
    #[inline(always)]
    fn weight<R: Real, const D: usize>(&self, patch: usize, offset: [R; 2], alone: bool) -> Jet<R> {
        if alone {
            return Jet::constant(offset[0].lit(1.0));
        }
        self.partition_weight::<R, D>(patch, offset)
    }

    /// W_i at `anchor + offset` with derivatives.
    #[inline(always)]
    pub fn partition_weight<R: Real, const D: usize>(
        &self,
        patch: usize,
        offset: [R; 2],
    ) -> Jet<R> {
        let partition = &self.field.step.partition;
        let half = partition.half[patch];
        let inverse = [1.0 / half.x, 1.0 / half.y];
        let xi = self.scaled(offset, partition.center[patch], inverse);
        partition.weight.tensor::<R, D>(xi, inverse)
    }

    /// The partition function φ_i = W_i / S of a patch, with derivatives: zero where the patch does
    /// not cover the point, `None` outside the domain.
    pub fn partition_function<const D: usize>(
        &mut self,
        patch: usize,
        offset: Vec2,
    ) -> Option<Jet<f64>> {
        let Covering { weight_sum, .. } = self.covering::<D>(offset)?;
        let weight = self.partition_weight::<f64, D>(patch, [offset.x, offset.y]);
        Some(weight.over::<D>(weight_sum))
    }

    /// The local field v_i of one patch and component.
    #[inline(always)]
    fn local_field<R: Real, const D: usize>(
        &self,
        patch: usize,
        component: usize,
        offset: [R; 2],
        functions: &mut FunctionJets<'_, 'f, R>,
    ) -> Jet<R> {
        let (partition, data) = (&self.field.step.partition, self.field.data);
        let scale = partition.scale[patch];
        let inverse = [1.0 / scale.x, 1.0 / scale.y];
        let xi = self.scaled(offset, partition.origin[patch], inverse);
        let mut v = Jet::constant(offset[0].lit(0.0));
        for block in data.blocks(patch) {
            let coefficients = data.block_coefficients(block, component);
            let degree = data.block_degree[block] as usize;
            let p = polynomial::<R, D>(coefficients, degree, xi);
            let p = stretched::<R, D>(p, inverse);
            v = v.plus::<D>(match self.field.functions.of(data.block_function[block]) {
                Slot::One => p,
                slot => p.times::<D>(functions.jet::<D>(slot)),
            });
        }
        v
    }

    /// (anchor + offset − origin) · inverse; the difference of anchor and origin is formed in f64.
    #[inline(always)]
    fn scaled<R: Real>(&self, offset: [R; 2], origin: Vec2, inverse: [f64; 2]) -> [R; 2] {
        let d = self.anchor - origin;
        let one = offset[0].lit(1.0);
        [
            (offset[0] + one.lit(d.x)) * one.lit(inverse[0]),
            (offset[1] + one.lit(d.y)) * one.lit(inverse[1]),
        ]
    }
}

/// Chain rule for ξ = (x − origin) · inverse.
#[inline(always)]
fn stretched<R: Real, const D: usize>(p: Jet<R>, inverse: [f64; 2]) -> Jet<R> {
    let (ix, iy) = (p.v.lit(inverse[0]), p.v.lit(inverse[1]));
    let mut out = p;
    if D >= 1 {
        (out.x, out.y) = (p.x * ix, p.y * iy);
    }
    if D >= 2 {
        (out.xx, out.xy, out.yy) = (p.xx * ix * ix, p.xy * ix * iy, p.yy * iy * iy);
    }
    out
}

/// Groups that have a place of their own, more than meet in the patches of one point in practice.
const PLACES: usize = 6;

/// The functions at one point: a group is evaluated when it is first asked for, and once.
struct FunctionJets<'a, 'f, R> {
    functions: &'a LocalFunctions<'f>,
    offset: [R; 2],
    side: Side,
    groups: [u32; PLACES],
    jets: [[Jet<R>; GROUP]; PLACES],
    next: usize,
    /// Where there are more, those that have lost their places.
    others: BTreeMap<u32, [Jet<R>; GROUP]>,
}

impl<'a, 'f, R: Real> FunctionJets<'a, 'f, R> {
    #[inline(always)]
    fn new(functions: &'a LocalFunctions<'f>, offset: [R; 2], side: Side) -> Self {
        let zero = Jet::constant(offset[0].lit(0.0));
        let (groups, jets) = ([u32::MAX; PLACES], [[zero; GROUP]; PLACES]);
        Self { functions, offset, side, groups, jets, next: 0, others: BTreeMap::new() }
    }

    #[inline(always)]
    fn jet<const D: usize>(&mut self, slot: Slot) -> Jet<R> {
        let Slot::Jet { group, entry } = slot else {
            return Jet::constant(self.offset[0].lit(1.0));
        };
        let mut place = 0;
        while place < PLACES && self.groups[place] != group {
            place += 1;
        }
        if place == PLACES {
            place = self.next;
            self.next = (self.next + 1) % PLACES;
            if self.groups[place] != u32::MAX {
                self.others.insert(self.groups[place], self.jets[place]);
            }
            self.groups[place] = group;
            let jets = &mut self.jets[place];
            match self.others.get(&group) {
                Some(known) => *jets = *known,
                None => {
                    self.functions.evaluate::<R, D>(group as usize, self.offset, self.side, jets);
                }
            }
        }
        self.jets[place][entry as usize]
    }
}

/// [`LocalField::evaluate_into`] on lanes.
struct Many<'a, 'f, const D: usize> {
    local: &'a mut LocalField<'f>,
    offsets: &'a [Vec2],
    side: Side,
    out: &'a mut [Jet<f64>],
}

impl<const D: usize> Job<f64> for Many<'_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        let components = self.local.field.components();
        let mut lanes = vec![Jet::constant(zero); components];
        let chunks = self.offsets.chunks(R::LANES).zip(self.out.chunks_mut(R::LANES * components));
        for (points, out) in chunks {
            let patches = self.local.covering_any(points);
            self.local.at_once::<R, D>(points, self.side, &patches, &mut lanes, out);
            for (&point, out) in points.iter().zip(out.chunks_mut(components)) {
                if !self.local.contains(point) {
                    out.fill(NOWHERE);
                }
            }
            self.local.patches = patches;
        }
    }
}

/// [`LocalField::evaluate_over`] on lanes.
struct Over<'a, 'f, const D: usize> {
    local: &'a LocalField<'f>,
    offsets: &'a [Vec2],
    side: Side,
    patches: &'a [u32],
    out: &'a mut [Jet<f64>],
}

impl<const D: usize> Job<f64> for Over<'_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        let components = self.local.field.components();
        let mut lanes = vec![Jet::constant(zero); components];
        let chunks = self.offsets.chunks(R::LANES).zip(self.out.chunks_mut(R::LANES * components));
        for (points, out) in chunks {
            self.local.at_once::<R, D>(points, self.side, self.patches, &mut lanes, out);
        }
    }
}

/// The value outside the domain.
const NOWHERE: Jet<f64> =
    Jet { v: f64::NAN, x: f64::NAN, y: f64::NAN, xx: f64::NAN, xy: f64::NAN, yy: f64::NAN };

/// Widest vector of f64.
const WIDEST: usize = <f64 as Scalar>::VECTOR;

/// The coordinates of up to [`WIDEST`] points, the last one repeated.
fn transposed(points: &[Vec2]) -> [[f64; WIDEST]; 2] {
    let at = |k: usize| points[k.min(points.len() - 1)];
    [std::array::from_fn(|k| at(k).x), std::array::from_fn(|k| at(k).y)]
}

/// Calls `f` with each lane's jet.
fn scatter<R: Real<Scalar = f64>>(jet: &Jet<R>, mut f: impl FnMut(usize, Jet<f64>)) {
    let mut lanes = [[0.0; WIDEST]; 6];
    for (lane, value) in lanes.iter_mut().zip([jet.v, jet.x, jet.y, jet.xx, jet.xy, jet.yy]) {
        value.store(lane);
    }
    for k in 0..R::LANES {
        let [v, x, y, xx, xy, yy] = lanes.map(|lane| lane[k]);
        f(k, Jet { v, x, y, xx, xy, yy });
    }
}

impl LocalField<'_> {
    /// Evaluates at no more points than there are lanes; `lanes` holds one vector a component.
    #[inline(always)]
    fn at_once<R: Real<Scalar = f64>, const D: usize>(
        &self,
        points: &[Vec2],
        side: Side,
        patches: &[u32],
        lanes: &mut [Jet<R>],
        out: &mut [Jet<f64>],
    ) {
        let components = lanes.len();
        let [xs, ys] = transposed(points);
        let offset = [lanes[0].v.load(&xs), lanes[0].v.load(&ys)];
        self.over_patches::<R, D>(offset, side, patches, lanes);
        for (component, jet) in lanes.iter().enumerate() {
            scatter(jet, |k, jet| {
                if k < points.len() {
                    out[k * components + component] = jet;
                }
            });
        }
    }

    /// The patches that cover at least one of the points, ascending.
    fn covering_any(&mut self, offsets: &[Vec2]) -> Vec<u32> {
        let mut patches = std::mem::take(&mut self.patches);
        patches.clear();
        for &offset in offsets {
            self.field.tree.query_point(self.anchor + offset, &mut patches);
        }
        patches.sort_unstable();
        patches.dedup();
        patches
    }
}
