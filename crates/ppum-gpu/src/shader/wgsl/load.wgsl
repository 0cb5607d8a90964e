// All data are read here. Texels of four words: of the dataset by `load`, of the region by
// `load_place`; pairs of the view by `load_view`.

fn load(at: u32) -> vec4<u32> {
    return textureLoad(data, texel_at(at), 0);
}

fn load_place(at: u32) -> vec4<u32> {
    return textureLoad(places, texel_at(at), 0);
}

// Column and row of a texel by its number.
fn texel_at(at: u32) -> vec2<u32> {
    return vec2<u32>(at & ((1u << ROW_BITS) - 1u), at >> ROW_BITS);
}

fn load_view(at: u32) -> vec2<f32> {
    return view_data[at];
}
