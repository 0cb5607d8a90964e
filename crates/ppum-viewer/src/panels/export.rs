//! Saving what is seen: an image, a figure, an animation; and the command that draws it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use egui::{ComboBox, DragValue, Grid, Key, Modifiers, TextEdit, Ui, Window};
use ppum_scene::help::tooltip;
use ppum_scene::request::FigureTexts;

use crate::export::{ExportChoice, ImageExport, LengthUnit, Motion, PageSize};
use crate::frames::RenderedFrame;
use crate::job::BackgroundJob;
use crate::save_target::{SaveTarget, replace};
use crate::session::Pane;
use crate::viewport::{OpenDataset, ViewState};
use crate::widgets::note_folder;

/// The export dialog, while it is open and while the file is made.
pub struct Exporter {
    what: ExportChoice,
    target: SaveTarget,
    page: PageSize,
    /// The page of the other kinds.
    other: PageSize,
    motion: Motion,
    texts: FigureTexts,
    job: Option<BackgroundJob<Result<String, String>>>,
    /// Images of an animation that were worked on, in both passes.
    done: Arc<AtomicUsize>,
    /// The name is written next.
    is_new: bool,
}

/// Largest side of a page \[pixels\].
const MOST: f64 = 16_384.0;

impl Exporter {
    /// Begins with a kind, and the size and name that suit what is seen; the steps move as fast as
    /// the player shows them \[images a second\].
    #[must_use]
    pub fn new(what: ExportChoice, viewport: &ViewState, player: f64) -> Self {
        let pixels = PageSize::pixels(viewport.camera.view.map_or([1024, 768], |view| view.pixels));
        let (page, other) = match what {
            ExportChoice::Figure => (PageSize::COLUMN, pixels),
            _ => (pixels, PageSize::COLUMN),
        };
        let mut motion = Motion::default();
        if what == ExportChoice::Steps {
            motion.rate = player;
        }
        let beside = |opened: &OpenDataset| {
            let path = opened.path.as_deref().unwrap_or(Path::new("picture"));
            path.with_extension(what.ends()[0]).to_string_lossy().into_owned()
        };
        let target = SaveTarget::new(viewport.opened.as_ref().map_or(String::new(), beside));
        let done = Arc::default();
        let texts = FigureTexts::default();
        Self { what, target, page, other, motion, texts, job: None, done, is_new: true }
    }

    /// Shows the choice; false once it is closed.
    pub fn show(&mut self, ui: &Ui, pane: &Pane, viewport: &mut ViewState) -> bool {
        if let Some(outcome) = self.job.as_ref().and_then(BackgroundJob::poll) {
            self.job = None;
            self.target.result = Some(outcome.flatten());
        }
        let mut is_open = true;
        let has_list = egui::Popup::is_any_open(ui.ctx());
        let window = Window::new("Save").open(&mut is_open).collapsible(false).resizable(false);
        let at = ui.ctx().content_rect().center_top() + egui::vec2(0.0, 60.0);
        let window = window.pivot(egui::Align2::CENTER_TOP).default_pos(at);
        window.show(ui.ctx(), |ui| match viewport.frame().cloned() {
            Some(frame) => self.choose(ui, pane, viewport, &frame),
            None => drop(ui.label("There is no image yet.")),
        });
        // Escape closes a list first
        let is_closed =
            !has_list && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        is_open && !is_closed
    }

    fn choose(
        &mut self,
        ui: &mut Ui,
        pane: &Pane,
        viewport: &mut ViewState,
        frame: &Arc<RenderedFrame>,
    ) {
        let grid = Grid::new("save").num_columns(2);
        let file = viewport.opened.as_ref().and_then(|opened| opened.path.as_deref());
        let is_entered = grid.show(ui, |ui| self.fields(ui, frame, file)).inner;
        let kind = (self.what, self.motion);
        let Some(order) = viewport.export(pane, kind, Some(self.page)) else { return };
        let order = ImageExport { texts: self.texts.clone(), ..order };
        let path = self.path(order.file.as_deref());
        let refused = SaveTarget::refusal(&path, self.what.ends(), order.file.as_deref());
        ui.horizontal(|ui| {
            let is_ready = refused.is_none() && self.job.is_none();
            let button = ui.add_enabled(is_ready, egui::Button::new("Save file"));
            if button.clicked() || (is_entered && is_ready) {
                self.save(ui, order.clone(), path.clone());
            }
            if let Some(job) = &self.job {
                ui.spinner();
                if ui.button("Stop").clicked() {
                    job.cancel();
                }
                if self.what.is_moving() {
                    ui.label(progress(self.done.load(Ordering::Relaxed), order.count()));
                    ui.ctx().request_repaint_after(Duration::from_millis(200));
                }
            }
        });
        if let Some(reason) = refused {
            ui.colored_label(ui.visuals().warn_fg_color, reason);
        }
        self.target.show_result(ui);
        if self.what != ExportChoice::Deformation {
            ui.separator();
            command(ui, &order.command(&path));
        }
    }

    /// The fields; true if Enter has finished the name.
    fn fields(&mut self, ui: &mut Ui, frame: &RenderedFrame, file: Option<&Path>) -> bool {
        let before = self.what;
        ui.label("Kind");
        ComboBox::from_id_salt("kind").selected_text(self.what.name()).show_ui(ui, |ui| {
            for what in ExportChoice::ALL {
                let can = match what {
                    ExportChoice::Steps => frame.field.dataset().steps.len() > 1,
                    ExportChoice::Deformation => frame.field.field().equation.elastic().is_some(),
                    _ => true,
                };
                let choice = egui::Button::selectable(self.what == what, what.name());
                if ui.add_enabled(can, choice).clicked() {
                    self.what = what;
                }
            }
        });
        ui.end_row();
        if self.what != before {
            self.change_from(before);
        }
        ui.label("Format");
        self.format(ui);
        ui.end_row();
        let label = ui.label("File");
        let width = (ui.ctx().content_rect().width() - 180.0).clamp(120.0, 340.0);
        let name = ui.add(TextEdit::singleline(&mut self.target.name).desired_width(width));
        let name = name.labelled_by(label.id).on_hover_text(&self.target.name);
        if std::mem::take(&mut self.is_new) {
            name.request_focus();
        }
        let is_entered = name.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.end_row();
        if !self.target.name.trim().is_empty() {
            ui.label("");
            ui.scope(|ui| {
                ui.set_max_width(width);
                note_folder(ui, &self.path(file));
            });
            ui.end_row();
        }
        size(ui, &mut self.page, self.what == ExportChoice::Figure);
        if self.what != ExportChoice::Image {
            texts(ui, &mut self.texts, width);
        }
        if self.what.is_moving() {
            ui.label("Images a second");
            ui.add(DragValue::new(&mut self.motion.rate).range(0.1..=60.0).speed(0.1));
            ui.end_row();
        }
        if self.what == ExportChoice::Deformation {
            ui.label("Images");
            ui.add(DragValue::new(&mut self.motion.count).range(2..=600));
            ui.end_row();
        }
        is_entered
    }

    /// Another kind has other forms, and a figure a size on paper.
    fn change_from(&mut self, before: ExportChoice) {
        if !self.what.ends().contains(&self.end().as_str()) {
            self.set_end(self.what.ends()[0]);
        }
        if (self.what == ExportChoice::Figure) != (before == ExportChoice::Figure) {
            std::mem::swap(&mut self.page, &mut self.other);
        }
    }

    /// The list of the forms of the file, which its name ends in.
    fn format(&mut self, ui: &mut Ui) {
        let end = self.end();
        ComboBox::from_id_salt("format").selected_text(end.to_uppercase()).show_ui(ui, |ui| {
            for one in self.what.ends() {
                if ui.selectable_label(end == *one, one.to_uppercase()).clicked() {
                    self.set_end(one);
                }
            }
        });
    }

    fn end(&self) -> String {
        let end = Path::new(self.target.name.trim()).extension().unwrap_or_default();
        end.to_string_lossy().to_lowercase()
    }

    fn set_end(&mut self, end: &str) {
        let name = Path::new(self.target.name.trim()).with_extension(end);
        self.target.name = name.to_string_lossy().into_owned();
    }

    /// The file: beside the dataset where its name has no folder.
    fn path(&self, dataset: Option<&Path>) -> PathBuf {
        let name = Path::new(self.target.name.trim());
        let folder = dataset.and_then(Path::parent).filter(|_| name.file_name().is_some());
        folder.map_or_else(|| name.to_owned(), |folder| folder.join(name))
    }

    /// Begins to write.
    fn save(&mut self, ui: &Ui, order: ImageExport, path: PathBuf) {
        if let Some(reason) = self.target.refuses(&path, self.what.ends(), order.file.as_deref()) {
            self.target.result = Some(Err(reason));
            return;
        }
        self.target.result = None;
        let done = Arc::clone(&self.done);
        done.store(0, Ordering::Relaxed);
        self.job = Some(BackgroundJob::start(ui.ctx(), move |stop| {
            let (bytes, notices) = order.bytes(&path, stop, &done)?;
            replace(&path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
            let notices = notices.iter().map(|notice| format!("\n{}", notice.line()));
            Ok(format!("Saved {}{}", path.display(), notices.collect::<String>()))
        }));
    }
}

/// The rows of the texts of a figure.
fn texts(ui: &mut Ui, texts: &mut FigureTexts, width: f32) {
    for (name, text) in [
        ("Title", &mut texts.title),
        ("x axis", &mut texts.x),
        ("y axis", &mut texts.y),
        ("Colour bar", &mut texts.bar),
    ] {
        let label = ui.label(name);
        let mut written = text.clone().unwrap_or_default();
        let field = TextEdit::singleline(&mut written).hint_text("automatic");
        if ui.add(field.desired_width(width)).labelled_by(label.id).changed() {
            *text = Some(written).filter(|text| !text.is_empty());
        }
        ui.end_row();
    }
}

/// The rows of a size. A figure has one on paper, whose height is that of what is shown unless
/// another is given; other pages have pixels.
fn size(ui: &mut Ui, page: &mut PageSize, is_figure: bool) {
    let is_paper = page.unit != LengthUnit::Pixel;
    ui.label("Width");
    ui.horizontal(|ui| {
        side(ui, "Width of the page", &mut page.width, is_paper);
        if is_figure {
            unit(ui, page);
        } else {
            ui.label("pixels");
        }
    });
    ui.end_row();
    ui.label("Height");
    ui.horizontal(|ui| {
        if is_figure && is_paper {
            let mut is_found = page.height.is_none();
            let text = "As high as what is shown needs at this width";
            if ui.checkbox(&mut is_found, "as shown").on_hover_text(text).changed() {
                page.height = (!is_found).then_some(0.75 * page.width);
            }
        }
        if let Some(height) = &mut page.height {
            side(ui, "Height of the page", height, is_paper);
        }
    });
    ui.end_row();
    if is_figure && is_paper {
        ui.label("Letters");
        let letters = DragValue::new(&mut page.font_size).range(4.0..=40.0).speed(0.1);
        let letters = ui.add(letters.suffix(" pt")).accessible_name("Size of the letters");
        letters.on_hover_text(tooltip("font_size"));
        ui.end_row();
        ui.label("Resolution");
        let dpi = DragValue::new(&mut page.dpi).range(50.0..=1200.0).max_decimals(0);
        let dpi = ui.add(dpi.suffix(" pixels per inch")).accessible_name("Resolution");
        dpi.on_hover_text(tooltip("dpi"));
        ui.end_row();
    }
}

fn unit(ui: &mut Ui, page: &mut PageSize) {
    let (name, _) = page.unit.words();
    ComboBox::from_id_salt("unit").selected_text(name).width(60.0).show_ui(ui, |ui| {
        for one in LengthUnit::ALL {
            if ui.selectable_label(page.unit == one, one.words().0).clicked() {
                *page = page.in_unit(one);
                if one == LengthUnit::Pixel {
                    page.height.get_or_insert((0.75 * page.width).round());
                }
            }
        }
    });
}

fn side(ui: &mut Ui, name: &str, value: &mut f64, is_paper: bool) {
    let (most, speed, decimals) = if is_paper { (200.0, 0.05, 2) } else { (MOST, 4.0, 0) };
    let least = if is_paper { 0.5 } else { 1.0 };
    let field = DragValue::new(value).range(least..=most).speed(speed).max_decimals(decimals);
    ui.add(field).accessible_name(name);
}

/// How far an animation has come: its range is found in a first pass over all images.
fn progress(done: usize, count: usize) -> String {
    match done.checked_sub(count) {
        None => format!("range of image {} of {count}", done + 1),
        Some(drawn) => format!("image {} of {count}", (drawn + 1).min(count)),
    }
}

/// The command that draws the image, to be copied.
pub fn command(ui: &mut Ui, command: &Result<String, String>) {
    match command {
        Ok(command) => {
            ui.horizontal(|ui| {
                ui.strong("The same on the command line");
                let id = ui.scope_id().with("copied");
                let is_copied = ui.data(|data| data.get_temp(id)) == Some(command.clone());
                if ui.button(if is_copied { "Copied" } else { "Copy" }).clicked() {
                    ui.ctx().copy_text(command.clone());
                    ui.data_mut(|data| data.insert_temp(id, command.clone()));
                }
            });
            let mut shown = command.as_str();
            let text = TextEdit::multiline(&mut shown).code_editor().desired_rows(2);
            ui.add(text.desired_width(ui.available_width().max(340.0)));
        }
        Err(error) => {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
    }
}
