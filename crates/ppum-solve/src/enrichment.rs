//! Which functions each patch's local space holds beside its polynomials.
//!
//! A crack cuts a patch *through* when it meets the open box of the patch and has no tip inside it;
//! then the patch gets the side of the crack times its polynomials (a jump). A patch with a tip
//! inside gets the Westergaard functions of the tip, times linear polynomials by default: the far
//! part of such a patch is cut but holds no jump, and without them the r^{3/2} term of the solution
//! is badly seen there. In a zone of fixed radius around a tip all patches get the Westergaard
//! functions, beside jumps where they are cut.

use crate::problem::{Enrichment, Problem};
use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::Partition;
use ppum::function::{Frame, Function, FunctionKind, WESTERGAARD};
use ppum::vec2::{Rect, Vec2};

/// Shortest part of a crack inside a patch, in half-sizes of the patch, that counts as a cut.
const LEAST_CUT: f64 = 1e-9;

/// A block to be: function index and polynomial degree.
pub(crate) type Block = (u32, u8);

/// The function table of a problem: 1, the sides of the cracks, four functions a tip.
pub(crate) struct Functions {
    pub(crate) table: Vec<Function>,
    tips: Vec<TipId>,
    n_cracks: usize,
}

impl Functions {
    pub(crate) fn new(cracks: &[Crack]) -> Self {
        let one = Function { name: "one".into(), kind: FunctionKind::One };
        let side = |crack: u32| Function {
            name: format!("side of crack {crack}"),
            kind: FunctionKind::Side { crack },
        };
        let tips: Vec<_> = tips(cracks).collect();
        let westergaard = tips.iter().flat_map(|&tip| {
            WESTERGAARD.iter().enumerate().map(move |(k, text)| Function {
                name: format!("westergaard {} of crack {} {}", k + 1, tip.crack, tip.end.name()),
                kind: FunctionKind::formula(text, Frame::Tip(tip)),
            })
        });
        let sides = (0..cracks.len() as u32).map(side);
        let table = std::iter::once(one).chain(sides).chain(westergaard).collect();
        Self { table, tips, n_cracks: cracks.len() }
    }

    fn side(&self, crack: usize) -> u32 {
        1 + crack as u32
    }

    /// The four functions of the tip with this position in the order of [`tips`].
    fn westergaard(&self, tip: usize) -> impl Iterator<Item = u32> {
        let first = (1 + self.n_cracks + 4 * tip) as u32;
        first..first + 4
    }
}

/// Decides the blocks of every patch.
pub(crate) struct Enricher<'a> {
    problem: &'a Problem,
    functions: &'a Functions,
    tip_points: Vec<Vec2>,
    radii: Vec<f64>,
}

impl<'a> Enricher<'a> {
    pub(crate) fn new(problem: &'a Problem, functions: &'a Functions) -> Self {
        let point = |tip: &TipId| problem.cracks[tip.crack as usize].end_point(tip.end);
        Self {
            problem,
            functions,
            tip_points: functions.tips.iter().map(point).collect(),
            radii: functions.tips.iter().map(|&tip| problem.enrichment_radius(tip)).collect(),
        }
    }

    /// The blocks of one patch with polynomials of degree `degree`: polynomials first, then jumps,
    /// then tip functions.
    pub(crate) fn blocks(&self, partition: &Partition, patch: usize, degree: u8) -> Vec<Block> {
        let support = partition.support(patch);
        let open = support.intersection(&self.problem.domain);
        let mode = self.problem.discretization.enrichment;
        let mut blocks = vec![(0, degree)];
        if mode == Enrichment::None {
            return blocks;
        }
        let shortest = LEAST_CUT * partition.half[patch].x.min(partition.half[patch].y);
        let cut: Vec<_> =
            self.problem.cracks.iter().map(|c| length_inside(c, &open) > shortest).collect();
        let holds: Vec<_> = self.tip_points.iter().map(|&tip| inside(&open, tip)).collect();
        if mode != Enrichment::AdditiveOnly {
            let jumps = (0..cut.len()).filter(|&crack| cut[crack] && !self.any_tip(crack, &holds));
            blocks.extend(jumps.map(|crack| (self.functions.side(crack), degree)));
        }
        for tip in 0..holds.len() {
            if let Some(degree) = self.tip_degree(mode, tip, &support, &cut, &holds) {
                blocks.extend(self.functions.westergaard(tip).map(|f| (f, degree)));
            }
        }
        blocks
    }

    /// Degree of the polynomials that multiply the functions of a tip, if the patch has them.
    fn tip_degree(
        &self,
        mode: Enrichment,
        tip: usize,
        support: &Rect,
        cut: &[bool],
        holds: &[bool],
    ) -> Option<u8> {
        let zone = support.distance(self.tip_points[tip]) < self.radii[tip];
        let crack = self.functions.tips[tip].crack as usize;
        match mode {
            Enrichment::None => None,
            Enrichment::AdditiveOnly => {
                let nearest = cut[crack] && self.nearest_tip(crack, support.center()) == Some(tip);
                (holds[tip] || zone || nearest).then_some(0)
            }
            _ if holds[tip] => Some(self.problem.discretization.tip_degree as u8),
            Enrichment::Zone if zone => Some(0),
            _ => None,
        }
    }

    fn any_tip(&self, crack: usize, holds: &[bool]) -> bool {
        self.tips_of(crack).any(|tip| holds[tip])
    }

    fn nearest_tip(&self, crack: usize, from: Vec2) -> Option<usize> {
        let distance = |tip: usize| (self.tip_points[tip] - from).length();
        self.tips_of(crack).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
    }

    fn tips_of(&self, crack: usize) -> impl Iterator<Item = usize> + '_ {
        let of_crack = move |&tip: &usize| self.functions.tips[tip].crack as usize == crack;
        (0..self.functions.tips.len()).filter(of_crack)
    }
}

/// True if `p` lies in the open box.
fn inside(open: &Rect, p: Vec2) -> bool {
    p.x > open.min.x && p.x < open.max.x && p.y > open.min.y && p.y < open.max.y
}

/// Length of a crack inside an open box; a segment along the box's border does not count.
pub(crate) fn length_inside(crack: &Crack, open: &Rect) -> f64 {
    crack.points.windows(2).map(|s| segment_inside(s[0], s[1], open)).sum()
}

/// Length of a segment inside an open box, by clipping its parameter range (Liang & Barsky 1984).
fn segment_inside(a: Vec2, b: Vec2, open: &Rect) -> f64 {
    let d = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (start, step, lo, hi) in
        [(a.x, d.x, open.min.x, open.max.x), (a.y, d.y, open.min.y, open.max.y)]
    {
        if step == 0.0 {
            if start <= lo || start >= hi {
                return 0.0;
            }
        } else {
            let (s, t) = ((lo - start) / step, (hi - start) / step);
            (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
        }
    }
    (to - from).max(0.0) * d.length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn clipped_lengths() {
        let open = Rect::new(vec2(0.0, 0.0), vec2(2.0, 1.0));
        for (a, b, expected) in [
            (vec2(-1.0, 0.5), vec2(3.0, 0.5), 2.0),
            (vec2(0.5, 0.5), vec2(0.5, 0.75), 0.25),
            (vec2(0.0, 0.0), vec2(2.0, 0.0), 0.0),
            (vec2(-1.0, -1.0), vec2(3.0, 3.0), 2f64.sqrt()),
            (vec2(-1.0, 0.5), vec2(1.0, 3.0), 0.0),
        ] {
            assert!((segment_inside(a, b, &open) - expected).abs() < 1e-15, "{a:?} {b:?}");
        }
    }
}
