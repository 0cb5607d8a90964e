//! scratch
use ppum::field::Field;
use ppum::formula::Formula;
use ppum::jet::Jet;
use ppum_solve::norms::norms;
use ppum_solve::problem::*;
use ppum_solve::solve::solve;
use ppum_solve::space::Space;
use std::time::Instant;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let base = Problem::read(std::path::Path::new(&args[1])).unwrap_or_else(|e| panic!("{e}"));
    let order: usize = args[2].parse().unwrap();
    let levels: Vec<u32> = args[3].split(',').map(|s| s.parse().unwrap()).collect();
    let without: Vec<usize> =
        args.get(4).map_or(vec![], |s| s.split(',').filter_map(|s| s.parse().ok()).collect());
    let mut last: Option<(f64, f64)> = None;
    for level in levels {
        let mut p = base.clone();
        p.discretization.cells = match p.discretization.cells {
            Cells::Grid([a, b]) => Cells::Grid([a << level, b << level]),
            _ => Cells::Level(level),
        };
        if order > 0 {
            p.discretization.order = Order::Uniform(order);
        }
        let mut k = 0;
        p.enrichments.retain(|_| {
            k += 1;
            !without.contains(&(k - 1))
        });
        if let Ok(d) = std::env::var("DEG") {
            for e in &mut p.enrichments {
                if e.degree.is_some() {
                    e.degree = Some(d.parse().unwrap())
                }
            }
        }
        let start = Instant::now();
        let d = match solve(&p, &mut |_| {}) {
            Ok(d) => d,
            Err(e) => {
                println!("level {level}: {e}");
                continue;
            }
        };
        let t = start.elapsed().as_secs_f64();
        let jets: Vec<[Formula; 3]> = p
            .exact
            .iter()
            .map(|e| {
                let f = e.formula();
                [f.clone(), f.derivative("x").unwrap(), f.derivative("y").unwrap()]
            })
            .collect();
        let exact = |a: ppum::vec2::Vec2, o: ppum::vec2::Vec2| {
            let q = a + o;
            let jet = |k: usize| {
                jets.get(k).map_or(Jet::constant(0.0), |f| {
                    let [v, x, y] = f.each_ref().map(|f| f.evaluate(&[q.x, q.y]));
                    Jet { x, y, ..Jet::constant(v) }
                })
            };
            [jet(0), jet(1)]
        };
        let space = Space::new(&d.steps[0], &d.equation, &d.tables).unwrap();
        let field = Field::new(&d, 0).unwrap();
        if std::env::var("COUNT").is_ok() {
            let q = space.quadrature(0);
            let t0 = Instant::now();
            let mut n = 0;
            let mut most = 0;
            for (c, cell) in space.partition.cell.iter().enumerate() {
                let m: usize =
                    q.cell(cell, &space.coverers[c]).iter().map(|r| r.offsets.len()).sum();
                n += m;
                most = most.max(m);
            }
            println!(
                "   points {n} in {} cells, most {most}, rules made in {:.3} s",
                space.partition.len(),
                t0.elapsed().as_secs_f64()
            );
        }
        let start = Instant::now();
        let [_, r, e] = norms(&field, &space, &exact);
        let tn = start.elapsed().as_secs_f64();
        let (en, l2) = e.relative_to(&r);
        let rec =
            |n: &str| d.steps[0].history.iter().find(|r| r.name == n).map_or(f64::NAN, |r| r.value);
        let rate = last.map_or(String::new(), |(a, b)| {
            format!("rates {:.2} {:.2}", (a / en).log2(), (b / l2).log2())
        });
        println!(
            "level {level}: unknowns {} cut {} res {:.1e}  energy {en:.4e}  L2 {l2:.4e} {rate}   [{t:.2}s basis {:.2} assembly {:.2} sol {:.2}, norms {tn:.2}s] ref {:.8e}",
            rec("unknowns"),
            rec("cut-off"),
            rec("residual"),
            rec("basis"),
            rec("assembly"),
            rec("solution"),
            r.energy
        );
        last = Some((en, l2));
    }
}
