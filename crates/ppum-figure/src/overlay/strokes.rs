//! Lines of cracks and rims: their colours, widths and arcs.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::view::View;

/// Dark line of a crack, and the light seam that parts it from dark colours.
pub(super) const CRACK: Rgba = [16, 16, 20, 255];
pub(super) const SEAM: Rgba = [255, 255, 255, 150];
/// Widths and radii in pixels of a bare image of at most 1024 × 768.
pub(super) const CRACK_WIDTH: f64 = 1.8;
pub(super) const TIP_RADIUS: f64 = 3.0;
pub(super) const RIM_WIDTH: f64 = 1.0;
pub(super) const SEAM_WIDTH: f64 = 1.0;

/// Points of the part of a circle in or near the view, in continuous pixel coordinates.
pub(super) fn arc(view: &View, center: Vec2, radius: f64) -> Vec<Vec2> {
    let from = view.center - center;
    let far = from.length();
    let toward = if far > 0.0 { from / far } else { vec2(1.0, 0.0) };
    let reach = 2.0 * view.half().length();
    if (far - radius).abs() > reach {
        return Vec::new();
    }
    // Chords that leave the arc by less than a tenth of a pixel.
    let half_angle = 2.0 * (reach / radius).min(1.0).asin();
    let step = (0.8 * view.pixel_size() / radius).sqrt();
    let count = (half_angle / step).ceil().max(4.0) as i32;
    let at = |k: i32| {
        let angle = half_angle * f64::from(k) / f64::from(count);
        // The point minus the nearest one of the circle, without cancellation.
        let beside = toward.left() * angle.sin() - toward * (2.0 * (0.5 * angle).sin().powi(2));
        view.pixel_of_offset(toward * (radius - far) + beside * radius)
    };
    (-count..=count).map(at).collect()
}
