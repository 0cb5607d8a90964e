//! The domain: a box and its holes, or the box around a mesh.

use ppum::dataset::Dataset;
use ppum::domain::{Domain, Hole, PolygonSide};
use ppum::vec2::Vec2;

use super::edges::{arcs, padded};
use crate::content::ObjectKind;
use crate::member::{GroupShape, Member, TableMembers, members, names_of};
use crate::reader::GroupReader;
use crate::stored::{DomainKind, HoleKind, StoredWord as _};

pub(super) const DOMAIN: Member<Dataset> = Member::<Dataset>::group(
    "domain",
    (GroupShape::Single, || names_of(MEMBERS)),
    |dataset, group, name| {
        let is_mesh = dataset.steps.iter().any(|step| step.partition.mesh().is_some());
        let kind = match (is_mesh, dataset.domain.holes.is_empty()) {
            (true, _) => DomainKind::Mesh,
            (false, true) => DomainKind::Box,
            (false, false) => DomainKind::BoxWithHoles,
        };
        let mut group = group.group(name);
        group.attribute("kind", &kind)?;
        group.put(MEMBERS, &dataset.domain)
    },
    |dataset, group, name, _| group.group(name).take(MEMBERS, &mut dataset.domain),
);

const MEMBERS: &[Member<Domain>] = members!(Domain:
    attribute("min", bounds.min), attribute("max", bounds.max), custom(STORED_HOLES));

/// The holes of a domain whose kind has them.
const STORED_HOLES: Member<Domain> = Member::<Domain>::group(
    "holes",
    (GroupShape::Table, || names_of(HOLE)),
    |domain, group, name| {
        let rows: Vec<_> = domain.holes.iter().map(StoredHole::of).collect();
        if rows.is_empty() { Ok(()) } else { group.group(name).put(HOLE, &rows) }
    },
    |domain, group, name, _| match group.known_attribute("kind") {
        Some(DomainKind::BoxWithHoles) => {
            let group = group.group(name);
            let rows = group.table(HOLE).into_iter().enumerate();
            domain.holes = rows.filter_map(|(k, row)| row.hole(&group, k)).collect();
        }
        Some(kind) => {
            group.refuse(name, ObjectKind::Group, kind.word().unwrap_or_default());
        }
        None => {}
    },
);

/// A hole as a row of its group: of one without arcs the bulges are 0.
#[derive(Clone, Default)]
struct StoredHole {
    kind: HoleKind,
    points: Vec<Vec2>,
    bulges: Vec<f64>,
    radius: f64,
}

const HOLE: &TableMembers<StoredHole> = members!(StoredHole:
    cell("kind", kind), list("points", "offsets", points), bulges("kind"), cell("radius", radius));

impl StoredHole {
    fn of(hole: &Hole) -> Self {
        let is_curved = hole.edges().any(|edge| edge.is_arc());
        let (kind, points, bulges, radius) = match hole {
            Hole::Circle { center, radius } => (HoleKind::Circle, vec![*center], vec![], *radius),
            Hole::Polygon { points, bulges, side, .. } => {
                let kind = match (side, is_curved) {
                    (PolygonSide::Inside, false) => HoleKind::Polygon,
                    (PolygonSide::Inside, true) => HoleKind::CurvedPolygon,
                    (PolygonSide::Outside, false) => HoleKind::Outside,
                    (PolygonSide::Outside, true) => HoleKind::CurvedOutside,
                };
                (kind, points.clone(), bulges.clone(), 0.0)
            }
        };
        Self { kind, bulges: padded(&bulges, points.len()), points, radius }
    }

    fn is_curved(&self) -> bool {
        matches!(self.kind, HoleKind::CurvedPolygon | HoleKind::CurvedOutside)
    }

    /// The hole of row k.
    fn hole(self, group: &GroupReader, k: usize) -> Option<Hole> {
        let says = self.is_curved();
        let Self { kind, points, bulges, radius } = self;
        if group.is_wrong("kind") {
            return None;
        }
        let bulges = arcs(group, ("kind", &[says]), &format!("hole {k}"), bulges);
        let side = match (kind, &*points) {
            (HoleKind::Circle, &[center]) => return Some(Hole::Circle { center, radius }),
            (HoleKind::Circle, _) if group.is_wrong("points") => return None,
            (HoleKind::Circle, other) => {
                group.error("offsets", format!("a circle has 1 point, not {}", other.len()));
                return None;
            }
            _ if radius != 0.0 => {
                group.error("radius", format!("is {radius} of a polygon, must be 0"));
                return None;
            }
            (HoleKind::Polygon | HoleKind::CurvedPolygon, _) => PolygonSide::Inside,
            (HoleKind::Outside | HoleKind::CurvedOutside, _) => PolygonSide::Outside,
        };
        Some(Hole::with_arcs(points, bulges, side))
    }
}
