//! The rules a [`Dataset`] must obey before anything may evaluate it.
//!
//! A dataset from a file or from a caller is data, not an invariant: [`Dataset::check`] is the one
//! place that decides whether its indices, shapes and numbers make sense. Evaluators rely on it.

mod domain;
mod formulas;
mod growth;
mod marks;
mod ranks;
mod tiling;
mod work;

use std::collections::{BTreeMap, BTreeSet};

use crate::cover::OVERLAP;
use crate::crack::{Crack, CrackEnd, End, SegmentId, TipId};
use crate::dataset::{
    Dataset, Equation, FieldData, MAX_DEGREE, Partition, Reaction, Step, TipIntensity, Warning,
    monomials,
};
use crate::function::{Cut, Frame, Function, FunctionKind, Part};
use crate::vec2::{Rect, Vec2};

/// The first thing found wrong in a dataset.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {mistake}")]
#[non_exhaustive]
pub struct CheckError {
    /// The place, as a path through the dataset's fields, e.g. `steps[0].partition.half[17]`.
    pub place: String,
    /// The mistake, and what was expected.
    pub mistake: String,
}

type Checked = Result<(), CheckError>;

impl Dataset {
    /// Checks that the dataset can be evaluated: consistent lengths, indices in range, rising
    /// offsets, finite numbers, positive extents, cracks without zero-length segments, formulas that
    /// can be read with the dataset's tables.
    ///
    /// Attributes and history may hold NaN ("no value") or infinities; nothing else may. That the cells
    /// tile the domain is asked, whether the supports cover it is not. O(n log n) in the size of the dataset.
    ///
    /// # Errors
    ///
    /// The first violation, with its place.
    pub fn check(&self) -> Checked {
        domain::check(&self.domain)?;
        formulas::check(self)?;
        if let Some((name, mistake)) = self.equation.mistake(&self.domain) {
            return fail(&format!("equation.{name}"), mistake);
        }
        require(!self.steps.is_empty(), "steps", || "a dataset needs at least one step".into())?;
        for (k, step) in self.steps.iter().enumerate() {
            check_step(step, &self.equation).map_err(|e| e.inside(&format!("steps[{k}]")))?;
            let known = k > 0 && self.steps[k - 1].partition.cell == step.partition.cell;
            if !known {
                tiling::check(&step.partition, &self.domain)
                    .map_err(|e| e.inside(&format!("steps[{k}].partition")))?;
            }
        }
        formulas::check_quantities(self)?;
        work::check(self)
    }
}

impl Step {
    /// Checks what can be known of a step without its patches: load, cracks, stress intensity factors, warnings.
    ///
    /// # Errors
    ///
    /// The first violation, with its place in the step.
    pub fn check_results(&self) -> Result<(), CheckError> {
        check_number("load", self.load)?;
        for (k, crack) in self.cracks.iter().enumerate() {
            check_crack(&format!("cracks[{k}]"), crack)?;
        }
        check_intensities(self)?;
        for (k, warning) in self.warnings.iter().enumerate() {
            check_warning(warning).map_err(|e| e.inside(&format!("warnings[{k}]")))?;
        }
        growth::check_growth(self)
    }
}

impl CheckError {
    /// The same error seen from the object that holds its place.
    fn inside(self, outer: &str) -> Self {
        Self { place: format!("{outer}.{}", self.place), ..self }
    }
}

fn fail(place: &str, mistake: String) -> Checked {
    Err(CheckError { place: place.to_owned(), mistake })
}

fn require(condition: bool, place: &str, mistake: impl FnOnce() -> String) -> Checked {
    if condition { Ok(()) } else { fail(place, mistake()) }
}

/// Checks every entry of an array; the place names the first that fails.
fn check_all<T>(
    name: &str,
    values: &[T],
    good: impl Fn(&T) -> bool,
    mistake: impl Fn(&T) -> String,
) -> Checked {
    check_each(name, values.len(), |k| good(&values[k]), |k| mistake(&values[k]))
}

/// The same of what belongs to each of so many entries.
fn check_each(
    name: &str,
    count: usize,
    good: impl Fn(usize) -> bool,
    mistake: impl Fn(usize) -> String,
) -> Checked {
    match (0..count).find(|&k| !good(k)) {
        None => Ok(()),
        Some(k) => fail(&format!("{name}[{k}]"), mistake(k)),
    }
}

fn check_number(place: &str, value: f64) -> Checked {
    require(value.is_finite(), place, || format!("{value} is not a finite number"))
}

fn check_numbers(name: &str, values: &[f64]) -> Checked {
    check_all(name, values, |v| v.is_finite(), |v| format!("{v} is not a finite number"))
}

fn check_points(name: &str, points: &[Vec2]) -> Checked {
    check_all(
        name,
        points,
        |p| p.is_finite(),
        |p| format!("({}, {}) is not a finite point", p.x, p.y),
    )
}

fn check_extents(name: &str, extents: &[Vec2]) -> Checked {
    check_all(
        name,
        extents,
        |e| e.is_finite() && e.x > 0.0 && e.y > 0.0,
        |e| format!("({}, {}) must be finite and positive", e.x, e.y),
    )
}

fn is_box(b: &Rect) -> bool {
    let size = b.size();
    b.min.is_finite() && b.max.is_finite() && size.is_finite() && size.x > 0.0 && size.y > 0.0
}

fn check_box(place: &str, b: &Rect) -> Checked {
    require(is_box(b), place, || {
        format!("({}, {}) to ({}, {}) is not a box", b.min.x, b.min.y, b.max.x, b.max.y)
    })
}

fn check_length(place: &str, length: usize, expected: usize, of: &str) -> Checked {
    require(length == expected, place, || {
        format!("has {length} entries, expected {expected} ({of})")
    })
}

fn check_index(place: &str, index: usize, count: usize, of: &str) -> Checked {
    require(index < count, place, || format!("index {index}, but there are {count} {of}"))
}

fn check_names<'a>(place: &str, names: impl Iterator<Item = &'a String>) -> Checked {
    let mut seen = BTreeSet::new();
    for name in names {
        require(!name.trim().is_empty(), place, || "a name is empty".into())?;
        require(seen.insert(name), place, || format!("the name `{name}` occurs twice"))?;
    }
    Ok(())
}

fn check_step(step: &Step, equation: &Equation) -> Checked {
    step.check_results()?;
    check_partition(&step.partition).map_err(|e| e.inside("partition"))?;
    for (k, function) in step.functions.iter().enumerate() {
        check_function(function, &step.cracks).map_err(|e| e.inside(&format!("functions[{k}]")))?;
    }
    check_names("fields", step.fields.iter().map(|f| &f.name))?;
    for (k, field) in step.fields.iter().enumerate() {
        check_field(field, step, equation).map_err(|e| e.inside(&format!("fields[{k}]")))?;
    }
    check_names("attributes", step.attributes.iter().map(|a| &a.name))?;
    for attribute in &step.attributes {
        let place = format!("attributes `{}`", attribute.name);
        check_length(&place, attribute.values.len(), step.partition.len(), "one per patch")?;
    }
    let components = step.fields.first().map_or(0, |field| field.components.len());
    for (k, reaction) in step.reactions.iter().enumerate() {
        check_reaction(reaction, components, equation)
            .map_err(|e| e.inside(&format!("reactions[{k}]")))?;
    }
    Ok(())
}

/// Part of a cell's size that its support reaches beyond it on each side, below which strips of overlap are
/// thinner than any cover's; a hair below the bound of covers, for rounding.
const LEAST_REACH: f64 = 0.005 - 1e-9;

/// Most patches: their borders are counted in 32 bits.
const MOST_PATCHES: usize = 1 << 30;

fn check_partition(partition: &Partition) -> Checked {
    let n = partition.len();
    require(n > 0, "center", || "there is no patch".into())?;
    require(n <= MOST_PATCHES, "center", || format!("{n} patches are too many"))?;
    for (name, length) in [
        ("half", partition.half.len()),
        ("origin", partition.origin.len()),
        ("scale", partition.scale.len()),
        ("cell", partition.cell.len()),
        ("level", partition.level.len()),
        ("point", partition.point.len()),
    ] {
        check_length(name, length, n, "one per patch")?;
    }
    check_points("center", &partition.center)?;
    check_extents("half", &partition.half)?;
    check_points("origin", &partition.origin)?;
    check_extents("scale", &partition.scale)?;
    check_points("points", &partition.points)?;
    check_all("cell", &partition.cell, is_box, |c| {
        format!("({}, {}) to ({}, {}) is not a box", c.min.x, c.min.y, c.max.x, c.max.y)
    })?;
    let reach = |patch: usize| thin_strip(&partition.support(patch), &partition.cell[patch]);
    check_each(
        "half",
        n,
        |patch| reach(patch).is_none(),
        |patch| {
            format!(
                "makes the support reach {} times the cell's size beyond it: patches overlap in strips too thin \
             for their numbers, give them {} times the cell at least",
                reach(patch).unwrap_or_default(),
                OVERLAP.start()
            )
        },
    )?;
    let meets = |patch: usize| partition.support(patch).overlaps(&partition.cell[patch]);
    check_each("center", n, meets, |_| "puts the support beside its cell".into())?;
    let points = partition.points.len();
    check_all(
        "point",
        &partition.point,
        |p| p.is_none_or(|p| (p as usize) < points),
        |p| format!("index {}, but there are {points} points", p.unwrap_or_default()),
    )
}

/// Farthest a support reaches beyond its cell, in units of the cell's size, where that is a strip too thin.
/// Rounding is no strip.
fn thin_strip(support: &Rect, cell: &Rect) -> Option<f64> {
    let along = |inner: [f64; 2], outer: [f64; 2]| {
        let rounding = 4.0 * f64::EPSILON * outer[0].abs().max(outer[1].abs());
        let reaches = [inner[0] - outer[0], outer[1] - inner[1]].into_iter();
        let strips = reaches.filter(move |reach| *reach > rounding);
        strips.map(move |reach| reach / (inner[1] - inner[0])).find(|&part| part < LEAST_REACH)
    };
    along([cell.min.x, cell.max.x], [support.min.x, support.max.x])
        .or_else(|| along([cell.min.y, cell.max.y], [support.min.y, support.max.y]))
}

fn check_crack(place: &str, crack: &Crack) -> Checked {
    check_points(&format!("{place}.points"), &crack.points)?;
    require(crack.points.len() >= 2, place, || {
        format!("has {} points, a crack needs two or more", crack.points.len())
    })?;
    let segments: Vec<Vec2> = crack.points.windows(2).map(|p| p[1] - p[0]).collect();
    check_all(
        &format!("{place}.segment"),
        &segments,
        |s| s.length() > 0.0 && s.unit().is_finite(),
        |_| "its two points are equal; leave one out".into(),
    )
}

fn check_function(function: &Function, cracks: &[Crack]) -> Checked {
    let count = cracks.len();
    match &function.kind {
        FunctionKind::One => Ok(()),
        FunctionKind::Side { crack } => check_index("crack", *crack as usize, count, "cracks"),
        FunctionKind::Component { cuts } => check_cuts(cuts, cracks),
        FunctionKind::Formula { frame, parameters, declared, .. } => {
            check_names("parameters", parameters.iter().map(|(name, _)| name))?;
            for (name, value) in parameters {
                check_number(&format!("parameters `{name}`"), *value)?;
            }
            check_points("declared.kinks", declared.kinks.as_flattened())?;
            check_points("declared.singular", &declared.singular)?;
            check_frame(frame, count)
        }
    }
}

/// Each cut is by a segment of a crack, and all that follow from it stand behind it.
fn check_cuts(cuts: &[Cut], cracks: &[Crack]) -> Checked {
    require(!cuts.is_empty(), "cuts", || "a component needs at least one".into())?;
    for (k, cut) in cuts.iter().enumerate() {
        let SegmentId { crack, segment } = cut.segment;
        check_index(&format!("cuts[{k}].crack"), crack as usize, cracks.len(), "cracks")?;
        let segments = cracks[crack as usize].points.len().saturating_sub(1);
        check_index(&format!("cuts[{k}].segment"), segment as usize, segments, "segments")?;
        for (name, part) in [("left", cut.left), ("right", cut.right)] {
            let Part::Cut(next) = part else { continue };
            let place = format!("cuts[{k}].{name}");
            check_index(&place, next as usize, cuts.len(), "cuts")?;
            require(next as usize > k, &place, || {
                format!("cut {next} follows from cut {k} and must stand behind it")
            })?;
        }
    }
    Ok(())
}

fn check_frame(frame: &Frame, cracks: usize) -> Checked {
    match *frame {
        Frame::World => Ok(()),
        Frame::Fixed { origin, angle } => {
            check_points("frame.origin", &[origin])?;
            check_number("frame.angle", angle)
        }
        Frame::Tip(tip) => check_index("frame.crack", tip.crack as usize, cracks, "cracks"),
    }
}

/// Most components of a field: each pixel of a picture holds all of them with their derivatives.
const MAX_COMPONENTS: usize = 64;

fn check_field(field: &FieldData, step: &Step, equation: &Equation) -> Checked {
    let components = field.components.len();
    require(components > 0, "components", || "a field needs at least one".into())?;
    require(components <= MAX_COMPONENTS, "components", || {
        format!("there are {components} components, but at most {MAX_COMPONENTS} may be")
    })?;
    check_names("components", field.components.iter())?;
    if field.name == "displacement" || field.name == "potential" {
        check_length("components", components, equation.components(), "those of the equation")?;
    }
    if !field.exact.is_empty() {
        check_length("exact", field.exact.len(), components, "one per component, or none")?;
    }
    check_rows(field, step.partition.len())?;
    check_coefficients(field)?;
    check_blocks(field, step.functions.len())
}

/// Compressed rows: start at zero, never fall, end at the number of blocks.
fn check_rows(field: &FieldData, patches: usize) -> Checked {
    let rows = &field.patch_blocks;
    check_length("patch_blocks", rows.len(), patches + 1, "one more than patches")?;
    require(rows[0] == 0, "patch_blocks[0]", || format!("is {}, expected 0", rows[0]))?;
    if let Some(k) = rows.windows(2).position(|w| w[0] > w[1]) {
        return fail(
            &format!("patch_blocks[{}]", k + 1),
            format!("{} falls below {}; offsets must not fall", rows[k + 1], rows[k]),
        );
    }
    let blocks = field.block_function.len();
    require(rows[patches] as usize == blocks, &format!("patch_blocks[{patches}]"), || {
        format!("is {}, but there are {blocks} blocks", rows[patches])
    })?;
    check_length("block_degree", field.block_degree.len(), blocks, "one per block")?;
    check_length("block_offset", field.block_offset.len(), blocks, "one per block")
}

fn check_coefficients(field: &FieldData) -> Checked {
    check_length("coefficients", field.coefficients.len(), field.components.len(), "components")?;
    let count = field.coefficients[0].len();
    for (k, values) in field.coefficients.iter().enumerate() {
        let place = format!("coefficients[{k}]");
        check_length(&place, values.len(), count, "as in component 0")?;
        check_numbers(&place, values)?;
    }
    Ok(())
}

fn check_blocks(field: &FieldData, functions: usize) -> Checked {
    let count = field.coefficients[0].len() as u64;
    check_all(
        "block_function",
        &field.block_function,
        |&f| (f as usize) < functions,
        |f| format!("index {f}, but there are {functions} functions"),
    )?;
    check_all(
        "block_degree",
        &field.block_degree,
        |&d| d as usize <= MAX_DEGREE,
        |d| format!("degree {d} is above {MAX_DEGREE}"),
    )?;
    for (b, (&offset, &degree)) in field.block_offset.iter().zip(&field.block_degree).enumerate() {
        let needed = monomials(degree as usize) as u64;
        let fits = offset.checked_add(needed).is_some_and(|end| end <= count);
        require(fits, &format!("block_offset[{b}]"), || {
            format!("coefficients {offset} + {needed} reach beyond the {count} stored")
        })?;
    }
    // blocks that shared theirs could ask for far more than a file holds
    let sizes = field.block_degree.iter().map(|&degree| monomials(degree.into()) as u64);
    let all: u64 = sizes.sum();
    require(all <= count, "block_offset", || {
        format!(
            "the blocks take {all} coefficients, but {count} are stored; give each block its own"
        )
    })
}

/// Most rings of a tip: each is compared with all others.
const MAX_RINGS: usize = 64;

/// Each tip has one entry at most, and ends of other kinds have none.
fn check_intensities(step: &Step) -> Checked {
    let mut seen = BTreeMap::new();
    for (k, intensity) in step.intensities.iter().enumerate() {
        let place = format!("intensities[{k}]");
        check_intensity(intensity, &step.cracks).map_err(|e| e.inside(&place))?;
        if let Some(other) = seen.insert(intensity.tip, k) {
            return fail(&place, format!("is of the same tip as intensities[{other}]; keep one"));
        }
    }
    Ok(())
}

fn check_intensity(intensity: &TipIntensity, cracks: &[Crack]) -> Checked {
    let TipId { crack, end } = intensity.tip;
    check_index("crack", crack as usize, cracks.len(), "cracks")?;
    let kind = cracks[crack as usize].ends[usize::from(end == End::Last)];
    require(kind == CrackEnd::Tip, "end", || {
        format!("the {} of crack {crack} is no tip", end.name())
    })?;
    check_number("k1", intensity.k1)?;
    check_number("k2", intensity.k2)?;
    check_number("t_stress", intensity.t_stress.unwrap_or(0.0))?;
    check_number("j", intensity.j.unwrap_or(0.0))?;
    let error = intensity.error.unwrap_or(0.0);
    require(error >= 0.0 && error.is_finite(), "error", || {
        format!("the estimated error is {error}, but must be finite and not negative")
    })?;
    require(intensity.rings.len() <= MAX_RINGS, "rings", || {
        format!("there are {} rings, but at most {MAX_RINGS} may be", intensity.rings.len())
    })?;
    check_all(
        "rings",
        &intensity.rings,
        |r| [r.r1, r.r2, r.k1, r.k2].iter().all(|v| v.is_finite()) && 0.0 <= r.r1 && r.r1 < r.r2,
        |r| format!("r1 = {}, r2 = {}: expected finite values and 0 ≤ r1 < r2", r.r1, r.r2),
    )
}

fn check_warning(warning: &Warning) -> Checked {
    require(!warning.kind.trim().is_empty(), "kind", || "is empty".into())?;
    check_points("at", warning.at.as_slice())?;
    check_number("value", warning.value)?;
    check_number("limit", warning.limit)
}

fn check_reaction(reaction: &Reaction, components: usize, equation: &Equation) -> Checked {
    require(!reaction.on.trim().is_empty(), "on", || "is empty".into())?;
    let of = "one per component of the first field";
    check_length("held", reaction.held.len(), components, of)?;
    check_length("force", reaction.force.len(), components, of)?;
    check_numbers("force", &reaction.force)?;
    let mut free = reaction.held.iter().zip(&reaction.force).filter(|(held, _)| !**held);
    require(free.all(|(_, &force)| force == 0.0), "force", || {
        "must be 0 of components that are not held".into()
    })?;
    check_number("moment", reaction.moment)?;
    require(equation.components() > 1 || reaction.moment == 0.0, "moment", || {
        format!("is {}, but a potential has none: expected 0", reaction.moment)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::{Attribute, Ring};
    use crate::equation::{Material, StressState};
    use crate::vec2::vec2;
    use crate::weight::WeightFunction;

    fn partition() -> Partition {
        let (center, half) = (vec2(0.5, 0.5), vec2(0.65, 0.65));
        Partition {
            weight: WeightFunction::Linear,
            center: vec![center],
            half: vec![half],
            origin: vec![center],
            scale: vec![half],
            cell: vec![Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0))],
            level: vec![0],
            point: vec![Some(0)],
            points: vec![vec2(0.3, 0.4)],
        }
    }

    fn field() -> FieldData {
        let mut field = FieldData::new("displacement", &["ux", "uy"]);
        field.push_patch(&[(0, 1), (1, 0)]);
        field.coefficients[1].fill(1.0);
        field
    }

    pub(super) fn dataset() -> Dataset {
        let tip = TipId { crack: 0, end: End::Last };
        let ring = Ring { r1: 0.0, r2: 0.1, k1: 1.0, k2: 0.0 };
        let crack = Crack {
            points: vec![vec2(0.0, 0.5), vec2(0.5, 0.5)],
            ends: [CrackEnd::Mouth, CrackEnd::Tip],
        };
        let mut step = Step::new(partition())
            .with_crack(crack)
            .with_function("one", FunctionKind::One)
            .with_function("side", FunctionKind::Side { crack: 0 })
            .with_field(field());
        step.attributes = vec![Attribute { name: "order".into(), values: vec![f64::NAN] }];
        step.intensities =
            vec![TipIntensity { rings: vec![ring], ..TipIntensity::new(tip, 1.0, 0.0) }];
        let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
        let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        Dataset::new(domain, Equation::elasticity(material)).with_step(step)
    }

    /// The place of the error after one change of a good dataset.
    pub(super) fn place_after(change: impl FnOnce(&mut Dataset)) -> String {
        let mut data = dataset();
        change(&mut data);
        data.check().expect_err("the change must be found").place
    }

    #[test]
    fn a_good_dataset_passes() {
        assert_eq!(dataset().check(), Ok(()));
    }

    #[test]
    fn domain_material_and_steps() {
        assert_eq!(place_after(|d| d.domain.bounds.max.x = 0.0), "domain");
        assert_eq!(place_after(|d| d.domain.bounds.max.x = f64::INFINITY), "domain");
        assert_eq!(place_after(|d| d.equation = Equation::poisson(0.0)), {
            "equation.conductivity"
        });
        let material = |young, poisson| {
            Equation::elasticity(Material { young, poisson, state: StressState::PlaneStrain })
        };
        assert_eq!(place_after(|d| d.equation = material(-1.0, 0.3)), "equation.young");
        assert_eq!(place_after(|d| d.equation = material(1.0, 0.5)), "equation.poisson");
        assert_eq!(place_after(|d| d.equation = material(1.0, f64::NAN)), "equation.poisson");
        assert_eq!(place_after(|d| d.steps.clear()), "steps");
        assert_eq!(place_after(|d| d.steps[0].load = f64::NAN), "steps[0].load");
    }

    #[test]
    fn partition_entries() {
        let place = |change: fn(&mut Partition)| {
            let full = place_after(|d| change(&mut d.steps[0].partition));
            full.strip_prefix("steps[0].partition.").expect("inside the partition").to_owned()
        };
        assert_eq!(place(|p| p.half.clear()), "half");
        assert_eq!(place(|p| p.half[0].y = 0.0), "half[0]");
        assert_eq!(place(|p| p.half[0].y = 0.5 * (1.0 + 1e-12)), "half[0]");
        assert_eq!(place(|p| p.scale[0].x = -1.0), "scale[0]");
        assert_eq!(place(|p| p.origin[0].x = f64::NAN), "origin[0]");
        assert_eq!(place(|p| p.cell[0].max.x = -1.0), "cell[0]");
        assert_eq!(place(|p| p.point[0] = Some(1)), "point[0]");
        assert_eq!(place(|p| p.points[0].y = f64::INFINITY), "points[0]");
        assert_eq!(place(|p| p.level.push(1)), "level");
    }

    #[test]
    fn cracks_and_functions() {
        let doubled = vec2(0.5, 0.5);
        assert_eq!(
            place_after(|d| d.steps[0].cracks[0].points.push(doubled)),
            "steps[0].cracks[0].segment[1]"
        );
        assert_eq!(place_after(|d| d.steps[0].cracks[0].points.truncate(1)), "steps[0].cracks[0]");
        assert_eq!(
            place_after(|d| d.steps[0].functions[1].kind = FunctionKind::Side { crack: 1 }),
            "steps[0].functions[1].crack"
        );
        let frame = Frame::Tip(TipId { crack: 7, end: End::Start });
        let tip_formula = FunctionKind::formula("sqrt(r)", frame);
        assert_eq!(
            place_after(|d| d.steps[0].functions[1].kind = tip_formula),
            "steps[0].functions[1].frame.crack"
        );
    }

    #[test]
    fn cuts_of_components() {
        let cut = |segment: u32, left, right| Cut {
            segment: SegmentId { crack: 0, segment },
            left,
            right,
        };
        let place = |cuts: Vec<Cut>| {
            let full =
                place_after(|d| d.steps[0].functions[1].kind = FunctionKind::Component { cuts });
            full.strip_prefix("steps[0].functions[1].").expect("inside the function").to_owned()
        };
        let (inside, outside) = (Part::Inside, Part::Outside);
        assert_eq!(place(vec![]), "cuts");
        let other = SegmentId { crack: 1, segment: 0 };
        assert_eq!(place(vec![Cut { segment: other, ..cut(0, inside, outside) }]), "cuts[0].crack");
        assert_eq!(place(vec![cut(1, inside, outside)]), "cuts[0].segment");
        assert_eq!(place(vec![cut(0, Part::Cut(1), outside)]), "cuts[0].left");
        assert_eq!(place(vec![cut(0, inside, Part::Cut(0))]), "cuts[0].right");
        let back = vec![cut(0, Part::Cut(1), inside), cut(0, outside, Part::Cut(0))];
        assert_eq!(place(back), "cuts[1].right");
        let mut good = dataset();
        let cuts = vec![cut(0, Part::Cut(1), Part::Cut(1)), cut(0, outside, inside)];
        good.steps[0].functions[1].kind = FunctionKind::Component { cuts };
        assert_eq!(good.check(), Ok(()));
    }

    #[test]
    fn field_arrays() {
        let place = |change: fn(&mut FieldData)| {
            let full = place_after(|d| change(&mut d.steps[0].fields[0]));
            full.strip_prefix("steps[0].fields[0].").expect("inside the field").to_owned()
        };
        assert_eq!(place(|f| f.components.truncate(1)), "components");
        assert_eq!(place(|f| f.components[1] = "ux".into()), "components");
        assert_eq!(place(|f| f.patch_blocks[0] = 1), "patch_blocks[0]");
        assert_eq!(place(|f| f.patch_blocks[1] = 1), "patch_blocks[1]");
        assert_eq!(place(|f| f.patch_blocks.push(2)), "patch_blocks");
        assert_eq!(place(|f| f.block_function[1] = 2), "block_function[1]");
        assert_eq!(place(|f| f.block_degree[0] = 9), "block_degree[0]");
        assert_eq!(place(|f| f.block_offset[1] = 4), "block_offset[1]");
        assert_eq!(place(|f| f.block_offset[1] = u64::MAX), "block_offset[1]");
        assert_eq!(place(|f| f.coefficients[1][2] = f64::NAN), "coefficients[1][2]");
        assert_eq!(place(|f| f.coefficients[1].truncate(3)), "coefficients[1]");
        assert_eq!(place(|f| f.exact.push("x".into())), "exact");
    }

    #[test]
    fn results() {
        assert_eq!(
            place_after(|d| d.steps[0].attributes[0].values.clear()),
            "steps[0].attributes `order`"
        );
        assert_eq!(
            place_after(|d| d.steps[0].intensities[0].rings[0].r1 = 0.1),
            "steps[0].intensities[0].rings[0]"
        );
        assert_eq!(
            place_after(|d| d.steps[0].intensities[0].tip.crack = 1),
            "steps[0].intensities[0].crack"
        );
        assert_eq!(
            place_after(|d| d.steps[0].intensities[0].j = Some(f64::INFINITY)),
            "steps[0].intensities[0].j"
        );
        assert_eq!(
            place_after(|d| d.steps[0].intensities[0].t_stress = Some(f64::NAN)),
            "steps[0].intensities[0].t_stress"
        );
        for error in [f64::NAN, -1e-9] {
            assert_eq!(
                place_after(|d| d.steps[0].intensities[0].error = Some(error)),
                "steps[0].intensities[0].error"
            );
        }
    }
}
