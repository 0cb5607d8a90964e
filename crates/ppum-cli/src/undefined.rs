//! Places of the plate at which a quantity has no value.

/// That a quantity has no value at some of the `things` of the plate.
pub(crate) fn message(name: &str, counts: [usize; 2], things: &str) -> String {
    format!(
        "`{name}` has no value at {} {things} of the plate: it is not defined there, as 0/0 and roots and \
         logarithms of negative numbers are not",
        of(counts)
    )
}

/// That the dataset has no value for some cells, which show at some pixels.
pub(crate) fn of_cells(name: &str, counts: [usize; 2]) -> String {
    format!(
        "`{name}` has no value at {} pixels of the plate: the dataset has none for their cells",
        of(counts)
    )
}

/// So many of all.
fn of([some, all]: [usize; 2]) -> String {
    if some == all { format!("all {all}") } else { format!("{some} of {all}") }
}
