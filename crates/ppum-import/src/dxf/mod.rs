//! DXF as text: sections of entities, each a list of pairs of a group code and a value.
//!
//! Read are the entities of model space, and those of inserted blocks; layers are the names.

mod entity;
mod pairs;

use std::collections::BTreeMap;

use ppum::vec2::Vec2;

use crate::affine::PlaneMap;
use crate::error::ImportError;
use crate::sketch::Sketch;
use crate::source::SourceLine;
use entity::{EntityShape, Insert};
use pairs::{Entities, Entity};

/// Deepest nesting of blocks in blocks.
const DEEPEST: usize = 16;

/// Most entities that inserted blocks make.
const MOST_INSERTED: usize = 1 << 20;

/// An entity as it is drawn.
struct EntityDrawing {
    shape: EntityShape,
    layer: String,
    source: SourceLine,
}

/// A block: entities around a base point.
#[derive(Default)]
struct DxfBlock {
    base: Vec2,
    entities: Vec<EntityDrawing>,
}

/// The entities of a file.
#[derive(Default)]
struct DxfDocument {
    model: DxfBlock,
    blocks: BTreeMap<String, DxfBlock>,
    /// A sentence on units and version.
    about: Option<String>,
}

/// The curves of a document.
struct DxfSketch<'a> {
    blocks: &'a BTreeMap<String, DxfBlock>,
    sketch: Sketch,
    inserted: usize,
}

/// Where a block is inserted.
#[derive(Clone, Copy)]
struct Placement<'a> {
    map: PlaneMap,
    /// The layer that stands for layer 0 in the block.
    layer: &'a str,
    depth: usize,
}

pub(crate) fn read(text: &str) -> Result<Sketch, ImportError> {
    if text.starts_with("AutoCAD Binary DXF") {
        let message = "is a binary DXF file, which is not read; save it as text (ASCII DXF)";
        return Err(SourceLine::new(1).error(message));
    }
    let DxfDocument { model, blocks, about } = DxfDocument::read(Entities::new(text))?;
    let mut drawing = DxfSketch { blocks: &blocks, sketch: Sketch::layered(), inserted: 0 };
    drawing.sketch.about = about;
    drawing.draw(&model, Placement { map: PlaneMap::IDENTITY, layer: "0", depth: 0 })?;
    Ok(drawing.sketch)
}

impl DxfDocument {
    fn read(mut entities: Entities<'_>) -> Result<Self, ImportError> {
        let (mut document, mut section, mut block) = (Self::default(), "", None);
        while let Some(entity) = entities.entity()? {
            match entity.kind {
                "EOF" => return Ok(document),
                "SECTION" => {
                    section = entity.text(2).unwrap_or_default();
                    document.read_header(&entity);
                }
                "ENDSEC" | "ENDBLK" => block = None,
                "BLOCK" => {
                    let name = entity.text(2).unwrap_or_default();
                    let new = DxfBlock { base: entity.point(10)?, entities: Vec::new() };
                    document.blocks.insert(name.to_owned(), new);
                    block = Some(name);
                }
                _ if section == "ENTITIES" || block.is_some() => {
                    let drawn = drawn(&entity, &mut entities)?;
                    let target = block.and_then(|name| document.blocks.get_mut(name));
                    target.unwrap_or(&mut document.model).entities.extend(drawn);
                }
                _ => {}
            }
        }
        let message =
            "the file ends without EOF, so that something is missing; save or copy it once more";
        Err(SourceLine::new(entities.line).error(message))
    }

    /// Units and version from the variables of the header.
    fn read_header(&mut self, section: &Entity<'_>) {
        let value = |name: &str| {
            let at = section.pairs.iter().position(|pair| pair.value == name)?;
            section.pairs.get(at + 1).map(|pair| pair.value)
        };
        let unit = value("$INSUNITS").and_then(|unit| unit.parse().ok()).and_then(unit_name);
        let unit = unit.map(|unit| format!("Lengths are in {unit}."));
        let version = value("$ACADVER").map(|version| format!("DXF of version {version}."));
        let about: Vec<_> = version.into_iter().chain(unit).collect();
        if !about.is_empty() {
            self.about = Some(about.join(" "));
        }
    }
}

/// Returns the curves that an entity of model space draws.
fn drawn(
    entity: &Entity<'_>,
    entities: &mut Entities<'_>,
) -> Result<Vec<EntityDrawing>, ImportError> {
    let shapes = entity::shapes(entity, entities)?;
    if entity.whole(67)? == Some(1) || entity.whole(60)? == Some(1) {
        return Ok(Vec::new());
    }
    let (layer, source) = (entity.text(8).unwrap_or("0"), entity.source());
    let drawn = |shape| EntityDrawing { shape, layer: layer.to_owned(), source };
    Ok(shapes.into_iter().map(drawn).collect())
}

impl DxfSketch<'_> {
    /// Adds the curves of a block.
    fn draw(&mut self, block: &DxfBlock, place: Placement<'_>) -> Result<(), ImportError> {
        for EntityDrawing { shape, layer, source } in &block.entities {
            let layer = if layer == "0" { place.layer } else { layer };
            let name = Some(layer.to_owned());
            self.count()?;
            match shape {
                EntityShape::Unread(kind) => self.sketch.leave(kind.as_str(), *source),
                EntityShape::Curve(curve) | EntityShape::Through(curve) => {
                    if matches!(shape, EntityShape::Through(_)) {
                        self.sketch.remark("the SPLINE has fit points alone; other programs may draw it otherwise between them", *source);
                    }
                    self.sketch.add(curve.mapped(&place.map), name, *source)?;
                }
                EntityShape::Insert(insert) => {
                    self.insert(insert, *source, Placement { layer, ..place })?;
                }
            }
        }
        Ok(())
    }

    /// Counts entities and inserted blocks.
    fn count(&mut self) -> Result<(), ImportError> {
        self.inserted += 1;
        if self.inserted > MOST_INSERTED {
            return Err(ImportError::too_many("entities", MOST_INSERTED));
        }
        Ok(())
    }

    fn insert(
        &mut self,
        insert: &Insert,
        source: SourceLine,
        place: Placement<'_>,
    ) -> Result<(), ImportError> {
        let name = &insert.block;
        let Some(block) = self.blocks.get(name).filter(|_| place.depth < DEEPEST) else {
            let what = format!("INSERT of block {name}, unknown or nested too deep");
            self.sketch.leave(what, source);
            return Ok(());
        };
        for map in insert.maps(block.base) {
            self.count()?;
            let map = place.map.after(&map);
            self.draw(block, Placement { map, depth: place.depth + 1, ..place })?;
        }
        Ok(())
    }
}

/// The unit of $INSUNITS.
fn unit_name(number: u32) -> Option<&'static str> {
    let names = [
        "inches",
        "feet",
        "miles",
        "millimetres",
        "centimetres",
        "metres",
        "kilometres",
        "microinches",
        "mils",
    ];
    names.get((number as usize).checked_sub(1)?).copied()
}
