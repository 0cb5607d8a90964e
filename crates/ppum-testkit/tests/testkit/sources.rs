//! The files of a crate, and which of them each one imports from.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A module by its names below the crate; the root has none.
pub(crate) type Module = Vec<String>;

/// The modules that each module imports from.
pub(crate) type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// The modules of a crate with their code, and the places that their `use` lines give to names.
struct Crate {
    code: BTreeMap<Module, String>,
    names: BTreeMap<Module, BTreeMap<String, Module>>,
}

/// What the files below a folder of sources import from each other. A name that a module hands on
/// counts as its origin's; comments and unit tests count for nothing.
pub(crate) fn imports(sources: &Path) -> Imports {
    let mut found = Crate { code: code(sources), names: BTreeMap::new() };
    found.names = found.code.keys().map(|m| (m.clone(), found.names_of(m))).collect();
    found.code.keys().map(|module| (module.clone(), found.imports_of(module))).collect()
}

/// The code of the modules below a folder of sources, without comments and unit tests.
pub(crate) fn code(sources: &Path) -> BTreeMap<Module, String> {
    let mut code = BTreeMap::new();
    read(sources, &mut Vec::new(), &mut code);
    code
}

/// The modules in circles: each with all that need it and that it needs.
pub(crate) fn circles(imports: &Imports) -> BTreeSet<BTreeSet<String>> {
    let needed: BTreeMap<_, _> = imports.keys().map(|m| (m, needed(imports, m))).collect();
    let circle = |module: &Module| -> BTreeSet<String> {
        let needs_it = |m: &&Module| needed.get(m).is_some_and(|needed| needed.contains(module));
        needed[module].iter().filter(needs_it).map(|m| m.join("::")).collect()
    };
    imports.keys().map(circle).filter(|circle| circle.len() > 1).collect()
}

/// All that a module imports from, by way of others too.
fn needed(imports: &Imports, module: &Module) -> BTreeSet<Module> {
    let (mut all, mut open) = (BTreeSet::new(), vec![module]);
    while let Some(next) = open.pop() {
        let to = imports.get(next).into_iter().flatten();
        open.extend(to.filter(|&to| all.insert(to.clone())));
    }
    all
}

/// Reads the files of a folder, which is that of the module `at`.
fn read(folder: &Path, at: &mut Module, code: &mut BTreeMap<Module, String>) {
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let is_code = path.is_dir() || path.extension().is_some_and(|end| end == "rs");
        if name == "tests" || !is_code {
            continue;
        }
        let is_face = ["lib", "main", "mod"].contains(&name.as_str());
        at.extend((!is_face).then_some(name));
        if path.is_dir() {
            read(&path, at, code);
        } else {
            let text = std::fs::read_to_string(&path).expect("a source file");
            code.insert(at.clone(), without_tests(&text));
        }
        at.truncate(at.len() - usize::from(!is_face));
    }
}

/// The lines of a file but for comments and unit tests.
fn without_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

impl Crate {
    fn names_of(&self, module: &Module) -> BTreeMap<String, Module> {
        let of = |path: &String| {
            let (path, alias) = path.split_once(" as ").unwrap_or((path, ""));
            let place = self.absolute(module, path)?;
            let name = if alias.is_empty() { place.last()?.clone() } else { alias.to_owned() };
            Some((name, place))
        };
        used(&self.code[module]).iter().filter_map(of).collect()
    }

    fn imports_of(&self, module: &Module) -> BTreeSet<Module> {
        let code = &self.code[module];
        let paths = used(code).into_iter().chain(inline(code));
        let places = paths.filter_map(|path| self.absolute(module, path.split(" as ").next()?));
        places.map(|place| self.origin(place)).filter(|origin| origin != module).collect()
    }

    /// The place below the crate that a path in a module means; none if it leads out of the crate.
    fn absolute(&self, module: &Module, path: &str) -> Option<Module> {
        let mut names: Vec<&str> = path.split("::").map(str::trim).collect();
        let mut base = if names[0] == "crate" { Vec::new() } else { module.clone() };
        if !["crate", "self", "super"].contains(&names[0]) {
            let child = [module.as_slice(), &[names[0].to_owned()]].concat();
            self.code.contains_key(&child).then_some(())?;
        }
        while let Some(&first) =
            names.first().filter(|&&name| ["crate", "self", "super"].contains(&name))
        {
            names.remove(0);
            if first == "super" {
                base.pop();
            }
        }
        base.extend(
            names.into_iter().filter(|&name| name != "self" && name != "*").map(str::to_owned),
        );
        Some(base)
    }

    /// The module that a place is in, or, if that hands it on, the one that it comes from.
    fn origin(&self, mut place: Module) -> Module {
        for _ in 0..self.code.len() {
            let n = (0..=place.len()).rev().find(|&n| self.code.contains_key(&place[..n]));
            let (module, rest) = place.split_at(n.unwrap_or(0));
            let known = rest.first().and_then(|name| self.names.get(module)?.get(name));
            let Some(known) = known else { return module.to_vec() };
            place = [known.as_slice(), &rest[1..]].concat();
        }
        place
    }
}

/// The paths of `use` lines, one by one.
fn used(code: &str) -> Vec<String> {
    let mut rest = code;
    let mut paths = Vec::new();
    while let Some(at) = rest.find("use ") {
        let line = rest[..at].rsplit('\n').next().unwrap_or_default().trim();
        rest = &rest[at + 4..];
        if line.is_empty() || line.starts_with("pub") {
            let end = rest.find(';').unwrap_or(rest.len());
            expand("", &rest[..end].split_whitespace().collect::<Vec<_>>().join(" "), &mut paths);
        }
    }
    paths
}

/// `a::{b, c::d}` as `a::b` and `a::c::d`.
fn expand(before: &str, path: &str, paths: &mut Vec<String>) {
    let Some((head, group)) = path.split_once('{') else {
        return paths.push(format!("{before}{}", path.trim()));
    };
    let before = format!("{before}{}", head.trim());
    let (mut depth, mut start) = (0, 0);
    for (at, mark) in group.char_indices() {
        depth += i32::from(mark == '{') - i32::from(mark == '}');
        if (mark == ',' && depth == 0) || depth < 0 {
            if !group[start..at].trim().is_empty() {
                expand(&before, &group[start..at], paths);
            }
            start = at + 1;
        }
    }
}

/// The paths from `crate`, `self` or `super` outside of `use` lines.
fn inline(code: &str) -> Vec<String> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let is_path = |word: &&str| {
        let starts = ["crate::", "self::", "super::"].iter().any(|start| word.starts_with(start));
        starts && !word.ends_with(':')
    };
    code.split(|c: char| !is_part(c)).filter(is_path).map(str::to_owned).collect()
}

#[test]
fn paths_are_found_in_all_forms() {
    let code =
        "use crate::a::b;\npub(crate) use super::{c::{d, e}, f as g};\nlet x = self::h::i(1);";
    let all: Vec<_> = used(code).into_iter().chain(inline(code)).collect();
    let expected =
        ["crate::a::b", "super::c::d", "super::c::e", "super::f as g", "crate::a::b", "self::h::i"];
    assert_eq!(all, expected);
}
