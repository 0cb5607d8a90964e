//! The word that was meant.

/// The known word that differs least, if it differs in no more than a third of its letters (rounded
/// up, so that two exchanged letters of `young` are still seen).
pub(in super::super) fn nearest<'w>(word: &str, known: &[&'w str]) -> Option<&'w str> {
    let (distance, near) = known.iter().map(|near| (edits(word, near), *near)).min()?;
    (distance <= near.len().div_ceil(3)).then_some(near)
}

/// Levenshtein's distance: letters to insert, remove or replace to make one word of the other.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for j in 0..b.len() {
            let replaced = diagonal + usize::from(letter != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distances() {
        for (a, b, expected) in
            [("", "abc", 3), ("yong", "young", 1), ("kitten", "sitting", 3), ("ab", "ba", 2)]
        {
            assert_eq!(edits(a, b), expected, "{a} {b}");
            assert_eq!(edits(b, a), expected, "{b} {a}");
        }
    }

    #[test]
    fn suggests_only_what_is_near() {
        let known = ["young", "poisson", "state"];
        assert_eq!(nearest("yuong", &known), Some("young"));
        assert_eq!(nearest("yong", &known), Some("young"));
        assert_eq!(nearest("poison", &known), Some("poisson"));
        assert_eq!(nearest("density", &known), None);
    }
}
