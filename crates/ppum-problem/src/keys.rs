//! The keys of a problem file: one row a key, from which come what its reader knows, the ranges of
//! its numbers, the tables of `docs/problem-file.md`, its JSON schema, and what editors complete.

use ppum::cover::OVERLAP;
use ppum::crack::Side;
use ppum::dataset::{MAX_DEGREE, StressState};
use ppum::text::exact as digits;

use super::adaptivity::{AdaptKind, Keep};
use super::boundary::{self, Edge};
use super::discretization::{Enrichment, MAX_LEVEL, MOST_TERMS};
use super::enrichment::Site;
use super::growth::{Criterion, LoadControl};
use super::solver::SolverKind;
use super::words::{EquationKind, Words as _, words};
use EquationKind::{Elasticity, Poisson};
use Kind::{
    Array, Components, Constant, Either, Flag, List, Number, Table, Tables, Text, Value, Whole,
    Word,
};

/// A table of keys.
#[derive(Debug)]
pub struct KeyTable {
    /// As messages call it.
    pub name: &'static str,
    /// One that is written inline.
    pub example: &'static str,
    /// Its keys.
    pub keys: &'static [KeyRow],
}

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct KeyRow {
    /// Its name.
    pub name: &'static str,
    /// The values that it takes.
    pub kind: Kind,
    /// The range of its numbers.
    pub range: Range,
    /// The value where the key is left out; `None` if there is none.
    pub default: Option<&'static str>,
    /// True if the key may not be left out, with the equation that it belongs to.
    pub is_required: bool,
    /// A value, for messages.
    pub example: &'static str,
    /// The equation that it belongs to, and the keys that do for the other one what it does.
    pub equation: Option<(EquationKind, &'static [&'static str])>,
    /// What follows the range in messages.
    pub remedy: &'static str,
    /// Its meaning, for people.
    pub doc: &'static str,
}

/// The values that a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A text in quotes, of the kind that the words say.
    Text(&'static str),
    /// `true` or `false`.
    Flag,
    /// A number.
    Number,
    /// A number, or a formula of numbers in quotes.
    Constant,
    /// A whole number that is not negative.
    Whole,
    /// A number, or a formula of x and y in quotes.
    Value,
    /// One of some words.
    Word(fn() -> Vec<&'static str>),
    /// So many values: their name in the plural, the form of the array, and what each is.
    Array(usize, &'static str, &'static str, &'static Kind),
    /// Any number of values: what they are called, and what each is.
    List(&'static str, &'static Kind),
    /// A value or one of some words for each component of a vector.
    Components(&'static str, &'static [&'static str]),
    /// A table.
    Table(&'static KeyTable),
    /// Tables that are written one after the other.
    Tables(&'static KeyTable),
    /// One of several.
    Either(&'static [Kind]),
}

/// A range of numbers, whose ends may be open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The ends.
    pub ends: [f64; 2],
    /// Whether each end is outside.
    pub open: [bool; 2],
}

const fn within(from: f64, to: f64) -> Range {
    Range { ends: [from, to], open: [false; 2] }
}

impl Range {
    const fn with_open(self, open: [bool; 2]) -> Self {
        Self { open, ..self }
    }

    /// True of finite numbers in the range.
    pub(super) fn contains(self, value: f64) -> bool {
        let Self { ends: [from, to], open } = self;
        value.is_finite()
            && (value > from || !open[0] && value == from)
            && (value < to || !open[1] && value == to)
    }

    /// The range as it follows "must be"; empty if it has no ends.
    pub(super) fn words(self) -> String {
        let ends = self.ends.map(digits);
        match (self.ends.map(f64::is_finite), self.open) {
            ([false, false], _) => String::new(),
            ([true, true], [false, false]) => format!("{} to {}", ends[0], ends[1]),
            ([true, true], open) => {
                let from = if open[0] { "above" } else { "at least" };
                let to = if open[1] { "below" } else { "at most" };
                format!("{from} {} and {to} {}", ends[0], ends[1])
            }
            _ if self == POSITIVE => "positive and finite".to_owned(),
            _ if self == NOT_NEGATIVE => "finite and not negative".to_owned(),
            _ => format!("at least {}", ends[0]),
        }
    }
}

const ALL: Range = within(f64::NEG_INFINITY, f64::INFINITY);
const NOT_NEGATIVE: Range = within(0.0, f64::INFINITY);
const POSITIVE: Range = NOT_NEGATIVE.with_open([true, false]);
const DEGREE: Range = within(0.0, MAX_DEGREE as f64);

/// Segments of a curve; what asks for more has a cusp.
const SEGMENTS: Range = within(4.0, MOST_SEGMENTS as f64);

/// Most segments of one curve.
pub(super) const MOST_SEGMENTS: usize = 4096;

const POINT: Kind = Array(2, "numbers", "[x, y]", &Constant);
const AXES: Kind = Array(2, "half axes", "[a, b]", &Constant);
const SEGMENT: Kind = Array(2, "points", "[[x0, y0], [x1, y1]]", &POINT);
const POINTS: Kind = List("points [[x, y], …]", &POINT);
const NUMBERS: Kind = List("numbers", &Number);

const fn key(name: &'static str, kind: Kind) -> KeyRow {
    KeyRow {
        name,
        kind,
        range: ALL,
        default: None,
        is_required: false,
        example: "",
        equation: None,
        remedy: "",
        doc: "",
    }
}

impl KeyRow {
    const fn range(self, range: Range) -> Self {
        Self { range, ..self }
    }

    const fn default(self, default: &'static str) -> Self {
        Self { default: Some(default), ..self }
    }

    const fn required(self, example: &'static str) -> Self {
        Self { is_required: true, example, ..self }
    }

    const fn example(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    const fn only(self, equation: EquationKind, other: &'static [&'static str]) -> Self {
        Self { equation: Some((equation, other)), ..self }
    }

    const fn doc(self, doc: &'static str) -> Self {
        Self { doc, ..self }
    }

    const fn remedy(self, remedy: &'static str) -> Self {
        Self { remedy, ..self }
    }

    /// The mistake of a number that is out of range.
    pub(super) fn mistake(&self, value: f64) -> Option<String> {
        let remedy = if self.remedy.is_empty() { "" } else { "; " };
        let words = self.range.words();
        let message =
            || format!("is {}, but must be {words}{remedy}{}", digits(value), self.remedy);
        (!self.range.contains(value)).then(message)
    }

    /// True if a problem of this equation may have the key.
    pub(super) fn fits(&self, equation: Option<EquationKind>) -> bool {
        self.equation.is_none_or(|(own, _)| equation.is_none_or(|equation| own == equation))
    }
}

impl Kind {
    /// The table that values are, if they may be one.
    pub(super) fn table(self) -> Option<&'static KeyTable> {
        match self {
            Table(table) | Tables(table) => Some(table),
            Either(kinds) => kinds.iter().find_map(|kind| kind.table()),
            _ => None,
        }
    }

    /// The words that it may be, in quotes.
    fn all_words(self) -> Vec<String> {
        match self {
            Word(words) => words().iter().map(|word| format!("\"{word}\"")).collect(),
            Either(kinds) => kinds.iter().flat_map(|kind| kind.all_words()).collect(),
            _ => Vec::new(),
        }
    }

    /// A value of the kind as it follows "must be".
    pub(super) fn words(self) -> String {
        match self {
            Text(_) => "a text in quotes".to_owned(),
            Flag => "true or false".to_owned(),
            Number | Constant => "a number".to_owned(),
            Whole => "a whole number".to_owned(),
            Value => "a number or a formula in quotes".to_owned(),
            Word(_) => self.all_words().join(", "),
            Array(count, items, form, _) => {
                format!("{} {items} {form}", if count == 2 { "two" } else { "four" })
            }
            List(items, _) => format!("a list of {items}"),
            Components(..) => "an array of two, one per component".to_owned(),
            Table(table) | Tables(table) => format!("a table such as {}", table.example),
            Either(kinds) => kinds.iter().map(|kind| kind.words()).collect::<Vec<_>>().join(" or "),
        }
    }
}

impl KeyTable {
    /// The row of a key.
    pub(super) fn row(&self, name: &str) -> Option<&'static KeyRow> {
        self.keys.iter().find(|row| row.name == name)
    }
}

/// The parts of the border that have names of their own.
fn places() -> Vec<&'static str> {
    words::<Edge>().into_iter().chain([boundary::OUTLINE]).collect()
}

fn exact() -> Vec<&'static str> {
    vec!["exact"]
}

/// What may stand at a byte of a problem file: headings after a bracket, words after the sign of
/// equality, else keys of the table whose heading is the last before it; those of the text's
/// equation alone. For editors.
#[must_use]
pub fn completions(text: &str, at: usize) -> Vec<String> {
    let before = text.get(..at).unwrap_or_default();
    let (earlier, line) = before.rsplit_once('\n').unwrap_or(("", before));
    let line = line.trim_start();
    let is_heading = |line: &&str| {
        line.starts_with('[') && line.trim_start_matches('[').starts_with(char::is_alphabetic)
    };
    let heading = earlier.lines().rev().find(is_heading);
    let table = match heading.map(|line| line.trim().trim_matches(['[', ']'])) {
        None => Some(&ROOT),
        Some(path) => path.split('.').try_fold(&ROOT, |table, name| table.row(name)?.kind.table()),
    };
    let equation = equation_of(text);
    let fits = |row: &&KeyRow| row.fits(Some(equation));
    let rows = table.map_or(&[][..], |table| table.keys).iter().filter(fits);
    if line.starts_with('[') {
        let tables = ROOT.keys.iter().filter(fits).filter_map(|row| row.kind.table());
        return tables.map(|table| table.name.to_owned()).collect();
    }
    if let Some((key, _)) = line.split_once('=') {
        let row = rows.into_iter().find(|row| row.name == key.trim());
        return row.map_or(Vec::new(), |row| row.kind.all_words());
    }
    let is_key = line.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    rows.filter(|_| is_key).map(|row| row.name.to_owned()).collect()
}

/// The equation of a text that may be half written: the kind in its table `[equation]`.
fn equation_of(text: &str) -> EquationKind {
    let own = text.split_once("[equation]").map_or("", |(_, rest)| rest);
    let lines = own.lines().take_while(|line| !line.trim_start().starts_with('['));
    let values = lines.filter_map(|line| line.split_once('='));
    let kind = values.into_iter().find(|(key, _)| key.trim() == "kind");
    let names = |(word, _): &&(&str, EquationKind)| kind.is_some_and(|(_, v)| v.contains(word));
    EquationKind::WORDS.iter().find(names).map_or(Elasticity, |(_, kind)| *kind)
}

/// Tables by their names, each with an example if it is written inline, and a row for each key:
/// `key: kind, what else there is to say => "its meaning";`.
macro_rules! tables {
    ($($(#[$about:meta])* $vis:vis static $table:ident = $name:literal, $example:literal {
        $($key:ident: $kind:expr $(, $set:ident($($value:expr),*))* => $($doc:literal)+;)*
    })*) => {
        $($(#[$about])* $vis static $table: KeyTable = KeyTable {
            name: $name,
            example: $example,
            keys: &[$(key(stringify!($key), $kind)$(.$set($($value),*))*.doc(concat!($($doc),+))),*],
        };)*
    };
}

tables! {
    /// The whole file.
    pub static ROOT = "the problem file", "" {
        title: Text("text"), default("name of the file") => "The problem's name, one line.";
        domain: Table(&DOMAIN), required("min = [-1, -1]`, `max = [1, 1]") => "The plate: a box, or a body of any outline.";
        equation: Table(&EQUATION) => "The equation.";
        material: Table(&MATERIAL) => "The material; Poisson's equation may do without.";
        temperature: Table(&TEMPERATURE), only(Elasticity, &[]) => "The change of temperature.";
        strain: Table(&STRAIN), only(Elasticity, &[]) => "Strains that are given beside.";
        hole: Tables(&HOLE) => "A hole.";
        crack: Tables(&CRACK) => "A crack.";
        boundary: Tables(&BOUNDARY) => "Conditions on a part of the border.";
        force: Tables(&FORCE), only(Elasticity, &[]) => "A force at a point.";
        support: Tables(&SUPPORT), only(Elasticity, &[]) => "A point held against rigid motion.";
        body_force: Table(&BODY_FORCE), only(Elasticity, &["source"]) => "A force per unit area.";
        source: Table(&SOURCE), only(Poisson, &["body_force"]) => "A source.";
        exact: Table(&EXACT) => "The exact solution, for images of the error.";
        discretization: Table(&DISCRETIZATION), required("level = 5") => "Cells, local spaces and enrichment.";
        refine: Tables(&REFINE) => "Where cells are divided.";
        enrichment: Tables(&ENRICHMENT) => "User-defined functions of the local spaces.";
        table: Tables(&TABLE) => "Values that formulas read.";
        quantity: Tables(&QUANTITY) => "A named quantity, for `-q`.";
        adaptivity: Table(&ADAPTIVITY) => "Steps that improve the cover where the error is large.";
        growth: Table(&GROWTH) => "Steps in which cracks grow.";
        solver: Table(&SOLVER) => "The linear solver.";
    }

    static DOMAIN = "[domain]", "" {
        min: POINT, example("[-1.0, -1.0]") => "Lower left corner; required without `outline`.";
        max: POINT, example("[1.0, 1.0]") => "Upper right corner; larger than `min` in both directions.";
        outline: Table(&OUTLINE) => "The outline of the body. With `min` and `max`, which may be left out then, the body is what it and the box have in common.";
    }

    /// A closed curve around the body.
    static OUTLINE = "`outline`", "{ points = [[0, 0], [2, 0], [0, 1]] }" {
        points: POINTS =>
            "The corners of a polygon, three or more, clockwise or counter-clockwise; it may not cross itself.";
        ellipse: Table(&WHOLE_ELLIPSE) => "Instead: an ellipse.";
        spline: POINTS => "Instead: a smooth closed curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&RIM_PIECE)) =>
            "Instead: several pieces, each starting where the previous one ends, the first where the last one ends.";
        segments: Whole, range(SEGMENTS), default("see [curves](#curves)") => "The number of segments of each curve.";
    }

    static EQUATION = "[equation]", "" {
        kind: Word(words::<EquationKind>), default("\"elasticity\""), example("\"elasticity\"") => "The equation.";
    }

    static MATERIAL = "[material]", "" {
        young: Value, required("1.0"), range(POSITIVE), only(Elasticity, &["conductivity"]) => "Young's modulus E > 0.";
        poisson: Value, required("0.3"), only(Elasticity, &["conductivity"]) =>
            "Poisson's ratio, −1 < ν < 0.5 in plane strain, −1 < ν ≤ 0.5 in plane stress.";
        state: Word(words::<StressState>), required("\"plane-strain\""), only(Elasticity, &[]) =>
            "The assumption about the third direction: ε_zz = 0 or σ_zz = 0.";
        expansion: Value, default("none"), example("1.2e-5"), only(Elasticity, &[]) =>
            "Coefficient α of thermal expansion, for `[temperature]`.";
        conductivity: Value, range(POSITIVE), default("1"), only(Poisson, &["young", "poisson", "state"]) =>
            "Conductivity κ > 0.";
    }

    static TEMPERATURE = "[temperature]", "" {
        value: Value, example("\"100*y\"") =>
            "The change of temperature ΔT since there was no stress; it strains the body by α ΔT in all directions.";
        problem: Text("text"), example("\"heat.toml\"") =>
            "Instead: the problem file of Poisson's equation whose solution ΔT is, on the same body with the same "
            "cracks; or its text, of several lines.";
    }

    static STRAIN = "[strain]", "" {
        xx: Value, default("0") =>
            "The strain ε⁰_xx that makes no stress where the body takes it: of growth, swelling, phases.";
        yy: Value, default("0") => "ε⁰_yy.";
        xy: Value, default("0") => "ε⁰_xy, half the change of a right angle.";
        zz: Value, default("0") => "ε⁰_zz; without effect in plane stress.";
    }

    static HOLE = "[[hole]]", "" {
        center: POINT, example("[0.0, 0.0]") => "Centre of a circle.";
        radius: Number, range(POSITIVE), example("0.5") => "Its radius.";
        points: POINTS =>
            "Instead: the corners of a polygon, three or more, clockwise or counter-clockwise; it may not cross "
            "itself.";
        ellipse: Table(&WHOLE_ELLIPSE) => "Instead: an ellipse.";
        spline: POINTS => "Instead: a smooth closed curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&RIM_PIECE)) =>
            "Instead: several pieces, each starting where the previous one ends, the first where the last one ends.";
        segments: Whole, range(SEGMENTS), default("see [curves](#curves)") => "The number of segments of each curve.";
    }

    static CRACK = "[[crack]]", "" {
        points: POINTS, example("[[-0.5, 0.0], [0.5, 0.0]]") => "A polyline of at least two points.";
        arc: Table(&ARC) => "Instead: an arc of a circle.";
        ellipse: Table(&ELLIPSE) => "Instead: a part of an ellipse.";
        spline: POINTS => "Instead: a smooth curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&PIECE)) =>
            "Instead: several of `points`, `arc`, `ellipse`, `spline`, each starting where the previous one ends.";
        segments: Whole, range(SEGMENTS), default("see [curves](#curves)") => "The number of segments of each curve.";
        contact: Flag, default("false"), only(Elasticity, &[]) =>
            "`true`: its faces press on each other where they touch, instead of overlapping; see "
            "[contact](#contact).";
        friction: Number, range(NOT_NEGATIVE), default("0"), only(Elasticity, &[]) =>
            "Coulomb's coefficient μ of friction between faces that touch.";
    }

    /// A piece of a path.
    static PIECE = "a piece of `path`", "{ points = [[0, 0], [1, 0]] }" {
        points: POINTS => "A polyline of at least two points.";
        arc: Table(&ARC) => "Instead: an arc of a circle.";
        ellipse: Table(&ELLIPSE) => "Instead: a part of an ellipse.";
        spline: POINTS => "Instead: a smooth curve through three or more points.";
    }

    /// A piece of an outline or of the rim of a hole.
    static RIM_PIECE = "a piece of `path`", "{ points = [[0, 0], [1, 0]], name = \"base\" }" {
        points: POINTS => "A polyline of at least two points.";
        arc: Table(&ARC) => "Instead: an arc of a circle.";
        ellipse: Table(&ELLIPSE) => "Instead: a part of an ellipse.";
        spline: POINTS => "Instead: a smooth curve through three or more points.";
        name: Text("name") => "A name for `on = { piece = … }`; several pieces may have it.";
    }

    /// An arc of a circle.
    static ARC = "`arc`", "{ center = [0, 0], radius = 1, from = 0, to = 90 }" {
        center: POINT, required("[0, 0]") => "The centre.";
        radius: Constant, required("1"), range(POSITIVE) => "The radius.";
        from: Constant, required("0") => "The angle at which it begins, in degrees.";
        to: Constant, required("90") => "The angle at which it ends, in degrees.";
    }

    /// A part of an ellipse.
    static ELLIPSE = "`ellipse`", "{ center = [0, 0], axes = [2, 1], from = 0, to = 90 }" {
        center: POINT, required("[0, 0]") => "The centre.";
        axes: AXES, required("[2, 1]"), range(POSITIVE) => "The semi-axes.";
        angle: Constant, default("0") => "The angle of the first axis to the x axis, in degrees.";
        from: Constant, required("0") => "The angle at which it begins, in degrees from the first axis.";
        to: Constant, required("90") => "The angle at which it ends.";
    }

    /// A whole ellipse.
    static WHOLE_ELLIPSE = "`ellipse`", "{ center = [0, 0], axes = [2, 1] }" {
        center: POINT, required("[0, 0]") => "The centre.";
        axes: AXES, required("[2, 1]"), range(POSITIVE) => "The semi-axes.";
        angle: Constant, default("0") => "The angle of the first axis to the x axis, in degrees.";
    }

    static BOUNDARY = "[[boundary]]", "" {
        on: Either(&[Word(places), Table(&ON)]), required("\"top\"") =>
            "Where: an edge, a piece of one, the outline, the rim of a hole, a piece with a name, the faces of a "
            "crack; see below.";
        displacement: Either(&[Components("[ux, uy]", &["free", "exact"]), Word(exact)]), default("free"),
            only(Elasticity, &["value"]) =>
            "Each component is a value, `\"free\"`, or `\"exact\"`.";
        traction: Components("[tx, ty]", &["free"]), default("free"), only(Elasticity, &["flux"]) =>
            "The traction σ n, n outwards; each component is a value, or `\"free\"`.";
        pressure: Value, only(Elasticity, &[]) => "A pressure p, that is, the traction −p n.";
        symmetry: Flag, only(Elasticity, &[]) => "On straight parts of the border: the normal displacement is 0, the tangential one free.";
        antisymmetry: Flag, only(Elasticity, &[]) => "On straight parts of the border: the tangential displacement is 0, the normal one free.";
        value: Either(&[Value, Word(exact)]), default("free"), only(Poisson, &["displacement"]) => "The value of u.";
        exchange: Value, only(Poisson, &[]) =>
            "A coefficient h > 0: `value` is that of the surroundings, κ ∂u/∂n = h (value − u).";
        flux: Value, default("free"), only(Poisson, &["traction"]) => "The flux κ ∂u/∂n into the plate, n outwards.";
    }

    /// A part of the border.
    static ON = "`on`", "" {
        edge: Word(words::<Edge>), example("\"top\"") => "A piece of this edge.";
        from: Number, default("start") =>
            "Start of the part: its y on the left and right, its x at the bottom and top; of a `piece` the length along it.";
        to: Number, default("end") => "End of the part, larger than `from`.";
        hole: Whole => "The rim of this hole, except the parts in other holes or outside the box.";
        piece: Text("name") => "The pieces of outline and rims with this name, or, with `from` or `to`, a part of one.";
        crack: Whole => "The faces of this crack.";
        face: Word(words::<Side>), default("both") => "Only the face that bounds the material on this side.";
    }

    static FORCE = "[[force]]", "" {
        at: POINT, required("[0.0, 0.0]") =>
            "The point, inside, on a straight part of the border, or on a crack; at no corner and no tip.";
        value: Array(2, "numbers", "[fx, fy]", &Constant), required("[0.0, -1.0]") =>
            "The force on the body, per unit of thickness.";
        face: Word(words::<Side>) => "On a crack: the face that bounds the material on this side.";
    }

    static SUPPORT = "[[support]]", "" {
        at: POINT, required("[0.0, 0.0]") => "The point, in the body or on its border, but on no crack.";
        displacement: Components("[ux, uy]", &["free"]), default("[0, 0]") =>
            "Each component is a number, or `\"free\"`.";
    }

    static BODY_FORCE = "[body_force]", "" {
        value: Components("[fx, fy]", &[]), required("[0.0, -1.0]") => "The force f per unit area.";
    }

    static SOURCE = "[source]", "" {
        value: Value, required("1.0") => "The source f.";
    }

    static EXACT = "[exact]", "" {
        displacement: Components("[ux, uy]", &[]), required("[\"x*y\", \"x + y\"]"), only(Elasticity, &["value"]) =>
            "Each component is a value.";
        value: Value, required("\"x*y\""), only(Poisson, &["displacement"]) => "The potential.";
    }

    static DISCRETIZATION = "[discretization]", "" {
        level: Whole, range(within(0.0, MAX_LEVEL as f64)), example("5") =>
            "4^level equal cells: 2^level along each side of the box; if the box is more than twice as long as wide, "
            "more along it and fewer across, so that no cell is more than twice as long as wide.";
        cells: Array(2, "whole numbers", "[nx, ny]", &Whole), range(within(1.0, f64::INFINITY)) =>
            "nx × ny equal cells, at most 4¹⁰ in all.";
        points: Text("text") =>
            "Name of a file of points. Cells are divided into four until none contains more than one point.";
        accuracy: Number, range(within(1e-9, 0.5)) =>
            "The requested relative error of K (for a K below 1 % of the K that the stress around the tip suggests, "
            "relative to that 1 %); if no tip has a K, as with Poisson's equation, the error of the energy. Cells are "
            "divided and orders raised until the estimated error is that small. No cells need be given: the first "
            "cover has level 2, below 1e-3 level 3, with automatic refinement. The keys of "
            "[`[adaptivity]`](#adaptivity) set the bounds, by default 30 steps and 100,000 unknowns; the warning "
            "`tolerance` says if a bound is reached first, or if the segments of a [curved crack](#curves) err by more.";
        refine: Flag, default("true") =>
            "Refine the cells where the field needs it: around tips, where a tip has little clearance, where the rim "
            "of a polygon would cross a patch twice, towards [singular points](#singular-points), at round holes and "
            "in ligaments. `false` keeps the base cells, except for [`[[refine]]`](#refine).";
        order: Either(&[Whole, Value]), range(DEGREE), default("2, see below") =>
            "Degree of the local polynomials. A formula of `x` and `y` is evaluated at each patch's centre and "
            "rounded. See [validation](validation.md#rates-beside-a-tip) for rates.";
        overlap: Number, range(within(*OVERLAP.start(), *OVERLAP.end())), default("1.3"),
            remedy("1.3 to 1.5 is the useful range") =>
            "α: a patch is its cell enlarged by this factor. Towards 1, patches overlap in ever thinner strips, and "
            "the solution gets stiffer (error of K 2e-3 at 1.01 instead of 4e-4, for the plate above with level 3); "
            "towards 2, more patches cover each point, which costs time.";
        weight: Text("name or formula"), default("\"linear\"") =>
            "The weight function: `\"linear\"`, `\"quadratic\"`, `\"cubic\"` (B-splines), `\"bump\"`, `\"cosine\"`, "
            "`\"wendland\"`, or a formula of `t` = |ξ|, positive for 0 ≤ t < 1 and zero at t = 1, such as `\"exp(1 - "
            "1/((1 - t)*(1 + t)))\"`.";
        enrichment: Word(words::<Enrichment>), default("\"williams\"") =>
            "The functions of the local spaces besides polynomials.";
        interfaces: Flag, default("true") => "Resolve the interfaces at which the [material](#material) jumps.";
        enrichment_radius: Number, range(POSITIVE), default("see below") => "Radius of the zone around each tip.";
        tip_degree: Whole, range(DEGREE), default("1"), remedy("1 is the default") =>
            "Degree of the polynomials that multiply the tip functions on patches that contain a tip; not with "
            "`\"williams\"`.";
        tip_terms: Whole, range(within(1.0, MOST_TERMS as f64)), default("the order of the patch, from 3 to 6") =>
            "With `\"williams\"`: number N of terms of Williams' series, r^½ to r^(N − ½).";
    }

    static REFINE = "[[refine]]", "" {
        size: Value, required("0.01"), range(POSITIVE) =>
            "The longest side that a cell may have there, positive: a number or a formula of `x` and `y`.";
        box: Array(4, "numbers", "[x0, y0, x1, y1]", &Constant) =>
            "Where: a box by its lower left and its upper right corner.";
        center: POINT, example("[0.0, 0.0]") => "Instead: a disc, by its centre.";
        radius: Constant, range(POSITIVE), example("0.5") => "Its radius.";
        hole: Whole => "Instead: the rim of this hole; the first `[[hole]]` is 0.";
        crack: Whole => "Instead: this crack; the first `[[crack]]` is 0.";
        distance: Constant, range(NOT_NEGATIVE), default("0") =>
            "Cells nearer than this to the box, the disc, the rim or the crack are divided as well.";
    }

    static ENRICHMENT = "[[enrichment]]", "" {
        function: Text("formula or name"), example("\"abs(y)\"") =>
            "A formula of the frame's `x`, `y`, `r`, `theta`, of `side(k)`, the side +1 or −1 of crack k, and of the "
            "parameters; or the name of a library function. One of `function` and `functions` is required.";
        functions: List("formulas in quotes", &Text("text")) => "Several of them.";
        parameters: Table(&PARAMETERS), default("those of the library function") => "Named constants.";
        at: Either(&[POINT, Word(words::<Site>)]) =>
            "The origin of the frame; `\"tips\"`: one frame at every tip, x along the growth direction, θ jumps on "
            "the crack.";
        angle: Constant, default("0") => "With a point in `at`: angle of the frame's x axis, in radians.";
        along: SEGMENT =>
            "Instead of `at`: origin at the first point, x towards the second; `y` is the distance to the line, "
            "positive on its left.";
        radius: Number, range(NOT_NEGATIVE), default("see below") =>
            "The patches whose support is nearer than this to the point, the tip or the segment.";
        where: Text("condition") =>
            "Instead of `radius`: the patches where a condition on the plate's x and y, such as `\"x < 0.3\"`, holds "
            "at the centre, a corner or the middle of an edge.";
        degree: Whole, range(DEGREE), default("0") =>
            "Degree of the polynomials; at tips, `tip_degree` on the patches that contain the tip.";
        kinks: List("segments [[[x0, y0], [x1, y1]], …]", &SEGMENT) =>
            "Segments, in the frame, across which the function or its slope jumps; only those that its formula does "
            "not show.";
        singular: POINTS =>
            "Points, in the frame, where it or its slope is infinite; only those that its formula does not show.";
        name: Text("text") => "Its name in reports.";
    }

    static PARAMETERS = "`parameters`", "{ lambda = 0.6 }" {
    }

    static TABLE = "[[table]]", "" {
        name: Text("word"), required("\"stiffness\"") => "Its name in formulas.";
        x: NUMBERS, example("[0.0, 0.5, 1.0]") => "Knots, two or more.";
        y: NUMBERS => "Knots of the second argument, if there is one.";
        values: List("numbers, or of rows", &Either(&[Number, NUMBERS])), example("[1.0, 2.0, 4.0]") =>
            "One per knot; with `y` a list of rows, one for each knot in y.";
        file: Text("text") =>
            "Instead of `x`, `y`, `values`: a file, its path relative to the problem file's folder, with `x,value` on "
            "each line, or a grid with `,x1,x2,…` on the first line and `y,v1,v2,…` on the others.";
    }

    static QUANTITY = "[[quantity]]", "" {
        name: Text("word"), required("\"slip\"") => "Its name; not that of a built-in quantity.";
        formula: Text("formula"), required("\"sqrt(ux^2 + uy^2)\"") =>
            "May use x, y, the components `ux`, `uy` (or `u`), derivatives `dux_dx`, …, built-in quantities with `_` "
            "for `-` (`von_mises`), the material's constants, the quantities before it, and tables.";
        unit: Text("text") => "For labels.";
    }

    static ADAPTIVITY = "[adaptivity]", "" {
        kind: Word(words::<AdaptKind>), default("\"h\"") =>
            "`\"h\"` divides cells; `\"p\"` raises their order, up to 8; `\"hp\"` raises it where the field is "
            "smooth, and divides elsewhere.";
        steps: Whole, range(within(1.0, 100.0)), default("10"), remedy("10 is the default") =>
            "Maximum number of improvements.";
        fraction: Number, range(within(0.0, 1.0).with_open([true, false])), default("0.6"),
            remedy("0.6 is the default") =>
            "The cells with this share of the square of the estimated error are improved (Dörfler 1996). Small shares "
            "give fewer unknowns and more steps.";
        max_unknowns: Whole, range(within(1.0, f64::INFINITY)), default("100000") =>
            "A step with more unknowns is not made.";
        tolerance: Number, range(within(0.0, 1.0).with_open([true; 2])), remedy("it is a part of the solution") =>
            "Stop when the estimated error in the energy norm, relative to the norm of the solution, is at most this. "
            "If another bound ends the steps first, a warning says so.";
        keep: Word(words::<Keep>), default("\"last\"") =>
            "The steps that the dataset keeps. With `\"all\"`, `ppum render --steps` and `ppum plot --convergence` "
            "show all of them.";
    }

    static GROWTH = "[growth]", "" {
        steps: Whole, required("20"), range(within(1.0, 1e5)) => "Maximum number of increments.";
        criterion: Word(words::<Criterion>), default("\"hoop\"") =>
            "The direction in which a tip advances: that of the largest hoop stress, that in which K_II vanishes at "
            "the end of the increment, or that in which most energy is released.";
        increment: Constant, range(POSITIVE), default("automatic"), remedy("leave it out to have it chosen") =>
            "Length by which the fastest tip grows in a step. By default a quarter of the shortest crack that has a "
            "tip, at most 1/50 of the plate's shorter side, but less where paths turn by more than 0.1 (5.7°) in it, "
            "down to an eighth of that; from one step to the next it changes by a factor of two at most.";
        toughness: Value, range(POSITIVE), default("none") =>
            "K_c > 0 at a point: a tip whose strength is less stays. Without it every tip advances. A formula that is "
            "not positive and finite at a tip is an error in the first step; later it ends the series.";
        load: Word(words::<LoadControl>), default("\"constant\"") =>
            "`\"critical\"`: the loads of each step are multiplied by the factor at which the strongest tip, relative "
            "to its toughness, reaches the toughness. Tips within 1 % of it advance, all others stay. Fields, stress "
            "intensity factors, reactions and energies of the step are those under this load; the factor is the "
            "step's `load`.";
        paris: Table(&PARIS) =>
            "Growth under cyclic loads: the strongest tip grows by `increment`, others by what they grow in the same "
            "number of cycles, once that is half an increment. If a strength reaches the toughness, the series ends.";
    }

    /// The law of Paris.
    static PARIS = "`paris`", "{ c = 1e-10, m = 3 }" {
        c: Constant, required("1e-10"), range(POSITIVE) =>
            "The factor c in da/dN = c ΔK^m, with ΔK = (1 − ratio) × strength (Paris & Erdogan 1963).";
        m: Constant, required("3"), range(within(0.0, 100.0)), remedy("2 to 4 is usual") => "The exponent m.";
        threshold: Constant, range(NOT_NEGATIVE), default("0") => "Tips with ΔK up to this stay.";
        ratio: Constant, range(within(-1e3, 1.0).with_open([false, true])), default("0"),
            remedy("it is the smallest load of a cycle in parts of the largest") =>
            "The ratio of the smallest to the largest load of a cycle.";
    }

    static SOLVER = "[solver]", "" {
        kind: Word(words::<SolverKind>), default("\"auto\"") =>
            "`\"direct\"` is a sparse Cholesky factorisation; `\"multilevel\"` is conjugate gradients with a "
            "hierarchy of coarser covers, which takes a fifth of the memory, and time in proportion to the unknowns. "
            "`\"auto\"` uses the direct solver up to some hundred thousand unknowns, and the multilevel solver if it "
            "takes less time, or if the factor does not fit into memory or takes more than 4 GB. If the multilevel "
            "solver does not converge, as on pieces without supports, the direct solver replaces it, with a warning, "
            "if there is enough memory.";
        tolerance: Number, range(within(1e-14, 1.0).with_open([false, true])), default("1e-12"),
            remedy("it is a part of the solution") =>
            "Relative error in the energy norm that the multilevel solver may leave, estimated by its residual; at "
            "least 1e-14. With the default, fields and K agree with those of the direct solver to 1e-9, unless "
            "materials differ by factors of 1e5 and more, where rounding limits the accuracy of both.";
        kernels: Flag, default("true") =>
            "`false` evaluates the formulas of built-in functions instead of the kernels that replace them: slower, "
            "with the same results to rounding.";
    }
}
