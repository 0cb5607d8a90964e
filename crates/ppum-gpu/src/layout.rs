//! Records that shaders read: declared once, here, and written out as WGSL.

/// Declares a record of numbers: a Rust structure, its words in the order of its fields, and the
/// same structure in WGSL.
///
/// Fields are ordered from the strictest alignment to the loosest, vectors first, so that neither
/// side has gaps; a test checks every record against WGSL's rules.
macro_rules! record {
    (
        $(#[$about:meta])*
        $name:ident { $( $(#[$what:meta])* $field:ident : $kind:ident, )+ }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default)]
        pub(crate) struct $name {
            $( $(#[$what])* pub(crate) $field: $crate::layout::kinds::$kind, )+
        }

        impl $name {
            /// Names and types of the fields in WGSL.
            pub(crate) const MEMBERS: &'static [(&'static str, &'static str)] = &[$(
                (stringify!($field), <$crate::layout::kinds::$kind as $crate::layout::GpuWords>::WGSL),
            )+];

            /// The words of all fields, up to a multiple of 16 bytes.
            pub(crate) fn words(&self) -> Vec<u32> {
                let mut words = Vec::new();
                $( $crate::layout::GpuWords::push(&self.$field, &mut words); )+
                words.resize(words.len().next_multiple_of(4), 0);
                words
            }
        }
    };
}

pub(crate) use record;

/// A WGSL structure with these members; `before` returns the text in front of each, by its index.
pub(crate) fn structure(
    name: &str,
    members: &[(&str, &str)],
    before: impl Fn(usize) -> String,
) -> String {
    let line =
        |(k, (name, kind)): (usize, &(&str, &str))| format!("    {}{name}: {kind},\n", before(k));
    let members: String = members.iter().enumerate().map(line).collect();
    format!("struct {name} {{\n{members}}}\n")
}

/// Names of the field types of records.
#[expect(non_camel_case_types, reason = "they are the names of WGSL")]
pub(crate) mod kinds {
    pub(crate) type f32 = std::primitive::f32;
    pub(crate) type u32 = std::primitive::u32;
    pub(crate) type vec2f = [std::primitive::f32; 2];
    pub(crate) type vec2u = [std::primitive::u32; 2];
}

/// A type of a field.
pub(crate) trait GpuWords {
    /// Its name in WGSL.
    const WGSL: &'static str;
    /// Appends its words.
    fn push(&self, words: &mut Vec<u32>);
}

macro_rules! words {
    ($($kind:ty, $name:literal, |$value:ident| $words:expr;)+) => { $(
        impl GpuWords for $kind {
            const WGSL: &'static str = $name;
            fn push(&self, words: &mut Vec<u32>) {
                let $value = self;
                words.extend($words);
            }
        }
    )+ };
}

words! {
    f32, "f32", |v| [v.to_bits()];
    u32, "u32", |v| [*v];
    [f32; 2], "vec2<f32>", |v| v.map(f32::to_bits);
    [u32; 2], "vec2<u32>", |v| *v;
}

/// The bytes of words, as devices read them.
pub(crate) fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().map(|word| word.to_le_bytes()).collect::<Vec<_>>().into_flattened()
}

/// A number of double precision as the sum of two of single precision.
pub(crate) fn halves(value: f64) -> [f32; 2] {
    let high = value as f32;
    [high, (value - f64::from(high)) as f32]
}

/// The halves of a number, the first of them a multiple of `quantum`. Differences of such multiples
/// are exact below 2²⁴ quanta.
pub(crate) fn halves_by(quantum: f64, value: f64) -> [f32; 2] {
    let high = ((value / quantum).round() * quantum) as f32;
    [high, (value - f64::from(high)) as f32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::quads::{QUAD_BYTES, QuadRecord};
    use crate::frame::view_data::ViewRecord;

    /// Vectors of two begin with an even word, so WGSL puts nothing between members.
    #[test]
    fn records_have_no_gaps() {
        for members in [ViewRecord::MEMBERS, QuadRecord::MEMBERS] {
            let mut word = 0;
            for (name, kind) in members {
                let size = if kind.starts_with("vec2") { 2 } else { 1 };
                assert_eq!(word % size, 0, "{name}");
                word += size;
            }
        }
        assert_eq!(4 * QuadRecord::default().words().len() as u64, QUAD_BYTES);
    }

    #[test]
    fn halves_keep_48_bits() {
        for value in [0.1, -1.0 / 3.0, 12345.678901234, 1e-12] {
            let [high, low] = halves(value).map(f64::from);
            assert!((high + low - value).abs() <= value.abs() * 2f64.powi(-47), "{value}");
        }
    }
}
