//! One sheet a benchmark: reference, source, our values on three covers, errors, an image.

use crate::page::{Page, error};
use crate::studies::exact_fields::{SLIT_SQUARES, TipPlate, slit_plate, tip_energies, tip_points};
use crate::studies::plates::{
    Plate, centre_cracks, collinear_cracks, edge_cracks, end_shear, end_shear_at, kinked_in_plane,
    slanted_cracks, stacked_cracks,
};
use crate::studies::support::{solved, squares, unknowns};
use ppum::vec2::{Rect, vec2};

/// The references of finite plates.
const PLATES: &str = "complex potentials, least squares on the border, two independent programs; they agree with \
    the handbook of Tada, Paris & Irwin (2000) where that has the plate";

pub(crate) fn write(page: &mut Page) -> anyhow::Result<()> {
    tip_field(page)?;
    finite_plates().into_iter().try_for_each(|each| sheet(page, &each))?;
    infinite_plane().into_iter().try_for_each(|each| sheet(page, &each))?;
    laplace(page)
}

fn finite_plates() -> Vec<Sheet> {
    vec![
        Sheet {
            title: "Centre crack, ends pulled",
            name: "centre-crack",
            reference: "width 2W, height 2H, crack of length 2a, unit traction on bottom and top, sides free.",
            source: PLATES,
            shown: 5,
            window: [[-1.0, -1.0], [1.0, 1.0]],
            plates: centre_cracks(),
        },
        Sheet {
            title: "Single edge crack, ends pulled",
            name: "edge-crack",
            reference: "width W, height 2H, crack of length a from the left edge; the ends are free to rotate.",
            source: PLATES,
            shown: 4,
            window: [[0.0, -1.0], [1.0, 1.0]],
            plates: edge_cracks(),
        },
        Sheet {
            title: "Slanted centre crack, ends pulled",
            name: "slanted-crack",
            reference: "a/W = 0.5, H/W = 2, crack at an angle to the x axis, load along y.",
            source: PLATES,
            shown: 1,
            window: [[-1.0, -2.0], [1.0, 2.0]],
            plates: slanted_cracks(),
        },
        Sheet {
            title: "Edge crack under end shear",
            name: "end-shear",
            reference: "W = 7, L = 16, a = 3.5 at mid-height, bottom clamped, unit shear traction on top, E = 3·10⁷; K \
                    itself. Published: 34.0 and 4.55. 7, 14 and 28 cells across.",
            source: "complex potentials, least squares on the border, two independent programs",
            shown: 1,
            window: [[0.0, 0.0], [7.0, 16.0]],
            plates: vec![end_shear_at(0.3, [34.042645, 4.536991]), end_shear()],
        },
    ]
}

fn infinite_plane() -> Vec<Sheet> {
    vec![
        Sheet {
            title: "Two collinear cracks in the infinite plane",
            name: "collinear-cracks",
            reference: "half-length a = 0.8, centres at ±1, all-round tension; cut out of the plane by the exact \
                    tractions on [−3, 3] × [−1.5, 1.5].",
            source: "closed form: Erdogan (1962); Tada, Paris & Irwin (2000)",
            shown: 0,
            window: [[-3.0, -1.5], [3.0, 1.5]],
            plates: vec![collinear_cracks()],
        },
        Sheet {
            title: "Two stacked cracks in the infinite plane",
            name: "stacked-cracks",
            reference: "half-length a = 1, distance 2, tension along y; order 3 in a plate of half-width 256 that stands \
                    for the plane; cells of size 1, 1/2 and 1/4 around the cracks, graded outwards.",
            source: "dislocation integral equations in the infinite plane",
            shown: 0,
            window: [[-3.0, -3.0], [3.0, 3.0]],
            plates: vec![stacked_cracks()],
        },
        Sheet {
            title: "Kinked crack in the infinite plane",
            name: "kinked-crack",
            reference: "length 2, then 1 at 15°, tension along y; order 3 in a plate of half-width 512 that stands \
                    for the plane; cells of size 1, 1/2 and 1/4 around the crack, graded outwards. References good to 1e-4; F = K/(σ√π).",
            source: "dislocation integral equations in the infinite plane",
            shown: 0,
            window: [[-2.0, -1.5], [3.0, 1.75]],
            plates: vec![kinked_in_plane()],
        },
    ]
}

/// A benchmark.
struct Sheet {
    title: &'static str,
    name: &'static str,
    reference: &'static str,
    source: &'static str,
    /// The plate of the image, and the window it shows.
    shown: usize,
    window: [[f64; 2]; 2],
    plates: Vec<Plate>,
}

fn sheet(page: &mut Page, sheet: &Sheet) -> anyhow::Result<()> {
    page.add(&format!("## {}", sheet.title));
    page.add(&format!("Reference: {}\nSource: {}.", sheet.reference, sheet.source));
    let mut picture = None;
    page.head(&["plate", "factor", "reference", "coarse", "middle", "fine", "errors", "unknowns"]);
    for (index, plate) in sheet.plates.iter().enumerate() {
        let solved = [0, 1, 2].map(|level| plate.solve(level));
        let unknowns = solved.each_ref().map(|s| unknowns(&s.dataset).to_string()).join(", ");
        for (k, known) in plate.known.iter().enumerate() {
            let values = solved.each_ref().map(|s| s.values[k]);
            let errors = values.map(|v| error(v / known.value - 1.0)).join(", ");
            let reference = (known.value * 1e10).round() / 1e10;
            let start = [plate.name.clone(), known.name.into(), reference.to_string()];
            let values = values.map(|v| format!("{v:.6}"));
            page.row(&[start.to_vec(), values.to_vec(), vec![errors, unknowns.clone()]].concat());
        }
        let [_, middle, _] = solved;
        picture = if index == sheet.shown { Some((middle.dataset, plate)) } else { picture };
    }
    let (mut dataset, plate) = picture.expect("the picture shows one of the plates");
    dataset.title = plate.name.clone();
    let [min, max] = sheet.window.map(|[x, y]| vec2(x, y));
    page.picture(sheet.name, &dataset, Rect::new(min, max))
}

fn tip_field(page: &mut Page) -> anyhow::Result<()> {
    page.add("## The field of a tip");
    page.add(
        "Reference: the singular field of Williams (1957) with K = 1 on [−1, 1]², tip at the centre, given on all edges; \
         every patch enriched, levels 1 to 3.\nSource: closed form; the energies ½∫σ:ε by a one-dimensional integral.",
    );
    page.head(&["value", "reference", "errors at level 1, 2, 3"]);
    let mut shown = None;
    for plate in TipPlate::ALL {
        let solved = [1, 2, 3].map(|level| plate.solve(level));
        for known in tip_energies(&plate).into_iter().chain(tip_points(&plate)) {
            let errors = solved.each_ref().map(|dataset| error(known.error(dataset))).join(", ");
            let name = format!("{}, {}", plate.name(), known.name);
            page.row(&[name, known.value.to_string(), errors]);
        }
        let [_, middle, _] = solved;
        shown.get_or_insert(middle);
    }
    let mut dataset = shown.expect("there are plates");
    dataset.title = "The field of a tip: mode I".into();
    page.picture("tip-field", &dataset, dataset.domain.bounds)
}

fn laplace(page: &mut Page) -> anyhow::Result<()> {
    page.add("## Laplace's equation on a slit square");
    page.add(
        "Reference: u = √r sin(θ/2) on [−1, 1]² with the slit y = 0, x < 0, given on all edges; zone of radius 0.4.\n\
         Source: closed form; the squares of the norms by one-dimensional integrals.",
    );
    page.head(&["norm", "reference", "level 2", "level 3", "level 4", "errors"]);
    let solved = [2, 3, 4].map(|level| solved(&slit_plate(level, 2)));
    let found = solved.each_ref().map(|dataset| <[f64; 2]>::from(squares(dataset)));
    for (k, name) in ["‖∇u‖²", "‖u‖²"].into_iter().enumerate() {
        let values = found.map(|f| f[k]);
        let errors = values.map(|v| error(v / SLIT_SQUARES[k] - 1.0)).join(", ");
        let start = vec![name.into(), format!("{:.12}", SLIT_SQUARES[k])];
        page.row(&[start, values.map(|v| format!("{v:.9}")).to_vec(), vec![errors]].concat());
    }
    let [_, mut middle, _] = solved;
    middle.title = "Laplace's equation on a slit square".into();
    page.picture("slit", &middle, middle.domain.bounds)
}
