//! Frames as pixels.
