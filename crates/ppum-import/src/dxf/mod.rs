//! DXF as text: sections of entities, each a list of pairs of a group code and a value.
//!
//! Read are the entities of model space, and those of inserted blocks; layers are the names.

mod entity;
mod pairs;

use std::collections::BTreeMap;

use ppum::vec2::Vec2;

use crate::affine::PlaneMap;
use crate::error::ImportError;
use crate::sketch::{NamedCurve, Sketch};
use crate::source::SourceLine;
use entity::{EntityShape, Insert};
use pairs::{Entities, Entity, Pairs};

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

/// The file, section by section.
#[derive(Default)]
struct DxfDocument {
    model: DxfBlock,
    blocks: BTreeMap<String, DxfBlock>,
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
        return Err(ImportError::syntax(SourceLine::new(1), message));
    }
    let mut document = DxfDocument { sketch: Sketch::layered(), ..DxfDocument::default() };
    document.read(Entities::new(Pairs::new(text)))?;
    let model = std::mem::take(&mut document.model);
    let blocks = std::mem::take(&mut document.blocks);
    document.draw(&model, &blocks, Placement { map: PlaneMap::IDENTITY, layer: "0", depth: 0 })?;
    Ok(document.sketch)
}

impl DxfDocument {
    fn read(&mut self, mut entities: Entities<'_>) -> Result<(), ImportError> {
        let (mut section, mut block) = (String::new(), None);
        while let Some(entity) = entities.next().transpose()? {
            match entity.kind {
                "EOF" => return Ok(()),
                "SECTION" => {
                    entity.text(2).unwrap_or_default().clone_into(&mut section);
                    self.read_header(&entity);
                }
                "ENDSEC" | "ENDBLK" => block = None,
                "BLOCK" => {
                    let name = entity.text(2).unwrap_or_default().to_owned();
                    self.blocks.insert(
                        name.clone(),
                        DxfBlock { base: entity.point(10)?, entities: Vec::new() },
                    );
                    block = Some(name);
                }
                _ if section == "ENTITIES" || block.is_some() => {
                    let drawn = Self::drawn(&entity, &mut entities)?;
                    let target = block.as_ref().and_then(|name| self.blocks.get_mut(name));
                    target.unwrap_or(&mut self.model).entities.extend(drawn);
                }
                _ => {}
            }
        }
        let message =
            "the file ends without EOF, so that something is missing; save or copy it once more";
        Err(ImportError::syntax(SourceLine::new(entities.line()), message))
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
            self.sketch.about = Some(about.join(" "));
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
        let layer = entity.text(8).unwrap_or("0").to_owned();
        let source = entity.source();
        let drawn = |shape| EntityDrawing { shape, layer: layer.clone(), source };
        Ok(shapes.into_iter().map(drawn).collect())
    }

    /// Adds the curves of a block.
    fn draw(
        &mut self,
        block: &DxfBlock,
        blocks: &BTreeMap<String, DxfBlock>,
        place: Placement<'_>,
    ) -> Result<(), ImportError> {
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
                    self.sketch.add(NamedCurve::new(curve.mapped(&place.map), name, *source))?;
                }
                EntityShape::Spline(spline) => {
                    self.sketch.add_spline(spline.clone().mapped(&place.map), name, *source)?;
                }
                EntityShape::Insert(insert) => {
                    self.insert(insert, *source, blocks, Placement { layer, ..place })?;
                }
            }
        }
        Ok(())
    }

    /// Counts entities and inserted blocks.
    fn count(&mut self) -> Result<(), ImportError> {
        self.inserted += 1;
        if self.inserted > MOST_INSERTED {
            return Err(ImportError::TooMany { what: "entities", most: MOST_INSERTED });
        }
        Ok(())
    }

    fn insert(
        &mut self,
        insert: &Insert,
        source: SourceLine,
        blocks: &BTreeMap<String, DxfBlock>,
        place: Placement<'_>,
    ) -> Result<(), ImportError> {
        let Some(block) = blocks.get(&insert.block).filter(|_| place.depth < DEEPEST) else {
            self.sketch.leave(
                format!("INSERT of block {}, unknown or nested too deep", insert.block),
                source,
            );
            return Ok(());
        };
        for map in insert.maps(block.base) {
            self.count()?;
            let map = place.map.after(&map);
            self.draw(block, blocks, Placement { map, depth: place.depth + 1, ..place })?;
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
