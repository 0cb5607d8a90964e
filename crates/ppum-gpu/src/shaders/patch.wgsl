// Patches: where they are and what they hold, see region.rs and bodies.rs.

// Coordinates of a pixel in the frame of a patch, and their slopes.
struct Place {
    xi: vec2<f32>,
    inverse: vec2<f32>,
}

// By the frame that begins at an address.
fn place_in(at: u32, pixel: Pixel) -> Place {
    let high = bitcast<vec2<f32>>(load_place(at));
    let low = bitcast<vec2<f32>>(load_place(at + 1u));
    let inverse = bitcast<vec2<f32>>(load_place(at + 2u));
    return Place(((pixel.high - high) + (pixel.low - low)) * inverse, inverse);
}

// The address of a patch's record.
fn patch_address(index: u32) -> u32 {
    return view.patches + index * PATCH_PAIRS;
}

// In the support of the weight, whose borders belong to the patch on their right or upper side.
fn covers(xi: vec2<f32>) -> bool {
    return all(xi >= vec2<f32>(-1.0)) && all(xi < vec2<f32>(1.0));
}

// Where the polynomials of a patch are taken; `support` is where its weight is.
fn polynomial_place(at: u32, support: Place, pixel: Pixel) -> Place {
    if OWN_FRAMES {
        return place_in(at + 4u, pixel);
    }
    return support;
}

// A constant field in two halves: what all patches of a pixel subtract from theirs.
struct Reference {
    high: array<Lanes, GROUPS>,
    low: array<Lanes, GROUPS>,
}

// The constants of the smooth term of a patch; 0 if it has none.
fn reference_of(body: vec2<u32>) -> Reference {
    var out: Reference;
    if body.y == 0u {
        return out;
    }
    let header = load(body.x);
    if (header.x & SMOOTH) == 0u || !is_one(header.x & ~SMOOTH) {
        return out;
    }
    var at = body.x + 1u + GROUPS * polynomial_pairs(header.y & 0xffu);
    for (var g = 0u; g < GROUPS; g++) {
        out.high[g] = load_lanes(at);
        out.low[g] = load_lanes(at + LANE_PAIRS);
        at += 2u * LANE_PAIRS;
    }
    return out;
}

fn polynomial_pairs(degree: u32) -> u32 {
    return (degree + 1u) * (degree + 2u) / 2u * LANE_PAIRS;
}

// The functions of the group that was used last: neighbouring patches often share it.
var<private> known_group: u32 = 0xffffffffu;
var<private> known: Functions;

// v_i minus the reference, with derivatives: the sum of function × polynomial.
fn local_field(
    body: vec2<u32>,
    place: Place,
    offset: vec2<f32>,
    reference: Reference,
) -> array<Jets, GROUPS> {
    var v: array<Jets, GROUPS>;
    var relative = false;
    var at = body.x;
    for (var term = 0u; term < body.y; term++) {
        let header = load(at);
        let group = header.x & ~SMOOTH;
        let one = is_one(group);
        at += 1u;
        if !one && group != known_group {
            known = functions(group, offset);
            known_group = group;
        }
        for (var entry = 0u; entry < 4u; entry++) {
            let degree = (header.y >> (8u * entry)) & 0xffu;
            if degree == ABSENT {
                continue;
            }
            for (var g = 0u; g < GROUPS; g++) {
                let p = polynomial(at, degree, place.xi, place.inverse);
                at += polynomial_pairs(degree);
                if one {
                    v[g] = jets_plus(v[g], p);
                } else {
                    v[g] = jets_plus(v[g], jets_times(functions_entry(known, entry), p));
                }
            }
        }
        if (header.x & SMOOTH) != 0u {
            for (var g = 0u; g < GROUPS; g++) {
                let high = load_lanes(at);
                let low = load_lanes(at + LANE_PAIRS);
                at += 2u * LANE_PAIRS;
                if one {
                    v[g].v += (high - reference.high[g]) + (low - reference.low[g]);
                } else {
                    var p = jets_zero();
                    p.v = high + low;
                    v[g] = jets_plus(v[g], jets_times(functions_entry(known, 0u), p));
                }
            }
            relative = one;
        }
    }
    if !relative {
        for (var g = 0u; g < GROUPS; g++) {
            v[g].v -= reference.high[g] + reference.low[g];
        }
    }
    return v;
}
