// A rectangle of one colour, which is the blend constant.

@vertex
fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let part = vec2<f32>(f32(index & 1u), f32(index >> 1u));
    return vec4<f32>(2.0 * part - 1.0, 0.0, 1.0);
}

@fragment
fn plain() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}
