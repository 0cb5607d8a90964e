//! The rings that stress intensity factors are integrated over.

use ppum::crack::Crack;
use ppum::dataset::TipIntensity;
use ppum_render::image::Rgba;
use ppum_render::view::View;

use super::strokes::circle;
use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};

const RING: Rgba = [225, 95, 20, 255];
const SEAM: Rgba = [255, 255, 255, 170];
const WIDTH: f64 = 1.2;

/// The borders of the rings of each tip: full lines around the disc that the integral covers,
/// dashed ones inside of which the cut-off function is one.
#[must_use]
pub fn rings(
    view: &View,
    scale: f64,
    cracks: &[Crack],
    intensities: &[TipIntensity],
) -> Vec<CanvasItem> {
    let (mut outer, mut inner) = (CanvasPath::default(), CanvasPath::default());
    for intensity in intensities {
        let Some(crack) = cracks.get(intensity.tip.crack as usize) else { continue };
        let tip = crack.end_point(intensity.tip.end);
        for ring in &intensity.rings {
            circle(view, tip, ring.r2).into_iter().for_each(|edge| outer.edge(edge));
            if ring.r1 > 0.0 {
                circle(view, tip, ring.r1).into_iter().for_each(|edge| inner.edge(edge));
            }
        }
    }
    let pen = StrokeStyle::new(RING, WIDTH * scale).with_halo(SEAM, 0.8 * scale);
    vec![
        CanvasItem::Line { path: outer, pen },
        CanvasItem::Line { path: inner, pen: pen.dashed(6.0 * scale, 4.0 * scale) },
    ]
}
