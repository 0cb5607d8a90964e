//! A field on the card: what stays there while views, functions and quantities change.

use std::sync::Arc;

use ppum::field::Field;
use ppum_render::view::View;
use wgpu::{Buffer, BufferDescriptor, BufferUsages};

use crate::bodies::{Bodies, Components};
use crate::device::Gpu;
use crate::error::GpuError;
use crate::groups::Groups;
use crate::layout::bytes;
use crate::region::{Region, has_own_frames};

/// Bindings for the dataset's data and for a region's; with the view's data they are the eight storage
/// buffers that WebGPU promises.
const MOST_CHUNKS: [usize; 2] = [5, 2];

/// A field on the card. Made by [`Renderer::upload`](crate::Renderer::upload); one for each step of a
/// series, say, of which any can be drawn without further ado.
#[derive(Debug)]
pub struct Scene {
    /// Which device it lives on.
    pub(crate) generation: u64,
    pub(crate) layout: SceneLayout,
    pub(crate) groups: Arc<Groups>,
    /// The dataset's data, in parts that can be bound.
    pub(crate) data: Vec<Buffer>,
    /// Address and number of terms of each patch.
    bodies: Vec<[u32; 2]>,
    place: Option<Place>,
}

/// What a shader must know of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SceneLayout {
    pub(crate) components: Components,
    /// Polynomials have other coordinates than weights.
    pub(crate) own_frames: bool,
    /// Buffers of the dataset's data and of regions.
    pub(crate) chunks: [usize; 2],
    /// Pairs of words that one binding shows.
    pub(crate) chunk_pairs: u32,
}

/// A region on the card.
#[derive(Debug)]
pub(crate) struct Place {
    pub(crate) region: Region,
    pub(crate) buffers: Vec<Buffer>,
    /// Where list and records begin.
    pub(crate) addresses: [u32; 2],
}

impl Scene {
    /// Uploads a field; `most` bounds the bytes of a binding.
    pub(crate) fn new(
        gpu: &Gpu,
        generation: u64,
        field: &Field<'_>,
        most: u64,
    ) -> Result<Self, GpuError> {
        let groups = Groups::new(&field.step.functions);
        let Bodies { pairs, patches } = Bodies::new(field, &groups);
        let chunk_pairs = (most / 8) as u32;
        let data = upload(gpu, "the coefficients", &pairs, chunk_pairs, MOST_CHUNKS[0])?;
        let components = Components::new(field.components());
        let chunks = [data.len(), 1];
        let own_frames = has_own_frames(field);
        let layout = SceneLayout { components, own_frames, chunks, chunk_pairs };
        let groups = Arc::new(groups);
        Ok(Self { generation, layout, groups, data, bodies: patches, place: None })
    }

    /// Sees to it that the patches of a view are on the card.
    pub(crate) fn place(
        &mut self,
        gpu: &Gpu,
        field: &Field<'_>,
        view: &View,
    ) -> Result<(), GpuError> {
        let shows = |place: &Place| place.region.shows(field, view);
        if self.place.as_ref().is_some_and(shows) {
            return Ok(());
        }
        let region = Region::new(field, view);
        let places = region.pairs(field, &self.bodies);
        let what = "the patches in sight";
        let buffers = upload(gpu, what, &places.pairs, self.layout.chunk_pairs, MOST_CHUNKS[1])?;
        self.layout.chunks[1] = buffers.len();
        let addresses = [places.list, places.patches];
        self.place = Some(Place { region, buffers, addresses });
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

/// Uploads pairs of words into as many buffers as bindings need, at least one.
fn upload(
    gpu: &Gpu,
    what: &str,
    pairs: &[[u32; 2]],
    chunk_pairs: u32,
    most: usize,
) -> Result<Vec<Buffer>, GpuError> {
    let chunk = chunk_pairs as usize;
    if pairs.len() > chunk * most {
        let (needed, most) = (8 * pairs.len() as u64, 8 * (chunk * most) as u64);
        return Err(GpuError::TooLarge { what: what.to_owned(), needed, most });
    }
    let empty: &[[u32; 2]] = &[[0; 2]];
    let pairs = if pairs.is_empty() { empty } else { pairs };
    let one = |part: &[[u32; 2]]| storage(gpu, what, part.as_flattened());
    gpu.checked(what, || pairs.chunks(chunk).map(one).collect())
}

/// A buffer with these words.
pub(crate) fn storage(gpu: &Gpu, label: &str, words: &[u32]) -> Buffer {
    let buffer = gpu.device().create_buffer(&BufferDescriptor {
        label: Some(label),
        size: 4 * words.len() as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue().write_buffer(&buffer, 0, &bytes(words));
    buffer
}
