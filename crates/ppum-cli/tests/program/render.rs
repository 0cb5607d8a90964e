use ppum_render::colormap::Colormap;

use crate::{CRACKED, LINEAR, Lab, Png, sound, with_formulas};

/// Every pixel of u = x + 2y has the colour of its centre's value, the upper row being the
/// upper one.
#[test]
fn pixels_are_values_at_their_centres() {
    let lab = Lab::solved(LINEAR);
    for options in ["", "--precision f32", "--threads 1", "--backend cpu"] {
        lab.run(&format!("render plate.h5 -o a.png -q u --size 64x32 --range 0,4 {options}"));
        let png = Png::read(&lab.path("a.png"));
        assert_eq!(png.size, [64, 32]);
        let map = Colormap::named("viridis").unwrap();
        for (column, row) in [(0, 0), (63, 0), (0, 31), (63, 31), (20, 7)] {
            let (x, y) = (f64::from(column) + 0.5, 31.5 - f64::from(row));
            let exact = map.color((x / 32.0 + 2.0 * y / 32.0) / 4.0);
            let found = png.pixel(column, row);
            let near = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
            assert!(near, "{options} {column} {row}: {found:?} {exact:?}");
        }
    }
}

#[test]
fn texts_tell_what_is_seen() {
    let lab = Lab::solved(CRACKED);
    lab.run("render plate.h5 -o a.png --size 40x30 --center 0.5,-0.25 --width 1e-9 --scale log");
    let png = Png::read(&lab.path("a.png"));
    assert_eq!(png.text("Title"), "Small plate");
    assert_eq!(png.text("ppum:quantity"), "von-mises");
    assert_eq!(png.text("ppum:dataset"), "plate.h5");
    assert_eq!(png.text("ppum:view"), "center 0.5,-0.25 width 1e-9 pixels 40x30");
    assert_eq!(png.text("ppum:scale"), "log");
    assert_eq!(png.text("ppum:colormap"), "viridis");
}

/// A formula of a quantity draws what the quantity draws, and the picture tells the formula.
#[test]
fn formulas_are_drawn() {
    let lab = Lab::solved(&with_formulas());
    let draw = |quantity: &str| {
        let arguments = "render plate.h5 -o a.png --size 60x60 --range=0,4";
        let told = lab.run_with(arguments, &["-q", quantity]);
        (Png::read(&lab.path("a.png")), told)
    };
    let (magnitude, _) = draw("magnitude");
    assert!(magnitude.texts.iter().all(|(key, _)| key != "ppum:formula"));
    lab.write("slip.txt", "# of both faces\nlet a = ux^2;\nsqrt(a + uy^2)\n");
    for (quantity, line) in [
        ("sqrt(ux^2+uy^2)", "sqrt(ux^2+uy^2)"),
        ("@slip.txt", "let a = ux^2; sqrt(a + uy^2)"),
        ("hypot(ux, uy)", "hypot(ux, uy)"),
    ] {
        let (picture, told) = draw(quantity);
        let near = |(a, b): (&u8, &u8)| a.abs_diff(*b) <= 1;
        assert!(picture.rgba.iter().zip(&magnitude.rgba).all(near), "{quantity}");
        assert_eq!(picture.text("ppum:quantity"), line);
        assert_eq!(picture.text("ppum:formula"), line);
        assert!(picture.text("Description").starts_with(line) && told.contains(line), "{told}");
    }
    let (stretch, _) = draw("stretch");
    assert_eq!(stretch.text("ppum:quantity"), "stretch");
    assert_eq!(stretch.text("ppum:formula"), "hypot(ux, uy)*2");
    let long = format!("{}ux", "ux + ".repeat(200));
    lab.run_with("render plate.h5 -o a.png --figure --size 400x300", &["-q", &long]);
    assert_eq!(Png::read(&lab.path("a.png")).text("ppum:formula"), long);
}

#[test]
fn sizes_of_bare_pictures_and_figures() {
    let lab = Lab::solved(CRACKED);
    for (options, size) in [
        ("", [768, 768]),
        ("--size 300x200", [300, 200]),
        ("--tip 0", [1024, 768]),
        ("--figure", [1024, 768]),
        ("--figure --size 500x600", [500, 600]),
    ] {
        lab.run(&format!("render plate.h5 -o a.png -q uy {options}"));
        assert_eq!(Png::read(&lab.path("a.png")).size, size, "{options}");
    }
}

#[test]
fn outside_the_domain_pictures_are_transparent() {
    let lab = Lab::solved(&sound());
    lab.run("render plate.h5 -o a.png --size 60x20 --range 0,2");
    let png = Png::read(&lab.path("a.png"));
    assert_eq!([png.pixel(5, 10)[3], png.pixel(30, 10)[3], png.pixel(55, 10)[3]], [0, 255, 0]);
    // σ is constant: one colour
    assert_eq!(png.pixel(22, 1), png.pixel(38, 18));
    assert_ne!(png.pixel(22, 1)[..3], [0, 0, 0]);
}

#[test]
fn ways_to_choose_the_window() {
    let lab = Lab::solved(CRACKED);
    let view = |options: &str| {
        lab.run(&format!("render plate.h5 -o a.png -q ux --size 20x10 {options}"));
        Png::read(&lab.path("a.png")).text("ppum:view").to_owned()
    };
    assert_eq!(view(""), "center 0.0,0.0 width 4.0 pixels 20x10");
    assert_eq!(view("--view 1,0.5,-1,-0.5"), "center 0.0,0.0 width 2.0 pixels 20x10");
    assert_eq!(view("--view -0.2,-0.2,0,0"), "center -0.1,-0.1 width 0.4 pixels 20x10");
    assert_eq!(view("--center -0.5,0 --width 2"), "center -0.5,0.0 width 2.0 pixels 20x10");
    assert_eq!(view("--tip 0 --zoom 4"), "center -0.5,0.0 width 1.0 pixels 20x10");
    assert_eq!(view("--tip 1 --zoom 4e11"), "center 0.5,0.0 width 1e-11 pixels 20x10");
}

#[test]
fn overlays_are_drawn() {
    let lab = Lab::solved(CRACKED);
    let draw = |options: &str| {
        lab.run(&format!("render plate.h5 -o a.png -q uy --size 90x90 {options}"));
        Png::read(&lab.path("a.png")).rgba
    };
    let pictures =
        ["", "--overlay cracks", "--overlay patches", "--overlay cracks,patches"].map(draw);
    for (k, a) in pictures.iter().enumerate() {
        assert!(pictures[..k].iter().all(|b| a != b), "{k}");
    }
    let changed = |a: &[u8], b: &[u8]| a.chunks(4).zip(b.chunks(4)).filter(|(a, b)| a != b).count();
    assert!((90..900).contains(&changed(&pictures[0], &pictures[1])), "half a row of crack");
}

#[test]
fn colours_from_a_file() {
    let lab = Lab::solved(LINEAR);
    lab.write("grey.txt", "0 0 0\n255 255 255\n");
    lab.run("render plate.h5 -o a.png -q u --size 16x8 --range=-4,4 --colormap grey.txt");
    let [r, g, b, a] = Png::read(&lab.path("a.png")).pixel(8, 4);
    // u at (1.0625, 0.4375)
    assert_eq!((r, g, b, a), (g, g, g, 255));
    assert!(r.abs_diff((255.0f64 * (4.0 + 1.9375) / 8.0).round() as u8) <= 1, "{r}");
}

/// The form is found by the content, whatever the file is called; mistakes have a place.
#[test]
fn colours_from_json() {
    let lab = Lab::solved(LINEAR);
    let preset = r#"[{"ColorSpace": "RGB", "RGBPoints": [0, 0, 0, 0, 3, 0, 0, 0, 4, 1, 1, 1],
        "UseAboveRangeColor": 1, "AboveRangeColor": [1, 0, 0]}]"#;
    lab.write("grey.txt", preset);
    lab.run("render plate.h5 -o a.png -q u --size 16x8 --range=0,2 --colormap grey.txt");
    let png = Png::read(&lab.path("a.png"));
    // u = 1.9375 lies at 0.96875 of the range, 0.875 of the way from the second colour to the third
    let [r, g, b, _] = png.pixel(8, 4);
    assert!(r == g && g == b && r.abs_diff((255.0f64 * 0.875).round() as u8) <= 1, "{r}");
    assert_eq!(png.pixel(1, 6)[0], 0, "lower left, u = 0.5625");
    assert_eq!(png.pixel(15, 0), [255, 0, 0, 255]);
    assert_eq!(png.text("ppum:colormap"), "grey.txt");
    lab.write("grey.csv", "[[0, 0, 0], [1, 1");
    let complaint = lab.fail("render plate.h5 -o b.png -q u --colormap grey.csv");
    assert!(complaint.contains("`grey.csv`, line 1, column 17: this is not JSON"), "{complaint}");
}

#[test]
fn partition_quantities() {
    let lab = Lab::solved(CRACKED);
    for quantity in ["overlap", "weight-sum", "phi:3", "direction"] {
        lab.run(&format!("render plate.h5 -o a.png -q {quantity} --size 30x30"));
    }
}

/// f64 and f32 are computed apart, and look the same; threads change no bit of a picture.
#[test]
fn precision_and_threads() {
    let lab = Lab::solved(CRACKED);
    let draw = |options: &str| {
        lab.run(&format!("render plate.h5 -o a.png --size 200x150 --range 0,3 {options}"));
        Png::read(&lab.path("a.png")).rgba
    };
    let double = draw("--backend cpu --threads 1");
    assert_eq!(double, draw("--backend cpu --threads 2"));
    let single = draw("--backend cpu --precision f32");
    // pixels at the edge of the colour "above" may fall on its other side
    let far = double.iter().zip(&single).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert!(far <= 12, "{far}");
}

/// A pixel and `probe` show the same value: the colours of a narrow range around it tell.
#[test]
fn a_pixel_is_what_probe_prints() {
    let lab = Lab::solved(CRACKED);
    let report = lab.json("probe plate.h5 --at 0.5,0.03125 -q syy");
    let syy = report["points"][0]["values"]["syy"].as_f64().unwrap();
    for (range, expected) in [
        (format!("{:?},{:?}", syy - 1e-9, syy + 3e-9), 0.25),
        (format!("{:?},{:?}", syy - 3e-9, syy + 1e-9), 0.75),
    ] {
        // the pixel (1, 1) of three by three has its centre at the view's
        let window = "--center 0.5,0.03125 --width 0.3 --size 3x3";
        lab.run(&format!(
            "render plate.h5 -o a.png -q syy {window} --range {range} --precision f64"
        ));
        let found = Png::read(&lab.path("a.png")).pixel(1, 1);
        let exact = Colormap::named("viridis").unwrap().color(expected);
        let near = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
        assert!(near, "{found:?} {exact:?}");
    }
}

/// σ_yy = 1: the plate grows in y by (1 − ν²) σ/E and shrinks in x by ν(1 + ν) σ/E, times
/// the factor.
#[test]
fn the_deformed_plate_has_its_size() {
    let lab = Lab::solved(&sound());
    let told = lab.run(
        "render plate.h5 -o a.png -q syy --deformed 0.5 --size 100x100 --view=-2,-2,2,2 --range 0,2",
    );
    assert!(told.contains("deformed ×0.5, 100x100 pixels"), "{told}");
    let png = Png::read(&lab.path("a.png"));
    assert_eq!(png.text("ppum:deformed"), "0.5");
    let solid = |column, row| png.pixel(column, row)[3] == 255;
    let width = (0..100).filter(|&i| solid(i, 50)).count() as f64 / 25.0;
    let height = (0..100).filter(|&j| solid(50, j)).count() as f64 / 25.0;
    // to the two pixels at the ends
    assert!((width - 2.0 * (1.0 - 0.5 * 0.39)).abs() < 0.081, "{width}");
    assert!((height - 2.0 * (1.0 + 0.5 * 0.91)).abs() < 0.081, "{height}");
}

#[test]
fn deformed_cracks_open_and_close() {
    let lab = Lab::solved(CRACKED);
    let draw = |options: &str| {
        let told = lab.run(&format!("render plate.h5 -o a.png -q uy {options}"));
        (Png::read(&lab.path("a.png")), told)
    };
    let (open, told) = draw("--size 120x120 --deformed auto --tip 1 --zoom 40");
    assert!(told.contains("deformed ×0.0") && !told.contains("over itself"), "{told}");
    let empty = open.rgba.chunks(4).filter(|p| p[3] == 0).count();
    // behind the tip, which is in the middle, the crack is open
    assert!((3000..9000).contains(&empty), "{empty}");
    let (_, told) = draw("--size 120x120 --deformed=-0.02 --view=-0.5,-0.5,0.5,0.5");
    assert!(told.contains("over itself at") && told.contains("(hatched)"), "{told}");
    let (plain, _) = draw("--size 120x120 --deformed 0.02 --view=-1.2,-1.2,1.2,1.2");
    for more in ["--outline", "--overlay cells", "--overlay cracks"] {
        let (other, _) =
            draw(&format!("--size 120x120 --deformed 0.02 --view=-1.2,-1.2,1.2,1.2 {more}"));
        assert_ne!(plain.rgba, other.rgba, "{more}");
    }
    // a picture with room for a legend
    let (plain, _) = draw("--size 400x400 --deformed 0.02 --view=-1.2,-1.2,1.2,1.2");
    for more in ["--isolines 5", "--arrows", "--crosses=40"] {
        let (other, _) =
            draw(&format!("--size 400x400 --deformed 0.02 --view=-1.2,-1.2,1.2,1.2 {more}"));
        let changed = plain.rgba.chunks(4).zip(other.rgba.chunks(4)).filter(|(a, b)| a != b);
        assert!((1_000..80_000).contains(&changed.count()), "{more}");
    }
    let (figure, _) = draw("--deformed auto --outline --figure --size 400x400");
    assert_eq!(figure.size, [400, 400]);
    let told =
        lab.run("render plate.h5 -o a.png -q ux,uy --deformed 0.02 --layout 2x1 --size 600x300");
    let panels = Png::read(&lab.path("a.png"));
    assert_eq!((panels.size, panels.text("ppum:deformed")), ([600, 300], "0.02"));
    assert!(told.contains("ux, uy, deformed ×0.02"), "{told}");
    // without displacement the plate is the plate
    let (still, _) = draw("--size 120x120 --deformed 0 --view=-1.2,-1.2,1.2,1.2");
    let (plate, _) = draw("--size 120x120 --view=-1.2,-1.2,1.2,1.2 --backend cpu");
    assert_eq!(still.rgba, plate.rgba);
}

#[test]
fn what_cannot_be_deformed_is_told() {
    let lab = Lab::solved(CRACKED);
    for (options, part) in [
        ("--deformed x", "a finite number, or auto"),
        ("--deformed inf", "a finite number, or auto"),
        ("--deformed 1e101", "at most 1e100"),
        ("--outline", "--deformed"),
        ("--deformed 1 --backend gpu", "by the processor"),
        ("--deformed 1 --precision f32", "by the processor"),
        ("--deformed 1 --overlay rings", "rings: of these overlays"),
        ("--deformed 0.01 --center 0.3,0.3 --width 1e-15", "finer than double precision"),
        ("--deformed 0.01 --view 50,50,51,51", "nothing of the deformed plate"),
    ] {
        let complaint = lab.fail(&format!("render plate.h5 -o a.png {options}"));
        assert!(complaint.contains(part), "{options}: {complaint}");
    }
    let potential = Lab::solved(LINEAR);
    let complaint = potential.fail("render plate.h5 -o a.png --deformed auto");
    assert!(complaint.contains("no displacement"), "{complaint}");
}

/// What is wrong with a negative number its option says; a picture without the plate is told.
#[test]
fn numbers_out_of_place_are_told() {
    let lab = Lab::solved(LINEAR);
    for (options, part) in [
        ("--width -1 --center 0,0", "a finite number above zero"),
        ("--tip -1", "invalid digit"),
        ("--step -1", "invalid digit"),
        ("--layout 2 -q u,u", "CxR"),
        ("--isolines 0.5", "with commas"),
        ("--crosses", "principal stresses"),
        ("--range 0,1e400", "two finite numbers"),
    ] {
        let complaint = lab.fail(&format!("render plate.h5 -o a.png {options}"));
        assert!(complaint.contains(part), "{options}: {complaint}");
    }
    for (options, part) in [
        ("--view=-1e9,-1e9,1e9,1e9", "no pixel has its centre on the plate"),
        ("--isolines 77,", "no isoline"),
        ("--arrows=1e6 --view 0.2,0.2,0.4,0.4", "no arrow"),
    ] {
        let (_, remark) = lab.warned(&format!("render plate.h5 -o a.png {options}"));
        assert!(remark.contains(part), "{options}: {remark}");
    }
}
