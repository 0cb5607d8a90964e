//! Functions that stand for the series of tips and corners: the solution takes combinations of
//! them only.

use crate::corner::{SingularCorner, WedgeTerm, corners};
use crate::terms::{on_side, symmetry_of_field};
use ppum::crack::TipId;
use ppum::dataset::{Equation, Step, monomials};
use ppum::function::{Frame, Function, FunctionKind, GROUP, NonsmoothPoints, Role, WESTERGAARD};
use ppum::library::WEDGE;
use ppum::vec2::Vec2;
use ppum_problem::{Problem, Symmetry};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Functions of a patch that stand for a series, or for one term of it.
#[derive(Clone, Debug)]
pub(crate) struct SeriesFunctions {
    pub(crate) origin: Origin,
    /// The blocks that they are stored in.
    pub(crate) blocks: Range<usize>,
    /// Their numbers among the patch's functions.
    pub(crate) functions: Range<usize>,
    /// Degree of the polynomials that multiply them.
    pub(crate) degree: usize,
}

/// The singular point of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Origin {
    /// The functions of a tip on a patch are the four of [`WESTERGAARD`] times polynomials. With
    /// z = x + iy in the tip's frame
    ///
    /// ```text
    /// r^(n+½) e^{i(n+½)θ} = zⁿ √r e^{iθ/2}      r^(n+½) e^{i(n−3/2)θ} = zⁿ √r e^{−3iθ/2}
    /// ```
    ///
    /// so that Williams' series up to r^(N − ½) are combinations of them with polynomials of degree
    /// N − 1. At a tip on an edge they are those of one symmetry to its axis.
    Tip(TipId, Option<Symmetry>),
    /// The four of [`WEDGE`] in the frame of a corner make one field. For Poisson's equation, one
    /// of them does.
    Corner {
        at: Vec2,
        /// Angle of the bisector.
        bisector: f64,
        term: WedgeTerm,
    },
}

/// Functions of a term at a tip: r^λ cos λθ, r^λ sin λθ, r^λ cos (λ−2)θ, r^λ sin (λ−2)θ.
pub(crate) const ANGULAR: usize = 4;

impl SeriesFunctions {
    /// Number of unknowns.
    pub(crate) fn unknowns(&self, components: usize) -> usize {
        match self.origin {
            // of a term a field for opening and one for sliding, one of both, or one function alone
            Origin::Tip(_, None) => components * self.terms(),
            Origin::Tip(_, Some(_)) => self.terms(),
            Origin::Corner { .. } => 1,
        }
    }

    /// Number of functions that the solver evaluates for it: of a tip those that the terms are made
    /// of, not those that they are stored as.
    pub(crate) fn evaluated(&self) -> usize {
        match self.origin {
            Origin::Tip(..) => ANGULAR * self.terms(),
            Origin::Corner { .. } => self.functions.len(),
        }
    }

    /// Number of terms: N of a tip.
    pub(crate) fn terms(&self) -> usize {
        self.degree + 1
    }
}

/// The series of all patches of a problem's step; none where the material varies, as terms are
/// others then.
pub(super) fn series(problem: &Problem, step: &Step) -> Vec<Vec<SeriesFunctions>> {
    if !problem.has_series() {
        return Vec::new();
    }
    let groups = groups(problem, step);
    (0..step.partition.len()).map(|patch| of_patch(step, patch, &groups)).collect()
}

/// By its first function in the table, the origin of each group of functions, and their number.
type FunctionOrigins = BTreeMap<u32, (Origin, usize)>;

fn groups(problem: &Problem, step: &Step) -> FunctionOrigins {
    let mut groups =
        if problem.has_tip_series() { of_tips(problem, step) } else { BTreeMap::new() };
    // to look for corners takes a second where rims have thousands of vertices
    if !step.functions.iter().any(|function| function.kind.role() == Some(Role::Corner)) {
        return groups;
    }
    for (functions, origin) in
        corners(problem).iter().flat_map(|corner| of_corner(corner, &problem.equation))
    {
        // none if no patch has them
        if let Some(first) = step.functions.iter().position(|f| f.kind == functions[0].kind) {
            groups.insert(first as u32, (origin, functions.len()));
        }
    }
    groups
}

/// The built-in functions of each tip.
fn of_tips(problem: &Problem, step: &Step) -> FunctionOrigins {
    let mut known = BTreeSet::new();
    let mut first = |kind: &FunctionKind| match *kind {
        FunctionKind::Formula { frame: Frame::Tip(tip), role: Role::Tip, .. } => {
            let origin = Origin::Tip(tip, symmetry_of_field(problem, tip));
            known.insert(tip).then_some((origin, WESTERGAARD.len()))
        }
        _ => None,
    };
    let all = (0..).zip(&step.functions);
    all.filter_map(|(index, function)| Some((index, first(&function.kind)?))).collect()
}

/// The functions of a corner, in groups: one for each of its fields.
pub(super) fn of_corner(
    corner: &SingularCorner,
    equation: &Equation,
) -> Vec<(Vec<Function>, Origin)> {
    let Some(wedge) = &corner.wedge else { return Vec::new() };
    let frame = Frame::Fixed { origin: corner.at, angle: wedge.bisector };
    let function = |term: &WedgeTerm, text: &str| Function {
        name: format!("r^{:.3} at [{}, {}]", term.exponent, corner.at.x, corner.at.y),
        kind: FunctionKind::Formula {
            text: on_side(text, wedge.side),
            frame,
            parameters: vec![("lambda".into(), term.exponent)],
            // known, so that quadrature need not look for it
            declared: NonsmoothPoints { singular: vec![Vec2::ZERO], ..NonsmoothPoints::default() },
            role: Role::Corner,
        },
    };
    let texts = |term: &WedgeTerm| match (equation, term.symmetry) {
        (Equation::Elasticity(_), _) => &WEDGE[..],
        (_, Symmetry::Symmetric) => &WEDGE[..1],
        (_, Symmetry::Antisymmetric) => &WEDGE[1..2],
    };
    let group = |term: &WedgeTerm| {
        let functions = texts(term).iter().map(|text| function(term, text)).collect();
        let (at, bisector) = (corner.at, wedge.bisector);
        (functions, Origin::Corner { at, bisector, term: *term })
    };
    wedge.terms.iter().map(group).collect()
}

fn of_patch(step: &Step, patch: usize, groups: &FunctionOrigins) -> Vec<SeriesFunctions> {
    let (data, mut at, mut found) = (&step.fields[0], 0, Vec::new());
    for block in data.blocks(patch) {
        let degree = usize::from(data.block_degree[block]);
        if let Some((origin, count)) = groups.get(&data.block_function[block]) {
            let functions = at..at + count * monomials(degree);
            found.push(SeriesFunctions {
                origin: *origin,
                blocks: block..block + count,
                functions,
                degree,
            });
        }
        at += monomials(degree);
    }
    found
}

const _: () = assert!(GROUP == WESTERGAARD.len() && GROUP == WEDGE.len());
