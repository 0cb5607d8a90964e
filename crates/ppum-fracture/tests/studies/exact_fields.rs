//! Exact fields, given on the whole border of a plate.

use super::support::{self, Errors, errors, solved};
use ppum::dataset::{Dataset, Material, StressState};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{
    BaseCells, Discretization, DomainEdge, Enrichment, Expression, PolynomialOrder, ProblemData,
};
use ppum_testkit::exact::{ExactField, Slit, Smooth, Williams};

/// E = 1, ν = 0.3, plane strain.
pub(crate) const MATERIAL: Material =
    Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// [−1, 1]².
pub(crate) const SQUARE: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));

/// Nothing refined.
pub(crate) fn discretization(cells: BaseCells, order: usize) -> Discretization {
    let mut set = Discretization::new(cells);
    set.order = PolynomialOrder::Uniform(order);
    set.refine = false;
    set
}

/// Formulas.
pub(crate) fn expressions<const N: usize>(texts: [String; N]) -> Vec<Expression> {
    texts.iter().map(|t| Expression::parse(t).expect("a formula of the testkit")).collect()
}

/// The problem with an exact solution, given on all four edges.
pub(crate) fn held<const N: usize>(mut problem: ProblemData, exact: [String; N]) -> ProblemData {
    problem.exact = expressions(exact);
    DomainEdge::ALL.into_iter().fold(problem, ProblemData::with_exact_boundary)
}

/// The manufactured field of the numerical study, with its body force.
pub(crate) fn smooth(level: u32, order: usize) -> Errors {
    let field = Smooth { material: MATERIAL };
    let set = discretization(BaseCells::Level(level), order);
    let mut problem = held(ProblemData::elasticity(SQUARE, MATERIAL, set), field.formulas());
    problem.source = expressions(field.body_force_formulas());
    errors(&solved(&problem), &|p| support::both(field.evaluate(p)))
}

/// A straight crack from the left edge to a tip, with the field around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TipProblem {
    /// The plate.
    pub(crate) domain: Rect,
    /// The tip.
    pub(crate) tip: Vec2,
    /// Angle of the crack to the x axis.
    pub(crate) angle: f64,
}

/// The oblique crack of the numerical study.
pub(crate) const OBLIQUE: TipProblem =
    TipProblem { domain: SQUARE, tip: vec2(0.03, 0.041), angle: 0.2 };

impl TipProblem {
    /// The field without load.
    pub(crate) fn field(&self) -> Williams {
        Williams::new(MATERIAL, self.tip, vec2(self.angle.cos(), self.angle.sin()))
    }

    /// The problem that has this field as its solution.
    pub(crate) fn problem(&self, field: &Williams, set: Discretization) -> ProblemData {
        self.problem_of(MATERIAL, field, set)
    }

    /// The same in another material, which is the field's.
    pub(crate) fn problem_of(
        &self,
        material: Material,
        field: &Williams,
        set: Discretization,
    ) -> ProblemData {
        let back = self.tip.x - self.domain.min.x;
        let mouth = vec2(self.domain.min.x, self.tip.y - back * self.angle.tan());
        let plate = ProblemData::elasticity(self.domain, material, set);
        held(plate.with_crack(&[mouth.into(), self.tip.into()]), field.formulas())
    }

    /// Relative errors of a solution.
    pub(crate) fn errors(&self, field: &Williams, set: Discretization) -> Errors {
        let solution = solved(&self.problem(field, set));
        errors(&solution, &|p| support::both(field.evaluate(p)))
    }

    /// Relative errors for the pure tip field K_I = 1, K_II = 0.5.
    pub(crate) fn pure(&self, cells: BaseCells, order: usize, radius: f64) -> Errors {
        let mut set = discretization(cells, order);
        set.enrichment_radius = Some(radius);
        self.errors(&self.field().with_intensities(1.0, 0.5), set)
    }
}

/// A strip in which the zone of radius [`Strip::RADIUS`] is the same piece, |x| < 1, on three
/// covers.
pub(crate) struct Strip;

impl Strip {
    /// Between 0.85625 and 0.925, so that on all three covers the patches that meet the disc are
    /// those of the cells within |x| < 1.
    pub(crate) const RADIUS: f64 = 0.9;

    /// Relative errors for the pure tip field on 2^level times 8 × 1 cells, level 0 to 2.
    pub(crate) fn errors(level: u32, order: usize) -> Errors {
        let domain = Rect::new(vec2(-2.0, -0.25), vec2(2.0, 0.25));
        let crack = TipProblem { domain, tip: vec2(0.0, 0.041), angle: 0.1 };
        crack.pure(BaseCells::Grid([8 << level, 1 << level]), order, Self::RADIUS)
    }
}

/// The field of the tables of the numerical study: K_I = 1, K_II = 0.5, T = 0.3 and r^{3/2} terms.
///
/// The study does not state the amplitudes of the latter. 0.4 and 0.3 are the pair of round numbers
/// that gives all 27 entries at once, most of them to three digits.
fn study_field() -> Williams {
    OBLIQUE.field().with_intensities(1.0, 0.5).with_t_stress(0.3).with_term(3, 0.4, 0.3)
}

/// One row of the tables of the numerical study.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StudyRow {
    /// Degree of the polynomials.
    pub(crate) order: usize,
    /// The patches with tip functions; the zone has radius 0.4.
    pub(crate) enrichment: Enrichment,
    /// Degree of the polynomials that multiply the tip functions on the patch of the tip.
    pub(crate) tip_degree: usize,
    /// The study's relative errors in the energy norm at the levels 2, 3 and 4.
    pub(crate) expected: [f64; 3],
}

impl StudyRow {
    /// Our relative error in the energy norm.
    pub(crate) fn error(&self, level: u32) -> f64 {
        let mut set = discretization(BaseCells::Level(level), self.order);
        set.enrichment = self.enrichment;
        set.enrichment_radius = (self.enrichment == Enrichment::Zone).then_some(0.4);
        set.tip_degree = self.tip_degree;
        OBLIQUE.errors(&study_field(), set).energy
    }
}

const fn row(
    order: usize,
    enrichment: Enrichment,
    tip_degree: usize,
    expected: [f64; 3],
) -> StudyRow {
    StudyRow { order, enrichment, tip_degree, expected }
}

/// The tables of the numerical study.
pub(crate) const STUDY: [StudyRow; 9] = [
    row(1, Enrichment::TipPatch, 0, [1.82e-1, 1.09e-1, 6.36e-2]),
    row(1, Enrichment::Zone, 0, [1.60e-1, 8.02e-2, 4.08e-2]),
    row(1, Enrichment::Zone, 1, [1.10e-1, 7.34e-2, 4.00e-2]),
    row(2, Enrichment::TipPatch, 0, [5.89e-2, 2.51e-2, 1.28e-2]),
    row(2, Enrichment::Zone, 0, [5.85e-2, 1.76e-2, 2.26e-3]),
    row(2, Enrichment::Zone, 1, [1.05e-2, 3.90e-3, 1.27e-3]),
    row(3, Enrichment::TipPatch, 0, [5.12e-2, 1.84e-2, 6.13e-3]),
    row(3, Enrichment::Zone, 0, [5.11e-2, 1.47e-2, 1.24e-3]),
    row(3, Enrichment::Zone, 1, [2.42e-3, 5.81e-4, 1.27e-4]),
];

/// The pure tip field K = 1 in one mode on [−1, 1]², tip at the centre, every patch enriched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TipPlate {
    state: StressState,
    /// 0 for mode I, 1 for mode II.
    mode: usize,
}

impl TipPlate {
    /// All states and modes.
    pub(crate) const ALL: [Self; 4] = [
        Self { state: StressState::PlaneStrain, mode: 0 },
        Self { state: StressState::PlaneStrain, mode: 1 },
        Self { state: StressState::PlaneStress, mode: 0 },
        Self { state: StressState::PlaneStress, mode: 1 },
    ];

    /// State and mode in words.
    pub(crate) fn name(&self) -> String {
        let state = match self.state {
            StressState::PlaneStrain => "plane strain",
            _ => "plane stress",
        };
        format!("{state}, mode {}", ["I", "II"][self.mode])
    }

    /// The solution at order 2.
    pub(crate) fn solve(&self, level: u32) -> Dataset {
        let material = Material { state: self.state, ..MATERIAL };
        let crack = TipProblem { domain: SQUARE, tip: Vec2::ZERO, angle: 0.0 };
        let mut set = discretization(BaseCells::Level(level), 2);
        set.enrichment_radius = Some(10.0);
        let [k1, k2] = if self.mode == 0 { [1.0, 0.0] } else { [0.0, 1.0] };
        let field = Williams::new(material, Vec2::ZERO, vec2(1.0, 0.0)).with_intensities(k1, k2);
        solved(&crack.problem_of(material, &field, set))
    }
}

/// A value that is known of a [`TipPlate`].
pub(crate) struct TipValue {
    /// Its nature.
    pub(crate) name: String,
    /// Its value.
    pub(crate) value: f64,
    found: Box<dyn Fn(&Dataset) -> f64>,
}

impl TipValue {
    /// Relative error of a solution.
    pub(crate) fn error(&self, dataset: &Dataset) -> f64 {
        (self.found)(dataset) / self.value - 1.0
    }
}

/// The strain energy ½ ∫ σ:ε.
pub(crate) fn tip_energies(plate: &TipPlate) -> Option<TipValue> {
    let known = match plate.state {
        StressState::PlaneStrain => [0.474129375227, 1.203559183268],
        _ => [0.575127348648, 1.304557156689],
    };
    Some(TipValue {
        name: "strain energy".into(),
        value: known[plate.mode],
        found: Box::new(support::strain_energy),
    })
}

/// Displacements and stresses at (0.3, 0.4).
pub(crate) fn tip_points(plate: &TipPlate) -> Vec<TipValue> {
    let displacements = match (plate.state, plate.mode) {
        (StressState::PlaneStrain, 0) => [0.3936086734, 0.1968043367],
        (StressState::PlaneStrain, _) => [0.7216159013, -0.1312028911],
        (StressState::PlaneStress, 0) => [0.4844414442, 0.2422207221],
        _ => [0.7670322867, -0.2220356619],
    };
    let stresses = match plate.mode {
        0 => [0.2825908425, 0.7266621663, 0.0403701204],
        _ => [-0.5449966248, 0.0403701204, 0.2825908425],
    };
    let names = ["ux", "uy", "sxx", "syy", "sxy"];
    let values = displacements.into_iter().chain(stresses);
    let value = |(name, value): (&'static str, f64)| TipValue {
        name: format!("{name} at (0.3, 0.4)"),
        value,
        found: Box::new(move |dataset| support::quantity(dataset, name, vec2(0.3, 0.4))),
    };
    names.into_iter().zip(values).map(value).collect()
}

/// u = √r sin(θ/2) on the slit square.
pub(crate) fn slit_plate(level: u32, order: usize) -> ProblemData {
    let mut set = discretization(BaseCells::Level(level), order);
    set.enrichment_radius = Some(0.4);
    let plate = ProblemData::poisson(SQUARE, 1.0, set).with_crack(&[[-1.0, 0.0], [0.0, 0.0]]);
    held(plate, Slit.formulas())
}

/// ‖∇u‖² and ‖u‖² of [`slit_plate`].
pub(crate) const SLIT_SQUARES: [f64; 2] = [1.762747174039, 1.530391432928];
