//! The window without a display: shown until it is at rest, and kept as a picture.

use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{self, RenderState, RendererOptions, ScreenDescriptor, WgpuSetup, wgpu};
use egui::{Context, FullOutput, RawInput, Rect, TexturesDelta, pos2, vec2};
use pollster::block_on;
use ppum_render::image::Image;

use crate::app::Viewer;
use crate::window::{NO_DRIVER, SIZE, Start};

/// A picture of the window that cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScreenshotError {
    /// Nothing to draw it with.
    #[error("{NO_DRIVER} ({0})")]
    NoDriver(String),
    /// A file that cannot be shown.
    #[error("{0}")]
    File(String),
    /// It does not come to rest.
    #[error("the window was not complete after {0} s")]
    Late(u64),
    /// The device has failed.
    #[error("the picture of the window cannot be read back from the graphics device: {0}")]
    Device(String),
    /// More pixels than the device draws.
    #[error("the window has {0} × {1} pixels, and the graphics device draws at most {2} × {2}")]
    Size(u32, u32, u32),
}

/// The time after which nobody waits for a window any more.
const PATIENCE: Duration = Duration::from_secs(600);

/// The picture of a window that begins so, once everything in it is drawn.
///
/// # Errors
/// Files that cannot be shown; no graphics driver, not even one that computes in software.
pub fn screenshot(start: Start) -> Result<Image, ScreenshotError> {
    let size = start.size.unwrap_or(SIZE).map(|n| n.round().max(1.0));
    let pixels = size.map(|n| n as u32);
    let state = device()?;
    let most = state.device.limits().max_texture_dimension_2d;
    if pixels.iter().any(|n| *n > most) {
        return Err(ScreenshotError::Size(pixels[0], pixels[1], most));
    }
    let ctx = Context::default();
    ctx.options_mut(|options| options.max_passes = 2.try_into().expect("two is not zero"));
    let mut viewer = start.viewer(&ctx);
    viewer.files.leave_no_trace();
    let output = at_rest(&ctx, &mut viewer, size, &state)?;
    drawn(&ctx, output, pixels, &state)
}

/// A device, a graphics card or software.
fn device() -> Result<RenderState, ScreenshotError> {
    let setup = WgpuSetup::without_display_handle();
    let instance = block_on(setup.new_instance());
    let configuration = egui_wgpu::WgpuConfiguration { wgpu_setup: setup, ..Default::default() };
    let options = RendererOptions::PREDICTABLE;
    block_on(RenderState::create(&configuration, &instance, None, options))
        .map_err(|error| ScreenshotError::NoDriver(error.to_string()))
}

/// Shows the window until nothing changes any more; the last output.
fn at_rest(
    ctx: &Context,
    viewer: &mut Viewer,
    size: [f32; 2],
    state: &RenderState,
) -> Result<FullOutput, ScreenshotError> {
    let start = Instant::now();
    let mut rest = 0;
    loop {
        let time = Some(start.elapsed().as_secs_f64());
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(size[0], size[1])));
        let input = RawInput { screen_rect, time, ..RawInput::default() };
        let mut output = ctx.run_ui(input, |ui| viewer.show(ui));
        upload(&mut output.textures_delta, state);
        rest = if viewer.is_working() { 0 } else { rest + 1 };
        if let Some(note) = viewer.files.notes.iter().find(|note| note.is_error) {
            return Err(ScreenshotError::File(note.text.clone()));
        }
        if rest > SETTLED {
            return Ok(output);
        }
        if start.elapsed() > PATIENCE {
            return Err(ScreenshotError::Late(PATIENCE.as_secs()));
        }
        thread::sleep(Duration::from_millis(if rest == 0 { 5 } else { 20 }));
    }
}

/// Pictures of a window at rest after which no panel moves any more: they fold and fade for a quarter of a second.
const SETTLED: u32 = 20;

fn upload(delta: &mut TexturesDelta, RenderState { device, queue, renderer, .. }: &RenderState) {
    let mut renderer = renderer.write();
    let mut set: Vec<_> = delta.set.drain().collect();
    set.sort_by_key(|(id, _)| format!("{id:?}"));
    for (id, images) in set {
        for image in images {
            renderer.update_texture(device, queue, id, &image);
        }
    }
    let mut free: Vec<_> = delta.free.drain().collect();
    free.sort_by_key(|id| format!("{id:?}"));
    free.iter().for_each(|id| renderer.free_texture(id));
}

/// The colour around the plate, as the window has it.
fn ground(ctx: &Context) -> wgpu::Color {
    let color = ctx.style_of(ctx.theme()).visuals.extreme_bg_color;
    let [r, g, b, a] = color.to_normalized_gamma_f32().map(f64::from);
    wgpu::Color { r, g, b, a }
}

/// Draws an output on a texture, and reads it back.
fn drawn(
    ctx: &Context,
    output: FullOutput,
    pixels: [u32; 2],
    state: &RenderState,
) -> Result<Image, ScreenshotError> {
    let RenderState { device, queue, target_format, .. } = state;
    let shapes = ctx.tessellate(output.shapes, output.pixels_per_point);
    let screen =
        ScreenDescriptor { size_in_pixels: pixels, pixels_per_point: output.pixels_per_point };
    let texture = texture(device, pixels, *target_format);
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut renderer = state.renderer.write();
    let buffers = renderer.update_buffers(device, queue, &mut encoder, &shapes, &screen);
    {
        let ops = wgpu::Operations {
            load: wgpu::LoadOp::Clear(ground(ctx)),
            store: wgpu::StoreOp::Store,
        };
        let target = wgpu::RenderPassColorAttachment {
            view: &view,
            resolve_target: None,
            ops,
            depth_slice: None,
        };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(target)],
            ..Default::default()
        });
        renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
    }
    queue.submit(buffers.into_iter().chain([encoder.finish()]));
    let rgba = read_back(state, &texture, pixels)?;
    Ok(Image { size: pixels, rgba })
}

fn texture(
    device: &wgpu::Device,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// The pixels of a texture, opaque, row by row.
fn read_back(
    RenderState { device, queue, target_format, .. }: &RenderState,
    texture: &wgpu::Texture,
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
