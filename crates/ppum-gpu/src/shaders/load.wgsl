// All data are read here. Pairs of words: of the dataset by `load`, of the region by `load_place`, both
// generated, since they may be in several buffers; of the view by `load_view`.

fn load_view(at: u32) -> vec2<f32> {
    return view_data[at];
}

fn load_pair(at: u32) -> vec2<f32> {
    return bitcast<vec2<f32>>(load(at));
}
