//! The method in pictures: values of cells, parts of the field.

use ppum::dataset::{Attribute, Dataset};
use ppum::vec2::{Vec2, vec2};
use ppum_render::colormap::Colormap;
use ppum_testkit::random::Random;

use crate::figures::read;
use crate::{CRACKED, LINEAR, Lab, Png};

/// A solved plate with attributes at random: few whole numbers, and one whose name a quantity has.
fn with_attributes(lab: &Lab) -> Dataset {
    let mut data = ppum_format::read(&lab.path("plate.h5")).unwrap();
    let (step, mut random) = (&mut data.steps[0], Random(7));
    let count = step.partition.len();
    let few = (0..count).map(|_| random.pick(&[-2.0, 5.0, 11.0])).collect();
    let many = (0..count).map(|k| if k == 9 { f64::NAN } else { random.between(0.0, 8.0) });
    let many = many.collect();
    step.attributes.push(Attribute { name: "few".into(), values: few });
    step.attributes.push(Attribute { name: "uy".into(), values: many });
    ppum_format::write(&data, &lab.path("plate.h5")).unwrap();
    data
}

/// The value of the cell that holds a point.
fn value(data: &Dataset, attribute: &str, point: Vec2) -> f64 {
    let step = &data.steps[0];
    let cell = step.partition.boxes().cell.iter().position(|cell| cell.contains(point)).unwrap();
    let found = step.attributes.iter().find(|found| found.name == attribute);
    found.unwrap().values[cell]
}

/// Every pixel has the colour of its cell's value: one each for whole numbers, else that of
/// the range.
#[test]
fn pixels_have_the_colours_of_their_cells() {
    let lab = Lab::solved(CRACKED);
    let data = with_attributes(&lab);
    let draw = |options: &str| {
        lab.run(&format!("render plate.h5 -o a.png --size 64x64 {options}"));
        Png::read(&lab.path("a.png"))
    };
    let [few, same] = ["-q few", "-q patch:few"].map(draw);
    assert_eq!(few.rgba, same.rgba);
    assert_eq!(same.text("ppum:quantity"), "patch:few");
    let draw = |options: &str| {
        lab.warned(&format!("render plate.h5 -o a.png --size 64x64 {options}"));
        Png::read(&lab.path("a.png"))
    };
    let many = draw("-q patch:uy --range 0,8");
    let map = Colormap::named("viridis").unwrap();
    let mut seen = [0; 3];
    for (i, j) in (0..64).flat_map(|i| (0..64).map(move |j| (i, j))) {
        let place = vec2((f64::from(i) - 31.5) / 32.0, (31.5 - f64::from(j)) / 32.0);
        let class = [-2.0, 5.0, 11.0].iter().position(|v| *v == value(&data, "few", place));
        seen[class.unwrap()] += 1;
        assert_eq!(few.pixel(i, j), map.color(0.5 * class.unwrap() as f64), "{i} {j}");
        let value = value(&data, "uy", place);
        let (found, expected) = (many.pixel(i, j), map.color(value / 8.0));
        let near = (0..3).all(|k| found[k].abs_diff(expected[k]) <= 1);
        assert!(near || value.is_nan() && found[0] == found[1], "{i} {j}: {found:?} {expected:?}");
    }
    assert!(seen.iter().all(|count| *count > 100), "{seen:?}");
    let (_, warning) = lab.warned("render plate.h5 -o a.png -q patch:uy");
    assert!(warning.contains("`patch:uy` has no value at"), "{warning}");
    assert!(warning.contains("the dataset has none for their cells"), "{warning}");
}

/// The bar has a label for each value there is, and for no other.
#[test]
fn legends_have_the_values_there_are() {
    let lab = Lab::solved(CRACKED);
    with_attributes(&lab);
    let told = lab.run("render plate.h5 -o a.svg -q few --figure --ticks x=0, --ticks y=0,");
    assert!(told.contains("a colour each for -2, 5, 11"), "{told}");
    let svg = read(&lab, "a.svg");
    for (label, is_there) in
        [("−2", true), ("5", true), ("11", true), ("−1", false), ("4", false), ("10", false)]
    {
        assert_eq!(svg.contains(&format!(">{label}</text>")), is_there, "{label}");
    }
    // quantities and values of cells stand side by side
    let told =
        lab.run("render plate.h5 -o b.svg -q von-mises,level,order,overlap,blocks,functions");
    assert!(told.contains("von-mises, level, order, overlap, blocks, functions"), "{told}");
    let svg = read(&lab, "b.svg");
    for caption in ["(a) von Mises stress", "(b) level", "(c) order p", "(f) functions"] {
        assert!(svg.contains(&format!(">{caption}</text>")), "{caption}");
    }
    // an explicit range is a range
    let told = lab.run("render plate.h5 -o c.svg -q few --range -5,15");
    assert!(told.contains("colours from -5 to 15"), "{told}");
    // on the deformed plate too
    lab.run("render plate.h5 -o d.png -q level,few --deformed auto --shared-range --size 600x300");
}

#[test]
fn parts_stand_in_panels() {
    let lab = Lab::solved(CRACKED);
    let draw = |options: &str| {
        lab.run(&format!("render plate.h5 -o a.png --size 600x520 -q uy {options}"));
        Png::read(&lab.path("a.png"))
    };
    let all = draw("--part all,smooth,jump,tip");
    assert_eq!(all.text("ppum:part"), "all, smooth, jump, tip");
    assert_eq!(all.rgba, draw("--part all,smooth,jump,tip --layout 2x2").rgba);
    assert_eq!(draw("--part all").rgba, draw("").rgba);
    let shared = draw("--part all,smooth,jump,tip --shared-range");
    let ends = |png: &Png| -> Vec<f64> {
        png.text("ppum:range").split(',').map(|n| n.parse().unwrap()).collect()
    };
    for part in ["all", "smooth", "jump", "tip"] {
        let (all, own) = (ends(&shared), ends(&draw(&format!("--part {part} --figure"))));
        let reach = 0.1 * (all[1] - all[0]);
        assert!(all[0] <= own[0] + reach && own[1] <= all[1] + reach, "{part}: {own:?} {all:?}");
    }
    let told = lab.run(
        "render plate.h5 -o a.svg --size 1800x900 -q von-mises,tresca --part smooth,jump,patch:3",
    );
    assert!(told.contains("smooth part, jump part, part of patch 3"), "{told}");
    let svg = read(&lab, "a.svg");
    let captions = ["(a) von Mises stress, smooth part", "(f) Tresca stress, part of patch 3"];
    assert!(captions.iter().all(|caption| svg.contains(caption)), "{svg}");
}

#[test]
fn mistakes_are_told() {
    let lab = Lab::solved(CRACKED);
    for (arguments, part) in [
        ("probe plate.h5 --at 0,0 -q level", "`ppum render -q level` draws it"),
        ("probe plate.h5 --at 0,0 -q patch:order", "belongs to the cells"),
        ("sample plate.h5 --crack 0 -q cut-off", "belongs to the cells"),
        ("compare plate.h5 -q level", "belongs to the cells"),
        ("info plate.h5 --extrema level", "belongs to the cells"),
        ("render plate.h5 -o a.png -q levle", "did you mean `level`"),
        ("render plate.h5 -o a.png -q strss", "of cells level, order, blocks, functions"),
        ("render plate.h5 -o a.png -q patch:foo", "cells have no value `foo`; there are level"),
        ("render plate.h5 -o a.png --shared-range", "give several quantities or parts"),
        ("render plate.h5 -o a.png --part smooth,tip --deformed auto", "one by one"),
        ("render plate.h5 -o a.png --part smooth,tp", "did you mean `tip`"),
        ("render plate.h5 -o a.png --part smooth,tip --layout 1x1", "fewer panels"),
        ("render plate.h5 -o a.png -q ux,uy --layout 0x1", "give at least"),
        ("render plate.h5 -o a.png -q ux,uy,syy --size 300x200", "no room"),
        ("probe plate.h5 --at 0,0 --part smooth,tip", "panels of `ppum render`"),
        ("compare plate.h5 --part smooth,tip", "panels of `ppum render`"),
    ] {
        let complaint = lab.fail(arguments);
        assert!(complaint.contains(part), "{arguments}: {complaint}");
        assert_eq!(lab.files(), ["plate.h5", "plate.toml"]);
    }
    let lab = Lab::solved(LINEAR);
    let complaint = lab.fail("render plate.h5 -o a.png --part all,jump");
    assert!(complaint.contains("has no block of the part `jump`"), "{complaint}");
    let (_, remark) = lab.warned("render plate.h5 -o a.png -q level,u --isolines 3");
    assert!(remark.contains("constant in each cell"), "{remark}");
}
