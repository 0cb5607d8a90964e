//! Pixels of an image drawn by a shader of our own, which does nothing but fetch them.
//!
//! That of egui filters, dithers and counts with remainders at every pixel; a software driver
//! computes all of it, whatever it needs, which takes ten times as long as all the rest of a
//! frame (docs/decisions/0012-frames-of-the-window.md).

use std::sync::{Arc, Weak};

use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use egui::{Context, PaintCallbackInfo, Painter, Rect};
use ppum_render::image::Image;

use super::pipeline::{format, id, pipeline};
use super::solids::Solids;
use crate::frames::ColoredImage;

/// Lets images be drawn by the shader on a device of wgpu; elsewhere egui draws them.
pub fn use_device(ctx: &Context, target: wgpu::TextureFormat) {
    if !target.is_srgb() {
        ctx.data_mut(|data| data.insert_temp(id(), target));
        ctx.add_plugin(Solids);
    }
}

/// Lets egui draw everything.
#[cfg(test)]
pub(crate) fn use_none(ctx: &Context) {
    ctx.data_mut(|data| data.remove::<wgpu::TextureFormat>(id()));
}

/// A slot for an image on the device, freed when its last clone is dropped.
#[derive(Clone, Default)]
pub(super) struct TextureSlot(Arc<()>);

/// Draws an image with its corners at those of a rectangle, a coarse one smoothly; false if egui
/// has to.
pub(super) fn draw(
    painter: &Painter,
    slot: &TextureSlot,
    picture: &Arc<ColoredImage>,
    (target, is_smooth): (Rect, bool),
) -> bool {
    let Some(format) = format(painter.ctx()) else { return false };
    let rect = painter.clip_rect();
    let relative = |x: f32, from: f32, size: f32| 2.0 * (x - from) / size - 1.0;
    let corner = |p: egui::Pos2| {
        [relative(p.x, rect.min.x, rect.width()), -relative(p.y, rect.min.y, rect.height())]
    };
    let ([left, top], [right, bottom]) = (corner(target.min), corner(target.max));
    let shown = ImageDraw {
        slot: slot.clone(),
        picture: Arc::clone(picture),
        corners: [left, top, right, bottom],
        is_smooth,
        format,
    };
    painter.add(Callback::new_paint_callback(rect, shown));
    true
}

/// An image that is to be drawn.
struct ImageDraw {
    slot: TextureSlot,
    picture: Arc<ColoredImage>,
    /// Left, top, right and bottom, from −1 to 1 across the rectangle that is drawn in.
    corners: [f32; 4],
    is_smooth: bool,
    format: wgpu::TextureFormat,
}

/// Pipelines and images on the device.
struct PixelResources {
    pipelines: [wgpu::RenderPipeline; 2],
    sampler: wgpu::Sampler,
    pictures: Vec<DeviceImage>,
}

/// An image on the device.
struct DeviceImage {
    slot: Weak<()>,
    picture: Arc<ColoredImage>,
    texture: wgpu::Texture,
    corners: wgpu::Buffer,
    /// For each of the pipelines.
    bindings: [wgpu::BindGroup; 2],
}

impl CallbackTrait for ImageDraw {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        _: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let kept = resources
            .entry::<PixelResources>()
            .or_insert_with(|| PixelResources::new(device, self.format));
        kept.pictures.retain(|picture| picture.slot.strong_count() > 0);
        let mut known = kept.pictures.iter().position(|picture| picture.is_at(&self.slot));
        if known.is_some_and(|k| kept.pictures[k].picture.image.size != self.picture.image.size) {
            known.take().map(|k| kept.pictures.remove(k));
        }
        match known {
            Some(k) => kept.pictures[k].change(queue, &self.picture),
            None => {
                let new = kept.picture(device, queue, self);
                kept.pictures.push(new);
            }
        }
        if let Some(picture) = kept.pictures.iter().find(|picture| picture.is_at(&self.slot)) {
            let bytes: Vec<u8> = self.corners.iter().flat_map(|x| x.to_le_bytes()).collect();
            queue.write_buffer(&picture.corners, 0, &bytes);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(kept) = resources.get::<PixelResources>() else { return };
        let Some(picture) = kept.pictures.iter().find(|p| p.is_at(&self.slot)) else { return };
        let number = usize::from(self.is_smooth);
        pass.set_pipeline(&kept.pipelines[number]);
        pass.set_bind_group(0, &picture.bindings[number], &[]);
        pass.draw(0..4, 0..1);
    }
}

impl PixelResources {
    fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("picture"),
            source: wgpu::ShaderSource::Wgsl(include_str!("pixels.wgsl").into()),
        });
        let kind = (format, wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let pipelines = ["exact", "smoothed"]
            .map(|entry| pipeline(device, &shader, ["corner", entry], kind, None));
        let filter = wgpu::FilterMode::Linear;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: filter,
            min_filter: filter,
            ..Default::default()
        });
        Self { pipelines, sampler, pictures: Vec::new() }
    }

    fn picture(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        shown: &ImageDraw,
    ) -> DeviceImage {
        let [width, height] = shown.picture.image.size;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let corners = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("corners"),
            size: size_of::<[f32; 4]>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let resources = [
            corners.as_entire_binding(),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        // one that is not smoothed has no sampler
        let bindings = [0, 1].map(|k| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("picture"),
                layout: &self.pipelines[k].get_bind_group_layout(0),
                entries: &entries[..2 + k],
            })
        });
        let (slot, picture) = (Arc::downgrade(&shown.slot.0), Arc::clone(&shown.picture));
        send(queue, &texture, &picture.image);
        DeviceImage { slot, picture, texture, corners, bindings }
    }
}

impl DeviceImage {
    fn is_at(&self, slot: &TextureSlot) -> bool {
        self.slot.as_ptr() == Arc::as_ptr(&slot.0)
    }

    /// Sends another image of the same size, if it is another one.
    fn change(&mut self, queue: &wgpu::Queue, picture: &Arc<ColoredImage>) {
        if !Arc::ptr_eq(&self.picture, picture) {
            send(queue, &self.texture, &picture.image);
            self.picture = Arc::clone(picture);
        }
    }
}

fn send(queue: &wgpu::Queue, texture: &wgpu::Texture, image: &Image) {
    let [width, height] = image.size;
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(4 * width),
        rows_per_image: Some(height),
    };
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    queue.write_texture(texture.as_image_copy(), &image.rgba, layout, size);
}
