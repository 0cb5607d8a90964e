//! The weight function as a text of WGSL.

use ppum::weight::WeightFunction;

use crate::error::GpuError;

/// The function of the shader that calls a formula of t: its value, slope and curvature at t = |ξ|
/// as those of ξ on the support \[−1, 1).
const OF_FORMULA: &str = "
fn weight(xi: f32) -> vec2<f32> {
    let t = min(abs(xi), 1.0);
    let jet = weight_formula(CALL);
    let within = xi >= -1.0 && xi < 1.0;
    let slope = select(-jet[1], jet[1], xi >= 0.0);
    return vec2<f32>(
        weight_or_zero(within, max(jet[0], 0.0)),
        weight_or_zero(within, slope),
    );
}

// Where t goes to 1 a formula may have a limit, but no number.
fn weight_or_zero(within: bool, value: f32) -> f32 {
    let finite = (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
    return select(0.0, value, within && finite);
}
";

/// The function `weight(xi: f32) -> vec3<f32>` of a weight: w, dw/dξ, d²w/dξ² at ξ, zero outside
/// \[−1, 1).
///
/// # Errors
/// A formula with a table that WGSL cannot hold.
pub(crate) fn weight_wgsl(weight: &WeightFunction) -> Result<String, GpuError> {
    let WeightFunction::Formula(formula) = weight else {
        let name = weight.name();
        return Ok(format!(
            "\nfn weight(xi: f32) -> vec2<f32> {{\n    return weight_{name}(xi);\n}}\n"
        ));
    };
    let text = formula
        .jets()
        .wgsl_of_used("weight_formula")
        .map_err(|error| GpuError::limit("the weight", &error))?;
    let argument = if formula.jets().uses(0) { "t" } else { "" };
    Ok(text + &OF_FORMULA.replace("CALL", argument))
}
