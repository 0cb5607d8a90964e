//! Graphics devices as they are measured.

use std::hint::black_box;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_gpu::{
    AdapterChoice, AdapterKind, Colors, Method, Program, Renderer, TransferFunction, Values,
};
use ppum_render::picture::Style;
use ppum_render::raster::Raster;
use ppum_render::view::View;
use serde::Serialize;

/// A device.
pub(crate) struct BenchDevice(Renderer);

/// A field on a device.
pub(crate) struct CardPrograms<'f> {
    gather: Program<'f, Colors>,
    splat: Option<Program<'f, Colors>>,
}

/// The graphics adapter.
#[derive(Debug, Serialize)]
pub(crate) struct BenchAdapter {
    pub(crate) name: String,
    pub(crate) kind: &'static str,
}

impl BenchDevice {
    /// Any device, or the reason why there is none.
    pub(crate) fn open() -> Result<Self, String> {
        Renderer::open(AdapterChoice::Any).map(Self).map_err(|error| error.to_string())
    }

    pub(crate) fn adapter(&self) -> BenchAdapter {
        let info = self.0.gpu().info();
        BenchAdapter { name: info.name.clone(), kind: info.kind.name() }
    }

    /// Puts a field on the device, and waits.
    pub(crate) fn upload(&mut self, field: &Field<'_>) -> anyhow::Result<()> {
        black_box(self.0.upload(field)?);
        Ok(self.0.wait()?)
    }

    /// True if the processor computes in its place.
    pub(crate) fn is_software(&self) -> bool {
        self.0.gpu().info().kind == AdapterKind::Software
    }
}

impl<'f> CardPrograms<'f> {
    /// Uploads a field and compiles images of a quantity; the range of the colours is fixed.
    pub(crate) fn new(
        BenchDevice(renderer): &mut BenchDevice,
        field: &'f Field<'f>,
        (quantity, look): (&Quantity, &Style),
        may_splat: bool,
    ) -> anyhow::Result<Self> {
        let scene = renderer.upload(field)?;
        let can_splat = renderer.gpu().info().blends_floats && may_splat;
        let Style { colormap, scale, range, undefined, .. } = look.clone();
        let nothing = Raster::<f32>::new([0, 0], Vec::new());
        let normalization =
            range.span(scale, colormap.diverging, &nothing, None).normalization(scale)?;
        let shading = TransferFunction { normalization, colormap, undefined };
        let output = Colors { quantity: quantity.clone(), shading };
        let mut compile = |method| renderer.compile(&scene, output.clone(), method);
        let gather = compile(Method::Gather)?;
        let splat = can_splat.then(|| compile(Method::Splat)).transpose()?;
        Ok(Self { gather, splat })
    }

    /// Draws and waits, without reading back; false if it cannot draw by this method.
    pub(crate) fn draw(
        &mut self,
        BenchDevice(renderer): &mut BenchDevice,
        method: Method,
        view: &View,
    ) -> anyhow::Result<bool> {
        let program = match method {
            Method::Gather => Some(&mut self.gather),
            Method::Splat => self.splat.as_mut(),
        };
        let Some(program) = program else { return Ok(false) };
        black_box(renderer.draw(program, view)?);
        renderer.wait()?;
        Ok(true)
    }

    /// The values of a quantity, read back; none if it cannot draw by this method.
    pub(crate) fn values(
        &self,
        BenchDevice(renderer): &mut BenchDevice,
        method: Method,
        (view, quantity): (&View, &Quantity),
    ) -> anyhow::Result<Option<Raster<f32>>> {
        if method == Method::Splat && self.splat.is_none() {
            return Ok(None);
        }
        let output = Values(quantity.clone());
        let mut program = renderer.compile(self.gather.scene(), output, method)?;
        Ok(Some(renderer.draw(&mut program, view)?.read()?))
    }
}
