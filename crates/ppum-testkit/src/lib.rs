//! ppum-testkit
