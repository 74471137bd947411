//! Subdivision as a plan that is built once and evaluated every frame.
