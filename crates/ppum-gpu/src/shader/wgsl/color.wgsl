// The 1D transfer function: values to colours, as Picture does it.

// Position of a value on the scale, 0 and 1 at the ends of the range.
fn scaled_value(value: f32) -> f32 {
    if view.scale == LOG {
        return log(value);
    }
    if view.scale == SYMLOG {
        return sign(value) * log(1.0 + abs(value) / view.threshold);
    }
    return value;
}

// All values read the palette once, so that processors that take every branch do so, too.
fn color_of(value: f32) -> vec4<f32> {
    let position = (scaled_value(value) - view.scale_start) * view.per_span;
    var entry = u32(clamp(position, 0.0, 1.0) * f32(PALETTE - 1u) + 0.5);
    entry = select(entry, PALETTE, value < view.range_min);
    entry = select(entry, PALETTE + 1u, value > view.range_max);
    let is_number = (bitcast<u32>(value) & 0x7fffffffu) <= 0x7f800000u;
    return textureLoad(palette, vec2<u32>(select(PALETTE + 2u, entry, is_number), 0u), 0);
}

@fragment
fn draw_color(covered: Covered) -> @location(0) vec4<f32> {
    let pixel = pixel_of(covered);
    return color_of(value_of(sample_of(pixel), pixel));
}
