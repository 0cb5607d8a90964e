//! The report of `ppum info --gpu`.

use std::io::{self, Write};

use serde::Serialize;

use crate::graphics::{Adapter, graphics, missing};

/// The graphics adapters of this machine, in the shape of the JSON.
#[derive(Debug, Serialize)]
pub(super) struct AdaptersReport {
    adapters: Vec<Adapter>,
}

impl AdaptersReport {
    /// Opens what each backend would open.
    pub(super) fn new() -> Self {
        let cards = graphics().cards;
        Self { adapters: cards.map_or_else(Vec::new, |cards| (cards.adapters)()) }
    }

    /// Writes text for people.
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.adapters.is_empty() {
            return writeln!(out, "{}", missing());
        }
        self.adapters.iter().try_for_each(|row| row.write(out))?;
        if !self.adapters.iter().any(|row| row.taken_by.contains(&"auto")) {
            writeln!(out, "--backend auto takes the CPU: none of these is graphics hardware")?;
        }
        Ok(())
    }
}

impl Adapter {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { name, kind, interface, driver, largest_texture, .. } = self;
        let taken_by = match self.taken_by.as_slice() {
            [] => "nothing".to_owned(),
            backends => format!("--backend {}", backends.join(", ")),
        };
        writeln!(out, "{name}")?;
        writeln!(out, "  kind         {kind}, by {interface}")?;
        writeln!(out, "  driver       {driver}")?;
        writeln!(out, "  binding      {} MiB", self.largest_binding_mib)?;
        writeln!(out, "  buffer       {} MiB", self.largest_buffer_mib)?;
        writeln!(out, "  texture      {largest_texture}x{largest_texture}")?;
        writeln!(out, "  can splat    {}", if self.splat { "yes" } else { "no" })?;
        writeln!(out, "  taken by     {taken_by}")
    }
}
