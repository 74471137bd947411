//! OBJ.
