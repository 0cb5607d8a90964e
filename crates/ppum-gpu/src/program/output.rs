//! Outputs of programs: what is written at a pixel, and the image that is read.

use std::fmt::Debug;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::image::Image;
use ppum_render::raster::Raster;
use wgpu::TextureFormat;

use crate::error::{GpuError, RenderError};
use crate::frame::shading::TransferFunction;
use crate::shader::passes::{Finish, SUMS};
use crate::shader::quantity::order_of;
use crate::shader::texts;

/// An output that a [`Program`](crate::Program) is compiled for: [`Values`], [`Colors`] or
/// [`Derivatives`].
pub trait Output: Writes {}

/// The value of a quantity at each pixel; read as a [`Raster`].
#[derive(Clone, Debug, PartialEq)]
pub struct Values(pub Quantity);

/// The colour of a quantity at each pixel; read as an [`Image`].
#[derive(Clone, Debug)]
pub struct Colors {
    /// The quantity.
    pub quantity: Quantity,
    /// The transfer function. It can be [replaced](crate::Program::shade) without compiling again.
    pub shading: TransferFunction,
}

/// Value, gradient and Hessian of a component of the field, by its index; read as six rasters, v,
/// x, y, xx, xy, yy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Derivatives(pub u8);

/// The inner side of [`Output`].
pub trait Writes: Clone + Debug {
    /// The image that is read.
    type Picture;

    /// The last pass.
    const FINISH: Finish;

    /// The quantity at a pixel.
    fn quantity(&self) -> Quantity;

    /// Checks that the field has what is wanted.
    ///
    /// # Errors
    /// No such component or patch, no exact solution.
    fn check(&self, field: &Field<'_>) -> Result<(), RenderError> {
        Ok(self.quantity().check(field)?)
    }

    /// Order of derivatives that the shader needs: 0, 1 or 2.
    fn order(&self) -> u32 {
        order_of(&self.quantity())
    }

    /// The colours, if the output has some.
    fn shading(&self) -> Option<&TransferFunction> {
        None
    }

    /// The component that is wanted, if it is not the quantity that is.
    fn component(&self) -> u8 {
        0
    }

    /// The image of the bytes of its textures, row by row without gaps.
    fn picture(size: [u32; 2], textures: Vec<Vec<u8>>) -> Self::Picture;
}

impl<T: Writes> Output for T {}

impl Writes for Values {
    type Picture = Raster<f32>;

    const FINISH: Finish =
        Finish { text: "", entry: "draw_value", formats: &[TextureFormat::R32Float] };

    fn quantity(&self) -> Quantity {
        self.0.clone()
    }

    fn picture(size: [u32; 2], textures: Vec<Vec<u8>>) -> Self::Picture {
        Raster::new(size, floats(&textures.concat()).collect())
    }
}

impl Writes for Colors {
    type Picture = Image;

    const FINISH: Finish =
        Finish { text: texts::COLOR, entry: "draw_color", formats: &[TextureFormat::Rgba8Unorm] };

    fn quantity(&self) -> Quantity {
        self.quantity.clone()
    }

    fn shading(&self) -> Option<&TransferFunction> {
        Some(&self.shading)
    }

    fn picture(size: [u32; 2], textures: Vec<Vec<u8>>) -> Self::Picture {
        Image { size, rgba: textures.concat() }
    }
}

impl Writes for Derivatives {
    type Picture = [Raster<f32>; 6];

    const FINISH: Finish =
        Finish { text: texts::COMPONENT, entry: "draw_component", formats: &[SUMS, SUMS] };

    fn quantity(&self) -> Quantity {
        Quantity::Component(self.0)
    }

    fn check(&self, field: &Field<'_>) -> Result<(), RenderError> {
        let (component, count) = (self.0, field.components());
        if usize::from(component) >= count {
            return Err(GpuError::Component { component, count }.into());
        }
        Ok(())
    }

    fn order(&self) -> u32 {
        2
    }

    fn component(&self) -> u8 {
        self.0
    }

    /// The first texture holds v, x, y, xx of each pixel, the second xy, yy and two zeros.
    fn picture(size: [u32; 2], textures: Vec<Vec<u8>>) -> Self::Picture {
        let raster = |k: usize| {
            let numbers = floats(&textures[k / 4]).skip(k % 4).step_by(4);
            Raster::new(size, numbers.collect())
        };
        std::array::from_fn(raster)
    }
}

/// Numbers of single precision from bytes.
fn floats(bytes: &[u8]) -> impl Iterator<Item = f32> {
    bytes.as_chunks().0.iter().map(|&four| f32::from_le_bytes(four))
}
