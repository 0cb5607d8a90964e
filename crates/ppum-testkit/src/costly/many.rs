//! Many of a thing.

use super::{CostlyCase, displacement, middle, piled, plate, straight, with_functions};
use ppum::crack::{Crack, CrackEnd, End, SegmentId, TipId, tips};
use ppum::dataset::{Attribute, Dataset, Ring, TipIntensity};
use ppum::domain::Hole;
use ppum::function::{Cut, Frame, Function, FunctionKind, Part, WESTERGAARD};
use ppum::vec2::{Vec2, vec2};

pub(super) const ALL: &[CostlyCase] = &[
    ("blocks", Some("coefficients"), blocks),
    ("blocks-of-one", Some("at a point"), blocks_of_one),
    ("patches", None, patches),
    ("patches-piled", Some("at a point"), patches_piled),
    ("patches-columns", Some("center"), patches_columns),
    ("components", Some("components"), components),
    ("fields", None, fields),
    ("steps", None, steps),
    ("attributes", None, attributes),
    ("functions", None, functions),
    ("functions-of-a-point", Some("at a point"), functions_of_a_point),
    ("cracks", None, cracks),
    ("cracks-crossing", None, cracks_crossing),
    ("crack-of-vertices", None, crack_of_vertices),
    ("sides-of-vertices", Some("at a point"), sides_of_vertices),
    ("junctions", None, junctions),
    ("cuts", Some("at a point"), cuts),
    ("tips-in-cells", None, tips_in_cells),
    ("rings", Some("rings"), rings),
    ("rings-of-tips", Some("rings"), rings_of_tips),
    ("intensities", None, intensities),
    ("holes", None, holes),
    ("polygon", None, polygon),
];

/// Blocks that share their coefficients.
fn blocks() -> Dataset {
    let mut dataset = plate(1, 8, middle());
    let (n, field) = (1_500_000, &mut dataset.steps[0].fields[0]);
    field.patch_blocks = vec![0, n as u32];
    field.block_function = vec![0; n];
    field.block_degree = vec![8; n];
    field.block_offset = vec![0; n];
    dataset
}

/// Blocks of one patch, each with its coefficients.
fn blocks_of_one() -> Dataset {
    let mut dataset = plate(1, 0, middle());
    dataset.steps[0].fields = vec![displacement(&[vec![(0, 0); 600_000]])];
    dataset
}

/// As many patches as fit into a file.
fn patches() -> Dataset {
    plate(256, 0, middle())
}

/// Patches that all cover everything.
fn patches_piled() -> Dataset {
    let mut dataset = plate(1, 0, middle());
    let n = 1 << 17;
    dataset.steps[0].partition = piled(n).into();
    dataset.steps[0].fields = vec![displacement(&vec![vec![(0, 0)]; n])];
    dataset
}

/// Patches as thin rows and thin columns: each meets all of the other kind, but a point has a few.
fn patches_columns() -> Dataset {
    let mut dataset = plate(1, 0, middle());
    let n = 1 << 16;
    let partition = dataset.steps[0].partition.boxes_mut().expect("boxes");
    *partition = piled(2 * n);
    for k in 0..n {
        let at = (k as f64 + 0.5) / n as f64;
        (partition.center[k], partition.half[k]) = (vec2(0.5, at), vec2(1.0, 1.0 / n as f64));
        (partition.center[n + k], partition.half[n + k]) =
            (vec2(at, 0.5), vec2(1.0 / n as f64, 1.0));
    }
    dataset.steps[0].fields = vec![displacement(&vec![vec![(0, 0)]; 2 * n])];
    dataset
}

/// Components of a field that is no displacement.
fn components() -> Dataset {
    let mut dataset = plate(8, 0, Vec::new());
    let n = 20_000;
    let field = &mut dataset.steps[0].fields[0];
    field.name = "values".into();
    field.components = (0..n).map(|k| format!("v{k}")).collect();
    field.coefficients = vec![field.coefficients[0].clone(); n];
    dataset
}

/// Fields of a step.
fn fields() -> Dataset {
    let mut dataset = plate(1, 0, Vec::new());
    let step = &mut dataset.steps[0];
    let field = step.fields[0].clone();
    for k in 0..50 {
        step.fields.push(field.clone());
        step.fields[k + 1].name = format!("field {k}");
    }
    dataset
}

/// Steps.
fn steps() -> Dataset {
    let mut dataset = plate(4, 1, middle());
    dataset.steps = vec![dataset.steps[0].clone(); 12];
    dataset
}

/// Values of patches.
fn attributes() -> Dataset {
    let mut dataset = plate(8, 0, middle());
    let attribute = |k| Attribute { name: format!("a{k}"), values: vec![1.0; 64] };
    dataset.steps[0].attributes = (0..10_000).map(attribute).collect();
    dataset
}

fn side(crack: u32) -> Function {
    Function { name: format!("side {crack}"), kind: FunctionKind::Side { crack } }
}

/// Functions of which each patch of many has one of its own.
fn functions() -> Dataset {
    let mut dataset = plate(64, 0, row(64));
    let step = &mut dataset.steps[0];
    step.functions.extend((0..4096).map(side));
    let own = |k: u32| vec![(0, 0), (k + 1, 0)];
    let blocks: Vec<_> = (0..step.partition.len() as u32).map(own).collect();
    step.fields = vec![displacement(&blocks)];
    dataset
}

/// Functions that one patch has.
fn functions_of_a_point() -> Dataset {
    let mut dataset = plate(1, 0, row(64));
    dataset.steps[0].functions.extend((0..4096).map(side));
    let all = (0..4096).map(|k| (k + 1, 0)).collect();
    dataset.steps[0].fields = vec![displacement(&[all])];
    dataset
}

/// Cracks in rows and columns, `n` of them a row.
fn row(n: u32) -> Vec<Crack> {
    let width = 1.0 / f64::from(n);
    let at = |k: u32| vec2((f64::from(k % n) + 0.25) * width, (f64::from(k / n) + 0.5) * width);
    (0..n * n).map(|k| straight(at(k), 0.5 * width)).collect()
}

/// Cracks, each with two tips, on few cells.
fn cracks() -> Dataset {
    plate(32, 1, row(64))
}

/// Cracks across the whole plate, each of which is near every tip's cell.
fn cracks_crossing() -> Dataset {
    let crack = |k: u32| {
        let y = 0.125 + 0.75 * f64::from(k) / 8192.0;
        Crack { points: vec![vec2(0.125, y), vec2(0.875, 1.0 - y)], ends: [CrackEnd::Tip; 2] }
    };
    plate(128, 0, (0..8192).map(crack).collect())
}

/// A crack that goes forth and back many times.
fn zigzag(n: u32, y: f64) -> Crack {
    let at = |k: u32| vec2(0.25 + 0.5 * f64::from(k) / f64::from(n), y + f64::from(k % 2) / 128.0);
    Crack { points: (0..=n).map(at).collect(), ends: [CrackEnd::Tip; 2] }
}

fn tip_functions(cracks: &[Crack]) -> Vec<Function> {
    let of = |tip: TipId| {
        WESTERGAARD.map(|text| {
            let kind = FunctionKind::formula(text, Frame::Tip(tip));
            Function { name: format!("tip {}", tip.crack), kind }
        })
    };
    tips(cracks).flat_map(of).collect()
}

/// One crack of thousands of vertices, with the functions of a solver everywhere.
fn crack_of_vertices() -> Dataset {
    let crack = zigzag(1 << 13, 0.375);
    let mut functions = vec![Function { name: "one".into(), kind: FunctionKind::One }, side(0)];
    functions.extend(tip_functions(std::slice::from_ref(&crack)));
    with_functions(plate(8, 1, vec![crack]), functions)
}

/// Cracks of many vertices whose sides are all asked for at each point.
fn sides_of_vertices() -> Dataset {
    let forth_and_back = |k: u32| vec2(0.25 + 0.5 * f64::from(k % 2), 0.375);
    let crack =
        Crack { points: (0..20_000).map(forth_and_back).collect(), ends: [CrackEnd::Tip; 2] };
    with_functions(plate(2, 1, vec![crack; 64]), (0..64).map(side).collect())
}

/// Cracks that cross in every patch, each of which has functions of three of its four components:
/// 1,200 of them.
fn junctions() -> Dataset {
    const N: u32 = 20;
    let through =
        |from: Vec2, to: Vec2| Crack { points: vec![from, to], ends: [CrackEnd::Mouth; 2] };
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(N);
    let level = (0..N).map(|k| through(vec2(-0.5, at(k)), vec2(1.5, at(k) + 0.001)));
    let upright = (0..N).map(|k| through(vec2(at(k), -0.5), vec2(at(k) + 0.001, 1.5)));
    let mut dataset = plate(N, 1, level.chain(upright).collect());
    let step = &mut dataset.steps[0];
    let mut blocks = Vec::new();
    for (patch, at) in step.partition.boxes().center.iter().enumerate() {
        let [column, row] = [at.x, at.y].map(|v| (v * f64::from(N)) as u32);
        let first = step.functions.len() as u32;
        step.functions.extend((1..4).map(|k| Function {
            name: format!("component {k} of patch {patch}"),
            kind: FunctionKind::Component { cuts: quadrant(k, row, N + column) },
        }));
        blocks.push(vec![(0, 1), (first, 1), (first + 1, 1), (first + 2, 1)]);
    }
    step.fields = vec![displacement(&blocks)];
    dataset
}

/// A component of two straight cracks that cross.
fn quadrant(k: u32, a: u32, b: u32) -> Vec<Cut> {
    let cut = |crack: u32, is_left: bool, part: Part| {
        let segment = SegmentId { crack, segment: 0 };
        let [left, right] = if is_left { [part, Part::Outside] } else { [Part::Outside, part] };
        Cut { segment, left, right }
    };
    vec![cut(a, k & 1 == 0, Part::Cut(1)), cut(b, k & 2 == 0, Part::Inside)]
}

/// A component whose tree is one long branch.
fn cuts() -> Dataset {
    const N: u32 = 1 << 18;
    let segment = SegmentId { crack: 0, segment: 0 };
    let cut = |k: u32| Cut { segment, left: Part::Outside, right: Part::Cut(k + 1) };
    let last = Cut { segment, left: Part::Inside, right: Part::Outside };
    let cuts = (0..N - 1).map(cut).chain([last]).collect();
    let function = Function { name: "component".into(), kind: FunctionKind::Component { cuts } };
    with_functions(plate(2, 1, middle()), vec![function])
}

/// Tips whose discs hold all cells.
fn tips_in_cells() -> Dataset {
    plate(128, 0, vec![straight(vec2(-0.5, 0.5), 1.0); 8192])
}

fn with_rings(n: usize) -> TipIntensity {
    let ring = |k: usize| Ring { r1: 0.0, r2: 1.0 + k as f64, k1: 1.0, k2: 0.0 };
    let tip = TipId { crack: 0, end: End::Start };
    TipIntensity { rings: (0..n).map(ring).collect(), ..TipIntensity::new(tip, 1.0, 0.0) }
}

/// Rings of one tip.
fn rings() -> Dataset {
    let mut dataset = plate(4, 1, middle());
    dataset.steps[0].intensities = vec![with_rings(300_000)];
    dataset
}

/// Rings of many tips.
fn rings_of_tips() -> Dataset {
    let mut dataset = plate(4, 1, row(24));
    let tip = |tip| TipIntensity { tip, ..with_rings(200) };
    dataset.steps[0].intensities = tips(&dataset.steps[0].cracks).map(tip).collect();
    dataset
}

/// Factors of many tips.
fn intensities() -> Dataset {
    let mut dataset = plate(4, 1, row(48));
    let tip = |tip| TipIntensity { tip, ..with_rings(2) };
    dataset.steps[0].intensities = tips(&dataset.steps[0].cracks).map(tip).collect();
    dataset
}

/// Holes that lie over each other, and cells beside them.
fn holes() -> Dataset {
    let mut dataset = plate(64, 0, middle());
    let hole = |_| Hole::Circle { center: vec2(0.5, 0.875), radius: 0.25 };
    dataset.domain.holes = (0..1 << 14).map(hole).collect();
    dataset
}

/// A hole with many corners.
fn polygon() -> Dataset {
    let mut dataset = plate(64, 0, middle());
    let comb = |k: u32| vec2(f64::from(k) / f64::from(1 << 14), 0.5 + 0.25 * f64::from(k % 2));
    let mut points: Vec<_> = (0..(1 << 14) - 2).map(comb).collect();
    points.extend([vec2(1.0, 0.875), vec2(0.0, 0.875)]);
    dataset.domain.holes = vec![Hole::polygon(points)];
    dataset
}
