// Finding the patches of a pixel, see bins.rs.

// The bin of a pixel: a list of patches that may cover it.
struct Bin {
    first: u32,
    count: u32,
}

// A patch that may cover a pixel: the address of its body, its record, and where the pixel lies in it.
struct Candidate {
    body: u32,
    at: u32,
    support: Coordinates,
}

fn node_at(index: u32) -> vec2<u32> {
    let nodes = load_place(index / 2u);
    return select(nodes.xy, nodes.zw, (index & 1u) == 1u);
}

fn bin_of(pixel: Pixel) -> Bin {
    let from_origin = (pixel.high - view.grid_high) + (pixel.low - view.grid_low);
    let last = vec2<f32>(view.grid_size - 1u);
    var t = max(from_origin * view.per_pitch, vec2<f32>(0.0));
    let column_row = min(floor(t), last);
    t -= column_row;
    let index = vec2<u32>(column_row);
    var node = node_at(index.y * view.grid_size.x + index.x);
    while node.y == INNER {
        t *= 2.0;
        let half = select(vec2<f32>(0.0), vec2<f32>(1.0), t >= vec2<f32>(1.0));
        t -= half;
        let child = vec2<u32>(half);
        node = node_at(node.x + child.x + 2u * child.y);
    }
    return Bin(node.x, node.y);
}

fn candidate_of(bin: Bin, k: u32, pixel: Pixel) -> Candidate {
    let entry = bin.first + k;
    let four = load_place(view.list + entry / 4u);
    let at = view.patches + four[entry & 3u] * RECORD_TEXELS;
    return Candidate(load_place(at + 1u).z, at, coordinates_in(at, pixel));
}

// Coordinates of a pixel in the frame that begins at an address.
fn coordinates_in(at: u32, pixel: Pixel) -> Coordinates {
    let origin = bitcast<vec4<f32>>(load_place(at));
    let inverse = bitcast<vec4<f32>>(load_place(at + 1u)).xy;
    return Coordinates(((pixel.high - origin.xy) + (pixel.low - origin.zw)) * inverse, inverse);
}

// Where the polynomials of a candidate are taken.
fn polynomial_coordinates(candidate: Candidate, pixel: Pixel) -> Coordinates {
    if OWN_FRAMES {
        return coordinates_in(candidate.at + 2u, pixel);
    }
    return candidate.support;
}

// Which of up to 32 candidates from `first` on cover a pixel, a bit each.
fn covering_of(bin: Bin, first: u32, pixel: Pixel) -> u32 {
    var covering = 0u;
    for (var k = first; k < min(bin.count, first + 32u); k++) {
        let candidate = candidate_of(bin, k, pixel);
        covering |= select(0u, 1u << (k - first), covers(candidate.support.xi));
    }
    return covering;
}

// The first candidate of a set.
fn first_of(candidates: u32) -> u32 {
    return firstTrailingBit(candidates);
}
