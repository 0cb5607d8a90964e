use std::sync::Arc;

use ppum::dataset::{Dataset, NamedQuantity};
use ppum::equation::{Elasticity, Equation, Material, StressState};
use ppum::expression::Expression;
use ppum::field::Field;
use ppum::formula::{Scope, Table};
use ppum::jet::Jet;
use ppum::quantity::{Quantity, QuantityError, Sample, Source, names};
use ppum::vec2::Vec2;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;
use ppum_testkit::wgsl::Module;

use super::{call, module};
use crate::error::GpuError;
use crate::shader::quantity::{order_of, quantity_wgsl};

/// Lanes of a field.
fn lanes(components: usize) -> usize {
    components.clamp(2, 4)
}

/// The structures that a quantity sees, and a function of the position and of each component's
/// value and gradient.
fn surroundings(components: usize) -> String {
    let (lanes, groups) = (lanes(components), components.div_ceil(4));
    let parameters: Vec<String> =
        (0..components).map(|c| format!("v{c}: f32, x{c}: f32, y{c}: f32")).collect();
    let vector = |member: &str, group: usize| {
        let lane = |lane: usize| match 4 * group + lane {
            c if c < components => format!("{member}{c}"),
            _ => "0.0".to_owned(),
        };
        format!("Lanes({})", (0..lanes).map(lane).collect::<Vec<_>>().join(", "))
    };
    let jets = |group| {
        let [v, x, y] = ["v", "x", "y"].map(|member| vector(member, group));
        format!("Jets({v}, {x}, {y})")
    };
    let all: Vec<String> = (0..groups).map(jets).collect();
    format!(
        "alias Lanes = vec{lanes}<f32>;
        struct Jets {{ v: Lanes, x: Lanes, y: Lanes }}
        struct Sample {{ position: vec2<f32>, u: array<Jets, {groups}>, weight_sum: f32, overlap: f32, part: f32 }}
        fn test(x: f32, y: f32, {}) -> f32 {{
            let u = array<Jets, {groups}>({});
            return quantity(Sample(vec2(x, y), u, 0.5, 3.0, 0.25));
        }}",
        parameters.join(", "),
        all.join(", "),
    )
}

fn shader(field: &Field<'_>, quantity: &Quantity) -> Module {
    let text = quantity_wgsl(field, quantity).expect("a text");
    module(&[&surroundings(field.components()), &text])
}

/// A dataset with so many components, called as the shading language would not have it.
fn dataset(components: usize) -> Dataset {
    let recipe =
        Recipe { components: components.min(4), level: 0, tip_level: 0, ..Recipe::default() };
    let mut dataset = recipe.dataset();
    if components > 2 {
        let data = &mut dataset.steps[0].fields[0];
        data.components = ["fn", "struct", "at", "vec2", "value", "quantity"].map(str::to_owned)
            [..components]
            .to_vec();
        data.coefficients = vec![data.coefficients[0].clone(); components];
    }
    dataset
}

/// A place and a gradient of single precision; every third nearly without shear or change
/// of volume.
fn sample(random: &mut Random, components: usize, k: usize) -> (Vec<f32>, Vec<Jet<f64>>) {
    let mut arguments = vec![random.between(0.3, 1.4) as f32, random.between(-0.2, 0.6) as f32];
    let mut numbers: Vec<f32> =
        (0..3 * components).map(|_| random.between(-1.0, 1.0) as f32).collect();
    if components == 2 {
        let small = 1e-4 * numbers[0];
        match k % 3 {
            1 => (numbers[2], numbers[4], numbers[5]) = (small, small, numbers[1] + small),
            2 => numbers[5] = small - numbers[1],
            _ => {}
        }
    }
    arguments.extend(&numbers);
    let jet = |n: &[f32]| {
        let [v, x, y] = [n[0], n[1], n[2]].map(f64::from);
        Jet { v, x, y, ..Jet::constant(0.0) }
    };
    (arguments, numbers.chunks(3).map(jet).collect())
}

fn expected(field: &Field<'_>, quantity: &Quantity, arguments: &[f32], jets: &[Jet<f64>]) -> f64 {
    let offset = [f64::from(arguments[0]), f64::from(arguments[1])];
    let moduli = field.equation.moduli(Vec2::ZERO, offset);
    quantity.of_field(&Sample { anchor: Vec2::ZERO, offset, moduli, jets, exact: &[] })
}

/// Unit roundoffs of single precision that a quantity may be apart: some operations, each of
/// numbers that are no larger than the constants times the gradient.
const ROUNDING: f64 = 16.0 * f32::EPSILON as f64;

/// Compares a quantity with its twin; `size` is that of what it is made of.
fn compare(field: &Field<'_>, name: &str, size: impl Fn(f64) -> f64) {
    let quantity = Quantity::parse(name, field).expect("a quantity");
    let (shader, mut random) = (shader(field, &quantity), Random(9));
    for k in 0..60 {
        let (arguments, jets) = sample(&mut random, field.components(), k);
        let (a, b) =
            (call(&shader, "test", &arguments)[0], expected(field, &quantity, &arguments, &jets));
        assert!((a - b).abs() <= ROUNDING * size(b.abs()), "{name} of {arguments:?}: {a:e} {b:e}");
    }
}

/// Names that of_field knows.
fn field_names(field: &Field<'_>) -> Vec<String> {
    let all = names(field.equation, &field.data.components).into_iter();
    let of_field = |q: &Quantity| !matches!(q.source(), Source::Exact | Source::Partition);
    all.filter(|(_, q)| of_field(q)).map(|(name, _)| name).collect()
}

#[test]
fn quantities_of_any_number_of_components() {
    for components in 1..=6 {
        let dataset = dataset(components);
        let field = Field::new(&dataset, 0).expect("a field");
        assert_eq!(field.components(), components);
        for name in field_names(&field) {
            // moduli of this material are below 1, angles below 2
            compare(&field, &name, |_| 4.0);
        }
    }
}

#[test]
fn quantities_of_materials() {
    let scope = Scope::cartesian();
    let table = Table::curve("soil", vec![0.0, 0.5, 2.0], vec![1.0, 2.0, 1.5]).expect("a table");
    let with_table = scope.with_tables(&[Arc::new(table)]).expect("a new name");
    let parse = |text| Expression::parse_in(text, &with_table).expect("a formula");
    for (young, poisson) in [
        ("if(x < 0.8, 1, 3)", "0.3"),
        ("2", "0.2 + 0.1*sin(x*y)"),
        ("table(soil, x)", "0.1 + 0.2*y^2"),
    ] {
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            let mut dataset = dataset(2);
            dataset.equation = Equation::Elasticity(Elasticity {
                young: parse(young),
                poisson: parse(poisson),
                state,
                eigenstrain: None,
                anisotropy: None,
            });
            let field = Field::new(&dataset, 0).expect("a field");
            for name in field_names(&field) {
                compare(&field, &name, |_| 16.0);
            }
            compare(&field, "mu*exx + lambda*out_of_plane*young/poisson", |value| 32.0 + value);
        }
    }
    let mut dataset = dataset(1);
    dataset.equation = Equation::Poisson { conductivity: parse("1 + x^2"), axisymmetric: false };
    let field = Field::new(&dataset, 0).expect("a field");
    compare(&field, "energy", |_| 4.0);
    compare(&field, "conductivity*du_dx", |_| 4.0);
}

/// Stresses of a nearly incompressible solid, by thousands larger than what they differ in: still
/// all digits.
#[test]
fn stresses_keep_their_digits() {
    for poisson in [0.3, 0.499, 0.499_99] {
        let mut dataset = dataset(2);
        let material = Material { young: 2.1e11, poisson, state: StressState::PlaneStrain };
        dataset.equation = Equation::elasticity(material);
        let field = Field::new(&dataset, 0).expect("a field");
        for name in ["von-mises", "tresca"] {
            let quantity = Quantity::parse(name, &field).expect("a quantity");
            let (shader, mut random) = (shader(&field, &quantity), Random(2));
            let mut worst = 0.0f64;
            for k in 0..300 {
                let (arguments, jets) = sample(&mut random, 2, k);
                let a = call(&shader, "test", &arguments)[0];
                let b = expected(&field, &quantity, &arguments, &jets);
                // differences of the gradient's own numbers round once
                let strain = jets[0].x.abs() + jets[1].y.abs() + jets[0].y.abs() + jets[1].x.abs();
                worst = worst.max((a - b).abs() / (b + 0.7e11 * 1e-6 * strain));
            }
            assert!(worst < 1e-6, "{name} at {poisson}: {worst:e}");
        }
    }
}

#[test]
fn formulas_and_named_quantities() {
    let mut dataset = dataset(2);
    let named = |name: &str, text: &str| NamedQuantity {
        name: name.into(),
        text: text.into(),
        unit: String::new(),
    };
    dataset.quantities = vec![named("fn", "ux^2 + x"), named("loop", "2*fn + von_mises")];
    let table = Table::curve("let_go", vec![0.0, 1.0, 2.0], vec![0.0, 1.0, 4.0]).expect("a table");
    dataset.tables = vec![Arc::new(table)];
    let field = Field::new(&dataset, 0).expect("a field");
    for text in [
        "fn",
        "loop",
        "sqrt(ux^2 + uy^2)",
        "x*y + 1",
        "sxx - young*exx",
        "s1/mu",
        "3",
        "table(let_go, x)*ux",
    ] {
        compare(&field, text, |value| 4.0 + value);
    }
}

#[test]
fn quantities_of_the_partition() {
    let dataset = dataset(2);
    let field = Field::new(&dataset, 0).expect("a field");
    for (name, expected) in [("weight-sum", 0.5), ("overlap", 3.0), ("phi:1", 0.25)] {
        let quantity = Quantity::parse(name, &field).expect("a quantity");
        assert_eq!(call(&shader(&field, &quantity), "test", &[0.0; 8]), [expected]);
        assert_eq!(order_of(&quantity), 0);
    }
}

/// As of the CPU: values are finite at a tip, what is made of the gradient is infinite.
#[test]
fn infinite_where_the_gradient_is_not_a_number() {
    for components in [1, 2, 3] {
        let dataset = dataset(components);
        let field = Field::new(&dataset, 0).expect("a field");
        let mut arguments = vec![0.5; 2];
        arguments.extend((0..components).flat_map(|_| [0.25, f32::NAN, f32::NAN]));
        for name in field_names(&field) {
            let quantity = Quantity::parse(&name, &field).expect("a quantity");
            let found = call(&shader(&field, &quantity), "test", &arguments)[0];
            let is_gradient = quantity.source() == Source::Gradient;
            assert_eq!(found.is_infinite(), is_gradient, "{name}");
            assert_eq!(order_of(&quantity), u32::from(is_gradient));
        }
    }
}

/// Squares of these would leave the range of single precision.
#[test]
fn norms_of_large_and_tiny_numbers() {
    let dataset = dataset(2);
    let field = Field::new(&dataset, 0).expect("a field");
    let shader = |name| shader(&field, &Quantity::parse(name, &field).expect("a quantity"));
    for size in [1e-30f32, 1e30] {
        let found = call(
            &shader("magnitude"),
            "test",
            &[0.0, 0.0, 3.0 * size, 0.0, 0.0, 4.0 * size, 0.0, 0.0],
        );
        assert!((found[0] / f64::from(size) - 5.0).abs() < 1e-6, "{found:?}");
        let found = call(&shader("von-mises"), "test", &[0.0, 0.0, 0.0, 0.0, size, 0.0, size, 0.0]);
        // √3 σ_xy with σ_xy = 2μ·size, μ = 1/2.6
        assert!((found[0] / f64::from(size) - 3f64.sqrt() / 1.3).abs() < 1e-6, "{found:?}");
    }
}

#[test]
fn the_error_is_not_for_the_gpu() {
    let dataset = dataset(1);
    let field = Field::new(&dataset, 0).expect("a field");
    let quantity: Result<_, QuantityError> = Quantity::parse("error", &field);
    let found = quantity_wgsl(&field, &quantity.expect("a name"));
    assert_eq!(found, Err(GpuError::NeedsDouble { quantity: "error".to_owned() }));
}
