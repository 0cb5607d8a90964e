//! Fields on meshes, in the datasets that importers have made.

use crate::{Lab, Png};

/// A folder with one of them as `mesh.h5`.
fn lab(name: &str) -> Lab {
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
