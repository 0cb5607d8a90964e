//! Kinks at the interfaces of materials: what no function of the problem's own has is added.

use super::{Degree, EnrichmentPatch, Enrichments, Instance, Patches};
use crate::smoothness::{BESIDE, Interface, InterfacePoint, Interfaces, Probe};
use crate::space::SpaceError;
use crate::space::inspect::InspectError;
use crate::watched::WorkPhase;
use ppum::crack::{Crack, LocalCrack, Side};
use ppum::dataset::BoxPartition;
use ppum::function::{Frame, Function, FunctionError, FunctionKind, NonsmoothPoints, Role};
use ppum::progress::Cancelled;
use ppum::vec2::Vec2;
use ppum_problem::Enrichment;
use rayon::prelude::*;
use std::sync::Arc;

/// Change of a gradient across an interface, relative to its size, that is a kink.
const BENT: f64 = 1e-3;

/// Distance of a point to an interface, in parts of a patch, that is rounding.
const ON: f64 = 1e-9;

/// An interface and, if it is to be independent on both sides of a crack, the crack.
type InterfaceCut = (usize, Option<usize>);

impl Enrichments<'_> {
    /// Adds |ψ| on the patches that an interface ψ = 0 cuts, as far as the material jumps there and
    /// no other function has the kink; and side(k) |ψ| where crack k cuts through patch
    /// and interface.
    ///
    /// # Errors
    /// A function of the problem's own that does not compile; cancelled.
    pub(crate) fn add_interfaces(
        &mut self,
        partition: &BoxPartition,
        stage: &WorkPhase<'_>,
    ) -> Result<(), SpaceError> {
        let set = &self.problem.discretization;
        if !set.interfaces || set.enrichment == Enrichment::None {
            return Ok(());
        }
        let (domain, cracks) = (self.problem.domain(), self.problem.cracks());
        let interfaces = Interfaces::new(self.problem.constants(), domain, cracks);
        if interfaces.all.is_empty() {
            return Ok(());
        }
        let probes = self.own_probes().map_err(InspectError::from)?;
        let cuts = |patch: usize| {
            let patch = EnrichmentPatch::new(partition, patch, self.problem);
            stage.advance(0).map(|()| self.cuts(&patch, &interfaces, &probes))
        };
        let cuts: Vec<Vec<InterfaceCut>> =
            (0..partition.len()).into_par_iter().map(cuts).collect::<Result<_, Cancelled>>()?;
        for (index, interface) in interfaces.all.iter().enumerate() {
            let cracks = (0..self.problem.cracks().len()).map(Some);
            for crack in [None].into_iter().chain(cracks) {
                let listed = |patch: &u32| cuts[*patch as usize].contains(&(index, crack));
                let patches: Vec<u32> = (0..partition.len() as u32).filter(listed).collect();
                if !patches.is_empty() {
                    let degree = match interface.frame {
                        Frame::World => Degree::OfPatch,
                        _ => Degree::BelowPatch,
                    };
                    let kink = vec![kink(interface, crack)];
                    self.push(kink, Patches::Listed(patches), degree);
                }
            }
        }
        Ok(())
    }

    /// The interfaces that are to be resolved on a patch.
    fn cuts(
        &self,
        patch: &EnrichmentPatch<'_>,
        interfaces: &Interfaces<'_>,
        probes: &[Probe],
    ) -> Vec<InterfaceCut> {
        let own = &self.instances[self.own.clone()];
        let own: Vec<_> = own.iter().filter(|new| patch.is_of(&new.patches)).collect();
        let size = patch.support.size();
        let width = size.x.min(size.y);
        let through =
            || self.jumps.as_ref().map_or_else(Vec::new, |jumps| jumps.through(&patch.open));
        let mut found: Vec<usize> = Vec::new();
        let mut cuts = Vec::new();
        for (index, interface) in interfaces.all.iter().enumerate() {
            let places = interfaces.places(interface, &patch.open);
            let known = |place: &InterfacePoint| {
                self.has_kink(&own, probes, place, width)
                    || found.iter().any(|&k| runs_through(&interfaces.all[k], place.at, width))
            };
            if places.iter().all(known) {
                continue;
            }
            found.push(index);
            cuts.push((index, None));
            let cracks = through().into_iter().map(|crack| crack as usize);
            let parted = cracks.filter(|&k| parts(&self.problem.cracks()[k], &places));
            cuts.extend(parted.map(|k| (index, Some(k))));
        }
        cuts
    }

    /// The functions of the problem's own, as quadrature sees them.
    fn own_probes(&self) -> Result<Vec<Probe>, FunctionError> {
        let cracks: Arc<[Crack]> = self.problem.cracks().into();
        let own = self.instances[self.own.clone()].iter().flat_map(|new| new.functions.clone());
        own.map(|index| {
            let function = &self.table[index as usize];
            let error = |e| FunctionError { index: index as usize, ..e };
            Probe::function(function, &cracks, &self.problem.tables).map_err(error)
        })
        .collect()
    }

    /// True if the gradient of one of the problem's own functions of some instances jumps across an
    /// interface.
    fn has_kink(
        &self,
        own: &[&Instance],
        probes: &[Probe],
        place: &InterfacePoint,
        width: f64,
    ) -> bool {
        let first = self.instances[self.own.clone()].first().map_or(0, |new| new.functions.start);
        let mut functions = own.iter().flat_map(|new| new.functions.clone());
        functions.any(|index| {
            let probe = &probes[(index - first) as usize];
            let beside = place.normal * (BESIDE * width);
            let [below, above] = [-1.0, 1.0].map(|sign| {
                let [_, x, y] = probe.jet(place.at, beside * sign);
                Vec2 { x, y }
            });
            (above - below).length() > BENT * above.length().max(below.length())
        })
    }
}

/// True if a point lies on an interface.
fn runs_through(interface: &Interface, p: Vec2, width: f64) -> bool {
    interface.value(p).abs() <= ON * width * interface.gradient(p).length()
}

/// True if the places lie on both sides of a crack.
fn parts(crack: &Crack, places: &[InterfacePoint]) -> bool {
    let above = |place: &InterfacePoint| {
        let seen = LocalCrack::new(crack, place.at);
        seen.side([0.0, 0.0], Side::Above) > 0.0
    };
    places.iter().any(above) && !places.iter().all(above)
}

/// |ψ|, times the side of a crack.
fn kink(interface: &Interface, crack: Option<usize>) -> Function {
    let (text, name) = (&interface.text, interface.name());
    let (text, name) = match crack {
        None => (text.clone(), format!("kink at {name}")),
        Some(k) => (format!("side({k})*{text}"), format!("kink at {name}, side of crack {k}")),
    };
    let (frame, parameters, declared) = (interface.frame, Vec::new(), NonsmoothPoints::default());
    let role = Role::Interface;
    Function { name, kind: FunctionKind::Formula { text, frame, parameters, declared, role } }
}
