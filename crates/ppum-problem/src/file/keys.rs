//! The keys of a problem file: one row a key, from which come what its reader knows, the ranges of
//! its numbers, the tables of `docs/problem`, the JSON schema, and what editors complete.

use std::fmt::Debug;

use ppum::cover::OVERLAP;
use ppum::crack::Side;
use ppum::dataset::{MAX_DEGREE, StressState};

pub use super::key_kinds::{KeyRow, KeyTable, Kind, NumberRange};
use EquationKind::{Elasticity, Poisson};
use Kind::{
    Array, Components, Constant, Either, Flag, List, Number, Table, Tables, Text, Value, Whole,
    Word,
};

use super::key_kinds::{NOT_NEGATIVE, POSITIVE, key, within};
use crate::data::{
    AdaptKind, Adaptivity, BaseCells, Criterion, Discretization, DomainEdge, Enrichment,
    EquationKind, Keyword as _, LoadControl, MAX_LEVEL, MOST_TERMS, OUTLINE as WHOLE_OUTLINE, Site,
    SolverKind, SolverSettings, StepsKept, words,
};

const DEGREE: NumberRange = within(0.0, MAX_DEGREE as f64);

const POINT: Kind = Array(2, "numbers", "[x, y]", &Constant);
const AXES: Kind = Array(2, "half axes", "[a, b]", &Constant);
const SEGMENT: Kind = Array(2, "points", "[[x0, y0], [x1, y1]]", &POINT);
const POINTS: Kind = List("points [[x, y], …]", &POINT);
const NUMBERS: Kind = List("numbers", &Number);
const BLOCK: Kind = Array(3, "numbers", "[n, max, min]", &Constant);

const EXPONENT: NumberRange = within(0.0, 100.0);
const USUAL: &str = "; 2 to 4 is usual";

/// The end of messages about numbers with a default.
const IS_DEFAULT: &str = "; {} is the default";

/// A default as problem files have it.
fn toml(value: impl Debug) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

fn discretization() -> Discretization {
    Discretization::new(BaseCells::Level(0))
}

/// The parts of the boundary that have names of their own.
fn places() -> Vec<&'static str> {
    words::<DomainEdge>().into_iter().chain([WHOLE_OUTLINE]).collect()
}

fn exact() -> Vec<&'static str> {
    vec!["exact"]
}

/// Lists the keys and values that fit at a byte of a problem file: headings after a bracket, words
/// after the sign of equality, else keys of the table whose heading is the last before it; those of
/// the text's equation alone. For editors.
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

/// Values along the axes of an anisotropic body.
const BY_AXES: Kind = List("numbers or formulas", &Value);

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
        title: Text("text"), default(|| "name of the file".into()) => "The problem's name, one line.";
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
        bulges: NUMBERS =>
            "With `points`: a number for each edge, the last one back to the first corner, as in DXF: tan(φ/4) of an "
            "arc that turns left by φ (1 is half a circle), 0 of a straight edge.";
        ellipse: Table(&WHOLE_ELLIPSE) => "Instead: an ellipse.";
        spline: POINTS => "Instead: a smooth closed curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&RIM_PIECE)) =>
            "Instead: several pieces, each starting where the previous one ends, the first where the last one ends.";
        segments: Whole => "Has no effect any more: curves are exact.";
    }

    static EQUATION = "[equation]", "" {
        kind: Word(words::<EquationKind>), default(|| toml(Elasticity.word())), example("\"elasticity\"") => "The equation.";
        axisymmetric: Flag, default(|| toml(false)), only(Poisson, &[]) =>
            "The body is one of revolution about x = 0, and x ≥ 0 the distance from the axis. With elasticity write "
            "`state = \"axisymmetric\"`.";
    }

    static MATERIAL = "[material]", "" {
        young: Either(&[Value, BY_AXES]), required("1.0"), range(POSITIVE), only(Elasticity, &["conductivity"]) =>
            "Young's modulus E > 0; of an anisotropic body [E1, E2], in plane strain [E1, E2, E3].";
        poisson: Either(&[Value, BY_AXES]), required("0.3"), only(Elasticity, &["conductivity"]) =>
            "Poisson's ratio, −1 < ν < 0.5 in plane strain, −1 < ν ≤ 0.5 in plane stress; of an anisotropic body "
            "[ν12], in plane strain [ν12, ν13, ν23], with ν12/E1 = ν21/E2.";
        shear: Value, example("9.66"), range(POSITIVE), only(Elasticity, &["conductivity"]) =>
            "Shear modulus G12 of an anisotropic body.";
        axis: Value, default(|| "0".into()), example("30"), only(Elasticity, &[]) =>
            "Angle of the first axis of an anisotropic body from the x axis, in degrees; a formula where fibres are "
            "curved.";
        stiffness: List("three rows of moduli", &List("three moduli", &Value)), only(Elasticity, &["conductivity"]),
            example("[[10, 3, 0], [3, 8, 0], [0, 0, 2]]") =>
            "Instead of `young`, `poisson` and `shear`: [[c11, c12, c16], [c12, c22, c26], [c16, c26, c66]] along the "
            "axes, of stresses to the strains ε11, ε22 and 2ε12.";
        out_of_plane: List("moduli", &Value), only(Elasticity, &[]), example("[4, 3, 0, 9]") =>
            "With `stiffness` in plane strain: [c13, c23, c36, c33].";
        state: Word(words::<StressState>), required("\"plane-strain\""), only(Elasticity, &[]) =>
            "The assumption about the third direction: ε_zz = 0, σ_zz = 0, or a body of revolution about x = 0.";
        expansion: Either(&[Value, BY_AXES]), default(|| "none".into()), example("1.2e-5"), only(Elasticity, &[]) =>
            "Coefficient α of thermal expansion, for `[temperature]`; of an anisotropic body also [α1, α2] or "
            "[α1, α2, α3] along its axes.";
        conductivity: Value, range(POSITIVE), default(|| "1".into()), only(Poisson, &["young", "poisson", "state"]) =>
            "Conductivity κ > 0.";
    }

    static TEMPERATURE = "[temperature]", "" {
        value: Value, example("\"100*y\"") =>
            "The change of temperature ΔT since there was no stress; it strains the body by α ΔT in all directions.";
        problem: Text("text"), example("\"heat.toml\"") =>
            "Instead: the problem file of Poisson's equation whose solution ΔT is, on this body; or its text, of "
            "several lines.";
    }

    static STRAIN = "[strain]", "" {
        xx: Value, default(|| "0".into()) =>
            "The strain ε⁰_xx that makes no stress where the body takes it: of growth, swelling, phases.";
        yy: Value, default(|| "0".into()) => "ε⁰_yy.";
        xy: Value, default(|| "0".into()) => "ε⁰_xy, half the change of a right angle.";
        zz: Value, default(|| "0".into()) =>
            "ε⁰_zz; without effect in plane stress, the hoop strain in a body of revolution.";
    }

    static HOLE = "[[hole]]", "" {
        center: POINT, example("[0.0, 0.0]") => "Centre of a circle.";
        radius: Number, range(POSITIVE), example("0.5") => "Its radius.";
        points: POINTS =>
            "Instead: the corners of a polygon, three or more, clockwise or counter-clockwise; it may not cross "
            "itself.";
        bulges: NUMBERS =>
            "With `points`: a number for each edge, the last one back to the first corner, as in DXF: tan(φ/4) of an "
            "arc that turns left by φ (1 is half a circle), 0 of a straight edge.";
        ellipse: Table(&WHOLE_ELLIPSE) => "Instead: an ellipse.";
        spline: POINTS => "Instead: a smooth closed curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&RIM_PIECE)) =>
            "Instead: several pieces, each starting where the previous one ends, the first where the last one ends.";
        segments: Whole => "Has no effect any more: curves are exact.";
    }

    pub(super) static CRACK = "[[crack]]", "" {
        points: POINTS, example("[[-0.5, 0.0], [0.5, 0.0]]") => "A polyline of at least two points.";
        bulges: NUMBERS =>
            "With `points`: a number for each edge, as in DXF: tan(φ/4) of an arc that turns left by φ (1 is half a "
            "circle, negative turns right), 0 of a straight edge.";
        arc: Table(&ARC) => "Instead: an arc of a circle.";
        ellipse: Table(&ELLIPSE) => "Instead: a part of an ellipse.";
        spline: POINTS => "Instead: a smooth curve through three or more points.";
        path: List("pieces such as { arc = { … } }", &Table(&PIECE)) =>
            "Instead: several of `points`, `arc`, `ellipse`, `spline`, each starting where the previous one ends.";
        segments: Whole => "Has no effect any more: curves are exact.";
        contact: Flag, default(|| toml(false)), only(Elasticity, &[]) =>
            "`true`: its faces press on each other where they touch, instead of overlapping; see "
            "[contact](contact.md).";
        friction: Number, range(NOT_NEGATIVE), default(|| "0".into()), only(Elasticity, &[]) =>
            "Coulomb's coefficient μ of friction between faces that touch.";
    }

    /// A piece of an outline or of the rim of a hole.
    static RIM_PIECE = "a piece of `path`", "{ points = [[0, 0], [1, 0]], name = \"base\" }" {
        points: POINTS => "A polyline of at least two points.";
        bulges: NUMBERS =>
            "With `points`: a number for each edge, as in DXF: tan(φ/4) of an arc that turns left by φ (1 is half a "
            "circle, negative turns right), 0 of a straight edge.";
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
        angle: Constant, default(|| "0".into()) => "The angle of the first axis to the x axis, in degrees.";
        from: Constant, required("0") => "The angle at which it begins, in degrees from the first axis.";
        to: Constant, required("90") => "The angle at which it ends.";
    }

    pub(super) static BOUNDARY = "[[boundary]]", "" {
        on: Either(&[Word(places), Table(&ON)]), required("\"top\"") =>
            "Where: an edge, a piece of one, the outline, the rim of a hole, a piece with a name, the faces of a "
            "crack; see below.";
        displacement: Either(&[Components("[ux, uy]", &["free", "exact"]), Word(exact)]), default(|| "free".into()),
            only(Elasticity, &["value"]) =>
            "Each component is a value, `\"free\"`, or `\"exact\"`.";
        traction: Components("[tx, ty]", &["free"]), default(|| "free".into()), only(Elasticity, &["flux"]) =>
            "The traction σ n, n outwards; each component is a value, or `\"free\"`.";
        pressure: Value, only(Elasticity, &[]) => "A pressure p, that is, the traction −p n.";
        symmetry: Flag, only(Elasticity, &[]) => "On straight parts of the border: the normal displacement is 0, the tangential one free.";
        antisymmetry: Flag, only(Elasticity, &[]) => "On straight parts of the border: the tangential displacement is 0, the normal one free.";
        value: Either(&[Value, Word(exact)]), default(|| "free".into()), only(Poisson, &["displacement"]) => "The value of u.";
        exchange: Value, only(Poisson, &[]) =>
            "A coefficient h > 0: `value` is that of the surroundings, κ ∂u/∂n = h (value − u).";
        flux: Value, default(|| "free".into()), only(Poisson, &["traction"]) => "The flux κ ∂u/∂n into the plate, n outwards.";
    }

    /// A part of the boundary.
    static ON = "`on`", "" {
        edge: Word(words::<DomainEdge>), example("\"top\"") => "A piece of this edge.";
        from: Number, default(|| "start".into()) =>
            "Start of the part: its y on the left and right, its x at the bottom and top; of a `piece` the length along it.";
        to: Number, default(|| "end".into()) => "End of the part, larger than `from`.";
        hole: Whole => "The rim of this hole, except the parts in other holes or outside the box.";
        piece: Text("name") => "The pieces of outline and rims with this name, or, with `from` or `to`, a part of one.";
        crack: Whole => "The faces of this crack.";
        face: Word(words::<Side>), default(|| "both".into()) => "Only the face that bounds the material on this side.";
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
        displacement: Components("[ux, uy]", &["free"]), default(|| "[0, 0]".into()) =>
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
            "[`[adaptivity]`](accuracy.md#adaptivity) set the bounds, by default 30 steps and 100,000 unknowns; "
            "the warning `tolerance` says if a bound is reached first.";
        refine: Flag, default(|| toml(discretization().refine)) =>
            "Refine the cells where the field needs it: around tips, where a tip has little clearance, where the rim "
            "of a polygon would cross a patch twice, towards [singular points](#singular-points), at round holes and "
            "in ligaments. `false` keeps the base cells, except for [`[[refine]]`](#refine).";
        order: Either(&[Whole, Value]), range(DEGREE), default(|| "2, see below".into()) =>
            "Degree of the local polynomials. A formula of `x` and `y` is evaluated at each patch's centre and "
            "rounded. See [validation](../validation.md#rates-beside-a-tip) for rates.";
        overlap: Number, range(within(*OVERLAP.start(), *OVERLAP.end())), default(|| toml(discretization().overlap)),
            remedy("; 1.3 to 1.5 is the useful range") =>
            "α: a patch is its cell enlarged by this factor. Towards 1, patches overlap in ever thinner strips, and "
            "the solution gets stiffer (error of K 2e-3 at 1.01 instead of 4e-4, for the first example with level 3); "
            "towards 2, more patches cover each point, which costs time.";
        weight: Text("name or formula"), default(|| "\"linear\"".into()) =>
            "The weight function: `\"linear\"`, `\"quadratic\"`, `\"cubic\"` (B-splines), `\"bump\"`, `\"cosine\"`, "
            "`\"wendland\"`, or a formula of `t` = |ξ|, positive for 0 ≤ t < 1 and zero at t = 1, such as `\"exp(1 - "
            "1/((1 - t)*(1 + t)))\"`.";
        enrichment: Word(words::<Enrichment>), default(|| toml(discretization().enrichment.word())) =>
            "The functions of the local spaces besides polynomials.";
        interfaces: Flag, default(|| toml(discretization().interfaces)) =>
            "Resolve the interfaces at which the [material](material.md#material) jumps.";
        enrichment_radius: Number, range(POSITIVE), default(|| "see below".into()) => "Radius of the zone around each tip.";
        tip_degree: Whole, range(DEGREE), default(|| toml(discretization().tip_degree)), remedy(IS_DEFAULT) =>
            "Degree of the polynomials that multiply the tip functions on patches that contain a tip; not with "
            "`\"williams\"`.";
        tip_terms: Whole, range(within(1.0, MOST_TERMS as f64)), default(|| "the order of the patch, from 3 to 6; on arcs one more than the order, from 3 to 7".into()) =>
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
        distance: Constant, range(NOT_NEGATIVE), default(|| "0".into()) =>
            "Cells nearer than this to the box, the disc, the rim or the crack are divided as well.";
    }

    static ENRICHMENT = "[[enrichment]]", "" {
        function: Text("formula or name"), example("\"abs(y)\"") =>
            "A formula of the frame's `x`, `y`, `r`, `theta`, of `side(k)`, the side +1 or −1 of crack k, and of the "
            "parameters; or the name of a library function. One of `function` and `functions` is required.";
        functions: List("formulas in quotes", &Text("text")) => "Several of them.";
        parameters: Table(&PARAMETERS), default(|| "those of the library function".into()) => "Named constants.";
        at: Either(&[POINT, Word(words::<Site>)]) =>
            "The origin of the frame; `\"tips\"`: one frame at every tip, x along the growth direction, θ jumps on "
            "the crack.";
        angle: Constant, default(|| "0".into()) => "With a point in `at`: angle of the frame's x axis, in radians.";
        along: SEGMENT =>
            "Instead of `at`: origin at the first point, x towards the second; `y` is the distance to the line, "
            "positive on its left.";
        radius: Number, range(NOT_NEGATIVE), default(|| "see below".into()) =>
            "The patches whose support is nearer than this to the point, the tip or the segment.";
        where: Text("condition") =>
            "Instead of `radius`: the patches where a condition on the plate's x and y, such as `\"x < 0.3\"`, holds "
            "at the centre, a corner or the middle of an edge.";
        degree: Whole, range(DEGREE), default(|| "0, or `tip_degree`".into()) =>
            "Degree of the polynomials; by default `tip_degree` on the patches that contain a tip, with `at = "
            "\"tips\"`, and 0 on all others.";
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
        kind: Word(words::<AdaptKind>), default(|| toml(Adaptivity::default().kind.word())) =>
            "`\"h\"` divides cells; `\"p\"` raises their order, up to 8; `\"hp\"` raises it where the field is "
            "smooth, and divides elsewhere.";
        steps: Whole, range(within(1.0, 100.0)), default(|| toml(Adaptivity::default().steps)), remedy(IS_DEFAULT) =>
            "Maximum number of improvements.";
        fraction: Number, range(within(0.0, 1.0).with_open([true, false])), default(|| toml(Adaptivity::default().fraction)),
            remedy(IS_DEFAULT) =>
            "The cells with this share of the square of the estimated error are improved (Dörfler 1996). Small shares "
            "give fewer unknowns and more steps.";
        max_unknowns: Whole, range(within(1.0, f64::INFINITY)), default(|| toml(Adaptivity::default().max_unknowns)) =>
            "A step with more unknowns is not made.";
        tolerance: Number, range(within(0.0, 1.0).with_open([true; 2])), remedy("; it is a part of the solution") =>
            "Stop when the estimated error in the energy norm, relative to the norm of the solution, is at most this. "
            "If another bound ends the steps first, a warning says so.";
        keep: Word(words::<StepsKept>), default(|| toml(Adaptivity::default().keep.word())) =>
            "The steps that the dataset keeps. With `\"all\"`, `ppum render --steps` and `ppum plot --convergence` "
            "show all of them.";
    }

    static GROWTH = "[growth]", "" {
        steps: Whole, required("20"), range(within(1.0, 1e5)) => "Maximum number of increments.";
        criterion: Word(words::<Criterion>), default(|| toml(Criterion::default().word())) =>
            "The direction in which a tip advances: that of the largest hoop stress, that in which K_II vanishes at "
            "the end of the increment, or that in which most energy is released.";
        increment: Constant, range(POSITIVE), default(|| "automatic".into()), remedy("; leave it out to have it chosen") =>
            "Length by which the fastest tip grows in a step. By default a quarter of the shortest crack that has a "
            "tip, at most 1/50 of the plate's shorter side, but less where paths turn by more than 0.1 (5.7°) in it, "
            "down to an eighth of that; from one step to the next it changes by a factor of two at most.";
        toughness: Value, range(POSITIVE), default(|| "none".into()) =>
            "K_c > 0 at a point: a tip whose strength is less stays. A formula may use `direction`, the angle of the new "
            "path from the x axis in radians: then the hoop stress over it is largest. Without it every tip advances. A formula that is "
            "not positive and finite at a tip is an error in the first step; later it ends the series.";
        load: Word(words::<LoadControl>), default(|| toml(LoadControl::default().word())) =>
            "`\"critical\"`: the loads of each step are multiplied by the factor at which the strongest tip, relative "
            "to its toughness, reaches the toughness. Tips within 1 % of it advance, all others stay. Fields, stress "
            "intensity factors, reactions and energies of the step are those under this load; the factor is the "
            "step's `load`.";
        rate: Text("formula"), example("\"1e-10*dk^3\"") =>
            "Growth by a law: da/dN of a tip per cycle, or da/dt per unit of time. It may use `dk`, `kmax`, `k1`, `k2`, `t_stress`, "
            "`ratio`, `extension`, `n`, `x`, `y`, `toughness`, `opening` and tables. The fastest tip grows by "
            "`increment`, others by what they grow in the same cycles, once that is half an increment. A tip whose rate "
            "is 0 stays. If K reaches the toughness, the series ends.";
        paris: Table(&PARIS) => "Instead of `rate`: da/dN = c ΔK^m (Paris & Erdogan 1963).";
        walker: Table(&WALKER) => "Instead: da/dN = c (ΔK (1 − ratio)^(γ − 1))^m, and c K_max^m where the ratio is negative (Walker 1970).";
        forman: Table(&FORMAN) => "Instead: da/dN = c ΔK^m / ((1 − ratio) K_c − ΔK) with the `toughness` K_c (Forman et al. 1967).";
        nasgro: Table(&NASGRO) =>
            "Instead: da/dN = c ((1 − f)/(1 − ratio) ΔK)^m (1 − ΔK_th/ΔK)^p / (1 − K_max/K_c)^q with the `toughness` "
            "K_c and the opening ratio f of `closure` (Forman & Mettu 1992).";
        closure: Table(&CLOSURE) => "Newman's ratio of the load that opens a crack to the largest (1984), `opening` in formulas.";
        ratio: Constant, range(within(-1e3, 1.0).with_open([false, true])), default(|| "0".into()),
            remedy("; it is the smallest load of a cycle in parts of the largest") =>
            "The ratio of the smallest to the largest load of a cycle.";
        cycles: List("blocks [n, max, min]", &BLOCK), example("[[1000, 1, 0], [1, 2, 0]]") =>
            "Instead of `ratio`: blocks `[n, max, min]` of n cycles (or units of time) between two multiples of the loads; "
            "after the last the first follows again.";
        wheeler: Table(&WHEELER) => "Slower growth behind overloads (Wheeler 1972).";
    }

    /// The law of Paris.
    static PARIS = "`paris`", "{ c = 1e-10, m = 3 }" {
        c: Constant, required("1e-10"), range(POSITIVE) =>
            "The factor c in da/dN = c ΔK^m, with ΔK = (1 − ratio) × strength (Paris & Erdogan 1963).";
        m: Constant, required("3"), range(EXPONENT), remedy(USUAL) => "The exponent m.";
        threshold: Constant, range(NOT_NEGATIVE), default(|| "0".into()) => "Tips with ΔK up to this stay.";
        ratio: Constant, range(within(-1e3, 1.0).with_open([false, true])), default(|| "0".into()),
            remedy("; it is the smallest load of a cycle in parts of the largest") =>
            "The key `ratio` of `[growth]`, as older files have it.";
    }

    /// The law of Walker.
    static WALKER = "`walker`", "{ c = 1e-10, m = 3, gamma = 0.5 }" {
        c: Constant, required("1e-10"), range(POSITIVE) => "The factor c.";
        m: Constant, required("3"), range(EXPONENT), remedy(USUAL) => "The exponent m.";
        gamma: Constant, range(within(0.0, 1.0)), default(|| toml(0.5)) => "The exponent γ: 1 where the ratio has no effect.";
        threshold: Constant, range(NOT_NEGATIVE), default(|| "0".into()) => "Tips with ΔK up to this stay.";
    }

    /// The law of Forman.
    static FORMAN = "`forman`", "{ c = 1e-7, m = 3 }" {
        c: Constant, required("1e-7"), range(POSITIVE) => "The factor c.";
        m: Constant, required("3"), range(EXPONENT), remedy(USUAL) => "The exponent m.";
        threshold: Constant, range(NOT_NEGATIVE), default(|| "0".into()) => "Tips with ΔK up to this stay.";
    }

    /// The law of NASGRO.
    static NASGRO = "`nasgro`", "{ c = 1e-10, m = 3, threshold = 2 }" {
        c: Constant, required("1e-10"), range(POSITIVE) => "The factor c.";
        m: Constant, required("3"), range(EXPONENT), remedy(USUAL) => "The exponent m.";
        p: Constant, range(NOT_NEGATIVE), default(|| toml(0.5)) => "The exponent p, of the threshold.";
        q: Constant, range(NOT_NEGATIVE), default(|| toml(0.5)) => "The exponent q, of the toughness.";
        threshold: Constant, range(NOT_NEGATIVE), default(|| "0".into()) => "ΔK_th: tips with ΔK up to this stay.";
    }

    /// Closure of cracks by plastic wakes.
    static CLOSURE = "`closure`", "{ alpha = 2, stress = 0.3 }" {
        alpha: Constant, required("2"), range(within(1.0, 3.0)) => "1 in plane stress to 3 in plane strain.";
        stress: Constant, required("0.3"), range(within(0.0, 1.0).with_open([false, true])) =>
            "The largest stress of a cycle in parts of the flow stress.";
    }

    /// Retardation behind overloads.
    static WHEELER = "`wheeler`", "{ yield = 350, exponent = 1.3 }" {
        yield: Constant, required("350"), range(POSITIVE) => "The yield stress σ_Y.";
        exponent: Constant, required("1.3"), range(NOT_NEGATIVE) =>
            "Rates are multiplied by (r/(a_o + r_o − a))^exponent while a plastic zone r = (K_max/σ_Y)²/(π constraint) at a "
            "stays inside r_o, that of a cycle before at a_o.";
        constraint: Constant, range(within(1.0, 6.0)), default(|| "1".into()) => "1 in plane stress, 3 in plane strain.";
    }

    static SOLVER = "[solver]", "" {
        kind: Word(words::<SolverKind>), default(|| toml(SolverSettings::default().kind.word())) =>
            "`\"direct\"` is a sparse Cholesky factorisation; `\"multilevel\"` is conjugate gradients with a "
            "hierarchy of coarser covers, which takes a fifth of the memory, and time in proportion to the unknowns. "
            "`\"auto\"` uses the direct solver up to some hundred thousand unknowns, and the multilevel solver if it "
            "takes less time, or if the factor does not fit into memory or takes more than 4 GB. If the multilevel "
            "solver does not converge, as on pieces without supports, the direct solver replaces it, with a warning, "
            "if there is enough memory.";
        tolerance: Number, range(within(1e-14, 1.0).with_open([false, true])), default(|| toml(SolverSettings::default().tolerance)),
            remedy("; it is a part of the solution") =>
            "Relative error in the energy norm that the multilevel solver may leave, estimated by its residual; at "
            "least 1e-14. With the default, fields and K agree with those of the direct solver to 1e-9, unless "
            "materials differ by factors of 1e5 and more, where rounding limits the accuracy of both.";
        kernels: Flag, default(|| toml(SolverSettings::default().kernels)) =>
            "`false` evaluates the formulas of built-in functions instead of the kernels that replace them: slower, "
            "with the same results to rounding.";
    }
}

/// A table of keys that another one has, too.
const fn part(name: &'static str, example: &'static str, keys: &'static [KeyRow]) -> KeyTable {
    KeyTable { name, example, keys }
}

/// A piece of a path: as one of a rim, without a name.
static PIECE: KeyTable =
    part("a piece of `path`", "{ points = [[0, 0], [1, 0]] }", RIM_PIECE.keys.split_at(5).0);

/// A whole ellipse: a part of one, without its ends.
static WHOLE_ELLIPSE: KeyTable =
    part("`ellipse`", "{ center = [0, 0], axes = [2, 1] }", ELLIPSE.keys.split_at(3).0);
