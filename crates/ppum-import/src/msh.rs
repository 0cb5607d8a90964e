//! Meshes of Gmsh as text, formats 2.2 and 4.1: the boundary of the triangles and quadrilaterals.
//!
//! Edges of one element are the boundary. Two of them between the same places, but with nodes of
//! their own, are the faces of a crack. Physical groups of lines are the names.

use std::collections::{BTreeMap, HashMap};

use ppum::vec2::{Vec2, vec2};

use crate::chain::Joints;
use crate::curve::PlaneCurve;
use crate::error::ImportError;
use crate::sketch::{NamedCurve, Sketch};
use crate::source::SourceLine;

/// Types of elements: number, corners, order.
const ELEMENTS: [(usize, usize, usize); 13] = [
    (1, 2, 1),
    (8, 2, 2),
    (26, 2, 3),
    (27, 2, 4),
    (2, 3, 1),
    (9, 3, 2),
    (21, 3, 3),
    (23, 3, 4),
    (3, 4, 1),
    (10, 4, 2),
    (16, 4, 2),
    (36, 4, 3),
    (37, 4, 4),
];

/// A point, which no boundary needs.
const POINT: usize = 15;

/// Nodes along an edge of an element, with the line of the element.
struct EdgeNodes {
    nodes: Vec<usize>,
    line: usize,
}

/// The lines of a file, and the mesh that was read from them.
#[derive(Default)]
struct GmshMesh<'a> {
    text: Vec<&'a str>,
    /// How many lines were read.
    line: usize,
    version: f64,
    /// Names of physical groups of lines.
    names: HashMap<i64, String>,
    /// Physical groups of curves, in format 4.
    curves: HashMap<i64, i64>,
    /// The numbers of nodes by their tags.
    numbers: HashMap<usize, usize>,
    nodes: Vec<Vec2>,
    /// Edges of triangles and quadrilaterals.
    edges: Vec<EdgeNodes>,
    /// Lines with their physical groups.
    lines: Vec<(EdgeNodes, i64)>,
    sketch: Sketch,
}

pub(crate) fn read(text: &str) -> Result<Sketch, ImportError> {
    let mut mesh = GmshMesh { text: text.lines().collect(), ..GmshMesh::default() };
    while mesh.line < mesh.text.len() {
        match mesh.next()? {
            "$MeshFormat" => mesh.read_format()?,
            "$PhysicalNames" => mesh.read_names()?,
            "$Entities" => mesh.read_entities()?,
            "$Nodes" if mesh.is_blocked() => mesh.read_node_blocks()?,
            "$Nodes" | "$ParametricNodes" => mesh.read_nodes()?,
            "$Elements" if mesh.is_blocked() => mesh.read_element_blocks()?,
            "$Elements" => mesh.read_elements()?,
            _ => {}
        }
    }
    if mesh.version == 0.0 {
        return Err(SourceLine::new(1).error("there is no $MeshFormat; is this a mesh of Gmsh?"));
    }
    mesh.draw()?;
    Ok(mesh.sketch)
}

impl<'a> GmshMesh<'a> {
    fn next(&mut self) -> Result<&'a str, ImportError> {
        let line = self.text.get(self.line).map(|line| line.trim());
        self.line += 1;
        line.ok_or_else(|| self.error("the file ends too early; save or copy it once more"))
    }

    /// The numbers of the next line.
    fn numbers<T: std::str::FromStr>(&mut self, least: usize) -> Result<Vec<T>, ImportError> {
        let all: Result<Vec<T>, _> =
            self.next()?.split_ascii_whitespace().map(str::parse).collect();
        let all = all.ok().filter(|all| all.len() >= least);
        all.ok_or_else(|| {
            self.error(format!("a line of {least} numbers or more belongs here; repair the file"))
        })
    }

    fn error(&self, message: impl std::fmt::Display) -> ImportError {
        SourceLine::new(self.line).error(message)
    }

    fn is_blocked(&self) -> bool {
        self.version >= 4.0
    }

    fn read_format(&mut self) -> Result<(), ImportError> {
        let format: Vec<f64> = self.numbers(3)?;
        if format[1] != 0.0 {
            return Err(
                self.error("is a binary mesh, which is not read; save it as text: Mesh.Binary = 0")
            );
        }
        if format[0] != 2.2 && format[0] != 4.1 {
            let message = format!(
                "is a mesh of format {}, but 2.2 and 4.1 are read; save it with Mesh.MshFileVersion = 4.1",
                format[0]
            );
            return Err(self.error(message));
        }
        self.version = format[0];
        self.sketch.about = Some(format!("Mesh of Gmsh, format {}.", format[0]));
        Ok(())
    }

    fn read_names(&mut self) -> Result<(), ImportError> {
        for _ in 0..self.numbers::<usize>(1)?[0] {
            let line = self.next()?;
            let mut parts = line.splitn(3, char::is_whitespace);
            let (Some(dimension), Some(Ok(tag)), Some(name)) =
                (parts.next(), parts.next().map(str::parse), parts.next())
            else {
                return Err(
                    self.error("a dimension, a number and a name belong here; repair the file")
                );
            };
            if dimension == "1" {
                self.names.insert(tag, name.trim().trim_matches('"').to_owned());
            }
        }
        Ok(())
    }

    /// Physical groups of the curves; points come before them.
    fn read_entities(&mut self) -> Result<(), ImportError> {
        let counts: Vec<usize> = self.numbers(4)?;
        for _ in 0..counts[0] {
            self.next()?;
        }
        for _ in 0..counts[1] {
            let curve: Vec<f64> = self.numbers(8)?;
            if curve[7] > 0.0 {
                let group = curve
                    .get(8)
                    .ok_or_else(|| self.error("a physical group is missing; repair the file"))?;
                self.curves.insert(curve[0] as i64, group.abs() as i64);
            }
        }
        Ok(())
    }

    fn add_node(&mut self, tag: usize, at: &[f64]) -> Result<(), ImportError> {
        if !at.iter().all(|x| x.is_finite()) {
            return Err(self.error("the node has numbers that are not finite; repair the file"));
        }
        if at[2] != 0.0 {
            self.sketch.leave(
                "z of a node; the border is taken in the x-y plane",
                SourceLine::new(self.line),
            );
        }
        self.numbers.insert(tag, self.nodes.len());
        self.nodes.push(vec2(at[0], at[1]));
        Ok(())
    }

    fn read_nodes(&mut self) -> Result<(), ImportError> {
        for _ in 0..self.numbers::<usize>(1)?[0] {
            let node: Vec<f64> = self.numbers(4)?;
            self.add_node(node[0] as usize, &node[1..4])?;
        }
        Ok(())
    }

    fn read_node_blocks(&mut self) -> Result<(), ImportError> {
        for _ in 0..self.numbers::<usize>(4)?[0] {
            let count = self.numbers::<usize>(4)?[3];
            let mut tags = Vec::new();
            for _ in 0..count {
                tags.push(self.numbers::<usize>(1)?[0]);
            }
            for tag in tags {
                let at: Vec<f64> = self.numbers(3)?;
                self.add_node(tag, &at)?;
            }
        }
        Ok(())
    }

    fn read_elements(&mut self) -> Result<(), ImportError> {
        for _ in 0..self.numbers::<usize>(1)?[0] {
            let element: Vec<i64> = self.numbers(3)?;
            let (kind, tags) = (element[1] as usize, element[2].clamp(0, 1000) as usize);
            let group = if tags > 0 { element.get(3).copied().unwrap_or(0) } else { 0 };
            self.add_element(kind, element.get(3 + tags..).unwrap_or_default(), group)?;
        }
        Ok(())
    }

    fn read_element_blocks(&mut self) -> Result<(), ImportError> {
        for _ in 0..self.numbers::<usize>(4)?[0] {
            let block: Vec<i64> = self.numbers(4)?;
            let group =
                if block[0] == 1 { self.curves.get(&block[1]).copied().unwrap_or(0) } else { 0 };
            for _ in 0..block[3] {
                let element: Vec<i64> = self.numbers(1)?;
                self.add_element(block[2] as usize, &element[1..], group)?;
            }
        }
        Ok(())
    }

    /// Keeps a line, or the edges of an element; nodes are corners, then those along each edge.
    fn add_element(&mut self, kind: usize, tags: &[i64], group: i64) -> Result<(), ImportError> {
        let Some((_, corners, order)) = ELEMENTS.iter().find(|element| element.0 == kind) else {
            if kind != POINT {
                self.sketch.leave(format!("element of type {kind}"), SourceLine::new(self.line));
            }
            return Ok(());
        };
        let known =
            |tag: &i64| usize::try_from(*tag).ok().and_then(|tag| self.numbers.get(&tag).copied());
        let count = if *corners == 2 { order + 1 } else { corners * order };
        let nodes: Option<Vec<_>> =
            tags.get(..count).and_then(|tags| tags.iter().map(known).collect());
        let nodes = nodes.ok_or_else(|| {
            self.error("the element has too few nodes, or unknown ones; repair the file")
        })?;
        let edge = |k: usize| {
            let inner = &nodes[corners + k * (order - 1)..][..order - 1];
            let ends = [nodes[k], nodes[(k + 1) % corners]];
            EdgeNodes { nodes: [&ends[..1], inner, &ends[1..]].concat(), line: self.line }
        };
        if *corners == 2 {
            self.lines.push((edge(0), group));
        } else {
            self.edges.extend((0..*corners).map(edge));
        }
        Ok(())
    }

    /// The boundary and the cracks, or the lines of a mesh without faces.
    fn draw(&mut self) -> Result<(), ImportError> {
        let groups: BTreeMap<_, _> =
            self.lines.iter().map(|(edge, group)| (key(edge), *group)).collect();
        let mut counts = HashMap::new();
        self.edges.iter().for_each(|edge| *counts.entry(key(edge)).or_insert(0) += 1);
        if let Some(edge) = self.edges.iter().find(|edge| counts[&key(edge)] > 2) {
            let message =
                "an edge belongs to three elements, which no plane mesh has; repair the mesh";
            return Err(SourceLine::new(edge.line).error(message));
        }
        let is_mesh = !self.edges.is_empty();
        self.sketch.is_mesh_without_faces = !is_mesh;
        let mut curves: Vec<_> = self
            .edges
            .iter()
            .filter(|edge| counts[&key(edge)] == 1)
            .map(|edge| self.named(edge, groups.get(&key(edge))))
            .collect();
        for (edge, group) in std::mem::take(&mut self.lines) {
            if counts.get(&key(&edge)) == Some(&1) {
                continue;
            }
            let named = self.named(&edge, Some(&group));
            let name = named.name.as_deref().unwrap_or_default();
            if !is_mesh || name.to_lowercase().starts_with("crack") {
                curves.push(named);
            } else if !name.is_empty() {
                self.sketch.leave(format!("line of {name} inside of the body"), named.source);
            }
        }
        self.add_with_cracks(curves)
    }

    fn named(&self, edge: &EdgeNodes, group: Option<&i64>) -> NamedCurve {
        let points = edge.nodes.iter().map(|node| self.nodes[*node]).collect();
        let name = group.filter(|group| **group != 0);
        let name = name.map(|group| {
            self.names.get(group).cloned().unwrap_or_else(|| format!("curve-{group}"))
        });
        NamedCurve::new(PlaneCurve::Polyline(points), name, SourceLine::new(edge.line))
    }

    /// Adds edges; of two between the same places one, as a crack.
    fn add_with_cracks(&mut self, curves: Vec<NamedCurve>) -> Result<(), ImportError> {
        let corner = self.nodes.iter().fold(Vec2::ZERO, |a, b| a.max(vec2(b.x.abs(), b.y.abs())));
        let mut joints = Joints::new((1e-10 * corner.x.max(corner.y)).max(f64::MIN_POSITIVE));
        let mut known: HashMap<[usize; 2], usize> = HashMap::new();
        for named in curves {
            let mut ends = named.curve.ends().map(|p| joints.number(p));
            ends.sort_unstable();
            if let Some(first) = known.get(&ends) {
                self.sketch.curves[*first].is_crack = true;
                continue;
            }
            known.insert(ends, self.sketch.curves.len());
            self.sketch.add(named.curve, named.name, named.source)?;
        }
        Ok(())
    }
}

/// The ends of an edge, the same for both of its sides.
fn key(edge: &EdgeNodes) -> [usize; 2] {
    let [a, b] = [edge.nodes[0], edge.nodes[edge.nodes.len() - 1]];
    [a.min(b), a.max(b)]
}
