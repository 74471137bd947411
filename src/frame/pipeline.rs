//! The frame's inner loop: a breed in, drawable parts out. Owns every buffer; in the steady state
//! it allocates nothing but the list of parts that a frame lends out.
//!
//! Lifetimes: the plan of a level until another is asked for; shape buffers written when the values changed; colours when
//! the look did.

use super::canvas::Canvas;
use super::dyes::Dyes;
use super::eyeball::Eyeball;
use super::eyelids::EyelidParts;
use super::folds::Folds;
use super::layers::Layers;
use super::mouth::MouthParts;
use super::muscles::MuscleParts;
use super::parts::{Frame, Material, Revisions};
use super::skeleton::Skeleton;
use super::uv::Uv;
use super::values::Values;
use super::whiskers::WhiskerParts;
use super::wrinkles::wrinkle;
use super::{StageHashes, cap, eyeball, skin};
use crate::anatomy::{Breed, Look};
use crate::coat::{self, Coat, Groom, Root};
use crate::math::fnv::Fnv64;
use crate::motion::{Channel, Pose};
use crate::rig::{ControlError, Deformed, Places, Rig, deform};
use crate::subdiv::{Evaluator, FaceVaryingError, Plan, PlanError, PlanOptions, Scheme, evaluate_once};
use glam::Vec3;
use std::sync::Arc;

/// Deepest level of subdivision that a pipeline makes.
pub const MAX_LEVEL: u32 = 5;

/// The level from which on vertices are dense enough for wrinkles.
const WRINKLED: u32 = 3;

/// A head unit of the base head, metres.
const CENTIMETRE: f32 = 0.01;

/// Why a pipeline cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// Deeper than a head needs.
    #[error("subdivision level is {0}, allowed 0 to {MAX_LEVEL}")]
    Level(u32),
    /// The plan cannot be built.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A baked asset is none, or a mesh lacks what a part stands on.
    #[error(transparent)]
    Baked(#[from] ControlError),
    /// The charts of the skin do not fit its plan.
    #[error(transparent)]
    Uv(#[from] FaceVaryingError),
}

/// From breeds to frames.
pub struct Pipeline {
    rig: Arc<Rig>,
    level: u32,
    threads: usize,
    plan: Arc<Plan>,
    evaluator: Evaluator,
    deformed: Deformed,
    control_flow: Vec<Vec3>,
    control_leathers: Vec<Vec3>,
    control_bare: Vec<Vec3>,
    control_surface: Vec<Vec3>,
    /// How much the skin is pressed together, at control vertices and on the refined skin.
    pressed: [Vec<Vec3>; 2],
    /// Whether the last frame's skin has more form than its control positions tell.
    is_wrinkled: bool,
    /// Those of the skin at rest.
    folds: Folds,
    parts: [Values; 4],
    eyelids: EyelidParts,
    /// Left and right.
    eyeballs: [Eyeball; 2],
    /// How much wider the pupils are than at rest, parts of the iris' width.
    widened: [f32; 2],
    whiskers: WhiskerParts,
    layers: Layers,
    /// Whether parts have texture coordinates.
    uv: bool,
    /// Once bone or teeth are asked for.
    skeleton: Option<Skeleton>,
    /// Once they are asked for.
    muscles: Option<MuscleParts>,
    /// Once mouth or tongue are asked for.
    mouth: Option<MouthParts>,
    dyes: Dyes,
    hair: HairValues,
    values: Vec<f32>,
    pose: Pose,
    /// The pose of the last frame.
    posed: Pose,
    look: Option<Look>,
    /// How much of the lower lids' lining the last frame shows, 0 to 1.
    haw: f32,
    /// How much the coat of the last frame is a puppy's, 0 to 1.
    youth: f32,
    revisions: Revisions,
}

/// What frames tell of hair; no roots until hair is asked for.
#[derive(Default)]
struct HairValues {
    /// How many strands are wanted.
    n_strands: usize,
    /// Of this level.
    roots: Vec<Root>,
    /// One for each root.
    colours: Vec<Vec3>,
    /// What is groomed at the control vertices.
    control: [Vec<Vec3>; coat::N_CHANNELS],
    /// The same at the vertices of the skin.
    refined: [Vec<Vec3>; coat::N_CHANNELS],
    /// One for each vertex of the skin.
    grooms: Vec<Groom>,
}

impl Pipeline {
    /// Builds the plan of a level (0 to [`MAX_LEVEL`]).
    ///
    /// # Errors
    /// A level that is too deep; a control mesh that lacks what a part stands on.
    pub fn new(rig: Arc<Rig>, level: u32) -> Result<Self, PipelineError> {
        let plan = Self::plan(&rig, level)?;
        let n = rig.mesh().n_vertices();
        let parts = Self::parts(&rig, &plan);
        Ok(Self {
            evaluator: Evaluator::new(&plan),
            level,
            threads: 1,
            deformed: Deformed::default(),
            control_flow: vec![Vec3::ZERO; n],
            control_leathers: vec![Vec3::ZERO; n],
            control_bare: vec![Vec3::ZERO; n],
            control_surface: vec![Vec3::ZERO; n],
            pressed: [vec![Vec3::ZERO; n], Vec::new()],
            is_wrinkled: false,
            folds: Folds::default(),
            parts,
            eyelids: EyelidParts::new(&rig)?,
            eyeballs: Default::default(),
            widened: [0.0; 2],
            whiskers: WhiskerParts::new(&rig, &plan)?,
            layers: Layers::default(),
            uv: false,
            skeleton: None,
            muscles: None,
            mouth: None,
            dyes: Dyes::default(),
            hair: HairValues::default(),
            values: Vec::new(),
            pose: Pose::default(),
            posed: Pose::default(),
            look: None,
            haw: 0.0,
            youth: 0.0,
            revisions: Revisions { topology: 1, shape: 0, look: 0 },
            plan: Arc::new(plan),
            rig,
        })
    }

    fn plan(rig: &Rig, level: u32) -> Result<Plan, PipelineError> {
        if level > MAX_LEVEL {
            return Err(PipelineError::Level(level));
        }
        Ok(Plan::build_with(rig.mesh(), &skin::tags(rig), &PlanOptions::new(Scheme::Sqrt3, level))?)
    }

    fn parts(rig: &Rig, plan: &Plan) -> [Values; 4] {
        let mut skin = Values::new(skin::topology(rig, plan));
        let (rest, _) = evaluate_once(plan, &rig.base());
        skin.rest = rest.into_iter().map(|p| p * CENTIMETRE).collect();
        [
            skin,
            Values::new(cap::topology(plan)),
            Values::new(eyeball::topology("eye_L")),
            Values::new(eyeball::topology("eye_R")),
        ]
    }

    /// The level of subdivision.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Changes the level; the next frame has another topology. The last one stays if this fails.
    ///
    /// # Errors
    /// A level that is too deep.
    pub fn set_level(&mut self, level: u32) -> Result<(), PipelineError> {
        if level == self.level {
            return Ok(());
        }
        let plan = Self::plan(&self.rig, level)?;
        self.whiskers = WhiskerParts::new(&self.rig, &plan)?;
        self.parts = Self::parts(&self.rig, &plan);
        self.folds = Folds::default();
        self.evaluator = Evaluator::new(&plan);
        self.evaluator.set_threads(self.threads);
        self.plan = Arc::new(plan);
        self.level = level;
        self.revisions.topology += 1;
        self.values.clear();
        self.look = None;
        self.dyes.forget();
        self.root_hair();
        let wants_uv = std::mem::take(&mut self.uv);
        self.set_uv(wants_uv)
    }

    /// Whether the next frames have texture coordinates. They cost nothing a frame, but something at each change of the
    /// level.
    ///
    /// # Errors
    /// Where the baked charts do not fit the mesh.
    pub fn set_uv(&mut self, wanted: bool) -> Result<(), PipelineError> {
        if wanted != self.uv {
            let [skin, _, left, right] = &mut self.parts;
            skin.uv = wanted.then(|| Uv::of_skin(&self.rig, &self.plan)).transpose()?;
            left.uv = wanted.then(|| eyeball::uv(&left.topology));
            right.uv = wanted.then(|| eyeball::uv(&right.topology));
            self.uv = wanted;
        }
        Ok(())
    }

    /// Which layers the next frames have. What is there of the skin, the eyes and the whiskers is evaluated in any case;
    /// what lies deeper only when it is asked for.
    ///
    /// # Errors
    /// Where a baked bone is none.
    pub fn set_layers(&mut self, layers: Layers) -> Result<(), PipelineError> {
        let shown = |l: Layers| Layers { skin: f32::from(u8::from(l.skin > 0.0)), ..l };
        let deep = |l: Layers| [l.bone || l.teeth, l.mouth || l.tongue, l.muscles];
        let [bone, mouth, muscles] = deep(layers);
        if bone && self.skeleton.is_none() {
            self.skeleton = Some(Skeleton::new()?);
        }
        if muscles && self.muscles.is_none() {
            self.muscles = Some(MuscleParts::new(&self.rig)?);
        }
        if mouth && self.mouth.is_none() {
            self.mouth = Some(MouthParts::new()?);
            self.look = None;
        }
        if deep(self.layers).iter().zip([bone, mouth, muscles]).any(|(had, wants)| wants && !had) {
            self.values.clear();
        }
        if shown(layers) != shown(self.layers) {
            self.revisions.topology += 1;
        }
        self.layers = layers;
        Ok(())
    }

    /// What the dog does in the next frames, inside the limits of its joints; at rest until this is called.
    pub fn set_pose(&mut self, pose: Pose) {
        self.pose = pose;
    }

    /// Which layers a frame has.
    pub fn layers(&self) -> Layers {
        self.layers
    }

    /// How many strands of hair the next frames have, at most [`coat::MAX_STRANDS`]; at first none. They have
    /// [`coat::n_rooted`] roots, of which a picture draws the others along its outline. They cost nothing a frame, but
    /// something at each change of the level.
    pub fn set_hair(&mut self, n_strands: usize) {
        if n_strands != self.hair.n_strands {
            self.hair.n_strands = n_strands;
            self.root_hair();
        }
    }

    /// Makes the roots that are wanted on the skin of this level; they are painted with the next frame.
    fn root_hair(&mut self) {
        self.hair.roots.clear();
        self.dyes.forget_hair();
        self.look = None;
        if self.hair.n_strands > 0 {
            let topology = &self.parts[0].topology;
            let triangles = topology.indices.as_chunks::<3>().0;
            let is_haired: Vec<bool> = topology
                .ranges
                .iter()
                .flat_map(|r| std::iter::repeat_n(r.material == Material::Coat, r.count as usize / 3))
                .collect();
            self.hair.roots =
                coat::roots(&self.rig, &self.plan, triangles, &is_haired, coat::n_rooted(self.hair.n_strands));
        }
    }

    /// Threads that evaluate; the bits do not depend on it.
    pub fn set_threads(&mut self, n: usize) {
        self.threads = n;
        self.evaluator.set_threads(n);
    }

    /// The skin's plan.
    pub fn skin_plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// The rig.
    pub fn rig(&self) -> &Arc<Rig> {
        &self.rig
    }

    /// The head of a breed. Recomputes what has changed since the last call and lends out the result.
    ///
    /// `breed.values` has one value for each row of the table that the rig was made for.
    pub fn update(&mut self, breed: &Breed) -> Frame<'_> {
        let is_other = self.values != breed.values;
        if is_other {
            self.rig.deform(&breed.values, deform::ROUNDS, &mut self.deformed);
            self.values.clone_from(&breed.values);
        }
        if is_other || self.posed != self.pose {
            self.rig.pose(&breed.values, &self.pose, &mut self.deformed);
            self.posed = self.pose;
            self.shape(&breed.values, is_other);
            self.revisions.shape += 1;
        }
        let haw = self.rig.seen_conjunctiva(&breed.values);
        if self.look.as_ref() != Some(&breed.look) || self.haw != haw {
            self.haw = haw;
            self.paint(&breed.look);
            self.look = Some(breed.look.clone());
            self.revisions.look += 1;
        }
        self.eyeballs = self.open_eyes(&breed.look);
        self.frame()
    }

    /// The eyes between the lids as they are now.
    fn open_eyes(&self, look: &Look) -> [Eyeball; 2] {
        let inner = self.rig.plan().handles().ei;
        let skin = &self.parts[0].positions;
        let sides = [inner.map(usize::from), inner.map(|v| self.rig.image(usize::from(v)))];
        let [left, right] = self.deformed.eyes;
        let widened = self.widened;
        [(left, widened[0], sides[0]), (right, widened[1], sides[1])]
            .map(|(eye, widened, margins)| Eyeball::new(eye, look.iris, widened, margins.map(|v| skin[v])))
    }

    /// Where the rigid parts of the last frame are.
    pub fn places(&self) -> Places {
        self.deformed.places
    }

    /// The last frame again.
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            parts: self.shown().map(Values::part).collect(),
            control: &self.deformed.control,
            control_indices: self.rig.mesh().indices(),
            plan: Some(&*self.plan).filter(|_| self.layers.skin > 0.0),
            is_planned: !self.is_wrinkled,
            whiskers: if self.layers.whiskers { &self.whiskers.whiskers } else { &[] },
            eyes: if self.layers.eyes { &self.eyeballs } else { &[] },
            coat: self.coat(),
            revisions: self.revisions,
        }
    }

    /// The colours of the last frame's skin between its vertices; none before the first frame.
    pub fn canvas(&self) -> Option<Canvas<'_>> {
        let (chart, look) = (self.dyes.known_chart()?, self.look.as_ref()?);
        Some(Canvas::new(&self.rig, &self.plan, chart, look, [&self.control_leathers, &self.control_bare]))
    }

    fn coat(&self) -> Option<Coat<'_>> {
        let HairValues { roots, colours, grooms, .. } = &self.hair;
        let look = self.look.as_ref().filter(|_| self.layers.skin > 0.0)?;
        Some(Coat { roots, colours, grooms, hair: &look.hair, youth: self.youth })
    }

    /// The parts of the layers, in the written order.
    fn shown(&self) -> impl Iterator<Item = &Values> {
        let Layers { skin, eyes, whiskers, muscles, bone, teeth, mouth, tongue } = self.layers;
        let own = [skin > 0.0, skin > 0.0, eyes, eyes];
        let own = self.parts.iter().zip(own).filter(|(_, shown)| *shown).map(|(part, _)| part);
        let lids = self.eyelids.parts().filter(move |_| eyes);
        let whiskers = Some(&self.whiskers.values).filter(|_| whiskers);
        let muscles = self.muscles.iter().filter(move |_| muscles).map(|m| &m.values);
        let bones = self.skeleton.iter().flat_map(move |s| s.parts(bone, teeth));
        let mouth = self.mouth.iter().flat_map(move |m| m.parts(mouth, tongue));
        own.chain(lids).chain(whiskers).chain(muscles).chain(bones).chain(mouth)
    }

    /// `is_other`: whether the values changed, not the pose alone.
    fn shape(&mut self, values: &[f32], is_other: bool) {
        let [skin, cap, left, right] = &mut self.parts;
        self.evaluator.evaluate_into(&self.plan, &self.deformed.control, &mut skin.positions, &mut skin.normals);
        if is_other {
            let shown = self.level >= WRINKLED;
            self.folds.shape(&self.rig, &self.plan, &skin.rest, values, shown);
        }
        self.folds.raise(self.plan.indices(), skin);
        let pressed = &mut self.pressed;
        self.is_wrinkled =
            self.level >= WRINKLED && self.rig.pressed(values, &self.pose, &mut self.deformed, &mut pressed[0]);
        if self.is_wrinkled {
            let [control, refined] = pressed;
            refined.resize(self.plan.n_vertices(), Vec3::ZERO);
            self.evaluator.evaluate_attribute(&self.plan, control, refined);
            let size = self.rig.of_head(values, &mut self.deformed).unit / 0.001;
            wrinkle(skin, refined, &self.deformed.places.head.turn, size);
        }
        self.is_wrinkled |= self.folds.is_there();
        self.rig.flow(&self.deformed.control, &mut self.control_flow);
        self.evaluator.evaluate_attribute(&self.plan, &self.control_flow, &mut skin.flow);
        cap::place(&self.plan, skin, cap);
        let possible = self.rig.posing().possible(&self.pose);
        self.widened = possible.channel(Channel::Pupil).map(eyeball::widened);
        for ((eye, &widened), part) in self.deformed.eyes.iter().zip(&self.widened).zip([left, right]) {
            eyeball::place(eye, widened, &mut part.positions, &mut part.normals);
        }
        let (measures, proportions) = (self.rig.measures(values), self.rig.proportions(values));
        self.youth = self.rig.youth(values);
        let alike = self.pose.is_rest();
        let places = self.deformed.places;
        let eyes = (&self.deformed.eyes, possible.channel(Channel::LidClosed));
        self.eyelids.shape(&proportions, eyes, &skin.positions, &places.head, alike);
        self.whiskers.shape(skin, proportions.scale, alike);
        let Layers { muscles, bone, teeth, mouth, tongue, .. } = self.layers;
        let head = Some((&measures, &proportions)).filter(|_| is_other);
        if let Some(skeleton) = self.skeleton.as_mut().filter(|_| bone || teeth) {
            skeleton.shape(head, &places);
        }
        if let Some(part) = self.muscles.as_mut().filter(|_| muscles) {
            part.shape(&self.rig, values, &self.pose, &mut self.deformed);
        }
        if let Some(inside) = self.mouth.as_mut().filter(|_| mouth || tongue) {
            let of_head = self.rig.of_head(values, &mut self.deformed);
            let size = (of_head.unit, of_head.front);
            inside.shape(head, &possible, &places, size);
        }
    }

    fn paint(&mut self, look: &Look) {
        let Self { control_leathers: leathers, control_bare: bare, control_surface, .. } = self;
        skin::paint(&self.rig, look, self.haw, leathers, bare, control_surface);
        let [skin, cap, left, right] = &mut self.parts;
        self.evaluator.evaluate_attribute(&self.plan, control_surface, &mut skin.surface);
        let HairValues { roots, colours: of_hair, control, refined, grooms, .. } = &mut self.hair;
        let hairs = (&roots[..], skin.topology.indices.as_chunks::<3>().0);
        self.dyes.paint(&self.rig, &self.plan, look, hairs, self.threads, &mut skin.colours, of_hair);
        self.whiskers.paint(&skin.colours);
        cap::paint(&self.plan, skin, cap);
        for values in &mut *refined {
            values.resize(self.plan.n_vertices(), Vec3::ZERO);
        }
        // Two buffers that hold something else from here on.
        let [refined_leathers, refined_bare, ..] = &mut *refined;
        for (control, refined) in [(leathers, &mut *refined_leathers), (bare, &mut *refined_bare)] {
            self.evaluator.evaluate_attribute(&self.plan, control, refined);
        }
        skin::put_leather_on(&mut skin.colours, refined_leathers, refined_bare);
        let surface = &self.control_surface;
        coat::groom(&self.rig, &look.hair, |v| surface[v].z, control);
        for (control, refined) in control.iter().zip(&mut *refined) {
            self.evaluator.evaluate_attribute(&self.plan, control, refined);
        }
        let flow = self.dyes.chart(&self.rig, &self.plan).flow();
        grooms.clear();
        grooms.extend((0..flow.len()).map(|v| Groom::of_channels(refined.each_ref().map(|r| r[v]), flow[v])));
        for eye in [left, right] {
            eyeball::colours(look.iris, &mut eye.colours);
            eye.surface.fill(Vec3::new(0.0, 1.0, 0.0));
        }
        self.eyelids.paint(look);
        if let Some(inside) = &mut self.mouth {
            inside.paint(look);
        }
    }

    /// One hash for each stage of the last frame: every part in the written order, vertices in canonical order.
    pub fn hashes(&self) -> StageHashes {
        let mut control = Fnv64::new();
        vectors(&mut control, &self.deformed.control);
        for eye in &self.deformed.eyes {
            vectors(&mut control, &[eye.centre]);
            control.f32(eye.radius);
            vectors(&mut control, &eye.axes);
        }
        let (mut positions, mut normals, mut indices) = (Fnv64::new(), Fnv64::new(), Fnv64::new());
        for part in self.shown() {
            vectors(&mut positions, &part.positions);
            vectors(&mut normals, &part.normals);
        }
        for part in self.shown() {
            // The plan's own order, whatever order materials are drawn in.
            let own = if part.topology.name == "skin" { self.plan.indices() } else { &part.topology.indices };
            own.iter().for_each(|&i| indices.u32(i));
        }
        StageHashes {
            control: control.finish(),
            positions: positions.finish(),
            normals: normals.finish(),
            indices: indices.finish(),
        }
    }
}

fn vectors(hash: &mut Fnv64, vs: &[Vec3]) {
    for v in vs {
        for x in v.to_array() {
            hash.f32(x);
        }
    }
}
