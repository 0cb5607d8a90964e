//! Formulas and the kernel that stands in for them are the same functions.

use crate::support::{assert_close, compiled, distance_to_cracks, evaluate, inside};
use ppum::crack::Side;
use ppum::function::{FunctionTable, Slot};
use ppum::vec2::Vec2;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// The four Westergaard functions in other words.
const OTHER_WORDS: [&str; 4] = [
    "cos(theta/2)*sqrt(r)",
    "sin(theta/2)*sqrt(r)",
    "sqrt(r)*sin(theta/2)*y/r",
    "let c = cos(theta/2); let s = sin(theta/2); 2*s*c^2*sqrt(r)",
];

/// On kinked cracks, at many scales around each tip and anywhere.
#[test]
fn formulas_agree_with_the_native_kernel() {
    for seed in 0..6 {
        let native = Recipe::random(seed);
        let formulas = Recipe { tip_functions: OTHER_WORDS.map(str::to_owned), ..native.clone() };
        let (a, b) = (native.dataset(), formulas.dataset());
        assert_eq!(a.steps[0].fields, b.steps[0].fields);
        let (a, b) = (compiled(&a), compiled(&b));
        let mut random = Random(seed);
        for tip in native.tips().map(|tip| native.position(tip)) {
            let (mut one, mut other) = (a.at(tip), b.at(tip));
            for k in 0..100 {
                let r = 10f64.powf(random.between(-10.0, 0.0));
                let offset = random.direction() * r;
                let side = if k % 2 == 0 { Side::Above } else { Side::Below };
                let Some(u) = evaluate::<2>(&mut one, offset, side) else { continue };
                let v = inside::<2>(&mut other, offset, side);
                for (u, v) in u.iter().zip(&v) {
                    let length = r.min(distance_to_cracks(a.step, tip + offset) + r / 10.0);
                    assert_close(u, v, 1e-12, 10.0 * r.sqrt().max(0.1), length.min(0.01));
                }
            }
        }
    }
}

/// The functions by themselves, to 1e-12 of √r in the value, r^{−1/2} in the gradient and r^{−3/2}
/// in the Hessian, right up to the faces and on both of them.
#[test]
fn single_functions_agree() {
    let native = Recipe::random(2);
    let formulas = Recipe { tip_functions: OTHER_WORDS.map(str::to_owned), ..native.clone() };
    let tables = [native, formulas].map(|recipe| {
        (FunctionTable::new(&recipe.functions(), recipe.cracks.len(), &[]).unwrap(), recipe)
    });
    let [(kernel, recipe), (table, _)] = &tables;
    let mut random = Random(2);
    for (tip, id) in recipe.tips().enumerate() {
        let crack = &recipe.cracks[id.crack as usize];
        let (at, back) = (crack.end_point(id.end), -crack.growth_direction(id.end));
        let (kernel_at, table_at) = (kernel.at(&recipe.cracks, at), table.at(&recipe.cracks, at));
        for n in 0..400 {
            let r = 10f64.powf(random.between(-12.0, -0.7));
            let tilt = 10f64.powf(random.between(-15.0, 0.0));
            let away =
                if n % 2 == 0 { random.direction() } else { (back + back.left() * tilt).unit() };
            let side = if n % 4 < 2 { Side::Above } else { Side::Below };
            for k in 0..4 {
                let function = (1 + recipe.cracks.len() + 4 * tip + k) as u32;
                let jet = |t: &FunctionTable, local: &ppum::function::LocalFunctions<'_>| {
                    let Slot::Jet { group, entry } = t.of(function) else { panic!("a function") };
                    let mut out = [ppum::jet::Jet::constant(0.0); 4];
                    local.evaluate::<f64, 2>(group as usize, (away * r).into(), side, &mut out);
                    out[entry as usize]
                };
                let (a, b) = (jet(kernel, &kernel_at), jet(table, &table_at));
                assert_close(&a, &b, 1e-12, r.sqrt(), r);
            }
        }
    }
    assert_eq!(kernel.group_len(kernel.groups() - 1), 1);
    assert_eq!(evaluate_at_tips(recipe), 0);
}

/// Number of tips where the value of the field is not finite.
fn evaluate_at_tips(recipe: &Recipe) -> usize {
    let dataset = recipe.dataset();
    let field = compiled(&dataset);
    let infinite = |tip| {
        let mut local = field.at(recipe.position(tip));
        let u = inside::<1>(&mut local, Vec2::ZERO, Side::Above);
        u.iter().any(|u| !u.v.is_finite())
    };
    recipe.tips().filter(|&tip| infinite(tip)).count()
}
