//! The exact form of the idea: rows shared by topology.
//!
//! A scheme is linear, and its weights depend on valences, boundaries and tags alone. So the patches of two control
//! triangles whose surroundings agree in these have the same rows, over different control vertices, whatever the shape and
//! however it moves. This counts how many different sets of rows a plan has, and what sharing them would save.
//!
//! Sharing means one table for each class from control vertices straight to the last level (the product of the steps), with
//! local numbers, and for each triangle the list of its control vertices. The plan's own tables share weights another way:
//! between successive rows of a step.

use std::collections::{BTreeMap, BTreeSet};

use super::classes::{code_around, valences};
use super::maps::composed;
use crate::math::fnv::Fnv64;
use crate::mesh::{DedgeId, DedgeMesh, FaceId, VertexId};
use crate::subdiv::plan::{DoublePlan, Plan, PlanError};
use crate::subdiv::scheme::{Normals, PlanOptions, Positions};
use crate::subdiv::shared_patches::child_order;
use crate::subdiv::stencil::StencilTable;
use crate::subdiv::tags::Tags;

/// How far the rows of a plan can be shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedRows {
    /// Control triangles that have a patch; holes have none.
    pub n_triangles: usize,
    /// Different sets of rows among them: the patches of one class differ in nothing but their control vertices and which
    /// corner comes first. Weights are compared to 1e-9, and sets by a hash of 64 bits.
    pub n_classes: usize,
    /// Different surroundings among them: valences, boundaries, tags of everything that touches the triangle. What shares
    /// these need not share rows where a scheme looks farther, and what does not may share them where it looks less far.
    pub n_surroundings: usize,
    /// Vertices of the last level.
    pub n_vertices: usize,
    /// Rows of all classes together; a row on a border is in the patches on both sides.
    pub n_class_rows: usize,
    /// Bytes of the plan's tables, one for each step, as they are.
    pub plan_bytes: usize,
    /// Bytes of the product of the steps, every row with its own weights.
    pub composed_bytes: usize,
    /// Bytes of the same shared by class: rows with local numbers of 16 bits, and each triangle's control vertices.
    pub shared_bytes: usize,
    /// Bytes that say where each value of a patch goes; none are needed where the vertices are ordered by patch.
    pub target_bytes: usize,
}

impl SharedRows {
    /// Counts for a triangle mesh. Takes the time and memory of the product of all steps in double precision, several times
    /// those of the plan.
    ///
    /// # Errors
    /// As [`Plan::build_with`]; polygon schemes have no triangles.
    pub fn count(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<SharedRows, PlanError> {
        if !options.scheme.is_triangular() {
            return Err(PlanError::NotPolygons { scheme: options.scheme });
        }
        let options = PlanOptions { normals: Normals::None, positions: Positions::Level, ..*options };
        let plan = Plan::build_with(control, tags, &options)?;
        let table = composed(&DoublePlan::build_with(control, tags, &options)?.tables, control.n_vertices());

        let n_children = options.scheme.faces_per_face().unwrap_or(1).pow(options.levels) as usize;
        let orders = [0, 1, 2].map(|turn| child_order(options.scheme.split(), options.levels, turn));
        let mut labels = Labels::new(control);
        let mut classes: BTreeMap<u64, Set> = BTreeMap::new();
        let mut counts = SharedRows {
            n_triangles: 0,
            n_classes: 0,
            n_surroundings: n_surroundings(control, tags),
            n_vertices: plan.n_vertices(),
            n_class_rows: 0,
            plan_bytes: plan.n_table_bytes(),
            composed_bytes: 8 * table.n_entries() + 4 * (table.n_rows() + 1),
            shared_bytes: 0,
            target_bytes: 0,
        };
        let parents = plan.face_parent();
        let mut first = 0;
        while first < parents.len() {
            let face = FaceId(parents[first]);
            // A frozen face is its own child.
            let is_whole = parents.get(first + n_children - 1) == Some(&face.0);
            let n = if is_whole { n_children } else { 1 };
            let sets = [0, 1, 2].map(|turn: u8| {
                let alone = [(0, turn)];
                let order = if is_whole { &orders[usize::from(turn)][..] } else { &alone[..] };
                let vertices = patch_vertices(&plan.indices()[3 * first..3 * (first + n)], order);
                labels.set(&table, &vertices, face, turn)
            });
            // Whichever corner comes first: the least hash names the class.
            let set = sets.into_iter().min_by_key(|set| set.hash).unwrap_or_default();
            counts.n_triangles += 1;
            counts.shared_bytes += 4 * set.n_sources + 4;
            counts.target_bytes += 4 * set.n_rows;
            classes.entry(set.hash).or_insert(set);
            first += n;
        }
        counts.n_classes = classes.len();
        counts.n_class_rows = classes.values().map(|set| set.n_rows).sum();
        counts.shared_bytes += classes.values().map(|set| 6 * set.n_entries + 2 * set.n_rows).sum::<usize>();
        Ok(counts)
    }
}

/// The rows of a patch, with local numbers.
#[derive(Clone, Copy, Default)]
struct Set {
    hash: u64,
    n_rows: usize,
    n_entries: usize,
    n_sources: usize,
}

/// The vertices of a patch, each once, in that order.
fn patch_vertices(indices: &[u32], order: &[(usize, u8)]) -> Vec<u32> {
    let corners = order.iter().flat_map(|&(child, turn)| (0..3).map(move |c| 3 * child + (usize::from(turn) + c) % 3));
    let mut seen = BTreeSet::new();
    corners.map(|corner| indices[corner]).filter(|&v| seen.insert(v)).collect()
}

/// Local numbers of control vertices around a triangle: its corners, then ring by ring, counter-clockwise.
struct Labels<'a> {
    mesh: &'a DedgeMesh,
    label: Vec<u32>,
    is_needed: Vec<bool>,
}

const NONE: u32 = u32::MAX;

impl<'a> Labels<'a> {
    fn new(mesh: &'a DedgeMesh) -> Labels<'a> {
        Labels { mesh, label: vec![NONE; mesh.n_vertices()], is_needed: vec![false; mesh.n_vertices()] }
    }

    fn set(&mut self, table: &StencilTable<f64>, vertices: &[u32], face: FaceId, turn: u8) -> Set {
        let mut needed: Vec<u32> = Vec::new();
        for &vertex in vertices {
            for &source in table.row(vertex as usize).0 {
                if !std::mem::replace(&mut self.is_needed[source as usize], true) {
                    needed.push(source);
                }
            }
        }
        let labelled = self.spread(face, turn, needed.len());
        let mut hash = Fnv64::new();
        let mut set = Set { n_rows: vertices.len(), n_sources: needed.len(), ..Set::default() };
        let mut row: Vec<(u32, i64)> = Vec::new();
        for &vertex in vertices {
            let (sources, weights) = table.row(vertex as usize);
            row.clear();
            let rounded = |w: f64| (w * f64::from(1 << 30)).round() as i64;
            row.extend(sources.iter().zip(weights).map(|(&s, &w)| (self.label[s as usize], rounded(w))));
            // What cancels out is there in one order of sums and not in another.
            row.retain(|&(_, weight)| weight != 0);
            row.sort_unstable();
            hash.u64(row.len() as u64);
            set.n_entries += row.len();
            for &(label, weight) in &row {
                hash.u32(label);
                hash.u64(weight as u64);
            }
        }
        set.hash = hash.finish();
        labelled.into_iter().for_each(|v| self.label[v as usize] = NONE);
        needed.into_iter().for_each(|v| self.is_needed[v as usize] = false);
        set
    }

    /// Numbers vertices until all `n_needed` have one; gives those that it has numbered.
    fn spread(&mut self, face: FaceId, turn: u8, mut n_needed: usize) -> Vec<u32> {
        let mesh = self.mesh;
        // With each vertex a directed edge that starts there: the first of its ring.
        let mut queue: Vec<(u32, DedgeId)> = Vec::new();
        let mut meet = |queue: &mut Vec<(u32, DedgeId)>, vertex: VertexId, start: DedgeId| {
            if self.label[vertex.index()] == NONE {
                self.label[vertex.index()] = queue.len() as u32;
                n_needed -= usize::from(self.is_needed[vertex.index()]);
                queue.push((vertex.0, start));
            }
            n_needed > 0
        };
        let mut goes_on = true;
        for k in 0..3 {
            let side = face.dedge((u32::from(turn) + k) % 3);
            goes_on = meet(&mut queue, mesh.origin(side), side);
        }
        let mut at = 0;
        while goes_on && at < queue.len() {
            let start = queue[at].1;
            let mut dedge = start;
            let closed = loop {
                goes_on = meet(&mut queue, mesh.target(dedge), mesh.twin(dedge).unwrap_or(dedge.next()));
                match mesh.twin(dedge.prev()) {
                    Some(onward) if onward == start => break true,
                    Some(onward) => dedge = onward,
                    None => {
                        goes_on = meet(&mut queue, mesh.origin(dedge.prev()), dedge.prev());
                        break false;
                    }
                }
            };
            if !closed {
                let mut dedge = start;
                while let Some(twin) = mesh.twin(dedge) {
                    dedge = twin.next();
                    goes_on = meet(&mut queue, mesh.target(dedge), mesh.twin(dedge).unwrap_or(dedge.next()));
                }
            }
            at += 1;
        }
        queue.into_iter().map(|(vertex, _)| vertex).collect()
    }
}

/// How many different surroundings the triangles of a control mesh have.
fn n_surroundings(control: &DedgeMesh, tags: &Tags) -> usize {
    let mut numbers = valences(control);
    for &(vertex, sharpness) in &tags.corners {
        numbers[vertex.index()] = numbers[vertex.index()].wrapping_add(sharpness.to_bits());
    }
    let mut sharpness = vec![0_u32; control.n_dedges()];
    for &(a, b, s) in &tags.creases {
        for (from, to) in [(a, b), (b, a)] {
            if let Some(dedge) = control.outgoing_dedges(from).find(|&d| control.target(d) == to) {
                sharpness[dedge.index()] = s.to_bits();
                if let Some(twin) = control.twin(dedge) {
                    sharpness[twin.index()] = s.to_bits();
                }
            }
        }
    }
    let mut kind = vec![0_u32; control.n_faces()];
    tags.frozen.iter().for_each(|f| kind[f.index()] = 1);
    tags.holes.iter().for_each(|f| kind[f.index()] = 2);
    let mark = |across: DedgeId, beyond: FaceId| [sharpness[across.index()], kind[beyond.index()]];
    let mut codes: BTreeSet<(u32, Vec<u32>)> = BTreeSet::new();
    for face in control.faces().filter(|f| kind[f.index()] != 2) {
        let code = (0..3).map(|turn| code_around(control, &numbers, mark, face, turn)).min();
        codes.extend(code.map(|code| (kind[face.index()], code)));
    }
    codes.len()
}
