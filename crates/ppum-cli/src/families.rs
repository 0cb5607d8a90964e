//! The functions of a step in few words: `westergaard 1–4 at 6 tips` for 24 of them.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use ppum::dataset::FieldData;
use ppum::function::{Frame, Function, FunctionKind, NonsmoothPoints};
use ppum::text::trimmed;

use crate::number::count;

/// Functions that differ in their places and numbers only.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Family {
    /// Numbers of the functions, rising.
    pub(crate) numbers: Vec<usize>,
    /// Name without the place, e.g. `westergaard 1–4`.
    pub(crate) name: String,
    /// Their places, e.g. `at 6 tips`; empty if everywhere.
    pub(crate) place: String,
    /// Formulas with their parameters, those that are no names already.
    pub(crate) formulas: Vec<String>,
    /// Blocks that use them.
    pub(crate) blocks: usize,
}

/// The number of blocks of a field that use each function.
pub(crate) fn blocks(functions: &[Function], field: &FieldData) -> Vec<usize> {
    let mut blocks = vec![0; functions.len()];
    field.block_function.iter().for_each(|&function| blocks[function as usize] += 1);
    blocks
}

/// The families of some functions, in the order of their first ones.
pub(crate) fn families(functions: &[Function], blocks: &[usize]) -> Vec<Family> {
    let mut groups: Vec<Vec<FunctionFamily<'_>>> = Vec::new();
    for group in groups_of(functions, blocks) {
        match groups.last_mut().filter(|family| group.continues(&family[family.len() - 1])) {
            Some(family) => family.push(group),
            None => groups.push(vec![group]),
        }
    }
    groups.iter().map(|groups| Family::new(groups)).collect()
}

impl Family {
    /// Name and place.
    pub(crate) fn title(&self) -> String {
        format!("{} {}", self.name, self.place).trim_end().to_owned()
    }

    /// The numbers as ranges, `2–25`; of many the first.
    pub(crate) fn numbers(&self) -> String {
        let mut runs: Vec<_> = self.numbers.chunk_by(|a, b| a + 1 == *b).map(range).collect();
        if runs.len() > MAX_RUNS {
            runs.truncate(MAX_RUNS - 1);
            runs.push("…".into());
        }
        runs.join(", ")
    }

    fn new(groups: &[FunctionFamily<'_>]) -> Self {
        let (first, last) = (&groups[0], &groups[groups.len() - 1]);
        let name = match (first.numbered(), last.numbered()) {
            (Some((base, [from, _])), Some((_, [_, to]))) if from < to => {
                format!("{base} {from}–{to}")
            }
            (Some((base, [number, _])), _) => format!("{base} {number}"),
            _ => first.stem.to_owned(),
        };
        let mut numbers: Vec<_> = groups.iter().flat_map(|group| &group.numbers).copied().collect();
        numbers.sort_unstable();
        Self {
            numbers,
            name,
            place: first.place(),
            formulas: groups.iter().filter_map(FunctionFamily::formula).collect(),
            blocks: groups.iter().map(|group| group.blocks).sum(),
        }
    }
}

/// Most ranges of numbers that are shown.
const MAX_RUNS: usize = 4;

fn range(run: &[usize]) -> String {
    match run {
        [only] => only.to_string(),
        _ => format!("{}–{}", run[0], run[run.len() - 1]),
    }
}

/// Functions that differ in their places only, and components in their numbers, too: each patch has
/// other ones.
struct FunctionFamily<'f> {
    stem: &'f str,
    names: Vec<&'f str>,
    kinds: Vec<&'f FunctionKind>,
    numbers: Vec<usize>,
    blocks: usize,
}

fn groups_of<'f>(functions: &'f [Function], blocks: &[usize]) -> Vec<FunctionFamily<'f>> {
    let mut groups: Vec<FunctionFamily<'_>> = Vec::new();
    let mut known: BTreeMap<FamilyKey<'_>, usize> = BTreeMap::new();
    for (number, (function, &blocks)) in functions.iter().zip(blocks).enumerate() {
        let (stem, kind) = (stem(function), &function.kind);
        match known.entry(key(stem, kind)) {
            Entry::Occupied(entry) => {
                let group = &mut groups[*entry.get()];
                group.names.push(&function.name);
                group.kinds.push(kind);
                group.numbers.push(number);
                group.blocks += blocks;
            }
            Entry::Vacant(entry) => {
                entry.insert(groups.len());
                let (names, kinds, numbers) = (vec![&*function.name], vec![kind], vec![number]);
                groups.push(FunctionFamily { stem, names, kinds, numbers, blocks });
            }
        }
    }
    groups
}

/// The name without the place, of a component without its number, too.
fn stem(function: &Function) -> &str {
    match (&function.kind, numbered(function.stem())) {
        (FunctionKind::Component { .. }, Some((base, _))) => base,
        _ => function.stem(),
    }
}

/// A name that ends in a number, and the number.
fn numbered(name: &str) -> Option<(&str, usize)> {
    let (base, number) = name.rsplit_once(' ')?;
    Some((base, number.parse().ok()?))
}

/// Name, kind, formula, names of parameters, and numbers: two functions that differ in their places
/// only have the same.
type FamilyKey<'f> = (&'f str, &'static str, &'f str, Vec<&'f str>, Vec<u64>);

fn key<'f>(stem: &'f str, kind: &'f FunctionKind) -> FamilyKey<'f> {
    let Some((text, frame, parameters, declared)) = parts(kind) else {
        let word = match kind {
            FunctionKind::Side { .. } => "side",
            FunctionKind::Component { .. } => "component",
            FunctionKind::Level { .. } => "level",
            _ => "one",
        };
        return (stem, word, "", Vec::new(), Vec::new());
    };
    let frame = match frame {
        Frame::World => "world",
        Frame::Tip(_) => "tip",
        Frame::Levels(_) => "levels",
        _ => "fixed",
    };
    let points = declared.kinks.as_flattened().iter().chain(&declared.singular);
    let values = parameters.iter().map(|(_, value)| *value);
    let numbers = [parameters.len(), declared.kinks.len()]
        .map(|n| n as u64)
        .into_iter()
        .chain(values.chain(points.flat_map(|p| [p.x, p.y])).map(f64::to_bits));
    let names = parameters.iter().map(|(name, _)| name.as_str()).collect();
    (stem, frame, text, names, numbers.collect())
}

type FormulaParts<'f> = (&'f str, &'f Frame, &'f [(String, f64)], &'f NonsmoothPoints);

fn parts(kind: &FunctionKind) -> Option<FormulaParts<'_>> {
    match kind {
        FunctionKind::Formula { text, frame, parameters, declared, .. } => {
            Some((text, frame, parameters, declared))
        }
        _ => None,
    }
}

impl<'f> FunctionFamily<'f> {
    /// A name that ends in a number, and the least and the largest number that it ends in.
    fn numbered(&self) -> Option<(&str, [usize; 2])> {
        let FunctionKind::Component { .. } = self.kinds[0] else {
            return numbered(self.stem).map(|(base, number)| (base, [number; 2]));
        };
        let number = |name: &&str| {
            name.strip_prefix(self.stem)?.trim_start().split(' ').next()?.parse().ok()
        };
        let numbers = || self.names.iter().filter_map(number);
        Some((self.stem, [numbers().min()?, numbers().max()?]))
    }

    /// True if this is the next function of a family at the same places.
    fn continues(&self, last: &Self) -> bool {
        let is_next = match (last.numbered(), self.numbered()) {
            (Some((base, [_, k])), Some((next, [m, _]))) => base == next && m == k + 1,
            _ => false,
        };
        let place = |kind: &&FunctionKind| {
            parts(kind).map(|(_, frame, parameters, _)| (*frame, parameters.to_vec()))
        };
        is_next && last.kinds.iter().map(place).eq(self.kinds.iter().map(place))
    }

    /// The places of the functions; of a single one its name tells.
    fn place(&self) -> String {
        let n = self.names.len();
        match self.kinds[0] {
            FunctionKind::Side { .. } => format!("of {}", count(n, "crack", "cracks")),
            FunctionKind::Component { .. } => self.owners(),
            FunctionKind::Formula { frame: Frame::Tip(_), .. } => {
                format!("at {}", count(n, "tip", "tips"))
            }
            _ if n > 1 => format!("at {n} places"),
            _ => self.names[0][self.stem.len()..].trim_start().to_owned(),
        }
    }

    /// The patches or cracks of components, by their names.
    fn owners(&self) -> String {
        let place = |name: &&'f str| name.find(" of ").map(|at| &name[at + 1..]);
        let owners: BTreeSet<&str> = self.names.iter().filter_map(place).collect();
        match owners.first() {
            None => String::new(),
            Some(only) if owners.len() == 1 => (*only).to_owned(),
            Some(first) if first.starts_with("of crack") => format!("of {} cracks", owners.len()),
            Some(_) => format!("of {} patches", owners.len()),
        }
    }

    /// The formula, unless the name says it, and its parameters.
    fn formula(&self) -> Option<String> {
        let (text, _, parameters, _) = parts(self.kinds[0])?;
        let parameters =
            parameters.iter().map(|(name, value)| format!("{name} = {}", trimmed(*value)));
        let text = [text.to_owned()].into_iter().filter(|text| text != self.stem);
        let all: Vec<_> = text.chain(parameters).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use ppum::crack::{End, TipId};
    use ppum::function::{Role, WESTERGAARD};
    use ppum::vec2::vec2;

    use super::*;

    fn function(name: &str, kind: FunctionKind) -> Function {
        Function { name: name.into(), kind }
    }

    /// One, two sides, the four functions of three tips.
    fn cracked() -> Vec<Function> {
        let mut all = vec![function("one", FunctionKind::One)];
        all.extend((0..2).map(|crack| {
            function(&format!("side of crack {crack}"), FunctionKind::Side { crack })
        }));
        for crack in 0..3 {
            let frame = Frame::Tip(TipId { crack, end: End::Last });
            all.extend((1..).zip(WESTERGAARD).map(|(k, text)| {
                let name = format!("westergaard {k} of crack {crack} end");
                function(&name, FunctionKind::formula(text, frame))
            }));
        }
        all
    }

    fn family_lines(functions: &[Function]) -> Vec<String> {
        let families = families(functions, &vec![2; functions.len()]);
        families.iter().map(|f| format!("{} {} {}", f.numbers(), f.title(), f.blocks)).collect()
    }

    #[test]
    fn functions_of_tips_are_a_family() {
        let all = cracked();
        assert_eq!(
            family_lines(&all),
            ["0 one 2", "1–2 side of 2 cracks 4", "3–14 westergaard 1–4 at 3 tips 24"]
        );
        assert_eq!(families(&all, &[0; 15])[2].formulas, WESTERGAARD);
    }

    /// Thousands of components are one family, whatever number each patch has of them.
    #[test]
    fn components_are_a_family() {
        let component = |k: usize, patch: usize| {
            let name = format!("component {k} of patch {patch}");
            function(&name, FunctionKind::Component { cuts: Vec::new() })
        };
        let mut all = cracked();
        for patch in 0..1000 {
            all.extend((1..=1 + patch % 4).map(|k| component(k, 3 * patch)));
        }
        assert_eq!(family_lines(&all)[3..], ["15–2514 component 1–4 of 1000 patches 5000"]);
        let two = [component(2, 7), component(2, 9)];
        assert_eq!(family_lines(&two), ["0–1 component 2 of 2 patches 4"]);
        assert_eq!(family_lines(&two[..1]), ["0 component 2 of patch 7 2"]);
        let beside = [0, 0, 3].map(|crack| {
            let name = format!("one side of crack {crack}");
            function(&name, FunctionKind::Component { cuts: Vec::new() })
        });
        assert_eq!(family_lines(&beside), ["0–2 one side of 2 cracks 6"]);
        let nowhere = ["component 1", "component 2"]
            .map(|name| function(name, FunctionKind::Component { cuts: Vec::new() }));
        assert_eq!(family_lines(&nowhere), ["0–1 component 1–2 4"]);
    }

    /// Functions that differ in more than their place are told apart.
    #[test]
    fn a_replaced_function_stands_alone() {
        let mut all = cracked();
        all[8].kind = FunctionKind::formula("r", Frame::Tip(TipId { crack: 1, end: End::Last }));
        assert_eq!(
            family_lines(&all)[2..],
            [
                "3, 7, 11 westergaard 1 at 3 tips 6",
                "4, 12 westergaard 2 at 2 tips 4",
                "5–6, 9–10, 13–14 westergaard 3–4 at 3 tips 12",
                "8 westergaard 2 at 1 tip 2",
            ]
        );
    }

    #[test]
    fn places_and_parameters() {
        let corner = |text: &str, x: f64| FunctionKind::Formula {
            text: text.into(),
            frame: Frame::Fixed { origin: vec2(x, 0.5), angle: 1.5 },
            parameters: vec![("lambda".into(), 0.5)],
            declared: NonsmoothPoints::default(),
            role: Role::Corner,
        };
        let all = [
            function("corner 1 at [1, 0.5]", corner("r^lambda", 1.0)),
            function("corner 2 at [1, 0.5]", corner("r", 1.0)),
            function("x*y", FunctionKind::formula("x*y", Frame::World)),
        ];
        assert_eq!(family_lines(&all), ["0–1 corner 1–2 at [1, 0.5] 4", "2 x*y 2"]);
        let families = families(&all, &[1; 3]);
        assert_eq!(families[0].formulas, ["r^lambda, lambda = 0.5", "r, lambda = 0.5"]);
        assert!(families[1].formulas.is_empty());
    }
}
