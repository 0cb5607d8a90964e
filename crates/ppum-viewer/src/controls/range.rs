//! Ranges as people write them and drag them.

use ppum_scene::colors::Colors;

/// A number as people and this program write it.
pub(crate) fn parse(text: &str) -> Option<f64> {
    text.trim().replace('−', "-").parse().ok().filter(|value: &f64| value.is_finite())
}

/// Fixes the range to two ends, of which one was changed.
///
/// # Errors
/// A range that is none; nothing has changed then.
pub(crate) fn set(colors: &mut Colors, ends: [f64; 2], changed: usize) -> Result<(), String> {
    let [min, max] = match (colors.symmetric, ends[changed].abs()) {
        (true, size) => [-size, size],
        (false, _) => ends,
    };
    let range = format!("{min:?},{max:?}").parse().map_err(|error| format!("{error}"))?;
    colors.range = range;
    Ok(())
}
