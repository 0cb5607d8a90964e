//! Cracks, tips, the border of the body, its supports and loads, and isolines as points and lines
//! (`.vtp`), to lie over a mesh.

use std::io::{self, Write};

use ppum::crack::tips;
use ppum::dataset::{Dataset, TipIntensity};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::vec2::{Rect, Vec2, vec2};

use super::arcs::with_polygons;
use super::borders::{ExportSegment, LineRequest, SAME, borders, longest};
use super::torn::Torn;
use super::vtu::{FileNotes, array, flat, numbers, write_texts};
use crate::image::body::BodyView;
use crate::image::boundary::BoundarySamples;
use crate::image::engine::Engine;
use crate::image::error::ImageError;
use crate::image::mirror_lines::MirrorLines;
use crate::image::subject::ImageSubject;
use crate::request::overlays::IsolineLevels;
use crate::request::page_style::DEFAULT_SIZE;
use crate::request::region::{ImageExtent, ViewRegion};

/// Distance of points with supports and loads, in parts of the longer side of the domain.
const SPACING: f64 = 0.04;

/// Points and lines of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct PolylineData {
    /// Tips, supports and loads.
    pub points: Vec<Feature>,
    /// Cracks, the border where it bounds the body, rims of holes among it, and isolines.
    pub lines: Vec<Feature>,
}

/// A point or a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// The kind of the feature.
    pub kind: FeatureKind,
    /// Its points, one or several.
    pub points: Vec<Vec2>,
}

/// The kind of a point or line.
#[derive(Clone, Debug, PartialEq)]
pub enum FeatureKind {
    /// A segment of the border.
    Border,
    /// A segment of the crack of a number.
    Crack(u32),
    /// A tip of the crack of a number, with its factors where they are known.
    Tip(u32, Option<TipIntensity>),
    /// An isoline of a level.
    Isoline(f64),
    /// A point whose displacement is held, in x and in y.
    Support([bool; 2]),
    /// A point with a traction.
    Load(Vec2),
    /// A line along which elements of a mesh are cut.
    Cut,
}

impl FeatureKind {
    /// Its number in the array `kind`.
    fn number(&self) -> u8 {
        match self {
            Self::Border => 0,
            Self::Crack(_) => 1,
            Self::Tip(..) => 2,
            Self::Isoline(_) => 3,
            Self::Support(_) => 4,
            Self::Load(_) => 5,
            Self::Cut => 6,
        }
    }

    /// The crack, −1 if there is none.
    fn crack(&self) -> i32 {
        match self {
            Self::Crack(crack) | Self::Tip(crack, _) => *crack as i32,
            _ => -1,
        }
    }

    /// A number of a tip, NaN where it is not known and of all else.
    fn of_tip(&self, value: impl Fn(&TipIntensity) -> Option<f64>) -> f64 {
        match self {
            Self::Tip(_, Some(found)) => value(found).unwrap_or(f64::NAN),
            _ => f64::NAN,
        }
    }

    /// The level of an isoline, else NaN.
    fn level(&self) -> f64 {
        if let Self::Isoline(level) = self { *level } else { f64::NAN }
    }

    /// The traction of a load, else zero.
    fn traction(&self) -> Vec2 {
        if let Self::Load(traction) = self { *traction } else { Vec2::ZERO }
    }

    /// One for each direction that a support holds.
    fn held(&self) -> [u8; 2] {
        let held = if let Self::Support(held) = self { *held } else { [false; 2] };
        held.map(u8::from)
    }
}

impl PolylineData {
    /// Those of a field's step, without isolines; supports and loads if the dataset has its
    /// problem.
    #[must_use]
    pub fn of(dataset: &Dataset, field: &Field<'_>) -> Self {
        let domain = with_polygons(field.domain);
        let bounds = &domain.bounds;
        let near = SAME * longest(bounds);
        let around = Rect::around(bounds.center(), bounds.size() * 0.5 + vec2(near, near));
        let all = borders(field, &domain, LineRequest::NONE).into_iter();
        let of_body = all.filter(|ExportSegment { ends: [a, b], .. }| {
            let middle = (*a + *b) / 2.0;
            let is_cut = |hole: &Hole| hole.contains(middle) && hole.rim_distance(middle) > near;
            around.contains(middle) && !domain.holes.iter().any(is_cut)
        });
        let segment = |ExportSegment { ends, kind }: ExportSegment| Feature {
            kind: kind
                .crack
                .map_or(FeatureKind::Border, |segment| FeatureKind::Crack(segment.crack)),
            points: ends.to_vec(),
        };
        let points = tips_of(field).chain(stations(dataset, SPACING * longest(bounds))).collect();
        let lines = of_body.map(segment);
        let Some(mesh) = field.step.partition.mesh() else {
            return Self { points, lines: lines.collect() };
        };
        let of_elements = Torn::of_elements(field, mesh).element_lines(field).into_iter();
        let kind = |is_cut| if is_cut { FeatureKind::Cut } else { FeatureKind::Border };
        let of_elements =
            of_elements.map(|(is_cut, points)| Feature { kind: kind(is_cut), points });
        let cracks = lines.filter(|line| matches!(line.kind, FeatureKind::Crack(_)));
        Self { points, lines: cracks.chain(of_elements).collect() }
    }

    /// Adds the isolines that an image of the whole domain has by default.
    ///
    /// # Errors
    /// The errors of isolines of an image: see [`ImageSubject::isolines`].
    pub fn add_isolines(
        &mut self,
        subject: &ImageSubject<'_>,
        levels: &IsolineLevels,
        watcher: &dyn Watcher,
    ) -> Result<(), ImageError> {
        let extent = ImageExtent { pixels: DEFAULT_SIZE, may_shrink: false, margin: 0.0 };
        let field = subject.field;
        let view = ViewRegion::default().seen(field.domain.bounds, field, extent)?;
        let body = BodyView::new(field, view, MirrorLines::default());
        let found = subject.isolines(&body, levels, &Engine::processor(watcher))?;
        self.lines.extend(found.iter().map(|line| Feature {
            kind: FeatureKind::Isoline(line.level),
            points: line.polyline().into_iter().map(|p| view.center + p).collect(),
        }));
        Ok(())
    }

    fn kinds(&self) -> impl Iterator<Item = &FeatureKind> {
        self.points.iter().chain(&self.lines).map(|feature| &feature.kind)
    }
}

fn tips_of(field: &Field<'_>) -> impl Iterator<Item = Feature> {
    let step = field.step;
    tips(&step.cracks).map(|tip| {
        let known = step.intensities.iter().find(|intensity| intensity.tip == tip);
        Feature {
            kind: FeatureKind::Tip(tip.crack, known.cloned()),
            points: vec![step.cracks[tip.crack as usize].end_point(tip.end)],
        }
    })
}

/// Points with supports and loads.
fn stations(dataset: &Dataset, spacing: f64) -> impl Iterator<Item = Feature> {
    let BoundarySamples { supports, loads } =
        BoundarySamples::of(dataset, spacing).unwrap_or_default();
    let feature = |kind, at| Feature { kind, points: vec![at] };
    let supports = supports.into_iter().filter(|s| !s.yields);
    let supports = supports.map(move |s| feature(FeatureKind::Support(s.held), s.at));
    supports.chain(loads.into_iter().map(move |l| feature(FeatureKind::Load(l.traction), l.at)))
}

/// Writes points and lines.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut dyn Write, lines: &PolylineData, about: &FileNotes) -> io::Result<()> {
    let [verts, sizes] = [&lines.points, &lines.lines]
        .map(|all| all.iter().map(|feature| feature.points.len()).collect::<Vec<_>>());
    let places = lines.points.iter().chain(&lines.lines).flat_map(|feature| &feature.points);
    let points: Vec<f64> = places.copied().flat_map(flat).collect();
    super::vtu::write_head(out, "PolyData")?;
    writeln!(out, "<FieldData>")?;
    write_texts(out, &about.texts)?;
    writeln!(out, "</FieldData>")?;
    writeln!(
        out,
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\">",
        points.len() / 3,
        verts.len(),
        sizes.len()
    )?;
    writeln!(out, "<Points>")?;
    numbers(out, "Points", "NumberOfComponents=\"3\"", &points)?;
    writeln!(out, "</Points>")?;
    write_cells(out, "Verts", 0, &verts)?;
    write_cells(out, "Lines", verts.len(), &sizes)?;
    write_arrays(out, lines)?;
    writeln!(out, "</Piece>\n</PolyData>\n</VTKFile>")
}

/// Cells of so many points each, which follow each other from the first one on.
fn write_cells(out: &mut dyn Write, kind: &str, first: usize, sizes: &[usize]) -> io::Result<()> {
    let bytes = |numbers: &mut dyn Iterator<Item = usize>| -> Vec<u8> {
        numbers.flat_map(|number| (number as i32).to_le_bytes()).collect()
    };
    let mut ends = sizes.iter().scan(0, |end, size| {
        *end += size;
        Some(*end)
    });
    let points = sizes.iter().sum::<usize>();
    writeln!(out, "<{kind}>")?;
    array(out, "Int32", "connectivity", "", &bytes(&mut (first..first + points)))?;
    array(out, "Int32", "offsets", "", &bytes(&mut ends))?;
    writeln!(out, "</{kind}>")
}

fn write_arrays(out: &mut dyn Write, lines: &PolylineData) -> io::Result<()> {
    let bytes =
        |number: fn(&FeatureKind) -> Vec<u8>| lines.kinds().flat_map(number).collect::<Vec<_>>();
    writeln!(out, "<CellData>")?;
    array(out, "UInt8", "kind", "", &bytes(|kind| vec![kind.number()]))?;
    array(out, "Int32", "crack", "", &bytes(|kind| kind.crack().to_le_bytes().to_vec()))?;
    array(out, "UInt8", "held", "NumberOfComponents=\"2\"", &bytes(|kind| kind.held().to_vec()))?;
    type Value = fn(&TipIntensity) -> Option<f64>;
    let values: [(&str, Value); 5] = [
        ("K_I", |tip| Some(tip.k1)),
        ("K_II", |tip| Some(tip.k2)),
        ("error", |tip| tip.error),
        ("T", |tip| tip.t_stress),
        ("J", |tip| tip.j),
    ];
    for (name, value) in values {
        numbers(out, name, "", &lines.kinds().map(|kind| kind.of_tip(value)).collect::<Vec<_>>())?;
    }
    numbers(out, "level", "", &lines.kinds().map(FeatureKind::level).collect::<Vec<_>>())?;
    let tractions: Vec<f64> = lines.kinds().flat_map(|kind| flat(kind.traction())).collect();
    numbers(out, "traction", "NumberOfComponents=\"3\"", &tractions)?;
    writeln!(out, "</CellData>")
}
