//! How values of the data model are stored: as numbers, texts and words in the rows of arrays.

use ppum::crack::{CrackEnd, End, SegmentId};
use ppum::dataset::{GrowthStop, Ring, StressState, TipStatus, WarningKind};
use ppum::function::{Cut, CutBranch, Role};
use ppum::mesh::Shape;
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

use crate::content::ElementType;

/// A value that is a row of an array, or an attribute.
pub(crate) trait StoredValue: Clone {
    type Element: ElementType + Default;
    /// The shape of an attribute; an array has one more extent, its rows.
    const SHAPE: &'static [u64] = &[];

    /// Adds its elements to others; none if the format has no word for it.
    fn store(&self, elements: &mut Vec<Self::Element>) -> Option<()>;

    /// The value in a row. Mistakes in it are reported, and another takes its place.
    fn restore(row: usize, elements: &[Self::Element], report: &mut dyn FnMut(String)) -> Self;

    /// Takes the place of what cannot be read.
    fn blank() -> Self {
        Self::restore(0, &vec![Self::Element::default(); Self::width()], &mut |_| {})
    }

    /// The number of elements.
    fn width() -> usize {
        Self::SHAPE.iter().product::<u64>() as usize
    }
}

macro_rules! plain {
    ($($type:ty),*) => {$(
        impl StoredValue for $type {
            type Element = Self;

            fn store(&self, elements: &mut Vec<Self>) -> Option<()> {
                elements.push(self.clone());
                Some(())
            }

            fn restore(_: usize, elements: &[Self], _: &mut dyn FnMut(String)) -> Self {
                elements[0].clone()
            }
        }
    )*};
}

plain!(f64, u8, u32, u64, i64, String);

/// Values of several numbers, each a type, the numbers' type and how many, and both ways.
macro_rules! numbers {
    ($($type:ty: [$element:ty; $width:literal], $store:expr, $restore:expr;)*) => {$(
        impl StoredValue for $type {
            type Element = $element;
            const SHAPE: &'static [u64] = &[$width];

            fn store(&self, elements: &mut Vec<$element>) -> Option<()> {
                let store: fn(&Self) -> [$element; $width] = $store;
                elements.extend(store(self));
                Some(())
            }

            fn restore(row: usize, elements: &[$element], report: &mut dyn FnMut(String)) -> Self {
                type Restore = fn([$element; $width], usize, &mut dyn FnMut(String)) -> $type;
                let restore: Restore = $restore;
                restore(std::array::from_fn(|k| elements[k]), row, report)
            }
        }
    )*};
}

numbers! {
    [u32; 2]: [u32; 2], |v| *v, |v, _, _| v;
    [Option<u32>; 2]: [i64; 2], |v| v.map(|index| index.map_or(-1, i64::from)),
        |v, _, report| v.map(|number| index(number, report));
    Vec2: [f64; 2], |p| [p.x, p.y], |[x, y], _, _| vec2(x, y);
    // NaN where there is none
    Option<Vec2>: [f64; 2], |p| p.map_or([f64::NAN; 2], <[f64; 2]>::from),
        |[x, y], _, _| (!x.is_nan() || !y.is_nan()).then_some(vec2(x, y));
    [Vec2; 2]: [f64; 4], |[a, b]| [a.x, a.y, b.x, b.y],
        |[x0, y0, x1, y1], _, _| [vec2(x0, y0), vec2(x1, y1)];
    Rect: [f64; 4], |c| [c.min.x, c.min.y, c.max.x, c.max.y],
        |[x0, y0, x1, y1], _, _| Rect::new(vec2(x0, y0), vec2(x1, y1));
    Ring: [f64; 4], |r| [r.r1, r.r2, r.k1, r.k2], |[r1, r2, k1, k2], _, _| Ring { r1, r2, k1, k2 };
    Cut: [i64; 4],
        |cut| {
            let SegmentId { crack, segment } = cut.segment;
            [crack.into(), segment.into(), cut.left.number(), cut.right.number()]
        },
        |numbers, row, report| cut(numbers).unwrap_or_else(|| {
            report(format!("row {row} is no cut"));
            let segment = SegmentId { crack: 0, segment: 0 };
            Cut { segment, left: CutBranch::Outside, right: CutBranch::Outside }
        });
}

/// Crack, segment, and the numbers of what follows on the left and on the right.
fn cut([crack, segment, left, right]: [i64; 4]) -> Option<Cut> {
    let index = |number: i64| u32::try_from(number).ok();
    let segment = SegmentId { crack: index(crack)?, segment: index(segment)? };
    Some(Cut { segment, left: CutBranch::of_number(left)?, right: CutBranch::of_number(right)? })
}

/// NaN stands for what is not known.
impl StoredValue for Option<f64> {
    type Element = f64;

    fn store(&self, elements: &mut Vec<f64>) -> Option<()> {
        self.unwrap_or(f64::NAN).store(elements)
    }

    fn restore(_: usize, elements: &[f64], _: &mut dyn FnMut(String)) -> Self {
        elements.first().copied().filter(|value| !value.is_nan())
    }
}

/// −1 stands for no index.
impl StoredValue for Option<u32> {
    type Element = i64;

    fn store(&self, elements: &mut Vec<i64>) -> Option<()> {
        self.map_or(-1, i64::from).store(elements)
    }

    fn restore(_: usize, elements: &[i64], report: &mut dyn FnMut(String)) -> Self {
        index(elements[0], report)
    }
}

fn index(number: i64, report: &mut dyn FnMut(String)) -> Option<u32> {
    let index = u32::try_from(number).ok();
    if index.is_none() && number != -1 {
        report(format!("{number} is neither an index nor -1"));
    }
    index
}

/// The code of a warning, whether it is known here or not.
impl StoredValue for WarningKind {
    type Element = String;

    fn store(&self, elements: &mut Vec<String>) -> Option<()> {
        self.to_string().store(elements)
    }

    fn restore(_: usize, elements: &[String], _: &mut dyn FnMut(String)) -> Self {
        elements[0].as_str().into()
    }
}

/// Words of a closed set of values.
pub(crate) type WordTable<T> = [(T, &'static str)];

/// A value that is stored as a word.
pub(crate) trait StoredWord: Copy + PartialEq + 'static {
    const WORDS: &'static WordTable<Self>;

    /// The value that has its word.
    fn kind(self) -> Self {
        self
    }

    /// Its word, if the format has one.
    fn word(self) -> Option<&'static str> {
        Self::WORDS.iter().find(|(value, _)| *value == self.kind()).map(|(_, word)| *word)
    }
}

/// The value of a word.
///
/// # Errors
///
/// A message that lists the words known here.
pub(crate) fn value<T: Clone>(words: &WordTable<T>, word: &str) -> Result<T, String> {
    words.iter().find(|(_, w)| *w == word).map(|(v, _)| v.clone()).ok_or_else(|| {
        let known: Vec<&str> = words.iter().map(|(_, w)| *w).collect();
        format!("unknown word `{word}`, expected one of: {}", known.join(", "))
    })
}

impl<T: StoredWord> StoredValue for T {
    type Element = String;

    fn store(&self, elements: &mut Vec<String>) -> Option<()> {
        self.word()?.to_owned().store(elements)
    }

    fn restore(_: usize, elements: &[String], report: &mut dyn FnMut(String)) -> Self {
        value(T::WORDS, &elements[0]).unwrap_or_else(|message| {
            report(message);
            T::WORDS[0].0
        })
    }
}

/// The kind of an end of a crack, and whether the crack has arcs: readers of files before 1.8 do
/// not know the words of those.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StoredEnd {
    pub(crate) kind: CrackEnd,
    pub(crate) is_curved: bool,
}

impl StoredWord for StoredEnd {
    const WORDS: &'static WordTable<Self> = &[
        (Self { kind: CrackEnd::Tip, is_curved: false }, "tip"),
        (Self { kind: CrackEnd::Mouth, is_curved: false }, "mouth"),
        (Self { kind: CrackEnd::Junction, is_curved: false }, "junction"),
        (Self { kind: CrackEnd::Tip, is_curved: true }, "curved-tip"),
        (Self { kind: CrackEnd::Mouth, is_curved: true }, "curved-mouth"),
        (Self { kind: CrackEnd::Junction, is_curved: true }, "curved-junction"),
    ];
}

/// The kinds of a crack's first and last point.
impl StoredValue for [StoredEnd; 2] {
    type Element = String;
    const SHAPE: &'static [u64] = &[2];

    fn store(&self, elements: &mut Vec<String>) -> Option<()> {
        self.iter().try_for_each(|end| end.store(elements))
    }

    fn restore(row: usize, elements: &[String], report: &mut dyn FnMut(String)) -> Self {
        [0, 1].map(|k| StoredEnd::restore(row, &elements[k..], report))
    }
}

/// An empty text stands for no word.
impl<T: StoredWord> StoredValue for Option<T> {
    type Element = String;

    fn store(&self, elements: &mut Vec<String>) -> Option<()> {
        self.map_or(Some(""), StoredWord::word)?.to_owned().store(elements)
    }

    fn restore(_: usize, elements: &[String], report: &mut dyn FnMut(String)) -> Self {
        let word = elements.first().filter(|word| !word.is_empty())?;
        value(T::WORDS, word).map_err(report).ok()
    }
}

macro_rules! words {
    ($($type:ty: $($value:ident $word:literal),*;)*) => {
        $(impl StoredWord for $type {
            const WORDS: &'static WordTable<Self> = &[$((Self::$value, $word)),*];
        })*
    };
}

words! {
    StressState: PlaneStrain "plane-strain", PlaneStress "plane-stress", Axisymmetric "axisymmetric";
    End: Start "start", Last "last";
    GrowthStop: NoTips "no-tips", AllHeld "all-held", Fracture "fracture",
        PieceComesOff "piece-comes-off", Unsolvable "unsolvable";
}

impl StoredWord for Role {
    const WORDS: &'static WordTable<Self> = &Self::NAMES;
}

/// Kinds of what the data model tells apart by other means.
macro_rules! kinds {
    ($($type:ident: $first:ident $first_word:literal $(, $value:ident $word:literal)*;)*) => {
        $(#[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub(crate) enum $type {
            #[default]
            $first,
            $($value),*
        })*

        words! { $($type: $first $first_word $(, $value $word)*;)* }
    };
}

kinds! {
    EquationKind: Elasticity "elasticity", Eigenstrain "eigenstrain", Anisotropic "anisotropic", Poisson "poisson",
        None "none", AxisymmetricPoisson "axisymmetric-poisson";
    HoleKind: Circle "circle", Polygon "polygon", Outside "outside",
        CurvedPolygon "curved-polygon", CurvedOutside "curved-outside";
    // readers of files before 1.2 know the first alone
    DomainKind: Box "box", BoxWithHoles "box-with-holes", Mesh "mesh";
    PartitionKind: Boxes "shepard-box", Mesh "mesh";
    FunctionTag: One "one", Side "side", Formula "formula", Component "component", Level "level";
    FrameKind: World "world", Fixed "fixed", Tip "tip", Levels "levels";
}

/// An index beside the word says which thing a tip meets.
impl StoredWord for TipStatus {
    const WORDS: &'static WordTable<Self> = &[
        (Self::Unknown, "unknown"),
        (Self::Grows, "grows"),
        (Self::LeavesBody, "leaves-plate"),
        (Self::MeetsAxis, "meets-axis"),
        (Self::MeetsHole(0), "meets-hole"),
        (Self::MeetsCrack(0), "meets-crack"),
        (Self::Waits, "waits"),
        (Self::Held, "held"),
        (Self::Closed, "closed"),
        (Self::MeetsItself, "meets-itself"),
        (Self::Joined, "joined"),
    ];

    fn kind(self) -> Self {
        match self {
            Self::MeetsHole(_) => Self::MeetsHole(0),
            Self::MeetsCrack(_) => Self::MeetsCrack(0),
            other => other,
        }
    }
}

/// Weight functions that have a name, and none for a formula.
pub(crate) const WEIGHTS: &WordTable<Option<WeightFunction>> = &[
    (Some(WeightFunction::Linear), "linear"),
    (Some(WeightFunction::Quadratic), "quadratic"),
    (Some(WeightFunction::Cubic), "cubic"),
    (None, "formula"),
];

/// Values with numbers, 0, 1, …, and their words in messages.
macro_rules! codes {
    ($($type:ty: $codes:expr;)*) => {$(
        impl StoredValue for $type {
            type Element = u8;

            fn store(&self, elements: &mut Vec<u8>) -> Option<()> {
                let codes: &WordTable<Self> = $codes;
                let code = codes.iter().position(|(value, _)| value == self)?;
                (code as u8).store(elements)
            }

            fn restore(row: usize, elements: &[u8], report: &mut dyn FnMut(String)) -> Self {
                let codes: &WordTable<Self> = $codes;
                codes.get(usize::from(elements[0])).map_or_else(|| {
                    let all = codes.iter().enumerate().map(|(k, (_, word))| format!("{k} ({word})"));
                    let all = all.collect::<Vec<_>>().join(", ");
                    report(format!("entry {row} is {}, expected one of: {all}", elements[0]));
                    codes[0].0
                }, |(value, _)| *value)
            }
        }
    )*};
}

codes! {
    Shape: &[(Self::Triangle, "triangle"), (Self::Square, "square")];
    PolynomialSpace: &[(Self::Total, "total degree"), (Self::Tensor, "tensor product")];
    // whether a level field is not negative
    bool: &[(false, "below"), (true, "above")];
}
