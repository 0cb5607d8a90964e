//! Limits of formulas, whoever wrote them.

/// Deepest nesting of parentheses, calls, signs and powers. Deeper ones are machine-made or
/// malicious; the parser needs up to 0.7 MiB of stack at this depth, a third of what a thread has.
pub const MAX_DEPTH: usize = 200;

/// Longest text of a formula, in bytes.
pub const MAX_LENGTH: usize = 1 << 16;

/// Most operations of a formula with its derivatives. Hand-written formulas have a hundred; this
/// many still fit in some tens of megabytes and are made within a second.
pub const MAX_NODES: usize = 1 << 18;
