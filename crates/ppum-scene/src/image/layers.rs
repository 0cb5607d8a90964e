//! The overlays of an image, drawn.

use ppum::crack::Crack;
use ppum::progress::Watcher;
use ppum::quantity::{Axis, Quantity, Reflection};
use ppum_figure::canvas::CanvasItem;
use ppum_figure::figure::FigureStyle;
use ppum_figure::levels;
use ppum_figure::overlay::{self, LegendEntry, Room};
use ppum_figure::ticks::Notation;
use ppum_render::RasterError;
use ppum_render::cells;
use ppum_render::deform::DeformError;
use ppum_render::glyph::GlyphLattice;
use ppum_render::isoline::Isoline;
use ppum_render::picture::ColoredRaster;
use ppum_render::view::View;

use super::body::{BodyPart, BodyView};
use super::boundary::BoundarySamples;
use super::error::{ImageError, ImageErrorKind};
use super::notice::Notice;
use super::subject::ImageSubject;
use super::values::RasterValues;
use super::whole;
use crate::request::overlays::{IsolineLevels, Overlay, Overlays};
use crate::request::scene::SceneRequest;

/// The image that overlays are drawn on.
#[derive(Clone, Copy)]
pub struct LayerInput<'a> {
    /// The subject; its dataset may hold the problem with supports and loads.
    pub subject: &'a ImageSubject<'a>,
    /// The body and its images, as they are seen.
    pub body: &'a BodyView<'a>,
    /// The image below.
    pub picture: &'a ColoredRaster,
    /// Values at the centres of its pixels.
    pub values: &'a RasterValues,
    /// The design of the figure around it, none of a bare image: lines and letters have their
    /// width by it, and cracks are drawn whatever is asked for.
    pub design: Option<&'a FigureStyle>,
    /// True if a colour bar tells how numbers are written.
    pub has_bar: bool,
}

impl LayerInput<'_> {
    /// The levels of isolines; none where nothing but rounding tells values apart.
    pub(crate) fn levels(&self, wanted: &IsolineLevels) -> Vec<f64> {
        let norm = &self.picture.normalization;
        match wanted {
            _ if self.picture.one_value.is_some() => Vec::new(),
            IsolineLevels::Auto => levels::automatic(norm, AUTOMATIC),
            IsolineLevels::Count(count) => levels::about(norm, *count),
            IsolineLevels::At(values) => values.clone(),
        }
    }

    /// Isolines, found on the exact field; the image's values say where to look for them.
    pub(crate) fn isolines(
        &self,
        quantity: &Quantity,
        levels: &[f64],
        watcher: &dyn Watcher,
    ) -> Result<Vec<Isoline>, RasterError> {
        whole::between_ends(levels, self.ends(), |levels| {
            whole::isolines(self.subject.field, self.body, quantity, levels, self.values, watcher)
        })
    }

    /// Draws the overlays of a scene. The deformed body of a figure has its border and the faces of
    /// its cracks unless they are left out, and the border of the undeformed one if that is asked
    /// for.
    ///
    /// # Errors
    /// Overlays that the field or the deformed body does not have; too many isolines; a watcher
    /// that stops it.
    pub fn layers(self, scene: &SceneRequest, watcher: &dyn Watcher) -> Result<Layers, ImageError> {
        let overlays = &scene.overlays;
        if overlays.crosses.is_some() && self.subject.field.equation.elastic().is_none() {
            return Err(ImageErrorKind::Crosses.into());
        }
        let scale = scale(self.design, self.picture.view.pixels);
        let layers = Layers::default();
        let mut drawing = LayerDrawing { overlays, input: self, scale, watcher, layers };
        drawing.draw(scene.outline)?;
        Ok(drawing.with_legend())
    }

    /// The ends of the values, those of the pixels if no others are known, and of the colours.
    fn ends(&self) -> ([f64; 2], [f64; 2]) {
        let ColoredRaster { span, normalization: norm, .. } = self.picture;
        let known = span.values.as_ref().map(|values| [values.min.value, values.max.value]);
        (known.unwrap_or_else(|| self.values.ends()), [norm.min(), norm.max()])
    }
}

/// Scale of lines and letters over an image: that of the figure's design, or of a bare image of
/// so many pixels.
#[must_use]
pub fn scale(design: Option<&FigureStyle>, pixels: [u32; 2]) -> f64 {
    design.map_or_else(|| overlay::line_scale(pixels), FigureStyle::scale)
}

/// The layers over an image.
#[derive(Debug, Default)]
pub struct Layers {
    /// Items in pixels of the image, the lowest first.
    pub items: Vec<CanvasItem>,
    /// The entries of a legend that has no room in the image.
    pub legend: Vec<LegendEntry>,
    /// Notices about requested items that are not visible.
    pub notices: Vec<Notice>,
}

/// Most levels that are chosen by the program.
const AUTOMATIC: usize = 14;
/// Distance of supports and loads, in units of the scale.
const SPACING: f64 = 30.0;

/// Layers while they are drawn.
struct LayerDrawing<'a> {
    overlays: &'a Overlays,
    input: LayerInput<'a>,
    scale: f64,
    watcher: &'a dyn Watcher,
    layers: Layers,
}

impl<'a> LayerDrawing<'a> {
    /// Draws all of them; with `outline` the border of the undeformed body below a deformed one.
    fn draw(&mut self, outline: bool) -> Result<(), ImageError> {
        if self.input.body.factor().is_some() {
            if let Some(overlay) = self.overlays.undeformable() {
                return Err(ImageErrorKind::Overlay(overlay).into());
            }
            if outline {
                self.undeformed_outline()?;
            }
        }
        let wanted = self.wanted();
        let glyphs = self.glyphs()?;
        let stations = self.stations();
        // of boxes and centres the colours are the same
        let mut meaning = Vec::new();
        let overlays = wanted.into_iter().map(|wanted| match wanted {
            Overlay::Boxes | Overlay::Centers => {
                let (items, entries) = self.enrichments(wanted);
                meaning = entries;
                items
            }
            other => self.overlay(other, &stations),
        });
        let overlays: Vec<CanvasItem> = overlays.collect::<Vec<_>>().concat();
        self.layers.legend.extend(meaning);
        self.isolines()?;
        self.layers.items.extend(glyphs);
        self.layers.items.extend(overlays);
        Ok(())
    }

    /// Layers of the body and, flipped, of its images.
    fn of_parts(&self, mut draw: impl FnMut(&BodyPart<'_>) -> Vec<CanvasItem>) -> Vec<CanvasItem> {
        let mut items = draw(&self.input.body.own);
        for image in &self.input.body.images {
            let (flips, size) = (image.flips(), image.view.pixels);
            items.extend(draw(image).into_iter().map(|item| item.flipped(flips, size)));
        }
        items
    }

    /// The border of the undeformed body.
    fn undeformed_outline(&mut self) -> Result<(), DeformError> {
        let (mirrors, mut failure) = (self.input.body.lines.at(), None);
        let items = self.of_parts(|part| {
            let points = part.points.iter();
            let outlines =
                points.map(|points| overlay::undeformed_outline(&points.view, mirrors, self.scale));
            let outlines = outlines.collect::<Result<Vec<_>, _>>();
            outlines.map_err(|error| failure = Some(error)).unwrap_or_default().concat()
        });
        self.layers.items.extend(items);
        failure.map_or(Ok(()), Err)
    }

    /// The centres or the boxes of cells by their enrichments, and what their colours mean.
    fn enrichments(&self, wanted: Overlay) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
        let draw = if wanted == Overlay::Boxes { overlay::boxes } else { overlay::centers };
        let mut entries = Vec::new();
        let items = self.of_parts(|part| {
            let (items, meaning) = draw(&part.view, self.scale, self.input.subject.field);
            if part.reflection == Reflection::NONE {
                entries = meaning;
            }
            items
        });
        (items, entries)
    }

    /// The overlays in their order, each once; a notice says which need cells that there are not.
    fn wanted(&mut self) -> Vec<Overlay> {
        let mut wanted = self.overlays.shown.clone();
        if self.input.design.is_some() && !self.overlays.no_cracks {
            wanted.push(Overlay::Cracks);
        }
        wanted.sort_unstable();
        wanted.dedup();
        if !cells::exist(self.input.subject.field) {
            let missing = wanted.extract_if(.., |overlay| overlay.is_of_cells());
            self.layers.notices.extend(missing.map(Notice::NoCells));
        }
        wanted
    }

    /// An overlay of the body and of its images.
    fn overlay(&self, wanted: Overlay, stations: &BoundarySamples) -> Vec<CanvasItem> {
        let LayerInput { subject: ImageSubject { field, .. }, picture, .. } = self.input;
        let (view, scale, mirrors) = (&picture.view, self.scale, self.input.body.lines.at());
        match wanted {
            Overlay::Supports => overlay::supports(view, scale, &stations.supports),
            Overlay::Loads => overlay::loads(view, scale, &stations.loads),
            Overlay::Cracks => {
                let edges = self.of_parts(|part| match &part.points {
                    Some(points) => [
                        overlay::deformed_outline(&points.view, mirrors, scale),
                        overlay::faces(&points.view, scale),
                    ]
                    .concat(),
                    None => [
                        overlay::rims(&part.view, scale, &field.domain.holes, mirrors),
                        overlay::cuts(&part.view, scale, field),
                    ]
                    .concat(),
                });
                // faces of deformed cracks are edges
                let cracks = match self.input.body.factor() {
                    Some(_) => Vec::new(),
                    None => overlay::cracks(view, scale, &self.input.body.cracks(field)),
                };
                [edges, cracks].concat()
            }
            wanted => self.of_parts(|part| match &part.points {
                Some(points) if wanted == Overlay::Cells => {
                    overlay::deformed_cells(&points.view, mirrors, scale)
                }
                Some(_) => Vec::new(),
                None => self.of_cover(wanted, &part.view),
            }),
        }
    }

    /// An overlay of the cover.
    fn of_cover(&self, wanted: Overlay, view: &View) -> Vec<CanvasItem> {
        let (scale, field) = (self.scale, self.input.subject.field);
        let step = field.step;
        match wanted {
            Overlay::Patches | Overlay::Cells if step.partition.mesh().is_some() => {
                let mesh = step.partition.mesh().into_iter();
                mesh.flat_map(|mesh| overlay::elements(view, scale, mesh)).collect()
            }
            Overlay::Patches => overlay::patches(view, scale, step.partition.boxes()),
            Overlay::Cells => overlay::cells(view, scale, step.partition.boxes()),
            Overlay::Points => overlay::points(view, scale, step.partition.boxes()),
            Overlay::Rings => overlay::rings(view, scale, &step.cracks, &step.intensities),
            _ => Vec::new(),
        }
    }

    /// Isolines, if they are asked for and there can be some, or a word that there are none of the
    /// levels that were listed; others lie in the range, if there is one.
    fn isolines(&mut self) -> Result<(), ImageError> {
        let LayerInput { subject, body, picture, .. } = self.input;
        let Some(wanted) = &self.overlays.isolines else { return Ok(()) };
        let Some(quantity) = subject.quantity() else {
            self.layers.notices.push(Notice::NoIsolines);
            return Ok(());
        };
        let lines = self.input.isolines(quantity, &self.input.levels(wanted), self.watcher)?;
        let cracks = match body.factor() {
            // they have opened, or closed: nothing can be said of their lines
            Some(_) => Vec::new(),
            None => body.cracks(subject.field),
        };
        if matches!(wanted, IsolineLevels::At(_)) {
            self.notice_of_none(lines.len(), Notice::NoIsoline);
        }
        let room = self.room(&picture.view, &cracks);
        self.layers.items.extend(overlay::isolines(&picture.view, self.scale, &lines, room));
        Ok(())
    }

    fn notice_of_none(&mut self, count: usize, notice: Notice) {
        self.layers.notices.extend((count == 0).then_some(notice));
    }

    /// Where labels of levels may stand, if they are asked for: not below a legend.
    fn room(&self, view: &View, cracks: &[Crack]) -> Option<Room> {
        let LayerInput { picture, has_bar, .. } = self.input;
        let notation = || match has_bar {
            true => Notation::of(&picture.normalization),
            false => Notation::PLAIN,
        };
        let legend = overlay::legend_box(view, self.scale, &self.layers.legend);
        let all = self.overlays.level_labels.then(|| Room::new(picture, cracks, notation()));
        all.map(|room| legend.into_iter().fold(room, Room::without))
    }

    /// Arrows and crosses with what their lengths mean in the legend.
    fn glyphs(&mut self) -> Result<Vec<CanvasItem>, ImageError> {
        let (field, view) = (self.input.subject.field, &self.input.picture.view);
        let mut items = Vec::new();
        if let Some(spacing) = self.overlays.crosses {
            let mut found = Vec::new();
            for part in self.input.body.parts() {
                let crosses = self.lattice(part, spacing).principal(self.watcher)?.into_iter();
                found.extend(crosses.map(|cross| cross.reflected(&part.reflection)));
            }
            self.notice_of_none(found.len(), Notice::NoCross);
            let (more, meaning) = overlay::crosses(view, self.scale, &found, spacing);
            items.extend(more);
            self.layers.legend.extend(meaning);
        }
        if let Some(spacing) = self.overlays.arrows {
            let shown = match field.components() {
                n if n == 2 || field.is_displacement() => {
                    [Quantity::Component(0), Quantity::Component(1)]
                }
                _ => [Quantity::Derivative(0, Axis::X), Quantity::Derivative(0, Axis::Y)],
            };
            let mut found = Vec::new();
            for part in self.input.body.parts() {
                let arrows = self.lattice(part, spacing).vectors(&shown, self.watcher)?.into_iter();
                found.extend(arrows.map(|arrow| arrow.reflected(&part.reflection)));
            }
            self.notice_of_none(found.len(), Notice::NoArrow);
            let (more, meaning) = overlay::arrows(view, self.scale, &found, spacing);
            items.extend(more);
            self.layers.legend.extend(meaning);
        }
        Ok(items)
    }

    /// The points of a part with glyphs.
    fn lattice<'b>(&'b self, part: &'b BodyPart<'_>, spacing: f64) -> GlyphLattice<'b> {
        let (by, spacing) = (&part.reflection, spacing * self.scale);
        match &part.points {
            Some(points) => GlyphLattice::deformed(points, by, spacing),
            None => GlyphLattice::reflected(
                self.input.subject.field,
                self.input.body.view(),
                by,
                spacing,
            ),
        }
    }

    /// Points along the border with supports and loads; none if nobody asks for them.
    fn stations(&mut self) -> BoundarySamples {
        if !self.overlays.have_stations() {
            return BoundarySamples::default();
        }
        let spacing = SPACING * self.scale * self.input.picture.view.pixel_size();
        let stations =
            BoundarySamples::of(self.input.subject.dataset, spacing).unwrap_or_else(|notice| {
                self.layers.notices.push(notice);
                BoundarySamples::default()
            });
        stations.mirrored(&self.input.body.lines)
    }

    /// The layers, with their legend over them if it has room.
    fn with_legend(self) -> Layers {
        let mut layers = self.layers;
        let inside = overlay::legend(&self.input.picture.view, self.scale, &layers.legend);
        if !inside.is_empty() {
            layers.legend.clear();
        }
        layers.items.extend(inside);
        layers
    }
}
