use ppum::crack::{Crack, CrackEnd, End, SegmentId, Side, TipId, tips};
use ppum::dataset::Step;
use ppum::formula::Table;
use ppum::function::{
    Cut, CutBranch, Frame, Function, FunctionKind, FunctionTable, Slot, WESTERGAARD,
};
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Recipe, crack};
use ppum_testkit::wgsl::Module;
use std::sync::Arc;

use super::{call, module};
use crate::error::GpuError;
use crate::frame::geometry::{PairGeometry, constants};
use crate::scene::groups::{FunctionGroups, GroupFrame};
use crate::shader::functions::{FormulaContext, functions_wgsl};
use crate::shader::texts::{
    CRACK, GEOMETRY, INDICATOR, JET, TIP, WESTERGAARD as WESTERGAARD_KERNEL,
};

/// The centre of the view.
const CENTER: Vec2 = vec2(0.8, 0.2);

/// The data of a view and what reads them, with the other declarations that point functions need.
fn view(step: &Step, frames: &[GroupFrame], order: usize) -> String {
    let domain = Rect::new(vec2(-9.0, -9.0), vec2(9.0, 9.0)).into();
    let geometry = PairGeometry::new(step, &domain, frames, CENTER);
    let words = geometry.pairs.iter().flatten().map(|v| format!("{:#x}u", v.to_bits()));
    let bits: Vec<String> = words.collect();
    let (count, bits) = (bits.len(), bits.join(", "));
    format!(
        "struct View {{ cracks: u32 }}
        const view = View({}u);
        const ORDER = {order}u;
        const HAS_KINKS = true;
        const HAS_ARCS = true;
        const LANE_PAIRS = 1u;
        alias Lanes = vec2<f32>;
        const WORDS = array<u32, {count}>({bits});
        fn load_view(at: u32) -> vec2<f32> {{
            return bitcast<vec2<f32>>(vec2<u32>(WORDS[2u * at], WORDS[2u * at + 1u]));
        }}
        {}",
        geometry.cracks,
        constants(),
    )
}

const NUMBERS: &str = "
    fn numbers(group: f32, x: f32, y: f32) -> array<f32, 13> {
        let f = functions(u32(group), vec2<f32>(x, y));
        return array<f32, 13>(
            f.v.x, f.x.x, f.y.x, f.v.y, f.x.y, f.y.y, f.v.z, f.x.z, f.y.z, f.v.w, f.x.w, f.y.w,
            select(0.0, 1.0, is_one(u32(group))));
    }";

/// The module of some functions, and their text.
fn shader(
    functions: &[Function],
    groups: &FunctionGroups,
    cracks: &[Crack],
    tables: &[Arc<Table>],
    order: usize,
) -> (Module, String) {
    let surroundings = FormulaContext { cracks: cracks.len(), tables, order };
    let (text, kernels) = functions_wgsl(functions, groups, surroundings).expect("a text");
    assert_eq!(kernels.len(), groups.count());
    assert!(kernels.iter().all(|kernel| text.contains(&format!("fn functions_{kernel}("))));
    let recipe =
        Recipe { level: 0, cells: [1, 1], tip_level: 0, cracks: vec![], ..Recipe::default() };
    let mut step = recipe.step();
    step.cracks = cracks.to_vec();
    step.functions = functions.to_vec();
    let view = view(&step, &groups.frames(functions), order);
    let parts = [JET, CRACK, INDICATOR, TIP, WESTERGAARD_KERNEL, GEOMETRY, &view, &text, NUMBERS];
    (module(&parts), text)
}

/// A kinked one, and an arc.
fn cracks() -> Vec<Crack> {
    let arc = crack(&[[0.7, 0.5], [1.1, 0.45]], [CrackEnd::Tip; 2]);
    vec![
        crack(&[[0.5, 0.1], [0.8, 0.17], [1.0, 0.3]], [CrackEnd::Tip; 2]),
        Crack { bulges: vec![0.3], ..arc },
    ]
}

fn recipe(extra: Vec<FunctionKind>) -> Vec<Function> {
    Recipe { cracks: cracks(), extra, ..Recipe::default() }.functions()
}

fn formula(text: &str, frame: Frame, parameters: &[(&str, f64)]) -> FunctionKind {
    let mut kind = FunctionKind::formula(text, frame);
    if let FunctionKind::Formula { parameters: all, .. } = &mut kind {
        *all = parameters.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
    }
    kind
}

/// Compares all functions with derivatives up to an order with the reference: formulas in
/// double precision.
fn compare(functions: &[Function], groups: &FunctionGroups, tables: &[Arc<Table>], order: usize) {
    let cracks = &cracks();
    let (shader, _) = shader(functions, groups, cracks, tables, order);
    let table = FunctionTable::of_formulas(functions, cracks.len(), tables).expect("functions");
    let (local, mut random) = (table.at(cracks, CENTER), Random(4));
    for _ in 0..40 {
        let offset = [random.between(-0.3, 0.3), random.between(-0.3, 0.3)].map(|v| v as f32);
        for (index, function) in (0..).zip(functions) {
            let [group, entry] = groups.slot(index);
            let all = call(&shader, "numbers", &[group as f32, offset[0], offset[1]]);
            assert_eq!(all[12] == 1.0, function.kind == FunctionKind::One, "{}", function.name);
            let found = &all[3 * entry as usize..][..3];
            let mut jets = [Jet::constant(1.0); 4];
            let entry = match table.of(index) {
                Slot::One => 0,
                Slot::Jet { group, entry } => {
                    let at = offset.map(f64::from);
                    local.evaluate::<f64, 1>(group as usize, at, Side::Above, &mut jets);
                    entry
                }
            };
            let jet = jets[entry as usize];
            let count = [1, 3][order];
            let expected = [jet.v, jet.x, jet.y];
            for (k, (a, b)) in found.iter().zip(expected).enumerate() {
                let b = if k < count { b } else { 0.0 };
                // offsets and origins of single precision, derivatives of size 1/r near a tip
                assert!(
                    (a - b).abs() <= 2e-5 * (1.0 + b.abs()),
                    "{} derivative {k} at {offset:?}: {a:e} {b:e}",
                    function.name
                );
            }
        }
    }
}

fn all_kinds() -> Vec<FunctionKind> {
    let fixed = Frame::Fixed { origin: vec2(0.2, -0.7), angle: 0.7 };
    let tip = Frame::Tip(TipId { crack: 1, end: End::Start });
    vec![
        formula("exp(-a*x)*cos(y^2) - r^3/(1 + x^2)", fixed, &[("a", 1.5)]),
        formula("x*y^2 + fn*loop", fixed, &[("fn", 0.5), ("loop", 2.0)]),
        formula("x*y^2", Frame::World, &[]),
        formula("(x - y)*side(1)", Frame::World, &[]),
        formula("theta*x*side(0) + y", tip, &[]),
        formula("cos(1.5*theta)*r + table(array, x)", tip, &[]),
        formula("3", tip, &[]),
        component(),
        FunctionKind::One,
        component(),
    ]
}

/// Left of the second segment of the first crack, and there right of the second crack; or right of
/// all of these.
fn component() -> FunctionKind {
    let cut =
        |crack, segment, left, right| Cut { segment: SegmentId { crack, segment }, left, right };
    let cuts = vec![
        cut(0, 1, CutBranch::Cut(1), CutBranch::Cut(2)),
        cut(1, 0, CutBranch::Outside, CutBranch::Inside),
        cut(0, 0, CutBranch::Outside, CutBranch::Cut(3)),
        cut(1, 0, CutBranch::Outside, CutBranch::Inside),
    ];
    FunctionKind::Component { cuts }
}

fn tables() -> Vec<Arc<Table>> {
    let knots = vec![-2.0, -0.5, 0.0, 1.0, 2.0];
    vec![Arc::new(
        Table::curve("array", knots.clone(), knots.iter().map(|x| x * x).collect())
            .expect("a table"),
    )]
}

#[test]
fn functions_of_every_kind() {
    let functions = recipe(all_kinds());
    for order in 0..=1 {
        compare(&functions, &FunctionGroups::new(&functions), &tables(), order);
    }
}

/// Formulas in place of a kernel's function, of a side, of a component and of 1, some of them at
/// one tip only.
#[test]
fn replaced_functions() {
    let plain = Recipe { cracks: cracks(), ..Recipe::default() };
    let mut step = plain.dataset().steps.remove(0);
    step.functions = recipe(all_kinds());
    let groups = FunctionGroups::new(&step.functions);
    let component = step.functions.iter().position(|f| f.kind == component());
    let component = component.expect("a component").to_string();
    for (which, text) in [
        ("1", "2*y + side(1)"),
        ("3", "r*x"),
        ("0", "1 + x"),
        ("10", "x + theta/4"),
        (&component, "x - side(0)"),
    ] {
        step.replace_function(which, text, &tables()).expect("a formula");
        compare(&step.functions, &groups, &tables(), 1);
    }
}

/// Tips have one kernel, however many there are.
#[test]
fn kernels_are_shared() {
    let cracks: Vec<Crack> = (0..144)
        .map(|k| crack(&[-1.0, 0.0, 1.0].map(|x| [x, f64::from(k)]), [CrackEnd::Tip; 2]))
        .collect();
    let mut functions = vec![Function { name: "one".into(), kind: FunctionKind::One }];
    for crack in 0..cracks.len() as u32 {
        functions.push(Function { name: "side".into(), kind: FunctionKind::Side { crack } });
    }
    for tip in tips(&cracks) {
        for text in WESTERGAARD.into_iter().chain(["r*theta"]) {
            let kind = FunctionKind::formula(text, Frame::Tip(tip));
            functions.push(Function { name: text.to_owned(), kind });
        }
    }
    functions.extend((0..50).map(|_| Function { name: "component".into(), kind: component() }));
    functions.push(Function { name: "side".into(), kind: FunctionKind::Side { crack: 3 } });
    let groups = FunctionGroups::new(&functions);
    assert_eq!(groups.count(), 1 + 145 + 50 + 288 + 288);
    let (_, text) = shader(&functions, &groups, &cracks, &[], 1);
    assert_eq!(text.matches("fn functions_").count(), 5);
    assert_eq!(text.matches("if group <").count(), 4);
    assert_eq!(text.matches("fn formulas_").count(), 1);
}

#[test]
fn random_recipes_are_valid() {
    for seed in 0..4 {
        let recipe = Recipe::random(seed);
        let recipe = if seed < 2 { recipe } else { recipe.with_arcs() };
        let functions = recipe.functions();
        for order in 0..=1 {
            shader(&functions, &FunctionGroups::new(&functions), &recipe.cracks, &[], order);
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_an_error_with_the_functions_name() {
    let knots: Vec<f64> = (0..3000).map(f64::from).collect();
    let long = [Arc::new(Table::curve("long", knots.clone(), knots).expect("a table"))];
    let error = |text: &str| {
        let functions =
            [Function { name: "load".into(), kind: FunctionKind::formula(text, Frame::World) }];
        let surroundings = FormulaContext { cracks: 0, tables: &long, order: 1 };
        functions_wgsl(&functions, &FunctionGroups::new(&functions), surroundings)
            .expect_err("no text")
    };
    let long = error("table(long, x)");
    assert!(matches!(long, GpuError::FormulaTooLarge { .. }), "{long}");
    assert!(long.to_string().contains("`load`") && long.to_string().contains("`long`"), "{long}");
    let broken = error("x +* y");
    assert!(
        matches!(&broken, GpuError::Formula { what, .. } if what.contains("`load`")),
        "{broken}"
    );
}
