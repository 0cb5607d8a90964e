// The Westergaard functions √r {cos θ/2, sin θ/2, sin θ/2 sin θ, cos θ/2 sin θ}: the twin of
// ppum::function::westergaard.

// The four functions with derivatives in the tip's frame. They are homogeneous of degree 1/2: what
// is needed is found on the unit circle and scaled by powers of √r, so no power of r is formed that
// the result has not. At r = 0 the values are zero and the derivatives NaN: they do not exist.
fn westergaard(p: TipPoint) -> Functions {
    let r = tip_radius(p);
    if r == 0.0 {
        return westergaard_at_tip();
    }
    let root = sqrt(r);
    let f = westergaard_on_circle(tip_half_angle(p, r), p.x / r, p.y / r);
    let slope = 1.0 / root;
    return Functions(root * f.v, slope * f.x, slope * f.y);
}

fn westergaard_at_tip() -> Functions {
    let none = vec4<f32>(ppum_from_bits(0x7fc00000u));
    var out = Functions();
    if ORDER >= 1u {
        out.x = none;
        out.y = none;
    }
    return out;
}

// At r = 1 for (cos θ/2, sin θ/2), cos θ and sin θ. With C = Re z^½ and S = Im z^½ the functions
// are C, S, S sin θ, C sin θ; derivatives of the roots are those of z^½, (z^½)′ = ½ z^{-½}.
fn westergaard_on_circle(half: vec2<f32>, ct: f32, st: f32) -> Functions {
    let c = half.x;
    let s = half.y;
    // the roots (a) times 1, 1, sin θ, sin θ (b)
    let a = vec4<f32>(c, s, s, c);
    let b = vec4<f32>(1.0, 1.0, st, st);
    var out = Functions();
    out.v = a * b;
    let sine = vec4<f32>(0.0, 0.0, 1.0, 1.0);
    let a_x = 0.5 * vec4<f32>(c, -s, -s, c);
    let a_y = 0.5 * vec4<f32>(s, c, c, s);
    let b_x = sine * (-st * ct);
    let b_y = sine * (ct * ct);
    if ORDER >= 1u {
        out.x = a_x * b + a * b_x;
        out.y = a_y * b + a * b_y;
    }
    return out;
}
