//! Drawing on devices, and what devices there are.

use ppum::progress::Watcher;
use ppum_gpu::{AdapterChoice, AdapterInfo, Gpu, GpuError, Method, RenderError, Renderer};
use ppum_render::raster::Raster;
use ppum_render::samples::{Means, SampleImage, Samples};
use ppum_scene::backend::Backend;
use ppum_scene::error::CardError;
use ppum_scene::values::{DrawingInput, PixelValues};

use ppum_cli::graphics::{Adapter, Cards};

fn failure(error: &RenderError) -> CardError {
    let is_normal =
        matches!(error, RenderError::Gpu(GpuError::NoAdapter { .. }) | RenderError::Quantity(_));
    CardError { message: message(error), is_normal }
}

/// Drawing on graphics cards.
pub(crate) const CARDS: Cards = Cards { draw, adapters };

/// Draws the means of so many samples a pixel. After an error the CPU may try.
fn draw(
    job: DrawingInput<'_>,
    samples: Samples,
    backend: Backend,
    watcher: &dyn Watcher,
) -> Result<PixelValues, CardError> {
    let DrawingInput { field, view, quantity } = job;
    // a device holds all samples at once
    let finer = view.finer(samples.side());
    let finer = finer.map_err(|e| CardError { message: e.to_string(), is_normal: true })?;
    let of_samples = DrawingInput { field, view: &finer, quantity };
    let (choice, method, kind) = match backend {
        Backend::Auto => (AdapterChoice::Real, Method::Gather, "gpu f32"),
        Backend::Splat => (AdapterChoice::Any, Method::Splat, "gpu splat f32"),
        Backend::Cpu | Backend::Gpu => (AdapterChoice::Any, Method::Gather, "gpu f32"),
    };
    let drawn = drawn(of_samples, choice, method, watcher);
    let (renderer, raster) = drawn.map_err(|error| failure(&error))?;
    let by = format!("{kind}, {}", renderer.gpu().info().name);
    if samples == Samples::CENTER {
        return Ok(PixelValues::new(raster, job.field, job.view, &by));
    }
    let undefined = raster.undefined(field.domain, &finer);
    let image = SampleImage { raster: &raster, undefined: &undefined };
    Ok(PixelValues::averaged(Means::of(view, quantity, samples, image), job, &by))
}

fn drawn(
    job: DrawingInput<'_>,
    choice: AdapterChoice,
    method: Method,
    watcher: &dyn Watcher,
) -> Result<(Renderer, Raster<f32>), RenderError> {
    let mut renderer = Renderer::open(choice)?;
    let raster = renderer.render(job.field, job.view, job.quantity, method, watcher)?;
    Ok((renderer, raster))
}

/// The error with the remedy that the options of this program offer.
fn message(error: &RenderError) -> String {
    let RenderError::Gpu(error) = error else { return error.to_string() };
    let remedy = match error {
        GpuError::NoAdapter { .. } => "; `--backend cpu` needs none",
        GpuError::Device { .. } => "; `--backend cpu` does without it",
        GpuError::Memory { .. } => "; draw fewer pixels or use `--backend cpu`",
        GpuError::FormulaTooLarge { .. } => "; `--backend cpu` has no such limit",
        GpuError::TooLarge { .. }
        | GpuError::PictureTooLarge { .. }
        | GpuError::TooMany { .. }
        | GpuError::NeedsDouble { .. }
        | GpuError::Mesh => "; use `--backend cpu`",
        _ => "",
    };
    format!("{error}{remedy}")
}

/// The graphics adapters of this machine; opens what each backend would open.
fn adapters() -> Vec<Adapter> {
    let taken =
        [("auto", AdapterChoice::Real), ("gpu", AdapterChoice::Any), ("splat", AdapterChoice::Any)]
            .map(|(backend, choice)| (backend, Gpu::open(choice).ok()));
    let adapter = |info: AdapterInfo| {
        let by = |(backend, gpu): &(&'static str, Option<Gpu>)| {
            let takes = gpu.as_ref().is_some_and(|gpu| *gpu.info() == info);
            (takes && (*backend != "splat" || info.blends_floats)).then_some(*backend)
        };
        described(&info, taken.iter().filter_map(by).collect())
    };
    ppum_gpu::adapters().into_iter().map(adapter).collect()
}

fn described(info: &AdapterInfo, taken_by: Vec<&'static str>) -> Adapter {
    const MIB: u64 = 1 << 20;
    Adapter {
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

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_scene::notice::Notice;

    #[test]
    fn failures_are_told_in_one_line() {
        let error = GpuError::Shader { message: "expected `;`\n  at 3:4\n".to_owned() };
        let failure = failure(&error.into());
        assert!(!failure.is_normal);
        let note = Notice::NoCard(failure.message).line();
        assert!(note.starts_with("note: ") && note.ends_with("expected `;` at 3:4"), "{note}");
        assert_eq!(note.lines().count(), 1);
        assert!(!super::failure(&GpuError::Lost.into()).is_normal);
    }

    #[test]
    fn errors_of_devices_name_the_option_that_helps() {
        let missing = message(&GpuError::NoAdapter { choice: AdapterChoice::Any }.into());
        assert!(
            missing.ends_with("mesa-vulkan-drivers`); `--backend cpu` needs none"),
            "{missing}"
        );
        let large = GpuError::PictureTooLarge { pixels: [20_000, 10], most: 16_384 };
        let large = message(&large.into());
        assert!(large.ends_with("at most 16384x16384; use `--backend cpu`"), "{large}");
        assert_eq!(message(&GpuError::Lost.into()), GpuError::Lost.to_string());
    }

    #[test]
    fn a_machine_without_a_graphics_card_is_no_failure() {
        let missing = GpuError::NoAdapter { choice: AdapterChoice::Real };
        assert!(failure(&missing.into()).is_normal);
    }
}
