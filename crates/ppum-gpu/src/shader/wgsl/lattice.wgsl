// Finding the patches of a pixel on a uniform cover, see lattice.rs: in place of bins.wgsl.

// The bin of a pixel, between four centres.
struct Bin {
    count: u32,
    // The bodies of the patches at its corners, by x + 2 y.
    bodies: vec4<u32>,
    // From its lower left corner to the pixel.
    d: vec2<f32>,
}

struct Candidate {
    body: u32,
    support: Coordinates,
}

fn bin_of(pixel: Pixel) -> Bin {
    let high = pixel.high - view.grid_high;
    let low = pixel.low - view.grid_low;
    let last = vec2<f32>(view.grid_size - 1u);
    let index = clamp(floor((high + low) * view.per_pitch), vec2<f32>(0.0), last);
    // of highs every step is exact
    let d = (high - index * view.pitch_high) + (low - index * view.pitch_low);
    let column_row = vec2<u32>(index);
    return Bin(4u, load_place(column_row.y * view.grid_size.x + column_row.x), d);
}

fn candidate_of(bin: Bin, k: u32, pixel: Pixel) -> Candidate {
    let right = (k & 1u) == 1u;
    let upper = k >= 2u;
    let lower = select(bin.bodies.x, bin.bodies.y, right);
    let body = select(lower, select(bin.bodies.z, bin.bodies.w, right), upper);
    let corner = select(vec2<f32>(0.0), view.pitch_high, vec2<bool>(right, upper));
    let rest = select(vec2<f32>(0.0), view.pitch_low, vec2<bool>(right, upper));
    return Candidate(body, Coordinates(((bin.d - corner) - rest) * view.per_half, view.per_half));
}

// Where the polynomials of a candidate are taken.
fn polynomial_coordinates(candidate: Candidate, pixel: Pixel) -> Coordinates {
    return candidate.support;
}

// Which of the four cover a pixel, a bit each.
fn covering_of(bin: Bin, first: u32, pixel: Pixel) -> u32 {
    let lower = bin.d * view.per_half < vec2<f32>(1.0);
    let upper = ((bin.d - view.pitch_high) - view.pitch_low) * view.per_half >= vec2<f32>(-1.0);
    let x = select(0u, 5u, lower.x) | select(0u, 10u, upper.x);
    let y = select(0u, 3u, lower.y) | select(0u, 12u, upper.y);
    let there = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), bin.bodies != vec4<u32>(NO_PATCH));
    return x & y & (there.x | there.y | there.z | there.w);
}

// The first candidate of a set that is not empty.
fn first_of(candidates: u32) -> u32 {
    let upper = select(3u, 2u, (candidates & 4u) != 0u);
    return select(select(upper, 1u, (candidates & 2u) != 0u), 0u, (candidates & 1u) != 0u);
}
