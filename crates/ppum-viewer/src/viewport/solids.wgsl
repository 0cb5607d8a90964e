// Triangles of plain colours: positions from −1 to 1 across the window, colours as they are to
// appear, premultiplied.

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec4<f32>,
}

@vertex
fn corner(@location(0) position: vec2<f32>, @location(1) color: vec4<f32>) -> Corner {
    return Corner(vec4<f32>(position, 0.0, 1.0), color);
}

@fragment
fn plain(@location(0) color: vec4<f32>) -> @location(0) vec4<f32> {
    return color;
}
