// Weight functions: the twin of ppum::weight. Those of a formula are generated.

// (w, dw/dt) at t = |ξ| as derivatives by ξ, zero outside [-1, 1). Where a derivative
// jumps, the one from the right is taken, so that a border belongs to the patch on its right or
// upper side.
fn weight_even(xi: f32, w: vec2<f32>) -> vec2<f32> {
    let inside = (xi >= -1.0) & (xi < 1.0);
    let slope = select(-w.y, w.y, xi >= 0.0);
    return select(vec2<f32>(), vec2<f32>(w.x, slope), inside);
}

// w = 1 - t
fn weight_linear(xi: f32) -> vec2<f32> {
    return weight_even(xi, vec2<f32>(1.0 - abs(xi), -1.0));
}

// w = 1 - 3 t² for t <= 1/3, else 3/2 (1 - t)²; the knots belong to the piece on their right.
fn weight_quadratic(xi: f32) -> vec2<f32> {
    let t = abs(xi);
    let u = 1.0 - t;
    let core = vec2<f32>(1.0 - 3.0 * t * t, -6.0 * t);
    let flank = vec2<f32>(1.5 * u * u, -3.0 * u);
    return weight_even(xi, select(flank, core, (xi >= -1.0 / 3.0) & (xi < 1.0 / 3.0)));
}

// w = 1 - 6 t² + 6 t³ for t <= 1/2, else 2 (1 - t)³
fn weight_cubic(xi: f32) -> vec2<f32> {
    let t = abs(xi);
    let u = 1.0 - t;
    let core = vec2<f32>(1.0 - 6.0 * t * t * u, t * (18.0 * t - 12.0));
    let flank = vec2<f32>(2.0 * u * u * u, -6.0 * u * u);
    return weight_even(xi, select(flank, core, t < 0.5));
}

// W = w(ξ) w(η) with its derivatives in the world; `inverse` holds the reciprocal half-extents.
fn weight_tensor(xi: vec2<f32>, inverse: vec2<f32>) -> Jet {
    let a = weight(xi.x);
    let b = weight(xi.y);
    var w = Jet(a.x * b.x, 0.0, 0.0);
    if ORDER >= 1u {
        w.x = a.y * inverse.x * b.x;
        w.y = a.x * (b.y * inverse.y);
    }
    return w;
}
