//! The time that frames of the window take, measured without a display: what `ppum bench window` tells.
//!
//! A frame of panning is all that lies between the mouse's move and the pixels: egui's input and layout, the picture of the
//! new view, its way to the device, and egui's drawing, which is waited for. In the window most of it happens side by side.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{RendererOptions, wgpu};
use egui::{
    Context, Event, FullOutput, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2,
};
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::frames::Backend;
use crate::session::Session;
use crate::surface::{PATIENCE, Surface, SurfaceError};

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
    surface: Surface,
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
    /// More pixels than the device draws.
    #[error("the window has {0} × {1} pixels, and the graphics device draws at most {2} × {2}")]
    Size(u32, u32, u32),
    /// No picture comes.
    #[error("no picture after {} s", PATIENCE.as_secs())]
    Late,
}

impl Measured {
    /// A window that shows a dataset, with its panels.
    ///
    /// # Errors
    /// No graphics driver.
    pub fn new(
        dataset: Arc<Dataset>,
        size: [u32; 2],
        backend: Backend,
    ) -> Result<Self, TimingError> {
        let (ctx, (send, woken)) = (Context::default(), channel());
        let surface = surface(&ctx, size)?;
        ctx.set_request_repaint_callback(move |_| {
            // nobody listens to the last ones
            let _ = send.send(());
        });
        let mut viewer = Viewer::with_backend(&ctx, Session::default(), backend);
        viewer.open(None, dataset);
        // left of the middle, away from panels and the colour bar
        let mouse = pos2(size[0] as f32 / 3.0, size[1] as f32 / 2.0);
        Ok(Self { ctx, viewer, surface, woken, size, start: Instant::now(), mouse, uploading: 0.0 })
    }

    /// The device that draws the window.
    #[must_use]
    pub fn device(&self) -> String {
        self.surface.state.adapter.get_info().name
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
        self.surface.send(&mut output.textures_delta);
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
        let handed = self.surface.hand_over(&self.ctx, output);
        let handing = start.elapsed().as_secs_f64();
        self.surface.draw(handed, wgpu::Color::BLACK);
        self.surface.wait().map_err(|error| TimingError::Device(error.to_string()))?;
        Ok([handing, start.elapsed().as_secs_f64() - handing])
    }
}

fn surface(ctx: &Context, [width, height]: [u32; 2]) -> Result<Surface, TimingError> {
    let options = RendererOptions::default();
    Surface::new(ctx, [width, height], options).map_err(|error| match error {
        SurfaceError::NoDriver(error) => TimingError::NoDriver(error.to_string()),
        SurfaceError::Size(most) => TimingError::Size(width, height, most),
    })
}
