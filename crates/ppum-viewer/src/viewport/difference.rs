//! Two views side by side: what each shows, which is taken from which, how large the difference is,
//! and why there is none.

use egui::{Align, Layout, Rect, RichText, Ui, UiBuilder, vec2};
use ppum::text::trimmed_to;
use ppum_render::resample::norms::{DifferenceNorms, NAMES};

use crate::frames::{FaultOrigin, PaneFrames, SubtractedImage};
use crate::measure::words::value;
use crate::widgets::wrong;

/// The relation of a view to the one beside it.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum PairRole {
    /// Nothing: it shows its own values.
    #[default]
    Alone,
    /// Its values are subtracted on the right.
    Left,
    /// It shows its values minus those of the left, if a dataset is open there.
    Right(Option<SubtractedImage>),
}

impl PairRole {
    /// Returns the subtrahend here.
    pub(crate) fn minus(&self) -> Option<&SubtractedImage> {
        match self {
            Self::Right(minus) => minus.as_ref(),
            _ => None,
        }
    }
}

/// Digits of norms.
const DIGITS: usize = 3;
/// Distance from the view's edge, and around the words.
const MARGIN: f32 = 10.0;
const ROOM: f32 = 5.0;
/// Widest words.
const WIDEST: f32 = 440.0;
/// Size of all but the first line \[points\].
const SMALL: f32 = 11.5;
/// Where there is less room one norm stands alone.
const NARROW: f32 = 400.0;

/// Says on both views how they are related, in the upper right corner; something on the left takes
/// some of the width.
pub fn show(
    ui: &mut Ui,
    (plate, taken): (Rect, f32),
    (pair, caption): (&PairRole, Option<&str>),
    frames: &PaneFrames,
) {
    let space = plate.width() - taken - 2.0 * (MARGIN + ROOM);
    let (title, lines) = match pair {
        PairRole::Alone if caption.is_none() => return,
        PairRole::Alone => ("", Vec::new()),
        PairRole::Left => ("left", Vec::new()),
        PairRole::Right(None) => ("right", vec![("nothing is open on the left".to_owned(), true)]),
        PairRole::Right(Some(_)) => ("right − left", difference_lines(frames, space < NARROW)),
    };
    let corner = plate.right_top() + vec2(-MARGIN - ROOM, MARGIN + ROOM);
    let left = corner.x - space.clamp(1.0, WIDEST);
    let room = Rect::from_x_y_ranges(left..=corner.x, corner.y..=plate.bottom().max(corner.y));
    let ground = ui.painter().add(egui::Shape::Noop);
    let builder = UiBuilder::new().max_rect(room).layout(Layout::top_down(Align::Max));
    let mut child = ui.new_child(builder);
    child.set_clip_rect(plate);
    child.spacing_mut().item_spacing.y = 1.0;
    if let Some(caption) = caption {
        let text = RichText::new(caption).size(SMALL).color(ui.visuals().strong_text_color());
        child.add(egui::Label::new(text).selectable(false).truncate());
    }
    if !title.is_empty() {
        child.add(egui::Label::new(RichText::new(title).strong()).selectable(false));
    }
    for (line, is_wrong) in lines {
        let color = if is_wrong { wrong(ui) } else { ui.visuals().text_color() };
        let text = RichText::new(line).size(SMALL).color(color);
        child.add(egui::Label::new(text).selectable(false).wrap());
    }
    let color = ui.visuals().panel_fill.gamma_multiply(0.88);
    let shape = egui::Shape::rect_filled(child.min_rect().expand(ROOM), 4.0, color);
    ui.painter_at(plate).set(ground, shape);
}

/// The lines about a difference, in short of one norm alone; true for those of errors.
fn difference_lines(frames: &PaneFrames, is_short: bool) -> Vec<(String, bool)> {
    let failure = frames.failure().filter(|failure| failure.fault == FaultOrigin::Minus);
    if let Some(failure) = failure {
        return vec![(failure.message.clone(), true)];
    }
    let mut lines = Vec::new();
    if let Some(frame) = frames.newest()
        && let Some(minus) = frame.minus()
    {
        let [_, unit] = minus.words();
        lines.extend(frame.norms.map(|norms| (words(&norms, &unit, is_short), false)));
        lines.extend(minus.warnings().into_iter().map(|warning| (warning, true)));
    }
    lines
}

/// The means and the largest of the differences in the view, also in parts of the left's own; in
/// short L2 alone.
fn words(norms: &DifferenceNorms, unit: &str, is_short: bool) -> String {
    match norms.absolute {
        _ if norms.compared == 0 => return "no point of this view has both values".into(),
        [.., 0.0] => return "no difference in this view".into(),
        _ => {}
    }
    let all = NAMES.into_iter().zip(norms.absolute).zip(norms.relative());
    let words = all.map(|((name, size), part)| {
        let size = value(rounded(size), unit);
        match part.is_finite() {
            true => format!("{name} {size} ({} %)", trimmed_to(100.0 * part, DIGITS)),
            false => format!("{name} {size}"),
        }
    });
    let wanted = if is_short { 1..2 } else { 0..3 };
    words.skip(wanted.start).take(wanted.len()).collect::<Vec<_>>().join(" · ")
}

/// The size of a difference with the digits that are shown.
pub(crate) fn rounded(size: f64) -> f64 {
    trimmed_to(size, DIGITS).parse().unwrap_or(size)
}
