// Pixels and where they are.

struct Pixel {
    // Column and row, from the upper left.
    index: vec2<u32>,
    // Its centre relative to the region's anchor, as the sum of two.
    high: vec2<f32>,
    low: vec2<f32>,
    // Its centre relative to the view's.
    offset: vec2<f32>,
}

fn pixel_at(index: vec2<u32>) -> Pixel {
    let steps = vec2<f32>(index);
    // of highs every step is exact
    let high = view.first_high + steps * view.step_high;
    let low = view.first_low + steps * view.step_low;
    let twice = 2.0 * steps + 1.0 - vec2<f32>(view.pixels);
    let offset = vec2<f32>(0.5, -0.5) * twice * view.pixel_size;
    return Pixel(index, high, low, offset);
}

// True for pixels of the domain.
fn is_inside(pixel: Pixel) -> bool {
    let after = all(pixel.index >= view.inside_first);
    let before = all(pixel.index < view.inside_end);
    if !HAS_HOLES {
        return after && before;
    }
    return after && before && !holes_contain(view.holes, view.n_holes, pixel.offset);
}

// One triangle that covers the picture.
@vertex
fn cover(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32((vertex << 1u) & 2u), f32(vertex & 2u));
    return vec4<f32>(2.0 * corner - 1.0, 0.0, 1.0);
}
