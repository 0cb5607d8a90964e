//! Cracks that grow: angles of kinks, paths, and a series of many steps.

use crate::page::{Page, error};
use crate::series::{course, example, place};
use crate::studies::support::solved;
use ppum::crack::{End, TipId};
use ppum::dataset::{Dataset, Step, TipIntensity, TipStatus};
use ppum::segment::distance;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_format::Series;
use ppum_fracture::growth::kink;
use ppum_problem::{Criterion, Problem};
use std::path::Path;

const CRITERIA: [(&str, &str, Criterion); 3] = [
    ("hoop stress", "hoop", Criterion::Hoop),
    ("local symmetry", "local-symmetry", Criterion::LocalSymmetry),
    ("energy", "energy", Criterion::Energy),
];

const LAST: TipId = TipId { crack: 0, end: End::Last };

/// The heading of what this module writes, to the end of the page.
pub(crate) const HEADING: &str = "## Growing cracks";

pub(crate) fn write(page: &mut Page) -> anyhow::Result<()> {
    page.add(HEADING);
    page.add(
        "`cargo run --release -p ppum-bench --example validation -- growth` computes only this part of the page. It keeps its\n\
         series in `target/growth` and does not compute again what is there.",
    );
    kinks(page);
    first_kink(page)?;
    convergence(page)?;
    holes(page)?;
    beam(page)?;
    network(page)?;
    many_steps(page)
}

/// Angles in degrees for K_I and K_II by the three criteria: roots with 40 digits, of Erdogan &
/// Sih's closed form and of the functions of kinks of Amestoy & Leblond.
const ANGLES: [([f64; 2], [f64; 3]); 4] = [
    ([1.0, 0.1], [-11.202_877_689_339, -11.251_507_101_054, -11.251_357_898_969]),
    ([1.0, 0.5], [-40.207_818_722_034, -42.125_904_144_012, -42.029_397_763_280]),
    ([1.0, 1.0], [-53.130_102_354_156, -56.957_967_292_911, -56.565_422_720_695]),
    ([0.0, 1.0], [-70.528_779_365_509, -77.330_076_636_460, -75.756_597_696_255]),
];

fn kinks(page: &mut Page) {
    page.add("### Angles of kinks");
    page.add(
        "Reference: by hoop stress, the closed form of Erdogan & Sih (1963); by local symmetry and energy, the root of k_II and\n\
         the maximum of k_I² + k_II² of the functions F_ij(θ) of Amestoy & Leblond (1992), found with 40 digits. Angles are in\n\
         degrees, differences absolute.",
    );
    page.head(&["K_I, K_II", "criterion", "reference", "difference"]);
    for (k, angles) in ANGLES {
        for ((name, _, criterion), angle) in CRITERIA.iter().zip(angles) {
            let found =
                kink(*criterion, &TipIntensity::new(LAST, k[0], k[1])).expect("an open crack");
            let [k1, k2] = k;
            let difference = error(found.angle.to_degrees() - angle);
            page.row(&[format!("{k1}, {k2}"), (*name).into(), format!("{angle:.9}"), difference]);
        }
    }
}

/// The edge crack under end shear.
fn shear(criterion: &str, increment: f64, steps: usize) -> anyhow::Result<Vec<Step>> {
    let rule = format!("criterion = \"{criterion}\"\nincrement = {increment}");
    let changes = [("increment = 0.25", &*rule), ("steps = 40", &*format!("steps = {steps}"))];
    let text = example("edge-shear-growth", &changes);
    Ok(course(&format!("shear-{criterion}-{increment}-{steps}"), &text)?.0)
}

fn ratio(step: &Step) -> f64 {
    step.intensities[0].k2 / step.intensities[0].k1
}

fn first_kink(page: &mut Page) -> anyhow::Result<()> {
    page.add("### Sliding behind the first kink");
    page.add(
        "The edge crack under end shear from above, [edge-shear-growth.toml](../examples/edge-shear-growth.toml), with\n\
         K_II = 0.1333 K_I: K_II / K_I at the tips after the first, second and third increment of 0.5.",
    );
    page.head(&["criterion", "first", "second", "third"]);
    for (name, key, _) in CRITERIA {
        let steps = shear(key, 0.5, 4)?;
        let ratios = [1, 2, 3].map(|k| format!("{:.3} %", 100.0 * ratio(&steps[k])));
        page.row(&[vec![name.to_owned()], ratios.to_vec()].concat());
    }
    Ok(())
}

/// Lengths of increments, and their number up to a growth of 2.
const INCREMENTS: [(f64, usize); 5] = [(1.0, 2), (0.5, 4), (0.25, 8), (0.125, 16), (0.0625, 32)];

fn convergence(page: &mut Page) -> anyhow::Result<()> {
    page.add("### Paths as increments are halved");
    page.add(
        "The tip of the same crack when it has grown by 2: its distance to the tip with increments half as long, and in\n\
         parentheses the order between two such distances.",
    );
    let titles = INCREMENTS.map(|(da, _)| da.to_string());
    let titles = titles.windows(2).map(|w| format!("{} to {}", w[0], w[1]));
    let titles: Vec<String> = ["criterion".into()]
        .into_iter()
        .chain(titles)
        .chain(["tip with the last".into()])
        .collect();
    page.head(&titles.iter().map(String::as_str).collect::<Vec<_>>());
    for (name, key, _) in CRITERIA {
        let tips = INCREMENTS.map(|(increment, steps)| {
            anyhow::Ok(shear(key, increment, steps)?[steps].cracks[0].end_point(End::Last))
        });
        let tips = tips.into_iter().collect::<anyhow::Result<Vec<Vec2>>>()?;
        let apart: Vec<f64> = tips.windows(2).map(|w| (w[1] - w[0]).length()).collect();
        let last = tips[tips.len() - 1];
        let last = format!("({:.5}, {:.5})", last.x, last.y);
        page.row(&[vec![name.to_owned()], crate::page::rated(&apart), vec![last]].concat());
    }
    Ok(())
}

fn holes(page: &mut Page) -> anyhow::Result<()> {
    page.add("### Two cracks and two holes");
    let (steps, last) = course("two-holes-growth", &example("two-holes-growth", &[]))?;
    let cracks = &last.steps[0].cracks;
    let [one, other] = [0, 1].map(|k| &cracks[k].points);
    let apart = one.iter().zip(other).map(|(p, q)| (*p + *q).length()).fold(0.0, f64::max);
    let end = one[one.len() - 1];
    page.add(&format!(
        "[two-holes-growth.toml](../examples/two-holes-growth.toml), after Bouchard, Bay & Chastel (2003): the plate is\n\
         symmetric under rotation by 180°. Each crack ends in the hole that it bends towards, after {} increments, one at\n\
         ({:.4}, {:.4}). The vertices of one path and the rotated ones of the other, {} each, differ by {} at most.",
        steps.len() - 1, end.x, end.y, one.len(), error(apart)
    ));
    page.picture("two-holes-growth", &last, last.domain.bounds)
}

/// A crack in the beam, how it is computed, and how far it goes.
struct Beam {
    /// Place and length of the crack.
    start: [f64; 2],
    order: usize,
    increment: f64,
    growth: f64,
}

const fn beam_from(start: [f64; 2], order: usize, increment: f64, growth: f64) -> Beam {
    Beam { start, order, increment, growth }
}

const BEAMS: [Beam; 5] = [
    beam_from([-5.0, 1.5], 3, 0.1, 3.8),
    beam_from([-5.0, 1.5], 3, 0.05, 3.8),
    beam_from([-5.0, 1.5], 4, 0.1, 3.8),
    beam_from([-6.0, 1.0], 3, 0.1, 4.2),
    beam_from([-6.0, 1.0], 3, 0.05, 4.2),
];

fn beam(page: &mut Page) -> anyhow::Result<()> {
    page.add("### Beam with three holes");
    page.add(BEAM);
    page.head(&[
        "start",
        "order",
        "increment",
        "x at y = −1.25",
        "x at y = −0.25",
        "x at y = 0.75",
        "nearest to the lowest rim",
        "to the middle one",
        "end",
    ]);
    let mut pictures = Vec::new();
    for beam in &BEAMS {
        let Beam { start: [x, a], order, increment, .. } = *beam;
        let (steps, last) = beam.course()?;
        let row = [format!("x = {x}, a = {a}"), order.to_string(), increment.to_string()];
        page.row(&[row.to_vec(), told(&steps)].concat());
        if order == 3 && increment == 0.1 {
            pictures.push((x, last));
        }
    }
    beam_factors(page);
    let window = Rect::new(vec2(-6.5, -4.0), vec2(-2.5, 4.0));
    pictures.iter().try_for_each(|(x, last)| page.picture(&format!("beam{x}"), last, window))
}

impl Beam {
    fn course(&self) -> anyhow::Result<(Vec<Step>, Dataset)> {
        let Self { start: [x, a], order, increment, growth } = *self;
        let crack = format!("points = [[{x:.1}, -4.0], [{x:.1}, {:.1}]]", a - 4.0);
        let changes = [
            (CRACK, crack),
            ("order = 3", format!("order = {order}")),
            ("increment = 0.1", format!("increment = {increment}")),
            ("steps = 60", format!("steps = {:.0}", growth / increment)),
        ];
        let changes = changes.each_ref().map(|(from, to)| (*from, to.as_str()));
        course(&format!("beam{x}-{order}-{increment}"), &example("beam-three-holes", &changes))
    }
}

/// The crack of the example.
const CRACK: &str = "points = [[-6.0, -4.0], [-6.0, -3.0]]";

const BEAM: &str = "\
[beam-three-holes.toml](../examples/beam-three-holes.toml), after Bittencourt, Wawrzynek, Ingraffea & Sousa (1996), and\n\
the same beam with a crack of length 1.5 at x = −5. In the published drawings, which have no numbers, the crack from x =\n\
−5 passes close to the lowest hole and ends in the middle one. So does the crack from x = −6, which passes the lowest\n\
hole at a distance. Here the crack from x = −6 agrees; the one from x = −5 passes as close to the lowest hole, but then\n\
passes the middle one on its right, at a distance of 0.2, with either order and increment. Another program gives the\n\
same factors there, see below the table. Forces at points in place of pressures 0.2 wide move the path from x = −6 by\n\
1e-4 at most; supports that hold the border change the first direction by 0.1°. Distances to rims are those of the\n\
whole path; 0 means that it ends there.";

/// The factors of the path from x = −5 at its 23rd increment, replaced by nine segments: hp finite
/// elements of order 6.
const SEGMENTS: &str = "points = [[-5.0, -4.0], [-5.0, -2.5], [-4.875135, -2.102985], [-4.742807, -1.742777], [-4.615927, -1.453226], \
    [-4.468577, -1.211223], [-4.330932, -1.074302], [-4.176629, -0.986961], [-3.971441, -0.61711], [-3.939385, -0.539702]]";
const FACTORS: [f64; 2] = [1.178_498_27, 0.005_559_64];

/// Factors on the way from the lowest hole to the middle one, beside those of another program.
fn beam_factors(page: &mut Page) {
    let text = example("beam-three-holes", &[(CRACK, SEGMENTS)]);
    let text = text.split("[growth]").next().unwrap_or_default();
    let problem = Problem::parse(text, "beam", Path::new(".")).expect("a problem");
    let tip = solved(&problem).steps[0].intensities[0].clone();
    page.add(&format!(
        "The crack from x = −5 along nine segments that follow its path to ({:.3}, {:.3}), between the two holes, has\n\
         K_I = {:.5} and K_II = {:.5}; hp finite elements that follow crack and holes (`tests/random`, order 6) give\n\
         {:.5} and {:.5}.",
        -3.939, -0.540, tip.k1, tip.k2, FACTORS[0], FACTORS[1]
    ));
}

/// Where a path passes heights and holes, and where it ends.
fn told(steps: &[Step]) -> Vec<String> {
    let points = &steps[steps.len() - 1].cracks[0].points;
    let segments = || points.windows(2).map(|w| [w[0], w[1]]);
    let passed = |y: f64| {
        let found = segments().find(|[p, q]| p.y <= y && y < q.y);
        found.map_or("–".into(), |[p, q]| {
            format!("{:.4}", p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y))
        })
    };
    let rim = |y: f64| {
        let near = segments().map(|s| distance(s, vec2(-4.0, y))).fold(f64::INFINITY, f64::min);
        if near - 0.25 < 1e-9 { "0".into() } else { format!("{:.4}", near - 0.25) }
    };
    let fates = steps.iter().filter_map(|step| step.growth.as_ref()?.tips.first());
    let met = fates
        .map(|row| row.fate)
        .find(|fate| matches!(fate, TipStatus::MeetsHole(_) | TipStatus::LeavesBody));
    let end = met.map_or("goes on upwards".into(), |fate| match fate {
        TipStatus::MeetsHole(0) => "upper hole".into(),
        TipStatus::MeetsHole(1) => "middle hole".into(),
        TipStatus::MeetsHole(_) => "lowest hole".into(),
        other => other.words(),
    });
    vec![passed(-1.25), passed(-0.25), passed(0.75), rim(-1.25), rim(0.75), end]
}

fn network(page: &mut Page) -> anyhow::Result<()> {
    page.add("### A network");
    let (steps, last) = course("network-growth", &example("network-growth", &[]))?;
    let fates: Vec<TipStatus> = steps
        .iter()
        .filter_map(|step| step.growth.as_ref())
        .flat_map(|g| g.tips.iter().map(|row| row.fate))
        .collect();
    let count = |of: fn(&TipStatus) -> bool| fates.iter().filter(|fate| of(fate)).count();
    let length = |step: &Step| step.cracks.iter().map(ppum::crack::Crack::length).sum::<f64>();
    let stop = last.steps[0].growth.as_ref().and_then(|growth| growth.stop);
    page.add(&format!(
        "[network-growth.toml](../examples/network-growth.toml): ten cracks with a total length of {:.2} grow to {:.2} in {}\n\
         increments; {} ends meet other cracks, {} leave the plate. The series ends because {}.",
        length(&steps[0]), length(&last.steps[0]), steps.len() - 1,
        count(|fate| matches!(fate, TipStatus::MeetsCrack(_))),
        count(|fate| *fate == TipStatus::LeavesBody),
        stop.map_or("all increments are made", |stop| stop.words()),
    ));
    page.picture("network-growth", &last, last.domain.bounds)
}

/// Increments of the long series.
const MANY: usize = 100;

fn many_steps(page: &mut Page) -> anyhow::Result<()> {
    page.add("### A hundred increments");
    let text = example(
        "edge-shear-growth",
        &[("increment = 0.25", "increment = 0.025"), ("steps = 40", &format!("steps = {MANY}"))],
    );
    let _ = std::fs::remove_file(place("many-steps"));
    let mut memory = Vec::new();
    let mut sizes = Vec::new();
    let path = place("many-steps");
    // step by step, as runs that are interrupted after each
    for n in 0..=MANY / 10 {
        let part =
            text.replace(&format!("steps = {MANY}"), &format!("steps = {}", (10 * n).max(1)));
        course("many-steps", &part)?;
        sizes.push((Series::open(&path)?.len(), std::fs::metadata(&path)?.len()));
        memory.push(resident());
    }
    let (steps, _) = course("many-steps", &text)?;
    let k: Vec<f64> = steps.iter().map(|step| step.intensities[0].k1).collect();
    let jump = (KINK..k.len() - 2).map(|i| departure(&k, i)).fold(0.0, f64::max);
    let worst = steps[1..].iter().map(|step| ratio(step).abs()).fold(0.0, f64::max);
    page.add(&format!(
        "The edge crack under end shear grows by 2.5 in increments of 0.025, a fortieth of a cell. K_I grows from {:.3} to\n\
         {:.3}; |K_II| / K_I is {} at most. From the fifth value on, K_I departs by at most {} of it from the cubic\n\
         through the two values before and the two after it. A jump would show with at least half its size.",
        k[0], k[MANY], error(worst), error(jump)
    ));
    page.head(&[
        "steps in the file",
        "bytes",
        "bytes a step since the row before",
        "memory of the process, MB",
    ]);
    let mut before = (0, 0);
    for ((n, bytes), memory) in sizes.into_iter().zip(memory) {
        let each = (bytes - before.1) / (n - before.0).max(1) as u64;
        page.row(&[
            n.to_string(),
            bytes.to_string(),
            each.to_string(),
            memory.map_or("–".into(), |mb| format!("{mb:.0}")),
        ]);
        before = (n, bytes);
    }
    Ok(())
}

/// The first step that is compared with those around it: behind the kink K_I is no smooth function
/// of the length.
const KINK: usize = 5;

/// |K − cubic through its four neighbours| / K.
fn departure(k: &[f64], i: usize) -> f64 {
    let cubic = (4.0 * (k[i - 1] + k[i + 1]) - k[i - 2] - k[i + 2]) / 6.0;
    (k[i] / cubic - 1.0).abs()
}

/// Memory of this process that is in use, in MB, where the system tells it.
fn resident() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kb| kb / 1024.0)
}
