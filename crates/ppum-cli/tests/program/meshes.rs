//! Fields on meshes, in the datasets that importers have made.

use ppum::dataset::{Dataset, Equation, Material, StressState};
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::exact::{CrackInPlane, ExactField};
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field};

use crate::{Lab, Png};

/// A folder with one of them as `mesh.h5`.
pub(super) fn lab(name: &str) -> Lab {
    let lab = Lab::new();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/python/fixtures");
    std::fs::copy(format!("{folder}/{name}.h5"), lab.path("mesh.h5")).unwrap();
    lab
}

/// Graphics cards leave them to the processor, which a note says where a card was asked for.
#[test]
fn cards_leave_meshes_to_the_processor() {
    let lab = lab("ngsolve-triangles");
    lab.run("render mesh.h5 -o cpu.png --size 80x70");
    for backend in ["gpu", "splat"] {
        let command = format!("render mesh.h5 -o a.png --size 80x70 --backend {backend}");
        let output = lab.command(&command).output().unwrap();
        assert!(output.status.success());
        let note = "note: drawn on the CPU, since graphics cards do not draw meshes\n";
        assert_eq!(String::from_utf8(output.stderr).unwrap(), note);
        let picture = Png::read(&lab.path("a.png"));
        assert_eq!(picture.text("ppum:backend"), "cpu f64");
        assert_eq!(picture.rgba, Png::read(&lab.path("cpu.png")).rgba);
    }
}

/// The cuts of elements are drawn as cracks are: dark, along the jump and nowhere else.
#[test]
fn cuts_are_where_the_field_jumps() {
    for (name, cut) in
        [("getfem-crack-curved", true), ("ngsxfem", true), ("skfem-triangles", false)]
    {
        let lab = lab(name);
        let command = |more: &str, file: &str| {
            lab.run(&format!("render mesh.h5 -o {file} --size 300x300 --range 0,1 {more}"));
            Png::read(&lab.path(file))
        };
        let plain = command("", "plain.png");
        let drawn = command("--overlay cracks", "drawn.png");
        let pairs = plain.rgba.as_chunks::<4>().0.iter().zip(drawn.rgba.as_chunks::<4>().0);
        let dark = pairs.filter(|(a, b)| a != b && b[..3].iter().all(|c| *c < 60)).count();
        assert_eq!(dark > 60, cut, "{name}: {dark}");
        assert!(dark < 3000, "{name}: {dark}");
    }
}

#[test]
fn crosses_need_elasticity() {
    let complaint = lab("mfem-squares").fail("render mesh.h5 -o a.png --crosses");
    assert!(complaint.contains("which only elasticity has"), "{complaint}");
}

/// Quadratic triangles that interpolate the field of a crack of half length 0.75 in the plane; the
/// crack lies on edges, whose nodes are doubled.
pub(super) fn cracked_plate() -> Dataset {
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let exact = CrackInPlane::biaxial(material, Vec2::ZERO, vec2(1.0, 0.0), 0.75, 0.05);
    let line = BivariatePolynomial::linear;
    let elements =
        MeshBuilder::tiles([16, 16], 1, &[line(-2.0, 4.0, 0.0), line(-2.0, 0.0, 4.0)], |_, _| true);
    // the shares of the corners of the reference triangle
    let (s, t) = (line(1.0 / 3.0, 2.0 / 3.0, 0.0), line(1.0 / 3.0, 0.0, 2.0 / 3.0));
    let rest = line(1.0, 0.0, 0.0).plus(&s.plus(&t).times(&line(-1.0, 0.0, 0.0)));
    let shares = [rest, s, t];
    let corners = elements.mesh.shape[0].corners();
    let parts = |component: usize| {
        let of_patch = |patch: usize| {
            let (center, _) = elements.mesh.image(patch, [0.0; 2]);
            let value = |xi: [f64; 2]| {
                let (p, _) = elements.mesh.image(patch, xi);
                // on the crack from inside the element
                exact.evaluate(p + (center - p) * 1e-12)[component].value
            };
            let mut sum = BivariatePolynomial::default();
            let mut add = |shape: BivariatePolynomial, value: f64| {
                sum = sum.plus(&shape.times(&line(value, 0.0, 0.0)));
            };
            for a in 0..3 {
                let b = (a + 1) % 3;
                let middle = [0, 1].map(|k| 0.5 * (corners[a][k] + corners[b][k]));
                let twice = shares[a].times(&line(2.0, 0.0, 0.0)).plus(&line(-1.0, 0.0, 0.0));
                add(shares[a].times(&twice), value(corners[a]));
                let bubble = shares[a].times(&shares[b]).times(&line(4.0, 0.0, 0.0));
                add(bubble, value(middle));
            }
            (PolynomialSpace::Total, 2, sum)
        };
        field("displacement", &(0..elements.mesh.len()).map(of_patch).collect::<Vec<_>>())
    };
    let [mut data, second] = [parts(0), parts(1)];
    data.components = vec!["ux".into(), "uy".into()];
    data.coefficients.extend(second.coefficients);
    let mut dataset = elements.dataset(vec![data]);
    dataset.equation = Equation::elasticity(material);
    dataset
}

/// A finite element's plate with a crack between doubled nodes: drawn deformed, the crack is open,
/// both faces are lines, the edges of elements move along, and pixels say the factor.
#[test]
fn plates_of_elements_are_drawn_deformed() {
    let lab = Lab::new();
    ppum_format::write(&cracked_plate(), &lab.path("mesh.h5")).unwrap();
    lab.run("render mesh.h5 -o still.png --size 400x400 --range 0,1");
    lab.run("render mesh.h5 -o moved.png --size 400x400 --range 0,1 --deformed 3");
    let [still, moved] = ["still.png", "moved.png"].map(|file| Png::read(&lab.path(file)));
    assert_eq!(moved.text("ppum:deformed"), "3.0");
    // the crack opens by 2 · 0.75 · 0.05 (κ + 1)/(4 μ) = 0.1365 in the middle, three times of it
    // are 36 pixels of a picture 4.5 wide
    let empty = |png: &Png, row: u32| png.pixel(200, row)[3] == 0;
    let count = |png: &Png| (100..300).filter(|&row| empty(png, row)).count();
    assert_eq!(count(&still), 0);
    assert!((34..=38).contains(&count(&moved)), "{}", count(&moved));
    // one dark line on either side of the opening, and nothing dark ahead of the tips
    lab.run("render mesh.h5 -o lines.png --size 400x400 --range 0,1 --deformed 3 --overlay cracks");
    let lines = Png::read(&lab.path("lines.png"));
    let dark = |column: u32| {
        let rows = (150..250).filter(|&row| lines.pixel(column, row)[3] == 255);
        let rows = rows.filter(|&row| lines.pixel(column, row)[..3].iter().all(|c| *c < 60));
        rows.count()
    };
    assert!(dark(200) >= 2 && dark(60) == 0 && dark(340) == 0, "{}", dark(200));
    lab.run("render mesh.h5 -o figure.png --figure --deformed auto --overlay cells --outline");
    lab.run("render mesh.h5 -o lines-of.png --deformed auto -q von-mises --isolines 8");
}
