//! Frames as files of other programs.
