//! SVG: shapes and paths of a tree of groups, each with its transform. The y axis is turned up.

mod number;
mod path;
mod shape;
mod viewport;

use std::collections::HashMap;

use ppum::vec2::{Vec2, vec2};
use roxmltree::{Document, Node, ParsingOptions};

use crate::affine::PlaneMap;
use crate::error::ImportError;
use crate::sketch::Sketch;
use crate::source::SourceLine;
use viewport::Viewport;

/// Most nodes of a file, and most elements that are drawn, those of each `<use>` counted.
const MOST_NODES: u32 = 1 << 22;

/// How deep `<use>` may stand in what another one draws.
const DEEPEST_USE: usize = 32;

/// Elements whose content is not drawn where it stands.
const NOT_DRAWN: [&str; 8] =
    ["defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style"];

/// Elements that draw nothing by themselves.
const SILENT: [&str; 9] =
    ["svg", "symbol", "g", "a", "switch", "title", "desc", "namedview", "script"];

/// The style that an element inherits.
#[derive(Clone)]
struct InheritedStyle<'a, 'input> {
    map: PlaneMap,
    name: Option<String>,
    is_visible: bool,
    /// Width and height of the view box, of which percentages are parts.
    view: Vec2,
    /// The `<use>` elements that draw this one.
    uses: usize,
    /// The `<use>` that draws this element, whose label and size precede its own.
    used_by: Option<Node<'a, 'input>>,
}

pub(crate) fn read(text: &str) -> Result<Sketch, ImportError> {
    // editors write document types; entities in them are expanded within limits
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = SourceLine::new(error.pos().row as usize);
        line.error(format!("is no XML: {error}; repair the file"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let message = format!("the file is <{}>, not <svg>", root.tag_name().name());
        return Err(SourceLine::new(1).error(message));
    }
    let elements = root.descendants().filter_map(|node| Some((node.attribute("id")?, node)));
    let mut reader = SvgReader {
        lines: line_starts(text),
        by_id: elements.collect(),
        sketch: Sketch::layered(),
    };
    let viewport = Viewport::of_page(root).map_err(|message| reader.source(root).error(message))?;
    reader.read(root, viewport.size())?;
    reader.turn_up(root, &viewport);
    Ok(reader.sketch)
}

struct SvgReader<'a, 'input> {
    /// The byte at which each line begins.
    lines: Vec<usize>,
    by_id: HashMap<&'a str, Node<'a, 'input>>,
    sketch: Sketch,
}

fn line_starts(text: &str) -> Vec<usize> {
    [0].into_iter().chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect()
}

impl<'a, 'input> SvgReader<'a, 'input> {
    fn source(&self, node: Node<'_, '_>) -> SourceLine {
        SourceLine::new(self.lines.partition_point(|start| *start <= node.range().start))
    }

    /// All elements, in the order of the file; those of a `<use>` in its place.
    fn read(&mut self, root: Node<'a, 'input>, view: Vec2) -> Result<(), ImportError> {
        let page = InheritedStyle {
            map: PlaneMap::IDENTITY,
            name: None,
            is_visible: true,
            view,
            uses: 0,
            used_by: None,
        };
        let (mut open, mut count) = (vec![(root, page)], 0);
        while let Some((node, inherited)) = open.pop() {
            count += 1;
            if count > MOST_NODES {
                return Err(ImportError::too_many("elements", MOST_NODES as usize));
            }
            self.note_style_sheet(node);
            let tag = node.tag_name().name();
            let is_used = tag == "symbol" && inherited.used_by.is_some();
            if !node.is_element() || (NOT_DRAWN.contains(&tag) && !is_used) {
                continue;
            }
            let source = self.source(node);
            if property(node, "display") == Some("none") {
                self.sketch.leave(format!("<{tag}> that is not displayed"), source);
                continue;
            }
            let syntax = |message: String| source.error(message);
            let own = inherited.inner(node).map_err(syntax)?;
            self.element(node, &own, source)?;
            if tag == "use" {
                open.extend(self.used(node, &own).map_err(syntax)?);
            }
            open.extend(node.children().rev().map(|child| (child, own.clone())));
        }
        Ok(())
    }

    /// The element that a `<use>` draws, shifted.
    fn used(
        &mut self,
        node: Node<'a, 'input>,
        own: &InheritedStyle<'a, 'input>,
    ) -> Result<Option<(Node<'a, 'input>, InheritedStyle<'a, 'input>)>, String> {
        let href = node.attributes().find(|attribute| attribute.name() == "href");
        let id = href.map(|href| href.value().trim().trim_start_matches('#'));
        let Some(target) = id.and_then(|id| self.by_id.get(id)) else {
            let name = id.unwrap_or_default();
            self.sketch.leave(format!("<use> of `{name}`, which is not there"), self.source(node));
            return Ok(None);
        };
        if own.uses == DEEPEST_USE {
            return Err(format!("<use> draws itself, or stands {DEEPEST_USE} deep; remove it"));
        }
        let [x, y] = shape::lengths(node, own.view, ["x", "y"])?;
        let map = own.map.after(&PlaneMap::shifting(vec2(x, y)));
        let inherited =
            InheritedStyle { map, uses: own.uses + 1, used_by: Some(node), ..own.clone() };
        Ok(Some((*target, inherited)))
    }

    /// Remembers a style sheet that may hide elements, as sheets are not read.
    fn note_style_sheet(&mut self, node: Node<'_, '_>) {
        let sheet = node.text().unwrap_or_default();
        let hides = ["display", "visibility"].iter().any(|property| sheet.contains(property));
        if node.tag_name().name() == "style" && hides {
            let what = "<style>, which may hide elements: set `display` at the elements themselves";
            self.sketch.leave(what, self.source(node));
        }
    }

    /// The curves of one element.
    fn element(
        &mut self,
        node: Node<'_, '_>,
        own: &InheritedStyle<'_, '_>,
        source: SourceLine,
    ) -> Result<(), ImportError> {
        let tag = node.tag_name().name();
        let Some(curves) =
            shape::curves(node, own.view).map_err(|message| source.error(message))?
        else {
            if !SILENT.contains(&tag) && tag != "use" {
                self.sketch.leave(format!("<{tag}>"), source);
            }
            return Ok(());
        };
        if !own.is_visible {
            self.sketch.leave(format!("<{tag}> that is not visible"), source);
            return Ok(());
        }
        for curve in curves {
            self.sketch.add(curve.mapped(&own.map), own.name.clone(), source)?;
        }
        Ok(())
    }

    /// Turns the y axis up, with the lower edge of the page at 0 if it is known; tells the unit.
    fn turn_up(&mut self, root: Node<'_, '_>, page: &Viewport) {
        let shift = vec2(0.0, page.bottom());
        self.sketch.map(&PlaneMap { shift, ..PlaneMap::scaling(1.0, -1.0) });
        let physical = root.attribute("width").and_then(number::millimetres);
        let user = page.size().x;
        if let Some(physical) = physical.filter(|_| user > 0.0) {
            self.sketch.about =
                Some(format!("Lengths are in user units of {:.6} mm.", physical / user));
        }
    }
}

impl InheritedStyle<'_, '_> {
    /// Returns the style that the children of an element inherit, and the values that hold for
    /// itself.
    fn inner(&self, node: Node<'_, '_>) -> Result<Self, String> {
        let own = number::transform(node.attribute("transform").unwrap_or_default())
            .ok_or("`transform` is not as SVG says; repair the file")?;
        let mut map = self.map.after(&own);
        let mut view = self.view;
        let is_nested = node.tag_name().name() == "svg" && node.parent_element().is_some();
        if is_nested || node.tag_name().name() == "symbol" {
            let viewport = Viewport::nested(node, self.used_by, self.view)?;
            (map, view) = (map.after(&viewport.map()), viewport.size());
        }
        Ok(Self {
            map,
            name: self
                .used_by
                .and_then(label)
                .or_else(|| label(node))
                .or_else(|| self.name.clone()),
            is_visible: match property(node, "visibility") {
                Some("visible") => true,
                Some("hidden" | "collapse") => false,
                _ => self.is_visible,
            },
            view,
            uses: self.uses,
            used_by: None,
        })
    }
}

/// A property of an element by its own style or attribute.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let style = node.attribute("style").unwrap_or_default();
    let mut declarations = style.split(';').filter_map(|declaration| declaration.split_once(':'));
    let declared = declarations.rfind(|(key, _)| key.trim() == name);
    let value = declared.map(|(_, value)| value).or_else(|| node.attribute(name))?;
    Some(value.trim().trim_end_matches("!important").trim_end())
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
