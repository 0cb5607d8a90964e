//! Images of solutions.

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::Rect;
use ppum_figure::figure::{FigureStyle, Labels, Panel, figure, plot_area};
use ppum_figure::overlay;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::png;
use ppum_render::scale::Scale;
use ppum_render::scatter::render;
use ppum_render::view::View;
use std::path::Path;

const SIZE: [u32; 2] = [640, 480];

/// Draws the stress (the gradient of a potential) of a solution in a window, on a
/// logarithmic scale.
pub(crate) fn draw(path: &Path, dataset: &Dataset, window: Rect) -> anyhow::Result<()> {
    let field = Field::new(dataset, 0)?;
    let name = if field.components() == 2 { "von-mises" } else { "gradient" };
    let quantity = Quantity::parse(name, &field)?;
    let design = FigureStyle::pixels(SIZE);
    let view = View::hug(window, plot_area(&dataset.title, &design)?)?;
    let style = Style { scale: Scale::Log, ..Style::default() };
    let picture =
        ColoredRaster::bare(&render::<f64>(&field, &view, &quantity, unwatched())?, &view, &style)?;
    let labels = Labels {
        title: dataset.title.clone(),
        quantity: quantity.symbol(&field.data.components),
        ..Labels::default()
    };
    let texts = picture.description(&dataset.title, "", name);
    let cracks = &field.step.cracks;
    let (scale, holes) = (design.scale(), &field.domain.holes);
    let layers =
        [overlay::rims(&view, scale, holes, [None; 2]), overlay::cracks(&view, scale, cracks)];
    let panel = Panel {
        picture: &picture,
        layers: layers.concat(),
        legend: vec![],
        labels,
        cracks,
        bar_of: None,
    };
    let image = figure(panel, &design)?.image();
    std::fs::write(path, png::encode(&image, &texts)?)?;
    Ok(())
}
