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
    /// Formats of the textures that are written.
    pub(crate) formats: &'static [TextureFormat],
}

/// The float textures that splatting adds fields into, called slots: two numbers of two
/// components each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slots {
    /// Pairs of components.
    pub(crate) pairs: u32,
    /// Slots of each of them.
    pub(crate) per_pair: u32,
    /// Textures for S and its derivatives: two if there are second ones, or φ of a patch is wanted.
    pub(crate) weights: u32,
}

/// The slots that one pass writes, those of one pair of components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FieldPass {
    pub(crate) pair: u32,
    /// Its first slot among those of the pair.
    pub(crate) first: u32,
    pub(crate) slots: u32,
}

/// Slots that one pass writes: 32 bytes per pixel, what WebGPU promises.
const SLOTS_PER_PASS: u32 = 2;

/// The format of what is added up.
pub(crate) const SUMS: TextureFormat = TextureFormat::Rgba32Float;

impl Slots {
    /// Their number.
    pub(crate) fn count(self) -> u32 {
        self.pairs * self.per_pair
    }

    /// All textures that the last pass adds up from.
    pub(crate) fn textures(self) -> u32 {
        self.weights + self.count()
    }

    /// The passes that fill them.
    pub(crate) fn passes(self) -> impl Iterator<Item = FieldPass> {
        let firsts = move || (0..self.per_pair).step_by(SLOTS_PER_PASS as usize);
        let pass = move |pair, first| {
            let slots = SLOTS_PER_PASS.min(self.per_pair - first);
            FieldPass { pair, first, slots }
        };
        (0..self.pairs).flat_map(move |pair| firsts().map(move |first| pass(pair, first)))
    }
}

impl FieldPass {
    /// Something to write for a shader that splats no field.
    pub(crate) const NONE: Self = Self { pair: 0, first: 0, slots: 1 };

    /// Its first slot among all.
    pub(crate) fn first_slot(self, slots: Slots) -> u32 {
        self.pair * slots.per_pair + self.first
    }
}
