//! Saving what is seen: a picture, a figure, a moving picture; and the command that draws it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{ComboBox, DragValue, Grid, Key, Modifiers, TextEdit, Ui, Window};
use ppum_scene::moving::Moving;

use crate::export::{ExportChoice, ExportKind, Order};
use crate::field::OwnedField;
use crate::frames::Frame;
use crate::job::Job;
use crate::replacing::{ASK, Replacing};
use crate::session::Pane;
use crate::stage::Stage;

/// What is to be written, while one chooses it and while it is made.
pub struct Exporter {
    what: ExportChoice,
    path: String,
    size: [u32; 2],
    /// Pictures a second.
    rate: f64,
    /// Pictures of the deformation's coming and going.
    count: usize,
    job: Option<Job<Result<String, String>>>,
    told: Option<Result<String, String>>,
    replacing: Replacing,
    /// The name is written next.
    is_new: bool,
}

/// Largest side of a page.
const MOST: u32 = 16_384;

impl Exporter {
    /// Begins with a kind, and the size and name that suit what is seen.
    #[must_use]
    pub fn new(what: ExportChoice, stage: &Stage) -> Self {
        let size = stage.view.map_or([1024, 768], |view| view.pixels);
        let path = match &stage.opened {
            Some(opened) => beside(opened.path.as_deref(), what.ends()[0]),
            None => String::new(),
        };
        Self {
            what,
            path,
            size,
            rate: 12.0,
            count: 36,
            job: None,
            told: None,
            replacing: Replacing::default(),
            is_new: true,
        }
    }

    /// Moves as fast as the player shows the steps \[images a second\].
    #[must_use]
    pub fn as_fast_as(mut self, player: f64) -> Self {
        if self.what == ExportChoice::Steps {
            self.rate = player;
        }
        self
    }

    /// Shows the choice; false once it is closed.
    pub fn show(&mut self, ui: &Ui, pane: &Pane, stage: &Stage) -> bool {
        self.finish();
        let mut is_open = true;
        let has_list = egui::Popup::is_any_open(ui.ctx());
        let window = Window::new("Save").open(&mut is_open).collapsible(false).resizable(false);
        window.show(ui.ctx(), |ui| match stage.frame() {
            Some(frame) => self.choose(ui, pane, stage, frame),
            None => {
                ui.label("There is no picture yet.");
            }
        });
        // Escape closes a list first
        let is_closed =
            !has_list && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        is_open && !is_closed
    }

    fn choose(&mut self, ui: &mut Ui, pane: &Pane, stage: &Stage, frame: &Arc<Frame>) {
        let grid = Grid::new("save").num_columns(2);
        let is_entered = grid.show(ui, |ui| self.fields(ui, frame)).inner;
        let order = self.order(pane, stage, frame);
        let path = PathBuf::from(self.path.trim());
        let refused = self.refused(&path, order.file.as_deref());
        ui.horizontal(|ui| {
            let is_ready = refused.is_none() && self.job.is_none();
            let button = ui.add_enabled(is_ready, egui::Button::new("Save file"));
            if button.clicked() || (is_entered && is_ready) {
                self.save(ui, (order.clone(), frame.factor), path.clone());
            }
            if let Some(job) = &self.job {
                ui.spinner();
                if ui.button("Stop").clicked() {
                    job.cancel();
                }
            }
        });
        if let Some(reason) = refused {
            ui.colored_label(ui.visuals().warn_fg_color, reason);
        }
        match &self.told {
            Some(Ok(told)) => {
                ui.label(told);
            }
            Some(Err(error)) => {
                ui.colored_label(ui.visuals().error_fg_color, error);
            }
            None => {}
        }
        if self.what != ExportChoice::Deformation {
            ui.separator();
            command(ui, &order.command(&path));
        }
    }

    /// The fields; true if Enter has finished the name.
    fn fields(&mut self, ui: &mut Ui, frame: &Frame) -> bool {
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
            let ends = self.what.ends();
            let path = Path::new(&self.path);
            let fits = ends.iter().any(|end| path.extension().is_some_and(|e| e == *end));
            if !fits {
                self.path = path.with_extension(ends[0]).to_string_lossy().into_owned();
            }
        }
        let label = ui.label("File");
        let name = ui.add(TextEdit::singleline(&mut self.path).desired_width(340.0));
        let name = name.labelled_by(label.id);
        if std::mem::take(&mut self.is_new) {
            name.request_focus();
        }
        let is_entered = name.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.end_row();
        ui.label("Pixels");
        ui.horizontal(|ui| {
            for side in &mut self.size {
                ui.add(DragValue::new(side).range(1..=MOST).speed(4.0));
            }
        });
        ui.end_row();
        if matches!(self.what, ExportChoice::Steps | ExportChoice::Deformation) {
            ui.label("Pictures a second");
            ui.add(DragValue::new(&mut self.rate).range(0.1..=60.0).speed(0.1));
            ui.end_row();
        }
        if self.what == ExportChoice::Deformation {
            ui.label("Pictures");
            ui.add(DragValue::new(&mut self.count).range(2..=600));
            ui.end_row();
        }
        is_entered
    }

    fn order(&self, pane: &Pane, stage: &Stage, frame: &Arc<Frame>) -> Order {
        let steps = (0..frame.field.dataset().steps.len()).collect();
        Order {
            field: Arc::clone(&frame.field),
            file: stage.opened.as_ref().and_then(|opened| opened.path.clone()),
            left: frame.left(),
            scene: pane.scene.drawn(),
            view: stage.view.unwrap_or(frame.wanted.view),
            size: self.size,
            kind: match self.what {
                ExportChoice::Picture => ExportKind::Picture,
                ExportChoice::Figure => ExportKind::Figure,
                ExportChoice::Steps => ExportKind::Moving(Moving::Steps(steps), self.rate),
                ExportChoice::Deformation => ExportKind::Moving(
                    Moving::Factor(frame.factor.unwrap_or(1.0), self.count),
                    self.rate,
                ),
            },
        }
    }

    /// The reason why the file cannot be written under its name, if there is one.
    fn refused(&self, path: &Path, dataset: Option<&Path>) -> Option<String> {
        if path.as_os_str().is_empty() {
            return Some("Write the name of a file.".into());
        }
        let ends = self.what.ends();
        let fits = |end: &&&str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
        if !ends.iter().any(|end| fits(&end)) {
            return Some(format!("The name must end in .{}.", ends.join(", .")));
        }
        let is_input = dataset.is_some_and(|dataset| ppum_file::is_same(dataset, path));
        is_input.then(|| "This file is the dataset itself; choose another name.".into())
    }

    /// Begins to write; the factor of a plate that is not deformed is looked for then.
    fn save(&mut self, ui: &Ui, (mut order, factor): (Order, Option<f64>), path: PathBuf) {
        if !self.replacing.allows(&path) {
            self.told = Some(Err(format!("{}: {ASK}", path.display())));
            return;
        }
        self.told = None;
        self.job = Some(Job::start(ui.ctx(), move |stop| {
            if let (ExportKind::Moving(Moving::Factor(unknown, _), _), None) =
                (&mut order.kind, factor)
            {
                *unknown = automatic(&order.field).unwrap_or(1.0);
            }
            let (bytes, notices) = order.bytes(&path, stop)?;
            write(&path, &bytes)?;
            let notices = notices.iter().map(|notice| format!("\n{}", notice.line()));
            Ok(format!("wrote {}{}", path.display(), notices.collect::<String>()))
        }));
    }

    fn finish(&mut self) {
        let Some(outcome) = self.job.as_ref().and_then(Job::poll) else { return };
        self.job = None;
        self.told = Some(outcome.and_then(|outcome| outcome));
    }
}

/// The command that draws the picture, to be copied.
pub fn command(ui: &mut Ui, command: &Result<String, String>) {
    match command {
        Ok(command) => {
            ui.horizontal(|ui| {
                ui.strong("The same on the command line");
                if ui.button("Copy").clicked() {
                    ui.ctx().copy_text(command.clone());
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

/// The factor that shows the largest displacement as some 5 % of the plate.
fn automatic(field: &OwnedField) -> Option<f64> {
    ppum_scene::deformed::Factor::Auto.number(&[field.field()]).ok()
}

/// A name beside the dataset's.
fn beside(dataset: Option<&Path>, end: &str) -> String {
    let path = dataset.map_or_else(|| PathBuf::from("picture"), Path::to_path_buf);
    path.with_extension(end).to_string_lossy().into_owned()
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    ppum_file::replace(path, |out| out.write_all(bytes))
        .map_err(|error: std::io::Error| format!("{}: {error}", path.display()))
}
