//! A field on the card: what stays there while views, functions and quantities change.
//!
//! ```text
//! groups ─▶ bodies                     coefficients of all patches, function by function
//! lattice, or bins ─▶ pages ─▶ region  the patches around a view, and where they are found
//! bodies, region ─▶ card               words on the device
//! ```

pub(crate) mod bins;
pub(crate) mod bodies;
pub(crate) mod card;
pub(crate) mod groups;
pub(crate) mod lattice;
pub(crate) mod pages;
pub(crate) mod region;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ppum::crack::Crack;
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::view::View;
use wgpu::TextureView;

use crate::device::Gpu;
use crate::error::GpuError;
use bodies::{Bodies, BodyFacts, ComponentLanes, GROUP_BITS, Others};
use card::Card;
use groups::FunctionGroups;
use lattice::CoverLattice;
use pages::HalfExtents;
use region::{RegionWords, UploadRegion, has_own_frames};

/// Components of a field: a term of four functions times polynomials of degree 8 then stays below
/// 4096 texels.
const MOST_COMPONENTS: usize = 64;

/// A field on the card. Made by [`Renderer::upload`](crate::Renderer::upload); one for each step of
/// a series, say, of which any can be drawn without further ado. Clones share what is on the card.
#[derive(Clone, Debug)]
pub struct Scene<'f> {
    field: &'f Field<'f>,
    groups: Arc<FunctionGroups>,
    on_card: Arc<Mutex<OnCard>>,
}

/// The part of a scene that lives on a device. It moves with the views, and to the next device when
/// one is lost.
#[derive(Debug)]
pub(crate) struct OnCard {
    gpu: Arc<Gpu>,
    pub(crate) layout: SceneLayout,
    /// The coefficients of the patches, see [`bodies`].
    pub(crate) data: TextureView,
    /// The address of each patch's body.
    pub(crate) bodies: Vec<u32>,
    pub(crate) lattice: Option<CoverLattice>,
    levels: Option<HalfExtents>,
    /// Boxes around the patches with more than smooth terms.
    pub(crate) enriched: Vec<(Rect, Others)>,
    region: Option<UploadedRegion>,
}

/// The properties of a scene that shaders are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SceneLayout {
    pub(crate) components: ComponentLanes,
    pub(crate) shape: BodyFacts,
    /// Patches lie on a lattice.
    pub(crate) is_lattice: bool,
    /// Polynomials have other coordinates than weights.
    pub(crate) own_frames: bool,
    pub(crate) has_holes: bool,
    /// Some crack has several edges, or an arc.
    pub(crate) has_kinks: bool,
    /// Some crack or rim has an arc.
    pub(crate) has_arcs: bool,
    /// The sizes of patches are halves of the largest ones.
    pub(crate) has_levels: bool,
}

/// A region on the card.
#[derive(Debug)]
pub(crate) struct UploadedRegion {
    pub(crate) region: UploadRegion,
    pub(crate) texture: TextureView,
    /// First texel of the nodes.
    pub(crate) nodes: u32,
}

impl<'f> Scene<'f> {
    /// Uploads a field.
    pub(crate) fn new(card: &Card, field: &'f Field<'f>) -> Result<Self, GpuError> {
        if field.step.partition.mesh().is_some() {
            return Err(GpuError::Mesh);
        }
        let groups = FunctionGroups::new(&field.step.functions);
        let on_card = Arc::new(Mutex::new(OnCard::new(card, field, &groups)?));
        Ok(Self { field, groups: Arc::new(groups), on_card })
    }

    /// The field whose functions are drawn.
    #[must_use]
    pub fn field(&self) -> &'f Field<'f> {
        self.field
    }

    /// The groups of functions that the data on the card refer to.
    pub(crate) fn groups(&self) -> &FunctionGroups {
        &self.groups
    }

    /// The part on the card; one drawing at a time has it.
    pub(crate) fn on_card(&self) -> MutexGuard<'_, OnCard> {
        self.on_card.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl OnCard {
    fn new(card: &Card, field: &Field<'_>, groups: &FunctionGroups) -> Result<Self, GpuError> {
        check_sizes(field, groups)?;
        let Bodies { parts, patches, shape, enriched } = Bodies::new(field, groups);
        let data = card.upload("the coefficients", &parts)?;
        let (layout, lattice, levels) = SceneLayout::of_field(field, shape);
        let (gpu, bodies, region) = (Arc::clone(&card.gpu), patches, None);
        Ok(Self { gpu, layout, data, bodies, lattice, levels, enriched, region })
    }

    /// Sees to it that a scene and the patches of a view are on a device. Its functions may have
    /// been replaced since it was uploaded: programs know them by the groups they had.
    pub(crate) fn bring(
        &mut self,
        card: &Card,
        scene: &Scene<'_>,
        view: &View,
    ) -> Result<(), GpuError> {
        let field = scene.field;
        if !Arc::ptr_eq(&self.gpu, &card.gpu) {
            *self = Self::new(card, field, &scene.groups)?;
        }
        let shows = |place: &UploadedRegion| place.region.shows(field, view);
        if self.region.as_ref().is_some_and(shows) {
            return Ok(());
        }
        let lattice = self.lattice.as_ref();
        let region = UploadRegion::new(field, view, lattice);
        let RegionWords { words, nodes } =
            region.words(field, (lattice, self.levels.as_ref()), &self.bodies);
        let texture = card.upload("the patches in sight", &[words])?;
        self.region = Some(UploadedRegion { region, texture, nodes });
        Ok(())
    }

    /// The half-extents of the patches of a lattice, or of the largest ones.
    pub(crate) fn half(&self) -> Option<Vec2> {
        let largest = self.levels.as_ref().map(|levels| levels.half);
        self.lattice.as_ref().map(|lattice| lattice.half).or(largest)
    }

    /// The region on the card, after [`OnCard::bring`].
    pub(crate) fn region(&self) -> Result<&UploadedRegion, GpuError> {
        self.region.as_ref().ok_or(GpuError::Lost)
    }
}

impl SceneLayout {
    /// That of a field, with its lattice or its levels if it has some.
    pub(crate) fn of_field(
        field: &Field<'_>,
        shape: BodyFacts,
    ) -> (Self, Option<CoverLattice>, Option<HalfExtents>) {
        let (own_frames, partition) = (has_own_frames(field), field.step.partition.boxes());
        let lattice = if own_frames { None } else { CoverLattice::from_partition(partition) };
        let searched = !own_frames && lattice.is_none();
        let levels = if searched { HalfExtents::from_partition(partition) } else { None };
        let mut sides = field.domain.holes.iter().flat_map(Hole::edges);
        let has_round_side = sides.any(|side| side.is_arc());
        let layout = Self {
            components: ComponentLanes::new(field.components()),
            shape,
            is_lattice: lattice.is_some(),
            own_frames,
            has_holes: !field.domain.holes.is_empty(),
            has_kinks: field.step.cracks.iter().any(|c| c.points.len() > 2 || c.is_curved()),
            has_arcs: field.step.cracks.iter().any(Crack::is_curved) || has_round_side,
            has_levels: levels.is_some(),
        };
        (layout, lattice, levels)
    }
}

/// Refuses what the numbers of terms cannot hold.
fn check_sizes(field: &Field<'_>, groups: &FunctionGroups) -> Result<(), GpuError> {
    let (functions, components) = (groups.functions(), field.components());
    if groups.count() >= 1 << GROUP_BITS || components > MOST_COMPONENTS {
        return Err(GpuError::TooMany { functions, components });
    }
    Ok(())
}
