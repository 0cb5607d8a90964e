// One pass: each pixel gathers what covers it.

// Everything known at a pixel. Sums are divided once:
//   S = Σ W_i     U = Σ W_i (v_i − reference)     u = U / S + reference     ∇u = (∇U − u ∇S) / S
//
// Processors that run many pixels in step, as all do, take every branch that one of them takes, and some take all. So
// the work is in loops over what is there: over the patches that cover the pixel, then over their terms.
fn gathered(pixel: Pixel) -> Sample {
    var weight: Jet;
    var u: array<Jets, GROUPS>;
    var reference: Reference;
    var overlap = 0.0;
    var part = 0.0;
    let bin = bin_of(pixel);
    for (var first = 0u; first < bin.count; first += 32u) {
        let covering = covering_of(bin, first, pixel);
        var enriched = 0u;
        for (var rest = covering; rest != 0u; rest &= rest - 1u) {
            let k = first + firstTrailingBit(rest);
            let candidate = candidate_of(bin, k, pixel);
            let w = weight_tensor(candidate.support.xi, candidate.support.inverse);
            weight = jet_plus(weight, w);
            if HAS_PART {
                part += select(0.0, w.v, candidate.body == view.chosen);
            }
            if HAS_FIELD {
                let smooth_term = smooth_of(candidate.body, polynomial_place(candidate, pixel));
                if rest == covering && first == 0u {
                    reference = Reference(smooth_term.high, smooth_term.low);
                }
                let v = smooth_field(smooth_term, pixel.offset, reference);
                for (var g = 0u; g < GROUPS; g++) {
                    u[g] = jets_plus(u[g], jets_times(w, v[g]));
                }
                enriched |= select(0u, 1u << (k - first), smooth_term.terms > 0u);
            }
        }
        overlap += f32(countOneBits(covering));
        if HAS_FIELD && (HAS_CONSTANTS || HAS_POLYNOMIALS) {
            // the terms of all patches in one loop
            var left = 0u;
            var next = 0u;
            var w: Jet;
            var place: Place;
            loop {
                if left == 0u {
                    if enriched == 0u {
                        break;
                    }
                    let k = first + firstTrailingBit(enriched);
                    enriched &= enriched - 1u;
                    let candidate = candidate_of(bin, k, pixel);
                    let head = load(candidate.body);
                    w = weight_tensor(candidate.support.xi, candidate.support.inverse);
                    place = polynomial_place(candidate, pixel);
                    left = head.x;
                    next = candidate.body + (head.y >> 8u);
                }
                let term = term_at(next);
                let v = other_field(term, place, pixel.offset);
                for (var g = 0u; g < GROUPS; g++) {
                    u[g] = jets_plus(u[g], jets_times(w, v[g]));
                }
                left -= 1u;
                next = term.next;
            }
        }
    }
    for (var g = 0u; g < GROUPS; g++) {
        u[g] = jets_over(u[g], weight);
        u[g].v += reference.high[g] + reference.low[g];
    }
    return Sample(view.center + pixel.offset, u, weight.v, overlap, part / weight.v);
}
