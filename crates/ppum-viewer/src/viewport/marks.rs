//! Marks over the view: the patches at the pointer, the curve with its handles, probes, extrema, K
//! beside its circle.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Stroke, Ui, Vec2, vec2};
use ppum::crack::Crack;
use ppum::dataset::{Dataset, TipIncrement, TipStatus};
use ppum_render::extrema::Extremum;

use super::ViewState;
use super::curves::{handles, outline};
use super::hover::HoverGeometry;
use crate::frames::RenderedFrame;
use crate::measure::probe::ProbeReading;
use crate::measure::words;
use crate::session::Pane;
use crate::widgets::symbol;
use ppum_scene::location::Location;

const INK: Color32 = Color32::from_rgb(214, 88, 0);
const HALO: Color32 = Color32::from_rgba_premultiplied(225, 225, 225, 225);

impl ViewState {
    /// Marks over the view: the patches at the pointer, the curve with its handles, probes,
    /// extrema.
    pub(super) fn marks(&mut self, ui: &Ui, sight: &HoverGeometry, pane: &Pane) {
        let painter = ui.painter_at(sight.rect);
        let cracks = self.cracks(pane);
        let cracks = cracks.as_deref().unwrap_or_default();
        if let (Some(probed), Some(frame)) = (&self.tools.hover, self.frames.newest()) {
            patches(&painter, sight, probed, frame);
            ring(&painter, sight, probed);
        }
        if let Some(along) = &pane.curve {
            curve(&painter, sight, &outline(along, cracks, Some(&sight.view)));
            for (_, spot) in handles(along, cracks) {
                if let Some(at) = sight.position(&spot) {
                    painter.circle(at, 4.5, Color32::WHITE, Stroke::new(2.0, INK));
                }
            }
        }
        for (k, spot) in pane.probes.iter().enumerate() {
            let is_selected = self.tools.selected == Some(k);
            let values = self.tools.probes.get(k).map(words::short_values);
            let label = format!("{}  {}", k + 1, values.unwrap_or_default());
            probe(&painter, sight, spot, label.trim_end(), is_selected);
        }
        if let Some(at) = self.tools.marked.and_then(|spot| sight.position(&spot)) {
            painter.circle(at, 5.0, INK, Stroke::new(1.5, Color32::WHITE));
        }
        if pane.extrema
            && let Some(frame) = self.frames.newest()
        {
            extrema(&painter, sight, frame);
        }
        let opened = self.opened.as_ref().filter(|opened| {
            pane.scene.subject.step_of(&opened.dataset) + 1 == opened.dataset.steps.len()
        });
        for (end, reason) in opened.map_or_else(Vec::new, |o| growth_ends(&o.dataset)) {
            if let Some(at) = sight.position(&Location::new(end, ppum::vec2::Vec2::ZERO)) {
                lettered(&painter, at + vec2(8.0, -8.0), Align2::LEFT_BOTTOM, &reason);
            }
        }
        self.factors(ui, sight, pane, cracks);
    }

    /// K outside of the circle, or the reason why there is none.
    fn factors(&mut self, ui: &Ui, sight: &HoverGeometry, pane: &Pane, cracks: &[Crack]) {
        let Some(along) = &pane.curve else { return };
        if !self.tools.integral.is_asked() || self.tools.grip.is_some() {
            return;
        }
        let (text, rows) = self.tools.integral.table();
        let seen: Vec<Pos2> =
            outline(along, cracks, None).iter().filter_map(|spot| sight.position(spot)).collect();
        if seen.is_empty() {
            return;
        }
        let cells = match rows.is_empty() {
            true => vec![[galley(ui, text.clone().into(), 260.0), None, None]],
            false => table(ui, &rows),
        };
        let mut within = sight.rect;
        within.max.x -= super::bar::width(within);
        show_table(ui, within, Rect::from_points(&seen), (&cells, &text));
    }
}

/// Returns the ends of cracks that grow no further after the last step of a series whose growth has
/// ended, each with the reason.
#[must_use]
pub fn growth_ends(dataset: &Dataset) -> Vec<(ppum::vec2::Vec2, String)> {
    let Some((last, before)) = dataset.steps.split_last() else { return Vec::new() };
    let Some((growth, stop)) = last.growth.as_ref().and_then(|g| Some((g, g.stop?))) else {
        return Vec::new();
    };
    let reason = |fate: TipStatus| match fate {
        TipStatus::Grows => stop.words().to_owned(),
        fate => fate.words(),
    };
    let rows = before.iter().filter_map(|step| step.growth.as_ref()).flat_map(|g| &g.tips);
    // a tip that goes on and is none any more has met something
    let ended = rows.filter(|row| row.fate.goes_on() && row.fate != TipStatus::Grows);
    let all = ended.chain(&growth.tips).take(LABELS);
    let end = |row: &TipIncrement| {
        let crack = last.cracks.get(row.tip.crack as usize)?;
        Some((crack.end_point(row.tip.end), reason(row.fate)))
    };
    all.filter_map(end).collect()
}

/// Labels of more ends would cover the body.
const LABELS: usize = 12;

/// A row of a small table.
type Row = [Option<Arc<Galley>>; 3];

fn galley(ui: &Ui, text: egui::WidgetText, width: f32) -> Option<Arc<Galley>> {
    let wrap = Some(egui::TextWrapMode::Wrap);
    Some(text.into_galley(ui, wrap, width, egui::TextStyle::Body))
}

/// The rows of a table of factors, without a column that has none.
fn table(ui: &Ui, rows: &[[String; 3]]) -> Vec<Row> {
    let has_stored = rows.iter().any(|row| !row[2].is_empty());
    let cell = |text: &str| galley(ui, egui::RichText::new(text).strong().into(), f32::INFINITY);
    let head = [None, cell("circle"), cell("stored").filter(|_| has_stored)];
    let row = |[name, own, stored]: &[String; 3]| {
        let name = galley(ui, symbol(ui, name).into(), f32::INFINITY);
        [name, cell(own), cell(stored).filter(|_| has_stored)]
    };
    std::iter::once(head).chain(rows.iter().map(row)).collect()
}

/// Shows a table on its own background: where it hides least of a circle, inside the view.
fn show_table(ui: &Ui, within: Rect, circle: Rect, (rows, text): (&[Row], &str)) {
    let size = |cell: &Option<Arc<Galley>>| cell.as_ref().map_or(Vec2::ZERO, |cell| cell.size());
    let widths = [0, 1, 2].map(|k| rows.iter().map(|row| size(&row[k]).x).fold(0.0, f32::max));
    let height = rows.iter().flatten().map(|cell| size(cell).y).fold(0.0, f32::max);
    let used = widths.iter().filter(|width| **width > 0.0).count().max(1) as f32;
    let all = widths.iter().sum::<f32>() + GAP * (used - 1.0);
    let rect = placed(within, circle, vec2(all, height * rows.len() as f32) + 2.0 * ROOM);
    let painter = ui.painter_at(within);
    painter.rect_filled(rect, 4.0, ui.visuals().panel_fill.gamma_multiply(0.92));
    for (number, row) in rows.iter().enumerate() {
        let mut at = rect.min + ROOM + vec2(0.0, number as f32 * height);
        for (cell, width) in row.iter().zip(widths) {
            if let Some(cell) = cell {
                painter.galley(at, Arc::clone(cell), ui.visuals().strong_text_color());
            }
            at.x += if width > 0.0 { width + GAP } else { 0.0 };
        }
    }
    // read aloud too
    let response = ui.interact(rect, ui.scope_id().with("factors"), egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
}

/// Room between the columns of a table, and around it \[points\].
const GAP: f32 = 12.0;
const ROOM: Vec2 = Vec2::new(6.0, 4.0);

/// A rectangle outside of a circle and inside of a view if one has room: above, below, on the right
/// or left; else in the corner of the view.
fn placed(within: Rect, circle: Rect, size: Vec2) -> Rect {
    let (c, half) = (circle.center(), 0.5 * size);
    let corners = [
        egui::pos2(c.x - half.x, circle.top() - size.y - APART),
        egui::pos2(c.x - half.x, circle.bottom() + APART),
        egui::pos2(circle.right() + APART, c.y - half.y),
        egui::pos2(circle.left() - size.x - APART, c.y - half.y),
    ];
    let inside = within.shrink(4.0);
    let all = corners.map(|corner| Rect::from_min_size(corner, size));
    let corner = Rect::from_min_size(inside.min, size);
    all.into_iter().find(|rect| inside.contains_rect(*rect)).unwrap_or(corner)
}

const APART: f32 = 8.0;

/// The supports of the patches, the more strongly the more they count.
fn patches(
    painter: &Painter,
    sight: &HoverGeometry,
    probed: &ProbeReading,
    frame: &Arc<RenderedFrame>,
) {
    let field = frame.field.field();
    for (patch, phi) in &probed.patches {
        let support = field.step.partition.support(*patch as usize);
        let bounds = field.domain.bounds;
        let (a, b) = (support.min.max(bounds.min), support.max.min(bounds.max));
        let corners = [a, ppum::vec2::vec2(b.x, a.y), b, ppum::vec2::vec2(a.x, b.y), a];
        let spots = corners.map(|corner| Location::new(corner, ppum::vec2::Vec2::ZERO));
        let strength = (30.0 + 130.0 * phi.clamp(0.0, 1.0)) as u8;
        for line in sight.lines(&spots) {
            painter.line_segment(line, Stroke::new(2.0, Color32::from_black_alpha(strength / 2)));
            painter.line_segment(line, Stroke::new(1.0, Color32::from_white_alpha(strength)));
        }
    }
}

/// A ring around what is read if that is not just under the pointer: a tip, a point of a crack.
fn ring(painter: &Painter, sight: &HoverGeometry, probed: &ProbeReading) {
    if (probed.tip.is_some() || probed.crack.is_some())
        && let Some(at) = sight.position(&probed.spot)
    {
        painter.circle_stroke(at, 5.0, Stroke::new(3.0, HALO));
        painter.circle_stroke(at, 5.0, Stroke::new(1.5, INK));
    }
}

fn curve(painter: &Painter, sight: &HoverGeometry, spots: &[Location]) {
    let lines = sight.lines(spots);
    for (width, color) in [(4.0, HALO), (2.0, INK)] {
        for line in &lines {
            painter.line_segment(*line, Stroke::new(width, color));
        }
    }
}

/// The mark of a probe: a cross with its number.
fn probe(
    painter: &Painter,
    sight: &HoverGeometry,
    spot: &Location,
    number: &str,
    is_selected: bool,
) {
    let Some(at) = sight.position(spot) else { return };
    let arm = if is_selected { 8.0 } else { 6.0 };
    for (width, color) in [(4.0, HALO), (if is_selected { 2.5 } else { 1.5 }, INK)] {
        let stroke = Stroke::new(width, color);
        painter.line_segment([at - vec2(arm, 0.0), at + vec2(arm, 0.0)], stroke);
        painter.line_segment([at - vec2(0.0, arm), at + vec2(0.0, arm)], stroke);
    }
    lettered(painter, at + vec2(7.0, -5.0), Align2::LEFT_BOTTOM, number);
}

/// Text on a small background, readable on any colours.
fn lettered(painter: &Painter, at: Pos2, align: Align2, text: &str) {
    if text.is_empty() {
        return;
    }
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), INK);
    let rect = align.anchor_size(at, galley.size());
    let over = (rect.right() + 3.0 - painter.clip_rect().right()).max(0.0);
    let rect = rect.translate(vec2(-over, 0.0));
    painter.rect_filled(rect.expand2(vec2(3.0, 0.0)), 3.0, HALO);
    painter.galley(rect.min, galley, INK);
}

/// The places of the least and the greatest value of what is seen of the body.
fn extrema(painter: &Painter, sight: &HoverGeometry, frame: &Arc<RenderedFrame>) {
    let Some(found) = &frame.colored.span.values else { return };
    let mark = |extremum: &Extremum, sign: &str, align: Align2| {
        if let Some(at) = sight.position(&Location::new(found.center, extremum.offset)) {
            painter.circle(at, 4.0, HALO, Stroke::new(2.0, INK));
            let text = format!("{sign} {}", words::value(extremum.value, ""));
            let shift = if align == Align2::LEFT_BOTTOM { -5.0 } else { 5.0 };
            lettered(painter, at + vec2(6.0, shift), align, &text);
        }
    };
    mark(&found.max, "▲", Align2::LEFT_BOTTOM);
    mark(&found.min, "▼", Align2::LEFT_TOP);
}
