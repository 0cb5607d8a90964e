//! ppum-render
