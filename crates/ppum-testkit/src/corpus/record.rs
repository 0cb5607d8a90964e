//! Files of records: lines `key: value`, records divided by blank lines.

use std::path::Path;

/// One record.
pub(super) struct CorpusRecord {
    /// File and line, for messages.
    pub(super) place: String,
    lines: Vec<(String, String)>,
}

/// The records of a file.
pub(super) fn records(path: &Path) -> Vec<CorpusRecord> {
    let text =
        std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let name = path.file_name().map_or("?".into(), |name| name.to_string_lossy());
    let lines: Vec<(usize, &str)> = (1..).zip(text.lines()).collect();
    let blocks = lines.split(|(_, line)| line.is_empty()).filter(|block| !block.is_empty());
    blocks.map(|block| CorpusRecord::new(format!("{name}:{}", block[0].0), block)).collect()
}

impl CorpusRecord {
    fn new(place: String, block: &[(usize, &str)]) -> Self {
        let pair = |&(number, line): &(usize, &str)| {
            let split = line.split_once(": ");
            let (key, value) =
                split.unwrap_or_else(|| panic!("{place}: line {number}: no `key: value`"));
            (key.to_owned(), value.to_owned())
        };
        Self { lines: block.iter().map(pair).collect(), place }
    }

    /// All values of a key.
    pub(super) fn all(&self, key: &str) -> impl Iterator<Item = &str> {
        self.lines.iter().filter(move |(known, _)| known == key).map(|(_, value)| value.as_str())
    }

    /// All lines, as keys and values.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&str, &str)> {
        self.lines.iter().map(|(key, value)| (key.as_str(), value.as_str()))
    }

    /// The value of a key, if it is there.
    pub(super) fn find(&self, key: &str) -> Option<&str> {
        self.all(key).next()
    }

    /// The value of a key.
    pub(super) fn text(&self, key: &str) -> &str {
        self.find(key).unwrap_or_else(|| self.fail(&format!("`{key}` is missing")))
    }

    /// Numbers divided by blanks.
    pub(super) fn numbers(&self, text: &str) -> Vec<f64> {
        text.split_ascii_whitespace().map(|text| self.number(text)).collect()
    }

    /// `name = number, …`; nothing if the key is missing.
    pub(super) fn pairs(&self, key: &str) -> Vec<(String, f64)> {
        let items = self.find(key).into_iter().flat_map(|text| text.split(", "));
        let pair = |item: &str| {
            let split = item.split_once(" = ");
            let (name, value) = split.unwrap_or_else(|| self.fail("expected `name = number`"));
            (name.to_owned(), self.number(value))
        };
        items.map(pair).collect()
    }

    fn number(&self, text: &str) -> f64 {
        text.parse().unwrap_or_else(|_| self.fail(&format!("`{text}` is no number")))
    }

    /// Ends the test: the corpus is broken.
    pub(super) fn fail(&self, message: &str) -> ! {
        panic!("{}: {message}", self.place)
    }
}
