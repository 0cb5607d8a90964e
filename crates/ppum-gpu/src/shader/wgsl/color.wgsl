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

fn color_of(value: f32) -> vec4<f32> {
    if (bitcast<u32>(value) & 0x7fffffffu) > 0x7f800000u {
        return textureLoad(palette, vec2<u32>(PALETTE + 2u, 0u), 0);
    }
    if value < view.range_min {
        return textureLoad(palette, vec2<u32>(PALETTE, 0u), 0);
    }
    if value > view.range_max {
        return textureLoad(palette, vec2<u32>(PALETTE + 1u, 0u), 0);
    }
    let position = (scaled_value(value) - view.scale_start) * view.per_span;
    let entry = clamp(position, 0.0, 1.0) * f32(PALETTE - 1u) + 0.5;
    return textureLoad(palette, vec2<u32>(u32(entry), 0u), 0);
}

@fragment
fn draw_color(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = pixel_at(vec2<u32>(position.xy));
    return color_of(value_of(sample_of(pixel), pixel));
}
