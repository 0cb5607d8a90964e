//! Rules for cells divided by hand.

use ppum::vec2::{Rect, Vec2, vec2};

use crate::data::{BaseCells, DEEPEST, LocalRefinement, MAX_LEVEL, ProblemData, RefinementRegion};
use crate::file::{Key, KeyError, no_such};

/// Most tables: each cell asks all that are near it.
const MAX_REFINEMENTS: usize = 1024;

/// Places along each axis at which a formula is tried before anything is computed.
const SAMPLES: u32 = 16;

/// Places of a box at which formulas are tried.
pub(super) fn samples(rect: &Rect) -> impl Iterator<Item = Vec2> + use<> {
    let (min, size) = (rect.min, rect.size());
    let part = |k: u32| (f64::from(k) + 0.5) / f64::from(SAMPLES);
    let at = move |k| min + vec2(size.x * part(k % SAMPLES), size.y * part(k / SAMPLES));
    (0..SAMPLES * SAMPLES).map(at)
}

/// All rules broken by the refinements; the domain and its cracks and holes are in order.
pub(super) fn check_refinements(problem: &ProblemData) -> Vec<KeyError> {
    let all = &problem.refinements;
    if all.len() > MAX_REFINEMENTS {
        let message = format!(
            "there are {} [[refine]], but at most {MAX_REFINEMENTS} may be; say more by formulas",
            all.len()
        );
        return vec![Key::new("refine").error(message)];
    }
    let check = |(index, new): (usize, &LocalRefinement)| {
        let found = bad_place(new, problem)
            .or_else(|| bad_distance(new))
            .or_else(|| bad_size(new, problem).map(|message| ("size", message)));
        let (name, message) = found?;
        Some(Key::new("refine").index(index).name(name).error(message))
    };
    all.iter().enumerate().filter_map(check).collect()
}

fn bad_place(new: &LocalRefinement, problem: &ProblemData) -> Option<(&'static str, String)> {
    let (bounds, holes, cracks) =
        (&problem.domain().bounds, problem.domain().holes.len(), problem.cracks().len());
    let holes = holes - usize::from(problem.domain().outline().is_some());
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
        RefinementRegion::Disc { center, radius }
            if radius > 0.0 && bounds.distance(center) >= radius =>
        {
            Some(("radius", missed("disc")))
        }
        RefinementRegion::Hole(hole) if hole >= holes => {
            Some(("hole", no_such("hole", hole, holes)))
        }
        RefinementRegion::Crack(crack) if crack >= cracks => {
            Some(("crack", no_such("crack", crack, cracks)))
        }
        _ => None,
    }
}

fn bad_distance(new: &LocalRefinement) -> Option<(&'static str, String)> {
    let message = "`distance` has no meaning on the whole plate; remove it, or say from what";
    let is_meant = new.distance > 0.0 && new.place == RefinementRegion::Plate;
    is_meant.then(|| ("distance", message.to_owned()))
}

/// The error of a size that is none somewhere, or that the base cells cannot be divided to.
fn bad_size(new: &LocalRefinement, problem: &ProblemData) -> Option<String> {
    let remedy = if new.size.constant().is_some() {
        ""
    } else {
        "; change the formula, e.g. add a constant"
    };
    let rect =
        new.bounds(problem.domain(), problem.cracks()).intersection(&problem.domain().bounds);
    let wrong = |p| Some((p, new.size_at(p).err()?));
    if let Some((p, value)) = samples(&rect).find_map(wrong) {
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
fn smallest(problem: &ProblemData) -> Option<f64> {
    let cells = &problem.discretization.cells;
    if matches!(cells, BaseCells::Level(level) if *level > MAX_LEVEL) {
        return None;
    }
    let size = cells.size(&problem.domain().bounds)?;
    Some(size.x.max(size.y) * 0.5f64.powi(DEEPEST as i32))
}
