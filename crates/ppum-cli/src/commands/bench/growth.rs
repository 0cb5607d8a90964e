//! How the solver's time grows with the unknowns.

use std::io::Write;
use std::path::Path;

use ppum_figure::plot::{Curve, Look, Plot, PlotAxis, plot, slope, with_slope};
use serde::Serialize;

use super::solver::Run;
use crate::output::Output;
use crate::page;

/// Size of the picture.
const SIZE: [u32; 2] = [900, 600];

/// The line t = a + b n nearest to the times of some numbers of unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Fit {
    /// The time of no unknowns, and of each one.
    seconds: f64,
    seconds_per_unknown: f64,
    /// Largest distance of a time from the line, as a part of the time.
    largest_deviation: f64,
    /// The exponent of the power law that is nearest in logarithms.
    exponent: f64,
}

/// The fits of all that a solution takes and of its phase `solution`.
#[derive(Debug, Serialize)]
pub(super) struct Fits {
    all: Fit,
    solution: Fit,
}

impl Fit {
    /// The least sum of squared deviations, each as a part of its time. None of fewer than three numbers of unknowns, which a
    /// line would meet anyhow.
    fn new(points: &[[f64; 2]]) -> Option<Self> {
        let mut sizes: Vec<f64> = points.iter().map(|p| p[0]).collect();
        sizes.dedup();
        if sizes.len() < 3 || points.iter().any(|p| p[1] <= 0.0) {
            return None;
        }
        // Σ w (a + b n − t) = 0 and Σ w n (a + b n − t) = 0 with w = 1/t²
        let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p[0], p[1])).sum::<f64>();
        let (w, wn, wnn) =
            (sum(&|_, t| 1.0 / (t * t)), sum(&|n, t| n / (t * t)), sum(&|n, t| n * n / (t * t)));
        let (wt, wnt) = (sum(&|_, t| 1.0 / t), sum(&|n, t| n / t));
        let determinant = w * wnn - wn * wn;
        let seconds = (wt * wnn - wnt * wn) / determinant;
        let seconds_per_unknown = (w * wnt - wn * wt) / determinant;
        let off = |p: &[f64; 2]| ((seconds + seconds_per_unknown * p[0]) / p[1] - 1.0).abs();
        let largest_deviation = points.iter().map(off).fold(0.0, f64::max);
        Some(Self { seconds, seconds_per_unknown, largest_deviation, exponent: slope(points)? })
    }

    fn words(&self) -> String {
        let Self { seconds, seconds_per_unknown, largest_deviation, exponent } = self;
        let sign = if *seconds < 0.0 { '−' } else { '+' };
        format!(
            "{:.2} µs an unknown {sign} {:.2} s, off by {:.0} % at most; exponent {exponent:.2}",
            1e6 * seconds_per_unknown,
            seconds.abs(),
            100.0 * largest_deviation
        )
    }
}

fn points(runs: &[Run], seconds: fn(&Run) -> f64) -> Vec<[f64; 2]> {
    runs.iter().map(|run| [run.unknowns as f64, seconds(run)]).collect()
}

impl Fits {
    pub(super) fn new(runs: &[Run]) -> Option<Self> {
        let all = Fit::new(&points(runs, |run| run.seconds))?;
        Some(Self { all, solution: Fit::new(&points(runs, Run::solution))? })
    }
}

/// A line for each level, and the fits.
pub(super) fn print(runs: &[Run], fits: Option<&Fits>, out: &mut dyn Write) -> anyhow::Result<()> {
    if runs.len() < 2 {
        return Ok(());
    }
    writeln!(
        out,
        "\nlevel   unknowns  solver      steps  solution [s]  in all [s]  solver [MB]  bytes/unknown"
    )?;
    for run in runs {
        let Run { level, unknowns, kind, iterations, bytes, seconds, .. } = run;
        let steps = iterations.map_or_else(|| "–".into(), |n| n.to_string());
        let bytes = bytes.unwrap_or(f64::NAN);
        let (mega, each) = (1e-6 * bytes, bytes / *unknowns as f64);
        let (kind, solution) = (kind.unwrap_or("–"), run.solution());
        writeln!(
            out,
            "{level:>5} {unknowns:>10}  {kind:<10} {steps:>6} {solution:>13.2} {seconds:>11.2} {mega:>12.1} {each:>14.0}"
        )?;
    }
    if let Some(Fits { all, solution }) = fits {
        writeln!(out, "in all    {}\nsolution  {}", all.words(), solution.words())?;
    }
    Ok(())
}

/// Times against unknowns, on logarithmic axes; the line that is fitted to all phases is dashed. Nothing is told beside JSON.
pub(super) fn picture(
    (runs, fits): (&[Run], Option<&Fits>),
    path: &Path,
    is_silent: bool,
    out: &mut Output,
) -> anyhow::Result<()> {
    let curve = |name: &str, points: Vec<[f64; 2]>| {
        let name = slope(&points).map_or_else(|| name.to_owned(), |p| with_slope(name, p, 2));
        Curve::new(name, points).with_look(Look::Dotted)
    };
    let mut curves = vec![
        curve("all phases", points(runs, |run| run.seconds)),
        curve("linear solver", points(runs, Run::solution)),
    ];
    if let Some(Fits { all, .. }) = fits {
        let line = |run: &Run| {
            let n = run.unknowns as f64;
            [n, all.seconds + all.seconds_per_unknown * n]
        };
        let name = format!("{:.1} µs an unknown", 1e6 * all.seconds_per_unknown);
        curves.push(Curve::new(name, runs.iter().map(line).collect()).with_look(Look::Dashed));
    }
    let drawn = Plot {
        title: "Centre crack, order 2".into(),
        x: PlotAxis::new("unknowns", "").logarithmic(),
        y: PlotAxis::new("time", "s").logarithmic(),
        curves,
    };
    let texts = [("Software".to_owned(), concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned())];
    let page = plot(&drawn, SIZE);
    if is_silent {
        return page::put(path, &page, None, &texts, out);
    }
    page::save(path, &page, None, &texts, "times against unknowns", out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times on a line, and off it by known parts.
    #[test]
    fn lines_are_found() {
        let line = |n: f64| 0.25 + 2e-5 * n;
        let exact: Vec<[f64; 2]> = [1e4, 4e4, 16e4, 64e4].map(|n| [n, line(n)]).into();
        let fit = Fit::new(&exact).expect("a line");
        assert!(
            (fit.seconds - 0.25).abs() < 1e-12 && (fit.seconds_per_unknown - 2e-5).abs() < 1e-17
        );
        assert!(fit.largest_deviation < 1e-12);
        // a time that grows with the power 3/2 is no line: the exponent tells
        let power: Vec<[f64; 2]> = [1e4, 4e4, 16e4].map(|n: f64| [n, 1e-6 * n.powf(1.5)]).into();
        let fit = Fit::new(&power).expect("a line");
        assert!((fit.exponent - 1.5).abs() < 1e-12 && fit.largest_deviation > 0.1);
        assert_eq!(Fit::new(&exact[..2]), None);
    }
}
