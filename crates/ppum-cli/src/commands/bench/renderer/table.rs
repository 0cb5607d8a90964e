//! The measurements, for people.

use std::io::{self, Write};

use super::{Adapter, Report, Row, Timed, WAYS};

impl Report {
    /// Writes a table; `threads` is their number on the CPU.
    pub(in super::super) fn print(&self, threads: usize, out: &mut dyn Write) -> io::Result<()> {
        let ([columns, rows], frames) = (self.pixels, self.frames);
        let what = match self.rows.first() {
            Some(Row { cover: "file", .. }) => "of the dataset's last step",
            _ => {
                "order 2, two components, four tip functions on a quarter\nof the area; displacement, \
                 gradient, von Mises stress, colours"
            }
        };
        writeln!(
            out,
            "pictures of {columns}x{rows} pixels: {what}\n\
             ms per frame, medians of {frames}: wall time / processor time of all threads; {threads} on the CPU"
        )?;
        match &self.adapter {
            Some(Adapter { name, kind }) => writeln!(out, "splat and gather by {name}, {kind}")?,
            None => {
                let missing = self.missing.as_deref().unwrap_or_default();
                writeln!(out, "splat and gather are missing: {missing}")?;
            }
        }
        let ways: String = WAYS.iter().map(|way| format!("{:>17}", way.name())).collect();
        writeln!(out, "{:<8}{:>8}{ways}{:>14}{:>8}", "cover", "patches", "splat/gather", "paper")?;
        self.rows.iter().try_for_each(|row| writeln!(out, "{}", row.line().trim_end()))?;
        if let Some(growth) = self.gather_growth {
            writeln!(out, "gather, most patches over 16: {growth:.2}")?;
        }
        writeln!(out, "paper: Üffinger et al. 2011, table 1, wall time on a GeForce GTX 470")
    }
}

impl Row {
    fn line(&self) -> String {
        let time = |name| self.methods.iter().find(|timed| timed.method == name);
        let text = |name| time(name).map_or_else(|| "–".to_owned(), Timed::text);
        let times: String = WAYS.iter().map(|way| format!("{:>17}", text(way.name()))).collect();
        let number = |value: Option<f64>| value.map_or_else(String::new, |v| format!("{v:.2}"));
        let (ratio, paper) = (number(self.splat_over_gather), number(self.paper_ms));
        format!("{:<8}{:>8}{times}{ratio:>14}{paper:>8}", self.cover, self.patches)
    }
}

impl Timed {
    fn text(&self) -> String {
        let core = self.core_ms.map(|core| format!(" / {:.1}", core.median)).unwrap_or_default();
        format!("{:.1}{core}", self.wall_ms.median)
    }
}
