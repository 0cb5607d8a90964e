//! Pictures on the card, and reading them back.

use std::marker::PhantomData;
use std::sync::Arc;

use wgpu::Texture;

use crate::device::Gpu;
#[cfg(not(target_arch = "wasm32"))]
use crate::device::read;
#[cfg(not(target_arch = "wasm32"))]
use crate::error::GpuError;
use crate::program::output::Output;

/// A picture on the card. Reading it waits until it is drawn; drawing goes on meanwhile, so the
/// next one, of the next step say, can be begun before.
#[derive(Debug)]
#[cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "a page cannot wait for pictures yet")
)]
pub struct Drawn<O> {
    gpu: Arc<Gpu>,
    textures: Vec<Texture>,
    size: [u32; 2],
    output: PhantomData<O>,
}

impl<O: Output> Drawn<O> {
    /// The textures that a program has written.
    pub(crate) fn new(gpu: &Arc<Gpu>, textures: Vec<Texture>, size: [u32; 2]) -> Self {
        Self { gpu: Arc::clone(gpu), textures, size, output: PhantomData }
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The picture: of [`Values`](crate::Values) a [`Raster`](ppum_render::raster::Raster), of
    /// [`Colors`](crate::Colors) an [`Image`](ppum_render::image::Image), of
    /// [`Derivatives`](crate::Derivatives) six rasters, v, x, y, xx, xy, yy.
    ///
    /// # Errors
    /// [`GpuError::Lost`]: the device is lost, with the picture. [`GpuError::Device`]: what went
    /// wrong while it was drawn.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read(&self) -> Result<O::Picture, GpuError> {
        let bytes = |texture| read::texture(&self.gpu, texture);
        let textures = self.textures.iter().map(bytes).collect::<Result<_, _>>()?;
        self.gpu.verdict()?;
        Ok(O::picture(self.size, textures))
    }
}
