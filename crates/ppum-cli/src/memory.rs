//! The memory of this machine.

use sysinfo::{MemoryRefreshKind, System};

/// Memory that is free \[bytes\], of the machine and of what its container may use; nothing if the system does
/// not tell.
pub(crate) fn free() -> Option<u64> {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    let machine = (system.total_memory() > 0).then(|| system.available_memory());
    let container = system.cgroup_limits().map(|limits| limits.free_memory);
    machine.into_iter().chain(container).min()
}
