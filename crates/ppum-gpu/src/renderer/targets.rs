//! The textures and buffers of frames, and the passes that use them.

use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindingResource, Buffer,
    BufferDescriptor, BufferUsages, CommandEncoder, Extent3d, LoadOp, Operations,
    RenderPassColorAttachment, RenderPassDescriptor, RenderPipeline, StoreOp, Texture,
    TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView,
};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::frame::areas::PixelArea;
use crate::frame::shading::PALETTE_TEXELS;
use crate::frame::view_data::ViewData;
use crate::layout::bytes;
use crate::program::pipelines::{Pipelines, SumPasses};
use crate::scene::OnCard;
use crate::shader::compose::ShaderVariant;
use crate::shader::passes::{Finish, SUMS};

/// Textures that are used again from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct Targets {
    size: [u32; 2],
    /// Sums of weights and fields.
    sums: Vec<TextureView>,
    palette: Option<(Vec<u8>, TextureView)>,
    /// The view's data and quads, in buffers that grow.
    uniform: Option<Buffer>,
    view: Option<Buffer>,
    quads: Option<Buffer>,
}

impl Targets {
    /// Textures of the right size, and the colours if the output has some.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        pipelines: &Pipelines,
        palette_texels: Option<Vec<u8>>,
    ) {
        if self.size != size {
            self.sums.clear();
            self.size = size;
        }
        while self.sums.len() < pipelines.sums() {
            let texture = target(gpu, size, SUMS);
            self.sums.push(texture.create_view(&Default::default()));
        }
        let texels = match palette_texels {
            Some(texels) => texels,
            None if self.palette.is_some() => return,
            None => vec![0; 4 * (PALETTE_TEXELS as usize + 3)],
        };
        if self.palette.as_ref().is_none_or(|(known, _)| *known != texels) {
            let view = palette(gpu, &texels);
            self.palette = Some((texels, view));
        }
    }

    /// Writes the view's data.
    pub(crate) fn write(&mut self, gpu: &Gpu, data: &ViewData) {
        let storage = BufferUsages::STORAGE;
        let pairs: Vec<u32> = data.pairs.as_flattened().iter().map(|v| v.to_bits()).collect();
        write(gpu, &mut self.uniform, BufferUsages::UNIFORM, &data.record.words());
        write(gpu, &mut self.view, storage, &pairs);
    }

    /// Group 0: view, dataset, region.
    pub(crate) fn data(
        &self,
        gpu: &Gpu,
        on_card: &OnCard,
        pipelines: &Pipelines,
    ) -> Result<BindGroup, GpuError> {
        let buffers = [&self.uniform, &self.view].into_iter().flatten();
        let textures =
            [&on_card.data, &on_card.region()?.texture].map(BindingResource::TextureView);
        let resources = buffers.map(Buffer::as_entire_binding).chain(textures).collect();
        Ok(group(gpu, &pipelines.data, resources))
    }

    /// The first two passes of splatting: `count` quads of these words.
    pub(crate) fn sum(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        SumPasses { sums, weights, fields, slots }: &SumPasses,
        data: &BindGroup,
        (words, count): (&[u32], u32),
    ) {
        let words = if words.is_empty() { &[0][..] } else { words };
        write(gpu, &mut self.quads, BufferUsages::VERTEX, words);
        let (into, others) = self.sums.split_at(1);
        let sums = group(gpu, sums, into.iter().map(BindingResource::TextureView).collect());
        self.add(encoder, (weights, &[data]), into, count);
        for (pipeline, into) in fields.iter().zip(others.chunks(slots.per_pair as usize)) {
            self.add(encoder, (pipeline, &[data, &sums]), into, count);
        }
    }

    /// Draws all quads into cleared textures.
    fn add(
        &self,
        encoder: &mut CommandEncoder,
        (pipeline, groups): (&RenderPipeline, &[&BindGroup]),
        into: &[TextureView],
        count: u32,
    ) {
        let attachments: Vec<_> = into.iter().map(attachment).collect();
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some("sum"),
            color_attachments: &attachments,
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        for (index, group) in (0..).zip(groups) {
            pass.set_bind_group(index, *group, &[]);
        }
        if let Some(quads) = &self.quads {
            pass.set_vertex_buffer(0, quads.slice(..));
            pass.draw(0..4, 0..count);
        }
    }

    /// The pass that makes the output; gives the textures it writes.
    pub(crate) fn finish(
        &self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        pipelines: &Pipelines,
        (data, areas): (&BindGroup, &[(PixelArea, ShaderVariant)]),
        last_pass: &Finish,
    ) -> Texture {
        let palette = self.palette.as_ref().map(|(_, view)| view);
        let summed = self.sums[..pipelines.sums()].iter().chain(palette);
        let resources = summed.map(BindingResource::TextureView).collect();
        let textures = group(gpu, &pipelines.textures, resources);
        let drawn = target(gpu, self.size, last_pass.format);
        let view = drawn.create_view(&Default::default());
        let attachments = [attachment(&view)];
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some("finish"),
            color_attachments: &attachments,
            ..Default::default()
        });
        pass.set_bind_group(0, data, &[]);
        pass.set_bind_group(1, &textures, &[]);
        for (PixelArea { rect: [x, y, width, height], others }, kind) in areas {
            if let Some(pipeline) = pipelines.finish.get(kind) {
                let group = others.group.unwrap_or_default();
                pass.set_pipeline(pipeline);
                pass.set_scissor_rect(*x, *y, *width, *height);
                pass.draw(0..3, group..group + 1);
            }
        }
        drop(pass);
        drawn
    }
}

fn attachment(view: &TextureView) -> Option<RenderPassColorAttachment<'_>> {
    let ops = Operations { load: LoadOp::Clear(wgpu::Color::TRANSPARENT), store: StoreOp::Store };
    Some(RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
}

fn group(gpu: &Gpu, layout: &BindGroupLayout, resources: Vec<BindingResource<'_>>) -> BindGroup {
    let entry = |(binding, resource)| BindGroupEntry { binding, resource };
    let entries: Vec<_> = (0..).zip(resources).map(entry).collect();
    let descriptor = BindGroupDescriptor { label: None, layout, entries: &entries };
    gpu.device().create_bind_group(&descriptor)
}

/// A texture to draw into and to read.
fn target(gpu: &Gpu, size: [u32; 2], format: TextureFormat) -> Texture {
    let usage =
        TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    gpu.device().create_texture(&descriptor(size, format, usage))
}

fn descriptor(
    [width, height]: [u32; 2],
    format: TextureFormat,
    usage: TextureUsages,
) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: None,
        size: Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    }
}

/// The colours as a texture one texel high.
fn palette(gpu: &Gpu, texels: &[u8]) -> TextureView {
    let width = texels.len() as u32 / 4;
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let descriptor = descriptor([width, 1], TextureFormat::Rgba8Unorm, usage);
    let texture = gpu.device().create_texture(&descriptor);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(texels.len() as u32),
        rows_per_image: None,
    };
    gpu.queue().write_texture(texture.as_image_copy(), texels, layout, descriptor.size);
    texture.create_view(&Default::default())
}

/// Writes words into a buffer, a larger one if they do not fit.
fn write(gpu: &Gpu, buffer: &mut Option<Buffer>, usage: BufferUsages, words: &[u32]) {
    let size = 4 * words.len() as u64;
    let fits = |buffer: &&mut Buffer| buffer.size() >= size;
    let buffer = match buffer.as_mut().filter(fits) {
        Some(buffer) => buffer,
        None => buffer.insert(gpu.device().create_buffer(&BufferDescriptor {
            label: Some("view"),
            size: size.next_power_of_two().min(gpu.limits().max_buffer_size).max(size),
            usage: usage | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })),
    };
    gpu.queue().write_buffer(buffer, 0, &bytes(words));
}
