//! The overlays of a picture, drawn.

use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Axis, Quantity, Reflection};
use ppum_figure::canvas::Item;
use ppum_figure::figure::Design;
use ppum_figure::levels;
use ppum_figure::overlay::{self, LegendEntry, Room};
use ppum_figure::ticks::Notation;
use ppum_render::RenderError;
use ppum_render::cells;
use ppum_render::deform::{DeformError, DeformedView};
use ppum_render::glyph::Lattice;
use ppum_render::isoline::Isoline;
use ppum_render::picture::Picture;
use ppum_render::view::View;

use crate::drawing::{BodyView, DrawingInput, RasterValues};
use crate::mirror::{MirrorImage, MirrorLines};
use crate::moved_body::{MovedBody, MovedImage};
use crate::notice::Notice;
use crate::overlays::{Levels, Overlay, Overlays};
use crate::stations::Stations;
use crate::whole;

/// What overlays are drawn on.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// The dataset, which may hold the problem with its supports and loads.
    pub dataset: &'a Dataset,
    /// Its field.
    pub field: &'a Field<'a>,
    /// The quantity that is shown; none of values of cells, which have no isolines.
    pub quantity: Option<&'a Quantity>,
    /// The picture below.
    pub picture: &'a Picture,
    /// Values at the centres of its pixels.
    pub values: &'a RasterValues,
    /// The design of the figure around it, none of a bare picture: lines and letters have their
    /// width by it, and cracks are drawn whatever is asked for.
    pub design: Option<&'a Design>,
    /// True if a colour bar tells how numbers are written.
    pub has_bar: bool,
}

impl Ground<'_> {
    /// The levels of isolines; none where nothing but rounding tells values apart.
    pub(crate) fn levels(&self, wanted: &Levels) -> Vec<f64> {
        let norm = &self.picture.normalization;
        match wanted {
            _ if self.picture.one_value.is_some() => Vec::new(),
            Levels::Auto => levels::automatic(norm, AUTOMATIC),
            Levels::Count(count) => levels::about(norm, *count),
            Levels::At(values) => values.clone(),
        }
    }

    /// Isolines, found on the exact field; the picture's values say where to look for them.
    pub(crate) fn isolines(
        &self,
        quantity: &Quantity,
        levels: &[f64],
        lines: MirrorLines,
        watcher: &dyn Watcher,
    ) -> Result<Vec<Isoline>, RenderError> {
        let Self { field, picture: Picture { view, .. }, values, .. } = *self;
        let job = (DrawingInput { field, view, quantity }, lines);
        whole::between_ends(levels, self.ends(), |levels| match values {
            RasterValues::Double(raster) => whole::isolines(job, levels, raster, watcher),
            RasterValues::Single(raster) => whole::isolines(job, levels, raster, watcher),
        })
    }

    /// The ends of the values, those of the pixels if no others are known, and of the colours.
    fn ends(&self) -> ([f64; 2], [f64; 2]) {
        let Picture { span, normalization: norm, .. } = self.picture;
        let known = span.values.as_ref().map(|values| [values.min.value, values.max.value]);
        (known.unwrap_or_else(|| self.values.ends()), [norm.min(), norm.max()])
    }
}

/// Scale of lines and letters over a picture: that of the figure's design, or of a bare picture of
/// so many pixels.
#[must_use]
pub fn scale(design: Option<&Design>, pixels: [u32; 2]) -> f64 {
    design.map_or_else(|| overlay::line_scale(pixels), Design::scale)
}

/// What is drawn over a picture.
#[derive(Debug, Default)]
pub struct Layers {
    /// Items in pixels of the picture, the lowest first.
    pub items: Vec<Item>,
    /// The entries of a legend that has no room in the picture.
    pub legend: Vec<LegendEntry>,
    /// What was asked for and is not seen.
    pub notices: Vec<Notice>,
}

/// Overlays that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayersError {
    /// Crosses of something else than elasticity.
    #[error(
        "crosses show principal stresses, which only elasticity has; arrows show vectors, or the gradient of one \
         component"
    )]
    Crosses,
    /// An overlay that belongs to the plate as it was.
    #[error("{}: of these overlays the deformed plate has cells and cracks alone", .0.name())]
    Deformed(Overlay),
    /// Isolines, or values that they are found from.
    #[error(transparent)]
    Render(Box<RenderError>),
    /// Places of the deformed plate.
    #[error(transparent)]
    Deform(Box<DeformError>),
}

impl From<RenderError> for LayersError {
    fn from(error: RenderError) -> Self {
        Self::Render(Box::new(error))
    }
}

impl From<DeformError> for LayersError {
    fn from(error: DeformError) -> Self {
        Self::Deform(Box::new(error))
    }
}

/// Most levels that are chosen by the program.
const AUTOMATIC: usize = 14;
/// Distance of supports and loads, in units of the scale.
const SPACING: f64 = 30.0;

impl Overlays {
    /// Draws them over a picture of what is seen. The deformed plate of a figure has its border and
    /// the faces of its cracks unless they are left out; with `outline` the border of the
    /// undeformed one too.
    ///
    /// # Errors
    /// Overlays that the field or the deformed plate does not have; too many isolines; a watcher
    /// that stops it.
    pub fn layers(
        &self,
        ground: Ground<'_>,
        seen: &BodyView<'_>,
        outline: bool,
        watcher: &dyn Watcher,
    ) -> Result<Layers, LayersError> {
        if self.crosses.is_some() && ground.field.equation.elastic().is_none() {
            return Err(LayersError::Crosses);
        }
        let scale = scale(ground.design, ground.picture.view.pixels);
        let layers = Layers::default();
        let lines = seen.lines();
        let images = seen.images(&ground.field.domain.body_bounds());
        let mut drawing = Drawing { overlays: self, ground, lines, images, scale, watcher, layers };
        match seen {
            BodyView::Plate(_) | BodyView::Mirrored(..) => drawing.plate()?,
            BodyView::Moved(body) => drawing.moved(body, outline)?,
        }
        Ok(drawing.with_legend())
    }
}

/// Layers while they are drawn.
struct Drawing<'a> {
    overlays: &'a Overlays,
    ground: Ground<'a>,
    /// The lines at which the body is mirrored, and its images that are seen.
    lines: MirrorLines,
    images: Vec<MirrorImage>,
    scale: f64,
    watcher: &'a dyn Watcher,
    layers: Layers,
}

impl<'a> Drawing<'a> {
    /// Draws over the plate as it was before it was loaded.
    fn plate(&mut self) -> Result<(), LayersError> {
        let Ground { field, picture, .. } = self.ground;
        let view = &picture.view;
        let wanted = self.wanted();
        let glyphs = self
            .glyphs(|reflection, spacing| Lattice::reflected(field, view, reflection, spacing))?;
        let (mut centers, mut boxes) = (Vec::new(), Vec::new());
        let mut entries = Vec::new();
        if wanted.contains(&Overlay::Boxes) {
            (boxes, entries) = overlay::boxes(view, self.scale, field);
            boxes.extend(self.reflected(|view| overlay::boxes(view, self.scale, field).0));
        }
        if wanted.contains(&Overlay::Centers) {
            // the same colours
            (centers, entries) = overlay::centers(view, self.scale, field);
            centers.extend(self.reflected(|view| overlay::centers(view, self.scale, field).0));
        }
        self.layers.legend.extend(entries);
        self.isolines()?;
        self.layers.items.extend(glyphs);
        let stations = self.stations();
        for wanted in wanted {
            let items = match wanted {
                Overlay::Boxes => std::mem::take(&mut boxes),
                Overlay::Centers => std::mem::take(&mut centers),
                other => self.overlay(other, &stations),
            };
            self.layers.items.extend(items);
        }
        Ok(())
    }

    /// The overlays in their order, each once; a notice says which need cells that there are not.
    fn wanted(&mut self) -> Vec<Overlay> {
        let mut wanted = self.overlays.shown.clone();
        if self.ground.design.is_some() && !self.overlays.no_cracks {
            wanted.push(Overlay::Cracks);
        }
        wanted.sort_unstable();
        wanted.dedup();
        if !cells::exist(self.ground.field) {
            let missing = wanted.extract_if(.., |overlay| overlay.is_of_cells());
            self.layers.notices.extend(missing.map(Notice::NoCells));
        }
        wanted
    }

    /// An overlay of the body and of its images.
    fn overlay(&self, wanted: Overlay, stations: &Stations) -> Vec<Item> {
        let Ground { field, picture, .. } = self.ground;
        let (view, scale) = (&picture.view, self.scale);
        match wanted {
            Overlay::Supports => overlay::supports(view, scale, &stations.supports),
            Overlay::Loads => overlay::loads(view, scale, &stations.loads),
            Overlay::Cracks => {
                let mirrors = self.lines.at();
                let edges = |view: &View| {
                    let rims = overlay::rims(view, scale, &field.domain.holes, mirrors);
                    [rims, overlay::cuts(view, scale, field)].concat()
                };
                let cracks = self.lines.cracks(&field.step.cracks);
                let cracks = overlay::cracks(view, scale, &cracks);
                [edges(view), self.reflected(edges), cracks].concat()
            }
            wanted => {
                let images = self.reflected(|view| self.of_cover(wanted, view));
                [self.of_cover(wanted, view), images].concat()
            }
        }
    }

    /// What is drawn of the body in the reflected views, where its images are.
    fn reflected(&self, draw: impl Fn(&View) -> Vec<Item>) -> Vec<Item> {
        let of = |image: &MirrorImage| {
            let (flips, size) = (image.flips(), image.view.pixels);
            draw(&image.view).into_iter().map(move |item| item.flipped(flips, size))
        };
        self.images.iter().flat_map(of).collect()
    }

    /// An overlay of the cover.
    fn of_cover(&self, wanted: Overlay, view: &View) -> Vec<Item> {
        let (scale, field) = (self.scale, self.ground.field);
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

    /// Draws over the deformed plate.
    fn moved(&mut self, body: &MovedBody<'_>, outline: bool) -> Result<(), LayersError> {
        if let Some(overlay) = self.overlays.undeformable() {
            return Err(LayersError::Deformed(overlay));
        }
        let (scale, mirrors) = (self.scale, self.lines.at());
        if outline {
            let items = of_parts(body, |view| overlay::undeformed_outline(view, mirrors, scale))?;
            self.layers.items.extend(items);
        }
        let glyphs = self.glyphs(|reflection, spacing| {
            let image = body.images.iter().find(|one| one.image.reflection == *reflection);
            let points = image.map_or(&body.own, |image| &image.points);
            Lattice::deformed(points, reflection, spacing)
        })?;
        self.deformed_isolines(body)?;
        self.layers.items.extend(glyphs);
        let wanted = self.wanted();
        if wanted.contains(&Overlay::Cells) {
            let cells = |view: &DeformedView<'_>| overlay::deformed_cells(view, mirrors, scale);
            self.layers.items.extend(of_parts(body, |view| Ok(cells(view)))?);
        }
        if wanted.contains(&Overlay::Cracks) {
            let edges = |view: &DeformedView<'_>| {
                let outline = overlay::deformed_outline(view, mirrors, scale);
                [outline, overlay::faces(view, scale)].concat()
            };
            self.layers.items.extend(of_parts(body, |view| Ok(edges(view)))?);
        }
        Ok(())
    }

    fn isolines(&mut self) -> Result<(), LayersError> {
        let Some((quantity, levels)) = self.levels() else { return Ok(()) };
        let lines = self.ground.isolines(quantity, &levels, self.lines, self.watcher)?;
        let Ground { field, picture, .. } = self.ground;
        let room = self.room(&picture.view, &self.lines.cracks(&field.step.cracks));
        self.add_isolines(&picture.view, &lines, room);
        Ok(())
    }

    /// Isolines of the plate as it was, where they have moved to.
    fn deformed_isolines(&mut self, body: &MovedBody<'_>) -> Result<(), LayersError> {
        let Some((quantity, levels)) = self.levels() else { return Ok(()) };
        let watcher = self.watcher;
        let lines = whole::between_ends(&levels, self.ground.ends(), |levels| {
            whole::moved_isolines(body, quantity, levels, watcher)
        })?;
        let view = &body.own.view.view;
        // cracks have opened, or closed: nothing can be said of their lines
        let room = self.room(view, &[]);
        self.add_isolines(view, &lines, room);
        Ok(())
    }

    /// Isolines, or a word that there are none of the levels that were listed; others lie in the
    /// range, if there is one.
    fn add_isolines(&mut self, view: &View, lines: &[Isoline], room: Option<Room>) {
        if matches!(self.overlays.isolines, Some(Levels::At(_))) {
            self.notice_of_none(lines.len(), Notice::NoIsoline);
        }
        self.layers.items.extend(overlay::isolines(view, self.scale, lines, room));
    }

    fn notice_of_none(&mut self, count: usize, notice: Notice) {
        self.layers.notices.extend((count == 0).then_some(notice));
    }

    /// Where labels of levels may stand, if they are asked for: not below a legend.
    fn room(&self, view: &View, cracks: &[Crack]) -> Option<Room> {
        let Ground { picture, has_bar, .. } = self.ground;
        let notation = || match has_bar {
            true => Notation::of(&picture.normalization),
            false => Notation::PLAIN,
        };
        let legend = overlay::legend_box(view, self.scale, &self.layers.legend);
        let all = self.overlays.level_labels.then(|| Room::new(picture, cracks, notation()));
        all.map(|room| legend.into_iter().fold(room, Room::without))
    }

    /// The quantity of isolines and their levels, if they are asked for and there can be some.
    fn levels(&mut self) -> Option<(&'a Quantity, Vec<f64>)> {
        let wanted = self.overlays.isolines.as_ref()?;
        let Some(quantity) = self.ground.quantity else {
            self.layers.notices.push(Notice::NoIsolines);
            return None;
        };
        Some((quantity, self.ground.levels(wanted)))
    }

    /// Arrows and crosses with what their lengths mean in the legend. `lattice` makes points of an
    /// image with a spacing.
    fn glyphs<'f>(
        &mut self,
        lattice: impl Fn(&Reflection, f64) -> Lattice<'f>,
    ) -> Result<Vec<Item>, LayersError> {
        let Ground { field, picture: Picture { view, .. }, .. } = self.ground;
        let mut items = Vec::new();
        if let Some(spacing) = self.overlays.crosses {
            let mut found = Vec::new();
            for reflection in self.reflections() {
                let points = lattice(&reflection, spacing * self.scale);
                let crosses = points.principal(self.watcher)?.into_iter();
                found.extend(crosses.map(|cross| cross.reflected(&reflection)));
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
            for reflection in self.reflections() {
                let points = lattice(&reflection, spacing * self.scale);
                let arrows = points.vectors(&shown, self.watcher)?.into_iter();
                found.extend(arrows.map(|arrow| arrow.reflected(&reflection)));
            }
            self.notice_of_none(found.len(), Notice::NoArrow);
            let (more, meaning) = overlay::arrows(view, self.scale, &found, spacing);
            items.extend(more);
            self.layers.legend.extend(meaning);
        }
        Ok(items)
    }

    /// The body as it is, and its images.
    fn reflections(&self) -> Vec<Reflection> {
        let images = self.images.iter().map(|image| image.reflection);
        [Reflection::NONE].into_iter().chain(images).collect()
    }

    /// Points along the border with supports and loads; none if nobody asks for them.
    fn stations(&mut self) -> Stations {
        if !self.overlays.have_stations() {
            return Stations::default();
        }
        let spacing = SPACING * self.scale * self.ground.picture.view.pixel_size();
        let stations = Stations::of(self.ground.dataset, spacing).unwrap_or_else(|notice| {
            self.layers.notices.push(notice);
            Stations::default()
        });
        stations.mirrored(&self.lines)
    }

    /// The layers, with their legend over them if it has room.
    fn with_legend(self) -> Layers {
        let mut layers = self.layers;
        let inside = overlay::legend(&self.ground.picture.view, self.scale, &layers.legend);
        if !inside.is_empty() {
            layers.legend.clear();
        }
        layers.items.extend(inside);
        layers
    }
}

/// What is drawn of the deformed body and, flipped, of its images.
fn of_parts(
    body: &MovedBody<'_>,
    draw: impl Fn(&DeformedView<'_>) -> Result<Vec<Item>, DeformError>,
) -> Result<Vec<Item>, DeformError> {
    let mut items = draw(&body.own.view)?;
    for MovedImage { image, points } in &body.images {
        let (flips, size) = (image.flips(), image.view.pixels);
        items.extend(draw(&points.view)?.into_iter().map(|item| item.flipped(flips, size)));
    }
    Ok(items)
}
