//! A picture of a scene from a view, made in one go.

use std::fmt::Write as _;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::text::trimmed;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, Design, FigureError, Labels, Panel, bare, figure, plot_area};
use ppum_render::RenderError;
use ppum_render::cells;
use ppum_render::colormap::ColormapError;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::picture::{Picture, Style};
use ppum_render::png::Text;
use ppum_render::range::{RangeError, Span};
use ppum_render::scatter::render;
use ppum_render::view::{View, ViewError};

use crate::deformed::{self, words};
use crate::drawing::{Drawn, PROCESSOR, Seen, Shown};
use crate::layers::{Ground, Layers, LayersError};
use crate::minus::{self, Minus, Side};
use crate::range;
use crate::scene::{Scene, ShownError, default_quantity, shown};
use crate::shared::Coloring;

/// A picture with what lies over it.
#[derive(Debug)]
pub struct Shot {
    /// What is shown.
    pub shown: Shown,
    /// The colours.
    pub picture: Picture,
    /// What lies over them.
    pub layers: Layers,
    /// What computed the values.
    pub by: String,
    /// How many times its displacement the plate is drawn with, if it is deformed.
    pub factor: Option<f64>,
}

/// The reason why there is no such picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShotError {
    /// Nothing that could be shown.
    #[error(transparent)]
    Shown(#[from] ShownError),
    /// The quantity, isolines, or a watcher that stopped it.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The deformed plate.
    #[error(transparent)]
    Deform(#[from] DeformError),
    /// The colour map.
    #[error(transparent)]
    Colormap(#[from] ColormapError),
    /// The range of the colours.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The overlays.
    #[error(transparent)]
    Layers(#[from] Box<LayersError>),
    /// The page.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The view.
    #[error(transparent)]
    View(#[from] ViewError),
}

/// Draws a scene's picture from a view on the processor, in double precision. The field is that of the scene's subject, see
/// [`Subject::apply`](crate::scene::Subject::apply). With something on the `left` that is subtracted, and the plate is as it was. With
/// the `design` of a figure its cracks are drawn whatever is asked for.
///
/// # Errors
/// What the field does not have; a range that does not fit; a watcher that stops it.
pub fn shot(
    dataset: &Dataset,
    (field, left): (&Field<'_>, Option<Side<'_>>),
    scene: &Scene,
    view: &View,
    design: Option<&Design>,
    watcher: &dyn Watcher,
) -> Result<Shot, ShotError> {
    shot_by(None, dataset, (field, left), scene, view, design, watcher)
}

/// The shot, its colours being those that are given.
fn shot_by(
    coloring: Option<&Coloring>,
    dataset: &Dataset,
    (field, left): (&Field<'_>, Option<Side<'_>>),
    scene: &Scene,
    view: &View,
    design: Option<&Design>,
    watcher: &dyn Watcher,
) -> Result<Shot, ShotError> {
    let shown = shown(scene.quantity.as_deref().unwrap_or(default_quantity(field)), field)?;
    let minus = left.map(|left| Minus { right: Side { field, shown: &shown }, left });
    let deformed = scene.deformed.filter(|_| minus.is_none());
    let factor = deformed.map(|factor| factor.number(&[field])).transpose()?;
    let seen = seen(field, view, factor, watcher)?;
    let (drawn, picture) = match (minus, coloring) {
        (Some(minus), _) => subtracted(minus, scene, view, watcher)?,
        (None, None) => colored(field, &seen, &shown, scene, watcher)?,
        (None, Some(coloring)) => {
            let drawn = drawn(field, &seen, &shown, watcher)?;
            let picture = coloring.picture(&drawn)?;
            (drawn, picture)
        }
    };
    // isolines are found of one field
    let (quantity, values) = (shown.quantity().filter(|_| minus.is_none()), &drawn.values);
    let ground = Ground {
        dataset,
        field,
        quantity,
        picture: &picture,
        values,
        design,
        has_bar: design.is_some_and(|design| design.bar != BarPlace::None),
    };
    let layers = scene.overlays.layers(ground, &seen, scene.outline, watcher).map_err(Box::new)?;
    drop(seen);
    Ok(Shot { shown, picture, layers, by: drawn.by, factor })
}

/// Values of a field with their colours.
fn colored(
    field: &Field<'_>,
    seen: &Seen<'_>,
    shown: &Shown,
    scene: &Scene,
    watcher: &dyn Watcher,
) -> Result<(Drawn, Picture), ShotError> {
    let drawn = drawn(field, seen, shown, watcher)?;
    let colormap = scene.colors.built_in(shown.quantity())?;
    let style = scene.colors.style_of([(shown, &drawn.values)], colormap);
    let span = span(field, seen, shown, &drawn, &style, watcher)?;
    let picture = drawn.picture(&style, span)?;
    Ok((drawn, picture))
}

/// The range of what is shown.
fn span(
    field: &Field<'_>,
    seen: &Seen<'_>,
    shown: &Shown,
    drawn: &Drawn,
    style: &Style,
    watcher: &dyn Watcher,
) -> Result<Span, ShotError> {
    Ok(match shown.quantity() {
        Some(quantity) => range::found(field, seen, quantity, drawn, style, watcher)?,
        None => drawn.span(style, None),
    })
}

/// What the values of a picture are, before it has colours: what is shown, its values, the style for it alone, its range.
pub(crate) fn uncolored(
    field: &Field<'_>,
    scene: &Scene,
    view: &View,
    watcher: &dyn Watcher,
) -> Result<(Shown, Drawn, Style, Span), ShotError> {
    let shown = shown(scene.quantity.as_deref().unwrap_or(default_quantity(field)), field)?;
    let factor = scene.deformed.map(|factor| factor.number(&[field])).transpose()?;
    let seen = seen(field, view, factor, watcher)?;
    let drawn = drawn(field, &seen, &shown, watcher)?;
    let style = scene.colors.style(shown.quantity(), scene.colors.built_in(shown.quantity())?);
    let span = span(field, &seen, &shown, &drawn, &style, watcher)?;
    drop(seen);
    Ok((shown, drawn, style, span))
}

/// A difference with its colours.
fn subtracted(
    minus: Minus<'_>,
    scene: &Scene,
    view: &View,
    watcher: &dyn Watcher,
) -> Result<(Drawn, Picture), ShotError> {
    let drawn = minus.draw(view, watcher)?.drawn;
    let style = minus.style(&scene.colors)?;
    let picture = drawn.picture(&style, minus::span(&drawn, &style))?;
    Ok((drawn, picture))
}

fn seen<'f>(
    field: &'f Field<'f>,
    view: &View,
    factor: Option<f64>,
    watcher: &dyn Watcher,
) -> Result<Seen<'f>, DeformError> {
    let Some(factor) = factor else { return Ok(Seen::Plate(*view)) };
    Ok(Seen::Moved(Deformation::new(field, factor)?.seen(view).points(watcher)?))
}

fn drawn(
    field: &Field<'_>,
    seen: &Seen<'_>,
    shown: &Shown,
    watcher: &dyn Watcher,
) -> Result<Drawn, ShotError> {
    Ok(match (seen, shown) {
        (Seen::Plate(view), Shown::Quantity(quantity)) => {
            let raster = render::<f64>(field, view, quantity, watcher)?;
            Drawn::new(raster, field, view, PROCESSOR)
        }
        (Seen::Plate(view), Shown::Cells(_, values)) => Drawn::of_cells(values, field, view),
        (Seen::Moved(points), shown) => deformed::draw(points, shown, watcher)?,
    })
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
    dataset: &Dataset,
    field: &Field<'_>,
    scene: &Scene,
    view: &View,
    design: &Design,
) -> Result<View, ShotError> {
    Ok(reshaped(view, plot_area(&title(dataset, field, scene)?, design)?)?)
}

/// The page of a scene's picture as a figure of a design, or bare without one, of the part of the plane that a view shows.
///
/// # Errors
/// As [`shot`]; a design without room.
pub fn page(
    dataset: &Dataset,
    (field, left): (&Field<'_>, Option<Side<'_>>),
    scene: &Scene,
    view: &View,
    design: Option<&Design>,
    watcher: &dyn Watcher,
) -> Result<(Canvas, Shot), ShotError> {
    let Some(design) = design else {
        let shot = shot(dataset, (field, left), scene, view, None, watcher)?;
        return Ok((bare(&shot.picture, shot.layers.items.clone()), shot));
    };
    let view = view_in(dataset, field, scene, view, design)?;
    figure_of(dataset, (field, left), scene, &view, design, watcher)
}

/// The page of a scene's picture as a figure of a design, the picture being that of the view, pixel for pixel: it need not fill the
/// design's room.
///
/// # Errors
/// As [`page`]; a picture that is larger than its room.
pub fn figure_of(
    dataset: &Dataset,
    (field, left): (&Field<'_>, Option<Side<'_>>),
    scene: &Scene,
    view: &View,
    design: &Design,
    watcher: &dyn Watcher,
) -> Result<(Canvas, Shot), ShotError> {
    figure_by(None, dataset, (field, left), scene, view, design, watcher)
}

/// The page of a scene's picture, its colours being those that are given, of a view: as a figure of a design that has room for it, or
/// bare.
pub(crate) fn page_by(
    coloring: &Coloring,
    dataset: &Dataset,
    field: &Field<'_>,
    scene: &Scene,
    view: &View,
    design: Option<&Design>,
    watcher: &dyn Watcher,
) -> Result<Canvas, ShotError> {
    let coloring = Some(coloring);
    if let Some(design) = design {
        let made = figure_by(coloring, dataset, (field, None), scene, view, design, watcher)?;
        return Ok(made.0);
    }
    let shot = shot_by(coloring, dataset, (field, None), scene, view, None, watcher)?;
    Ok(bare(&shot.picture, shot.layers.items))
}

fn figure_by(
    coloring: Option<&Coloring>,
    dataset: &Dataset,
    (field, left): (&Field<'_>, Option<Side<'_>>),
    scene: &Scene,
    view: &View,
    design: &Design,
    watcher: &dyn Watcher,
) -> Result<(Canvas, Shot), ShotError> {
    let title = title(dataset, field, scene)?;
    let shot = shot_by(coloring, dataset, (field, left), scene, view, Some(design), watcher)?;
    let labels = match left {
        None => labels(&shot.shown, title, field),
        Some(left) => {
            let minus = Minus { right: Side { field, shown: &shot.shown }, left };
            let [quantity, unit] = minus.words();
            Labels { title, quantity, unit, ..Labels::default() }
        }
    };
    let panel = Panel {
        picture: &shot.picture,
        layers: shot.layers.items.clone(),
        legend: shot.layers.legend.clone(),
        labels,
        cracks: &field.step.cracks,
        bar_of: None,
    };
    Ok((figure(panel, design)?, shot))
}

/// The title of a figure: that of the dataset, with the step of a series, the part, and the factor of the deformed plate.
pub(crate) fn title(
    dataset: &Dataset,
    field: &Field<'_>,
    scene: &Scene,
) -> Result<String, DeformError> {
    let mut title = of_step(dataset, scene.subject.step_of(dataset));
    let mut add = |text: String| title = format!("{title} ({text})").trim_start().to_owned();
    if let Some(part) = &scene.subject.part {
        add(format!("{part} only"));
    }
    if let Some(factor) = scene.deformed {
        add(words(factor.number(&[field])?));
    }
    Ok(title)
}

/// A dataset's title with the step, if there are several, and its load, if loads differ.
#[must_use]
pub fn of_step(dataset: &Dataset, step: usize) -> String {
    let mut title = dataset.title.clone();
    let Some(shown) = dataset.steps.get(step).filter(|_| dataset.steps.len() > 1) else {
        return title;
    };
    let gap = if title.is_empty() { "" } else { ", " };
    let _ = write!(title, "{gap}step {step}");
    if dataset.steps.iter().any(|other| other.load != shown.load) {
        let _ = write!(title, ", load {}", trimmed(shown.load));
    }
    title
}

/// The words of a figure of what is shown.
#[must_use]
pub fn labels(shown: &Shown, title: String, field: &Field<'_>) -> Labels {
    let (quantity, unit) = match shown {
        Shown::Quantity(quantity) => {
            (quantity.symbol(&field.data.components), quantity.unit(field).to_owned())
        }
        Shown::Cells(name, _) => (cells::label(name).to_owned(), String::new()),
    };
    Labels { title, quantity, unit, ..Labels::default() }
}

impl Shot {
    /// The texts of its file: what it shows, of which dataset, under which command.
    #[must_use]
    pub fn texts(&self, title: &str, file: &str, scene: &Scene, command: &str) -> Vec<Text> {
        let quantity = scene.quantity.as_deref().unwrap_or_default();
        let mut texts = self.picture.description(title, file, quantity);
        let mut add = |key: &str, text: String| texts.push((format!("ppum:{key}"), text));
        add("backend", self.by.clone());
        add("command", command.to_owned());
        if let Some(factor) = self.factor {
            add("deformed", format!("{factor:?}"));
        }
        texts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::overlays::{Levels, Overlay, Overlays, SPACING};
    use ppum::progress::unwatched;
    use ppum_figure::canvas::Item;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    use crate::deformed::Factor;

    /// Widths of all lines of a page, and sizes of its letters.
    fn widths(page: &Canvas) -> Vec<f64> {
        let of = |item: &Item| match item {
            Item::Line { pen, .. } => {
                vec![pen.width, pen.halo.map_or(0.0, |h| h.width), pen.dashes.map_or(0.0, |d| d[0])]
            }
            Item::Text(line) => vec![line.size],
            Item::Inset { canvas, .. } => widths(canvas),
            _ => Vec::new(),
        };
        page.items.iter().flat_map(of).collect()
    }

    /// Strokes and letters, those over the picture too, are lengths on paper: the same at any number of pixels per inch.
    #[test]
    fn strokes_are_lengths_on_paper() {
        for seed in 0..4 {
            let recipe = Recipe { components: 2, ..Recipe::random(seed) };
            let dataset = Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let overlays = Overlays {
                shown: vec![Overlay::Patches, Overlay::Points, Overlay::Centers, Overlay::Rings],
                isolines: Some(Levels::Count(4)),
                level_labels: true,
                arrows: Some(SPACING),
                crosses: Some(SPACING),
            };
            let deformed = (seed % 2 == 1).then_some(Factor::Given(0.02));
            let scene =
                Scene { overlays, deformed, quantity: Some("ux".into()), ..Scene::default() };
            let on_paper = |dpi: f64| {
                let design = Design::inches([3.4, 2.6], dpi);
                let view = View::fit(dataset.domain.bounds, [340, 260]).unwrap();
                let made = page(
                    &dataset,
                    (&field, None),
                    &scene.drawn(),
                    &view,
                    Some(&design),
                    unwatched(),
                );
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
