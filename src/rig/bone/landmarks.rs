//! Landmarks of the bone: where they stand on the canonical skull, and where a head's measures put them.
//!
//! The canonical skull is a constructed mesaticephalic one of 200 mm. Craniometric points are those of von den Driesch
//! 1976. Of the targets these are exact: prosthion to nasion is the facial length, nasion to akrokranion the cranial
//! length, zygion to zygion the zygomatic width, euryon to euryon the cranial width; the condyles' middle is the origin.
//! What the measures leave open follows the skin's proportions at the depth of the tissue over the bone.

use super::teeth;
use crate::math::ops;
use crate::rig::proportions::{Measures, Proportions};
use glam::{Vec3, vec3};

/// One landmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmark {
    /// Number in the list of landmarks; `S` is the skull layer.
    pub id: &'static str,
    /// Anatomical name.
    pub name: &'static str,
    /// On the canonical skull, millimetres, head's frame: the left one, or in the median plane.
    pub canonical: Vec3,
    /// On which mesh it is a vertex, if on any.
    pub on: Option<BoneMesh>,
}

/// The two bones of the head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoneMesh {
    /// Cranium and upper jaw.
    Skull,
    /// Lower jaw.
    Mandible,
}

macro_rules! landmarks {
    ($($key:ident $id:literal $name:literal ($x:literal, $y:literal, $z:literal) $on:expr;)*) => {
        /// All of them, in the order of [`Targets`].
        pub const LANDMARKS: &[Landmark] = &[
            $(Landmark { id: $id, name: $name, canonical: Vec3::new($x, $y, $z), on: $on },)*
        ];

        /// A position for each landmark.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Targets<T> { $(#[doc = $name] pub $key: T,)* }

        impl<T: Copy> Targets<T> {
            /// With each point changed alike.
            pub fn map(&self, mut f: impl FnMut(T) -> T) -> Self {
                Targets { $($key: f(self.$key),)* }
            }

            /// As a list, in the order of [`LANDMARKS`].
            pub fn list(&self) -> [T; LANDMARKS.len()] {
                [$(self.$key,)*]
            }
        }

        impl Targets<Vec3> {
            /// Those of the canonical skull, millimetres.
            pub const CANONICAL: Targets<Vec3> = Targets { $($key: Vec3::new($x, $y, $z),)* };
        }
    };
}

const SKULL: Option<BoneMesh> = Some(BoneMesh::Skull);
const MANDIBLE: Option<BoneMesh> = Some(BoneMesh::Mandible);

landmarks! {
    prosthion "S01" "prosthion" (0.0, 6.0, 138.0) SKULL;
    rhinion "S02" "rhinion" (0.0, 25.0, 121.0) SKULL;
    nasion "S03" "nasion" (0.0, 37.0, 50.0) SKULL;
    glabella "S04" "glabella" (0.0, 58.0, 28.0) SKULL;
    bregma "S05" "bregma" (0.0, 63.0, -5.0) SKULL;
    vertex "S06" "vertex" (0.0, 64.0, -18.0) SKULL;
    akrokranion "S07" "akrokranion" (0.0, 46.0, -58.0) SKULL;
    opisthion "S08" "opisthion" (0.0, 20.0, -54.0) SKULL;
    basion "S09" "basion" (0.0, 4.0, -49.0) SKULL;
    synsphenion "S10" "synsphenion" (0.0, 2.0, -12.0) SKULL;
    staphylion "S11" "staphylion" (0.0, 9.0, 24.0) SKULL;
    zygion "S12" "zygion" (52.4, 14.0, 8.0) SKULL;
    euryon "S13" "euryon" (29.7, 35.0, -22.0) SKULL;
    frontostenion "S14" "frontostenion" (20.0, 47.0, 12.0) SKULL;
    ectorbitale "S15" "ectorbitale" (27.0, 48.0, 30.0) SKULL;
    entorbitale "S16" "entorbitale" (20.0, 34.0, 58.0) SKULL;
    orbit_rim "S17" "ventral orbital rim" (36.0, 20.0, 50.0) SKULL;
    frontal_process "S18" "frontal process of the zygomatic bone" (43.5, 25.0, 31.0) SKULL;
    arch_root "S20" "rostral root of the zygomatic arch" (33.0, 12.0, 64.0) SKULL;
    maxilla "S21" "maxilla at the fourth premolar" (33.0, 7.0, 70.0) SKULL;
    canine "S22" "maxilla at the canine alveolus" (20.5, 8.0, 122.0) SKULL;
    incisor "S23" "incisive bone at the third incisor" (11.5, 6.0, 132.0) SKULL;
    nasoincisive "S24" "nasoincisive notch" (12.0, 18.0, 126.0) SKULL;
    condyle "S25" "condyle centre" (38.0, 0.0, 0.0) None;
    retroarticular "S26" "retroarticular process" (32.0, -4.0, -6.0) SKULL;
    coronion "S27" "coronoid process" (34.0, 36.0, 12.0) MANDIBLE;
    gonion "S28" "angular process" (36.0, -19.0, -6.0) MANDIBLE;
    masseteric "S29" "masseteric fossa" (37.0, 0.0, 16.0) MANDIBLE;
    body "S30" "mandibular body at the first molar, ventral" (24.0, -30.0, 66.0) MANDIBLE;
    symphysis "S31" "symphysis, caudal end" (0.0, -24.0, 101.0) MANDIBLE;
    infradentale "S32" "infradentale" (0.0, -5.0, 134.0) MANDIBLE;
    gnathion "S33" "gnathion" (0.0, -19.0, 120.0) MANDIBLE;
    bulla "S34" "tympanic bulla, ventral" (21.0, -16.0, -30.0) SKULL;
    meatus "S35" "external acoustic meatus" (33.0, 4.0, -24.0) None;
    occipital_condyle "S36" "occipital condyle, caudal" (9.0, 8.0, -54.0) SKULL;
    paracondylar "S37" "paracondylar process" (25.0, -14.0, -44.0) SKULL;
    asterion "S38" "nuchal crest, lateral" (33.0, 30.0, -44.0) SKULL;
    lower_canine "L1" "mandible at the canine alveolus" (15.5, -7.0, 124.0) None;
    lower_carnassial "L2" "mandible at the first molar, alveolar" (26.5, -5.0, 66.0) None;
    lower_last "L3" "mandible behind the last molar, alveolar" (30.5, -1.0, 40.0) None;
    upper_last "L4" "maxilla at the last molar" (28.0, 7.0, 52.0) None;
}

/// Millimetres of the canonical skull for one head unit along the cranium.
const MM: f32 = 10.23;
/// Skin over bone in the median plane, head units.
const TISSUE: f32 = 0.45;

/// The upper teeth's necks above the lip's margin, as a part of the muzzle's depth.
const ALVEOLUS: f32 = 0.46;

/// Where the landmarks of a head's bone stand: metres, head's frame.
pub fn targets(m: &Measures, s: &Proportions) -> Targets<Vec3> {
    let canon = Targets::<Vec3>::CANONICAL;
    let u = |metres: f32| metres / s.scale;
    let (zw, cw) = (0.5 * u(m.zygomatic_width), 0.5 * u(m.cranial_width));
    let (face, cranium) = (u(m.facial_length), u(m.cranial_length));
    let hinge = s.hinge();

    // The median profile, in the frame of the proportions (origin at the skin of the nasion).
    let nasion = vec3(0.0, -TISSUE - 0.5 * (s.stop - 1.7).max(0.0), -0.35 - 0.06 * (s.muz_len - 9.0).clamp(0.0, 4.0));
    let rise = (s.cran_h - 2.4 + 0.5 * s.occiput - nasion.y).clamp(-0.6 * cranium, 0.6 * cranium);
    let akrokranion = nasion + vec3(0.0, rise, -ops::sqrt(cranium * cranium - rise * rise));
    let base = hinge.y;
    let crown = s.cran_h - 0.2;

    // Heights and depths of the cranium, canonical millimetres to head units, straight between landmarks.
    let along =
        |z: f32| line(z, &[(-58.0, akrokranion.z), (0.0, hinge.z), (50.0, nasion.z), (60.0, nasion.z + 10.0 / MM)]);
    let up = |y: f32| {
        line(
            y,
            &[
                (-20.0, base - 20.0 / MM),
                (0.0, base),
                (14.0, s.zyg_y),
                (37.0, nasion.y.min(crown - 1.0)),
                (64.0, crown),
            ],
        )
    };
    // Frontal bone stays under a forehead that is round rather than high.
    let forehead = {
        let (top, radii) = s.forehead();
        let from_middle = ((along(28.0) + 0.26 * s.cran_len) / radii.y).clamp(-1.0, 1.0);
        top - radii.x * (1.0 - ops::sqrt(1.0 - from_middle * from_middle)) - 0.25
    };
    let wide = |x: f32| x / 29.7 * cw;
    let cranial = |c: Vec3| vec3(wide(c.x), up(c.y), along(c.z));
    let occipital = |c: Vec3| {
        let y = line(c.y, &[(-20.0, base - 20.0 / MM), (0.0, base), (46.0, akrokranion.y)]);
        vec3(wide(c.x), y, along(c.z))
    };

    // Around the eye: it has its place and its size.
    let orbit = 0.5 + 0.5 * s.eye_r / 1.05;
    let before = vec3(1.0, 1.0, s.depth_of_orbit());
    let beside =
        |c: Vec3| s.eye() + (c - vec3(27.5, 36.0, 46.5)) / MM * orbit * if c.z > 46.5 { before } else { Vec3::ONE };

    // The face, in the muzzle's frame.
    let (w0, w1) = (0.5 * s.muz_w0, 0.5 * s.muz_w1);
    let nasion_m = s.muzzle_from_head(nasion);
    let (alveolar0, front) = (s.lip0() + ALVEOLUS * s.muz_d0, s.lip1() + ALVEOLUS * s.muz_d1);
    // A face that is higher than long turns its palate up.
    let drop = (nasion_m.y - front).min(0.85 * face);
    let prosthion = vec3(0.0, nasion_m.y - drop, nasion_m.z + ops::sqrt(face * face - drop * drop));
    let out =
        |z: f32| line(z, &[(24.0, along(24.0) - nasion.z + nasion_m.z), (50.0, nasion_m.z), (138.0, prosthion.z)]);
    let alveolar = |z: f32| line(out(z), &[(out(50.0), alveolar0), (prosthion.z, prosthion.y)]);
    let bridge = |z: f32| {
        let t = (out(z) / s.muz_len).clamp(0.0, 1.0);
        let arch = ((t - 0.3) / 0.7).clamp(0.0, 1.0);
        let skin = s.bridge0() + 0.45 + t * (s.bridge1() - s.bridge0() - 0.45);
        (skin + 4.0 * s.roman * arch * (1.0 - arch) - TISSUE).max(prosthion.y + 0.4 * drop)
    };
    // Between palate and bridge.
    let at = |x: f32, y: f32, z: f32| {
        let t = (y - 7.0) / (bridge_of_canon(z) - 7.0);
        vec3(x, alveolar(z) + t * (bridge(z) - alveolar(z)), out(z))
    };
    let (c, p4, last) = (canon.canine, canon.maxilla, canon.upper_last);
    let maxilla = at(0.87 * w0, p4.y, p4.z);
    let canine = at(0.79 * w1, c.y, c.z);

    // The lower jaw: under the upper, as far as its skin allows.
    let below = |y: f32| y / 11.0 * (0.35 * s.jaw_d + 0.4);
    let floor = |z: f32| {
        let skin0 = s.lip0() - s.jaw_d;
        let skin1 = s.lip1() - 0.72 * s.jaw_d;
        line(out(z), &[(out(24.0), skin0 + 0.3), (prosthion.z, skin1 + 0.55)])
    };
    // So far forwards that the incisors have their overjet. The first lower one stands between infradentale and canine,
    // and the canine between infradentale and the first molar, which stays: both a part of the way, so that it is linear.
    let infradentale = {
        let unit = s.head_from_muzzle(prosthion).distance(akrokranion) / 200.0;
        let [(up_part, up_behind), (low_part, low_behind)] = [true, false].map(teeth::first_edge);
        let upper = prosthion.z + up_part * (out(canon.incisor.z) - prosthion.z) - up_behind * unit;
        let lower = upper - u(m.overjet) + low_behind * unit;
        let back = low_part * teeth::LOWER_FRONT * (134.0 - canon.lower_canine.z) / (134.0 - 66.0);
        vec3(0.0, prosthion.y - below(11.0), (lower - back * out(66.0)) / (1.0 - back))
    };
    let jaw_z = |z: f32| line(z, &[(0.0, out(0.0)), (66.0, out(66.0)), (134.0, infradentale.z)]);
    let jaw_w = 0.5 + 0.58 * s.jaw_w;
    let lower = |z: f32| {
        line(z, &[(40.0, alveolar0 - below(9.0)), (66.0, alveolar(66.0) - below(12.0)), (134.0, infradentale.y)])
    };
    let hinge_m = s.muzzle_from_head(hinge);
    // Inside the lower lip, which hangs over the bone of broad short muzzles.
    let lip1 = 0.86 * (0.62 * w1 + 0.8 * s.lip_t * s.slim()) - 0.35;
    let lip0 = 0.93 * (0.87 * w0 + 0.55 * s.lip_t) - 0.5;

    let head = |p: Vec3| s.metres(p);
    let muzzle = |p: Vec3| s.metres(s.head_from_muzzle(p));
    Targets {
        prosthion: muzzle(prosthion),
        rhinion: muzzle(vec3(0.0, bridge(121.0), out(121.0))),
        nasion: head(nasion),
        glabella: head(vec3(0.0, up(58.0).min(forehead), along(28.0))),
        bregma: head(vec3(0.0, up(63.0), along(-5.0))),
        vertex: head(vec3(0.0, up(64.0), along(-18.0))),
        akrokranion: head(akrokranion),
        opisthion: head(occipital(canon.opisthion)),
        basion: head(occipital(canon.basion)),
        synsphenion: head(cranial(canon.synsphenion)),
        staphylion: muzzle(vec3(0.0, alveolar0 + 0.25, out(24.0))),
        zygion: head(vec3(zw, s.zyg_y, along(8.0))),
        euryon: head(vec3(cw, up(35.0), along(-22.0))),
        frontostenion: head(cranial(canon.frontostenion)),
        ectorbitale: head(beside(canon.ectorbitale)),
        entorbitale: head(beside(canon.entorbitale)),
        orbit_rim: head(beside(canon.orbit_rim)),
        frontal_process: head(beside(canon.frontal_process)),
        arch_root: muzzle(at(0.87 * w0, canon.arch_root.y, canon.arch_root.z)),
        maxilla: muzzle(maxilla),
        canine: muzzle(canine),
        incisor: muzzle(at(0.44 * w1, canon.incisor.y, canon.incisor.z)),
        nasoincisive: muzzle(at(0.46 * w1, canon.nasoincisive.y, canon.nasoincisive.z)),
        condyle: head(vec3(0.725 * zw, hinge.y, hinge.z)),
        retroarticular: head(hinge + vec3(0.61 * zw, -4.0 / MM, -6.0 / MM)),
        coronion: head(vec3(0.65 * zw, up(36.0), along(12.0))),
        gonion: muzzle(hinge_m + vec3(0.69 * zw, -1.86, -0.6)),
        masseteric: head(vec3(0.706 * zw, hinge.y, along(16.0))),
        body: muzzle(vec3((0.64 * w0 * jaw_w).min(lip0 - 0.2), floor(66.0), jaw_z(66.0))),
        symphysis: muzzle(vec3(0.0, floor(101.0), jaw_z(101.0))),
        infradentale: muzzle(infradentale),
        gnathion: muzzle(vec3(0.0, floor(120.0) + 0.4, jaw_z(120.0))),
        bulla: head(cranial(canon.bulla)),
        meatus: head(cranial(canon.meatus)),
        occipital_condyle: head(occipital(canon.occipital_condyle)),
        paracondylar: head(cranial(canon.paracondylar)),
        asterion: head(occipital(canon.asterion)),
        lower_canine: muzzle(vec3((0.60 * w1 * jaw_w).min(lip1), lower(124.0), jaw_z(124.0))),
        lower_carnassial: muzzle(vec3((0.71 * w0 * jaw_w).min(lip0), lower(66.0), jaw_z(66.0))),
        lower_last: muzzle(vec3(0.80 * w0 * jaw_w, lower(40.0), jaw_z(40.0))),
        upper_last: muzzle(at(0.74 * w0, last.y, last.z)),
    }
}

/// Height of the canonical bridge.
fn bridge_of_canon(z: f32) -> f32 {
    line(z, &[(50.0, 37.0), (121.0, 25.0), (138.0, 22.0)])
}

/// Straight between the points, and straight on beyond them.
fn line(x: f32, points: &[(f32, f32)]) -> f32 {
    let last = points.len() - 2;
    let k = points[1..].iter().position(|p| x <= p.0).unwrap_or(last).min(last);
    let ((x0, y0), (x1, y1)) = (points[k], points[k + 1]);
    y0 + (x - x0) / (x1 - x0) * (y1 - y0)
}
