// Finding the patches of a pixel on any cover, see bins.rs and pages.rs.

// The bin of a pixel: the page at hand, its texel, and the vector from the bin's lower left corner
// to the pixel, as the sum of two.
struct Bin {
    page: u32,
    high: vec2<f32>,
    low: vec2<f32>,
}

fn bin_of(pixel: Pixel) -> Bin {
    let from_high = pixel.high - view.grid_high;
    let from_low = pixel.low - view.grid_low;
    let last = vec2<f32>(view.grid_size - 1u);
    let index = clamp(floor((from_high + from_low) * view.per_pitch), vec2<f32>(0.0), last);
    // of highs every step is exact
    var high = from_high - index * view.pitch_high;
    var low = from_low - index * view.pitch_low;
    let column_row = vec2<u32>(index);
    let bin = column_row.y * view.grid_size.x + column_row.x;
    var node = load_place(view.nodes + bin / 4u)[bin & 3u];
    var half_high = view.pitch_high;
    var half_low = view.pitch_low;
    loop {
        if node < INNER {
            break;
        }
        half_high *= 0.5;
        half_low *= 0.5;
        let is_upper = high + low >= half_high + half_low;
        high -= select(vec2<f32>(0.0), half_high, is_upper);
        low -= select(vec2<f32>(0.0), half_low, is_upper);
        let child = select(0u, 1u, is_upper.x) + select(0u, 2u, is_upper.y);
        node = load_place(view.nodes + (node - INNER))[child];
        if node < INNER {
            break;
        }
    }
    return Bin(node * PAGE_TEXELS, high, low);
}

fn four_of(bin: Bin) -> Four {
    let x = texel_of(bin, 0u);
    let y = texel_of(bin, 1u);
    let bodies = load_place(bin.page + 2u);
    let inverse_x = inverse_of(bin, view.per_half.x, 4u);
    let inverse_y = inverse_of(bin, view.per_half.y, 5u);
    let support = places_at(bin, x, y, inverse_x, inverse_y);
    if !OWN_FRAMES {
        return Four(bodies, support, support);
    }
    let frame = places_at(bin, texel_of(bin, 6u), texel_of(bin, 7u), texel_of(bin, 8u), texel_of(bin, 9u));
    return Four(bodies, support, frame);
}

fn texel_of(bin: Bin, k: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(load_place(bin.page + k));
}

// Reciprocal half-extents along an axis: those of the largest patches doubled level by level, or
// numbers of their own.
fn inverse_of(bin: Bin, largest: f32, k: u32) -> vec4<f32> {
    if !HAS_LEVELS {
        return texel_of(bin, k);
    }
    let levels = load_place(bin.page + 3u).x;
    let exponents = (vec4<u32>(levels) >> vec4<u32>(0u, 8u, 16u, 24u)) & vec4<u32>(0xffu);
    return largest * bitcast<vec4<f32>>((exponents + 127u) << vec4<u32>(23u));
}

// Where the pixel of a bin lies in frames with these origins, seen from its corner.
fn places_at(
    bin: Bin,
    x: vec4<f32>,
    y: vec4<f32>,
    inverse_x: vec4<f32>,
    inverse_y: vec4<f32>,
) -> Places {
    let d_x = ((bin.high.x - x) + bin.low.x) * inverse_x;
    let d_y = ((bin.high.y - y) + bin.low.y) * inverse_y;
    return Places(d_x, d_y, inverse_x, inverse_y);
}

// False if another page of the bin follows.
fn is_last(bin: Bin) -> bool {
    return load_place(bin.page + 3u).y == 0u;
}

fn next_of(bin: Bin) -> Bin {
    return Bin(bin.page + PAGE_TEXELS, bin.high, bin.low);
}
