// Finding the patches of a pixel, see bins.rs.

// First entry of the list, and how many: the patches that may cover a pixel.
fn bin_of(pixel: Pixel) -> vec2<u32> {
    let from_origin = (pixel.high - view.grid_high) + (pixel.low - view.grid_low);
    let last = vec2<f32>(view.grid_size - 1u);
    var t = max(from_origin * view.per_pitch, vec2<f32>(0.0));
    let column_row = min(floor(t), last);
    t -= column_row;
    let index = vec2<u32>(column_row);
    var node = load_place(index.y * view.grid_size.x + index.x);
    while node.y == INNER {
        t *= 2.0;
        let half = select(vec2<f32>(0.0), vec2<f32>(1.0), t >= vec2<f32>(1.0));
        t -= half;
        let child = vec2<u32>(half);
        node = load_place(node.x + child.x + 2u * child.y);
    }
    return node;
}

// An entry of the list.
fn bin_entry(index: u32) -> u32 {
    let pair = load_place(view.list + index / 2u);
    return select(pair.x, pair.y, (index & 1u) == 1u);
}
