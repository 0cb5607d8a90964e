//! The function table.

use ppum::crack::{SegmentId, TipId};
use ppum::function::{Cut, Declared, Frame, Function, FunctionKind, Part, Role, native};
use ppum::vec2::{Vec2, vec2};

use super::group::GroupReader;
use crate::content::ObjectKind;
use crate::names::{ENDS, NO_LEVELS, Words};

#[derive(Clone, Copy)]
enum FunctionTag {
    One,
    Side,
    Formula,
    Component,
    Level,
}

const KINDS: &Words<FunctionTag> = &[
    (FunctionTag::One, "one"),
    (FunctionTag::Side, "side"),
    (FunctionTag::Formula, "formula"),
    (FunctionTag::Component, "component"),
    (FunctionTag::Level, "level"),
];

#[derive(Clone, Copy)]
enum FrameKind {
    World,
    Fixed,
    Tip,
    Levels,
}

const FRAMES: &Words<FrameKind> = &[
    (FrameKind::World, "world"),
    (FrameKind::Fixed, "fixed"),
    (FrameKind::Tip, "tip"),
    (FrameKind::Levels, "levels"),
];

/// The columns of the function table that are not plain names.
struct Columns {
    crack: Vec<i64>,
    formula: Vec<String>,
    frame: Vec<String>,
    end: Vec<String>,
    origin: Vec<Vec2>,
    angle: Vec<f64>,
    parameters: Vec<Vec<(String, f64)>>,
    cuts: Vec<Vec<Cut>>,
    declared: Vec<Declared>,
    levels: Vec<[i64; 2]>,
    /// None in files of versions before 1.7.
    role: Option<Vec<String>>,
}

/// The columns with a row for each function.
const COLUMNS: [&str; 8] =
    ["name", "kind", "crack", "formula", "frame", "frame_end", "frame_origin", "frame_angle"];

pub(super) fn functions(group: &GroupReader) -> Vec<Function> {
    let n = group.rows_of(&COLUMNS);
    let names = group.column::<String>("name", n);
    let kinds = group.column::<String>("kind", n);
    let mut columns = Columns {
        crack: group.column("crack", n),
        formula: group.column("formula", n),
        frame: group.column("frame", n),
        end: group.column("frame_end", n),
        origin: group.point_rows("frame_origin", n),
        angle: group.column("frame_angle", n),
        parameters: parameters(group, n),
        cuts: cuts(group, n),
        declared: declared(group, n),
        levels: levels(group, n),
        role: group.holds("role", ObjectKind::Dataset).then(|| group.column("role", n)),
    };
    let function = |(k, (name, word)): (usize, (String, String))| {
        let kind = columns.function_kind(group, (k, &name), &word).unwrap_or(FunctionKind::One);
        Function { name, kind }
    };
    names.into_iter().zip(kinds).enumerate().map(function).collect()
}

/// The level fields of each function, −1 for none.
fn levels(group: &GroupReader, functions: usize) -> Vec<[i64; 2]> {
    match group.holds("levels", ObjectKind::Dataset) {
        true => group.rows("levels", functions),
        false => vec![NO_LEVELS; functions],
    }
}

fn parameters(group: &GroupReader, functions: usize) -> Vec<Vec<(String, f64)>> {
    let n = group.rows_of(&["parameter_name", "parameter_value"]);
    let names = group.column::<String>("parameter_name", n);
    let values = group.column::<f64>("parameter_value", n);
    let pairs: Vec<(String, f64)> = std::iter::zip(names, values).collect();
    group.parts("parameter_offsets", functions, ("parameter_name", &pairs))
}

/// A list that belongs to each function, which may be missing from the file together with
/// its offsets.
fn lists<T: Clone>(
    group: &GroupReader,
    [name, offsets]: [&str; 2],
    functions: usize,
    list: impl Fn() -> Vec<T>,
) -> Vec<Vec<T>> {
    if [name, offsets].map(|name| group.holds(name, ObjectKind::Dataset)) == [false; 2] {
        return vec![Vec::new(); functions];
    }
    group.parts(offsets, functions, (name, &list()))
}

/// The cuts of components.
fn cuts(group: &GroupReader, functions: usize) -> Vec<Vec<Cut>> {
    let none = Cut {
        segment: SegmentId { crack: 0, segment: 0 },
        left: Part::Outside,
        right: Part::Outside,
    };
    let cut = |(k, row)| {
        cut(row).unwrap_or_else(|| {
            group.error("cuts", format!("row {k} is no cut"));
            none
        })
    };
    lists(group, ["cuts", "cut_offsets"], functions, || {
        group.all_rows::<i64, 4>("cuts").into_iter().enumerate().map(cut).collect()
    })
}

/// Crack, segment, and the numbers of what follows on the left and on the right.
fn cut([crack, segment, left, right]: [i64; 4]) -> Option<Cut> {
    let [crack, segment] = [crack, segment].map(|index| u32::try_from(index).ok());
    let [left, right] = [left, right].map(Part::of_number);
    Some(Cut {
        segment: SegmentId { crack: crack?, segment: segment? },
        left: left?,
        right: right?,
    })
}

/// Kinks and singular points.
fn declared(group: &GroupReader, functions: usize) -> Vec<Declared> {
    let kinks = lists(group, ["kinks", "kink_offsets"], functions, || {
        let segment = |[x0, y0, x1, y1]: [f64; 4]| [vec2(x0, y0), vec2(x1, y1)];
        group.all_rows("kinks").into_iter().map(segment).collect()
    });
    let singular =
        lists(group, ["singular", "singular_offsets"], functions, || group.points("singular"));
    let all = kinks.into_iter().zip(singular);
    all.map(|(kinks, singular)| Declared { kinks, singular }).collect()
}

impl Columns {
    /// Takes the row of a function out of the columns. What its kind does not use must be left
    /// there as nothing: a row that says more than its kind was damaged, or written for
    /// another kind.
    fn function_kind(
        &mut self,
        group: &GroupReader,
        (k, name): (usize, &str),
        word: &str,
    ) -> Option<FunctionKind> {
        let function = match group.word(KINDS, word, "kind")? {
            FunctionTag::One => FunctionKind::One,
            FunctionTag::Side => FunctionKind::Side { crack: self.take_crack(group, k) },
            FunctionTag::Level => FunctionKind::Level { field: self.take_level(group, k, 1) },
            FunctionTag::Component => {
                FunctionKind::Component { cuts: std::mem::take(&mut self.cuts[k]) }
            }
            FunctionTag::Formula => {
                let frame = self.take_frame(group, k)?;
                FunctionKind::Formula {
                    frame,
                    role: self.take_role(group, (k, name), frame)?,
                    text: std::mem::take(&mut self.formula[k]),
                    parameters: std::mem::take(&mut self.parameters[k]),
                    declared: std::mem::take(&mut self.declared[k]),
                }
            }
        };
        if let Some((name, nothing)) = self.left_over(k) {
            let mistake =
                format!("function {k} of the kind `{word}` does not use it: expected {nothing}");
            group.error(name, mistake);
        }
        Some(function)
    }

    /// A column that still says something of a function, and what it says of functions that do not
    /// use it.
    fn left_over(&self, k: usize) -> Option<(&'static str, &'static str)> {
        let Declared { kinks, singular } = &self.declared[k];
        [
            ("crack", self.crack[k] == -1, "-1"),
            ("formula", self.formula[k].is_empty(), "an empty text"),
            ("frame", self.frame[k].is_empty(), "an empty text"),
            ("frame_end", self.end[k].is_empty(), "an empty text"),
            ("frame_origin", self.origin[k] == Vec2::ZERO, "0, 0"),
            ("frame_angle", self.angle[k] == 0.0, "0"),
            ("parameter_offsets", self.parameters[k].is_empty(), "no parameters"),
            ("cut_offsets", self.cuts[k].is_empty(), "no cuts"),
            ("kink_offsets", kinks.is_empty(), "no kinks"),
            ("levels", self.levels[k] == NO_LEVELS, "-1, -1"),
            ("role", self.role.as_ref().is_none_or(|r| r[k].is_empty()), "an empty text"),
            ("singular_offsets", singular.is_empty(), "no singular points"),
        ]
        .into_iter()
        .find_map(|(name, is_nothing, nothing)| (!is_nothing).then_some((name, nothing)))
    }

    fn take_frame(&mut self, group: &GroupReader, k: usize) -> Option<Frame> {
        let word = std::mem::take(&mut self.frame[k]);
        Some(match group.word(FRAMES, &word, "frame")? {
            FrameKind::World => Frame::World,
            FrameKind::Fixed => Frame::Fixed {
                origin: std::mem::replace(&mut self.origin[k], Vec2::ZERO),
                angle: std::mem::take(&mut self.angle[k]),
            },
            FrameKind::Levels => {
                Frame::Levels([0, 1].map(|column| self.take_level(group, k, column)))
            }
            FrameKind::Tip => Frame::Tip(TipId {
                crack: self.take_crack(group, k),
                end: group.word(ENDS, &std::mem::take(&mut self.end[k]), "frame_end")?,
            }),
        })
    }

    fn take_role(
        &mut self,
        group: &GroupReader,
        (k, name): (usize, &str),
        frame: Frame,
    ) -> Option<Role> {
        match &mut self.role {
            Some(words) => group.word(&Role::NAMES, &std::mem::take(&mut words[k]), "role"),
            None => Some(role_by_name(name, &self.formula[k], frame, &self.parameters[k])),
        }
    }

    fn take_level(&mut self, group: &GroupReader, k: usize, column: usize) -> u32 {
        let field = std::mem::replace(&mut self.levels[k][column], -1);
        u32::try_from(field).unwrap_or_else(|_| {
            group.error(
                "levels",
                format!("function {k} has no level field ({field}) in column {column}"),
            );
            0
        })
    }

    fn take_crack(&mut self, group: &GroupReader, k: usize) -> u32 {
        let crack = std::mem::replace(&mut self.crack[k], -1);
        u32::try_from(crack).unwrap_or_else(|_| {
            group.error("crack", format!("function {k} has no crack ({crack})"));
            0
        })
    }
}

/// The role of a formula in a file of a version before 1.7, whose writers told it by names alone.
pub(super) fn role_by_name(
    name: &str,
    text: &str,
    frame: Frame,
    parameters: &[(String, f64)],
) -> Role {
    let is_of_corner = |Vec2 { x, y }: Vec2| match parameters {
        [(parameter, exponent)] if parameter == "lambda" => {
            name == format!("r^{exponent:.3} at [{x}, {y}]")
        }
        _ => false,
    };
    match frame {
        Frame::Tip(_) if native(text, frame).is_some() => Role::Tip,
        Frame::Fixed { origin, .. } if is_of_corner(origin) => Role::Corner,
        Frame::Fixed { origin: Vec2 { x, y }, .. }
            if name.starts_with(&format!("force at [{x}, {y}], ")) =>
        {
            Role::Force
        }
        _ if name.starts_with("kink at ") && name.contains(" = 0") => Role::Interface,
        _ => Role::User,
    }
}
