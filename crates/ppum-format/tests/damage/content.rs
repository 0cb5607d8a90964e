//! Damage to what a file means: its named arrays.

use std::collections::BTreeMap;

use ppum_format::{ArrayValues, Arrays};

/// An array of a file.
#[derive(Clone)]
struct Array {
    shape: Vec<u64>,
    values: ArrayValues,
}

type Content = BTreeMap<String, Array>;

/// Does the same with the values of an array, whatever their type.
macro_rules! with_values {
    ($array:expr, $values:ident => $action:expr) => {
        match $array {
            ArrayValues::F64($values) => $action,
            ArrayValues::U8($values) => $action,
            ArrayValues::U32($values) => $action,
            ArrayValues::U64($values) => $action,
            ArrayValues::I64($values) => $action,
            ArrayValues::Text($values) => $action,
            ArrayValues::Other(_) => unreachable!("files with other types are not damaged"),
        }
    };
}

fn len(values: &ArrayValues) -> usize {
    with_values!(values, v => v.len())
}

/// True of the attributes with checksums.
fn is_checksum(name: &str) -> bool {
    ["@sha256", "@sha256_rest"].iter().any(|end| name.ends_with(end))
}

type RandomBelow<'a> = &'a mut dyn FnMut(usize) -> usize;

/// A damaged file.
#[derive(Clone, Debug)]
pub(crate) struct DamagedFile {
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
    /// The kind of damage, e.g. `truncated`.
    pub(crate) what: String,
    /// True if the checksum was made right again, or is not there: only the meaning can tell.
    pub(crate) is_sealed: bool,
}

/// A copy with one to three arrays changed; none if the file cannot be read, or the result
/// not written.
pub(super) fn damaged(file: &[u8], below: RandomBelow) -> Option<DamagedFile> {
    let arrays = Arrays::from_bytes(file).ok()?;
    let all = arrays.iter().map(|(name, shape, values)| {
        (name.to_owned(), Array { shape: shape.to_vec(), values: values.clone() })
    });
    let mut content: Content = all.collect();
    if content.is_empty()
        || content.values().any(|array| matches!(array.values, ArrayValues::Other(_)))
    {
        return None;
    }
    let count = content.keys().filter(|name| is_checksum(name)).count();
    let mut what = Vec::new();
    for _ in 0..=below(content.len().min(3)) {
        what.extend(change(&mut content, below));
    }
    let is_sealed = below(4) > 0;
    if is_sealed {
        content.retain(|name, _| !is_checksum(name));
    }
    let is_whole = content.keys().filter(|name| is_checksum(name)).count() == count;
    let mut arrays = Arrays::default();
    for (name, Array { shape, values }) in content {
        arrays.insert(&name, shape, values);
    }
    if is_sealed && below(3) > 0 {
        arrays.seal();
    }
    let bytes = arrays.to_bytes().ok()?;
    Some(DamagedFile {
        bytes,
        what: what.join(", "),
        is_sealed: is_sealed || !is_whole || count == 0,
    })
}

/// One array changed; there is one at least.
fn change(content: &mut Content, below: RandomBelow) -> Option<String> {
    let names: Vec<String> = content.keys().cloned().collect();
    let name = names[below(names.len())].clone();
    let other = names[below(names.len())].clone();
    let array = content.get_mut(&name)?;
    let what = match below(16) {
        0 => {
            content.remove(&name);
            "missing"
        }
        1 => {
            let copy = content.get(&other)?.clone();
            content.insert(name.clone(), copy);
            "another's"
        }
        2 => {
            let moved = content.remove(&name)?;
            content.insert(name.replace("0000", "0001") + "x", moved);
            "moved"
        }
        3 => {
            array.values = of_another_type(&array.values, below);
            "type"
        }
        4 => {
            reshape(array, below);
            "shape"
        }
        5 => {
            resize(array, below);
            "length"
        }
        6 if !name.contains('@') && below(8) == 0 => {
            *array = zeros(array, below);
            "zeros"
        }
        6 | 7 => {
            swap(&mut array.values, below);
            "swapped"
        }
        8 => {
            each(&mut array.values, below);
            "all values"
        }
        _ => {
            one(&mut array.values, below);
            "value"
        }
    };
    Some(format!("{name}: {what}"))
}

/// Returns as many values of another type.
fn of_another_type(values: &ArrayValues, below: RandomBelow) -> ArrayValues {
    let n = len(values);
    match below(6) {
        0 => ArrayValues::F64(vec![0.5; n]),
        1 => ArrayValues::U8(vec![1; n]),
        2 => ArrayValues::U32(vec![1; n]),
        3 => ArrayValues::U64(vec![0; n]),
        4 => ArrayValues::I64(vec![-1; n]),
        _ => ArrayValues::Text(vec!["1".to_owned(); n]),
    }
}

fn reshape(array: &mut Array, below: RandomBelow) {
    match below(4) {
        0 => array.shape.push(1),
        1 => array.shape.insert(0, 1),
        2 => array.shape.reverse(),
        _ => array.shape = vec![array.shape.iter().product()],
    }
}

/// Fewer or more rows.
fn resize(array: &mut Array, below: RandomBelow) {
    let Some(rows) = array.shape.first().copied() else { return };
    let row: u64 = array.shape[1..].iter().product();
    let rows = match below(4) {
        0 => 0,
        1 => rows.saturating_sub(1),
        2 => rows + 1,
        _ => 2 * rows,
    };
    array.shape[0] = rows;
    let n = (rows * row) as usize;
    with_values!(&mut array.values, v => v.resize(n, Default::default()));
}

/// Zeros of the same type and rank, far more than there were: they shrink to nothing.
fn zeros(array: &Array, below: RandomBelow) -> Array {
    let rows = 1_u64 << (16 + below(6));
    let mut shape = array.shape.clone();
    if let Some(first) = shape.first_mut() {
        *first = rows;
    }
    let n = shape.iter().product::<u64>().min(1 << 23) as usize;
    let values = match &array.values {
        ArrayValues::U8(_) => ArrayValues::U8(vec![0; n]),
        ArrayValues::U32(_) => ArrayValues::U32(vec![0; n]),
        ArrayValues::U64(_) => ArrayValues::U64(vec![0; n]),
        ArrayValues::I64(_) => ArrayValues::I64(vec![0; n]),
        ArrayValues::Text(_) => ArrayValues::Text(vec!["x".to_owned(); n.min(1 << 16)]),
        _ => ArrayValues::F64(vec![0.0; n]),
    };
    Array { shape, values }
}

fn swap(values: &mut ArrayValues, below: RandomBelow) {
    let n = len(values);
    if n == 0 {
        return;
    }
    let (a, b) = (below(n), below(n));
    with_values!(values, v => v.swap(a, b));
}

fn each(values: &mut ArrayValues, below: RandomBelow) {
    match values {
        ArrayValues::F64(v) => {
            let value = number(v.first().copied().unwrap_or(1.0), below);
            v.fill(value);
        }
        ArrayValues::U8(v) => v.fill(integer(below) as u8),
        ArrayValues::U32(v) => v.fill(integer(below) as u32),
        ArrayValues::U64(v) => v.fill(integer(below)),
        ArrayValues::I64(v) => v.fill(integer(below) as i64),
        ArrayValues::Text(v) => v.fill(text(below)),
        ArrayValues::Other(_) => {}
    }
}

fn one(values: &mut ArrayValues, below: RandomBelow) {
    let n = len(values);
    if n == 0 {
        return;
    }
    let at = below(n);
    match values {
        ArrayValues::F64(v) => v[at] = number(v[at], below),
        ArrayValues::U8(v) => v[at] = integer(below) as u8,
        ArrayValues::U32(v) => v[at] = integer(below) as u32,
        ArrayValues::U64(v) => v[at] = integer(below),
        ArrayValues::I64(v) => v[at] = integer(below) as i64,
        ArrayValues::Text(v) => v[at] = text(below),
        ArrayValues::Other(_) => {}
    }
}

/// A number that is none, or is far too large or small, or wrong.
fn number(old: f64, below: RandomBelow) -> f64 {
    const NUMBERS: [f64; 12] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN,
        5e-324,
        -5e-324,
        f64::MIN_POSITIVE,
        0.0,
        -0.0,
        1e160,
        1.0,
    ];
    match below(16) {
        k if k < NUMBERS.len() => NUMBERS[k],
        12 => -old,
        13 => old * 1e-200,
        14 => old * 1e200,
        _ => old + 1.0,
    }
}

fn integer(below: RandomBelow) -> u64 {
    match below(8) {
        0 => 0,
        1 => 1,
        2 => u64::MAX,
        3 => u64::MAX - 1,
        4 => 1 << 31,
        5 => 1 << 63,
        6 => u64::from(u32::MAX),
        _ => below(40) as u64,
    }
}

/// Words of the format, formulas that are none, and texts that try to break their reader.
fn text(below: RandomBelow) -> String {
    const WORDS: &str = "||one|side|formula|tip|world|fixed|start|last|mouth|junction|linear|cubic|box|ppum|\
        elasticity|poisson|shepard-box|plane-stress|displacement|potential|ux|u|x|t|theta|0|-1|1e999|1/0|0/0|\
        x +|sqrt(|y/r|1/x|table(curve, x)|dtable(surface, 9, 9, x, y)|table(surface, 1/0, x)|side(7)|side(0)|\
        side(4294967296)|sqrt(-1 - x^2)|exp(exp(exp(exp(9))))*x|let a = x; a^a|(1 - t)^2|1 - t|t - 1|ü\u{0301}\u{202e}|\
        \u{1}|\n|a\tb|../../x|%s%n|sha256|r^-1|log(r)*theta|sign(x)*floor(1e300*y)|if(x > y, r, 1e308*r)";
    match below(8) {
        0 => {
            let piece = ["(", "-", "sqrt(", "x+", "let a = (", "x^", "1,", "not "][below(8)];
            piece.repeat(1 << below(17))
        }
        1 => (0..1 << below(12)).map(|k| format!("+ sin({k}*x)^{k}")).collect(),
        _ => {
            let words: Vec<&str> = WORDS.split('|').map(str::trim_start).collect();
            words[below(words.len())].to_owned()
        }
    }
}
