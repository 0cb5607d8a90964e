//! Texts of files are shown, and not obeyed by terminals.

use std::process::Output;

use ppum::dataset::{Dataset, NamedQuantity, Record, Warning};
use ppum::printable::is_printable;

use crate::{CRACKED, Lab, Png};

/// Sets a terminal's title, colours it, turns its text around, and moves about.
const HOSTILE: &str = "a\u{1b}]0;b\u{7}\u{9b}31m\u{202e}c\u{7f}\u{8}\rd\u{2028}e\u{200b}f";

/// The text shown of it.
const SHOWN: &str = r"a\u001b]0;b\u0007\u009b31m\u202ec\u007f\u0008\u000dd\u2028e\u200bf";

/// A dataset all of whose texts for people are hostile.
fn hostile(lab: &Lab) -> Dataset {
    let mut data = ppum_format::read(&lab.path("plate.h5")).unwrap();
    let word = || HOSTILE.to_owned();
    (data.title, data.program) = (word(), word());
    data.quantities.push(NamedQuantity { unit: word(), ..data.quantities[0].clone() });
    data.quantities[1].name = "twice".to_owned();
    let step = &mut data.steps[0];
    for function in &mut step.functions {
        function.name += HOSTILE;
    }
    step.fields[0].name = word();
    step.fields[0].unit = word();
    for attribute in &mut step.attributes {
        attribute.name += HOSTILE;
    }
    step.history.push(Record { name: word(), value: 1.0, unit: word() });
    let warning =
        Warning { kind: word().as_str().into(), at: None, value: 1.0, limit: 0.5, message: word() };
    step.warnings.push(warning);
    data
}

/// Nothing but what is printable, and ends of lines; the texts can be seen if they were to
/// be shown.
fn check(arguments: &str, output: &Output, has_texts: bool) {
    let mut all = String::new();
    for bytes in [&output.stdout, &output.stderr] {
        all += std::str::from_utf8(bytes).unwrap();
    }
    let bad: Vec<_> = all.chars().filter(|c| *c != '\n' && !is_printable(*c)).collect();
    assert!(bad.is_empty(), "{arguments}: {bad:?} in {all:?}");
    assert_eq!(all.contains(r"\u2028e"), has_texts, "{arguments}: {all}");
}

#[test]
fn hostile_texts_are_escaped_by_every_command() {
    let lab = Lab::new();
    let quantity = "[[quantity]]\nname = \"stretch\"\nformula = \"ux\"\n";
    lab.write("plate.toml", &(CRACKED.to_owned() + quantity));
    lab.run("solve plate.toml");
    ppum_format::write(&hostile(&lab), &lab.path("plate.h5")).unwrap();
    let escaped: String = HOSTILE.chars().map(|c| format!("\\u{:04x}", c as u32)).collect();
    lab.write("title.toml", &CRACKED.replace("Small plate", &escaped));
    lab.write("raw.toml", &CRACKED.replace("Small plate", HOSTILE));
    lab.write("key.toml", &format!("{CRACKED}\n[\"{escaped}\"]\n"));
    lab.write("formula.txt", &format!("ux + {HOSTILE}"));
    lab.write("points.csv", &format!("1,2\n{HOSTILE}\n"));
    for (arguments, has_texts) in [
        ("info plate.h5", true),
        ("info plate.h5 --json", true),
        ("sif plate.h5", true),
        ("sif plate.h5 --json", true),
        ("probe plate.h5 --at 0.5,0.5", false),
        ("probe plate.h5 --at 0.5,0.5 --json", false),
        ("probe plate.h5 --at 0.5,0.5 -q @formula.txt", false),
        ("sample plate.h5 --points points.csv", false),
        ("sample plate.h5 --line 0,0,1,1 -q twice -o a.csv", false),
        ("render plate.h5 -o a.png -q twice --size 400x300 --figure --backend cpu", false),
        ("formula twice --of plate.h5", false),
        ("formula @formula.txt", false),
        ("solve title.toml", true),
        ("solve raw.toml", false),
        ("solve key.toml", true),
    ] {
        check(arguments, &lab.command(arguments).output().unwrap(), has_texts);
    }
    let picture = Png::read(&lab.path("a.png"));
    assert_eq!(picture.text("Title"), SHOWN);
    let texts = picture.texts.iter().flat_map(|(_, text)| text.chars());
    assert!(texts.clone().all(is_printable) && texts.count() > 100);
}

/// As in names that a script hands over without a look.
#[test]
fn hostile_arguments_are_escaped() {
    let lab = Lab::solved(CRACKED);
    let missing = format!("{HOSTILE}.h5");
    for (arguments, hostile) in [
        ("info", missing.as_str()),
        ("solve", &missing),
        ("render plate.h5 -o", &missing),
        ("render plate.h5 -o a.png --colormap", HOSTILE),
        ("sif plate.h5", HOSTILE),
        ("", HOSTILE),
        ("probe plate.h5 --at", HOSTILE),
        ("info --gpu", &format!("--{HOSTILE}")),
    ] {
        let output = lab.command(arguments).arg(hostile).output().unwrap();
        check(arguments, &output, true);
        assert!(!output.status.success() && output.stderr.starts_with(b"error: "), "{arguments}");
    }
    assert_eq!(lab.files(), ["plate.h5", "plate.toml"]);
}

/// A table on its way to another program is what it is in a file, byte for byte.
#[test]
fn data_are_not_changed() {
    let lab = Lab::new();
    lab.write(
        "plate.toml",
        &(CRACKED.to_owned() + "[[quantity]]\nname = \"q\"\nformula = \"ux\"\n"),
    );
    lab.run("solve plate.toml");
    let mut data = ppum_format::read(&lab.path("plate.h5")).unwrap();
    data.quantities[0].unit = HOSTILE.to_owned();
    ppum_format::write(&data, &lab.path("plate.h5")).unwrap();
    let told = lab.run("sample plate.h5 --line 0,0,1,1 -q q");
    lab.run("sample plate.h5 --line 0,0,1,1 -q q -o a.csv");
    assert!(told.contains(HOSTILE));
    assert_eq!(told, std::fs::read_to_string(lab.path("a.csv")).unwrap());
}
