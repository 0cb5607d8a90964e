// One pass: each pixel gathers what covers it.

// What is added up at a pixel.
struct Sums {
    weight: Jet,
    u: array<Jets, GROUPS>,
    reference: Reference,
    overlap: f32,
    part: f32,
}

// Everything known at a pixel. Sums are divided once:
//   S = Σ W_i     U = Σ W_i (v_i − reference)     u = U / S + reference     ∇u = (∇U − u ∇S) / S
fn gathered(pixel: Pixel) -> Sample {
    var sums: Sums;
    let bin = bin_of(pixel);
    if HAS_LONG_LISTS {
        for (var first = 0u; first < bin.count; first += 32u) {
            add_candidates(bin, first, pixel, &sums);
        }
    } else {
        // a loop of one round is a loop
        add_candidates(bin, 0u, pixel, &sums);
    }
    var u: array<Jets, GROUPS>;
    for (var g = 0u; g < GROUPS; g++) {
        u[g] = jets_over(sums.u[g], sums.weight);
        u[g].v += sums.reference.high[g] + sums.reference.low[g];
    }
    let part = sums.part / sums.weight.v;
    return Sample(view.center + pixel.offset, u, sums.weight.v, sums.overlap, part);
}

// Adds up to 32 candidates from `first` on.
//
// Processors that run many pixels in step take every branch that one of them takes, and some take all. So the
// work is in loops over what is there: over the patches that cover the pixel, then over their terms.
fn add_candidates(bin: Bin, first: u32, pixel: Pixel, sums: ptr<function, Sums>) {
    let covering = covering_of(bin, first, pixel);
    var enriched = 0u;
    for (var rest = covering; rest != 0u; rest &= rest - 1u) {
        let k = first + first_of(rest);
        let candidate = candidate_of(bin, k, pixel);
        let w = weight_tensor(candidate.support.xi, candidate.support.inverse);
        (*sums).weight = jet_plus((*sums).weight, w);
        if HAS_PART {
            (*sums).part += select(0.0, w.v, candidate.body == view.chosen);
        }
        if HAS_FIELD {
            let smooth_term = smooth_of(candidate.body, polynomial_coordinates(candidate, pixel));
            if rest == covering && (*sums).overlap == 0.0 {
                (*sums).reference = Reference(smooth_term.high, smooth_term.low);
            }
            let v = smooth_field(smooth_term, pixel.offset, (*sums).reference);
            for (var g = 0u; g < GROUPS; g++) {
                (*sums).u[g] = jets_plus((*sums).u[g], jets_times(w, v[g]));
            }
            enriched |= select(0u, 1u << (k - first), smooth_term.terms > 0u);
        }
    }
    (*sums).overlap += f32(countOneBits(covering));
    if HAS_FIELD && (HAS_CONSTANTS || HAS_POLYNOMIALS) {
        add_terms(bin, first, enriched, pixel, sums);
    }
}

// Adds the other terms of candidates, all in one loop.
fn add_terms(bin: Bin, first: u32, enriched: u32, pixel: Pixel, sums: ptr<function, Sums>) {
    var rest = enriched;
    var left = 0u;
    var next = 0u;
    var w: Jet;
    var coordinates: Coordinates;
    loop {
        if left == 0u {
            if rest == 0u {
                break;
            }
            let candidate = candidate_of(bin, first + first_of(rest), pixel);
            rest &= rest - 1u;
            let head = load(candidate.body);
            w = weight_tensor(candidate.support.xi, candidate.support.inverse);
            coordinates = polynomial_coordinates(candidate, pixel);
            left = head.x;
            next = candidate.body + (head.y >> 8u);
        }
        let term = term_at(next);
        let v = other_field(term, coordinates, pixel.offset);
        for (var g = 0u; g < GROUPS; g++) {
            (*sums).u[g] = jets_plus((*sums).u[g], jets_times(w, v[g]));
        }
        left -= 1u;
        next = term.next;
    }
}
