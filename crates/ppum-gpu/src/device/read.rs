//! Reading images back as numbers.

use std::sync::mpsc;

use wgpu::{
    BufferDescriptor, BufferUsages, COPY_BYTES_PER_ROW_ALIGNMENT, Extent3d, MapMode, PollType,
    TexelCopyBufferInfo, TexelCopyBufferLayout, Texture,
};

use super::Gpu;
use crate::error::GpuError;

/// The bytes of a texture, row by row without gaps.
pub(crate) fn texture(gpu: &Gpu, texture: &Texture) -> Result<Vec<u8>, GpuError> {
    let Extent3d { width, height, .. } = texture.size();
    let texel = texture.format().block_copy_size(None).unwrap_or(4);
    let row = width * texel;
    let padded = row.next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT);
    let (sender, receiver) = mpsc::channel();
    let buffer = gpu.checked("read the picture", || {
        let buffer = gpu.device().create_buffer(&BufferDescriptor {
            label: Some("picture"),
            size: u64::from(padded) * u64::from(height),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let layout =
            TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
        let into = TexelCopyBufferInfo { buffer: &buffer, layout };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        gpu.queue().submit([encoder.finish()]);
        buffer.map_async(MapMode::Read, .., move |result| {
            // nobody listens if waiting has failed
            let _ = sender.send(result);
        });
        buffer
    })?;
    wait(gpu)?;
    match receiver.try_recv() {
        Ok(Ok(())) => {}
        _ => return Err(GpuError::Lost),
    }
    let bytes = buffer.get_mapped_range(..).map_err(|_| GpuError::Lost)?;
    let rows = bytes.chunks(padded as usize);
    Ok(rows.flat_map(|line| &line[..row as usize]).copied().collect())
}

/// Waits for the device to finish.
pub(crate) fn wait(gpu: &Gpu) -> Result<(), GpuError> {
    gpu.device().poll(PollType::wait_indefinitely()).map_err(|_| GpuError::Lost)?;
    gpu.verdict()
}
