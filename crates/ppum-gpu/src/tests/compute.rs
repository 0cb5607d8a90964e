//! Functions of shaders at rows of numbers: a compute shader around them, on the driver.

use wgpu::util::DeviceExt;
use wgpu::{BufferUsages, ComputePipelineDescriptor};

use crate::{Gpu, GpuError, frame::geometry, shader::texts};

/// Words of a work group.
const GROUP: u32 = 64;

/// The point functions with what they need, for slopes or without. The text of a test defines
/// `fn row(k: u32)`, which reads `input(k, i)` and writes `put(k, i, value)`, and perhaps `weight`.
pub(crate) fn point_functions(order: u32, cracks: u32) -> String {
    let texts: String = texts::POINT_FUNCTIONS.iter().map(|(_, text)| *text).collect();
    format!(
        "const ORDER = {order}u;\nconst HAS_KINKS = true;\nconst HAS_ARCS = true;\nalias Lanes = vec2<f32>;\nconst LANE_PAIRS = 1u;\n\
         struct View {{ cracks: u32 }}\nconst view = View({cracks}u);\n\
         fn load_view(at: u32) -> vec2<f32> {{ return pairs[at]; }}\n\
         fn load_lanes(at: u32) -> Lanes {{ return pairs[at]; }}\n{}{}{texts}",
        geometry::constants(),
        ppum::formula::wgsl_prelude(),
    )
}

/// The whole text for rows of some numbers.
pub(crate) fn around(text: &str, rows: usize, inputs: usize, outputs: usize) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> pairs: array<vec2<f32>>;
         @group(0) @binding(1) var<storage, read> rows_in: array<f32>;
         @group(0) @binding(2) var<storage, read_write> rows_out: array<f32>;
         fn input(k: u32, i: u32) -> f32 {{ return rows_in[k * {inputs}u + i]; }}
         fn put(k: u32, i: u32, value: f32) {{ rows_out[k * {outputs}u + i] = value; }}
         @compute @workgroup_size({GROUP}) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
             if id.x < {rows}u {{ row(id.x); }}
         }}
         {text}"
    )
}

/// The `outputs` numbers that `row` of a text writes for each row.
pub(crate) fn run<const N: usize>(
    gpu: &Gpu,
    text: &str,
    pairs: &[[f32; 2]],
    rows: &[[f32; N]],
    outputs: usize,
) -> Result<Vec<Vec<f32>>, GpuError> {
    let module = gpu.shader("row", &around(text, rows.len(), N, outputs))?;
    let pairs = if pairs.is_empty() { &[[0.0; 2]][..] } else { pairs };
    let bytes = |numbers: &[f32]| -> Vec<u8> {
        numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
    };
    let size = 4 * (rows.len() * outputs) as u64;
    gpu.checked("run the rows", || {
        let buffers = [
            storage(gpu, &bytes(pairs.as_flattened())),
            storage(gpu, &bytes(rows.as_flattened())),
            storage(gpu, &vec![0; size as usize]),
        ];
        dispatch(gpu, &module, &buffers, rows.len());
        read(gpu, &buffers[2], size)
    })
    .map(|numbers| numbers.chunks(outputs).map(<[f32]>::to_vec).collect())
}

fn storage(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    let descriptor = wgpu::util::BufferInitDescriptor { label: None, contents, usage };
    gpu.device().create_buffer_init(&descriptor)
}

fn dispatch(gpu: &Gpu, module: &wgpu::ShaderModule, buffers: &[wgpu::Buffer], rows: usize) {
    let device = gpu.device();
    let layout = layout(gpu);
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: &[Some(&layout)],
        ..Default::default()
    });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: None,
        layout: Some(&pipeline_layout),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    let group = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
    let group = device.create_bind_group(&group);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups((rows as u32).div_ceil(GROUP), 1, 1);
    drop(pass);
    gpu.queue().submit([encoder.finish()]);
}

/// Two buffers that are read, used or not, and one that is written.
fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding: u32| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: binding < 2 },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries = [0, 1, 2].map(entry);
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

fn read(gpu: &Gpu, from: &wgpu::Buffer, size: u64) -> Vec<f32> {
    let device = gpu.device();
    let copy = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(from, 0, &copy, 0, size);
    gpu.queue().submit([encoder.finish()]);
    copy.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("the buffer is read"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    let bytes = copy.slice(..).get_mapped_range().expect("mapped");
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
}
