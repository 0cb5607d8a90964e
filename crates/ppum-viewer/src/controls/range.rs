//! Ranges as people write them and drag them.

use ppum_scene::colors::ColorOptions;

/// A number as people and this program write it.
pub(crate) fn parse(text: &str) -> Option<f64> {
    text.trim().replace('−', "-").parse().ok().filter(|value: &f64| value.is_finite())
}

/// The digits that tell a thousandth of a range, and `least` at least: deep inside, values have
/// their first ones in common.
pub(crate) fn digits([min, max]: [f64; 2], least: usize) -> usize {
    const PARTS: f64 = 3.0;
    // as many as doubles have, at most
    const MOST: f64 = 17.0;
    let common = (min.abs().max(max.abs()) / (max - min)).log10().ceil();
    if common.is_finite() { least.max((common + PARTS).clamp(0.0, MOST) as usize) } else { least }
}

/// Fixes the range to two ends, of which one was changed.
///
/// # Errors
/// A range that is none; nothing has changed then.
pub(crate) fn set(colors: &mut ColorOptions, ends: [f64; 2], changed: usize) -> Result<(), String> {
    let [min, max] = match (colors.symmetric, ends[changed].abs()) {
        (true, size) => [-size, size],
        (false, _) => ends,
    };
    let range = format!("{min:?},{max:?}").parse().map_err(|error| format!("{error}"))?;
    colors.range = range;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_tell_a_thousandth_of_the_range() {
        assert_eq!(digits([0.0, 2.0], 4), 4);
        assert_eq!(digits([36.0845571, 36.0845575], 4), 11);
        assert_eq!(digits([-1.0, 1.0], 5), 5);
        for odd in [[1.0, 1.0], [f64::NAN, 1.0], [f64::NEG_INFINITY, f64::INFINITY]] {
            assert_eq!(digits(odd, 4), 4, "{odd:?}");
        }
        assert_eq!(digits([1.0, 1.0 + f64::EPSILON], 4), 17);
    }
}
