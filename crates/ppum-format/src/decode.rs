//! Content → dataset: the layout of FORMAT.md, group by group, every name and shape checked.

use ppum::crack::{Crack, CrackEnd, TipId};
use ppum::dataset::{
    Attribute, Dataset, Equation, FieldData, Material, Partition, Record, Ring, Step, TipIntensity,
};
use ppum::function::{Declared, Frame, Function, FunctionKind};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

use crate::content::{Array, Content, Element, Values, join};
use crate::error::ReadError;
use crate::names::{CRACK_ENDS, ENDS, STRESS_STATES, Words, value};

type Read<T> = Result<T, ReadError>;

/// Is this a dataset, and of a version that can be read here?
pub(crate) fn check_version(content: &Content) -> Read<()> {
    let is_text = |a: &Array| matches!(&a.values, Values::Text(t) if t.concat() == "ppum");
    if !content.get("@format").is_some_and(is_text) {
        return Err(ReadError::NotADataset);
    }
    match content.get("@format_version").map(|a| &a.values) {
        Some(Values::U32(v)) if v.len() == 2 => match v[0] {
            0 => Err(ReadError::object("@format_version", "the major version is at least 1")),
            major if major > crate::FORMAT_VERSION.0 => {
                Err(ReadError::TooNew { major: major.into(), minor: v[1].into() })
            }
            _ => Ok(()),
        },
        _ => Err(ReadError::object("@format_version", "expected two u32: major, minor")),
    }
}

/// The dataset in a content. Shapes and words are right afterwards, meaning is not yet checked.
pub(crate) fn dataset(mut content: Content) -> Read<Dataset> {
    let mut root = Group { path: String::new(), content: &mut content };
    Ok(Dataset {
        title: root.attribute("title")?,
        program: root.attribute("program")?,
        problem: if root.has("problem") { Some(root.scalar("problem")?) } else { None },
        domain: domain(&mut root.group("domain"))?,
        equation: equation(&mut root.group("equation"))?,
        quantities: Vec::new(),
        tables: Vec::new(),
        steps: numbered(&mut root, "steps", step)?,
    })
}

/// A place in the file to take arrays from. What is taken is gone: nothing is copied.
struct Group<'a> {
    path: String,
    content: &'a mut Content,
}

impl Group<'_> {
    fn group(&mut self, name: &str) -> Group<'_> {
        Group { path: self.path_of(name), content: self.content }
    }

    fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    fn has(&self, name: &str) -> bool {
        self.content.contains_key(&self.path_of(name))
    }

    /// True if there is anything in the group.
    fn exists(&self) -> bool {
        let path = self.path.as_str();
        let from_here = self.content.range(path.to_owned()..).map(|(key, _)| key);
        let mut rests = from_here.map_while(|key| key.strip_prefix(path));
        rests.any(|rest| rest.starts_with(['/', '@']))
    }

    fn error(&self, name: &str, problem: impl Into<String>) -> ReadError {
        ReadError::object(&self.path_of(name), problem)
    }

    /// The values of an array of the given shape.
    fn take<T: Element>(&mut self, key: &str, shape: &[Extent]) -> Read<Vec<T>> {
        let array = self.content.remove(key).ok_or_else(|| ReadError::object(key, "is missing"))?;
        let fits = array.shape.len() == shape.len()
            && array.shape.iter().zip(shape).all(|(n, extent)| extent.allows(*n));
        if !fits {
            let wanted: Vec<String> = shape.iter().map(Extent::to_string).collect();
            return Err(ReadError::object(
                key,
                format!("has shape {:?}, expected [{}]", array.shape, wanted.join(", ")),
            ));
        }
        T::unwrap(array.values).map_err(|other| {
            ReadError::object(key, format!("has type {}, expected {}", other.type_name(), T::NAME))
        })
    }

    fn scalar<T: Element>(&mut self, name: &str) -> Read<T> {
        let key = self.path_of(name);
        self.one(&key)
    }

    fn attribute<T: Element>(&mut self, name: &str) -> Read<T> {
        let key = self.path_of(&format!("@{name}"));
        self.one(&key)
    }

    fn one<T: Element>(&mut self, key: &str) -> Read<T> {
        let value = self.take(key, &[])?.pop();
        value.ok_or_else(|| ReadError::object(key, "is empty"))
    }

    fn attribute_point(&mut self, name: &str) -> Read<Vec2> {
        let key = self.path_of(&format!("@{name}"));
        let p = self.take::<f64>(&key, &[Extent::Is(2)])?;
        Ok(vec2(p[0], p[1]))
    }

    /// A vector of any length.
    fn vector<T: Element>(&mut self, name: &str) -> Read<Vec<T>> {
        self.take(&self.path_of(name), &[Extent::Any])
    }

    /// A vector as long as another.
    fn column<T: Element>(&mut self, name: &str, length: usize) -> Read<Vec<T>> {
        self.take(&self.path_of(name), &[Extent::Is(length as u64)])
    }

    /// A matrix of `N` columns.
    fn rows<T: Element + Clone, const N: usize>(&mut self, name: &str) -> Read<Vec<[T; N]>> {
        let values = self.take::<T>(&self.path_of(name), &[Extent::Any, Extent::Is(N as u64)])?;
        Ok(values.as_chunks::<N>().0.to_vec())
    }

    fn points(&mut self, name: &str) -> Read<Vec<Vec2>> {
        Ok(self.rows(name)?.into_iter().map(Vec2::from).collect())
    }

    /// The rows of a matrix with a given number of them.
    fn matrix(&mut self, name: &str, rows: usize) -> Read<Vec<Vec<f64>>> {
        let key = self.path_of(name);
        let values = self.take::<f64>(&key, &[Extent::Is(rows as u64), Extent::Any])?;
        let columns = values.len().checked_div(rows).unwrap_or(0);
        Ok((0..rows).map(|k| values[k * columns..(k + 1) * columns].to_vec()).collect())
    }

    /// Compressed rows of `count` parts over `length` entries, as ranges.
    fn offsets(
        &mut self,
        name: &str,
        count: usize,
        length: usize,
    ) -> Read<Vec<std::ops::Range<usize>>> {
        let ends = self.column::<u64>(name, count + 1)?;
        let rising = ends.windows(2).all(|w| w[0] <= w[1]);
        if ends[0] != 0 || !rising || ends[count] != length as u64 {
            return Err(
                self.error(name, format!("must rise from 0 to the {length} entries it divides"))
            );
        }
        Ok(ends.windows(2).map(|w| w[0] as usize..w[1] as usize).collect())
    }

    fn word<T: Copy>(&self, words: &Words<T>, word: &str, name: &str) -> Read<T> {
        value(words, word).map_err(|problem| self.error(name, problem))
    }
}

/// What is allowed of one dimension of an array.
enum Extent {
    Any,
    Is(u64),
}

impl Extent {
    fn allows(&self, n: u64) -> bool {
        match self {
            Self::Any => true,
            Self::Is(expected) => n == *expected,
        }
    }
}

impl std::fmt::Display for Extent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Any => f.write_str("any"),
            Self::Is(n) => n.fmt(f),
        }
    }
}

/// The groups `0000`, `0001`, … of a group, as long as they go on.
fn numbered<T>(
    parent: &mut Group,
    name: &str,
    item: impl Fn(&mut Group) -> Read<T>,
) -> Read<Vec<T>> {
    let mut items = Vec::new();
    loop {
        let mut group = parent.group(&format!("{name}/{:04}", items.len()));
        if !group.exists() {
            return Ok(items);
        }
        items.push(item(&mut group)?);
    }
}

fn domain(group: &mut Group) -> Read<Rect> {
    expect_kind(group, "box")?;
    Ok(Rect::new(group.attribute_point("min")?, group.attribute_point("max")?))
}

fn expect_kind(group: &mut Group, expected: &'static str) -> Read<()> {
    let kind: String = group.attribute("kind")?;
    group.word(&[((), expected)], &kind, "@kind")
}

fn equation(group: &mut Group) -> Read<Equation> {
    let kind: String = group.attribute("kind")?;
    match kind.as_str() {
        "elasticity" => {
            let state: String = group.attribute("state")?;
            Ok(Equation::elasticity(Material {
                young: group.attribute("young")?,
                poisson: group.attribute("poisson")?,
                state: group.word(STRESS_STATES, &state, "@state")?,
            }))
        }
        "poisson" => Ok(Equation::poisson(group.attribute("conductivity")?)),
        _ => Err(group.error("@kind", format!("unknown equation `{kind}`"))),
    }
}

fn step(group: &mut Group) -> Read<Step> {
    Ok(Step {
        load: group.attribute("load")?,
        partition: partition(&mut group.group("partition"))?,
        cracks: cracks(&mut group.group("cracks"))?,
        functions: functions(&mut group.group("functions"))?,
        fields: numbered(group, "fields", field)?,
        attributes: optional(group, "attributes", attributes)?,
        intensities: optional(group, "intensities", intensities)?,
        history: optional(group, "history", history)?,
    })
}

/// What a group holds, nothing if it is not there.
fn optional<T>(
    parent: &mut Group,
    name: &str,
    items: impl Fn(&mut Group) -> Read<Vec<T>>,
) -> Read<Vec<T>> {
    let mut group = parent.group(name);
    if group.exists() { items(&mut group) } else { Ok(Vec::new()) }
}

fn partition(group: &mut Group) -> Read<Partition> {
    expect_kind(group, "shepard-box")?;
    let word: String = group.attribute("weight")?;
    let weight = WeightFunction::from_name(&word)
        .ok_or_else(|| group.error("@weight", format!("unknown weight function `{word}`")))?;
    if group.vector::<f64>("weight_breakpoints")? != weight.breakpoints() {
        return Err(group.error("weight_breakpoints", format!("are not those of `{word}`")));
    }
    let center = group.points("center")?;
    let point = group.column::<i64>("point", center.len())?;
    let point = point.into_iter().map(|p| point_index(group, p)).collect::<Read<_>>()?;
    Ok(Partition {
        weight,
        half: group.points("half")?,
        origin: group.points("origin")?,
        scale: group.points("scale")?,
        cell: group
            .rows("cell")?
            .into_iter()
            .map(|[x0, y0, x1, y1]| Rect::new(vec2(x0, y0), vec2(x1, y1)))
            .collect(),
        level: group.vector("level")?,
        point,
        points: group.points("points")?,
        center,
    })
}

fn point_index(group: &Group, p: i64) -> Read<Option<u32>> {
    match p {
        -1 => Ok(None),
        _ => u32::try_from(p)
            .map(Some)
            .map_err(|_| group.error("point", format!("{p} is neither an index nor -1"))),
    }
}

fn cracks(group: &mut Group) -> Read<Vec<Crack>> {
    let points = group.points("points")?;
    let ends = group.rows::<String, 2>("ends")?;
    let parts = group.offsets("offsets", ends.len(), points.len())?;
    let kind = |word: &str| -> Read<CrackEnd> { group.word(CRACK_ENDS, word, "ends") };
    std::iter::zip(parts, ends)
        .map(|(part, [start, last])| {
            Ok(Crack { points: points[part].to_vec(), ends: [kind(&start)?, kind(&last)?] })
        })
        .collect()
}

/// The columns of the function table that are not plain names.
struct Columns {
    crack: Vec<i64>,
    formula: Vec<String>,
    frame: Vec<String>,
    end: Vec<String>,
    origin: Vec<Vec2>,
    angle: Vec<f64>,
    parameters: Vec<Vec<(String, f64)>>,
}

fn functions(group: &mut Group) -> Read<Vec<Function>> {
    let names = group.vector::<String>("name")?;
    let n = names.len();
    let kinds = group.column::<String>("kind", n)?;
    let mut columns = Columns {
        crack: group.column("crack", n)?,
        formula: group.column("formula", n)?,
        frame: group.column("frame", n)?,
        end: group.column("frame_end", n)?,
        origin: group.points("frame_origin")?,
        angle: group.column("frame_angle", n)?,
        parameters: parameters(group, n)?,
    };
    if columns.origin.len() != n {
        return Err(group.error("frame_origin", format!("expected {n} rows")));
    }
    let function = |(k, (name, kind)): (usize, (String, String))| {
        Ok(Function { name, kind: columns.function_kind(group, k, &kind)? })
    };
    names.into_iter().zip(kinds).enumerate().map(function).collect()
}

fn parameters(group: &mut Group, functions: usize) -> Read<Vec<Vec<(String, f64)>>> {
    let names = group.vector::<String>("parameter_name")?;
    let values = group.column::<f64>("parameter_value", names.len())?;
    let parts = group.offsets("parameter_offsets", functions, names.len())?;
    let pairs: Vec<(String, f64)> = std::iter::zip(names, values).collect();
    Ok(parts.into_iter().map(|part| pairs[part].to_vec()).collect())
}

impl Columns {
    fn function_kind(&mut self, group: &Group, k: usize, kind: &str) -> Read<FunctionKind> {
        match kind {
            "one" => Ok(FunctionKind::One),
            "side" => Ok(FunctionKind::Side { crack: self.crack_index(group, k)? }),
            "formula" => Ok(FunctionKind::Formula {
                frame: self.frame(group, k)?,
                text: std::mem::take(&mut self.formula[k]),
                parameters: std::mem::take(&mut self.parameters[k]),
                declared: Declared::default(),
            }),
            _ => Err(group.error("kind", format!("function {k} is of unknown kind `{kind}`"))),
        }
    }

    fn frame(&self, group: &Group, k: usize) -> Read<Frame> {
        match self.frame[k].as_str() {
            "world" => Ok(Frame::World),
            "fixed" => Ok(Frame::Fixed { origin: self.origin[k], angle: self.angle[k] }),
            "tip" => Ok(Frame::Tip(TipId {
                crack: self.crack_index(group, k)?,
                end: group.word(ENDS, &self.end[k], "frame_end")?,
            })),
            other => Err(group.error("frame", format!("function {k} has unknown frame `{other}`"))),
        }
    }

    fn crack_index(&self, group: &Group, k: usize) -> Read<u32> {
        let crack = self.crack[k];
        u32::try_from(crack)
            .map_err(|_| group.error("crack", format!("function {k} has no crack ({crack})")))
    }
}

fn field(group: &mut Group) -> Read<FieldData> {
    let components = group.vector::<String>("components")?;
    Ok(FieldData {
        name: group.attribute("name")?,
        unit: group.attribute("unit")?,
        exact: if group.has("exact") { group.vector("exact")? } else { Vec::new() },
        patch_blocks: group.vector("patch_blocks")?,
        block_function: group.vector("block_function")?,
        block_degree: group.vector("block_degree")?,
        block_offset: group.vector("block_offset")?,
        coefficients: group.matrix("coefficients", components.len())?,
        components,
    })
}

fn attributes(group: &mut Group) -> Read<Vec<Attribute>> {
    let names = group.vector::<String>("name")?;
    let values = group.matrix("values", names.len())?;
    Ok(std::iter::zip(names, values).map(|(name, values)| Attribute { name, values }).collect())
}

fn intensities(group: &mut Group) -> Read<Vec<TipIntensity>> {
    let crack = group.vector::<u32>("crack")?;
    let n = crack.len();
    let end = group.column::<String>("end", n)?;
    let (k1, k2) = (group.column::<f64>("k1", n)?, group.column::<f64>("k2", n)?);
    let ring = |[r1, r2, k1, k2]: [f64; 4]| Ring { r1, r2, k1, k2 };
    let rings: Vec<Ring> = group.rows("rings")?.into_iter().map(ring).collect();
    let parts = group.offsets("ring_offsets", n, rings.len())?;
    let intensity = |(k, part): (usize, std::ops::Range<usize>)| {
        let tip = TipId { crack: crack[k], end: group.word(ENDS, &end[k], "end")? };
        Ok(TipIntensity { tip, k1: k1[k], k2: k2[k], rings: rings[part].to_vec() })
    };
    parts.into_iter().enumerate().map(intensity).collect()
}

fn history(group: &mut Group) -> Read<Vec<Record>> {
    let names = group.vector::<String>("name")?;
    let values = group.column::<f64>("value", names.len())?;
    let units = group.column::<String>("unit", names.len())?;
    let records = names.into_iter().zip(values).zip(units);
    Ok(records.map(|((name, value), unit)| Record { name, value, unit }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{checksum, encode, synthetic};

    fn content() -> Content {
        encode::content(&synthetic::dataset(1)).unwrap()
    }

    /// The object that decoding complains about.
    fn complaint(content: Content) -> Option<String> {
        match dataset(content) {
            Ok(_) => None,
            Err(ReadError::Object { object, .. }) => Some(object),
            Err(other) => panic!("unexpected error: {other}"),
        }
    }

    /// A group that goes missing as a whole is a shorter list, an item alone is an error.
    #[test]
    fn a_missing_item_is_named() {
        let optional = ["problem", "@format", "@format_version"];
        for key in content().keys() {
            let mut damaged = content();
            damaged.remove(key);
            match complaint(damaged) {
                Some(object) => assert_eq!(&object, key),
                None => {
                    assert!(optional.contains(&key.as_str()) || key.ends_with("exact"), "{key}")
                }
            }
        }
    }

    #[test]
    fn a_wrong_type_or_rank_is_named() {
        for key in content().keys().filter(|key| !key.starts_with("@format")) {
            let mut damaged = content();
            damaged.get_mut(key).unwrap().values = Values::Other("complex".into());
            assert_eq!(complaint(damaged).as_ref(), Some(key));
            let mut damaged = content();
            damaged.get_mut(key).unwrap().shape.push(1);
            assert_eq!(complaint(damaged).as_ref(), Some(key));
        }
    }

    #[test]
    fn unknown_words_are_named() {
        for (key, word) in [
            ("domain@kind", "disc"),
            ("equation@kind", "heat"),
            ("equation@state", "plane"),
            ("steps/0000/partition@kind", "mesh"),
            ("steps/0000/partition@weight", "sextic"),
        ] {
            let mut damaged = content();
            damaged.insert(key.into(), Array::scalar(word.to_owned()));
            let error = dataset(damaged).unwrap_err().to_string();
            let (group, name) = key.split_once('@').unwrap();
            assert!(
                error.contains(group) && error.contains(name) && error.contains(word),
                "{error}"
            );
        }
        for key in ["cracks/ends", "functions/kind", "functions/frame", "intensities/end"] {
            let key = format!("steps/0000/{key}");
            let mut damaged = content();
            let Values::Text(words) = &mut damaged.get_mut(&key).unwrap().values else {
                panic!("{key} holds words")
            };
            words.fill("sideways".into());
            // functions of other kinds have no frame
            assert_eq!(complaint(damaged), Some(key));
        }
    }

    #[test]
    fn lists_that_do_not_divide_are_named() {
        for key in ["cracks/offsets", "functions/parameter_offsets", "intensities/ring_offsets"] {
            let key = format!("steps/0000/{key}");
            for change in [
                |v: &mut Vec<u64>| v[0] = 1,
                |v: &mut Vec<u64>| *v.last_mut().unwrap() += 1,
                |v: &mut Vec<u64>| {
                    let n = v.len();
                    v[n - 2] = u64::MAX;
                },
            ] {
                let mut damaged = content();
                let Values::U64(offsets) = &mut damaged.get_mut(&key).unwrap().values else {
                    panic!("{key} holds offsets")
                };
                change(offsets);
                assert_eq!(complaint(damaged), Some(key.clone()));
            }
        }
    }

    #[test]
    fn versions() {
        let with = |version: [u32; 2]| {
            let mut content = content();
            content.insert("@format_version".into(), Array::vector(version));
            check_version(&content)
        };
        assert!(with([1, 0]).is_ok() && with([1, 9]).is_ok());
        assert!(matches!(with([2, 1]), Err(ReadError::TooNew { major: 2, minor: 1 })));
        assert!(matches!(with([0, 1]), Err(ReadError::Object { .. })));
        assert!(matches!(check_version(&Content::new()), Err(ReadError::NotADataset)));
    }

    #[test]
    fn unknown_groups_are_ignored() {
        let mut later = content();
        later.insert("steps/0000/later@kind".into(), Array::scalar(1.0));
        later.insert("steps/0000/fields/notes/text".into(), Array::vector([1u8]));
        let text = |content| format!("{:?}", dataset(content).unwrap());
        assert!(text(later) == text(content()));
    }

    #[test]
    fn the_checksum_is_optional_but_must_be_right() {
        let mut plain = content();
        assert!(checksum::verify(&mut plain).is_ok());
        let mut sealed = content();
        checksum::seal(&mut sealed);
        assert!(checksum::verify(&mut sealed.clone()).is_ok());
        sealed.insert("@title".into(), Array::scalar("another".to_owned()));
        assert!(matches!(checksum::verify(&mut sealed), Err(ReadError::Checksum { .. })));
    }
}
