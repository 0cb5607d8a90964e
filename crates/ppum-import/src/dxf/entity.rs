//! Curves of single entities.

use std::f64::consts::TAU;

use ppum::vec2::{Vec2, vec2};

use super::pairs::{Entities, Entity};
use crate::affine::PlaneMap;
use crate::bspline::BSpline;
use crate::curve::{EllipseArc, PlaneCurve};
use crate::error::ImportError;
use crate::sketch::DrawnCurve;

/// Most rows or columns of an inserted block.
const MOST_COPIES: i64 = 1000;

/// The curve that an entity draws.
pub(super) enum EntityShape {
    Curve(DrawnCurve),
    Insert(Insert),
    /// Something that is not read, by its name.
    Unread(String),
    /// A spline whose course between its points the file does not tell.
    Through(DrawnCurve),
}

/// A block that is inserted once, or in rows and columns.
pub(super) struct Insert {
    pub(super) block: String,
    map: PlaneMap,
    turn: PlaneMap,
    copies: [i64; 2],
    apart: Vec2,
}

impl Insert {
    /// The maps of all copies of a block with a base point.
    pub(super) fn maps(&self, base: Vec2) -> impl Iterator<Item = PlaneMap> {
        let [columns, rows] = self.copies;
        let copies = (0..rows)
            .flat_map(move |row| (0..columns).map(move |column| vec2(column as f64, row as f64)));
        copies.map(move |copy| {
            let shift = vec2(copy.x * self.apart.x, copy.y * self.apart.y);
            let map = self.map.after(&PlaneMap::shifting(-base));
            PlaneMap::shifting(self.turn.vector(shift)).after(&map)
        })
    }
}

/// A vertex of a polyline, with the bulge of the segment after it.
type BulgedVertex = (Vec2, f64);

/// The curve that an entity draws. A polyline takes its vertices from the entities that follow.
pub(super) fn shapes(
    entity: &Entity<'_>,
    entities: &mut Entities<'_>,
) -> Result<Vec<EntityShape>, ImportError> {
    let vertices =
        if entity.kind == "POLYLINE" { polyline(entity, entities)? } else { Some(Vec::new()) };
    let Some(side) = side(entity)? else {
        return Ok(vec![EntityShape::Unread(format!("{} out of the plane", entity.kind))]);
    };
    // these are drawn in the plane of the file, all others in their own
    let is_mirrored = side < 0.0 && !matches!(entity.kind, "LINE" | "ELLIPSE");
    let curves: Vec<DrawnCurve> = match (entity.kind, vertices) {
        ("LINE", _) => vec![DrawnCurve::polyline(vec![entity.point(10)?, entity.point(11)?])],
        ("ARC", _) => arc(entity, [entity.number(50, 0.0)?, entity.number(51, 360.0)?])?,
        ("CIRCLE", _) => arc(entity, [0.0, 360.0])?,
        ("ELLIPSE", _) => vec![ellipse(entity, side)?],
        ("LWPOLYLINE", _) => bulged(&light_vertices(entity)?, entity.flag(70, 1)?),
        ("POLYLINE", Some(vertices)) => bulged(&vertices, entity.flag(70, 1)?),
        ("SPLINE", _) => return Ok(vec![spline(entity)?]),
        ("INSERT", _) => return Ok(vec![EntityShape::Insert(insert(entity, side)?)]),
        // points and what ends a polyline draw nothing
        ("POINT" | "VERTEX" | "SEQEND" | "ATTRIB" | "VIEWPORT", _) => Vec::new(),
        (kind, _) => return Ok(vec![EntityShape::Unread(kind.to_owned())]),
    };
    // own coordinates of a plane seen from behind
    let mirror = PlaneMap::scaling(-1.0, 1.0);
    let seen = |curve: DrawnCurve| if is_mirrored { curve.mapped(&mirror) } else { curve };
    Ok(curves.into_iter().map(|curve| EntityShape::Curve(seen(curve))).collect())
}

/// The sign of the z axis in which the entity's own plane is drawn; nothing if it is tilted.
fn side(entity: &Entity<'_>) -> Result<Option<f64>, ImportError> {
    let (tilt, z) = (entity.point(210)?, entity.number(230, 1.0)?);
    Ok((tilt.length() <= 1e-9 * z.abs()).then(|| z.signum()))
}

/// An arc of a circle, counter-clockwise between angles in degrees; nothing without a radius.
fn arc(entity: &Entity<'_>, [from, to]: [f64; 2]) -> Result<Vec<DrawnCurve>, ImportError> {
    let radius = entity.number(40, 0.0)?;
    let turn = (to - from).rem_euclid(360.0);
    let range = [from, from + if turn > 0.0 { turn } else { 360.0 }].map(f64::to_radians);
    let range = if turn > 0.0 { range } else { [range[0], range[0] + TAU] };
    let arc = EllipseArc::circle(entity.point(10)?, radius, range);
    Ok((radius > 0.0).then(|| PlaneCurve::Arc(arc).into()).into_iter().collect())
}

fn ellipse(entity: &Entity<'_>, side: f64) -> Result<DrawnCurve, ImportError> {
    let major = entity.point(11)?;
    let minor = major.left() * (side * entity.number(40, 1.0)?);
    let [from, to] = [entity.number(41, 0.0)?, entity.number(42, TAU)?];
    let turn = (to - from).rem_euclid(TAU);
    let whole = turn < 1e-12 || TAU - turn < 1e-12;
    let range = [from, from + if whole { TAU } else { turn }];
    if major.length() == 0.0 || minor.length() == 0.0 {
        let message = "the ellipse has an axis of length 0; repair or remove it";
        return Err(entity.source().error(message));
    }
    let arc = EllipseArc { center: entity.point(10)?, radii: [major, minor], range };
    Ok(PlaneCurve::Arc(arc).into())
}

/// The vertices of an LWPOLYLINE: a bulge (42) belongs to the vertex (10, 20) before it.
fn light_vertices(entity: &Entity<'_>) -> Result<Vec<BulgedVertex>, ImportError> {
    let mut vertices: Vec<_> = entity.points(10)?.into_iter().map(|point| (point, 0.0)).collect();
    let bulges = entity.numbers(42)?;
    let (mut vertex, mut bulge) = (0, bulges.iter());
    for pair in &entity.pairs {
        match pair.code {
            10 => vertex += 1,
            42 if vertex > 0 => vertices[vertex - 1].1 = bulge.next().copied().unwrap_or(0.0),
            _ => {}
        }
    }
    Ok(vertices)
}

/// The vertices of a POLYLINE, each an entity of its own; nothing for meshes in space.
fn polyline(
    entity: &Entity<'_>,
    entities: &mut Entities<'_>,
) -> Result<Option<Vec<BulgedVertex>>, ImportError> {
    let mut vertices = Vec::new();
    while let Some(vertex) = entities.entity()? {
        match vertex.kind {
            "SEQEND" => break,
            // control points of a curve that is drawn by other vertices
            "VERTEX" if !vertex.flag(70, 16)? => {
                vertices.push((vertex.point(10)?, vertex.number(42, 0.0)?))
            }
            "VERTEX" => {}
            _ => {
                let message = "a POLYLINE has no SEQEND before this entity; repair the file";
                return Err(vertex.source().error(message));
            }
        }
    }
    Ok((!entity.flag(70, 16 | 64)?).then_some(vertices))
}

/// The straight runs and arcs of a polyline.
fn bulged(vertices: &[BulgedVertex], is_closed: bool) -> Vec<DrawnCurve> {
    let next = vertices.iter().skip(1).chain(vertices.first().filter(|_| is_closed));
    let mut curves: Vec<PlaneCurve> = Vec::new();
    for ((a, bulge), (b, _)) in vertices.iter().zip(next).filter(|(a, b)| a.0 != b.0) {
        // an arc of a height of 1e-12 of its chord is a line
        if bulge.abs() > 1e-12 {
            curves.push(PlaneCurve::Arc(EllipseArc::bulged(*a, *b, *bulge)));
        } else if let Some(PlaneCurve::Polyline(run)) = curves.last_mut() {
            run.push(*b);
        } else {
            curves.push(PlaneCurve::Polyline(vec![*a, *b]));
        }
    }
    curves.into_iter().map(DrawnCurve::from).collect()
}

/// A spline by control points, or else through its fit points.
fn spline(entity: &Entity<'_>) -> Result<EntityShape, ImportError> {
    let (points, mut through) = (entity.points(10)?, entity.points(11)?);
    let degree = usize::try_from(entity.whole(71)?.unwrap_or(3)).unwrap_or(0);
    if let Some(spline) = BSpline::new(degree, entity.numbers(40)?, points, entity.numbers(41)?) {
        return Ok(EntityShape::Curve(spline.into()));
    }
    through.dedup();
    Ok(match through.len() {
        0 | 1 => EntityShape::Unread(
            "SPLINE whose knots, points and degree do not fit together".to_owned(),
        ),
        2 => EntityShape::Curve(DrawnCurve::polyline(through)),
        _ => EntityShape::Through(PlaneCurve::Spline(through).into()),
    })
}

fn insert(entity: &Entity<'_>, side: f64) -> Result<Insert, ImportError> {
    let turn = PlaneMap::turning(entity.number(50, 0.0)?);
    let scale = PlaneMap::scaling(entity.number(41, 1.0)?, entity.number(42, 1.0)?);
    let seen = PlaneMap::scaling(side, 1.0).after(&PlaneMap::shifting(entity.point(10)?));
    let copies = [entity.whole(70)?.unwrap_or(1), entity.whole(71)?.unwrap_or(1)];
    if copies.iter().any(|count| !(1..=MOST_COPIES).contains(count)) {
        return Err(entity.source().error(format!(
            "INSERT has {copies:?} columns and rows, but 1 to {MOST_COPIES} are read"
        )));
    }
    Ok(Insert {
        block: entity.text(2).unwrap_or_default().to_owned(),
        map: seen.after(&turn).after(&scale),
        turn: PlaneMap::scaling(side, 1.0).after(&turn),
        copies,
        apart: vec2(entity.number(44, 0.0)?, entity.number(45, 0.0)?),
    })
}
