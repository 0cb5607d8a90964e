// All data are read here. Texels of four words: of the dataset by `load`, of the region by `load_place`; pairs of
// the view by `load_view`.

fn load(at: u32) -> vec4<u32> {
    return textureLoad(data, vec2<u32>(at % TEXELS, at / TEXELS), 0);
}

fn load_place(at: u32) -> vec4<u32> {
    return textureLoad(places, vec2<u32>(at % TEXELS, at / TEXELS), 0);
}

fn load_view(at: u32) -> vec2<f32> {
    return view_data[at];
}
