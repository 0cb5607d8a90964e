//! The memory of this machine.

use sysinfo::{MemoryRefreshKind, System};

/// Bytes of the largest block that glibc learns from.
const LARGEST: usize = (32 << 20) - (64 << 10);

/// Lets memory that is freed stay at hand. glibc hands blocks of megabytes back to the system when
/// they are freed, and a frame that fetches its own again takes half as long again (decision 23).
/// It keeps blocks as small as the largest that it has seen freed; this one is never touched. Other
/// allocators do not mind.
pub(crate) fn keep_freed() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGEST)));
}

/// Memory that is free \[bytes\], of the machine and of what its container may use; nothing if the
/// system does not tell.
pub(crate) fn free() -> Option<u64> {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    let machine = (system.total_memory() > 0).then(|| system.available_memory());
    let container = system.cgroup_limits().map(|limits| limits.free_memory);
    machine.into_iter().chain(container).min()
}
