//! Points for arrows and crosses, with their values: vectors, and principal stresses with
//! their directions.
//!
//! The points are those of a [`GlyphLattice`] that lie in the view and on the body. It is at rest
//! in the world: its points are multiples of the spacing from the origin, so panning moves the
//! arrows with the field, and no arrow jumps. Values are evaluated at the points, each by itself;
//! those that are not finite, as stresses at a tip, have no glyph.
//!
//! A point on a crack stands for one of its faces: that on the left of the crack's direction, and
//! says so.

use ppum::crack::{SegmentId, Side};
use ppum::field::{Field, LocalField};
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, Reflection};
use ppum::sides::Segments;
use ppum::vec2::{Vec2, vec2};
use ppum_raster::RasterError;
use ppum_raster::parts::Parts;
use ppum_raster::view::View;
use rayon::prelude::*;

use crate::deform::DeformedPoints;

/// Least distance of the points, pixels.
pub const LEAST_SPACING: f64 = 4.0;

/// A point with a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glyph<V> {
    /// Its offset from the view's centre.
    pub offset: Vec2,
    /// The value there.
    pub value: V,
    /// The face that it stands for, if it lies on a crack.
    pub face: Option<(SegmentId, Side)>,
}

/// Principal stresses in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principal {
    /// The larger one.
    pub s1: f64,
    /// The smaller one.
    pub s2: f64,
    /// Angle of the direction of σ₁ from the x axis, in (−π/2, π/2]; σ₂ is perpendicular.
    pub angle: f64,
}

/// The points of a lattice in an image, with the points of the body that are seen there; row by
/// row from below.
#[derive(Clone, Debug)]
pub struct GlyphLattice<'f> {
    field: &'f Field<'f>,
    /// The point of the body that [`LatticePoint::point`] is counted from.
    anchor: Vec2,
    rows: Vec<Vec<LatticePoint>>,
}

/// Distance from a line of symmetry \[pixels\] that is rounding.
const ON_LINE: f64 = 1e-6;

/// A position in the view, and the point of the body that is there.
#[derive(Clone, Copy, Debug)]
struct LatticePoint {
    /// Its offset from the view's centre.
    at: Vec2,
    /// The point of the body that is there, as an offset from the anchor.
    point: Vec2,
}

impl Glyph<Vec2> {
    /// The vector of the reflected field.
    #[must_use]
    pub fn reflected(self, reflection: &Reflection) -> Self {
        Self { value: reflection.vector(self.value) * reflection.sign(), ..self }
    }
}

impl Glyph<Principal> {
    /// The principal stresses of the reflected field.
    #[must_use]
    pub fn reflected(self, reflection: &Reflection) -> Self {
        let Principal { s1, s2, angle } = self.value;
        let [s1, s2] = if reflection.is_odd { [-s2, -s1] } else { [s1, s2] };
        let angle = reflection.direction().apply(angle);
        Self { value: Principal { s1, s2, angle }, ..self }
    }
}

impl<'f> GlyphLattice<'f> {
    /// The lattice with a spacing in pixels, at least [`LEAST_SPACING`], on the undeformed body.
    #[must_use]
    pub fn new(field: &'f Field<'f>, view: &View, spacing: f64) -> Self {
        let [x, y] = lines(view, spacing);
        let row = |&y: &f64| {
            x.iter().map(|&x| vec2(x, y)).map(|at| LatticePoint { at, point: at }).collect()
        };
        Self { field, anchor: view.center, rows: y.iter().map(row).collect() }
    }

    /// The points of the same lattice beyond lines of symmetry, where the body is that of the
    /// [reflected](View::reflected) view; points on the lines are the body's own.
    #[must_use]
    pub fn reflected(
        field: &'f Field<'f>,
        view: &View,
        reflection: &Reflection,
        spacing: f64,
    ) -> Self {
        let mut lattice = Self::new(field, view, spacing);
        lattice.anchor = view.reflected(reflection.lines).center;
        let near = ON_LINE * view.pixel_size();
        let is_on = |line: Option<f64>, x: f64| line.is_some_and(|line| (x - line).abs() <= near);
        let [x, y] = reflection.lines;
        let is_own = |p: Vec2| is_on(x, p.x) || is_on(y, p.y);
        for row in &mut lattice.rows {
            row.retain(|place| !is_own(view.center + place.at));
            row.iter_mut().for_each(|place| place.point = reflection.vector(place.at));
        }
        lattice
    }

    /// The lattice on the deformed body, at rest in the deformed plane: the centres of the pixels
    /// that its points lie in, and the points of the body that are seen there. For a mirrored
    /// image of the body, which is that of the reflected view, the points are reflected back.
    #[must_use]
    pub fn deformed(points: &DeformedPoints<'f>, reflection: &Reflection, spacing: f64) -> Self {
        let view = &points.view.view;
        let [x, y] = lines(view, spacing);
        let place = |x: f64, y: f64| {
            let [i, j] = <[f64; 2]>::from(view.pixel_of_offset(vec2(x, y)));
            let last = view.pixels.map(|n| n - 1);
            let [i, j] = [(i as u32).min(last[0]), (j as u32).min(last[1])];
            let point = points.at(i, j).first()?.offset;
            Some(LatticePoint { at: reflection.vector(view.offset(i, j)), point })
        };
        let row = |&y: &f64| x.iter().filter_map(|&x| place(x, y)).collect();
        let rows = y.iter().map(row).collect();
        Self { field: points.view.field(), anchor: points.view.anchor, rows }
    }

    /// Vectors of two quantities, such as `ux` and `uy`.
    ///
    /// # Errors
    /// A quantity has no meaning for the field; the watcher stops the call.
    pub fn vectors(
        &self,
        quantities: &[Quantity; 2],
        watcher: &dyn Watcher,
    ) -> Result<Vec<Glyph<Vec2>>, RasterError> {
        self.glyphs(quantities, watcher, |[x, y]| vec2(x, y))
    }

    /// Principal stresses, those at the points of the body in its undeformed directions.
    ///
    /// # Errors
    /// The field has no stresses; the watcher stops the call.
    pub fn principal(&self, watcher: &dyn Watcher) -> Result<Vec<Glyph<Principal>>, RasterError> {
        let field = self.field;
        let named = |name| Quantity::parse(name, field);
        let quantities = [named("s1")?, named("s2")?, named("direction")?];
        let value = |[s1, s2, angle]: [f64; 3]| Principal { s1, s2, angle };
        self.glyphs(&quantities, watcher, value)
    }

    fn glyphs<const N: usize, V: Send>(
        &self,
        quantities: &[Quantity; N],
        watcher: &dyn Watcher,
        value: impl Fn([f64; N]) -> V + Sync,
    ) -> Result<Vec<Glyph<V>>, RasterError> {
        quantities.iter().try_for_each(|quantity| quantity.check(self.field))?;
        let parts = Parts::start(watcher, self.rows.len())?;
        let segments = Segments::new(&self.field.step.cracks);
        let row = |row: &Vec<LatticePoint>| {
            let mut local = self.field.at(self.anchor);
            let glyph = |place| self.glyph(&segments, &mut local, place, quantities, &value);
            let row: Vec<_> = row.iter().filter_map(glyph).collect();
            parts.finish_one().map(|()| row)
        };
        let rows: Vec<_> = self.rows.par_iter().map(row).collect::<Result<_, _>>()?;
        Ok(rows.into_iter().flatten().collect())
    }

    /// The glyph at a place, unless a value is not finite.
    fn glyph<const N: usize, V>(
        &self,
        segments: &Segments<'_>,
        local: &mut LocalField<'f>,
        &LatticePoint { at, point }: &LatticePoint,
        quantities: &[Quantity; N],
        value: impl Fn([f64; N]) -> V,
    ) -> Option<Glyph<V>> {
        let segment = segments.at(self.anchor, point);
        let mut on_face = segment.map(|segment| self.field.on(segment, self.anchor));
        let (local, side) = (on_face.as_mut().unwrap_or(local), Side::default());
        let found = quantities.each_ref().map(|quantity| quantity.at(local, point, side));
        let face = segment.map(|segment| (segment, side));
        let is_finite = found.iter().all(|v| v.is_finite());
        is_finite.then(|| Glyph { offset: at, value: value(found), face })
    }
}

/// The columns and rows of a lattice in a view, as offsets from its centre.
fn lines(view: &View, spacing: f64) -> [Vec<f64>; 2] {
    let (step, half) = (spacing.max(LEAST_SPACING) * view.pixel_size(), view.half());
    [(view.center.x, half.x), (view.center.y, half.y)]
        .map(|(center, half)| multiples(center, half, step))
}

/// The multiples of a step within `center ± half`, from the centre; the rest of the division is
/// exact, however large the quotient.
fn multiples(center: f64, half: f64, step: f64) -> Vec<f64> {
    let rest = center.rem_euclid(step);
    let (first, last) =
        (((rest - half) / step).ceil() as i64, ((rest + half) / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step - rest).filter(|at| at.abs() <= half).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deform::Deformation;
    use ppum::crack::CrackEnd;
    use ppum::domain::Hole;
    use ppum::progress::{Progress, Verdict, unwatched};
    use ppum::vec2::Rect;
    use ppum_testkit::synthetic::{Coefficients, Recipe, crack};

    const SPACING: f64 = 17.0;

    fn displacement(field: &Field<'_>) -> [Quantity; 2] {
        ["ux", "uy"].map(|name| Quantity::parse(name, field).expect("a quantity"))
    }

    #[test]
    fn values_are_those_of_the_points() {
        for seed in 0..3 {
            let mut dataset = Recipe::random(seed).dataset();
            let (center, radius) = (vec2(0.6, 0.1), 0.2);
            dataset.domain.holes = vec![Hole::Circle { center, radius }];
            let field = Field::new(&dataset, 0).expect("a field");
            let view = View::hug(dataset.domain.bounds, [400, 300]).expect("a view");
            let quantities = displacement(&field);
            let arrows = GlyphLattice::new(&field, &view, SPACING)
                .vectors(&quantities, unwatched())
                .expect("arrows");
            let crosses =
                GlyphLattice::new(&field, &view, SPACING).principal(unwatched()).expect("crosses");
            assert_eq!(arrows.len(), crosses.len());
            // the area of the domain, without the hole, over that of a square of the lattice
            let area = dataset.domain.bounds.size().x * dataset.domain.bounds.size().y;
            let area = area - std::f64::consts::PI * radius * radius;
            let expected = area / (SPACING * view.pixel_size()).powi(2);
            assert!((arrows.len() as f64 / expected - 1.0).abs() < 0.05, "{expected}");
            let mut local = field.at(view.center);
            let mut at = |text: &str, offset| {
                let quantity = Quantity::parse(text, &field).expect("a quantity");
                quantity.at(&mut local, offset, Side::Above)
            };
            for (arrow, cross) in arrows.iter().zip(&crosses) {
                let p = arrow.offset;
                assert_eq!(arrow.offset, cross.offset);
                assert!(dataset.domain.contains(view.center + p));
                assert_eq!(arrow.value, vec2(at("ux", p), at("uy", p)));
                let found = [cross.value.s1, cross.value.s2, cross.value.angle];
                assert_eq!(found, ["s1", "s2", "direction"].map(|text| at(text, p)));
            }
        }
    }

    /// Panned, zoomed to 10⁻¹² and panned there, points stay where they are in the world.
    #[test]
    fn the_lattice_rests_in_the_world() {
        let dataset = Recipe::default().dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let quantities = displacement(&field);
        for width in [0.5, 1e-6, 1e-12] {
            let start = dataset.steps[0].cracks[0].points[1];
            let seen = |center| {
                let view = View::new(center, width, [200, 150]).expect("a view");
                let all =
                    GlyphLattice::new(&field, &view, SPACING).vectors(&quantities, unwatched());
                (view, all.expect("arrows"))
            };
            let (first, arrows) = seen(start);
            assert!((90..130).contains(&arrows.len()), "{}", arrows.len());
            let (second, panned) = seen(start + vec2(0.3137, -0.2071) * width);
            let shift = second.center - first.center;
            let inner = Rect::around(Vec2::ZERO, second.half() * 0.99);
            for arrow in arrows.iter().filter(|arrow| inner.contains(arrow.offset - shift)) {
                let same = |other: &&Glyph<Vec2>| {
                    (other.offset + shift - arrow.offset).length() < 1e-9 * first.pixel_size()
                };
                let there = panned.iter().find(same).expect("the same arrow");
                assert!((there.value - arrow.value).length() < 1e-12, "{there:?} {arrow:?}");
            }
        }
    }

    /// On the deformed body points stand in a lattice of the image, and have the values of the
    /// points of the body there.
    #[test]
    fn glyphs_of_the_deformed_plate_are_those_of_its_points() {
        for seed in 0..3 {
            let (coefficients, degrees) = (Coefficients::Taylor, vec![2]);
            let recipe = Recipe { coefficients, degrees, ..Recipe::random(seed) };
            let dataset = recipe.dataset();
            let field = Field::new(&dataset, 0).expect("a field");
            let view = View::hug(dataset.domain.bounds, [200, 150]).expect("a view");
            let (factor, quantities) = (0.1, displacement(&field));
            let seen = Deformation::new(&field, factor).expect("elastic").seen(&view);
            let points = seen.points(unwatched()).expect("points");
            let lattice = GlyphLattice::deformed(&points, &Reflection::NONE, SPACING);
            let arrows = lattice.vectors(&quantities, unwatched()).expect("arrows");
            assert!(arrows.len() > 60, "{}", arrows.len());
            for arrow in &arrows {
                // x = X + s u(X): the point of the body that the value itself leads to has this
                // value
                let place = view.center + arrow.offset - arrow.value * factor;
                let mut local = field.at(place);
                let u = quantities.each_ref().map(|q| q.at(&mut local, Vec2::ZERO, Side::Above));
                let miss = (Vec2::from(u) - arrow.value).length() * factor;
                assert!(miss < 0.02 * view.pixel_size(), "{miss}");
                let column = (view.center + arrow.offset) / (SPACING * view.pixel_size());
                let off = [column.x, column.y].map(|c| (c - c.round()).abs() * SPACING);
                assert!(off.iter().all(|off| *off <= 0.5 + 1e-6), "{off:?}");
            }
            let crosses = lattice.principal(unwatched()).expect("crosses");
            assert!(crosses.len() == arrows.len());
        }
    }

    #[test]
    fn points_on_a_crack_say_so() {
        // a crack along the lattice's own line y = 0
        let cracks = vec![crack(&[[0.4, 0.0], [1.1, 0.0]], [CrackEnd::Tip; 2])];
        let dataset = Recipe { cracks, ..Recipe::default() }.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::new(vec2(0.75, 0.0), 0.8, [200, 100]).expect("a view");
        let quantities = displacement(&field);
        let all = GlyphLattice::new(&field, &view, 10.0)
            .vectors(&quantities, unwatched())
            .expect("arrows");
        let on: Vec<_> = all.iter().filter(|glyph| glyph.face.is_some()).collect();
        assert_eq!(on.len(), 17);
        let id = SegmentId { crack: 0, segment: 0 };
        let mut local = field.on(id, view.center);
        for glyph in on {
            assert_eq!((glyph.offset.y, glyph.face), (0.0, Some((id, Side::Above))));
            let value = quantities.each_ref().map(|q| q.at(&mut local, glyph.offset, Side::Above));
            assert_eq!(glyph.value, value.into());
        }
    }

    #[test]
    fn what_has_no_stress_is_refused_and_calls_can_be_stopped() {
        let dataset = Recipe { components: 1, ..Recipe::default() }.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::hug(dataset.domain.bounds, [40, 30]).expect("a view");
        let found = GlyphLattice::new(&field, &view, SPACING).principal(unwatched());
        assert!(matches!(found, Err(RasterError::Quantity(_))));
        let quantities =
            ["du_dx", "du_dy"].map(|q| Quantity::parse(q, &field).expect("a quantity"));
        let stop = |_: Progress| Verdict::Stop;
        let found = GlyphLattice::new(&field, &view, SPACING).vectors(&quantities, &stop);
        assert!(matches!(found, Err(RasterError::Cancelled(_))));
        // a spacing of nothing is the least one
        let dense = GlyphLattice::new(&field, &view, 0.0)
            .vectors(&quantities, unwatched())
            .expect("arrows");
        assert!(dense.len() <= 11 * 9, "{}", dense.len());
    }
}
