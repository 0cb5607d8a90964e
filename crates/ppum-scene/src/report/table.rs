//! A table of numbers with names, as CSV and as NPY.

use std::collections::BTreeSet;
use std::io::{self, Write};

/// A column's name and unit; the unit may be empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name.
    pub name: String,
    /// The unit.
    pub unit: String,
}

impl Column {
    /// A column.
    #[must_use]
    pub fn new(name: &str, unit: &str) -> Self {
        Self { name: name.to_owned(), unit: unit.to_owned() }
    }

    /// `name [unit]`, quoted where CSV wants it.
    fn head(&self) -> String {
        let Self { name, unit } = self;
        let text = if unit.is_empty() { name.clone() } else { format!("{name} [{unit}]") };
        if text.contains([',', '"', '\n', '\r']) {
            return format!("\"{}\"", text.replace('"', "\"\""));
        }
        text
    }
}

/// Numbers in rows and columns.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberTable {
    columns: Vec<Column>,
    /// Row by row.
    values: Vec<f64>,
    /// Shape of the rows as an array; of a grid rows and columns.
    shape: Vec<usize>,
}

/// Two columns of one name, which arrays cannot have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there would be two columns `{0}`; leave one out")]
pub struct SameName(pub String);

impl NumberTable {
    /// A table of columns, its values row by row.
    #[must_use]
    pub fn new(columns: Vec<Column>, values: Vec<f64>) -> Self {
        let shape = vec![values.len() / columns.len()];
        Self { columns, values, shape }
    }

    /// Returns the table with a first column.
    #[must_use]
    pub fn with_first(self, column: Column, first: Vec<f64>) -> Self {
        let rows = first.iter().zip(self.values.chunks(self.columns.len()));
        let values = rows.flat_map(|(first, rest)| [&[*first], rest].concat()).collect();
        Self::new([vec![column], self.columns].concat(), values)
    }

    /// Returns the table as an array of so many rows and columns of places.
    #[must_use]
    pub fn with_shape(self, [rows, columns]: [usize; 2]) -> Self {
        Self { shape: vec![rows, columns], ..self }
    }

    /// The names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// The columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks(self.columns.len())
    }

    /// The numbers of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let at = self.names().position(|known| known == name)?;
        Some(self.values.chunks(self.columns.len()).map(|row| row[at]).collect())
    }

    /// Fields of arrays have names of their own.
    ///
    /// # Errors
    /// The name that two columns have.
    pub fn check_names(&self) -> Result<(), SameName> {
        let mut seen = BTreeSet::new();
        match self.columns.iter().find(|column| !seen.insert(&column.name)) {
            Some(column) => Err(SameName(column.name.clone())),
            None => Ok(()),
        }
    }

    /// `201 rows of s, x, y`
    #[must_use]
    pub fn summary(&self) -> String {
        let names: Vec<_> = self.names().collect();
        let rows: usize = self.shape.iter().product();
        format!("{rows} {} of {}", if rows == 1 { "row" } else { "rows" }, names.join(", "))
    }

    /// Numbers in the fewest digits that mean the same double; `nan`, `inf` and `-inf`.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let heads: Vec<_> = self.columns.iter().map(Column::head).collect();
        writeln!(out, "{}", heads.join(","))?;
        let mut line = String::new();
        for row in self.values.chunks(self.columns.len()) {
            line.clear();
            for value in row {
                line.push_str(if line.is_empty() { "" } else { "," });
                line.push_str(&number(*value));
            }
            writeln!(out, "{line}")?;
        }
        Ok(())
    }

    /// Writes the table as text.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut out = Vec::new();
        self.write_csv(&mut out).expect("memory takes all that is written");
        String::from_utf8(out).expect("names and numbers are text")
    }

    /// A structured array of numpy's format 1.0, or 3.0 where names need it.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn write_npy(&self, out: &mut dyn Write) -> io::Result<()> {
        let header = self.npy_header();
        let plain = header.is_ascii() && header.len() < 65_000;
        let (version, size) = if plain { (1, 2) } else { (3, 4) };
        // magic, version, length and header end at a multiple of 64 bytes
        let used = 8 + size + header.len() + 1;
        let header = format!("{header}{}\n", " ".repeat(used.next_multiple_of(64) - used));
        out.write_all(b"\x93NUMPY")?;
        out.write_all(&[version, 0])?;
        out.write_all(&(header.len() as u64).to_le_bytes()[..size])?;
        out.write_all(header.as_bytes())?;
        self.values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
    }

    fn npy_header(&self) -> String {
        let field = |Column { name, .. }: &Column| format!("({}, '<f8')", quoted(name));
        let fields: Vec<_> = self.columns.iter().map(field).collect();
        let shape: String = self.shape.iter().map(|n| format!("{n}, ")).collect();
        format!(
            "{{'descr': [{}], 'fortran_order': False, 'shape': ({}), }}",
            fields.join(", "),
            shape.trim_end()
        )
    }
}

fn number(value: f64) -> String {
    if value.is_nan() { "nan".to_owned() } else { format!("{value:?}") }
}

/// A text as Python writes it.
fn quoted(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('\'', "\\'");
    format!("'{}'", escaped.replace('\n', "\\n").replace('\r', "\\r"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> NumberTable {
        let columns = vec![Column::new("x", ""), Column::new("max(ux, 1)", "mm")];
        NumberTable::new(columns, vec![0.1, f64::NAN, 1e300, f64::NEG_INFINITY])
    }

    #[test]
    fn csv_has_all_digits() {
        let mut out = Vec::new();
        table().write_csv(&mut out).expect("memory");
        let text = String::from_utf8(out).expect("text");
        assert_eq!(text, "x,\"max(ux, 1) [mm]\"\n0.1,nan\n1e300,-inf\n");
    }

    /// The format as numpy documents it: NEP 1, `numpy.lib.format`.
    #[test]
    fn npy_is_what_numpy_reads() {
        for (name, version, size) in [("it's", 1_u8, 2), ("σ", 3, 4)] {
            let mut table = table();
            table.columns[0].name = name.into();
            let mut out = Vec::new();
            table.write_npy(&mut out).expect("memory");
            assert_eq!(out[..8], [0x93, b'N', b'U', b'M', b'P', b'Y', version, 0]);
            let length = (0..size).map(|k| usize::from(out[8 + k]) << (8 * k)).sum::<usize>();
            let data = 8 + size + length;
            assert!(data.is_multiple_of(64) && out[data - 1] == b'\n');
            let header = std::str::from_utf8(&out[8 + size..data]).expect("text");
            let name = name.replace('\'', "\\'");
            let expected = format!(
                "{{'descr': [('{name}', '<f8'), ('max(ux, 1)', '<f8')], 'fortran_order': False, 'shape': (2,), }}"
            );
            assert_eq!(header.trim_end(), expected);
            assert_eq!(out[data..data + 8], 0.1_f64.to_le_bytes());
            assert_eq!(out.len(), data + 32);
        }
    }

    #[test]
    fn names_occur_once() {
        let mut table = table();
        table.columns[1].name = "x".into();
        assert!(table.check_names().is_err());
    }
}
