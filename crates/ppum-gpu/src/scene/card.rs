//! Words put on the device, as textures of texels of four words each.

use std::sync::Arc;

use wgpu::{
    Extent3d, Origin3d, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

use crate::device::Gpu;
use crate::error::GpuError;

/// Texels in a row of a texture of data: a texture then holds up to 1 GiB on any device.
pub(crate) const TEXELS: u32 = 8192;

/// Words of a row.
const ROW: usize = 4 * TEXELS as usize;

/// Words that are written at once, whole rows: 32 MiB, so that staging them takes little beside
/// the data.
const AT_ONCE: usize = 256 * ROW;

/// An open device as data see it.
#[derive(Clone, Debug)]
pub(crate) struct Card {
    pub(crate) gpu: Arc<Gpu>,
    /// Most rows of a texture of data.
    pub(crate) rows: u32,
}

impl Card {
    /// A device with all the rows it has.
    pub(crate) fn new(gpu: Gpu) -> Self {
        let rows = gpu.limits().max_texture_dimension_2d;
        Self { gpu: Arc::new(gpu), rows }
    }

    /// Uploads words, part after part; `what` names them in the plural.
    pub(crate) fn upload(&self, what: &str, parts: &[Vec<u32>]) -> Result<TextureView, GpuError> {
        let words: usize = parts.iter().map(Vec::len).sum();
        let rows = words.div_ceil(ROW).max(1);
        let size_of = |rows: usize| 16 * u64::from(TEXELS) * rows as u64;
        if rows > self.rows as usize {
            let (needed, most) = (size_of(rows), size_of(self.rows as usize));
            return Err(GpuError::TooLarge { what: what.to_owned(), needed, most });
        }
        self.gpu.checked(what, || {
            let texture = self.texture(what, rows as u32);
            self.write_parts(&texture, parts, words);
            texture.create_view(&TextureViewDescriptor::default())
        })
    }

    /// Writes all parts, some rows at a time.
    fn write_parts(&self, texture: &Texture, parts: &[Vec<u32>], words: usize) {
        let mut staged = Vec::with_capacity(words.min(AT_ONCE));
        let mut row = 0;
        for part in parts {
            let mut left = &part[..];
            while !left.is_empty() {
                let (now, later) = left.split_at(left.len().min(AT_ONCE - staged.len()));
                staged.extend(now.iter().map(|word| word.to_le_bytes()));
                left = later;
                if staged.len() == AT_ONCE {
                    self.write_rows(texture, row, &staged);
                    row += (AT_ONCE / ROW) as u32;
                    staged.clear();
                }
            }
        }
        staged.resize(staged.len().next_multiple_of(4), [0; 4]);
        self.write_rows(texture, row, &staged);
    }

    fn texture(&self, what: &str, rows: u32) -> Texture {
        self.gpu.device().create_texture(&TextureDescriptor {
            label: Some(what),
            size: Extent3d { width: TEXELS, height: rows, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rgba32Uint,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        })
    }

    /// Writes texels from the beginning of a row on; the last row may be short.
    fn write_rows(&self, texture: &Texture, row: u32, words: &[[u8; 4]]) {
        let (full, rest) = words.split_at(words.len() / ROW * ROW);
        let height = (full.len() / ROW) as u32;
        self.write(texture, row, full, [TEXELS, height]);
        self.write(texture, row + height, rest, [(rest.len() / 4) as u32, 1]);
    }

    /// Writes words into a rectangle of texels at the beginning of a row.
    fn write(&self, texture: &Texture, y: u32, words: &[[u8; 4]], [width, height]: [u32; 2]) {
        if words.is_empty() {
            return;
        }
        let target =
            TexelCopyTextureInfo { origin: Origin3d { x: 0, y, z: 0 }, ..texture.as_image_copy() };
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * width),
            rows_per_image: None,
        };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        self.gpu.queue().write_texture(target, words.as_flattened(), layout, size);
    }
}
