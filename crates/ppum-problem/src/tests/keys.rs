//! The tables of `docs/problem-file.md` and `docs/problem`, and the schema, are those of the keys.
//!
//! `PPUM_WRITE=1 cargo test -p ppum-problem --lib tests::keys` writes them anew.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::{Problem, ProblemData};
use crate::data::{EquationKind, Keyword};
use crate::file::keys::{KeyRow, KeyTable, Kind, NumberRange, ROOT, completions};

/// The path of the table of all tables.
const FILE: &str = "file";

/// The tables of keys below a table, by the path of the keys that lead there.
fn tables(table: &'static KeyTable, path: &str, found: &mut BTreeMap<String, &'static KeyTable>) {
    let is_new = !found.values().any(|known| std::ptr::eq(*known, table));
    if is_new && !table.keys.is_empty() {
        found.insert(path.to_owned(), table);
        for (row, next) in table.keys.iter().filter_map(|row| Some((row, nested(row.kind)?))) {
            let path = if path == FILE { row.name } else { &format!("{path}.{}", row.name) };
            tables(next, path, found);
        }
    }
}

fn nested(kind: Kind) -> Option<&'static KeyTable> {
    if let Kind::List(_, kind) = kind { kind.table() } else { kind.table() }
}

fn all_tables() -> BTreeMap<String, &'static KeyTable> {
    let mut found = BTreeMap::new();
    tables(&ROOT, FILE, &mut found);
    found
}

/// What the column "type" says.
fn type_words(kind: Kind) -> String {
    match kind {
        Kind::Text(words) => words.to_owned(),
        Kind::Flag => "`true`, `false`".to_owned(),
        Kind::Constant => "number or constant formula".to_owned(),
        Kind::Number | Kind::Whole => kind.words().trim_start_matches("a ").to_owned(),
        Kind::Value => "value".to_owned(),
        Kind::Word(words) => {
            words().iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
        }
        Kind::Array(_, _, form, _) | Kind::Components(form, _) => format!("`{form}`"),
        Kind::List(_, Kind::Table(_)) => "list of tables".to_owned(),
        Kind::List(items, Kind::Either(_) | Kind::Text(_)) => format!("list of {items}"),
        Kind::List(_, Kind::Number) => "list of numbers".to_owned(),
        Kind::List(_, kind) => format!("list of {}", type_words(*kind)),
        Kind::Table(table) if !table.example.is_empty() => format!("`{}`", table.example),
        Kind::Table(_) => "table".to_owned(),
        Kind::Tables(_) => "any number of tables".to_owned(),
        Kind::Either(kinds) => {
            kinds.iter().map(|kind| type_words(*kind)).collect::<Vec<_>>().join(", or ")
        }
    }
}

fn markdown(row: &KeyRow) -> String {
    let range = match row.range.words() {
        words if words.is_empty() => words,
        words => format!(", {words}"),
    };
    let is_word = |text: &str| text.starts_with('"') || ["true", "false"].contains(&text);
    let default = match row.default.map(|default| default()) {
        _ if row.is_required => "required".to_owned(),
        Some(text) if is_word(&text) => format!("`{text}`"),
        other => other.unwrap_or_default(),
    };
    let equation = match row.equation {
        Some((EquationKind::Elasticity, _)) => "*Elasticity.* ",
        Some((EquationKind::Poisson, _)) => "*Poisson.* ",
        None => "",
    };
    let cells = [format!("`{}`", row.name), type_words(row.kind) + &range, default];
    let cells: Vec<_> = cells.into_iter().chain([format!("{equation}{}", row.doc)]).collect();
    let cells =
        cells.iter().map(|cell| format!(" {}", cell.replace('|', "\\|")).trim_end().to_owned());
    format!("|{} |", cells.collect::<Vec<_>>().join(" |"))
}

/// What stands before the table of a path; the next line is its first.
fn mark(path: &str) -> String {
    format!("<!-- keys: {path} -->\n")
}

/// A page with the tables of the keys that it has marks for; no page before may have had them.
fn page(text: &str, missing: &mut BTreeMap<String, &'static KeyTable>) -> String {
    let mut text = text.to_owned();
    for (path, table) in all_tables() {
        let mark = mark(&path);
        let Some(start) = text.find(&mark).map(|at| at + mark.len()) else { continue };
        let is_first = missing.remove(&path).is_some() && !text[start..].contains(&mark);
        assert!(is_first, "the pages have one {mark}");
        let end = start + text[start..].find("\n\n").unwrap_or(text[start..].trim_end().len());
        let rows = table.keys.iter().map(markdown).collect::<Vec<_>>().join("\n");
        let head = "| key | type | default | meaning |\n|---|---|---|---|\n";
        text.replace_range(start..end, &(head.to_owned() + &rows));
    }
    text
}

fn object(pairs: impl IntoIterator<Item = (&'static str, Value)>) -> Map<String, Value> {
    pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn number(kind: &str, NumberRange { ends, open }: NumberRange) -> Value {
    let names = [["minimum", "exclusiveMinimum"], ["maximum", "exclusiveMaximum"]];
    let bounds = (0..2).filter(|&k| ends[k].is_finite());
    let bounds = bounds.map(|k| (names[k][usize::from(open[k])], json!(ends[k])));
    Value::Object(object([("type", json!(kind))].into_iter().chain(bounds)))
}

fn schema(kind: Kind, range: NumberRange, names: &BTreeMap<String, &'static KeyTable>) -> Value {
    let array = |count: usize, items: Value| json!({ "type": "array", "items": items, "minItems": count, "maxItems": count });
    let either = |all: Vec<Value>| json!({ "anyOf": all });
    let formula = json!({ "type": "string" });
    let reference = |table: &KeyTable| {
        let path = names.iter().find(|(_, known)| std::ptr::eq(**known, table));
        match path {
            Some((path, _)) => json!({ "$ref": format!("#/definitions/{path}") }),
            None => {
                json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } })
            }
        }
    };
    match kind {
        Kind::Text(_) => formula,
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Number => number("number", range),
        Kind::Constant | Kind::Value => either(vec![number("number", range), formula]),
        Kind::Whole => {
            let ends = [range.ends[0].max(0.0), range.ends[1]];
            number("integer", NumberRange { ends, ..range })
        }
        Kind::Word(words) => json!({ "enum": words() }),
        Kind::Array(count, _, _, kind) => array(count, schema(*kind, range, names)),
        Kind::List(_, kind) => json!({ "type": "array", "items": schema(*kind, range, names) }),
        Kind::Components(..) => array(2, schema(Kind::Value, range, names)),
        Kind::Table(table) => reference(table),
        Kind::Tables(table) => json!({ "type": "array", "items": reference(table) }),
        Kind::Either(kinds) => {
            either(kinds.iter().map(|kind| schema(*kind, range, names)).collect())
        }
    }
}

fn table_schema(table: &KeyTable, names: &BTreeMap<String, &'static KeyTable>) -> Value {
    let property = |row: &KeyRow| {
        let mut value = schema(row.kind, row.range, names);
        // nothing may stand beside a reference
        if value.get("$ref").is_none() {
            value["description"] = json!(row.doc);
        }
        (row.name, value)
    };
    let required = table.keys.iter().filter(|row| row.is_required && row.equation.is_none());
    json!({
        "type": "object",
        "additionalProperties": false,
        "properties": object(table.keys.iter().map(property)),
        "required": required.map(|row| row.name).collect::<Vec<_>>(),
    })
}

/// What an equation refuses and requires in the tables of the file.
fn of_equation(table: &KeyTable, equation: EquationKind) -> Option<Value> {
    let property = |row: &KeyRow| {
        let inner = || {
            let inner = of_equation(nested(row.kind)?, equation)?;
            let is_list = matches!(row.kind, Kind::Tables(_));
            Some(if is_list { json!({ "items": inner }) } else { inner })
        };
        let value = if row.fits(Some(equation)) { inner()? } else { json!(false) };
        Some((row.name, value))
    };
    let properties = object(table.keys.iter().filter_map(property));
    let own =
        |row: &&KeyRow| row.is_required && row.equation.is_some_and(|(own, _)| own == equation);
    let required: Vec<_> = table.keys.iter().filter(own).map(|row| row.name).collect();
    let value = json!({ "properties": properties, "required": required });
    (!properties.is_empty() || !required.is_empty()).then_some(value)
}

/// The schema, a definition a line. What every elastic problem needs, a problem of heat may leave
/// to the problem that it stands in, and no editor sees in which it stands.
fn schema_text() -> String {
    let names = all_tables();
    let mut root = table_schema(&ROOT, &names);
    root["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    root["title"] = json!("Problem file of ppum");
    let [elasticity, poisson] = [EquationKind::Elasticity, EquationKind::Poisson];
    let kind =
        json!({ "properties": { "kind": { "const": poisson.word() } }, "required": ["kind"] });
    root["if"] = json!({ "properties": { "equation": kind }, "required": ["equation"] });
    root["then"] = json!(of_equation(&ROOT, poisson));
    root["else"] = json!(of_equation(&ROOT, elasticity));
    root["else"]["required"] = root["required"].take();
    root["required"] = json!([]);
    let definition = |(path, table): (&String, &&'static KeyTable)| {
        let mut schema = table_schema(table, &names);
        if path == "domain" {
            let ways = [["min", "max"].as_slice(), &["outline"]];
            schema["anyOf"] = json!(ways.map(|keys| json!({ "required": keys })));
        }
        format!("    \"{path}\": {schema}")
    };
    let definitions = names.iter().filter(|(path, _)| path.as_str() != FILE).map(definition);
    let definitions = definitions.collect::<Vec<_>>().join(",\n");
    let line = |(key, value): (&String, &Value)| format!("  \"{key}\": {value}");
    let lines = root.as_object().into_iter().flatten().map(line).collect::<Vec<_>>().join(",\n");
    format!("{{\n  \"definitions\": {{\n{definitions}\n  }},\n{lines}\n}}\n")
}

/// Compares a file of the documentation with what it should hold, or writes it.
fn holds(file: &str, expected: impl FnOnce(&str) -> String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let expected = expected(&text);
    if std::env::var_os("PPUM_WRITE").is_some() {
        std::fs::write(&path, &expected).expect("written");
    } else {
        let lines = text.lines().zip(expected.lines());
        let first = lines.clone().find(|(there, wanted)| there != wanted);
        assert!(
            text == expected,
            "docs/{file} differs; the first line of its mistakes: {first:#?}"
        );
    }
}

#[test]
fn the_pages_have_the_tables_of_the_keys() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/problem");
    let names = std::fs::read_dir(folder).expect("pages of groups of keys");
    let names = names.map(|entry| entry.expect("a page").file_name().into_string());
    let groups = names.map(|name| format!("problem/{}", name.expect("a name")));
    let mut missing = all_tables();
    for file in groups.chain(["problem-file.md".to_owned()]) {
        holds(&file, |text| page(text, &mut missing));
    }
    assert!(missing.is_empty(), "no page has the keys of {:?}", missing.keys());
}

#[test]
fn the_schema_is_that_of_the_keys() {
    holds("problem-file.schema.json", |_| schema_text());
}

/// A problem of heat that leaves its body to the problem it stands in is read, and has all that
/// the schema requires.
#[test]
fn heat_needs_no_body_of_its_own() {
    let heat = "equation = { kind = \"poisson\" }\nmaterial = { conductivity = 1.0 }\n\
                boundary = [{ on = \"top\", value = 1.0 }, { on = \"bottom\", value = 0.0 }]\n";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let text = std::fs::read_to_string(folder.join("insulated-crack.toml")).expect("an example");
    let embedded = text.replace("\"insulated-crack-heat.toml\"", &format!("'''\n{heat}'''"));
    assert_ne!(embedded, text);
    let problem = Problem::parse(&embedded, "example.toml", &folder);
    assert!(problem.is_ok(), "{problem:?}");

    let schema: Value = serde_json::from_str(&schema_text()).expect("JSON");
    let keys: toml::Table = heat.parse().expect("TOML");
    let missing = |branch: &Value| {
        let required = branch["required"].as_array().cloned().unwrap_or_default();
        let missing = |key: &&Value| !keys.contains_key(key.as_str().unwrap_or_default());
        required.iter().filter(missing).count()
    };
    let branches = [&schema, &schema["then"], &schema["else"]];
    assert_eq!(branches.map(missing), [0, 0, 2], "{branches:#?}");
}

/// What the ranges say is what numbers beside their ends are told.
#[test]
fn ranges_hold_what_they_say() {
    let mut count = 0;
    for row in all_tables().values().flat_map(|table| table.keys) {
        let NumberRange { ends, open } = row.range;
        for k in (0..2).filter(|&k| ends[k].is_finite()) {
            let outward = [-1.0, 1.0][k] * ends[k].abs().max(1.0) * 1e-9;
            assert_eq!(row.range_error(ends[k]).is_some(), open[k], "{}", row.name);
            assert!(row.range_error(ends[k] + outward).is_some(), "{}", row.name);
            assert!(row.range_error(ends[k] - outward).is_none(), "{}", row.name);
            count += 1;
        }
        assert!(
            row.range.words().is_empty() || row.range_error(f64::NAN).is_some(),
            "{}",
            row.name
        );
    }
    assert!(count > 30, "{count}");
}

/// Examples of messages, and tables that are shown, are such as the reader takes: the schema knows
/// each key, and each key has a meaning that is a sentence.
#[test]
fn rows_are_whole() {
    for row in all_tables().values().flat_map(|table| table.keys) {
        assert!(row.doc.ends_with('.'), "{}: {}", row.name, row.doc);
        if !row.example.is_empty() && !row.example.contains(" = ") {
            let text = format!("{} = {}", row.name, row.example);
            assert!(toml::from_str::<toml::Table>(&text).is_ok(), "{text}");
        }
    }
}

#[test]
fn keys_are_completed_where_they_stand() {
    let at = |text: &str| completions(text, text.len());
    assert!(at("ti").contains(&"title".to_owned()) && at("[").contains(&"[material]".to_owned()));
    assert!(at("[[cr").contains(&"[[crack]]".to_owned()));
    assert_eq!(at("[material]\nyoung = 1\ny")[0], "young");
    assert!(at("[[hole]]\n").contains(&"center".to_owned()));
    assert_eq!(at("[adaptivity]\nkind = \""), ["h", "p", "hp"].map(|word| format!("\"{word}\"")));
    assert_eq!(at("[domain]\nmin = ["), Vec::<String>::new());
    assert_eq!(at("[nobody]\n"), Vec::<String>::new());
    assert_eq!(at("# "), Vec::<String>::new());
    // each equation has its own
    let poisson = "[equation]\nkind = \"poisson\"\n";
    for (text, is_poisson) in
        [("", false), ("[equation]\nkind = \"elasticity\"\n", false), (poisson, true)]
    {
        let tables = at(&format!("{text}["));
        let has = |table: &str| tables.contains(&table.to_owned());
        assert_eq!((has("[source]"), has("[body_force]")), (is_poisson, !is_poisson), "{text}");
        let keys = at(&format!("{text}[material]\n"));
        let has = |key: &str| keys.contains(&key.to_owned());
        assert_eq!((has("conductivity"), has("young")), (is_poisson, !is_poisson), "{text}");
    }
}

/// A key that is written with its default means what it means where it is left out, in the first
/// table of its name of each example, or in an empty one where there is none.
#[test]
fn defaults_are_what_is_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let parse = |text: &str| {
        let problem = Problem::parse(text, "example.toml", &folder).ok()?;
        let read = format!("{:?}", ProblemData { text: None, ..problem.into_data() });
        // formulas that were written differently
        Some(read.replace("Formula(\"0.0\")", "Formula(\"0\")"))
    };
    let mut shown = BTreeSet::new();
    for entry in std::fs::read_dir(&folder).expect("examples") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|end| end != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("an example");
        for row in ROOT.keys {
            // an accuracy has steps of its own
            let is_other = row.name == "adaptivity" && text.contains("\naccuracy");
            let Some(table) = row.kind.table().filter(|_| !is_other) else { continue };
            let (text, at) = with_table(&text, row.name);
            let plain = parse(&text);
            let body = text[at..].split("\n[").next().unwrap_or_default();
            let is_given = |key: &str| {
                body.lines().any(|line| line.split('=').next().map(str::trim) == Some(key))
            };
            for key in table.keys.iter().filter(|key| !is_given(key.name)) {
                let Some(default) = key.default.map(|default| default()) else { continue };
                let line = format!("\n{} = {default}", key.name);
                if line.parse::<toml::Table>().is_err() {
                    continue;
                }
                // some tables need keys without a default, some keys others beside them
                let written = parse(&format!("{}{line}{}", &text[..at], &text[at..]));
                if written.is_some() {
                    assert_eq!(written, plain, "{}: {}.{}", path.display(), row.name, key.name);
                    shown.insert(format!("{}.{}", row.name, key.name));
                }
            }
        }
    }
    assert!(shown.len() > 20, "{shown:?}");
}

/// The text with a table of a name, and the end of the header of the first.
fn with_table(text: &str, name: &str) -> (String, usize) {
    let headers = [format!("\n[{name}]"), format!("\n[[{name}]]")];
    let ends = headers.iter().filter_map(|header| Some(text.find(header.as_str())? + header.len()));
    match ends.min() {
        Some(end) => (text.to_owned(), end),
        None => (format!("{text}{}", headers[0]), text.len() + headers[0].len()),
    }
}
