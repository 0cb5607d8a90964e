//! Recipes of datasets, and their covers.

use crate::random::Random;
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, TipId, tips};
use ppum::dataset::{BoxPartition, MAX_DEGREE};
use ppum::function::{Frame, FunctionKind, NonsmoothPoints, Role, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

/// The features of a synthetic dataset.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// Domain.
    pub domain: Rect,
    /// Root cells.
    pub cells: [u32; 2],
    /// Number of random points that make the cover; 0 for none.
    pub points: usize,
    /// Levels of halving everywhere; not used if there are points.
    pub level: u8,
    /// Rounds in which one cell in four, at random, is halved.
    pub random_rounds: u32,
    /// Level of the cells that hold a tip or a junction.
    pub tip_level: u8,
    /// Overlap α.
    pub overlap: f64,
    /// Weight function.
    pub weight: WeightFunction,
    /// True if the frames of polynomials differ from the supports.
    pub own_frames: bool,
    /// Cracks.
    pub cracks: Vec<Crack>,
    /// Degrees of smooth and side blocks, taken in turn by the patches.
    pub degrees: Vec<u8>,
    /// Degree of the blocks of tip functions.
    pub tip_degree: u8,
    /// Patches whose centre is closer than this to a tip have its functions.
    pub zone: f64,
    /// Patches that a crack cuts through have its side function.
    pub jumps: bool,
    /// Places where cracks meet. Where there are any, patches that cracks cut into more than two
    /// components have functions of these in place of sides.
    pub junctions: Vec<Junction>,
    /// Texts that stand for the four Westergaard functions in the tips' frames.
    pub tip_functions: [String; 4],
    /// More functions; every third patch has one of them, in turn, with a linear polynomial.
    pub extra: Vec<FunctionKind>,
    /// Number of components: 1 makes a potential, 2 a displacement, at most 6.
    pub components: usize,
    /// Coefficients.
    pub coefficients: Coefficients,
    /// Seed of all that is random.
    pub seed: u64,
}

/// A place where cracks meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Where they meet.
    pub center: Vec2,
    /// Within this distance the field of [`Coefficients::Taylor`] jumps from component to component
    /// of what the cracks leave of the box around it; no tip lies in it.
    pub radius: f64,
}

/// The choice of the coefficients.
#[derive(Clone, Debug)]
pub enum Coefficients {
    /// Uniform in \[−1, 1): patches have nothing to do with each other.
    Random,
    /// As a solver finds them: the field is [`smooth`](super::smooth) plus
    /// [`amplitude`](super::amplitude) × Westergaard functions of the tips ×
    /// [`cut_off`](super::cut_off), plus a [`level`](super::level) for each component at a junction
    /// × cut-off. Patches near a tip have its functions with these factors, all else is expanded by
    /// Taylor's formula about each patch, so that neighbours agree up to h³.
    Taylor,
    /// One polynomial everywhere: for each component the coefficients of the monomials, in the
    /// order of datasets, of x and y measured from the domain's centre. Blocks other than the
    /// smooth one get zeros. Degrees of blocks must suffice.
    Polynomial(Vec<Vec<f64>>),
}

impl Default for Recipe {
    fn default() -> Self {
        let domain = Rect::new(vec2(0.2, -0.3), vec2(0.2 + 4.0 / 3.0, 0.7));
        Self {
            domain,
            cells: [4, 3],
            points: 0,
            level: 2,
            random_rounds: 0,
            tip_level: 5,
            overlap: 1.3,
            weight: WeightFunction::Linear,
            own_frames: false,
            cracks: vec![kinked()],
            degrees: vec![2],
            tip_degree: 0,
            zone: 0.2,
            jumps: true,
            junctions: Vec::new(),
            tip_functions: WESTERGAARD.map(str::to_owned),
            extra: Vec::new(),
            components: 2,
            coefficients: Coefficients::Taylor,
            seed: 1,
        }
    }
}

/// A crack with one kink and two tips in the default domain, along no axis.
#[must_use]
pub fn kinked() -> Crack {
    crack(&[[0.5713, 0.0931], [0.8642, 0.2817], [1.1831, 0.1973]], [CrackEnd::Tip; 2])
}

/// A crack through points.
#[must_use]
pub fn crack(points: &[[f64; 2]], ends: [CrackEnd; 2]) -> Crack {
    Crack::polyline(points.iter().map(|&p| p.into()).collect(), ends)
}

impl Recipe {
    /// A recipe in which everything is random and present: a graded cover, the default domain with
    /// a kinked, a straight and an edge crack, degrees 0 to 8, polynomial frames of their own,
    /// formulas, random coefficients.
    #[must_use]
    pub fn random(seed: u64) -> Self {
        let mut random = Random(seed);
        let text = |text: &str, frame| FunctionKind::Formula {
            text: text.to_owned(),
            frame,
            parameters: vec![("a".to_owned(), 1.5)],
            declared: NonsmoothPoints::default(),
            role: Role::User,
        };
        let frame = Frame::Fixed { origin: vec2(0.9, 0.1), angle: random.between(-3.0, 3.0) };
        Self {
            points: 20 * random.below(2),
            level: 1,
            random_rounds: 1 + random.below(3) as u32,
            tip_level: 4 + random.below(2) as u8,
            overlap: random.between(1.05, 1.7),
            weight: WeightFunction::ALL[random.below(3)].clone(),
            own_frames: random.below(2) == 0,
            cracks: random_cracks(&mut random),
            degrees: (0..=MAX_DEGREE as u8).collect(),
            tip_degree: random.below(2) as u8,
            extra: vec![
                text("exp(-a*x)*cos(y^2) - r^3/(1 + x^2)", frame),
                text("x*y^2", Frame::World),
            ],
            coefficients: Coefficients::Random,
            seed,
            ..Self::default()
        }
    }

    /// The recipe with arcs of random bulges in place of the first edge of each crack and of three
    /// in four others.
    #[must_use]
    pub fn with_arcs(mut self) -> Self {
        let mut random = Random(self.seed ^ 0xa7c5);
        let mut bulge = |edge: usize| {
            let is_arc = edge == 0 || random.below(4) > 0;
            if is_arc { random.between(-0.4, 0.4) } else { 0.0 }
        };
        for crack in &mut self.cracks {
            crack.bulges = (0..crack.points.len() - 1).map(&mut bulge).collect();
        }
        self
    }

    /// The partition of unity.
    ///
    /// # Panics
    /// If the recipe allows no cover.
    #[must_use]
    pub fn partition(&self) -> BoxPartition {
        let mut random = Random(self.seed);
        let mut cover = self.cover(&mut random);
        for _ in 0..self.random_rounds {
            cover.refine(|_, _| random.below(4) == 0).expect("a cover");
        }
        let tips: Vec<Vec2> = self.tips().map(|tip| self.position(tip)).collect();
        let fine = || tips.iter().copied().chain(self.junctions.iter().map(|j| j.center));
        let near = |cell: Rect| fine().any(|place| cell.contains(place));
        while cover.refine(|cell, level| level < self.tip_level && near(cell)).expect("a cover") > 0
        {
        }
        let mut partition = cover.partition(self.overlap, self.weight.clone()).expect("an overlap");
        if self.own_frames {
            for (k, origin) in partition.origin.iter_mut().enumerate() {
                let half = partition.half[k];
                *origin = *origin + vec2(0.2 * half.x, -0.1 * half.y);
                partition.scale[k] = vec2(half.x * 0.7, half.y * 1.2);
            }
        }
        partition
    }

    fn cover(&self, random: &mut Random) -> Cover {
        if self.points > 0 {
            let points = (0..self.points).map(|_| random.point(&self.domain)).collect();
            return Cover::scattered(self.domain, self.cells, points).expect("a cover");
        }
        let mut cover = Cover::grid(self.domain, self.cells).expect("a grid");
        while cover.refine(|_, level| level < self.level).expect("a cover") > 0 {}
        cover
    }

    /// The tips, in the order of their functions.
    pub fn tips(&self) -> impl Iterator<Item = TipId> + '_ {
        tips(&self.cracks)
    }

    /// The position of a tip.
    #[must_use]
    pub fn position(&self, tip: TipId) -> Vec2 {
        self.cracks[tip.crack as usize].end_point(tip.end)
    }
}

/// A kinked crack with two tips, an oblique straight one, and a kinked one from the left edge.
fn random_cracks(random: &mut Random) -> Vec<Crack> {
    let mut near =
        |x: f64, y: f64| [x + random.between(-0.04, 0.04), y + random.between(-0.04, 0.04)];
    let inner = [near(0.6, 0.4), near(0.8, 0.28), near(1.0, 0.42), near(1.25, 0.36)];
    let straight = [near(0.75, -0.15), near(1.2, 0.05)];
    let edge = [[0.2, near(0.0, 0.1)[1]], near(0.35, 0.12), near(0.45, -0.02)];
    vec![
        crack(&inner, [CrackEnd::Tip; 2]),
        crack(&straight, [CrackEnd::Tip; 2]),
        crack(&edge, [CrackEnd::Mouth, CrackEnd::Tip]),
    ]
}
