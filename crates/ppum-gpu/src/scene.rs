//! A field on the card: what stays there while views, functions and quantities change.

use std::sync::Arc;

use ppum::field::Field;
use ppum::vec2::Rect;
use ppum_render::view::View;
use wgpu::{
    Extent3d, Origin3d, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

use crate::bodies::{Bodies, Components, GROUP_BITS, Others, Shape};
use crate::device::Gpu;
use crate::error::GpuError;
use crate::groups::Groups;
use crate::lattice::Lattice;
use crate::layout::bytes;
use crate::region::{Places, Region, has_own_frames};

/// Texels in a row of a texture of data: a texture then holds up to 1 GiB on any device.
pub(crate) const TEXELS: u32 = 8192;

/// A field on the card. Made by [`Renderer::upload`](crate::Renderer::upload); one for each step of a
/// series, say, of which any can be drawn without further ado.
#[derive(Debug)]
pub struct Scene {
    /// Which device it lives on.
    pub(crate) generation: u64,
    pub(crate) layout: SceneLayout,
    pub(crate) groups: Arc<Groups>,
    /// What the patches hold, see [`bodies`](crate::bodies).
    pub(crate) data: TextureView,
    /// The address of each patch's body.
    pub(crate) bodies: Vec<u32>,
    pub(crate) lattice: Option<Lattice>,
    /// Where there are more than smooth terms.
    pub(crate) enriched: Vec<(Rect, Others)>,
    place: Option<Place>,
}

/// What a shader must know of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SceneLayout {
    pub(crate) components: Components,
    pub(crate) shape: Shape,
    /// Patches lie on a lattice.
    pub(crate) is_lattice: bool,
    /// Polynomials have other coordinates than weights.
    pub(crate) own_frames: bool,
    pub(crate) has_holes: bool,
    /// Some crack has several segments.
    pub(crate) has_kinks: bool,
    /// Some bin of the region meets more than 32 patches.
    pub(crate) has_long_lists: bool,
}

impl SceneLayout {
    /// That of a field, with its lattice if it has one.
    pub(crate) fn of(field: &Field<'_>, shape: Shape) -> (Self, Option<Lattice>) {
        let own_frames = has_own_frames(field);
        let lattice = if own_frames { None } else { Lattice::of(&field.step.partition) };
        let layout = Self {
            components: Components::new(field.components()),
            shape,
            is_lattice: lattice.is_some(),
            own_frames,
            has_holes: !field.domain.holes.is_empty(),
            has_kinks: field.step.cracks.iter().any(|crack| crack.points.len() > 2),
            has_long_lists: false,
        };
        (layout, lattice)
    }
}

impl SceneLayout {
    /// The layout where no other terms than these beside the smooth one are.
    pub(crate) fn with(self, others: Others) -> Self {
        Self { shape: Shape { others, ..self.shape }, ..self }
    }
}

/// A region on the card.
#[derive(Debug)]
pub(crate) struct Place {
    pub(crate) region: Region,
    pub(crate) texture: TextureView,
    /// Where list and records begin.
    pub(crate) list: u32,
    pub(crate) patches: u32,
}

impl Scene {
    /// Uploads a field; a texture has `rows` rows at most.
    pub(crate) fn new(
        gpu: &Gpu,
        generation: u64,
        field: &Field<'_>,
        rows: u32,
    ) -> Result<Self, GpuError> {
        let groups = Arc::new(Groups::new(&field.step.functions));
        Self::with_groups(gpu, generation, field, rows, groups)
    }

    /// Uploads the field of a scene on a new device. Its functions may have been replaced since: programs know
    /// them by the groups they had.
    pub(crate) fn renewed(
        &self,
        gpu: &Gpu,
        generation: u64,
        field: &Field<'_>,
        rows: u32,
    ) -> Result<Self, GpuError> {
        Self::with_groups(gpu, generation, field, rows, Arc::clone(&self.groups))
    }

    fn with_groups(
        gpu: &Gpu,
        generation: u64,
        field: &Field<'_>,
        rows: u32,
        groups: Arc<Groups>,
    ) -> Result<Self, GpuError> {
        check_sizes(field, &groups)?;
        let Bodies { words, patches, shape, enriched } = Bodies::new(field, &groups);
        let data = upload(gpu, "the coefficients", &words, rows)?;
        let (layout, lattice) = SceneLayout::of(field, shape);
        let (bodies, place) = (patches, None);
        Ok(Self { generation, layout, groups, data, bodies, lattice, enriched, place })
    }

    /// Sees to it that the patches of a view are on the card.
    pub(crate) fn place(
        &mut self,
        gpu: &Gpu,
        field: &Field<'_>,
        view: &View,
        rows: u32,
    ) -> Result<(), GpuError> {
        let shows = |place: &Place| place.region.shows(field, view);
        if self.place.as_ref().is_some_and(shows) {
            return Ok(());
        }
        let lattice = self.lattice.as_ref();
        let region = Region::new(field, view, lattice);
        let Places { words, list, patches } =
            region.places(field, self.layout.own_frames, lattice, &self.bodies);
        let texture = upload(gpu, "the patches in sight", &words, rows)?;
        // once it is so it stays: a program made for it draws all regions
        self.layout.has_long_lists |= region.bins.longest() > 32;
        self.place = Some(Place { region, texture, list, patches });
        Ok(())
    }

    /// The region on the card, after [`Scene::place`].
    pub(crate) fn placed(&self) -> Result<&Place, GpuError> {
        self.place.as_ref().ok_or(GpuError::Lost)
    }

    /// Checks that a field, perhaps with replaced functions, is the one that was uploaded.
    pub(crate) fn check(&self, field: &Field<'_>) -> Result<(), GpuError> {
        let same = self.bodies.len() == field.step.partition.len()
            && self.groups.functions() == field.step.functions.len()
            && self.layout.components.count == field.components();
        if same {
            return Ok(());
        }
        let message = "the scene was uploaded of another field; upload this one";
        Err(GpuError::Unsupported(message.to_owned()))
    }
}

/// Refuses what the numbers of terms cannot hold.
fn check_sizes(field: &Field<'_>, groups: &Groups) -> Result<(), GpuError> {
    if groups.count() >= 1 << GROUP_BITS || field.components() > MOST_COMPONENTS {
        let (functions, components) = (groups.functions(), field.components());
        return Err(GpuError::Unsupported(format!(
            "{functions} functions and {components} components are more than shaders tell apart; use \
             `--backend cpu`"
        )));
    }
    Ok(())
}

/// Components of a field: a term of four functions times polynomials of degree 8 then stays below 4096 quads.
const MOST_COMPONENTS: usize = 64;

/// Uploads words as a texture of quads.
fn upload(gpu: &Gpu, what: &str, words: &[u32], most: u32) -> Result<TextureView, GpuError> {
    let quads = words.len().div_ceil(4).max(1);
    let rows = quads.div_ceil(TEXELS as usize);
    let size_of = |rows: usize| 16 * u64::from(TEXELS) * rows as u64;
    if rows > most as usize {
        let (needed, most) = (size_of(rows), size_of(most as usize));
        return Err(GpuError::TooLarge { what: what.to_owned(), needed, most });
    }
    gpu.checked(what, || {
        let texture = gpu.device().create_texture(&TextureDescriptor {
            label: Some(what),
            size: Extent3d { width: TEXELS, height: rows as u32, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rgba32Uint,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (row, part) in (0..).step_by(ROWS_AT_ONCE).zip(words.chunks(WORDS_AT_ONCE)) {
            write_rows(gpu, &texture, row, part);
        }
        texture.create_view(&TextureViewDescriptor::default())
    })
}

/// Rows that are written at once: 32 MiB, so that staging them takes little beside the data.
const ROWS_AT_ONCE: usize = 256;

const WORDS_AT_ONCE: usize = 4 * TEXELS as usize * ROWS_AT_ONCE;

/// Writes words from the beginning of a row on; the last row may be short.
fn write_rows(gpu: &Gpu, texture: &Texture, row: u32, words: &[u32]) {
    let in_row = 4 * TEXELS as usize;
    let (full, rest) = words.split_at(words.len() / in_row * in_row);
    let height = (full.len() / in_row) as u32;
    for (y, words, width, height) in
        [(row, full, TEXELS, height), (row + height, rest, rest.len().div_ceil(4) as u32, 1)]
    {
        if words.is_empty() {
            continue;
        }
        let mut words = words.to_vec();
        words.resize(words.len().next_multiple_of(4), 0);
        let target =
            TexelCopyTextureInfo { origin: Origin3d { x: 0, y, z: 0 }, ..texture.as_image_copy() };
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * width),
            rows_per_image: None,
        };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        gpu.queue().write_texture(target, &bytes(&words), layout, size);
    }
}
