//! The window without a display: shown until it is at rest, and kept as an image.

use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{RenderState, RendererOptions, wgpu};
use egui::{Context, FullOutput, RawInput, Rect, pos2, vec2};
use ppum_render::image::Image;

use crate::app::Viewer;
use crate::surface::{Surface, SurfaceError};
use crate::window::{NO_DRIVER, SIZE, WindowStart};

/// An image of the window that cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScreenshotError {
    /// Nothing to draw it with.
    #[error("{NO_DRIVER} ({0})")]
    NoDriver(String),
    /// A file that cannot be shown.
    #[error("{0}")]
    File(String),
    /// An image that cannot be drawn as it was chosen.
    #[error("{0}")]
    Picture(String),
    /// It does not come to rest.
    #[error("the window was not complete after {0} s")]
    Late(u64),
    /// The device has failed.
    #[error("the image of the window cannot be read back from the graphics device: {0}")]
    Device(String),
    /// More pixels than the device draws.
    #[error("the window has {0} × {1} pixels, and the graphics device draws at most {2} × {2}")]
    Size(u32, u32, u32),
}

/// The time after which nobody waits for a window any more.
const PATIENCE: Duration = Duration::from_secs(600);

/// The image of a window that begins so, once everything in it is drawn.
///
/// # Errors
/// Files that cannot be shown; no graphics driver, not even one that computes in software.
pub fn screenshot(start: WindowStart) -> Result<Image, ScreenshotError> {
    let size = start.size.unwrap_or(SIZE).map(|n| n.round().max(1.0));
    let pixels = size.map(|n| n as u32);
    let ctx = Context::default();
    let surface = surface(&ctx, pixels)?;
    ctx.options_mut(|options| options.max_passes = 2.try_into().expect("two is not zero"));
    let mut viewer = start.viewer(&ctx);
    viewer.files.leave_no_trace();
    let output = at_rest(&ctx, &mut viewer, size, &surface)?;
    let handed = surface.hand_over(&ctx, output);
    surface.draw(handed, ground(&ctx));
    let rgba = read_back(&surface, pixels)?;
    Ok(Image { size: pixels, rgba })
}

fn surface(ctx: &Context, [width, height]: [u32; 2]) -> Result<Surface, ScreenshotError> {
    let options = RendererOptions::PREDICTABLE;
    Surface::new(ctx, [width, height], options).map_err(|error| match error {
        SurfaceError::NoDriver(error) => ScreenshotError::NoDriver(error.to_string()),
        SurfaceError::Size(most) => ScreenshotError::Size(width, height, most),
    })
}

/// Shows the window until nothing changes any more; the last output.
fn at_rest(
    ctx: &Context,
    viewer: &mut Viewer,
    size: [f32; 2],
    surface: &Surface,
) -> Result<FullOutput, ScreenshotError> {
    let start = Instant::now();
    let mut rest = 0;
    loop {
        let time = Some(start.elapsed().as_secs_f64());
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(size[0], size[1])));
        let input = RawInput { screen_rect, time, ..RawInput::default() };
        let mut output = ctx.run_ui(input, |ui| viewer.show(ui));
        surface.send(&mut output.textures_delta);
        rest = if viewer.is_working() { 0 } else { rest + 1 };
        if let Some(note) = viewer.files.notes.iter().find(|note| note.is_error) {
            return Err(ScreenshotError::File(note.text.clone()));
        }
        if rest > SETTLED {
            let failure = viewer.viewports.iter().find_map(|viewport| viewport.frames.failure());
            return match failure {
                Some(failure) => Err(ScreenshotError::Picture(failure.message.clone())),
                None => Ok(output),
            };
        }
        if start.elapsed() > PATIENCE {
            return Err(ScreenshotError::Late(PATIENCE.as_secs()));
        }
        thread::sleep(Duration::from_millis(if rest == 0 { 5 } else { 20 }));
    }
}

/// Images of a window at rest after which no panel moves any more: they fold and fade for a
/// quarter of a second.
const SETTLED: u32 = 20;

/// The colour around the image, as the window has it.
fn ground(ctx: &Context) -> wgpu::Color {
    let color = crate::widgets::ground(&ctx.style_of(ctx.theme()).visuals);
    let [r, g, b, a] = color.to_normalized_gamma_f32().map(f64::from);
    wgpu::Color { r, g, b, a }
}

/// The pixels of a texture, opaque, row by row.
fn read_back(
    Surface { state: RenderState { device, queue, target_format, .. }, texture, .. }: &Surface,
    [width, height]: [u32; 2],
) -> Result<Vec<u8>, ScreenshotError> {
    let failed = |error: &dyn std::fmt::Display| ScreenshotError::Device(error.to_string());
    let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    let submission = queue.submit([encoder.finish()]);
    let (sender, receiver) = mpsc::channel();
    buffer.slice(..).map_async(wgpu::MapMode::Read, move |outcome| drop(sender.send(outcome)));
    let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: Some(PATIENCE) };
    device.poll(wait).map_err(|error| failed(&error))?;
    receiver.recv().map_err(|error| failed(&error))?.map_err(|error| failed(&error))?;
    let bytes = buffer.slice(..).get_mapped_range().map_err(|error| failed(&error))?;
    let is_swapped = matches!(
        target_format,
        wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb
    );
    let rows = bytes.chunks_exact(row as usize).flat_map(|r| &r[..4 * width as usize]);
    let mut rgba: Vec<u8> = rows.copied().collect();
    for pixel in rgba.as_chunks_mut::<4>().0 {
        if is_swapped {
            pixel.swap(0, 2);
        }
        pixel[3] = 255;
    }
    Ok(rgba)
}

#[cfg(test)]
mod tests {
    use egui::{Color32, Stroke, Window};
    use ppum_testkit::random::Random;
    use ppum_testkit::skipped::skipped;

    use super::*;
    use crate::viewport::pixels;

    const PIXELS: [u32; 2] = [420, 300];

    /// Widgets, a window above them, and shapes that overlap.
    fn widgets(ui: &mut egui::Ui, random: &mut Random) {
        ui.heading("Letters over grounds");
        let (mut is_on, mut value) = (true, 0.3);
        ui.horizontal(|ui| {
            let _ = ui.button("button");
            ui.checkbox(&mut is_on, "checked");
            let _ = ui.radio(true, "radio");
        });
        ui.add(egui::Slider::new(&mut value, 0.0..=1.0));
        ui.add(egui::ProgressBar::new(0.4).text("progress"));
        ui.collapsing("folded", |ui| ui.label("nothing"));
        Window::new("above").fixed_pos([150.0, 60.0]).show(ui.ctx(), |ui| ui.label("all of it"));
        for _ in 0..40 {
            let mut number = |most: f64| (most * random.unit()) as f32;
            let (at, to) = (pos2(number(420.0), number(300.0)), pos2(number(420.0), number(300.0)));
            let color = Color32::from_rgba_unmultiplied(200, 80, number(255.0) as u8, 120);
            let (size, stroke) = (number(30.0), Stroke::new(0.5 + number(3.0), color));
            ui.painter().circle(at, size, color, stroke);
            ui.painter().line_segment([at, to], stroke);
            let label = (egui::Align2::LEFT_TOP, egui::FontId::proportional(9.0 + 0.3 * size));
            ui.painter().text(to, label.0, "words", label.1, Color32::WHITE);
        }
    }

    /// The pixels of what our shader draws as far as it can, and of what egui draws alone.
    #[test]
    fn our_shader_draws_what_egui_would_draw() {
        let picture = |is_ours: bool| {
            let ctx = Context::default();
            let surface = surface(&ctx, PIXELS).ok()?;
            if !is_ours {
                pixels::use_none(&ctx);
            }
            let [width, height] = PIXELS.map(|n| n as f32);
            let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height)));
            let show = |time| {
                let input = RawInput { screen_rect, time: Some(time), ..RawInput::default() };
                let mut output = ctx.run_ui(input, |ui| widgets(ui, &mut Random(3)));
                surface.send(&mut output.textures_delta);
                output
            };
            (0..4).for_each(|k| drop(show(f64::from(k))));
            let handed = surface.hand_over(&ctx, show(9.0));
            surface.draw(handed, ground(&ctx));
            Some(read_back(&surface, PIXELS).expect("it can be read"))
        };
        let (Some(ours), Some(theirs)) = (picture(true), picture(false)) else {
            return skipped("there is no graphics driver");
        };
        let (least, most) = (ours.iter().min(), ours.iter().max());
        assert!(most > least, "nothing is drawn");
        // egui's circles come from a texture, and their rims are softer
        let differences = || ours.iter().zip(&theirs).map(|(a, b)| a.abs_diff(*b));
        let off = differences().filter(|by| *by > 2).count();
        assert!(off < ours.len() / 500, "{off} of {} differ", ours.len());
        assert!(differences().max() < Some(40), "{:?}", differences().max());
    }
}
