//! The traits of one function or coefficient that quadrature has to know.

use super::growth::{Behaviour, growth};
use super::pieces::{SmoothPieces, rays};
use super::probe::Probe;
use crate::quadrature::{BranchCoordinate, KinkLine, SingularGrowth, Singularity};
use ppum::anisotropy::TIP_FUNCTIONS;
use ppum::crack::Crack;
use ppum::dataset::{BoxPartition, Step};
use ppum::expression::Expression;
use ppum::formula::{self, Formula, Table};
use ppum::function::{
    CompileError, Frame, Function, FunctionError, FunctionKind, NonsmoothPoints, function_scope,
    native,
};
use ppum::vec2::{Rect, Vec2, vec2};
use std::f64::consts::PI;
use std::sync::Arc;

/// Exponent that a function of infinite energy is graded for.
const DIVERGENT: SingularGrowth = SingularGrowth::Powers { least: 0.04 };

/// The traits of one function or coefficient that quadrature has to know.
#[derive(Default)]
pub(super) struct Traits {
    pub(super) singular: Vec<Singularity>,
    pub(super) kinks: Vec<KinkLine>,
    pub(super) probe: Option<Probe>,
    /// Degree, where it is a piecewise polynomial.
    pub(super) degree: usize,
    /// A point around which the energy is infinite.
    pub(super) divergent: Option<Vec2>,
}

impl Traits {
    fn add_singular(&mut self, point: Vec2, growth: SingularGrowth) {
        self.singular.push(Singularity { growth, ..Singularity::tip(point) });
    }
}

/// The surroundings that the traits of a function depend on.
pub(super) struct TraitContext<'s> {
    pub(super) cracks: Arc<[Crack]>,
    pub(super) tables: &'s [Arc<Table>],
    /// The box that the cells cover.
    pub(super) domain: Rect,
    /// A length longer than the domain.
    pub(super) reach: f64,
    /// Half the width of the smallest patch.
    pub(super) scale: f64,
}

/// The box of all cells.
pub(crate) fn box_of(partition: &BoxPartition) -> Rect {
    let first = partition.cell.first().copied().unwrap_or(Rect::new(Vec2::ZERO, Vec2::ZERO));
    partition.cell.iter().fold(first, |all, cell| all.union(cell))
}

impl<'s> TraitContext<'s> {
    pub(super) fn new(step: &Step, tables: &'s [Arc<Table>]) -> Self {
        let partition = step.partition.boxes();
        let domain = box_of(partition);
        let halves = partition.half.iter().map(|half| half.x.min(half.y));
        Self {
            cracks: step.cracks.as_slice().into(),
            tables,
            domain,
            reach: 2.0 * domain.size().length(),
            scale: halves.fold(f64::INFINITY, f64::min),
        }
    }

    pub(super) fn traits(&self, function: &Function) -> Result<Traits, FunctionError> {
        match &function.kind {
            FunctionKind::Formula { text, frame, .. } if native(text, *frame).is_some() => {
                let singular = vec![Singularity::tip(self.axes(*frame).origin)];
                Ok(Traits { singular, ..Traits::default() })
            }
            FunctionKind::Formula { text, frame, parameters, .. }
                if TIP_FUNCTIONS.contains(&&**text) =>
            {
                let axes = self.axes(*frame);
                let number = |name: &str| parameters.iter().find(|(own, _)| own == name);
                let root = |names: [&str; 2]| {
                    let root = names.map(|name| number(name).map_or(1.0, |(_, value)| *value));
                    BranchCoordinate::new(axes.x, root)
                };
                let branches = Some([root(["a1", "b1"]), root(["a2", "b2"])]);
                let singular = vec![Singularity { branches, ..Singularity::tip(axes.origin) }];
                Ok(Traits { singular, ..Traits::default() })
            }
            FunctionKind::Formula { text, frame, parameters, declared, .. } => {
                let error = |source: CompileError| FunctionError {
                    index: 0,
                    name: function.name.clone(),
                    source: Box::new(source),
                };
                let scope = function_scope(parameters, self.cracks.len(), self.tables)
                    .map_err(|e| error(e.into()))?;
                let formula = Formula::parse(text, &scope).map_err(|e| error(e.into()))?;
                self.of_formula(function, &formula, &self.axes(*frame), declared)
            }
            _ => Ok(Traits::default()),
        }
    }

    fn of_formula(
        &self,
        function: &Function,
        formula: &Formula,
        axes: &FrameAxes,
        declared: &NonsmoothPoints,
    ) -> Result<Traits, FunctionError> {
        let probe = Probe::function(function, &self.cracks, self.tables)?;
        let SmoothPieces { sets, degree } = SmoothPieces::new(formula);
        let mut traits = Traits { degree: degree.unwrap_or(0), ..Traits::default() };
        for set in sets {
            if let Some(line) = set.line() {
                traits.kinks.push(KinkLine::Line(axes.line(line)));
            } else if let Some(rays) = rays(&set.value) {
                traits.kinks.extend(rays.into_iter().map(|theta| self.ray(axes, theta)));
            } else {
                let text = set.value.text();
                let part = Probe::part_of(function, text, &self.cracks, self.tables)?;
                traits.kinks.push(KinkLine::Curve(Arc::new(move |p| part.jet(p, Vec2::ZERO)[0])));
            }
        }
        if formula.uses_branch() && !axes.is_tip {
            traits.kinks.push(self.ray(axes, PI));
        }
        let segments = declared.kinks.iter();
        traits.kinks.extend(segments.map(|s| KinkLine::Segment(s.map(|p| axes.to_world(p)))));
        if formula.singular_at_origin() {
            match growth(&|offset| probe.jet(axes.origin, offset), self.scale) {
                Behaviour::Constant => {}
                Behaviour::Grows(growth) => traits.add_singular(axes.origin, growth),
                Behaviour::Diverges => {
                    if !declared.singular.contains(&Vec2::ZERO) {
                        traits.add_singular(axes.origin, DIVERGENT);
                    }
                    traits.divergent = Some(axes.origin);
                }
            }
        }
        // Distances from points other than the origin carry the rounding of coordinates. Nothing
        // may look nearer than the rule for half powers does: noise would be taken for
        // the function.
        for &point in &declared.singular {
            traits.add_singular(axes.to_world(point), SingularGrowth::HalfPowers);
        }
        traits.probe = (degree.is_none() && declared.singular.is_empty()).then_some(probe);
        Ok(traits)
    }

    /// The ray from the origin of a frame, as far as the domain reaches.
    fn ray(&self, axes: &FrameAxes, theta: f64) -> KinkLine {
        let end = vec2(theta.cos(), theta.sin()) * (self.reach + axes.origin.length());
        KinkLine::Segment([axes.origin, axes.to_world(end)])
    }

    fn axes(&self, frame: Frame) -> FrameAxes {
        let (origin, x, is_tip) = match frame {
            Frame::Fixed { origin, angle } => (origin, vec2(angle.cos(), angle.sin()), false),
            Frame::Tip(tip) => {
                let crack = &self.cracks[tip.crack as usize];
                (crack.end_point(tip.end), crack.growth_direction(tip.end), true)
            }
            _ => (Vec2::ZERO, vec2(1.0, 0.0), false),
        };
        FrameAxes { origin, x, is_tip }
    }
}

/// The traits of a coefficient of the equation.
pub(super) fn traits_of_coefficient(coefficient: &Expression) -> Traits {
    if coefficient.constant().is_some() {
        return Traits::default();
    }
    let formula = coefficient.formula();
    let SmoothPieces { sets, degree } = SmoothPieces::new(formula);
    let probe = degree.is_none().then(|| Probe::coefficient(formula).ok()).flatten();
    Traits { kinks: in_world(sets), probe, degree: degree.unwrap_or(0), ..Traits::default() }
}

/// The traits of a load or of given values, whose absolute value has a `mean`; none of a polynomial
/// of low degree, which every rule resolves.
pub(super) fn traits_of_data(data: &Expression, mean: f64) -> Option<Traits> {
    if data.constant().is_some() {
        return None;
    }
    let formula = data.formula();
    let SmoothPieces { mut sets, degree } = SmoothPieces::new(formula);
    if degree.is_some() && sets.is_empty() {
        return None;
    }
    let known = |sets: &[formula::Kink], set: &formula::Kink| {
        sets.iter().any(|known| known.value.text() == set.value.text())
    };
    for crest in formula.crests() {
        if !known(&sets, &crest) {
            sets.push(crest);
        }
    }
    let kinks = in_world(sets);
    // the sides of curves are looked at, too: rules of pieces with such sides are not exact
    let curved = kinks.iter().any(|kink| matches!(kink, KinkLine::Curve(_)));
    let is_probed = degree.is_none() || curved;
    let probe = is_probed.then(|| Probe::Load { formula: formula.clone(), mean });
    Some(Traits { kinks, probe, ..Traits::default() })
}

/// Level functions of the body's x and y on whose zero sets a load may jump.
pub(crate) fn levels_of_data(data: &Expression) -> Vec<Formula> {
    if data.constant().is_some() {
        return Vec::new();
    }
    SmoothPieces::new(data.formula()).sets.into_iter().map(|set| set.value).collect()
}

/// Sets of a formula of the body's x and y.
fn in_world(sets: Vec<formula::Kink>) -> Vec<KinkLine> {
    let world = FrameAxes { origin: Vec2::ZERO, x: vec2(1.0, 0.0), is_tip: false };
    let kink = |set: formula::Kink| match set.line() {
        Some(line) => KinkLine::Line(world.line(line)),
        None => KinkLine::Curve(Arc::new(move |p: Vec2| set.value.evaluate(&[p.x, p.y]))),
    };
    sets.into_iter().map(kink).collect()
}

/// A frame's axes in the world.
struct FrameAxes {
    origin: Vec2,
    x: Vec2,
    is_tip: bool,
}

impl FrameAxes {
    fn to_world(&self, p: Vec2) -> Vec2 {
        self.origin + self.x * p.x + self.x.left() * p.y
    }

    /// Two points of the line a x + b y + c = 0.
    fn line(&self, [a, b, c]: [f64; 3]) -> [Vec2; 2] {
        let normal = vec2(a, b);
        let foot = normal * (-c / normal.dot(normal));
        [foot, foot + normal.unit().left()].map(|p| self.to_world(p))
    }
}
