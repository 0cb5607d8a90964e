//! ppum-format
