//! Errors of solutions of one problem, against their unknowns.

use ppum::dataset::{Dataset, Equation, Step};
use ppum::field::Field;
use ppum::formula::{Formula, FormulaJets, Scope};
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use ppum_figure::plot::{CurveStyle, Plot, PlotAxis, PlotCurve, slope, with_slope};

use ppum_solve::norms::norms;
use ppum_solve::space::TrialSpace;

use super::{NamedDataset, PlotError};

/// A curve for each error: those of the exact solution if all datasets have them, else the
/// distances of energy and stress intensity factors from those of the dataset with most unknowns.
/// For a single dataset, all steps are compared.
///
/// # Errors
/// Fewer than three solutions of different sizes; solutions of several problems.
pub fn convergence(datasets: &[NamedDataset<'_>], step: Option<usize>) -> Result<Plot, PlotError> {
    let mut solutions = match datasets {
        [NamedDataset { dataset, .. }] if dataset.steps.len() >= 3 && step.is_none() => {
            all_steps(dataset)
        }
        _ => one_step_each(datasets, step)?,
    };
    of_one_problem(datasets)?;
    solutions.sort_by(|a, b| unknowns(a.step).total_cmp(&unknowns(b.step)));
    let mut sizes: Vec<f64> = solutions.iter().map(|solution| unknowns(solution.step)).collect();
    sizes.dedup();
    if sizes.len() < 3 {
        return Err(PlotError::FewSizes(sizes));
    }
    let mut curves = exact(&solutions)?;
    if curves.is_empty() {
        curves = distances(&solutions.iter().map(|solution| solution.step).collect::<Vec<_>>());
    }
    if curves.is_empty() {
        return Err(PlotError::Incomparable);
    }
    let mut plot = Plot {
        x: PlotAxis::new("unknowns", "").logarithmic(),
        y: PlotAxis::new("relative error", "").logarithmic(),
        ..Plot::default()
    };
    plot.title.clone_from(&datasets[0].dataset.title);
    plot.curves = curves;
    Ok(plot)
}

/// The history of an adaptation: the estimated error of each step that the dataset keeps, in the
/// energy norm and of K, relative, against its unknowns. None of a dataset with fewer than two such
/// steps, or whose cracks grow.
#[must_use]
pub fn adaptation(dataset: &Dataset) -> Option<Plot> {
    let steps = &dataset.steps;
    if steps.windows(2).any(|pair| pair[0].cracks != pair[1].cracks) {
        return None;
    }
    let of = |label: &str, record: &str| {
        let point = |step: &Step| Some([unknowns(step), step.record(record).filter(|v| *v > 0.0)?]);
        let points: Vec<_> = steps.iter().filter_map(point).collect();
        (points.len() > 1).then(|| curve(label, points))
    };
    let kinds = [("energy", "estimated error"), ("K", "estimated error of factors")];
    let curves: Vec<_> = kinds.into_iter().filter_map(|(label, name)| of(label, name)).collect();
    (!curves.is_empty()).then(|| Plot {
        x: PlotAxis::new("unknowns", "").logarithmic(),
        y: PlotAxis::new("estimated error", "").logarithmic(),
        curves,
        ..Plot::default()
    })
}

/// The steps of an adaptation.
fn all_steps(dataset: &Dataset) -> Vec<DatasetStep<'_>> {
    let steps = dataset.steps.iter().enumerate();
    steps.map(|(index, step)| DatasetStep { dataset, index, step }).collect()
}

/// One step of each dataset, the last one unless another is asked for.
fn one_step_each<'d>(
    datasets: &[NamedDataset<'d>],
    step: Option<usize>,
) -> Result<Vec<DatasetStep<'d>>, PlotError> {
    if datasets.len() < 3 {
        return Err(PlotError::FewDatasets);
    }
    let one = |&NamedDataset { name, dataset }: &NamedDataset<'d>| {
        let index = step.unwrap_or(dataset.steps.len().saturating_sub(1));
        let found = dataset.steps.get(index).map(|step| DatasetStep { dataset, index, step });
        found.ok_or_else(|| PlotError::Step { name: name.to_owned(), step: index })
    };
    datasets.iter().map(one).collect()
}

/// Datasets of different problems have no common solution that they could come near.
fn of_one_problem(datasets: &[NamedDataset<'_>]) -> Result<(), PlotError> {
    for NamedDataset { name, dataset } in datasets {
        if dataset.steps.windows(2).any(|pair| pair[0].cracks != pair[1].cracks) {
            return Err(PlotError::Grown((*name).to_owned()));
        }
    }
    let [NamedDataset { name, dataset: first }, others @ ..] = datasets else { return Ok(()) };
    for NamedDataset { name: other, dataset } in others {
        let cracks = |dataset: &Dataset| dataset.steps.first().map(|step| step.cracks.clone());
        let what = match () {
            () if dataset.equation != first.equation => "the equation or the material",
            () if dataset.domain != first.domain => "the plate",
            () if cracks(dataset) != cracks(first) => "the cracks",
            () if exact_texts(dataset) != exact_texts(first) => "the exact solution",
            () => continue,
        };
        let [first, other] = [name, other].map(|name| (*name).to_owned());
        return Err(PlotError::OtherProblem { first, other, what });
    }
    Ok(())
}

/// The exact solutions of a dataset's fields.
fn exact_texts(dataset: &Dataset) -> Vec<&[String]> {
    let fields = dataset.steps.first().map_or(&[][..], |step| &step.fields);
    fields.iter().map(|field| field.exact.as_slice()).collect()
}

fn unknowns(step: &Step) -> f64 {
    step.unknowns() as f64
}

/// A step of a dataset.
struct DatasetStep<'d> {
    dataset: &'d Dataset,
    index: usize,
    step: &'d Step,
}

/// Relative errors in the energy norm and in L² where all exact solutions are known.
fn exact(solutions: &[DatasetStep<'_>]) -> Result<Vec<PlotCurve>, PlotError> {
    let mut points = [Vec::new(), Vec::new()];
    for solution in solutions {
        let Some(errors) = errors(solution)? else { return Ok(Vec::new()) };
        for (points, error) in points.iter_mut().zip(errors) {
            points.push([unknowns(solution.step), error]);
        }
    }
    let [energy, l2] = points;
    Ok(vec![curve("energy norm", energy), curve("L² norm", l2)])
}

/// Errors relative to the exact solution, in the energy norm and in L²; none if it, or the
/// equation, is not known.
fn errors(
    DatasetStep { dataset, index, step }: &DatasetStep<'_>,
) -> Result<Option<[f64; 2]>, PlotError> {
    let field = Field::new(dataset, *index).map_err(PlotError::of)?;
    if !field.has_exact() || dataset.equation == Equation::None {
        return Ok(None);
    }
    let scope = Scope::cartesian().with_tables(&dataset.tables).map_err(PlotError::of)?;
    let parse = |text: &String| Formula::parse(text, &scope);
    let formulas = field.data.exact.iter().map(parse).collect::<Result<Vec<_>, _>>();
    let formulas = formulas.map_err(PlotError::of)?;
    let jets = FormulaJets::new(&formulas.iter().collect::<Vec<_>>(), 1).map_err(PlotError::of)?;
    let exact = |anchor: Vec2, offset: Vec2| {
        let (p, mut out) = (anchor + offset, vec![0.0; 3 * formulas.len()]);
        jets.evaluate(&[p.x, p.y], &mut Vec::new(), &mut out);
        let jet = |d: &[f64]| Jet { x: d[1], y: d[2], ..Jet::constant(d[0]) };
        let mut both = [Jet::constant(0.0); 2];
        both.iter_mut().zip(out.chunks(3)).for_each(|(jet_of, d)| *jet_of = jet(d));
        both
    };
    field.on_cells("norms of errors").map_err(PlotError::of)?;
    let space = TrialSpace::new(step, &dataset.domain, &dataset.equation, &dataset.tables);
    let space = space.map_err(PlotError::of)?;
    let [_, reference, difference] = norms(&field, &space, &exact);
    let (energy, l2) = difference.relative_to(&reference);
    Ok(Some([energy, l2]))
}

/// Distances from the last step's numbers.
fn distances(steps: &[&Step]) -> Vec<PlotCurve> {
    let Some((last, others)) = steps.split_last() else { return Vec::new() };
    let mut curves = Vec::new();
    let mut add = |label: &str, value: &dyn Fn(&Step) -> Option<f64>| {
        let Some(reference) = value(last).filter(|v| *v != 0.0) else { return };
        let point = |step: &&Step| Some([unknowns(step), (value(step)? / reference - 1.0).abs()]);
        if let Some(points) = others.iter().map(point).collect::<Option<Vec<_>>>() {
            curves.push(curve(label, points));
        }
    };
    add("energy", &|step| step.record("energy"));
    let number = last.intensities.len();
    for tip in 0..number {
        let label = if number > 1 { format!("K_{{I}} of tip {tip}") } else { "K_{I}".into() };
        add(&label, &|step| step.intensities.get(tip).map(|found| found.k1));
    }
    curves
}

/// A curve with dots, and the exponent of its power law.
fn curve(label: &str, points: Vec<[f64; 2]>) -> PlotCurve {
    let text = match slope(&points) {
        Some(slope) => with_slope(label, slope, 2),
        None => label.to_owned(),
    };
    PlotCurve::new(text, points).with_look(CurveStyle::Dotted)
}
