//! Everything that has no letters and no pixels, drawn by a shader of our own: that of egui looks
//! up a texture for every pixel, which takes a software driver a hundred
//! nanoseconds (docs/decisions/0012-frames-of-the-window.md).

use std::ops::Range;
use std::sync::Arc;

use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use egui::emath::TSTransform;
use egui::epaint::{ClippedShape, Mesh, Tessellator, TextureId, WHITE_UV};
use egui::{Context, FullOutput, PaintCallbackInfo, Plugin, Rect, Shape};

use super::pipeline::{format as format_of, pipeline};

/// Sees to it, at the end of each frame.
pub(super) struct Solids;

impl Plugin for Solids {
    fn debug_name(&self) -> &'static str {
        "solids"
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let Some(format) = format_of(ctx) else { return };
        let options = ctx.tessellation_options_mut(|options| *options);
        let tessellator = Tessellator::new(output.pixels_per_point, options, [1, 1], Vec::new());
        let layers = layers(std::mem::take(&mut output.shapes));
        output.shapes = drawn(layers, tessellator, format);
    }
}

/// The parts that are drawn at once.
#[derive(Debug)]
enum Layer {
    /// Shapes of plain colours that are cut off at one rectangle.
    Solid(Rect, Vec<Shape>),
    Other(ClippedShape),
}

/// Shapes as few layers: a solid one is drawn together with one of before, unless it covers
/// something in between.
fn layers(shapes: Vec<ClippedShape>) -> Vec<Layer> {
    let mut found = SolidLayers::default();
    for ClippedShape { clip_rect, shape, transform_after_tessellation } in shapes {
        let is_moved = transform_after_tessellation != TSTransform::IDENTITY;
        if is_moved {
            found.put(clip_rect, shape, Some(transform_after_tessellation));
        } else {
            found.put_each(clip_rect, shape);
        }
    }
    found.layers
}

#[derive(Default)]
struct SolidLayers {
    layers: Vec<Layer>,
    /// Where each of them draws.
    bounds: Vec<Rect>,
}

impl SolidLayers {
    fn put_each(&mut self, clip: Rect, shape: Shape) {
        match shape {
            Shape::Noop => {}
            Shape::Vec(shapes) => shapes.into_iter().for_each(|shape| self.put_each(clip, shape)),
            shape => self.put(clip, shape, None),
        }
    }

    fn put(&mut self, clip: Rect, shape: Shape, moved: Option<TSTransform>) {
        let bounds = if moved.is_none() { reach(&shape).intersect(clip) } else { clip };
        if moved.is_none() && is_solid(&shape) {
            self.put_solid(clip, shape, bounds);
        } else {
            let transform_after_tessellation = moved.unwrap_or_default();
            let other = ClippedShape { clip_rect: clip, shape, transform_after_tessellation };
            self.layers.push(Layer::Other(other));
            self.bounds.push(bounds);
        }
    }

    fn put_solid(&mut self, clip: Rect, shape: Shape, bounds: Rect) {
        for (layer, theirs) in self.layers.iter_mut().zip(&mut self.bounds).rev() {
            match layer {
                Layer::Solid(other, shapes) if *other == clip => {
                    shapes.push(shape);
                    *theirs = theirs.union(bounds);
                    return;
                }
                _ if theirs.intersects(bounds) => break,
                _ => {}
            }
        }
        self.layers.push(Layer::Solid(clip, vec![shape]));
        self.bounds.push(bounds);
    }
}

/// Where a shape draws, its smooth rims included.
fn reach(shape: &Shape) -> Rect {
    shape.visual_bounding_rect().expand(2.0)
}

/// True for shapes that have no texture.
fn is_solid(shape: &Shape) -> bool {
    match shape {
        Shape::Noop | Shape::Text(_) | Shape::Callback(_) | Shape::Vec(_) => false,
        Shape::Rect(rect) => rect.brush.is_none(),
        Shape::Mesh(mesh) => {
            mesh.texture_id == TextureId::default()
                && mesh.vertices.iter().all(|v| v.uv == WHITE_UV)
        }
        _ => true,
    }
}

/// The layers as egui is to draw them: solid ones by our shader, all from one mesh.
fn drawn(
    layers: Vec<Layer>,
    mut tessellator: Tessellator,
    format: wgpu::TextureFormat,
) -> Vec<ClippedShape> {
    let (mut mesh, mut parts) = (Mesh::default(), Vec::new());
    for layer in &mut layers.into_iter() {
        parts.push(match layer {
            Layer::Solid(clip, shapes) => {
                let start = mesh.indices.len();
                tessellator.set_clip_rect(clip);
                shapes.into_iter().for_each(|shape| tessellator.tessellate_shape(shape, &mut mesh));
                Err((clip, start as u32..mesh.indices.len() as u32))
            }
            Layer::Other(other) => Ok(other),
        });
    }
    let mesh = Arc::new(mesh);
    let part = |(clip, range)| {
        let part = MeshRange { mesh: Arc::clone(&mesh), range, format };
        let shape = Shape::Callback(Callback::new_paint_callback(clip, part));
        let transform_after_tessellation = TSTransform::IDENTITY;
        ClippedShape { clip_rect: clip, shape, transform_after_tessellation }
    };
    parts.into_iter().map(|other| other.unwrap_or_else(part)).collect()
}

/// Triangles of the frame's mesh.
struct MeshRange {
    mesh: Arc<Mesh>,
    range: Range<u32>,
    format: wgpu::TextureFormat,
}

/// Pipeline and mesh of a frame on the device.
struct MeshResources {
    pipeline: wgpu::RenderPipeline,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    mesh: Arc<Mesh>,
}

impl CallbackTrait for MeshRange {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        screen: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let kept = resources
            .entry::<MeshResources>()
            .or_insert_with(|| MeshResources::new(device, self.format));
        if !Arc::ptr_eq(&kept.mesh, &self.mesh) {
            kept.send(device, queue, &self.mesh, screen);
        }
        Vec::new()
    }

    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(kept) = resources.get::<MeshResources>() else { return };
        let [width, height] = info.screen_size_px.map(|n| n as f32);
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        pass.set_pipeline(&kept.pipeline);
        pass.set_vertex_buffer(0, kept.vertices.slice(..));
        pass.set_index_buffer(kept.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(self.range.clone(), 0, 0..1);
    }
}

/// Bytes of a vertex: two floats and a colour.
const VERTEX: u64 = 12;

impl MeshResources {
    fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("solids"),
            source: wgpu::ShaderSource::Wgsl(include_str!("solids.wgsl").into()),
        });
        let vertex = wgpu::VertexBufferLayout {
            array_stride: VERTEX,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Unorm8x4],
        };
        let kind = (format, wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let pipeline = pipeline(device, &shader, ["corner", "plain"], kind, Some(vertex));
        let [vertices, indices] = [wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX]
            .map(|usage| buffer(device, usage, 1 << 16));
        Self { pipeline, vertices, indices, mesh: Arc::default() }
    }

    /// Sends the mesh of a frame.
    fn send(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        mesh: &Arc<Mesh>,
        screen: &ScreenDescriptor,
    ) {
        let [vertices, indices] = bytes(mesh, screen);
        for (kept, bytes) in [(&mut self.vertices, vertices), (&mut self.indices, indices)] {
            if kept.size() < bytes.len() as u64 {
                *kept = buffer(device, kept.usage(), bytes.len().next_power_of_two() as u64);
            }
            queue.write_buffer(kept, 0, &bytes);
        }
        self.mesh = Arc::clone(mesh);
    }
}

fn buffer(device: &wgpu::Device, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("solids"),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Vertices and indices as the shader reads them.
fn bytes(mesh: &Mesh, screen: &ScreenDescriptor) -> [Vec<u8>; 2] {
    let [width, height] = screen.size_in_pixels.map(|n| n as f32 / screen.pixels_per_point);
    let mut vertices = Vec::with_capacity(VERTEX as usize * mesh.vertices.len());
    for vertex in &mesh.vertices {
        let (x, y) = (2.0 * vertex.pos.x / width - 1.0, 1.0 - 2.0 * vertex.pos.y / height);
        vertices.extend(x.to_le_bytes());
        vertices.extend(y.to_le_bytes());
        vertices.extend(vertex.color.to_array());
    }
    [vertices, mesh.indices.iter().flat_map(|index| index.to_le_bytes()).collect()]
}

#[cfg(test)]
mod tests {
    use egui::{Color32, pos2, vec2};
    use ppum_testkit::random::Random;

    use super::*;

    /// Rectangles and circles of plain colours and, in between, squares with textures.
    fn shapes(random: &mut Random, count: usize) -> Vec<ClippedShape> {
        let clips = [Rect::EVERYTHING, Rect::from_min_size(pos2(0.0, 0.0), vec2(50.0, 100.0))];
        let mut shape = || {
            let mut number = |most: f64| (most * random.unit()) as f32;
            let rect = Rect::from_min_size(
                pos2(number(100.0), number(100.0)),
                vec2(number(20.0), number(20.0)),
            );
            let shape = match random.below(3) {
                0 => Shape::image(TextureId::User(1), rect, rect, Color32::WHITE),
                1 => Shape::circle_filled(rect.center(), 0.5 * rect.width(), Color32::RED),
                _ => Shape::rect_filled(rect, 0.0, Color32::BLUE),
            };
            ClippedShape {
                clip_rect: clips[random.below(2)],
                shape,
                transform_after_tessellation: TSTransform::IDENTITY,
            }
        };
        (0..count).map(|_| shape()).collect()
    }

    /// All shapes with their rectangles, one after the other.
    fn flat(layers: &[Layer]) -> Vec<(Rect, Shape)> {
        let each = |layer: &Layer| match layer {
            Layer::Solid(clip, shapes) => shapes.iter().map(|s| (*clip, s.clone())).collect(),
            Layer::Other(other) => vec![(other.clip_rect, other.shape.clone())],
        };
        layers.iter().flat_map(each).collect()
    }

    #[test]
    fn whatever_overlaps_is_drawn_in_its_order() {
        for seed in 0..40 {
            let all = shapes(&mut Random(seed), 120);
            let before: Vec<_> = all.iter().map(|s| (s.clip_rect, s.shape.clone())).collect();
            let layers = layers(all);
            let after = flat(&layers);
            assert_eq!(before.len(), after.len());
            let place = |one: &(Rect, Shape)| after.iter().position(|other| other == one);
            let places: Vec<_> = before.iter().map(|one| place(one).expect("it is kept")).collect();
            for (k, (clip, shape)) in before.iter().enumerate() {
                for (l, (other_clip, other)) in before.iter().enumerate().skip(k + 1) {
                    let [a, b] = [(clip, shape), (other_clip, other)]
                        .map(|(clip, shape)| shape.visual_bounding_rect().intersect(*clip));
                    assert!(!a.intersects(b) || places[k] < places[l], "seed {seed}: {k}, {l}");
                }
            }
            assert!(layers.len() < 110, "{}", layers.len());
        }
    }

    #[test]
    fn widgets_beside_each_other_are_drawn_at_once() {
        let row = |k: u32| {
            let rect = Rect::from_min_size(pos2(0.0, 30.0 * k as f32), vec2(80.0, 20.0));
            let letters = Shape::image(TextureId::default(), rect, rect, Color32::WHITE);
            [Shape::rect_filled(rect, 3.0, Color32::GRAY), letters].map(|shape| ClippedShape {
                clip_rect: Rect::EVERYTHING,
                shape,
                transform_after_tessellation: TSTransform::IDENTITY,
            })
        };
        let found = layers((0..20).flat_map(row).collect());
        assert_eq!(found.len(), 21, "the grounds, and twenty words");
        assert!(matches!(&found[0], Layer::Solid(_, shapes) if shapes.len() == 20));
    }
}
