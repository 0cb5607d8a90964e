//! The tables of options in docs/commands, which are those of the program's help.

use std::collections::BTreeMap;
use std::path::Path;

use clap::Arg;

use crate::cli::Cli;

const HEAD: &str = "| option | default | meaning |\n|---|---|---|\n";

/// A page with the table of its command as it is now. Options that a command before has too are in
/// one row; `shown` are the rows of those, with the command.
fn with_table(page: &str, command: &clap::Command, shown: &mut BTreeMap<String, String>) -> String {
    let (mut table, mut known) = (HEAD.to_owned(), BTreeMap::<String, Vec<String>>::new());
    for arg in command.get_arguments().filter(|arg| arg.get_long().is_some()) {
        match shown.get(&row(arg)) {
            Some(before) => known.entry(before.clone()).or_default().push(name(arg)),
            None => table += &row(arg),
        }
        shown.entry(row(arg)).or_insert_with(|| command.get_name().to_owned());
    }
    for (before, options) in known {
        let options = options.join(", ");
        table += &format!("| {options} | | As for [`ppum {before}`]({before}.md). |\n");
    }
    let Some((start, rest)) = page.split_once("| option |") else {
        assert_eq!(table, HEAD, "ppum {}: write `| option |` for a table", command.get_name());
        return page.to_owned();
    };
    let rest = rest.split_inclusive('\n').skip(1).skip_while(|line| line.starts_with('|'));
    format!("{start}{table}{}", rest.collect::<String>())
}

/// The names of an option.
fn name(arg: &Arg) -> String {
    let long = arg.get_long().unwrap_or_default();
    arg.get_short().map_or_else(String::new, |short| format!("`-{short}`, "))
        + &format!("`--{long}`")
}

/// An option with its values, its default, and its help.
fn row(arg: &Arg) -> String {
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    let (mut meaning, mut default) = match help.rsplit_once(" [default: ") {
        Some((before, rest)) => {
            let (default, after) = rest.split_once(']').unwrap_or((rest, ""));
            (format!("{before}{after}"), default.to_owned())
        }
        None => (help, String::new()),
    };
    let defaults = arg.get_default_values().iter().map(|value| format!("`{}`", value.display()));
    if arg.is_required_set() {
        default = "required".into();
    } else if default.is_empty() && arg.get_action().takes_values() {
        default = defaults.collect();
    }
    let values: Vec<String> = arg
        .get_possible_values()
        .iter()
        .map(|value| {
            let help = value.get_help().map_or_else(String::new, |help| format!(", {help}"));
            format!("`{}`{help}", value.get_name())
        })
        .collect();
    if !values.is_empty() && arg.get_action().takes_values() {
        meaning = format!("{meaning}: {}", values.join("; "));
    }
    let value = if arg.get_action().takes_values() { value_name(arg) } else { String::new() };
    let name = name(arg);
    let name = name.strip_suffix('`').unwrap_or(&name);
    format!("| {name}{value}` | {default} | {}. |\n", meaning.trim_end_matches('.'))
        .replace("|  |", "| |")
}

/// Returns the placeholder after the name of an option; signs of tables are escaped.
fn value_name(arg: &Arg) -> String {
    let names = arg.get_value_names().unwrap_or_default();
    let name = names.first().map_or_else(String::new, |name| name.replace('|', r"\|"));
    match arg.is_require_equals_set() {
        true => format!("[={name}]"),
        false => format!(" {name}"),
    }
}

/// `PPUM_WRITE=1 cargo test --release -p ppum-cli tables` writes them again.
#[test]
fn tables_of_options_are_those_of_the_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let read = |file: &str| std::fs::read_to_string(folder.join(file)).expect(file);
    let (overview, mut shown) = (read("cli.md"), BTreeMap::new());
    for command in Cli::whole().get_subcommands() {
        let file = format!("commands/{}.md", command.get_name());
        assert!(overview.contains(&format!("]({file})")), "docs/cli.md has no link to {file}");
        let page = read(&file);
        let wanted = with_table(&page, command, &mut shown);
        assert!(wanted.matches("| option |").count() <= 1, "docs/{file} has two tables of options");
        if std::env::var_os("PPUM_WRITE").is_some() {
            std::fs::write(folder.join(&file), &wanted).unwrap();
            continue;
        }
        let rows = page.lines().zip(wanted.lines()).find(|(ours, theirs)| ours != theirs);
        assert!(page == wanted, "{rows:?}: write the table of docs/{file} anew");
    }
}
