//! Files that hands open: datasets of all kinds, problems, sessions, and what is none of these.

use std::path::PathBuf;

use ppum_testkit::costly;
use ppum_testkit::synthetic::{Recipe, growing};

use crate::kit::plate;
use crate::lab::Lab;

/// Datasets that ask for much.
const COSTLY: [&str; 7] =
    ["steps", "attributes", "cracks", "tips-in-cells", "crack-of-vertices", "holes", "fields"];

/// A problem that is solved at once.
const PROBLEM: &str = include_str!("../../../../../examples/centre-crack.toml");

/// Writes them all; the first is a plate.
pub(super) fn written(lab: &Lab, seed: u64) -> Vec<PathBuf> {
    let mut files = vec![lab.write("plate.h5", &plate())];
    for number in 0..3 {
        let mut dataset = Recipe::random(seed * 7 + number).dataset();
        dataset.title = ["", "A title\nof two lines and of a word that is none: ∇²σ 漢字", "x"]
            [number as usize]
            .repeat(1 + 30 * number as usize);
        files.push(lab.write(&format!("made-{number}.h5"), &dataset));
    }
    files.push(
        lab.write("potential.h5", &Recipe { components: 1, ..Recipe::random(seed) }.dataset()),
    );
    files.push(lab.write("growing.h5", &growing(5)));
    for name in COSTLY {
        files.push(lab.write(&format!("{name}.h5"), &costly::named(name)));
    }
    let bytes = std::fs::read(&files[0]).expect("it is there");
    let mut broken = bytes.clone();
    broken.iter_mut().skip(3000).step_by(97).for_each(|byte| *byte ^= 0x55);
    let problem = PROBLEM.replace("level = 6", "level = 2");
    let texts: [(&str, &[u8]); 9] = [
        ("broken.h5", b"no dataset"),
        ("half.h5", &bytes[..bytes.len() / 2]),
        ("flipped.h5", &broken),
        ("problem.toml", problem.as_bytes()),
        ("wrong.toml", b"[domain\n"),
        ("letters.toml", "title = \"漢字 🔥 \u{202e}\"\n\u{0}[cover]\nlevel = 99999999\n".as_bytes()),
        ("session.ppum-session", b"{\"ppum-session\":1,\"panes\":[{\"file\":\"plate.h5\"},{\"file\":\"growing.h5\"},{}],\"active\":7}"),
        ("wrong.ppum-session", b"{\"ppum-session\":99}"),
        ("empty", b""),
    ];
    for (name, text) in texts {
        files.push(lab.path(name));
        std::fs::write(lab.path(name), text).expect("it can be written");
    }
    files.extend([lab.path("gone.h5"), lab.folder.path().to_owned()]);
    files
}
