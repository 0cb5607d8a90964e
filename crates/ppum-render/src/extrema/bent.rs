//! Curved interfaces: chords of their course, between which points are pulled onto them.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;
use std::sync::Arc;

use crate::pieces::{FormulaLevel, LevelCurve as _, material_kinks};

/// Nodes of the grids on which the courses are looked for, at most.
const NODES: usize = 1 << 18;

/// A part of the zeros of a formula, seen from one side.
pub(super) struct Bent {
    curve: Arc<FormulaLevel>,
    chord: [Vec2; 2],
    /// To the side from which it is seen, a unit vector.
    toward: Vec2,
}

impl Bent {
    /// The point at a part of the way of the chord, pulled onto the curve along the chord's normal,
    /// and `beside` it.
    pub(super) fn at(&self, t: f64, beside: f64) -> Vec2 {
        let [a, b] = self.chord;
        let (middle, reach) = (a + (b - a) * t, (b - a).left() * 0.25);
        let on_curve = self.curve.root(middle - reach, middle + reach);
        on_curve.unwrap_or(middle) + self.toward * beside
    }

    pub(super) fn length(&self) -> f64 {
        (self.chord[1] - self.chord[0]).length()
    }
}

/// Both sides of the parts of curved interfaces in a rectangle of offsets from an anchor.
pub(super) fn bent_interfaces(
    field: &Field<'_>,
    anchor: Vec2,
    rect: &Rect,
    pixel: f64,
) -> Vec<Bent> {
    let kinks: Vec<_> = material_kinks(field).filter(|kink| kink.line().is_none()).collect();
    let steps = ((NODES / kinks.len().max(1)) as f64).sqrt().max(1.0) as usize;
    let mut found = Vec::new();
    for kink in kinks {
        let curve = Arc::new(FormulaLevel { formula: kink.value, anchor });
        for chord in chords(&curve, rect, pixel, steps) {
            let normal = (chord[1] - chord[0]).unit().left();
            let seen = |toward| Bent { curve: Arc::clone(&curve), chord, toward };
            found.extend([normal, -normal].map(seen));
        }
    }
    found
}

/// Chords of the course of a curve through the squares of a grid of so many steps at most in each
/// direction, where it crosses two sides.
fn chords(curve: &FormulaLevel, rect: &Rect, pixel: f64, steps: usize) -> Vec<[Vec2; 2]> {
    let size = rect.size();
    let count = |length: f64| ((length / pixel).ceil() as usize).clamp(1, steps);
    let [columns, rows] = [count(size.x), count(size.y)];
    let node = |i: usize, j: usize| {
        let (x, y) = (i as f64 / columns as f64, j as f64 / rows as f64);
        rect.min + vec2(size.x * x, size.y * y)
    };
    let row = |j: usize| (0..=columns).map(|i| curve.is_positive(node(i, j))).collect::<Vec<_>>();
    let (signs, mut all): (Vec<_>, _) = ((0..=rows).into_par_iter().map(row).collect(), Vec::new());
    for (j, pair) in (1..).zip(signs.windows(2)) {
        let [below, above] = [&pair[0], &pair[1]];
        for i in 1..=columns {
            let signs = [below[i - 1], below[i], above[i], above[i - 1]];
            let corners = [node(i - 1, j - 1), node(i, j - 1), node(i, j), node(i - 1, j)];
            if signs.iter().all(|&sign| sign == signs[0]) {
                continue;
            }
            let root = |k: usize| curve.root(corners[k], corners[(k + 1) % 4]);
            if let [a, b] = (0..4).filter_map(root).collect::<Vec<_>>()[..] {
                all.push([a, b]);
            }
        }
    }
    all
}
