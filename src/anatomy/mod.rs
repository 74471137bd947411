//! Measures of a dog's head, breeds as values of them, and their files. Knows no mesh.
