// Values, with slopes if the constant ORDER is 1, and their algebra: the twin of ppum::jet. Slopes
// stay 0 if it is 0.

struct Jet { v: f32, x: f32, y: f32 }

// The components of a field side by side.
struct Jets { v: Lanes, x: Lanes, y: Lanes }

// Up to four functions of one group.
struct Functions { v: vec4<f32>, x: vec4<f32>, y: vec4<f32> }

fn jet_plus(a: Jet, b: Jet) -> Jet {
    var out = Jet();
    out.v = a.v + b.v;
    if ORDER >= 1u {
        out.x = a.x + b.x;
        out.y = a.y + b.y;
    }
    return out;
}

fn jets_zero() -> Jets {
    return Jets(Lanes(), Lanes(), Lanes());
}

fn jets_plus(a: Jets, b: Jets) -> Jets {
    var out = jets_zero();
    out.v = a.v + b.v;
    if ORDER >= 1u {
        out.x = a.x + b.x;
        out.y = a.y + b.y;
    }
    return out;
}

// The product by Leibniz' rule.
fn jets_times(a: Jet, b: Jets) -> Jets {
    var out = jets_zero();
    out.v = a.v * b.v;
    if ORDER >= 1u {
        out.x = a.x * b.v + a.v * b.x;
        out.y = a.y * b.v + a.v * b.y;
    }
    return out;
}

// The quotient `sum / s` by the quotient rule.
fn jets_over(sum: Jets, s: Jet) -> Jets {
    let inverse = 1.0 / s.v;
    var out = jets_zero();
    out.v = sum.v * inverse;
    if ORDER >= 1u {
        out.x = (sum.x - out.v * s.x) * inverse;
        out.y = (sum.y - out.v * s.y) * inverse;
    }
    return out;
}

// Derivatives with respect to the world of functions of a frame whose x axis is the unit
// vector `axis`.
fn functions_turned(f: Functions, axis: vec2<f32>) -> Functions {
    let c = axis.x;
    let s = axis.y;
    var out = Functions(f.v, vec4<f32>(), vec4<f32>());
    if ORDER >= 1u {
        out.x = c * f.x - s * f.y;
        out.y = s * f.x + c * f.y;
    }
    return out;
}

// One function of a group.
fn functions_entry(f: Functions, k: u32) -> Jet {
    return Jet(f.v[k], f.x[k], f.y[k]);
}
