//! Cracks, tips and the border of the body as points and lines (`.vtp`), to lie over a mesh.

use std::io::{self, Write};

use ppum::crack::{TipId, tips};
use ppum::dataset::TipIntensity;
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::vec2::{Rect, Vec2, vec2};

use super::borders::{Border, SAME, borders, longest, with_polygons};
use super::vtu::{About, array, flat, numbers, write_texts};

/// What a cell is, as its array `kind` has it.
const BORDER: u8 = 0;
const CRACK: u8 = 1;
const TIP: u8 = 2;

/// Points and lines of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Lines {
    /// The tips, with their factors where they are known.
    pub tips: Vec<(Vec2, TipId, Option<TipIntensity>)>,
    /// Segments of the border, rims of holes among them, where they bound the body, and of cracks
    /// with their numbers.
    pub segments: Vec<([Vec2; 2], Option<u32>)>,
}

impl Lines {
    /// Those of a field's step.
    #[must_use]
    pub fn of(field: &Field<'_>) -> Self {
        let domain = with_polygons(field.domain);
        let bounds = &domain.bounds;
        let near = SAME * longest(bounds);
        let around = Rect::around(bounds.center(), bounds.size() * 0.5 + vec2(near, near));
        let all = borders(field, &domain, false).into_iter();
        let of_body = all.filter(|Border { ends: [a, b], .. }| {
            let middle = (*a + *b) / 2.0;
            let is_cut = |hole: &Hole| hole.contains(middle) && hole.rim_distance(middle) > near;
            around.contains(middle) && !domain.holes.iter().any(is_cut)
        });
        let segment = |border: Border| (border.ends, border.kind.crack.map(|s| s.crack));
        Self { tips: tips_of(field), segments: of_body.map(segment).collect() }
    }

    fn kinds(&self) -> Vec<u8> {
        let line = |(_, crack): &([Vec2; 2], Option<u32>)| crack.map_or(BORDER, |_| CRACK);
        self.tips.iter().map(|_| TIP).chain(self.segments.iter().map(line)).collect()
    }

    /// The crack of each cell, −1 for the border.
    fn cracks(&self) -> Vec<u8> {
        let tips = self.tips.iter().map(|(_, tip, _)| Some(tip.crack));
        let all = tips.chain(self.segments.iter().map(|(_, crack)| *crack));
        all.flat_map(|crack| crack.map_or(-1, |crack| crack as i32).to_le_bytes()).collect()
    }

    /// A number of tips, NaN where it is not known, and for segments.
    fn of_tips(&self, value: impl Fn(&TipIntensity) -> Option<f64>) -> Vec<f64> {
        let tips = self.tips.iter().map(|(_, _, found)| found.as_ref().and_then(&value));
        let all = tips.chain(self.segments.iter().map(|_| None));
        all.map(|value| value.unwrap_or(f64::NAN)).collect()
    }
}

fn tips_of(field: &Field<'_>) -> Vec<(Vec2, TipId, Option<TipIntensity>)> {
    let step = field.step;
    let tip = |tip: TipId| {
        let known = step.intensities.iter().find(|intensity| intensity.tip == tip);
        (step.cracks[tip.crack as usize].end_point(tip.end), tip, known.cloned())
    };
    tips(&step.cracks).map(tip).collect()
}

/// Writes points and lines.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut dyn Write, lines: &Lines, about: &About) -> io::Result<()> {
    let (tips, segments) = (lines.tips.len(), lines.segments.len());
    super::vtu::write_head(out, "PolyData")?;
    writeln!(out, "<FieldData>")?;
    write_texts(out, &about.texts)?;
    writeln!(out, "</FieldData>")?;
    writeln!(
        out,
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{tips}\" NumberOfLines=\"{segments}\">",
        tips + 2 * segments
    )?;
    let ends = lines.segments.iter().flat_map(|(ends, _)| *ends);
    let points: Vec<f64> =
        lines.tips.iter().map(|(at, _, _)| *at).chain(ends).flat_map(flat).collect();
    writeln!(out, "<Points>")?;
    numbers(out, "Points", "NumberOfComponents=\"3\"", &points)?;
    writeln!(out, "</Points>")?;
    write_cells(out, "Verts", (0, tips), 1)?;
    write_cells(out, "Lines", (tips, segments), 2)?;
    write_arrays(out, lines)?;
    writeln!(out, "</Piece>\n</PolyData>\n</VTKFile>")
}

/// So many cells of some points each, which follow each other from the first one on.
fn write_cells(
    out: &mut dyn Write,
    kind: &str,
    (first, count): (usize, usize),
    size: usize,
) -> io::Result<()> {
    let bytes = |numbers: &mut dyn Iterator<Item = usize>| -> Vec<u8> {
        numbers.flat_map(|number| (number as i32).to_le_bytes()).collect()
    };
    writeln!(out, "<{kind}>")?;
    array(out, "Int32", "connectivity", "", &bytes(&mut (first..first + size * count)))?;
    array(out, "Int32", "offsets", "", &bytes(&mut (1..=count).map(|k| size * k)))?;
    writeln!(out, "</{kind}>")
}

fn write_arrays(out: &mut dyn Write, lines: &Lines) -> io::Result<()> {
    writeln!(out, "<CellData>")?;
    array(out, "UInt8", "kind", "", &lines.kinds())?;
    array(out, "Int32", "crack", "", &lines.cracks())?;
    type Value = fn(&TipIntensity) -> Option<f64>;
    let values: [(&str, Value); 5] = [
        ("K_I", |tip| Some(tip.k1)),
        ("K_II", |tip| Some(tip.k2)),
        ("error", |tip| tip.error),
        ("T", |tip| tip.t_stress),
        ("J", |tip| tip.j),
    ];
    for (name, value) in values {
        numbers(out, name, "", &lines.of_tips(value))?;
    }
    writeln!(out, "</CellData>")
}
