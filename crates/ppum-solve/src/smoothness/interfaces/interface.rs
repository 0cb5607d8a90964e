//! The sets on which constants of the material and given strains may jump.

use crate::law::{Law, Strain};
use crate::quadrature::LevelFunction;
use ppum::crack::Crack;
use ppum::dataset::Equation;
use ppum::domain::Domain;
use ppum::expression::Expression;
use ppum::formula::{Formula, Kink, one_line};
use ppum::function::Frame;
use ppum::vec2::{Rect, Vec2, vec2};
use std::sync::Arc;

/// Points in each direction at which two level functions are compared.
const COMPARED: usize = 24;

/// Part of a level function's size that is rounding.
const ROUNDING: f64 = 1e-12;

/// The sets on which constants of an equation may jump in a cracked body.
pub struct Interfaces<'e> {
    /// No two have proportional level functions.
    pub all: Vec<Interface>,
    pub(super) domain: &'e Domain,
    pub(super) cracks: &'e [Crack],
    pub(super) law: Law<'e>,
    /// The coefficient of expansion by a temperature of the field.
    expansion: Option<&'e Expression>,
    /// The largest of what [`given`](Self::given) has, 0 without any.
    pub(super) largest: [f64; 2],
}

/// A set on which a constant may jump: the zeros of a level function ψ.
pub struct Interface {
    pub(super) level: Arc<LevelFunction>,
    /// The derivatives of ψ.
    slopes: [Formula; 2],
    /// The text of ψ in the body's coordinates.
    name: String,
    /// A frame and the text of |ψ| in it.
    pub(crate) frame: Frame,
    pub(crate) text: String,
}

impl<'e> Interfaces<'e> {
    /// Those of an equation, and of a coefficient of expansion by a temperature that is solved for.
    pub fn new(
        (equation, expansion): (&'e Equation, Option<&'e Expression>),
        domain: &'e Domain,
        cracks: &'e [Crack],
    ) -> Self {
        let mut all: Vec<Interface> = Vec::new();
        let constants = equation.constants().map(|(_, expression)| expression).chain(expansion);
        let formulas = constants.filter(|expression| expression.constant().is_none());
        let kinks = formulas.flat_map(|expression| expression.formula().kinks());
        for new in kinks.filter_map(|kink| Interface::new(&kink, &domain.bounds)) {
            let is_new = |known: &Interface| {
                !proportional(&|p| known.value(p), &|p| new.value(p), &domain.bounds)
            };
            if all.iter().all(is_new) {
                all.push(new);
            }
        }
        let law = Law::new(equation);
        let new = Self { all, domain, cracks, law, expansion, largest: [0.0; 2] };
        if new.all.is_empty() { new } else { Self { largest: new.largest_given(), ..new } }
    }

    /// The entries of minus the given strains, and the coefficient of expansion by a temperature of
    /// the field.
    pub(super) fn given(&self, p: Vec2) -> [Vec<f64>; 2] {
        let Strain(strain) = self.law.at(p).elastic(&Strain::default());
        let expansion = self.expansion.map_or(0.0, |expansion| expansion.value(p));
        [strain.as_flattened().to_vec(), vec![expansion]]
    }

    /// The largest of them at points all over the body.
    fn largest_given(&self) -> [f64; 2] {
        let points = points_of(&self.domain.bounds).filter(|p| self.domain.contains(*p));
        points.map(|p| self.given(p)).fold([0.0; 2], |most, given| {
            std::array::from_fn(|k| {
                let finite = given[k].iter().filter(|entry| entry.is_finite());
                finite.fold(most[k], |most: f64, entry| most.max(entry.abs()))
            })
        })
    }
}

/// Points all over a box, on no line that a user would choose.
fn points_of(rect: &Rect) -> impl Iterator<Item = Vec2> {
    let part = |k: usize| (k as f64 + 0.4142) / COMPARED as f64;
    let (min, size) = (rect.min, rect.size());
    let places = (0..COMPARED * COMPARED).map(|k| (k % COMPARED, k / COMPARED));
    places.map(move |(i, j)| min + vec2(size.x * part(i), size.y * part(j)))
}

impl Interface {
    /// None if the level function has no derivatives.
    fn new(kink: &Kink, domain: &Rect) -> Option<Self> {
        let derivative = |variable| kink.value.derivative(variable).ok();
        let slopes = [derivative("x")?, derivative("y")?];
        let name = one_line(kink.value.text());
        let (frame, text) = match kink.line() {
            Some(line) => (along(line, domain.center()), "abs(y)".to_owned()),
            None => (Frame::World, format!("abs({})", kink.value.text())),
        };
        let value = kink.value.clone();
        let level = Arc::new(move |p: Vec2| value.evaluate(&[p.x, p.y]));
        Some(Self { level, slopes, name, frame, text })
    }

    /// ψ
    pub(crate) fn value(&self, p: Vec2) -> f64 {
        (self.level)(p)
    }

    /// ∇ψ
    pub(crate) fn gradient(&self, p: Vec2) -> Vec2 {
        let [x, y] = self.slopes.each_ref().map(|slope| slope.evaluate(&[p.x, p.y]));
        vec2(x, y)
    }

    /// Its name in reports: the equation of its points.
    pub(crate) fn name(&self) -> String {
        format!("{} = 0", self.name)
    }
}

/// The frame along the line a x + b y + c = 0, its origin next to a point.
fn along([a, b, c]: [f64; 3], near: Vec2) -> Frame {
    let normal = vec2(a, b);
    let origin = near - normal * ((normal.dot(near) + c) / normal.dot(normal));
    let way = normal.left();
    Frame::Fixed { origin, angle: (-way.y).atan2(-way.x) }
}

/// True if two functions are multiples of each other, as far as points all over a box tell: then
/// they vanish at the same places.
pub(crate) fn proportional(f: &dyn Fn(Vec2) -> f64, g: &dyn Fn(Vec2) -> f64, rect: &Rect) -> bool {
    let pairs: Vec<_> = points_of(rect).map(|p| (f(p), g(p))).collect();
    let largest = pairs.iter().copied().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    largest.is_some_and(|(a, b)| {
        let bound = ROUNDING * (a * b).abs();
        bound > 0.0 && pairs.iter().all(|(x, y)| (y * a - x * b).abs() <= bound)
    })
}
