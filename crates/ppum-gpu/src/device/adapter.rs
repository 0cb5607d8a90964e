//! The graphics adapters of this machine, and which of them is taken.

use wgpu::{Adapter, Backends, DeviceType, Features, InstanceDescriptor, InstanceFlags};

use crate::choice::{AdapterChoice, AdapterKind};
use crate::error::GpuError;

/// A graphics adapter and its limits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterInfo {
    /// Name, as the driver gives it.
    pub name: String,
    /// The kind of device.
    pub kind: AdapterKind,
    /// The interface it is driven by: `vulkan`, `metal`, `dx12`, in a browser `webgpu`.
    pub backend: String,
    /// Name and version of the driver; may be empty.
    pub driver: String,
    /// Largest part of a buffer that a shader sees at once, bytes.
    pub largest_storage_binding: u64,
    /// Largest buffer, bytes.
    pub largest_buffer: u64,
    /// Largest width and height of a texture, pixels.
    pub largest_texture: u32,
    /// True if it adds up 32-bit floats while drawing (blending), as splatting needs.
    pub blends_floats: bool,
}

/// The adapters of this machine, in the order of the drivers. Empty if there is no driver.
///
/// OpenGL is left out: it cannot draw to 32-bit floats everywhere. Takes some ten milliseconds.
#[must_use]
pub fn adapters() -> Vec<AdapterInfo> {
    enumerate().iter().map(info).collect()
}

/// An instance without the validation layers of drivers, so that debug builds behave as others do.
fn instance() -> wgpu::Instance {
    wgpu::Instance::new(InstanceDescriptor {
        backends: Backends::PRIMARY,
        flags: InstanceFlags::empty(),
        ..InstanceDescriptor::new_without_display_handle()
    })
}

fn enumerate() -> Vec<Adapter> {
    pollster::block_on(instance().enumerate_adapters(Backends::PRIMARY))
}

/// The best adapter of a choice.
pub(crate) fn choose(choice: AdapterChoice) -> Result<Adapter, GpuError> {
    if choice == AdapterChoice::Real && !may_have_card() {
        return Err(GpuError::NoAdapter { choice });
    }
    let mut adapters = enumerate();
    adapters.retain(|adapter| choice.accepts(kind(adapter)) && is_complete(adapter));
    adapters.into_iter().min_by_key(kind).ok_or(GpuError::NoAdapter { choice })
}

/// False if this machine has no graphics card for sure: drivers need not be opened to find none
/// then, which takes time and makes them complain. On Linux cards have device nodes, lent ones too
/// (`dxg` is that of Windows' own virtual machines); elsewhere the drivers have to be asked.
fn may_have_card() -> bool {
    let is_node = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.is_ok_and(|entry| is_node_of_card(&entry.file_name().to_string_lossy()))
    };
    let has_node = |folder| std::fs::read_dir(folder).is_ok_and(|mut all| all.any(is_node));
    let is_told = cfg!(target_os = "linux") && std::fs::read_dir("/dev").is_ok();
    !is_told || ["/dev", "/dev/dri"].into_iter().any(has_node)
}

/// True for the names of device nodes that drivers of cards open.
fn is_node_of_card(name: &str) -> bool {
    const STARTS: [&str; 6] = ["renderD", "card", "nvidia", "dxg", "mali", "kgsl"];
    STARTS.iter().any(|start| name.starts_with(start))
}

/// True if it has all that WebGPU promises.
fn is_complete(adapter: &Adapter) -> bool {
    wgpu::Limits::defaults().check_limits(&adapter.limits())
        && adapter.get_downlevel_capabilities().is_webgpu_compliant()
}

fn kind(adapter: &Adapter) -> AdapterKind {
    kind_of(adapter.get_info().device_type)
}

fn kind_of(kind: DeviceType) -> AdapterKind {
    match kind {
        DeviceType::DiscreteGpu => AdapterKind::Discrete,
        DeviceType::IntegratedGpu => AdapterKind::Integrated,
        DeviceType::VirtualGpu => AdapterKind::Virtual,
        DeviceType::Cpu => AdapterKind::Software,
        DeviceType::Other => AdapterKind::Other,
    }
}

/// The name, kind and limits of an adapter.
pub(crate) fn info(adapter: &Adapter) -> AdapterInfo {
    let (info, limits) = (adapter.get_info(), adapter.limits());
    AdapterInfo {
        name: info.name,
        kind: kind_of(info.device_type),
        backend: info.backend.to_str().to_owned(),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        largest_storage_binding: limits.max_storage_buffer_binding_size,
        largest_buffer: limits.max_buffer_size,
        largest_texture: limits.max_texture_dimension_2d,
        blends_floats: adapter.features().contains(Features::FLOAT32_BLENDABLE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_cards_are_known() {
        for name in ["renderD128", "card0", "nvidia0", "nvidiactl", "dxg", "mali0", "kgsl-3d0"] {
            assert!(is_node_of_card(name), "{name}");
        }
        for name in ["null", "zero", "dri", "tty", "fb0", "kvm", "vda"] {
            assert!(!is_node_of_card(name), "{name}");
        }
    }
}
