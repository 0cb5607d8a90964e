//! Lists on command lines and in files.

/// The parts of a list: what commas separate that stand in no parentheses and no comment.
#[must_use]
pub fn parts(list: &str) -> Vec<&str> {
    let (mut depth, mut comment, mut start) = (0usize, false, 0);
    let mut parts = Vec::new();
    for (at, c) in list.char_indices() {
        match c {
            '\n' => comment = false,
            _ if comment => {}
            '#' => comment = true,
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(list[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(list[start..].trim());
    parts
}

/// Finite numbers with commas between, none of them required.
pub(crate) fn numbers(list: &str) -> Option<Vec<f64>> {
    let number = |part: &str| part.parse().ok().filter(|v: &f64| v.is_finite());
    list.split(',').map(str::trim).filter(|part| !part.is_empty()).map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_part_what_is_outside_of_parentheses() {
        assert_eq!(parts("ux, uy"), ["ux", "uy"]);
        assert_eq!(parts("max(ux, hypot(uy, 1)),@q.txt"), ["max(ux, hypot(uy, 1))", "@q.txt"]);
        assert_eq!(parts("ux # a, b (\n + uy, 1"), ["ux # a, b (\n + uy", "1"]);
        assert_eq!(parts("a), (b, c"), ["a)", "(b, c"]);
        assert_eq!(parts(""), [""]);
    }
}
