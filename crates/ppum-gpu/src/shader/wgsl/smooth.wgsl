// The smooth terms of patches of any degrees: smooth.rs writes this out where there is only one.

fn smooth_of(address: u32, coordinates: Coordinates) -> Smooth {
    var out: Smooth;
    let head = load(address);
    let degree = head.y & 0xffu;
    out.terms = head.x;
    out.others = address + (head.y >> 8u);
    if degree == ABSENT {
        return out;
    }
    out.present = true;
    let count = monomials(degree);
    var at = 2u * address + LANE_PAIRS;
    for (var g = 0u; g < GROUPS; g++) {
        out.v[g] = polynomial_with(at, degree, coordinates.xi, coordinates.inverse, Lanes());
        out.high[g] = load_lanes(at + (count - 1u) * LANE_PAIRS);
        out.low[g] = load_lanes(at + count * LANE_PAIRS);
        at += (count + 1u) * LANE_PAIRS;
    }
    return out;
}
