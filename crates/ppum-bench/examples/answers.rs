//! The numbers of problem files, a line of JSON each: what is held against independent solutions.
//!
//!     cargo run --release -p ppum-bench --example answers -- examples/edge-shear.toml …
//!
//! `energy`, `unknowns`, quadrature `points`, `reactions` (force and moment of each support) and
//! `seconds`; of each of `tips` its `crack`, `end`, place, `k1`, `k2` and `rings`, each radius, K_I
//! and K_II; of each of `warnings` its `kind`, `value`, `limit`, `at` and `message`. A problem that
//! is refused gives `error`.

use ppum::dataset::{Dataset, Warning};
use ppum::progress::unwatched;
use ppum::vec2::Vec2;
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

fn main() {
    for file in std::env::args().skip(1) {
        let start = Instant::now();
        let mut line = answer(Path::new(&file)).unwrap_or_else(|error| json!({ "error": error }));
        line["file"] = file.into();
        line["seconds"] = start.elapsed().as_secs_f64().into();
        println!("{line}");
    }
}

fn answer(file: &Path) -> Result<Value, String> {
    let problem = Problem::read(file).map_err(|e| e.to_string())?;
    solve(&problem, unwatched()).map(|dataset| numbers(&dataset)).map_err(|e| e.to_string())
}

fn numbers(dataset: &Dataset) -> Value {
    let step = &dataset.steps[0];
    let record = |name: &str| step.history.iter().find(|r| r.name == name).map(|r| r.value);
    let place = |p: Vec2| json!([p.x, p.y]);
    let tip = |t: &ppum::dataset::TipIntensity| {
        let at = step.cracks[t.tip.crack as usize].end_point(t.tip.end);
        let rings: Vec<_> = t.rings.iter().map(|ring| json!([ring.r2, ring.k1, ring.k2])).collect();
        json!({
            "crack": t.tip.crack, "end": t.tip.end.name(), "at": place(at), "k1": t.k1, "k2": t.k2, "rings": rings
        })
    };
    let warning = |w: &Warning| {
        let at = w.at.map(place);
        json!({ "kind": w.kind.to_string(), "value": w.value, "limit": w.limit, "at": at, "message": w.message })
    };
    json!({
        "energy": record("energy"),
        "unknowns": record("unknowns"),
        "points": record("quadrature points"),
        "reactions": step.reactions.iter().map(|r| json!([r.force, r.moment])).collect::<Vec<_>>(),
        "tips": step.intensities.iter().map(tip).collect::<Vec<_>>(),
        "warnings": step.warnings.iter().map(warning).collect::<Vec<_>>(),
    })
}
