//! Grows the cracks of a problem file and prints the tips of each step.
use ppum::progress::unwatched;
use ppum_solve::growth::grow;
use ppum_solve::problem::Problem;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("a problem file")?;
    let problem = Problem::read(Path::new(&path))?;
    let (mut number, start) = (0, Instant::now());
    grow(&problem, None, None, unwatched(), |dataset| -> Result<(), std::convert::Infallible> {
        let step = &dataset.steps[0];
        let growth = step.growth.as_ref().expect("growth");
        println!("step {number}: {:.2} s, load {:.6}, cycles {:?}, unknowns {} {:?}", start.elapsed().as_secs_f64(), step.load, growth.cycles, step.unknowns(), growth.stop.map(|s| s.words()));
        for row in &growth.tips {
            let at = step.cracks[row.tip.crack as usize].end_point(row.tip.end);
            let k = step.intensities.iter().find(|k| k.tip == row.tip);
            let (k1, k2, err) = k.map_or((f64::NAN, f64::NAN, f64::NAN), |k| (k.k1, k.k2, k.error.unwrap_or(f64::NAN)));
            println!("  {}{} ({:.7}, {:.7}) K {k1:.5} {k2:.6} err {:.0e} ratio {:+.5} dir {:.4}° curv {:+.5} len {:.4} {}", row.tip.crack, row.tip.end.name(), at.x, at.y, err / k1, k2 / k1, row.direction.to_degrees(), row.curvature, row.length, row.fate.words());
        }
        for w in &step.warnings { println!("    warning {}: {}", w.kind, w.message); }
        number += 1;
        Ok(())
    }).map_err(|e| e.to_string())?;
    Ok(())
}
