//! Pipelines and the layouts of their bindings.

use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BlendComponent,
    BlendFactor, BlendState, BufferBindingType, ColorTargetState, ColorWrites, RenderPipeline,
    ShaderStages, TextureSampleType, TextureViewDimension, VertexAttribute, VertexBufferLayout,
    VertexFormat, VertexStepMode,
};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::frame::quads::{QUAD_BYTES, QuadRecord};
use crate::shader::passes::{Finish, SUMS};

/// The layout of group 0: the view, its data, the data of the dataset and those of the region.
pub(crate) fn data_layout(gpu: &Gpu) -> BindGroupLayout {
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = texture_type(TextureSampleType::Uint);
    let types = [
        buffer(BufferBindingType::Uniform),
        buffer(BufferBindingType::Storage { read_only: true }),
        texture,
        texture,
    ];
    let entries: Vec<_> = (0..).zip(types).map(|(binding, ty)| layout_entry(binding, ty)).collect();
    let descriptor = BindGroupLayoutDescriptor { label: Some("data"), entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

fn texture_type(sample_type: TextureSampleType) -> BindingType {
    let view_dimension = TextureViewDimension::D2;
    BindingType::Texture { sample_type, view_dimension, multisampled: false }
}

/// A binding for fragment shaders; the view, which is the uniform, also for vertex shaders.
fn layout_entry(binding: u32, ty: BindingType) -> BindGroupLayoutEntry {
    let is_uniform = matches!(ty, BindingType::Buffer { ty: BufferBindingType::Uniform, .. });
    let both = ShaderStages::VERTEX_FRAGMENT;
    let visibility = if is_uniform { both } else { ShaderStages::FRAGMENT };
    BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// The layout of a group of `count` textures.
pub(crate) fn textures_layout(gpu: &Gpu, count: u32) -> BindGroupLayout {
    let ty = texture_type(TextureSampleType::Float { filterable: false });
    let entries: Vec<_> = (0..count).map(|binding| layout_entry(binding, ty)).collect();
    let descriptor = BindGroupLayoutDescriptor { label: Some("textures"), entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

/// Makes the pipelines of a program.
#[derive(Clone, Copy)]
pub(crate) struct PipelineBuilder<'a> {
    pub(crate) gpu: &'a Gpu,
    /// The layout of group 0.
    pub(crate) data: &'a BindGroupLayout,
}

impl PipelineBuilder<'_> {
    /// The pass that makes the output; `textures` is the layout of group 1.
    pub(crate) fn finish(
        self,
        finish: &Finish,
        text: &str,
        textures: &BindGroupLayout,
    ) -> Result<RenderPipeline, GpuError> {
        let target = Some(finish.format.into());
        self.pipeline(text, ["cover", finish.entry], &[], &[target], Some(textures))
    }

    /// A pass that draws quads and adds up what they write.
    pub(crate) fn quads(
        self,
        fragment: &str,
        text: &str,
        targets: u32,
        textures: Option<&BindGroupLayout>,
    ) -> Result<RenderPipeline, GpuError> {
        let add = BlendComponent { dst_factor: BlendFactor::One, ..BlendComponent::REPLACE };
        let blend = Some(BlendState { color: add, alpha: add });
        let target = ColorTargetState { format: SUMS, blend, write_mask: ColorWrites::ALL };
        let targets = vec![Some(target); targets as usize];
        let attributes = attributes();
        let quads = [Some(VertexBufferLayout {
            array_stride: QUAD_BYTES,
            step_mode: VertexStepMode::Instance,
            attributes: &attributes,
        })];
        self.pipeline(text, ["draw_quad", fragment], &quads, &targets, textures)
    }

    /// A pipeline of two functions of a text: it draws the instances of a buffer, or without one a
    /// triangle that covers the image.
    fn pipeline(
        self,
        text: &str,
        [vertex, fragment]: [&str; 2],
        buffers: &[Option<VertexBufferLayout<'_>>],
        targets: &[Option<ColorTargetState>],
        textures: Option<&BindGroupLayout>,
    ) -> Result<RenderPipeline, GpuError> {
        let module = self.gpu.shader("compile the shader", text)?;
        let device = self.gpu.device();
        let groups = [Some(self.data), textures];
        let topology = match buffers {
            [] => wgpu::PrimitiveTopology::TriangleList,
            _ => wgpu::PrimitiveTopology::TriangleStrip,
        };
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &[],
            zero_initialize_workgroup_memory: false,
        };
        self.gpu.checked("make the pipeline", || {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(fragment),
                bind_group_layouts: &groups,
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(fragment),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: compilation_options.clone(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState { topology, ..Default::default() },
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options,
                    targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        })
    }
}

/// The fields of a quad's record.
fn attributes() -> Vec<VertexAttribute> {
    let mut offset = 0;
    let attribute = |(location, (_, kind)): (u32, &(&str, &str))| {
        let format = match *kind {
            "vec2<f32>" => VertexFormat::Float32x2,
            "vec2<u32>" => VertexFormat::Uint32x2,
            _ => VertexFormat::Uint32,
        };
        let at = offset;
        offset += format.size();
        VertexAttribute { format, offset: at, shader_location: location }
    };
    (0..).zip(QuadRecord::MEMBERS).map(attribute).collect()
}
