//! Properties of every field, on synthetic datasets.

mod anchors;
mod borders;
mod decompose;
mod deep_zoom;
mod derivatives;
mod each;
mod errors;
mod faces;
mod formulas;
mod gradients;
mod hp_mesh;
mod indicators;
mod jumps;
mod lanes;
mod library;
mod mesh;
mod mesh_checks;
mod partition;
mod reflected;
mod replace;
mod reproduction;
mod sample;
mod sides;
mod support;
