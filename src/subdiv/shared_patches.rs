//! Patches of control triangles that share their rows, sixteen side by side.
//!
//! The rows of the vertices over a control triangle depend on the valences, boundaries and tags around its three corners
//! alone, so triangles whose corners agree in these are of one class: the same rows over other control vertices. A class
//! keeps them once, step by step, with numbers of its own; its triangles are evaluated sixteen at a time, one in each lane.
//! A few kilobytes of rows then stand for the tables of all steps, everything between control points and result stays in
//! the first cache, and what a frame moves is little more than what it delivers.
//!
//! That one ring is enough is a property of Loop: a corner's neighbours matter by their place, not by their own rings
//! (Loop 1987: a patch depends on the vertices of the triangles that touch it). √3 reaches farther.

use std::collections::{BTreeMap, BTreeSet};

use crate::mesh::{DedgeId, DedgeMesh, FaceId, VertexId};

use super::level::Sharpness;
use super::limit::LimitTable;
use super::normals::Rings;
use super::plan::Plan;
use super::scheme::{Normals, Positions, Scheme, Split};
use super::stencil::{StencilBuilder, StencilTable};
use super::tags::Tags;

/// Triangles side by side.
pub(super) const LANES: usize = 16;

/// Fewest steps at which sharing gains where normals are wanted, and where they are not: borders, which triangles share and
/// patches do not, weigh too much below.
const MIN_LEVELS: [u32; 2] = [3, 4];
/// Most steps: what all of them keep for a class must stay in the caches.
const MAX_LEVELS: u32 = 6;
/// Most places for each triangle, empty ones counted: beyond, classes are too many for the mesh.
const MAX_PLACES: f64 = 1.6;

const NONE: u32 = u32::MAX;

/// The rows of one kind of triangle. Numbers are local: of the control vertices around it, then of those of each level that
/// the next one needs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Class {
    /// One for each step. The first `n_rows` rows of the last are the patch itself.
    pub(super) steps: Vec<StencilTable>,
    /// Vertices of the patch, borders included.
    pub(super) n_rows: usize,
    /// For the rows of the patch, over those of the last step.
    pub(super) limit: Option<LimitTable>,
    /// Likewise, for normals from faces.
    pub(super) rings: Option<Rings>,
}

impl Class {
    /// Control vertices around the triangle.
    pub(super) fn n_sources(&self) -> usize {
        self.steps[0].n_sources()
    }
}

/// Sixteen triangles of one class; those that are missing repeat the last and deliver nothing.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Group {
    pub(super) class: u32,
    pub(super) first_source: u32,
    /// Deliveries end where those of the next group begin.
    pub(super) first_delivery: u32,
}

/// A vertex of the last level, and which row of which lane it is.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Delivery {
    /// Three times [`LANES`] for each row before it, and the lane: where its x stands among the blocks of the patch.
    pub(super) place: u32,
    pub(super) vertex: u32,
}

/// All patches of a plan.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SharedPatches {
    pub(super) n_control: usize,
    pub(super) n_vertices: usize,
    pub(super) classes: Vec<Class>,
    pub(super) groups: Vec<Group>,
    /// For each group the control vertices of its class, each for all lanes.
    pub(super) sources: Vec<u32>,
    /// Each vertex of the last level, once: patches share their borders, and the first triangle delivers them.
    pub(super) deliveries: Vec<Delivery>,
}

impl SharedPatches {
    /// The patches of a finished plan, given what it was built from and the sharpness of its level 0; none where sharing gains
    /// nothing.
    pub(super) fn build(control: &DedgeMesh, tags: &Tags, sharpness: &Sharpness, plan: &Plan) -> Option<SharedPatches> {
        let options = plan.options();
        let levels = options.levels;
        let pushes = options.positions == Positions::Limit;
        let has_sharp_tags = !(tags.creases.is_empty() && tags.corners.is_empty());
        let min_levels = MIN_LEVELS[usize::from(options.normals == Normals::None)];
        if options.scheme != Scheme::Loop
            || !(min_levels..=MAX_LEVELS).contains(&levels)
            || !(tags.holes.is_empty() && tags.frozen.is_empty())
            || (pushes && options.normals == Normals::Faces)
            // On which side of a crease a limit normal stands is the tables' choice, not one of the surroundings.
            || (has_sharp_tags && options.normals == Normals::Limit)
            || plan.tables.len() != levels as usize
        {
            return None;
        }
        let kinds = Kinds::sort(control, sharpness);
        let n_groups: usize = kinds.faces.iter().map(|faces| faces.len().div_ceil(LANES)).sum();
        if (n_groups * LANES) as f64 > MAX_PLACES * control.n_faces() as f64 {
            return None;
        }
        Some(Builder::new(control, plan, kinds).finish())
    }

    /// What a group delivers.
    pub(super) fn deliveries_of(&self, group: usize) -> &[Delivery] {
        let end = self.groups.get(group + 1).map_or(self.deliveries.len(), |next| next.first_delivery as usize);
        &self.deliveries[self.groups[group].first_delivery as usize..end]
    }

    /// The control vertices of a group, each for all lanes.
    pub(super) fn sources_of(&self, group: Group) -> &[u32] {
        let n = LANES * self.classes[group.class as usize].n_sources();
        &self.sources[group.first_source as usize..][..n]
    }

    /// Bytes of all of it.
    pub(super) fn n_bytes(&self) -> usize {
        let class = |class: &Class| {
            class.steps.iter().map(StencilTable::n_bytes).sum::<usize>()
                + class.limit.as_ref().map_or(0, LimitTable::n_bytes)
                + class.rings.as_ref().map_or(0, Rings::n_bytes)
        };
        self.classes.iter().map(class).sum::<usize>()
            + size_of_val(&self.groups[..])
            + size_of_val(&self.sources[..])
            + size_of_val(&self.deliveries[..])
    }

    /// Whether everything that an evaluation relies on holds: numbers are below their bounds, and each vertex is delivered
    /// once. Tables must have been checked on their own.
    pub(super) fn is_sound(&self) -> bool {
        let class_is_sound = |class: &Class| {
            let chained = class.steps.windows(2).all(|pair| pair[0].n_rows() == pair[1].n_sources());
            let n_last = class.steps.last().map_or(0, StencilTable::n_rows);
            let below = |sources: &[u32]| sources.iter().all(|&s| (s as usize) < n_last);
            chained
                && !class.steps.is_empty()
                && class.n_rows <= n_last
                && class.limit.as_ref().is_none_or(|limit| limit.n_rows == class.n_rows && below(&limit.sources))
                && class.rings.as_ref().is_none_or(|rings| rings.n_vertices == class.n_rows && below(&rings.neighbours))
        };
        if !self.classes.iter().all(class_is_sound) || self.sources.iter().any(|&s| s as usize >= self.n_control) {
            return false;
        }
        let (mut source, mut n_there) = (0, 0);
        let mut is_there = vec![false; self.n_vertices];
        for (i, group) in self.groups.iter().enumerate() {
            let Some(class) = self.classes.get(group.class as usize) else { return false };
            let end = self.groups.get(i + 1).map_or(self.deliveries.len(), |next| next.first_delivery as usize);
            let first = group.first_delivery as usize;
            let Some(deliveries) = self.deliveries.get(first..end) else { return false };
            if group.first_source as usize != source || first != n_there {
                return false;
            }
            source += LANES * class.n_sources();
            n_there = end;
            for delivery in deliveries {
                let place = delivery.place as usize;
                let is_new =
                    is_there.get_mut(delivery.vertex as usize).is_some_and(|there| !std::mem::replace(there, true));
                if !is_new || place % (3 * LANES) >= LANES || place / (3 * LANES) >= class.n_rows {
                    return false;
                }
            }
        }
        source == self.sources.len() && n_there == self.n_vertices && n_there == self.deliveries.len()
    }
}

/// Triangles sorted by what lies around their corners.
struct Kinds {
    /// Of each kind the triangles, in order, each with the corner that comes first.
    faces: Vec<Vec<(FaceId, u8)>>,
    /// Of each kind the control vertices around its triangles, one triangle after another, and how many each has.
    around: Vec<Vec<u32>>,
}

impl Kinds {
    fn sort(control: &DedgeMesh, sharpness: &Sharpness) -> Kinds {
        let label = vec![NONE; control.n_vertices()];
        let mut surroundings = Surroundings { mesh: control, sharpness, label };
        let mut kinds = Kinds { faces: Vec::new(), around: Vec::new() };
        let mut numbers: BTreeMap<Vec<u32>, usize> = BTreeMap::new();
        for face in control.faces() {
            // Whichever corner comes first: the least key names the kind.
            let keys = [0, 1, 2].map(|turn: u8| (surroundings.key(face, turn), turn));
            let [a, b, c] = keys;
            let ((key, around), turn) = a.min(b).min(c);
            let next = numbers.len();
            let kind = *numbers.entry(key).or_insert(next);
            if kind == next {
                kinds.faces.push(Vec::new());
                kinds.around.push(Vec::new());
            }
            kinds.faces[kind].push((face, turn));
            kinds.around[kind].extend(around);
        }
        kinds
    }
}

/// Writes down what lies around the corners of a triangle.
struct Surroundings<'a> {
    mesh: &'a DedgeMesh,
    sharpness: &'a Sharpness,
    /// Local numbers; none between calls.
    label: Vec<u32>,
}

impl Surroundings<'_> {
    /// Equal for triangles with the same rows; and the control vertices in the order in which they are met.
    fn key(&mut self, face: FaceId, turn: u8) -> (Vec<u32>, Vec<u32>) {
        let mesh = self.mesh;
        let (mut key, mut around) = (Vec::with_capacity(32), Vec::with_capacity(16));
        let sides = [0, 1, 2].map(|k| face.dedge((u32::from(turn) + k) % 3));
        for side in sides {
            self.meet(mesh.origin(side), &mut around);
        }
        for start in sides {
            let corner = mesh.origin(start);
            if !self.sharpness.is_empty() {
                key.push(self.sharpness.vertex(corner).to_bits());
            }
            let opening = key.len();
            key.push(0);
            // Counter-clockwise, and at a boundary what lies the other way.
            let mut dedge = start;
            let is_closed = loop {
                self.spoke(dedge, mesh.target(dedge), &mut key, &mut around);
                match mesh.twin(dedge.prev()) {
                    Some(onward) if onward == start => break true,
                    Some(onward) => dedge = onward,
                    None => break false,
                }
            };
            if !is_closed {
                self.spoke(dedge.prev(), mesh.origin(dedge.prev()), &mut key, &mut around);
                key.push(NONE);
                dedge = start;
                while let Some(twin) = mesh.twin(dedge) {
                    dedge = twin.next();
                    self.spoke(dedge, mesh.target(dedge), &mut key, &mut around);
                }
            }
            key[opening] = 2 * (key.len() - opening) as u32 + u32::from(is_closed);
        }
        around.iter().for_each(|&v| self.label[v as usize] = NONE);
        (key, around)
    }

    fn spoke(&mut self, dedge: DedgeId, end: VertexId, key: &mut Vec<u32>, around: &mut Vec<u32>) {
        let label = self.meet(end, around);
        key.push(label);
        if !self.sharpness.is_empty() {
            key.push(self.sharpness.dedge(dedge).to_bits());
        }
    }

    fn meet(&mut self, vertex: VertexId, around: &mut Vec<u32>) -> u32 {
        let label = &mut self.label[vertex.index()];
        if *label == NONE {
            *label = around.len() as u32;
            around.push(vertex.0);
        }
        *label
    }
}

/// The children of a triangle after some steps, in the order in which they come when corner `turn` comes first, each with
/// its own corner that comes first.
pub(super) fn child_order(split: Split, levels: u32, turn: u8) -> Vec<(usize, u8)> {
    let mut order = vec![(0, turn)];
    for _ in 0..levels {
        let children = |(parent, turn): (usize, u8)| {
            let outer = (0..3).map(move |k| usize::from((k + turn) % 3));
            let (n, middle) = match split {
                Split::Quarters => (4, Some((3, turn))),
                _ => (3, None),
            };
            outer.map(|k| (k, 0)).chain(middle).map(move |(k, turn)| (n * parent + k, turn)).collect::<Vec<_>>()
        };
        order = order.into_iter().flat_map(children).collect();
    }
    order
}

struct Builder<'a> {
    plan: &'a Plan,
    kinds: Kinds,
    /// For each corner that may come first, where the vertices of a patch stand among the corners of its faces.
    corners: [Vec<usize>; 3],
    /// For each vertex of a level its local number while a class is made.
    local: Vec<u32>,
    patches: SharedPatches,
}

/// A group before its place is known.
struct Draft {
    kind: usize,
    /// Its first triangle, among those of the kind.
    first: usize,
}

impl Builder<'_> {
    fn new<'a>(control: &DedgeMesh, plan: &'a Plan, kinds: Kinds) -> Builder<'a> {
        let levels = plan.options().levels;
        let n_children = 1 << (2 * levels);
        let indices = &plan.indices()[..3 * n_children];
        let corners = [0, 1, 2].map(|turn| {
            let mut seen = BTreeSet::new();
            child_order(Split::Quarters, levels, turn)
                .into_iter()
                .flat_map(|(child, turn)| (0..3).map(move |c| 3 * child + (usize::from(turn) + c) % 3))
                .filter(|&corner| seen.insert(indices[corner]))
                .collect()
        });
        Builder {
            plan,
            kinds,
            corners,
            local: vec![NONE; plan.n_vertices()],
            patches: SharedPatches {
                n_control: control.n_vertices(),
                n_vertices: plan.n_vertices(),
                classes: Vec::new(),
                groups: Vec::new(),
                sources: Vec::new(),
                deliveries: Vec::new(),
            },
        }
    }

    fn finish(mut self) -> SharedPatches {
        // Where each vertex of a patch went among the rows of its class.
        let places: Vec<Vec<u32>> = (0..self.kinds.faces.len()).map(|kind| self.class(kind)).collect();
        let owner = self.owners();
        let mut drafts: Vec<Draft> = (0..self.kinds.faces.len())
            .flat_map(|kind| (0..self.kinds.faces[kind].len()).step_by(LANES).map(move |first| Draft { kind, first }))
            .collect();
        // Neighbours in the mesh stay neighbours in time.
        drafts.sort_by_key(|draft| self.kinds.faces[draft.kind][draft.first].0);
        for Draft { kind, first } in drafts {
            let class = &self.patches.classes[kind];
            let members = &self.kinds.faces[kind];
            let members = &members[first..members.len().min(first + LANES)];
            let n_around = class.n_sources();
            let around = &self.kinds.around[kind];
            self.patches.groups.push(Group {
                class: kind as u32,
                first_source: self.patches.sources.len() as u32,
                first_delivery: self.patches.deliveries.len() as u32,
            });
            for source in 0..n_around {
                let of_lane = |lane: usize| around[(first + lane.min(members.len() - 1)) * n_around + source];
                self.patches.sources.extend((0..LANES).map(of_lane));
            }
            let mut deliveries: Vec<Delivery> = Vec::new();
            for (lane, &(face, turn)) in members.iter().enumerate() {
                let vertices = self.vertices_of(face, turn);
                let own = vertices.zip(&places[kind]).filter(|(vertex, _)| owner[*vertex as usize] == face.0);
                let place = |row: u32| 3 * LANES as u32 * row + lane as u32;
                let first = deliveries.len();
                deliveries.extend(own.map(|(vertex, &row)| Delivery { place: place(row), vertex }));
                // As they lie in memory.
                deliveries[first..].sort_unstable_by_key(|delivery| delivery.vertex);
            }
            self.patches.deliveries.append(&mut deliveries);
        }
        // The kernels rely on it.
        assert!(self.patches.is_sound(), "each vertex of the last level is delivered once");
        self.patches
    }

    /// The vertices of a patch when corner `turn` comes first.
    fn vertices_of(&self, face: FaceId, turn: u8) -> impl Iterator<Item = u32> + '_ {
        let n_corners = 3 << (2 * self.plan.options().levels);
        let indices = &self.plan.indices()[face.index() * n_corners..][..n_corners];
        self.corners[usize::from(turn)].iter().map(|&corner| indices[corner])
    }

    /// For each vertex of the last level the first triangle that has it.
    fn owners(&self) -> Vec<u32> {
        let mut owner = vec![NONE; self.plan.n_vertices()];
        let n_corners = 3 << (2 * self.plan.options().levels);
        for (face, indices) in self.plan.indices().chunks_exact(n_corners).enumerate() {
            for &corner in &self.corners[0] {
                let owner = &mut owner[indices[corner] as usize];
                *owner = (*owner).min(face as u32);
            }
        }
        owner
    }

    /// Makes the class of a kind from its first triangle; for each vertex of the patch its row.
    fn class(&mut self, kind: usize) -> Vec<u32> {
        let (face, turn) = self.kinds.faces[kind][0];
        let patch: Vec<u32> = self.vertices_of(face, turn).collect();
        let plan = self.plan;
        let (last, steps) = plan.tables.split_last().expect("a plan with patches has steps");
        let rows_of = |vertex: u32| plan.limit.as_ref().map_or(&[][..], |limit| limit.row(vertex as usize).0);
        let ring_of = |vertex: u32| plan.rings.as_ref().map_or(&[][..], |rings| rings.ring(vertex as usize));

        // The patch first, then what its limit or its normals need; rows of one kind together, so that runs are long.
        let mut own = patch.clone();
        sort_by_row(&mut own, last);
        let mut others = self.needed(&own, &own, |v| rows_of(v).iter().chain(ring_of(v)));
        sort_by_row(&mut others, last);
        let mut level: Vec<u32> = own.iter().copied().chain(others).collect();

        self.number(&level);
        let limit = plan.limit.as_ref().map(|limit| self.local_limit(limit, &own));
        let rings = plan.rings.as_ref().map(|rings| self.local_rings(rings, &own));
        let places = patch.iter().map(|&vertex| self.local[vertex as usize]).collect();
        self.forget(&level);

        let n_around = self.kinds.around[kind].len() / self.kinds.faces[kind].len();
        let around = self.kinds.around[kind][..n_around].to_vec();
        let mut tables = vec![last];
        tables.extend(steps.iter().rev());
        let mut class = Class { steps: Vec::new(), n_rows: own.len(), limit, rings };
        for (i, table) in tables.iter().enumerate() {
            let coarser = match tables.get(i + 1) {
                Some(coarser) => {
                    let mut vertices = self.needed(&level, &[], |v| table.row(v as usize).0.iter());
                    sort_by_row(&mut vertices, coarser);
                    vertices
                }
                None => around.clone(),
            };
            self.number(&coarser);
            class.steps.push(self.local_table(table, &level, coarser.len()));
            self.forget(&coarser);
            level = coarser;
        }
        class.steps.reverse();
        self.patches.classes.push(class);
        places
    }

    /// What some vertices need beyond those that are known, each once, in the order in which it is met.
    fn needed<'v, I>(&mut self, vertices: &[u32], known: &[u32], needs: impl Fn(u32) -> I) -> Vec<u32>
    where
        I: Iterator<Item = &'v u32>,
    {
        self.number(known);
        let mut met = Vec::new();
        for &needed in vertices.iter().flat_map(|&vertex| needs(vertex)) {
            if std::mem::replace(&mut self.local[needed as usize], 0) == NONE {
                met.push(needed);
            }
        }
        self.forget(known);
        self.forget(&met);
        met
    }

    fn number(&mut self, vertices: &[u32]) {
        vertices.iter().zip(0..).for_each(|(&vertex, i)| self.local[vertex as usize] = i);
    }

    fn forget(&mut self, vertices: &[u32]) {
        vertices.iter().for_each(|&vertex| self.local[vertex as usize] = NONE);
    }

    fn local_of(&self, vertex: u32) -> u32 {
        let local = self.local[vertex as usize];
        assert!(local != NONE, "a patch reaches beyond the triangles that touch its own");
        local
    }

    fn local_table(&self, table: &StencilTable, rows: &[u32], n_sources: usize) -> StencilTable {
        let mut builder: StencilBuilder<f32> = StencilTable::builder(n_sources, rows.len(), 0);
        for &row in rows {
            let (sources, weights) = table.row(row as usize);
            for (&source, &weight) in sources.iter().zip(weights) {
                builder.entry(self.local_of(source), f64::from(weight));
            }
            builder.end_row();
        }
        builder.finish()
    }

    fn local_limit(&self, limit: &LimitTable, rows: &[u32]) -> LimitTable {
        let mut local = LimitTable::with_capacity(7 * rows.len());
        for &vertex in rows {
            let (sources, weights) = limit.row(vertex as usize);
            local.push(sources.iter().map(|&source| self.local_of(source)), weights);
        }
        local
    }

    fn local_rings(&self, rings: &Rings, rows: &[u32]) -> Rings {
        let lists = rows.iter().map(|&vertex| rings.ring(vertex as usize).iter().map(|&v| self.local_of(v)));
        Rings::of_lists(lists, 6 * rows.len())
    }
}

/// Brings rows of the same length and weights together, otherwise as they were.
fn sort_by_row(vertices: &mut [u32], table: &StencilTable) {
    vertices.sort_by_cached_key(|&vertex| {
        let (_, weights) = table.row(vertex as usize);
        (weights.len(), weights.iter().map(|w| w.to_bits()).collect::<Vec<_>>())
    });
}
