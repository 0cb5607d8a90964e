//! Marks on a row of places, the nearest of which is found at once.

/// Marks on the places up to a bound: bits, and above each 64 words of them a word that says which
/// are not zero.
pub(super) struct Marks {
    levels: Vec<Vec<u64>>,
}

impl Marks {
    pub(super) fn new(bound: usize) -> Self {
        let mut levels = vec![vec![0; bound.div_ceil(64)]];
        while let Some(below) = levels.last().map(Vec::len).filter(|&n| n > 1) {
            levels.push(vec![0; below.div_ceil(64)]);
        }
        Self { levels }
    }

    pub(super) fn set(&mut self, place: u32) {
        let mut at = place as usize;
        for words in &mut self.levels {
            words[at / 64] |= 1 << (at % 64);
            at /= 64;
        }
    }

    pub(super) fn clear(&mut self, place: u32) {
        let mut at = place as usize;
        for words in &mut self.levels {
            let word = &mut words[at / 64];
            *word &= !(1 << (at % 64));
            if *word != 0 {
                return;
            }
            at /= 64;
        }
    }

    /// The last mark up to a place, itself included.
    pub(super) fn last_up_to(&self, place: u32) -> Option<u32> {
        let mut at = place as usize;
        // on the lowest level the place itself counts, above only words before its own
        let mut counts = u64::MAX >> (63 - at % 64);
        for (height, words) in self.levels.iter().enumerate() {
            let word = words[at / 64] & counts;
            if word != 0 {
                let found = 64 * (at / 64) + highest(word);
                let lower = self.levels[..height].iter().rev();
                return Some(lower.fold(found, |at, words| 64 * at + highest(words[at])) as u32);
            }
            at /= 64;
            counts = (1 << (at % 64)) - 1;
        }
        None
    }
}

/// The highest bit of a word that is not zero.
fn highest(word: u64) -> usize {
    word.ilog2() as usize
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use ppum_testkit::random::Random;

    #[test]
    fn marks_are_a_set() {
        let mut random = Random(5);
        for bound in [1, 2, 64, 65, 5000, 300_000] {
            let (mut marks, mut set) = (Marks::new(bound), BTreeSet::new());
            for round in 0..4000 {
                let mut place = || (random.unit() * bound as f64) as u32;
                let (changed, asked) = (place(), place());
                // at first more come than go, then the other way round
                if (random.unit() < 0.7) == (round < 2000) {
                    marks.set(changed);
                    set.insert(changed);
                } else {
                    let gone = set.range(..=changed).next_back().copied().unwrap_or(changed);
                    marks.clear(gone);
                    set.remove(&gone);
                }
                let expected = set.range(..=asked).next_back().copied();
                assert_eq!(marks.last_up_to(asked), expected, "{asked} of {bound}");
            }
        }
    }
}
