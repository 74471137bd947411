//! The parts of a head that may touch, as spheres with what each follows.

use super::motion::{Follow, Joints, Moved};
use super::spheres::{Body, Fit, Sphere, chain, cover};
use crate::math::ops;
use crate::rig::bone::{Bones, BonesOfHead, Targets, teeth};
use crate::rig::{Eye, Handles, Rig};
use glam::Vec3;
use std::ops::Range;

/// What spheres stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Crowns of the upper teeth.
    UpperTeeth,
    /// Crowns of the lower teeth.
    LowerTeeth,
    /// Alveolar bone and palate of the upper jaw.
    UpperJaw,
    /// Mandible.
    Mandible,
    /// Eyeballs with their corneas.
    Eyes,
    /// Margin and inner side of the upper lip.
    UpperLip,
    /// Margin and inner side of the lower lip.
    LowerLip,
    /// Tongue.
    Tongue,
}

impl Part {
    /// Number of parts.
    pub const COUNT: usize = 8;
    /// All of them.
    pub const ALL: [Part; Self::COUNT] = [
        Part::UpperTeeth,
        Part::LowerTeeth,
        Part::UpperJaw,
        Part::Mandible,
        Part::Eyes,
        Part::UpperLip,
        Part::LowerLip,
        Part::Tongue,
    ];

    /// How close its cover is, canonical millimetres.
    pub const fn fit(self) -> Fit {
        match self {
            Part::UpperTeeth | Part::LowerTeeth => Fit { grow: 0.3, miss: 0.45, most: 32 },
            Part::UpperJaw => Fit { grow: 1.0, miss: 0.48, most: 120 },
            Part::Mandible => Fit { grow: 1.0, miss: 0.48, most: 200 },
            Part::Eyes => Fit { grow: 0.2, miss: 0.0, most: 2 },
            Part::UpperLip | Part::LowerLip => Fit { grow: LIP, miss: 0.0, most: usize::MAX },
            Part::Tongue => Fit { grow: 0.6, miss: 0.48, most: 90 },
        }
    }

    /// Whether more than the parameters of the jaw and the tongue moves it: muscles move lips, and a tongue curls.
    pub const fn is_soft(self) -> bool {
        matches!(self, Part::UpperLip | Part::LowerLip | Part::Tongue)
    }
}

/// Radius of the spheres of a lip, canonical millimetres: lips are kept so far off the teeth.
pub const LIP: f32 = 0.8;

/// A vertex of the skin that spheres of a lip hang on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LipVertex {
    /// Its number in the whole skin.
    pub vertex: u32,
    /// How much it follows the jaw.
    pub follow: Follow,
    /// Unit, horizontal at rest: out of the mouth, across the line of the lips.
    pub outwards: Vec3,
}

/// Where a sphere of a lip hangs: two vertices of [`Spheres::lip`], and the part of the way from the first to the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Numbers in the list of lip vertices.
    pub ends: [u16; 2],
    /// Part of the way, 0 to 1.
    pub t: f32,
}

/// The lips' rows of vertices of the whole skin, each from the right corner of the mouth over the median plane to the left
/// one: control vertices, which every level of the refined skin has under the same numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct LipRows {
    /// Margin and inner row of the upper lip.
    pub upper: [Vec<u32>; 2],
    /// Margin and inner row of the lower lip.
    pub lower: [Vec<u32>; 2],
}

impl LipRows {
    /// Of a rig.
    pub fn new(rig: &Rig) -> Self {
        let Handles { s, l, mu, ml, .. } = rig.plan().handles();
        let row = |of: &dyn Fn(usize) -> u16| -> Vec<u32> {
            let left: Vec<u32> = (3..=10).map(|i| u32::from(of(i))).collect();
            let right = left[1..].iter().rev().map(|&v| rig.image(v as usize) as u32);
            right.chain(left.iter().copied()).collect()
        };
        Self { upper: [row(&|i| s[i][9]), row(&|i| mu[i][1])], lower: [row(&|i| l[i][9]), row(&|i| ml[i][1])] }
    }
}

/// The skin that lips are part of.
#[derive(Clone, Copy, Debug)]
pub struct Lips<'a> {
    /// Which vertices.
    pub rows: &'a LipRows,
    /// Positions of the skin at rest, control or refined: every vertex of the rows.
    pub at: &'a [Vec3],
    /// How much of the jaw's turn each follows, 0 to 1; as many.
    pub weights: &'a [f32],
}

/// One head at rest. Metres, head's frame.
#[derive(Clone, Copy, Debug)]
pub struct Head<'a> {
    /// Connectivity of the bones.
    pub bones: &'a Bones,
    /// Bones and teeth.
    pub of_head: &'a BonesOfHead,
    /// Tongue.
    pub tongue: Body<'a>,
    /// Left eye and right eye.
    pub eyes: &'a [Eye; 2],
    /// Lips.
    pub lips: Lips<'a>,
}

/// All spheres of one head, part by part.
#[derive(Clone, Debug, Default)]
pub struct Spheres {
    /// A canonical millimetre, metres.
    pub unit: f32,
    /// At rest.
    pub at_rest: Vec<Sphere>,
    /// What each follows; as many.
    pub follow: Vec<Follow>,
    /// How close the cover of each part is, metres, in the order of [`Part::ALL`].
    pub fits: [(f32, f32); Part::COUNT],
    starts: [usize; Part::COUNT + 1],
    /// Vertices of both lips, each once.
    lip: Vec<LipVertex>,
    /// Where the spheres of both lips hang, the upper's first.
    spans: Vec<Span>,
    joints: Joints,
    /// From the tongue's root to its tip at rest.
    tongue: [f32; 2],
    /// Half its width at even distances from root to tip.
    widths: [f32; WIDTHS],
}

impl Spheres {
    /// The spheres of a head. Empty where it has no bones yet.
    pub fn new(head: &Head) -> Self {
        let Some(targets) = head.of_head.targets else { return Self::default() };
        let unit = teeth::unit(&targets);
        let (root, tip) = ends(head.tongue.at);
        let joints = Joints { hinge: targets.condyle.with_x(0.0), pivot: pivot(head.tongue.at, root, tip) };
        let widths = half_widths(head.tongue.at, [root, tip]);
        let mut out = Self { unit, joints, tongue: [root, tip], widths, ..Self::default() };
        for (k, part) in Part::ALL.into_iter().enumerate() {
            let fit = part.fit();
            let fit = Fit { grow: fit.grow * unit, miss: fit.miss * unit, ..fit };
            let kept = out.add(part, head, &targets, fit);
            out.fits[k] = (kept.grow, kept.miss);
            out.starts[k + 1] = out.at_rest.len();
        }
        out
    }

    fn add(&mut self, part: Part, head: &Head, targets: &Targets<Vec3>, fit: Fit) -> Fit {
        let Head { bones, of_head, tongue, eyes, lips } = head;
        let list = &mut self.at_rest;
        let mut kept = fit;
        match part {
            Part::UpperTeeth => kept = crowns(&of_head.upper_teeth, true, fit, list),
            Part::LowerTeeth => kept = crowns(&of_head.lower_teeth, false, fit, list),
            Part::UpperJaw => {
                let body = Body { at: &of_head.skull, indices: bones.skull.mesh().indices() };
                // What a lower tooth can come near to.
                let (back, top) = (targets.upper_last.z - 6.0 * self.unit, 9.0 * self.unit);
                let rim = |z: f32| {
                    let t = (z - targets.upper_last.z) / (targets.prosthion.z - targets.upper_last.z);
                    targets.upper_last.y + t.clamp(0.0, 1.0) * (targets.prosthion.y - targets.upper_last.y)
                };
                kept = cover(body, fit, true, |p| p.z > back && p.y < rim(p.z) + top, list);
            }
            Part::Mandible => {
                let body = Body { at: &of_head.mandible, indices: bones.mandible.mesh().indices() };
                kept = cover(body, fit, true, |_| true, list);
            }
            Part::Eyes => {
                for eye in eyes.iter() {
                    list.extend(eyeball(eye, fit.grow));
                }
            }
            Part::UpperLip | Part::LowerLip => {
                let rows = if part == Part::UpperLip { &lips.rows.upper } else { &lips.rows.lower };
                for row in rows {
                    let at: Vec<Vec3> = row.iter().map(|&v| lips.at[v as usize]).collect();
                    let own: Vec<u16> = (0..row.len())
                        .map(|k| {
                            let jaw = lips.weights[row[k] as usize];
                            let along = at[(k + 1).min(at.len() - 1)] - at[k.saturating_sub(1)];
                            // Rows run from right to left.
                            let outwards = Vec3::new(-along.z, 0.0, along.x).normalize_or(Vec3::Z);
                            let new = LipVertex { vertex: row[k], follow: Follow { jaw, ..Follow::SKULL }, outwards };
                            let known = self.lip.iter().position(|old| old.vertex == new.vertex);
                            known.unwrap_or_else(|| {
                                self.lip.push(new);
                                self.lip.len() - 1
                            }) as u16
                        })
                        .collect();
                    chain(&at, LIP_SPACING * self.unit, |side, t, centre| {
                        let ends = [own[side], own[side + 1]];
                        let [a, b] = ends.map(|v| self.lip[usize::from(v)].follow.jaw);
                        list.push(Sphere { centre, radius: fit.grow });
                        self.follow.push(Follow { jaw: a + t * (b - a), ..Follow::SKULL });
                        self.spans.push(Span { ends, t });
                    });
                }
            }
            Part::Tongue => kept = cover(*tongue, fit, true, |_| true, list),
        }
        let own = |sphere: &Sphere| match part {
            Part::UpperTeeth | Part::UpperJaw | Part::Eyes => Follow::SKULL,
            Part::Tongue => tongue_follow(self.tongue, sphere.centre.z),
            _ => Follow::MANDIBLE,
        };
        let new = &self.at_rest[self.follow.len()..];
        let follow: Vec<Follow> = new.iter().map(own).collect();
        self.follow.extend(follow);
        kept
    }

    /// Numbers of the spheres of a part.
    pub fn of(&self, part: Part) -> Range<usize> {
        self.starts[part as usize]..self.starts[part as usize + 1]
    }

    /// The part of a sphere.
    pub fn part(&self, sphere: usize) -> Part {
        let k = self.starts[1..Part::COUNT].partition_point(|&start| start <= sphere);
        Part::ALL[k]
    }

    /// Where each sphere of both lips hangs: the upper lip's, then the lower's.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// The vertices that spheres of the lips hang on.
    pub fn lip(&self) -> &[LipVertex] {
        &self.lip
    }

    /// The joints.
    pub fn joints(&self) -> Joints {
        self.joints
    }

    /// Where a sphere's centre is.
    pub fn centre(&self, sphere: usize, moved: &Moved) -> Vec3 {
        moved.carry(self.follow[sphere], self.at_rest[sphere].centre)
    }

    /// Where the parameters alone put every centre (`out`: as many as spheres).
    pub fn place(&self, moved: &Moved, out: &mut [Vec3]) {
        for ((to, sphere), &follow) in out.iter_mut().zip(&self.at_rest).zip(&self.follow) {
            *to = moved.carry(follow, sphere.centre);
        }
    }

    /// Puts the lips' centres where a posed skin has them (`skin`: as the skin at rest; `out`: as many as spheres).
    pub fn place_lips(&self, skin: &[Vec3], out: &mut [Vec3]) {
        let lips = self.of(Part::UpperLip).start..self.of(Part::LowerLip).end;
        for (to, span) in out[lips].iter_mut().zip(&self.spans) {
            let [a, b] = span.ends.map(|v| skin[self.lip[usize::from(v)].vertex as usize]);
            *to = a.lerp(b, span.t);
        }
    }

    /// How far the spheres of a part are from where the parameters alone put them, at most, metres; `centres`: as many as
    /// spheres.
    pub fn stray(&self, part: Part, moved: &Moved, centres: &[Vec3]) -> f32 {
        let off = |k: usize| self.centre(k, moved).distance(centres[k]);
        // What is no number strayed beyond any level.
        self.of(part).map(off).fold(0.0, |most, off| if off <= most { most } else { off })
    }

    /// How far along the tongue a point of it lies at rest: 0 at its root, 1 at its tip.
    pub fn along_tongue(&self, p: Vec3) -> f32 {
        along(self.tongue, p.z)
    }

    /// Half the tongue's width where a point of it lies at rest.
    pub fn tongue_half_width(&self, p: Vec3) -> f32 {
        let at = self.along_tongue(p) * (WIDTHS - 1) as f32;
        let k = (at as usize).min(WIDTHS - 2);
        self.widths[k] + (at - k as f32) * (self.widths[k + 1] - self.widths[k])
    }

    /// How a point of the tongue at rest follows.
    pub fn tongue_follow(&self, p: Vec3) -> Follow {
        tongue_follow(self.tongue, p.z)
    }
}

/// Half of how far the spheres of a lip stand apart at most, canonical millimetres: what is midway between two lies 0.4 mm
/// outside both.
const LIP_SPACING: f32 = 1.2;

/// Spheres of a jaw's crowns, tooth by tooth from the left first incisor backwards, each followed by its mirror image.
/// `at`: as [`teeth::place`] makes it.
fn crowns(at: &[Vec3], upper: bool, fit: Fit, out: &mut Vec<Sphere>) -> Fit {
    let indices = Bones::tooth_indices(upper);
    let n_left = at.len() / 2 / teeth::TOOTH_VERTICES;
    let per_tooth = indices.len() / (2 * n_left).max(1);
    let mut kept = fit;
    for (tooth, (at, indices)) in
        at.chunks(teeth::TOOTH_VERTICES).zip(indices.chunks(per_tooth)).take(n_left).enumerate()
    {
        let first = (tooth * teeth::TOOTH_VERTICES) as u32;
        let indices: Vec<u32> = indices.iter().map(|v| v - first).collect();
        let before = out.len();
        let own = cover(Body { at, indices: &indices }, fit, false, |_| true, out);
        kept = Fit { grow: kept.grow.max(own.grow), miss: kept.miss.max(own.miss), ..fit };
        for k in before..out.len() {
            out.push(out[k].mirrored());
        }
    }
    kept
}

/// The globe, and the cornea as the sphere through its apex and its limbus.
fn eyeball(eye: &Eye, grow: f32) -> [Sphere; 2] {
    let gaze = eye.axes[2];
    let apex = eye.reach(gaze);
    // Where the cornea meets the globe: so far along the gaze and so far off it.
    let limbus = eye.limbus()[0].max(eye.limbus()[1]);
    let (off, along) = (eye.radius * ops::sin(limbus), eye.radius * ops::cos(limbus));
    let height = (apex - along).max(1e-6);
    // The sphere of a cap of that height over that circle.
    let radius = (off * off + height * height) / (2.0 * height);
    let cornea = Sphere { centre: eye.centre + gaze * (apex - radius), radius: radius + grow };
    [Sphere { centre: eye.centre, radius: eye.radius + grow }, cornea]
}

/// The tongue's root and tip along the head.
fn ends(at: &[Vec3]) -> (f32, f32) {
    at.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), p| (low.min(p.z), high.max(p.z)))
}

/// Where along the tongue it begins to slide out, wholly does, and is free to bend; root 0, tip 1.
const SLIDES: [f32; 2] = [0.2, 0.6];
const FREE: f32 = 0.45;

fn along([root, tip]: [f32; 2], z: f32) -> f32 {
    ((z - root) / (tip - root).max(1e-6)).clamp(0.0, 1.0)
}

fn tongue_follow(tongue: [f32; 2], z: f32) -> Follow {
    let along = along(tongue, z);
    let ramp = |from: f32, to: f32| ((along - from) / (to - from)).clamp(0.0, 1.0);
    Follow { jaw: 1.0, out: ramp(SLIDES[0], SLIDES[1]), lift: ramp(FREE, 1.0) }
}

/// Places at which the tongue's width is kept.
const WIDTHS: usize = 17;

/// At each place the widest of the vertices nearer to it than its neighbours are.
fn half_widths(at: &[Vec3], tongue: [f32; 2]) -> [f32; WIDTHS] {
    let mut widths = [0.0_f32; WIDTHS];
    for p in at {
        let place = along(tongue, p.z) * (WIDTHS - 1) as f32;
        let k = (place as usize).min(WIDTHS - 2);
        for k in [k, k + 1] {
            widths[k] = widths[k].max(p.x.abs());
        }
    }
    widths
}

/// Middle of the tongue's height where it begins to be free.
fn pivot(at: &[Vec3], root: f32, tip: f32) -> Vec3 {
    let z = root + FREE * (tip - root);
    let near = at.iter().filter(|p| (p.z - z).abs() < 0.04 * (tip - root));
    let (low, high) = near.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), p| (l.min(p.y), h.max(p.y)));
    Vec3::new(0.0, if low <= high { 0.5 * (low + high) } else { 0.0 }, z)
}
