//! Which places of the skin are landmarks: those of the control mesh's file, and more of the canonical list by name.
//!
//! Ids K01 to K58 are those of the canonical list of skin landmarks. A place is a control vertex, or the middle of a
//! control face, which is a vertex of the refined skin from level 1 on. Not on this skin: K33 and K34 belong to the
//! eyeball, K52 to the tongue, and K50 and K51 are the fold and, as K49, the tip of an ear that hangs.

use super::control::HalfMesh;

/// Id, name, and one vertex of the control mesh or the three of a face; see `assets/head.patch.ron` for the vertices.
const MORE: [(&str, &str, &[&str]); 22] = [
    ("K01", "nose tip", &["nm.1"]),
    ("K06", "nostril, lateral slit end", &["nr.4"]),
    ("K08", "upper lip margin at canine", &["s.5.9"]),
    ("K12", "lower lip margin at canine", &["l.5.9"]),
    ("K17", "jaw line at M1", &["l.10.11"]),
    ("K18", "jaw angle", &["s.14.9", "s.15.9", "l.15.10"]),
    ("K21", "bridge corner at mid muzzle", &["s.5.2"]),
    ("K26", "brow pad medial", &["s.9.1", "s.9.2", "s.10.2"]),
    ("K28", "brow lateral", &["s.11.2", "s.11.3", "s.12.3"]),
    ("K35", "infraorbital groove end", &["s.9.5"]),
    ("K37", "masseter bulge", &["s.13.7", "s.13.8", "s.14.8"]),
    ("K41", "muzzle-cheek junction", &["s.9.6"]),
    ("K42", "whisker pad centre", &["s.3.6", "s.4.6", "s.4.7"]),
    ("K43", "genal vibrissa tuft", &["s.11.8"]),
    ("K44", "interramal vibrissa tuft", &["l.11.14"]),
    ("K45", "supraorbital vibrissa tuft", &["s.10.1", "s.10.2", "s.11.2"]),
    ("K53", "neck dorsal at atlas", &["s.17.0"]),
    ("K54", "neck lateral at atlas", &["s.18.6"]),
    ("K55", "neck ventral at C1", &["l.18.14"]),
    ("K56", "inner brow head", &["s.10.0", "s.10.1", "s.11.1"]),
    ("K57", "planum nasale dorsolateral corner", &["s.0.3"]),
    ("K58", "lower lip margin at P2-P3", &["l.7.9"]),
];

/// A place of the control mesh, by number in the whole mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A vertex; it keeps its number at every level.
    Vertex(u32),
    /// The middle of a face.
    Face(u32),
}

/// A landmark of the skin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkinLandmark {
    /// Id of the canonical list: K and two digits.
    pub id: String,
    /// What it is, in words.
    pub name: String,
    /// In the median plane, or on the left.
    pub place: Place,
    /// Its mirror image on the right; none for one in the median plane.
    pub right: Option<Place>,
}

impl HalfMesh {
    /// The landmarks of the skin by id, ascending. What the mesh has no vertices for is left out.
    pub fn skin_landmarks(&self) -> Vec<SkinLandmark> {
        let own =
            self.landmarks.iter().map(|(id, name, v)| (id.as_str(), name.as_str(), Some(Place::Vertex((*v).into()))));
        let more = MORE.iter().map(|&(id, name, tags)| (id, name, self.place(tags)));
        let mirror = self.mirror();
        let landmark = |(id, name, place): (&str, &str, Option<Place>)| {
            let place = place?;
            let right = match place {
                Place::Vertex(v) => (!self.midline[v as usize]).then(|| Place::Vertex(mirror[v as usize])),
                // The faces of the right half follow those of the left in their order.
                Place::Face(f) => Some(Place::Face(f + self.faces.len() as u32)),
            };
            Some(SkinLandmark { id: id.to_owned(), name: name.to_owned(), place, right })
        };
        let mut all: Vec<SkinLandmark> = own.chain(more).filter_map(landmark).collect();
        all.sort_by(|a, b| a.id.cmp(&b.id));
        all
    }

    fn place(&self, tags: &[&str]) -> Option<Place> {
        let vertices: Vec<usize> =
            tags.iter().map(|tag| self.tags.iter().position(|t| t == tag)).collect::<Option<_>>()?;
        if let [vertex] = vertices[..] {
            return Some(Place::Vertex(vertex as u32));
        }
        let face = self.faces.iter().position(|f| vertices.iter().all(|&v| f.iter().any(|&c| usize::from(c) == v)));
        face.map(|f| Place::Face(f as u32))
    }
}
