//! A plan as bytes: saved once, loaded at the speed of memory.
//!
//! Little-endian throughout. A header of 40 bytes (mark, version, fingerprint of the inputs, length and XXH3 checksum of
//! what follows), then the parts in a written order, each list as its length and its numbers. Whoever loads trusts nothing:
//! the checksum finds damage, and every number that an evaluation relies on is checked against its bound, so that no file
//! can make it read out of place.

use bytemuck::{AnyBitPattern, NoUninit, Pod, Zeroable};
use twox_hash::XxHash3_64;

use super::limit::LimitTable;
use super::normals::{RingRun, Rings};
use super::plan::{Counts, Plan, wants_limit};
use super::runs::Run;
use super::scheme::{BoundaryRule, Creasing, LoopWeights, Normals, PlanOptions, Positions, Scheme};
use super::shared_patches::{Class, SharedPatches};
use super::stencil::{StencilTable, all_below};

const MARK: [u8; 8] = *b"LONDRAPL";
/// Raised with each change of what follows; older versions are refused, since a plan can always be built anew.
const VERSION: u32 = 2;

/// Why bytes are no plan, or not the one asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFileError {
    /// Another kind of file.
    #[error("this is no plan of Londra: it does not begin with \"LONDRAPL\"")]
    NotAPlan,
    /// Written by another version of the program.
    #[error("the plan has version {found}, this program reads {}; build it anew", VERSION)]
    Version {
        /// What the file says.
        found: u32,
    },
    /// Made from other inputs.
    #[error(
        "the plan belongs to other inputs: its fingerprint is {found:016x}, that of the mesh, tags and options at hand is \
         {expected:016x}; build it anew"
    )]
    OtherInputs {
        /// What the file says.
        found: u64,
        /// What was asked for.
        expected: u64,
    },
    /// There are fewer or more bytes than the header says.
    #[error("the plan has {found} bytes behind its header instead of {expected}; it was cut or has grown")]
    Length {
        /// What there is.
        found: u64,
        /// What the header says.
        expected: u64,
    },
    /// The bytes are not those that were written.
    #[error("the checksum of the plan does not match; the file is damaged")]
    Checksum,
    /// The bytes are those that were written, but no plan: a bug of the program that wrote them, or malice.
    #[error("the plan contradicts itself in its {part}")]
    Inconsistent {
        /// Which part.
        part: &'static str,
    },
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Header {
    mark: [u8; 8],
    version: u32,
    reserved: u32,
    fingerprint: u64,
    length: u64,
    checksum: u64,
}

impl Plan {
    /// The plan as bytes, for [`Plan::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut writer = Writer { bytes: vec![0; size_of::<Header>()] };
        writer.options(&self.options);
        writer.number(self.n_control);
        writer.number(self.n_frozen);
        let counts: Vec<u64> = self.counts.iter().flat_map(|c| [c.n_vertices as u64, c.n_faces as u64]).collect();
        writer.list(&counts);
        writer.number(self.tables.len());
        self.tables.iter().for_each(|table| writer.table(table));
        for list in [&self.face_sizes, &self.corners, &self.indices, &self.face_parent] {
            writer.list(list);
        }
        writer.list(&self.boundary_loops.iter().map(|l| l.len() as u64).collect::<Vec<_>>());
        writer.list(&self.boundary_loops.concat());
        writer.surface(self.rings.as_ref(), self.limit.as_ref());
        writer.number(usize::from(self.patches.is_some()));
        if let Some(patches) = &self.patches {
            writer.patches(patches);
        }
        let mut bytes = writer.bytes;
        let (header, body) = bytes.split_at_mut(size_of::<Header>());
        header.copy_from_slice(bytemuck::bytes_of(&Header {
            mark: MARK,
            version: VERSION.to_le(),
            reserved: 0,
            fingerprint: self.fingerprint.to_le(),
            length: (body.len() as u64).to_le(),
            checksum: XxHash3_64::oneshot(body).to_le(),
        }));
        bytes
    }

    /// The plan that [`Plan::to_bytes`] wrote. With `expected`, only that of the inputs with this
    /// [`fingerprint`](Plan::fingerprint), which is known without building it: [`Plan::fingerprint_of`].
    ///
    /// Costs a checksum, a copy and a look at each index: about three copies of the bytes.
    ///
    /// # Errors
    /// What is wrong with the bytes, or with the inputs.
    pub fn from_bytes(bytes: &[u8], expected: Option<u64>) -> Result<Plan, PlanFileError> {
        let (header, body) = bytes.split_at_checked(size_of::<Header>()).ok_or(PlanFileError::NotAPlan)?;
        let header: Header = bytemuck::pod_read_unaligned(header);
        if header.mark != MARK {
            return Err(PlanFileError::NotAPlan);
        }
        if u32::from_le(header.version) != VERSION {
            return Err(PlanFileError::Version { found: u32::from_le(header.version) });
        }
        let fingerprint = u64::from_le(header.fingerprint);
        if let Some(expected) = expected.filter(|e| *e != fingerprint) {
            return Err(PlanFileError::OtherInputs { found: fingerprint, expected });
        }
        if body.len() as u64 != u64::from_le(header.length) {
            return Err(PlanFileError::Length { found: body.len() as u64, expected: u64::from_le(header.length) });
        }
        if XxHash3_64::oneshot(body) != u64::from_le(header.checksum) {
            return Err(PlanFileError::Checksum);
        }
        let mut reader = Reader { bytes: body, part: "options" };
        let plan = reader.plan(fingerprint)?;
        if !reader.bytes.is_empty() {
            return Err(PlanFileError::Inconsistent { part: "end" });
        }
        Ok(plan)
    }
}

struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    fn number(&mut self, n: usize) {
        self.bytes.extend((n as u64).to_le_bytes());
    }

    fn list<T: NoUninit>(&mut self, list: &[T]) {
        self.number(list.len());
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytemuck::cast_slice(list));
        to_little_endian(&mut self.bytes[start..], element_size::<T>());
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
    }

    fn table(&mut self, table: &StencilTable) {
        self.number(table.n_sources);
        self.number(table.n_rows);
        self.list(&table.sources);
        self.list(&table.weights);
        self.list(&table.runs);
    }

    /// What makes limits and normals of positions.
    fn surface(&mut self, rings: Option<&Rings>, limit: Option<&LimitTable>) {
        self.number(usize::from(rings.is_some()));
        if let Some(rings) = rings {
            self.list(&rings.neighbours);
            self.list(&rings.runs);
        }
        self.number(usize::from(limit.is_some()));
        if let Some(limit) = limit {
            self.list(&limit.sources);
            self.list(&limit.weights);
            self.list(&limit.runs);
        }
    }

    fn patches(&mut self, patches: &SharedPatches) {
        self.number(patches.classes.len());
        for class in &patches.classes {
            self.number(class.steps.len());
            class.steps.iter().for_each(|table| self.table(table));
            self.number(class.n_rows);
            self.surface(class.rings.as_ref(), class.limit.as_ref());
        }
        self.list(&patches.groups);
        self.list(&patches.sources);
        self.list(&patches.deliveries);
    }

    fn options(&mut self, options: &PlanOptions) {
        let scheme = Scheme::ALL.iter().position(|s| *s == options.scheme).unwrap_or(0);
        self.number(scheme);
        self.number(options.levels as usize);
        self.bytes.extend([
            options.loop_weights as u8,
            options.boundary as u8,
            options.creasing as u8,
            options.positions as u8,
            options.normals as u8,
            0,
            0,
            0,
        ]);
    }
}

/// All lists are of 32-bit numbers or made of such, but for those of `u64`.
fn element_size<T>() -> usize {
    if align_of::<T>() == 8 { 8 } else { 4 }
}

/// Turns the bytes of each number round on a big-endian machine; the same call turns them back.
fn to_little_endian(bytes: &mut [u8], size: usize) {
    if cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    part: &'static str,
}

type Read<T> = Result<T, PlanFileError>;

impl Reader<'_> {
    fn wrong<T>(&self) -> Read<T> {
        Err(PlanFileError::Inconsistent { part: self.part })
    }

    fn check(&self, holds: bool) -> Read<()> {
        if holds { Ok(()) } else { self.wrong() }
    }

    fn take(&mut self, n: usize) -> Read<&[u8]> {
        match self.bytes.split_at_checked(n) {
            Some((taken, rest)) => {
                self.bytes = rest;
                Ok(taken)
            }
            None => self.wrong(),
        }
    }

    fn number(&mut self) -> Read<usize> {
        let part = self.part;
        let bytes: [u8; 8] = self.take(8)?.try_into().map_err(|_| PlanFileError::Inconsistent { part })?;
        // Nothing in a plan is larger than 32 bits can count.
        u32::try_from(u64::from_le_bytes(bytes)).map(|n| n as usize).or_else(|_| self.wrong())
    }

    fn list<T: AnyBitPattern + NoUninit>(&mut self) -> Read<Vec<T>> {
        let n = self.number()?;
        let n_bytes = n.checked_mul(size_of::<T>()).filter(|n| *n <= self.bytes.len());
        let Some(n_bytes) = n_bytes else { return self.wrong() };
        let bytes = self.take(n_bytes)?;
        let list = if cfg!(target_endian = "big") {
            let mut bytes = bytes.to_vec();
            to_little_endian(&mut bytes, element_size::<T>());
            bytemuck::pod_collect_to_vec(&bytes)
        } else {
            // Where it lies in memory as numbers do, nothing has to be cleared before it is copied.
            bytemuck::try_cast_slice(bytes).map_or_else(|_| bytemuck::pod_collect_to_vec(bytes), <[T]>::to_vec)
        };
        let padding = n_bytes.next_multiple_of(8) - n_bytes;
        self.take(padding)?;
        Ok(list)
    }

    fn choice<T: Copy>(&self, byte: u8, choices: &[T]) -> Read<T> {
        choices.get(byte as usize).copied().map_or_else(|| self.wrong(), Ok)
    }

    fn options(&mut self) -> Read<PlanOptions> {
        let scheme = self.number()?;
        let levels = self.number()? as u32;
        let bytes: [u8; 8] = self.take(8)?.try_into().unwrap_or_default();
        Ok(PlanOptions {
            scheme: self.choice(scheme.min(255) as u8, &Scheme::ALL)?,
            levels,
            loop_weights: self.choice(bytes[0], &[LoopWeights::Loop, LoopWeights::Warren])?,
            boundary: self.choice(bytes[1], &[BoundaryRule::EdgeOnly, BoundaryRule::EdgeAndCorner])?,
            creasing: self.choice(bytes[2], &[Creasing::Uniform, Creasing::Chaikin])?,
            positions: self.choice(bytes[3], &[Positions::Level, Positions::Limit])?,
            normals: self.choice(bytes[4], &[Normals::Faces, Normals::Limit, Normals::None])?,
        })
    }

    fn plan(&mut self, fingerprint: u64) -> Read<Plan> {
        let options = self.options()?;
        self.part = "counts";
        let (n_control, n_frozen) = (self.number()?, self.number()?);
        let counts: Vec<u64> = self.list()?;
        let (pairs, rest) = counts.as_chunks::<2>();
        self.check(rest.is_empty() && !pairs.is_empty() && counts.iter().all(|&n| n <= u64::from(u32::MAX)))?;
        let counts: Vec<Counts> =
            pairs.iter().map(|&[v, f]| Counts { n_vertices: v as usize, n_faces: f as usize }).collect();
        let Counts { n_vertices, n_faces } = counts[counts.len() - 1];
        // Levels are counted from 0; adaptive plans have as many as they went deep.
        self.check(n_control > 0 && n_vertices > 0)?;

        self.part = "stencil tables";
        let n_tables = self.number()?;
        self.check(n_tables <= 2 + counts.len())?;
        let mut tables = Vec::new();
        let mut sources = n_control;
        for _ in 0..n_tables {
            let table = self.table()?;
            self.check(table.n_sources == sources)?;
            sources = table.n_rows;
            tables.push(table);
        }
        self.check(sources == n_vertices)?;

        self.part = "faces";
        let [face_sizes, corners, indices, face_parent]: [Vec<u32>; 4] =
            [self.list()?, self.list()?, self.list()?, self.list()?];
        let n_corners: u64 = face_sizes.iter().map(|&n| u64::from(n)).sum();
        self.check(n_corners == corners.len() as u64 && indices.len().is_multiple_of(3))?;
        self.check(if face_sizes.is_empty() { indices.len() == 3 * n_faces } else { face_sizes.len() == n_faces })?;
        self.check(all_below(&indices, n_vertices) && all_below(&corners, n_vertices))?;
        self.check(face_parent.len() == n_faces && n_frozen <= n_faces)?;

        self.part = "boundaries";
        let lengths: Vec<u64> = self.list()?;
        let flat: Vec<u32> = self.list()?;
        self.check(all_below(&flat, n_vertices))?;
        let mut boundary_loops = Vec::new();
        let mut rest = &flat[..];
        for length in lengths {
            let Some((head, tail)) = usize::try_from(length).ok().and_then(|n| rest.split_at_checked(n)) else {
                return self.wrong();
            };
            boundary_loops.push(head.to_vec());
            rest = tail;
        }
        self.check(rest.is_empty())?;

        let (rings, limit) = self.surface(n_vertices, n_vertices)?;
        self.part = "normals";
        self.check(rings.is_some() == (options.normals == Normals::Faces))?;
        self.check(options.normals != Normals::Limit || limit.is_some())?;
        let patches = if self.number()? != 0 { Some(self.patches(n_control, n_vertices, &options)?) } else { None };
        Ok(Plan {
            options,
            n_control,
            counts,
            tables,
            face_sizes,
            corners,
            indices,
            face_parent,
            n_frozen,
            boundary_loops,
            rings,
            limit,
            patches,
            fingerprint,
        })
    }

    fn table(&mut self) -> Read<StencilTable> {
        let (n_sources, n_rows) = (self.number()?, self.number()?);
        let table =
            StencilTable { n_sources, n_rows, sources: self.list()?, weights: self.list()?, runs: self.list()? };
        self.check(all_below(&table.sources, n_sources))?;
        self.check_runs(&table.runs, n_rows, table.sources.len(), table.weights.len())?;
        Ok(table)
    }

    /// Rings and limits of `n_rows` vertices among `n_sources`, where there are any.
    fn surface(&mut self, n_rows: usize, n_sources: usize) -> Read<(Option<Rings>, Option<LimitTable>)> {
        self.part = "rings";
        let rings = if self.number()? != 0 { Some(self.rings(n_rows, n_sources)?) } else { None };
        self.part = "limit table";
        let limit = if self.number()? != 0 { Some(self.limit(n_rows, n_sources)?) } else { None };
        Ok((rings, limit))
    }

    fn limit(&mut self, n_rows: usize, n_sources: usize) -> Read<LimitTable> {
        let table = LimitTable { n_rows, sources: self.list()?, weights: self.list()?, runs: self.list()? };
        self.check(all_below(&table.sources, n_sources))?;
        self.check_runs(&table.runs, n_rows, table.sources.len(), table.weights.len())?;
        Ok(table)
    }

    fn patches(&mut self, n_control: usize, n_vertices: usize, options: &PlanOptions) -> Read<SharedPatches> {
        self.part = "patches";
        let n_classes = self.number()?;
        let mut classes = Vec::new();
        for _ in 0..n_classes {
            let n_steps = self.number()?;
            self.check(n_steps == options.levels as usize && n_steps > 0)?;
            let steps: Vec<StencilTable> = (0..n_steps).map(|_| self.table()).collect::<Read<_>>()?;
            let n_rows = self.number()?;
            let (rings, limit) = self.surface(n_rows, steps[n_steps - 1].n_rows)?;
            self.part = "patches";
            self.check(rings.is_some() == (options.normals == Normals::Faces))?;
            self.check(limit.is_some() == wants_limit(options))?;
            classes.push(Class { steps, n_rows, limit, rings });
        }
        let (groups, sources, deliveries) = (self.list()?, self.list()?, self.list()?);
        let patches = SharedPatches { n_control, n_vertices, classes, groups, sources, deliveries };
        self.check(patches.is_sound())?;
        Ok(patches)
    }

    fn check_runs(&self, runs: &[Run], n_rows: usize, n_entries: usize, n_weights: usize) -> Read<()> {
        let (mut row, mut entry) = (0, 0);
        for (i, run) in runs.iter().enumerate() {
            let end = runs.get(i + 1).map_or(n_rows, |next| next.first_row as usize);
            let len = run.row_len as usize;
            self.check(run.first_row as usize == row && end > row && len > 0 && run.first_entry as usize == entry)?;
            self.check((run.first_weight as usize).checked_add(len).is_some_and(|end| end <= n_weights))?;
            entry = entry.checked_add((end - row).saturating_mul(len)).map_or_else(|| self.wrong(), Ok)?;
            row = end;
        }
        self.check(row == n_rows && entry == n_entries)
    }

    fn rings(&mut self, n_vertices: usize, n_sources: usize) -> Read<Rings> {
        let rings = Rings { neighbours: self.list()?, runs: self.list::<RingRun>()?, n_vertices };
        self.check(all_below(&rings.neighbours, n_sources))?;
        let (mut vertex, mut entry) = (0, 0);
        for (i, run) in rings.runs.iter().enumerate() {
            let end = rings.runs.get(i + 1).map_or(n_vertices, |next| next.first_vertex as usize);
            self.check(run.first_vertex as usize == vertex && end > vertex && run.len > 1)?;
            self.check(run.first_entry as usize == entry)?;
            entry = entry.saturating_add((end - vertex).saturating_mul(run.len as usize));
            vertex = end;
        }
        self.check(vertex == n_vertices && entry == rings.neighbours.len())?;
        Ok(rings)
    }
}
