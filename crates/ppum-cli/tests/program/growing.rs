//! Series of cracks that grow: runs that are killed, that find no room, or each other.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum_format::Series;
use ppum_solve::report::strip_timings;

use crate::Lab;

/// A crack that grows straight on, on cells that are as coarse as gives no warning.
const GROWING: &str = r#"
title = "Growing"
domain = { min = [-1, -1], max = [1, 1] }
material = { young = 1, poisson = 0.3, state = "plane-strain" }
boundary = [ { on = "bottom", traction = [0, -1] }, { on = "top", traction = [0, 1] } ]
discretization = { level = 3, order = 1, refine = false, enrichment = "zone" }
growth = { increment = 0.05, steps = 2 }
crack = [{ points = [[-1, 0], [0.3, 0]] }]
"#;

/// The longest wait for a state. Only a test that hangs waits so long.
const TIME_LIMIT: Duration = Duration::from_secs(300);

impl Lab {
    /// A folder with `plate.toml` and its whole series `whole.h5`.
    fn grown() -> Self {
        let lab = Self::solved(GROWING);
        fs::rename(lab.path("plate.h5"), lab.path("whole.h5")).unwrap();
        lab
    }

    /// Everything in a series but the seconds that its solution took.
    fn content(&self, name: &str) -> Dataset {
        let mut dataset = ppum_format::read(&self.path(name)).unwrap();
        dataset.steps.iter_mut().for_each(strip_timings);
        dataset
    }

    /// A run that has written so many steps of `a.h5`, and goes on.
    fn running(&self, arguments: &str, steps: usize) -> Child {
        let mut command = self.command(arguments);
        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let start = Instant::now();
        while Series::open(&self.path("a.h5")).map_or(0, |series| series.len()) < steps {
            assert!(start.elapsed() < TIME_LIMIT, "no step is written");
            sleep(Duration::from_millis(5));
        }
        child
    }

    /// The series is there up to some step, each step as in the whole one.
    fn holds_a_beginning(&self, name: &str) -> usize {
        let (whole, part) = (self.content("whole.h5"), self.content(name));
        let len = part.steps.len();
        assert!(part.steps[..] == whole.steps[..len]);
        len
    }
}

/// A run that is killed, again and again, ends with the content of one that was not, and leaves no
/// other file.
#[test]
fn a_killed_run_goes_on() {
    let lab = Lab::grown();
    let (all, start) = (lab.content("whole.h5").steps.len(), Instant::now());
    for steps in [1, 2] {
        loop {
            let mut child = lab.running("solve plate.toml -o a.h5 --resume", steps);
            child.kill().unwrap();
            child.wait().unwrap();
            let len = lab.holds_a_beginning("a.h5");
            assert!(len >= steps);
            if len < all {
                break;
            }
            // on a busy machine a run may end before it is killed
            assert!(start.elapsed() < TIME_LIMIT, "no run is killed before its end");
            fs::remove_file(lab.path("a.h5")).unwrap();
        }
    }
    let told = lab.run("solve plate.toml -o a.h5 --resume");
    assert!(told.contains("growth ended with step 2"), "{told}");
    assert!(lab.content("a.h5") == lab.content("whole.h5"));
    assert_eq!(lab.files(), ["a.h5", "plate.toml", "whole.h5"]);
    let told = lab.run("solve plate.toml -o a.h5 --resume");
    assert!(told.contains("nothing to do"), "{told}");
}

/// The disk is full: the steps so far stay, the error says how many and how to go on, and that is
/// what happens.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_the_steps() {
    let lab = Lab::grown();
    // room for about half of the series, in blocks of 512 bytes
    let blocks = fs::metadata(lab.path("whole.h5")).unwrap().len() / 1024;
    let script = format!("trap '' XFSZ; ulimit -c 0; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_ppum"), "solve", "plate.toml", "-o", "a.h5"]);
    let output = command.current_dir(lab.folder.path()).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{told}");
    let len = lab.holds_a_beginning("a.h5");
    assert!((1..3).contains(&len), "{len}");
    let steps = if len == 1 { "1 step".to_owned() } else { format!("{len} steps") };
    let expected = format!("a.h5 holds {steps}; `ppum solve --resume` goes on from there");
    assert!(told.starts_with("error: ") && told.contains(&expected), "{told}");
    assert!(told.contains("File too large"), "{told}");
    lab.run("solve plate.toml -o a.h5 --resume");
    assert!(lab.content("a.h5") == lab.content("whole.h5"));
    assert_eq!(lab.files(), ["a.h5", "plate.toml", "whole.h5"]);
}

/// Where nothing can be written that is told before any work, and what is there stays.
#[test]
fn what_cannot_be_written_stays() {
    let lab = Lab::grown();
    let bytes = fs::read(lab.path("whole.h5")).unwrap();
    lab.write("plate.toml", &GROWING.replace("steps = 2", "steps = 3"));
    let mut permissions = fs::metadata(lab.path("whole.h5")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(lab.path("whole.h5"), permissions).unwrap();
    for resume in ["", " --resume"] {
        let complaint = lab.fail(&format!("solve plate.toml -o whole.h5{resume}"));
        assert!(complaint.contains("write-protected"), "{complaint}");
        if cfg!(target_os = "linux") {
            // where not even the superuser can make files
            let complaint = lab.fail(&format!("solve plate.toml -o /proc/a.h5{resume}"));
            assert!(complaint.contains("cannot write /proc/a.h5"), "{complaint}");
        }
    }
    assert!(fs::read(lab.path("whole.h5")).unwrap() == bytes);
    assert_eq!(lab.files(), ["plate.toml", "whole.h5"]);
}

/// While one run writes a series, others are refused, and anybody may read it.
#[test]
fn one_run_writes_a_series() {
    let lab = Lab::grown();
    lab.write("long.toml", &GROWING.replace("steps = 2", "steps = 8000").replace("0.05", "1e-5"));
    let mut child = lab.running("solve long.toml -o a.h5", 2);
    for arguments in ["long.toml --resume", "long.toml", "plate.toml"] {
        let complaint = lab.fail(&format!("solve {arguments} -o a.h5"));
        let expected = if arguments == "plate.toml" { "a.h5" } else { "another run" };
        assert!(complaint.contains(expected), "{arguments}: {complaint}");
    }
    assert!(lab.run("info a.h5 --step 1").contains("numbered from 0"));
    assert!(child.try_wait().unwrap().is_none(), "the first run goes on");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(Series::open(&lab.path("a.h5")).unwrap().len() >= 2);
    assert!(lab.files().iter().all(|name| !name.ends_with(".part")));
}

/// The cracks of a series are not those of one problem.
#[test]
fn a_series_does_not_converge() {
    let complaint = Lab::grown().fail("plot whole.h5 --convergence -o c.svg");
    assert!(complaint.contains("grow from step to step"), "{complaint}");
}

/// No step follows from one that has changed since it was written: its checksum is looked at first.
#[test]
fn a_damaged_step_is_not_gone_on_from() {
    let lab = Lab::grown();
    lab.write("plate.toml", &GROWING.replace("steps = 2", "steps = 4"));
    let mut bytes = fs::read(lab.path("whole.h5")).unwrap();
    let last = lab.content("whole.h5").steps.pop().unwrap();
    let way = last.growth.unwrap().tips[0].path[0].x.to_le_bytes();
    let at = bytes.windows(8).rposition(|found| found == way).expect("the way of the tip");
    bytes[at + 2] ^= 1;
    fs::write(lab.path("whole.h5"), &bytes).unwrap();
    let complaint = lab.fail("solve plate.toml -o whole.h5 --resume");
    assert!(complaint.contains("whole.h5") && complaint.contains("checksum"), "{complaint}");
    assert!(fs::read(lab.path("whole.h5")).unwrap() == bytes);
}
