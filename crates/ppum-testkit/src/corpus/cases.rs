//! The cases of the corpus.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::record::{CorpusRecord, records};
use ppum::formula::{Scope, Table};

/// The themes, one file each.
pub const THEMES: [&str; 11] = [
    "arithmetic",
    "functions",
    "comparisons",
    "kinks",
    "half_angle",
    "westergaard",
    "williams",
    "weights",
    "quantities",
    "tables",
    "spicy",
];

/// A formula at a point, and what must come out.
#[derive(Clone, Debug)]
pub struct FormulaCase {
    /// Theme and line, for messages.
    pub place: String,
    /// The text.
    pub formula: String,
    /// The scope in which it is parsed.
    pub scope: Scope,
    /// The independent variables.
    pub variables: Vec<String>,
    /// One number for each of [`Scope::inputs`].
    pub inputs: Vec<f64>,
    /// Value, gradient, Hessian by pairs of variables (first, first), (first, second), …; what is
    /// not promised is missing at the end.
    pub expected: Vec<Vec<f64>>,
    /// Bounds of the errors of value, gradient and Hessian.
    pub bounds: [Bound; 3],
    /// The reason why single precision cannot be asked, if so.
    pub not_single: Option<String>,
}

/// A bound of an absolute error to first order, in units of the unit roundoff, in three parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// From roundings of + − * / √ and integer powers.
    pub arithmetic: f64,
    /// From one rounding of each other function.
    pub functions: f64,
    /// From rounding inputs and literals to single precision.
    pub inputs: f64,
}

/// The folder of the corpus.
#[must_use]
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus")
}

/// All cases, theme by theme.
///
/// # Panics
/// When a file is missing or a record is not as `README.md` says.
#[must_use]
pub fn cases() -> Vec<FormulaCase> {
    let tables = tables();
    let of_theme = |theme: &&str| {
        let records = records(&folder().join(format!("formulas/{theme}.txt")));
        records.iter().map(|record| FormulaCase::new(record, &tables)).collect::<Vec<_>>()
    };
    THEMES.iter().flat_map(of_theme).collect()
}

/// The tables of `tables.txt`.
///
/// # Panics
/// When the file is missing or a record is not as `README.md` says.
#[must_use]
pub fn tables() -> Vec<Arc<Table>> {
    let records = records(&folder().join("tables.txt"));
    records.iter().map(|record| Arc::new(table(record))).collect()
}

fn table(record: &CorpusRecord) -> Table {
    let numbers = |key| record.all(key).flat_map(|text| record.numbers(text)).collect::<Vec<_>>();
    let (name, x, y, values) =
        (record.text("table"), numbers("x"), numbers("y"), numbers("values"));
    let table = if y.is_empty() {
        Table::curve(name, x, values)
    } else {
        Table::surface(name, x, y, values)
    };
    table.unwrap_or_else(|error| record.fail(&error.to_string()))
}

impl FormulaCase {
    fn new(record: &CorpusRecord, tables: &[Arc<Table>]) -> Self {
        let (scope, variables) = scope(record, tables);
        let at = record.pairs("at");
        let input = |name: &str| {
            let found = at.iter().find(|(known, _)| known == name);
            found.unwrap_or_else(|| record.fail(&format!("no input `{name}`"))).1
        };
        let expected = ["value", "gradient", "hessian"]
            .into_iter()
            .map_while(|key| record.find(key))
            .map(|text| record.numbers(text));
        Self {
            place: record.place.clone(),
            formula: unescaped(record.text("formula")),
            inputs: scope.inputs().map(input).collect(),
            scope,
            variables,
            expected: expected.collect(),
            bounds: bounds(record),
            not_single: record
                .find("single")
                .map(|text| text.trim_start_matches("no, ").to_owned()),
        }
    }
}

/// The scope of a record and its independent variables.
fn scope(record: &CorpusRecord, tables: &[Arc<Table>]) -> (Scope, Vec<String>) {
    let kind = record.text("scope");
    let names: Vec<&str> = match kind {
        "cartesian" | "polar" => vec!["x", "y"],
        names => names.split(' ').collect(),
    };
    let scope = if kind == "polar" { Ok(Scope::polar()) } else { Scope::new(&names) };
    let parameters = record.pairs("parameters");
    let scope = parameters
        .iter()
        .fold(scope, |scope, (name, value)| scope.and_then(|s| s.with_parameter(name, *value)));
    let used = record.find("tables").into_iter().flat_map(|text| text.split(' '));
    let scope = used.fold(scope, |scope, name| {
        let table = tables.iter().find(|table| table.name() == name);
        let table = table.unwrap_or_else(|| record.fail(&format!("no table `{name}`")));
        scope.and_then(|s| s.with_table(Arc::clone(table)))
    });
    let scope = scope.unwrap_or_else(|error| record.fail(&error.to_string()));
    let sides = record.pairs("at").iter().filter(|(name, _)| name.starts_with("side(")).count();
    (scope.with_sides(sides), names.into_iter().map(str::to_owned).collect())
}

fn bounds(record: &CorpusRecord) -> [Bound; 3] {
    let part = |key| record.find(key).map_or(Vec::new(), |text| record.numbers(text));
    let [arithmetic, functions, inputs] = ["arithmetic", "functions", "inputs"].map(part);
    let at = |part: &[f64], order: usize| part.get(order).copied().unwrap_or(0.0);
    std::array::from_fn(|order| Bound {
        arithmetic: at(&arithmetic, order),
        functions: at(&functions, order),
        inputs: at(&inputs, order),
    })
}

/// The text of an escaped one: `\n`, `\r`, `\t`, and `\u{…}` for any character.
pub(super) fn unescaped(text: &str) -> String {
    let mut parts = text.split("\\u{");
    let plain = |part: &str| part.replace("\\n", "\n").replace("\\r", "\r").replace("\\t", "\t");
    let mut whole = parts.next().map_or_else(String::new, plain);
    for part in parts {
        let (code, rest) = part.split_once('}').expect("`\\u{` is followed by `}`");
        let code = u32::from_str_radix(code, 16).expect("a number in hexadecimal");
        whole.push(char::from_u32(code).expect("a character"));
        whole += &plain(rest);
    }
    whole
}
