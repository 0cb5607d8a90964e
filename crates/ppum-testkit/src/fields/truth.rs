//! The truth that an image is held to.

use ppum::crack::{LocalCrack, Side};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::{Quantity, Source};
use ppum::vec2::{Rect, Vec2, vec2};

use super::window::Window;

/// Half the width of the band along cracks and borders, pixels. Positions in single precision are
/// good to some 10⁻⁵ of a pixel.
pub const BAND: f64 = 1.0 / 256.0;

/// A window of a field, evaluated point by point.
#[derive(Clone, Debug)]
pub struct Truth<'f> {
    field: &'f Field<'f>,
    window: Window,
    /// Largest |u| and |∇u| around each pixel.
    values: Vec<f64>,
    gradients: Vec<f64>,
    band: Vec<bool>,
}

/// The values of a quantity, and their local scale.
#[derive(Clone, Debug)]
pub struct ExpectedValues<'t> {
    band: &'t [bool],
    /// The values, row by row from the top; NaN outside the domain.
    pub values: Vec<f64>,
    scale: Vec<f64>,
    /// s₁ − s₂ where the quantity is the direction of s₁, which nothing but this determines.
    anisotropy: Option<Vec<f64>>,
}

/// The largest error of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Largest difference in units of the local scale.
    pub worst: f64,
    /// Index of the pixel.
    pub at: usize,
    /// 99th percentile of the differences in these units.
    pub most: f64,
    /// 99th percentile of the relative error.
    pub relative: f64,
    /// Pixels that are NaN or infinite on one side only.
    pub strange: usize,
    /// The last of them: its index, the expected value and the one found.
    pub strangest: Option<(usize, f64, f64)>,
    /// Pixels, and those of them in the band.
    pub pixels: [usize; 2],
}

impl<'f> Truth<'f> {
    /// Evaluates all pixels of a window.
    #[must_use]
    pub fn new(field: &'f Field<'f>, window: Window) -> Self {
        let mut local = field.at(window.center);
        let mut jets = vec![Jet::constant(0.0); field.components()];
        let mut norms = |offset| {
            if !local.evaluate::<1>(offset, Side::Above, &mut jets) {
                return [f64::NAN; 2];
            }
            let of = |part: &dyn Fn(&Jet<f64>) -> f64| jets.iter().map(part).sum::<f64>().sqrt();
            [of(&|u| u.v * u.v), of(&|u| u.x * u.x + u.y * u.y)]
        };
        let all: Vec<_> = window.offsets().map(&mut norms).collect();
        let [values, gradients] = [0, 1].map(|k| all.iter().map(|n| n[k]).collect::<Vec<_>>());
        let mean = mean(&gradients);
        let gradients =
            around(&gradients, window.pixels).iter().map(|g| g.max(0.1 * mean)).collect();
        let values = around(&values, window.pixels);
        Self { field, window, values, gradients, band: band(field, &window) }
    }

    /// The values of a quantity by [`Quantity::at`].
    #[must_use]
    pub fn expected(&self, quantity: &Quantity) -> ExpectedValues<'_> {
        let evaluate = |quantity: &Quantity| -> Vec<f64> {
            let mut local = self.field.at(self.window.center);
            let value = |offset| quantity.at(&mut local, offset, Side::Above);
            self.window.offsets().map(value).collect()
        };
        let values = evaluate(quantity);
        let made_of = |k: usize| match (quantity, quantity.source()) {
            (Quantity::EnergyDensity, _) => self.gradients[k] * self.gradients[k],
            (_, Source::Gradient) => self.gradients[k],
            (Quantity::WeightSum | Quantity::Overlap, _) => 0.0,
            (_, Source::Partition) => 1.0,
            _ => self.values[k],
        };
        let scale = around(&values, self.window.pixels)
            .iter()
            .enumerate()
            .map(|(k, s)| s.max(made_of(k)))
            .collect();
        let anisotropy = (*quantity == Quantity::PrincipalDirection).then(|| {
            let [s1, s2] = [Quantity::Principal1, Quantity::Principal2].map(|q| evaluate(&q));
            s1.iter().zip(s2).map(|(a, b)| a - b).collect()
        });
        ExpectedValues { band: &self.band, values, scale, anisotropy }
    }

    /// A component with derivatives: all pixels of v, x, y, xx, xy, yy. Second derivatives are
    /// differences of terms of the size |∇u| |∇φ_i| and have that for their scale: |∇u| over the
    /// smallest half-extent of a patch in sight.
    #[must_use]
    pub fn component(&self, component: usize) -> [ExpectedValues<'_>; 6] {
        let mut local = self.field.at(self.window.center);
        let mut jets = vec![Jet::constant(0.0); self.field.components()];
        let mut one = |offset| match local.evaluate::<2>(offset, Side::Above, &mut jets) {
            true => jets[component],
            false => Jet::constant(f64::NAN),
        };
        let all: Vec<_> = self.window.offsets().map(&mut one).collect();
        let parts: [fn(&Jet<f64>) -> f64; 6] =
            [|u| u.v, |u| u.x, |u| u.y, |u| u.xx, |u| u.xy, |u| u.yy];
        let half = &self.field.step.partition.boxes().half;
        let smallest = half.iter().map(|h| h.x.min(h.y)).fold(f64::INFINITY, f64::min);
        std::array::from_fn(|k| {
            let values: Vec<f64> = all.iter().map(parts[k]).collect();
            let curvatures = || around(&values, self.window.pixels).into_iter();
            let scale = match k {
                0 => self.values.clone(),
                1 | 2 => self.gradients.clone(),
                _ => curvatures().zip(&self.gradients).map(|(c, g)| c.max(g / smallest)).collect(),
            };
            ExpectedValues { band: &self.band, values, scale, anisotropy: None }
        })
    }
}

impl ExpectedValues<'_> {
    /// Compares an image, row by row from the top.
    ///
    /// # Panics
    /// If it has another number of pixels.
    #[must_use]
    pub fn compare(&self, found: impl ExactSizeIterator<Item = f64>) -> Differences {
        assert_eq!(found.len(), self.values.len(), "pictures of one size");
        let outside = self.band.iter().filter(|&&band| band).count();
        let mut out = Differences {
            worst: 0.0,
            at: 0,
            most: 0.0,
            relative: 0.0,
            strange: 0,
            strangest: None,
            pixels: [0; 2],
        };
        out.pixels = [self.band.len(), outside];
        let (mut relative, mut all) = (vec![0.0], vec![0.0]);
        for (k, found) in found.enumerate().filter(|&(k, _)| !self.band[k]) {
            let expected = self.values[k];
            if !expected.is_finite() || !found.is_finite() {
                if class(found) != class(expected) {
                    out.strange += 1;
                    out.strangest = Some((k, expected, found));
                }
                continue;
            }
            let difference = self.difference(k, found);
            relative.push(if difference == 0.0 { 0.0 } else { difference / expected.abs() });
            let scaled = if difference == 0.0 { 0.0 } else { difference / self.scale[k] };
            all.push(scaled);
            if scaled > out.worst {
                (out.worst, out.at) = (scaled, k);
            }
        }
        (out.most, out.relative) = (percentile(all), percentile(relative));
        out
    }

    fn difference(&self, k: usize, found: f64) -> f64 {
        let difference = found - self.values[k];
        match &self.anisotropy {
            // angles are equal up to half turns
            Some(anisotropy) => difference.sin().abs() * anisotropy[k],
            None => difference.abs(),
        }
    }
}

/// The kind of a number: an order of NaN, −∞, finite, +∞.
fn class(value: f64) -> u8 {
    match value {
        v if v.is_nan() => 0,
        v if v == f64::NEG_INFINITY => 1,
        v if v == f64::INFINITY => 3,
        _ => 2,
    }
}

/// The 99th percentile of some numbers.
fn percentile(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[(values.len() - 1) * 99 / 100]
}

fn mean(values: &[f64]) -> f64 {
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    finite.iter().sum::<f64>() / finite.len().max(1) as f64
}

/// The largest finite magnitude of the 3 × 3 pixels around each; 0 if there is none.
fn around(values: &[f64], [columns, rows]: [u32; 2]) -> Vec<f64> {
    let (columns, rows) = (columns as usize, rows as usize);
    let largest = |i: usize, j: usize| {
        let lines = j.saturating_sub(1)..(j + 2).min(rows);
        let near =
            lines.flat_map(|j| &values[j * columns..][i.saturating_sub(1)..(i + 2).min(columns)]);
        near.map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
    };
    (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).map(|(i, j)| largest(i, j)).collect()
}

/// The pixels too near to something that jumps.
fn band(field: &Field<'_>, window: &Window) -> Vec<bool> {
    let (center, near) = (window.center, BAND * window.pixel_size());
    let cracks: Vec<_> =
        field.step.cracks.iter().map(|crack| LocalCrack::new(crack, center)).collect();
    let partition = field.step.partition.boxes();
    let mut patches = Vec::new();
    let mut at = |p: Vec2| {
        // a pixel around: what f64 rounds away does not matter
        let pixel = window.pixel_size();
        patches.clear();
        field.tree.query_box(&Rect::around(center + p, vec2(pixel, pixel)), &mut patches);
        let supports = patches.iter().map(|&patch| partition.support(patch as usize));
        let mut boxes = supports.chain([field.domain.bounds]);
        boxes.any(|b| near_border(&Rect::new(b.min - center, b.max - center), p, near))
            || cracks.iter().any(|crack| near_crack(crack, p, near))
            || field.domain.holes.iter().any(|hole| hole.rim_distance(center + p) < near)
    };
    window.offsets().map(&mut at).collect()
}

/// True near an edge, near all of the circle of an arc, and near the tangents at the ends.
fn near_crack(crack: &LocalCrack, p: Vec2, near: f64) -> bool {
    let vertices = crack.vertices();
    let near_edge = crack.segments().iter().any(|s| {
        let along = s.tangent.dot(p);
        let across = s.tangent.cross(p) + s.distance;
        let power = 2.0 * across - s.curvature * (along * along + across * across);
        let distance = power / (1.0 + (1.0 - s.curvature * power).max(0.0).sqrt());
        let is_beside = s.curvature != 0.0 || along > s.lo - near && along < s.hi + near;
        distance.abs() < near && is_beside
    });
    let mut ends = vertices.first().into_iter().chain(vertices.last());
    near_edge || ends.any(|end| end.tangents[0].cross(p - end.at).abs() < near)
}

fn near_border(b: &Rect, p: Vec2, near: f64) -> bool {
    let inside = p.x > b.min.x - near
        && p.x < b.max.x + near
        && p.y > b.min.y - near
        && p.y < b.max.y + near;
    let on = |a: f64, b: f64| (a - b).abs() < near;
    inside && (on(p.x, b.min.x) || on(p.x, b.max.x) || on(p.y, b.min.y) || on(p.y, b.max.y))
}
