//! Numbers as texts of WGSL.

/// A number in single precision, negative ones in parentheses. One that is not finite is made by a
/// function: as a constant expression it is an error.
pub(crate) fn number(value: f64) -> String {
    let value = value as f32;
    match (value.is_finite(), value.is_sign_negative()) {
        (true, false) => format!("{value:?}"),
        (true, true) => format!("({value:?})"),
        (false, _) => format!("ppum_from_bits({:#x}u)", value.to_bits()),
    }
}
