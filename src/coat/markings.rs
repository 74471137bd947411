//! The colour of a coat at a place of the skin: a pure function of the place, the same bits everywhere.
//!
//! Every kind of marking is a signed distance in the frame of the base head, where nose, eyes, lips and ears lie at known
//! places. Before it is asked, the place is moved by slow noise, so that borders wander by some five millimetres, and by a
//! little along the hair, so that they end in tufts. A hair decides for itself on which side of a soft border it stands.

use super::chart::Site;
use crate::anatomy::{Marking, MarkingKind, Pattern};
use crate::math::{noise, ops};
use crate::rig::folds;
use glam::{Vec3, vec3};

/// Places of the base head, left side, head units.
mod place {
    use glam::{Vec3, vec3};

    /// Middle of the lids.
    pub const EYE: Vec3 = vec3(3.43, -0.30, -0.20);
    /// From the inner to the outer corner of the eye, unit.
    pub const EYE_AXIS: Vec3 = vec3(0.893, 0.063, -0.444);
    /// Half the lids' width and height.
    pub const EYE_HALF: (f32, f32) = (1.1, 0.75);
    /// Inner corner of the eye.
    pub const CANTHUS: Vec3 = vec3(2.35, -0.70, 0.35);
    /// Where a dot over the eye has its middle.
    pub const BROW: Vec3 = vec3(2.35, 1.70, -0.75);
    /// Where the upper lip meets the nose.
    pub const SNOUT: Vec3 = vec3(0.0, -3.6, 9.2);
    /// Middle of the spot on the cheek.
    pub const CHEEK: Vec3 = vec3(5.2, -4.8, -1.5);
    /// The root of the ear's outer face: all of the ear counts as lying there, wherever it hangs.
    pub const EAR: Vec3 = vec3(4.0, 1.6, -6.8);
    /// The neck's axis, from the head to the cut edge, unit; the edge lies `NECK_END` along it.
    pub const NECK: Vec3 = vec3(0.0, -0.670, -0.742);
    pub const NECK_END: f32 = 15.5;
    /// Across the neck, towards the throat, unit.
    pub const VENTRAL: Vec3 = vec3(0.0, -0.742, 0.670);
}

/// Millimetres of the default head in head units.
const MM: f32 = 0.1;
/// How far from the median plane both sides wander freely, head units.
const MIDDLE: f32 = 0.6;
/// What is no place of a marking.
const OUTSIDE: f32 = -100.0;

/// The layers of one coat, ready to be asked for colours.
#[derive(Debug)]
pub struct Colouring<'a> {
    base: Vec3,
    layers: Vec<Layer<'a>>,
}

#[derive(Debug)]
struct Layer<'a> {
    marking: &'a Marking,
    colour: Vec3,
}

/// A site that has been moved by noise.
struct Spot<'a> {
    site: &'a Site,
    /// Moved; of the ears, where they stand.
    p: Vec3,
    /// Moved, wherever on the ear it is.
    free: Vec3,
    /// Distance from the median plane.
    a: f32,
    /// Along the neck's axis.
    neck: f32,
    /// Towards the throat.
    ventral: f32,
    /// How much it is ear.
    ear: f32,
}

impl<'a> Colouring<'a> {
    /// Of one coat.
    pub fn new(pattern: &'a Pattern) -> Self {
        let colour = |marking: &Marking| pattern.pigments.colour(marking.paint);
        let layers = pattern.markings.iter().map(|marking| Layer { marking, colour: colour(marking) }).collect();
        Self { base: pattern.base_colour(), layers }
    }

    /// The linear colour of the coat at a site. `patch`: how much of the regions of a [`MarkingKind::Patch`] is there, by
    /// the marking's place in the pattern, 0 to 1.
    pub fn at(&self, site: &Site, patch: impl Fn(usize) -> f32) -> Vec3 {
        let spot = Spot::new(site);
        let mut colour = self.base;
        for (i, Layer { marking, colour: paint }) in self.layers.iter().enumerate() {
            let cover = match marking.kind {
                MarkingKind::Patch => spot.within((patch(i) - 0.5) * 1.6, marking.values[0]),
                _ => spot.cover(marking),
            };
            colour = colour.lerp(*paint, (cover * marking.amount).clamp(0.0, 1.0));
        }
        colour
    }
}

impl<'a> Spot<'a> {
    fn new(site: &'a Site) -> Self {
        let raw = site.place;
        // Both sides wander alike in part: a dog's face is nearly the same left and right.
        let twin = vec3(raw.x.abs(), raw.y, raw.z);
        let flip = vec3(if raw.x < 0.0 { -1.0 } else { 1.0 }, 1.0, 1.0);
        // What moves the sides against each other ends at the median plane, or it would tear what lies across it.
        let apart = vec3((raw.x / MIDDLE).clamp(-1.0, 1.0), 1.0, 1.0);
        let slow = noise::smooth(twin / 2.4, 1) * 0.42 * apart + noise::smooth(raw / 2.0, 2) * 0.30;
        let tuft = 0.30 * noise::smooth(raw / 0.26, 3).x + site.fibre.own(1).map_or(0.0, |own| 0.24 * own - 0.12);
        let free = raw + slow + site.flow * tuft;
        let ear = smoothstep(0.15, 0.75, site.ear.x);
        let root = vec3(place::EAR.x * flip.x, place::EAR.y, place::EAR.z);
        let p = free.lerp(root + 0.5 * slow, ear);
        Self { site, p, free, a: p.x.abs(), neck: p.dot(place::NECK), ventral: p.dot(place::VENTRAL), ear }
    }

    /// From a distance inside a border (head units) to how much is covered; `soft_mm` is the border's width.
    fn within(&self, inside: f32, soft_mm: f32) -> f32 {
        let soft = soft_mm * MM;
        match self.site.fibre.own(2) {
            None => smoothstep(-0.5, 0.5, inside / soft),
            // Each hair is of one colour or the other, nearly.
            Some(own) => smoothstep(-0.2, 0.2, inside / soft + 0.8 * (own - 0.5)),
        }
    }

    /// The place, mirrored to the left side.
    fn left(&self) -> Vec3 {
        vec3(self.a, self.p.y, self.p.z)
    }

    fn muzzle(&self, extent: f32, bridge: f32) -> f32 {
        let d = (self.left() - place::SNOUT) * vec3(0.9, 0.75, 1.0);
        let top = smoothstep(-2.5, -1.4, self.p.y) * smoothstep(-2.0, 0.5, self.p.z);
        16.0 * extent - d.length() - (1.0 - bridge) * 7.0 * top
    }

    /// From the lids outwards.
    fn eye(&self) -> f32 {
        let d = self.left() - place::EYE;
        let along = d.dot(place::EYE_AXIS);
        let across = (d - place::EYE_AXIS * along).length();
        let (w, h) = place::EYE_HALF;
        (ops::hypot(along / w, across / h) - 1.0) * 0.9
    }

    /// How high a place lies: on the head above a line that sinks backwards, on the neck towards the nape.
    fn height(&self) -> f32 {
        let head = self.p.y - 0.27 * (self.p.z + 5.0);
        let nape = -0.40 * self.ventral;
        head + (nape - head) * smoothstep(8.0, 12.0, self.neck)
    }

    fn throat(&self, extent: f32) -> f32 {
        let under = (-2.5 - self.p.z).max(-6.5 - self.p.y);
        if extent > 0.0 { (self.ventral - 4.5 + 7.0 * extent).min(under) } else { OUTSIDE }
    }

    fn brow(&self, radius: f32) -> f32 {
        if radius > 0.0 { radius - ((self.left() - place::BROW) * vec3(0.75, 1.1, 0.9)).length() } else { OUTSIDE }
    }

    fn blaze(&self, width: f32, top: f32, muzzle: f32) -> f32 {
        let p = self.p;
        let end = -9.5 * top;
        let half = 0.5 * width * (1.0 + 0.3 * smoothstep(0.0, -4.0, p.z)) + 2.2 * muzzle * smoothstep(0.5, 5.5, p.z);
        let taper = ops::sqrt(((p.z - end) / 2.5).clamp(0.0, 1.0));
        if width > 0.0 { (half * taper - self.a).min(p.y + 2.9).min(p.z - end) } else { OUTSIDE }
    }

    fn bar(&self, peak: f32) -> f32 {
        let p = self.p;
        let width = 0.95 - 0.07 * p.z.max(0.0);
        if peak > 0.0 { (width - self.a).min(7.0 * peak - 1.0 - p.z).min(p.y + 2.2) } else { OUTSIDE }
    }

    fn pale_side(&self, extent: f32) -> f32 {
        let p = self.p;
        let border = -4.8 + 4.4 * extent - 0.3 * (-3.0 - p.z).max(0.0);
        let mut head = border - p.y;
        if p.z > 0.0 {
            head = head.min(-1.7 - p.y);
        }
        let neck = self.ventral - 3.5 + 8.0 * extent;
        head + (neck - head) * smoothstep(8.5, 11.0, self.neck)
    }

    /// What [`MarkingKind::Piebald`] leaves coloured.
    fn patch_of_side(&self, extent: f32, left: f32, right: f32) -> f32 {
        let from = place::EYE;
        let along = vec3(4.2, 1.2, -6.0) - from;
        let d = self.left() - from;
        let t = (d.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let side = right + (left - right) * smoothstep(-1.2, 1.2, self.p.x);
        let size = 7.0 * (1.0 - extent) + 150.0 * (0.15 - extent).max(0.0);
        if side > 0.0 { size * side - (d - along * t).length() } else { OUTSIDE }
    }

    /// Noise with blobs `size` across and `torn` borders, about -1 to 1.
    fn blobs(&self, size: f32, torn: f32, seed: u32) -> f32 {
        let p = self.free;
        let coarse = noise::smooth(p / size, seed);
        let middle = noise::smooth(p / (0.42 * size), seed ^ 0x51);
        let fine = noise::smooth(p / (0.17 * size).max(0.12), seed ^ 0x77);
        0.8 * coarse.x + 0.35 * middle.y + torn * (0.30 * middle.x + 0.35 * fine.x)
    }

    /// Distance into the nearest of round spots, `size` across; far outside where none is near.
    fn spots(&self, size: f32, density: f32, seed: u32) -> f32 {
        let p = self.site.place + (self.free - self.site.place) * 0.25;
        let mesh = size * (2.6 - 1.5 * density);
        let place = p / mesh;
        // No spot is wider than half a cell beyond its own.
        let reach = Vec3::splat(0.56);
        let [from, to] = [place - reach, place + reach].map(|corner| corner.floor().as_ivec3());
        let mut inside = OUTSIDE;
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    let cell = glam::ivec3(x, y, z);
                    let own = noise::cell(cell, seed ^ 0x1234);
                    if own.x < 0.35 + 0.6 * density {
                        let middle = cell.as_vec3() + noise::cell(cell, seed);
                        let radius = 0.5 * size * (0.55 + 0.6 * own.y);
                        inside = inside.max(radius - (place - middle).length() * mesh);
                    }
                }
            }
        }
        inside
    }

    /// Stripes across the hair, each of its own strength, that branch and end.
    fn stripes(&self, spacing: f32, width: f32, breaks: f32, seed: u32) -> f32 {
        let p = self.free;
        let warp =
            noise::smooth(p / (3.2 * spacing), seed).x * 1.3 + noise::smooth(p / (1.1 * spacing), seed ^ 0x99).x * 0.45;
        let phase = (0.85 * p.z + 0.45 * p.x.abs() + 0.25 * p.y) / spacing + warp;
        let wave = ops::cos(std::f32::consts::TAU * (phase - phase.floor()));
        let gap = noise::smooth(p / (1.6 * spacing), seed ^ 0x33).x;
        (wave - ops::cos(std::f32::consts::PI * width) - breaks * 2.0 * (gap + 0.15)) * 0.20 * spacing
    }

    /// How much of a marking is here, 0 to 1.
    fn cover(&self, marking: &Marking) -> f32 {
        use MarkingKind::*;
        let v = marking.values;
        let p = self.p;
        let seed = |value: f32| (value as u32).wrapping_mul(0x9e37_79b9) ^ (marking.kind as u32) << 16;
        match marking.kind {
            Mask => {
                let [extent, eyes, bridge, soft, ..] = v;
                let lids = if eyes > 0.0 { 2.4 * eyes - self.eye() } else { OUTSIDE };
                let muzzle = if extent > 0.0 { self.muzzle(extent, bridge) } else { OUTSIDE };
                self.within(muzzle.max(lids), soft)
            }
            Muzzle => {
                let [extent, bridge, soft, ..] = v;
                self.within(if extent > 0.0 { self.muzzle(extent, bridge) } else { OUTSIDE }, soft)
            }
            Blaze => {
                let [width, top, muzzle, soft, ..] = v;
                self.within(self.blaze(width * MM, top, muzzle), soft)
            }
            Cap => {
                let [extent, peak, soft, ..] = v;
                self.within((self.height() - 2.4 + 4.8 * extent).max(self.bar(peak)), soft)
            }
            Sable => {
                let [extent, soft, ..] = v;
                let rim = if self.ear > 0.0 { (0.8 - self.site.ear.z.abs()) * self.ear * 2.0 } else { 0.0 };
                self.within(self.height() - 3.4 + 5.0 * extent + rim, soft)
            }
            Saddle => {
                let [extent, forward, soft, ..] = v;
                let down = if extent >= 1.0 { 100.0 } else { -8.8 + 14.0 * extent - self.ventral };
                self.within(down.min(self.neck - 9.0 + 6.0 * forward), soft) * (1.0 - self.ear)
            }
            Collar => {
                let [width, soft, ..] = v;
                self.within(self.neck - place::NECK_END + width * MM, soft)
            }
            Throat => {
                let [extent, soft, ..] = v;
                self.within(self.throat(extent), soft)
            }
            TanPoints => {
                let [brows, muzzle, cheeks, throat, ears, soft] = v;
                let sides = if muzzle > 0.0 { (-5.2 + 4.0 * muzzle - p.y).min(p.z - 0.5) } else { OUTSIDE };
                let cheek = ((self.left() - place::CHEEK) * vec3(0.5, 1.0, 0.75)).length();
                let cheek = if cheeks > 0.0 { 4.4 * cheeks - cheek } else { OUTSIDE };
                let inside = sides.max(cheek).max(self.throat(throat)).max(self.brow(1.5 * brows));
                let inner = self.ear * ears * self.within((-0.45 - self.site.ear.z) * 1.2, soft);
                self.within(inside, soft).max(inner)
            }
            BrowDots => {
                let [size, soft, ..] = v;
                self.within(self.brow(0.5 * size * MM), soft)
            }
            Urajiro => {
                let [extent, soft, ..] = v;
                self.within(if extent > 0.0 { self.pale_side(extent) } else { OUTSIDE }, soft)
            }
            TearLine => {
                let [length, width, soft, ..] = v;
                let along = vec3(-0.10, -0.78, 0.62) * (length * MM).max(1e-3);
                let d = self.left() - place::CANTHUS;
                let t = (d.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                self.within(0.5 * width * MM - (d - along * t).length(), soft)
            }
            EyeRings => {
                let [width, soft, ..] = v;
                self.within(width * MM - self.eye(), soft)
            }
            EyePatch => {
                let [size, left, right, soft, ..] = v;
                let side = right + (left - right) * smoothstep(-0.5, 0.5, p.x);
                let d = (self.left() - place::EYE) * vec3(0.75, 1.0, 0.75);
                let inside = if side > 0.0 { 0.5 * size * MM * side - d.length() } else { OUTSIDE };
                self.within(inside, soft)
            }
            Ears => {
                let [from, outside, inside, soft, ..] = v;
                let face = inside + (outside - inside) * smoothstep(-0.6, 0.1, self.site.ear.z);
                let along = if from > 0.0 { (self.site.ear.y - from) * 8.0 } else { 100.0 };
                self.ear * face * self.within(along, soft)
            }
            EarRims => {
                let [width, soft, ..] = v;
                self.ear * self.within((width - self.site.ear.z.abs()) * 1.8, soft)
            }
            Thumb => {
                let [size, height, soft, ..] = v;
                let d = ops::hypot(1.5 * self.a, p.z + 9.0 * height);
                self.within((0.5 * size * MM - d).min(p.y + 0.5), soft)
            }
            Wrinkles => {
                let [spacing, soft, ..] = v;
                let spacing = spacing * MM;
                let valley = folds::Site::new(self.site.place, 1.0).valley(spacing);
                self.within((valley - 0.45) * 0.5 * spacing, soft)
            }
            Piebald => {
                let [extent, left, right, ears, ragged, number] = v;
                let wander = ragged * 2.6 * noise::smooth(self.free / 2.8, seed(number)).x;
                let white = -self.patch_of_side(extent, left, right) - wander;
                let head = if extent > 0.0 { self.within(white, 2.5) } else { 0.0 };
                head + (1.0 - ears - head) * self.ear
            }
            Patches => {
                let [size, cover, torn, number, soft, ..] = v;
                let field = self.blobs(size * MM, torn, seed(number));
                self.within((field - threshold(cover)) * 0.6 * size * MM, soft)
            }
            Spots | Ticking => {
                let [size, density, number, soft, ..] = v;
                let inside = if density > 0.0 { self.spots(size * MM, density, seed(number)) } else { OUTSIDE };
                self.within(inside, soft)
            }
            Brindle => {
                let [spacing, width, breaks, number, soft, ..] = v;
                self.within(self.stripes(spacing * MM, width, breaks, seed(number)), soft)
            }
            Merle => {
                let [size, cover, torn, number, ..] = v;
                let inside = (self.blobs(size * MM, torn, seed(number)) - threshold(cover)) * 0.6 * size * MM;
                let tone = 0.45 * self.within(inside + 0.16 * size * MM, 3.0);
                self.within(inside, 1.5).max(tone)
            }
            Roan => {
                let [density, patchy, number, ..] = v;
                let here = density * (1.0 + patchy * noise::smooth(self.free / 1.7, seed(number)).x);
                self.site.fibre.own(seed(number)).map_or(here, |own| if own < here { 1.0 } else { 0.0 })
            }
            Grizzle => {
                let [density, spread, number, ..] = v;
                let own = self.site.fibre.own(seed(number)).unwrap_or(0.5);
                let lock = 0.25 * noise::smooth(self.free / 0.5, seed(number)).x;
                (density + spread * (own - 0.5 + lock)).clamp(0.0, 1.0)
            }
            // Asked for where the regions are known.
            Patch => 0.0,
        }
    }
}

/// The height above which so much of the field of [`Spot::blobs`] lies, about.
fn threshold(cover: f32) -> f32 {
    if cover <= 0.0 {
        return 100.0;
    }
    (0.5 - cover) * 1.5
}

/// 0 below `from`, 1 above `to`, smooth between; the other way round where `to` is the lower one.
fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
