//! Outputs of programs: what is written at a pixel, and the image that is read.

use std::fmt::Debug;

use ppum::quantity::Quantity;
use ppum_render::image::Image;
use ppum_render::raster::Raster;
use wgpu::TextureFormat;

use crate::frame::shading::TransferFunction;
use crate::shader::passes::Finish;
use crate::shader::texts;

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

/// An output that a [`Program`](crate::Program) is compiled for: [`Values`] or
/// [`Colors`].
pub trait Output: Clone + Debug {
    /// The image that is read.
    type Picture;

    /// The last pass.
    const FINISH: Finish;

    /// The quantity at a pixel.
    fn quantity(&self) -> Quantity;

    /// The colours, if the output has some.
    fn shading(&self) -> Option<&TransferFunction> {
        None
    }

    /// The image of the bytes of its texture, row by row without gaps.
    fn picture(size: [u32; 2], bytes: Vec<u8>) -> Self::Picture;
}

impl Output for Values {
    type Picture = Raster<f32>;

    const FINISH: Finish =
        Finish { text: "", entry: "draw_value", format: TextureFormat::R32Float };

    fn quantity(&self) -> Quantity {
        self.0.clone()
    }

    fn picture(size: [u32; 2], bytes: Vec<u8>) -> Self::Picture {
        let numbers = bytes.as_chunks().0.iter().map(|&four| f32::from_le_bytes(four));
        Raster::new(size, numbers.collect())
    }
}

impl Output for Colors {
    type Picture = Image;

    const FINISH: Finish =
        Finish { text: texts::COLOR, entry: "draw_color", format: TextureFormat::Rgba8Unorm };

    fn quantity(&self) -> Quantity {
        self.quantity.clone()
    }

    fn shading(&self) -> Option<&TransferFunction> {
        Some(&self.shading)
    }

    fn picture(size: [u32; 2], bytes: Vec<u8>) -> Self::Picture {
        Image { size, rgba: bytes }
    }
}
