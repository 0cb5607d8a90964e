//! The window: frames of panning, the first image, and what it does when nothing happens, measured
//! without a display.
//!
//! A frame of panning is all that lies between the mouse's move and the pixels: egui's input and
//! layout, the image of the new view, its way to the device, and egui's drawing, which is waited
//! for. In the window most of it happens side by side.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, anyhow};
use cpu_time::ProcessTime;
use eframe::egui_wgpu::{RendererOptions, wgpu};
use egui::{
    Context, Event, FullOutput, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2,
};
use ppum::dataset::Dataset;
use ppum_viewer::Viewer;
use ppum_viewer::session::Session;
use ppum_viewer::surface::{PATIENCE, Surface};
use serde::Serialize;

use crate::synthetic::CrackRecipe;
use crate::table::ReportTable;

/// The report of `ppum-bench window`.
#[derive(Debug, Serialize)]
pub struct WindowReport {
    pixels: [u32; 2],
    frames: u32,
    /// The device that draws the window itself.
    device: String,
    rows: Vec<FramesRow>,
}

/// The frames of a dataset.
#[derive(Debug, Serialize)]
struct FramesRow {
    patches: usize,
    /// From opening to the first image on the screen, without reading a file.
    first_ms: f64,
    /// A frame of panning, and the parts of it: input, layout and shapes; the image; tessellation,
    /// and textures on their way to the device; the device.
    frame_ms: WindowSummary,
    layout_ms: WindowSummary,
    image_ms: WindowSummary,
    upload_ms: WindowSummary,
    paint_ms: WindowSummary,
    /// Processor time of all threads for a frame, the device's of software too.
    core_ms: WindowSummary,
    /// Times of a window in which nothing has changed: egui's own layout and drawing.
    again_ms: WindowSummary,
    again_core_ms: WindowSummary,
    /// Processor time in a second in which nothing happens.
    idle_ms: f64,
    /// True if the window wants to be shown then.
    idle_repaints: bool,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct WindowSummary {
    median: f64,
    least: f64,
    /// That of 95 % of the frames.
    most: f64,
}

/// Levels of uniform covers: 4^level patches.
const LEVELS: [u8; 3] = [4, 7, 10];

/// The first frames find nothing prepared, and are not counted.
const WARM: u32 = 3;

impl WindowReport {
    /// Measures; `quick` shows few patches on few pixels.
    ///
    /// # Errors
    /// No graphics driver, or one that fails.
    pub fn new(quick: bool, frames: u32) -> anyhow::Result<Self> {
        let pixels = if quick { [320, 240] } else { [1280, 800] };
        let levels = if quick { &LEVELS[..1] } else { &LEVELS[..] };
        let (mut rows, mut device) = (Vec::new(), String::new());
        for &level in levels {
            let dataset = Arc::new(CrackRecipe::new(level, level).dataset()?);
            let patches = dataset.steps[0].partition.len();
            let mut window = MeasuredWindow::new(dataset, pixels)?;
            device = window.surface.state.adapter.get_info().name;
            rows.push(FramesRow::new(patches, &mut window, frames)?);
        }
        Ok(Self { pixels, frames, device, rows })
    }
}

impl crate::Report for WindowReport {
    fn words(&self) -> String {
        let Self { pixels: [columns, rows], frames, device, .. } = self;
        format!(
            "window of {columns}x{rows} pixels, drawn by {device}: dragging the plate, von Mises stress\n\
             ms, medians of {frames} frames: input and layout, image, upload, painting; 95 % take no longer than `most`\n"
        )
    }

    fn tables(&self) -> Vec<ReportTable> {
        let head = [
            "patches", "first", "frame", "most", "layout", "image", "upload", "paint", "core",
            "again", "core", "idle/s",
        ];
        let line = |row: &FramesRow| {
            let parts = [row.layout_ms, row.image_ms, row.upload_ms, row.paint_ms];
            let cores = [row.core_ms, row.again_ms, row.again_core_ms];
            let medians = parts.into_iter().chain(cores).map(|part| part.median);
            let numbers = [row.first_ms, row.frame_ms.median, row.frame_ms.most];
            let numbers = numbers.into_iter().chain(medians).chain([row.idle_ms]);
            let cells = numbers.map(|number| format!("{number:.1}"));
            [row.patches.to_string()].into_iter().chain(cells).collect()
        };
        vec![ReportTable {
            title: "Frames of the window".into(),
            words: 0,
            head: head.map(str::to_owned).into(),
            rows: self.rows.iter().map(line).collect(),
            note: String::new(),
        }]
    }
}

impl FramesRow {
    fn new(patches: usize, window: &mut MeasuredWindow, frames: u32) -> anyhow::Result<Self> {
        let first_ms = 1e3 * window.first()?;
        window.rest()?;
        let times = window.dragged(frames)?;
        window.rest()?;
        let again = (0..frames).map(|_| FrameTime::of(|| window.again()));
        let again = again.collect::<anyhow::Result<Vec<_>>>()?;
        let idle_repaints = window.idle() < Duration::from_secs(3600);
        let core = ProcessTime::now();
        std::thread::sleep(Duration::from_secs(1));
        let idle_ms = 1e3 * core.elapsed().as_secs_f64();
        let of = |times: &[FrameTime], part: fn(&FrameTime) -> f64| {
            WindowSummary::new(times.iter().map(part).collect())
        };
        Ok(Self {
            patches,
            first_ms,
            frame_ms: of(&times, FrameTime::total),
            layout_ms: of(&times, |time| time.layout),
            image_ms: of(&times, |time| time.image),
            upload_ms: of(&times, |time| time.upload),
            paint_ms: of(&times, |time| time.paint),
            core_ms: of(&times, |time| time.core),
            again_ms: of(&again, FrameTime::total),
            again_core_ms: of(&again, |time| time.core),
            idle_ms,
            idle_repaints,
        })
    }
}

impl WindowSummary {
    /// Summarises seconds.
    fn new(seconds: Vec<f64>) -> Self {
        let mut ms: Vec<_> = seconds.into_iter().map(|s| 1e3 * s).collect();
        ms.sort_by(f64::total_cmp);
        let (lower, upper) = (ms[(ms.len() - 1) / 2], ms[ms.len() / 2]);
        let most = ms[(ms.len() - 1) * 95 / 100];
        Self { median: 0.5 * (lower + upper), least: ms[0], most }
    }
}

/// The time of a frame \[s\].
#[derive(Clone, Copy, Debug, Default)]
struct FrameTime {
    layout: f64,
    image: f64,
    upload: f64,
    paint: f64,
    /// Processor time.
    core: f64,
}

impl FrameTime {
    /// Does a frame, and notes what processors it takes.
    fn of(frame: impl FnOnce() -> anyhow::Result<Self>) -> anyhow::Result<Self> {
        let core = ProcessTime::now();
        let time = frame()?;
        Ok(Self { core: core.elapsed().as_secs_f64(), ..time })
    }

    /// The time that passes.
    fn total(&self) -> f64 {
        self.layout + self.image + self.upload + self.paint
    }
}

/// A window whose frames are measured.
struct MeasuredWindow {
    ctx: Context,
    viewer: Viewer,
    surface: Surface,
    woken: Receiver<()>,
    size: [u32; 2],
    start: Instant,
    mouse: Pos2,
    /// The time to upload the textures of the last output \[s\].
    uploading: f64,
}

impl MeasuredWindow {
    /// A window that shows a dataset, with its panels.
    fn new(dataset: Arc<Dataset>, size: [u32; 2]) -> anyhow::Result<Self> {
        let (ctx, (send, woken)) = (Context::default(), channel());
        let surface = Surface::new(&ctx, size, RendererOptions::default())
            .map_err(|error| anyhow!("no graphics driver draws the window: {error:?}"))?;
        ctx.set_request_repaint_callback(move |_| {
            // nobody listens to the last ones
            let _ = send.send(());
        });
        let mut viewer = Viewer::new(&ctx, Session::default());
        viewer.open(None, dataset);
        // left of the middle, away from panels and the colour bar
        let mouse = pos2(size[0] as f32 / 3.0, size[1] as f32 / 2.0);
        Ok(Self { ctx, viewer, surface, woken, size, start: Instant::now(), mouse, uploading: 0.0 })
    }

    /// Shows the window until its first image is on the screen \[s\].
    fn first(&mut self) -> anyhow::Result<f64> {
        let start = Instant::now();
        self.show(Vec::new());
        self.wait(|viewer| viewer.viewports[0].frames.newest().is_some())?;
        let output = self.show(Vec::new());
        self.draw(output)?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// Shows the window until nothing better will come.
    fn rest(&mut self) -> anyhow::Result<()> {
        self.wait(|viewer| !viewer.viewports[0].frames.is_working())?;
        let output = self.show(Vec::new());
        self.draw(output).map(|_| ())
    }

    /// The time until the window wants to be shown again, when nothing happens.
    fn idle(&mut self) -> Duration {
        // effects of the mouse fade for a while
        for _ in 0..60 {
            self.show(Vec::new());
            std::thread::sleep(Duration::from_millis(10));
        }
        let output = self.show(Vec::new());
        output.viewport_output.values().map(|v| v.repaint_delay).min().unwrap_or(Duration::MAX)
    }

    /// Drags the plate around in a circle, some 14 pixels a frame.
    fn dragged(&mut self, frames: u32) -> anyhow::Result<Vec<FrameTime>> {
        let by = |frame: u32| {
            let (sin, cos) = (0.1 * f64::from(frame)).sin_cos();
            [14.0 * cos, 14.0 * sin].map(|by| by.round() as f32)
        };
        self.show(vec![Event::PointerMoved(self.mouse)]);
        let press = self.button(true);
        self.show(vec![press]);
        let all = (0..frames + WARM).map(|frame| FrameTime::of(|| self.drag(by(frame))));
        let times = all.skip(WARM as usize).collect::<anyhow::Result<Vec<_>>>()?;
        let release = self.button(false);
        self.show(vec![release]);
        Ok(times)
    }

    fn button(&self, pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos: self.mouse, button, pressed, modifiers }
    }

    /// Drags the plate by so many pixels.
    fn drag(&mut self, by: [f32; 2]) -> anyhow::Result<FrameTime> {
        let start = Instant::now();
        self.mouse += vec2(by[0], by[1]);
        self.show(vec![Event::PointerMoved(self.mouse)]);
        let (asked, view) = (Instant::now(), self.viewer.viewports[0].camera.view);
        self.wait(|viewer| {
            let newest = viewer.viewports[0].frames.newest();
            newest.is_some_and(|frame| Some(frame.request.view) == view)
        })?;
        let there = Instant::now();
        let output = self.show(Vec::new());
        let uploading = self.uploading;
        let layout = ((asked - start) + there.elapsed()).as_secs_f64() - uploading;
        let [upload, paint] = self.draw(output)?;
        let image = (there - asked).as_secs_f64();
        Ok(FrameTime { layout, image, upload: upload + uploading, paint, core: 0.0 })
    }

    /// Shows the window once more, although nothing has changed: what egui's own drawing takes.
    fn again(&mut self) -> anyhow::Result<FrameTime> {
        let start = Instant::now();
        let output = self.show(Vec::new());
        let layout = start.elapsed().as_secs_f64();
        let [upload, paint] = self.draw(output)?;
        Ok(FrameTime { layout, upload, paint, ..FrameTime::default() })
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

    fn wait(&mut self, is_there: impl Fn(&Viewer) -> bool) -> anyhow::Result<()> {
        let start = Instant::now();
        loop {
            self.viewer.viewports[0].frames.poll();
            if is_there(&self.viewer) {
                return Ok(());
            }
            let left = PATIENCE
                .checked_sub(start.elapsed())
                .with_context(|| format!("no image after {} s", PATIENCE.as_secs()))?;
            // who asks to be shown once more before it was shown is not heard
            let _ = self.woken.recv_timeout(left.min(Duration::from_micros(500)));
        }
    }

    /// Draws an output and waits for it: seconds to hand it over, and to draw it.
    fn draw(&self, output: FullOutput) -> anyhow::Result<[f64; 2]> {
        let start = Instant::now();
        let handed = self.surface.hand_over(&self.ctx, output);
        let handing = start.elapsed().as_secs_f64();
        self.surface.draw(handed, wgpu::Color::BLACK);
        self.surface.wait().context("the graphics device fails")?;
        Ok([handing, start.elapsed().as_secs_f64() - handing])
    }
}
