//! Strains and stresses: the numbers of a field at a point that a law sees, and their duals.
//!
//! A law sees of a field u the numbers D_k u_j alone, with the operators D = (∂/∂x, ∂/∂y), and in
//! bodies of revolution 1/x as a third one, D_3 u_x = u_x/x being the hoop strain. Fields
//! make them of their jets, `LawAt::strain`, functions of a space bring them along
//! (`Shapes::slopes`, with as many arrays as there are operators), and everything between the two
//! is linear in them: nobody else knows what D is made of.

use ppum::equation::Equation;
use ppum::jet::Jet;
use ppum::real::{LaneJob, LaneNumber as _, Real};
use ppum::vec2::{Vec2, vec2};

/// Most operators D_k.
pub(crate) const OPERATORS: usize = 3;

/// The place of the operator 1/x.
pub(crate) const HOOP: usize = 2;

/// True if the third operator makes a strain.
pub(crate) fn has_hoop_strain(equation: &Equation) -> bool {
    equation.is_axisymmetric() && equation.elastic().is_some()
}

/// Number of operators D_k of an equation.
pub(crate) fn operators(equation: &Equation) -> usize {
    if has_hoop_strain(equation) { OPERATORS } else { HOOP }
}

/// v/x of a function with its slope at a point; one that is regular there vanishes on the axis.
pub(crate) fn hoop(v: f64, slope: f64, x: f64) -> f64 {
    if x == 0.0 { slope } else { v / x }
}

/// D_k u_j of a field at a point, j the row; zero beyond the components of the field. Where
/// components are directions, its symmetric part is the strain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain(pub [[f64; OPERATORS]; 2]);

/// The stress σ_ik that does work on D_k u_i, or the flux of a potential in its first row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stress(pub [[f64; OPERATORS]; 2]);

/// The entry of the unit strain, which is a change of volume alone.
pub(super) fn unit(pair: [usize; 2]) -> f64 {
    f64::from(u8::from([[0, 0], [1, 1], [0, HOOP]].contains(&pair)))
}

/// The pair whose entry is the other one of a symmetric strain.
pub(super) fn transposed([j, k]: [usize; 2]) -> [usize; 2] {
    if k == HOOP { [j, k] } else { [k, j] }
}

impl Strain {
    /// The strain of a field with these components.
    pub(super) fn new(u: &[Jet<f64>]) -> Self {
        let mut strain = Self::default();
        strain.0.iter_mut().zip(u).for_each(|(row, u)| *row = [u.x, u.y, 0.0]);
        strain
    }

    /// The strain with these entries xx, yy and xy.
    pub(super) fn symmetric([xx, yy, xy]: [f64; 3]) -> Self {
        Self([[xx, xy, 0.0], [xy, yy, 0.0]])
    }

    /// The strain with a hoop strain beside.
    pub(super) fn with_hoop(mut self, hoop: f64) -> Self {
        self.0[0][HOOP] = hoop;
        self
    }

    /// The hoop strain of a body of revolution; zero in the plane.
    #[must_use]
    pub fn hoop(&self) -> f64 {
        self.0[0][HOOP]
    }

    /// A stretch that is equal in all directions.
    pub(super) fn isotropic(stretch: f64) -> Self {
        Self(std::array::from_fn(|j| std::array::from_fn(|k| stretch * unit([j, k]))))
    }

    /// The sum or, with the factor −1, the difference of two strains.
    #[must_use]
    pub(super) fn plus(&self, factor: f64, other: &Self) -> Self {
        let entry = |j: usize, k: usize| self.0[j][k] + factor * other.0[j][k];
        Self(std::array::from_fn(|j| std::array::from_fn(|k| entry(j, k))))
    }

    /// The change of volume, tr ε.
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.0[0][0] + self.0[1][1] + self.hoop()
    }

    /// The rows of the plane: the gradient of each component.
    #[must_use]
    pub fn in_plane(&self) -> [Vec2; 2] {
        self.0.map(|[x, y, _]| vec2(x, y))
    }

    /// Adds a multiple of the strain of a function of one component.
    pub(crate) fn add(&mut self, component: usize, factor: f64, slopes: [f64; OPERATORS]) {
        self.0[component].iter_mut().zip(slopes).for_each(|(sum, slope)| *sum += slope * factor);
    }
}

impl Stress {
    /// The sum of two stresses.
    #[must_use]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let entry = |i: usize, k: usize| self.0[i][k] + other.0[i][k];
        Self(std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k))))
    }

    /// The traction (flux) on a surface with a normal.
    #[must_use]
    pub(crate) fn traction(&self, normal: Vec2) -> Vec2 {
        self.0.map(|[x, y, _]| x * normal.x + y * normal.y).into()
    }

    /// The hoop stress of a body of revolution.
    #[must_use]
    pub fn hoop(&self) -> f64 {
        self.0[0][HOOP]
    }

    /// The work of row i on a strain; that of all rows is σ:ε.
    #[must_use]
    pub(crate) fn row_work(&self, strain: &Strain, i: usize) -> f64 {
        self.0[i].iter().zip(strain.0[i]).map(|(stress, strain)| stress * strain).sum()
    }

    /// σ:ε over the components of a field.
    #[must_use]
    pub fn work(&self, strain: &Strain) -> f64 {
        (0..2).map(|i| self.row_work(strain, i)).sum()
    }

    /// Mandel's vector of a symmetric stress, whose square is σ:σ.
    #[must_use]
    pub(crate) fn mandel(&self) -> [f64; 4] {
        let [[xx, xy, hoop], [_, yy, _]] = self.0;
        [xx, yy, std::f64::consts::SQRT_2 * xy, hoop]
    }
}

/// The pairs (j, k) of D_k u_j for each entry of symmetric strains: (ε_11, ε_22, 2ε_12, ε_θ).
pub(super) const PAIRS: [[usize; 2]; 4] = [[0, 0], [1, 1], [0, 1], [0, HOOP]];

/// The matrix on the entries of symmetric strains.
pub(super) type Rigidity = [[f64; PAIRS.len()]; PAIRS.len()];

/// The law of elasticity at points, times weights.
pub(crate) struct WeightedRigidity(pub(super) Vec<Rigidity>);

impl WeightedRigidity {
    /// The stresses σ_ik of some vector fields from their strains D_k v_i, both arrays
    /// \[components, points, operators, fields\].
    pub(crate) fn stresses(&self, fields: usize, strains: &[f64], stresses: &mut [f64]) {
        if strains.len() == 2 * OPERATORS * fields * self.0.len() {
            return self.hoop_stresses(fields, strains, stresses);
        }
        f64::dispatch(FieldStresses { fields, rigidity: &self.0, strains, to: stresses });
    }

    /// Those of a body of revolution.
    fn hoop_stresses(&self, n: usize, strains: &[f64], stresses: &mut [f64]) {
        let half = strains.len() / 2;
        for (point, d) in self.0.iter().enumerate() {
            for a in 0..n {
                let at = |[j, k]: [usize; 2]| j * half + (point * OPERATORS + k) * n + a;
                let of = |pair: [usize; 2]| strains[at(pair)];
                let strain = [of([0, 0]), of([1, 1]), of([0, 1]) + of([1, 0]), of([0, HOOP])];
                for (row, pair) in d.iter().zip(PAIRS) {
                    stresses[at(pair)] = row.iter().zip(strain).map(|(d, e)| d * e).sum();
                }
                stresses[at([1, 0])] = stresses[at([0, 1])];
                stresses[at([1, HOOP])] = 0.0;
            }
        }
    }
}

struct FieldStresses<'a> {
    fields: usize,
    rigidity: &'a [Rigidity],
    strains: &'a [f64],
    to: &'a mut [f64],
}

impl LaneJob<f64> for FieldStresses<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, _: R) {
        let (half, n) = (self.strains.len() / 2, self.fields);
        let ([first, second], (to, below)) =
            ([&self.strains[..half], &self.strains[half..]], self.to.split_at_mut(half));
        let strains = first.chunks_exact(2 * n).zip(second.chunks_exact(2 * n));
        let stresses = to.chunks_exact_mut(2 * n).zip(below.chunks_exact_mut(2 * n));
        for (((u, v), (s, t)), d) in strains.zip(stresses).zip(self.rigidity) {
            let ((ux, uy), (vx, vy)) = (u.split_at(n), v.split_at(n));
            let ((sx, sy), (tx, ty)) = (s.split_at_mut(n), t.split_at_mut(n));
            for a in 0..n {
                let (x, y, z) = (ux[a], vy[a], uy[a] + vx[a]);
                sx[a] = d[0][0] * x + d[0][1] * y + d[0][2] * z;
                ty[a] = d[1][0] * x + d[1][1] * y + d[1][2] * z;
                sy[a] = d[2][0] * x + d[2][1] * y + d[2][2] * z;
                tx[a] = sy[a];
            }
        }
    }
}

/// Most rigid-body modes a field can have.
pub(crate) const MODES: usize = 3;

/// One number per rigid-body mode.
pub(crate) type PerMode = [f64; MODES];

/// The fields without strain, which restraints or a constraint of the null space must remove: two
/// translations and the rotation about a centre, in units of a size; for one component the
/// constant. A body of revolution moves along its axis alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RigidModes {
    /// Centre of the rotation.
    pub(crate) center: Vec2,
    /// Distance from the centre at which the rotation moves points by 1.
    pub(crate) size: f64,
    components: usize,
    is_axial: bool,
}

impl RigidModes {
    pub(crate) fn new(center: Vec2, size: f64, equation: &Equation) -> Self {
        let is_axial = has_hoop_strain(equation);
        Self { center, size, components: equation.components(), is_axial }
    }

    /// Number of modes.
    pub(crate) fn count(&self) -> usize {
        if self.components == 1 || self.is_axial { 1 } else { MODES }
    }

    /// The modes at x; those beyond [`RigidModes::count`] are zero.
    pub(crate) fn at(&self, x: Vec2) -> [[f64; 2]; MODES] {
        let d = (x - self.center) / self.size;
        match self.components {
            1 => [[1.0, 0.0], [0.0; 2], [0.0; 2]],
            _ if self.is_axial => [[0.0, 1.0], [0.0; 2], [0.0; 2]],
            _ => [[1.0, 0.0], [0.0, 1.0], [-d.y, d.x]],
        }
    }

    /// The resultant force, and the moment about the centre, of loads that do some work on each
    /// mode; no moment acts on a potential.
    pub(crate) fn resultant(&self, [x, y, turn]: PerMode) -> (Vec2, Option<f64>) {
        if self.is_axial {
            return (vec2(0.0, x), Some(0.0));
        }
        (vec2(x, y), (self.count() > 1).then_some(turn * self.size))
    }

    /// A combination of the modes at x.
    pub(crate) fn combined(&self, mode: &PerMode, x: Vec2) -> [f64; 2] {
        let basic = self.at(x);
        [0, 1].map(|i| (0..MODES).map(|k| mode[k] * basic[k][i]).sum())
    }
}
