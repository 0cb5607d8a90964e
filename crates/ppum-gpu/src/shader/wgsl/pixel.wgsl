// Pixels and where they are.

struct Pixel {
    // Column and row, from the upper left.
    index: vec2<u32>,
    // Its centre relative to the region's anchor, as the sum of two.
    high: vec2<f32>,
    low: vec2<f32>,
    // Its centre relative to the view's.
    offset: vec2<f32>,
    // The group of functions that all terms beside the smooth ones are of, where there is but one.
    group: u32,
}

fn pixel_at(index: vec2<u32>) -> Pixel {
    let steps = vec2<f32>(index);
    // of highs every step is exact
    let high = view.first_high + steps * view.step_high;
    let low = view.first_low + steps * view.step_low;
    let twice = 2.0 * steps + 1.0 - vec2<f32>(view.pixels);
    let offset = vec2<f32>(0.5, -0.5) * twice * view.pixel_size;
    return Pixel(index, high, low, offset, 0u);
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

// A point of the triangle that covers the picture; it is drawn once for each area, as the instance
// that has the number of the area's group.
struct Covered {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) group: u32,
}

@vertex
fn cover(@builtin(vertex_index) vertex: u32, @builtin(instance_index) group: u32) -> Covered {
    let corner = vec2<f32>(f32((vertex << 1u) & 2u), f32(vertex & 2u));
    return Covered(vec4<f32>(2.0 * corner - 1.0, 0.0, 1.0), group);
}

fn pixel_of(at: Covered) -> Pixel {
    var pixel = pixel_at(vec2<u32>(at.position.xy));
    pixel.group = at.group;
    return pixel;
}
