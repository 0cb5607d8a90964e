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
    let curvature = slope * slope * slope;
    return Functions(
        root * f.v,
        slope * f.x,
        slope * f.y,
        curvature * f.xx,
        curvature * f.xy,
        curvature * f.yy,
    );
}

fn westergaard_at_tip() -> Functions {
    let none = vec4<f32>(ppum_from_bits(0x7fc00000u));
    var out = Functions();
    if ORDER >= 1u {
        out.x = none;
        out.y = none;
    }
    if ORDER >= 2u {
        out.xx = none;
        out.xy = none;
        out.yy = none;
    }
    return out;
}

// At r = 1 for (cos θ/2, sin θ/2), cos θ and sin θ. With C = Re z^½ and S = Im z^½ the functions
// are C, S, S sin θ, C sin θ; derivatives of the roots are those of z^½, (z^½)′ = ½ z^{-½},
// (z^½)″ = -¼ z^{-3/2}.
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
    if ORDER >= 2u {
        let real = 0.25 * (s * st - c * ct);
        let imaginary = 0.25 * (s * ct + c * st);
        let a_xx = vec4<f32>(real, imaginary, imaginary, real);
        let a_xy = vec4<f32>(-imaginary, real, real, -imaginary);
        let b_xx = sine * (st * (2.0 * ct * ct - st * st));
        let b_xy = sine * (ct * (2.0 * st * st - ct * ct));
        let b_yy = sine * (-3.0 * st * ct * ct);
        out.xx = a_xx * b + 2.0 * a_x * b_x + a * b_xx;
        out.xy = a_xy * b + (a_x * b_y + a_y * b_x) + a * b_xy;
        out.yy = -a_xx * b + 2.0 * a_y * b_y + a * b_yy;
    }
    return out;
}
