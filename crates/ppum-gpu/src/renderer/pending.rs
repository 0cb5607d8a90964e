//! Images on the card, and reading them back.

use std::marker::PhantomData;
use std::sync::Arc;

use wgpu::Texture;

use crate::device::Gpu;
use crate::device::read;
use crate::error::GpuError;
use crate::program::output::Output;

/// An image on the card, perhaps still being drawn. `read` waits for it. The next image, for
/// example of the next step, can be started before this one is read.
#[derive(Debug)]
pub struct QueuedOutput<O> {
    gpu: Arc<Gpu>,
    texture: Texture,
    size: [u32; 2],
    output: PhantomData<O>,
}

impl<O: Output> QueuedOutput<O> {
    /// The texture that a program has written.
    pub(crate) fn new(gpu: &Arc<Gpu>, texture: Texture, size: [u32; 2]) -> Self {
        Self { gpu: Arc::clone(gpu), texture, size, output: PhantomData }
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Waits for the image and returns it: a [`Raster`](ppum_render::raster::Raster) for
    /// [`Values`](crate::Values), an [`Image`](ppum_render::image::Image) for
    /// [`Colors`](crate::Colors).
    ///
    /// # Errors
    /// [`GpuError::Lost`]: the device is lost, with the image. [`GpuError::Device`]: an error that
    /// occurred while it was drawn.
    pub fn read(&self) -> Result<O::Picture, GpuError> {
        let bytes = read::texture(&self.gpu, &self.texture)?;
        self.gpu.verdict()?;
        Ok(O::picture(self.size, bytes))
    }
}
