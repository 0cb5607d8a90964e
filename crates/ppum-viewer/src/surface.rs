//! The output of egui, drawn on a texture: the window without a display.

use eframe::egui_wgpu::{
    self, RenderState, RendererOptions, ScreenDescriptor, WgpuError, WgpuSetup, WgpuSetupCreateNew,
    wgpu,
};
use egui::{ClippedPrimitive, Context, FullOutput, TexturesDelta};
use pollster::block_on;
use std::time::Duration;

use crate::viewport::pixels;

/// A texture of the window's size, and the device that draws on it: a graphics card, or software.
pub struct Surface {
    /// The device.
    pub state: RenderState,
    /// The target of drawing.
    pub texture: wgpu::Texture,
    size: [u32; 2],
}

/// Shapes on the device, ready to be drawn.
pub struct DeviceShapes {
    shapes: Vec<ClippedPrimitive>,
    screen: ScreenDescriptor,
    encoder: wgpu::CommandEncoder,
    buffers: Vec<wgpu::CommandBuffer>,
}

/// A surface that there cannot be.
#[derive(Debug)]
pub enum SurfaceError {
    /// Nothing to draw with.
    NoDriver(WgpuError),
    /// More pixels than the device draws: at most so many in a row.
    Size(u32),
}

/// Nobody waits longer for the device.
pub const PATIENCE: Duration = Duration::from_secs(120);

impl Surface {
    /// A surface for what a context shows, whose images are drawn by our shader as in the window.
    ///
    /// # Errors
    /// No driver; more pixels than the device draws.
    pub fn new(
        ctx: &Context,
        size: [u32; 2],
        options: RendererOptions,
    ) -> Result<Self, SurfaceError> {
        let state = device(options).map_err(SurfaceError::NoDriver)?;
        let most = state.device.limits().max_texture_dimension_2d;
        if size.iter().any(|n| *n > most) {
            return Err(SurfaceError::Size(most));
        }
        pixels::use_device(ctx, state.target_format);
        let texture = texture(&state, size);
        Ok(Self { state, texture, size })
    }

    /// Sends textures to the device, and frees those that are used no more, always in the
    /// same order.
    pub fn send(&self, delta: &mut TexturesDelta) {
        let RenderState { device, queue, renderer, .. } = &self.state;
        let mut renderer = renderer.write();
        let mut set: Vec<_> = delta.set.drain().collect();
        set.sort_by_key(|(id, _)| format!("{id:?}"));
        for (id, images) in &set {
            images.iter().for_each(|image| renderer.update_texture(device, queue, *id, image));
        }
        delta.free.drain().for_each(|id| renderer.free_texture(&id));
    }

    /// Makes triangles of an output's shapes and hands them over.
    pub fn hand_over(&self, ctx: &Context, output: FullOutput) -> DeviceShapes {
        let RenderState { device, queue, renderer, .. } = &self.state;
        let pixels_per_point = output.pixels_per_point;
        let shapes = ctx.tessellate(output.shapes, pixels_per_point);
        let screen = ScreenDescriptor { size_in_pixels: self.size, pixels_per_point };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut renderer = renderer.write();
        let buffers = renderer.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        DeviceShapes { shapes, screen, encoder, buffers }
    }

    /// Draws them on a ground.
    pub fn draw(&self, handed: DeviceShapes, ground: wgpu::Color) {
        let DeviceShapes { shapes, screen, mut encoder, buffers } = handed;
        let view = &self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let ops =
            wgpu::Operations { load: wgpu::LoadOp::Clear(ground), store: wgpu::StoreOp::Store };
        let attachment =
            wgpu::RenderPassColorAttachment { view, resolve_target: None, ops, depth_slice: None };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
        let renderer = self.state.renderer.read();
        renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
        self.state.queue.submit(buffers.into_iter().chain([encoder.finish()]));
    }

    /// Waits until the device has done all that was asked of it.
    ///
    /// # Errors
    /// A device that fails.
    pub fn wait(&self) -> Result<(), wgpu::PollError> {
        let all = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        self.state.device.poll(all).map(|_| ())
    }
}

/// A device as the window would take it. OpenGL is left out, which the program is built without,
/// but not its tests: what drives windows in them brings it along.
fn device(options: RendererOptions) -> Result<RenderState, WgpuError> {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::PRIMARY;
    let setup = WgpuSetup::from(setup);
    let instance = block_on(setup.new_instance());
    let configuration = egui_wgpu::WgpuConfiguration { wgpu_setup: setup, ..Default::default() };
    block_on(RenderState::create(&configuration, &instance, None, options))
}

fn texture(state: &RenderState, [width, height]: [u32; 2]) -> wgpu::Texture {
    state.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("window"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: state.target_format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
