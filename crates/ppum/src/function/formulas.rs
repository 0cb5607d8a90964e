//! Formulas in one frame, evaluated together.

use std::sync::Arc;

use super::Frame;
use crate::crack::{Crack, LocalCrack, LocalTip, Side, TipPoint};
use crate::formula::{DerivativeError, Formula, FormulaJets};
use crate::jet::Jet;
use crate::real::{Real, Scalar};
use crate::vec2::{Vec2, vec2};

use super::table::GROUP;

/// Up to [`GROUP`] formulas of one scope in one frame.
#[derive(Clone, Debug)]
pub(super) struct Formulas {
    compiled: Arc<Compiled>,
    frame: Frame,
}

#[derive(Debug)]
struct Compiled {
    formulas: Vec<Formula>,
    /// With 0, 1 and 2 derivatives.
    jets: [FormulaJets; 3],
    /// Whether θ itself is used, which costs an arc tangent.
    theta: bool,
    /// Whether the side of each crack is used.
    sides: Vec<bool>,
}

impl Formulas {
    /// Compiles formulas of one scope.
    pub(super) fn new(
        formulas: Vec<Formula>,
        frame: Frame,
        cracks: usize,
    ) -> Result<Self, DerivativeError> {
        let all: Vec<_> = formulas.iter().collect();
        let uses = |name: &str| formulas.iter().any(|formula| formula.uses(name));
        let compiled = Compiled {
            jets: [
                FormulaJets::new(&all, 0)?,
                FormulaJets::new(&all, 1)?,
                FormulaJets::new(&all, 2)?,
            ],
            theta: uses("theta"),
            sides: (0..cracks).map(|k| uses(&format!("side({k})"))).collect(),
            formulas,
        };
        Ok(Self { compiled: Arc::new(compiled), frame })
    }

    /// The same functions in another frame, if these are the same formulas.
    pub(super) fn with_frame(&self, formulas: &[Formula], frame: Frame) -> Option<Self> {
        let compiled = Arc::clone(&self.compiled);
        (compiled.formulas == formulas).then_some(Self { compiled, frame })
    }

    /// Number of functions.
    pub(super) fn len(&self) -> usize {
        self.compiled.formulas.len()
    }

    /// The functions seen from an anchor.
    pub(super) fn at(&self, cracks: &[Crack], anchor: Vec2) -> LocalFormulas<'_> {
        let used = |(crack, &used): (_, &bool)| used.then(|| LocalCrack::new(crack, anchor));
        LocalFormulas {
            compiled: &self.compiled,
            frame: LocalFrame::new(cracks, self.frame, anchor),
            cracks: cracks.iter().zip(&self.compiled.sides).map(used).collect(),
        }
    }
}

/// A formula's frame seen from an anchor.
#[derive(Clone, Debug)]
enum LocalFrame {
    Fixed { from_origin: Vec2, axis: Vec2 },
    Tip(LocalTip),
}

impl LocalFrame {
    fn new(cracks: &[Crack], frame: Frame, anchor: Vec2) -> Self {
        match frame {
            Frame::World => Self::Fixed { from_origin: anchor, axis: vec2(1.0, 0.0) },
            Frame::Fixed { origin, angle } => {
                Self::Fixed { from_origin: anchor - origin, axis: vec2(angle.cos(), angle.sin()) }
            }
            Frame::Tip(tip) => {
                Self::Tip(LocalTip::new(&cracks[tip.crack as usize], tip.end, anchor))
            }
        }
    }

    /// The point `anchor + offset` in the frame. In a fixed frame the negative x axis belongs to the
    /// upper side, θ = +π.
    fn point(&self, offset: Vec2, side: Side) -> TipPoint<f64> {
        match self {
            Self::Fixed { from_origin, axis } => {
                let d = *from_origin + offset;
                let (x, y) = (axis.dot(d), axis.cross(d));
                TipPoint { x, y, sign: if y >= 0.0 { 1.0 } else { -1.0 }, branch: 1.0 }
            }
            Self::Tip(tip) => tip.point([offset.x, offset.y], side),
        }
    }

    fn axis(&self) -> Vec2 {
        match self {
            Self::Fixed { axis, .. } => *axis,
            Self::Tip(tip) => tip.axis,
        }
    }
}

/// Formulas seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct LocalFormulas<'t> {
    compiled: &'t Compiled,
    frame: LocalFrame,
    /// The cracks whose sides are used.
    cracks: Vec<Option<LocalCrack>>,
}

impl LocalFormulas<'_> {
    /// The inputs of the formulas at a point; NaN for those they do not use.
    fn inputs(&self, offset: Vec2, side: Side, inputs: &mut Vec<f64>) {
        let p = self.frame.point(offset, side);
        let r = p.x.hypot(p.y);
        let theta = if self.compiled.theta { p.polar().1 } else { f64::NAN };
        let [cos_half, sin_half] = p.half_angle(r);
        inputs.clear();
        inputs.extend([p.x, p.y, r, theta, cos_half, sin_half]);
        let side_of = |crack: &LocalCrack| crack.side([offset.x, offset.y], side);
        inputs.extend(self.cracks.iter().map(|crack| crack.as_ref().map_or(f64::NAN, side_of)));
    }

    /// The functions at the lanes of `offset`, one lane after the other.
    pub(super) fn evaluate<R: Real, const D: usize>(
        &self,
        offset: [R; 2],
        side: Side,
        out: &mut [Jet<R>],
    ) {
        let [mut xs, mut ys] = [[R::Scalar::default(); 16]; 2];
        offset[0].store(&mut xs);
        offset[1].store(&mut ys);
        let mut lanes = [[[R::Scalar::default(); 16]; 6]; GROUP];
        let (mut inputs, mut scratch) = (Vec::new(), Vec::new());
        let axis = self.frame.axis();
        let jets = &self.compiled.jets[D];
        let size = [1, 3, 6][D];
        let mut results = [0.0; 6 * GROUP];
        let results = &mut results[..jets.n_outputs()];
        for k in 0..R::LANES {
            let point = vec2(xs[k].to_f64(), ys[k].to_f64());
            self.inputs(point, side, &mut inputs);
            jets.evaluate(&inputs, &mut scratch, results);
            for (lanes, results) in lanes.iter_mut().zip(results.chunks_exact(size)) {
                let mut all = [0.0; 6];
                all[..size].copy_from_slice(results);
                let [v, x, y, xx, xy, yy] = all;
                let world = Jet { v, x, y, xx, xy, yy }.turned::<D>(axis.x, axis.y);
                let world = [world.v, world.x, world.y, world.xx, world.xy, world.yy];
                for (lane, value) in lanes.iter_mut().zip(world) {
                    lane[k] = R::Scalar::from_f64(value);
                }
            }
        }
        for (out, lanes) in out.iter_mut().zip(&lanes).take(self.compiled.formulas.len()) {
            let [v, x, y, xx, xy, yy] = lanes.map(|lane| offset[0].load(&lane));
            *out = Jet { v, x, y, xx, xy, yy };
        }
    }
}
