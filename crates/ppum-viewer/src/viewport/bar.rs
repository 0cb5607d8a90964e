//! The colour bar of a view: drawn as figures draw it, and the control of the range. Its ends are
//! dragged, its middle shifts both, the wheel spreads them; a click on an end edits its number, a
//! double click leaves the range to the program.

use egui::{
    Align2, Area, Color32, CursorIcon, FontId, Key, Pos2, Rect, Response, Sense, Shape, Stroke,
    TextEdit, Ui, pos2, vec2,
};
use ppum::text::exact;
use ppum_figure::figure::{FigureStyle, Labels, StandaloneColorBar, Theme};
use ppum_render::extrema::{Extrema, Extremum};
use ppum_render::picture::ColoredRaster;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Normalization;
use ppum_scene::colors::ColorOptions;
use ppum_scene::range::RangeLocations;
use ppum_scene::values::PixelValues;

use crate::controls::range::{digits, parse, set};
use crate::frames::RenderedFrame;
use crate::measure::probe::ProbeReading;
use crate::measure::words::number;
use crate::same_arc::SameArc;
use crate::session::Pane;
use crate::shapes::{self, ImagePlacement};
use crate::widgets::wrong;

/// The present gesture on the bar.
#[derive(Clone, Debug, Default)]
pub struct BarGrip {
    /// The range when it was grabbed, and where.
    grabbed: Option<GrabbedBar>,
    /// The end that is written, and what.
    edited: Option<EditedLimit>,
    /// The extrema of values, which are looked for with ranges that are found and hold for those
    /// that are given.
    extrema: Option<(SameArc<PixelValues>, Extrema)>,
}

/// A bar as it was when it was grabbed. One that is dragged has other labels and other ends; what
/// the hand does is measured on the one that it took.
#[derive(Clone, Copy, Debug)]
struct GrabbedBar {
    norm: Normalization,
    /// Heights of positions 0 and 1.
    ends: [f32; 2],
    /// The height at which the button went down.
    from: f32,
}

#[derive(Clone, Debug)]
struct EditedLimit {
    end: usize,
    text: String,
    mistake: Option<String>,
    is_new: bool,
}

/// Length of the bar in parts of the view's height, and at most; no bar where it would be shorter
/// than the least.
const PART: f32 = 0.6;
const MOST: f32 = 420.0;
const LEAST: f32 = 140.0;
/// Distance from the view's edge, and around the bar.
const MARGIN: f32 = 10.0;
const ROOM: f32 = 8.0;
/// Width of its colours.
const BODY: f32 = 22.0;
/// Length of the marks of extrema.
const MARK: f32 = 8.0;
/// Height of what counts as an end.
const END: f32 = 22.0;
/// Views that are narrower have bars without a name.
const NARROW: f32 = 560.0;
/// Letters in parts of those of a figure of 1024 × 768 pixels.
const LETTERS: f64 = 0.92;
/// Turns of the wheel, in points, that spread the range e times.
const WHEEL: f64 = 240.0;
/// Names of the ends.
const ENDS: [&str; 2] = ["Lower end of the colours", "Upper end of the colours"];

/// A bar at its place.
struct BarLayout<'a> {
    frame: &'a RenderedFrame,
    bar: StandaloneColorBar,
    /// The bar's upper left corner.
    corner: Pos2,
    right: f32,
}

/// Shows the bar of an image over a view, with ticks at what is read at the pointer.
pub fn show(
    ui: &mut Ui,
    plate: Rect,
    grip: &mut BarGrip,
    colors: &mut ColorOptions,
    frame: &RenderedFrame,
    hover: Option<&ProbeReading>,
) {
    let length = length(plate);
    if length < LEAST || plate.width() < LEAST {
        return;
    }
    let standing = BarLayout::new(ui, plate, frame, length);
    standing.paint(ui);
    standing.body(ui, grip, colors);
    for end in [0, 1] {
        standing.end(ui, grip, colors, end);
    }
    standing.extrema(ui, grip.extrema(frame));
    standing.edit(ui, grip, colors);
    let values = hover.iter().flat_map(|probed| &probed.sides).map(|sided| sided.value);
    standing.follow(ui, values);
}

/// Shows the bar of the difference to a resampled image, where that is seen: beside the other
/// one, and nothing drags it.
pub fn of_difference(
    ui: &Ui,
    plate: Rect,
    (pane, is_compared): (&Pane, bool),
    frame: &RenderedFrame,
) {
    let length = length(plate);
    let Some(other) = frame.other.as_ref().filter(|_| is_compared) else { return };
    if length < LEAST || plate.width() < 2.0 * LEAST || !pane.against.difference {
        return;
    }
    let labels = Labels { quantity: "resampled − direct".into(), ..Labels::default() };
    let beside = BarLayout::new(ui, plate, frame, length).whole().left();
    let bar = bar(ui, &other.difference, &labels, length);
    let standing = BarLayout::at(plate, frame, bar, beside - MARGIN);
    standing.paint(ui);
}

/// The length of a view's bar.
fn length(plate: Rect) -> f32 {
    (PART * plate.height()).min(MOST)
}

/// The width that a view's bar usually takes of it; zero where there is no bar.
pub(super) fn width(plate: Rect) -> f32 {
    let is_there = length(plate) >= LEAST && plate.width() >= LEAST;
    let labels = if plate.width() < NARROW { 48.0 } else { 66.0 };
    if is_there { BODY + labels + 2.0 * ROOM + MARGIN } else { 0.0 }
}

/// The room below a view's bar, where the whole body is never; none if there is no bar.
pub(super) fn below(plate: Rect) -> Option<Rect> {
    let (width, length) = (width(plate), length(plate));
    let top = plate.center().y + 0.5 * length + 2.0 * ROOM;
    let corner = plate.right_bottom() - vec2(MARGIN, MARGIN);
    (width > 0.0).then(|| Rect::from_min_max(pos2(plate.right() - width, top), corner))
}

/// A bar in the window's colours.
fn bar(ui: &Ui, picture: &ColoredRaster, labels: &Labels, length: f32) -> StandaloneColorBar {
    let mut design = FigureStyle::pixels([1024, 768]);
    design.font_size *= LETTERS;
    design.theme = if ui.visuals().dark_mode { Theme::Dark } else { Theme::Light };
    StandaloneColorBar::new(picture, labels, &design, f64::from(length))
}

impl GrabbedBar {
    /// How far a height is from where the button went down, in lengths of the bar.
    fn by(&self, at: f32) -> f64 {
        let [low, high] = self.ends;
        f64::from(at - self.from) / f64::from(high - low)
    }
}

impl BarGrip {
    /// The extrema of an image's values, if they are known.
    fn extrema(&mut self, frame: &RenderedFrame) -> Option<&Extrema> {
        if let Some(found) = &frame.colored.span.values {
            self.extrema = Some(((&frame.drawn).into(), found.clone()));
        }
        let known = self.extrema.as_ref().filter(|(of, _)| *of == (&frame.drawn).into());
        known.map(|(_, extrema)| extrema)
    }
}

impl<'a> BarLayout<'a> {
    fn new(ui: &Ui, plate: Rect, frame: &'a RenderedFrame, length: f32) -> Self {
        let [quantity, unit] = frame.words();
        let mut labels = Labels { quantity, unit, ..Labels::default() };
        if plate.width() < NARROW {
            // the name stands in the panel, too
            labels.quantity.clear();
        }
        let bar = bar(ui, &frame.colored, &labels, length);
        Self::at(plate, frame, bar, plate.right() - MARGIN)
    }

    /// Places the bar at the middle of a view's height, to the left of a position.
    fn at(plate: Rect, frame: &'a RenderedFrame, bar: StandaloneColorBar, right: f32) -> Self {
        let mut width = bar.bounds()[1].x as f32;
        // one that is dragged has other labels and stays where it is
        width = width.max(bar.width as f32 + if plate.width() < NARROW { 48.0 } else { 66.0 });
        let top = plate.center().y - 0.5 * length(plate);
        let corner = pos2((right - ROOM - width).round(), top.round());
        Self { frame, bar, corner, right }
    }

    fn norm(&self) -> &Normalization {
        &self.frame.colored.normalization
    }

    /// True if values have a colour each, so that there is no range.
    fn has_classes(&self) -> bool {
        !self.frame.colored.colormap.classes().is_empty()
    }

    /// The height of a position from 0 to 1.
    fn height(&self, position: f64) -> f32 {
        let [low, high] = self.bar.ends;
        self.corner.y + (low + position * (high - low)) as f32
    }

    /// The position of a height.
    fn position(&self, height: f32) -> f64 {
        let [low, high] = self.bar.ends;
        (f64::from(height - self.corner.y) - low) / (high - low)
    }

    /// Returns the rectangle of the colours.
    fn colored(&self) -> Rect {
        let right = self.corner.x + self.bar.width as f32;
        Rect::from_min_max(pos2(self.corner.x, self.height(1.0)), pos2(right, self.height(0.0)))
    }

    /// All of it.
    fn whole(&self) -> Rect {
        let [min, max] = self.bar.bounds().map(|p| self.corner + vec2(p.x as f32, p.y as f32));
        // on the left there are marks
        let min = min - vec2(MARK, 0.0);
        Rect::from_min_max(min, pos2(self.right - ROOM, max.y)).expand(ROOM)
    }

    fn paint(&self, ui: &Ui) {
        let ground = ui.visuals().panel_fill.gamma_multiply(0.88);
        ui.painter().rect_filled(self.whole(), 6.0, ground);
        let placed = ImagePlacement::new(self.corner, 1.0);
        shapes::draw(ui.painter(), placed, &self.bar.items);
    }

    /// The middle: shifts the range, the wheel spreads it.
    fn body(&self, ui: &Ui, grip: &mut BarGrip, colors: &mut ColorOptions) {
        let id = ui.scope_id().with("colour bar");
        // the background takes the mouse, so that the view below does not move
        ui.interact(self.whole(), id.with("ground"), Sense::click_and_drag());
        let response = ui.interact(self.colored(), id, Sense::click_and_drag());
        name(&response, "Range of the colours");
        let response = response.on_hover_text(
            "Drag to shift the range, its ends to change them; the wheel spreads it, a double click finds it",
        );
        if self.has_classes() {
            return;
        }
        if let Some((norm, by)) = self.grabbed(&response, grip) {
            shift(colors, [0.0, 1.0].map(|end| norm.value(end - by)));
        }
        let wheel = ui.input(|input| f64::from(input.smooth_scroll_delta().y));
        if let Some(at) = response.hover_pos().filter(|_| wheel != 0.0) {
            let (at, factor) = (self.position(at.y), (-wheel / WHEEL).exp());
            shift(colors, [0.0, 1.0].map(|end| self.norm().value(at + (end - at) * factor)));
        }
        self.automatic(&response, grip, colors);
    }

    /// An end: dragged to where its value is to be, or written.
    fn end(&self, ui: &Ui, grip: &mut BarGrip, colors: &mut ColorOptions, end: usize) {
        let rect = self.end_rect(end);
        let id = ui.scope_id().with("end of the colour bar").with(end);
        let response = ui.interact(rect, id, Sense::click_and_drag());
        name(&response, ENDS[end]);
        let response = response.on_hover_cursor(CursorIcon::ResizeVertical);
        if self.has_classes() {
            return;
        }
        let ends = [self.norm().min(), self.norm().max()];
        if let Some((norm, by)) = self.grabbed(&response, grip) {
            let mut ends = [norm.min(), norm.max()];
            ends[end] = norm.value(end as f64 + by);
            // an impossible end stays where it was
            let _ = set(colors, ends, end);
        } else if response.clicked() {
            let text = exact(short(ends[end], ends));
            grip.edited = Some(EditedLimit { end, text, mistake: None, is_new: true });
        }
        self.automatic(&response, grip, colors);
    }

    /// The part of the bar that belongs to an end, with what stands beside it.
    fn end_rect(&self, end: usize) -> Rect {
        let colored = self.colored();
        let at = if end == 0 { colored.bottom() } else { colored.top() };
        let inside = END.min(0.25 * colored.height());
        let (top, bottom) = match end {
            0 => (at - inside, at + END),
            _ => (at - END, at + inside),
        };
        Rect::from_min_max(
            pos2(colored.left() - 4.0, top),
            pos2(self.whole().right() - ROOM, bottom),
        )
    }

    /// While it is dragged: the range when that began, and by how many lengths of the bar.
    fn grabbed(&self, response: &Response, grip: &mut BarGrip) -> Option<(Normalization, f64)> {
        let at = response.interact_pointer_pos()?.y;
        if response.drag_started() {
            // where the button went down: a drag is known some points later
            let origin = response.ctx.input(|input| input.pointer.press_origin());
            let ends = [0.0, 1.0].map(|end| self.height(end));
            let from = origin.map_or(at, |origin| origin.y);
            grip.grabbed = Some(GrabbedBar { norm: *self.norm(), ends, from });
            grip.edited = None;
        }
        let dragged = response.dragged();
        grip.grabbed.filter(|_| dragged).map(|grabbed| (grabbed.norm, grabbed.by(at)))
    }

    fn automatic(&self, response: &Response, grip: &mut BarGrip, colors: &mut ColorOptions) {
        if response.double_clicked() {
            colors.range = RangeChoice::Auto;
            grip.edited = None;
        }
    }

    /// Small marks at the smallest and the largest value of all, with their places.
    fn extrema(&self, ui: &Ui, extrema: Option<&Extrema>) {
        let picture = &self.frame.colored;
        let Some(extrema) = extrema else { return };
        if self.has_classes() || picture.one_value.is_some() || !picture.has_values {
            return;
        }
        for (number, extremum) in [&extrema.min, &extrema.max].into_iter().enumerate() {
            let at = pos2(self.corner.x - 3.0, self.mark(extremum));
            let points = vec![at, at + vec2(-MARK, -5.0), at + vec2(-MARK, 5.0)];
            let ink = ui.visuals().strong_text_color();
            ui.painter().add(Shape::convex_polygon(points, ink, Stroke::NONE));
            let rect = Rect::from_center_size(at - vec2(3.0, 0.0), vec2(14.0, 14.0));
            let id = ui.scope_id().with("extremum").with(number);
            let response = ui.interact(rect, id, Sense::hover());
            let told = || {
                let dataset = self.frame.field.dataset();
                let telling = RangeLocations::new(dataset, self.frame.field.field());
                let all = telling.extrema(extrema, picture.view.width);
                format!("{}: {}", ["smallest value", "largest value"][number], all[number])
            };
            name(&response, ["Smallest value", "Largest value"][number]);
            response.on_hover_ui(|ui| {
                ui.label(told());
            });
        }
    }

    /// The height of an extremum's mark: beyond the ends at the points of the triangles.
    fn mark(&self, extremum: &Extremum) -> f32 {
        let position = self.norm().position(extremum.value).clamp(0.0, 1.0);
        let beyond = match extremum.value {
            value if value > self.norm().max() => -10.0,
            value if value < self.norm().min() => 10.0,
            _ => 0.0,
        };
        self.height(position) + beyond
    }

    /// Ticks at the values below the pointer, with the values: those of two faces that are near
    /// stand one above the other.
    fn follow(&self, ui: &Ui, values: impl Iterator<Item = f64>) {
        if self.has_classes() {
            return;
        }
        let ends = [self.norm().min(), self.norm().max()];
        let tick = |value: f64| {
            let at = self.height(self.norm().position(value).clamp(0.0, 1.0));
            (at, number(value, digits(ends, 4)))
        };
        let mut ticks: Vec<_> = values.filter(|value| !value.is_nan()).map(tick).collect();
        ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
        ticks.dedup_by(|a, b| a.1 == b.1);
        let heights: Vec<f32> = ticks.iter().map(|(at, _)| *at).collect();
        let ink = ui.visuals().strong_text_color();
        let left = self.corner.x - MARK - 4.0;
        for ((at, text), beside) in ticks.into_iter().zip(apart(&heights, ROW)) {
            let font = FontId::proportional(12.0);
            let galley = ui.painter().layout_no_wrap(text, font, ink);
            let rect = Align2::RIGHT_CENTER.anchor_size(pos2(left - 4.0, beside), galley.size());
            ui.painter().rect_filled(rect.expand(3.0), 3.0, ui.visuals().panel_fill);
            ui.painter().galley(rect.min, galley, ink);
            let line = Stroke::new(1.5, contrast(ui));
            ui.painter().hline(left..=self.colored().right(), at, line);
        }
    }

    /// The number of an end, while it is written.
    fn edit(&self, ui: &Ui, grip: &mut BarGrip, colors: &mut ColorOptions) {
        let Some(mut edited) = grip.edited.take() else { return };
        let end = edited.end;
        let place = pos2(self.whole().left() - 112.0, self.height(end as f64) - 12.0);
        // each of two views has its own
        let id = ui.scope_id().with("an end of the colours, written");
        let area = Area::new(id).fixed_pos(place).order(egui::Order::Foreground);
        let is_done = area.show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).inner_margin(4.0).show(ui, |ui| field(ui, &mut edited))
        });
        let mut is_done = is_done.inner.inner;
        if matches!(is_done, BarGesture::Entered | BarGesture::Finished)
            && let Err(mistake) = self.entered(&edited, colors)
            && is_done == BarGesture::Entered
        {
            (edited.mistake, edited.is_new, is_done) = (Some(mistake), true, BarGesture::No);
        }
        if is_done == BarGesture::No {
            grip.edited = Some(edited);
        }
    }

    fn entered(&self, edited: &EditedLimit, colors: &mut ColorOptions) -> Result<(), String> {
        let mut ends = match colors.range {
            RangeChoice::Fixed(min, max) => [min, max],
            _ => [self.norm().min(), self.norm().max()],
        };
        ends[edited.end] = parse(&edited.text).ok_or("write a finite number")?;
        set(colors, ends, edited.end)
    }
}

/// Height of the number of a tick, with its ground \[points\].
const ROW: f32 = 20.0;

/// Heights in ascending order that are at least `gap` from one another, around the same middle.
fn apart(heights: &[f32], gap: f32) -> Vec<f32> {
    let (Some(first), Some(last)) = (heights.first(), heights.last()) else { return Vec::new() };
    let spaces = (heights.len() - 1) as f32;
    let is_apart = heights.windows(2).all(|pair| pair[1] - pair[0] >= gap);
    let top = 0.5 * (first + last - spaces * gap);
    let spread = |(k, at): (usize, &f32)| if is_apart { *at } else { top + k as f32 * gap };
    heights.iter().enumerate().map(spread).collect()
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum BarGesture {
    No,
    Entered,
    Finished,
    Left,
}

/// The field that a number is written in.
fn field(ui: &mut Ui, edited: &mut EditedLimit) -> BarGesture {
    let edit = TextEdit::singleline(&mut edited.text).desired_width(90.0);
    let edit = ui.add(edit).accessible_name(format!("{} as a number", ENDS[edited.end]));
    if edited.is_new {
        edit.request_focus();
        edited.is_new = false;
    }
    if let Some(mistake) = &edited.mistake {
        ui.colored_label(wrong(ui), mistake);
    }
    let [enter, escape] = [Key::Enter, Key::Escape].map(|key| ui.input(|i| i.key_pressed(key)));
    match (edit.lost_focus(), enter, escape) {
        (_, _, true) => BarGesture::Left,
        (true, true, _) => BarGesture::Entered,
        // a number that is written counts, as in other fields; one that is none is given up
        (true, false, _) => BarGesture::Finished,
        _ => BarGesture::No,
    }
}

/// Fixes the range to both ends; one that is none leaves the range as it was.
fn shift(colors: &mut ColorOptions, [min, max]: [f64; 2]) {
    if let Ok(range) = format!("{min:?},{max:?}").parse() {
        colors.range = range;
    }
}

fn name(response: &Response, name: &str) {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
}

fn contrast(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::WHITE } else { Color32::BLACK }
}

/// An end with the digits that its range gives a meaning to.
fn short(end: f64, [min, max]: [f64; 2]) -> f64 {
    let step = 10f64.powi(((max - min) / 1000.0).log10().floor() as i32);
    let rounded = format!("{:.12e}", (end / step).round() * step).parse().unwrap_or(end);
    if f64::is_finite(rounded) { rounded } else { end }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_near_stand_one_above_the_other() {
        assert!(apart(&[], 20.0).is_empty());
        assert_eq!(apart(&[7.0], 20.0), [7.0]);
        assert_eq!(apart(&[100.0, 102.0], 20.0), [91.0, 111.0]);
        assert_eq!(apart(&[100.0, 160.0], 20.0), [100.0, 160.0]);
    }
}
