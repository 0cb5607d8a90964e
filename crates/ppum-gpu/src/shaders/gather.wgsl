// One pass: each pixel gathers what covers it.

// Everything known at a pixel. Sums are divided once:
//   S = Σ W_i     U = Σ W_i (v_i − reference)     u = U / S + reference     ∇u = (∇U − u ∇S) / S
fn gathered(pixel: Pixel) -> Sample {
    var weight: Jet;
    var u: array<Jets, GROUPS>;
    var reference: Reference;
    var overlap = 0.0;
    var part = 0.0;
    let bin = bin_of(pixel);
    for (var k = 0u; k < bin.y; k++) {
        let index = bin_entry(bin.x + k);
        let at = patch_address(index);
        let support = place_in(at, pixel);
        if !covers(support.xi) {
            continue;
        }
        let w = weight_tensor(support.xi, support.inverse);
        weight = jet_plus(weight, w);
        part += select(0.0, w.v, index == view.chosen);
        if HAS_FIELD {
            let body = load_place(at + 3u);
            if overlap == 0.0 {
                reference = reference_of(body);
            }
            let place = polynomial_place(at, support, pixel);
            let v = local_field(body, place, pixel.offset, reference);
            for (var g = 0u; g < GROUPS; g++) {
                u[g] = jets_plus(u[g], jets_times(w, v[g]));
            }
        }
        overlap += 1.0;
    }
    for (var g = 0u; g < GROUPS; g++) {
        u[g] = jets_over(u[g], weight);
        u[g].v += reference.high[g] + reference.low[g];
    }
    return Sample(view.center + pixel.offset, u, weight.v, overlap, part / weight.v);
}
