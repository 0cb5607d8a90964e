//! The window: frames of panning, the first picture, and what it does when nothing happens.

use std::io::{self, Write};

use serde::Serialize;

/// The report of `ppum bench window`.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pixels: [u32; 2],
    frames: u32,
    /// What draws the window itself.
    device: String,
    rows: Vec<Row>,
}

/// The frames of a dataset.
#[derive(Debug, Serialize)]
struct Row {
    patches: usize,
    /// From opening to the first picture on the screen, without reading a file.
    first_ms: f64,
    /// A frame of panning, and the parts of it.
    frame_ms: Summary,
    /// Processor time of all threads for a frame, the device's of software too.
    core_ms: Summary,
    /// The same of a window in which nothing has changed: egui's own layout and drawing.
    again_ms: Summary,
    again_core_ms: Summary,
    layout_ms: Summary,
    picture_ms: Summary,
    upload_ms: Summary,
    paint_ms: Summary,
    /// Processor time in a second in which nothing happens.
    idle_ms: f64,
    /// True if the window wants to be shown then.
    idle_repaints: bool,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Summary {
    median: f64,
    least: f64,
    /// That of 95 % of the frames.
    most: f64,
}

impl Report {
    /// Writes a table.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let [columns, rows] = self.pixels;
        writeln!(
            out,
            "window of {columns}x{rows} pixels, drawn by {}: dragging the plate, von Mises stress\n\
             ms, medians of {} frames: input and layout, picture, upload, painting; 95 % take no longer than `most`",
            self.device, self.frames
        )?;
        let heads = [
            "patches", "first", "frame", "most", "layout", "picture", "upload", "paint", "core",
            "again", "core", "idle/s",
        ];
        let line =
            |words: Vec<String>| words.iter().map(|word| format!("{word:>9}")).collect::<String>();
        writeln!(out, "{}", line(heads.map(str::to_owned).to_vec()))?;
        for row in &self.rows {
            let parts = [row.layout_ms, row.picture_ms, row.upload_ms, row.paint_ms];
            let numbers = [row.first_ms, row.frame_ms.median, row.frame_ms.most];
            let numbers = numbers.into_iter().chain(parts.map(|part| part.median));
            let cores = [row.core_ms, row.again_ms, row.again_core_ms].map(|part| part.median);
            let numbers = numbers.chain(cores).chain([row.idle_ms]);
            let words = numbers.map(|number| format!("{number:.1}"));
            writeln!(
                out,
                "{}",
                line([row.patches.to_string()].into_iter().chain(words).collect())
            )?;
        }
        Ok(())
    }
}

#[cfg(not(feature = "window"))]
impl Report {
    /// Says how to get the window.
    pub(super) fn new(_: bool, _: u32) -> anyhow::Result<Self> {
        anyhow::bail!(
            "this program was built without the window; build it with \
             `cargo install --locked --path crates/ppum-cli --features window`"
        )
    }
}

#[cfg(feature = "window")]
mod measure {
    use std::sync::Arc;
    use std::time::Duration;

    use cpu_time::ProcessTime;
    use ppum_viewer::frames::Backend;
    use ppum_viewer::timing::{FrameTime, Measured, TimingError};

    use super::super::synthetic::Recipe;
    use super::{Report, Row, Summary};

    /// Levels of uniform covers: 4^level patches.
    const LEVELS: [u8; 3] = [4, 7, 10];

    impl Report {
        /// Measures; `quick` shows few patches on few pixels.
        pub(in super::super) fn new(quick: bool, frames: u32) -> anyhow::Result<Self> {
            let pixels = if quick { [320, 240] } else { [1280, 800] };
            let levels = if quick { &LEVELS[..1] } else { &LEVELS[..] };
            let (mut rows, mut device) = (Vec::new(), String::new());
            for &level in levels {
                let dataset = Arc::new(Recipe::new(level, level).dataset()?);
                let patches = dataset.steps[0].partition.len();
                let open = || Measured::new(dataset, pixels, Backend::Auto);
                let mut window = crate::graphics::opening(open)?;
                device = window.device();
                // the pictures open devices of their own
                let row = || Row::new(patches, &mut window, frames);
                rows.push(crate::graphics::opening(row)?);
            }
            Ok(Self { pixels, frames, device, rows })
        }
    }

    impl Row {
        fn new(patches: usize, window: &mut Measured, frames: u32) -> anyhow::Result<Self> {
            let first_ms = 1e3 * window.first()?;
            window.rest()?;
            let (times, cores) = dragged(window, frames)?;
            window.rest()?;
            let mut again = (0..frames).map(|_| with_core(|| window.again()));
            let again = again.by_ref().collect::<Result<Vec<_>, _>>()?;
            let idle_repaints = window.idle() < Duration::from_secs(3600);
            let core = ProcessTime::now();
            std::thread::sleep(Duration::from_secs(1));
            let idle_ms = 1e3 * core.elapsed().as_secs_f64();
            let again_ms = Summary::new(again.iter().map(|(time, _)| time.total()).collect());
            let again_core_ms = Summary::new(again.iter().map(|(_, core)| *core).collect());
            let of = |part: fn(&FrameTime) -> f64| Summary::new(times.iter().map(part).collect());
            Ok(Self {
                patches,
                first_ms,
                frame_ms: of(FrameTime::total),
                core_ms: Summary::new(cores),
                again_ms,
                again_core_ms,
                layout_ms: of(|time| time.layout),
                picture_ms: of(|time| time.picture),
                upload_ms: of(|time| time.upload),
                paint_ms: of(|time| time.paint),
                idle_ms,
                idle_repaints,
            })
        }
    }

    /// Drags the plate around in a circle, some 14 pixels a frame: frames, and seconds of processors.
    fn dragged(window: &mut Measured, frames: u32) -> anyhow::Result<(Vec<FrameTime>, Vec<f64>)> {
        window.press();
        let step = |frame: u32| {
            let (sin, cos) = (0.1 * f64::from(frame)).sin_cos();
            [14.0 * cos, 14.0 * sin].map(|by| by.round() as f32)
        };
        // the first ones find nothing prepared, and are not counted
        let all = (0..frames + WARM).map(|frame| with_core(|| window.drag(step(frame))));
        let times = all.skip(WARM as usize).collect::<Result<Vec<_>, _>>()?;
        window.release();
        Ok(times.into_iter().unzip())
    }

    /// A frame, and the seconds of processors that it took.
    fn with_core(
        frame: impl FnOnce() -> Result<FrameTime, TimingError>,
    ) -> Result<(FrameTime, f64), TimingError> {
        let core = ProcessTime::now();
        let time = frame()?;
        Ok((time, core.elapsed().as_secs_f64()))
    }

    const WARM: u32 = 3;

    impl Summary {
        /// Of seconds.
        fn new(seconds: Vec<f64>) -> Self {
            let mut ms: Vec<_> = seconds.into_iter().map(|s| 1e3 * s).collect();
            ms.sort_by(f64::total_cmp);
            let (lower, upper) = (ms[(ms.len() - 1) / 2], ms[ms.len() / 2]);
            let most = ms[(ms.len() - 1) * 95 / 100];
            Self { median: 0.5 * (lower + upper), least: ms[0], most }
        }
    }
}
