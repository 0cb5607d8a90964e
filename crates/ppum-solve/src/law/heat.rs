//! A temperature that strains an elastic body, the solution of a heat problem on the same cover.
//!
//! In a dataset displacement and temperature are one field, (ux, uy, T). While a problem is solved
//! they are two: the temperature is known before the system of the displacement is assembled, whose
//! strains ε⁰ = α T I + … it gives. Their local spaces have the same patches but functions of their
//! own; in the joint field a block is of zeros in the components that do not have it.

use super::strain::Strain;
use crate::report::SolverReport;
use ppum::crack::{SegmentId, Side};
use ppum::dataset::{Dataset, Equation, FieldData, NamedQuantity, Reaction, Step, TEMPERATURE};
use ppum::equation::Moduli;
use ppum::expression::Expression;
use ppum::field::{Field, FieldError};
use ppum::formula::FormulaJets;
use ppum::function::Function;
use ppum::jet::Jet;
use ppum::vec2::Vec2;

/// Components of a displacement.
const DISPLACEMENT: usize = 2;

/// The face of a crack that a point lies on.
pub type FaceLocation = Option<(SegmentId, Side)>;

/// A temperature that is known, and the body that it strains.
#[derive(Debug)]
pub struct Temperature {
    /// The temperature as the first field of the only step.
    heat: Dataset,
    /// The equation of the body, with the coefficient α of expansion.
    equation: Equation,
    /// The solver's report; empty for a temperature that is stored.
    pub report: SolverReport,
}

impl Temperature {
    /// A temperature, the first field of a dataset's only step, in a body with an equation that has
    /// a coefficient of expansion, with the report of its solution.
    ///
    /// # Errors
    /// A field that does not compile.
    pub fn new(
        heat: Dataset,
        equation: Equation,
        report: SolverReport,
    ) -> Result<Self, FieldError> {
        Field::new(&heat, 0)?;
        Ok(Self { heat, equation, report })
    }

    /// The temperature as the solution of its own problem, which has an equation of one component.
    pub fn potential(&self, equation: &Equation) -> Dataset {
        let mut dataset = self.heat.clone();
        let field = &mut dataset.steps[0].fields[0];
        "potential".clone_into(&mut field.name);
        field.components = equation.component_names().iter().map(|&name| name.into()).collect();
        dataset.equation = equation.clone();
        dataset
    }

    /// The temperature, ready to be evaluated.
    pub(super) fn field(&self) -> TemperatureField<'_> {
        let field = Field::new(&self.heat, 0).expect("it was compiled when it was made");
        let slope = |e: &Expression| FormulaJets::new(&[e.formula()], 1).ok();
        let body = self.equation.elastic();
        let slopes = [self.equation.expansion(), body.map(|body| &body.poisson)]
            .map(|e| e.filter(|e| e.constant().is_none()).and_then(slope));
        TemperatureField { field, equation: &self.equation, slopes }
    }

    /// The dataset of displacement and temperature, with quantities of both.
    pub fn joined(&self, mut plain: Dataset, quantities: &[NamedQuantity]) -> Dataset {
        let step = &mut plain.steps[0];
        *step = joined(step, &self.heat.steps[0]);
        for Reaction { held, force, .. } in &mut step.reactions {
            held.push(false);
            force.push(0.0);
        }
        plain.equation = self.equation.clone();
        plain.quantities = quantities.to_vec();
        plain
    }

    /// The displacement and the temperature of a step of a joint dataset, each as the only step of
    /// a dataset; none if the step has no temperature.
    ///
    /// # Errors
    /// A field that does not compile.
    pub fn split(dataset: &Dataset, step: usize) -> Result<Option<(Dataset, Self)>, FieldError> {
        if !Field::new(dataset, step)?.has_temperature() {
            return Ok(None);
        }
        let step = &dataset.steps[step];
        let part = |name: &str, components: std::ops::Range<usize>, equation: Equation| {
            let mut part = Dataset::new(dataset.domain.clone(), equation);
            part.tables.clone_from(&dataset.tables);
            let mut step = step.clone();
            let field = &mut step.fields[0];
            field.name = name.to_owned();
            field.components = field.components[components.clone()].to_vec();
            field.coefficients = field.coefficients[components].to_vec();
            field.exact.clear();
            step.fields.truncate(1);
            step.reactions.clear();
            part.with_step(step)
        };
        let plain =
            part("displacement", 0..DISPLACEMENT, dataset.equation.clone().without_expansion());
        let heat = part(TEMPERATURE, DISPLACEMENT..DISPLACEMENT + 1, Equation::None);
        let (equation, report) = (dataset.equation.clone(), SolverReport::default());
        Ok(Some((plain, Self::new(heat, equation, report)?)))
    }
}

/// A step of a displacement with that of a temperature on the same patches as a third component.
pub(crate) fn joined(plain: &Step, heat: &Step) -> Step {
    let mut step = plain.clone();
    let numbers = heat.functions.iter().map(|new| number_of(&mut step.functions, new)).collect();
    step.fields[0] = joined_fields(&plain.fields[0], &heat.fields[0], numbers);
    step
}

/// The number of a function in a table, to which it is added if it is not there.
fn number_of(table: &mut Vec<Function>, new: &Function) -> u32 {
    let known = table.iter().position(|function| function.kind == new.kind);
    known.unwrap_or_else(|| {
        table.push(new.clone());
        table.len() - 1
    }) as u32
}

/// Displacement and temperature as one field. `numbers` has the numbers of the temperature's
/// functions in the joint table.
fn joined_fields(plain: &FieldData, heat: &FieldData, numbers: Vec<u32>) -> FieldData {
    let mut joined = FieldData::new(&plain.name, &["ux", "uy", TEMPERATURE]);
    joined.unit.clone_from(&plain.unit);
    for patch in 0..plain.patch_blocks.len() - 1 {
        let mut blocks: Vec<(u32, u8)> =
            plain.blocks(patch).map(|b| (plain.block_function[b], plain.block_degree[b])).collect();
        let mut places = Vec::new();
        for b in heat.blocks(patch) {
            let new = (numbers[heat.block_function[b] as usize], heat.block_degree[b]);
            let known = (0..blocks.len()).find(|k| blocks[*k] == new && !places.contains(k));
            places.push(known.unwrap_or(blocks.len()));
            blocks.extend(known.is_none().then_some(new));
        }
        joined.push_patch(&blocks);
        let first = joined.blocks(patch).start;
        for (place, block) in (first..).zip(plain.blocks(patch)) {
            (0..DISPLACEMENT).for_each(|c| copy(&mut joined, (place, c), plain, (block, c)));
        }
        for (place, block) in places.into_iter().zip(heat.blocks(patch)) {
            copy(&mut joined, (first + place, DISPLACEMENT), heat, (block, 0));
        }
    }
    joined
}

/// Copies the coefficients of a block and component.
fn copy(to: &mut FieldData, (place, c): (usize, usize), from: &FieldData, at: (usize, usize)) {
    let coefficients = from.block_coefficients(at.0, at.1);
    let start = to.block_offset[place] as usize;
    to.coefficients[c][start..start + coefficients.len()].copy_from_slice(coefficients);
}

/// A temperature that can be evaluated, and the body that it strains.
#[derive(Debug)]
pub(super) struct TemperatureField<'t> {
    field: Field<'t>,
    equation: &'t Equation,
    /// α and ν with their first derivatives; none of a constant.
    slopes: [Option<FormulaJets>; 2],
}

impl TemperatureField<'_> {
    /// The coefficient of expansion.
    pub(super) fn expansion(&self) -> Option<&Expression> {
        self.equation.expansion()
    }

    /// T with `D` derivatives at a point, on a face if it lies on one. NaN where no patch lies.
    fn jet<const D: usize>(&self, x: Vec2, face: FaceLocation) -> Jet<f64> {
        let (mut patches, mut jets) = (Vec::new(), [Jet::constant(f64::NAN)]);
        // also where rounding has put a point of a rim outside the domain
        self.field.tree.query_point(x, &mut patches);
        let (local, side) = match face {
            Some((segment, side)) => (self.field.on(segment, x), side),
            None => (self.field.at(x), Side::Above),
        };
        if !patches.is_empty() {
            local.over_patches::<f64, D>([0.0; 2], side, &patches, &mut jets);
        }
        jets[0]
    }

    /// The moduli of the body at a point, with the strains of the temperature.
    pub(super) fn moduli(&self, x: Vec2, face: FaceLocation) -> Moduli<f64> {
        self.equation.moduli(x, [0.0; 2]).heated(self.jet::<0>(x, face).v)
    }

    /// The derivative along `axis` of the strains in the plane that the temperature gives,
    /// (1 + ν) α T in plane strain, α T in plane stress and in bodies of revolution.
    pub(super) fn strain_slope(&self, x: Vec2, axis: Vec2) -> Strain {
        let along = |jets: &Option<FormulaJets>| {
            jets.as_ref().map_or(0.0, |jets| {
                let mut out = [0.0; 3];
                jets.evaluate(&[x.x, x.y], &mut Vec::new(), &mut out);
                out[1] * axis.x + out[2] * axis.y
            })
        };
        let Moduli { expansion, expansion_out, out_of_plane, .. } =
            self.equation.moduli(x, [0.0; 2]);
        let [of_expansion, of_poisson] = self.slopes.each_ref().map(along);
        let t = self.jet::<1>(x, None);
        let slope = expansion * (t.x * axis.x + t.y * axis.y) + of_expansion * t.v;
        if self.equation.is_axisymmetric() {
            return Strain::isotropic(slope);
        }
        Strain::isotropic(slope * (1.0 + out_of_plane) + of_poisson * expansion_out * t.v)
    }
}
