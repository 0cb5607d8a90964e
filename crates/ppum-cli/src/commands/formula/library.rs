//! The list of built-in functions.

use std::io::{self, Write};

use ppum::library::{Definition, ELASTICITY, ENRICHMENTS, Entry, POISSON, WEIGHTS};
use ppum::text::trimmed;
use serde::Serialize;

use super::report::{FormulaParameter, parameters};
use crate::number::json;

/// Prints the library.
pub(super) fn list(out: &mut dyn Write, as_json: bool) -> anyhow::Result<()> {
    let library = groups().flat_map(|(_, rows)| rows).collect();
    if as_json { Ok(json(out, &Library { library })?) } else { Ok(write(out)?) }
}

#[derive(Debug, Serialize)]
struct Library {
    library: Vec<LibraryRow>,
}

#[derive(Debug, Serialize)]
struct LibraryRow {
    of: &'static str,
    name: String,
    about: &'static str,
    parameters: Vec<FormulaParameter>,
    formulas: Vec<&'static str>,
}

/// The kinds of functions: a heading, and the functions.
fn groups() -> impl Iterator<Item = (&'static str, Vec<LibraryRow>)> {
    let entries = |of, entries: &[Entry]| entries.iter().map(|e| entry(of, e)).collect();
    let quantities = |of, list: &[Definition]| {
        list.iter().map(|&(name, text)| quantity(of, name, text)).collect()
    };
    [
        ("weights, of t for 0 ≤ t < 1", entries("weight", &WEIGHTS)),
        ("enrichments, of x, y, r, theta in their frame", entries("plane", &ENRICHMENTS)),
        ("quantities of elasticity", quantities("elasticity", &ELASTICITY)),
        ("quantities of Poisson problems", quantities("poisson", &POISSON)),
    ]
    .into_iter()
}

fn entry(of: &'static str, entry: &Entry) -> LibraryRow {
    let Entry { name, about, texts, .. } = entry;
    LibraryRow {
        of,
        name: (*name).to_owned(),
        about,
        parameters: parameters(entry.parameters.iter().map(|&(name, value)| (name, value))),
        formulas: texts.to_vec(),
    }
}

fn quantity(of: &'static str, name: &str, text: &'static str) -> LibraryRow {
    let name = name.replace('_', "-");
    LibraryRow { of, name, about: "", parameters: Vec::new(), formulas: vec![text] }
}

/// Width of the column of names.
const NAME: usize = 16;

fn write(out: &mut dyn Write) -> io::Result<()> {
    for (k, (heading, rows)) in groups().enumerate() {
        writeln!(out, "{}{heading}", if k == 0 { "" } else { "\n" })?;
        for row in rows {
            let parameters =
                row.parameters.iter().map(|p| format!("{} = {}", p.name, trimmed(p.value.0)));
            let about: Vec<_> = [row.about.to_owned()]
                .into_iter()
                .filter(|text| !text.is_empty())
                .chain(parameters)
                .collect();
            let about = (!about.is_empty()).then(|| about.join("; "));
            let texts = row.formulas.iter().map(|text| (*text).to_owned());
            for (line, text) in about.into_iter().chain(texts).enumerate() {
                let name = if line == 0 { row.name.as_str() } else { "" };
                writeln!(out, "  {name:NAME$} {text}")?;
            }
        }
    }
    Ok(())
}
