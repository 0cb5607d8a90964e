//! The word that was meant by one that is not known.

/// Longest word that suggestions are sought for: keeps the search cheap on hostile text.
const MAX_SUGGESTED: usize = 40;

/// Letters of a word that may be a part of another one.
const LEAST_PART: usize = 4;

/// The known word that was meant by an unknown one: the same except for case or for a third of its
/// letters (at least one), else one that it is a part of. Letters are inserted, left out, replaced,
/// or exchanged with their neighbour.
#[must_use]
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > MAX_SUGGESTED {
        return None;
    }
    let known: Vec<_> = known.into_iter().filter(|k| k.len() <= MAX_SUGGESTED).collect();
    let meant = word.to_lowercase();
    let length = meant.chars().count();
    let limit = (length / 3).max(1);
    let near = |&candidate: &&'a str| {
        let other = candidate.to_lowercase();
        let distance = strsim::osa_distance(&meant, &other);
        let longer = length.max(other.chars().count());
        let starts_otherwise = meant.chars().next() != other.chars().next();
        (distance <= limit && distance < longer).then_some((distance, starts_otherwise, candidate))
    };
    let by_letters = known.iter().filter_map(near).min_by_key(|(far, other, _)| (*far, *other));
    let is_part = |k: &&'a str| length >= LEAST_PART && k.contains(word);
    by_letters.map(|(.., near)| near).or_else(|| known.iter().copied().find(is_part))
}

/// `` (did you mean `near`?)`` for messages about an unknown word; empty if nothing is near.
#[must_use]
pub fn hint<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(word, known).map_or(String::new(), |near| format!(" (did you mean `{near}`?)"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_meant() {
        let known = ["theta", "r", "x", "sqrt", "young", "poisson", "ux", "sxx", "von-mises"];
        let find = |name| nearest(name, known);
        for (word, meant) in [
            ("thet", "theta"),
            ("R", "r"),
            ("xs", "x"),
            ("sqrrt", "sqrt"),
            ("yuong", "young"),
            ("poison", "poisson"),
            ("vonmises", "von-mises"),
            ("mises", "von-mises"),
            ("sx", "sxx"),
        ] {
            assert_eq!(find(word), Some(meant), "{word}");
        }
        for word in ["velocity", "q", "density", "", &"r".repeat(1000)] {
            assert_eq!(find(word), None, "{word}");
        }
        assert_eq!(hint("thet", known), " (did you mean `theta`?)");
        assert_eq!(hint("velocity", known), "");
    }
}
