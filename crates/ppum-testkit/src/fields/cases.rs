//! The cases, in groups.

use std::sync::Arc;

use ppum::crack::{Crack, CrackEnd};
use ppum::dataset::{Dataset, Eigenstrain, Material, StressState};
use ppum::domain::{Hole, PolygonSide};
use ppum::edge::Edge;
use ppum::equation::{Elasticity, Equation};
use ppum::expression::Expression;
use ppum::formula::{Scope, Table};
use ppum::function::{Frame, FunctionKind, WESTERGAARD};
use ppum::vec2::{Vec2, vec2};
use ppum::weight::WeightFunction;

use super::window::Window;
use crate::synthetic::{Coefficients, Recipe, crack, kinked};

/// A dataset to be drawn.
#[derive(Clone, Debug)]
pub struct DrawingCase {
    /// Its subject.
    pub name: String,
    /// The dataset; its first step is drawn.
    pub dataset: Dataset,
    /// The window.
    pub windows: Vec<Window>,
    /// Texts of the quantities that are drawn, the one that shows most first.
    pub quantities: Vec<String>,
}

/// All of the gradient, and a value.
const SOME: &[&str] = &["von-mises", "uy"];

/// Degree 0 to 8, the same everywhere else.
const DEGREES: [u8; 9] = [2, 0, 8, 1, 5, 3, 7, 4, 6];

impl DrawingCase {
    fn new(name: &str, recipe: &Recipe, quantities: &[&str]) -> Self {
        Self {
            name: name.to_owned(),
            dataset: recipe.dataset(),
            windows: vec![whole([101, 75])],
            quantities: quantities.iter().map(|&text| text.to_owned()).collect(),
        }
    }

    fn with_windows(self, windows: Vec<Window>) -> Self {
        Self { windows, ..self }
    }

    fn with(mut self, change: impl FnOnce(&mut Dataset)) -> Self {
        change(&mut self.dataset);
        self
    }
}

/// Nearly the whole domain of the recipes, with pixels that are commensurate with no cell.
fn whole(pixels: [u32; 2]) -> Window {
    let center = Recipe::default().domain.center() + vec2(0.0123, -0.0171);
    Window { center, width: 1.2637, pixels }
}

/// Covers, weights, degrees and frames of polynomials.
#[must_use]
pub fn coverings() -> Vec<DrawingCase> {
    let default = Recipe::default;
    let weight = |text: &str| {
        let known = WeightFunction::from_library(text);
        let scope = Scope::new(&["t"]).expect("t is a name");
        known.unwrap_or_else(|| WeightFunction::formula(text, &scope).expect("a weight"))
    };
    let weights =
        ["linear", "quadratic", "cubic", "bump", "if(t < 1/4, 1, (1 - t)^2*(16/9)) + 0.3*(1 - t)"];
    let of_weight = |text: &&str| {
        let recipe = Recipe { weight: weight(text), tip_level: 3, ..default() };
        DrawingCase::new(&format!("weight {text}"), &recipe, &["von-mises"])
    };
    let mut all: Vec<_> = weights.iter().map(of_weight).collect();
    let mixed = Recipe { degrees: DEGREES.to_vec(), tip_degree: 1, own_frames: true, ..default() };
    all.push(DrawingCase::new("degrees 0 to 8, frames of their own", &mixed, SOME));
    for level in [0, 1, 5] {
        let recipe = Recipe { level, tip_level: level, ..default() };
        all.push(DrawingCase::new(
            &format!("uniform cover of level {level}"),
            &recipe,
            &["von-mises"],
        ));
    }
    let graded = Recipe { level: 1, tip_level: 8, random_rounds: 2, ..default() };
    all.push(DrawingCase::new("graded cover", &graded, &["von-mises", "overlap"]));
    let partition = ["von-mises", "ux", "phi:3", "weight-sum", "overlap"];
    for (seed, quantities) in [(1, &partition[..]), (2, SOME), (3, SOME)] {
        all.push(DrawingCase::new(&format!("random {seed}"), &Recipe::random(seed), quantities));
    }
    all.push(DrawingCase::new("random with arcs", &Recipe::random(4).with_arcs(), SOME));
    all
}

/// Functions, cracks and numbers of components.
#[must_use]
pub fn functions() -> Vec<DrawingCase> {
    let default = Recipe::default;
    let texts = WESTERGAARD.map(|text| format!("({text})"));
    let formulas = Recipe { tip_functions: texts, tip_degree: 1, ..default() };
    let williams = ["r*cos(theta)", "r^(3/2)*sin(1.5*theta)", "sqrt(r)*cos(theta/2)", "x*y"];
    let others = Recipe { tip_functions: williams.map(str::to_owned), ..default() };
    let fixed = Frame::Fixed { origin: vec2(0.9, 0.1), angle: 0.7 };
    let extra = [
        ("exp(-x)*cos(y^2) - r^3/(1 + x^2)", fixed),
        ("side(0)*(1 + x*y)", Frame::World),
        ("max(x, y)*tanh(3*x)", fixed),
    ]
    .map(|(text, frame)| FunctionKind::formula(text, frame))
    .to_vec();
    let sides = Recipe { extra, degrees: vec![1, 2], ..default() };
    let cracks = Recipe { cracks: several(), zone: 0.1, ..default() };
    let mut all = vec![
        DrawingCase::new("tip functions without a kernel", &formulas, SOME),
        DrawingCase::new("other tip functions", &others, SOME),
        DrawingCase::new("formulas in fixed frames and with sides", &sides, SOME),
        DrawingCase::new("several cracks", &cracks, SOME).with_windows(vec![whole([147, 111])]),
        DrawingCase::new("a function of a table", &extra_of_one("x*y^2"), SOME).with(tabulate),
    ];
    for components in [1, 3, 4, 6] {
        let recipe = Recipe { components, degrees: vec![2, 3], tip_level: 3, ..default() };
        let name = format!("{components} components");
        let quantities =
            if components == 4 { &["gradient", "magnitude"][..] } else { &["gradient"] };
        all.push(DrawingCase::new(&name, &recipe, quantities));
    }
    all
}

/// Two cracks inside, one from the left edge.
fn several() -> Vec<Crack> {
    let straight = crack(&[[0.7512, -0.1523], [1.2231, -0.0317]], [CrackEnd::Tip; 2]);
    let edge = crack(&[[0.2, 0.4312], [0.4123, 0.4987]], [CrackEnd::Mouth, CrackEnd::Tip]);
    vec![kinked(), straight, edge]
}

fn extra_of_one(text: &str) -> Recipe {
    let extra = vec![FunctionKind::formula(text, Frame::World)];
    Recipe { extra, tip_level: 3, ..Recipe::default() }
}

/// Puts a function of a table in the place of the extra one.
fn tabulate(dataset: &mut Dataset) {
    let x: Vec<f64> = (0..9).map(|k| f64::from(k) * 0.6).collect();
    let values = x.iter().map(|x| x.sin()).collect();
    dataset.tables = vec![Arc::new(Table::curve("wave", x, values).expect("a table"))];
    let tables = dataset.tables.clone();
    dataset.steps[0].replace_function("extra", "table(wave, 3*x)*y", &tables).expect("a function");
}

/// Cracks that cross, branch and end on each other, seen as a whole, in patches of all sizes.
#[must_use]
pub fn junctions() -> Vec<DrawingCase> {
    let graded = Recipe::meeting();
    let coarse = Recipe { level: 1, tip_level: 2, overlap: 1.6, ..Recipe::meeting() };
    let random = Recipe {
        coefficients: Coefficients::Random,
        degrees: DEGREES.to_vec(),
        own_frames: true,
        ..Recipe::meeting()
    };
    let one = Recipe { components: 1, weight: WeightFunction::Cubic, ..Recipe::meeting() };
    vec![
        DrawingCase::new("junctions", &graded, SOME).with_windows(vec![whole([151, 113])]),
        DrawingCase::new("junctions in large patches", &coarse, SOME),
        DrawingCase::new("junctions of unrelated patches", &random, SOME),
        DrawingCase::new("junctions of a potential", &one, &["gradient", "u"]),
    ]
}

/// All quantities of an elastic plate, φ of a patch, and formulas of them.
const ELASTIC: &str = "von-mises; ux; duy_dx; duy_dy; magnitude; gradient; energy; weight-sum; overlap; \
    divergence; curl; exx; eyy; exy; sxx; syy; sxy; szz; tresca; s1; s2; direction; hydrostatic; phi:23; \
    sqrt(sxx^2 + 3*sxy^2) - 2*ux; if(x > 0.7, s1, s2)";

/// Those of a body that a temperature strains.
const HEATED: [&str; 9] = [
    "von-mises",
    "temperature",
    "sxx",
    "szz",
    "energy",
    "direction",
    "magnitude",
    "gradient",
    "s1 - elastic_xx",
];

/// Those in which a body of revolution has its hoop strain u_x/x.
const ROUND: [&str; 9] =
    ["von-mises", "shoop", "ehoop", "sxx", "s1", "energy", "divergence", "tresca", "hydrostatic"];

/// Equations, materials, holes, and quantities of all kinds.
#[must_use]
pub fn equations() -> Vec<DrawingCase> {
    let elastic: Vec<&str> = ELASTIC.split("; ").collect();
    let coarse = Recipe { level: 1, tip_level: 2, ..Recipe::default() };
    let regions = Equation::Elasticity(Elasticity {
        young: expression("if(x < 0.8131, 1, 2) + 0.25*y"),
        poisson: expression("if(x^2 + y^2 < 0.5, 0.2, 0.3)"),
        state: StressState::PlaneStress,
        eigenstrain: None,
        anisotropy: None,
    });
    let stress = Material { young: 1.0, poisson: 0.35, state: StressState::PlaneStress };
    let round = Material { state: StressState::Axisymmetric, ..stress };
    let one = Recipe { components: 1, ..coarse.clone() };
    let three = Recipe { components: 3, ..coarse.clone() };
    let heated = |state| {
        let strains = ["0.1*x", "-0.2", "0.3*y", "0.25"].map(expression);
        let expansion = Some(expression("0.5 + 0.25*y"));
        let eigenstrain = Some(Box::new(Eigenstrain { strains, expansion }));
        let (young, poisson) = (1.5.into(), 0.3.into());
        let equation = Equation::Elasticity(Elasticity {
            young,
            poisson,
            state,
            eigenstrain,
            anisotropy: None,
        });
        move |d: &mut Dataset| {
            let names = equation.component_names().iter().map(|&name| name.to_owned());
            d.steps[0].fields[0].components = names.collect();
            d.equation = equation.clone();
        }
    };
    let conductivity = expression("1 + 0.5*sin(3*x)");
    vec![
        DrawingCase::new("all quantities", &coarse, &elastic).with_windows(vec![whole([89, 67])]),
        DrawingCase::new("plane stress", &coarse, &["von-mises", "szz"])
            .with(|d| d.equation = Equation::elasticity(stress)),
        DrawingCase::new("materials by region", &coarse, &["von-mises", "energy"])
            .with(|d| d.equation = regions),
        DrawingCase::new("Poisson", &one, &["energy", "u"])
            .with(|d| d.equation = Equation::Poisson { conductivity, axisymmetric: false }),
        DrawingCase::new("temperature in plane strain", &three, &HEATED)
            .with(heated(StressState::PlaneStrain)),
        DrawingCase::new("temperature in plane stress", &three, &HEATED)
            .with(heated(StressState::PlaneStress)),
        DrawingCase::new("temperature in a body of revolution", &three, &ROUND)
            .with(heated(StressState::Axisymmetric)),
        DrawingCase::new("body of revolution", &coarse, &ROUND)
            .with(|d| d.equation = Equation::elasticity(round)),
        DrawingCase::new("holes", &coarse, &["von-mises", "ux"]).with(|d| d.domain.holes = holes()),
        DrawingCase::new("outline", &coarse, &["von-mises", "ux"])
            .with(|d| d.domain.holes = outlined()),
        DrawingCase::new("rims with arcs", &coarse, &["von-mises", "ux"])
            .with(|d| d.domain.holes = rounded()),
    ]
}

fn expression(text: &str) -> Expression {
    Expression::parse(text).expect("a formula of x and y")
}

/// A circle inside, one over the border, a polygon over the first.
fn holes() -> Vec<Hole> {
    let round = Hole::Circle { center: vec2(0.5, 0.1), radius: 0.125 };
    let notch = Hole::Circle { center: vec2(1.2, 0.71), radius: 0.2 };
    let points = [[0.4, 0.2], [0.8, 0.15], [0.6, 0.3], [0.7, 0.55]];
    vec![round, notch, Hole::polygon(points.map(Vec2::from).to_vec())]
}

/// A body with an outline that turns inwards, leaves the box and has a hole over it.
fn outlined() -> Vec<Hole> {
    let points = [[-0.9, 0.05], [0.2, 0.3], [1.1, -0.2], [1.0, 0.9], [0.1, 0.55], [-0.6, 0.8]];
    let mut all = holes();
    all.push(Hole::outside(points.map(Vec2::from).to_vec()));
    all
}

/// A body with an outline of arcs and segments, a slot with round ends, and a hole of a large arc
/// and a small one.
fn rounded() -> Vec<Hole> {
    let polygon = |points: &[[f64; 2]], bulges: &[f64], side| {
        let points = points.iter().copied().map(Vec2::from).collect();
        Hole::with_arcs(points, bulges.to_vec(), side)
    };
    let outline = [[0.25, -0.25], [1.3, -0.2], [1.35, 0.5], [0.3, 0.6]];
    vec![
        polygon(&outline, &[0.0, 0.5, -0.2, 0.0], PolygonSide::Outside),
        polygon(
            &[[0.4, 0.4], [0.7, 0.4], [0.7, 0.48], [0.4, 0.48]],
            &[0.0, 1.0, 0.0, 1.0],
            PolygonSide::Inside,
        ),
        polygon(&[[1.1, -0.02], [1.2, 0.0]], &[2.5, -0.4], PolygonSide::Inside),
    ]
}

/// Windows partly and wholly outside, of odd sizes, and inside one patch.
#[must_use]
pub fn wholes() -> Vec<DrawingCase> {
    let recipe = Recipe::default();
    let corner = recipe.domain.max + vec2(0.013, 0.017);
    let seen = |center, width, pixels| Window { center, width, pixels };
    let mut windows: Vec<_> =
        [[67, 49], [1, 1], [7, 120], [161, 3]].map(|pixels| seen(corner, 0.71, pixels)).to_vec();
    windows.push(seen(vec2(9.0, 0.0), 1.0, [33, 17]));
    windows.push(seen(recipe.domain.center(), 400.0, [64, 48]));
    let inside = Recipe { level: 0, tip_level: 0, degrees: vec![5], overlap: 1.1, ..recipe };
    let patch = vec2(0.2 + 1.0 / 6.0, -0.3 + 1.0 / 6.0);
    let alone = vec![seen(patch, 0.11, [65, 33]), seen(patch, 1e-8, [33, 65])];
    vec![
        DrawingCase::new("partly and wholly outside", &Recipe::default(), SOME)
            .with_windows(windows),
        DrawingCase::new("inside one patch", &inside, SOME).with_windows(alone),
        DrawingCase::new("unrelated patches", &unrelated(), SOME)
            .with_windows(vec![whole([101, 75])]),
    ]
}

fn unrelated() -> Recipe {
    Recipe {
        coefficients: Coefficients::Random,
        degrees: DEGREES.to_vec(),
        level: 1,
        ..Recipe::default()
    }
}

/// Zooms by factors up to 1e12 to a tip, beside it, to the middle of an oblique crack and to a
/// kink; the image's centre lies on them, or a few pixels beside the tip.
#[must_use]
pub fn zooms() -> DrawingCase {
    let recipe = Recipe { tip_level: 9, ..Recipe::default() };
    let points = recipe.cracks[0].points.clone();
    let middle = points[0] + (points[1] - points[0]) * 0.63;
    let beside = |zoom: f64| points[2] + vec2(0.71, 0.43) * (recipe.domain.size().x / zoom);
    let places: [&dyn Fn(f64) -> Vec2; 4] = [&|_| points[2], &beside, &|_| middle, &|_| points[1]];
    let windows = places
        .iter()
        .flat_map(|place| ZOOMS.map(|zoom| zoomed(&recipe, place(zoom), zoom)))
        .collect();
    DrawingCase::new("zooms", &recipe, SOME).with_windows(windows)
}

/// Zooms by the same factors to a tip on an arc, beside it, to the middle of the arc, to its joint
/// with a segment of the same tangent, to a kink of two arcs, and to the rim of a hole.
#[must_use]
pub fn arc_zooms() -> DrawingCase {
    let points = [[0.5713, 0.0931], [0.7642, 0.2217], [0.9831, 0.1973], [1.1837, 0.2831]];
    let [a, b, c, d] = points.map(Vec2::from);
    let arc = Edge::tangent_to(b, (b - a).unit(), c);
    let last = Edge { from: c, to: d, bulge: 0.7 };
    let bulges = vec![0.0, arc.bulge, last.bulge];
    let cracks = vec![Crack { points: vec![a, b, c, d], bulges, ends: [CrackEnd::Tip; 2] }];
    let recipe = Recipe { cracks, tip_level: 9, zone: 0.1, ..Recipe::default() };
    let holes = rounded();
    let rim = holes[0].edges().nth(1).map_or(a, |side| side.at(0.37));
    let beside = |zoom: f64| d + vec2(0.71, 0.43) * (recipe.domain.size().x / zoom);
    let places: [&dyn Fn(f64) -> Vec2; 6] =
        [&|_| d, &beside, &|_| last.at(0.63), &|_| b, &|_| c, &|_| rim];
    let windows = places
        .iter()
        .flat_map(|place| ZOOMS.map(|zoom| zoomed(&recipe, place(zoom), zoom)))
        .collect();
    DrawingCase::new("zooms to arcs", &recipe, SOME)
        .with_windows(windows)
        .with(|data| data.domain.holes = holes)
}

const ZOOMS: [f64; 5] = [1.0, 1e3, 1e6, 1e9, 1e12];

fn zoomed(recipe: &Recipe, center: Vec2, zoom: f64) -> Window {
    Window { center, width: recipe.domain.size().x / zoom, pixels: [65, 49] }
}

/// Zooms by factors of 1e3 to 1e12 to all junctions, and to the middle of an arm. Patches there are
/// no finer than is seen of jumps in single precision: their slopes are differences of constants
/// over the size of a patch.
#[must_use]
pub fn junction_zooms() -> DrawingCase {
    let recipe = Recipe { tip_level: 4, ..Recipe::meeting() };
    let arm = &recipe.cracks[0].points;
    let middle = arm[0] + (arm[1] - arm[0]) * 0.13;
    let places = recipe.junctions.iter().map(|place| place.center).chain([middle]);
    let seen = places.flat_map(|at| ZOOMS[1..].iter().map(move |&zoom| (at, zoom)));
    let windows = seen.map(|(at, zoom)| zoomed(&recipe, at, zoom)).collect();
    DrawingCase::new("zooms to junctions", &recipe, SOME).with_windows(windows)
}
