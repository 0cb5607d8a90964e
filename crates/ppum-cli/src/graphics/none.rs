//! A program that was built without graphics devices: the CPU draws.

use std::marker::PhantomData;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::picture::Style;
use ppum_render::raster::Raster;
use ppum_render::samples::Samples;
use ppum_render::view::View;

use super::{Adapter, Device, Failure, Method};
use ppum_scene::drawing::{Drawn, Job};

/// The answer of `ppum info --gpu`.
pub(crate) const MISSING: &str = "\
no graphics adapter: this program was built without graphics cards; build it with
`cargo install --locked --path crates/ppum-cli --features window` (or `--features gpu`, without the window).
Images are drawn on the CPU instead, the same to rounding.";

/// The reason why no device draws.
const REASON: &str =
    "no graphics adapter: this program was built without graphics cards (`--features gpu`)";

pub(crate) fn draw(_: Job<'_>, _: Samples, _: Device, _: Method) -> Result<Drawn, Failure> {
    Err(Failure { message: format!("{REASON}; `--backend cpu` needs none"), is_normal: true })
}

pub(crate) fn adapters() -> Vec<Adapter> {
    Vec::new()
}

/// A device; there is none.
pub(crate) enum Cards {}

/// A field on a device; there is none.
pub(crate) enum Card<'f> {
    #[expect(dead_code, reason = "holds the lifetime, and cannot be made")]
    Never(Cards, PhantomData<&'f ()>),
}

impl Cards {
    pub(crate) fn open() -> Result<Self, String> {
        Err(REASON.to_owned())
    }

    pub(crate) fn name(&self) -> String {
        match *self {}
    }

    pub(crate) fn kind(&self) -> &'static str {
        match *self {}
    }

    pub(crate) fn is_software(&self) -> bool {
        match *self {}
    }

    pub(crate) fn upload(&mut self, _: &Field<'_>) -> anyhow::Result<()> {
        match *self {}
    }
}

impl<'f> Card<'f> {
    pub(crate) fn new(
        cards: &mut Cards,
        _: &'f Field<'f>,
        _: (&Quantity, &Style),
        _: bool,
    ) -> anyhow::Result<Self> {
        match *cards {}
    }

    pub(crate) fn draw(&mut self, cards: &mut Cards, _: Method, _: &View) -> anyhow::Result<bool> {
        match *cards {}
    }

    pub(crate) fn values(
        &self,
        cards: &mut Cards,
        _: Method,
        _: (&View, &Quantity),
    ) -> anyhow::Result<Option<Raster<f32>>> {
        match *cards {}
    }
}

/// Drivers of the window write what they like.
#[cfg(feature = "window")]
pub(crate) fn opening<T>(open: impl FnOnce() -> T) -> T {
    open()
}
