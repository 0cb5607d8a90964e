//! The solver against exact solutions and independent reference values.

mod adaptive;
mod anisotropy;
mod arcs;
mod awkward;
mod axisymmetric;
mod contact;
mod corners;
mod curved;
mod curved_contact;
mod eigenstrain;
mod estimate;
mod estimator;
mod examples;
mod exchange;
mod faces;
mod fatigue;
mod features;
mod forces;
mod foreign;
mod formulas;
mod goal;
mod graded;
mod growth;
mod halves;
mod heat;
mod holes;
mod incompressible;
mod intensity;
mod interfaces;
mod junctions;
mod kernels;
mod kinked;
mod loads;
mod multilevel;
mod names;
mod outlines;
mod paths;
mod physics;
mod pieces;
mod plates;
mod positions;
mod random;
mod reactions;
mod refined;
mod rims;
mod rounding;
mod sides;
mod slivers;
#[path = "../studies/mod.rs"]
mod studies;
mod support;
mod supports;
mod tip_terms;
mod visible;
mod warnings;
mod watched;
mod weight_functions;
mod weights;
mod williams;

/// The tables of a problem file for the body [−1, 1]², E = 1, ν = 0.3 in plane strain.
const SQUARE_BODY: &str = "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 1\n\
     poisson = 0.3\nstate = \"plane-strain\"\n";
