//! Places of the plate at which a quantity has no value.

/// That a quantity has no value at some of the `things` of the plate.
pub(crate) fn message(name: &str, [undefined, all]: [usize; 2], things: &str) -> String {
    let count =
        if undefined == all { format!("all {all}") } else { format!("{undefined} of {all}") };
    format!(
        "`{name}` has no value at {count} {things} of the plate: it is not defined there, as 0/0 and roots and \
         logarithms of negative numbers are not"
    )
}
