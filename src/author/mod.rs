//! How the head's assets are made: patch language, first fit, bake.
