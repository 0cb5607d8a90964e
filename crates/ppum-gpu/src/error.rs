//! Failures of graphics devices. Nothing here panics, so that who draws can fall back to the CPU.

use ppum::formula::WgslError;
use ppum::progress::Cancelled;
use ppum::quantity::QuantityError;

use crate::choice::AdapterChoice;

/// The reason why a graphics device could not do what it was asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is no adapter, or none of the wanted kind.
    #[error(
        "no graphics adapter{}: install a Vulkan driver for the graphics card, or the software \
         one (on Debian `libvulkan1 mesa-vulkan-drivers`)",
        choice.suffix()
    )]
    NoAdapter {
        /// The adapters that would have done.
        choice: AdapterChoice,
    },
    /// The driver refused to do something.
    #[error("{what}: the graphics driver says: {message}")]
    Device {
        /// The action, as in "open the device".
        what: String,
        /// The driver's words.
        message: String,
    },
    /// The device's memory is full.
    #[error("{what}: out of graphics memory")]
    Memory {
        /// The action, as in "draw".
        what: String,
    },
    /// A shader is not accepted.
    #[error("shader: {message}")]
    Shader {
        /// The compiler's words, with the place.
        message: String,
    },
    /// The device was lost: driver reset, card removed. Everything on it has to be made again.
    #[error("the graphics device was lost; open it again")]
    Lost,
    /// Data that do not fit into what the device binds at once.
    #[error("{what} need {needed} bytes, and the graphics device takes {most}")]
    TooLarge {
        /// The data, in the plural.
        what: String,
        /// Bytes that are needed.
        needed: u64,
        /// Bytes that there can be.
        most: u64,
    },
    /// An image with more pixels than the device draws.
    #[error(
        "a picture of {}x{} pixels: this graphics device draws at most {most}x{most}",
        pixels[0], pixels[1]
    )]
    PictureTooLarge {
        /// Columns and rows.
        pixels: [u32; 2],
        /// Most of either.
        most: u32,
    },
    /// More functions or components than the data of a scene can number.
    #[error("{functions} functions and {components} components are more than shaders tell apart")]
    TooMany {
        /// Functions of the step.
        functions: usize,
        /// Components of the field.
        components: usize,
    },
    /// A formula that is wrong.
    #[error("{what}: {message}")]
    Formula {
        /// The formula.
        what: String,
        /// The error.
        message: String,
    },
    /// A formula that is right, but too large for a shader.
    #[error("{what}: {error}")]
    FormulaTooLarge {
        /// The formula.
        what: String,
        /// The limit it exceeds.
        error: WgslError,
    },
    /// A quantity that single precision cannot show.
    #[error(
        "`{quantity}` is the difference of nearly equal numbers and needs double precision, which the GPU \
         has not"
    )]
    NeedsDouble {
        /// Name of the quantity.
        quantity: String,
    },
    /// Splatting on a device that does not blend 32-bit floats.
    #[error(
        "splatting adds up 32-bit floats while drawing, which {adapter} does not; gather instead"
    )]
    NoBlending {
        /// Name of the adapter.
        adapter: String,
    },
    /// Splatting a field of more components than there are textures for.
    #[error(
        "splatting holds all components in textures, of which there are too few for this field; \
         gather instead"
    )]
    TooFewTextures {
        /// Textures that are needed.
        needed: u32,
        /// Textures that there can be.
        most: u32,
    },
    /// A field on a mesh.
    #[error("the patches are the elements of a mesh, which graphics cards do not draw")]
    Mesh,
}

impl GpuError {
    /// A wrong formula.
    pub(crate) fn formula(what: &str, error: &dyn std::fmt::Display) -> Self {
        Self::Formula { what: what.to_owned(), message: error.to_string() }
    }

    /// A formula that is right, but too large for a shader.
    pub(crate) fn limit(what: &str, error: &WgslError) -> Self {
        Self::FormulaTooLarge { what: what.to_owned(), error: error.clone() }
    }
}

/// The reason why an image was not drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The graphics device could not.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

#[cfg(test)]
mod tests {
    use super::*;

    ppum_testkit::errors_cross_threads!(GpuError, RenderError);

    #[test]
    fn a_missing_adapter_says_what_to_install() {
        let text = GpuError::NoAdapter { choice: AdapterChoice::Any }.to_string();
        for word in ["Vulkan driver", "mesa-vulkan-drivers"] {
            assert!(text.contains(word), "{text}");
        }
    }
}
