//! Milliseconds a frame.
use cpu_time::ProcessTime;
use ppum::crack::CrackEnd;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_gpu::{Choice, Method, Output, Renderer, Shading};
use ppum_render::colormap::Colormap;
use ppum_render::range::Range;
use ppum_render::raster::Raster;
use ppum_render::scale::Scale;
use ppum_render::view::View;
use ppum_testkit::synthetic::{Recipe, crack};
use std::time::Instant;

const STRAIGHT: [[f64; 2]; 2] = [[0.5713, 0.1531], [1.1831, 0.2473]];

fn recipe(level: u8) -> Recipe {
    let r = Recipe {
        cells: [4, 4],
        level,
        tip_level: 0,
        jumps: false,
        cracks: vec![crack(&STRAIGHT, [CrackEnd::Tip; 2])],
        ..Recipe::default()
    };
    let mut d: Vec<f64> = r
        .partition()
        .center
        .into_iter()
        .map(|p: Vec2| {
            STRAIGHT.iter().map(|&t| (p - Vec2::from(t)).length()).fold(f64::INFINITY, f64::min)
        })
        .collect();
    d.sort_by(f64::total_cmp);
    Recipe { zone: d[d.len() / 4], ..r }
}

fn main() {
    let levels: Vec<u8> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let mut renderer = Renderer::open(Choice::Any).unwrap();
    println!("{:?}", renderer.gpu().info());
    for level in levels {
        let recipe = recipe(level);
        let t = Instant::now();
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let made = t.elapsed();
        let t = Instant::now();
        let mut scene = renderer.upload(&field).unwrap();
        let up = t.elapsed();
        let norm = Range::Fixed(0.0, 5.0)
            .normalization(Scale::Linear, false, &Raster::new([1, 1], vec![1.0f32]))
            .unwrap();
        let shading = Shading {
            normalization: norm,
            colormap: Colormap::named("viridis").unwrap(),
            undefined: [0; 4],
        };
        for method in [Method::Splat, Method::Gather] {
            if method == Method::Splat && level > 5 {
                continue;
            }
            let mut program = renderer
                .compile(&scene, &field, &Quantity::VonMises, method, Output::Colors)
                .unwrap();
            let (mut wall, mut core) = (Vec::new(), Vec::new());
            for k in 0..9 {
                let s = f64::from(k) * 0.618_033_988;
                let view = View::new(
                    recipe.domain.center()
                        + vec2(0.00123 + 0.001 * s.fract(), -0.00171 + 0.0013 * s.fract()),
                    1.3297,
                    [1024, 768],
                )
                .unwrap();
                let (w, c) = (Instant::now(), ProcessTime::now());
                let drawn =
                    renderer.draw(&mut scene, &mut program, &field, &view, Some(&shading)).unwrap();
                renderer.wait().unwrap();
                wall.push(w.elapsed().as_secs_f64() * 1e3);
                core.push(c.elapsed().as_secs_f64() * 1e3);
                drop(drawn);
            }
            println!(
                "{:8} {method:?} first {:.1} wall min {:.1} core min {:.1}  all {:.1?}  (made {made:.1?} upload {up:.1?})",
                field.step.partition.len(),
                wall[0],
                wall.iter().copied().fold(1e9, f64::min),
                core.iter().copied().fold(1e9, f64::min),
                core
            );
        }
    }
}
