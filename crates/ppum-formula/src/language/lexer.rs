//! Text → tokens.

use crate::error::{ErrorKind, FormulaError, TextSpan};
use crate::language::ast::Infix;
use crate::library::foreign;
use crate::operation::Binary;

/// A piece of the text that the grammar knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Token {
    /// Its kind.
    pub(crate) kind: TokenKind,
    /// Its place.
    pub(crate) span: TextSpan,
}

/// The kinds of tokens. The text of a name is found by the token's span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TokenKind {
    Number(f64),
    Name,
    Let,
    Operator(Infix),
    Not,
    Open,
    Close,
    Comma,
    Semicolon,
    Assign,
    End,
}

use TokenKind as Kind;

const fn arithmetic(operation: Binary) -> TokenKind {
    Kind::Operator(Infix::Arithmetic(operation))
}

/// The signs of the language; longer ones first.
const SIGNS: [(&str, TokenKind); 18] = [
    ("<=", Kind::Operator(Infix::LessEqual)),
    (">=", Kind::Operator(Infix::GreaterEqual)),
    ("==", Kind::Operator(Infix::Equal)),
    ("!=", Kind::Operator(Infix::NotEqual)),
    ("<", Kind::Operator(Infix::Less)),
    (">", Kind::Operator(Infix::Greater)),
    ("=", Kind::Assign),
    ("+", arithmetic(Binary::Add)),
    ("-", arithmetic(Binary::Sub)),
    ("*", arithmetic(Binary::Mul)),
    ("/", arithmetic(Binary::Div)),
    ("^", arithmetic(Binary::Pow)),
    ("(", Kind::Open),
    (")", Kind::Close),
    (",", Kind::Comma),
    (";", Kind::Semicolon),
    // the minus sign and the dot of typeset formulas, as they are pasted from papers
    ("−", arithmetic(Binary::Sub)),
    ("·", arithmetic(Binary::Mul)),
];

/// Signs of other languages and what to write instead; longer ones first.
const FOREIGN: [(&str, &str); 18] = [
    ("**", "`^`"),
    ("&&", "`and`"),
    ("||", "`or`"),
    ("&", "`and`"),
    ("|", "`or`, or `abs(…)`"),
    ("!", "`not`"),
    ("[", "`(`"),
    ("{", "`(`"),
    ("?", "`if(condition, a, b)`"),
    ("%", "`a - b*floor(a/b)`"),
    ("√", "`sqrt(…)`"),
    ("×", "`*`"),
    ("²", "`^2`"),
    ("³", "`^3`"),
    ("≤", "`<=`"),
    ("≥", "`>=`"),
    ("π", "`pi`"),
    ("θ", "`theta`"),
];

/// The tokens of a text, an [`End`](TokenKind::End) last.
pub(crate) fn tokens(source: &str) -> Result<Vec<Token>, FormulaError> {
    let mut lexer = Lexer { source, position: 0 };
    let mut tokens = Vec::new();
    loop {
        lexer.skip_blanks();
        let token = lexer.token()?;
        tokens.push(token);
        if token.kind == Kind::End {
            return Ok(tokens);
        }
    }
}

struct Lexer<'a> {
    source: &'a str,
    position: usize,
}

impl Lexer<'_> {
    fn rest(&self) -> &str {
        &self.source[self.position..]
    }

    /// Passes white space and comments.
    fn skip_blanks(&mut self) {
        loop {
            self.position += length_while(self.rest(), char::is_whitespace);
            if !self.rest().starts_with('#') {
                return;
            }
            self.position += length_while(self.rest(), |c| c != '\n');
        }
    }

    fn token(&mut self) -> Result<Token, FormulaError> {
        let Some(first) = self.rest().chars().next() else {
            return Ok(self.take(Kind::End, 0));
        };
        if first.is_ascii_alphabetic() || first == '_' {
            let length = length_while(self.rest(), |c| c.is_ascii_alphanumeric() || c == '_');
            self.refuse_module(length)?;
            let kind = word(&self.rest()[..length]);
            return Ok(self.take(kind, length));
        }
        if first.is_ascii_digit() || first == '.' {
            return self.number();
        }
        self.sign()
    }

    /// Makes a token of the next `length` bytes.
    fn take(&mut self, kind: TokenKind, length: usize) -> Token {
        let span = TextSpan { start: self.position, end: self.position + length };
        self.position = span.end;
        Token { kind, span }
    }

    /// Refuses a name of other languages with the module that it is from, as in `np.sqrt`.
    fn refuse_module(&self, length: usize) -> Result<(), FormulaError> {
        let in_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let name = self.rest()[length..].strip_prefix('.').unwrap_or_default();
        if !name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            return Ok(());
        }
        let whole = length_while(self.rest(), |c| in_name(c) || c == '.');
        let name = self.rest()[..whole].rsplit('.').find(|part| !part.is_empty()).unwrap_or(name);
        let instead = foreign(name).unwrap_or(name).to_owned();
        Err(self.error(whole, ErrorKind::Module { instead }))
    }

    /// Digits with at most one point, then at most one exponent.
    fn number(&mut self) -> Result<Token, FormulaError> {
        let text = self.rest();
        let digits = |from: usize| length_while(&text[from..], |c| c.is_ascii_digit());
        let mut length = digits(0);
        if text[length..].starts_with('.') {
            length += 1;
            length += digits(length);
        }
        if text[length..].starts_with(['e', 'E']) {
            length += 1;
            length += usize::from(text[length..].starts_with(['+', '-']));
            length += digits(length);
        }
        match text[..length].parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(self.take(Kind::Number(value), length)),
            _ => Err(self.error(length, ErrorKind::InvalidNumber)),
        }
    }

    fn sign(&mut self) -> Result<Token, FormulaError> {
        let text = self.rest();
        let known = SIGNS.iter().find(|(sign, _)| text.starts_with(sign));
        let foreign = FOREIGN.iter().find(|(sign, _)| text.starts_with(sign));
        match (known, foreign) {
            // `**` begins with the known `*`, `!=` with the foreign `!`: the longer one is meant
            (Some((sign, kind)), f) if f.is_none_or(|(other, _)| other.len() < sign.len()) => {
                Ok(self.take(*kind, sign.len()))
            }
            (_, Some((sign, instead))) => {
                Err(self.error(sign.len(), ErrorKind::Unexpected { expected: instead }))
            }
            _ => {
                let length = text.chars().next().map_or(0, char::len_utf8);
                let expected = "a number, a name or an operator";
                Err(self.error(length, ErrorKind::Unexpected { expected }))
            }
        }
    }

    fn error(&self, length: usize, mistake: ErrorKind) -> FormulaError {
        let span = TextSpan { start: self.position, end: self.position + length };
        FormulaError::new(self.source, span, mistake)
    }
}

/// Bytes of the longest prefix whose characters all fit.
fn length_while(text: &str, fits: impl Fn(char) -> bool) -> usize {
    text.find(|c| !fits(c)).unwrap_or(text.len())
}

fn word(text: &str) -> TokenKind {
    match text {
        "let" => Kind::Let,
        "and" => Kind::Operator(Infix::And),
        "or" => Kind::Operator(Infix::Or),
        "not" => Kind::Not,
        _ => Kind::Name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<TokenKind> {
        tokens(text).expect("valid tokens").into_iter().map(|t| t.kind).collect()
    }

    #[test]
    fn numbers() {
        for (text, value) in
            [("1", 1.0), ("1.5", 1.5), (".5", 0.5), ("5.", 5.0), ("1e3", 1e3), ("2.5E-3", 2.5e-3)]
        {
            assert_eq!(kinds(text), [Kind::Number(value), Kind::End], "{text}");
        }
        for text in ["1e", "1e+", ".", "1e999"] {
            assert_eq!(tokens(text).expect_err(text).mistake, ErrorKind::InvalidNumber);
        }
    }

    #[test]
    fn signs_and_comments() {
        assert_eq!(
            kinds("a<=b # a<b\n != not(c)"),
            [
                Kind::Name,
                Kind::Operator(Infix::LessEqual),
                Kind::Name,
                Kind::Operator(Infix::NotEqual),
                Kind::Not,
                Kind::Open,
                Kind::Name,
                Kind::Close,
                Kind::End
            ]
        );
        assert_eq!(kinds("x − 2·y"), kinds("x - 2*y"));
    }

    #[test]
    fn spans_are_bytes() {
        let text = "ab + 12.5";
        let spans: Vec<&str> =
            tokens(text).expect("valid").iter().map(|t| &text[t.span.range()]).collect();
        assert_eq!(spans, ["ab", "+", "12.5", ""]);
    }

    #[test]
    fn foreign_signs_name_their_remedy() {
        for (text, found, remedy) in [
            ("x**2", "**", "`^`"),
            ("a && b", "&&", "`and`"),
            ("!a", "!", "`not`"),
            ("2π", "π", "`pi`"),
        ] {
            let error = tokens(text).expect_err(text);
            assert_eq!(error.found, found);
            assert_eq!(error.mistake, ErrorKind::Unexpected { expected: remedy });
        }
    }
}
