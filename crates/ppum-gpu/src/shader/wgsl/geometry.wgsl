// What is read of the view's data by the point functions: frames of groups, cracks. The twin is
// geometry.rs, which writes it. Whole numbers are floats there.

// The crack whose side is a group's function.
fn crack_of(group: u32) -> Crack {
    return crack_from(load_view(GEOMETRY_PAIRS * group));
}

// The component whose indicator is a group's function.
fn indicator_of(group: u32) -> Indicator {
    let pair = load_view(GEOMETRY_PAIRS * group);
    return Indicator(u32(pair.x), u32(pair.y));
}

// The tip of a group's frame.
fn tip_at(group: u32) -> Tip {
    let at = GEOMETRY_PAIRS * group;
    let line = load_view(at + 2u);
    let end = vec2<u32>(load_view(at + 3u));
    return Tip(load_view(at), load_view(at + 1u), line.x, line.y, end.x, end.y);
}

// The fixed frame of a group, that of the world too.
fn fixed_at(group: u32) -> Fixed {
    let at = GEOMETRY_PAIRS * group;
    return Fixed(load_view(at), load_view(at + 1u));
}

// A crack of the step by its index.
fn crack_at(k: u32) -> Crack {
    return crack_from(load_view(view.cracks + k));
}

fn crack_from(pair: vec2<f32>) -> Crack {
    return Crack(u32(pair.x), u32(abs(pair.y)), pair.y < 0.0);
}
