// Finding the patches of a pixel on a uniform cover, see lattice.rs: in place of bins.wgsl.

// The bin of a pixel, between four centres.
struct Bin {
    // The bodies of the patches at its corners, by x + 2 y.
    bodies: vec4<u32>,
    // From its lower left corner to the pixel.
    d: vec2<f32>,
}

fn bin_of(pixel: Pixel) -> Bin {
    let high = pixel.high - view.grid_high;
    let low = pixel.low - view.grid_low;
    let last = vec2<f32>(view.grid_size - 1u);
    let index = clamp(floor((high + low) * view.per_pitch), vec2<f32>(0.0), last);
    // of highs every step is exact
    let d = (high - index * view.pitch_high) + (low - index * view.pitch_low);
    let column_row = vec2<u32>(index);
    return Bin(load_place(column_row.y * view.grid_size.x + column_row.x), d);
}

fn four_of(bin: Bin) -> Four {
    let lower = bin.d * view.per_half;
    let upper = ((bin.d - view.pitch_high) - view.pitch_low) * view.per_half;
    let x = vec4<f32>(lower.x, upper.x, lower.x, upper.x);
    let y = vec4<f32>(lower.yy, upper.yy);
    let places = Places(x, y, vec4<f32>(view.per_half.x), vec4<f32>(view.per_half.y));
    return Four(bin.bodies, places, places);
}

fn is_last(bin: Bin) -> bool {
    return true;
}

fn next_of(bin: Bin) -> Bin {
    return bin;
}
