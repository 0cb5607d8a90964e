//! Isolines of the whole: those of the body and those of its images.
//!
//! Where a level is the least or the largest value, rounding decides on which side of it values
//! lie: of a displacement that a support holds at zero pieces of lines would be found along the
//! support. Such a level is looked for just inside of the values. So a plateau at the end of the
//! values has its border, a border on which the end is attained has a line, and a single place
//! where it is attained has none.

use std::borrow::Cow;

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, Reflection, ValueChange};
use ppum_figure::overlay::carried;
use ppum_render::RasterError;
use ppum_render::isoline::{Isoline, isolines as isolines_of_body};
use ppum_render::scatter::render;

use super::zero_line;
use crate::image::body::{BodyPart, BodyView};
use crate::image::mirror_lines::{MirrorLines, slope_sign};
use crate::image::values::{RasterValues, with_raster};

/// The lines on which a quantity has one of some values, where they are seen of the body and of
/// its images. The values at the pixels of an undeformed body are given.
pub(crate) fn isolines(
    field: &Field<'_>,
    body: &BodyView<'_>,
    quantity: &Quantity,
    levels: &[f64],
    values: &RasterValues,
    watcher: &dyn Watcher,
) -> Result<Vec<Isoline>, RasterError> {
    let is_mirrored = body.lines != MirrorLines::default();
    // of images one level after the other: each keeps its number, however it is rounded
    let together = if is_mirrored { 1 } else { levels.len().max(1) };
    let mut all = Vec::new();
    for part in body.parts() {
        let reflected = quantity.reflected(&part.reflection, field)?;
        let (view, known) = match &part.points {
            None if is_mirrored => {
                (part.view, Cow::Owned(values.restricted(part, reflected.change, field)))
            }
            None => (part.view, Cow::Borrowed(values)),
            Some(points) => {
                let Some(view) = points.material_view() else { continue };
                let raster = render::<f64>(field, &view, &reflected.quantity, watcher)?;
                (view, Cow::Owned(raster.into()))
            }
        };
        for levels in levels.chunks(together) {
            let there: Vec<f64> = levels.iter().map(|&l| reflected.change.apply(l)).collect();
            let found = with_raster!(&*known, raster => {
                isolines_of_body(field, &view, &reflected.quantity, &there, raster, watcher)?
            });
            let found = part.points.as_ref().map(|p| carried(&p.view, &found)).unwrap_or(found);
            all.extend(found.into_iter().map(|line| {
                let level = if let [only] = levels { *only } else { line.level };
                reflected_line(line, level, part, reflected.change)
            }));
        }
    }
    if is_mirrored && body.factor().is_none() && levels.contains(&0.0) {
        zero_line::complete(field, (body.view(), &body.lines), quantity, &mut all)?;
    }
    Ok(all)
}

/// A line of the body as one of a part; larger values stay on the left.
fn reflected_line(line: Isoline, level: f64, part: &BodyPart<'_>, change: ValueChange) -> Isoline {
    let mut points = line.points;
    if part.reflection != Reflection::NONE {
        points.iter_mut().for_each(|p| *p = part.reflection.vector(*p));
    }
    let [across, down] = part.flips();
    if (across != down) != (slope_sign(change) < 0.0) {
        points.reverse();
    }
    Isoline { level, points, ..line }
}

/// Tolerance for the rounding of values, relative to the largest one.
const ROUNDING: f64 = 1e-9;

/// Finds lines of levels, by the values' ends and the ends of their colours. Each line has the
/// level that was asked for.
pub(crate) fn between_ends<E>(
    levels: &[f64],
    (values, colors): ([f64; 2], [f64; 2]),
    find: impl FnOnce(&[f64]) -> Result<Vec<Isoline>, E>,
) -> Result<Vec<Isoline>, E> {
    let sizes = [values, colors].concat().into_iter().filter(|v| v.is_finite()).map(f64::abs);
    let reach = ROUNDING * sizes.fold(0.0, f64::max);
    let inside = |&level: &f64| match values {
        [min, _] if (level - min).abs() <= reach => min + reach,
        [_, max] if (level - max).abs() <= reach => max - reach,
        _ => level,
    };
    let inner: Vec<f64> = levels.iter().map(inside).collect();
    let mut lines = find(&inner)?;
    for line in &mut lines {
        if let Some(k) = inner.iter().position(|&level| level == line.level) {
            line.level = levels[k];
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Levels at the ends are looked for inside of the values, others where they are; lines have
    /// the levels that were asked for.
    #[test]
    fn levels_at_ends_are_moved_inside() {
        let mut random = Random(3);
        for _ in 0..100 {
            let (min, size) = (random.between(-2.0, 2.0), 10f64.powf(random.between(-9.0, 9.0)));
            let [low, high] = [min * size, (min + random.between(0.1, 3.0)) * size];
            let middle = 0.5 * (low + high);
            let noise = 1e-13 * size;
            let levels = [low - noise, middle, high + noise];
            let find = |inner: &[f64]| {
                assert!(inner[0] > low + noise && inner[2] < high - noise, "{inner:?}");
                assert!(inner[1] == middle && inner[0] < middle && middle < inner[2]);
                let line = |&level| Isoline { level, points: Vec::new(), closed: false };
                Ok::<_, ()>(inner.iter().map(line).collect())
            };
            let lines = between_ends(&levels, ([low, high], [low, high]), find).unwrap();
            assert!(lines.iter().map(|line| line.level).eq(levels));
            let find = |inner: &[f64]| {
                assert_eq!(inner[1..], levels[1..], "without an end there is none");
                Ok::<_, ()>(Vec::new())
            };
            let ends = ([low, f64::INFINITY], [low, high]);
            between_ends(&levels, ends, find).unwrap();
        }
    }
}
