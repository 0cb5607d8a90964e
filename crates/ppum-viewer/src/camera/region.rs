//! Where a body is in the window: all of it, or a place that can be shown.

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::view::View;

use crate::session::VisibleRegion;

/// Room around the whole body, in parts of its size.
const ROOM: f64 = 0.03;
/// The largest and the smallest width, in parts of the body's size.
const WIDEST: f64 = 20.0;
const NARROWEST: f64 = 1e-12;
/// Doubles in the narrowest view of a body that lies far from the origin: about one a pixel.
const COARSEST: f64 = 2048.0;

/// The view of a place, or of the whole body beside the last `taken` columns; none of a body
/// without size.
#[must_use]
pub fn view(
    place: Option<VisibleRegion>,
    whole: Rect,
    pixels: [u32; 2],
    taken: u32,
) -> Option<View> {
    if let Some(place) = place {
        return place.view(pixels).ok();
    }
    let room = whole.size() * ROOM;
    let all = Rect::new(whole.min - room, whole.max + room);
    let middle = View::fit(all, pixels).ok()?;
    let free = 0.5 * (middle.width - all.size().x) / middle.pixel_size();
    if free >= f64::from(taken) || 2 * taken > pixels[0] {
        return Some(middle);
    }
    let beside = View::fit(all, [pixels[0] - taken, pixels[1]]).ok()?;
    let pixel = beside.pixel_size();
    let center = beside.center + vec2(0.5 * f64::from(taken) * pixel, 0.0);
    View::new(center, f64::from(pixels[0]) * pixel, pixels).ok()
}

/// A place that can be shown: no wider than the body many times, no narrower than doubles tell
/// pixels apart, never beside the body.
#[must_use]
pub(super) fn bounded(place: VisibleRegion, bounds: &Rect) -> VisibleRegion {
    let size = bounds.size().x.max(bounds.size().y);
    let ends = [bounds.min.x, bounds.max.x, bounds.min.y, bounds.max.y];
    let far = ends.into_iter().map(f64::abs).fold(0.0, f64::max);
    let narrowest = (NARROWEST * size).max(COARSEST * f64::EPSILON * far);
    let width = place.width.clamp(narrowest, (WIDEST * size).max(narrowest));
    let center = place.center().max(bounds.min).min(bounds.max);
    VisibleRegion { center: center.into(), width }
}

/// True if a place is one of this body: something of it may be seen there, and pixels are told
/// apart.
pub(crate) fn is_of(place: VisibleRegion, bounds: &Rect) -> bool {
    let nearest = bounded(place, bounds);
    let is_near = (place.center() - nearest.center()).length() <= WIDEST * bounds.size().length();
    let is_wide = (SLACK.recip()..=SLACK).contains(&(place.width / nearest.width));
    is_near && is_wide
}

/// How far beyond what can be shown a width may lie: the body may have been written again, a
/// little larger.
const SLACK: f64 = 100.0;

/// The place after a zoom at an offset from the view's centre, which stays where it is: by the
/// factor, or by what the limits leave of it. True if they have left less of an enlargement.
#[must_use]
pub(super) fn zoomed(
    view: &View,
    offset: Vec2,
    factor: f64,
    bounds: &Rect,
) -> (VisibleRegion, bool) {
    let at =
        |center: Vec2, width: f64| bounded(VisibleRegion { center: center.into(), width }, bounds);
    let width = at(view.center, view.width / factor).width;
    if width == view.width {
        return (VisibleRegion { center: view.center.into(), width }, width > view.width / factor);
    }
    let shift = offset * (1.0 - width / view.width);
    (at(view.center + shift, width), width > view.width / factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    #[test]
    fn whatever_notches_are_turned_the_point_below_the_pointer_stays() {
        let mut random = Random(11);
        let bounds = Rect::new(vec2(-1.0, -0.5), vec2(1.0, 0.5));
        let mut clipped = [0; 2];
        for _ in 0..200 {
            let mut view = view(None, bounds, [900, 600], 0).expect("a plate with a size");
            let pixel = vec2(random.between(300.0, 600.0), random.between(200.0, 400.0));
            let down = if random.unit() < 0.5 { 1.0 } else { -1.0 };
            for _ in 0..60 {
                let factor = (down * random.between(-0.5, 2.0)).exp();
                let offset = view.offset_at(pixel);
                let below = view.center + offset;
                let (place, _) = zoomed(&view, offset, factor, &bounds);
                let refused = (place.width * factor / view.width - 1.0).abs() > 1e-9;
                clipped[usize::from(down > 0.0)] += usize::from(refused);
                let after = super::view(Some(place), bounds, view.pixels, 0).expect("a place");
                let shift = below - (after.center + after.offset_at(pixel));
                // only the body's border may hold the middle back
                let is_free = bounds.contains(below + offset * (-after.width / view.width));
                if is_free {
                    assert!(shift.length() <= 1.1 * after.pixel_size(), "{shift:?} {place:?}");
                }
                if refused && after.width == view.width && is_free {
                    assert_eq!(after.center, view.center);
                }
                view = after;
            }
        }
        assert!(clipped.into_iter().all(|count| count > 100), "{clipped:?}");
    }

    #[test]
    fn whatever_is_asked_for_can_be_shown() {
        let mut random = Random(5);
        for _ in 0..2000 {
            let size = 10f64.powf(random.between(-12.0, 12.0));
            let corner = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0))
                * (size * 10f64.powf(random.between(-3.0, 8.0)));
            let bounds = Rect::new(corner, corner + vec2(size, size * random.between(0.02, 1.0)));
            let size = bounds.size();
            if !(size.x > 0.0 && size.y > 0.0) {
                continue;
            }
            let width = 10f64.powf(random.between(-300.0, 300.0));
            let far = 10f64.powf(random.between(-10.0, 200.0));
            let center = [random.between(-far, far), random.between(-far, far)];
            let place = bounded(VisibleRegion { center, width }, &bounds);
            let view = view(Some(place), bounds, [1280, 800], 0);
            assert!(view.is_some_and(|view| view.rect().overlaps(&bounds)), "{bounds:?} {place:?}");
        }
    }

    #[test]
    fn the_whole_plate_is_seen_beside_what_is_taken() {
        let mut random = Random(6);
        for _ in 0..500 {
            let size = vec2(random.between(0.01, 1.0), random.between(0.01, 1.0));
            let corner = vec2(random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            let (whole, pixels) =
                (Rect::new(corner, corner + size), [200 + random.below(900) as u32, 300]);
            let taken = random.below(100) as u32;
            let view = view(None, whole, pixels, taken).unwrap();
            let [low, high] = [whole.min, whole.max].map(|corner| view.pixel(corner));
            let right = f64::from(pixels[0] - taken);
            assert!(
                low.x > 0.0 && high.x < right && high.y > 0.0 && low.y < 300.0,
                "{whole:?} {pixels:?}"
            );
        }
    }
}
