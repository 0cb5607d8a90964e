// The three passes of Üffinger et al. 2011, section 4 and figure 3: patches drawn as quads.
//
//   1  S = Σ W_i and ∇S by additive blending                                 sum_weight
//   2  φ_i v_i and ∇(φ_i v_i) = ∇φ_i v_i + φ_i ∇v_i, likewise, φ_i = W_i / S  sum_field
//   3  the quantity of the sums, then its colour                             sample_of
//
// A quad is clipped to the view and its corners put on borders of pixels in double precision. Its
// local coordinates are given at its first pixel, with their steps from pixel to pixel: exact where
// the interpolation of corners is not.

struct Quad {
    @builtin(position) position: vec4<f32>,
    // Its first pixel; there ξ, and the steps of ξ to the next column and row.
    @location(0) @interpolate(flat) first: vec2<u32>,
    @location(1) @interpolate(flat) xi: vec2<f32>,
    @location(2) @interpolate(flat) step: vec2<f32>,
    // The same in the frame of the polynomials.
    @location(3) @interpolate(flat) frame_xi: vec2<f32>,
    @location(4) @interpolate(flat) frame_step: vec2<f32>,
    // The address of what the patch holds, which tells it from all others.
    @location(5) @interpolate(flat) body: u32,
}

@vertex
fn draw_quad(@builtin(vertex_index) vertex: u32, quad: Instance) -> Quad {
    let is_end = vec2<bool>((vertex & 1u) == 1u, vertex >= 2u);
    let corner = vec2<f32>(select(quad.first, quad.end, is_end));
    let at = corner / vec2<f32>(view.pixels) * 2.0 - 1.0;
    let position = vec4<f32>(at.x, -at.y, 0.0, 1.0);
    return Quad(
        position, quad.first, quad.xi, quad.step, quad.frame_xi, quad.frame_step, quad.body
    );
}

// Where the pixel at hand lies in the frame that has ξ and these steps at the first pixel of
// its quad.
fn quad_coordinates(quad: Quad, xi: vec2<f32>, step: vec2<f32>) -> Coordinates {
    let steps = vec2<f32>(vec2<u32>(quad.position.xy) - quad.first);
    return Coordinates(xi + steps * step, vec2<f32>(1.0, -1.0) * step / view.pixel_size);
}

// The weight of a patch; 0 on the pixels of its quad's border that it does not cover.
fn quad_weight(support: Coordinates) -> Jet {
    if !covers(support.xi) {
        return Jet();
    }
    return weight_tensor(support.xi, support.inverse);
}

// W with its slope and the number of patches; in the place of the slope W of the chosen patch,
// where its φ is drawn, which needs no slope.
@fragment
fn sum_weight(quad: Quad) -> Weights {
    let support = quad_coordinates(quad, quad.xi, quad.step);
    let w = quad_weight(support);
    let part = select(0.0, w.v, quad.body == view.chosen);
    let overlap = select(0.0, 1.0, covers(support.xi));
    return Weights(vec4<f32>(w.v, select(w.x, part, HAS_PART), w.y, overlap));
}

// φ_i v_i of two components; a slot holds two of value, x, y.
@fragment
fn sum_field(quad: Quad) -> Fields {
    let pixel = pixel_at(vec2<u32>(quad.position.xy));
    let support = quad_coordinates(quad, quad.xi, quad.step);
    // on the very border W is 0, but its slope is not
    if !covers(support.xi) {
        return Fields();
    }
    let w = weight_tensor(support.xi, support.inverse);
    let phi = jet_over(w, weight_sum(pixel.index));
    var coordinates = support;
    if OWN_FRAMES {
        coordinates = quad_coordinates(quad, quad.frame_xi, quad.frame_step);
    }
    let smooth_term = smooth_of(quad.body, coordinates);
    var v = smooth_field(smooth_term, pixel.offset, view_reference());
    if HAS_CONSTANTS || HAS_POLYNOMIALS {
        var next = smooth_term.others;
        for (var k = 0u; k < smooth_term.terms; k++) {
            let term = term_at(next);
            let other = other_field(term, coordinates, pixel.offset);
            for (var g = 0u; g < GROUPS; g++) {
                v[g] = jets_plus(v[g], other[g]);
            }
            next = term.next;
        }
    }
    return fields_of(jets_times(phi, v[2u * PAIR / LANES]));
}

// The constants that all patches subtract from theirs: those of a patch in sight.
fn view_reference() -> Reference {
    var out: Reference;
    for (var g = 0u; g < GROUPS; g++) {
        out.high[g] = view_lanes(view.reference + g * LANE_PAIRS);
        out.low[g] = view_lanes(view.reference + (GROUPS + g) * LANE_PAIRS);
    }
    return out;
}

// Σ W_i with derivatives, from the first pass.
fn weight_sum(index: vec2<u32>) -> Jet {
    let first = textureLoad(weights_0, index, 0);
    return Jet(first.x, first.y, first.z);
}

fn jet_over(a: Jet, b: Jet) -> Jet {
    let sum = Jets(Lanes(a.v), Lanes(a.x), Lanes(a.y));
    let q = jets_over(sum, b);
    return Jet(q.v.x, q.x.x, q.y.x);
}

// Everything known at a pixel, from the first two passes.
fn summed(pixel: Pixel) -> Sample {
    let sum = weight_sum(pixel.index);
    let weights = textureLoad(weights_0, pixel.index, 0);
    let reference = view_reference();
    var u: array<Jets, GROUPS>;
    if HAS_FIELD {
        for (var g = 0u; g < GROUPS; g++) {
            u[g] = jets_of(g, pixel.index);
            u[g].v += reference.high[g] + reference.low[g];
        }
    }
    return Sample(view.center + pixel.offset, u, sum.v, weights.w, weights.y / sum.v);
}

// The sums of a group of components; slot k of a pair of them holds two numbers of each.
fn jets_of(group: u32, index: vec2<u32>) -> Jets {
    var out: Jets;
    let pair = group * LANES / 2u;
    let v_x = slot_pairs(pair, 0u, index);
    out.v = v_x[0];
    if ORDER >= 1u {
        out.x = v_x[1];
        out.y = slot_pairs(pair, 1u, index)[0];
    }
    return out;
}

// Slot k of the pairs of components of a group, beginning with `pair`: two numbers of each
// component.
fn slot_pairs(pair: u32, k: u32, index: vec2<u32>) -> array<Lanes, 2> {
    let a = field_slot(pair * SLOTS + k, index);
    if LANES == 2u {
        return array<Lanes, 2>(lanes_of(a.xy, a.xy), lanes_of(a.zw, a.zw));
    }
    let b = field_slot((pair + 1u) * SLOTS + k, index);
    return array<Lanes, 2>(lanes_of(a.xy, b.xy), lanes_of(a.zw, b.zw));
}
