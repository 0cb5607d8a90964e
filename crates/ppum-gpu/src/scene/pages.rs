//! The patches of bins as shaders read them: pages of four, each seen from the corner of its bin.
//!
//! ```text
//! page   x of the origins · y · addresses of the bodies · [levels, 8 bits each; 1 if another page follows; 0; 0]
//!        if half-extents are not halves of the largest ones: reciprocals in x · in y
//!        if polynomials have frames of their own: x of their origins · y · reciprocal scales in x · in y
//! ```
//!
//! Each is a texel of four, one word for each patch. Positions are seen from a corner nearby, so
//! single precision does: relative to the patch's size they are as exact as ξ itself.

use ppum::dataset::BoxPartition;
use ppum::vec2::{Vec2, vec2};

use super::bins::{BinLeaf, Bins, FEW};
use super::lattice::NO_PATCH;

/// Part of a size by which it may miss a level: f64 makes sizes from borders of cells.
const ROUNDING: f64 = 1e-9;

/// Most levels: 8 bits in a page, and powers of two of single precision.
const MOST_LEVELS: f64 = 120.0;

/// Half-extents that are halves of the largest ones, as those of quadtrees are.
#[derive(Clone, Debug)]
pub(crate) struct HalfExtents {
    /// The largest half-extents.
    pub(crate) half: Vec2,
    /// How many times those of each patch are halved.
    halvings: Vec<u8>,
}

impl HalfExtents {
    /// Those of a partition; none if there are other sizes.
    pub(crate) fn from_partition(partition: &BoxPartition) -> Option<Self> {
        let half = partition.half.iter().copied().reduce(Vec2::max)?;
        let level = |own: &Vec2| {
            let level = (half.x / own.x).log2().round();
            let halved = half * (-level).exp2();
            let near = |a: f64, b: f64| (a - b).abs() <= ROUNDING * b;
            let fits = level <= MOST_LEVELS && near(own.x, halved.x) && near(own.y, halved.y);
            fits.then_some(level as u8)
        };
        let halvings = partition.half.iter().map(level).collect::<Option<_>>()?;
        Some(Self { half, halvings })
    }
}

/// Texels of a page.
pub(crate) fn page_texels(has_levels: bool, own_frames: bool) -> u32 {
    match (has_levels, own_frames) {
        (true, _) => 4,
        (false, false) => 6,
        (false, true) => 10,
    }
}

/// Writes pages.
pub(crate) struct Pages<'a> {
    pub(crate) partition: &'a BoxPartition,
    /// The point that bins are seen from.
    pub(crate) anchor: Vec2,
    pub(crate) levels: Option<&'a HalfExtents>,
    /// Polynomials have frames of their own; then there are no levels.
    pub(crate) own_frames: bool,
    /// The address of each patch's body.
    pub(crate) bodies: &'a [u32],
}

impl Pages<'_> {
    /// The pages of bins whose patches are these, the empty one first.
    pub(crate) fn words(&self, bins: &Bins, patches: &[u32]) -> Vec<u32> {
        let texels = page_texels(self.levels.is_some(), self.own_frames) as usize;
        let mut words = Vec::with_capacity(4 * texels * bins.pages as usize);
        self.push(Vec2::ZERO, [None; FEW], false, &mut words);
        for BinLeaf { corner, patches: range } in &bins.leaves {
            let mut fours = bins.list[range.clone()].chunks(FEW).peekable();
            while let Some(four) = fours.next() {
                let four = [0, 1, 2, 3].map(|k| four.get(k).map(|&k| patches[k as usize] as usize));
                self.push(*corner, four, fours.peek().is_some(), &mut words);
            }
        }
        words
    }

    /// Adds a page of a bin with this corner.
    fn push(
        &self,
        corner: Vec2,
        four: [Option<usize>; FEW],
        is_followed: bool,
        words: &mut Vec<u32>,
    ) {
        let BoxPartition { center, half, origin, scale, .. } = self.partition;
        push_seen(four, |patch| (center[patch] - self.anchor) - corner, words);
        words.extend(four.map(|patch| patch.map_or(NO_PATCH, |patch| self.bodies[patch])));
        let level = |k: usize| {
            let levels = four[k].zip(self.levels).map(|(patch, levels)| levels.halvings[patch]);
            u32::from(levels.unwrap_or_default()) << (8 * k)
        };
        words.extend([(0..FEW).map(level).sum(), is_followed.into(), 0, 0]);
        if self.levels.is_none() {
            push_seen(four, |patch| inverse(half[patch]), words);
        }
        if self.own_frames {
            push_seen(four, |patch| (origin[patch] - self.anchor) - corner, words);
            push_seen(four, |patch| inverse(scale[patch]), words);
        }
    }
}

/// Adds the x of four vectors, then their y; zeros where there is no patch.
fn push_seen(four: [Option<usize>; FEW], of: impl Fn(usize) -> Vec2, words: &mut Vec<u32>) {
    let vectors = four.map(|patch| patch.map_or(Vec2::ZERO, &of));
    words.extend(vectors.map(|v| (v.x as f32).to_bits()));
    words.extend(vectors.map(|v| (v.y as f32).to_bits()));
}

fn inverse(v: Vec2) -> Vec2 {
    vec2(1.0 / v.x, 1.0 / v.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::bins::{BinPatch, INNER};
    use ppum::cover::Cover;
    use ppum::vec2::Rect;
    use ppum::weight::WeightFunction;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::Recipe;

    /// The bins of a whole domain, seen from a point in it.
    fn bins(partition: &BoxPartition, domain: Rect, anchor: Vec2) -> Bins {
        let seen = |rect: Rect| Rect::new(rect.min - anchor, rect.max - anchor);
        let covered =
            |k: usize| BinPatch { support: seen(partition.support(k)), cell: partition.spacing(k) };
        let patches: Vec<_> = (0..partition.len()).map(covered).collect();
        Bins::new(seen(domain), &patches, 1e-7)
    }

    /// The shader's way from a point to what pages tell of it, in double precision: addresses,
    /// coordinates in the supports and in the frames of polynomials.
    fn page_entries(
        words: &[u32],
        bins: &Bins,
        pages: &Pages<'_>,
        p: Vec2,
    ) -> Vec<(u32, [Vec2; 2])> {
        let t = p - pages.anchor - bins.origin;
        let last = bins.size.map(|n| f64::from(n) - 1.0);
        let (i, j) =
            ((t.x / bins.pitch.x).floor().min(last[0]), (t.y / bins.pitch.y).floor().min(last[1]));
        let mut d = vec2(t.x - i * bins.pitch.x, t.y - j * bins.pitch.y);
        let (mut node, mut half) =
            (bins.nodes[j as usize * bins.size[0] as usize + i as usize], bins.pitch);
        while node >= INNER {
            half = half * 0.5;
            let (right, upper) = (f64::from(d.x >= half.x), f64::from(d.y >= half.y));
            d = d - vec2(right * half.x, upper * half.y);
            node = bins.nodes[4 * (node - INNER) as usize + (right + 2.0 * upper) as usize];
        }
        let size = 4 * page_texels(pages.levels.is_some(), pages.own_frames) as usize;
        let mut all = Vec::new();
        for page in words[node as usize * size..].chunks(size) {
            let number = |texel: usize, k: usize| f64::from(f32::from_bits(page[4 * texel + k]));
            let pair = |texel: usize, k: usize| vec2(number(texel, k), number(texel + 1, k));
            for k in (0..FEW).filter(|&k| page[8 + k] != NO_PATCH) {
                let inverse = pages.levels.map_or_else(
                    || pair(4, k),
                    |levels| inverse(levels.half) * f64::from((page[12] >> (8 * k)) & 0xff).exp2(),
                );
                let support = (d - pair(0, k)).scaled_by(inverse);
                let frame =
                    if pages.own_frames { (d - pair(6, k)).scaled_by(pair(8, k)) } else { support };
                all.push((page[8 + k], [support, frame]));
            }
            if page[13] == 0 {
                break;
            }
        }
        all
    }

    trait ScaledBy {
        fn scaled_by(self, by: Vec2) -> Vec2;
    }

    impl ScaledBy for Vec2 {
        fn scaled_by(self, by: Vec2) -> Vec2 {
            vec2(self.x * by.x, self.y * by.y)
        }
    }

    /// Every patch that covers a point has an entry with its coordinates, to a few roundings of
    /// single precision.
    #[test]
    fn pages_tell_where_points_lie() {
        for (seed, own_frames) in [(1, false), (2, true), (3, false), (4, true)] {
            let overlap = if seed == 3 { 1.9 } else { 1.3 };
            let recipe = Recipe { tip_level: 9, own_frames, overlap, ..Recipe::random(seed) };
            let (partition, anchor) = (recipe.partition(), recipe.domain.center());
            let bodies: Vec<u32> = (0..partition.len() as u32).map(|k| 3 * k + 1).collect();
            let levels = if own_frames { None } else { HalfExtents::from_partition(&partition) };
            assert!(own_frames || levels.is_some(), "quadtrees have levels");
            let bins = bins(&partition, recipe.domain, anchor);
            let levels = levels.as_ref();
            let pages =
                Pages { partition: &partition, anchor, levels, own_frames, bodies: &bodies };
            let all: Vec<u32> = (0..partition.len() as u32).collect();
            let words = pages.words(&bins, &all);
            assert_eq!(
                words.len(),
                4 * bins.pages as usize * page_texels(!own_frames, own_frames) as usize
            );
            let mut random = Random(seed);
            for _ in 0..500 {
                let p = random.point(&recipe.domain);
                let entries = page_entries(&words, &bins, &pages, p);
                for k in (0..partition.len()).filter(|&k| partition.support(k).contains(p)) {
                    let at = |origin: Vec2, scale: Vec2| (p - origin).scaled_by(inverse(scale));
                    let exact = [
                        at(partition.center[k], partition.half[k]),
                        at(partition.origin[k], partition.scale[k]),
                    ];
                    let (_, found) =
                        entries.iter().find(|(body, _)| *body == bodies[k]).expect("a patch");
                    for (found, exact) in found.iter().zip(exact) {
                        let error = (*found - exact).length();
                        assert!(error < 8.0 * f64::from(f32::EPSILON), "{error:e} at {p:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn sizes_that_are_no_halves_have_no_levels() {
        let domain = Rect::new(vec2(-0.3, 0.1), vec2(1.1, 1.3));
        let mut cover = Cover::grid(domain, [7, 6]).expect("a grid");
        cover.refine_leaves(&[3, 8]).expect("a cover");
        let mut partition = cover.partition(1.3, WeightFunction::Linear).expect("an overlap");
        let levels = HalfExtents::from_partition(&partition).expect("a quadtree");
        assert_eq!(levels.halvings.iter().max(), Some(&1));
        partition.half[5].x *= 1.001;
        assert!(HalfExtents::from_partition(&partition).is_none());
    }
}
