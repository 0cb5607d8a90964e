//! Frames of meshes beside covers of as many patches of the same order, by one thread:
//!
//!     cargo run --release -p ppum-bench --example meshes
//!
//! prints milliseconds, the least of some frames, of the value and of the gradient.

use std::time::Instant;

use anyhow::Context as _;
use ppum::cover::Cover;
use ppum::dataset::{Dataset, Equation, FieldData, Step};
use ppum::field::Field;
use ppum::function::FunctionKind;
use ppum::polynomial::PolynomialSpace::Total;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field, random_polynomial};
use ppum_testkit::random::Random;

const PIXELS: [u32; 2] = [800, 800];
const FRAMES: usize = 9;

fn main() -> anyhow::Result<()> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    pool.install(|| {
        println!("{:>8} {:>6} {:>9} {:>9} {:>6}", "patches", "order", "mesh", "cover", "ratio");
        for (cells, order, map_degree) in [([223, 224], 2, 1), ([70, 71], 4, 4)] {
            let mesh = triangles(cells, order, map_degree);
            let side = (2.0 * f64::from(cells[0] * cells[1])).sqrt() as u32;
            let cover = cover(side, order)?;
            for quantity in ["v", "gradient"] {
                let [a, b] = [&mesh, &cover].map(|dataset| least(dataset, quantity));
                let (a, b) = (a?, b?);
                let count = mesh.steps[0].partition.len();
                println!("{count:8} {order:6} {a:9.2} {b:9.2} {:6.2}  {quantity}", a / b);
            }
        }
        Ok(())
    })
}

/// Triangles over the unit square, moved inside of it by a polynomial of the degree of their maps.
fn triangles(cells: [i32; 2], order: u8, map_degree: u8) -> Dataset {
    let mut random = Random(1);
    let mut bent = |linear: BivariatePolynomial| {
        let p = random_polynomial(&mut random, Total, map_degree.into());
        linear.plus(&p.times(&BivariatePolynomial::linear(0.02, 0.0, 0.0)))
    };
    let plane = [
        bent(BivariatePolynomial::linear(0.0, 1.0, 0.0)),
        bent(BivariatePolynomial::linear(0.0, 0.0, 1.0)),
    ];
    let elements = MeshBuilder::tiles(cells, map_degree, &plane, |_, _| true);
    let one = |_| (Total, order, random_polynomial(&mut random, Total, order.into()));
    let parts: Vec<_> = (0..elements.mesh.len()).map(one).collect();
    elements.dataset(vec![field("v", &parts)])
}

fn cover(side: u32, order: u8) -> anyhow::Result<Dataset> {
    let (mut random, unit) = (Random(2), Rect::new(Vec2::ZERO, vec2(1.0, 1.0)));
    let boxes = Cover::grid(unit, [side, side])?.partition(1.3, WeightFunction::Quadratic)?;
    let mut field = FieldData::new("v", &["v"]);
    (0..boxes.len()).for_each(|_| field.push_patch(&[(0, order)]));
    field.coefficients[0].fill_with(|| random.between(-1.0, 1.0));
    let step = Step::new(boxes).with_function("one", FunctionKind::One).with_field(field);
    Ok(Dataset::new(unit, Equation::None).with_step(step))
}

/// The least of some frames, in milliseconds.
fn least(dataset: &Dataset, quantity: &str) -> anyhow::Result<f64> {
    let field = Field::new(dataset, 0)?;
    let quantity = Quantity::parse(quantity, &field)?;
    let view = View::window(0.0, 0.0, 1.0, 1.0, PIXELS)?;
    let mut least: Option<f64> = None;
    for _ in 0..FRAMES {
        let begin = Instant::now();
        std::hint::black_box(render::<f64>(&field, &view, &quantity, unwatched())?);
        let ms = begin.elapsed().as_secs_f64() * 1e3;
        least = Some(least.map_or(ms, |before| before.min(ms)));
    }
    least.context("there are frames")
}
