// Patches and what they hold, see region.rs and bodies.rs.

// Coordinates ξ of a pixel in the frame of a patch, and their slopes.
struct Coordinates {
    xi: vec2<f32>,
    inverse: vec2<f32>,
}

// In the support of the weight, whose borders belong to the patch on their right or upper side.
fn covers(xi: vec2<f32>) -> bool {
    return all(xi >= vec2<f32>(-1.0)) && all(xi < vec2<f32>(1.0));
}

// A constant field in two halves: what all patches of a pixel subtract from theirs.
struct Reference {
    high: array<Lanes, GROUPS>,
    low: array<Lanes, GROUPS>,
}

// The smooth term of a patch, and where the others are.
struct Smooth {
    // Without its constants.
    v: array<Jets, GROUPS>,
    // The constants, in two halves.
    high: array<Lanes, GROUPS>,
    low: array<Lanes, GROUPS>,
    // Number of other terms, and the texel at which they begin.
    terms: u32,
    others: u32,
    // False if the patch has no smooth term.
    present: bool,
}

fn monomials(degree: u32) -> u32 {
    return (degree + 1u) * (degree + 2u) / 2u;
}

// The smooth term minus the reference.
fn smooth_field(
    smooth_term: Smooth,
    offset: vec2<f32>,
    reference: Reference,
) -> array<Jets, GROUPS> {
    var v = smooth_term.v;
    let high = smooth_term.high;
    let low = smooth_term.low;
    for (var g = 0u; g < GROUPS; g++) {
        if !HAS_SMOOTH {
            v[g].v -= reference.high[g] + reference.low[g];
        } else if is_one(SMOOTH_GROUP) {
            v[g].v += (high[g] - reference.high[g]) + (low[g] - reference.low[g]);
        } else {
            // another function has taken the place of 1
            v[g].v += high[g] + low[g];
            // 0 · f has no value where f has none
            if smooth_term.present {
                v[g] = jets_times(functions_entry(functions(SMOOTH_GROUP, offset), 0u), v[g]);
            }
            v[g].v -= reference.high[g] + reference.low[g];
        }
    }
    return v;
}

// A term beside the smooth one: the functions of a group, each times a polynomial.
struct Term {
    group: u32,
    // The texel at which the next one begins.
    next: u32,
    // 8 bits for each function.
    degrees: u32,
    // Its own texel.
    address: u32,
}

fn term_at(address: u32) -> Term {
    let head = load(address);
    let group = head.x & ((1u << GROUP_BITS) - 1u);
    return Term(group, address + (head.x >> GROUP_BITS), head.y, address);
}

fn degree_of(term: Term, entry: u32) -> u32 {
    return (term.degrees >> (8u * entry)) & 0xffu;
}

// True if all polynomials are constants; then there is one for each of four functions.
fn has_constants(term: Term) -> bool {
    return !HAS_POLYNOMIALS || (HAS_CONSTANTS && term.degrees == 0u);
}

// A function times a constant.
fn times_constant(f: Jet, c: Lanes) -> Jets {
    var out = jets_zero();
    out.v = f.v * c;
    if ORDER >= 1u {
        out.x = f.x * c;
        out.y = f.y * c;
    }
    return out;
}

fn other_field(term: Term, coordinates: Coordinates, offset: vec2<f32>) -> array<Jets, GROUPS> {
    let f = functions(term.group, offset);
    var v: array<Jets, GROUPS>;
    if HAS_CONSTANTS && has_constants(term) {
        var c = four_constants(term.address);
        for (var g = 0u; g < GROUPS; g++) {
            for (var entry = 0u; entry < 4u; entry++) {
                let part = times_constant(functions_entry(f, entry), c[entry * GROUPS + g]);
                v[g] = jets_plus(v[g], part);
            }
        }
    }
    if HAS_POLYNOMIALS && !has_constants(term) {
        var at = 2u * term.address + LANE_PAIRS;
        var entry = 0u;
        loop {
            let degree = degree_of(term, entry);
            if degree != ABSENT {
                let jet = functions_entry(f, entry);
                for (var g = 0u; g < GROUPS; g++) {
                    let p = polynomial(at, degree, coordinates.xi, coordinates.inverse);
                    at += monomials(degree) * LANE_PAIRS;
                    v[g] = jets_plus(v[g], jets_times(jet, p));
                }
            }
            entry++;
            // the loop ends with the last polynomial
            if entry == 4u || (term.degrees >> (8u * entry)) == (ALL_ABSENT >> (8u * entry)) {
                break;
            }
        }
    }
    return v;
}

