//! SVG: shapes and paths of a tree of groups, each with its transform. The y axis is turned up.

mod drawn;
mod number;
mod path;
mod shape;

use ppum::vec2::vec2;
use roxmltree::{Document, Node, ParsingOptions};

use crate::affine::PlaneMap;
use crate::error::ImportError;
use crate::sketch::{NamedCurve, Sketch};
use crate::source::SourceLine;
use drawn::SvgCurve;

/// Most nodes of a file.
const MOST_NODES: u32 = 1 << 22;

/// Elements whose content is not drawn where it stands.
const NOT_DRAWN: [&str; 8] =
    ["defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style"];

/// Elements that draw nothing by themselves.
const SILENT: [&str; 8] = ["svg", "g", "a", "switch", "title", "desc", "namedview", "script"];

/// What an element inherits.
#[derive(Clone)]
struct Inherited {
    map: PlaneMap,
    name: Option<String>,
}

pub(crate) fn read(text: &str) -> Result<Sketch, ImportError> {
    // editors write document types; entities in them are expanded within limits
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = SourceLine::new(error.pos().row as usize);
        ImportError::syntax(line, format!("is no XML: {error}; repair the file"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let message = format!("the file is <{}>, not <svg>", root.tag_name().name());
        return Err(ImportError::syntax(SourceLine::new(1), message));
    }
    let mut reader = SvgReader { lines: line_starts(text), sketch: Sketch::layered() };
    reader.read(root)?;
    reader.turn_up(root)?;
    Ok(reader.sketch)
}

struct SvgReader {
    /// The byte at which each line begins.
    lines: Vec<usize>,
    sketch: Sketch,
}

fn line_starts(text: &str) -> Vec<usize> {
    [0].into_iter().chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect()
}

impl SvgReader {
    fn source(&self, node: Node<'_, '_>) -> SourceLine {
        SourceLine::new(self.lines.partition_point(|start| *start <= node.range().start))
    }

    /// All elements, in the order of the file.
    fn read(&mut self, root: Node<'_, '_>) -> Result<(), ImportError> {
        let mut open = vec![(root, Inherited { map: PlaneMap::IDENTITY, name: None })];
        while let Some((node, inherited)) = open.pop() {
            let tag = node.tag_name().name();
            if !node.is_element() || NOT_DRAWN.contains(&tag) {
                continue;
            }
            let source = self.source(node);
            if is_hidden(node) {
                self.sketch.leave(format!("<{tag}> that is not displayed"), source);
                continue;
            }
            let map = number::transform(node.attribute("transform").unwrap_or_default())
                .ok_or_else(|| {
                    ImportError::syntax(source, "`transform` is not as SVG says; repair the file")
                })?;
            let name = label(node).or(inherited.name);
            let own = Inherited { map: inherited.map.after(&map), name };
            self.element(node, &own, source)?;
            open.extend(node.children().rev().map(|child| (child, own.clone())));
        }
        Ok(())
    }

    /// The curves of one element.
    fn element(
        &mut self,
        node: Node<'_, '_>,
        own: &Inherited,
        source: SourceLine,
    ) -> Result<(), ImportError> {
        let tag = node.tag_name().name();
        let Some(curves) =
            shape::curves(node).map_err(|message| ImportError::syntax(source, message))?
        else {
            let is_nested = tag == "svg" && node.parent_element().is_some();
            if !SILENT.contains(&tag) || is_nested {
                let rest = if is_nested { " in <svg>: its own view box is ignored" } else { "" };
                self.sketch.leave(format!("<{tag}>{rest}"), source);
            }
            return Ok(());
        };
        for curve in curves {
            let name = own.name.clone();
            match curve {
                SvgCurve::Curve(curve) => {
                    self.sketch.add(NamedCurve::new(curve.mapped(&own.map), name, source))?
                }
                SvgCurve::Spline(spline) => {
                    self.sketch.add_spline(spline.mapped(&own.map), name, source)?
                }
            }
        }
        Ok(())
    }

    /// Turns the y axis up, with the lower edge of the page at 0 if it is known; tells the unit.
    fn turn_up(&mut self, root: Node<'_, '_>) -> Result<(), ImportError> {
        let error = || {
            ImportError::syntax(
                SourceLine::new(1),
                "`viewBox` is not four numbers; repair the file",
            )
        };
        let view = root
            .attribute("viewBox")
            .map(|text| number::numbers(text).ok_or_else(error))
            .transpose()?;
        let [width, height] =
            ["width", "height"].map(|key| root.attribute(key).and_then(number::length));
        let bottom = match view.as_deref() {
            Some([_, y, _, height]) => y + height,
            Some(_) => return Err(error()),
            None => height.unwrap_or(0.0),
        };
        self.sketch.map(&PlaneMap { shift: vec2(0.0, bottom), ..PlaneMap::scaling(1.0, -1.0) });
        let physical = root.attribute("width").and_then(number::millimetres);
        let user = view.as_ref().map(|view| view[2]).or(width);
        if let (Some(physical), Some(user)) = (physical, user.filter(|user| *user > 0.0)) {
            self.sketch.about =
                Some(format!("Lengths are in user units of {:.6} mm.", physical / user));
        }
        Ok(())
    }
}

/// True for elements that are not displayed.
fn is_hidden(node: Node<'_, '_>) -> bool {
    let style: String = node.attribute("style").unwrap_or_default().split_whitespace().collect();
    node.attribute("display") == Some("none") || style.contains("display:none")
}

/// The label of an element, or its identifier, if that is no name that a program made.
fn label(node: Node<'_, '_>) -> Option<String> {
    let labels = node.attributes().filter(|attribute| attribute.name() == "label");
    let label = labels.map(|attribute| attribute.value()).find(|label| !label.trim().is_empty());
    let id = || node.attribute("id").filter(|id| !is_generated(id));
    // the page is no group
    let id = if node.tag_name().name() == "svg" { None } else { label.or_else(id) };
    id.map(|id| id.trim().to_owned()).filter(|id| !id.is_empty())
}

/// True for identifiers such as `path12-3`.
fn is_generated(id: &str) -> bool {
    let kinds = [
        "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "g", "use", "svg",
        "layer",
    ];
    let rest = kinds.iter().find_map(|kind| id.strip_prefix(kind));
    rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit() || c == '-' || c == '_'))
}
