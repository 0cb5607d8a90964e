//! Mutants: texts with a few random changes, of characters or of the parts of a formula.

use crate::random::Random;

/// A text that mutants are made of.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Its origin.
    pub name: String,
    /// The text.
    pub text: String,
}

/// Pieces that mean something to the language, or should not, divided by `|`.
const PIECES: &str = "theta/2|let a = |let b = |a|b|if(|if(x < y, |table(wave, |dtable(wave, 1, |wave|\
    dtable(factor, 1, 2, |factor|scale|1e999|64|65|2147483648|(|)|,|;|=| |\n|#|sqrt(|sin(|max(|hypot(|\
    clamp(|^-|·|−|π|\u{0}|é|e|.|1e| not |side(|-1|+ +|**|<|==";

/// Operands, divided by `|`.
const OPERANDS: &str = "x|y|t|r|theta|(theta/2)|cos(theta/2)|sin(3*theta/2)|tan(theta/2)|sin(64*theta/2)|\
    side(0)|table(wave, x)|table(factor, x, y)|dtable(wave, 2, y)|dtable(factor, 1, 2, x, y)|scale|pi|e|\
    0|1|2|0.5|(-1)|16|17|1e308|1e-308|5e-324|(0/0)|(1/0)|(x - x)|(y/r)|abs(x)|(x^2 + y^2)";

/// Operators, divided by blanks.
const OPERATORS: &str = "+ - * / ^ < <= > >= == != and or";

/// Functions of one number, divided by blanks.
const FUNCTIONS: &str =
    "sqrt cbrt exp log log10 sin cos tan asin acos atan sinh cosh tanh abs sign floor";

/// Functions of two numbers, divided by blanks.
const FUNCTIONS_OF_TWO: &str = "atan2 min max hypot";

/// Longest mutant, in bytes: above the limits of the language, so that these are met too.
const LONGEST: usize = 1 << 18;

/// One of the seeds after one to five changes.
#[must_use]
pub fn mutant(seeds: &[Seed], random: &mut Random) -> String {
    let mut text = any(seeds, random).to_owned();
    let rough = random.below(3) == 0;
    for _ in 0..=random.below(5) {
        if text.len() > LONGEST {
            text.truncate(place(&text, random));
        }
        text = if rough { roughly(&text, seeds, random) } else { by_parts(&text, seeds, random) };
    }
    text
}

/// A change of characters: most results are no formulas.
fn roughly(text: &str, seeds: &[Seed], random: &mut Random) -> String {
    let (a, b) = (place(text, random), place(text, random));
    let (start, end) =
        if random.below(4) > 0 { (a, near(text, a, random)) } else { (a.min(b), a.max(b)) };
    let (before, part, after) = (&text[..start], &text[start..end], &text[end..]);
    match random.below(9) {
        0 => format!("{before}{after}"),
        1 => format!("{before}{}{after}", part.repeat(random.below(5))),
        2 => format!("{before}{}{after}", part.repeat(random.below(300))),
        3 | 4 => format!("{before}{}{part}{after}", one(PIECES, '|', random)),
        5 => format!("{before}{}{after}", one(PIECES, '|', random)),
        6 => format!("{before}{}{after}", fragment(seeds, random)),
        7 => wrapped(before, part, after, random),
        _ => format!("{before}{}{after}", character(random)),
    }
}

/// A change that keeps most formulas formulas.
fn by_parts(text: &str, seeds: &[Seed], random: &mut Random) -> String {
    let (operator, other) = (one(OPERATORS, ' ', random), any(seeds, random));
    match random.below(9) {
        0 => exchanged(text, is_operand, &format!("({other})"), random),
        1 | 2 => exchanged(text, is_operand, one(OPERANDS, '|', random), random),
        3 => exchanged(text, |part| listed(OPERATORS, part), operator, random),
        4 => exchanged(text, |part| listed(FUNCTIONS, part), one(FUNCTIONS, ' ', random), random),
        5 => format!("({text}) {operator} ({other})"),
        6 => format!("{}({text})", one(FUNCTIONS, ' ', random)),
        7 => format!("{}({text}, {other})", one(FUNCTIONS_OF_TWO, ' ', random)),
        _ => format!("if({other} {operator} 1, {text}, {})", one(OPERANDS, '|', random)),
    }
}

/// The text with one of the parts that fit replaced.
fn exchanged(text: &str, fits: impl Fn(&str) -> bool, by: &str, random: &mut Random) -> String {
    let parts = parts(text);
    let fitting: Vec<usize> = (0..parts.len()).filter(|&k| fits(parts[k])).collect();
    if fitting.is_empty() {
        return text.to_owned();
    }
    let chosen = fitting[random.below(fitting.len())];
    parts.iter().enumerate().map(|(k, part)| if k == chosen { by } else { part }).collect()
}

/// Words and numbers, and single characters between them.
fn parts(text: &str) -> Vec<&str> {
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if word(first) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (part, later) = rest.split_at(length);
        parts.push(part);
        rest = later;
    }
    parts
}

fn is_operand(part: &str) -> bool {
    matches!(part, "x" | "y" | "t" | "r" | "theta" | "a" | "b" | "pi")
        || part.starts_with(|c: char| c.is_ascii_digit())
}

fn listed(list: &str, part: &str) -> bool {
    list.split(' ').any(|known| known == part)
}

fn one<'a>(list: &'a str, divider: char, random: &mut Random) -> &'a str {
    let count = list.split(divider).count();
    list.split(divider).nth(random.below(count)).expect("below their number")
}

fn any<'a>(seeds: &'a [Seed], random: &mut Random) -> &'a str {
    &seeds[random.below(seeds.len())].text
}

/// A border of characters.
fn place(text: &str, random: &mut Random) -> usize {
    border(text, random.below(text.len() + 1))
}

/// The first border of characters at a byte or after it; the end if there is none.
fn border(text: &str, byte: usize) -> usize {
    (byte..text.len()).find(|&k| text.is_char_boundary(k)).unwrap_or(text.len())
}

/// A border up to eight bytes further on.
fn near(text: &str, start: usize, random: &mut Random) -> usize {
    border(text, start + random.below(9))
}

/// A part of another seed.
fn fragment<'a>(seeds: &'a [Seed], random: &mut Random) -> &'a str {
    let text = any(seeds, random);
    let start = place(text, random);
    let end = border(text, start + random.below(60));
    &text[start..end]
}

/// `part` inside some levels of a call or parentheses.
fn wrapped(before: &str, part: &str, after: &str, random: &mut Random) -> String {
    let open = one(PIECES, '|', random);
    let most = if random.below(8) == 0 { 250 } else { 4 };
    let levels = 1 + random.below(most);
    let close = if open.ends_with('(') { ")" } else { "" };
    format!("{before}{}{part}{}{after}", open.repeat(levels), close.repeat(levels))
}

/// Any character: ASCII, control, or from all of Unicode.
fn character(random: &mut Random) -> char {
    let code = match random.below(3) {
        0 => random.below(0x20),
        1 => 0x20 + random.below(0x60),
        _ => random.below(0x11_0000),
    };
    char::from_u32(code as u32).unwrap_or('\u{fffd}')
}
