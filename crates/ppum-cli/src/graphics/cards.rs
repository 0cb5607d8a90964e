//! Graphics devices as `ppum bench` measures them.

use std::hint::black_box;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_gpu::{AdapterKind, Choice, Colors, Program, Renderer, Shading, Values};
use ppum_render::picture::Style;
use ppum_render::raster::Raster;
use ppum_render::view::View;

use super::{Method, devices, drivers};

/// A device.
pub(crate) struct Cards(Renderer);

/// A field on a device.
pub(crate) struct Card<'f> {
    gather: Program<'f, Colors>,
    splat: Option<Program<'f, Colors>>,
}

impl Cards {
    /// Any device, or the reason why there is none.
    pub(crate) fn open() -> Result<Self, String> {
        let opened = drivers::opening(|| Renderer::open(Choice::Any));
        opened.map(Self).map_err(|error| devices::message(&error.into()))
    }

    pub(crate) fn name(&self) -> String {
        self.0.gpu().info().name.clone()
    }

    /// The kind of device, in a word.
    pub(crate) fn kind(&self) -> &'static str {
        self.0.gpu().info().kind.name()
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

impl<'f> Card<'f> {
    /// Uploads a field and compiles pictures of a quantity; the range of the colours is fixed.
    pub(crate) fn new(
        Cards(renderer): &mut Cards,
        field: &'f Field<'f>,
        (quantity, look): (&Quantity, &Style),
        may_splat: bool,
    ) -> anyhow::Result<Self> {
        let scene = renderer.upload(field)?;
        let can_splat = renderer.gpu().info().blends_floats && may_splat;
        let Style { colormap, scale, range, undefined, .. } = look.clone();
        let nothing = Raster::<f32>::new([0, 0], Vec::new());
        let normalization = range.normalization(scale, colormap.diverging, &nothing)?;
        let shading = Shading { normalization, colormap, undefined };
        let output = Colors { quantity: quantity.clone(), shading };
        let mut compile = |method: Method| renderer.compile(&scene, output.clone(), method.into());
        let gather = compile(Method::Gather)?;
        let splat = can_splat.then(|| compile(Method::Splat)).transpose()?;
        Ok(Self { gather, splat })
    }

    /// Draws and waits, without reading back; false if it cannot draw by this method.
    pub(crate) fn draw(
        &mut self,
        Cards(renderer): &mut Cards,
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
        Cards(renderer): &mut Cards,
        method: Method,
        (view, quantity): (&View, &Quantity),
    ) -> anyhow::Result<Option<Raster<f32>>> {
        if method == Method::Splat && self.splat.is_none() {
            return Ok(None);
        }
        let output = Values(quantity.clone());
        let mut program = renderer.compile(self.gather.scene(), output, method.into())?;
        Ok(Some(renderer.draw(&mut program, view)?.read()?))
    }
}
