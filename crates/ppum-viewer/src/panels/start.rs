//! The start page, while no dataset is open: files of before, and examples.

use std::sync::Arc;

use egui::{
    Galley, Rect, RichText, Role, ScrollArea, Sense, StrokeKind, TextStyle, TextWrapMode, Ui, Vec2,
    WidgetInfo, WidgetText, vec2,
};

use crate::actions::Action;
use crate::files::examples;
use crate::panel_context::PanelContext;
use crate::shapes::{self, ImagePlacement};
use crate::widgets::note;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let room = ui.available_width();
    ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
    ScrollArea::vertical().id_salt("start").auto_shrink([false; 2]).show(ui, |ui| {
        let width = (room - 32.0).clamp(200.0, WIDEST);
        ui.add_space(16.0);
        ui.horizontal(|ui| {
            ui.add_space((0.5 * (room - width)).max(12.0));
            ui.vertical(|ui| {
                ui.set_width(width);
                page(ui, context);
            });
        });
    });
}

fn page(ui: &mut Ui, context: &mut PanelContext<'_>) {
    ui.heading("ppum");
    ui.label("Fields with cracks, exact at every pixel, down to the tip.");
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if ui.button(RichText::new("Open a file…").strong()).clicked() {
            context.actions.push(Action::Open);
        }
        if ui.button("New problem").clicked() {
            context.actions.push(Action::NewProblem);
        }
        if ui.button("Import a drawing…").clicked() {
            context.actions.push(Action::Import);
        }
    });
    let kinds = "dataset (.h5), problem (.toml), drawing (.dxf, .svg, .msh, .geo), session";
    ui.weak(format!("Ctrl+O, or drop a file here: {kinds}"));
    ui.add_space(12.0);
    ui.strong("Recent files");
    recent(ui, context);
    ui.add_space(12.0);
    ui.strong("Examples");
    ui.weak("A click solves the problem, within seconds mostly, and shows it with its text.");
    ui.add_space(4.0);
    context.files.find_previews();
    let gap = ui.spacing().item_spacing.x;
    let columns = (((ui.available_width() + gap) / (TILE + gap)) as usize).max(1);
    let width = (ui.available_width() + gap) / columns as f32 - gap;
    let numbers: Vec<usize> = (0..examples::ALL.len()).collect();
    for row in numbers.chunks(columns) {
        let texts: Vec<_> = row.iter().map(|number| texts(ui, *number, width)).collect();
        let heights = texts.iter().map(|[title, about]| title.size().y + about.size().y);
        let height = (heights.fold(PICTURE.y, f32::max) + 2.0 * ROOM).ceil();
        ui.horizontal(|ui| {
            for (number, texts) in row.iter().zip(texts) {
                tile(ui, context, (*number, texts), vec2(width, height));
            }
        });
    }
}

/// Width of the page, least width of a tile, size of the image in it, and room around it.
const WIDEST: f32 = 1240.0;
const TILE: f32 = 240.0;
const PICTURE: Vec2 = vec2(76.0, 56.0);
const ROOM: f32 = 6.0;

/// The title of an example and a line about it, wrapped behind its image.
fn texts(ui: &Ui, number: usize, width: f32) -> [Arc<Galley>; 2] {
    let example = &examples::ALL[number];
    let room = width - PICTURE.x - 3.0 * ROOM;
    let title = RichText::new(example.title()).strong();
    [title, note(ui, example.about)].map(|text| {
        let text = WidgetText::from(text);
        text.into_galley(ui, Some(TextWrapMode::Wrap), room, TextStyle::Body)
    })
}

/// An example: its body, its title, and a line about it.
fn tile(
    ui: &mut Ui,
    context: &mut PanelContext<'_>,
    (number, [title, about]): (usize, [Arc<Galley>; 2]),
    size: Vec2,
) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = examples::ALL[number].title();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if response.clicked() {
        context.actions.push(Action::Example(number));
    }
    if !ui.is_rect_visible(rect) {
        return;
    }
    let visuals = ui.style().interact(&response);
    ui.painter().rect(rect, 4.0, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    let picture = Rect::from_min_size(rect.min + vec2(ROOM, ROOM), PICTURE);
    if let Some(preview) = context.files.previews.of(number) {
        let items =
            preview.items([2.0 * PICTURE.x, 2.0 * PICTURE.y].map(|n| n as u32), 2.0 * LINES);
        shapes::draw(&ui.painter_at(picture), ImagePlacement::new(picture.min, 0.5), &items);
    }
    let mut corner = picture.right_top() + vec2(ROOM, 0.0);
    for text in [title, about] {
        let below = corner + vec2(0.0, text.size().y);
        ui.painter().galley(corner, text, ui.visuals().text_color());
        corner = below;
    }
}

/// Widths of lines and signs in parts of those of images.
const LINES: f64 = 0.45;

/// Files with their folders.
fn recent(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let recent = context.files.kept.recent.clone();
    if recent.is_empty() {
        ui.weak("None yet.");
    }
    for path in recent {
        ui.horizontal(|ui| {
            if ui.button(crate::files::name(&path)).clicked() {
                let pane = context.session.active;
                context.files.open(&path, pane, crate::files::read::Why::Opened);
            }
            let folder = path.parent().map(|folder| folder.display().to_string());
            ui.add(egui::Label::new(RichText::new(folder.unwrap_or_default()).weak()).truncate());
        });
    }
}
