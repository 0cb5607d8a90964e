//! Errors are told in one line, on standard error, with an exit status.

use std::process::Stdio;

use crate::{CRACKED, LINEAR, Lab};

#[test]
fn files_that_are_not_there_or_not_datasets() {
    let lab = Lab::new();
    lab.write("text.h5", "not HDF5 at all, but long enough to be looked at");
    for command in ["info", "sif", "probe --at 0,0", "render -o a.png"] {
        let missing = lab.fail(&format!("{command} missing.h5"));
        assert_eq!(missing.matches("missing.h5").count(), 1, "{missing}");
        assert_eq!(missing.lines().count(), 1, "{missing}");
        let wrong = lab.fail(&format!("{command} text.h5"));
        assert!(wrong.contains("text.h5: not a readable HDF5 file"), "{wrong}");
    }
    let missing = lab.fail("solve missing.toml");
    assert!(missing.starts_with("error: missing.toml: cannot read"), "{missing}");
    assert_eq!(lab.files(), ["text.h5"]);
}

/// The bytes of a dataset that need not obey the rules, its checksum right.
pub(crate) fn unchecked(dataset: &ppum::dataset::Dataset) -> Vec<u8> {
    let mut arrays = ppum_format::Arrays::of(dataset).unwrap();
    arrays.seal();
    arrays.to_bytes().unwrap()
}

#[test]
fn check_lists_all_errors_of_a_dataset() {
    let lab = Lab::solved(CRACKED);
    assert!(lab.run("check plate.h5").contains("plate.h5: no errors"));
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    let step = &mut dataset.steps[0];
    step.load = f64::NAN;
    step.partition.boxes_mut().expect("boxes").half.iter_mut().for_each(|half| *half = *half * 0.5);
    step.fields[0].block_offset[1] = 0;
    std::fs::write(lab.path("bad.h5"), unchecked(&dataset)).unwrap();
    let output = lab.command("check bad.h5").output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!((output.status.code(), told.lines().count()), (Some(1), 3), "{told}");
    for place in ["steps/0000@load: ", "partition/half: ", "fields/0000/block_offset[1]: "] {
        assert!(told.contains(place), "{place}: {told}");
    }
    let first = lab.fail("info bad.h5");
    assert!(first.contains("@load") && first.contains("`ppum check bad.h5` lists all"), "{first}");
    assert_eq!(lab.command("check missing.h5").output().unwrap().status.code(), Some(1));
}

#[test]
fn quantities_of_other_programs_are_answered_by_ours() {
    let lab = Lab::solved(CRACKED);
    for (foreign, own) in [
        ("mises", "von-mises"),
        ("S11", "sxx"),
        ("SEQV", "von-mises"),
        ("sigma_xx", "sxx"),
        ("stress_xy", "sxy"),
        ("U1", "ux"),
    ] {
        for command in ["probe plate.h5 --at 0,0", "render plate.h5 -o a.png"] {
            let complaint = lab.fail(&format!("{command} -q {foreign}"));
            assert!(complaint.contains(&format!("did you mean `{own}`?")), "{complaint}");
        }
    }
    // a field without temperature has no such quantity
    let complaint = lab.fail("probe plate.h5 --at 0,0 -q NT11");
    assert!(!complaint.contains("did you mean"), "{complaint}");
}

#[test]
fn unknown_quantities_list_the_known() {
    let lab = Lab::solved(CRACKED);
    for command in ["probe plate.h5 --at 0,0 -q mises", "render plate.h5 -o a.png -q mises"] {
        let complaint = lab.fail(command);
        assert!(complaint.contains("`mises`"), "{complaint}");
        for known in ["von-mises", "ux", "dux_dy", "weight-sum", "phi:N"] {
            assert!(complaint.contains(known), "{known}: {complaint}");
        }
    }
    assert!(
        lab.fail("probe plate.h5 --at 0,0 -q error")
            .contains("; give it as [exact] in the problem file")
    );
    assert!(lab.fail("probe plate.h5 --at 0,0 -q phi:99999").contains("no patch 99999"));
    let lab = Lab::solved(LINEAR);
    assert!(!lab.fail("probe plate.h5 --at 0,0 -q sxx").contains("von-mises"));
}

#[test]
fn arguments_that_are_not_what_they_should_be() {
    let lab = Lab::solved(CRACKED);
    for (arguments, hint) in [
        ("probe plate.h5", "--at"),
        ("probe plate.h5 --at 1", "X,Y"),
        ("probe plate.h5 --at nan,0", "finite"),
        ("probe plate.h5 --at 0,0 --step 1", "there is no step 1"),
        ("render plate.h5", "--output"),
        ("render plate.h5 -o a.jpg", ".png"),
        ("render plate.h5 -o a.png --size 10", "WIDTHxHEIGHT"),
        ("render plate.h5 -o a.png --size 0x10", "0x10"),
        ("render plate.h5 -o a.png --size 90000x90000", "90000"),
        ("render plate.h5 -o a.png --figure --size 100x100", "leaves no room"),
        ("render plate.h5 -o a.png --colormap jet", "turbo"),
        ("render plate.h5 -o a.png --range 2,1", "smaller number first"),
        ("render plate.h5 -o a.png --scale log --range 0,1", "logarithmic"),
        ("render plate.h5 -o a.png --range wide", "P%,Q%"),
        ("render plate.h5 -o a.png --range 98%,2%", "smaller one first"),
        ("render plate.h5 -o a.png --range 60%", "below 50%"),
        ("render plate.h5 -o a.png --scale square", "symlog"),
        ("render plate.h5 -o a.png --overlay dots", "patches"),
        ("render plate.h5 -o a.png --view 0,0,0,1", "no area"),
        ("render plate.h5 -o a.png --center 0,0", "--width"),
        ("render plate.h5 -o a.png --center 0,0 --width 0", "above zero"),
        ("render plate.h5 -o a.png --center 0,0 --width 1 --tip 0", "cannot be used with"),
        ("render plate.h5 -o a.png --tip 2", "2 tips"),
        ("render plate.h5 -o a.png --tip 0 --zoom 1e30", "double precision"),
        ("render plate.h5 -o a.png --backend gpu --precision f64", "use backend cpu"),
        ("render plate.h5 -o a.png --backend splat --precision f64", "single precision"),
        ("render plate.h5 -o a.png --backend card", "splat"),
        ("info", "--gpu"),
        ("info --gpu plate.h5", "cannot be used with"),
        ("render plate.h5 -o nowhere/a.png", "nowhere"),
        ("sample plate.h5", "--line"),
        ("sample plate.h5 --line 0,0,1", "X0,Y0,X1,Y1"),
        ("sample plate.h5 --line 0,0,0,0", "equal"),
        ("sample plate.h5 --line 0,0,1,0 --count 1", "two points"),
        ("sample plate.h5 --line 0,0,1,0 --grid 2x2", "cannot be used with"),
        ("sample plate.h5 --grid 100000x100000", "at most"),
        ("sample plate.h5 --grid 0x5", "no points"),
        ("sample plate.h5 --crack 1", "1 crack,"),
        ("sample plate.h5 --points plate.toml", "plate.toml:"),
        ("sample plate.h5 --points none.csv", "none.csv"),
        ("sample plate.h5 --crack 0 -q ux,ux", "two columns"),
        ("sample plate.h5 --crack 0 -o a.txt", ".npy"),
        ("sample plate.h5 --crack 0 -o nowhere/a.csv", "nowhere"),
        ("paint plate.h5", "paint"),
        ("", "Usage"),
    ] {
        let output = lab.command(arguments).output().unwrap();
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert!(matches!(output.status.code(), Some(1 | 2)), "ppum {arguments}: {complaint}");
        assert!(complaint.contains(hint), "ppum {arguments}: {complaint}");
        assert!(output.stdout.is_empty());
    }
    assert_eq!(lab.files(), ["plate.h5", "plate.toml"], "nothing half done is left");
}

/// The error points at the place in the formula, line by line.
#[test]
fn formulas_that_are_wrong() {
    let lab = Lab::solved(CRACKED);
    lab.write("slip.txt", "# of the faces\n  sqrt(ux^2 + uz^2)\n");
    for command in ["probe plate.h5 --at 0,0", "render plate.h5 -o a.png"] {
        assert_eq!(
            lab.fail_with(command, &["-q", "sqrt(ux^2 + uz^2)"]),
            "error: line 1, column 13: unknown name `uz`; did you mean `ux`?\n\
             error:   sqrt(ux^2 + uz^2)\n\
             error:               ^^\n"
        );
        let from_file = lab.fail_with(command, &["-q", "@slip.txt"]);
        assert!(
            from_file.starts_with("error: slip.txt: line 2, column 15: unknown"),
            "{from_file}"
        );
        assert!(lab.fail_with(command, &["-q", "@slop.txt"]).contains("cannot read slop.txt"));
    }
}

/// A reader that goes away is no reason to panic.
#[test]
fn closed_pipes() {
    let lab = Lab::solved(CRACKED);
    let mut command = lab.command("info plate.h5 --json");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_printed_are_a_failure() {
    let lab = Lab::solved(CRACKED);
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = lab.command("sif plate.h5").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: "));
}

#[test]
fn help_goes_to_standard_output() {
    let lab = Lab::new();
    for command in ["", "demo", "solve", "info", "sif", "probe", "sample", "render", "formula"] {
        let text = lab.run(&format!("{command} --help"));
        assert!(text.contains("Examples:"), "{command}: {text}");
    }
    assert!(lab.run("--version").starts_with("ppum "));
}
