// Patches and what they hold, see region.rs and bodies.rs.

// Coordinates ξ of a pixel in the frame of a patch, and their slopes.
struct Place {
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

// What a patch holds.
struct Body {
    // The first coefficient of the smooth term, in the unit of load_lanes.
    first: u32,
    // Its degree; ABSENT if there is no smooth term.
    degree: u32,
    // Number of other terms, and the quad at which they begin.
    terms: u32,
    others: u32,
}

fn body_at(address: u32) -> Body {
    let head = load(address);
    let degree = select(SMOOTH_DEGREE, head.y & 0xffu, SMOOTH_DEGREE == ABSENT);
    return Body(2u * address + LANE_PAIRS, degree, head.x, address + (head.y >> 8u));
}

fn monomials(degree: u32) -> u32 {
    return (degree + 1u) * (degree + 2u) / 2u;
}

// Where high and low of the constants of a smooth term are.
fn constants_at(body: Body, group: u32) -> u32 {
    let count = monomials(body.degree);
    return body.first + (group * (count + 1u) + count - 1u) * LANE_PAIRS;
}

// The constants of the smooth term of a patch; 0 if it has none.
fn reference_of(body: Body) -> Reference {
    var out: Reference;
    if body.degree != ABSENT {
        for (var g = 0u; g < GROUPS; g++) {
            let at = constants_at(body, g);
            out.high[g] = load_lanes(at);
            out.low[g] = load_lanes(at + LANE_PAIRS);
        }
    }
    return out;
}

// The smooth term of a patch minus the reference.
fn smooth_field(
    body: Body,
    place: Place,
    offset: vec2<f32>,
    reference: Reference,
) -> array<Jets, GROUPS> {
    var v: array<Jets, GROUPS>;
    let own = reference_of(body);
    let degree = select(body.degree, 0u, body.degree == ABSENT);
    for (var g = 0u; g < GROUPS; g++) {
        let at = body.first + g * (monomials(degree) + 1u) * LANE_PAIRS;
        if is_one(SMOOTH_GROUP) {
            let constant =
                (own.high[g] - reference.high[g]) + (own.low[g] - reference.low[g]);
            v[g] = polynomial_with(at, degree, place.xi, place.inverse, constant);
        } else {
            // another function has taken the place of 1
            let constant = own.high[g] + own.low[g];
            let p = polynomial_with(at, degree, place.xi, place.inverse, constant);
            v[g] = jets_times(functions_entry(functions(SMOOTH_GROUP, offset), 0u), p);
            v[g].v -= reference.high[g] + reference.low[g];
        }
    }
    return v;
}

// A term beside the smooth one: the functions of a group, each times a polynomial.
struct Term {
    group: u32,
    // The quad at which the next one begins.
    next: u32,
    // 8 bits for each function.
    degrees: u32,
    // The first coefficient, in the unit of load_lanes.
    first: u32,
}

fn term_at(address: u32) -> Term {
    let head = load(address);
    let group = head.x & ((1u << GROUP_BITS) - 1u);
    return Term(group, address + (head.x >> GROUP_BITS), head.y, 2u * address + LANE_PAIRS);
}

fn degree_of(term: Term, entry: u32) -> u32 {
    return (term.degrees >> (8u * entry)) & 0xffu;
}

// True if all polynomials are constants; then there is one for each of four functions.
fn has_constants(term: Term) -> bool {
    return !HAS_POLYNOMIALS || (HAS_CONSTANTS && term.degrees == 0u);
}

// A function times a constant.
fn scaled(f: Jet, c: Lanes) -> Jets {
    return Jets(f.v * c, f.x * c, f.y * c, f.xx * c, f.xy * c, f.yy * c);
}

fn other_field(term: Term, place: Place, offset: vec2<f32>) -> array<Jets, GROUPS> {
    let f = functions(term.group, offset);
    var v: array<Jets, GROUPS>;
    if HAS_CONSTANTS && has_constants(term) {
        for (var entry = 0u; entry < 4u; entry++) {
            let jet = functions_entry(f, entry);
            for (var g = 0u; g < GROUPS; g++) {
                let c = load_lanes(term.first + (entry * GROUPS + g) * LANE_PAIRS);
                v[g] = jets_plus(v[g], scaled(jet, c));
            }
        }
    }
    if HAS_POLYNOMIALS && !has_constants(term) {
        var at = term.first;
        for (var entry = 0u; entry < 4u && (term.degrees >> (8u * entry)) != ALL_ABSENT >> (8u * entry); entry++) {
            let degree = degree_of(term, entry);
            if degree == ABSENT {
                continue;
            }
            let jet = functions_entry(f, entry);
            for (var g = 0u; g < GROUPS; g++) {
                let p = polynomial(at, degree, place.xi, place.inverse);
                at += monomials(degree) * LANE_PAIRS;
                v[g] = jets_plus(v[g], jets_times(jet, p));
            }
        }
    }
    return v;
}
