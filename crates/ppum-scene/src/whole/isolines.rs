//! Isolines of the whole: those of the body and those of its images.

use std::borrow::Cow;

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, Reflection, ValueChange};
use ppum_figure::overlay::carried;
use ppum_render::RasterError;
use ppum_render::isoline::{Isoline, isolines as isolines_of_body};
use ppum_render::scatter::render;

use super::zero_line;
use crate::body::{BodyPart, BodyView};
use crate::drawing::RasterValues;
use crate::mirror::{MirrorLines, slope_sign};

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
            let found = match &*known {
                RasterValues::Double(raster) => {
                    isolines_of_body(field, &view, &reflected.quantity, &there, raster, watcher)?
                }
                RasterValues::Single(raster) => {
                    isolines_of_body(field, &view, &reflected.quantity, &there, raster, watcher)?
                }
            };
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
