// One component of the field's vector with its derivatives, as numbers.

struct Numbers {
    // v, x, y, xx
    @location(0) first: vec4<f32>,
    // xy, yy
    @location(1) second: vec4<f32>,
}

@fragment
fn draw_component(covered: Covered) -> Numbers {
    let pixel = pixel_of(covered);
    let at = sample_of(pixel);
    if at.overlap == 0.0 || !is_inside(pixel) {
        let none = vec4<f32>(ppum_from_bits(0x7fc00000u));
        return Numbers(none, none);
    }
    let u = at.u[view.component / LANES];
    let k = view.component % LANES;
    return Numbers(
        vec4<f32>(u.v[k], u.x[k], u.y[k], u.xx[k]),
        vec4<f32>(u.xy[k], u.yy[k], 0.0, 0.0),
    );
}
