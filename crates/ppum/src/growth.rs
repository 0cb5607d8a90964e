//! How cracks grow from one step of a series to the next: what is decided at the end of a step, and
//! stored with it.
//!
//! The cracks of the next step follow from the cracks of this one and its [`Growth`] alone, so that
//! a series goes on from its last step as if it had never been interrupted.

use crate::crack::TipId;
use crate::edge::Edge;
use crate::vec2::Vec2;

/// The growth that follows a step: the next increment of each tip, and the end of the series.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Growth {
    /// Load cycles up to this step; none where growth has no time.
    pub cycles: Option<f64>,
    /// The tips, in the order of cracks and ends.
    pub tips: Vec<TipIncrement>,
    /// The reason why the series ends with this step; none if it goes on.
    pub stop: Option<GrowthStop>,
}

/// The next increment of one tip: it stays, or goes on along an arc of a circle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TipIncrement {
    /// The tip.
    pub tip: TipId,
    /// Whether the tip grows or stays, and why.
    pub fate: TipStatus,
    /// The factor that is compared with the toughness: K_I of a crack that grows in the direction
    /// of its criterion under the loads of the problem \[stress·length^½\]; NaN where there
    /// is none.
    pub k_eq: f64,
    /// Direction of the arc at the tip, the angle to the x axis \[rad\]; without growth that of
    /// the crack.
    pub direction: f64,
    /// Curvature of the arc, positive where it turns left \[1/length\].
    pub curvature: f64,
    /// The vertices that the crack gets at this end, from the tip on, which is none of them: the
    /// end of the arc; none of a tip that stays. Older files have several, joined by segments.
    pub path: Vec<Vec2>,
    /// Length of the path.
    pub length: f64,
    /// Growth that is due, but less than an increment: it is made together with what follows.
    pub due: f64,
    /// Length by which the crack has grown at this end since the first step.
    pub extension: f64,
}

impl TipIncrement {
    /// The edges that the crack gets at this end, from the tip on, which lies at a point.
    #[must_use]
    pub fn edges(&self, tip: Vec2) -> Vec<Edge> {
        let bulge = match self.path[..] {
            [_] => (0.25 * self.curvature * self.length).tan(),
            _ => 0.0,
        };
        let starts = std::iter::once(tip).chain(self.path.iter().copied());
        let edge = |(from, &to): (Vec2, &Vec2)| Edge { from, to, bulge };
        starts.zip(&self.path).map(edge).collect()
    }

    /// A tip that stays where it is, of which nothing else is known.
    #[must_use]
    pub fn staying(tip: TipId, fate: TipStatus) -> Self {
        Self { tip, fate, k_eq: f64::NAN, ..Self::default() }
    }
}

/// Whether a tip grows or stays, and why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum TipStatus {
    /// It goes on, and is a tip again.
    Grows,
    /// It goes on to the boundary of the body, where it ends.
    LeavesBody,
    /// It goes on to the axis of a body of revolution, where it ends.
    MeetsAxis,
    /// It goes on to the rim of a hole, where it ends.
    MeetsHole(u32),
    /// It goes on to another crack, where it ends.
    MeetsCrack(u32),
    /// Its growth is less than an increment so far.
    Waits,
    /// Its strength is below the toughness, or not the largest.
    Held,
    /// K_I is negative: its faces overlap.
    Closed,
    /// It has no factors.
    #[default]
    Unknown,
    /// It would meet its own crack.
    MeetsItself,
    /// Another crack goes on to it, so that it is a tip no more.
    Joined,
}

impl TipStatus {
    /// True if the tip goes on.
    #[must_use]
    pub fn goes_on(self) -> bool {
        let ends = matches!(self, Self::LeavesBody | Self::MeetsAxis);
        ends || matches!(self, Self::Grows | Self::MeetsHole(_) | Self::MeetsCrack(_))
    }

    /// In words, e.g. `meets crack 3`.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Grows => "grows".into(),
            Self::LeavesBody => "leaves the plate".into(),
            Self::MeetsAxis => "meets the axis".into(),
            Self::MeetsHole(k) => format!("meets hole {k}"),
            Self::MeetsCrack(k) => format!("meets crack {k}"),
            Self::Waits => "waits".into(),
            Self::Held => "held".into(),
            Self::Closed => "closed".into(),
            Self::Unknown => "no factors".into(),
            Self::MeetsItself => "would meet itself".into(),
            Self::Joined => "is joined".into(),
        }
    }
}

/// The reason why a series ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GrowthStop {
    /// There are no tips any more.
    NoTips,
    /// No tip goes on.
    AllHeld,
    /// A tip under cyclic loads reaches the toughness: the rest is one motion.
    Fracture,
    /// The next increment would set a piece free that loads act on.
    PieceComesOff,
    /// The next step cannot be solved for another reason, which a warning of this step tells.
    Unsolvable,
}

impl GrowthStop {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::NoTips => "no tip is left",
            Self::AllHeld => "no tip goes on",
            Self::Fracture => "the toughness is reached",
            Self::PieceComesOff => "a piece comes off",
            Self::Unsolvable => "the next step cannot be solved",
        }
    }
}
