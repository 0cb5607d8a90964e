//! The domain: a box and its holes, or the box around a mesh.

use ppum::dataset::Dataset;
use ppum::domain::{Domain, Hole, PolygonSide};
use ppum::vec2::Vec2;

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
            let rows = group.table(HOLE).into_iter();
            domain.holes = rows.filter_map(|row| row.hole(&group)).collect();
        }
        Some(kind) => {
            group.refuse(name, ObjectKind::Group, kind.word().unwrap_or_default());
        }
        None => {}
    },
);

/// A hole as a row of its group.
#[derive(Clone, Default)]
struct StoredHole {
    kind: HoleKind,
    points: Vec<Vec2>,
    radius: f64,
}

const HOLE: &TableMembers<StoredHole> = members!(StoredHole:
    cell("kind", kind), list("points", "offsets", points), cell("radius", radius));

impl StoredHole {
    fn of(hole: &Hole) -> Self {
        let (kind, points, radius) = match hole {
            Hole::Circle { center, radius } => (HoleKind::Circle, vec![*center], *radius),
            Hole::Polygon { points, side } => match side {
                PolygonSide::Inside => (HoleKind::Polygon, points.clone(), 0.0),
                PolygonSide::Outside => (HoleKind::Outside, points.clone(), 0.0),
            },
        };
        Self { kind, points, radius }
    }

    fn hole(self, group: &GroupReader) -> Option<Hole> {
        let Self { kind, points, radius } = self;
        match (kind, &*points) {
            _ if group.is_wrong("kind") => {}
            (HoleKind::Circle, &[center]) => return Some(Hole::Circle { center, radius }),
            (HoleKind::Circle, _) if group.is_wrong("points") => {}
            (HoleKind::Circle, other) => {
                group.error("offsets", format!("a circle has 1 point, not {}", other.len()));
            }
            _ if radius != 0.0 => {
                group.error("radius", format!("is {radius} of a polygon, must be 0"));
            }
            (HoleKind::Polygon, _) => return Some(Hole::polygon(points)),
            (HoleKind::Outside, _) => return Some(Hole::outside(points)),
        }
        None
    }
}
