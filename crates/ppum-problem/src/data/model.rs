//! A problem as data, and one that has been checked.

use std::ops::Deref;
use std::path::PathBuf;
use std::sync::Arc;

use ppum::crack::{Crack, Side, TipId, tips};
use ppum::dataset::{Equation, Material, NamedQuantity};
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::expression::Expression;
use ppum::formula::Table;
use ppum::vec2::Vec2;

use super::{
    Adaptivity, Body, BoundaryCondition, BoundaryPart, BoundaryPiece, Condition, Diagnostic,
    Discretization, DomainEdge, Enrichment, Force, GrowthRule, LocalEnrichment, LocalRefinement,
    ProblemError, SolverKind, SolverSettings, Support,
};

/// A problem with its discretisation that breaks no rule.
///
/// It is made from [`ProblemData`] and read like these, but does not change:
/// [`into_data`](Self::into_data) gives them back.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem(ProblemData);

impl Deref for Problem {
    type Target = ProblemData;

    fn deref(&self) -> &ProblemData {
        &self.0
    }
}

impl Problem {
    /// The problem of data that break no rule.
    ///
    /// # Errors
    /// Everything that is wrong, each named by its key.
    pub fn new(data: ProblemData) -> Result<Self, ProblemError> {
        data.check()?;
        Ok(Self::of_checked(data))
    }

    /// The problem of data that were checked; the problem of a temperature is on its body and
    /// discretised as it is.
    pub(crate) fn of_checked(data: ProblemData) -> Self {
        let mut data = data.with_axis();
        if let Some(SolvedTemperature { problem, .. }) = &mut data.temperature {
            problem.0.body = data.body.with_pieces(problem.pieces());
            problem.0.discretization = data.discretization.clone();
            problem.0.refinements = data.refinements.clone();
            problem.0.solver = data.solver;
            (problem.0.adaptivity, problem.0.growth) = (None, None);
        }
        Self(data)
    }

    /// The data, which can be changed and checked again.
    #[must_use]
    pub fn into_data(self) -> ProblemData {
        self.0
    }

    /// The problem with the cracks of one of its steps in place of its own.
    pub fn with_cracks(&self, cracks: Vec<Crack>) -> Self {
        let body = (*self.body).clone().with_cracks(cracks);
        Self::of_checked(ProblemData { body: body.into(), ..self.0.clone() })
    }

    /// The problem whose cracks have grown to these lines, polylines or chains of edges.
    ///
    /// # Errors
    /// The rules that the new cracks break.
    pub fn grown(&self, lines: Vec<Crack>) -> Result<Self, ProblemError> {
        Self::new(self.0.clone().with_lines(lines))
    }

    /// The problem of the temperature in the body, discretised as this one.
    pub fn heat(&self) -> Option<&Self> {
        Some(&self.temperature.as_ref()?.problem)
    }
}

/// A problem with its discretisation, as it is given.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemData {
    /// One line that names the problem; may be empty.
    pub title: String,
    /// The body.
    pub body: Arc<Body>,
    /// The equation with its material.
    pub equation: Equation,
    /// The temperature that strains the body, if another problem gives it.
    pub temperature: Option<SolvedTemperature>,
    /// The conditions on the boundary.
    pub boundary: Vec<BoundaryCondition>,
    /// Forces at points.
    pub forces: Vec<Force>,
    /// Points that are held against rigid motion.
    pub supports: Vec<Support>,
    /// The right-hand side f, one expression per component: body force or source.
    pub source: Vec<Expression>,
    /// The exact solution, one expression per component; empty if unknown.
    pub exact: Vec<Expression>,
    /// Quantities the problem names, beside the built-in ones.
    pub quantities: Vec<NamedQuantity>,
    /// Tables its formulas may read.
    pub tables: Vec<Arc<Table>>,
    /// Functions of the local spaces beside the built-in ones.
    pub enrichments: Vec<LocalEnrichment>,
    /// Cover, local spaces and enrichment.
    pub discretization: Discretization,
    /// How the cover is improved by its own solutions; `None` solves once.
    pub adaptivity: Option<Adaptivity>,
    /// How cracks grow, step by step; `None` solves the problem with the cracks as they are.
    pub growth: Option<GrowthRule>,
    /// Where cells are divided by hand.
    pub refinements: Vec<LocalRefinement>,
    /// The linear solver.
    pub solver: SolverSettings,
    /// The problem file's text, if there was one.
    pub text: Option<String>,
    /// The files that the text names, which were read with it: tables and points.
    pub files: Vec<PathBuf>,
    /// Remarks on the text that are no errors, such as keys that have no effect.
    pub notes: Vec<Diagnostic>,
}

/// A change of temperature T, the solution of Poisson's equation on the same body with the same
/// cracks, which strains the body by α T in all directions.
///
/// Only the conditions, sources, conductivity and functions of its problem count. It is solved on
/// the cells of the elastic problem with the polynomials of that, again for each of its steps.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedTemperature {
    /// The problem of the temperature.
    pub problem: Box<Problem>,
    /// The coefficient α of thermal expansion.
    pub expansion: Expression,
}

impl ProblemData {
    /// True if tips have Williams' series, and corners theirs: where the material varies they have
    /// other ones.
    pub fn has_series(&self) -> bool {
        self.discretization.enrichment == Enrichment::Williams
            && self.equation.has_uniform_material()
    }

    /// True if tips have Williams' series, which is that of plane fields.
    pub fn has_tip_series(&self) -> bool {
        self.has_series() && !self.equation.is_axisymmetric()
    }

    /// A problem of elasticity on a box, as yet without cracks, loads and restraints.
    #[must_use]
    pub fn elasticity(
        domain: impl Into<Domain>,
        material: Material,
        discretization: Discretization,
    ) -> Self {
        Self::new(domain.into(), Equation::elasticity(material), discretization)
    }

    /// A Poisson problem with conductivity κ on a box, as yet without cracks, sources and
    /// conditions.
    #[must_use]
    pub fn poisson(
        domain: impl Into<Domain>,
        conductivity: f64,
        discretization: Discretization,
    ) -> Self {
        Self::new(domain.into(), Equation::poisson(conductivity), discretization)
    }

    fn new(domain: Domain, equation: Equation, discretization: Discretization) -> Self {
        Self {
            title: String::new(),
            body: Body::new(domain, Vec::new()).into(),
            source: vec![Expression::number(0.0); equation.components()],
            equation,
            temperature: None,
            boundary: Vec::new(),
            forces: Vec::new(),
            supports: Vec::new(),
            exact: Vec::new(),
            quantities: Vec::new(),
            tables: Vec::new(),
            enrichments: Vec::new(),
            discretization,
            adaptivity: None,
            growth: None,
            refinements: Vec::new(),
            solver: SolverSettings::default(),
            text: None,
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The problem with one more crack; its ends on the boundary, also on rims and in holes, become
    /// mouths, those on other cracks junctions, and all others tips. Ends of the cracks before it
    /// that lie on it become junctions, too. Cost: that of looking at all cracks;
    /// [`with_lines`](Self::with_lines) makes many at once.
    #[must_use]
    pub fn with_crack(self, points: &[[f64; 2]]) -> Self {
        let points: Vec<Vec2> = points.iter().copied().map(Vec2::from).collect();
        self.with_crack_along(points)
    }

    /// The problem with one more crack along a polyline or a chain of edges, as
    /// [`with_crack`](Self::with_crack) has it.
    #[must_use]
    pub fn with_crack_along(self, course: impl Into<Crack>) -> Self {
        let mut lines = self.cracks().to_vec();
        lines.push(course.into());
        self.with_lines(lines)
    }

    /// The problem with cracks along lines, polylines or chains of edges, in place of its own, see
    /// [`cracks`](crate::cracks()).
    #[must_use]
    pub fn with_lines(self, lines: impl IntoIterator<Item = Crack>) -> Self {
        let body = (*self.body).clone().with_lines(lines).settled();
        Self { body: body.into(), ..self }
    }

    /// The problem with the same cracks in another domain.
    #[must_use]
    pub fn with_domain(self, domain: impl Into<Domain>) -> Self {
        let body = (*self.body).clone().with_domain(domain.into());
        Self { body: body.into(), ..self }
    }

    /// The problem with conditions on a whole edge, one per component.
    #[must_use]
    pub fn with_boundary(mut self, edge: DomainEdge, components: Vec<Condition>) -> Self {
        self.boundary.push(BoundaryCondition::on_edge(edge, &self.domain().bounds, components));
        self
    }

    /// The problem with a pressure on a part of the boundary.
    #[must_use]
    pub fn with_pressure(mut self, on: BoundaryPart, pressure: f64) -> Self {
        self.boundary.push(BoundaryCondition::pressure(on, pressure.into()));
        self
    }

    /// The problem with a crack, given by its number, whose faces may touch, with Coulomb's
    /// coefficient μ ≥ 0 of friction.
    #[must_use]
    pub fn with_contact(self, crack: u32, friction: f64) -> Self {
        let body = (*self.body).clone().with_contact(crack, friction);
        Self { body: body.into(), ..self }
    }

    /// The problem with exact values given on a whole edge.
    #[must_use]
    pub fn with_exact_boundary(self, edge: DomainEdge) -> Self {
        let components = self.exact.iter().cloned().map(Condition::Dirichlet).collect();
        self.with_boundary(edge, components)
    }

    /// The problem whose cover is improved by its own solutions.
    #[must_use]
    pub fn with_adaptivity(mut self, adaptivity: Adaptivity) -> Self {
        self.adaptivity = Some(adaptivity);
        self
    }

    /// The problem whose cracks grow.
    #[must_use]
    pub fn with_growth(mut self, growth: GrowthRule) -> Self {
        self.growth = Some(growth);
        self
    }

    /// The linear solver: of levels, the coarser ones do not see faces that touch.
    pub fn solver_kind(&self) -> SolverKind {
        if self.touches() { SolverKind::Direct } else { self.solver.kind }
    }

    /// True if faces of some crack may touch.
    pub(crate) fn touches(&self) -> bool {
        self.body.contacts().next().is_some()
    }

    /// Number of arcs of which cracks and rims consist.
    #[must_use]
    pub fn arcs(&self) -> usize {
        let rims = self.domain().holes.iter().flat_map(Hole::edges);
        rims.chain(self.cracks().iter().flat_map(Crack::edges)).filter(Edge::is_arc).count()
    }

    /// The box minus holes Ω.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        self.body.domain()
    }

    /// The cracks.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        self.body.cracks()
    }

    /// The pieces of rims that have names, which conditions may be on.
    #[must_use]
    pub fn pieces(&self) -> &[BoundaryPiece] {
        self.body.pieces()
    }

    /// True if something acts on faces of cracks.
    pub fn loads_faces(&self) -> bool {
        self.boundary.iter().any(|condition| matches!(condition.on, BoundaryPart::Crack { .. }))
    }

    /// Number of components of the unknown field.
    #[must_use]
    pub fn components(&self) -> usize {
        self.equation.components()
    }

    /// Radius of the zone around a tip whose patches are enriched: the one given, or by default a
    /// quarter of the crack's length, at most a quarter of the distance to the nearest other tip.
    ///
    /// The radius does not shrink with the cells: the rate of convergence rests on that.
    #[must_use]
    pub fn enrichment_radius(&self, tip: TipId) -> f64 {
        if let Some(radius) = self.discretization.enrichment_radius {
            return radius;
        }
        let position = |tip: TipId| self.cracks()[tip.crack as usize].end_point(tip.end);
        let length = self.cracks()[tip.crack as usize].length();
        let others = tips(self.cracks()).filter(|other| *other != tip);
        let distances = others.map(|other| (position(other) - position(tip)).length());
        0.25 * distances.fold(length, f64::min)
    }

    /// A part of the boundary in words.
    pub fn words_of(&self, part: BoundaryPart) -> String {
        match part {
            BoundaryPart::Piece(piece) => format!("the piece `{}`", self.pieces()[piece].name),
            BoundaryPart::Hole(hole) if self.domain().outline() == Some(hole) => {
                "the outline".into()
            }
            other => other.to_string(),
        }
    }

    /// True if a side of the rim of a hole belongs to a part of the boundary.
    pub fn is_on(&self, part: BoundaryPart, hole: usize, side: usize) -> bool {
        match part {
            BoundaryPart::Hole(whole) => whole == hole,
            BoundaryPart::Sides(run) => run.holds(hole, side),
            BoundaryPart::Piece(piece) => {
                self.pieces()[piece].runs.iter().any(|run| run.holds(hole, side))
            }
            BoundaryPart::Edge { .. } | BoundaryPart::Crack { .. } => false,
        }
    }

    /// The source (body force) at a point; zero beyond the components.
    pub fn source_at(&self, x: Vec2) -> [f64; 2] {
        let mut source = [0.0; 2];
        source.iter_mut().zip(&self.source).for_each(|(value, e)| *value = e.value(x));
        source
    }

    /// The number of the edge of a crack that is nearest to a point, and the normal of its face
    /// into the body there.
    pub(crate) fn face_near(&self, crack: usize, side: Side, x: Vec2) -> (usize, Vec2) {
        let edges = self.cracks()[crack].edges().enumerate();
        let nearest = edges.min_by(|(_, s), (_, t)| s.distance(x).total_cmp(&t.distance(x)));
        let left = |edge: Edge| edge.tangent_towards(x).left();
        let (number, left) = nearest.map_or((0, Vec2::ZERO), |(k, edge)| (k, left(edge)));
        (number, if side == Side::Above { left } else { -left })
    }

    /// The traction on the face of a crack at a point of it, the sum of all conditions there.
    pub fn face_load(&self, crack: usize, side: Side, x: Vec2) -> [f64; 2] {
        let normal = -self.face_near(crack, side, x).1;
        let mut sum = [0.0; 2];
        for condition in &self.boundary {
            let BoundaryPart::Crack { crack: other, face } = condition.on else { continue };
            if other == crack && face.is_none_or(|face| face == side) {
                let load = condition.values(x, normal);
                sum.iter_mut().zip(load).for_each(|(sum, t)| *sum += t);
            }
        }
        sum
    }
}
