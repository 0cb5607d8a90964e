//! The function table.

use ppum::crack::{SegmentId, TipId};
use ppum::function::{Cut, Declared, Frame, Function, FunctionKind, Part};
use ppum::vec2::{Vec2, vec2};

use super::Read;
use super::group::Group;
use crate::content::Form;
use crate::names::ENDS;

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
}

pub(super) fn functions(group: &Group) -> Read<Vec<Function>> {
    let names = group.vector::<String>("name")?;
    let n = names.len();
    let kinds = group.column::<String>("kind", n)?;
    let mut columns = Columns {
        crack: group.column("crack", n)?,
        formula: group.column("formula", n)?,
        frame: group.column("frame", n)?,
        end: group.column("frame_end", n)?,
        origin: group.points("frame_origin")?,
        angle: group.column("frame_angle", n)?,
        parameters: parameters(group, n)?,
        cuts: cuts(group, n)?,
        declared: declared(group, n)?,
    };
    if columns.origin.len() != n {
        return Err(group.error("frame_origin", format!("expected {n} rows")));
    }
    let function = |(k, (name, kind)): (usize, (String, String))| {
        Ok(Function { name, kind: columns.function_kind(group, k, &kind)? })
    };
    names.into_iter().zip(kinds).enumerate().map(function).collect()
}

fn parameters(group: &Group, functions: usize) -> Read<Vec<Vec<(String, f64)>>> {
    let names = group.vector::<String>("parameter_name")?;
    let values = group.column::<f64>("parameter_value", names.len())?;
    let parts = group.offsets("parameter_offsets", functions, names.len())?;
    let pairs: Vec<(String, f64)> = std::iter::zip(names, values).collect();
    Ok(parts.into_iter().map(|part| pairs[part].to_vec()).collect())
}

/// The cuts of components, which may be missing from the file.
fn cuts(group: &Group, functions: usize) -> Read<Vec<Vec<Cut>>> {
    if !(group.holds("cuts", Form::Dataset)? || group.holds("cut_offsets", Form::Dataset)?) {
        return Ok(vec![Vec::new(); functions]);
    }
    let rows = group.rows::<i64, 4>("cuts")?;
    let parts = group.offsets("cut_offsets", functions, rows.len())?;
    let cuts: Vec<_> = rows
        .iter()
        .enumerate()
        .map(|(k, row)| cut(*row).ok_or_else(|| group.error("cuts", format!("row {k} is no cut"))))
        .collect::<Read<_>>()?;
    Ok(parts.into_iter().map(|part| cuts[part].to_vec()).collect())
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

/// Kinks and singular points, each of which may be missing from the file.
fn declared(group: &Group, functions: usize) -> Read<Vec<Declared>> {
    let mut declared = vec![Declared::default(); functions];
    if group.holds("kinks", Form::Dataset)? || group.holds("kink_offsets", Form::Dataset)? {
        let segment = |&[x0, y0, x1, y1]: &[f64; 4]| [vec2(x0, y0), vec2(x1, y1)];
        let kinks: Vec<_> = group.rows("kinks")?.iter().map(segment).collect();
        let parts = group.offsets("kink_offsets", functions, kinks.len())?;
        std::iter::zip(&mut declared, parts).for_each(|(d, part)| d.kinks = kinks[part].to_vec());
    }
    if group.holds("singular", Form::Dataset)? || group.holds("singular_offsets", Form::Dataset)? {
        let points = group.points("singular")?;
        let parts = group.offsets("singular_offsets", functions, points.len())?;
        std::iter::zip(&mut declared, parts)
            .for_each(|(d, part)| d.singular = points[part].to_vec());
    }
    Ok(declared)
}

impl Columns {
    /// Takes the row of a function out of the columns. What its kind does not use must be left there as
    /// nothing: a row that says more than its kind was damaged, or written for another kind.
    fn function_kind(&mut self, group: &Group, k: usize, kind: &str) -> Read<FunctionKind> {
        let function = match kind {
            "one" => FunctionKind::One,
            "side" => FunctionKind::Side { crack: self.take_crack(group, k)? },
            "component" => FunctionKind::Component { cuts: std::mem::take(&mut self.cuts[k]) },
            "formula" => FunctionKind::Formula {
                frame: self.take_frame(group, k)?,
                text: std::mem::take(&mut self.formula[k]),
                parameters: std::mem::take(&mut self.parameters[k]),
                declared: std::mem::take(&mut self.declared[k]),
            },
            _ => {
                return Err(
                    group.error("kind", format!("function {k} is of unknown kind `{kind}`"))
                );
            }
        };
        match self.left_over(k) {
            None => Ok(function),
            Some((name, nothing)) => Err(group.error(
                name,
                format!("function {k} of the kind `{kind}` does not use it: expected {nothing}"),
            )),
        }
    }

    /// A column that still says something of a function, and what it says of functions that do not use it.
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
            ("singular_offsets", singular.is_empty(), "no singular points"),
        ]
        .into_iter()
        .find_map(|(name, is_nothing, nothing)| (!is_nothing).then_some((name, nothing)))
    }

    fn take_frame(&mut self, group: &Group, k: usize) -> Read<Frame> {
        match std::mem::take(&mut self.frame[k]).as_str() {
            "world" => Ok(Frame::World),
            "fixed" => Ok(Frame::Fixed {
                origin: std::mem::replace(&mut self.origin[k], Vec2::ZERO),
                angle: std::mem::take(&mut self.angle[k]),
            }),
            "tip" => Ok(Frame::Tip(TipId {
                crack: self.take_crack(group, k)?,
                end: group.word(ENDS, &std::mem::take(&mut self.end[k]), "frame_end")?,
            })),
            other => Err(group.error("frame", format!("function {k} has unknown frame `{other}`"))),
        }
    }

    fn take_crack(&mut self, group: &Group, k: usize) -> Read<u32> {
        let crack = std::mem::replace(&mut self.crack[k], -1);
        u32::try_from(crack)
            .map_err(|_| group.error("crack", format!("function {k} has no crack ({crack})")))
    }
}
