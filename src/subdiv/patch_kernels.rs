//! Patches of one class, sixteen at a time: every step, the limit and the normals between two looks at memory.

use glam::Vec3;

use super::kernels::fetch;
use super::limit::LimitTable;
use super::normals::{HUGE, Rings, TINY, unit_of};
use super::register::{Plain, Register};
use super::runs::pieces;
use super::scheme::Positions;
use super::shared_patches::{Class, Delivery, LANES, SharedPatches};
use super::stencil::StencilTable;
use super::team::Team;

/// The same vertex of sixteen patches: all x, all y, all z.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C, align(64))]
pub(super) struct Block([f32; 3 * LANES]);

/// Registers of a coordinate.
const fn parts<R: Register>() -> usize {
    LANES / R::WIDTH
}

impl Default for Block {
    fn default() -> Block {
        Block([0.0; 3 * LANES])
    }
}

/// Groups of patches that a thread takes at once: enough to pay for the taking, few enough to balance.
const GROUPS: usize = 4;

/// The buffers of one worker: two levels in turn, and what is delivered.
#[derive(Debug, Default)]
pub(super) struct PatchBuffers {
    coarse: Vec<Block>,
    fine: Vec<Block>,
    positions: Vec<Block>,
    normals: Vec<Block>,
}

impl PatchBuffers {
    /// Grows where the patches need more.
    fn fit(&mut self, patches: &SharedPatches) {
        let tables = || patches.classes.iter().flat_map(|class| &class.steps);
        let n_between = tables().map(|t| t.n_rows().max(t.n_sources())).max().unwrap_or(0);
        let n_rows = patches.classes.iter().map(|class| class.n_rows).max().unwrap_or(0);
        for (buffer, n) in [
            (&mut self.coarse, n_between),
            (&mut self.fine, n_between),
            (&mut self.positions, n_rows),
            (&mut self.normals, n_rows),
        ] {
            if buffer.len() < n {
                buffer.resize(n, Block::default());
            }
        }
    }
}

impl SharedPatches {
    /// Makes buffers fit, one for each thread.
    pub(super) fn fit(&self, buffers: &mut Vec<PatchBuffers>, threads: usize) {
        if buffers.len() < threads {
            buffers.resize_with(threads, PatchBuffers::default);
        }
        buffers.iter_mut().for_each(|buffers| buffers.fit(self));
    }

    /// Positions of the last level from control positions, and normals unless their list is empty. There are
    /// buffers for each of the team.
    pub(super) fn evaluate(
        &self,
        wanted: Positions,
        control: &[Vec3],
        positions: &mut [Vec3],
        normals: &mut [Vec3],
        buffers: &mut [PatchBuffers],
        team: &Team,
    ) {
        assert_eq!(control.len(), self.n_control, "one value for each control vertex");
        assert_eq!(positions.len(), self.n_vertices, "one position for each vertex");
        assert!(normals.is_empty() || normals.len() == self.n_vertices, "one normal for each vertex, or none");
        let out = [Places::of(positions), Places::of(normals)];
        let starts = (0..self.groups.len()).step_by(GROUPS);
        team.share_with(buffers, starts, |buffers, start| {
            for group in start..(start + GROUPS).min(self.groups.len()) {
                self.group(wanted, group, control, &out, buffers);
            }
        });
    }

    fn group(
        &self,
        wanted: Positions,
        number: usize,
        control: &[Vec3],
        out: &[Places<'_>; 2],
        buffers: &mut PatchBuffers,
    ) {
        let group = self.groups[number];
        let class = &self.classes[group.class as usize];
        let wants_normals = out[1].n > 0;
        let deliveries = self.deliveries_of(number);
        let work = Work { class, sources: self.sources_of(group), control, wanted, wants_normals };
        let from_limit = refine(work, buffers);
        let positions = if from_limit { &buffers.positions } else { &buffers.coarse };
        let positions: &[f32] = bytemuck::cast_slice(&positions[..class.n_rows]);
        let normals: &[f32] = bytemuck::cast_slice(&buffers.normals[..class.n_rows]);
        if wants_normals {
            for &delivery in deliveries {
                out[0].take(delivery, positions);
                out[1].take(delivery, normals);
            }
        } else {
            deliveries.iter().for_each(|&delivery| out[0].take(delivery, positions));
        }
    }
}

/// A list whose places several threads fill, each its own.
struct Places<'a> {
    start: *mut Vec3,
    n: usize,
    lent: std::marker::PhantomData<&'a mut [Vec3]>,
}

// SAFETY: the places are plain numbers, and no two threads have the same one: see `take`.
#[allow(unsafe_code)]
unsafe impl Sync for Places<'_> {}

impl<'a> Places<'a> {
    fn of(list: &'a mut [Vec3]) -> Places<'a> {
        Places { start: list.as_mut_ptr(), n: list.len(), lent: std::marker::PhantomData }
    }

    /// Takes over a vertex from the blocks of a patch.
    #[inline(always)]
    #[allow(unsafe_code)]
    fn take(&self, Delivery { place, vertex }: Delivery, values: &[f32]) {
        let (place, vertex) = (place as usize, vertex as usize);
        debug_assert!(place + 2 * LANES < values.len() && vertex < self.n);
        // SAFETY: the place is in a row of the class, and the vertex below the length of the list, which `evaluate`
        // compares with the number of vertices. Each vertex is delivered once, and each group has one thread, so that
        // nobody else writes there (`SharedPatches::is_sound`, checked when patches are made or loaded).
        unsafe {
            let value = |k: usize| *values.get_unchecked(place + k * LANES);
            *self.start.add(vertex) = Vec3::new(value(0), value(1), value(2));
        }
    }
}

/// What there is to do for a group.
#[derive(Clone, Copy)]
struct Work<'a> {
    class: &'a Class,
    /// Control vertices of the class, each for all lanes.
    sources: &'a [u32],
    control: &'a [Vec3],
    wanted: Positions,
    wants_normals: bool,
}

/// From control positions to those of the patch, in `coarse` or, if it says so, in `positions`; and to its normals.
fn refine(work: Work, buffers: &mut PatchBuffers) -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        use super::register::{Avx, Avx512};

        macro_rules! with {
            ($register:ident, $feature:tt) => {{
                #[target_feature(enable = $feature)]
                fn on_this_processor(work: Work, buffers: &mut PatchBuffers) -> bool {
                    refine_with::<$register>(work, buffers)
                }

                if is_x86_feature_detected!($feature) {
                    #[allow(unsafe_code)]
                    // SAFETY: the processor has it.
                    return unsafe { on_this_processor(work, buffers) };
                }
            }};
        }
        with!(Avx512, "avx512f");
        with!(Avx, "avx");
    }
    refine_with::<Plain>(work, buffers)
}

#[inline(always)]
fn refine_with<R: Register>(work: Work, buffers: &mut PatchBuffers) -> bool {
    let Work { class, sources, control, wanted, wants_normals } = work;
    for (block, sources) in buffers.coarse.iter_mut().zip(sources.chunks_exact(LANES)) {
        for (lane, &source) in sources.iter().enumerate() {
            let p = fetch(control, source);
            (block.0[lane], block.0[LANES + lane], block.0[2 * LANES + lane]) = (p.x, p.y, p.z);
        }
    }
    for table in &class.steps {
        apply::<R>(table, &buffers.coarse[..table.n_sources()], &mut buffers.fine[..table.n_rows()]);
        std::mem::swap(&mut buffers.coarse, &mut buffers.fine);
    }
    let n_last = class.steps.last().map_or(0, StencilTable::n_rows);
    let source = &buffers.coarse[..n_last];
    let from_limit = wanted == Positions::Limit && class.limit.is_some();
    if let Some(limit) = &class.limit {
        let positions = if from_limit { &mut buffers.positions[..class.n_rows] } else { &mut [] };
        let normals = if wants_normals { &mut buffers.normals[..class.n_rows] } else { &mut [] };
        limits::<R>(limit, source, positions, normals);
    }
    if let (Some(rings), true) = (&class.rings, wants_normals) {
        ring_normals::<R>(rings, source, &mut buffers.normals[..class.n_rows]);
    }
    from_limit
}

/// A block of a list of blocks, to be read register by register.
#[derive(Clone, Copy)]
struct At<'a>(&'a Block);

#[inline(always)]
#[allow(unsafe_code)]
fn at(blocks: &[Block], place: u32) -> At<'_> {
    debug_assert!((place as usize) < blocks.len());
    // SAFETY: sources are below the number of values that the table is applied to; see `kernels` and
    // `SharedPatches::is_sound`.
    At(unsafe { blocks.get_unchecked(place as usize) })
}

impl At<'_> {
    #[inline(always)]
    fn get<R: Register>(self, register: usize) -> R {
        R::load(&self.0.0[register * R::WIDTH..][..R::WIDTH])
    }

    /// One part of the lanes of a vector.
    #[inline(always)]
    fn vector<R: Register>(self, part: usize) -> [R; 3] {
        [self.get(part), self.get(parts::<R>() + part), self.get(2 * parts::<R>() + part)]
    }
}

impl Block {
    #[inline(always)]
    fn set<R: Register>(&mut self, register: usize, value: R) {
        value.store(&mut self.0[register * R::WIDTH..][..R::WIDTH]);
    }

    #[inline(always)]
    fn set_vector<R: Register>(&mut self, part: usize, [x, y, z]: [R; 3]) {
        self.set(part, x);
        self.set(parts::<R>() + part, y);
        self.set(2 * parts::<R>() + part, z);
    }
}

/// All rows of a table. Sums are those of [`kernels`](super::kernels), in the order of this table.
#[inline(always)]
fn apply<R: Register>(table: &StencilTable, source: &[Block], out: &mut [Block]) {
    assert_eq!(source.len(), table.n_sources(), "one value for each source");
    assert_eq!(out.len(), table.n_rows(), "one value for each row");
    for piece in pieces(&table.runs, table.n_rows, 0..out.len()) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let out = &mut out[piece.out];
        match *weights {
            [w, v, u, t] if w == v && u == t => {
                let (w, u) = (R::splat(w), R::splat(u));
                for (out, &[a, b, c, d]) in out.iter_mut().zip(sources.as_chunks::<4>().0) {
                    let (a, b, c, d) = (at(source, a), at(source, b), at(source, c), at(source, d));
                    for i in 0..3 * parts::<R>() {
                        let (ends, sides) = (a.get::<R>(i).plus(b.get(i)), c.get::<R>(i).plus(d.get(i)));
                        out.set(i, ends.times(w).plus(sides.times(u)));
                    }
                }
            }
            [w, v, ref rest @ ..] if rest.len() == 5 && rest.iter().all(|r| *r == v) => {
                let (w, v) = (R::splat(w), R::splat(v));
                for (out, &[s, a, b, c, d, e, f]) in out.iter_mut().zip(sources.as_chunks::<7>().0) {
                    let (s, a, b, c) = (at(source, s), at(source, a), at(source, b), at(source, c));
                    let (d, e, f) = (at(source, d), at(source, e), at(source, f));
                    for i in 0..3 * parts::<R>() {
                        let ring = a.get::<R>(i).plus(b.get(i)).plus(c.get(i));
                        let ring = ring.plus(d.get::<R>(i).plus(e.get(i)).plus(f.get(i)));
                        out.set(i, s.get::<R>(i).times(w).plus(ring.times(v)));
                    }
                }
            }
            _ => {
                for (out, sources) in out.iter_mut().zip(sources.chunks_exact(weights.len())) {
                    let n = 3 * parts::<R>();
                    let mut sums = [R::splat(0.0); 3 * LANES / Plain::WIDTH];
                    for (&s, &weight) in sources.iter().zip(weights) {
                        let (s, weight) = (at(source, s), R::splat(weight));
                        for (i, sum) in sums[..n].iter_mut().enumerate() {
                            *sum = sum.plus(s.get::<R>(i).times(weight));
                        }
                    }
                    sums[..n].iter().enumerate().for_each(|(i, &sum)| out.set(i, sum));
                }
            }
        }
    }
}

/// Limit positions and limit normals; either list may be empty.
#[inline(always)]
fn limits<R: Register>(table: &LimitTable, source: &[Block], positions: &mut [Block], normals: &mut [Block]) {
    let n = positions.len().max(normals.len());
    for piece in pieces(&table.runs, table.n_rows, 0..n) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let is_regular = LimitTable::is_regular(weights);
        for (row, sources) in piece.out.zip(sources.chunks_exact(weights.len())) {
            if let (true, &[v, q0, q1, q2, q3, q4, q5]) = (is_regular, sources) {
                let (q0, q1, q2) = (at(source, q0), at(source, q1), at(source, q2));
                let (q3, q4, q5) = (at(source, q3), at(source, q4), at(source, q5));
                let v = at(source, v);
                if let Some(out) = positions.get_mut(row) {
                    let (centre, neighbour) = (R::splat(weights[0][0]), R::splat(weights[1][0]));
                    for i in 0..3 * parts::<R>() {
                        let ring = q0.get::<R>(i).plus(q3.get(i)).plus(q1.get::<R>(i).plus(q4.get(i)));
                        let ring = ring.plus(q2.get::<R>(i).plus(q5.get(i)));
                        out.set(i, v.get::<R>(i).times(centre).plus(ring.times(neighbour)));
                    }
                }
                if let Some(out) = normals.get_mut(row) {
                    for part in 0..parts::<R>() {
                        // Opposite neighbours come in with opposite weights.
                        let a = minus(q0.vector::<R>(part), q3.vector(part));
                        let b = minus(q1.vector::<R>(part), q4.vector(part));
                        let c = minus(q2.vector::<R>(part), q5.vector(part));
                        let (first, second) = (plus(a, times(minus(b, c), R::splat(0.5))), plus(b, c));
                        put_unit(out, part, cross(first, second));
                    }
                }
                continue;
            }
            for part in 0..parts::<R>() {
                let mut sums = [[R::splat(0.0); 3]; 3];
                for (&s, weights) in sources.iter().zip(weights) {
                    let s = at(source, s).vector::<R>(part);
                    for k in 0..3 {
                        sums[k] = plus(sums[k], times(s, R::splat(weights[k])));
                    }
                }
                if let Some(out) = positions.get_mut(row) {
                    out.set_vector(part, sums[0]);
                }
                if let Some(out) = normals.get_mut(row) {
                    put_unit(out, part, cross(sums[1], sums[2]));
                }
            }
        }
    }
}

/// Normals from faces, as in [`normals`](super::normals).
#[inline(always)]
fn ring_normals<R: Register>(rings: &Rings, source: &[Block], normals: &mut [Block]) {
    for run in 0..rings.runs.len() {
        let (rows, outlines, len) = rings.run(run);
        for (out, outline) in normals[rows].iter_mut().zip(outlines.chunks_exact(len)) {
            for part in 0..parts::<R>() {
                let corner = at(source, outline[0]).vector::<R>(part);
                let mut sum = [R::splat(0.0); 3];
                let mut k = 1;
                // From the corner over the next two to the third.
                while k + 2 < len {
                    let a = at(source, outline[k]).vector::<R>(part);
                    let b = at(source, outline[k + 1]).vector::<R>(part);
                    let c = at(source, outline[k + 2]).vector::<R>(part);
                    sum = plus(sum, cross(minus(b, corner), minus(c, a)));
                    k += 2;
                }
                if k + 1 < len {
                    let a = at(source, outline[k]).vector::<R>(part);
                    let b = at(source, outline[k + 1]).vector::<R>(part);
                    sum = plus(sum, cross(minus(a, corner), minus(b, corner)));
                }
                put_unit(out, part, sum);
            }
        }
    }
}

#[inline(always)]
fn plus<R: Register>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])]
}

#[inline(always)]
fn minus<R: Register>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0].minus(b[0]), a[1].minus(b[1]), a[2].minus(b[2])]
}

#[inline(always)]
fn times<R: Register>(a: [R; 3], factor: R) -> [R; 3] {
    [a[0].times(factor), a[1].times(factor), a[2].times(factor)]
}

#[inline(always)]
fn cross<R: Register>([ax, ay, az]: [R; 3], [bx, by, bz]: [R; 3]) -> [R; 3] {
    [ay.times(bz).minus(az.times(by)), az.times(bx).minus(ax.times(bz)), ax.times(by).minus(ay.times(bx))]
}

/// Unit vectors along a vector of each lane, as in [`normals`](super::normals).
#[inline(always)]
fn put_unit<R: Register>(out: &mut Block, part: usize, sum: [R; 3]) {
    let squared = sum[0].times(sum[0]).plus(sum[1].times(sum[1])).plus(sum[2].times(sum[2]));
    let inverse = R::splat(1.0).over(squared.sqrt());
    if squared.all_between(TINY, HUGE) {
        out.set_vector(part, times(sum, inverse));
    } else {
        out.set_vector(part, sum);
        settle(out, part * R::WIDTH..(part + 1) * R::WIDTH);
    }
}

/// Makes unit vectors of some lanes, some of which are too short or too long, or none.
#[cold]
#[inline(never)]
fn settle(out: &mut Block, lanes: std::ops::Range<usize>) {
    for lane in lanes {
        let places = [lane, LANES + lane, 2 * LANES + lane];
        let sum = Vec3::from_array(places.map(|place| out.0[place]));
        let unit = unit_of(sum);
        places.into_iter().zip(unit.to_array()).for_each(|(place, value)| out.0[place] = value);
    }
}

#[cfg(test)]
mod tests {
    use super::{Block, PatchBuffers, Plain, Work, refine, refine_with};
    use crate::mesh::shapes::torus;
    use crate::subdiv::scheme::{Normals, PlanOptions, Positions, Scheme};
    use crate::subdiv::{Plan, Tags};
    use glam::Vec3;

    type Refine = fn(Work, &mut PatchBuffers) -> bool;

    fn bits(blocks: &[Block]) -> Vec<u32> {
        blocks.iter().flat_map(|block| block.0).map(f32::to_bits).collect()
    }

    #[test]
    fn wide_registers_have_other_bits_than_plain_arithmetic() {
        let shape = torus(12, 9);
        let mesh = shape.mesh().expect("in the cabinet");
        for (positions, normals) in
            [(Positions::Limit, Normals::Limit), (Positions::Level, Normals::Faces), (Positions::Level, Normals::Limit)]
        {
            let options = PlanOptions { positions, normals, ..PlanOptions::new(Scheme::Loop, 3) };
            let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
            let patches = plan.patches.as_ref().expect("one class");
            // Some triangles without area, whose normals are settled one by one.
            let control: Vec<Vec3> = shape.positions.iter().map(|p| if p.x > 0.0 { *p } else { Vec3::ZERO }).collect();
            for group in &patches.groups {
                let class = &patches.classes[group.class as usize];
                let sources = patches.sources_of(*group);
                let run = |with: Refine| {
                    let mut buffers = PatchBuffers::default();
                    buffers.fit(patches);
                    let (control, wanted) = (&control[..], positions);
                    let work = Work { class, sources, control, wanted, wants_normals: true };
                    let from_limit = with(work, &mut buffers);
                    let last = bits(&buffers.coarse[..class.n_rows]);
                    (from_limit, last, bits(&buffers.positions), bits(&buffers.normals))
                };
                let plain = run(refine_with::<Plain>);
                assert!(plain.3.iter().all(|&x| f32::from_bits(x).is_finite()));
                assert!(run(refine) == plain, "what this processor takes, {normals:?}");
                #[cfg(target_arch = "x86_64")]
                if is_x86_feature_detected!("avx") {
                    assert!(run(refine_with::<crate::subdiv::register::Avx>) == plain, "AVX, {normals:?}");
                }
            }
        }
    }
}
