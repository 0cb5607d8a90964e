//! Drawing by the CPU, or by a graphics device that gathers or splats.

use ppum_testkit::skipped::skipped;

use crate::{CRACKED, LINEAR, Lab, Png, keys, with_formulas};

/// Variables that hide all Vulkan drivers from a command: of new loaders and of old ones.
const HIDDEN: [(&str, &str); 2] = [("VK_DRIVER_FILES", "none"), ("VK_ICD_FILENAMES", "none")];

/// True if there is a graphics adapter that splats, a software one say. If there is none the test
/// is skipped, unless `PPUM_REQUIRE_GPU` is set.
pub(crate) fn has_adapter(lab: &Lab) -> bool {
    let report = lab.json("info --gpu");
    let adapters = report["adapters"].as_array().unwrap();
    let found = adapters.iter().any(|row| row["splat"] == true);
    if !found {
        skipped("no graphics adapter");
    }
    found
}

impl Lab {
    /// Pixels lie on no border of a patch, where stresses jump.
    fn draw(&self, options: &str) -> Png {
        let window =
            if options.contains("--tip") { "" } else { "--center 0.0123,0.0077 --width 2.61" };
        self.run(&format!("render plate.h5 -o a.png --size 320x240 {window} {options}"));
        Png::read(&self.path("a.png"))
    }

    /// The end of a command, its output and its complaint, with no driver to be found.
    pub(crate) fn without_driver(&self, arguments: &str) -> (Option<i32>, String, String) {
        let output = self.command(arguments).envs(HIDDEN).output().unwrap();
        let [text, complaint] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code(), text, complaint)
    }
}

/// Bytes of two pictures that differ by more than a step.
fn far(a: &Png, b: &Png) -> usize {
    assert_eq!(a.size, b.size);
    a.rgba.iter().zip(&b.rgba).filter(|(a, b)| a.abs_diff(**b) > 1).count()
}

/// Every backend draws the same picture. Left out are pixels whose value is the end of the range,
/// where the colour jumps, and those on the crack's line: no more than 4 in a thousand.
#[test]
fn backends_agree() {
    let lab = Lab::solved(CRACKED);
    if !has_adapter(&lab) {
        return;
    }
    for options in [
        "--range 0,3",
        "-q uy --colormap coolwarm",
        "-q uy --samples 3",
        "-q direction --range=-1.6,1.6",
        "--tip 1 --zoom 1e6 --scale log",
        "-q overlap --range 0,9",
        "-q phi:20 --range 0,1",
        "--figure --overlay patches,cracks --range 0,3",
    ] {
        let cpu = lab.draw(&format!("{options} --backend cpu"));
        assert_eq!(cpu.text("ppum:backend"), "cpu f64");
        for (backend, by) in [("gpu", "gpu f32, "), ("splat", "gpu splat f32, ")] {
            let gpu = lab.draw(&format!("{options} --backend {backend}"));
            let found = far(&cpu, &gpu);
            assert!(found * 250 <= cpu.rgba.len(), "{options} --backend {backend}: {found}");
            assert!(gpu.text("ppum:backend").starts_with(by), "{:?}", gpu.texts);
        }
    }
}

/// Formulas of a dataset and those that replace them are compiled for the device.
#[test]
fn formulas_are_drawn_by_any_backend() {
    if !has_adapter(&Lab::new()) {
        return;
    }
    let lab = Lab::solved(&with_formulas());
    for options in [
        "-q stretch --range 0,8",
        "-q uy --range=-4,4 --weight bump",
        "-q ux --range=-4,4 --function 10=r",
        "-q uy --range=-4,4 --part jump",
    ] {
        let draw = |backend: &str| lab.draw(&format!("{options} --backend {backend}"));
        let (cpu, gpu, splat) = (draw("cpu"), draw("gpu"), draw("splat"));
        let most = cpu.rgba.len() / 250;
        assert!(far(&cpu, &gpu) <= most && far(&cpu, &splat) <= most, "{options}");
    }
}

#[test]
fn what_drew_is_told() {
    let lab = Lab::solved(LINEAR);
    for (options, by) in [
        ("--backend cpu", "cpu f64"),
        ("--backend cpu --precision f32", "cpu f32"),
        ("--backend auto --precision f64", "cpu f64"),
    ] {
        let told = lab.run(&format!("render plate.h5 -o a.png {options}"));
        assert!(told.ends_with(&format!(", {by}\n")), "{told}");
        assert_eq!(Png::read(&lab.path("a.png")).text("ppum:backend"), by);
    }
    // single precision cannot show differences of nearly equal numbers: not a word, the CPU draws
    assert_eq!(lab.draw("-q error").text("ppum:backend"), "cpu f64");
}

#[test]
fn without_a_driver_the_cpu_draws() {
    let lab = Lab::solved(LINEAR);
    let (code, text, complaint) = lab.without_driver("render plate.h5 -o a.png");
    assert_eq!((code, complaint.as_str()), (Some(0), ""));
    // where drivers are no Vulkan ones they cannot be hidden
    if cfg!(target_os = "linux") {
        assert!(text.ends_with(", cpu f64\n"), "{text}");
        for backend in ["gpu", "splat"] {
            let (code, text, complaint) =
                lab.without_driver(&format!("render plate.h5 -o b.png --backend {backend}"));
            assert_eq!((code, text.as_str()), (Some(1), ""));
            let reason =
                if cfg!(feature = "gpu") { "mesa-vulkan-drivers" } else { "was built without" };
            for part in ["error: no graphics adapter", reason, "--backend cpu"] {
                assert!(complaint.contains(part), "{complaint}");
            }
        }
        assert_eq!(lab.files(), ["a.png", "plate.h5", "plate.toml"]);
    }
}

#[test]
fn a_device_says_what_it_cannot() {
    let lab = Lab::solved(LINEAR);
    if !has_adapter(&lab) {
        return;
    }
    for backend in ["gpu", "splat"] {
        for (options, hint) in [
            ("-q error", "needs double precision"),
            ("--size 100000x16", "use `--backend cpu`"),
            ("-q uz", "known are"),
        ] {
            let command = format!("render plate.h5 -o b.png --backend {backend} {options}");
            let complaint = lab.fail(&command);
            assert!(complaint.contains(hint), "{command}: {complaint}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn adapters_are_missing() {
    let lab = Lab::new();
    let (code, text, complaint) = lab.without_driver("info --gpu");
    assert_eq!((code, complaint.as_str()), (Some(0), ""));
    let reason =
        if cfg!(feature = "gpu") { "libvulkan1 mesa-vulkan-drivers" } else { "built without" };
    for part in ["no graphics adapter", "on the CPU", reason] {
        assert!(text.contains(part), "{text}");
    }
    let (code, text, _) = lab.without_driver("info --gpu --json");
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, report), (Some(0), serde_json::json!({ "adapters": [] })));
}

#[test]
fn adapters_are_listed() {
    let lab = Lab::new();
    if !has_adapter(&lab) {
        return;
    }
    let report = lab.json("info --gpu");
    let rows = report["adapters"].as_array().unwrap();
    for row in rows {
        assert_eq!(
            keys(row),
            [
                "driver",
                "interface",
                "kind",
                "largest_binding_mib",
                "largest_buffer_mib",
                "largest_texture",
                "name",
                "splat",
                "taken_by"
            ]
        );
        assert!(row["largest_binding_mib"].as_u64().unwrap() >= 128, "what WebGPU promises");
        assert!(row["largest_texture"].as_u64().unwrap() >= 8192, "what WebGPU promises");
    }
    let takers = |backend: &str| {
        let takes = |row: &&serde_json::Value| {
            row["taken_by"].as_array().unwrap().contains(&backend.into())
        };
        rows.iter().filter(takes).collect::<Vec<_>>()
    };
    assert_eq!(takers("gpu").len(), 1);
    assert!(takers("auto").iter().all(|row| row["kind"] != "software"));
    let text = lab.run("info --gpu");
    let name = takers("gpu")[0]["name"].as_str().unwrap();
    for part in [name, "can splat    yes", "MiB", "taken by     --backend "] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// A crack that cuts slivers off patches, with a weight that is nearly nothing there: single
/// precision draws what double precision draws.
#[test]
fn slivers_look_the_same_in_single_precision() {
    let cut = CRACKED.replace("[[-0.5, 0.0], [0.5, 0.0]]", "[[-0.4, -0.11], [0.31, 0.17]]");
    let lab = Lab::solved(&cut.replace("level = 3", "level = 2\nweight = \"cubic\""));
    for window in ["--center 0,0 --width 2", "--center 0.1008,0.0081 --width 0.02"] {
        let draw = |precision: &str| {
            let options = format!("--backend cpu --precision {precision} --range 0.2,1 {window}");
            lab.run(&format!("render plate.h5 -o a.png --size 300x300 {options}"));
            Png::read(&lab.path("a.png"))
        };
        assert_eq!(far(&draw("f32"), &draw("f64")), 0, "{window}");
    }
}

/// A step whose stresses have no three digits in single precision: a warning says so, and nothing
/// of one that has them.
#[test]
fn too_few_digits_of_single_precision_are_told() {
    let lab = Lab::solved(CRACKED);
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    for (rounding, is_told) in [(1.8e-12, false), (1.9e-12, true)] {
        let history = &mut dataset.steps[0].history;
        history.iter_mut().find(|record| record.name == "rounding").unwrap().value = rounding;
        ppum_format::write(&dataset, &lab.path("plate.h5")).unwrap();
        for (precision, is_single) in [("f32", true), ("f64", false)] {
            let arguments =
                format!("render plate.h5 -o a.png --size 40x40 --precision {precision}");
            let output = lab.command(&format!("{arguments} --backend cpu")).output().unwrap();
            let complaint = String::from_utf8(output.stderr).unwrap();
            let warns = complaint.contains("in single precision stresses are wrong");
            assert_eq!(warns, is_told && is_single, "{rounding} {precision}: {complaint}");
        }
    }
}
