// Indicators of components seen from the view's centre: the twin of ppum::function::indicator.

// Where the cuts of a component's tree are in the view's data, and how many.
struct Indicator { first: u32, count: u32 }

// 1 in the component, 0 outside. On the line or circle of a cut its left is taken. A cut stands
// before those that follow from it, so no way through the tree is longer than the tree.
fn indicator_value(indicator: Indicator, offset: vec2<f32>) -> f32 {
    var cut = 0u;
    for (var k = 0u; k < indicator.count; k++) {
        let at = indicator.first + CUT_PAIRS * cut;
        let line = Crack(u32(load_view(at).x), 1u, false);
        let next = load_view(at + 1u);
        let part = select(next.y, next.x, crack_edge_distance(line, 0u, offset) >= 0.0);
        if part < 0.0 {
            return select(0.0, 1.0, part == INDICATOR_INSIDE);
        }
        cut = u32(part);
    }
    return 0.0;
}
