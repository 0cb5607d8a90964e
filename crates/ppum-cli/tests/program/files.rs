//! Files: what is not read, what is not written over, and that nothing is left half written.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::{CRACKED, LINEAR, Lab};

/// A cracked plate with a table and points, and files of all other kinds that commands read.
fn with_inputs() -> Lab {
    let lab = Lab::new();
    lab.write("points.csv", "-0.5,-0.5\n0.5,0.5\n0.25,0.75\n");
    lab.write("table.csv", "-2,1\n2,1\n");
    lab.write("q.txt", "hypot(ux, uy)");
    lab.write("f.txt", "r");
    lab.write("w.txt", "1 - t");
    lab.write("map.csv", "0 0 0\n1 1 1\n");
    let table = "[[table]]\nname = \"modulus\"\nfile = \"table.csv\"\n";
    let problem = CRACKED.replace("level = 3", "points = \"points.csv\"") + table;
    lab.write("plate.toml", &problem.replace("young = 1.0", "young = \"table(modulus, x)\""));
    lab.write("plain.toml", LINEAR);
    lab.run("solve plain.toml -o plate.h5");
    lab
}

/// All files with their bytes.
fn contents(lab: &Lab) -> Vec<(String, Vec<u8>)> {
    let read = |name: String| (name.clone(), fs::read(lab.path(&name)).unwrap());
    lab.files().into_iter().map(read).collect()
}

/// Every kind of file that a command reads; `FILE` is one without an end.
const READERS: [&str; 13] = [
    "solve FILE",
    "solve FILE --check",
    "info FILE",
    "sif FILE",
    "probe FILE --at 0,0",
    "probe plate.h5 --at 0,0 -q @FILE",
    "sample FILE --grid 2x2",
    "sample plate.h5 --points FILE",
    "render FILE -o a.png",
    "render plate.h5 -o a.png --colormap FILE",
    "render plate.h5 -o a.png --weight @FILE",
    "formula @FILE",
    "formula x --table k=FILE",
];

#[cfg(unix)]
#[test]
fn endless_inputs_are_refused() {
    let lab = with_inputs();
    assert!(Command::new("mkfifo").arg(lab.path("pipe")).status().unwrap().success());
    fs::File::create(lab.path("long")).unwrap().set_len(2 << 40).unwrap();
    // the signature of HDF5, or else no more would be read of it
    let hdf5 = fs::File::create(lab.path("long.h5")).unwrap();
    std::io::Write::write_all(&mut &hdf5, b"\x89HDF\r\n\x1a\n").unwrap();
    hdf5.set_len(2 << 40).unwrap();
    let before = lab.files();
    for (file, reason) in [
        ("/dev/zero", "it is a device, not a regular file"),
        ("pipe", "it is a pipe, not a regular file"),
        ("long", "it has more than "),
        ("long.h5", "it has more than "),
        (".", "it is a folder"),
    ] {
        for reader in READERS {
            let complaint = lab.fail(&reader.replace("FILE", file));
            assert!(complaint.contains(reason), "{reader} of {file}: {complaint}");
        }
    }
    for file in ["points.csv", "table.csv"] {
        fs::remove_file(lab.path(file)).unwrap();
        std::os::unix::fs::symlink("/dev/zero", lab.path(file)).unwrap();
        let complaint = lab.fail("solve plate.toml --check");
        assert!(complaint.contains(file) && complaint.contains("a device"), "{complaint}");
    }
    assert_eq!(lab.files(), before);
}

/// Commands that write with all files that they read; `OUT` is what they are told to write.
const WRITERS: [(&str, &[&str]); 3] = [
    ("solve plate.toml -o OUT", &["plate.toml", "points.csv", "table.csv"]),
    (
        "sample plate.h5 --points points.csv -q u,@q.txt --function one=@f.txt --weight @w.txt -o OUT",
        &["plate.h5", "points.csv", "q.txt", "f.txt", "w.txt"],
    ),
    (
        "render plate.h5 -q @q.txt --colormap map.csv --function one=@f.txt --weight @w.txt -o OUT",
        &["plate.h5", "q.txt", "map.csv", "f.txt", "w.txt"],
    ),
];

/// Not under any name that it goes by.
#[test]
fn inputs_are_not_written_over() {
    let lab = with_inputs();
    fs::create_dir(lab.path("sub")).unwrap();
    for input in ["plate.toml", "plate.h5", "points.csv", "table.csv", "q.txt", "map.csv"] {
        fs::hard_link(lab.path(input), lab.path("sub").join(format!("hard-{input}"))).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(lab.path(input), lab.path(&format!("sub/soft-{input}")))
            .unwrap();
    }
    let unchanged = || {
        ["plate.toml", "plate.h5", "points.csv", "table.csv"]
            .map(|n| fs::read(lab.path(n)).unwrap())
    };
    let before = unchanged();
    for (command, inputs) in WRITERS {
        for input in inputs {
            let linked = ["q.txt", "f.txt", "w.txt", "map.csv"].contains(input);
            let mut names =
                vec![(*input).to_owned(), format!("./{input}"), format!("sub/../{input}")];
            names.push(lab.path(input).display().to_string());
            if !linked {
                names.push(format!("sub/hard-{input}"));
                #[cfg(unix)]
                names.push(format!("sub/soft-{input}"));
            }
            for name in names {
                let complaint = lab.fail(&command.replace("OUT", &name));
                assert!(complaint.contains("would replace"), "{command} {name}: {complaint}");
            }
        }
    }
    assert!(unchanged() == before);
}

#[test]
fn extensions_say_what_is_written() {
    let lab = with_inputs();
    let before = contents(&lab);
    for (command, name, remedy) in [
        (WRITERS[0].0, "x.png", ".h5 or .hdf5"),
        (WRITERS[0].0, "x.csv", ".h5 or .hdf5"),
        (WRITERS[0].0, "x.toml", ".h5 or .hdf5"),
        (WRITERS[0].0, "x", ".h5 or .hdf5"),
        (WRITERS[1].0, "x.h5", ".csv or .npy"),
        (WRITERS[1].0, "x.png", ".csv or .npy"),
        (WRITERS[2].0, "x.h5", ".png"),
        (WRITERS[2].0, "x.csv", ".png"),
    ] {
        let complaint = lab.fail(&command.replace("OUT", name));
        assert!(complaint.contains(remedy), "{command} {name}: {complaint}");
    }
    assert!(contents(&lab) == before);
}

/// Whatever would fail after minutes of work is told before; `--check` knows it too.
#[test]
fn targets_that_cannot_be_written() {
    let lab = with_inputs();
    lab.write("kept.h5", "precious");
    let mut permissions = fs::metadata(lab.path("kept.h5")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(lab.path("kept.h5"), permissions).unwrap();
    fs::create_dir(lab.path("folder.h5")).unwrap();
    let long = format!("{}.h5", "n".repeat(300));
    let mut targets = vec![
        ("kept.h5", "write-protected"),
        ("folder.h5", "is a folder"),
        ("nowhere/a.h5", "there is no folder nowhere"),
        ("plate.toml/a.h5", "plate.toml"),
        (&long, "cannot write"),
    ];
    if cfg!(target_os = "linux") {
        // where not even the superuser can make files
        targets.push(("/proc/a.h5", "cannot write /proc/a.h5"));
    }
    let before = lab.files();
    for (target, reason) in targets {
        for more in ["", " --check"] {
            let complaint = lab.fail(&format!("solve plate.toml -o {target}{more}"));
            assert!(complaint.contains(reason), "{target}: {complaint}");
        }
    }
    assert_eq!(lab.files(), before);
    assert_eq!(fs::read(lab.path("kept.h5")).unwrap(), b"precious");
}

/// A table and a picture as a dataset: links are followed, other names of the old file keep it.
#[cfg(unix)]
#[test]
fn links_are_followed() {
    let lab = Lab::solved(LINEAR);
    fs::create_dir(lab.path("data")).unwrap();
    for (command, name) in
        [("sample plate.h5 --grid 3x3", "a.csv"), ("render plate.h5 --size 64x48", "a.png")]
    {
        lab.write(&format!("data/{name}"), "old");
        fs::hard_link(lab.path("data").join(name), lab.path(&format!("data/hard-{name}"))).unwrap();
        std::os::unix::fs::symlink(Path::new("data").join(name), lab.path(name)).unwrap();
        lab.run(&format!("{command} -o {name}"));
        assert!(fs::symlink_metadata(lab.path(name)).unwrap().is_symlink());
        assert!(fs::metadata(lab.path("data").join(name)).unwrap().len() > 50);
        assert_eq!(fs::read(lab.path(&format!("data/hard-{name}"))).unwrap(), b"old");
    }
    let mut names: Vec<_> =
        fs::read_dir(lab.path("data")).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["a.csv", "a.png", "hard-a.csv", "hard-a.png"]);
}

/// The disk is full, or the program is killed: the old table is there. What a dead program leaves
/// is removed by the next one that writes the file.
#[cfg(target_os = "linux")]
#[test]
fn tables_are_written_whole_or_not_at_all() {
    let lab = Lab::solved(LINEAR);
    lab.write("a.csv", "precious");
    // files of at most 64 blocks; one that grows is an error, or else the program's end
    for (trap, parts) in [("trap '' XFSZ", 0), ("", 1)] {
        let script = format!("{trap}\nulimit -c 0; ulimit -f 64; exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script, env!("CARGO_BIN_EXE_ppum")]);
        command.args("sample plate.h5 --grid 200x200 -o a.csv".split(' '));
        let output = command.current_dir(lab.folder.path()).output().unwrap();
        assert!(!output.status.success());
        assert_eq!(fs::read(lab.path("a.csv")).unwrap(), b"precious");
        let names = lab.files();
        assert_eq!(names.iter().filter(|name| name.ends_with(".part")).count(), parts, "{names:?}");
    }
    lab.run("sample plate.h5 --grid 200x200 -o a.csv");
    assert_eq!(lab.files(), ["a.csv", "plate.h5", "plate.toml"]);
    assert_eq!(fs::read_to_string(lab.path("a.csv")).unwrap().lines().count(), 40_001);
}

#[test]
fn an_edited_problem_survives_the_demonstration() {
    let lab = Lab::new();
    fs::create_dir(lab.path("out")).unwrap();
    for edited in ["title = \"mine\"\n", "", &"# long\n".repeat(10_000)] {
        lab.write("out/centre-crack.toml", edited);
        let complaint = lab.fail("demo");
        assert!(complaint.contains("another folder with -o"), "{complaint}");
        let found = fs::read_to_string(lab.path("out/centre-crack.toml")).unwrap();
        assert_eq!(found, edited);
        assert_eq!(fs::read_dir(lab.path("out")).unwrap().count(), 1);
    }
    // what could not be written in the end is told at the beginning
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/centre-crack.toml");
    fs::copy(example, lab.path("out/centre-crack.toml")).unwrap();
    fs::create_dir(lab.path("out/patches.png")).unwrap();
    assert!(lab.fail("demo").contains("patches.png"));
    assert_eq!(fs::read_dir(lab.path("out")).unwrap().count(), 2);
}

#[test]
fn threads_are_limited() {
    let lab = with_inputs();
    for command in ["solve plate.toml", "render plate.h5 -o a.png"] {
        for threads in ["0", "1025", "1000000", "-1"] {
            let complaint = lab.fail(&format!("{command} --threads={threads}"));
            assert!(complaint.contains("from 1 to 1024"), "{command}: {complaint}");
        }
    }
    // 1024 are understood, but too many to be worth their start in a test
    assert!(lab.fail("render none.h5 -o a.png --threads 1024").contains("none.h5"));
    lab.run("render plate.h5 -o a.png --size 64x48 --backend cpu --threads 128");
    let output = lab.command("sif plate.h5").env("RAYON_NUM_THREADS", "1000000").output().unwrap();
    assert!(output.stderr.starts_with(b"error: RAYON_NUM_THREADS: at most 1024"));
}
