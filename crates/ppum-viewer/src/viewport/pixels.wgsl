// A picture in a rectangle: its pixels as they are, or smoothed.

// left, top, right, bottom
@group(0) @binding(0) var<uniform> corners: vec4<f32>;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var smoothing: sampler;

struct Corner {
    @builtin(position) position: vec4<f32>,
    // in parts of the picture: only the second stage asks for its size, as wgpu derives no layout
    // for a texture of both stages that one of them samples
    @location(0) part: vec2<f32>,
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    let part = vec2<f32>(f32(index & 1u), f32(index >> 1u));
    let position = mix(corners.xy, corners.zw, part);
    return Corner(vec4<f32>(position, 0.0, 1.0), part);
}

// opacity is multiplied in on the screen, and not in the picture
fn shown(color: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(color.rgb * color.a, color.a);
}

@fragment
fn exact(in: Corner) -> @location(0) vec4<f32> {
    let pixel = in.part * vec2<f32>(textureDimensions(picture));
    return shown(textureLoad(picture, vec2<i32>(pixel), 0));
}

@fragment
fn smoothed(in: Corner) -> @location(0) vec4<f32> {
    return shown(textureSampleLevel(picture, smoothing, in.part, 0.0));
}
