//! Tables in Markdown.

/// Prints the head of a table.
pub(crate) fn head(columns: &[&str]) {
    println!("\n| {} |", columns.join(" | "));
    println!("|{}", " --- |".repeat(columns.len()));
}

/// Prints one row.
pub(crate) fn row(cells: &[String]) {
    println!("| {} |", cells.join(" | "));
}

/// An error as a power of ten with two digits.
pub(crate) fn error(value: f64) -> String {
    format!("{value:.1e}")
}

/// The rate between an error and the one on cells twice as large, in parentheses.
pub(crate) fn rate(coarse: Option<f64>, fine: f64) -> String {
    coarse.map_or(String::new(), |coarse| format!(" ({:.2})", (coarse / fine).log2()))
}

/// Errors on covers each of half the cell size of the one before, with rates.
pub(crate) fn rated(errors: &[f64]) -> Vec<String> {
    let before = std::iter::once(None).chain(errors.iter().copied().map(Some));
    let cell = |(before, &e): (Option<f64>, &f64)| format!("{e:.2e}{}", rate(before, e));
    before.zip(errors).map(cell).collect()
}
