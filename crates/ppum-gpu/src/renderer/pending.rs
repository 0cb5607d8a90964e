//! Images on the card, and reading them back.

use std::marker::PhantomData;
use std::sync::Arc;

use wgpu::Texture;

use crate::device::Gpu;
#[cfg(not(target_arch = "wasm32"))]
use crate::device::read;
#[cfg(not(target_arch = "wasm32"))]
use crate::error::GpuError;
use crate::program::output::Output;

/// An image on the card, perhaps still being drawn. `read` waits for it. The next image, for
/// example of the next step, can be started before this one is read.
#[derive(Debug)]
#[cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "a page cannot wait for pictures yet")
)]
pub struct QueuedOutput<O> {
    gpu: Arc<Gpu>,
    textures: Vec<Texture>,
    size: [u32; 2],
    output: PhantomData<O>,
}

impl<O: Output> QueuedOutput<O> {
    /// The textures that a program has written.
    pub(crate) fn new(gpu: &Arc<Gpu>, textures: Vec<Texture>, size: [u32; 2]) -> Self {
        Self { gpu: Arc::clone(gpu), textures, size, output: PhantomData }
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Waits for the image and returns it: a [`Raster`](ppum_render::raster::Raster) for
    /// [`Values`](crate::Values), an [`Image`](ppum_render::image::Image) for
    /// [`Colors`](crate::Colors), six rasters (v, x, y, xx, xy, yy) for
    /// [`Derivatives`](crate::Derivatives).
    ///
    /// # Errors
    /// [`GpuError::Lost`]: the device is lost, with the image. [`GpuError::Device`]: an error that
    /// occurred while it was drawn.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read(&self) -> Result<O::Picture, GpuError> {
        let bytes = |texture| read::texture(&self.gpu, texture);
        let textures = self.textures.iter().map(bytes).collect::<Result<_, _>>()?;
        self.gpu.verdict()?;
        Ok(O::picture(self.size, textures))
    }
}
