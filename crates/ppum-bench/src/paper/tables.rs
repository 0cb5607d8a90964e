//! The report as tables.

use super::agreement::{Agreement, Difference};
use super::files::OpeningTime;
use super::scenes::SceneGroup;
use super::turns::{FrameTiming, Spent};
use super::{PaperReport, SceneRow};
use crate::frames::{DrawingDevice, FrameTimes, WAYS};
use crate::table::ReportTable;

const CPU: [DrawingDevice; 2] = [DrawingDevice::CpuF32, DrawingDevice::CpuF64];
const DEVICES: [DrawingDevice; 2] = [DrawingDevice::Gather, DrawingDevice::Splat];

/// Describes the measurement.
pub(super) fn words(report: &PaperReport) -> String {
    let [columns, rows] = report.pixels;
    format!(
        "{}\n\
         images of {columns}x{rows} pixels: displacement, gradient, von Mises stress, colours; order 2, two components,\n\
         four tip functions on a quarter of the area, if nothing else is said\n\
         milliseconds a frame, least / median of {} frames; paper: Üffinger et al. 2011, table 1, GeForce GTX 470\n",
        report.machine.words(),
        report.frames
    )
}

pub(super) fn tables(report: &PaperReport) -> Vec<ReportTable> {
    let groups = SceneGroup::ALL.into_iter().map(|group| times(report, group));
    let all = groups.chain([threads(report), files(report), differences(report)]);
    all.filter(|table| !table.rows.is_empty()).collect()
}

fn owned<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).into()
}

fn rows(report: &PaperReport, group: SceneGroup) -> impl Iterator<Item = &SceneRow> {
    report.rows.iter().filter(move |row| row.group == group)
}

/// The words that begin a row.
fn start(row: &SceneRow) -> Vec<String> {
    vec![row.scene.clone(), row.cover.to_owned(), row.patches.to_string()]
}

/// Processor time of one thread, the whole of the devices', and the paper's.
fn times(report: &PaperReport, group: SceneGroup) -> ReportTable {
    let head =
        owned(["scene", "cover", "patches", "paper", "cpu f32", "cpu f64", "gather", "splat"]);
    let line = |row: &SceneRow| {
        let paper = row.paper_ms.map(|ms| format!("{ms:.2}"));
        let cpu = CPU.map(|way| row.method(way).and_then(|timed| timed.one).map(core));
        let devices = DEVICES.map(|way| row.method(way).and_then(|timed| timed.all).map(core));
        let cells = [paper].into_iter().chain(cpu).chain(devices).map(Option::unwrap_or_default);
        start(row).into_iter().chain(cells).collect()
    };
    let note = match group {
        SceneGroup::Patches => {
            "Paper: wall time. CPU: CPU time of one thread. Gather and splat: CPU time of all threads where the device is \
             software, else wall time."
        }
        _ => "",
    };
    let rows = rows(report, group).map(line).collect();
    ReportTable { title: group.title().to_owned(), words: 2, head, rows, note: note.to_owned() }
}

/// Time that passes on one thread and on all of them.
fn threads(report: &PaperReport) -> ReportTable {
    let n = report.machine.threads;
    let mut head = owned(["scene", "cover", "patches"]);
    for way in CPU {
        let name = way.name();
        head.extend([format!("{name}, 1 thread"), format!("{n} threads"), "gain".to_owned()]);
    }
    let cells = |timed: Option<&FrameTiming>| {
        let time = |spent: Option<Spent>| spent.map(|s| pair(s.wall_ms)).unwrap_or_default();
        let gain = timed.and_then(|timed| timed.gain).map(|gain| format!("{gain:.2}"));
        let [one, all] = [timed.and_then(|t| t.one), timed.and_then(|t| t.all)].map(time);
        [one, all, gain.unwrap_or_default()]
    };
    let line = |row: &SceneRow| {
        let times = CPU.into_iter().flat_map(|way| cells(row.method(way)));
        start(row).into_iter().chain(times).collect()
    };
    ReportTable {
        title: "Threads: wall time".to_owned(),
        words: 2,
        head,
        rows: rows(report, SceneGroup::Patches).map(line).collect(),
        note: "Gain: median of one thread over that of all.".to_owned(),
    }
}

/// From a file to the first image.
fn files(report: &PaperReport) -> ReportTable {
    let line = |opening: &OpeningTime| {
        let OpeningTime { patches, bytes, open_ms, first_ms, upload_ms } = opening;
        let upload = upload_ms.map(number).unwrap_or_default();
        let (mega, rate) = (1e-6 * *bytes as f64, 1e-3 * *bytes as f64 / open_ms);
        vec![
            patches.to_string(),
            format!("{mega:.1}"),
            number(*open_ms),
            format!("{rate:.0}"),
            number(*first_ms),
            upload,
        ]
    };
    let head = ["patches", "MB", "open", "MB/s", "first image", "upload"];
    ReportTable {
        title: "From a file to the first image".to_owned(),
        words: 0,
        head: owned(head),
        rows: report.files.iter().map(line).collect(),
        note: "Milliseconds that pass on all threads, least of three; the file is in the system's memory. First image: from opening on, \
               by the CPU in f32."
            .to_owned(),
    }
}

/// Frames against the reference, and the negative control.
fn differences(report: &PaperReport) -> ReportTable {
    let mut head = owned(["scene", "cover", "patches"]);
    for way in WAYS {
        head.extend([way.name().to_owned(), "control".to_owned()]);
    }
    let line = |row: &SceneRow| {
        let cells = WAYS.into_iter().flat_map(|way| compared(row.method(way)));
        start(row).into_iter().chain(cells).collect()
    };
    let agreements = || report.rows.iter().flat_map(|row| &row.methods).filter_map(|t| t.agreement);
    let (count, wrong) = (agreements().count(), agreements().filter(|a| !a.holds).count());
    let controls: Vec<bool> = agreements().filter_map(|a| a.control).map(|c| c.caught).collect();
    let missed = controls.iter().filter(|caught| !**caught).count();
    let note = format!(
        "{count} frames compared with the reference, {wrong} wrong. {} controls with a wrong derivative of the weight, {} caught, \
         {missed} missed. In units of the local scale; cpu f64: the largest difference, at most 1e-12 on coarse covers; others, in f32: \
         that of 99 % of the pixels, at most 2e-5; both in proportion to the patches across beyond 12. Marked with !: beyond the limit, \
         or a control within it.",
        controls.len(),
        controls.len() - missed
    );
    let compared =
        report.rows.iter().filter(|row| row.methods.iter().any(|t| t.agreement.is_some()));
    ReportTable {
        title: "Differences from the reference".to_owned(),
        words: 2,
        head,
        rows: compared.map(line).collect(),
        note,
    }
}

/// The difference that counts, and the control's.
fn compared(timed: Option<&FrameTiming>) -> [String; 2] {
    let Some(agreement) = timed.and_then(|timed| timed.agreement) else {
        return Default::default();
    };
    let Agreement { difference, holds, control, .. } = agreement;
    let is_double = timed.is_some_and(|timed| timed.method == DrawingDevice::CpuF64.name());
    let text = |Difference { p99, largest }: Difference, is_good: bool| {
        let mark = if is_good { "" } else { "!" };
        format!("{mark}{:.0e}", if is_double { largest } else { p99 })
    };
    let control = control.map(|control| text(control.difference, control.caught));
    [text(difference, holds), control.unwrap_or_default()]
}

/// Least and median of processor time, or of time that passes where there is none.
fn core(spent: Spent) -> String {
    pair(spent.core())
}

/// The ways of a single dataset.
pub(super) fn methods(all: &[FrameTiming]) -> ReportTable {
    let head = owned(["method", "1 thread", "all threads", "processor of all"]);
    let cell = |spent: Option<Spent>, time: fn(Spent) -> FrameTimes| {
        spent.map(|spent| pair(time(spent))).unwrap_or_default()
    };
    let line = |FrameTiming { method, one, all, .. }: &FrameTiming| {
        let times = [(*one, true), (*all, true), (*all, false)];
        let cells = times
            .map(|(spent, is_wall)| cell(spent, if is_wall { |s| s.wall_ms } else { Spent::core }));
        [(*method).to_owned()].into_iter().chain(cells).collect()
    };
    let (title, rows) = ("Frames".to_owned(), all.iter().map(line).collect());
    ReportTable { title, words: 1, head, rows, note: String::new() }
}

fn pair(FrameTimes { least, median }: FrameTimes) -> String {
    format!("{} / {}", number(least), number(median))
}

/// Three digits.
fn number(ms: f64) -> String {
    match ms {
        ms if ms < 9.995 => format!("{ms:.2}"),
        ms if ms < 99.95 => format!("{ms:.1}"),
        ms => format!("{ms:.0}"),
    }
}
