//! How muscles move the skin: each pulls the skin around its insertion towards where it comes from, and what it presses
//! together on the way stands up.
//!
//! Weights belong to the mesh; ways and directions to a head. A pose is then one product and one sum for each entry.

use super::zones::{Neighbours, fade, smoothstep};
use crate::anatomy::Region;
use crate::mesh::VertexId;
use crate::motion::{Kind, Muscle, MuscleTable, Wrinkles};
use crate::rig::bone::{LANDMARKS, Targets};
use crate::rig::{HalfMesh, Place, RigError, SkinLandmark};
use glam::{Vec3, vec3};

/// Head units of the base head for a millimetre of a head with a skull of 200 mm.
const BASE_MM: f32 = 0.1;
/// Half the strip about the median plane in which the muscles of both sides share the skin, head units of the base head.
const SHARED: f32 = 0.8;
/// How high skin stands up that is pressed together to nothing, millimetres.
const THROWN_UP: f32 = 9.0;
/// Part of a pull into the head that the tissue below takes back.
const INWARDS: f32 = 1.05;
/// How much of it counts in front of the teeth.
const FLAT: f32 = 0.8;
/// How much the lining at the corner of the mouth goes with it.
const CORNER: f32 = 0.7;
/// Weakest pull that counts.
const LEAST: f32 = 0.004;

/// Where a landmark is found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Spot {
    /// On the skin.
    Skin(Place),
    /// Number in the list of bone's landmarks.
    Bone(usize),
}

impl Spot {
    /// The landmark of that id.
    pub(super) fn find(id: &str, skin: &[SkinLandmark]) -> Result<Self, RigError> {
        let of_skin = skin.iter().find(|l| l.id == *id).map(|l| Spot::Skin(l.place));
        let of_bone = || LANDMARKS.iter().position(|l| l.id == id).map(Spot::Bone);
        of_skin.or_else(of_bone).ok_or_else(|| RigError::MissingLandmark(id.to_owned()))
    }
}

/// A muscle on the mesh.
#[derive(Clone, Debug)]
struct Bound {
    kind: Kind,
    path: Vec<Vec<Spot>>,
    insertion: Vec<Spot>,
    pull_mm: f32,
    gather: f32,
    wrinkles: Option<Wrinkles>,
    /// Vertices of the whole mesh that the left one moves, ascending.
    vertices: Vec<u32>,
    /// Those of the lips and their lining.
    lips: Vec<u32>,
    /// Those of the muzzle's side: where they look down, a lip hangs below them and no bone.
    hanging: Vec<u32>,
    /// For each of them and each insertion, how much it is pulled.
    weights: Vec<f32>,
}

/// Every muscle on the mesh, immutable.
#[derive(Clone, Debug)]
pub struct MusclePlan {
    bound: Vec<Bound>,
    /// The other side's vertex of each vertex of the whole mesh.
    mirror: Vec<u32>,
}

/// What a full contraction of each left muscle does to this head: an entry for each vertex that it moves.
#[derive(Clone, Debug, Default)]
pub struct Pulls {
    /// Start of each muscle's entries, and the end of the last.
    offsets: Vec<u32>,
    entries: Vec<(u32, Vec3)>,
    /// How much each entry's skin is pressed together, 0 to 1.
    pressed: Vec<f32>,
}

/// How freely the skin of a region slides over the bone, 0 to 1.
fn looseness(region: Region) -> f32 {
    match region {
        Region::Nose | Region::Nostril | Region::Crown => 0.5,
        Region::Temple => 0.6,
        Region::Bridge | Region::Stop => 0.75,
        Region::Orbit | Region::Forehead | Region::LowerJaw => 0.9,
        Region::Lid | Region::EarInner | Region::EarOuter | Region::EarEdge => 0.0,
        Region::Nape | Region::NeckSide | Region::NeckFront => 0.5,
        _ => 1.0,
    }
}

impl MusclePlan {
    pub(super) fn new(
        table: &MuscleTable,
        half: &HalfMesh,
        neighbours: &Neighbours,
        base: &[Vec3],
        mirror: &[u32],
    ) -> Result<Self, RigError> {
        let skin = half.skin_landmarks();
        let spot = |id: &String| Spot::find(id, &skin);
        let faces = half.triangles();
        let mut regions = half.whole_regions();
        // The lining goes with the margin of its lip, so that it never hangs below it, and is grown to the gum behind.
        let margin = |v: usize| -> Option<(usize, f32)> {
            let own = if v < half.n_half() { v } else { mirror[v] as usize };
            // Round the corner it is held back inside.
            let (lip, part) = match half.tags[own].split('.').collect::<Vec<_>>()[..] {
                ["mu", row, "1"] => (format!("s.{row}.9"), 1.0),
                ["mu", row, "2"] => (format!("s.{row}.9"), 0.9),
                ["ml", row, "1"] => (format!("l.{row}.9"), 1.0),
                ["ml", row, "2"] => (format!("l.{row}.9"), 0.9),
                ["mu" | "ml", ..] => return Some((v, 0.0)),
                _ => return None,
            };
            let part = if lip.contains(".9.") || lip.contains(".10.") { part * CORNER } else { part };
            let lip = if lip == "l.10.9" { "s.10.9" } else { &lip };
            let lip = half.tags.iter().position(|t| t == lip)?;
            Some((if v < half.n_half() { lip } else { mirror[lip] as usize }, part))
        };
        let margins: Vec<(usize, f32)> = (0..base.len()).map(|v| margin(v).unwrap_or((v, 1.0))).collect();
        regions.resize(base.len(), Region::Cheek);
        let bound = table.muscles.iter().map(|m| {
            let path = m.path.iter().map(|a| a.iter().map(spot).collect()).collect::<Result<Vec<Vec<Spot>>, _>>()?;
            let insertion = m.insertion.iter().map(spot).collect::<Result<Vec<Spot>, _>>()?;
            let zones: Vec<Spot> = if m.kind == Kind::Chewing {
                m.belly.iter().map(spot).collect::<Result<_, _>>()?
            } else {
                insertion.clone()
            };
            let reach = m.reach_mm * BASE_MM;
            let ways: Vec<Vec<f32>> = zones
                .iter()
                .map(|zone| match *zone {
                    Spot::Skin(Place::Vertex(v)) => neighbours.ways(base, &[(v, 0.0)], reach),
                    Spot::Skin(Place::Face(f)) => {
                        let corners = faces[f as usize];
                        let middle = corners.iter().map(|&v| base[v as usize]).sum::<Vec3>() / 3.0;
                        let from = corners.map(|v| (v, middle.distance(base[v as usize])));
                        neighbours.ways(base, &from, reach)
                    }
                    Spot::Bone(_) => vec![f32::INFINITY; base.len()],
                })
                .collect();
            let (mut vertices, mut weights) = (Vec::new(), Vec::new());
            for v in 0..base.len() {
                let own_side = smoothstep(-SHARED, SHARED, base[v].x);
                let (from, part) = margins[v];
                let free = looseness(regions[from]) * part * own_side;
                let of_zones: Vec<f32> = ways.iter().map(|way| fade(way[from], reach) * free).collect();
                if of_zones.iter().any(|&w| w > LEAST) {
                    vertices.push(v as u32);
                    weights.extend(of_zones);
                }
            }
            let is_lip = |v: &u32| matches!(regions[*v as usize], Region::UpperLip | Region::LowerLip | Region::Mouth);
            let lips = vertices.iter().copied().filter(is_lip).collect();
            let hangs = |v: &u32| matches!(regions[*v as usize], Region::WhiskerPad | Region::MuzzleSide);
            let hanging = vertices.iter().copied().filter(hangs).collect();
            let Muscle { kind, pull_mm, gather, wrinkles, .. } = *m;
            Ok(Bound { kind, path, insertion, pull_mm, gather, wrinkles, vertices, lips, hanging, weights })
        });
        Ok(Self { bound: bound.collect::<Result<_, RigError>>()?, mirror: mirror.to_vec() })
    }

    /// What the muscles do to a head: `rest`: control positions of the whole mesh, `normals`: outwards, unit, one each;
    /// `unit`: metres of a millimetre of the head with a skull of 200 mm.
    pub(super) fn of_head(
        &self,
        half: &HalfMesh,
        neighbours: &Neighbours,
        (rest, normals): (&[Vec3], &[Vec3]),
        bone: &Targets<Vec3>,
        unit: f32,
        out: &mut Pulls,
    ) {
        let bone = bone.list();
        let place = |spot: &Spot| match *spot {
            Spot::Bone(k) => bone[k],
            Spot::Skin(Place::Vertex(v)) => rest[v as usize],
            Spot::Skin(Place::Face(f)) => {
                half.faces[f as usize].iter().map(|&v| rest[usize::from(v)]).sum::<Vec3>() / 3.0
            }
        };
        let mean = |spots: &Vec<Spot>| spots.iter().map(place).sum::<Vec3>() / spots.len() as f32;
        out.offsets.clear();
        out.offsets.push(0);
        out.entries.clear();
        out.pressed.clear();
        let mut moved = vec![Vec3::ZERO; rest.len()];
        for m in &self.bound {
            let path: Vec<Vec3> = m.path.iter().map(mean).collect();
            let last = path.last().copied().unwrap_or_default();
            let pull = m.pull_mm * unit;
            let zones = m.weights.len() / m.vertices.len().max(1);
            let start = out.entries.len();
            if m.kind == Kind::Chewing {
                for (&v, weights) in m.vertices.iter().zip(m.weights.chunks(zones.max(1))) {
                    let weight = weights.iter().copied().fold(0.0, f32::max);
                    out.entries.push((v, normals[v as usize] * (weight * pull)));
                }
            } else {
                let ways: Vec<Vec3> = m.insertion.iter().map(|i| (last - place(i)).normalize_or_zero()).collect();
                for (&v, weights) in m.vertices.iter().zip(m.weights.chunks(zones.max(1))) {
                    let (mut way, mut sum, mut most) = (Vec3::ZERO, 0.0, 0.0f32);
                    for (&w, &d) in weights.iter().zip(&ways) {
                        way += d * w;
                        sum += w;
                        most = most.max(w);
                    }
                    // Skin slides over what lies under it, and does not go into it.
                    let way = way * (most / sum.max(1e-6));
                    let n = normals[v as usize];
                    // A lip's edge looks down, and may rise; so may what goes over into it, or the skin would hang before
                    // the edge like a curtain. In front a lip is thick, and is drawn flat against the teeth.
                    let n = if m.lips.contains(&v) { n.with_y(0.0) } else { n };
                    let n = if m.hanging.contains(&v) { vec3(n.x, n.y.max(0.0), FLAT * n.z) } else { n };
                    let way = way - n * (INWARDS * way.dot(n).min(0.0));
                    out.entries.push((v, way * pull));
                }
                if m.gather > 0.0 {
                    for &(v, d) in &out.entries[start..] {
                        moved[v as usize] = d;
                    }
                    let entries = &mut out.entries[start..];
                    out.pressed.resize(start, 0.0);
                    for (v, d) in entries.iter_mut() {
                        let own = *v as usize;
                        let ring = neighbours.of(VertexId(*v));
                        let strain = ring.iter().map(|&n| {
                            let edge = rest[n as usize] - rest[own];
                            (moved[n as usize] - moved[own]).dot(edge) / edge.length_squared().max(1e-12)
                        });
                        let pressed = (-strain.sum::<f32>() / ring.len() as f32).clamp(0.0, 0.4);
                        out.pressed.push(pressed);
                        *d += normals[own] * (pressed * m.gather * THROWN_UP * unit);
                    }
                    for &(v, _) in &out.entries[start..] {
                        moved[v as usize] = Vec3::ZERO;
                    }
                }
            }
            out.pressed.resize(out.entries.len(), 0.0);
            out.offsets.push(out.entries.len() as u32);
        }
    }

    /// Adds what muscles do at these contractions (left, right); `contraction`: of a muscle by its number.
    pub(super) fn contract(&self, pulls: &Pulls, contraction: impl Fn(usize) -> [f32; 2], at: &mut [Vec3]) {
        for (m, range) in pulls.offsets.windows(2).enumerate() {
            let [left, right] = contraction(m);
            let entries = &pulls.entries[range[0] as usize..range[1] as usize];
            if left != 0.0 {
                for &(v, d) in entries {
                    at[v as usize] += d * left;
                }
            }
            if right != 0.0 {
                for &(v, d) in entries {
                    at[self.mirror[v as usize] as usize] += Vec3::new(-d.x, d.y, d.z) * right;
                }
            }
        }
    }

    /// How much the skin is pressed together at each control vertex (`out`: one each) into wrinkles of nose, brow and cheek.
    /// Gives whether it is anywhere.
    pub(super) fn press(&self, pulls: &Pulls, contraction: impl Fn(usize) -> [f32; 2], out: &mut [Vec3]) -> bool {
        out.fill(Vec3::ZERO);
        let mut is_any = false;
        for (m, range) in pulls.offsets.windows(2).enumerate() {
            let [left, right] = contraction(m);
            let Some(wrinkles) = self.bound[m].wrinkles.filter(|_| left != 0.0 || right != 0.0) else { continue };
            is_any = true;
            let range = range[0] as usize..range[1] as usize;
            for (&(v, _), &pressed) in pulls.entries[range.clone()].iter().zip(&pulls.pressed[range]) {
                out[v as usize][wrinkles as usize] += pressed * left;
                out[self.mirror[v as usize] as usize][wrinkles as usize] += pressed * right;
            }
        }
        is_any
    }

    /// The other side's vertex of each vertex of the whole mesh.
    pub(super) fn mirror(&self) -> &[u32] {
        &self.mirror
    }
}
