//! Uphill from a pixel.

use ppum::crack::Side;
use ppum::field::LocalField;
use ppum::quantity::QuantityGradient;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::raster::Raster;
use rayon::prelude::*;

use super::curves::{Promise, best_first};

/// Most steps of Newton's method.
const NEWTON: usize = 12;

/// Step of the differences that make the Hessian, pixels.
const DIFFERENCE: f64 = 1e-3;

/// Directions that are tried together, and how often they are turned before the step is halved.
const DIRECTIONS: usize = 6;
const TURNS: usize = 3;

/// Turn from one set of directions to the next, in turns: no direction comes back.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Steps below this part of a pixel change nothing that is seen in the value.
const LEAST: f64 = 1e-7;

/// A step of Newton's method below which the peak is there: the value is known to its square,
/// beside what a pixel changes.
const THERE: f64 = 1e-4;

/// Steps down to which something higher is looked for around such a peak.
const NEAR: f64 = 0.1;

/// Most rounds of directions.
const ROUNDS: usize = 2000;

/// The pixels that are not below (for the sign −1 above) any of their neighbours, and the height
/// that there may be around them if it rises as it does from the lowest neighbour; the most
/// promising first, at most so many.
pub(super) fn starts(raster: &Raster, sign: f64, most: usize) -> Vec<Promise<[u32; 2]>> {
    let [columns, rows] = raster.size;
    let value = |i: u32, j: u32| finite(sign * raster.value(i, j));
    let in_row = |j: u32| raster.row(j).iter().map(|&v| finite(sign * v));
    let highest = (0..rows).flat_map(in_row).fold(f64::NEG_INFINITY, f64::max);
    let first = (0..rows).find_map(|j| {
        let i = (0..columns).find(|&i| value(i, j) == highest)?;
        Some([i, j])
    });
    let top = |i: u32, j: u32| {
        let here = value(i, j);
        let around = (j.saturating_sub(1)..(j + 2).min(rows))
            .flat_map(|j| (i.saturating_sub(1)..(i + 2).min(columns)).map(move |i| (i, j)));
        let mut least = here;
        for (i, j) in around {
            let there = value(i, j);
            if there > here {
                return None;
            }
            least = least.min(there);
        }
        // what is told is no less than any place
        let promise = if first == Some([i, j]) { f64::INFINITY } else { here + (here - least) };
        (promise > highest || here == highest).then_some((promise, [i, j]))
    };
    let found =
        (0..rows).into_par_iter().flat_map_iter(|j| (0..columns).filter_map(move |i| top(i, j)));
    best_first(found.collect(), most)
}

/// NaN for what is infinite: singular points are looked at apart, since at a tip all quantities of
/// the gradient are.
pub(super) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}

/// Climbs in a rectangle of offsets; down for the sign −1.
pub(super) struct Climber<'a, 'f, H> {
    pub(super) slope: &'a QuantityGradient,
    pub(super) local: LocalField<'f>,
    pub(super) rect: Rect,
    pub(super) sign: f64,
    /// Says where not to go.
    pub(super) is_hidden: H,
}

impl<H: Fn(Vec2) -> bool> Climber<'_, '_, H> {
    /// The highest place that is found from a point, and its value; `None` where there is none.
    pub(super) fn climb(&mut self, from: Vec2, pixel: f64) -> Option<(f64, Vec2)> {
        let start = self.inside(from);
        let best = (self.height(start), start);
        if best.0.is_nan() {
            return None;
        }
        let (best, is_peak) = self.newton(best, pixel);
        let best = self.turn(best, pixel, if is_peak { NEAR } else { LEAST });
        Some((self.sign * best.0, best.1))
    }

    /// Steps to where the gradient vanishes, as long as they lead up; true if they have come there.
    fn newton(&mut self, mut best: (f64, Vec2), pixel: f64) -> ((f64, Vec2), bool) {
        for _ in 0..NEWTON {
            let Some(step) = self.newton_step(best.1, DIFFERENCE * pixel) else { break };
            if step.length() < THERE * pixel {
                return (best, true);
            }
            if step.length() > 2.0 * pixel {
                break;
            }
            let there = self.inside(best.1 + step);
            let height = self.height(there);
            if height.is_nan() || height <= best.0 {
                break;
            }
            best = (height, there);
        }
        (best, false)
    }

    /// −H⁻¹ ∇q if the Hessian H is negative definite.
    fn newton_step(&mut self, at: Vec2, h: f64) -> Option<Vec2> {
        let g = self.gradient(at);
        let [right, left] = [h, -h].map(|h| self.gradient(at + vec2(h, 0.0)));
        let [up, down] = [h, -h].map(|h| self.gradient(at + vec2(0.0, h)));
        let (in_x, in_y) = ((right - left) / (2.0 * h), (up - down) / (2.0 * h));
        let (xx, yy, xy) = (in_x.x, in_y.y, 0.5 * (in_x.y + in_y.x));
        let determinant = xx * yy - xy * xy;
        let is_peak = determinant > 0.0 && xx + yy < 0.0;
        let step = vec2(xy * g.y - yy * g.x, xy * g.x - xx * g.y) / determinant;
        (is_peak && step.is_finite()).then_some(step)
    }

    /// Tries directions, ever closer, until nothing is higher and steps are below the least
    /// one \[pixels\].
    fn turn(&mut self, mut best: (f64, Vec2), pixel: f64, mut least: f64) -> (f64, Vec2) {
        let (mut step, mut failed, mut turned) = (0.5 * pixel, 0, 0.0);
        for _ in 0..ROUNDS {
            let found = self.best_around(best, step, turned);
            turned = (turned + GOLDEN).fract();
            if found.0 > best.0 {
                (best, failed, least) = (found, 0, LEAST);
                continue;
            }
            failed += 1;
            if failed == TURNS {
                (step, failed) = (0.5 * step, 0);
            }
            if step < least * pixel {
                break;
            }
        }
        best
    }

    fn best_around(&mut self, best: (f64, Vec2), step: f64, turned: f64) -> (f64, Vec2) {
        (0..DIRECTIONS).fold(best, |best_so_far, k| {
            let (sin, cos) =
                ((k as f64 + turned) / DIRECTIONS as f64 * std::f64::consts::TAU).sin_cos();
            let there = self.inside(best.1 + vec2(cos, sin) * step);
            let height = self.height(there);
            if height > best_so_far.0 { (height, there) } else { best_so_far }
        })
    }

    fn inside(&self, p: Vec2) -> Vec2 {
        p.max(self.rect.min).min(self.rect.max)
    }

    fn height(&mut self, at: Vec2) -> f64 {
        if (self.is_hidden)(at) {
            return f64::NAN;
        }
        finite(self.sign * self.slope.quantity().at(&mut self.local, at, Side::Above))
    }

    fn gradient(&mut self, at: Vec2) -> Vec2 {
        self.slope.at(&mut self.local, at, Side::Above).gradient * self.sign
    }
}
