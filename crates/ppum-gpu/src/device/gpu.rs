//! An opened graphics device, whose errors come back as results.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{Device, DeviceDescriptor, Features, Limits, Queue};

use super::adapter::{self, AdapterInfo};
use crate::choice::AdapterChoice;
use crate::error::GpuError;

/// An opened graphics device.
#[derive(Debug)]
pub struct Gpu {
    device: Device,
    queue: Queue,
    info: AdapterInfo,
    state: Arc<DriverState>,
}

/// The driver's unsolicited events.
#[derive(Debug, Default)]
struct DriverState {
    lost: AtomicBool,
    /// The first error outside of [`Gpu::checked`] that nobody has asked for yet.
    complaint: Mutex<Option<String>>,
}

impl Gpu {
    /// Opens the best adapter of a choice; waits for it.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], or [`GpuError::Device`] if the driver refuses.
    pub fn open(choice: AdapterChoice) -> Result<Self, GpuError> {
        let adapter = adapter::choose(choice)?;
        let descriptor = DeviceDescriptor {
            label: Some("ppum"),
            required_features: adapter.features() & Features::FLOAT32_BLENDABLE,
            required_limits: limits(&adapter.limits()),
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) = opened.map_err(|error| device_error("open the device", &error))?;
        let state = Arc::new(DriverState::default());
        watch(&device, &state);
        Ok(Self { device, queue, info: adapter::info(&adapter), state })
    }

    /// The adapter that is opened.
    #[must_use]
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// The device of wgpu.
    pub(crate) fn device(&self) -> &Device {
        &self.device
    }

    /// The queue of wgpu.
    pub(crate) fn queue(&self) -> &Queue {
        &self.queue
    }

    /// The limits that the device was opened with: WebGPU's defaults, except for larger textures
    /// and buffers.
    pub(crate) fn limits(&self) -> Limits {
        self.device.limits()
    }

    /// The result of `f`, or the error that the driver found in it; `what` names the action, as in
    /// "make the pipeline".
    ///
    /// A browser answers later only: there errors are left to [`Gpu::verdict`].
    pub(crate) fn checked<T>(&self, what: &str, f: impl FnOnce() -> T) -> Result<T, GpuError> {
        if self.is_lost() {
            return Err(GpuError::Lost);
        }
        let (value, error) = self.scoped(f);
        if error.is_some() {
            // a lost device says so when nothing is under way any more, and what lived on it is
            // invalid before
            let _ = self.device.poll(wgpu::PollType::wait_indefinitely());
        }
        match error {
            _ if self.is_lost() => Err(GpuError::Lost),
            Some(wgpu::Error::OutOfMemory { .. }) => {
                Err(GpuError::Memory { what: what.to_owned() })
            }
            Some(error) => Err(device_error(what, &error)),
            None => Ok(value),
        }
    }

    /// A module of a text of WGSL.
    pub(crate) fn shader(&self, label: &str, text: &str) -> Result<wgpu::ShaderModule, GpuError> {
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some(label), source };
        let module = self.checked(label, || self.device.create_shader_module(descriptor));
        module.map_err(|error| match error {
            GpuError::Device { message, .. } => GpuError::Shader { message },
            other => other,
        })
    }

    /// The result of `f` and the first error in it.
    fn scoped<T>(&self, f: impl FnOnce() -> T) -> (T, Option<wgpu::Error>) {
        use wgpu::ErrorFilter;
        let filters = [ErrorFilter::Internal, ErrorFilter::OutOfMemory, ErrorFilter::Validation];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let value = f();
        // scopes are a stack
        let popped = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop()));
        // all are popped, whatever the first one has
        let errors: Vec<_> = popped.collect();
        (value, errors.into_iter().flatten().next())
    }

    /// The first complaint of the driver, outside of [`Gpu::checked`], since this was asked last.
    pub(crate) fn verdict(&self) -> Result<(), GpuError> {
        let complaint = self.state.complaint.lock().unwrap_or_else(PoisonError::into_inner).take();
        match complaint {
            _ if self.is_lost() => Err(GpuError::Lost),
            Some(message) => Err(GpuError::Device { what: "draw".to_owned(), message }),
            None => Ok(()),
        }
    }

    /// True once the device is lost: driver reset, card removed. It does not come back;
    /// open another.
    pub(crate) fn is_lost(&self) -> bool {
        self.state.lost.load(Ordering::Relaxed)
    }

    /// Loses the device, so that a test can see what survives.
    #[doc(hidden)]
    pub fn lose(&self) {
        self.device.destroy();
        // the driver tells when it is asked; an error says that it has told
        let _ = self.device.poll(wgpu::PollType::Poll);
    }
}

/// WebGPU's defaults, except for textures and buffers as large as the adapter makes them: images
/// above 8192 pixels a side and data above 1 GiB are drawn where the adapter can. All else stays at
/// the defaults, so that what is tested here is what runs elsewhere.
fn limits(most: &Limits) -> Limits {
    Limits {
        max_texture_dimension_2d: most.max_texture_dimension_2d,
        max_buffer_size: most.max_buffer_size,
        ..Limits::defaults()
    }
}

/// Writes down what the driver tells by itself; without this wgpu would panic.
fn watch(device: &Device, state: &Arc<DriverState>) {
    let (lost, complaints) = (Arc::clone(state), Arc::clone(state));
    device.set_device_lost_callback(move |_, _| lost.lost.store(true, Ordering::Relaxed));
    device.on_uncaptured_error(Arc::new(move |error| {
        let mut complaint = complaints.complaint.lock().unwrap_or_else(PoisonError::into_inner);
        complaint.get_or_insert_with(|| message(&error));
    }));
}

fn device_error(what: &str, error: &dyn std::error::Error) -> GpuError {
    GpuError::Device { what: what.to_owned(), message: message(error) }
}

/// An error with what caused it.
fn message(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(next) = cause {
        let words = next.to_string();
        if !text.contains(&words) {
            text = format!("{text}: {words}");
        }
        cause = next.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::gpu_or_skip;

    /// A buffer larger than the device makes.
    fn too_large(gpu: &Gpu) -> wgpu::Buffer {
        gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: gpu.limits().max_buffer_size + 4,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        })
    }

    #[test]
    fn errors_come_back_as_results() {
        let Some(gpu) = gpu_or_skip() else { return };
        let error = gpu.checked("make a buffer", || too_large(&gpu)).expect_err("too large");
        assert!(matches!(&error, GpuError::Device { what, .. } if what == "make a buffer"));
        assert_eq!(gpu.checked("count", || 1), Ok(1));
        assert_eq!(gpu.verdict(), Ok(()));
        let _ = too_large(&gpu);
        assert!(matches!(gpu.verdict(), Err(GpuError::Device { .. })));
        assert_eq!(gpu.verdict(), Ok(()));
    }

    #[test]
    fn a_wrong_shader_is_told_with_its_place() {
        let Some(gpu) = gpu_or_skip() else { return };
        let error = gpu.shader("wrong", "fn f() -> f32 { return 1u; }").expect_err("wrong");
        assert!(
            matches!(&error, GpuError::Shader { message } if message.contains("1u")),
            "{error}"
        );
    }

    #[test]
    fn a_lost_device_says_so() {
        let Some(gpu) = gpu_or_skip() else { return };
        assert!(!gpu.is_lost());
        gpu.lose();
        assert!(gpu.is_lost());
        assert_eq!(gpu.checked("anything", || ()), Err(GpuError::Lost));
        assert_eq!(gpu.verdict(), Err(GpuError::Lost));
    }
}
