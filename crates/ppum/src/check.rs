//! The rules a [`Dataset`] must obey before anything may evaluate it.
//!
//! A dataset from a file or from a caller is data, not an invariant: [`Dataset::check`] is the one
//! place that decides whether its indices, shapes and numbers make sense. Evaluators rely on it.

mod coverage;
mod domain;
mod edges;
mod errors;
mod fields;
mod formulas;
mod functions;
mod growth;
mod line;
mod marks;
mod mesh;
mod partition;
mod ranks;
mod results;
mod tiling;

use crate::dataset::{Dataset, Equation, Partition, Step};
pub use errors::CheckError;
use errors::{Errors, check_length, check_names, check_number, fail, require};
use fields::check_field;
use functions::{check_crack, check_function};
use partition::check_partition;
use results::{check_intensities, check_reaction, check_warning};

impl Dataset {
    /// Checks that the dataset can be evaluated: consistent lengths, indices in range, rising
    /// offsets, finite numbers, positive extents, cracks without zero-length segments, formulas
    /// that can be read with the dataset's tables.
    ///
    /// Attributes and history may hold NaN ("no value") or infinities; nothing else may. The cells
    /// tile the domain, and the supports cover them. O(n log n) in the size of the dataset.
    ///
    /// # Errors
    ///
    /// The first violation, with its place.
    pub fn check(&self) -> Result<(), CheckError> {
        self.diagnose().into_iter().next().map_or(Ok(()), Err)
    }

    /// Returns all violations that [`check`](Self::check) would find, if each one before were
    /// repaired, up to a hundred: one of each array, and none that only follows from others.
    #[must_use]
    pub fn diagnose(&self) -> Vec<CheckError> {
        let mut errors = Errors::default();
        let has_domain = errors.within("domain", |e| domain::check(&self.domain, e));
        let has_formulas = formulas::check(self, &mut errors);
        if has_domain
            && has_formulas
            && let Some((name, message)) = self.equation.invalid_constant(&self.domain)
        {
            errors.add(fail(&format!("equation.{name}"), message));
        }
        errors.add(require(!self.steps.is_empty(), "steps", || {
            "a dataset needs at least one step".into()
        }));
        for (k, step) in self.steps.iter().enumerate() {
            errors.within(&format!("steps[{k}]"), |errors| {
                let has_partition = check_step(step, &self.equation, errors);
                if has_domain && has_partition {
                    let before = k.checked_sub(1).map(|k| &self.steps[k].partition);
                    errors.within("partition", |errors| self.check_place(step, before, errors));
                }
            });
        }
        formulas::check_quantities(self, &mut errors);
        errors.into_list()
    }

    /// Checks that a step's patches cover the domain, or are all of it, as those of the step
    /// before do.
    fn check_place(&self, step: &Step, before: Option<&Partition>, errors: &mut Errors) {
        match (&step.partition, before) {
            (Partition::Boxes(_), Some(Partition::Mesh(_))) => {
                errors.add(fail("", "is of boxes, that of the step before of a mesh".into()));
            }
            (Partition::Mesh(_), Some(Partition::Boxes(_))) => {
                errors.add(fail("", "is of a mesh, that of the step before of boxes".into()));
            }
            (Partition::Mesh(mesh), _) => {
                errors.add(mesh::check_domain(mesh, &self.domain));
            }
            (Partition::Boxes(boxes), before) => {
                let has_same_cells = before.is_some_and(|before| before.boxes().cell == boxes.cell);
                let is_fine = has_same_cells || !boxes.has_cells();
                if is_fine || errors.add(tiling::check(boxes, &self.domain)) {
                    errors.add(coverage::check(boxes, &self.domain));
                }
            }
        }
    }
}

impl Step {
    /// Checks what can be known of a step without its patches: load, cracks, stress intensity
    /// factors, warnings.
    ///
    /// # Errors
    ///
    /// The first violation, with its place in the step.
    pub fn check_results(&self) -> Result<(), CheckError> {
        let mut errors = Errors::default();
        check_results(self, &mut errors);
        errors.into_list().into_iter().next().map_or(Ok(()), Err)
    }
}

fn check_results(step: &Step, errors: &mut Errors) {
    errors.add(check_number("load", step.load));
    errors.each("cracks", &step.cracks, |_, crack| check_crack(crack));
    check_intensities(step, errors);
    errors.each("warnings", &step.warnings, |_, warning| check_warning(warning));
    growth::check_growth(step, errors);
}

/// Checks a step by itself. True if its partition is one.
fn check_step(step: &Step, equation: &Equation, errors: &mut Errors) -> bool {
    check_results(step, errors);
    let has_partition = errors.within("partition", |e| check_partition(&step.partition, e));
    errors.each("functions", &step.functions, |_, f| check_function(f, &step.cracks));
    errors.add(check_names("fields", step.fields.iter().map(|f| &f.name)));
    for (k, field) in step.fields.iter().enumerate() {
        errors.within(&format!("fields[{k}]"), |e| check_field(field, step, equation, e));
    }
    mesh::check_levels(step, errors);
    errors.add(check_names("attributes", step.attributes.iter().map(|a| &a.name)));
    for attribute in &step.attributes {
        let place = format!("attributes `{}`", attribute.name);
        let (length, patches) = (attribute.values.len(), step.partition.len());
        errors.add(check_length(&place, length, patches, "one per patch"));
    }
    let components = step.fields.first().map_or(0, |field| field.components.len());
    errors.each("reactions", &step.reactions, |_, reaction| {
        check_reaction(reaction, components, equation)
    });
    has_partition
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::{Crack, CrackEnd, End, SegmentId, TipId};
    use crate::dataset::{Attribute, BoxPartition, FieldData, Ring, TipIntensity};
    use crate::edge::Edge;
    use crate::equation::{Material, StressState};
    use crate::function::{Cut, CutBranch, Frame, FunctionKind};
    use crate::vec2::{Rect, vec2};
    use crate::weight::WeightFunction;

    fn partition() -> BoxPartition {
        let (center, half) = (vec2(0.5, 0.5), vec2(0.65, 0.65));
        BoxPartition {
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
        let crack =
            Crack::polyline(vec![vec2(0.0, 0.5), vec2(0.5, 0.5)], [CrackEnd::Mouth, CrackEnd::Tip]);
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
        let place = |change: fn(&mut BoxPartition)| {
            let full = place_after(|d| change(d.steps[0].partition.boxes_mut().expect("boxes")));
            full.strip_prefix("steps[0].partition.").expect("inside the partition").to_owned()
        };
        assert_eq!(place(|p| p.half.clear()), "half");
        assert_eq!(place(|p| p.half[0].y = 0.0), "half[0]");
        assert_eq!(place(|p| p.half[0].y = 0.5 * (1.0 + 1e-12)), "half");
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

    /// Bulges are finite, of a size whose arcs have a chord, and one for each edge; an arc does not
    /// run back on the edge before it.
    #[test]
    fn bulges_of_cracks() {
        let with = |points: &[[f64; 2]], bulges: &[f64]| Crack {
            points: points.iter().copied().map(Into::into).collect(),
            bulges: bulges.to_vec(),
            ends: [CrackEnd::Mouth, CrackEnd::Tip],
        };
        let points = [[0.0, 0.5], [0.5, 0.5], [0.5, 0.7]];
        let quarter = std::f64::consts::FRAC_PI_8.tan();
        let mut good = dataset();
        // the second one turns back towards itself, beside it
        let fine = [[0.5, -64.0], [quarter, -quarter], [0.0, 1e-300], [0.4, -0.4]];
        good.steps[0].cracks.extend(fine.map(|bulges| with(&points, &bulges)));
        assert_eq!(good.check(), Ok(()));
        let there_and_back = [points[0], points[1], points[0]];
        let part =
            Edge { from: points[0].into(), to: points[1].into(), bulge: 0.5 }.part([0.3, 1.0]);
        let back = [points[0], points[1], part.from.into()];
        for (points, bulges, place) in [
            (&points[..], &[0.5][..], ".bulges"),
            (&points, &[f64::NAN, 0.0], ".bulges[0]"),
            (&points, &[0.0, f64::INFINITY], ".bulges[1]"),
            (&points, &[-64.1, 0.0], ".bulges[0]"),
            (&there_and_back, &[0.5, -0.5], ".segment[1]"),
            (&back, &[0.5, -part.bulge], ".segment[1]"),
            (&[points[0], points[0], points[1]], &[0.5, 0.0], ".segment[0]"),
        ] {
            let found = place_after(|d| d.steps[0].cracks[0] = with(points, bulges));
            assert_eq!(found, format!("steps[0].cracks[0]{place}"));
        }
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
        let (inside, outside) = (CutBranch::Inside, CutBranch::Outside);
        assert_eq!(place(vec![]), "cuts");
        let other = SegmentId { crack: 1, segment: 0 };
        assert_eq!(place(vec![Cut { segment: other, ..cut(0, inside, outside) }]), "cuts[0].crack");
        assert_eq!(place(vec![cut(1, inside, outside)]), "cuts[0].segment");
        assert_eq!(place(vec![cut(0, CutBranch::Cut(1), outside)]), "cuts[0].left");
        assert_eq!(place(vec![cut(0, inside, CutBranch::Cut(0))]), "cuts[0].right");
        let back = vec![cut(0, CutBranch::Cut(1), inside), cut(0, outside, CutBranch::Cut(0))];
        assert_eq!(place(back), "cuts[1].right");
        let mut good = dataset();
        let cuts = vec![cut(0, CutBranch::Cut(1), CutBranch::Cut(1)), cut(0, outside, inside)];
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

    /// Blocks share no coefficients, and what could be multiplied by something else has a limit.
    #[test]
    fn sizes_that_multiply_have_limits() {
        let twice = |d: &mut Dataset| {
            let field = &mut d.steps[0].fields[0];
            field.block_offset.fill(0);
            field.coefficients.iter_mut().for_each(|component| component.truncate(3));
        };
        assert_eq!(place_after(twice), "steps[0].fields[0].block_offset[1]");
        let components = |d: &mut Dataset| {
            let field = &mut d.steps[0].fields[0];
            field.name = "values".into();
            field.components = (0..65).map(|k| format!("v{k}")).collect();
            field.coefficients = vec![field.coefficients[0].clone(); 65];
        };
        assert_eq!(place_after(components), "steps[0].fields[0].components");
        let rings = |d: &mut Dataset| {
            let rings = &mut d.steps[0].intensities[0].rings;
            *rings = vec![rings[0]; 65];
        };
        assert_eq!(place_after(rings), "steps[0].intensities[0].rings");
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
