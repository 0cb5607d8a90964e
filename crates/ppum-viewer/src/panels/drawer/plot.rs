//! Values along a curve: which one, of what, and the plot, whose points are found on the body.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{ComboBox, DragValue, Stroke, Ui, vec2};
use ppum::crack::{Crack, tips};
use ppum::field::Field;
use ppum::quantity::face_names;
use ppum_figure::plot::{LEAST, Plot, plot};
use ppum_scene::profile::ProfileCurve;

use crate::measure::plot_request::{CurveValues, PlotRequest};
use crate::measure::tool::Tool;
use crate::panel_context::PanelContext;
use crate::save_target::{SaveTarget, has_extension, replace};
use crate::session::Pane;
use crate::viewport::ViewState;
use crate::widgets::chart::{PlotWidget, SMALLER, reading, scaled_chart};
use crate::widgets::entry::entry;
use crate::widgets::wrong;
use crate::widgets::{button, note_folder};

/// Shows the page.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    ui.horizontal_wrapped(|ui| chooser(ui, pane, viewport));
    viewport.tools.marked = None;
    let Some(frame) = viewport.frames.newest().cloned() else { return };
    if frame.left.is_some() {
        ui.weak("Of the view on the right alone: a curve is of one field.");
    }
    let Some(asked) = PlotRequest::of(pane, &frame.field) else {
        ui.weak("Draw a line or a circle over the plate, or choose a crack or a tip.");
        return;
    };
    let theirs = asked.clone();
    viewport.tools.plot.ask(&asked, false, ui.ctx(), move |watcher| theirs.find(watcher));
    let newest = viewport.tools.plot.newest().cloned();
    let Some((known, found)) = newest else {
        ui.spinner();
        return;
    };
    if known != asked {
        // asked for again when what runs is done
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(15));
    }
    if found.is_ok() {
        viewport.tools.good = Some((known.along, Arc::clone(&found)));
    }
    let good = viewport.tools.good.clone().filter(|(along, _)| *along == asked.along);
    let values = good.as_ref().and_then(|(_, found)| found.as_ref().as_ref().ok());
    let page = values.map(|values| values.plot(pane.plot.log));
    ui.horizontal_wrapped(|ui| {
        settings(ui, pane, frame.field.field());
        if let (Some(values), Some(page)) = (values, &page) {
            save(ui, viewport, values, page);
        }
    });
    if let Err(reason) = &*found {
        ui.colored_label(ui.visuals().error_fg_color, reason);
    }
    if let (Some(values), Some(page)) = (values, &page) {
        graph(ui, pane, viewport, values, page);
    }
}

/// Buttons for the files of a plot.
fn save(ui: &mut Ui, viewport: &mut ViewState, values: &CurveValues, drawn: &Plot) {
    let page = || plot(drawn, PAGE);
    let files: [(&str, &dyn Fn() -> Vec<u8>); 4] = [
        ("csv", &|| values.table.csv().into_bytes()),
        ("svg", &|| page().svg(96.0, &[]).into_bytes()),
        ("pdf", &|| page().pdf(96.0, &[])),
        ("png", &|| ppum_render::png::encode_at(&page().image(), None, &[]).unwrap_or_default()),
    ];
    outputs(ui, viewport, ("plot", &files), &|| values.table.csv());
}

/// Size of the page of a plot that is written to a file, as `ppum plot` has it.
const PAGE: [u32; 2] = [900, 600];

/// Which curve.
fn chooser(ui: &mut Ui, pane: &mut Pane, viewport: &mut ViewState) {
    let cracks = viewport.cracks(pane);
    let cracks = cracks.as_deref().unwrap_or_default();
    let chosen = pane.curve.as_ref().map_or("no curve".into(), name);
    let list = ComboBox::from_id_salt("curve").selected_text(chosen).width(150.0);
    let list = list.show_ui(ui, |ui| {
        let before = pane.curve;
        for (along, name) in choices(cracks, viewport) {
            ui.selectable_value(&mut pane.curve, along, name);
        }
        if pane.curve != before {
            viewport.tools.refused = None;
            let is_ray = matches!(pane.curve, Some(ProfileCurve::Ray { .. }));
            pane.plot.log = [is_ray; 2];
        }
    });
    list.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "Curve"));
    for (tool, sign, name) in [
        (Tool::Line, "Line", "Draw a line"),
        (Tool::Circle, "Circle", "Draw a circle"),
        (Tool::Ray, "Ray", "Draw a ray"),
        (Tool::Crack, "Crack", "Click a crack"),
    ] {
        let is_on = viewport.tools.tool == Some(tool);
        let chosen = ui.selectable_label(is_on, sign).on_hover_text(tool.hint());
        chosen.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_on, name));
        if chosen.clicked() {
            viewport.tools.tool = (!is_on).then_some(tool);
            if tool == Tool::Ray {
                pane.plot.log = [true; 2];
            }
        }
    }
    numbers(ui, pane, viewport);
}

/// The curves of a step that need no drawing.
fn choices(cracks: &[Crack], viewport: &ViewState) -> Vec<(Option<ProfileCurve>, String)> {
    const MOST: usize = 100;
    let mut all = vec![None];
    all.push(viewport.middle());
    all.extend((0..cracks.len().min(MOST)).map(|index| Some(ProfileCurve::Crack { index })));
    for tip in 0..tips(cracks).count().min(MOST) {
        all.push(Some(ProfileCurve::Around { tip, radius: None }));
        all.push(Some(ProfileCurve::Ray { tip, angle: 0.0, far: None }));
    }
    let named = |along: Option<ProfileCurve>| {
        let name = along.as_ref().map_or("no curve".into(), name);
        (along, name)
    };
    all.into_iter().map(named).collect()
}

fn name(along: &ProfileCurve) -> String {
    match along {
        ProfileCurve::Line { .. } => "line".into(),
        ProfileCurve::Circle { .. } => "circle".into(),
        ProfileCurve::Crack { index } => format!("crack {index}"),
        ProfileCurve::Around { tip, .. } => format!("around tip {tip}"),
        ProfileCurve::Ray { tip, .. } => format!("ray from tip {tip}"),
    }
}

/// The numbers of the curve, to be edited.
fn numbers(ui: &mut Ui, pane: &mut Pane, viewport: &mut ViewState) {
    let Some(along) = pane.curve else { return };
    let (hint, values): (&str, Vec<f64>) = match along {
        ProfileCurve::Line { from, to, .. } => ("x, y to x, y", [from, to].concat()),
        ProfileCurve::Circle { center, radius } => {
            ("centre, radius", vec![center[0], center[1], radius])
        }
        ProfileCurve::Around { radius, .. } => ("radius", radius.into_iter().collect()),
        ProfileCurve::Ray { angle, far, .. } => {
            ("angle, length", [angle].into_iter().chain(far).collect())
        }
        ProfileCurve::Crack { .. } => return,
    };
    let texts: Vec<String> = values.iter().map(|v| number_text(*v)).collect();
    if let ProfileCurve::Line { anchor, .. } = along
        && anchor != [0.0; 2]
    {
        ui.label(format!("({}, {}) +", ppum::text::exact(anchor[0]), ppum::text::exact(anchor[1])));
    }
    if let Some(text) = entry(ui, "Numbers of the curve", &texts.join(", "), hint, 190.0) {
        let changed = with_numbers(along, &text, &values)
            .ok_or_else(|| format!("“{}” is not what is needed: {hint}", text.trim()));
        match changed.and_then(|along| viewport.refusal(pane, &along).map_or(Ok(along), Err)) {
            Ok(changed) => (pane.curve, viewport.tools.refused) = (Some(changed), None),
            Err(reason) => viewport.tools.refused = Some(reason),
        }
    }
    if let Some(reason) = &viewport.tools.refused {
        ui.colored_label(wrong(ui), reason);
    }
}

/// Digits of numbers that are edited: with one more 0.1 + 0.2 would not be 0.3.
const DIGITS: usize = 15;

fn number_text(value: f64) -> String {
    ppum::text::trimmed_to(value, DIGITS)
}

/// A curve with the numbers of a text, of which those that stand as they did are what they were;
/// none if these are not the ones that it needs.
fn with_numbers(along: ProfileCurve, text: &str, before: &[f64]) -> Option<ProfileCurve> {
    let read = |(k, part): (usize, &str)| {
        let part = part.trim().replace('−', "-");
        let same = before.get(k).filter(|value| number_text(**value) == part);
        same.map_or_else(|| part.parse(), |value| Ok(*value))
    };
    let parsed: Result<Vec<f64>, _> = text.split(',').enumerate().map(read).collect();
    let numbers = parsed.ok().filter(|all| all.iter().all(|v: &f64| v.is_finite()))?;
    match (along, &numbers[..]) {
        (ProfileCurve::Line { anchor, .. }, &[x0, y0, x1, y1]) => {
            Some(ProfileCurve::Line { anchor, from: [x0, y0], to: [x1, y1] })
        }
        (ProfileCurve::Circle { .. }, &[x, y, radius]) => {
            Some(ProfileCurve::Circle { center: [x, y], radius })
        }
        (ProfileCurve::Around { tip, .. }, &[radius]) => {
            Some(ProfileCurve::Around { tip, radius: Some(radius) })
        }
        (ProfileCurve::Ray { tip, far, .. }, &[angle]) => {
            Some(ProfileCurve::Ray { tip, angle, far })
        }
        (ProfileCurve::Ray { tip, .. }, &[angle, far]) => {
            Some(ProfileCurve::Ray { tip, angle, far: Some(far) })
        }
        _ => None,
    }
}

/// Quantities, axes and points.
fn settings(ui: &mut Ui, pane: &mut Pane, field: &Field<'_>) {
    let text = pane.plot.quantities.clone().unwrap_or_default();
    if let Some(text) = entry(ui, "Quantities of the plot", &text, "as on the plate", 150.0) {
        pane.plot.quantities = (!text.trim().is_empty()).then_some(text);
    }
    if matches!(pane.curve, Some(ProfileCurve::Crack { .. })) {
        ui.menu_button("Faces", |ui| add_face_quantity(ui, pane, field));
    }
    let [x, y] = &mut pane.plot.log;
    ui.checkbox(x, "log x");
    ui.checkbox(y, "log y");
    let points = DragValue::new(&mut pane.plot.count).range(2..=100_000).suffix(" points");
    ui.add(points).widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::SpinButton, true, "Number of points")
    });
}

/// The quantities of the faces of cracks, of which the one that is clicked is plotted too.
fn add_face_quantity(ui: &mut Ui, pane: &mut Pane, field: &Field<'_>) {
    for name in face_names(field) {
        if ui.button(name).clicked() {
            let before = pane.plot.quantities.take().filter(|text| !text.trim().is_empty());
            let both = |before: String| format!("{before}, {name}");
            pane.plot.quantities = Some(before.map_or_else(|| name.to_owned(), both));
            ui.close();
        }
    }
}

/// Ends of names of files, and what is written into them.
type PlotFiles<'a> = [(&'a str, &'a dyn Fn() -> Vec<u8>)];

/// Buttons that copy and write files, with the result of the last one; they go beside the dataset
/// and are named after it and what they hold unless another name is given.
pub(crate) fn outputs(
    ui: &mut Ui,
    viewport: &mut ViewState,
    (what, files): (&'static str, &PlotFiles<'_>),
    text: &dyn Fn() -> String,
) {
    if ui.button("Copy CSV").clicked() {
        ui.ctx().copy_text(text());
        viewport.tell("Copied: the table, with all digits");
    }
    let input = viewport.opened.as_ref().and_then(|opened| opened.path.clone());
    let dataset = input.clone().unwrap_or_else(|| PathBuf::from("solution"));
    let name = format!("{}-{what}", dataset.file_stem().unwrap_or_default().display());
    let target = viewport.tools.targets.entry(what).or_default();
    let label = ui.label("File");
    let field = egui::TextEdit::singleline(&mut target.name).hint_text(&name).desired_width(150.0);
    ui.add(field).labelled_by(label.id);
    let written = target.name.trim();
    let file = dataset.with_file_name(if written.is_empty() { &name } else { written });
    for (end, bytes) in files {
        let end_shown = end.to_uppercase();
        if button(ui, &end_shown, &format!("Save {end_shown}")).clicked() {
            target.result = Some(save_table(target, &file, (end, bytes), input.as_deref()));
        }
    }
    match &target.result {
        Some(Ok(text)) => drop(ui.add(egui::Label::new(text).truncate()).on_hover_text(text)),
        Some(Err(_)) => target.show_result(ui),
        None => note_folder(ui, &file),
    }
}

/// Writes a file under a name with an end of its own.
fn save_table(
    target: &mut SaveTarget,
    file: &Path,
    (end, bytes): (&str, &dyn Fn() -> Vec<u8>),
    dataset: Option<&Path>,
) -> Result<String, String> {
    let has_end = has_extension(file, &[end]);
    let path = if has_end { file.to_owned() } else { file.with_added_extension(end) };
    if let Some(reason) = target.refuses(&path, &[end], dataset) {
        return Err(reason);
    }
    let written = replace(&path, &bytes()).map(|()| format!("Saved {}", path.display()));
    written.map_err(|error| format!("{}: {error}", path.display()))
}

/// The plot; the pointer in it marks the point on the body and reads the values there.
fn graph(ui: &mut Ui, pane: &Pane, viewport: &mut ViewState, values: &CurveValues, drawn: &Plot) {
    let room = ui.available_size().max(vec2(LEAST[0] as f32, LEAST[1] as f32) * SMALLER);
    let PlotWidget { response, placed, area } =
        scaled_chart(ui, "Plotted curves", drawn, room, SMALLER);
    let (rect, painter) = (response.rect, ui.painter_at(response.rect));
    let Some(at) = response.hover_pos() else { return };
    let column = f64::from((at.x - rect.min.x) / SMALLER);
    let Some((row, spot)) = values.nearest(area.across(column), pane.plot.log[0]) else { return };
    let ink = ui.visuals().strong_text_color();
    for point in values.points(row) {
        if let Some(position) = area.position(point) {
            let at = placed.at(position);
            painter.vline(at.x, rect.y_range(), Stroke::new(0.5, ink));
            painter.circle(at, 3.5, ink, Stroke::NONE);
        }
    }
    viewport.tools.marked = Some(spot);
    reading(ui, rect, &values.words(row));
}
