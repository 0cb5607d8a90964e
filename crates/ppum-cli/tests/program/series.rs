//! Pictures of several steps, and means over pixels.

use ppum::crack::{CrackEnd, Side};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use ppum_render::colormap::Colormap;
use ppum_testkit::synthetic::{Coefficients, Recipe, growing, series};

use crate::{LINEAR, Lab, Png};

const LOADS: [f64; 3] = [0.0, 1.0, 4.0];

impl Lab {
    /// A folder with a dataset `plate.h5`.
    fn holding(dataset: &Dataset) -> Self {
        let lab = Self::new();
        ppum_format::write(dataset, &lab.path("plate.h5")).unwrap();
        lab
    }
}

/// u = load · (x − x_0), x_0 in the plate's middle, on covers that differ.
fn slopes() -> Dataset {
    let coefficients = Coefficients::Polynomial(vec![vec![0.0, 1.0, 0.0]]);
    let recipe = |k: usize| Recipe {
        cracks: Vec::new(),
        components: 1,
        level: 1 + k as u8 % 2,
        coefficients: coefficients.clone(),
        ..Recipe::default()
    };
    series(&LOADS, recipe)
}

/// Cells of one value have one colour in all steps, whatever values a step has.
#[test]
fn cells_of_all_steps_have_one_legend() {
    let lab = Lab::holding(&slopes());
    lab.run("render plate.h5 -o l.png -q level --steps all --size 20x20");
    let map = Colormap::named("viridis").unwrap();
    for (step, color) in [(0, map.color(0.0)), (1, map.color(1.0)), (2, map.color(0.0))] {
        let png = Png::read(&lab.path(&format!("l-00{step}.png")));
        assert_eq!(png.pixel(10, 10), color, "{step}");
    }
    let complaint = lab.fail("render plate.h5 -o m.png -q level --samples 2");
    assert!(complaint.contains("leave samples out"), "{complaint}");
}

/// The images of an APNG as they are shown.
fn shown(path: &std::path::Path) -> Vec<Vec<u8>> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let columns = reader.info().width as usize;
    let count = reader.info().animation_control().unwrap().num_frames;
    let mut canvas = vec![0; reader.output_buffer_size().unwrap()];
    let frame = |_| {
        let mut data = vec![0; canvas.len()];
        let size = reader.next_frame(&mut data).unwrap().buffer_size();
        let frame = reader.info().frame_control().unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (100, 1000));
        let [left, top, width] =
            [frame.x_offset, frame.y_offset, frame.width].map(|n| 4 * n as usize);
        for (row, line) in data[..size].chunks(width).enumerate() {
            let at = (top / 4 + row) * 4 * columns + left;
            canvas[at..at + width].copy_from_slice(line);
        }
        canvas.clone()
    };
    (0..count).map(frame).collect()
}

/// Delays of the images of a GIF, hundredths of a second; it must go on for ever.
fn delays(bytes: &[u8]) -> Vec<u16> {
    assert_eq!(&bytes[..6], b"GIF89a");
    assert!(bytes.windows(11).any(|part| part == b"NETSCAPE2.0"));
    // past the palette of 256 colours, block by block
    let (mut at, mut found) = (13 + 768, Vec::new());
    loop {
        let is_image = match bytes[at] {
            0x21 if bytes[at + 1] == 0xf9 => {
                found.push(u16::from_le_bytes([bytes[at + 4], bytes[at + 5]]));
                false
            }
            0x21 => false,
            0x2c => true,
            end => {
                assert_eq!((end, at + 1), (0x3b, bytes.len()));
                return found;
            }
        };
        at += if is_image { 11 } else { 2 };
        while bytes[at] > 0 {
            at += 1 + usize::from(bytes[at]);
        }
        at += 1;
    }
}

/// Each picture shows its step in colours that mean the same in all.
#[test]
fn numbered_pictures_have_one_range() {
    let lab = Lab::holding(&slopes());
    let told = lab.run("render plate.h5 -o a.png --steps all --size 64x48");
    assert!(told.starts_with("wrote a-000.png to a-002.png: u, 3 steps, 64x48 pixels"), "{told}");
    assert_eq!(lab.files(), ["a-000.png", "a-001.png", "a-002.png", "plate.h5"]);
    let map = Colormap::named("viridis").unwrap();
    let half = 4.0 * 2.0 / 3.0;
    for (k, load) in LOADS.into_iter().enumerate() {
        let png = Png::read(&lab.path(&format!("a-{k:03}.png")));
        for column in [0, 13, 40, 63] {
            let x = (f64::from(column) - 31.5) / 48.0;
            let exact = map.color((load * x + half) / (2.0 * half));
            let found = png.pixel(column, 20);
            let near = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
            assert!(near, "{k} {column}: {found:?} {exact:?}");
        }
        assert_eq!(png.text("ppum:step"), k.to_string());
        assert_eq!(png.text("ppum:load"), format!("{load:?}"));
        let range = png.text("ppum:range").split_once(',').unwrap();
        let ends = [range.0, range.1].map(|end| end.parse::<f64>().unwrap());
        assert!((ends[0] + half).abs() < 1e-5 && (ends[1] - half).abs() < 1e-5, "{ends:?}");
    }
    // that of one step alone is its own
    lab.run("render plate.h5 -o b.png --steps 1 --size 64x48");
    lab.run("render plate.h5 -o c.png --step 1 --size 64x48");
    let [b, c] = ["b-001.png", "c.png"].map(|name| Png::read(&lab.path(name)));
    assert_eq!((b.rgba, b.texts), (c.rgba, c.texts));
    // of no values at all
    let (_, warning) =
        lab.warned("render plate.h5 -o d.png --steps all -q sqrt(-1-u^2) --size 9x9");
    assert!(warning.contains("at all") && warning.lines().count() == 1, "{warning}");
}

#[test]
fn a_series_begins_with_one_value() {
    let lab = Lab::holding(&growing(4));
    let range = |steps: &str| {
        lab.run(&format!("render plate.h5 -o a.png --steps {steps} -q ux --size 90x70"));
        Png::read(&lab.path("a-002.png")).text("ppum:range").to_owned()
    };
    let [with, without] = ["all", "1.."].map(range);
    let ends = |text: &str| {
        let (min, max) = text.split_once(',').unwrap();
        [min, max].map(|end| end.parse::<f64>().unwrap())
    };
    let ([a, b], [c, d]) = (ends(&with), ends(&without));
    // zero everywhere: no more than zero is added
    assert!(a == c.min(0.0) && b == d, "{with} {without}");
}

#[test]
fn steps_are_chosen() {
    let lab = Lab::holding(&growing(12));
    let drawn = |steps: &str| {
        lab.run(&format!("render plate.h5 -o a.svg --steps {steps} --size 20x15 --range 0,2"));
        let files = lab.files().into_iter().filter_map(|name| {
            let step = name.strip_prefix("a-")?.strip_suffix(".svg")?.to_owned();
            std::fs::remove_file(lab.path(&name)).unwrap();
            Some(step)
        });
        files.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(drawn("2..4"), "002 003 004");
    assert_eq!(drawn("0..11:5"), "000 005 010");
    assert_eq!(drawn("9..,1,1,3"), "001 003 009 010 011");
    assert_eq!(drawn("..1"), "000 001");
    assert_eq!(drawn("all:6"), "000 006");
    for (arguments, part) in [
        ("--steps 12", "there is no step 12; the dataset has 12 steps, numbered from 0"),
        ("--steps 3..12", "there is no step 12"),
        ("--steps 20..", "there is no step 20"),
        ("--steps 5..2", "write 2..5"),
        ("--steps 0..5:0", "the stride is 0"),
        ("--steps some", "write all"),
        ("--steps 1 --step 1", "--step"),
        ("--fps 5", "--steps"),
        ("--steps 1 --fps 51", "up to 50"),
        ("--steps 1 --layout 1x1", "draw the panels of one step"),
        ("--steps 1 -q ux,uy", "several panels and several steps"),
        ("--steps all --tip 1", "1 tip, numbered from 0"),
        ("--steps all -o -", "-o"),
    ] {
        let complaint = lab.fail(&format!("render plate.h5 -o b.png {arguments}"));
        assert!(complaint.contains(part), "{arguments}: {complaint}");
    }
    assert_eq!(lab.files(), ["plate.h5"]);
    let complaint = lab.fail("render plate.h5 -o b.gif");
    assert!(complaint.contains("add --steps all"), "{complaint}");
    let complaint = lab.fail("render plate.h5 -o - --steps all");
    assert!(complaint.contains("go to files"), "{complaint}");
    // nothing is drawn if one of the files could not be written
    std::fs::create_dir(lab.path("c-011.png")).unwrap();
    let complaint = lab.fail("render plate.h5 -o c.png --steps all");
    assert!(complaint.contains("c-011.png: is a folder"), "{complaint}");
    assert_eq!(lab.files(), ["c-011.png", "plate.h5"]);
}

/// Moving pictures show what the numbered ones do.
#[test]
fn moving_pictures() {
    let lab = Lab::holding(&growing(5));
    let draw = |name: &str, more: &str| {
        let steps = if more.contains("--steps") { "" } else { "--steps all" };
        let size = if more.contains("--size") { "" } else { "--size 60x45" };
        lab.run(&format!("render plate.h5 -o {name} -q uy {steps} {size} {more}"))
    };
    draw("a.png", "");
    let told = draw("a.apng", "--fps 10 --threads 1");
    assert!(told.starts_with("wrote a.apng: 10 a second, uy, 5 steps, 60x45 pixels"), "{told}");
    let frames = shown(&lab.path("a.apng"));
    assert_eq!(frames.len(), 5);
    for (k, frame) in frames.iter().enumerate() {
        assert!(Png::read(&lab.path(&format!("a-{k:03}.png"))).rgba == *frame, "{k}");
    }
    assert_eq!(Png::read(&lab.path("a.apng")).text("ppum:step"), "0,1,2,3,4");
    let gif = |more: &str| {
        draw("a.gif", more);
        std::fs::read(lab.path("a.gif")).unwrap()
    };
    let one = gif("--fps 12.5 --figure --size 500x400 --threads 1");
    assert_eq!(delays(&one), [8; 5]);
    assert_eq!(one, gif("--fps 12.5 --figure --size 500x400 --threads 2"));
    assert_eq!(delays(&gif("--steps 3")), [20]);
}

/// Windows follow the tip of each step, and titles tell it.
#[test]
fn steps_have_their_own_tips_and_titles() {
    let dataset = growing(3);
    let lab = Lab::holding(&dataset);
    lab.run("render plate.h5 -o a.png --steps all --tip 0 --zoom 1e6 --size 30x20 -q ux");
    lab.run("render plate.h5 -o a.svg --steps all --size 400x300 --figure --isolines auto -q ux --samples 2");
    for (k, step) in dataset.steps.iter().enumerate() {
        let tip = step.cracks[0].points[2];
        let png = Png::read(&lab.path(&format!("a-{k:03}.png")));
        let view = format!("center {:?},{:?} ", tip.x, tip.y);
        assert!(png.text("ppum:view").starts_with(&view), "{view}");
        assert_eq!(step.cracks[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
        let svg = std::fs::read_to_string(lab.path(&format!("a-{k:03}.svg"))).unwrap();
        let title = format!(">Growing crack, step {k}, load {}<", [0.0, 0.5, 1.0][k]);
        assert!(svg.contains(&title), "{title}");
    }
    lab.run_with(
        "render plate.h5 -o b.svg --step 1 --figure",
        &["--labels", "title=At {load} ({step})"],
    );
    let svg = std::fs::read_to_string(lab.path("b.svg")).unwrap();
    assert!(svg.contains(">At 0.5 (1)<"));
}

#[test]
fn the_deformed_plate_has_one_factor_and_one_window() {
    let lab = Lab::holding(&growing(3));
    let told = lab.run("render plate.h5 -o a.png --steps all --deformed auto --size 50x40");
    let texts = |key: &str| {
        let text = |k| Png::read(&lab.path(&format!("a-00{k}.png"))).text(key).to_owned();
        [0, 1, 2].map(text)
    };
    for key in ["ppum:deformed", "ppum:view", "ppum:range"] {
        let [a, b, c] = texts(key);
        assert!(a == b && b == c, "{key}: {a} {b} {c}");
    }
    let factor = texts("ppum:deformed")[0].parse::<f64>().unwrap();
    assert!(factor > 0.0 && told.contains(", deformed ×"), "{told}");
    lab.run("render plate.h5 -o b.png --step 2 --deformed auto --size 50x40");
    assert_eq!(Png::read(&lab.path("b.png")).text("ppum:deformed"), texts("ppum:deformed")[2]);
}

/// The mean of x² + 2y over the values that a pixel holds, by `probe`'s own evaluation.
#[test]
fn means_over_pixels() {
    let lab = Lab::solved(LINEAR);
    let draw = |options: &str| {
        lab.run_with(
            &format!("render plate.h5 -o a.png --size 4x2 --range 0,6 {options}"),
            &["-q", "u^2"],
        );
        Png::read(&lab.path("a.png"))
    };
    let plain = draw("");
    assert_eq!(plain.text("ppum:pixel"), "value at pixel centre");
    let one = draw("--samples 1");
    assert_eq!((one.rgba, one.texts), (plain.rgba.clone(), plain.texts.clone()));
    let dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    let field = Field::new(&dataset, 0).unwrap();
    let square = Quantity::parse("u^2", &field).unwrap();
    let map = Colormap::named("viridis").unwrap();
    for options in ["--samples 8", "--samples 8 --precision f32", "--samples 8 --threads 1"] {
        let png = draw(options);
        assert_eq!(png.text("ppum:pixel"), "mean of 8x8 values in the pixel");
        for (column, row) in [(0, 0), (3, 1), (2, 0)] {
            let at = |k: u32, n: u32| (f64::from(k) + (f64::from(n) + 0.5) / 8.0) / 2.0;
            let value = |n: u32| {
                let p = Vec2 { x: at(column, n % 8), y: 1.0 - at(row, n / 8) };
                square.at(&mut field.at(p), Vec2::ZERO, Side::Above)
            };
            let mean = (0..64).map(value).sum::<f64>() / 64.0;
            let exact = map.color(mean / 6.0);
            let found = png.pixel(column, row);
            let near = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
            assert!(near, "{options} {column} {row}: {found:?} {exact:?}");
        }
        assert_ne!(png.rgba, plain.rgba);
    }
    // half of the outermost pixels lies outside the plate
    lab.run("render plate.h5 -o b.png -q u --samples 4 --view=-0.25,0,2.25,1 --size 5x2");
    let png = Png::read(&lab.path("b.png"));
    assert_eq!([0, 1, 4].map(|column| png.pixel(column, 0)[3]), [128, 255, 128]);
    let crack = Lab::solved(crate::CRACKED);
    let complaint = crack.fail("render plate.h5 -o a.png --samples 2 --deformed auto");
    assert!(complaint.contains("leave samples out"), "{complaint}");
    for wrong in ["0", "17", "x"] {
        let complaint = lab.fail(&format!("render plate.h5 -o a.png --samples {wrong}"));
        assert!(complaint.contains("from 1 to 16"), "{complaint}");
    }
}
