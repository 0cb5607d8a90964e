//! Estimated errors, accuracies that are asked for, and covers that adapt.

use crate::page::{Page, error};
use crate::studies::adapted::{
    CRACK, SQUARE_HOLE, corner, course, crack, line, on, set, square_hole,
};
use crate::studies::factors::{errors_of_factors, plates};
use crate::studies::plates::Plate;
use crate::studies::support::solved;
use anyhow::Context as _;
use ppum_figure::form::PageFormat;
use ppum_figure::plot::{CurveStyle, Plot, PlotAxis, PlotCurve, plot};
use ppum_problem::{AdaptKind, Adaptivity, BaseCells, ProblemData};

/// The output of `tests/random/estimates.py`.
const ESTIMATES: &str = include_str!("../../../../tests/random/estimates.md");

pub(crate) fn write(page: &mut Page) -> anyhow::Result<()> {
    estimates(page);
    accuracies(page);
    courses(page)
}

/// The least, the median and the largest.
fn spread(mut all: Vec<f64>) -> [f64; 3] {
    all.sort_by(f64::total_cmp);
    let last = all.len().saturating_sub(1);
    [0, last / 2, last].map(|k| all.get(k).copied().unwrap_or(f64::NAN))
}

fn estimates(page: &mut Page) {
    page.add("## Estimated errors of K");
    page.add(ESTIMATES.trim_end());
}

fn accuracies(page: &mut Page) {
    page.add("## Requested accuracies of K");
    page.add(
        "`accuracy` in `[discretization]`, from level 2, all else by default: the largest error of the tips of each plate over\n\
         the requested accuracy, and the unknowns. Where references have six digits, errors at 1e-6 are those of the references.",
    );
    let asked = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
    let titles = asked.map(|accuracy| format!("{accuracy:.0e}"));
    let titles: Vec<&str> =
        std::iter::once("plate").chain(titles.iter().map(String::as_str)).collect();
    page.head(&titles);
    let mut parts = Vec::new();
    for plate in plates() {
        let cells = asked.map(|accuracy| {
            let (part, unknowns) = reached(&plate, accuracy);
            parts.push(part);
            format!("{part:.2}, {unknowns}")
        });
        page.row(&[vec![plate.name.clone()], cells.to_vec()].concat());
    }
    let good = parts.iter().filter(|part| **part <= 1.0).count();
    let [_, median, worst] = spread(parts.clone());
    page.add(&format!(
        "{good} of {} were reached; the median is {median:.2} of the requested accuracy, the largest {worst:.2}.",
        parts.len()
    ));
}

/// The largest error over the accuracy, and the unknowns it took.
fn reached(plate: &Plate, accuracy: f64) -> (f64, usize) {
    let mut problem = plate.problem.clone().with_adaptivity(Adaptivity::to(accuracy));
    problem.discretization.cells = BaseCells::Level(2);
    let dataset = solved(&problem);
    let errors = errors_of_factors(plate, &dataset).into_iter().map(|[size, e, _]| e / size);
    (errors.fold(0.0, f64::max) / accuracy, dataset.steps[0].unknowns())
}

/// A problem that adapts: its name, the first order, its strain energy if that is what tells
/// the error.
type Case = (&'static str, fn() -> ProblemData, usize, Option<f64>);

const CASES: [Case; 3] = [
    ("corner of 270°", corner, 1, None),
    ("square hole", square_hole, 2, Some(SQUARE_HOLE)),
    ("crack", crack, 2, Some(CRACK)),
];

fn courses(page: &mut Page) -> anyhow::Result<()> {
    page.add("## Covers that adapt");
    page.add(
        "Errors in the energy norm of a potential r^⅔ sin ⅔θ around a corner of 270°, of a plate with a square hole, and of one\n\
         with a crack.\n\
         h: the exponent of the error in unknowns, to be p/2. hp: c and the correlation of ln(error) = a − c N^⅓, steps of more than a\n\
         sixth of the last one's unknowns; straight lines in the picture, which shows the relative errors.",
    );
    page.head(&[
        "problem",
        "h, p = 1",
        "h, p = 2",
        "h, p = 3",
        "hp: c",
        "correlation",
        "last step of hp",
    ]);
    let mut curves = Vec::new();
    for (name, problem, order, energy) in CASES {
        let run = |kind, order, most: usize| {
            let mut set = set(kind, 40, most);
            set.fraction = if kind == AdaptKind::Hp { 0.5 } else { set.fraction };
            course(&solved(&on(problem(), order, set)), energy)
        };
        let rate = |order: usize| {
            let points = run(AdaptKind::H, order, 15_000);
            format!("{:.2}", -line(&logarithms(&points, f64::ln, 0.1))[0])
        };
        let rates: Vec<String> = (1..=3).map(rate).collect();
        let points = run(AdaptKind::Hp, order, 10_000);
        let [slope, correlation] = line(&logarithms(&points, f64::cbrt, 1.0 / 6.0));
        let last =
            points.last().map(|[n, e, _]| format!("{} at {n}", error(*e))).unwrap_or_default();
        let hp = [format!("{:.2}", -slope), format!("{correlation:.3}"), last];
        page.row(&[vec![name.to_owned()], rates, hp.to_vec()].concat());
        curves.push(curve(format!("{name}, hp"), &points, CurveStyle::Dotted));
        curves.push(curve(
            format!("{name}, h, p = 2"),
            &run(AdaptKind::H, 2, 15_000),
            CurveStyle::Dashed,
        ));
    }
    draw(page, curves)
}

/// Errors by a measure of the unknowns, from a part of the last step's on.
fn logarithms(points: &[[f64; 3]], of: fn(f64) -> f64, part: f64) -> Vec<[f64; 2]> {
    let least = points.last().map_or(0.0, |[n, ..]| part * n);
    let late = points.iter().filter(|[n, ..]| *n >= least);
    late.map(|[n, error, _]| [of(*n), error.ln()]).collect()
}

fn curve(label: String, points: &[[f64; 3]], look: CurveStyle) -> PlotCurve {
    let points = points.iter().map(|[n, error, _]| [n.cbrt(), *error]).collect();
    PlotCurve::new(label, points).with_look(look)
}

fn draw(page: &mut Page, curves: Vec<PlotCurve>) -> anyhow::Result<()> {
    let picture = Plot {
        x: PlotAxis::new("cube root of the number of unknowns", ""),
        y: PlotAxis::new("error in the energy norm", "").logarithmic(),
        curves,
        ..Plot::default()
    };
    let path = page.image("adaptive.png");
    let bytes = PageFormat::of(&path).bytes(&plot(&picture, [900, 600]), None, &[])?;
    std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    page.add("![Errors of adaptive covers over the cube root of the unknowns](images/validation/adaptive.png)");
    Ok(())
}
