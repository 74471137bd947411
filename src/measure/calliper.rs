//! What a vet would measure, taken on the head as it stands: on bone between landmarks, on skin as on a live dog.
//!
//! Points and indices: von den Driesch 1976 and the literature that `docs/head.md` names. Every number here is measured on
//! the model; what it has to do with living dogs is as good as the numbers that the breed was made from.

use crate::anatomy::Breed;
use crate::frame::skin_tags;
use crate::math::ops;
use crate::rig::bone::{Bones, Targets, targets, teeth};
use crate::rig::{ControlError, Deformed, Rig, deform};
use crate::subdiv::{Evaluator, Plan, PlanError, PlanOptions, Scheme};
use glam::Vec3;
use std::sync::Arc;

/// Steps of the skin on which live-dog measures are taken.
const LEVEL: u32 = 3;

/// On what something is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tissue {
    /// Refined skull or mandible.
    Bone,
    /// Refined skin.
    Skin,
}

/// What a number counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Millimetres.
    Millimetre,
    /// Degrees.
    Degree,
    /// A hundredth: an index.
    Percent,
    /// A quotient.
    Ratio,
}

impl Tissue {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Tissue::Bone => "bone",
            Tissue::Skin => "skin",
        }
    }
}

impl Dimension {
    /// The unit behind a number; nothing behind a pure one.
    pub fn unit(self) -> &'static str {
        match self {
            Dimension::Millimetre => "mm",
            Dimension::Degree => "deg",
            Dimension::Percent | Dimension::Ratio => "",
        }
    }

    /// How many digits behind the point mean something.
    pub fn decimals(self) -> usize {
        if self == Dimension::Ratio { 2 } else { 1 }
    }
}

/// One measurement of one head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Short name, stable.
    pub id: &'static str,
    /// What it is called.
    pub label: &'static str,
    /// From where to where, or by which formula.
    pub definition: &'static str,
    /// On bone or on skin.
    pub tissue: Tissue,
    /// What the number counts.
    pub dimension: Dimension,
    /// The number.
    pub value: f32,
}

/// Dogs by their cephalic index: narrow below 46, broad above 66, the midpoints of the class averages 39, 52 and 81.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkullClass {
    /// Long and narrow.
    Dolichocephalic,
    /// Between.
    Mesaticephalic,
    /// Short and broad.
    Brachycephalic,
}

impl SkullClass {
    /// Of a cephalic index.
    pub fn of(cephalic_index: f32) -> SkullClass {
        match cephalic_index {
            i if i < 46.0 => SkullClass::Dolichocephalic,
            i if i > 66.0 => SkullClass::Brachycephalic,
            _ => SkullClass::Mesaticephalic,
        }
    }

    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            SkullClass::Dolichocephalic => "dolichocephalic",
            SkullClass::Mesaticephalic => "mesaticephalic",
            SkullClass::Brachycephalic => "brachycephalic",
        }
    }
}

/// Why nothing can be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// A baked bone is none.
    #[error(transparent)]
    Bone(#[from] ControlError),
    /// The skin's plan cannot be built.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// Measures heads; buffers are made once.
pub struct Calliper {
    rig: Arc<Rig>,
    bones: Bones,
    plan: Plan,
    evaluator: Evaluator,
    deformed: Deformed,
}

impl Calliper {
    /// For a rig.
    ///
    /// # Errors
    /// See [`MeasureError`].
    pub fn new(rig: Arc<Rig>) -> Result<Self, MeasureError> {
        let plan = Plan::build_with(rig.mesh(), &skin_tags(&rig), &PlanOptions::new(Scheme::Sqrt3, LEVEL))?;
        Ok(Self {
            bones: Bones::embedded()?,
            evaluator: Evaluator::new(&plan),
            plan,
            rig,
            deformed: Deformed::default(),
        })
    }

    /// Every measurement of a head, in a fixed order. `values`: SI, one for each row of the table that the rig was made for.
    pub fn measure(&mut self, values: &[f32]) -> Vec<Measurement> {
        let rig = &self.rig;
        rig.deform(values, deform::ROUNDS, &mut self.deformed);
        let bone = self.bones.landmarks_alone(&rig.measures(values), &rig.proportions(values));
        let skin = self.evaluator.evaluate(&self.plan, &self.deformed.control).positions;
        let landmarks = &rig.half().landmarks;
        let on_skin = |id: &str| {
            let vertex = landmarks.iter().find(|l| l.0 == id).map(|l| usize::from(l.2));
            vertex.map_or(Vec3::NAN, |v| skin[v]) * 1000.0
        };
        let on_bone = |id: &str| bone.iter().find(|(known, _)| *known == id).map_or(Vec3::NAN, |(_, p)| *p) * 1000.0;
        let mut found = measurements(&on_bone, &on_skin, self.deformed.eyes[0].radius * 2000.0);
        found.push(Measurement {
            id: "overjet",
            label: "Overjet",
            definition: "edge of the upper first incisor before that of the lower, along the palate; below 0 undershot",
            tissue: Tissue::Bone,
            dimension: Dimension::Millimetre,
            value: overjet(&targets(&rig.measures(values), &rig.proportions(values))) * 1000.0,
        });
        found
    }

    /// The same for every breed: what percentiles are among.
    pub fn survey(&mut self, breeds: &[Breed]) -> Vec<Vec<Measurement>> {
        breeds.iter().map(|breed| self.measure(&breed.values)).collect()
    }
}

/// From the edge of the lower first incisor forwards to that of the upper, on the crowns, metres.
fn overjet(landmarks: &Targets<Vec3>) -> f32 {
    let [upper, lower] = [true, false].map(|upper| {
        let mut crowns = Vec::new();
        teeth::place(landmarks, upper, &mut crowns);
        teeth::edge_of_first(&crowns).map_or(f32::NAN, |edge| edge.z)
    });
    upper - lower
}

fn measurements(bone: &dyn Fn(&str) -> Vec3, skin: &dyn Fn(&str) -> Vec3, globe: f32) -> Vec<Measurement> {
    use Dimension::{Degree, Millimetre, Percent, Ratio};
    let (prosthion, nasion, inion) = (bone("S01"), bone("S03"), bone("S07"));
    let (zygion, euryon) = (bone("S12"), bone("S13"));
    let skull_length = prosthion.distance(inion);
    let facial_length = prosthion.distance(nasion);
    let cranial_length = nasion.distance(inion);
    let (zygomatic_width, cranial_width) = (2.0 * zygion.x, 2.0 * euryon.x);
    let cranial_height = bone("S05").distance(bone("S10"));
    let mandible_length = ((bone("S32") - bone("S28")) * Vec3::new(0.0, 1.0, 1.0)).length();
    let condylobasal = (prosthion - bone("S36") * Vec3::new(0.0, 1.0, 1.0)).length();
    let palate = prosthion.distance(bone("S11"));
    let palatal_width = 2.0 * bone("S21").x;
    let stop = skin("K22");
    let (nose, occiput) = (skin("K02"), skin("K25"));
    let (muzzle, cranium) = (stop.distance(nose), stop.distance(occiput));
    let (medial, lateral) = (skin("K29"), skin("K30"));
    // Seen from the front: from the tip of the frontal's process to the lower rim, against the horizontal.
    let rim = bone("S18") - bone("S15");
    let orbital = ops::atan2(rim.y.abs(), rim.x.abs()).to_degrees();
    let of = |id, label, definition, tissue, dimension, value| Measurement {
        id,
        label,
        definition,
        tissue,
        dimension,
        value,
    };
    let (b, s) = (Tissue::Bone, Tissue::Skin);
    vec![
        of("skull_length", "Skull length", "prosthion to akrokranion", b, Millimetre, skull_length),
        of("facial_length", "Facial length", "prosthion to nasion", b, Millimetre, facial_length),
        of("cranial_length", "Cranial length", "nasion to akrokranion", b, Millimetre, cranial_length),
        of("zygomatic_width", "Zygomatic width", "zygion to zygion", b, Millimetre, zygomatic_width),
        of("cranial_width", "Cranial width", "euryon to euryon", b, Millimetre, cranial_width),
        of("cranial_height", "Cranial height", "bregma to the synsphenion", b, Millimetre, cranial_height),
        of("mandible_length", "Mandible length", "angular process to infradentale", b, Millimetre, mandible_length),
        of(
            "condylobasal_length",
            "Condylobasal length",
            "prosthion to the occipital condyles",
            b,
            Millimetre,
            condylobasal,
        ),
        of("palatal_length", "Palatal length", "prosthion to staphylion", b, Millimetre, palate),
        of("palatal_width", "Palatal width", "across the fourth premolars", b, Millimetre, palatal_width),
        of(
            "skull_index",
            "Skull (cephalic) index",
            "100 zygomatic width / skull length",
            b,
            Percent,
            100.0 * zygomatic_width / skull_length,
        ),
        of(
            "cranial_index",
            "Cranial index",
            "100 cranial width / cranial length",
            b,
            Percent,
            100.0 * cranial_width / cranial_length,
        ),
        of(
            "facial_index",
            "Facial index",
            "100 zygomatic width / facial length",
            b,
            Percent,
            100.0 * zygomatic_width / facial_length,
        ),
        of("s_index", "S-index", "facial length / cranial length", b, Ratio, facial_length / cranial_length),
        of("lw_index", "LW-index", "skull length / zygomatic width", b, Ratio, skull_length / zygomatic_width),
        of(
            "orbital_angle",
            "Orbital angle",
            "from ectorbitale to the zygomatic rim, seen from the front, against the horizontal",
            b,
            Degree,
            orbital,
        ),
        of(
            "craniofacial_ratio",
            "Craniofacial ratio",
            "stop to nose / stop to occiput, straight",
            s,
            Ratio,
            muzzle / cranium,
        ),
        of("muzzle_length", "Muzzle length", "stop to the nose's upper edge", s, Millimetre, muzzle),
        of("live_cranial_length", "Cranial length, live", "stop to occiput", s, Millimetre, cranium),
        of("head_length", "Head length, live", "nose's upper edge to occiput", s, Millimetre, nose.distance(occiput)),
        of("head_width", "Head width, live", "across the zygomatic arches", s, Millimetre, 2.0 * skin("K36").x),
        of("medial_canthi", "Medial canthi", "inner corner to inner corner", s, Millimetre, 2.0 * medial.x),
        of("lateral_canthi", "Lateral canthi", "outer corner to outer corner", s, Millimetre, 2.0 * lateral.x),
        of("fissure_length", "Lid fissure", "inner to outer corner", s, Millimetre, medial.distance(lateral)),
        of("globe_diameter", "Globe diameter", "of the eyeball", s, Millimetre, globe),
    ]
}

/// The measurement with an id.
///
/// # Panics
/// Where the list has none.
pub fn value(list: &[Measurement], id: &str) -> f32 {
    list.iter().find(|m| m.id == id).unwrap_or_else(|| panic!("no measurement {id}")).value
}
