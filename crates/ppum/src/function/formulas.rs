//! Formulas in one frame, evaluated together.

use std::cell::RefCell;
use std::sync::Arc;

use super::anchored::AnchoredCracks;
use super::kinds::Frame;
use crate::crack::{Crack, LocalCrack, LocalTip, Side, TipPoint};
use crate::jet::Jet;
use crate::vec2::{Vec2, vec2};
use ppum_formula::real::{Lanes, Real};
use ppum_formula::{Block, BlockScratch, DerivativeError, Formula, FormulaJets};

/// Largest number of functions in a group.
pub const GROUP: usize = 4;

/// Up to [`GROUP`] formulas of one scope in one frame.
#[derive(Clone, Debug)]
pub(super) struct FormulaGroup {
    compiled: Arc<CompiledGroup>,
    frame: Frame,
}

#[derive(Debug)]
struct CompiledGroup {
    formulas: Vec<Formula>,
    /// With 0, 1 and 2 derivatives.
    jets: [FormulaJets; 3],
    /// Whether each input is used: x, y, r, θ, cos(θ/2), sin(θ/2), the sides of the cracks.
    uses: Vec<bool>,
}

/// Index of θ among the inputs; it costs an arc tangent.
const THETA: usize = 3;

/// Number of inputs before the sides of cracks.
const POLAR: usize = 6;

impl FormulaGroup {
    /// Compiles formulas of one scope.
    pub(super) fn new(formulas: Vec<Formula>, frame: Frame) -> Result<Self, DerivativeError> {
        let all: Vec<_> = formulas.iter().collect();
        let [v, d, dd] = [0, 1, 2].map(|order| FormulaJets::new(&all, order));
        let jets = [v?, d?, dd?];
        // Derivatives use inputs that values do not.
        let mut uses = vec![false; formulas[0].scope().inputs().count()];
        jets[2].used().for_each(|input| uses[input] = true);
        let compiled = CompiledGroup { uses, jets, formulas };
        Ok(Self { compiled: Arc::new(compiled), frame })
    }

    /// Returns the functions in another frame, if these are the same formulas.
    pub(super) fn with_frame(&self, formulas: &[Formula], frame: Frame) -> Option<Self> {
        let compiled = Arc::clone(&self.compiled);
        (compiled.formulas == formulas).then_some(Self { compiled, frame })
    }

    /// The level fields that are x and y of the frame.
    pub(super) fn levels(&self) -> Option<[u32; 2]> {
        match self.frame {
            Frame::Levels(fields) => Some(fields),
            _ => None,
        }
    }

    /// Number of functions.
    pub(super) fn len(&self) -> usize {
        self.compiled.formulas.len()
    }

    /// Operations of an evaluation with the first derivatives, inputs and the segments of cracks
    /// whose sides are needed counted too.
    pub(super) fn cost(&self, cracks: &[Crack]) -> usize {
        let CompiledGroup { jets, uses, .. } = &*self.compiled;
        let sides = cracks.iter().zip(&uses[POLAR..]).filter(|(_, used)| **used);
        let frame = match self.frame {
            Frame::Tip(tip) => cracks[tip.crack as usize].points.len(),
            _ => 0,
        };
        let segments: usize = sides.map(|(crack, _)| crack.points.len()).sum();
        jets[1].n_operations() + uses.len() + segments + frame
    }

    /// Number of operations with two derivatives.
    pub(super) fn operations(&self) -> usize {
        self.compiled.jets[2].n_operations()
    }

    /// The functions as seen from the anchor of the cracks.
    pub(super) fn anchored<'t>(&'t self, cracks: &AnchoredCracks<'t>) -> LocalFormulas<'t> {
        let used = |(crack, &used): (u32, &bool)| used.then(|| cracks.crack(crack));
        LocalFormulas {
            compiled: &self.compiled,
            frame: LocalFrame::new(cracks, self.frame),
            cracks: (0..).zip(&self.compiled.uses[POLAR..]).map(used).collect(),
        }
    }
}

/// A formula's frame seen from an anchor.
#[derive(Clone, Debug)]
enum LocalFrame<'t> {
    Fixed {
        from_origin: Vec2,
        axis: Vec2,
    },
    Tip(LocalTip<'t>),
    /// The point is known on a patch alone.
    Levels,
}

impl<'t> LocalFrame<'t> {
    fn new(cracks: &AnchoredCracks<'t>, frame: Frame) -> Self {
        let anchor = cracks.anchor;
        match frame {
            Frame::World => Self::Fixed { from_origin: anchor, axis: vec2(1.0, 0.0) },
            Frame::Fixed { origin, angle } => {
                Self::Fixed { from_origin: anchor - origin, axis: vec2(angle.cos(), angle.sin()) }
            }
            Frame::Tip(tip) => Self::Tip(cracks.tip(tip)),
            Frame::Levels(_) => Self::Levels,
        }
    }

    /// The point `anchor + offset` in the frame. In a fixed frame the negative x axis belongs to
    /// the upper side, θ = +π.
    #[inline(always)]
    fn point<R: Real>(&self, offset: [R; 2], side: Side) -> TipPoint<R> {
        match self {
            Self::Fixed { from_origin, axis } => {
                let one = offset[0].broadcast(1.0);
                let (c, s) = (one.broadcast(axis.x), one.broadcast(axis.y));
                let dx = offset[0] + one.broadcast(from_origin.x);
                let dy = offset[1] + one.broadcast(from_origin.y);
                let (x, y) = (c.mul_add(dx, s * dy), c * dy - s * dx);
                TipPoint { x, y, sign: R::sign(y.ge(one.broadcast(0.0)), one), branch: one }
            }
            Self::Tip(tip) => tip.point(offset, side),
            Self::Levels => {
                let [nan, one] = [f64::NAN, 1.0].map(|v| offset[0].broadcast(v));
                TipPoint { x: nan, y: nan, sign: one, branch: one }
            }
        }
    }

    fn axis(&self) -> Vec2 {
        match self {
            Self::Fixed { axis, .. } => *axis,
            Self::Tip(tip) => tip.axis,
            Self::Levels => vec2(1.0, 0.0),
        }
    }
}

/// Formulas seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct LocalFormulas<'t> {
    compiled: &'t CompiledGroup,
    frame: LocalFrame<'t>,
    /// The cracks whose sides are used.
    cracks: Vec<Option<LocalCrack<'t>>>,
}

thread_local! {
    /// Memory for an evaluation at a point: allocating it each time would cost as much as
    /// the formulas.
    static WORKSPACE: RefCell<Workspace> = RefCell::default();
}

/// Numbers of one evaluation, in rows of one per lane, and of one lane of it.
#[derive(Clone, Debug, Default)]
struct Workspace {
    rows: Vec<Lanes>,
    inputs: Vec<f64>,
    scratch: Vec<f64>,
    numbers: Vec<f64>,
    results: Vec<Lanes>,
}

impl Workspace {
    /// The results of the rows, one lane after the other.
    fn run(&mut self, jets: &FormulaJets, lanes: usize) {
        let Self { rows, inputs, scratch, numbers, results } = self;
        inputs.resize(rows.len(), 0.0);
        results.resize(jets.n_outputs(), Lanes::default());
        numbers.resize(jets.n_outputs(), 0.0);
        for lane in 0..lanes {
            inputs.iter_mut().zip(&*rows).for_each(|(input, row)| *input = row[lane]);
            jets.evaluate(inputs, scratch, numbers);
            results.iter_mut().zip(&*numbers).for_each(|(row, &number)| row[lane] = number);
        }
    }
}

impl LocalFormulas<'_> {
    fn len(&self) -> usize {
        self.compiled.formulas.len()
    }

    /// The functions at one point or at one vector of points, one lane after the other.
    #[inline(always)]
    pub(super) fn evaluate<R: Real, const D: usize>(
        &self,
        offset: [R; 2],
        side: Side,
        out: &mut [Jet<R>],
    ) {
        let point = self.frame.point(offset, side);
        self.evaluate_at::<R, D>(&point, offset, side, out);
    }

    /// The functions at a point that is known in their frame too. In kernels all of it is inlined,
    /// so the memory is taken out, not lent to a closure.
    #[inline(always)]
    pub(super) fn evaluate_at<R: Real, const D: usize>(
        &self,
        point: &TipPoint<R>,
        offset: [R; 2],
        side: Side,
        out: &mut [Jet<R>],
    ) {
        let polar = self.polar(point);
        let mut workspace = WORKSPACE.take();
        self.evaluate_in::<R, D>(&mut workspace, &polar, (offset, side), out);
        WORKSPACE.set(workspace);
    }

    #[inline(always)]
    fn evaluate_in<R: Real, const D: usize>(
        &self,
        workspace: &mut Workspace,
        polar: &[R; POLAR],
        (offset, side): ([R; 2], Side),
        out: &mut [Jet<R>],
    ) {
        workspace.rows.resize(self.compiled.uses.len(), Lanes::default());
        let mut index = 0;
        while index < workspace.rows.len() {
            workspace.rows[index] = self.input(index, polar, offset, side).lanes();
            index += 1;
        }
        workspace.run(&self.compiled.jets[D], R::LANES);
        let (like, axis) = (offset[0], self.frame.axis());
        let mut entry = 0;
        while entry < self.len().min(out.len()) {
            let (mut values, mut j) = ([like.broadcast(0.0); 6], 0);
            while j < SIZE[D] {
                let row = &workspace.results[entry * SIZE[D] + j];
                values[j] = like.with_lanes(|lane| row[lane]);
                j += 1;
            }
            out[entry] = jet(values).turned::<D>(like.broadcast(axis.x), like.broadcast(axis.y));
            entry += 1;
        }
    }

    /// The functions at many vectors of points, block by block.
    #[inline(always)]
    pub(super) fn fill<R: Real, const D: usize>(
        &self,
        offsets: &[[R; 2]],
        side: Side,
        scratch: &mut BlockScratch<R::Scalar>,
        out: &mut [[Jet<R>; GROUP]],
    ) {
        let mut block = self.compiled.jets[D].block(scratch);
        let per_block = Block::<R::Scalar>::POINTS / R::LANES;
        let (axis, mut first) = (self.frame.axis(), 0);
        while first < offsets.len() {
            let n = per_block.min(offsets.len() - first);
            let mut k = 0;
            while k < n {
                let offset = offsets[first + k];
                let polar = self.polar(&self.frame.point(offset, side));
                let mut index = 0;
                while index < self.compiled.uses.len() {
                    if self.compiled.uses[index] {
                        let value = self.input(index, &polar, offset, side);
                        value.store(&mut block.input(index)[k * R::LANES..]);
                    }
                    index += 1;
                }
                k += 1;
            }
            block.run();
            k = 0;
            while k < n {
                let like = offsets[first + k][0];
                let (c, s) = (like.broadcast(axis.x), like.broadcast(axis.y));
                let mut entry = 0;
                while entry < self.len() {
                    let (mut values, mut j) = ([like.broadcast(0.0); 6], 0);
                    while j < SIZE[D] {
                        let row = block.output(entry * SIZE[D] + j);
                        values[j] = like.load(&row[k * R::LANES..]);
                        j += 1;
                    }
                    out[first + k][entry] = jet(values).turned::<D>(c, s);
                    entry += 1;
                }
                k += 1;
            }
            first += n;
        }
    }

    /// The inputs before the sides of cracks, at a point.
    #[inline(always)]
    fn polar<R: Real>(&self, p: &TipPoint<R>) -> [R; POLAR] {
        let r = p.radius();
        let half @ [cos_half, sin_half] = p.half_angle(r);
        let theta = if self.compiled.uses[THETA] { TipPoint::theta(half) } else { r };
        [p.x, p.y, r, theta, cos_half, sin_half]
    }

    /// The input of an index; that of a side of a crack that is not used has no meaning.
    #[inline(always)]
    fn input<R: Real>(&self, index: usize, polar: &[R; POLAR], offset: [R; 2], side: Side) -> R {
        if index < POLAR {
            return polar[index];
        }
        match &self.cracks[index - POLAR] {
            Some(crack) => crack.side(offset, side),
            None => offset[0],
        }
    }
}

/// Numbers of a jet of order D.
const SIZE: [usize; 3] = [1, 3, 6];

/// The jet of a sequence of values and derivatives.
#[inline(always)]
fn jet<R: Real>([v, x, y, xx, xy, yy]: [R; 6]) -> Jet<R> {
    Jet { v, x, y, xx, xy, yy }
}
