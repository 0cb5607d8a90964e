//! The time that frames of the window take, measured without a display: what `ppum bench window` tells.
//!
//! A frame of panning is all that lies between the mouse's move and the pixels: egui's input and layout, the picture of the
//! new view, its way to the device, and egui's drawing, which is waited for. In the window most of it happens side by side.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{self, RenderState, RendererOptions, ScreenDescriptor, WgpuSetup, wgpu};
use egui::{
    Context, Event, FullOutput, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2,
};
use pollster::block_on;
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::frames::Backend;
use crate::session::Session;
use crate::stage::pixels;

/// What a frame took \[s\].
#[derive(Clone, Copy, Debug)]
pub struct FrameTime {
    /// Input, layout and shapes.
    pub layout: f64,
    /// The picture, until it is there.
    pub picture: f64,
    /// Tessellation, and textures on their way to the device.
    pub upload: f64,
    /// The device, until it has drawn.
    pub paint: f64,
}

impl FrameTime {
    /// All of it.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.layout + self.picture + self.upload + self.paint
    }
}

/// A window whose frames are measured.
pub struct Measured {
    ctx: Context,
    viewer: Viewer,
    state: RenderState,
    target: wgpu::TextureView,
    woken: Receiver<()>,
    size: [u32; 2],
    start: Instant,
    mouse: Pos2,
    /// What textures of the last output took on their way \[s\].
    uploading: f64,
}

/// A window that cannot be measured.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TimingError {
    /// Nothing draws the window.
    #[error(
        "no graphics driver draws the window, not even in software ({0}); install one, such as mesa-vulkan-drivers"
    )]
    NoDriver(String),
    /// The device has failed.
    #[error("the graphics device fails: {0}")]
    Device(String),
    /// No picture comes.
    #[error("no picture after {} s", PATIENCE.as_secs())]
    Late,
}

/// Nobody waits longer for a picture.
const PATIENCE: Duration = Duration::from_secs(120);

impl Measured {
    /// A window without panels that shows a dataset.
    ///
    /// # Errors
    /// No graphics driver.
    pub fn new(
        dataset: Arc<Dataset>,
        size: [u32; 2],
        backend: Backend,
    ) -> Result<Self, TimingError> {
        let state = device()?;
        let target = target(&state, size);
        let (ctx, (send, woken)) = (Context::default(), channel());
        ctx.set_request_repaint_callback(move |_| {
            // nobody listens to the last ones
            let _ = send.send(());
        });
        let session = Session { panels: false, ..Session::default() };
        let mut viewer = Viewer::with_backend(&ctx, session, backend);
        pixels::use_device(&ctx, state.target_format);
        viewer.open(None, dataset);
        let mouse = pos2(size[0] as f32, size[1] as f32) / 2.0;
        Ok(Self {
            ctx,
            viewer,
            state,
            target,
            woken,
            size,
            start: Instant::now(),
            mouse,
            uploading: 0.0,
        })
    }

    /// The device that draws the window.
    #[must_use]
    pub fn device(&self) -> String {
        self.state.adapter.get_info().name
    }

    /// Shows the window until its first picture is on the screen \[s\].
    ///
    /// # Errors
    /// A device that fails; no picture.
    pub fn first(&mut self) -> Result<f64, TimingError> {
        let start = Instant::now();
        self.show(Vec::new());
        self.wait(|viewer| viewer.stages[0].frames.newest().is_some())?;
        let output = self.show(Vec::new());
        self.draw(output)?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// Shows the window until nothing better will come.
    ///
    /// # Errors
    /// A device that fails; no picture.
    pub fn rest(&mut self) -> Result<(), TimingError> {
        self.wait(|viewer| !viewer.stages[0].frames.is_working())?;
        let output = self.show(Vec::new());
        self.draw(output).map(|_| ())
    }

    /// The time until the window wants to be shown again, when nothing happens.
    pub fn idle(&mut self) -> Duration {
        // effects of the mouse fade for a while
        for _ in 0..60 {
            self.show(Vec::new());
            std::thread::sleep(Duration::from_millis(10));
        }
        let output = self.show(Vec::new());
        output.viewport_output.values().map(|v| v.repaint_delay).min().unwrap_or(Duration::MAX)
    }

    /// Takes hold of the plate.
    pub fn press(&mut self) {
        self.show(vec![Event::PointerMoved(self.mouse)]);
        let button = self.button(true);
        self.show(vec![button]);
    }

    /// Lets go of it.
    pub fn release(&mut self) {
        let button = self.button(false);
        self.show(vec![button]);
    }

    fn button(&self, pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos: self.mouse, button, pressed, modifiers }
    }

    /// Drags the plate by so many pixels.
    ///
    /// # Errors
    /// A device that fails; no picture.
    pub fn drag(&mut self, by: [f32; 2]) -> Result<FrameTime, TimingError> {
        let start = Instant::now();
        self.mouse += vec2(by[0], by[1]);
        self.show(vec![Event::PointerMoved(self.mouse)]);
        let (asked, view) = (Instant::now(), self.viewer.stages[0].view);
        self.wait(|viewer| {
            let newest = viewer.stages[0].frames.newest();
            newest.is_some_and(|frame| Some(frame.wanted.view) == view)
        })?;
        let there = Instant::now();
        let output = self.show(Vec::new());
        let uploading = self.uploading;
        let layout = ((asked - start) + there.elapsed()).as_secs_f64() - uploading;
        let [upload, paint] = self.draw(output)?;
        let picture = (there - asked).as_secs_f64();
        Ok(FrameTime { layout, picture, upload: upload + uploading, paint })
    }

    /// Shows the window once more, although nothing has changed: what egui's own drawing takes.
    ///
    /// # Errors
    /// A device that fails.
    pub fn again(&mut self) -> Result<FrameTime, TimingError> {
        let start = Instant::now();
        let output = self.show(Vec::new());
        let layout = start.elapsed().as_secs_f64();
        let [upload, paint] = self.draw(output)?;
        Ok(FrameTime { layout, picture: 0.0, upload, paint })
    }

    fn show(&mut self, events: Vec<Event>) -> FullOutput {
        let size = vec2(self.size[0] as f32, self.size[1] as f32);
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size));
        let time = Some(self.start.elapsed().as_secs_f64());
        let input = RawInput { screen_rect, time, events, ..RawInput::default() };
        let mut output = self.ctx.run_ui(input, |ui| self.viewer.show(ui));
        let start = Instant::now();
        let mut textures: Vec<_> = output.textures_delta.set.drain().collect();
        textures.sort_by_key(|(id, _)| format!("{id:?}"));
        let RenderState { device, queue, renderer, .. } = &self.state;
        for (id, image) in
            textures.iter().flat_map(|(id, all)| all.iter().map(move |one| (id, one)))
        {
            renderer.write().update_texture(device, queue, *id, image);
        }
        output.textures_delta.free.drain().for_each(|id| renderer.write().free_texture(&id));
        self.uploading = start.elapsed().as_secs_f64();
        output
    }

    fn wait(&mut self, is_there: impl Fn(&Viewer) -> bool) -> Result<(), TimingError> {
        let start = Instant::now();
        loop {
            self.viewer.stages[0].frames.poll();
            if is_there(&self.viewer) {
                return Ok(());
            }
            let left = PATIENCE.checked_sub(start.elapsed()).ok_or(TimingError::Late)?;
            // who asks to be shown once more before it was shown is not heard
            let _ = self.woken.recv_timeout(left.min(Duration::from_micros(500)));
        }
    }

    /// Draws an output and waits for it: seconds to hand it over, and to draw it.
    fn draw(&self, output: FullOutput) -> Result<[f64; 2], TimingError> {
        let start = Instant::now();
        let shapes = self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let RenderState { device, queue, renderer, .. } = &self.state;
        let mut renderer = renderer.write();
        let screen = ScreenDescriptor {
            size_in_pixels: self.size,
            pixels_per_point: output.pixels_per_point,
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let buffers = renderer.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        let handed = start.elapsed().as_secs_f64();
        let ops = wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
            store: wgpu::StoreOp::Store,
        };
        let view = &self.target;
        let attachment =
            wgpu::RenderPassColorAttachment { view, resolve_target: None, ops, depth_slice: None };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
        renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
        queue.submit(buffers.into_iter().chain([encoder.finish()]));
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        device.poll(wait).map_err(|error| TimingError::Device(error.to_string()))?;
        Ok([handed, start.elapsed().as_secs_f64() - handed])
    }
}

/// A device as the window would take it.
fn device() -> Result<RenderState, TimingError> {
    let setup = WgpuSetup::without_display_handle();
    let instance = block_on(setup.new_instance());
    let configuration = egui_wgpu::WgpuConfiguration { wgpu_setup: setup, ..Default::default() };
    block_on(RenderState::create(&configuration, &instance, None, RendererOptions::default()))
        .map_err(|error| TimingError::NoDriver(error.to_string()))
}

fn target(state: &RenderState, [width, height]: [u32; 2]) -> wgpu::TextureView {
    let texture = state.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: state.target_format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
