//! Plates with independently computed stress intensity factors: complex-potential least squares for
//! finite plates, cross-checked with handbooks; closed forms in the plane.

use super::support::{solved, strain_energy, unknowns};
use ppum::dataset::{Dataset, Material, StressState};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{
    BaseCells, Condition, Discretization, DomainEdge, Expression, PolynomialOrder, ProblemData,
};
use ppum_testkit::exact::CollinearCracks;
use std::f64::consts::PI;

/// A plate whose stress intensity factors are known.
#[derive(Clone, Debug)]
pub(crate) struct Plate {
    /// Its nature.
    pub(crate) name: String,
    /// The problem, on the coarsest of three covers.
    pub(crate) problem: ProblemData,
    /// Its covers.
    covers: Covers,
    /// K is divided by this.
    pub(crate) scale: f64,
    /// The known answers.
    pub(crate) known: Vec<Known>,
}

/// Covers, each with cells half as large as the one before.
#[derive(Clone, Copy, Debug)]
enum Covers {
    /// Grids; the cells of the first one.
    Grid([u32; 2]),
    /// Cells of size 1 in |x|, |y| < 4, of twice the size to twice as far, and so on to the border
    /// of a square plate of this half-width, a power of two.
    Rings(f64),
}

impl Covers {
    fn cells(self, level: u32) -> BaseCells {
        match self {
            Self::Grid(cells) => BaseCells::Grid(cells.map(|n| n << level)),
            Self::Rings(half_width) => {
                let start = (4.0, 0.5f64.powi(level as i32));
                let rings = std::iter::successors(Some(start), |(half, size)| {
                    (*half < half_width).then_some((2.0 * half, 2.0 * size))
                });
                BaseCells::Points(rings.flat_map(|(half, size)| ring(half, size)).collect())
            }
        }
    }
}

/// The centres of the cells of one size: all for the first ring, else those outside half its width.
fn ring(half: f64, size: f64) -> Vec<Vec2> {
    let n = (2.0 * half / size) as u32;
    let at = |k: u32| (f64::from(k) + 0.5) * size - half;
    let all = (0..n * n).map(|k| vec2(at(k % n), at(k / n)));
    let first = half <= 4.0;
    all.filter(|p| first || p.x.abs().max(p.y.abs()) > 0.5 * half).collect()
}

/// A known stress intensity factor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    /// Name.
    pub(crate) name: &'static str,
    /// Tip, as they are numbered in the dataset.
    pub(crate) tip: usize,
    /// 0 for K_I, 1 for K_II.
    pub(crate) mode: usize,
    /// Its value, over the plate's scale.
    pub(crate) value: f64,
}

/// A solution of a plate.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    /// The numbers that [`Plate::known`] names.
    pub(crate) values: Vec<f64>,
    /// The solution.
    pub(crate) dataset: Dataset,
}

impl Plate {
    /// Solves the plate with every cell divided into 2^level × 2^level.
    pub(crate) fn solve(&self, level: u32) -> Solved {
        let mut problem = self.problem.clone();
        problem.discretization.cells = self.covers.cells(level);
        let dataset = solved(&problem);
        let intensities = &dataset.steps[0].intensities;
        let value = |known: &Known| {
            let tip = &intensities[known.tip];
            [tip.k1, tip.k2][known.mode] / self.scale
        };
        let values = self.known.iter().map(value).collect();
        Solved { values, dataset }
    }
}

fn known(name: &'static str, tip: usize, mode: usize, value: f64) -> Known {
    Known { name, tip, mode, value }
}

pub(crate) fn traction(x: Expression, y: Expression) -> Vec<Condition> {
    vec![Condition::Neumann(x), Condition::Neumann(y)]
}

/// A plate under unit tension on bottom and top.
pub(crate) fn pulled(domain: Rect, cells: [u32; 2], cracks: &[&[[f64; 2]]]) -> ProblemData {
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let plate =
        ProblemData::elasticity(domain, material, Discretization::new(BaseCells::Grid(cells)));
    cracks
        .iter()
        .fold(plate, |plate, crack| plate.with_crack(crack))
        .with_boundary(DomainEdge::Bottom, traction(0.0.into(), (-1.0).into()))
        .with_boundary(DomainEdge::Top, traction(0.0.into(), 1.0.into()))
}

/// Strain energy of [`oblique_crack`]: finite elements of order 12 on a mesh graded towards the
/// tips and the corners, good to 2e-9.
const OBLIQUE_ENERGY: f64 = 2.428_931_916;

/// A crack of half-length 0.5 whose slope is 3 : 4 in the middle of [−1, 1]², pulled: the relative
/// error in the energy norm, whose square under loads alone is what the strain energy lacks, and
/// the number of unknowns.
pub(crate) fn oblique_crack(level: u32, order: usize) -> (f64, usize) {
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let mut problem = pulled(domain, [1, 1], &[&[[-0.4, -0.3], [0.4, 0.3]]]);
    problem.discretization.cells = BaseCells::Level(level);
    problem.discretization.order = PolynomialOrder::Uniform(order);
    let dataset = solved(&problem);
    let missing = 1.0 - strain_energy(&dataset) / OBLIQUE_ENERGY;
    (missing.abs().sqrt(), unknowns(&dataset))
}

fn root(a: f64) -> f64 {
    (PI * a).sqrt()
}

/// Crack of length 2a in the middle of a plate of width 2 and height 2H.
pub(crate) fn centre_crack(a: f64, height: f64, value: f64) -> Plate {
    let domain = Rect::new(vec2(-1.0, -height), vec2(1.0, height));
    let cells = [8, (8.0 * height) as u32];
    Plate {
        name: format!("centre crack, a/W = {a}, H/W = {height}"),
        problem: pulled(domain, cells, &[&[[-a, 0.0], [a, 0.0]]]),
        covers: Covers::Grid(cells),
        scale: root(a),
        known: vec![known("F_I", 1, 0, value)],
    }
}

/// The centre cracks of the table.
pub(crate) fn centre_cracks() -> Vec<Plate> {
    [
        (0.3, 0.5, 1.370860),
        (0.3, 1.0, 1.123191),
        (0.3, 2.0, 1.058301),
        (0.3, 3.0, 1.057747),
        (0.5, 0.5, 1.967084),
        (0.5, 1.0, 1.3337121601),
        (0.5, 2.0, 1.1876355618),
        (0.5, 3.0, 1.186671),
        (0.7, 0.5, 3.039542),
        (0.7, 1.0, 1.677138),
        (0.7, 2.0, 1.489110),
        (0.7, 3.0, 1.48826),
    ]
    .map(|(a, height, value)| centre_crack(a, height, value))
    .into()
}

/// Edge cracks of length a in a plate of width W = 1 and height 2H, ends free to rotate.
pub(crate) fn edge_cracks() -> Vec<Plate> {
    [
        (0.3, 0.5, 1.84765),
        (0.3, 1.0, 1.661122),
        (0.3, 1.5, 1.659874),
        (0.5, 0.5, 3.008759),
        (0.5, 1.0, 2.825465),
        (0.5, 1.5, 2.824587),
    ]
    .map(|(a, height, value)| {
        let domain = Rect::new(vec2(0.0, -height), vec2(1.0, height));
        let cells = [8, (16.0 * height) as u32];
        Plate {
            name: format!("edge crack, a/W = {a}, H/W = {height}"),
            problem: pulled(domain, cells, &[&[[0.0, 0.0], [a, 0.0]]]),
            covers: Covers::Grid(cells),
            scale: root(a),
            known: vec![known("F_I", 0, 0, value)],
        }
    })
    .into()
}

/// Slanted centre cracks, a/W = 0.5, H/W = 2.
pub(crate) fn slanted_cracks() -> Vec<Plate> {
    [(15.0f64, 1.112747, 0.261865), (45.0, 0.611836, 0.545855)]
        .map(|(degrees, first, second)| {
            let (s, c) = degrees.to_radians().sin_cos();
            let domain = Rect::new(vec2(-1.0, -2.0), vec2(1.0, 2.0));
            let cells = [8, 16];
            let crack = [[-0.5 * c, -0.5 * s], [0.5 * c, 0.5 * s]];
            Plate {
                name: format!("slanted crack, {degrees}°"),
                problem: pulled(domain, cells, &[&crack]),
                covers: Covers::Grid(cells),
                scale: root(0.5),
                known: vec![known("F_I", 1, 0, first), known("F_II", 1, 1, second)],
            }
        })
        .into()
}

/// Edge crack under end shear with ν = 0.25.
pub(crate) fn end_shear() -> Plate {
    end_shear_at(0.25, [34.0425413592, 4.5369400294])
}

/// Edge crack under end shear: W = 7, L = 16, a = 3.5, bottom clamped; K_I and K_II of
/// Poisson's ratio.
pub(crate) fn end_shear_at(poisson: f64, [first, second]: [f64; 2]) -> Plate {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(7.0, 16.0));
    let material = Material { young: 3e7, poisson, state: StressState::PlaneStrain };
    let cells = [7, 16];
    let clamp = || Condition::Dirichlet(Expression::number(0.0));
    let set = Discretization::new(BaseCells::Grid(cells));
    Plate {
        name: format!("end shear, ν = {poisson}"),
        problem: ProblemData::elasticity(domain, material, set)
            .with_crack(&[[0.0, 8.0], [3.5, 8.0]])
            .with_boundary(DomainEdge::Bottom, vec![clamp(), clamp()])
            .with_boundary(DomainEdge::Top, traction(1.0.into(), 0.0.into())),
        covers: Covers::Grid(cells),
        scale: 1.0,
        known: vec![known("K_I", 0, 0, first), known("K_II", 0, 1, second)],
    }
}

/// Two collinear cracks 0.2 < |x| < 1.8, cut out of the infinite plane by its exact tractions.
pub(crate) fn collinear_cracks() -> Plate {
    let field = CollinearCracks::new(0.2, 1.8, 1.0);
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let domain = Rect::new(vec2(-3.0, -1.5), vec2(3.0, 1.5));
    let cells = [16, 8];
    let formula = |text: &String, sign: f64| {
        let text = if sign < 0.0 { negated(text) } else { text.clone() };
        Expression::parse(&text).expect("a formula of the testkit")
    };
    let [xx, yy, xy] = field.stress_formulas();
    let plate =
        ProblemData::elasticity(domain, material, Discretization::new(BaseCells::Grid(cells)))
            .with_crack(&[[-1.8, 0.0], [-0.2, 0.0]])
            .with_crack(&[[0.2, 0.0], [1.8, 0.0]]);
    let problem = DomainEdge::ALL.into_iter().fold(plate, |plate, edge| {
        let n = edge.normal();
        let [x, y] = if n.x == 0.0 { [&xy, &yy] } else { [&xx, &xy] };
        plate.with_boundary(edge, traction(formula(x, n.x + n.y), formula(y, n.x + n.y)))
    });
    let [outer, inner] = field.intensities().map(|k| k / root(0.8));
    Plate {
        name: "collinear cracks".into(),
        problem,
        covers: Covers::Grid(cells),
        scale: root(0.8),
        known: vec![known("F_I outer", 3, 0, outer), known("F_I inner", 2, 0, inner)],
    }
}

/// A crack of length 2 that goes on for 1 at 15°, order 3, in a plate of half-width 512 that stands
/// for the infinite plane. Smaller plates show that the factors are 3/w² larger in half-width w.
pub(crate) fn kinked_in_plane() -> Plate {
    let (s, c) = 15f64.to_radians().sin_cos();
    let domain = Rect::new(vec2(-512.0, -512.0), vec2(512.0, 512.0));
    let mut problem = pulled(domain, [1, 1], &[&[[-1.0, 0.0], [1.0, 0.0], [1.0 + c, s]]]);
    problem.discretization.order = PolynomialOrder::Uniform(3);
    Plate {
        name: "kinked crack".into(),
        problem,
        covers: Covers::Rings(512.0),
        scale: root(1.0),
        known: vec![
            known("F_I kinked end", 1, 0, 1.1520),
            known("F_II kinked end", 1, 1, 0.3178),
            known("F_I other end", 0, 0, 1.2148),
            known("F_II other end", 0, 1, -0.0226),
        ],
    }
}

/// Two cracks of half-length 1 at distance 2, one above the other, order 3, in a plate of
/// half-width 256 that stands for the infinite plane.
pub(crate) fn stacked_cracks() -> Plate {
    let domain = Rect::new(vec2(-256.0, -256.0), vec2(256.0, 256.0));
    let mut problem =
        pulled(domain, [1, 1], &[&[[-1.0, 1.0], [1.0, 1.0]], &[[-1.0, -1.0], [1.0, -1.0]]]);
    problem.discretization.order = PolynomialOrder::Uniform(3);
    Plate {
        name: "stacked cracks".into(),
        problem,
        covers: Covers::Rings(256.0),
        scale: root(1.0),
        known: vec![
            known("F_I upper, right", 1, 0, 0.843_080_1),
            known("F_II upper, right", 1, 1, -0.061_096_5),
            known("F_II lower, right", 3, 1, 0.061_096_5),
        ],
    }
}

/// The negative of a formula that ends in its value after `let` bindings.
fn negated(text: &str) -> String {
    let (bindings, value) = text.rsplit_once("; ").expect("a formula with bindings");
    format!("{bindings}; -({value})")
}
