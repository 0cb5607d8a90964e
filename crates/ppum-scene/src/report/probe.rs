//! Exact values at a point: of the quantity and its gradient, on both sides of a crack, with cell
//! and patches, of the body or of its images.

use ppum::crack::{SegmentId, Side};
use ppum::field::{Field, LocalField};
use ppum::quantity::{Quantity, QuantityGradient, Reflection, ValueChange, face_names};
use ppum::sides::Segments;
use ppum::vec2::{Vec2, vec2};

use crate::image::mirror_lines::{MirrorLines, slope_sign};
use crate::image::quantity::DisplayedQuantity;
use crate::image::whole::reflected;
use crate::report::location::{Location, number};
use crate::report::owner::Owner;

/// The reading at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeReading {
    /// The point.
    pub spot: Location,
    /// The number of the tip that it is, if it is one.
    pub tip: Option<usize>,
    /// The crack that it lies on, if it lies on one.
    pub crack: Option<u32>,
    /// The values: one, or above and below a crack.
    pub sides: Vec<SideValue>,
    /// The patch that it belongs to; none outside the body.
    pub owner: Option<Owner>,
    /// On a crack the quantities of its faces by their symbols, with a value above and one below,
    /// or one alone of both.
    pub faces: Vec<(String, Vec<f64>)>,
    /// The patches of a cover that cover it, with their φ.
    pub patches: Vec<(u32, f64)>,
    /// True in an image of a body that is mirrored: patch and tip are those at the point whose
    /// image it is.
    pub is_mirrored: bool,
}

/// Value and gradient, on one side of a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideValue {
    /// The side of the crack, if the point lies on one.
    pub side: Option<Side>,
    /// The value; NaN where there is none.
    pub value: f64,
    /// Its gradient; NaN where there is none.
    pub gradient: Vec2,
    /// The values on the right and on the left whose difference it is, if it is one.
    pub terms: Option<[f64; 2]>,
}

impl SideValue {
    /// The gradient by its size and direction: `3.2 at 45°`; none where there is none.
    #[must_use]
    pub fn slope(&self) -> Option<String> {
        let (size, g) = (self.gradient.length(), self.gradient);
        let angle = || number(g.y.atan2(g.x).to_degrees().round(), 3);
        match size {
            _ if g.x.is_nan() => None,
            0.0 => Some("0".to_owned()),
            _ if size.is_finite() => Some(format!("{} at {}°", number(size, 5), angle())),
            _ => Some("∞".to_owned()),
        }
    }

    /// The difference from what is read on the left.
    fn minus(self, left: &Self) -> Self {
        Self {
            side: self.side.or(left.side),
            value: self.value - left.value,
            gradient: self.gradient - left.gradient,
            terms: Some([self.value, left.value]),
        }
    }
}

impl ProbeReading {
    /// True outside the body.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        self.owner.is_none()
    }

    /// The difference from what is read on the left. Where a crack runs on one side alone, the
    /// other has one value for both of its faces.
    #[must_use]
    pub fn minus(self, left: &Self) -> Self {
        let count = self.sides.len().max(left.sides.len());
        let of = |sides: &[SideValue], k: usize| sides[k.min(sides.len() - 1)];
        let sides = (0..count).map(|k| of(&self.sides, k).minus(&of(&left.sides, k))).collect();
        Self { sides, crack: self.crack.or(left.crack), faces: Vec::new(), ..self }
    }

    /// The value above a crack minus that below.
    #[must_use]
    pub fn jump(&self) -> Option<f64> {
        match self.sides[..] {
            [above, below] => Some(above.value - below.value),
            _ => None,
        }
    }
}

/// Reads values at points of a field and of its images, as long as it is given that field.
pub struct PointReader {
    shown: DisplayedQuantity,
    gradient: Option<QuantityGradient>,
    faces: Vec<Quantity>,
    images: Vec<ImageReader>,
}

/// Reads the values in an image of a body that is mirrored.
struct ImageReader {
    reflection: Reflection,
    /// Reads the values of the body, whose change makes them those of the image.
    reader: PointReader,
    change: ValueChange,
}

impl ImageReader {
    fn new(field: &Field<'_>, shown: &DisplayedQuantity, reflection: Reflection) -> Option<Self> {
        let (shown, change) = reflected(shown, &reflection, field).ok()?;
        let reader = PointReader::new(field, &shown, &MirrorLines::default());
        Some(Self { reflection, reader, change })
    }

    /// The values at a point of the image; none outside of it.
    fn read(&self, field: &Field<'_>, spot: &Location) -> Option<ProbeReading> {
        let Self { reflection, reader, change } = self;
        let there = reflection.point(spot.anchor());
        let there = Location::new(there, reflection.vector(spot.offset()));
        let read = reader.read_own(field, &there);
        let side = |sided: &SideValue| SideValue {
            value: change.apply(sided.value),
            gradient: reflection.vector(sided.gradient) * slope_sign(*change),
            ..*sided
        };
        let sides = read.sides.iter().map(side).collect();
        (!read.is_outside()).then_some(ProbeReading {
            spot: *spot,
            sides,
            is_mirrored: true,
            faces: Vec::new(),
            ..read
        })
    }
}

/// The symbol of a quantity of faces, and its values above and below, or one of both.
fn on_faces(face: &Quantity, local: &mut LocalField<'_>, offset: Vec2) -> (String, Vec<f64>) {
    let mut values = vec![face.at(local, offset, Side::Above)];
    if matches!(face, Quantity::Face(face) if face.is_sided()) {
        values.push(face.at(local, offset, Side::Below));
    }
    (face.symbol(&[]), values)
}

/// Most segments of cracks that are looked through for one that a point lies on.
const MOST_SEGMENTS: usize = 10_000;

impl PointReader {
    /// Reads what is shown of a field that is mirrored at some lines.
    #[must_use]
    pub fn new(field: &Field<'_>, shown: &DisplayedQuantity, lines: &MirrorLines) -> Self {
        let gradient = shown.quantity().and_then(|one| QuantityGradient::new(one, field).ok());
        let image = |by| ImageReader::new(field, shown, by);
        let images = lines.reflections().filter_map(image).collect();
        let faces =
            face_names(field).filter_map(|name| Quantity::parse(name, field).ok()).collect();
        Self { shown: shown.clone(), gradient, faces, images }
    }

    /// The values at a point of the body or of an image.
    #[must_use]
    pub fn read(&self, field: &Field<'_>, spot: &Location) -> ProbeReading {
        let own = self.read_own(field, spot);
        let is_outside = own.is_outside();
        let mut images = self.images.iter().filter(|_| is_outside);
        images.find_map(|image| image.read(field, spot)).unwrap_or(own)
    }

    /// The values at a point of the body itself.
    #[must_use]
    pub fn read_own(&self, field: &Field<'_>, spot: &Location) -> ProbeReading {
        let tip = spot.tip(&field.step.cracks);
        let on = if tip.is_some() { None } else { segment_of(field, spot) };
        let mut local = match on {
            Some(segment) => field.on(segment, spot.anchor()),
            None => field.at(spot.anchor()),
        };
        let mut patches = Vec::new();
        if local.contains(spot.offset()) {
            field.tree.query_point(spot.point(), &mut patches);
            patches.sort_unstable();
        }
        let owner = Owner::of(field, &mut local, spot.offset(), &patches);
        let sides: &[Option<Side>] = match on {
            Some(_) => &[Some(Side::Above), Some(Side::Below)],
            None => &[None],
        };
        let sides = sides.iter().map(|&side| {
            let at = (spot.offset(), side.unwrap_or_default());
            let (value, gradient) = self.value(&mut local, at, owner);
            SideValue { side, value, gradient, terms: None }
        });
        let sides = sides.collect();
        let faces = self.faces.iter().filter(|_| on.is_some());
        let faces = faces.map(|face| on_faces(face, &mut local, spot.offset())).collect();
        let phi = |patch: &u32| {
            let phi = local.partition_function::<0>(*patch as usize, spot.offset());
            (*patch, phi.map_or(f64::NAN, |jet| jet.v))
        };
        let is_cover = field.step.partition.mesh().is_none();
        let patches = patches.iter().filter(|_| is_cover).map(phi).collect();
        let (spot, crack) = (*spot, on.map(|segment| segment.crack));
        ProbeReading { spot, tip, crack, sides, owner, faces, patches, is_mirrored: false }
    }

    /// Value and gradient on a side; of a value of cells that of the point's own.
    fn value(
        &self,
        local: &mut LocalField<'_>,
        (offset, side): (Vec2, Side),
        owner: Option<Owner>,
    ) -> (f64, Vec2) {
        match (&self.shown, &self.gradient) {
            (DisplayedQuantity::Quantity(_), Some(both)) => {
                let slope = both.at(local, offset, side);
                (slope.value, slope.gradient)
            }
            (DisplayedQuantity::Quantity(quantity), None) => {
                (quantity.at(local, offset, side), NOWHERE)
            }
            (DisplayedQuantity::Cells(_, values), _) => {
                let of_cell = owner.and_then(|owner| values.get(owner.patch() as usize));
                (of_cell.copied().unwrap_or(f64::NAN), NOWHERE)
            }
        }
    }
}

/// The segment that a point lies on: the one that it was put on if the step still has it, or one
/// that it lies on except for rounding.
#[must_use]
pub fn segment_of(field: &Field<'_>, spot: &Location) -> Option<SegmentId> {
    let cracks = &field.step.cracks;
    if let Some([crack, segment]) = spot.on {
        let edge = cracks.get(crack as usize)?.edges().nth(segment as usize)?;
        let (distance, _) = spot.projected(edge);
        let is_on = distance <= 1e-14 * edge.length().max(edge.from.length());
        return is_on.then_some(SegmentId { crack, segment });
    }
    let segments: usize = cracks.iter().map(|crack| crack.points.len()).sum();
    if segments > MOST_SEGMENTS {
        return None;
    }
    Segments::new(cracks).at(spot.anchor(), spot.offset())
}

const NOWHERE: Vec2 = vec2(f64::NAN, f64::NAN);
