//! Images and pages of requests from views.

use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{FigureStyle, plot_area};
use ppum_render::view::{View, ViewError};

use super::{FieldSource, ImageError, QuantityRequest, RenderedImage, title};
use crate::body::BodyView;
use crate::engine::Engine;
use crate::request::Request;

/// Draws an image from a view.
///
/// # Errors
/// Features that the field does not have; a range that does not fit; a watcher that stops it.
pub fn shot(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: Option<&FigureStyle>,
    engine: &Engine<'_>,
) -> Result<RenderedImage, ImageError> {
    let asked = QuantityRequest::new(&request.scene, source.field)?;
    let seen = source.seen(&request.scene, view, engine)?;
    source.input(&asked, &seen).draw(request, design, engine)
}

/// The view of the same part of the plane, or more where the shapes differ, on other pixels.
///
/// # Errors
/// As [`View::new`].
pub fn reshaped(view: &View, pixels: [u32; 2]) -> Result<View, ViewError> {
    let aspect = f64::from(pixels[0]) / f64::from(pixels[1].max(1));
    View::new(view.center, view.width.max(view.height() * aspect), pixels)
}

/// The view of a figure of a design that shows the part of the plane that a view shows, or more.
///
/// # Errors
/// As [`page`].
pub fn view_in(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: &FigureStyle,
) -> Result<View, ImageError> {
    Ok(reshaped(view, plot_area(&title(source, request)?, design)?)?)
}

/// The page of an image as a figure of a design, or bare without one, of the part of the plane
/// that a view shows.
///
/// # Errors
/// As [`shot`]; a design without room.
pub fn page(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: Option<&FigureStyle>,
    engine: &Engine<'_>,
) -> Result<(Canvas, RenderedImage), ImageError> {
    let of_design = |design| view_in(source, request, view, design);
    let view = design.map_or(Ok(*view), of_design)?;
    let seen = source.seen(&request.scene, &view, engine)?;
    page_seen(source, request, &seen, design, engine)
}

/// The page of an image of what is seen.
///
/// # Errors
/// As [`page`]; an image that is larger than its room.
pub fn page_seen(
    source: FieldSource<'_>,
    request: &Request,
    seen: &BodyView<'_>,
    design: Option<&FigureStyle>,
    engine: &Engine<'_>,
) -> Result<(Canvas, RenderedImage), ImageError> {
    let asked = QuantityRequest::new(&request.scene, source.field)?;
    let shot = source.input(&asked, seen).draw(request, design, engine)?;
    source.page(shot, request, design, engine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::overlays::{IsolineLevels, Overlay, Overlays, SPACING};
    use crate::scene::SceneRequest;
    use ppum::field::Field;
    use ppum_figure::canvas::CanvasItem;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    use crate::deformed::Magnification;

    /// Widths of all lines of a page, and sizes of its letters.
    fn widths(page: &Canvas) -> Vec<f64> {
        let of = |item: &CanvasItem| match item {
            CanvasItem::Line { pen, .. } => {
                vec![pen.width, pen.halo.map_or(0.0, |h| h.width), pen.dashes.map_or(0.0, |d| d[0])]
            }
            CanvasItem::Text(line) => vec![line.size],
            CanvasItem::Inset { canvas, .. } => widths(canvas),
            _ => Vec::new(),
        };
        page.items.iter().flat_map(of).collect()
    }

    /// Strokes and letters, those over the image too, are lengths on paper: the same at any
    /// number of pixels per inch.
    #[test]
    fn strokes_are_lengths_on_paper() {
        for seed in 0..4 {
            let recipe = Recipe { components: 2, ..Recipe::random(seed) };
            let dataset = Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let overlays = Overlays {
                shown: vec![Overlay::Patches, Overlay::Points, Overlay::Centers, Overlay::Rings],
                no_cracks: false,
                isolines: Some(IsolineLevels::Count(4)),
                level_labels: true,
                arrows: Some(SPACING),
                crosses: Some(SPACING),
            };
            let deformed = (seed % 2 == 1).then_some(Magnification::Given(0.02));
            let scene = SceneRequest {
                overlays,
                deformed,
                quantity: Some("ux".into()),
                ..SceneRequest::default()
            };
            let on_paper = |dpi: f64| {
                let design = FigureStyle::inches([3.4, 2.6], dpi);
                let view = View::fit(dataset.domain.bounds, [340, 260]).unwrap();
                let (source, request) = (FieldSource::of(&dataset, &field), scene.drawn().into());
                let made = page(source, &request, &view, Some(&design), &Engine::default());
                let mut all = widths(&made.unwrap().0);
                all.iter_mut().for_each(|width| *width *= 72.0 / dpi);
                all.sort_by(f64::total_cmp);
                all.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
                all
            };
            let [screen, print] = [96.0, 300.0].map(on_paper);
            assert!(screen.len() > 3, "{screen:?}");
            let is_in = |width: &f64| print.iter().any(|other| (other - width).abs() < 1e-9);
            assert!(screen.iter().all(is_in), "seed {seed}: {screen:?} {print:?}");
        }
    }
}
