//! Isolines of the whole: those of the body and those of its images.

use ppum::progress::Watcher;
use ppum::quantity::{Reflection, ValueChange};
use ppum_render::RenderError;
use ppum_render::isoline::{Isoline, isolines as isolines_of_body};
use ppum_render::raster::{Raster, Sample};

use super::drawn::restricted;
use super::zero_line;
use crate::drawing::DrawingInput;
use crate::mirror::{MirrorImage, MirrorLines, slope_sign};

/// The lines on which a quantity has one of some values, of a body and of its images, if it is
/// mirrored. The values at the pixels are given.
pub(crate) fn isolines<T: Sample>(
    (job, lines): (DrawingInput<'_>, MirrorLines),
    levels: &[f64],
    raster: &Raster<T>,
    watcher: &dyn Watcher,
) -> Result<Vec<Isoline>, RenderError> {
    let DrawingInput { field, view, quantity } = job;
    if lines == MirrorLines::default() {
        return isolines_of_body(field, view, quantity, levels, raster, watcher);
    }
    let own = MirrorImage { reflection: Reflection::NONE, view: *view };
    let mut all = Vec::new();
    for image in [own].into_iter().chain(lines.images(view, &field.domain.body_bounds())) {
        let reflected = quantity.reflected(&image.reflection, field)?;
        let part = restricted(raster, &image, reflected.change, field);
        // one level after the other: each keeps its number, however it is rounded
        for &level in levels {
            let there = [reflected.change.apply(level)];
            let of = (field, &image.view, &reflected.quantity);
            let found = isolines_of_body(of.0, of.1, of.2, &there, &part, watcher)?;
            let line = |line: Isoline| reflected_line(line, level, &image, reflected.change);
            all.extend(found.into_iter().map(line));
        }
    }
    if levels.contains(&0.0) {
        zero_line::complete(field, (view, &lines), quantity, &mut all)?;
    }
    Ok(all)
}

/// A line of the body as one of an image; larger values stay on the left.
pub(super) fn reflected_line(
    line: Isoline,
    level: f64,
    image: &MirrorImage,
    change: ValueChange,
) -> Isoline {
    let mut points = line.points;
    points.iter_mut().for_each(|p| *p = image.reflection.vector(*p));
    let [across, down] = image.flips();
    if (across != down) != (slope_sign(change) < 0.0) {
        points.reverse();
    }
    Isoline { level, points, ..line }
}
