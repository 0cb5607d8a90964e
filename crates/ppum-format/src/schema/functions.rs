//! The function table.

use ppum::crack::{End, TipId};
use ppum::dataset::Step;
use ppum::function::{Cut, Frame, Function, FunctionKind, NonsmoothPoints, Role, native};
use ppum::vec2::Vec2;

use crate::member::{GroupShape, Member, MemberNames, TableMembers, members, names_of};
use crate::reader::GroupReader;
use crate::stored::{FrameKind, FunctionTag, StoredWord, value};

pub(super) const FUNCTIONS: Member<Step> = Member::<Step>::group(
    "functions",
    (GroupShape::Table, || names_of(FUNCTION)),
    |step, group, name| {
        let mut group = group.group(name);
        let rows: Option<Vec<_>> = step.functions.iter().map(StoredFunction::of).collect();
        group.put(FUNCTION, &rows.ok_or_else(|| group.unknown("kind"))?)
    },
    |step, group, name, _| {
        let group = group.group(name);
        let function = |(k, row): (usize, StoredFunction)| {
            let one = || Function { name: String::new(), kind: FunctionKind::One };
            row.function(&group, k).unwrap_or_else(one)
        };
        step.functions = group.table(FUNCTION).into_iter().enumerate().map(function).collect();
    },
);

/// A row of the function table; what a kind does not use says nothing.
#[derive(Clone, Default)]
struct StoredFunction {
    name: String,
    kind: FunctionTag,
    crack: Option<u32>,
    formula: String,
    frame: Option<FrameKind>,
    end: Option<End>,
    origin: Vec2,
    angle: f64,
    parameters: Vec<String>,
    parameter_values: Vec<f64>,
    cuts: Vec<Cut>,
    declared: NonsmoothPoints,
    levels: [Option<u32>; 2],
    role: Option<Role>,
}

const FUNCTION: &TableMembers<StoredFunction> = members!(StoredFunction:
    cell("name", name), cell("kind", kind), cell("crack", crack), cell("formula", formula),
    cell("frame", frame), cell("frame_end", end), cell("frame_origin", origin),
    cell("frame_angle", angle), list("parameter_name", "parameter_offsets", parameters),
    list("parameter_value", "parameter_offsets", parameter_values),
    list("cuts", "cut_offsets", cuts).optional(),
    list("kinks", "kink_offsets", declared.kinks).optional(),
    list("singular", "singular_offsets", declared.singular).optional(),
    cell("levels", levels).optional(), cell("role", role).optional(),
);

/// The columns of every function.
const OF_ALL: [&str; 2] = ["name", "kind"];

impl StoredFunction {
    /// The row of a function; none of a kind or frame that the format has no word for.
    fn of(function: &Function) -> Option<Self> {
        let row = Self { name: function.name.clone(), ..Self::default() };
        Some(match &function.kind {
            FunctionKind::One => row,
            FunctionKind::Side { crack } => {
                Self { kind: FunctionTag::Side, crack: Some(*crack), ..row }
            }
            FunctionKind::Level { field } => {
                Self { kind: FunctionTag::Level, levels: [None, Some(*field)], ..row }
            }
            FunctionKind::Component { cuts } => {
                Self { kind: FunctionTag::Component, cuts: cuts.clone(), ..row }
            }
            FunctionKind::Formula { text, frame, parameters, declared, role } => {
                let (parameters, parameter_values) = parameters.iter().cloned().unzip();
                Self {
                    kind: FunctionTag::Formula,
                    formula: text.clone(),
                    role: Some(*role),
                    parameters,
                    parameter_values,
                    declared: declared.clone(),
                    ..row
                }
                .in_frame(frame)?
            }
            _ => return None,
        })
    }

    fn in_frame(self, frame: &Frame) -> Option<Self> {
        Some(match *frame {
            Frame::World => Self { frame: Some(FrameKind::World), ..self },
            Frame::Fixed { origin, angle } => {
                Self { frame: Some(FrameKind::Fixed), origin, angle, ..self }
            }
            Frame::Levels(fields) => {
                Self { frame: Some(FrameKind::Levels), levels: fields.map(Some), ..self }
            }
            Frame::Tip(TipId { crack, end }) => {
                Self { frame: Some(FrameKind::Tip), crack: Some(crack), end: Some(end), ..self }
            }
            _ => return None,
        })
    }

    /// The function of row k. Columns that its kind does not use must say nothing: a row that says
    /// more than its kind was damaged, or written for another kind.
    fn function(mut self, group: &GroupReader, k: usize) -> Option<Function> {
        if group.is_wrong("kind") {
            return None;
        }
        let kind = match self.kind {
            FunctionTag::One => FunctionKind::One,
            FunctionTag::Side => FunctionKind::Side { crack: self.take_crack(group, k) },
            FunctionTag::Level => FunctionKind::Level { field: self.take_level(group, k, 1) },
            FunctionTag::Component => {
                FunctionKind::Component { cuts: std::mem::take(&mut self.cuts) }
            }
            FunctionTag::Formula => self.take_formula(group, k)?,
        };
        let rows = std::slice::from_ref(&self);
        let mut rest = FUNCTION.iter().filter(|member| !OF_ALL.contains(&member.names.stored));
        if let Some(member) = rest.find(|member| (member.is_used)(rows)) {
            let MemberNames { stored, offsets, .. } = member.names;
            let word = self.kind.word().unwrap_or_default();
            let nothing = match (offsets, stored) {
                (Some("parameter_offsets"), _) => "no parameters",
                (Some("cut_offsets"), _) => "no cuts",
                (Some("kink_offsets"), _) => "no kinks",
                (Some(_), _) => "no singular points",
                (None, "crack") => "-1",
                (None, "levels") => "-1, -1",
                (None, "frame_origin") => "0, 0",
                (None, "frame_angle") => "0",
                _ => "an empty text",
            };
            let message =
                format!("function {k} of the kind `{word}` does not use it: expected {nothing}");
            group.error(offsets.unwrap_or(stored), message);
        }
        Some(Function { name: self.name, kind })
    }

    fn take_formula(&mut self, group: &GroupReader, k: usize) -> Option<FunctionKind> {
        let frame = self.take_frame(group, k)?;
        let names = std::mem::take(&mut self.parameters);
        let parameters: Vec<_> =
            names.into_iter().zip(std::mem::take(&mut self.parameter_values)).collect();
        let role = match self.role.take() {
            None if group.row_count("role").is_none() => {
                role_by_name(&self.name, &self.formula, frame, &parameters)
            }
            role => needed(group, "role", role)?,
        };
        Some(FunctionKind::Formula {
            frame,
            role,
            text: std::mem::take(&mut self.formula),
            parameters,
            declared: std::mem::take(&mut self.declared),
        })
    }

    fn take_frame(&mut self, group: &GroupReader, k: usize) -> Option<Frame> {
        Some(match needed(group, "frame", self.frame.take())? {
            FrameKind::World => Frame::World,
            FrameKind::Fixed => Frame::Fixed {
                origin: std::mem::replace(&mut self.origin, Vec2::ZERO),
                angle: std::mem::take(&mut self.angle),
            },
            FrameKind::Levels => {
                Frame::Levels([0, 1].map(|column| self.take_level(group, k, column)))
            }
            FrameKind::Tip => Frame::Tip(TipId {
                crack: self.take_crack(group, k),
                end: needed(group, "frame_end", self.end.take())?,
            }),
        })
    }

    fn take_level(&mut self, group: &GroupReader, k: usize, column: usize) -> u32 {
        self.levels[column].take().unwrap_or_else(|| {
            let message = format!("function {k} has no level field (-1) in column {column}");
            group.error("levels", message);
            0
        })
    }

    fn take_crack(&mut self, group: &GroupReader, k: usize) -> u32 {
        self.crack.take().unwrap_or_else(|| {
            group.error("crack", format!("function {k} has no crack (-1)"));
            0
        })
    }
}

/// The value of a word that must be there.
fn needed<T: StoredWord>(group: &GroupReader, name: &str, found: Option<T>) -> Option<T> {
    found.or_else(|| value(T::WORDS, "").map_err(|message| group.error(name, message)).ok())
}

/// The role of a formula in a file of a version before 1.7, whose writers told it by names alone.
pub(crate) fn role_by_name(
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
