//! The language: from a text to operations in a graph, by the names of a scope.

pub(crate) mod ast;
mod dependent;
mod half_angle;
mod lexer;
pub(crate) mod lower;
pub(crate) mod parser;
pub(crate) mod scope;
