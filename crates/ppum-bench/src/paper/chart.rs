//! Times against the number of patches, as a chart.

use std::path::Path;

use ppum_figure::plot::{CurveStyle, PlotCurve};

use super::scenes::SceneGroup;
use super::turns::Spent;
use super::{PaperReport, SceneRow};
use crate::chart;
use crate::frames::DrawingDevice;

/// Draws the least wall times, so that those of the paper and of devices compare with the CPU's.
pub(super) fn save(report: &PaperReport, path: &Path) -> anyhow::Result<()> {
    let title = "Table 1 of Üffinger et al. 2011: a frame of 1024 × 768 pixels";
    chart::save(path, title, [("patches", ""), ("time", "ms")], curves(report))
}

fn curves(report: &PaperReport) -> Vec<PlotCurve> {
    let curve = |name: &str, cover: &str, time: &dyn Fn(&SceneRow) -> Option<f64>| {
        let rows = report.rows.iter().filter(|row| row.group == SceneGroup::Patches);
        let mut points: Vec<[f64; 2]> = rows
            .filter(|row| row.cover == cover)
            .filter_map(|row| Some([row.patches as f64, time(row)?]))
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        PlotCurve::new(name, points)
    };
    let least = |spent: Option<Spent>| spent.map(|spent| spent.wall_ms.least);
    let one = |way| move |row: &SceneRow| least(row.method(way)?.one);
    let all = |way| move |row: &SceneRow| least(row.method(way)?.all);
    let n = report.machine.threads;
    let dotted = [
        curve("splat, software, all threads", "uniform", &all(DrawingDevice::Splat)),
        curve("gather, software, all threads", "uniform", &all(DrawingDevice::Gather)),
        curve("CPU f64, 1 thread", "uniform", &one(DrawingDevice::CpuF64)),
        curve("CPU f32, 1 thread", "uniform", &one(DrawingDevice::CpuF32)),
        curve("CPU f32, 1 thread, graded", "graded", &one(DrawingDevice::CpuF32)),
        curve(&format!("CPU f32, {n} threads"), "uniform", &all(DrawingDevice::CpuF32)),
    ];
    let dotted = dotted.into_iter().map(|curve| curve.with_look(CurveStyle::Dotted));
    let paper = curve("the paper, GeForce GTX 470", "uniform", &|row| row.paper_ms);
    let all = dotted.chain([paper.with_look(CurveStyle::Dashed)]);
    all.filter(|curve| !curve.points.is_empty()).collect()
}
