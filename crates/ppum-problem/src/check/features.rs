//! Features of problems, and which of them do not go together.
//!
//! [`EXCLUDED`] is the one list of pairs. A diagnostic has the place of the first of a pair, names
//! that of the second, and ends with a remedy for either. A requirement is a pair, too: of the
//! feature, and of the property of problems without the required one.

use ppum::crack::Crack;
use ppum::vec2::Vec2;

use crate::data::{
    Adaptivity, Criterion, Enrichment, GrowthLaw, GrowthRule, Keyword as _, LoadControl,
    LocalEnrichment, ProblemData, SolverKind, StepsKept, Symmetry,
};
use crate::file::{Key, KeyError};

/// A feature has a key, a remedy, and a problem that has it; keys in lists have their first entry.
struct FeatureRow {
    key: &'static str,
    remedy: &'static str,
    is_of: fn(&ProblemData) -> bool,
}

macro_rules! features {
    ($($(#[$about:meta])* $name:ident: $key:literal, $remedy:literal => $is_of:expr;)*) => {
        /// A property of a problem that excludes others.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Feature { $($(#[$about])* $name,)* }

        impl Feature {
            /// All features.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            fn row(self) -> FeatureRow {
                match self { $(Self::$name => FeatureRow { key: $key, remedy: $remedy, is_of: $is_of },)* }
            }
        }
    };
}

macro_rules! excluded {
    ($($first:ident, $second:ident => $why:literal;)*) => {
        /// Pairs that do not go together, and why; `{}` is the word of the enrichment.
        const EXCLUDED: &[(Feature, Feature, &str)] =
            &[$((Feature::$first, Feature::$second, $why)),*];
    };
}

features! {
    /// The field is a potential.
    Potential: "material", "" => |p| p.equation.elastic().is_none();
    /// E or ν vary.
    VaryingMaterial: "material", "give numbers for `young` and `poisson`" =>
        |p| p.equation.elastic().is_some() && !p.equation.has_uniform_material();
    /// The body is anisotropic.
    Anisotropic: "material", "give numbers for `young` and `poisson`" => |p| p.equation.anisotropy().is_some();
    /// Its axes are not those of the crack on the border.
    ObliqueFibres: "material.axis", "turn the axes along the crack" => |p| {
        p.border_cracks().any(|(_, line)| !is_aligned(p, line.ends))
    };
    /// A tip is on an arc.
    TipOnArc: "crack.points", "give the edge at the tip as a segment" => |p| arc_at_tip(p).is_some();
    /// The criterion rests on functions of kinks in isotropic bodies.
    OtherCriterion: "growth.criterion", "write `criterion = \"hoop\"`" =>
        |p| grows(p, |rule| rule.criterion != Criterion::Hoop);
    /// Strains are given, or made by a temperature.
    GivenStrains: "material.expansion", "leave [temperature] and [strain] out" =>
        |p| p.dataset_equation().eigenstrains().next().is_some();
    /// Shear is among them.
    GivenShear: "material.expansion", "leave `xy` out" =>
        |p| p.equation.eigenstrains().nth(2).is_some_and(|(_, xy)| xy.constant() != Some(0.0));
    /// The temperature is the solution of a problem.
    SolvedTemperature: "temperature.problem", "give the temperature by a formula" => |p| p.temperature.is_some();
    /// An exact solution is given.
    ExactSolution: "exact", "leave [exact] out" => |p| !p.exact.is_empty();
    /// Faces of cracks may touch.
    Contact: "crack.contact", "leave `contact` out" => |p| p.touches();
    /// Forces act at points.
    Forces: "force", "give it as a traction on a short piece of the border, or as a [body_force]" =>
        |p| !p.forces.is_empty();
    /// The body is a part of a symmetric one: a crack lies on its boundary.
    PartialModel: "crack.points", "model the whole plate" => |p| p.border_cracks().next().is_some();
    /// The whole of which it is a part is antisymmetric.
    SlidingPart: "crack.points", "model the whole plate" =>
        |p| p.border_cracks().any(|(k, _)| p.symmetry_of(k) == Some(Symmetry::Antisymmetric));
    /// The line of the crack is an oblique side of an outline.
    ObliquePart: "crack.points", "turn the body, or model the whole plate" => |p| {
        let is_oblique = |[a, b]: [Vec2; 2]| a.x != b.x && a.y != b.y;
        p.border_cracks().any(|(_, line)| line.hole.is_some() && is_oblique(line.ends))
    };
    /// The body is one of revolution.
    Axisymmetric: "material.state", "write another `state`" => |p| p.equation.is_axisymmetric();
    /// Functions of the user's own are in the space.
    UserFunctions: "enrichment", "leave [[enrichment]] out" => |p| !p.enrichments.is_empty();
    /// Tips have no series.
    OtherTipFunctions: "discretization.enrichment", "write `enrichment = \"williams\"`" =>
        |p| p.discretization.enrichment != Enrichment::Williams;
    /// No functions jump across cracks.
    NoJumps: "discretization.enrichment", "take another enrichment" =>
        |p| !p.discretization.enrichment.has_jumps() && !p.cracks().is_empty();
    /// No functions are in zones around tips.
    NoZones: "discretization.enrichment", "write `enrichment = \"williams\"`" => |p| {
        !p.discretization.enrichment.has_zones() && !p.enrichments.iter().any(LocalEnrichment::has_default_zone)
    };
    /// The number of terms at tips is given.
    TipTerms: "discretization.tip_terms", "remove it" => |p| p.discretization.tip_terms.is_some();
    /// The radius of zones around tips is given.
    EnrichmentRadius: "discretization.enrichment_radius", "remove it" => |p| p.discretization.enrichment_radius.is_some();
    /// An accuracy is asked for.
    Accuracy: "discretization.accuracy", "leave `accuracy` out" => |p| adapts(p, |set| set.accuracy.is_some());
    /// All steps of an adaptation are kept.
    KeptSteps: "adaptivity.keep", "leave `keep` out" => |p| adapts(p, |set| set.keep == StepsKept::All);
    /// The linear solver has levels.
    Multilevel: "solver.kind", "leave `kind` out" => |p| p.solver.kind == SolverKind::Multilevel;
    /// Cracks grow.
    Growth: "growth", "leave [growth] out" => |p| grows(p, |_| true);
    /// They grow under the load that they need.
    CriticalLoad: "growth.load", "leave `load` out" => |p| grows(p, |rule| rule.load == LoadControl::Critical);
    /// No toughness is known.
    NoToughness: "growth.toughness", "add a `toughness`" => |p| grows(p, |rule| rule.toughness.is_none());
    /// It depends on the direction of growth.
    DirectedToughness: "growth.toughness", "leave `direction` out" => |p| grows(p, GrowthRule::is_directed);
    /// They grow by a law.
    GrowthLaw: "growth.rate", "leave the law out" => |p| has_law(p, |_| true);
    /// The law has no rate without a toughness.
    ToughnessRate: "growth.rate", "take another law" => |p| has_law(p, |law| law.uses("toughness"));
    /// The law has no rate without closure.
    OpeningRate: "growth.rate", "take another law" => |p| has_law(p, |law| law.uses("opening"));
    /// No closure is known.
    NoClosure: "growth.closure", "add `closure = { alpha = 2, stress = 0.3 }`" =>
        |p| grows(p, |rule| rule.law.as_ref().is_none_or(|law| law.closure.is_none()));
}

excluded! {
    TipTerms, OtherTipFunctions => "`tip_terms` has no meaning with enrichment = \"{}\"";
    EnrichmentRadius, NoZones => "`enrichment_radius` has no meaning with enrichment = \"{}\"";
    // cells as small as there may be do not stand for functions of cracks
    Accuracy, NoJumps => "no accuracy can be had with `enrichment = \"{}\"`, which leaves out how fields jump across cracks";
    CriticalLoad, NoToughness => "`load = \"critical\"` needs a `toughness`, which the load is chosen to reach";
    DirectedToughness, OtherCriterion => "a `toughness` by `direction` goes with the largest hoop stress over it alone";
    CriticalLoad, GrowthLaw => "`load = \"critical\"` is for one load that grows, a law of growth for many cycles of the same";
    ToughnessRate, NoToughness => "the law of growth needs a `toughness`, which its rate depends on";
    ToughnessRate, DirectedToughness => "the law of growth takes one `toughness` at a point, and none by `direction`";
    OpeningRate, NoClosure => "the law of growth needs a `closure`, which its rate depends on";
    CriticalLoad, GivenStrains => "`load = \"critical\"` multiplies the loads by a factor, but not temperatures and given strains";
    SolvedTemperature, Contact => "a temperature that is solved for jumps across cracks whose faces touch";
    ExactSolution, SolvedTemperature => "an exact solution cannot be given beside a temperature that is solved for";
    Growth, Potential => "cracks grow by their stress intensity factors, which only elasticity has";
    KeptSteps, Growth => "`keep = \"all\"` keeps the steps of an adaptation, and [growth] those of growth";
    Contact, Potential => "only faces of elastic bodies touch";
    Contact, NoJumps => "with `enrichment = \"{}\"` faces do not part, so that they cannot touch";
    Multilevel, Contact => "faces that touch need the direct solver, since coarser levels do not see them";
    Forces, Contact => "no force at a point can act beside faces that touch";
    Forces, Potential => "the field of a force at a point is one of an elastic body";
    Forces, Anisotropic => "the field of a force at a point is known in isotropic bodies alone";
    TipOnArc, Anisotropic => "the fields of tips on arcs are known in isotropic bodies alone";
    SolvedTemperature, Anisotropic => "a temperature that is solved for strains a body alike in all directions";
    OtherCriterion, Anisotropic => "the functions of kinks that the criterion needs are those of isotropic bodies";
    ObliqueFibres, PartialModel => "the halves of an anisotropic body are alike only if the crack on its border is along an axis";
    Forces, VaryingMaterial => "the field of a force is known where E and ν are constants alone";
    OtherTipFunctions, PartialModel => "a crack on the border needs the functions of `enrichment = \"williams\"`";
    VaryingMaterial, PartialModel => "a crack on the border needs a material that is the same everywhere";
    GivenShear, PartialModel => "given strains have the symmetry of a crack on the border only without [strain] `xy`";
    GivenStrains, SlidingPart => "temperatures and given strains have the symmetry of a crack on the border only with `symmetry = true`";
    SolvedTemperature, PartialModel => "a temperature that is solved for cannot be had with a crack on the border";
    UserFunctions, PartialModel => "user-defined functions do not satisfy the symmetry of a border with a crack";
    Anisotropic, Axisymmetric => "the hoop strain is known in isotropic bodies of revolution alone";
    Forces, Axisymmetric => "a force at a point of the half-plane is one on a ring, whose field is another one";
    SlidingPart, Axisymmetric => "a body of revolution under loads of revolution has no part that is antisymmetric";
    Growth, SlidingPart => "a crack that slides turns off the line that it lies on";
    Growth, ObliquePart => "a crack grows along an edge, or along a side of an outline that is horizontal or vertical";
}

/// The first crack with a tip on an arc.
fn arc_at_tip(problem: &ProblemData) -> Option<usize> {
    let is_line = |crack: &Crack| crack.points.len() > 1;
    let has = |crack: &Crack| is_line(crack) && crack.tips().any(|end| crack.edge_to(end).is_arc());
    problem.cracks().iter().position(has)
}

/// Part of the stiffness that is rounding of angles.
const ALIGNED: f64 = 1e-9;

/// True if the axes of the material are those of a line, where it is the same everywhere.
fn is_aligned(problem: &ProblemData, [a, b]: [Vec2; 2]) -> bool {
    let axis = (b - a).unit();
    problem.equation.anisotropy().is_none_or(|law| {
        let [c11, _, c16, c22, c26, _] = law.at_tip(a, axis).stiffness();
        c16.abs().max(c26.abs()) <= ALIGNED * (c11 + c22)
    })
}

fn grows(problem: &ProblemData, is: fn(&GrowthRule) -> bool) -> bool {
    problem.growth.as_ref().is_some_and(is)
}

fn has_law(problem: &ProblemData, is: fn(&GrowthLaw) -> bool) -> bool {
    problem.growth.as_ref().and_then(|rule| rule.law.as_ref()).is_some_and(is)
}

fn adapts(problem: &ProblemData, is: fn(&Adaptivity) -> bool) -> bool {
    problem.adaptivity.as_ref().is_some_and(is)
}

impl ProblemData {
    /// The features of the problem.
    #[must_use]
    pub fn features(&self) -> Vec<Feature> {
        Feature::ALL.iter().copied().filter(|feature| (feature.row().is_of)(self)).collect()
    }
}

/// The diagnostics of pairs of features that exclude each other.
pub(super) fn check_features(problem: &ProblemData) -> Vec<KeyError> {
    let found = problem.features();
    let is_broken = |(first, second, _): &&_| found.contains(first) && found.contains(second);
    EXCLUDED.iter().filter(is_broken).map(|broken| error(problem, broken)).collect()
}

fn error(problem: &ProblemData, (first, second, why): &(Feature, Feature, &str)) -> KeyError {
    let remedies = [first, second].map(|feature| feature.row().remedy);
    let remedies: Vec<&str> = remedies.into_iter().filter(|remedy| !remedy.is_empty()).collect();
    let why = why.replace("{}", problem.discretization.enrichment.word());
    let error = first.key(problem).error(format!("{why}; {}", remedies.join(", or ")));
    let is_of_crack = second.row().key.starts_with("crack");
    if is_of_crack { error.with_other(second.key(problem)) } else { error }
}

impl Feature {
    /// True if the two are never in one problem.
    #[must_use]
    pub fn excludes(self, other: Self) -> bool {
        let is_pair = |(a, b, _): &_| [*a, *b] == [self, other] || [*b, *a] == [self, other];
        EXCLUDED.iter().any(is_pair)
    }

    /// Where it is said.
    fn key(self, problem: &ProblemData) -> Key {
        let (path, on_border) = (self.row().key, problem.border_cracks().next());
        match path.split_once('.') {
            None if ["force", "enrichment"].contains(&path) => Key::new(path).index(0),
            Some(("growth", "rate")) => {
                let law = problem.growth.as_ref().and_then(|rule| rule.law.as_ref());
                Key::new("growth").name(law.map_or("rate", GrowthLaw::key))
            }
            Some(("crack", name)) => {
                let contact = problem.body.contacts().next().map_or(0, |(crack, _)| crack);
                let border = on_border.map_or(0, |(crack, _)| crack);
                let crack = match self {
                    Self::Contact => contact,
                    Self::TipOnArc => arc_at_tip(problem).unwrap_or(0),
                    _ => border,
                };
                Key::new("crack").index(crack).name(name)
            }
            _ => Key::new(path),
        }
    }
}
