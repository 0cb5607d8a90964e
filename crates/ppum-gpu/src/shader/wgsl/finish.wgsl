// From what is known at a pixel to what is written.

// NaN outside the domain and where no patch is.
fn value_of(at: Sample, pixel: Pixel) -> f32 {
    if at.overlap == 0.0 || !is_inside(pixel) {
        return ppum_from_bits(0x7fc00000u);
    }
    return quantity(at);
}

@fragment
fn draw_value(covered: Covered) -> @location(0) f32 {
    let pixel = pixel_of(covered);
    return value_of(sample_of(pixel), pixel);
}
