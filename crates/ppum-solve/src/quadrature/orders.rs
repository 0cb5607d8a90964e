//! Numbers of Gauss points.

use super::gauss::gauss;
use super::split::breaks;

/// Rectangles farther from a singular point than this many diameters do not feel it: n Gauss points
/// then err by about 18^(−2n).
const FAR: f64 = 4.0;

/// Rules that are tried for a weight function: points, and parts of an overlap.
const MOST_POINTS: usize = 24;
const PARTS: [usize; 6] = [1, 2, 3, 4, 6, 8];

/// Cells of the line on which a weight function is tried, with neighbours of equal size and of half
/// the size on either side.
const CELLS: [f64; 7] = [2.0, 2.0, 1.0, 1.0, 2.0, 2.0, 1.0];

/// Numbers of Gauss points in each direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Orders {
    /// Order where several patches overlap.
    pub overlap: usize,
    /// Order where one patch is alone, φ = 1, and the integrand a polynomial.
    pub flat: usize,
    /// Order near points where a function is singular.
    pub singular: usize,
    /// Order where a function has kinks: sides of pieces may follow curves there.
    pub kinked: usize,
    /// Order where functions are probed, and near singular points where one has kinks as well.
    pub probed: usize,
    /// Points less in rules that are compared to see whether they resolve a function alone: what is
    /// left for the polynomials that multiply it.
    pub reserve: usize,
    /// Equal parts that overlaps are divided into, in each direction in which the partition
    /// functions vary.
    pub parts: usize,
}

/// The patches and functions that are active on a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct ActiveFunctions {
    /// Number of patches.
    pub(super) patches: usize,
    /// Distance to the nearest singular point, in sizes of the piece; infinite if no function is
    /// singular.
    pub(super) distance: f64,
    /// True if a function has kinks, or a curve runs through the piece.
    pub(super) kinks: bool,
    /// True if functions are probed.
    pub(super) probes: bool,
}

impl Orders {
    /// The orders for polynomials of degree p and linear weights, with more points in overlaps than
    /// [`Orders::for_weight`] finds necessary. A product of two polynomials is exact where one
    /// patch is alone, cracks or not.
    ///
    /// On a square that is its diameter away from a tip, max(p + 2, 8) points integrate ξ^2p / r to
    /// 1e-5 or better (docs/decisions/0030-points.md).
    #[must_use]
    pub(crate) const fn for_degree(p: usize) -> Self {
        let (singular, probed) = (at_least_8(p + 2), at_least_8(p + 5));
        Self { overlap: p + 4, flat: p + 1, singular, kinked: p + 4, probed, reserve: p, parts: 1 }
    }

    /// Returns `n` points for every kind of piece, half of it for polynomials that multiply a
    /// probe.
    #[must_use]
    pub(crate) const fn uniform(n: usize) -> Self {
        let reserve = n / 2;
        Self { overlap: n, flat: n, singular: n, kinked: n, probed: n, reserve, parts: 1 }
    }

    /// Orders for polynomials of degree p and any weight function, and the error of the rule in
    /// overlaps.
    ///
    /// `weight` gives \[w, dw/dξ\] at ξ ∈ (−1, 1); `breakpoints` are the places t = |ξ| where a
    /// derivative jumps; `stretch` is α, the size of a patch relative to its cell. On a line of
    /// cells of two sizes the products φ_i φ_k, φ_i′ φ_k′ and the same times ξ_i^p ξ_k^p are
    /// integrated with more and more points, on more and more parts of each overlap, until the
    /// error is below `accuracy` times the largest. The returned error is larger only if no rule is
    /// good enough, which is then the best of those tried. Takes some milliseconds.
    #[must_use]
    pub(crate) fn for_weight(
        p: usize,
        stretch: f64,
        breakpoints: &[f64],
        weight: &dyn Fn(f64) -> [f64; 2],
        accuracy: f64,
    ) -> (Self, f64) {
        let line = AxisPatches::new(stretch, breakpoints, weight);
        let exact = line.products(p, MOST_POINTS, 4 * PARTS[PARTS.len() - 1]);
        let default = Self::for_degree(p);
        let mut tried: Vec<(usize, usize)> = (default.flat..=MOST_POINTS.max(default.overlap))
            .flat_map(|n| PARTS.map(|parts| (n, parts)))
            .collect();
        tried.sort_by_key(|&(n, parts)| (n * parts, parts));
        let mut best = (default, f64::INFINITY);
        for (n, parts) in tried {
            let error = difference(&line.products(p, n, parts), &exact);
            if error < best.1 || best.1.is_infinite() {
                best = (Self { overlap: n, parts, ..default }, error);
            }
            if error <= accuracy {
                break;
            }
        }
        best
    }

    /// The number for a piece.
    pub(super) fn choose(self, active: &ActiveFunctions) -> usize {
        if active.probes {
            self.probed.max(self.overlap)
        } else if active.distance < FAR {
            if active.kinks { self.probed } else { self.singular }
        } else if active.kinks {
            self.overlap.max(self.kinked)
        } else if active.distance < f64::INFINITY {
            self.overlap.max(self.flat)
        } else if active.patches == 1 {
            self.flat
        } else {
            self.overlap
        }
    }
}

const fn at_least_8(n: usize) -> usize {
    if n > 8 { n } else { 8 }
}

/// Patches on a line.
struct AxisPatches<'a> {
    /// Centres and half-sizes.
    patches: Vec<(f64, f64)>,
    /// Ends of the intervals on which the partition functions are smooth.
    breaks: Vec<f64>,
    weight: &'a dyn Fn(f64) -> [f64; 2],
}

impl<'a> AxisPatches<'a> {
    fn new(stretch: f64, breakpoints: &[f64], weight: &'a dyn Fn(f64) -> [f64; 2]) -> Self {
        let (mut end, mut patches) = (0.0, Vec::new());
        for size in CELLS {
            patches.push((end + 0.5 * size, 0.5 * stretch * size));
            end += size;
        }
        let places = || breakpoints.iter().copied().chain([1.0]);
        let of = |&(c, h): &(f64, f64)| places().flat_map(move |t| [c - t * h, c + t * h]);
        let breaks = breaks(0.0, end, patches.iter().flat_map(of).collect(), 1e-12);
        Self { patches, breaks, weight }
    }

    /// The integrals of products, kind after kind.
    fn products(&self, p: usize, n: usize, parts: usize) -> [Vec<f64>; 4] {
        let m = self.patches.len();
        let mut sums = [(); 4].map(|()| vec![0.0; m * m]);
        for interval in self.breaks.windows(2) {
            let step = (interval[1] - interval[0]) / parts as f64;
            for k in 0..parts {
                let from = interval[0] + k as f64 * step;
                for (x, w) in gauss(n).on(from, from + step) {
                    self.add(p, x, w, &mut sums);
                }
            }
        }
        sums
    }

    fn add(&self, p: usize, x: f64, weight: f64, sums: &mut [Vec<f64>; 4]) {
        let near = |&(c, h): &(f64, f64)| {
            let xi = (x - c) / h;
            (xi.abs() < 1.0).then(|| {
                let [w, slope] = (self.weight)(xi);
                (xi, w, slope / h)
            })
        };
        let active: Vec<_> = self.patches.iter().map(near).collect();
        let sum = active.iter().flatten().fold([0.0, 0.0], |[s, d], a| [s + a.1, d + a.2]);
        let shepard = |&(xi, w, slope): &(f64, f64, f64)| {
            (xi.powi(p as i32), w / sum[0], (slope - w / sum[0] * sum[1]) / sum[0])
        };
        let m = active.len();
        for (i, a) in active.iter().enumerate() {
            for (k, b) in active.iter().enumerate() {
                let (Some(a), Some(b)) = (a, b) else { continue };
                let ((s, f, df), (t, g, dg)) = (shepard(a), shepard(b));
                let products = [f * g, df * dg, f * g * s * t, df * dg * s * t];
                for (sum, product) in sums.iter_mut().zip(products) {
                    sum[i * m + k] += weight * product;
                }
            }
        }
    }
}

/// Largest difference of the sums of a kind relative to the largest of the kind.
fn difference(sums: &[Vec<f64>; 4], exact: &[Vec<f64>; 4]) -> f64 {
    let of_kind = |(a, b): (&Vec<f64>, &Vec<f64>)| {
        let largest = |v: &mut dyn Iterator<Item = f64>| v.fold(0.0, |m: f64, x| m.max(x.abs()));
        let error = largest(&mut a.iter().zip(b).map(|(x, y)| x - y));
        error / largest(&mut b.iter().copied())
    };
    sums.iter().zip(exact).map(of_kind).fold(0.0, f64::max)
}
