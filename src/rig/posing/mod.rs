//! From a head at rest to a head in a pose: muscles, lips, lids, jaw, ears, neck, in that written order.
//!
//! Three things apart: [`PosePlan`] belongs to the mesh and is made once, [`OfHead`] belongs to a head and is made when its
//! measures change, a [`Pose`] is of the moment. Nothing is allocated for a pose.

mod bones;
mod ears;
mod fibres;
mod jaw;
mod lips;
mod muscles;
mod neck;
mod rigid;
mod zones;

pub use fibres::{Fibres, STRAP_VERTICES};
pub use muscles::Pulls;
pub use rigid::Rigid;

use super::bone::{Targets, targets};
use super::deform::{self, DeformPlan, Lids};
use super::implicit::Implicit;
use super::proportions::{Measures, Proportions};
use super::{Eye, HalfMesh, RigError};
use crate::math::ops;
use crate::mesh::{DedgeMesh, VertexId};
use crate::motion::{Channel, JointLimits, MuscleTable, Pose};
use bones::{BonesOf, OffBone, Pushes};
use ears::Ears;
use glam::{Mat3, Vec3, vec3};
use lips::Lips;
use muscles::MusclePlan;
use zones::Neighbours;

/// Radius of the belly of a chewing muscle as a part of what it stands out by when it is hard.
const BELLY: f32 = 2.5;

/// What no measure and no pose changes.
pub struct PosePlan {
    limits: JointLimits,
    table: MuscleTable,
    neighbours: Neighbours,
    muscles: MusclePlan,
    fibres: Fibres,
    lips: Lips,
    ears: Ears,
    /// One for each vertex of the whole mesh: how much of the mandible's turn it makes, and of the head's.
    jaw: Vec<f32>,
    /// How much of the way back of the corner of the mouth each vertex makes; the left corner.
    drawn: Vec<f32>,
    corner: usize,
    off_bone: OffBone,
    neck: Vec<f32>,
    /// Numbers of the muscles that close the jaws.
    closers: [Option<usize>; 2],
}

impl std::fmt::Debug for PosePlan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PosePlan").finish_non_exhaustive()
    }
}

/// What of a pose depends on the head alone.
#[derive(Clone, Debug, Default)]
pub struct OfHead {
    /// The whole mesh at rest, metres, and its outward unit normals, smoothed.
    rest: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// What each muscle does.
    pub pulls: Pulls,
    /// Metres of a millimetre of the head with a skull of 200 mm.
    pub unit: f32,
    /// Middle of both condyles, and of the joint behind the occiput, metres.
    pub hinge: Vec3,
    /// See `hinge`.
    pub pivot: Vec3,
    /// How far in front the skin reaches, metres.
    pub front: f32,
    /// Landmarks of the left bone, in their list's order, metres.
    bone: Vec<Vec3>,
    surface: Option<(Proportions, Implicit)>,
    bones: BonesOf,
    axes: [Vec3; 3],
    /// Lengths of the closing muscles at rest: origin and insertion.
    closers: [[Vec3; 2]; 2],
}

/// Buffers of a pose: made once, written again.
#[derive(Clone, Debug, Default)]
pub struct Buffers {
    /// The half with other lids.
    lids: Vec<Vec3>,
    pushes: Pushes,
}

/// Where the rigid parts of a posed head are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Places {
    /// Skull and what hangs on it: from the head at rest.
    pub head: Rigid,
    /// Mandible and what hangs on it: from the head at rest.
    pub mandible: Rigid,
    /// The mandible against the skull.
    pub jaw: Rigid,
}

impl PosePlan {
    pub(super) fn new(half: &HalfMesh, mesh: &DedgeMesh, plan: &DeformPlan, images: &[u32]) -> Result<Self, RigError> {
        let n = mesh.n_vertices();
        let neighbours = Neighbours::new(mesh);
        let h = plan.handles();
        let own: Vec<Vec3> = half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut base = vec![Vec3::ZERO; n];
        half.unfold(&own, &mut base);
        let mut mirror: Vec<u32> = images.to_vec();
        mirror.resize(n, 0);
        images.iter().enumerate().for_each(|(v, &image)| mirror[image as usize] = v as u32);
        let table = MuscleTable::embedded()?;
        let jaw = jaw::weights(h, images, &neighbours, n);
        let drawn = jaw::drawn(h, images, &neighbours, &base);
        let neck = neck::weights(h, images, &neighbours, n);
        let mut is_lid = vec![false; n];
        deform::lid_vertices(h).for_each(|v| [v, mirror[v] as usize].into_iter().for_each(|v| is_lid[v] = true));
        // The jaw has its own way for the corner of the mouth.
        let corner = u32::from(h.s[10][9]);
        let is_corner = |v: usize| v as u32 == corner || mirror[v] == corner;
        Ok(Self {
            limits: JointLimits::embedded()?,
            muscles: MusclePlan::new(&table, half, &neighbours, &base, &mirror)?,
            fibres: Fibres::new(&table, half)?,
            lips: Lips::new(h, &neighbours, &base),
            ears: Ears::new(h, &neighbours, &base),
            off_bone: OffBone::new(
                mesh.indices().as_chunks::<3>().0,
                &half.whole_regions(),
                &base,
                |v| is_lid[v],
                |v| neck[v] == neck::END || is_corner(v),
            ),
            jaw,
            drawn,
            corner: corner as usize,
            neck,
            closers: ["masseter", "temporalis"].map(|id| table.index_of(id)),
            table,
            neighbours,
        })
    }

    /// The muscles.
    pub fn table(&self) -> &MuscleTable {
        &self.table
    }

    /// Limits of the joints.
    pub fn limits(&self) -> &JointLimits {
        &self.limits
    }

    /// How much of the mandible's turn each vertex of the whole mesh makes, 0 to 1.
    pub fn jaw_weights(&self) -> &[f32] {
        &self.jaw
    }

    /// How much of the head's turn each vertex of the whole mesh makes, 0 to 1.
    pub fn neck_weights(&self) -> &[f32] {
        &self.neck
    }

    /// The pose inside the limits of its joints, with the jaw open as far as a tongue that is out asks for and the head no
    /// lower than its jaw is off the throat.
    #[must_use]
    pub fn possible(&self, pose: &Pose) -> Pose {
        let mut out = self.limits.clamped(pose);
        let gape = &mut out.channel_mut(Channel::JawGape)[0];
        *gape = gape.max(jaw::opened(pose).min(self.limits.of(Channel::JawGape).range.1));
        let lowest = neck::lowest(&out);
        out.channel_mut(Channel::HeadNod).iter_mut().for_each(|nod| *nod = nod.max(lowest));
        out
    }

    /// The least of these: how much of the head's turn the neck's cut end makes.
    pub fn neck_end_weight(&self) -> f32 {
        neck::END
    }

    /// Where the neck's cut end is in a pose, from the head at rest; `head`: [`super::Rig::of_head`].
    pub fn neck_end(&self, head: &OfHead, pose: &Pose) -> Rigid {
        neck::turned(head.pivot, head.unit, &self.possible(pose), neck::END)
    }

    /// How muscles are seen.
    pub fn fibres(&self) -> &Fibres {
        &self.fibres
    }

    /// What depends on the head; `half`: its control positions at rest, metres.
    pub(super) fn measure(
        &self,
        (mesh, of_half): (&DedgeMesh, &HalfMesh),
        measures: &Measures,
        shape: &Proportions,
        half: &[Vec3],
        out: &mut OfHead,
    ) {
        let n = mesh.n_vertices();
        out.rest.resize(n, Vec3::ZERO);
        of_half.unfold(half, &mut out.rest);
        self.smooth_normals(mesh, &out.rest, &mut out.normals);
        let bone: Targets<Vec3> = targets(measures, shape);
        let skull = bone.prosthion.distance(bone.akrokranion);
        // As the head grows in length and width.
        out.unit = 0.001 * ops::sqrt(skull / 0.2 * (2.0 * bone.zygion.x / 0.105));
        out.hinge = bone.condyle.with_x(0.0);
        out.pivot = bone.occipital_condyle.with_x(0.0);
        out.front = out.rest.iter().map(|p| p.z).fold(f32::MIN, f32::max);
        out.axes = deform::orbit_axes(shape).map(|axis| shape.direction(axis));
        out.closers = [
            [0.5 * (bone.zygion + bone.arch_root), 0.5 * (bone.masseteric + bone.gonion)],
            [(bone.vertex + bone.frontostenion + bone.asterion) / 3.0, bone.coronion],
        ];
        self.muscles.of_head(of_half, &self.neighbours, (&out.rest, &out.normals), &bone, out.unit, &mut out.pulls);
        self.off_bone.of_head(&self.neighbours, &out.rest, &bone, &mut out.bones);
        out.bone.clear();
        out.bone.extend(bone.list());
        out.surface = Some((*shape, Implicit::new(shape)));
    }

    fn smooth_normals(&self, mesh: &DedgeMesh, at: &[Vec3], normals: &mut Vec<Vec3>) {
        normals.clear();
        normals.resize(at.len(), Vec3::ZERO);
        for f in mesh.indices().as_chunks::<3>().0 {
            let [a, b, c] = f.map(|v| at[v as usize]);
            let area = (b - a).cross(c - a);
            f.iter().for_each(|&v| normals[v as usize] += area);
        }
        for _ in 0..2 {
            let before = normals.clone();
            for (v, n) in normals.iter_mut().enumerate() {
                let ring = self.neighbours.of(VertexId(v as u32));
                let mean =
                    ring.iter().map(|&r| before[r as usize].normalize_or_zero()).sum::<Vec3>() / ring.len() as f32;
                *n = before[v].normalize_or_zero() + mean;
            }
        }
        normals.iter_mut().for_each(|n| *n = n.normalize_or(Vec3::Y));
    }

    /// Moves the control positions of the head (`control`, at rest) and gives the eyes and the places of what is rigid.
    pub(super) fn apply(
        &self,
        plan: &DeformPlan,
        head: &OfHead,
        (half, eye): (&[Vec3], &Eye),
        pose: &Pose,
        Buffers { lids: scratch, pushes }: &mut Buffers,
        control: &mut [Vec3],
    ) -> ([Eye; 2], Places) {
        let pose = &self.possible(pose);
        let mirror = self.muscles.mirror();
        let bulges = self.bulges(head, pose);
        self.muscles.contract(&head.pulls, |m| self.contraction(pose, &bulges, m), control);
        self.lips.part(pose, head.unit, mirror, &head.normals, control);
        let eyes = [0, 1].map(|side| gazing(eye, pose, side));
        self.lids(plan, head, half, (eye, &eyes), pose, (scratch, control));
        let jaw = jaw::mandible(head.hinge, head.unit, pose);
        if !jaw.is_rest() {
            let back = jaw::back((head.rest[self.corner] - head.hinge).with_x(0.0).length(), pose);
            for ((p, &w), &drawn) in control.iter_mut().zip(&self.jaw).zip(&self.drawn).filter(|((_, w), _)| **w > 0.0)
            {
                *p = jaw::turned(head.hinge, head.unit, pose, w).point(*p);
                let to = (head.hinge - *p).with_x(0.0).normalize_or_zero();
                *p += to * (back * drawn);
            }
        }
        if let Some((shape, surface)) = &head.surface {
            self.ears.turn(pose, head.unit, &head.rest, (shape, surface), mirror, control);
        }
        let place = neck::turned(head.pivot, head.unit, pose, 1.0);
        if !place.is_rest() {
            for (p, &w) in control.iter_mut().zip(&self.neck) {
                let part = if w == 1.0 { place } else { neck::turned(head.pivot, head.unit, pose, w) };
                *p = part.point(*p);
            }
        }
        let mandible = place.after(&jaw);
        self.off_bone.keep_off(&self.neighbours, &head.bones, [&place, &mandible], pushes, control);
        let eyes = eyes.map(|e| {
            if place.is_rest() {
                return e;
            }
            Eye { centre: place.point(e.centre), axes: e.axes.map(|a| place.direction(a)), ..e }
        });
        (eyes, Places { head: place, mandible, jaw })
    }

    /// See [`super::Rig::pressed`].
    pub(super) fn pressed(&self, head: &OfHead, pose: &Pose, out: &mut [Vec3]) -> bool {
        let pose = &self.possible(pose);
        self.muscles.press(&head.pulls, |m| pose.muscle(m), out)
    }

    /// Positions of the muscles' straps on a posed head.
    pub(super) fn straps(
        &self,
        of_half: &HalfMesh,
        head: &OfHead,
        pose: &Pose,
        posed: (&[Vec3], &Places),
        out: &mut Vec<Vec3>,
    ) {
        let pose = &self.possible(pose);
        let bite = pose.channel(Channel::Bite);
        let contraction = |m: usize| match self.closers.contains(&Some(m)) {
            true => [0, 1].map(|side| pose.muscle(m)[side].max(bite[side])),
            false => pose.muscle(m),
        };
        self.fibres.place(of_half, self.muscles.mirror(), head, posed, contraction, out);
    }

    /// How far masseter and temporalis stand out, as parts of their pull: hard when they bite, drawn out thin when the
    /// mouth is wide open, at constant volume.
    fn bulges(&self, head: &OfHead, pose: &Pose) -> [[f32; 2]; 2] {
        let jaw = jaw::mandible(head.hinge, head.unit, pose);
        let bite = pose.channel(Channel::Bite);
        [0, 1].map(|k| {
            let [origin, insertion] = head.closers[k];
            let length = origin.distance(insertion).max(1e-5);
            let drawn = origin.distance(jaw.point(insertion)) / length;
            let thin = if drawn == 1.0 { 0.0 } else { BELLY * (ops::sqrt(1.0 / drawn.max(0.2)) - 1.0) };
            bite.map(|b| b + thin)
        })
    }

    fn contraction(&self, pose: &Pose, bulges: &[[f32; 2]; 2], muscle: usize) -> [f32; 2] {
        let own = pose.muscle(muscle);
        match self.closers.iter().position(|c| *c == Some(muscle)) {
            Some(k) => [0, 1].map(|side| own[side].max(0.0) + bulges[k][side]),
            None => own,
        }
    }

    fn lids(
        &self,
        plan: &DeformPlan,
        head: &OfHead,
        half: &[Vec3],
        (ahead, eyes): (&Eye, &[Eye; 2]),
        pose: &Pose,
        (scratch, control): (&mut Vec<Vec3>, &mut [Vec3]),
    ) {
        let [closed, raised, lift] =
            [Channel::LidClosed, Channel::LidRaised, Channel::GazeLift].map(|c| pose.channel(c));
        let mirror = self.muscles.mirror();
        for side in 0..2 {
            let lids = Lids { closed: closed[side], raised: raised[side], lift: lift[side].to_radians() };
            let own = if side == 0 { eyes[0] } else { eyes[1].mirrored() };
            if lids == Lids::default() && own == *ahead {
                continue;
            }
            deform::place_lids(plan, (&own, ahead), head.axes, lids, half, scratch);
            for v in deform::lid_vertices(plan.handles()) {
                let d = scratch[v] - half[v];
                if side == 0 {
                    control[v] += d;
                } else {
                    control[mirror[v] as usize] += vec3(-d.x, d.y, d.z);
                }
            }
        }
    }
}

/// An eye of the left (0) or right (1) side that looks somewhere; `eye`: the left one at rest.
fn gazing(eye: &Eye, pose: &Pose, side: usize) -> Eye {
    let own = if side == 0 { *eye } else { eye.mirrored() };
    let [turn, lift] = [Channel::GazeTurn, Channel::GazeLift].map(|c| pose.channel(c)[side].to_radians());
    if turn == 0.0 && lift == 0.0 {
        return own;
    }
    // About the head's vertical, then up about the eye's own transverse axis (Fick's order).
    let turn = Mat3::from_rotation_y(turn);
    let [a, b, g] = own.axes.map(|axis| turn * axis);
    let up = Mat3::from_axis_angle(a.normalize_or(Vec3::X), -lift);
    Eye { axes: [a, up * b, up * g], ..own }
}
