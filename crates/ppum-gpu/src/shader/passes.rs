//! The passes of an image: what each draws, and into what.

use wgpu::TextureFormat;

/// The way patches come together at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// One pass: each pixel finds its patches and sums over them.
    Gather,
    /// The three passes of Üffinger et al. 2011: patches are drawn as quads and blended.
    Splat,
}

/// The last pass: what is written at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finish {
    /// Its text beside that which all outputs share.
    pub(crate) text: &'static str,
    /// The function of the shader.
    pub(crate) entry: &'static str,
    /// The format of the texture that is written.
    pub(crate) format: TextureFormat,
}

/// The float textures that splatting adds into: one of weights, and two numbers of two components
/// in each of the others, called slots. One pass fills those of a pair: 32 bytes per pixel at most,
/// what WebGPU promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slots {
    /// Pairs of components.
    pub(crate) pairs: u32,
    /// Slots of each of them.
    pub(crate) per_pair: u32,
}

/// The format of what is added up.
pub(crate) const SUMS: TextureFormat = TextureFormat::Rgba32Float;

impl Slots {
    /// Their number.
    pub(crate) fn count(self) -> u32 {
        self.pairs * self.per_pair
    }

    /// All textures that the last pass adds up from.
    pub(crate) fn textures(self) -> u32 {
        1 + self.count()
    }
}
