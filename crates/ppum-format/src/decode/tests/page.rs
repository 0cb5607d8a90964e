//! The objects that FORMAT.md lists are those of written files, with their types.

use std::collections::{BTreeMap, BTreeSet};

use super::mesh;
use crate::content::ObjectTree;
use crate::{checksum, encode, everything};
use ppum::anisotropy::Anisotropy;
use ppum::dataset::{Dataset, Equation, StressState};
use ppum::expression::Expression;

const PAGE: &str = include_str!("../../../../../FORMAT.md");

const TYPES: [&str; 6] = ["f64", "u8", "u32", "u64", "i64", "str"];

/// Types by the names of objects, without the groups that they are in.
type Types = BTreeMap<String, BTreeSet<String>>;

/// The items of all lists, each in one line.
fn items() -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    let mut inside = false;
    for line in PAGE.lines() {
        if let Some(item) = line.strip_prefix("- ") {
            items.push(item.to_owned());
        } else if inside && line.starts_with("  ") {
            items.last_mut().expect("inside of one").push_str(&line[1..]);
        }
        inside = line.starts_with("- ") || inside && line.starts_with("  ");
    }
    items
}

/// Types with their shapes, `or` between those of one name.
fn kinds(text: &str) -> Vec<BTreeSet<String>> {
    let words: Vec<&str> = text.split(' ').collect();
    let mut kinds: Vec<BTreeSet<String>> = Vec::new();
    for (k, pair) in words.windows(2).enumerate() {
        if !TYPES.contains(&pair[0]) || !pair[1].starts_with('[') {
            continue;
        }
        match kinds.last_mut().filter(|_| k > 0 && words[k - 1] == "or") {
            Some(last) => last.insert(pair[0].to_owned()),
            None => {
                kinds.push(BTreeSet::from([pair[0].to_owned()]));
                true
            }
        };
    }
    kinds
}

/// Names, a colon, the types of each, or one type for all.
fn add(text: &str, types: &mut Types) {
    let Some((names, rest)) = text.split_once(": ").filter(|_| text.starts_with('`')) else {
        return;
    };
    let kinds = kinds(rest);
    for (k, name) in names.split('`').skip(1).step_by(2).enumerate() {
        let own = kinds.get(k).or(kinds.first()).into_iter().flatten().cloned();
        types.entry(name.to_owned()).or_default().extend(own);
    }
}

fn of_page() -> Types {
    let mut types = Types::new();
    for item in items() {
        item.split("; `").enumerate().for_each(|(k, part)| {
            add(&if k == 0 { part.to_owned() } else { format!("`{part}") }, &mut types);
        });
    }
    types.retain(|_, kinds| !kinds.is_empty());
    types
}

fn of_files() -> Types {
    let mut types = Types::new();
    let mut add = |mut content: ObjectTree| {
        checksum::seal_parts(&mut content);
        for (name, array) in content.iter() {
            let own = &name[name
                .rfind(['/', '@'])
                .map_or(0, |at| at + usize::from(name.as_bytes()[at] == b'/'))..];
            types.entry(own.to_owned()).or_default().insert(array.values.type_name().to_owned());
        }
    };
    (0..12).for_each(|seed| add(encode::content(&everything::dataset(seed)).expect("valid")));
    add(encode::content(&mesh::dataset()).expect("valid"));
    let others = heated().into_iter().chain(anisotropic());
    others.for_each(|dataset| add(encode::content(&dataset).expect("valid")));
    types
}

/// Bodies that a temperature strains, by a coefficient that is a number, and by a formula.
fn heated() -> Vec<Dataset> {
    let all = ppum_testkit::fields::equations().into_iter().map(|case| case.dataset);
    let mut heated: Vec<Dataset> = all.filter(|d| d.equation.expansion().is_some()).collect();
    let Some(Equation::Elasticity(body)) = heated.first_mut().map(|d| &mut d.equation) else {
        panic!("a body that a temperature strains")
    };
    body.eigenstrain.as_mut().expect("strains").expansion = Some(Expression::number(0.5));
    heated
}

/// Anisotropic bodies, by numbers and by formulas.
fn anisotropic() -> [Dataset; 2] {
    let number = |value: f64| Expression::number(value);
    let formula = |value: f64| -> Expression {
        Expression::parse(&format!("{value} + 0*x")).expect("a formula")
    };
    let body = |of: &dyn Fn(f64) -> Expression| {
        let law = Anisotropy {
            plane: [10.0, 3.0, 0.0, 8.0, 0.0, 2.0].map(of),
            through: [3.0, 2.0, 0.0, 9.0].map(of),
            axis: of(0.3),
        };
        let mut all = ppum_testkit::fields::equations().into_iter().map(|case| case.dataset);
        let mut dataset = all.next().expect("an elastic body");
        dataset.equation = Equation::Elasticity(law.body(StressState::PlaneStrain, None));
        dataset
    };
    [body(&number), body(&formula)]
}

#[test]
fn objects_are_those_of_the_page() {
    let (page, files) = (of_page(), of_files());
    for (name, kinds) in &files {
        let listed = page.get(name).unwrap_or_else(|| panic!("{name} is not on the page"));
        assert!(kinds.is_subset(listed), "{name}: {kinds:?}, but on the page {listed:?}");
    }
    for (name, kinds) in &page {
        assert_eq!(files.get(name), Some(kinds), "{name} as on the page is in no file");
    }
}
