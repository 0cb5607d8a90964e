//! The tables `[adaptivity]`, `[growth]` and `[[refine]]`.

use ppum::expression::Expression;
use ppum::vec2::{Rect, vec2};

use crate::data::{
    Adaptivity, Closure, GrowthLaw, GrowthRule, LoadBlock, LocalRefinement, NAMED_LAWS, NamedLaw,
    RefinementRegion, Wheeler, scopes,
};
use crate::file::{DocumentValue, FromValue as _, Section, all};

/// The table, or its defaults for the accuracy that `[discretization]` asks for. Values that are
/// wrong are reported, and left at their defaults.
pub(super) fn adaptivity(root: &Section<'_>, accuracy: Option<f64>) -> Option<Adaptivity> {
    let default = accuracy.map_or_else(Adaptivity::default, Adaptivity::to);
    let Some(section) = root.section("adaptivity") else { return accuracy.map(|_| default) };
    let set = with_keys!(section, default, steps, fraction, max_unknowns, kind, keep);
    Some(Adaptivity { tolerance: section.get("tolerance"), ..set })
}

/// The table. Values that are wrong are reported, and left at their defaults.
pub(super) fn growth(section: &Section<'_>) -> GrowthRule {
    let rule = GrowthRule::new(section.require("steps").unwrap_or(1));
    GrowthRule {
        increment: section.get("increment"),
        toughness: toughness(section),
        law: law(section),
        ..with_keys!(section, rule, criterion, load)
    }
}

fn toughness(section: &Section<'_>) -> Option<Expression> {
    let scope = scopes::toughness(section.document.tables()).ok()?;
    section.value("toughness")?.expression(&scope)
}

/// The law of growth; what goes with one is an error without it.
fn law(section: &Section<'_>) -> Option<GrowthLaw> {
    let names: Vec<_> = std::iter::once("rate").chain(NAMED_LAWS.map(|law| law.name)).collect();
    let mut own = None;
    let law = match &section.given(&names)[..] {
        [] => {
            let parts = section.given(&["ratio", "cycles", "closure", "wheeler"]);
            let remedy =
                "is for growth by a law; add e.g. `paris = { c = 1e-10, m = 3 }` or a `rate`";
            return parts.first().and_then(|(_, value)| value.error(remedy));
        }
        [_, (_, second), ..] => return second.error("is another law of growth; give one"),
        [("rate", value)] => {
            let text = value.text()?;
            match GrowthLaw::formula(text, section.document.tables()) {
                Ok(formula) => value.inside(text, formula),
                Err(error) => value.error(&format!("cannot be used: {error}")),
            }
        }
        [(name, _)] => {
            own = section.section(name);
            let law = NAMED_LAWS.iter().find(|law| law.name == *name);
            law.zip(own.as_ref()).and_then(|(law, own)| named(own, law))
        }
    };
    let closure = section.section("closure").and_then(|section| {
        Some(Closure { alpha: section.require("alpha")?, stress: section.require("stress")? })
    });
    let wheeler = section.section("wheeler").and_then(|section| {
        let (yield_stress, exponent) = (section.require("yield"), section.require("exponent"));
        let constraint = section.or("constraint", 1.0);
        Some(Wheeler { yield_stress: yield_stress?, exponent: exponent?, constraint: constraint? })
    });
    let blocks = blocks(section, own.as_ref().and_then(|own| own.value("ratio")));
    let mut law = law?.with_closure(closure);
    if let Some(value) = section.value("closure").filter(|_| !law.uses("opening")) {
        return value
            .error("has no effect on a law without `opening`; take it out, or use it in `rate`");
    }
    (law.blocks, law.wheeler) = (blocks?, wheeler);
    Some(law)
}

fn named(section: &Section<'_>, law: &'static NamedLaw) -> Option<GrowthLaw> {
    let value = |(key, default): &(&'static str, Option<f64>)| match default {
        Some(default) => section.or(key, *default),
        None => section.require(key),
    };
    Some(GrowthLaw::named(law, all(law.parameters.iter().map(value))?))
}

/// The loads of a law: blocks, or cycles of one ratio, which Paris' law has among its own keys,
/// too.
fn blocks(section: &Section<'_>, own_ratio: Option<DocumentValue<'_>>) -> Option<Vec<LoadBlock>> {
    let all_given = [own_ratio, section.value("ratio"), section.value("cycles")];
    let mut given = all_given.into_iter().flatten();
    let (first, second) = (given.next(), given.next());
    if let Some(second) = second {
        return second
            .error("says another time which loads repeat; give `ratio` or `cycles`, once");
    }
    let Some(value) = first else { return Some(vec![LoadBlock::constant(0.0)]) };
    match section.value("cycles") {
        None => {
            // what is wrong is reported, and 0 stands for it
            Some(vec![LoadBlock::constant(value.within("ratio", section).unwrap_or(0.0))])
        }
        Some(value) => all(value.list()?.iter().map(|block| {
            let [cycles, max, min] = <[f64; 3]>::read(block)?;
            Some(LoadBlock { cycles, max, min })
        })),
    }
}

pub(super) fn refinement(section: &Section<'_>) -> Option<LocalRefinement> {
    let place = place(section);
    let (distance, size) = (section.or("distance", 0.0), section.require("size"));
    Some(LocalRefinement { place: place?, distance: distance?, size: size? })
}

fn place(section: &Section<'_>) -> Option<RefinementRegion> {
    let is_disc = |key: &str| ["center", "radius"].contains(&key);
    let mut given = section.given(&["box", "center", "radius", "hole", "crack"]);
    given.dedup_by(|b, a| is_disc(a.0) && is_disc(b.0));
    if let [_, (_, second), ..] = &given[..] {
        return second.error("names another place; write one [[refine]] for each");
    }
    if section.mentions_any(&["center", "radius"]) {
        let (center, radius) = (section.require("center"), section.require("radius"));
        return Some(RefinementRegion::Disc { center: center?, radius: radius? });
    }
    match given.first().map_or("", |(key, _)| key) {
        "box" => {
            let [x0, y0, x1, y1] = section.get("box")?;
            Some(RefinementRegion::Box(Rect::new(vec2(x0, y0), vec2(x1, y1))))
        }
        "hole" => section.get("hole").map(RefinementRegion::Hole),
        "crack" => section.get("crack").map(RefinementRegion::Crack),
        _ => Some(RefinementRegion::Plate),
    }
}
