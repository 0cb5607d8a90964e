//! The corpus of fields on the CPU, scalar and in vectors, by gathering and by splatting.

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum_gpu::{Method, Renderer, Scene, Values};
use ppum_render::reference::reference;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_testkit::fields::{self, Differences, DrawingCase, Truth};

use crate::{OUTLIERS, SINGLE, close, good, quantity, renderer_or_skip, values, view};

/// Double precision likewise.
const DOUBLE: f64 = 1e-11;
/// Of von Mises stress in deep views, 99th percentile of the relative error.
const RELATIVE: f64 = 1e-5;
/// Largest share of pixels that may lie in the band.
const MOST_IN_BAND: f64 = 0.02;

/// An evaluator of pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Evaluator {
    Scalar,
    Double,
    Single,
    Gpu(Method),
}

use Evaluator::{Double, Gpu, Scalar, Single};

const ALL: [Evaluator; 5] = [Scalar, Double, Single, Gpu(Method::Gather), Gpu(Method::Splat)];
/// Index of splatting among them.
const SPLATTING: usize = 4;

/// A scene and its programs, where there is a graphics device.
struct OnCard<'r, 'f> {
    renderer: &'r mut Renderer,
    scene: Scene<'f>,
}

#[derive(Debug, Default)]
struct Worst {
    scaled: [f64; 5],
    /// Pixels, and those in the band.
    pixels: [usize; 2],
}

/// Draws the cases by all evaluators and compares with the truth. Compiling is what takes time:
/// only the first quantity of a case is splatted.
fn agree(group: &str, cases: &[DrawingCase], check: impl Fn(&str, Evaluator, &Differences)) {
    let mut renderer = renderer_or_skip();
    let mut worst = Worst::default();
    for case in cases {
        let field = good(Field::new(&case.dataset, 0));
        let truths: Vec<_> = case.windows.iter().map(|&w| Truth::new(&field, w)).collect();
        let mut card = renderer.as_mut().map(|renderer| OnCard::new(renderer, &field));
        for (k, text) in case.quantities.iter().enumerate() {
            let evaluators = if k == 0 { &ALL[..] } else { &ALL[..SPLATTING] };
            let quantity = quantity(text, &field);
            for (index, &evaluator) in evaluators.iter().enumerate() {
                let mut draw = drawing(evaluator, &field, &quantity, card.as_mut());
                for (window, truth) in case.windows.iter().zip(&truths) {
                    let Some(found) = draw(&view(window)) else { continue };
                    let found = truth.expected(&quantity).compare(found.into_iter());
                    worst.note(index, &found);
                    check(
                        &format!("{}: {text}, {evaluator:?} {window:?}", case.name),
                        evaluator,
                        &found,
                    );
                }
            }
        }
    }
    let band = worst.pixels[1] as f64 / worst.pixels[0] as f64;
    println!("{group}: largest differences {:?} of {ALL:?}; {band:.4} left out", worst.scaled);
    assert!(band < MOST_IN_BAND, "{band} of the pixels are left out");
}

/// Draws the values of a view, row by row from the top.
type Draw<'a> = Box<dyn FnMut(&View) -> Option<Vec<f64>> + 'a>;

/// The function by which an evaluator draws a view; it gives nothing if there is no device.
fn drawing<'a>(
    evaluator: Evaluator,
    field: &'a Field<'a>,
    quantity: &'a Quantity,
    card: Option<&'a mut OnCard<'_, '_>>,
) -> Draw<'a> {
    match (evaluator, card) {
        (Scalar, _) => {
            Box::new(|view| Some(values(&good(reference(field, view, quantity, unwatched())))))
        }
        (Double, _) => {
            Box::new(|view| Some(values(&good(render::<f64>(field, view, quantity, unwatched())))))
        }
        (Single, _) => {
            Box::new(|view| Some(values(&good(render::<f32>(field, view, quantity, unwatched())))))
        }
        (Gpu(_), None) => Box::new(|_| None),
        (Gpu(method), Some(OnCard { renderer, scene })) => {
            let mut program = good(renderer.compile(scene, Values(quantity.clone()), method));
            Box::new(move |view| {
                let drawn = good(renderer.draw(&mut program, view));
                Some(values(&good(drawn.read())))
            })
        }
    }
}

impl<'r, 'f> OnCard<'r, 'f> {
    fn new(renderer: &'r mut Renderer, field: &'f Field<'f>) -> Self {
        let scene = good(renderer.upload(field));
        Self { renderer, scene }
    }
}

impl Worst {
    fn note(&mut self, evaluator: usize, found: &Differences) {
        for k in 0..2 {
            self.pixels[k] += found.pixels[k];
        }
        self.scaled[evaluator] = self.scaled[evaluator].max(found.worst);
    }
}

/// All values within the tolerance, none where there is none.
fn within(what: &str, evaluator: Evaluator, found: &Differences) {
    let (most, worst) = match evaluator {
        Gpu(method) => return close(what, method, found),
        Scalar => (0.0, 0.0),
        Double => (DOUBLE, DOUBLE),
        Single => (SINGLE, SINGLE * OUTLIERS),
    };
    assert_eq!(found.strange, 0, "{what}: {found:?}");
    assert!(found.most <= most && found.worst <= worst, "{what}: {found:?}");
}

#[test]
fn covers_and_weights() {
    agree("covers and weights", &fields::coverings(), within);
}

#[test]
fn functions_cracks_and_components() {
    agree("functions, cracks, components", &fields::functions(), within);
}

#[test]
fn equations_and_quantities() {
    agree("equations and quantities", &fields::equations(), within);
}

#[test]
fn windows_of_all_kinds() {
    agree("windows", &fields::wholes(), within);
}

#[test]
fn cracks_that_meet() {
    agree("cracks that meet", &fields::junctions(), within);
}

#[test]
fn zooms() {
    deep("zooms", fields::zooms());
}

#[test]
fn zooms_to_arcs() {
    deep("zooms to arcs", fields::arc_zooms());
}

#[test]
fn zooms_to_junctions() {
    deep("zooms to junctions", fields::junction_zooms());
}

fn deep(group: &str, case: DrawingCase) {
    agree(group, &[case], |what, evaluator, found| {
        within(what, evaluator, found);
        let stress = what.contains("von-mises");
        assert!(!stress || found.relative <= RELATIVE, "{what}: {found:?}");
    });
}
