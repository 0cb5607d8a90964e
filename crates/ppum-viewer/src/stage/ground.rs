//! The grounds of panels, drawn by a shader of our own: that of egui takes 60 ns a pixel on a software driver, whatever it draws.

use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use egui::{Color32, Frame, PaintCallbackInfo, Panel, Rect, Ui};

use super::pixels;

/// Shows a panel on its ground.
pub fn show<R>(panel: Panel, ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    let frame = Frame::side_top_panel(ui.style());
    let color = frame.fill;
    let add = |ui: &mut Ui| {
        // what can be seen of a panel is all of it
        fill(ui, ui.clip_rect(), color);
        add(ui)
    };
    panel.frame(frame.fill(Color32::TRANSPARENT)).show(ui, add).inner
}

/// The colour around the plate.
pub(super) fn around(ui: &Ui) -> Color32 {
    ui.visuals().extreme_bg_color
}

/// Fills a rectangle.
pub fn fill(ui: &Ui, rect: Rect, color: Color32) {
    match pixels::format(ui.ctx()) {
        Some(format) => {
            ui.painter().add(Callback::new_paint_callback(rect, Ground { color, format }))
        }
        None => ui.painter().rect_filled(rect, 0.0, color),
    };
}

/// A rectangle of one colour.
struct Ground {
    color: Color32,
    format: wgpu::TextureFormat,
}

/// What draws it.
struct Pipeline(wgpu::RenderPipeline);

impl CallbackTrait for Ground {
    fn prepare(
        &self,
        device: &wgpu::Device,
        _: &wgpu::Queue,
        _: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        resources.entry().or_insert_with(|| Pipeline(pipeline(device, self.format)));
        Vec::new()
    }

    fn paint(
        &self,
        _: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(Pipeline(pipeline)) = resources.get() else { return };
        let [r, g, b, a] = self.color.to_normalized_gamma_f32().map(f64::from);
        pass.set_pipeline(pipeline);
        pass.set_blend_constant(wgpu::Color { r, g, b, a });
        pass.draw(0..4, 0..1);
    }
}

fn pipeline(device: &wgpu::Device, format: wgpu::TextureFormat) -> wgpu::RenderPipeline {
    let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("ground"),
        source: wgpu::ShaderSource::Wgsl(include_str!("ground.wgsl").into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("ground"),
        ..Default::default()
    });
    let constant = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Constant,
        dst_factor: wgpu::BlendFactor::Zero,
        operation: wgpu::BlendOperation::Add,
    };
    let blend = wgpu::BlendState { color: constant, alpha: constant };
    pixels::pipeline(device, &shader, &layout, ["corner", "plain"], (format, blend))
}
