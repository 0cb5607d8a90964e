//! Figures: their files, sizes, words and panels.

use crate::{CRACKED, LINEAR, Lab, Png};

pub(crate) fn read(lab: &Lab, name: &str) -> String {
    String::from_utf8_lossy(&std::fs::read(lab.path(name)).unwrap()).into_owned()
}

/// The form is that of the name's end; all three tell the same.
#[test]
fn figures_are_vectors_too() {
    let lab = Lab::solved(CRACKED);
    let told = lab.run("render plate.h5 -o a.svg --figure --inches 4x3 --dpi 150 -q syy");
    assert!(told.starts_with("wrote ") && told.contains("a.svg: syy, 600x450 pixels"), "{told}");
    let svg = read(&lab, "a.svg");
    assert!(svg.contains("width=\"4in\" height=\"3in\" viewBox=\"0 0 600 450\""));
    for part in ["<title>Small plate</title>", "key=\"ppum:range\"", ">yy</tspan>", "@font-face"] {
        assert!(svg.contains(part), "{part}");
    }
    lab.run("render plate.h5 -o a.PDF --figure --inches 4x3 --dpi 150 -q syy");
    let pdf = read(&lab, "a.PDF");
    assert!(pdf.starts_with("%PDF-") && pdf.contains("/MediaBox [0 0 288 216]"));
    assert!(pdf.contains("/Title (Small plate)"));
    lab.run("render plate.h5 -o bare.svg --size 40x30 -q syy");
    let bare = read(&lab, "bare.svg");
    assert!(bare.contains("viewBox=\"0 0 40 30\"") && !bare.contains("@font-face"));
    let complaint = lab.fail("render plate.h5 -o a.jpg");
    assert!(complaint.contains("PNG, SVG or PDF") && complaint.contains(".pdf"), "{complaint}");
}

#[test]
fn figures_are_drawn_as_asked() {
    let lab = Lab::solved(CRACKED);
    let look = "--theme dark --bar bottom --ticks x=2 --ticks 1,2 --font-size 11 --extremes contrast --bands 4";
    lab.run(&format!("render plate.h5 -o a.png --figure --range 0,3 {look}"));
    let dark = Png::read(&lab.path("a.png"));
    assert!(dark.size == [1024, 768] && dark.pixel(1, 1)[..3].iter().all(|c| *c < 60));
    lab.run("render plate.h5 -o b.png --figure --transparent --range 0,3");
    assert_eq!(Png::read(&lab.path("b.png")).pixel(1, 1), [0; 4]);
    lab.run("render plate.h5 -o c.svg --figure --labels title=A,B,bar=Spannung,x= --ticks 0.5,");
    let svg = read(&lab, "c.svg");
    for part in [">A,B</text>", ">Spannung</text>", ">y</text>", ">0.5</text>"] {
        assert!(svg.contains(part), "{part}");
    }
    assert!(!svg.contains(">x</text>"));
    for option in [
        "--theme dark",
        "--bar none",
        "--ticks 3",
        "--labels x=a",
        "--font-size 9",
        "--transparent",
    ] {
        let complaint = lab.fail(&format!("render plate.h5 -o d.png {option}"));
        assert!(complaint.contains("add --figure"), "{complaint}");
    }
    for (option, reason) in [("--dpi 1e9", "from 1 to 100000"), ("--inches 1e9", "up to 1000")] {
        let complaint = lab.fail(&format!("render plate.h5 -o d.png --figure {option}"));
        assert!(complaint.contains(reason), "{complaint}");
    }
}

/// The end of a title says which step it is.
#[test]
fn long_titles_keep_their_ends() {
    let lab = Lab::solved(CRACKED);
    let title = "title=Some words about a plate that take many more lines than four of this page has, step 7";
    lab.run_with("render plate.h5 -o a.svg --figure --inches 2 --labels", &[title]);
    let svg = read(&lab, "a.svg");
    assert!(svg.contains(">Some") && svg.contains("step 7</text>"), "{svg}");
}

#[test]
fn panels_are_drawn() {
    let lab = Lab::solved(CRACKED);
    let told = lab
        .run_with("render plate.h5 -o a.svg --layout 2x2 -q", &["von-mises,ux,hypot(ux, uy),syy"]);
    assert!(told.contains("von-mises, ux, hypot(ux, uy), syy, 1320x1200 pixels"), "{told}");
    let svg = read(&lab, "a.svg");
    let captions =
        ["(a) ", "(b) ", "(c) ", "(d) "].map(|caption| svg.matches(&format!(">{caption}")).count());
    assert_eq!(captions, [1; 4]);
    // four plots on their grounds, four bars
    assert_eq!(svg.matches("<image ").count(), 12);
    lab.run("render plate.h5 -o b.svg --layout 2x1 -q ux,uy --shared-range");
    let svg = read(&lab, "b.svg");
    assert_eq!(svg.matches("<image ").count(), 5);
    assert!(svg.contains("key=\"ppum:range\""));
    // rows and columns that nothing is in are left out
    let page = |layout: &str| {
        let (_, warning) = lab.warned(&format!("render plate.h5 -o d.png -q ux {layout}"));
        assert!(warning.contains("they are left out"), "{warning}");
        Png::read(&lab.path("d.png")).size
    };
    lab.run("render plate.h5 -o d.png -q ux --layout 1x1");
    let one = Png::read(&lab.path("d.png")).size;
    assert_eq!([page("--layout 2x2"), page("--layout 1000000000x1")], [one; 2]);
    let complaint = lab.fail("render plate.h5 -o c.svg --layout 2x1 -q ux,uy,syy");
    assert!(complaint.contains("fewer panels than there are pictures, 3"), "{complaint}");
}

/// Panels with one range show the colours of one picture with that range.
#[test]
fn a_shared_range_spans_all() {
    let lab = Lab::solved(LINEAR);
    let range = |name: &str, options: &str| {
        lab.run_with(&format!("render plate.h5 -o {name}.png --size 900x500 {options}"), &[]);
        Png::read(&lab.path(&format!("{name}.png"))).text("ppum:range").to_owned()
    };
    let numbers =
        |text: String| -> Vec<f64> { text.split(',').map(|n| n.parse().unwrap()).collect() };
    let all = numbers(range("a", "--layout 2x1 -q u,u+7 --shared-range"));
    let [one, other] = ["-q u", "-q u+7"].map(|q| numbers(range("b", &format!("{q} --figure"))));
    assert!(
        all[0] <= one[0] + 0.2 && all[1] > other[1] - 0.2 && all[1] > 7.0,
        "{all:?} {one:?} {other:?}"
    );
}

#[test]
fn letters_that_the_font_lacks_are_told() {
    let lab = Lab::solved(&LINEAR.replace("Plane", "Platte 板"));
    let (_, warning) = lab.warned("render plate.h5 -o a.png --figure");
    assert!(warning.contains("lacks `板`; boxes stand for them"), "{warning}");
    let (_, warning) = lab.warned("render plate.h5 -o a.svg --figure");
    assert!(warning.contains("lacks `板`; programs with other fonts show them"), "{warning}");
    assert!(read(&lab, "a.svg").contains(">Platte 板</text>"));
    // a bare picture has no letters
    lab.run("render plate.h5 -o a.png");
}

#[test]
fn directions_have_colours_that_go_round() {
    let lab = Lab::solved(CRACKED);
    lab.run("render plate.h5 -o a.png --size 30x30 -q direction");
    let png = Png::read(&lab.path("a.png"));
    assert_eq!(png.text("ppum:colormap"), "twilight");
    let ends: Vec<f64> = png.text("ppum:range").split(',').map(|n| n.parse().unwrap()).collect();
    assert!(ends[0] == -ends[1] && (ends[1] - std::f64::consts::FRAC_PI_2).abs() < 1e-7);
    lab.run("render plate.h5 -o b.png --size 30x30 -q direction --colormap viridis");
    assert_eq!(Png::read(&lab.path("b.png")).text("ppum:colormap"), "viridis");
}

/// Undefined pixels of the plate are grey, those outside are not there.
#[test]
fn undefined_is_not_outside() {
    let lab = Lab::solved(LINEAR);
    let (_, warning) =
        lab.warned("render plate.h5 -o a.png -q sqrt(u-1.5) --view -1,-1,3,3 --size 80x80");
    assert!(warning.contains("has no value at"), "{warning}");
    let png = Png::read(&lab.path("a.png"));
    // u = x + 2y on a plate that begins at the origin
    let [r, g, b, opacity] = png.pixel(22, 57);
    assert!(opacity == 255 && r.abs_diff(b) < 8 && r == g, "{:?}", png.pixel(22, 57));
    assert_eq!(png.pixel(2, 2), [0; 4]);
}

/// Overlays show, each in its own way; words come in any order.
/// What a picture cannot show is said.
#[test]
fn what_has_no_room_or_no_value_is_told() {
    let lab = Lab::solved(CRACKED);
    let told = |options: &str| lab.warned(&format!("render plate.h5 -o o.png {options}")).1;
    assert!(told("--size 60x60 --arrows=20").contains("too small for its legend: longest arrow"));
    // without a word
    lab.run("render plate.h5 -o o.png --size 600x600 --arrows");
    lab.run("render plate.h5 -o o.png --size 700x525 --figure --arrows");
    assert!(told("--size 60x60 -q 1/0").contains("`1/0` has no finite value"));
}

#[test]
fn overlays_are_drawn_over_the_colours() {
    let lab = Lab::solved(CRACKED);
    let draw = |options: &str| {
        lab.run(&format!("render plate.h5 -o o.png --size 300x300 -q uy {options}"));
        Png::read(&lab.path("o.png")).rgba
    };
    let plain = draw("");
    let options = [
        "--overlay patches",
        "--overlay cells",
        "--overlay centers",
        "--overlay rings",
        "--overlay cracks",
        "--overlay supports",
        "--overlay loads",
        "--isolines auto",
        "--isolines 5 --level-labels",
        "--arrows",
        "--crosses=20",
    ];
    let drawn: Vec<_> = options.iter().map(|options| draw(options)).collect();
    for (k, picture) in drawn.iter().enumerate() {
        assert!(*picture != plain, "{}", options[k]);
        assert!(drawn[..k].iter().all(|other| other != picture), "{}", options[k]);
    }
    assert_eq!(draw("--overlay cells,cracks"), draw("--overlay cracks,cells,cracks"));
    for wrong in [
        "--isolines 0",
        "--isolines x",
        "--isolines ,",
        "--isolines 1e9",
        "--isolines=-1",
        "--layout 2 -q ux,uy",
        "--figure --font-size 1e9",
        "--level-labels",
        "--arrows=1",
        "--overlay nodes",
    ] {
        lab.fail(&format!("render plate.h5 -o w.png {wrong}"));
    }
}

/// The isolines of a linear potential are straight, at the values asked for.
#[test]
fn isolines_are_vectors() {
    let lab = Lab::solved(LINEAR);
    lab.run("render plate.h5 -o lines.svg -q u --isolines 0.5,1,99 --level-labels --size 400x200");
    let svg = read(&lab, "lines.svg");
    assert!(
        svg.contains(">0.5</text>") && svg.contains(">1</text>") && !svg.contains(">99<"),
        "{svg}"
    );
}
