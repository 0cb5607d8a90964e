//! The body of a problem: what elasticity and heat share.

use std::sync::Arc;

use ppum::border::BorderLine;
use ppum::crack::Crack;
use ppum::domain::Domain;

use super::{BoundaryPart, BoundaryPiece, Discretization};
use crate::geometry::{settled, with_ends};

/// A body with cracks: the box minus holes Ω, and the pieces of its boundary that have names.
///
/// The ends of cracks, and the straight lines of the boundary that they lie on, always fit the
/// domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    domain: Domain,
    pieces: Vec<BoundaryPiece>,
    cracks: Vec<Crack>,
    /// Coulomb's coefficient μ ≥ 0 of friction of each crack whose faces may touch; faces of others
    /// may overlap.
    contacts: Vec<Option<f64>>,
    /// The straight line of the boundary that each crack lies on.
    lines: Vec<Option<BorderLine>>,
}

impl Body {
    /// A body without cracks.
    pub(crate) fn new(domain: Domain, pieces: Vec<BoundaryPiece>) -> Self {
        let (cracks, contacts, lines) = (Vec::new(), Vec::new(), Vec::new());
        Self { domain, pieces, cracks, contacts, lines }
    }

    /// The body with the same cracks in another domain.
    pub(crate) fn with_domain(self, domain: Domain) -> Self {
        let cracks = self.cracks.clone();
        Self { domain, ..self }.with_lines(cracks).settled()
    }

    /// The body with cracks along these lines in place of its own, as they are: vertices that a
    /// crack does not need stay. Cracks keep what is known of their faces by their numbers.
    pub(crate) fn with_lines(self, lines: impl IntoIterator<Item = impl Into<Crack>>) -> Self {
        let cracks = with_ends(lines, &self.domain);
        self.with_cracks(cracks)
    }

    /// The body with the cracks of a step in place of its own.
    pub(crate) fn with_cracks(mut self, cracks: Vec<Crack>) -> Self {
        let touching = self.contacts.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        self.contacts.resize(cracks.len().max(touching), None);
        self.lines = cracks.iter().map(|crack| self.domain.line_along(crack)).collect();
        Self { cracks, ..self }
    }

    /// The body whose cracks meet exactly where they are meant to, see [`cracks`](crate::cracks()).
    pub(crate) fn settled(mut self) -> Self {
        let cracks = settled(std::mem::take(&mut self.cracks), &self.domain);
        self.with_cracks(cracks)
    }

    /// The body with coefficients of friction between the faces of its cracks that may touch.
    pub(crate) fn with_contacts(self, contacts: Vec<Option<f64>>) -> Self {
        Self { contacts, ..self }
    }

    /// The body with a crack, given by its number, whose faces may touch with some friction.
    pub(crate) fn with_contact(mut self, crack: u32, friction: f64) -> Self {
        let crack = crack as usize;
        self.contacts.resize(self.contacts.len().max(crack + 1), None);
        self.contacts[crack] = Some(friction);
        self
    }

    /// The body as another problem names its pieces.
    pub(crate) fn with_pieces(self: &Arc<Self>, pieces: &[BoundaryPiece]) -> Arc<Self> {
        match self.pieces == pieces {
            true => Arc::clone(self),
            false => Arc::new(Self { pieces: pieces.to_vec(), ..(**self).clone() }),
        }
    }

    /// The box minus holes Ω.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The pieces of rims that have names, which conditions may be on.
    #[must_use]
    pub fn pieces(&self) -> &[BoundaryPiece] {
        &self.pieces
    }

    /// The cracks.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        &self.cracks
    }

    /// Coulomb's coefficient of friction between the faces of a crack, if these may touch.
    #[must_use]
    pub fn contact(&self, crack: u32) -> Option<f64> {
        *self.contacts.get(crack as usize)?
    }

    /// The cracks whose faces may touch, by their numbers, with their coefficients of friction.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        self.contacts.iter().enumerate().filter_map(|(crack, friction)| Some((crack, (*friction)?)))
    }

    /// The straight line of the boundary that a crack lies on.
    pub fn line_of(&self, crack: usize) -> Option<BorderLine> {
        self.lines[crack]
    }
}

/// The body of a text that may not be a problem yet.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyText {
    /// The body.
    pub body: Body,
    /// Where the text has conditions on the boundary, in its order.
    pub conditions: Vec<ConditionPlace>,
    /// The key of loads on the boundary: `traction` or `flux`.
    pub load_key: &'static str,
}

/// A condition in a text.
#[derive(Clone, Debug, PartialEq)]
pub struct ConditionPlace {
    /// The part of the boundary.
    pub part: BoundaryPart,
    /// The part as it is written.
    pub on: String,
    /// Line and column of its table, from 1.
    pub at: [usize; 2],
}

/// A body that a temperature strains, and its discretisation.
pub(crate) struct HeatedBody<'a> {
    pub(crate) body: &'a Body,
    pub(crate) discretization: &'a Discretization,
}
