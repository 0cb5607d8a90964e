//! Golden pictures, on top of the numbers: a few small ones to look at, which all renderers draw.
//!
//! They are made by the CPU in double precision. To make them anew, and to look at them:
//!
//! ```text
//! PPUM_GOLDEN=write cargo test -p ppum-gpu --test conformance golden
//! ```

use std::path::{Path, PathBuf};

use ppum::dataset::Dataset;
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Image;
use ppum_render::picture::{Picture, Style};
use ppum_render::png;
use ppum_render::range::Range;
use ppum_render::raster::{Raster, Sample};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_testkit::synthetic::{Recipe, kinked};

use crate::{METHODS, good, quantity, renderer_or_skip};

/// Steps of a byte that a channel may be off: a value that is rounded may take the neighbouring entry of the palette,
/// or one of two sides of a crack or border that passes through the centre of its pixel.
const STEPS: u8 = 2;
/// Share of the pixels that may be farther off: those on cracks and borders.
const EXCEPTIONS: f64 = 0.002;

/// What is drawn: quantity, colours, their range, and a window.
struct Golden {
    name: &'static str,
    dataset: Dataset,
    quantity: &'static str,
    colors: (&'static str, f64, f64),
    view: View,
}

const PIXELS: [u32; 2] = [96, 72];

fn all() -> Vec<Golden> {
    let recipe = Recipe::default();
    let whole = good(View::fit(recipe.domain, PIXELS));
    let tip = kinked().points[2];
    let random = Recipe::random(2);
    let mut holes = recipe.dataset();
    holes.domain.holes = vec![
        Hole::Circle { center: vec2(0.5, 0.45), radius: 0.125 },
        Hole::Polygon { points: [[0.9, 0.0], [1.2, -0.1], [1.1, 0.1]].map(Vec2::from).to_vec() },
    ];
    let golden =
        |name, dataset, quantity, colors, view| Golden { name, dataset, quantity, colors, view };
    vec![
        golden("stress", recipe.dataset(), "von-mises", ("viridis", 0.0, 5.0), whole),
        golden("holes", holes, "uy", ("coolwarm", -1.6, 1.6), whole),
        golden(
            "tip",
            recipe.dataset(),
            "von-mises",
            ("magma", 0.0, 6e4),
            good(View::new(tip, 1e-9, PIXELS)),
        ),
        golden(
            "overlap",
            random.dataset(),
            "overlap",
            ("turbo", 0.0, 9.0),
            good(View::fit(random.domain, PIXELS)),
        ),
    ]
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.png"))
}

fn picture<T: Sample>(golden: &Golden, raster: &Raster<T>) -> Image {
    let (map, min, max) = golden.colors;
    let mut style = good(Style::named(map));
    (style.range, style.undefined) = (Range::Fixed(min, max), [255; 4]);
    good(Picture::bare(raster, &golden.view, &style)).image
}

/// The picture in the repository, made anew if that is asked for.
fn kept(golden: &Golden, image: &Image) -> Image {
    let path = path(golden.name);
    if std::env::var_os("PPUM_GOLDEN").is_some() {
        good(std::fs::write(&path, good(png::encode(image, &[]))));
    }
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    decode(&bytes)
}

fn decode(bytes: &[u8]) -> Image {
    let mut decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(::png::Transformations::ALPHA);
    let mut reader = good(decoder.read_info());
    let size = [reader.info().width, reader.info().height];
    let mut rgba = vec![0; size.iter().product::<u32>() as usize * 4];
    good(reader.next_frame(&mut rgba));
    Image { size, rgba }
}

/// Checks a picture against the one that is kept.
fn same(what: &str, kept: &Image, found: &Image) {
    assert_eq!(kept.size, found.size, "{what}");
    let pixels = kept.rgba.chunks(4).zip(found.rgba.chunks(4));
    let off = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
    let far = pixels.map(off).filter(|off| *off > Some(STEPS)).count();
    let share = far as f64 / f64::from(kept.size[0] * kept.size[1]);
    println!("{what}: {far} pixels off");
    assert!(share <= EXCEPTIONS, "{what}: {far} pixels are off");
}

#[test]
fn golden_pictures_are_drawn_by_all() {
    let mut renderer = renderer_or_skip();
    for golden in all() {
        let field = good(Field::new(&golden.dataset, 0));
        let quantity = quantity(golden.quantity, &field);
        let (view, name) = (&golden.view, golden.name);
        let double = picture(&golden, &good(render::<f64>(&field, view, &quantity)));
        let kept = kept(&golden, &double);
        same(&format!("{name} in double precision"), &kept, &double);
        let single = picture(&golden, &good(render::<f32>(&field, view, &quantity)));
        same(&format!("{name} in single precision"), &kept, &single);
        for method in METHODS {
            let Some(renderer) = &mut renderer else { continue };
            let drawn = picture(&golden, &good(renderer.render(&field, view, &quantity, method)));
            same(&format!("{name} by {method:?}"), &kept, &drawn);
        }
    }
}
