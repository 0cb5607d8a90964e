//! `-` stands for standard input and output.

use std::io::Write as _;
use std::process::{Output, Stdio};

use crate::{CRACKED, Lab, Png};

impl Lab {
    /// Runs a command with bytes on standard input.
    fn fed(&self, arguments: &str, input: &[u8]) -> Output {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // a command that refuses reads nothing
        let _ = child.stdin.take().unwrap().write_all(input);
        child.wait_with_output().unwrap()
    }

    /// The output of a successful command on its input, and its messages.
    fn made(&self, arguments: &str, input: &[u8]) -> (Vec<u8>, String) {
        let Output { status, stdout, stderr } = self.fed(arguments, input);
        let told = String::from_utf8(stderr).unwrap();
        assert!(status.success(), "{arguments}: {told}");
        (stdout, told)
    }

    fn refused(&self, arguments: &str, input: &[u8]) -> String {
        let Output { status, stdout, stderr } = self.fed(arguments, input);
        let complaint = String::from_utf8(stderr).unwrap();
        assert!(
            matches!(status.code(), Some(1 | 2)) && stdout.is_empty(),
            "{arguments}: {complaint}"
        );
        complaint
    }
}

#[test]
fn from_a_problem_to_a_picture_without_files() {
    let lab = Lab::new();
    let (dataset, told) = lab.made("solve - -o -", CRACKED.as_bytes());
    assert!(told.contains("Small plate") && told.contains("wrote standard output"), "{told}");
    let (picture, told) = lab.made("render - -o - --size 40x30", &dataset);
    assert!(told.starts_with("wrote standard output: von-mises, 40x30"), "{told}");
    let (table, told) = lab.made("sample - --grid 2x2 -o -", &dataset);
    assert!(table.starts_with(b"x,y,side,ux") && told.is_empty(), "{told}");
    assert!(lab.files().is_empty());
    // the same as by files
    lab.write("plate.toml", CRACKED);
    lab.run("solve plate.toml");
    lab.run("render plate.h5 -o a.png --size 40x30");
    std::fs::write(lab.path("b.png"), picture).unwrap();
    let [a, b] = ["a.png", "b.png"].map(|name| Png::read(&lab.path(name)));
    assert_eq!((a.rgba, b.text("ppum:dataset")), (b.rgba.clone(), "standard input"));
    assert_eq!(table, lab.run("sample plate.h5 --grid 2x2").into_bytes());
    let bytes = std::fs::read(lab.path("plate.h5")).unwrap();
    for command in ["info", "sif", "probe --at 0.3,0.2", "formula ux --of"] {
        let (out, _) = lab.made(&format!("{command} -"), &bytes);
        assert!(!out.is_empty(), "{command}");
    }
    let tips =
        |out: &[u8]| serde_json::from_slice::<serde_json::Value>(out).unwrap()["tips"].clone();
    assert_eq!(tips(&lab.made("sif - --json", &bytes).0), lab.json("sif plate.h5")["tips"]);
}

#[test]
fn texts_from_standard_input() {
    let lab = Lab::solved(CRACKED);
    let (table, _) = lab.made("sample plate.h5 --points - -q ux", b"0.1,0.2\n0.3,0.4\n");
    assert_eq!(String::from_utf8(table).unwrap().lines().count(), 3);
    let (told, _) = lab.made("probe plate.h5 --at 0.1,0.2 -q @-", b"ux # the first\n + uy");
    assert!(!told.is_empty());
    assert!(lab.refused("sample plate.h5 --points -", b"x\n").contains("standard input"));
    assert!(lab.refused("probe plate.h5 --at 0,0 -q @-", b"uz").contains("standard input"));
}

/// Files that a problem names are looked for in the working directory.
#[test]
fn a_problem_from_standard_input_reads_tables() {
    let lab = Lab::new();
    lab.write("modulus.csv", "-2,1\n2,3\n");
    let table = "[[table]]\nname = \"modulus\"\nfile = \"modulus.csv\"\n[material]";
    let text = CRACKED.replace("young = 1.0", "young = \"table(modulus, x)\"");
    lab.made("solve - -o plate.h5", text.replace("[material]", table).as_bytes());
    assert!(lab.run("info plate.h5").contains("modulus(x)"));
}

#[test]
fn standard_streams_are_used_once() {
    let lab = Lab::solved(CRACKED);
    let bytes = std::fs::read(lab.path("plate.h5")).unwrap();
    for command in ["probe - --at 0,0 -q @-", "sample - --points -", "render - -o a.png -q @-"] {
        assert!(lab.refused(command, &bytes).contains("already"), "{command}");
    }
    assert!(lab.refused("solve -", CRACKED.as_bytes()).contains("-o"));
    assert!(lab.refused("solve - -o - --json", CRACKED.as_bytes()).contains("--json"));
    assert!(lab.refused("solve - -o x.h5", b"nothing").starts_with("error: standard input:"));
    assert!(
        lab.refused("info -", b"no dataset").contains("standard input: not a readable HDF5 file")
    );
    assert_eq!(lab.files(), ["plate.h5", "plate.toml"]);
}
