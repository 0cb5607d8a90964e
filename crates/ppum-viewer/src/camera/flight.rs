//! Flights from one place to another: out, across and in, along the shortest way in scale and place
//! (van Wijk and Nuij 2003, "Smooth and efficient zooming and panning").

use ppum::vec2::Vec2;

use crate::session::VisibleRegion;

/// A flight that has begun.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    from: VisibleRegion,
    to: VisibleRegion,
    /// The location that is set at the end: none for the whole body.
    pub(super) end: Option<VisibleRegion>,
    /// When it began, and what it takes \[s\], by the window's clock.
    began: f64,
    takes: f64,
}

/// How much a flight rises before it moves on: the ρ of the paper.
const RHO: f64 = 1.42;
/// Seconds per unit of way, and the longest flight \[s\].
const PACE: f64 = 0.12;
const LONGEST: f64 = 2.0;

impl Flight {
    /// A flight that begins at a time.
    pub(super) fn new(
        from: VisibleRegion,
        to: VisibleRegion,
        end: Option<VisibleRegion>,
        now: f64,
    ) -> Self {
        let takes = (PACE * FlightPath::new(from, to).length).clamp(0.0, LONGEST);
        Self { from, to, end, began: now, takes }
    }

    /// Where it is; nothing once it has ended.
    pub(super) fn at(&self, now: f64) -> Option<VisibleRegion> {
        let part = (now - self.began) / self.takes;
        if part.is_nan() || part >= 1.0 {
            return None;
        }
        // slow at both ends
        let eased = part * part * (3.0 - 2.0 * part);
        let place = FlightPath::new(self.from, self.to).at(eased);
        // between places that are too far apart there is no way
        let is_finite = place.width > 0.0 && place.width.is_finite() && place.center().is_finite();
        is_finite.then_some(place)
    }
}

/// The way between two places.
struct FlightPath {
    from: VisibleRegion,
    to: VisibleRegion,
    /// Distance of the centres.
    distance: f64,
    /// Its length, in the metric that counts moves by the width and scales by their logarithm.
    length: f64,
    start: f64,
}

impl FlightPath {
    fn new(from: VisibleRegion, to: VisibleRegion) -> Self {
        let distance = (to.center() - from.center()).length();
        let (w0, w1) = (from.width, to.width);
        let (start, length) = if distance < 1e-9 * w0.min(w1) {
            (0.0, (w1 / w0).ln().abs() / RHO)
        } else {
            let b = |sign: f64, w: f64| {
                (w1 * w1 - w0 * w0 + sign * RHO.powi(4) * distance * distance)
                    / (2.0 * w * RHO * RHO * distance)
            };
            let r = |b: f64| -(b.asinh());
            let (r0, r1) = (r(b(1.0, w0)), r(b(-1.0, w1)));
            (r0, (r1 - r0) / RHO)
        };
        Self { from, to, distance, length, start }
    }

    /// The place at a part of the way, 0 to 1.
    fn at(&self, part: f64) -> VisibleRegion {
        let (from, to) = (self.from.center(), self.to.center());
        if self.distance < 1e-9 * self.from.width.min(self.to.width) {
            let width = self.from.width * (self.to.width / self.from.width).powf(part);
            return VisibleRegion { center: (from + (to - from) * part).into(), width };
        }
        let s = part * self.length;
        let (r0, w0) = (self.start, self.from.width);
        let way = w0 / (RHO * RHO) * (r0.cosh() * (RHO * s + r0).tanh() - r0.sinh());
        let width = w0 * r0.cosh() / (RHO * s + r0).cosh();
        let center: Vec2 = from + (to - from) * (way / self.distance).clamp(0.0, 1.0);
        VisibleRegion { center: center.into(), width }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, width: f64) -> VisibleRegion {
        VisibleRegion { center: [x, 0.5], width }
    }

    #[test]
    fn a_flight_begins_and_ends_where_it_should() {
        for (a, b) in [
            (place(0.0, 2.0), place(0.5, 1e-9)),
            (place(0.5, 1e-9), place(-0.3, 1e-9)),
            (place(0.1, 1.0), place(0.1, 1e-12)),
            (place(0.5, 1e-6), place(0.0, 3.0)),
        ] {
            let path = FlightPath::new(a, b);
            for (part, want) in [(0.0, a), (1.0, b)] {
                let found = path.at(part);
                assert!((found.width / want.width - 1.0).abs() < 1e-6, "{a:?} {b:?} {found:?}");
                let miss = (found.center() - want.center()).length();
                assert!(miss < 1e-3 * want.width.max(1e-10), "{a:?} {b:?} {found:?}");
            }
            assert!(path.length.is_finite() && path.length >= 0.0);
        }
    }

    #[test]
    fn between_far_tips_it_rises() {
        let path = FlightPath::new(place(-0.5, 1e-6), place(0.5, 1e-6));
        assert!(path.at(0.5).width > 0.1);
    }
}
