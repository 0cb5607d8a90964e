//! Numbers in their order, where there are many and most occur again and again: the edges of cells
//! and supports.
//!
//! A cover of a million cells has some thousand different edge coordinates. So they are sorted
//! after most repetitions have been left out, found by a table of the parts of their range, and
//! counted instead of compared.

/// Numbers that increase, among which others are found at once.
pub(super) struct Ranks {
    places: Vec<f64>,
    /// Places before each of the equal parts that the range is divided into, and the number of all.
    starts: Vec<u32>,
    from: f64,
    /// Parts in a unit of length.
    scale: f64,
}

impl Ranks {
    /// The values in order, without those that lie within `near` of the one before that is kept.
    pub(super) fn new(values: impl Iterator<Item = f64>, near: f64) -> Self {
        let mut places = mostly_different(values);
        places.sort_unstable_by(f64::total_cmp);
        places.dedup_by(|next, kept| *next <= *kept + near);
        let [from, to] = [places.first(), places.last()].map(|end| end.copied().unwrap_or(0.0));
        let scale = places.len() as f64 / (to - from);
        let mut ranks = Self { places, starts: Vec::new(), from, scale };
        ranks.starts = ranks.counted();
        ranks
    }

    fn counted(&self) -> Vec<u32> {
        let mut starts = vec![0; self.places.len() + 2];
        self.places.iter().for_each(|&place| starts[self.part(place) + 1] += 1);
        let mut before = 0;
        for start in &mut starts {
            before += *start;
            *start = before;
        }
        starts
    }

    /// The part of the range that a value is in. It does not fall where values rise.
    fn part(&self, value: f64) -> usize {
        (((value - self.from) * self.scale) as usize).min(self.places.len())
    }

    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    pub(super) fn at(&self, rank: u32) -> f64 {
        self.places[rank as usize]
    }

    /// The number of places up to a value, itself included.
    pub(super) fn up_to(&self, value: f64) -> u32 {
        let part = self.part(value);
        let [from, to] = [self.starts[part], self.starts[part + 1]];
        let near = &self.places[from as usize..to as usize];
        from + near.partition_point(|&place| place <= value) as u32
    }
}

/// Logarithm of the number of values that are remembered.
const REMEMBERED: u32 = 13;

/// The values, each at least once, but hardly any twice that are equal and near each other.
fn mostly_different(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut seen = vec![f64::NAN; 1 << REMEMBERED];
    // the highest bits of a product depend on all bits
    let hash =
        |value: f64| value.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - REMEMBERED);
    let is_new = |value: &f64| {
        let known = &mut seen[hash(*value) as usize];
        let is_new = *known != *value;
        *known = *value;
        is_new
    };
    values.filter(is_new).collect()
}

/// The places of keys below `bound`, in the order of the keys; those of equal keys as they come.
pub(super) fn in_order(keys: impl Iterator<Item = u32> + Clone, bound: usize) -> Vec<u32> {
    let mut next = vec![0_u32; bound + 1];
    keys.clone().for_each(|key| next[key as usize + 1] += 1);
    let mut before = 0;
    for start in &mut next {
        before += *start;
        *start = before;
    }
    let mut order = vec![0; before as usize];
    for (place, key) in (0..).zip(keys) {
        let at = &mut next[key as usize];
        order[*at as usize] = place;
        *at += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Numbers spread evenly, crowded at a point, on a lattice, huge, and few.
    fn samples(random: &mut Random) -> Vec<Vec<f64>> {
        let mut some = |n: usize, of: fn(f64) -> f64| (0..n).map(|_| of(random.unit())).collect();
        vec![
            vec![],
            vec![-0.0, 0.0],
            some(1000, |u| u),
            some(1000, |u| 3.0 + (-60.0 * u).exp()),
            some(30_000, |u| (20_000.0 * u).floor() / 7.0),
            some(500, |u| f64::MAX * (2.0 * u - 1.0)),
            some(500, |u| f64::from_bits((1000.0 * u) as u64)),
            some(500, |u| if u < 0.1 { f64::INFINITY } else { u }),
        ]
    }

    #[test]
    fn ranks_are_those_of_a_sorted_list() {
        let mut random = Random(11);
        for values in samples(&mut random) {
            let mut sorted = values.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            sorted.dedup();
            let ranks = Ranks::new(values.iter().copied(), 0.0);
            assert_eq!(ranks.places, sorted);
            let others = [f64::MIN, f64::MAX, -1.0, 0.0, 0.5, 1e300, f64::INFINITY];
            let between = sorted.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]);
            for value in sorted.iter().copied().chain(others).chain(between) {
                let expected = sorted.partition_point(|&place| place <= value);
                assert_eq!(ranks.up_to(value) as usize, expected, "{value}");
            }
        }
    }

    #[test]
    fn numbers_near_each_other_are_one() {
        let ranks = Ranks::new([0.0, 3.0, 1.05, 1.0, 1.1, 1.2].into_iter(), 0.11);
        assert_eq!(ranks.places, [0.0, 1.0, 1.2, 3.0]);
    }

    #[test]
    fn counting_sorts() {
        let mut random = Random(12);
        for bound in [1, 2, 50, 4000] {
            let keys: Vec<u32> = (0..1000).map(|_| (random.unit() * bound as f64) as u32).collect();
            let mut expected: Vec<u32> = (0..1000).collect();
            expected.sort_by_key(|&k| keys[k as usize]);
            assert_eq!(in_order(keys.iter().copied(), bound), expected);
        }
    }
}
