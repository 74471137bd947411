//! The head: control mesh, landmarks, and the function from measures to control positions.
