//! Legends for which there is no room in a plot: beside it, or above it.

use ppum::vec2::{Vec2, vec2};

use super::ink::Ink;
use super::metrics::GAP;
use crate::overlay::{LegendBox, LegendEntry};

/// Between a plot and a legend beside it or above it.
const AWAY: f64 = 12.0;
/// Sizes in parts of the usual one, the first that fits is taken.
const SIZES: [f64; 3] = [1.0, 0.85, 0.7];

/// A legend outside of its plot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Legend<'a> {
    legend: LegendBox<'a>,
    is_beside: bool,
    scale: f64,
}

/// The room that a legend may take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Free {
    /// Right of the plot, before its bar, and how high.
    pub(super) beside: [f64; 2],
    /// From the plot's left to the panel's right, and above all that reaches above the plot.
    pub(super) above: [f64; 2],
}

impl<'a> Legend<'a> {
    /// The place of a legend in the free room; none without entries, or without room.
    pub(super) fn new(entries: &'a [LegendEntry], free: Free, scale: f64) -> Option<Self> {
        let of = |scale: f64| {
            let legend = LegendBox::new(entries, scale);
            let (size, away) = (legend.size(), AWAY * scale);
            let fits = |size: Vec2, room: [f64; 2]| size.x <= room[0] && size.y <= room[1];
            let is_beside = fits(size + vec2(away, 0.0), free.beside);
            let is_above = fits(size + vec2(0.0, away), free.above);
            (is_beside || is_above).then_some(Self { legend, is_beside, scale })
        };
        let sizes = SIZES.into_iter().filter(|_| !entries.is_empty());
        sizes.map(|part| part * scale).find_map(of)
    }

    /// Draws a legend that stands beside a plot; returns where that and it end at the right.
    pub(super) fn draw_beside(&self, ink: &mut Ink, [min, max]: [Vec2; 2]) -> Vec2 {
        if !self.is_beside {
            return max;
        }
        let corner = vec2((max.x + AWAY * self.scale).round(), min.y);
        ink.items.extend(self.legend.items(corner));
        vec2(corner.x + self.legend.size().x, max.y)
    }

    /// Draws a legend that stands above a plot and all that reaches above that, up to `top`.
    pub(super) fn draw_above(&self, ink: &mut Ink, left: f64, top: f64) {
        if !self.is_beside {
            let height = self.legend.size().y + (AWAY - GAP) * self.scale;
            let corner = vec2(left, (top - height).round());
            ink.items.extend(self.legend.items(corner));
        }
    }
}
