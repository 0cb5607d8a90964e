//! A step's functions, ready to be evaluated.
//!
//! Functions that share their geometry form a *group* and are evaluated at once: the side of a
//! crack, a component's indicator, the four Westergaard functions of a tip, formulas in one frame
//! that follow each other.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use super::anchored::AnchoredCracks;
use super::formulas::{FormulaGroup, GROUP, LocalFormulas};
use super::indicator::{Cut, LocalIndicator};
use super::kinds::{Frame, Function, FunctionKind};
use super::westergaard::westergaard;
use crate::crack::{Crack, LocalCrack, LocalTip, SegmentId, Side, TipId, TipPoint};
use crate::jet::Jet;
use crate::library::WESTERGAARD;
use crate::vec2::Vec2;
use ppum_formula::real::Real;
use ppum_formula::{
    BlockScratch, DerivativeError, Formula, FormulaError, Scope, ScopeError, Table,
};

/// The place of a function's value in a compiled table.
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

/// Least cost of a group in [`FunctionTable::cost`]: it is found, kept for a point or a tile of an
/// image, and turned into the world.
const LEAST_COST: usize = 256;

#[derive(Clone, Debug)]
enum Group {
    Side(u32),
    Westergaard(TipId),
    Component(Vec<Cut>),
    Level(u32),
    Formulas(FormulaGroup),
}

/// How a group of functions depends on the level fields of a mesh: the patch that holds a point
/// evaluates them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LevelUse {
    /// It is the sign of this one.
    Sign(u32),
    /// They are x and y of its frame.
    Frame([u32; 2]),
}

/// A function's formula is wrong.
#[derive(Debug, thiserror::Error)]
#[error("function {index} (`{name}`): {source}")]
pub struct FunctionError {
    /// Index in the table.
    pub index: usize,
    /// Name of the function.
    pub name: String,
    /// The error.
    pub source: Box<CompileError>,
}

/// A reason for which a formula cannot be used as a function.
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
    /// All functions together.
    TooLarge(#[from] TooLarge),
}

/// The functions of a step are too many or too long to be kept and compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the functions up to this one have {count} {what} together; at most {most} may be")]
pub struct TooLarge {
    count: usize,
    what: &'static str,
    most: usize,
}

/// Bytes of all formulas of a table.
const MAX_TEXT: usize = 1 << 22;
/// Names that the formulas of a table know: cracks, tables and parameters, counted for
/// each function.
const MAX_NAMES: usize = 1 << 20;
/// Parameters of a function: each is compared with all others, and looked for wherever a formula
/// has a name.
const MAX_PARAMETERS: usize = 1 << 10;
/// Operations of all different formulas of a table with two derivatives: a hundred megabytes.
const MAX_OPERATIONS: usize = 1 << 20;
/// Operations that each different formula counts as beside its own: what it takes to compile and
/// keep even `x`.
const FORMULA: usize = 32;

impl FunctionTable {
    /// Compiles a table for a step with this number of cracks, whose formulas may read `tables`.
    ///
    /// # Errors
    /// A formula that does not parse.
    pub fn new(
        functions: &[Function],
        cracks: usize,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        Compiler { kernels: true, ..Compiler::new(cracks, tables) }.compile(functions)
    }

    /// Like [`FunctionTable::new`], but formulas are evaluated as such where there is a native
    /// kernel for them too.
    ///
    /// # Errors
    /// A formula that does not parse.
    pub fn of_formulas(
        functions: &[Function],
        cracks: usize,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        Compiler::new(cracks, tables).compile(functions)
    }

    /// The place of function `function` of the step.
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
        match &self.groups[group] {
            Group::Westergaard(_) => 4,
            Group::Side(_) | Group::Component(_) | Group::Level(_) => 1,
            Group::Formulas(formulas) => formulas.len(),
        }
    }

    /// Cost of an evaluation of a group with its first derivatives: operations, and segments of
    /// cracks. The cost of every group is included.
    ///
    /// # Panics
    /// If the cracks are not those of the table's step.
    #[must_use]
    pub fn cost(&self, group: usize, cracks: &[Crack]) -> usize {
        let segments = |crack: u32| cracks[crack as usize].points.len();
        LEAST_COST
            + match &self.groups[group] {
                Group::Side(crack) => segments(*crack),
                Group::Westergaard(tip) => segments(tip.crack),
                Group::Component(cuts) => cuts.len(),
                Group::Level(_) => 0,
                Group::Formulas(formulas) => formulas.cost(cracks),
            }
    }

    /// How a group depends on level fields; `None` if it does not.
    pub(crate) fn level_use(&self, group: usize) -> Option<LevelUse> {
        match &self.groups[group] {
            Group::Level(field) => Some(LevelUse::Sign(*field)),
            Group::Formulas(formulas) => formulas.levels().map(LevelUse::Frame),
            _ => None,
        }
    }

    /// The table as seen from an anchor. The local form of a group is computed when it is first
    /// requested.
    #[must_use]
    pub fn at<'t>(&'t self, cracks: &'t [Crack], anchor: Vec2) -> LocalFunctions<'t> {
        LocalFunctions::new(self, AnchoredCracks { cracks, anchor, on: None })
    }

    /// The table as seen from an anchor, for points that lie on a segment of a crack: what depends
    /// on that crack is evaluated on it, on the side that is asked for, wherever rounding has put
    /// the points. All else goes by their position.
    ///
    /// # Panics
    /// If there is no such segment.
    #[must_use]
    pub fn on<'t>(
        &'t self,
        cracks: &'t [Crack],
        segment: SegmentId,
        anchor: Vec2,
    ) -> LocalFunctions<'t> {
        assert!((segment.crack as usize) < cracks.len(), "there is no crack {}", segment.crack);
        LocalFunctions::new(self, AnchoredCracks { cracks, anchor, on: Some(segment) })
    }
}

/// Makes a table.
struct Compiler<'a> {
    cracks: usize,
    tables: &'a [Arc<Table>],
    /// Use native kernels where there are.
    kernels: bool,
    sides: BTreeMap<u32, u32>,
    tips: BTreeMap<TipId, u32>,
    groups: Vec<GroupDraft>,
    /// Bytes of formulas, and names in their scopes.
    text: usize,
    names: usize,
}

fn limit(count: usize, what: &'static str, most: usize) -> Result<(), TooLarge> {
    if count <= most { Ok(()) } else { Err(TooLarge { count, what, most }) }
}

/// Formulas that are compiled, found by their texts and parameters.
#[derive(Default)]
struct CompiledFormulas {
    compiled: BTreeMap<String, FormulaGroup>,
    operations: usize,
}

impl CompiledFormulas {
    /// The formulas in their frame, compiled if they are new. `function` is the first of them.
    fn compile(
        &mut self,
        function: &Function,
        formulas: Vec<Formula>,
        frame: Frame,
    ) -> Result<FormulaGroup, CompileError> {
        let key = key(function, &formulas);
        let like = self.compiled.get(&key).and_then(|known| known.with_frame(&formulas, frame));
        if let Some(known) = like {
            return Ok(known);
        }
        let new = FormulaGroup::new(formulas, frame)?;
        self.operations += new.operations() + FORMULA * new.len();
        limit(self.operations, "operations", MAX_OPERATIONS)?;
        self.compiled.insert(key, new.clone());
        Ok(new)
    }
}

/// Texts and parameters: formulas that differ have different ones.
fn key(function: &Function, formulas: &[Formula]) -> String {
    let parameters = match &function.kind {
        FunctionKind::Formula { parameters, .. } => parameters.as_slice(),
        _ => &[],
    };
    let texts = formulas.iter().map(|formula| format!("{}\0", formula.text()));
    let parameters =
        parameters.iter().map(|(name, value)| format!("{name}={:x}\0", value.to_bits()));
    texts.chain(parameters).collect()
}

/// A group to be.
enum GroupDraft {
    Side(u32),
    Westergaard(TipId),
    Component(Vec<Cut>),
    Level(u32),
    /// Formulas, and the function that is the first of them.
    Formulas(usize, Frame, Vec<Formula>),
}

impl<'a> Compiler<'a> {
    fn new(cracks: usize, tables: &'a [Arc<Table>]) -> Self {
        let (sides, tips) = (BTreeMap::new(), BTreeMap::new());
        let groups = Vec::new();
        Self { cracks, tables, kernels: false, sides, tips, groups, text: 0, names: 0 }
    }

    fn compile(mut self, functions: &[Function]) -> Result<FunctionTable, FunctionError> {
        let error = |index: usize, source| {
            let name = functions[index].name.clone();
            FunctionError { index, name, source: Box::new(source) }
        };
        let mut slots = Vec::with_capacity(functions.len());
        for (index, function) in functions.iter().enumerate() {
            slots.push(self.slot(index, &function.kind).map_err(|e| error(index, e))?);
        }
        let (mut known, mut groups) =
            (CompiledFormulas::default(), Vec::with_capacity(self.groups.len()));
        for draft in self.groups {
            groups.push(match draft {
                GroupDraft::Side(crack) => Group::Side(crack),
                GroupDraft::Westergaard(tip) => Group::Westergaard(tip),
                GroupDraft::Component(cuts) => Group::Component(cuts),
                GroupDraft::Level(field) => Group::Level(field),
                GroupDraft::Formulas(first, frame, formulas) => {
                    let compiled = known.compile(&functions[first], formulas, frame);
                    Group::Formulas(compiled.map_err(|e| error(first, e))?)
                }
            });
        }
        Ok(FunctionTable { slots, groups })
    }

    /// Counts a formula and what it knows before it is read.
    fn count(&mut self, text: &str, parameters: usize) -> Result<(), TooLarge> {
        self.text += text.len();
        self.names += self.cracks + self.tables.len() + parameters;
        limit(parameters, "parameters of it", MAX_PARAMETERS)?;
        limit(self.text, "bytes of formulas", MAX_TEXT)?;
        limit(self.names, "cracks, tables and parameters in formulas", MAX_NAMES)
    }

    fn slot(&mut self, index: usize, kind: &FunctionKind) -> Result<Slot, CompileError> {
        let new = self.groups.len() as u32;
        Ok(match kind {
            FunctionKind::One => Slot::One,
            FunctionKind::Side { crack } => {
                let group = *self.sides.entry(*crack).or_insert(new);
                self.slot_of(group, 0, || GroupDraft::Side(*crack))
            }
            FunctionKind::Component { cuts } => {
                self.slot_of(new, 0, || GroupDraft::Component(cuts.clone()))
            }
            FunctionKind::Level { field } => self.slot_of(new, 0, || GroupDraft::Level(*field)),
            FunctionKind::Formula { text, frame, parameters, .. } => {
                match native(text, *frame).filter(|_| self.kernels) {
                    Some((tip, entry)) => {
                        let group = *self.tips.entry(tip).or_insert(new);
                        self.slot_of(group, entry, || GroupDraft::Westergaard(tip))
                    }
                    None => {
                        self.count(text, parameters.len())?;
                        let scope = function_scope(parameters, self.cracks, self.tables)?;
                        self.formula(index, *frame, Formula::parse(text, &scope)?)
                    }
                }
            }
        })
    }

    /// The slot of an entry of a group, which is made if it is new.
    fn slot_of(&mut self, group: u32, entry: u32, draft: impl FnOnce() -> GroupDraft) -> Slot {
        if group as usize == self.groups.len() {
            self.groups.push(draft());
        }
        Slot::Jet { group, entry }
    }

    /// The slot of a formula: in the last group if that is of its kind and has room.
    fn formula(&mut self, index: usize, frame: Frame, formula: Formula) -> Slot {
        if let Some(GroupDraft::Formulas(_, of, formulas)) = self.groups.last_mut()
            && *of == frame
            && formulas.len() < GROUP
            && formulas[0].scope() == formula.scope()
        {
            let entry = formulas.len() as u32;
            formulas.push(formula);
            return Slot::Jet { group: self.groups.len() as u32 - 1, entry };
        }
        let group = self.groups.len() as u32;
        self.slot_of(group, 0, || GroupDraft::Formulas(index, frame, vec![formula]))
    }
}

/// The tip and index if a formula is one of the [Westergaard functions](WESTERGAARD) in a tip's
/// frame: then [`westergaard()`] evaluates it.
#[must_use]
pub fn native(text: &str, frame: Frame) -> Option<(TipId, u32)> {
    let Frame::Tip(tip) = frame else { return None };
    (0..).zip(WESTERGAARD).find(|(_, known)| *known == text).map(|(k, _)| (tip, k))
}

/// The names that the formula of a function may use: x, y, r, theta of its frame, its parameters,
/// the sides of the step's cracks, the tables.
///
/// # Errors
/// Parameters or tables whose names are none or clash.
pub fn function_scope(
    parameters: &[(String, f64)],
    cracks: usize,
    tables: &[Arc<Table>],
) -> Result<Scope, ScopeError> {
    let scope = Scope::polar().with_sides(cracks).with_tables(tables)?;
    let mut parameters = parameters.iter();
    parameters.try_fold(scope, |scope, (name, value)| scope.with_parameter(name, *value))
}

/// The functions of a step seen from an anchor.
///
/// A step may have far more functions than are needed near an anchor, so each is formed when it is
/// first asked for, and the places for them are made in pages.
#[derive(Clone, Debug)]
pub struct LocalFunctions<'t> {
    table: &'t FunctionTable,
    cracks: AnchoredCracks<'t>,
    /// Groups of a page.
    page: usize,
    pages: Vec<OnceLock<FunctionPage<'t>>>,
}

type FunctionPage<'t> = Vec<OnceLock<LocalGroup<'t>>>;

#[derive(Clone, Debug)]
enum LocalGroup<'t> {
    Side(LocalCrack<'t>),
    Westergaard(LocalTip<'t>),
    Component(LocalIndicator),
    /// Known on a patch alone.
    Level,
    Formulas(LocalFormulas<'t>),
}

impl<'t> LocalFunctions<'t> {
    /// As many pages as a page has places.
    fn new(table: &'t FunctionTable, cracks: AnchoredCracks<'t>) -> Self {
        let page = table.groups.len().isqrt() + 1;
        Self { table, cracks, page, pages: vec![OnceLock::new(); page] }
    }

    #[inline(always)]
    fn group(&self, group: usize) -> &LocalGroup<'t> {
        let formed =
            self.pages[group / self.page].get().and_then(|page| page[group % self.page].get());
        formed.unwrap_or_else(|| self.form(group))
    }

    #[cold]
    fn form(&self, group: usize) -> &LocalGroup<'t> {
        let page = self.pages[group / self.page].get_or_init(|| vec![OnceLock::new(); self.page]);
        page[group % self.page].get_or_init(|| match &self.table.groups[group] {
            &Group::Side(crack) => LocalGroup::Side(self.cracks.crack(crack)),
            &Group::Westergaard(tip) => LocalGroup::Westergaard(self.cracks.tip(tip)),
            Group::Component(cuts) => {
                LocalGroup::Component(LocalIndicator::new(cuts, &self.cracks))
            }
            Group::Level(_) => LocalGroup::Level,
            Group::Formulas(formulas) => LocalGroup::Formulas(formulas.anchored(&self.cracks)),
        })
    }

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
        match self.group(group) {
            LocalGroup::Side(crack) => out[0] = Jet::constant(crack.side(offset, side)),
            LocalGroup::Component(of) => out[0] = Jet::constant(of.value(offset, side)),
            LocalGroup::Westergaard(tip) => {
                let [a, b, c, d] = at_tip::<R, D>(tip, offset, side);
                (out[0], out[1], out[2], out[3]) = (a, b, c, d);
            }
            LocalGroup::Level => out[0] = Jet::constant(offset[0].broadcast(f64::NAN)),
            LocalGroup::Formulas(formulas) => formulas.evaluate::<R, D>(offset, side, out),
        }
    }

    /// Fills the jets of a group of formulas at a point that is known in their frame too, with
    /// derivatives by x and y of the frame [of level fields](Frame::Levels).
    #[inline(always)]
    pub(crate) fn evaluate_in_frame<R: Real, const D: usize>(
        &self,
        group: usize,
        point: &TipPoint<R>,
        (offset, side): ([R; 2], Side),
        out: &mut [Jet<R>],
    ) {
        if let LocalGroup::Formulas(formulas) = self.group(group) {
            formulas.evaluate_at::<R, D>(point, offset, side, out);
        }
    }

    /// Fills the jets of one group at many vectors of points: faster than one by one for formulas.
    #[inline(always)]
    pub fn fill<R: Real, const D: usize>(
        &self,
        group: usize,
        offsets: &[[R; 2]],
        side: Side,
        scratch: &mut BlockScratch<R::Scalar>,
        out: &mut [[Jet<R>; GROUP]],
    ) {
        if let LocalGroup::Formulas(formulas) = self.group(group) {
            formulas.fill::<R, D>(offsets, side, scratch, out);
            return;
        }
        let mut k = 0;
        while k < offsets.len() {
            self.evaluate::<R, D>(group, offsets[k], side, &mut out[k]);
            k += 1;
        }
    }

    /// The tip of a group, if its functions are the four of [`westergaard()`]: [`at_tip`] evaluates
    /// them. Callers check this before a loop over points, which then needs no choice and keeps the
    /// functions in registers.
    #[inline(always)]
    #[must_use]
    pub fn tip(&self, group: usize) -> Option<&LocalTip<'t>> {
        match self.group(group) {
            LocalGroup::Westergaard(tip) => Some(tip),
            _ => None,
        }
    }

    /// True if a group is evaluated by a kernel, not by formulas.
    #[must_use]
    pub fn is_native(&self, group: usize) -> bool {
        !matches!(self.table.groups[group], Group::Formulas(_))
    }
}

/// The functions of [`westergaard()`] at a tip, with derivatives in the world.
#[inline(always)]
pub fn at_tip<R: Real, const D: usize>(
    tip: &LocalTip<'_>,
    offset: [R; 2],
    side: Side,
) -> [Jet<R>; 4] {
    let [a, b, c, d] = westergaard::<R, D>(&tip.point(offset, side));
    let (x, y) = (offset[0].broadcast(tip.axis.x), offset[0].broadcast(tip.axis.y));
    [a.turned::<D>(x, y), b.turned::<D>(x, y), c.turned::<D>(x, y), d.turned::<D>(x, y)]
}
