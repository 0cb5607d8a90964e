//! One command each: its arguments and what it prints.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod demo;
pub(crate) mod export;
pub(crate) mod formula;
pub(crate) mod import;
pub(crate) mod info;
pub(crate) mod init;
pub(crate) mod man;
pub(crate) mod plot;
pub(crate) mod probe;
pub(crate) mod render;
pub(crate) mod sample;
pub(crate) mod sif;
pub(crate) mod solve;
pub(crate) mod view;
pub(crate) mod weight;
