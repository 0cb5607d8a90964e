// One pass: each pixel gathers what covers it.
//
// Processors that run many pixels in step take every branch that one of them takes, and some take
// all. So the work is in loops over what is there: over the patches that cover a pixel, then over
// their terms. Some leave a loop at its end only, and go on to there when no pixel is left: so it
// is asked at the end of a round, too, whether that was the last.

// Up to four patches that may cover a pixel.
struct Four {
    // Addresses of what they hold; NO_PATCH for none.
    bodies: vec4<u32>,
    // Where the pixel lies in the supports, and slopes.
    support: Places,
    // The same in the frames of polynomials.
    frame: Places,
}

// Coordinates of a pixel in the frames of four patches, and their slopes.
struct Places {
    x: vec4<f32>,
    y: vec4<f32>,
    inverse_x: vec4<f32>,
    inverse_y: vec4<f32>,
}

fn place_in(places: Places, k: u32) -> Coordinates {
    return Coordinates(
        vec2<f32>(places.x[k], places.y[k]),
        vec2<f32>(places.inverse_x[k], places.inverse_y[k]),
    );
}

// What is added up at a pixel.
struct Sums {
    weight: Jet,
    u: array<Jets, GROUPS>,
    reference: Reference,
    overlap: u32,
    part: f32,
    factors: Factors,
}

// Everything known at a pixel. Sums are divided once:
//   S = Σ W_i     U = Σ W_i (v_i − reference)     u = U / S + reference     ∇u = (∇U − u ∇S) / S
fn gathered(pixel: Pixel) -> Sample {
    var sums: Sums;
    var bin = bin_of(pixel);
    loop {
        add_four(four_of(bin), pixel, &sums);
        if is_last(bin) {
            break;
        }
        bin = next_of(bin);
    }
    if HAS_FIELD && IN_ONE_GROUP {
        add_group(pixel, &sums);
    }
    var u: array<Jets, GROUPS>;
    for (var g = 0u; g < GROUPS; g++) {
        u[g] = jets_over(sums.u[g], sums.weight);
        u[g].v += sums.reference.high[g] + sums.reference.low[g];
    }
    let part = sums.part / sums.weight.v;
    return Sample(view.center + pixel.offset, u, sums.weight.v, f32(sums.overlap), part);
}

// Adds what up to four patches have at a pixel.
fn add_four(four: Four, pixel: Pixel, sums: ptr<function, Sums>) {
    let covering = covering_of(four);
    var enriched = 0u;
    var rest = covering;
    loop {
        if rest == 0u {
            break;
        }
        let k = first_of(rest);
        let support = place_in(four.support, k);
        let w = weight_tensor(support.xi, support.inverse);
        (*sums).weight = jet_plus((*sums).weight, w);
        if HAS_PART {
            (*sums).part += select(0.0, w.v, four.bodies[k] == view.chosen);
        }
        if HAS_FIELD {
            let smooth_term = smooth_of(four.bodies[k], place_in(four.frame, k));
            if rest == covering && (*sums).overlap == 0u {
                (*sums).reference = Reference(smooth_term.high, smooth_term.low);
            }
            let v = smooth_field(smooth_term, pixel.offset, (*sums).reference);
            for (var g = 0u; g < GROUPS; g++) {
                (*sums).u[g] = jets_plus((*sums).u[g], jets_times(w, v[g]));
            }
            if IN_ONE_GROUP {
                add_factors(sums, smooth_term, w);
            }
            enriched |= select(0u, rest & (~rest + 1u), smooth_term.terms > 0u);
        }
        rest &= rest - 1u;
        if rest == 0u {
            break;
        }
    }
    (*sums).overlap += countOneBits(covering);
    if HAS_FIELD && (HAS_CONSTANTS || HAS_POLYNOMIALS) && !IN_ONE_GROUP {
        add_terms(four, enriched & covering, pixel, sums);
    }
}

// Which of four patches cover a pixel, a bit each. Borders belong to the patch on their right or
// upper side.
fn covering_of(four: Four) -> u32 {
    let one = vec4<f32>(1.0);
    let in_x = (four.support.x >= -one) & (four.support.x < one);
    let in_y = (four.support.y >= -one) & (four.support.y < one);
    let covers = in_x & in_y & (four.bodies != vec4<u32>(NO_PATCH));
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), covers);
    return bits.x | bits.y | bits.z | bits.w;
}

// The first of four that is in a set; the last of an empty one.
fn first_of(patches: u32) -> u32 {
    let upper = select(3u, 2u, (patches & 4u) != 0u);
    return select(select(upper, 1u, (patches & 2u) != 0u), 0u, (patches & 1u) != 0u);
}

// Adds the other terms of patches, all in one loop.
fn add_terms(four: Four, enriched: u32, pixel: Pixel, sums: ptr<function, Sums>) {
    var rest = enriched;
    var left = 0u;
    var next = 0u;
    var w: Jet;
    var coordinates: Coordinates;
    loop {
        if rest == 0u && left == 0u {
            break;
        }
        if left == 0u {
            let k = first_of(rest);
            let support = place_in(four.support, k);
            let head = load(four.bodies[k]);
            w = weight_tensor(support.xi, support.inverse);
            coordinates = place_in(four.frame, k);
            left = head.x;
            next = four.bodies[k] + (head.y >> 8u);
            rest &= rest - 1u;
        }
        let term = term_at(next);
        let v = other_field(term, coordinates, pixel.offset);
        for (var g = 0u; g < GROUPS; g++) {
            (*sums).u[g] = jets_plus((*sums).u[g], jets_times(w, v[g]));
        }
        left -= 1u;
        next = term.next;
        if rest == 0u && left == 0u {
            break;
        }
    }
}

// Adds the functions of the one group that there is times their factors.
fn add_group(pixel: Pixel, sums: ptr<function, Sums>) {
    let added = times_factors(functions_here(pixel.group, pixel.offset), (*sums).factors);
    for (var g = 0u; g < GROUPS; g++) {
        // 0 times no value is no value
        if (*sums).factors.are_there {
            (*sums).u[g] = jets_plus((*sums).u[g], added[g]);
        }
    }
}
