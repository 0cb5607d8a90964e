//! View boxes: the map from the user units of a page, a nested `<svg>` or a `<symbol>` to those
//! around it (SVG 2, sections 8.2 and 8.6).

use ppum::vec2::{Vec2, vec2};
use roxmltree::Node;

use super::number;
use super::shape::lengths;
use crate::affine::PlaneMap;

/// A rectangle, and the view box that is shown in it.
pub(super) struct Viewport {
    /// The lower corner of the rectangle, and its sides.
    rectangle: [Vec2; 2],
    /// The lower corner of the view box, and its sides.
    view: [Vec2; 2],
    /// `preserveAspectRatio`.
    aspect: String,
}

impl Viewport {
    /// The page, whose user units are those of the drawing.
    pub(super) fn of_page(root: Node<'_, '_>) -> Result<Self, String> {
        let side = |key: &str| root.attribute(key).and_then(|text| number::length(text, 0.0));
        let size = ["width", "height"].map(|key| side(key).unwrap_or(0.0));
        Self::new(root, [Vec2::ZERO, vec2(size[0], size[1])])
    }

    /// A nested element. Its sides are those of the `<use>` that draws it, else its own, else
    /// those of the view box around it.
    pub(super) fn nested(
        node: Node<'_, '_>,
        used_by: Option<Node<'_, '_>>,
        around: Vec2,
    ) -> Result<Self, String> {
        let at = lengths(node, around, ["x", "y"])?;
        let mut sides = [around.x, around.y];
        for given in [Some(node), used_by].into_iter().flatten() {
            let own = lengths(given, around, ["width", "height"])?;
            for (side, own) in sides.iter_mut().zip(own).filter(|(_, own)| *own > 0.0) {
                *side = own;
            }
        }
        Self::new(node, [vec2(at[0], at[1]), vec2(sides[0], sides[1])])
    }

    fn new(node: Node<'_, '_>, rectangle: [Vec2; 2]) -> Result<Self, String> {
        let numbers = node.attribute("viewBox").map(number::numbers);
        let view = match numbers.as_ref().map(Option::as_deref) {
            None => [Vec2::ZERO, rectangle[1]],
            Some(Some(&[x, y, width, height])) => [vec2(x, y), vec2(width, height)],
            Some(_) => return Err("`viewBox` is not four numbers; repair the file".to_owned()),
        };
        let aspect = node.attribute("preserveAspectRatio").unwrap_or_default().to_owned();
        Ok(Self { rectangle, view, aspect })
    }

    /// The sides of the view box.
    pub(super) fn size(&self) -> Vec2 {
        self.view[1]
    }

    /// The lower edge of the view box, where y points down.
    pub(super) fn bottom(&self) -> f64 {
        self.view[0].y + self.view[1].y
    }

    /// The map from the view box to the rectangle.
    pub(super) fn map(&self) -> PlaneMap {
        let [at, sides] = self.rectangle;
        let ratio = vec2(sides.x / self.view[1].x, sides.y / self.view[1].y);
        if !(ratio.x > 0.0 && ratio.y > 0.0 && ratio.x.is_finite() && ratio.y.is_finite()) {
            return PlaneMap::shifting(at - self.view[0]);
        }
        let has = |word: &str| self.aspect.contains(word);
        let (low, high) = (ratio.x.min(ratio.y), ratio.x.max(ratio.y));
        let scale = match (has("none"), has("slice")) {
            (true, _) => ratio,
            (false, true) => vec2(high, high),
            (false, false) => vec2(low, low),
        };
        let place = |min: &str, max: &str| match (has(min), has(max)) {
            (true, _) => 0.0,
            (_, true) => 1.0,
            _ => 0.5,
        };
        let free = sides - vec2(scale.x * self.view[1].x, scale.y * self.view[1].y);
        let shift = vec2(place("xMin", "xMax") * free.x, place("YMin", "YMax") * free.y);
        let map = PlaneMap { shift: at + shift, ..PlaneMap::scaling(scale.x, scale.y) };
        map.after(&PlaneMap::shifting(-self.view[0]))
    }
}
