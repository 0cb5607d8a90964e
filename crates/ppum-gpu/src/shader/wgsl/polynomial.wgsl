// Polynomials of two variables by nested Horner schemes: the twin of ppum::polynomial.

// The sum of c ξ^a η^b over a + b <= degree with its derivatives in the world; `inverse` holds the
// reciprocal scales of ξ. At `at` are the coefficients in the order they are needed: b = degree …
// 0, for each a = degree - b … 0, all components of one side by side.
fn polynomial(at: u32, degree: u32, xi: vec2<f32>, inverse: vec2<f32>) -> Jets {
    let last = at + ((degree + 1u) * (degree + 2u) / 2u - 1u) * LANE_PAIRS;
    return polynomial_with(at, degree, xi, inverse, load_lanes(last));
}

// The same with another constant in place of the last coefficient.
fn polynomial_with(
    at: u32,
    degree: u32,
    xi: vec2<f32>,
    inverse: vec2<f32>,
    constant: Lanes,
) -> Jets {
    var sum = jets_zero();
    var next = at;
    // `row` is degree - b; both loops end after the last round, not before one that is not needed
    var row = 0u;
    loop {
        // the factor of η^b with its derivatives by ξ
        var p = Lanes();
        var px = Lanes();
        var k = 0u;
        loop {
            if ORDER >= 1u {
                px = px * xi.x + p;
            }
            let is_last = row == degree && k == row;
            p = p * xi.x + select(load_lanes(next), constant, is_last);
            next += LANE_PAIRS;
            k++;
            if k > row {
                break;
            }
        }
        if ORDER >= 1u {
            sum.y = sum.y * xi.y + sum.v;
            sum.x = sum.x * xi.y + px;
        }
        sum.v = sum.v * xi.y + p;
        row++;
        if row > degree {
            break;
        }
    }
    return polynomial_in_world(sum, inverse);
}

// Derivatives by ξ as derivatives in the world.
fn polynomial_in_world(p: Jets, inverse: vec2<f32>) -> Jets {
    var out = p;
    if ORDER >= 1u {
        out.x = p.x * inverse.x;
        out.y = p.y * inverse.y;
    }
    return out;
}
