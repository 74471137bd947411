//! Arithmetic that gives the same bits everywhere, and the named spaces.
