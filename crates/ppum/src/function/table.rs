//! A step's functions, ready to be evaluated.
//!
//! Functions that share their geometry form a *group* and are evaluated at once: the side of a crack,
//! the four Westergaard functions of a tip, one formula.

use std::sync::Arc;

use super::{Frame, Function, FunctionKind, WESTERGAARD, westergaard};
use crate::crack::{Crack, LocalCrack, LocalTip, Side, TipId};
use crate::formula::{
    DerivativeError, Formula, FormulaError, FormulaJets, Scope, ScopeError, Table,
};
use crate::jet::Jet;
use crate::real::{Real, Scalar};
use crate::vec2::{Vec2, vec2};

/// Where the value of a function is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The function is 1.
    One,
    /// One entry of a group.
    Jet {
        /// Index of the group.
        group: u32,
        /// Entry of the group, below [`GROUP`].
        entry: u32,
    },
}

/// The compiled function table of a step.
#[derive(Clone, Debug)]
pub struct FunctionTable {
    slots: Vec<Slot>,
    groups: Vec<Group>,
}

/// Largest number of functions in a group.
pub const GROUP: usize = 4;

#[derive(Clone, Debug)]
enum Group {
    Side(u32),
    Westergaard(TipId),
    Formula(Box<Compiled>),
}

#[derive(Clone, Debug)]
struct Compiled {
    jet: FormulaJets,
    frame: Frame,
}

/// A function's formula is wrong.
#[derive(Debug, thiserror::Error)]
#[error("function {index} (`{name}`): {source}")]
pub struct FunctionError {
    /// Index in the table.
    pub index: usize,
    /// Name of the function.
    pub name: String,
    /// What is wrong.
    pub source: Box<CompileError>,
}

/// Why a formula cannot be used as a function.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
#[non_exhaustive]
pub enum CompileError {
    /// Its text.
    Formula(#[from] FormulaError),
    /// Its parameters.
    Scope(#[from] ScopeError),
    /// Its derivatives.
    Derivative(#[from] DerivativeError),
}

impl FunctionTable {
    /// Compiles a table whose formulas may read `tables`.
    ///
    /// # Errors
    /// A formula that does not parse.
    pub fn new(functions: &[Function], tables: &[Arc<Table>]) -> Result<Self, FunctionError> {
        Self::compile(functions, tables, true)
    }

    /// Like [`FunctionTable::new`], but formulas are evaluated as such where there is a native kernel
    /// for them too.
    ///
    /// # Errors
    /// A formula that does not parse.
    pub fn of_formulas(
        functions: &[Function],
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        Self::compile(functions, tables, false)
    }

    fn compile(
        functions: &[Function],
        tables: &[Arc<Table>],
        kernels: bool,
    ) -> Result<Self, FunctionError> {
        let mut table = Self { slots: Vec::new(), groups: Vec::new() };
        for (index, function) in functions.iter().enumerate() {
            let slot = table.slot(&function.kind, tables, kernels).map_err(|source| {
                FunctionError { index, name: function.name.clone(), source: Box::new(source) }
            })?;
            table.slots.push(slot);
        }
        Ok(table)
    }

    fn slot(
        &mut self,
        kind: &FunctionKind,
        tables: &[Arc<Table>],
        kernels: bool,
    ) -> Result<Slot, CompileError> {
        Ok(match kind {
            FunctionKind::One => Slot::One,
            FunctionKind::Side { crack } => self.group(Group::Side(*crack), 0),
            FunctionKind::Formula { text, frame, parameters, .. } => {
                match native(text, *frame).filter(|_| kernels) {
                    Some((tip, k)) => self.group(Group::Westergaard(tip), k),
                    None => {
                        let formula = Formula::parse(text, &scope(parameters, tables)?)?;
                        let jet = FormulaJets::new(&[&formula], 2)?;
                        let compiled = Box::new(Compiled { jet, frame: *frame });
                        self.group(Group::Formula(compiled), 0)
                    }
                }
            }
        })
    }

    /// The slot of an entry of a group, which is made if there is none like it yet.
    fn group(&mut self, group: Group, entry: usize) -> Slot {
        let known = self.groups.iter().position(|known| match (known, &group) {
            (Group::Side(a), Group::Side(b)) => a == b,
            (Group::Westergaard(a), Group::Westergaard(b)) => a == b,
            _ => false,
        });
        let index = known.unwrap_or_else(|| {
            self.groups.push(group);
            self.groups.len() - 1
        });
        Slot::Jet { group: index as u32, entry: entry as u32 }
    }

    /// Where function `function` of the step is found.
    #[must_use]
    pub fn of(&self, function: u32) -> Slot {
        self.slots[function as usize]
    }

    /// Number of groups.
    #[must_use]
    pub fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Number of functions in a group, at most [`GROUP`].
    #[must_use]
    pub fn group_len(&self, group: usize) -> usize {
        match self.groups[group] {
            Group::Westergaard(_) => 4,
            Group::Side(_) | Group::Formula(_) => 1,
        }
    }

    /// The table as seen from an anchor.
    #[must_use]
    pub fn at(&self, cracks: &[Crack], anchor: Vec2) -> LocalFunctions<'_> {
        let seen = |group| match group {
            &Group::Side(crack) => {
                LocalGroup::Side(LocalCrack::new(&cracks[crack as usize], anchor))
            }
            &Group::Westergaard(tip) => LocalGroup::Westergaard(local_tip(cracks, tip, anchor)),
            Group::Formula(compiled) => {
                LocalGroup::Formula(&compiled.jet, LocalFrame::new(cracks, compiled.frame, anchor))
            }
        };
        LocalFunctions { table: self, groups: self.groups.iter().map(seen).collect() }
    }
}

/// The tip and index if a formula is one of the Westergaard functions in a tip's frame.
fn native(text: &str, frame: Frame) -> Option<(TipId, usize)> {
    let Frame::Tip(tip) = frame else { return None };
    WESTERGAARD.iter().position(|&known| known == text).map(|k| (tip, k))
}

fn scope(parameters: &[(String, f64)], tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    let mut tables = tables.iter();
    let scope =
        tables.try_fold(Scope::polar(), |scope, table| scope.with_table(Arc::clone(table)))?;
    let mut parameters = parameters.iter();
    parameters.try_fold(scope, |scope, (name, value)| scope.with_parameter(name, *value))
}

fn local_tip(cracks: &[Crack], tip: TipId, anchor: Vec2) -> LocalTip {
    LocalTip::new(&cracks[tip.crack as usize], tip.end, anchor)
}

/// The functions of a step seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalFunctions<'t> {
    table: &'t FunctionTable,
    groups: Vec<LocalGroup<'t>>,
}

#[derive(Clone, Debug)]
enum LocalGroup<'t> {
    Side(LocalCrack),
    Westergaard(LocalTip),
    Formula(&'t FormulaJets, LocalFrame),
}

impl<'t> LocalFunctions<'t> {
    /// The table these functions belong to.
    #[must_use]
    pub fn table(&self) -> &'t FunctionTable {
        self.table
    }

    /// Fills the jets of one group, with derivatives in the world. `out` holds
    /// [`FunctionTable::group_len`] jets at least.
    #[inline(always)]
    pub fn evaluate<R: Real, const D: usize>(
        &self,
        group: usize,
        offset: [R; 2],
        side: Side,
        out: &mut [Jet<R>],
    ) {
        match &self.groups[group] {
            LocalGroup::Side(crack) => out[0] = Jet::constant(crack.side(offset, side)),
            LocalGroup::Westergaard(tip) => {
                let [a, b, c, d] = westergaard::<R, D>(&tip.point(offset, side));
                let (x, y) = (offset[0].lit(tip.axis.x), offset[0].lit(tip.axis.y));
                out[0] = a.turned::<D>(x, y);
                out[1] = b.turned::<D>(x, y);
                out[2] = c.turned::<D>(x, y);
                out[3] = d.turned::<D>(x, y);
            }
            LocalGroup::Formula(formula, frame) => {
                out[0] = frame.jet::<R, D>(formula, offset, side);
            }
        }
    }
}

/// A formula's frame seen from an anchor.
#[derive(Clone, Debug)]
enum LocalFrame {
    Fixed { from_origin: Vec2, axis: Vec2 },
    Tip(LocalTip),
}

impl LocalFrame {
    fn new(cracks: &[Crack], frame: Frame, anchor: Vec2) -> Self {
        match frame {
            Frame::World => Self::Fixed { from_origin: anchor, axis: vec2(1.0, 0.0) },
            Frame::Fixed { origin, angle } => {
                Self::Fixed { from_origin: anchor - origin, axis: vec2(angle.cos(), angle.sin()) }
            }
            Frame::Tip(tip) => Self::Tip(local_tip(cracks, tip, anchor)),
        }
    }

    /// x, y, r, θ of a point, and the frame's x axis.
    fn coordinates(&self, offset: Vec2, side: Side) -> ([f64; 4], Vec2) {
        match self {
            Self::Fixed { from_origin, axis } => {
                let d = *from_origin + offset;
                let (x, y) = (axis.dot(d), axis.cross(d));
                ([x, y, x.hypot(y), y.atan2(x)], *axis)
            }
            Self::Tip(tip) => {
                let p = tip.point([offset.x, offset.y], side);
                let (r, theta) = p.polar();
                ([p.x, p.y, r, theta], tip.axis)
            }
        }
    }

    /// The formula at the lanes of `offset`, one lane after the other.
    fn jet<R: Real, const D: usize>(
        &self,
        formula: &FormulaJets,
        offset: [R; 2],
        side: Side,
    ) -> Jet<R> {
        let [mut xs, mut ys] = [[R::Scalar::default(); 16]; 2];
        offset[0].store(&mut xs);
        offset[1].store(&mut ys);
        let mut lanes = [[R::Scalar::default(); 16]; 6];
        let mut scratch = Vec::new();
        for k in 0..R::LANES {
            let point = vec2(xs[k].to_f64(), ys[k].to_f64());
            let (inputs, axis) = self.coordinates(point, side);
            let mut out = [0.0; 6];
            formula.evaluate(&inputs, &mut scratch, &mut out);
            let [v, x, y, xx, xy, yy] = out;
            let world = Jet { v, x, y, xx, xy, yy }.turned::<D>(axis.x, axis.y);
            let world = [world.v, world.x, world.y, world.xx, world.xy, world.yy];
            for (lane, value) in lanes.iter_mut().zip(world) {
                lane[k] = R::Scalar::from_f64(value);
            }
        }
        let [v, x, y, xx, xy, yy] = lanes.map(|lane| offset[0].load(&lane));
        Jet { v, x, y, xx, xy, yy }
    }
}
