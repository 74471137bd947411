//! Where a place of the skin lies on the default head: what markings and the noise of hair are bound to.
//!
//! The control vertices of the base head go through the same tables as those of every other head, so a place keeps its
//! coordinates whatever the breed, the measures and the pose are.

use super::Root;
use crate::anatomy::Region;
use crate::math::noise;
use crate::rig::{EAR_RINGS, Rig};
use crate::subdiv::{Plan, evaluate_once};
use glam::{Vec3, vec3};

/// A place of the skin as markings see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// On the base head, in the proportions' frame and head units: 10 mm on the default head.
    pub place: Vec3,
    /// x how much it is ear, 0 to 1; y from the ear's base, 0, to its tip, 1; z 1 on its outer face, 0 on its margin, -1 on
    /// its inner face.
    pub ear: Vec3,
    /// Where hair lies on the base head, about unit length; zero where there is none.
    pub flow: Vec3,
    /// What has the colour.
    pub fibre: Fibre,
}

/// What has a colour: fibres of one place differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fibre {
    /// The skin, or many hairs at once.
    Skin,
    /// The hair of a seed.
    Hair(u32),
    /// One of those that a painter draws, with the one number from 0 to 1 by which it differs from those beside it.
    Stroke(f32),
}

impl Fibre {
    /// By what it differs from its neighbours for a purpose, 0 to 1; nothing where it is none.
    pub(super) fn own(self, purpose: u32) -> Option<f32> {
        match self {
            Self::Skin => None,
            Self::Hair(seed) => Some(noise::of_number(seed, purpose)),
            Self::Stroke(own) => Some(own),
        }
    }
}

/// The sites of the vertices of a plan's skin. Made once per topology.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    place: Vec<Vec3>,
    ear: Vec<Vec3>,
    flow: Vec<Vec3>,
}

impl Chart {
    /// The chart of a plan of the rig's mesh.
    pub fn new(rig: &Rig, plan: &Plan) -> Self {
        let half = rig.half();
        let n = rig.mesh().n_vertices();
        let base: Vec<Vec3> = half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut control = vec![Vec3::ZERO; n];
        half.unfold(&base, &mut control);
        let mut flow = vec![Vec3::ZERO; n];
        rig.flow(&control, &mut flow);
        let of_half: Vec<Vec3> = half.tags.iter().zip(&half.regions).map(|(tag, &region)| ear(tag, region)).collect();
        let mut ears = vec![Vec3::ZERO; n];
        half.unfold(&of_half, &mut ears);
        // Unfolding mirrors x, which is no coordinate here.
        ears.iter_mut().for_each(|e| e.x = e.x.abs());
        let [place, ear, flow] = [control, ears, flow].map(|values| evaluate_once(plan, &values).0);
        Self { place, ear, flow }
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// Where hair lies on the base head at each vertex, about unit length; zero where there is none.
    pub fn flow(&self) -> &[Vec3] {
        &self.flow
    }

    /// The site of a vertex.
    pub fn vertex(&self, v: usize) -> Site {
        Site { place: self.place[v], ear: self.ear[v], flow: self.flow[v], fibre: Fibre::Skin }
    }

    /// The site of a fibre at a place between vertices: the mean of theirs, by weight.
    pub fn between(&self, place: &[(usize, f32)], fibre: Fibre) -> Site {
        let mixed = |values: &[Vec3]| place.iter().fold(Vec3::ZERO, |sum, &(v, weight)| sum + values[v] * weight);
        Site { place: mixed(&self.place), ear: mixed(&self.ear), flow: mixed(&self.flow), fibre }
    }

    /// The site of a hair's root; `triangles` are those that it was made for.
    pub fn root(&self, root: &Root, triangles: &[[u32; 3]]) -> Site {
        let corners = triangles[root.triangle as usize];
        let mixed = |values: &[Vec3]| root.mixed(corners.map(|v| values[v as usize]));
        Site {
            place: mixed(&self.place),
            ear: mixed(&self.ear),
            flow: mixed(&self.flow),
            fibre: Fibre::Hair(root.seed),
        }
    }
}

/// What [`Site::ear`] is at a control vertex.
fn ear(tag: &str, region: Region) -> Vec3 {
    let side = match region {
        Region::EarOuter => 1.0,
        Region::EarInner => -1.0,
        Region::EarEdge => 0.0,
        _ => return Vec3::ZERO,
    };
    let ring = tag.strip_prefix('a').and_then(|t| t.split('.').next()).and_then(|r| r.parse::<u32>().ok());
    let along = (ring.unwrap_or(0) as f32 + 0.5) / (EAR_RINGS as f32 + 0.5);
    vec3(1.0, along.min(1.0), side)
}
