//! Functions and coefficients as quadrature looks at them.

use crate::quadrature::{CrackFace, Probes};
use ppum::crack::{Crack, Side};
use ppum::formula::{DerivativeError, Formula, Table};
use ppum::function::{Function, FunctionError, FunctionKind, FunctionTable, GROUP, Slot};
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use std::sync::Arc;

/// A scalar with its gradient.
#[derive(Clone, Debug)]
pub(crate) enum Probe {
    /// A function of a step's table.
    Function { table: FunctionTable, cracks: Arc<[Crack]> },
    /// A coefficient of the equation: a formula of x and y, its derivatives.
    Coefficient(Box<[Formula; 3]>),
    /// A load or a given value, and the mean of its absolute value.
    Load { formula: Formula, mean: f64 },
}

impl Probe {
    /// A function of a step with these cracks.
    pub(crate) fn function(
        function: &Function,
        cracks: &Arc<[Crack]>,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        let table = FunctionTable::new(std::slice::from_ref(function), cracks.len(), tables)?;
        Ok(Self::Function { table, cracks: Arc::clone(cracks) })
    }

    /// A formula in the frame of a function, with its parameters.
    pub(crate) fn part_of(
        function: &Function,
        text: &str,
        cracks: &Arc<[Crack]>,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        let mut part = function.clone();
        if let FunctionKind::Formula { text: whole, .. } = &mut part.kind {
            *whole = text.to_owned();
        }
        Self::function(&part, cracks, tables)
    }

    pub(crate) fn coefficient(formula: &Formula) -> Result<Self, DerivativeError> {
        let derivatives = [formula.derivative("x")?, formula.derivative("y")?];
        let [x, y] = derivatives;
        Ok(Self::Coefficient(Box::new([formula.clone(), x, y])))
    }

    /// Operations of an evaluation, about.
    pub(crate) fn operations(&self) -> usize {
        match self {
            Self::Function { table, cracks } => match table.of(0) {
                Slot::Jet { group, .. } => table.cost(group as usize, cracks),
                Slot::One => 0,
            },
            Self::Coefficient(formulas) => formulas.iter().map(|f| f.text().len()).sum(),
            Self::Load { formula, .. } => formula.text().len(),
        }
    }

    /// Value and gradient at `anchor + offset`.
    pub(crate) fn jet(&self, anchor: Vec2, offset: Vec2) -> [f64; 3] {
        let mut out = Vec::with_capacity(1);
        self.jets(anchor, &[offset], None, &mut out);
        out[0]
    }

    /// Appends values and gradients at several points, which may lie on a face of a crack.
    fn jets(
        &self,
        anchor: Vec2,
        offsets: &[Vec2],
        face: Option<CrackFace>,
        out: &mut Vec<[f64; 3]>,
    ) {
        match self {
            Self::Function { table, cracks } => {
                let Slot::Jet { group, entry } = table.of(0) else { return };
                let seen = match face {
                    Some(CrackFace { segment, .. }) => table.on(cracks, segment, anchor),
                    None => table.at(cracks, anchor),
                };
                let side = face.map_or(Side::Above, |face| face.side);
                out.extend(offsets.iter().map(|offset| {
                    let mut jets = [Jet::constant(0.0); GROUP];
                    let place = [offset.x, offset.y];
                    seen.evaluate::<f64, 1>(group as usize, place, side, &mut jets);
                    let jet = jets[entry as usize];
                    [jet.v, jet.x, jet.y]
                }));
            }
            Self::Coefficient(formulas) => out.extend(offsets.iter().map(|&offset| {
                let p = anchor + offset;
                formulas.each_ref().map(|formula| formula.evaluate(&[p.x, p.y]))
            })),
            Self::Load { formula, .. } => {
                let mut scratch = Vec::new();
                out.extend(offsets.iter().map(|&offset| {
                    let p = anchor + offset;
                    [formula.evaluate_with(&[p.x, p.y], &mut scratch), 0.0, 0.0]
                }));
            }
        }
    }
}

/// The probes of a space, by their places in the list.
#[derive(Clone, Debug, Default)]
pub(super) struct ProbeList(pub(super) Vec<Probe>);

impl Probes for ProbeList {
    fn evaluate(
        &self,
        function: u32,
        (anchor, offsets): (Vec2, &[Vec2]),
        face: Option<CrackFace>,
        out: &mut Vec<[f64; 3]>,
    ) {
        self.0[function as usize].jets(anchor, offsets, face, out);
    }

    fn load(&self, function: u32) -> Option<f64> {
        match self.0[function as usize] {
            Probe::Load { mean, .. } => Some(mean),
            _ => None,
        }
    }
}
