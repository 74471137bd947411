//! Heads made ready for the question what touches in their mouths.

use glam::Vec3;
use londra::anatomy::{Breed, ParamTable};
use londra::frame::{Layers, Pipeline};
use londra::motion::JointLimits;
use londra::rig::bone::{Bones, BonesOfHead};
use londra::rig::touch::{Body, Head, LipRows, Lips, Swept};
use londra::rig::{Eye, Rig};
use std::sync::Arc;

/// What makes mouths, once for a program.
pub struct Maker {
    /// The table of measures.
    #[allow(dead_code)] // not every user asks
    pub table: Arc<ParamTable>,
    rig: Arc<Rig>,
    pipeline: Pipeline,
    pub bones: Bones,
    pub tongue_indices: Vec<u32>,
    pub rows: LipRows,
    pub weights: Vec<f32>,
    pub limits: JointLimits,
}

/// One head at rest.
pub struct Shape {
    /// Bones and teeth.
    pub bones: BonesOfHead,
    /// The tongue as it is drawn.
    pub tongue: Vec<Vec3>,
    /// The refined skin.
    pub skin: Vec<Vec3>,
    /// Eyes.
    pub eyes: [Eye; 2],
}

impl Maker {
    /// For a table and its rig.
    pub fn new(table: &Arc<ParamTable>, rig: &Arc<Rig>) -> Maker {
        let rows = LipRows::new(rig);
        let mut weights = vec![0.0; rig.mesh().n_vertices()];
        for row in &rows.lower {
            row.iter().for_each(|&v| weights[v as usize] = 1.0);
        }
        // Towards the corners of the mouth both lips share the jaw's turn.
        for (row, near) in rows.upper.iter().map(|r| (r, 0.15)).chain(rows.lower.iter().map(|r| (r, 0.85))) {
            let last = row.len() - 1;
            for (place, weight) in [(1, near), (last - 1, near), (0, 0.5), (last, 0.5)] {
                weights[row[place] as usize] = weight;
            }
        }
        let mut pipeline = Pipeline::new(rig.clone(), 3).unwrap_or_else(|e| panic!("{e}"));
        let layers = Layers::parse("skin,eyes,tongue").unwrap_or_else(|e| panic!("{e}"));
        pipeline.set_layers(layers).unwrap_or_else(|e| panic!("{e}"));
        let frame = pipeline.frame();
        let tongue = frame.parts.iter().find(|p| p.topology.name == "tongue").expect("it is shown");
        let tongue_indices = tongue.topology.indices.clone();
        Maker {
            table: table.clone(),
            rig: rig.clone(),
            pipeline,
            bones: Bones::embedded().unwrap_or_else(|e| panic!("{e}")),
            tongue_indices,
            rows,
            weights,
            limits: JointLimits::embedded().unwrap_or_else(|e| panic!("{e}")),
        }
    }

    /// A head.
    pub fn shape(&mut self, breed: &Breed) -> Shape {
        let frame = self.pipeline.update(breed);
        let skin = frame.parts[0].positions.to_vec();
        let eyes = std::array::from_fn(|side| frame.eyes[side].eye);
        let tongue = frame.parts.iter().find(|p| p.topology.name == "tongue").expect("it is shown");
        let mut out = Shape { bones: BonesOfHead::default(), tongue: tongue.positions.to_vec(), skin, eyes };
        let (measures, proportions) = (self.rig.measures(&breed.values), self.rig.proportions(&breed.values));
        self.bones.shape(&measures, &proportions, &mut out.bones);
        out
    }

    /// What its parts are made of.
    pub fn head<'a>(&'a self, shape: &'a Shape) -> Head<'a> {
        Head {
            bones: &self.bones,
            of_head: &shape.bones,
            tongue: Body { at: &shape.tongue, indices: &self.tongue_indices },
            eyes: &shape.eyes,
            lips: Lips { rows: &self.rows, at: &shape.skin, weights: &self.weights },
        }
    }

    /// Its spheres and tables.
    pub fn swept(&self, shape: &Shape) -> Swept {
        Swept::new(&self.head(shape), &self.limits)
    }
}
