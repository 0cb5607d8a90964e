//! Cells divided by hand.

use ppum::expression::Expression;
use ppum::vec2::{Rect, Vec2, vec2};

use super::check::{MAX_LEVEL, MistakeAt, numbered};
use super::key::Key;
use super::{Cells, Problem};

/// Divisions of a base cell after which a problem counts as unresolvable.
pub(crate) const DEEPEST: usize = 16;

/// Most tables: each cell asks all that are near it.
pub(super) const MAX_REFINEMENTS: usize = 1024;

/// Places along each axis at which a formula of the size is tried before anything is computed.
const SAMPLES: u32 = 16;

/// Cells of a part of the plate that are divided until they have a size: `[[refine]]` in problem
/// files.
///
/// A cell that meets the place, or is nearer to it than `distance`, has no side longer than `size`.
/// Of a formula that is its smallest value at nine places of what the cell has in common with the
/// box around the place: corners, centre and middles of the sides.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalRefinement {
    /// Where.
    pub place: RefinementRegion,
    /// Cells nearer than this to the place are divided as well.
    pub distance: f64,
    /// The longest side of a cell, of x and y.
    pub size: Expression,
}

/// The part of the domain that is refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RefinementRegion {
    /// All of it.
    Plate,
    /// A box.
    Box(Rect),
    /// A disc.
    Disc {
        /// Its centre.
        center: Vec2,
        /// Its radius.
        radius: f64,
    },
    /// The rim of a hole.
    Hole(usize),
    /// A crack.
    Crack(usize),
}

impl LocalRefinement {
    /// Cells of at most a size where they meet a place.
    #[must_use]
    pub fn new(place: RefinementRegion, size: impl Into<Expression>) -> Self {
        Self { place, distance: 0.0, size: size.into() }
    }

    /// The size at a point if it is one.
    ///
    /// # Errors
    /// The value, if it is not positive and finite.
    pub(crate) fn size_at(&self, p: Vec2) -> Result<f64, f64> {
        let size = self.size.value(p);
        if size > 0.0 && size.is_finite() { Ok(size) } else { Err(size) }
    }

    /// The box around all that is divided; that of the plate if it is everywhere.
    pub(crate) fn bounds(&self, problem: &Problem) -> Rect {
        let around = match self.place {
            RefinementRegion::Plate => return problem.domain.bounds,
            RefinementRegion::Box(rect) => rect,
            RefinementRegion::Disc { center, radius } => Rect::around(center, vec2(radius, radius)),
            RefinementRegion::Hole(hole) => problem.domain.holes[hole].bounds(),
            RefinementRegion::Crack(crack) => {
                crate::geometry::around(&problem.cracks[crack].points)
            }
        };
        crate::geometry::wider(&around, self.distance)
    }
}

/// Nine places of a box: centre, corners, middles of the sides.
pub(crate) fn nine(rect: &Rect) -> impl Iterator<Item = Vec2> + use<> {
    let (min, half) = (rect.min, rect.size() * 0.5);
    (0..9u32).map(move |k| min + vec2(half.x * f64::from(k % 3), half.y * f64::from(k / 3)))
}

/// All rules broken by the refinements; the domain and its cracks and holes are in order.
pub(super) fn check_refinements(problem: &Problem) -> Vec<MistakeAt> {
    let all = &problem.refinements;
    if all.len() > MAX_REFINEMENTS {
        let message = format!(
            "there are {} [[refine]], but at most {MAX_REFINEMENTS} may be; say more by formulas",
            all.len()
        );
        return vec![MistakeAt::new(Key::new("refine"), message)];
    }
    let check = |(index, new): (usize, &LocalRefinement)| {
        let found = bad_place(new, problem)
            .or_else(|| bad_distance(new))
            .or_else(|| bad_size(new, problem).map(|message| ("size", message)));
        let (name, message) = found?;
        Some(MistakeAt::new(Key::new("refine").index(index).name(name), message))
    };
    all.iter().enumerate().filter_map(check).collect()
}

fn bad_place(new: &LocalRefinement, problem: &Problem) -> Option<(&'static str, String)> {
    let (bounds, holes, cracks) =
        (&problem.domain.bounds, problem.domain.holes.len(), problem.cracks.len());
    let missed = |what: &str| format!("the {what} misses the domain; move it in, or leave it out");
    match new.place {
        RefinementRegion::Box(rect) => {
            let has_sides = rect.min.x < rect.max.x && rect.min.y < rect.max.y;
            let message = if !(has_sides && rect.min.is_finite() && rect.max.is_finite()) {
                "`box` must be [x0, y0, x1, y1] with x0 < x1 and y0 < y1, all finite".to_owned()
            } else if !rect.overlaps(bounds) {
                missed("box")
            } else {
                return None;
            };
            Some(("box", message))
        }
        RefinementRegion::Disc { center, .. } if !center.is_finite() => {
            Some(("center", "the centre is not finite".to_owned()))
        }
        RefinementRegion::Disc { radius, .. } if !(radius > 0.0 && radius.is_finite()) => {
            let message = format!("`radius` is {radius}, but must be positive and finite");
            Some(("radius", message))
        }
        RefinementRegion::Disc { center, radius } if bounds.distance(center) >= radius => {
            Some(("radius", missed("disc")))
        }
        RefinementRegion::Hole(hole) if hole >= holes => {
            Some(("hole", format!("there is no hole {hole}; {}", numbered(holes, "[[hole]]"))))
        }
        RefinementRegion::Crack(crack) if crack >= cracks => {
            let message = format!("there is no crack {crack}; {}", numbered(cracks, "[[crack]]"));
            Some(("crack", message))
        }
        _ => None,
    }
}

fn bad_distance(new: &LocalRefinement) -> Option<(&'static str, String)> {
    let distance = new.distance;
    let message = if !(distance >= 0.0 && distance.is_finite()) {
        format!("`distance` is {distance}, but must be finite and not negative")
    } else if distance > 0.0 && new.place == RefinementRegion::Plate {
        "`distance` has no meaning on the whole plate; remove it, or say from what".to_owned()
    } else {
        return None;
    };
    Some(("distance", message))
}

/// The mistake of a size that is none somewhere, or that the base cells cannot be divided to.
fn bad_size(new: &LocalRefinement, problem: &Problem) -> Option<String> {
    let remedy = if new.size.constant().is_some() {
        ""
    } else {
        "; change the formula, e.g. add a constant"
    };
    let rect = new.bounds(problem).intersection(&problem.domain.bounds);
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(SAMPLES);
    let places = (0..SAMPLES * SAMPLES).map(|k| {
        let (x, y) = (place(k % SAMPLES), place(k / SAMPLES));
        rect.min + vec2(rect.size().x * x, rect.size().y * y)
    });
    let wrong = places.filter_map(|p| new.size_at(p).err().map(|value| (p, value))).next();
    if let Some((p, value)) = wrong {
        let at = match new.size.constant() {
            Some(_) => String::new(),
            None => format!(" at [{}, {}]", p.x, p.y),
        };
        return Some(format!("`size` is {value}{at}, but must be positive and finite{remedy}"));
    }
    let (size, least) = (new.size.constant()?, smallest(problem)?);
    (size < least).then(|| {
        format!(
            "`size` is {size:?}, but {DEEPEST} divisions of the base cells, the most there may be, give cells of \
             {least:?}; give a larger size, or smaller base cells"
        )
    })
}

/// The size that base cells have after all divisions; nothing is known of those around points.
fn smallest(problem: &Problem) -> Option<f64> {
    let cells = &problem.discretization.cells;
    if matches!(cells, Cells::Level(level) if *level > MAX_LEVEL) {
        return None;
    }
    let size = cells.size(&problem.domain.bounds)?;
    Some(size.x.max(size.y) * 0.5f64.powi(DEEPEST as i32))
}
