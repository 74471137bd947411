//! From measures in SI units to the head's proportions: everything relative to the cranial length, so that the shape of
//! a head does not depend on its size.
//!
//! One *head unit* is a tenth of a 106 mm cranium's centimetre: 10 mm on the default head. Frame of the proportions:
//! origin at the skin of the nasion, x to the dog's left, y up, z forward.

use crate::math::ops;
use glam::{Vec2, Vec3, vec2, vec3};

macro_rules! measures {
    ($($field:ident = $id:literal),* $(,)?) => {
        /// The values that the shape of a head depends on, one field for each row of `rigs/anatomy.ron`, in SI units.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Measures {
            $(#[doc = concat!("The row `", $id, "`.")] pub $field: f32,)*
        }

        impl Measures {
            /// The table's ids, in the order of the fields.
            pub const IDS: &'static [&'static str] = &[$($id),*];

            /// Picks the fields out of a breed's values; `columns` (length: `IDS`) tells where each stands.
            pub fn from_values(values: &[f32], columns: &[usize]) -> Self {
                let mut column = columns.iter();
                Self { $($field: column.next().map_or(f32::NAN, |&c| values[c]),)* }
            }
        }
    };
}

measures! {
    cranial_length = "cranial_length_mm",
    cranial_width = "cranial_width_mm",
    cranial_height = "cranial_height_mm",
    forehead_dome = "forehead_dome",
    occiput = "occiput_mm",
    furrow = "furrow_mm",
    temporalis = "temporalis_mm",
    zygomatic_width = "zygomatic_width_mm",
    zygomatic_drop = "zygomatic_drop_mm",
    masseter = "masseter_mm",
    brow = "brow_mm",
    facial_length = "facial_length_mm",
    stop_angle = "stop_angle_deg",
    facial_tilt = "facial_tilt_deg",
    muzzle_width_root = "muzzle_width_root_mm",
    muzzle_width_tip = "muzzle_width_tip_mm",
    muzzle_depth_root = "muzzle_depth_root_mm",
    muzzle_depth_tip = "muzzle_depth_tip_mm",
    bridge_width = "bridge_width",
    nasal_arch = "nasal_arch_mm",
    nose_roll = "nose_roll",
    nose_width = "nose_width_mm",
    nose_height = "nose_height_mm",
    nose_projection = "nose_projection_mm",
    nose_lift = "nose_lift_mm",
    flews = "flews_mm",
    lip_thickness = "lip_thickness",
    mouth_corner = "mouth_corner_mm",
    overjet = "overjet_mm",
    jaw_width = "jaw_width",
    jaw_depth = "jaw_depth_mm",
    chin = "chin_mm",
    dewlap = "dewlap_mm",
    eye_spacing = "eye_spacing_mm",
    eye_height = "eye_height_mm",
    eye_depth = "eye_depth_mm",
    eyeball_diameter = "eyeball_diameter_mm",
    gaze_angle = "gaze_angle_deg",
    eye_cant = "eye_cant_deg",
    lid_opening = "lid_opening",
    lid_width = "lid_width",
    ear_length = "ear_length_mm",
    ear_width = "ear_width_mm",
    ear_base = "ear_base_mm",
    ear_set_height = "ear_set_height_mm",
    ear_set_back = "ear_set_back_mm",
    ear_set_width = "ear_set_width_mm",
    ear_lift = "ear_lift_deg",
    ear_back = "ear_back_deg",
    ear_turn = "ear_turn_deg",
    ear_fold = "ear_fold_deg",
    ear_fold_height = "ear_fold_height",
    ear_fold_softness = "ear_fold_softness",
    ear_fold_slant = "ear_fold_slant_deg",
    ear_sweep = "ear_sweep_deg",
    ear_cup = "ear_cup",
    ear_thickness = "ear_thickness_mm",
    ear_tip = "ear_tip",
    ear_widest = "ear_widest",
    neck_width = "neck_width_mm",
    neck_depth = "neck_depth_mm",
    neck_angle = "neck_angle_deg",
    brow_folds = "brow_folds_mm",
    nose_folds = "nose_folds_mm",
    cheek_folds = "cheek_folds_mm",
    fold_spacing = "fold_spacing_mm",
    lid_dome = "lid_dome",
    haw = "haw_mm",
    age = "age_weeks",
    sex = "sex",
}

/// Measures of the ear in head units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarProportions {
    /// From base to tip.
    pub length: f32,
    /// At the widest place.
    pub width: f32,
    /// Along the base.
    pub base: f32,
    /// Middle of the left ear's base.
    pub set: Vec3,
    /// Of the ear above the horizontal.
    pub lift: f32,
    /// Towards the nape.
    pub back: f32,
    /// Of the opening about the ear's own axis.
    pub turn: f32,
    /// At the fold: how far the tip hangs over.
    pub fold: f32,
    /// Where the fold lies, as a part of the length.
    pub fold_height: f32,
    /// Part of the length over which the fold is spread.
    pub fold_softness: f32,
    /// Of the fold's line against a line across the ear: positive where the front edge folds nearest to the base.
    pub fold_slant: f32,
    /// Of the leather about the transverse axis, backwards.
    pub sweep: f32,
    /// How far the leather is rolled to a cup.
    pub cup: f32,
    /// Of the leather.
    pub thickness: f32,
    /// How round the tip is.
    pub tip: f32,
    /// Where the widest place lies, as a part of the length.
    pub widest: f32,
}

/// A head without its size. Lengths in head units, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportions {
    /// Metres of one head unit.
    pub scale: f32,
    /// From brow to nape: a constant, since everything is relative to it.
    pub cran_len: f32,
    /// Width of the braincase with its muscles.
    pub cran_w: f32,
    /// Height of the crown above the nasion.
    pub cran_h: f32,
    /// How round the forehead is.
    pub dome: f32,
    /// How far the occiput stands out.
    pub occiput: f32,
    /// Depth of the frontal furrow.
    pub furrow: f32,
    /// Width between the zygomatic arches, skin included.
    pub zyg_w: f32,
    /// Height of the arches from the nasion.
    pub zyg_y: f32,
    /// Thickness of the masseter.
    pub cheek: f32,
    /// Depth of the bridge below the forehead.
    pub stop: f32,
    /// How far the brow ridge stands out.
    pub brow: f32,
    /// From the nasion to the muzzle's end.
    pub muz_len: f32,
    /// Width of the muzzle at its root.
    pub muz_w0: f32,
    /// Width of the muzzle at its tip.
    pub muz_w1: f32,
    /// Depth of the upper muzzle at its root.
    pub muz_d0: f32,
    /// Depth of the upper muzzle at its tip.
    pub muz_d1: f32,
    /// Of the muzzle against the cranium.
    pub muz_tilt: f32,
    /// How far the bridge is arched.
    pub roman: f32,
    /// Width of the bridge as a part of the muzzle's.
    pub bridge_w: f32,
    /// Size of the roll above the nose.
    pub wrinkle: f32,
    /// Width of the nose pad.
    pub nose_w: f32,
    /// Height of the nose pad.
    pub nose_h: f32,
    /// How far the nose stands before the muzzle.
    pub nose_out: f32,
    /// How far the nose is lifted above the bridge's line.
    pub nose_up: f32,
    /// How far the flews hang.
    pub flew: f32,
    /// Thickness of the lips.
    pub lip_t: f32,
    /// Where the corner of the mouth lies along the muzzle.
    pub corner_z: f32,
    /// How far the chin's pad stands before the upper lip's front.
    pub jaw_len: f32,
    /// Width of the lower jaw as a part of the upper's.
    pub jaw_w: f32,
    /// Depth of the lower jaw.
    pub jaw_d: f32,
    /// How far the chin stands out.
    pub chin: f32,
    /// How far the dewlap hangs.
    pub throat: f32,
    /// Left eyeball from the median plane.
    pub eye_x: f32,
    /// Height of the eyeball's middle.
    pub eye_y: f32,
    /// The eyeball's middle along the axis of the head.
    pub eye_z: f32,
    /// Radius of the eyeball.
    pub eye_r: f32,
    /// Of the eye's axis to the side.
    pub eye_yaw: f32,
    /// Of the lids' long axis.
    pub eye_cant: f32,
    /// How far the lids are open.
    pub eye_open: f32,
    /// Width of the opening of the lids.
    pub eye_w: f32,
    /// How much fuller than a plain arch the upper lid is, towards the nose before all.
    pub eye_dome: f32,
    /// How far the lower lid hangs off the ball.
    pub haw: f32,
    /// Width of the neck.
    pub neck_w: f32,
    /// Depth of the neck.
    pub neck_d: f32,
    /// Of the neck below the horizontal.
    pub neck_ang: f32,
    /// The left ear.
    pub ear: EarProportions,
}

/// Cranial length of the default head, metres: there a head unit is 10 mm.
const REFERENCE_CRANIUM: f32 = 0.106;

/// The base of the cranium below the skin of the nasion on the canonical head, with the skin of the crown (head units).
const BASE_BELOW_NASION: f32 = 3.65;

/// How far the chin's pad stands before the upper lip's front where the incisors meet edge to edge (head units).
const LEVEL_BITE: f32 = -0.6;

/// How deep the bridge lies under the forehead (head units) for an interior stop angle in radians. A curve through the
/// classes of the standards: 175 degrees is hardly a step, 145 a Labrador's, 95 the deepest.
fn stop_depth(angle: f32) -> f32 {
    let open = ((angle.to_degrees() - 90.0) / 90.0).clamp(0.0, 1.0);
    2.75 * (1.0 - ops::powf(open, 2.2))
}

impl Proportions {
    /// Relates every measure to the cranial length.
    pub fn new(m: &Measures) -> Self {
        let scale = m.cranial_length * (0.01 / REFERENCE_CRANIUM);
        let u = |metres: f32| metres / scale;
        Self {
            scale,
            cran_len: 11.5,
            cran_w: 1.2 * u(m.cranial_width) + 2.0 * u(m.temporalis),
            cran_h: u(m.cranial_height) - BASE_BELOW_NASION,
            dome: m.forehead_dome,
            occiput: u(m.occiput),
            furrow: u(m.furrow),
            zyg_w: u(m.zygomatic_width) + 0.9,
            zyg_y: -u(m.zygomatic_drop),
            cheek: u(m.masseter),
            stop: stop_depth(m.stop_angle),
            brow: u(m.brow),
            muz_len: 0.98 * u(m.facial_length),
            muz_w0: u(m.muzzle_width_root),
            muz_w1: u(m.muzzle_width_tip),
            muz_d0: u(m.muzzle_depth_root),
            muz_d1: u(m.muzzle_depth_tip),
            muz_tilt: m.facial_tilt,
            roman: u(m.nasal_arch),
            bridge_w: m.bridge_width,
            wrinkle: m.nose_roll,
            nose_w: u(m.nose_width),
            nose_h: u(m.nose_height),
            nose_out: u(m.nose_projection),
            nose_up: u(m.nose_lift),
            flew: u(m.flews),
            lip_t: m.lip_thickness,
            corner_z: u(m.mouth_corner),
            jaw_len: LEVEL_BITE - u(m.overjet),
            jaw_w: m.jaw_width,
            jaw_d: u(m.jaw_depth),
            chin: u(m.chin),
            throat: u(m.dewlap),
            eye_x: 0.5 * u(m.eye_spacing),
            eye_y: u(m.eye_height),
            eye_z: -u(m.eye_depth),
            eye_r: 0.5 * u(m.eyeball_diameter),
            eye_yaw: m.gaze_angle,
            eye_cant: m.eye_cant,
            eye_open: m.lid_opening,
            eye_w: m.lid_width,
            eye_dome: m.lid_dome,
            haw: u(m.haw),
            neck_w: u(m.neck_width),
            neck_d: u(m.neck_depth),
            neck_ang: m.neck_angle,
            ear: EarProportions {
                length: u(m.ear_length),
                width: u(m.ear_width),
                base: u(m.ear_base),
                set: vec3(0.5 * u(m.ear_set_width), u(m.ear_set_height), -u(m.ear_set_back)),
                lift: m.ear_lift,
                back: m.ear_back,
                turn: m.ear_turn,
                fold: m.ear_fold,
                fold_height: m.ear_fold_height,
                fold_softness: m.ear_fold_softness,
                fold_slant: m.ear_fold_slant,
                sweep: m.ear_sweep,
                cup: m.ear_cup,
                thickness: u(m.ear_thickness),
                tip: m.ear_tip,
                widest: m.ear_widest,
            },
        }
    }

    /// Metres of one millimetre of the canonical head, whose cranium is 108.4 mm long.
    pub fn canonical_mm(&self) -> f32 {
        self.scale * (REFERENCE_CRANIUM / 0.01 / 108.4)
    }
    /// Height of the bridge at its root, muzzle frame.
    pub fn bridge0(&self) -> f32 {
        // A short face has no room for a bridge above the nasion.
        let long = (self.muz_len / 9.0).min(1.0);
        0.5 * long * long - 0.66 * self.stop
    }
    /// Height of the bridge at the nose, muzzle frame.
    pub fn bridge1(&self) -> f32 {
        self.bridge0() - 0.65 * (self.muz_len / 9.0).min(1.0)
    }
    /// Height of the lip line at the root of the muzzle, muzzle frame.
    pub fn lip0(&self) -> f32 {
        self.bridge0() - self.muz_d0
    }
    /// Height of the lip line at the tip of the muzzle, muzzle frame.
    pub fn lip1(&self) -> f32 {
        self.bridge1() - self.muz_d1
    }
    /// How the muzzle's tip compares with the default head's: features at the lips shrink with it.
    pub fn slim(&self) -> f32 {
        (self.muz_w1 / 5.8).clamp(0.45, 1.1)
    }
    /// Foremost extent of the lower jaw, muzzle frame.
    pub fn jaw_z(&self) -> f32 {
        self.muz_len + self.jaw_len
    }
    /// Middle of the nose pad, muzzle frame.
    pub fn nose_centre(&self) -> Vec3 {
        vec3(0.0, self.bridge1() - 0.12 - 0.4 * self.nose_h + self.nose_up, self.muz_len - 0.6 + self.nose_out)
    }
    /// Middle of the left eyeball.
    pub fn eye(&self) -> Vec3 {
        vec3(self.eye_x, self.eye_y, self.eye_z)
    }
    /// The forehead's body: height of its top, and its radii upwards and forwards about a middle that lies 0.26 of the
    /// cranium behind the nasion.
    pub fn forehead(&self) -> (f32, Vec2) {
        let radii = vec2(2.5 + 0.5 * self.dome + 0.12 * self.cran_h, 0.25 * self.cran_len + 0.2);
        (0.18 * self.cran_h - 1.3 + 0.35 * self.dome + radii.x, radii)
    }
    /// How deep the eye lies behind the edge of the orbit: 1 on long faces, less where a short one pushes it forward.
    pub fn depth_of_orbit(&self) -> f32 {
        0.25 + 0.75 * (self.muz_len / 8.5).min(1.0)
    }
    /// How far the medial canthus stands before the ball, as a part of the ball's radius.
    pub fn canthus(&self) -> f32 {
        0.15 * self.depth_of_orbit()
    }
    /// Midpoint of the mandibular condyles: the origin of the head's frame.
    pub fn hinge(&self) -> Vec3 {
        vec3(0.0, self.zyg_y - 1.37, -0.46 * self.cran_len)
    }
    /// Start and unit direction of the neck.
    pub fn neck_axis(&self) -> (Vec3, Vec3) {
        let start = vec3(0.0, self.cran_h - self.neck_d / 2.0 + 0.1, -0.66 * self.cran_len);
        (start, vec3(0.0, -ops::sin(self.neck_ang), -ops::cos(self.neck_ang)))
    }
    /// Out of the muzzle frame.
    pub fn head_from_muzzle(&self, p: Vec3) -> Vec3 {
        let (c, s) = (ops::cos(self.muz_tilt), ops::sin(self.muz_tilt));
        vec3(p.x, p.y * c + p.z * s, p.z * c - p.y * s)
    }
    /// Into the muzzle frame.
    pub fn muzzle_from_head(&self, p: Vec3) -> Vec3 {
        let (c, s) = (ops::cos(self.muz_tilt), ops::sin(self.muz_tilt));
        vec3(p.x, p.y * c - p.z * s, p.z * c + p.y * s)
    }
    /// From the frame of the proportions to the head's frame in metres: origin between the condyles, palate along z.
    pub fn metres(&self, p: Vec3) -> Vec3 {
        self.muzzle_from_head(p - self.hinge()) * self.scale
    }
    /// Back from the head's frame.
    pub fn proportional(&self, p: Vec3) -> Vec3 {
        self.head_from_muzzle(p * (1.0 / self.scale)) + self.hinge()
    }
    /// A direction into the head's frame.
    pub fn direction(&self, d: Vec3) -> Vec3 {
        self.muzzle_from_head(d)
    }
}
