//! Values and isolines of the deformed whole.

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_figure::overlay::carried;
use ppum_render::RenderError;
use ppum_render::deform::DeformError;
use ppum_render::isoline::{Isoline, isolines};
use ppum_render::scatter::render;

use super::drawn::reflected;
use super::isolines::reflected_line;
use crate::deformed;
use crate::drawing::{Drawn, Shown};
use crate::mirror::MirrorImage;
use crate::moved_body::{MovedBody, MovedImage};

/// Draws the deformed body and its images at the centres of pixels. Where parts lie over each other
/// the body itself is seen.
pub(crate) fn draw_moved<E: From<RenderError> + From<DeformError>>(
    body: &MovedBody<'_>,
    (field, shown): (&Field<'_>, &Shown),
    watcher: &dyn Watcher,
) -> Result<Drawn, E> {
    let mut whole = deformed::draw(&body.own, shown, watcher)?;
    for MovedImage { image, points } in &body.images {
        let (shown, change) = reflected(shown, image, field)?;
        let part = deformed::draw(points, &shown, watcher)?.flipped(image.flips(), change);
        let overlap = whole.pixels_with(&part).filter(|&[i, j]| !body.is_on_line(i, j));
        let columns = whole.view.pixels[0];
        let overlap: Vec<u32> = overlap.map(|[i, j]| j * columns + i).collect();
        whole.fill(part);
        whole.overlap.extend(overlap);
        whole.overlap.sort_unstable();
        whole.overlap.dedup();
    }
    Ok(whole)
}

/// Isolines of the deformed body and its images.
pub(crate) fn moved_isolines(
    body: &MovedBody<'_>,
    quantity: &Quantity,
    levels: &[f64],
    watcher: &dyn Watcher,
) -> Result<Vec<Isoline>, RenderError> {
    let mut all = Vec::new();
    // one level after the other: each keeps its number, however it is rounded
    let levels: Vec<&[f64]> = match body.images.is_empty() {
        true => vec![levels],
        false => levels.chunks(1).collect(),
    };
    for (reflection, points) in body.parts() {
        let Some(view) = points.material_view() else { continue };
        let field = points.view.field();
        let found = quantity.reflected(&reflection, field)?;
        let raster = render::<f64>(field, &view, &found.quantity, watcher)?;
        let image = MirrorImage { reflection, view };
        for levels in &levels {
            let there: Vec<f64> = levels.iter().map(|&level| found.change.apply(level)).collect();
            let lines = isolines(field, &view, &found.quantity, &there, &raster, watcher)?;
            let lines = carried(&points.view, &lines).into_iter();
            let level = |line: &Isoline| if let [only] = levels { *only } else { line.level };
            all.extend(lines.map(|line| {
                let level = level(&line);
                reflected_line(line, level, &image, found.change)
            }));
        }
    }
    Ok(all)
}
