//! The functions of a step as a text of WGSL.
//!
//! Groups of the same formulas in the same kind of frame share a kernel: the tips of a hundred
//! cracks have one. `functions(group, offset)` chooses the kernel by the group's number.

use std::fmt::Write;
use std::ops::Range;
use std::sync::Arc;

use ppum::formula::{Formula, FormulaJets, Table};
use ppum::function::{Function, FunctionKind, WESTERGAARD, function_scope, native};

use crate::error::GpuError;
use crate::scene::groups::{FunctionGroups, GroupFrame, texts};

/// Members of a jet, in the order in which formulas give them.
const MEMBERS: [&str; 3] = ["v", "x", "y"];

/// Numbers of a jet by its order.
const SIZE: [usize; 2] = [1, 3];

/// The surroundings that a step's formulas are compiled in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FormulaContext<'a> {
    /// Number of cracks, whose sides formulas may use.
    pub(crate) cracks: usize,
    /// The tables of the dataset.
    pub(crate) tables: &'a [Arc<Table>],
    /// Order of derivatives, 0, 1 or 2.
    pub(crate) order: usize,
}

/// The kernels of all groups and the functions
/// `functions(group: u32, offset: vec2<f32>) -> Functions` and `is_one(group: u32) -> bool`, for a
/// table in which functions may be replaced; and the number of each group's kernel.
///
/// # Errors
/// A formula that does not compile, or is too large for WGSL.
pub(crate) fn functions_wgsl(
    functions: &[Function],
    groups: &FunctionGroups,
    surroundings: FormulaContext<'_>,
) -> Result<(String, Vec<usize>), GpuError> {
    let frames = groups.frames(functions);
    let mut runs: Vec<(FunctionKernel, Range<usize>)> = Vec::new();
    let mut kernels = Vec::new();
    let (mut keys, mut text) = (Vec::new(), String::new());
    for (group, frame) in frames.iter().enumerate() {
        let key = (kind(frame), texts(functions, groups.members(group)));
        let kernel =
            FunctionKernel(keys.iter().position(|known| *known == key).unwrap_or(keys.len()));
        if kernel.0 == keys.len() {
            text += &kernel.text(&key.0, functions, groups.members(group), surroundings)?;
            keys.push(key);
        }
        kernels.push(kernel.0);
        match runs.last_mut() {
            Some((last, range)) if *last == kernel => range.end = group + 1,
            _ => runs.push((kernel, group..group + 1)),
        }
    }
    let is_one = |kernel: &FunctionKernel| keys[kernel.0].0 == KernelKind::One;
    let ones = runs.iter().filter(|(kernel, _)| is_one(kernel)).map(|(_, range)| range);
    Ok((text + &chooser(&runs) + &is_one_wgsl(ones), kernels))
}

/// The kind of code that evaluates a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KernelKind {
    One,
    Side,
    Indicator,
    /// Formulas in a frame that stays where it is.
    Fixed,
    /// Formulas in the frame of a tip.
    Tip,
}

fn kind(frame: &GroupFrame) -> KernelKind {
    match frame {
        GroupFrame::One => KernelKind::One,
        GroupFrame::Side(_) => KernelKind::Side,
        GroupFrame::Indicator(_) => KernelKind::Indicator,
        GroupFrame::Fixed { .. } | GroupFrame::World => KernelKind::Fixed,
        GroupFrame::Tip(_) => KernelKind::Tip,
    }
}

/// A kernel by its number: the function `functions_N`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FunctionKernel(usize);

impl FunctionKernel {
    fn text(
        self,
        kind: &KernelKind,
        functions: &[Function],
        members: &[u32],
        surroundings: FormulaContext<'_>,
    ) -> Result<String, GpuError> {
        let body = match kind {
            KernelKind::One => constant("1.0"),
            KernelKind::Side => {
                format!("    let side = crack_side(crack_of(group), offset);\n{}", constant("side"))
            }
            KernelKind::Indicator => {
                let value = "    let value = indicator_value(indicator_of(group), offset);\n";
                format!("{value}{}", constant("value"))
            }
            KernelKind::Fixed | KernelKind::Tip => {
                let members = members.iter().map(|&member| &functions[member as usize]);
                let formulas = GroupFormulas::new(members, surroundings)?;
                return self.of_formulas(*kind, &formulas, surroundings.order);
            }
        };
        Ok(self.function(&body))
    }

    fn function(self, body: &str) -> String {
        format!(
            "\nfn functions_{}(group: u32, offset: vec2<f32>) -> Functions {{\n{body}}}\n",
            self.0
        )
    }

    fn of_formulas(
        self,
        kind: KernelKind,
        all: &GroupFormulas,
        order: usize,
    ) -> Result<String, GpuError> {
        let mut body = match kind {
            KernelKind::Tip => {
                "    let frame = tip_at(group);\n    let p = tip_point(frame, offset);\n"
            }
            _ => "    let frame = fixed_at(group);\n    let p = fixed_point(frame, offset);\n",
        }
        .to_owned();
        if all.natives().next().is_some() {
            body += "    let native = westergaard(p);\n";
        }
        let mut text = String::new();
        if let Some(jets) = &all.jets {
            let name = format!("formulas_{}", self.0);
            let compiled = jets.wgsl_of_used(&name);
            text = compiled.map_err(|error| GpuError::limit(&all.name, &error))?;
            body += &call(jets, &name);
        }
        let f = all.results(order);
        writeln!(body, "    return functions_turned({f}, frame.axis);")
            .expect("a string takes all");
        Ok(text + &self.function(&body))
    }
}

/// The line that returns a first function with this value and derivatives 0.
fn constant(value: &str) -> String {
    let zeros = ", vec4<f32>()".repeat(MEMBERS.len() - 1);
    format!("    return Functions(vec4<f32>({value}, 0.0, 0.0, 0.0){zeros});\n")
}

/// The formulas of a group.
struct GroupFormulas {
    /// The first function, for messages.
    name: String,
    /// The code of each function.
    sources: Vec<FunctionCode>,
    /// Those that are evaluated as formulas, together.
    jets: Option<FormulaJets>,
}

/// The code of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FunctionCode {
    /// A function of Westergaard's by its index.
    Native(usize),
    /// A formula by its index among those that are compiled.
    Formula(usize),
}

impl GroupFormulas {
    fn new<'f>(
        members: impl Iterator<Item = &'f Function>,
        surroundings: FormulaContext<'_>,
    ) -> Result<Self, GpuError> {
        let (mut name, mut sources, mut formulas) = (String::new(), Vec::new(), Vec::new());
        for function in members {
            let FunctionKind::Formula { text, frame, parameters, .. } = &function.kind else {
                continue;
            };
            name = format!("the function `{}`", function.name);
            sources.push(match native(text, *frame) {
                Some((_, entry)) => FunctionCode::Native(entry as usize),
                None => {
                    let wrong = |error: &dyn std::fmt::Display| GpuError::formula(&name, error);
                    let scope =
                        function_scope(parameters, surroundings.cracks, surroundings.tables)
                            .map_err(|error| wrong(&error))?;
                    formulas.push(Formula::parse(text, &scope).map_err(|error| wrong(&error))?);
                    FunctionCode::Formula(formulas.len() - 1)
                }
            });
        }
        let all: Vec<_> = formulas.iter().collect();
        let compile = |_| FormulaJets::new(&all, surroundings.order);
        let jets = all
            .first()
            .map(compile)
            .transpose()
            .map_err(|error| GpuError::formula(&name, &error))?;
        Ok(Self { name, sources, jets })
    }

    /// The functions of Westergaard's among them.
    fn natives(&self) -> impl Iterator<Item = usize> {
        self.sources.iter().filter_map(|source| match source {
            FunctionCode::Native(entry) => Some(*entry),
            FunctionCode::Formula(_) => None,
        })
    }

    /// The functions in the frame, an expression.
    fn results(&self, order: usize) -> String {
        if self.natives().eq(0..WESTERGAARD.len()) {
            return "native".to_owned();
        }
        let vectors = (0..MEMBERS.len()).map(|member| match member < SIZE[order] {
            true => self.vector(member, SIZE[order]),
            false => "vec4<f32>()".to_owned(),
        });
        format!("Functions(\n        {},\n    )", vectors.collect::<Vec<_>>().join(",\n        "))
    }

    /// One member of the jets of all functions.
    fn vector(&self, member: usize, size: usize) -> String {
        let mut lanes = ["0.0", "0.0", "0.0", "0.0"].map(str::to_owned);
        for (lane, source) in lanes.iter_mut().zip(&self.sources) {
            *lane = match source {
                FunctionCode::Native(entry) => {
                    format!("native.{}.{}", MEMBERS[member], LANES[*entry])
                }
                FunctionCode::Formula(index) => format!("jets[{}]", index * size + member),
            };
        }
        format!("vec4<f32>({})", lanes.join(", "))
    }
}

/// Names of the elements of a vector.
const LANES: [&str; 4] = ["x", "y", "z", "w"];

/// Index of r among the inputs of functions; x and y are before it.
const RADIUS: usize = 2;

/// Number of inputs before the sides of cracks: x, y, r, θ, cos(θ/2), sin(θ/2).
const POLAR: usize = 6;

/// The lines that evaluate formulas at the point `p` of their frame; only what they use is
/// computed.
fn call(jets: &FormulaJets, name: &str) -> String {
    let used: Vec<usize> = jets.used().collect();
    let within = |range: Range<usize>| used.iter().any(|index| range.contains(index));
    let mut text = String::new();
    for (needed, line) in [
        (within(RADIUS..POLAR), "    let r = tip_radius(p);\n"),
        (within(RADIUS + 1..POLAR), "    let half = tip_half_angle(p, r);\n"),
    ] {
        text += if needed { line } else { "" };
    }
    let arguments: Vec<String> = used.iter().map(|&index| argument(index)).collect();
    text + &format!("    let jets = {name}({});\n", arguments.join(", "))
}

/// The WGSL of an input of functions.
fn argument(index: usize) -> String {
    let polar = ["p.x", "p.y", "r", "tip_theta(half)", "half.x", "half.y"];
    match polar.get(index) {
        Some(text) => (*text).to_owned(),
        None => format!("crack_side(crack_at({}u), offset)", index - POLAR),
    }
}

/// The function that finds the kernel of a group.
fn chooser(runs: &[(FunctionKernel, Range<usize>)]) -> String {
    let mut text = "\nfn functions(group: u32, offset: vec2<f32>) -> Functions {\n".to_owned();
    let (last, before) = match runs {
        [before @ .., (FunctionKernel(last), _)] => {
            (format!("functions_{last}(group, offset)"), before)
        }
        // a step without functions has no blocks either
        [] => ("Functions()".to_owned(), runs),
    };
    for (FunctionKernel(kernel), groups) in before {
        let call = format!("return functions_{kernel}(group, offset);");
        writeln!(text, "    if group < {}u {{\n        {call}\n    }}", groups.end)
            .expect("a string takes all");
    }
    text + &format!("    return {last};\n}}\n")
}

/// The function that tells which groups are the function 1.
fn is_one_wgsl<'r>(ones: impl Iterator<Item = &'r Range<usize>>) -> String {
    let run = |range: &Range<usize>| match range.start {
        0 => format!("group < {}u", range.end),
        start => format!("(group >= {start}u && group < {}u)", range.end),
    };
    let runs: Vec<String> = ones.map(run).collect();
    let holds = if runs.is_empty() { "false".to_owned() } else { runs.join(" || ") };
    format!("\nfn is_one(group: u32) -> bool {{\n    return {holds};\n}}\n")
}
