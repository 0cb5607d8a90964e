//! Tables as functions of WGSL: all derivatives at a point, without arrays.
//!
//! Drivers may copy an array into the memory of each invocation before they index it, and take
//! seconds to compile that. So the binary search for the cell is written out: an `if` for each
//! inner knot, and in the innermost blocks the coefficients of one cell.

use super::number::number;
use crate::table::Table;

/// Most knots or cubics of a table. The text grows with them, and so does the time to compile it: a
/// software driver needs two seconds for so many.
pub(crate) const MAX_ELEMENTS: usize = 2047;

/// Knots or cubics of a table, whichever are more.
pub(crate) fn elements(table: &Table) -> usize {
    table.x().len().max(table.y().len()).max(table.coefficients().len() / 4)
}

/// The function of a table. For one argument x it gives f, f′, f″, f‴ as `vec4<f32>`; of two the
/// array whose element \[n\]\[m\] is ∂ᵐ⁺ⁿf/∂xᵐ∂yⁿ.
pub(crate) fn function(name: &str, table: &Table) -> String {
    let text = if table.y().is_empty() { curve(name, table) } else { surface(name, table) };
    format!("// Derivatives of the table `{}`.\n{text}", table.name())
}

fn curve(name: &str, table: &Table) -> String {
    let cubics: Vec<String> = table.coefficients().chunks(4).map(cubic).collect();
    let cell = |i: usize| format!("knot = {};\ncubic = {};\n", number(table.x()[i]), cubics[i]);
    format!(
        "fn {name}(x: f32) -> vec4<f32> {{\nlet x_inside = {};\nvar knot: f32;\nvar cubic: vec4<f32>;\n{}\
         return ppum_curve(cubic, x - x_inside, x_inside - knot);\n}}\n",
        inside('x', table.x()),
        search('x', inner(table.x()), 0, &cell),
    )
}

fn surface(name: &str, table: &Table) -> String {
    let cubics: Vec<String> = table.coefficients().chunks(4).map(cubic).collect();
    let cell = |i: usize, j: usize| {
        let first = 4 * (j * (table.x().len() - 1) + i);
        let knot = [table.x()[i], table.y()[j]].map(number).join(", ");
        let rows = cubics[first..first + 4].join(", ");
        format!("knot = vec2<f32>({knot});\nrows = array<vec4<f32>, 4>({rows});\n")
    };
    let column = |i: usize| search('y', inner(table.y()), 0, &|j| cell(i, j));
    format!(
        "fn {name}(x: f32, y: f32) -> array<vec4<f32>, 4> {{\nlet at = vec2<f32>(x, y);\n\
         let inside = vec2<f32>({}, {});\nvar knot: vec2<f32>;\nvar rows: array<vec4<f32>, 4>;\n{}\
         return ppum_surface(rows, at - inside, inside - knot);\n}}\n",
        inside('x', table.x()),
        inside('y', table.y()),
        search('x', inner(table.x()), 0, &column),
    )
}

/// The number of the range that is nearest to the argument.
fn inside(axis: char, knots: &[f64]) -> String {
    let [first, last] = [knots[0], knots[knots.len() - 1]].map(number);
    format!("ppum_clamp({axis}, {first}, {last})")
}

fn inner(knots: &[f64]) -> &[f64] {
    &knots[1..knots.len() - 1]
}

/// Binary search among inner knots, those before cell `first` being passed; `cell` gives the lines
/// of a cell. NaN is in the first one.
fn search(axis: char, knots: &[f64], first: usize, cell: &dyn Fn(usize) -> String) -> String {
    let middle = knots.len() / 2;
    let Some(&knot) = knots.get(middle) else { return cell(first) };
    let above = search(axis, &knots[middle + 1..], first + middle + 1, cell);
    let below = search(axis, &knots[..middle], first, cell);
    format!("if {axis} >= {} {{\n{above}}} else {{\n{below}}}\n", number(knot))
}

fn cubic(coefficients: &[f64]) -> String {
    let numbers: Vec<String> = coefficients.iter().map(|&c| number(c)).collect();
    format!("vec4<f32>({})", numbers.join(", "))
}
