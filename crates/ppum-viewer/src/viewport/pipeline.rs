//! The target of custom shaders.

use eframe::egui_wgpu::wgpu;
use egui::{Context, Id};

/// The format of what is drawn on, if our shaders can.
pub(super) fn format(ctx: &Context) -> Option<wgpu::TextureFormat> {
    ctx.data(|data| data.get_temp(id()))
}

pub(super) fn id() -> Id {
    Id::unique("format of the window's pixels")
}

/// Draws triangles of vertices on a format, or the four corners of a rectangle.
pub(super) fn pipeline(
    device: &wgpu::Device,
    shader: &wgpu::ShaderModule,
    [corner, pixel]: [&str; 2],
    (format, blend): (wgpu::TextureFormat, wgpu::BlendState),
    vertex: Option<wgpu::VertexBufferLayout<'_>>,
) -> wgpu::RenderPipeline {
    let buffers: Vec<_> = vertex.iter().cloned().map(Some).collect();
    let topology = match vertex {
        Some(_) => wgpu::PrimitiveTopology::TriangleList,
        None => wgpu::PrimitiveTopology::TriangleStrip,
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pixel),
        layout: None,
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(corner),
            buffers: &buffers,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
        },
        primitive: wgpu::PrimitiveState { topology, ..Default::default() },
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some(pixel),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(blend),
                write_mask: wgpu::ColorWrites::ALL,
            })],
            compilation_options: wgpu::PipelineCompilationOptions::default(),
        }),
        multiview_mask: None,
        cache: None,
    })
}
