//! What `ppum info --gpu` tells.

use std::io::{self, Write};

use ppum_gpu::{AdapterInfo, Choice, Gpu, adapters};
use serde::Serialize;

use crate::drivers;

/// The graphics adapters of this machine, in the shape of the JSON.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    adapters: Vec<Row>,
}

/// An adapter.
#[derive(Debug, Serialize)]
struct Row {
    name: String,
    kind: &'static str,
    interface: String,
    driver: String,
    largest_binding_mib: u64,
    largest_buffer_mib: u64,
    largest_texture: u32,
    /// It can splat.
    splat: bool,
    /// The values of `--backend` that take it.
    taken_by: Vec<&'static str>,
}

const MISSING: &str = "\
no graphics adapter: this machine has no Vulkan, Metal or Direct3D 12 driver that this program can use.
Pictures are drawn on the CPU, which is exact and quick. For drawing on a graphics card install its driver;
for trying out --backend gpu without a card a software driver does:
  Debian, Ubuntu   apt-get install libvulkan1 mesa-vulkan-drivers
  Fedora           dnf install vulkan-loader mesa-vulkan-drivers
  Arch             pacman -S vulkan-icd-loader vulkan-swrast";

impl Report {
    /// Opens what each backend would open.
    pub(super) fn new() -> Self {
        drivers::opening(Self::found)
    }

    fn found() -> Self {
        let taken = [("auto", Choice::Real), ("gpu", Choice::Any), ("splat", Choice::Any)]
            .map(|(backend, choice)| (backend, Gpu::open(choice).ok()));
        let row = |info: AdapterInfo| {
            let by = |(backend, gpu): &(&'static str, Option<Gpu>)| {
                let takes = gpu.as_ref().is_some_and(|gpu| *gpu.info() == info);
                (takes && (*backend != "splat" || info.blends_floats)).then_some(*backend)
            };
            Row::new(&info, taken.iter().filter_map(by).collect())
        };
        Self { adapters: adapters().into_iter().map(row).collect() }
    }

    /// The same for people.
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.adapters.is_empty() {
            return writeln!(out, "{MISSING}");
        }
        self.adapters.iter().try_for_each(|row| row.write(out))?;
        if !self.adapters.iter().any(|row| row.taken_by.contains(&"auto")) {
            writeln!(out, "--backend auto takes the CPU: none of these is graphics hardware")?;
        }
        Ok(())
    }
}

impl Row {
    fn new(info: &AdapterInfo, taken_by: Vec<&'static str>) -> Self {
        const MIB: u64 = 1 << 20;
        Self {
            name: info.name.clone(),
            kind: info.kind.name(),
            interface: info.backend.clone(),
            driver: info.driver.clone(),
            largest_binding_mib: info.largest_storage_binding / MIB,
            largest_buffer_mib: info.largest_buffer / MIB,
            largest_texture: info.largest_texture,
            splat: info.blends_floats,
            taken_by,
        }
    }

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
