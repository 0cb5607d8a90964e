//! The functions that each patch's local space holds beside its polynomials.
//!
//! All enrichments, built in or of a problem's own, are *instances*: functions, the patches that
//! have them, the degree of the polynomials that multiply them.
//!
//! A patch that cracks cut into several parts gets functions that jump there times its polynomials:
//! the sides of cracks, or where these meet or cut slivers off indicators of the parts ([`Jumps`]).
//! A patch with a tip inside gets the Westergaard functions of the tip, times linear polynomials by
//! default: the far part of such a patch is cut but holds no jump, and without them the r^{3/2}
//! term of the solution is badly seen there. In a zone of fixed radius around a tip all patches get
//! the Westergaard functions, beside jumps where they are cut.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::OnceLock;

use super::williams::of_corner;
use crate::corner::corners;
use crate::terms::known_fields;
use ppum::anisotropy::TIP_FUNCTIONS;
use ppum::border::touch;
use ppum::crack::{Crack, End, SegmentId, TipId, tips};
use ppum::dataset::BoxPartition;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::expression::Expression;
use ppum::function::{Cut, Frame, Function, FunctionKind, Role, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::{
    BoxList, Jumps, around, distance, edge_inside, exceeds, inside, length_inside, wider,
};
use ppum_problem::{Enrichment, EnrichmentRegion, LocalEnrichment, Problem, Site};

/// Shortest part of a crack or segment inside a patch, in half-sizes of the patch, that counts as a
/// cut.
const LEAST_CUT: f64 = 1e-9;

/// A block to be: function index and polynomial degree.
pub(crate) type BlockSpec = (u32, u8);

/// The function table of a problem, and which patches have which functions.
pub(crate) struct Enrichments<'p> {
    pub(crate) table: Vec<Function>,
    problem: &'p Problem,
    /// The cracks across which patches have jumps; none where the mode has no jumps.
    jumps: Option<Jumps<'p>>,
    /// The numbers of components by a single crack, by their cuts.
    one_sided: BTreeMap<Vec<(SegmentId, i64, i64)>, u32>,
    instances: Vec<Instance>,
    /// The numbers of the instances, by the places of their patches, once all are there.
    placed: OnceLock<BoxList<usize>>,
    /// Those of the problem's own among the instances.
    own: Range<usize>,
}

/// Functions that go together.
struct Instance {
    functions: Range<u32>,
    /// The tip in whose frame they are, if there is one.
    tip: Option<TipId>,
    patches: Patches,
    degree: Degree,
}

/// The patches that have an instance.
enum Patches {
    All,
    /// Those that hold the shape or are cut by it, and those nearer to it than a length.
    Near(ZoneCore, f64),
    /// The patches on the tip's crack, farther from the tip than its length, that have no other tip
    /// of the crack nearer.
    Behind(TipId, f64),
    /// Those where the expression is positive.
    Where(Expression),
    /// These, ascending.
    Listed(Vec<u32>),
}

/// A shape that patches can be near to.
#[derive(Clone, Copy)]
enum ZoneCore {
    Point(Vec2),
    Segment([Vec2; 2]),
}

/// Degree of the polynomials of an instance.
#[derive(Clone, Copy)]
enum Degree {
    /// That of the patch's smooth polynomials.
    OfPatch,
    /// One less: the functions vanish like a distance.
    BelowPatch,
    Fixed(u8),
    /// This degree on patches that hold the point, else 0.
    Holding(Vec2, u8),
    /// That of so many terms of Williams' series, or as many as the patch's smooth polynomials
    /// ask for.
    Series {
        terms: Option<usize>,
        is_on_arc: bool,
    },
}

/// Frame and extent of the functions of an enrichment, which may have several of these zones.
struct EnrichmentZone {
    frame: Frame,
    /// The shape that patches are near to; none in the world's frame.
    shape: Option<ZoneCore>,
    /// Their distance from it by default.
    radius: f64,
    degree: Degree,
    /// Added to the functions' names.
    name: String,
}

impl<'p> Enrichments<'p> {
    pub(crate) fn new(problem: &'p Problem) -> Self {
        let one = Function { name: "one".into(), kind: FunctionKind::One };
        let mut all = Self {
            table: vec![one],
            problem,
            jumps: None,
            one_sided: BTreeMap::new(),
            instances: Vec::new(),
            placed: OnceLock::new(),
            own: 0..0,
        };
        let mode = problem.discretization.enrichment;
        if mode.has_jumps() {
            all.add_jumps();
        }
        if let Some(at_tips) = westergaard(mode) {
            all.add(&at_tips, Role::Tip);
        }
        match mode {
            Enrichment::AdditiveOnly => all.extend_along_cracks(),
            Enrichment::Williams if problem.has_series() => {
                all.take_series(problem.discretization.tip_terms);
            }
            _ => {}
        }
        let first = all.instances.len();
        problem.enrichments.iter().for_each(|own| all.add(own, Role::User));
        all.own = first..all.instances.len();
        all
    }

    /// The sides of all cracks, the first functions of the table after the function 1.
    fn add_jumps(&mut self) {
        let (cracks, domain) = (self.problem.cracks(), self.problem.domain());
        let side = |crack: u32| Function {
            name: format!("side of crack {crack}"),
            kind: FunctionKind::Side { crack },
        };
        self.table.extend((0..cracks.len() as u32).map(side));
        self.jumps = Some(Jumps::new(cracks, domain, touch(&domain.bounds)));
    }

    fn add(&mut self, new: &LocalEnrichment, role: Role) {
        for zone in zones(self.problem, new.site) {
            let patches = match (&new.region, zone.shape) {
                (EnrichmentRegion::Where(condition), _) => Patches::Where(condition.clone()),
                (EnrichmentRegion::Near(radius), Some(shape)) => Patches::Near(shape, *radius),
                (_, Some(shape)) => Patches::Near(shape, zone.radius),
                (_, None) => Patches::All,
            };
            let degree = new.degree.map_or(zone.degree, |degree| Degree::Fixed(degree as u8));
            let mut functions = functions(new, &zone, role);
            if let (Role::Tip, Frame::Tip(tip)) = (role, zone.frame) {
                self.take_anisotropy(&mut functions, tip);
            }
            self.push(functions, patches, degree);
        }
    }

    /// Makes the functions of a tip those of an anisotropic body, if it is in one.
    fn take_anisotropy(&self, functions: &mut [Function], tip: TipId) {
        let Some(body) = self.problem.equation.anisotropy() else { return };
        let crack = &self.problem.cracks()[tip.crack as usize];
        let law = body.at_tip(crack.end_point(tip.end), crack.growth_direction(tip.end));
        for (function, new) in functions.iter_mut().zip(TIP_FUNCTIONS) {
            if let FunctionKind::Formula { text, parameters, .. } = &mut function.kind {
                (*text, *parameters) = (new.to_owned(), law.parameters());
            }
        }
    }

    fn push(&mut self, functions: Vec<Function>, patches: Patches, degree: Degree) {
        let first = self.table.len() as u32;
        self.table.extend(functions);
        let functions = first..self.table.len() as u32;
        self.placed.take();
        let tip = match &self.table[first as usize].kind {
            FunctionKind::Formula { frame: Frame::Tip(tip), .. } => Some(*tip),
            _ => None,
        };
        self.instances.push(Instance { functions, tip, patches, degree });
    }

    /// Gives the functions of the tips, so far the only instances, the degree of Williams' series
    /// of some number of terms.
    fn take_series(&mut self, terms: Option<usize>) {
        let cracks = self.problem.cracks();
        for Instance { tip, degree, .. } in &mut self.instances {
            let is_on_arc =
                tip.is_some_and(|id| cracks[id.crack as usize].edge_to(id.end).is_arc());
            *degree = Degree::Series { terms, is_on_arc };
        }
    }

    /// Gives the patches of a partition in the rooms of corners that turn inwards the functions
    /// of these.
    pub(crate) fn add_corners(&mut self, partition: &BoxPartition) {
        let bounds = self.problem.domain().bounds;
        for corner in corners(self.problem) {
            let has = |&k: &u32| {
                corner.has_room_for(&partition.support(k as usize).intersection(&bounds))
            };
            let patches: Vec<u32> = (0..partition.len() as u32).filter(has).collect();
            for (functions, _) in of_corner(&corner, &self.problem.equation) {
                if !patches.is_empty() {
                    self.push(functions, Patches::Listed(patches.clone()), Degree::Fixed(0));
                }
            }
        }
    }

    /// Gives patches of a partition the fields that are known.
    pub(crate) fn add_known(&mut self, partition: &BoxPartition) {
        let bounds = self.problem.domain().bounds;
        for field in known_fields(self.problem) {
            let patches = Patches::Listed(field.patches(partition, &bounds));
            self.push(field.functions, patches, Degree::Fixed(0));
        }
    }

    /// Gives the functions of each tip, so far the only instances, to the patches along its part of
    /// the crack too.
    fn extend_along_cracks(&mut self) {
        let at_tips = self.instances.iter().zip(tips(self.problem.cracks()));
        let behind = |(instance, tip): (&Instance, TipId)| Instance {
            functions: instance.functions.clone(),
            tip: instance.tip,
            patches: Patches::Behind(tip, self.problem.enrichment_radius(tip)),
            degree: instance.degree,
        };
        let behind: Vec<_> = at_tips.map(behind).collect();
        self.instances.extend(behind);
    }

    /// The blocks of one patch with polynomials of degree `degree`: polynomials first, then jumps,
    /// then the other enrichments.
    pub(crate) fn blocks(
        &mut self,
        partition: &BoxPartition,
        patch: usize,
        degree: u8,
    ) -> Vec<BlockSpec> {
        let seen = EnrichmentPatch::new(partition, patch, self.problem);
        let mut blocks = vec![(0, degree)];
        blocks.extend(self.jumps(&seen).into_iter().map(|function| (function, degree)));
        let near = self.placed().near(&seen.support).map(|&k| &self.instances[k]);
        let misled = |new: &&Instance| new.tip.is_some_and(|tip| self.misleads(tip, &seen.open));
        for instance in near.filter(|new| seen.is_of(&new.patches) && !misled(new)) {
            let degree = instance.degree.on(&seen, degree);
            blocks.extend(instance.functions.clone().map(|function| (function, degree)));
        }
        blocks
    }

    /// True if the functions of a tip jump in a box where nothing else does.
    fn misleads(&self, tip: TipId, open: &Rect) -> bool {
        let mislead = |jumps: &Jumps<'_>| jumps.mislead(tip, open) || jumps.is_beyond(tip, open);
        self.jumps.as_ref().is_some_and(mislead)
    }

    /// The functions that jump in a patch; those of its own come to the table.
    fn jumps(&mut self, patch: &EnrichmentPatch<'_>) -> Vec<u32> {
        let all = self.jumps.as_ref().map_or_else(Vec::new, |jumps| jumps.of(&patch.open));
        all.into_iter().enumerate().map(|(k, kind)| self.jump(k, kind, patch)).collect()
    }

    /// The number of a patch's k-th jump in the table. Patches that one crack cuts in the same way
    /// share it.
    fn jump(&mut self, k: usize, kind: FunctionKind, patch: &EnrichmentPatch<'_>) -> u32 {
        let new = self.table.len() as u32;
        let cuts = match &kind {
            FunctionKind::Side { crack } => return crack + 1,
            FunctionKind::Component { cuts } => cuts,
            _ => &Vec::new(),
        };
        let cracks: BTreeSet<u32> = cuts.iter().map(|cut| cut.segment.crack).collect();
        let name = match cracks.first() {
            Some(only) if cracks.len() == 1 => {
                let number = |cut: &Cut| (cut.segment, cut.left.number(), cut.right.number());
                let known = self.one_sided.entry(cuts.iter().map(number).collect()).or_insert(new);
                if *known != new {
                    return *known;
                }
                format!("one side of crack {only}")
            }
            _ => format!("component {} of patch {}", k + 1, patch.index),
        };
        self.table.push(Function { name, kind });
        new
    }
}

/// Number of terms of Williams' series beside polynomials of a degree. Measured at orders 1 to 8
/// (docs/decisions/0016): fewer limit the rate at which errors fall, more gain nothing.
///
/// Cut off after N terms, the series of a tip on an arc leaves tractions of the order κ^N r^(N − ½)
/// on the faces, which change K itself, so that it has one term more; what is left out of the
/// series of a straight crack leaves none (docs/decisions/0048-arcs.md).
fn terms(degree: usize, is_on_arc: bool) -> usize {
    let more = usize::from(is_on_arc);
    (degree + more).clamp(FEWEST_TERMS, ENOUGH_TERMS + more)
}

const FEWEST_TERMS: usize = 3;
const ENOUGH_TERMS: usize = 6;

impl Degree {
    /// The degree on a patch whose smooth polynomials have the degree `degree`.
    fn on(self, patch: &EnrichmentPatch<'_>, degree: u8) -> u8 {
        match self {
            Self::OfPatch => degree,
            Self::BelowPatch => degree.saturating_sub(1),
            Self::Fixed(degree) => degree,
            Self::Holding(p, inside) if patch.holds(p) => inside,
            Self::Holding(..) => 0,
            Self::Series { terms: given, is_on_arc } => {
                (given.unwrap_or(terms(degree.into(), is_on_arc)) - 1) as u8
            }
        }
    }
}

impl Enrichments<'_> {
    fn placed(&self) -> &BoxList<usize> {
        let instances = self.instances.iter().enumerate();
        let zone = |(k, new): (usize, &Instance)| (new.patches.zone(self.problem), k);
        self.placed.get_or_init(|| BoxList::new(instances.map(zone)))
    }
}

impl Patches {
    /// A box that all of the patches meet.
    fn zone(&self, problem: &Problem) -> Rect {
        let everywhere = wider(&problem.domain().bounds, problem.domain().bounds.size().length());
        match self {
            Patches::All | Patches::Listed(_) | Patches::Where(_) => everywhere,
            Patches::Near(ZoneCore::Point(p), radius) => wider(&around(&[*p]), *radius),
            Patches::Near(ZoneCore::Segment(ends), radius) => wider(&around(ends), *radius),
            Patches::Behind(tip, _) => problem.cracks()[tip.crack as usize].bounds(),
        }
    }
}

/// The built-in enrichment of tips.
fn westergaard(mode: Enrichment) -> Option<LocalEnrichment> {
    let new = LocalEnrichment {
        name: "westergaard".into(),
        ..LocalEnrichment::new(&WESTERGAARD, Site::Tips)
    };
    match mode {
        Enrichment::None | Enrichment::Jumps => None,
        Enrichment::TipPatch => {
            Some(LocalEnrichment { region: EnrichmentRegion::Near(0.0), ..new })
        }
        Enrichment::Zone | Enrichment::Williams => Some(new),
        Enrichment::AdditiveOnly => Some(LocalEnrichment { degree: Some(0), ..new }),
    }
}

fn zones(problem: &Problem, site: Site) -> Vec<EnrichmentZone> {
    let zone = |frame, shape, name| EnrichmentZone {
        frame,
        shape,
        radius: 0.0,
        degree: Degree::Fixed(0),
        name,
    };
    match site {
        Site::World => vec![zone(Frame::World, None, String::new())],
        Site::Point { at, angle } => {
            let name = format!(" at [{}, {}]", at.x, at.y);
            let frame = Frame::Fixed { origin: at, angle };
            vec![zone(frame, Some(ZoneCore::Point(at)), name)]
        }
        Site::Along([a, b]) => {
            let name = format!(" along [{}, {}] to [{}, {}]", a.x, a.y, b.x, b.y);
            let frame = Frame::Fixed { origin: a, angle: (b.y - a.y).atan2(b.x - a.x) };
            vec![zone(frame, Some(ZoneCore::Segment([a, b])), name)]
        }
        Site::Tips => tips(problem.cracks()).map(|tip| at_tip(problem, tip)).collect(),
    }
}

fn at_tip(problem: &Problem, tip: TipId) -> EnrichmentZone {
    let point = problem.cracks()[tip.crack as usize].end_point(tip.end);
    EnrichmentZone {
        frame: Frame::Tip(tip),
        shape: Some(ZoneCore::Point(point)),
        radius: problem.enrichment_radius(tip),
        degree: Degree::Holding(point, problem.discretization.tip_degree as u8),
        name: format!(" of crack {} {}", tip.crack, tip.end.name()),
    }
}

fn functions(new: &LocalEnrichment, zone: &EnrichmentZone, role: Role) -> Vec<Function> {
    let name = |k: usize, text: &str| match (new.name.as_str(), new.functions.len()) {
        ("", _) => format!("{text}{}", zone.name),
        (name, 1) => format!("{name}{}", zone.name),
        (name, _) => format!("{name} {}{}", k + 1, zone.name),
    };
    let function = |(k, text): (usize, &String)| Function {
        name: name(k, text),
        kind: FunctionKind::Formula {
            text: text.clone(),
            frame: zone.frame,
            parameters: new.parameters.clone(),
            declared: new.declared.clone(),
            role,
        },
    };
    new.functions.iter().enumerate().map(function).collect()
}

/// A patch as the rules see it.
struct EnrichmentPatch<'p> {
    index: u32,
    cracks: &'p [Crack],
    holes: &'p [Hole],
    support: Rect,
    /// The support inside the domain, as an open box.
    open: Rect,
    /// The shortest cut that counts.
    shortest: f64,
}

impl<'p> EnrichmentPatch<'p> {
    fn new(partition: &BoxPartition, patch: usize, problem: &'p Problem) -> Self {
        let (support, half) = (partition.support(patch), partition.half[patch]);
        Self {
            index: patch as u32,
            cracks: problem.cracks(),
            holes: &problem.domain().holes,
            support,
            open: support.intersection(&problem.domain().bounds),
            shortest: LEAST_CUT * half.x.min(half.y),
        }
    }

    fn is_of(&self, patches: &Patches) -> bool {
        match patches {
            Patches::All => true,
            Patches::Near(ZoneCore::Point(p), radius) => {
                self.holds(*p) || self.is_near(*p, *radius)
            }
            Patches::Near(ZoneCore::Segment([a, b]), radius) => {
                let segment = Edge::segment([*a, *b]);
                edge_inside(segment, &self.support) > self.shortest
                    || distance(segment, &self.support) < *radius
            }
            Patches::Behind(tip, radius) => {
                let crack = &self.cracks[tip.crack as usize];
                !self.is_near(crack.end_point(tip.end), *radius)
                    && self.is_cut(crack)
                    && self.nearest_tip(crack) == Some(tip.end)
            }
            Patches::Listed(all) => all.binary_search(&self.index).is_ok(),
            Patches::Where(expression) => self.looks().any(|p| expression.value(p) > 0.0),
        }
    }

    /// True if the point, also one on the boundary of the domain, lies in the open support.
    fn holds(&self, p: Vec2) -> bool {
        inside(&self.support, p)
    }

    fn is_near(&self, p: Vec2, radius: f64) -> bool {
        exceeds(radius, self.support.distance(p))
    }

    fn is_cut(&self, crack: &Crack) -> bool {
        length_inside(crack, &self.open, self.holes) > self.shortest
    }

    fn nearest_tip(&self, crack: &Crack) -> Option<End> {
        let distance = |&end: &End| (crack.end_point(end) - self.support.center()).length();
        crack.tips().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Centre, corners and middles of the edges, as far as the domain reaches.
    fn looks(&self) -> impl Iterator<Item = Vec2> {
        let (min, half) = (self.open.min, self.open.size() * 0.5);
        let at = move |k: u8| min + vec2(half.x * f64::from(k % 3), half.y * f64::from(k / 3));
        (0..9).map(at)
    }
}

mod interfaces;
#[cfg(test)]
mod tests;
