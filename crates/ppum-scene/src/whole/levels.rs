//! Levels at the ends of a quantity's values.
//!
//! Where a level is the least or the largest value, rounding decides on which side of it values
//! lie: of a displacement that a support holds at zero pieces of lines would be found along the
//! support. Such a level is looked for just inside of the values. So a plateau at the end of the
//! values has its border, a border on which the end is attained has a line, and a single place
//! where it is attained has none.

use ppum_render::isoline::Isoline;

/// Tolerance for the rounding of values, relative to the largest one.
const ROUNDING: f64 = 1e-9;

/// Finds lines of levels, by the values' ends and the ends of their colours. Each line has the
/// level that was asked for.
pub(crate) fn between_ends<E>(
    levels: &[f64],
    (values, colors): ([f64; 2], [f64; 2]),
    find: impl FnOnce(&[f64]) -> Result<Vec<Isoline>, E>,
) -> Result<Vec<Isoline>, E> {
    let sizes = [values, colors].concat().into_iter().filter(|v| v.is_finite()).map(f64::abs);
    let reach = ROUNDING * sizes.fold(0.0, f64::max);
    let inside = |&level: &f64| match values {
        [min, _] if (level - min).abs() <= reach => min + reach,
        [_, max] if (level - max).abs() <= reach => max - reach,
        _ => level,
    };
    let inner: Vec<f64> = levels.iter().map(inside).collect();
    let mut lines = find(&inner)?;
    for line in &mut lines {
        if let Some(k) = inner.iter().position(|&level| level == line.level) {
            line.level = levels[k];
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Levels at the ends are looked for inside of the values, others where they are; lines have
    /// the levels that were asked for.
    #[test]
    fn levels_at_ends_are_moved_inside() {
        let mut random = Random(3);
        for _ in 0..100 {
            let (min, size) = (random.between(-2.0, 2.0), 10f64.powf(random.between(-9.0, 9.0)));
            let [low, high] = [min * size, (min + random.between(0.1, 3.0)) * size];
            let middle = 0.5 * (low + high);
            let noise = 1e-13 * size;
            let levels = [low - noise, middle, high + noise];
            let find = |inner: &[f64]| {
                assert!(inner[0] > low + noise && inner[2] < high - noise, "{inner:?}");
                assert!(inner[1] == middle && inner[0] < middle && middle < inner[2]);
                let line = |&level| Isoline { level, points: Vec::new(), closed: false };
                Ok::<_, ()>(inner.iter().map(line).collect())
            };
            let lines = between_ends(&levels, ([low, high], [low, high]), find).unwrap();
            assert!(lines.iter().map(|line| line.level).eq(levels));
            let find = |inner: &[f64]| {
                assert_eq!(inner[1..], levels[1..], "without an end there is none");
                Ok::<_, ()>(Vec::new())
            };
            let ends = ([low, f64::INFINITY], [low, high]);
            between_ends(&levels, ends, find).unwrap();
        }
    }
}
