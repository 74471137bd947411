//! A small patch language for the topology of a bilaterally symmetric head.
//!
//! A patch file lists verbs. Each adds named vertices or triangles to one half (x ≥ 0) of the mesh:
//! `Grid`, `Alias`, `Band`, `Zip`, `Pole`; `midline` names the vertices that both halves share, `regions` what every
//! vertex belongs to, `landmarks` the named points. Shape is no business of this file: it places nothing in space.
//!
//! A *chain* is a list of vertex names in which a number may be a range: `s.0.0..9` is ten names, `s.8..11.2` four.

use crate::anatomy::Region;
use crate::rig::HalfMesh;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A patch file as written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatchFile {
    /// Format version, 1.
    pub version: u32,
    /// The verbs, in order.
    pub verbs: Vec<Verb>,
    /// Chains of vertices with x = 0.
    pub midline: Vec<String>,
    /// Region of each vertex: the last matching chain wins.
    pub regions: Vec<(Region, Vec<String>)>,
    /// Named loops that the shape and the motion use.
    pub loops: BTreeMap<String, Vec<String>>,
    /// Named points: landmark id, name, vertex.
    pub landmarks: Vec<(String, String, String)>,
    /// Edges of the skin: name, chains of vertices along it, sharpness in double steps of √3.
    #[serde(default)]
    pub creases: Vec<(String, Vec<String>, f32)>,
    /// Charts of the texture's layout: a face belongs to the last that has all its corners.
    pub charts: Vec<ChartPatch>,
}

/// A chart of the texture's layout.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartPatch {
    /// Its name.
    pub name: String,
    /// Chains of its vertices; none at all are all vertices.
    #[serde(default)]
    pub vertices: Vec<String>,
    /// Chains in the median plane where it joins its mirror image.
    #[serde(default)]
    pub join: Vec<String>,
    /// Length in the layout against length on the skin, beside the other charts.
    #[serde(default = "even")]
    pub density: f64,
}

fn even() -> f64 {
    1.0
}

/// One step of a patch file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Verb {
    /// Vertices `name.i.j` for rows and columns (inclusive) and two triangles a cell, all split along the same diagonal.
    Grid {
        /// First part of the vertices' names.
        name: String,
        /// First and last row.
        rows: (i32, i32),
        /// First and last column.
        cols: (i32, i32),
        /// Turned the other way round.
        #[serde(default)]
        flip: bool,
        /// Blocks of cells left out: row, column, rows, columns.
        #[serde(default)]
        holes: Vec<(i32, i32, i32, i32)>,
        /// Cells (by their first corner) split along the other diagonal.
        #[serde(default)]
        cross: Vec<(i32, i32)>,
        /// Names that stand for vertices made before, as two chains of equal length.
        #[serde(default)]
        alias: Vec<(String, String)>,
    },
    /// A new closed or open row of vertices `name.k` beside a chain, joined to it by a strip of quads.
    Band {
        /// The chain to start from.
        from: Vec<String>,
        /// Name of the new row.
        name: String,
        /// Whether the last vertex joins the first.
        closed: bool,
    },
    /// A new closed row of `count` vertices inside a closed chain of another number, joined by triangles.
    Ring {
        /// The closed chain to start from.
        from: Vec<String>,
        /// Name of the new row.
        name: String,
        /// Number of its vertices.
        count: usize,
        /// Turn of each vertex of `from`, in degrees, increasing.
        from_deg: Vec<f64>,
        /// Turn of each new vertex, in degrees, increasing.
        ring_deg: Vec<f64>,
    },
    /// New vertices without triangles, for a chain that a later verb uses.
    Points(Vec<String>),
    /// A strip of triangles between two open chains of any lengths that may share their ends.
    Strip(Vec<String>, Vec<String>),
    /// One vertex `name` in the middle of a closed chain.
    Pole {
        /// The closed chain.
        from: Vec<String>,
        /// Name of the new vertex.
        name: String,
    },
}

/// Why a patch file makes no mesh.
#[derive(Debug, thiserror::Error)]
pub enum PatchError {
    /// A chain names a vertex that no verb has made.
    #[error("unknown vertex `{0}`")]
    UnknownVertex(String),
    /// A chain's text is not a list of numbers and ranges.
    #[error("`{0}` is not a vertex name such as `s.3.9` or a range such as `s.0..3.9`")]
    BadName(String),
    /// Two names for one thing must come in equal numbers.
    #[error("alias `{0}` and `{1}` name different numbers of vertices")]
    AliasLength(String, String),
    /// A triangle meets the mesh made so far in an edge that has two triangles already.
    #[error("triangle {0}, {1}, {2} would be the third at an edge")]
    ThirdFace(String, String, String),
    /// A vertex was made and given no region.
    #[error("vertex `{0}` has no region")]
    NoRegion(String),
    /// Two neighbours of a crease's chain are no neighbours in the mesh.
    #[error("crease `{0}` runs from `{1}` to `{2}`, but no edge joins them")]
    NoEdge(String, String, String),
    /// The angles of a ring do not fit its vertices.
    #[error("ring `{0}` needs one angle for each vertex, increasing")]
    RingAngles(String),
}

/// Expands one name with ranges.
fn expand(name: &str) -> Result<Vec<String>, PatchError> {
    let bad = || PatchError::BadName(name.to_owned());
    // `..` inside a part is a range, a single `.` ends the part.
    let protected = name.replace("..", "~");
    let mut out = vec![String::new()];
    for (n, part) in protected.split('.').enumerate() {
        let choices: Vec<String> = match part.split_once('~') {
            None => vec![part.to_owned()],
            Some((a, b)) => {
                let (a, b): (i32, i32) = (a.parse().map_err(|_| bad())?, b.parse().map_err(|_| bad())?);
                if a <= b {
                    (a..=b).map(|k| k.to_string()).collect()
                } else {
                    (b..=a).rev().map(|k| k.to_string()).collect()
                }
            }
        };
        let dot = if n == 0 { "" } else { "." };
        out = out.iter().flat_map(|head| choices.iter().map(move |c| format!("{head}{dot}{c}"))).collect();
    }
    Ok(out)
}

struct Builder {
    tags: Vec<String>,
    index: BTreeMap<String, u16>,
    faces: Vec<[u16; 3]>,
    edges: BTreeMap<(u16, u16), usize>,
}

impl Builder {
    fn vertex(&mut self, tag: &str) -> u16 {
        if let Some(&v) = self.index.get(tag) {
            return v;
        }
        let v = self.tags.len() as u16;
        self.tags.push(tag.to_owned());
        self.index.insert(tag.to_owned(), v);
        v
    }

    fn chain(&self, names: &[String]) -> Result<Vec<u16>, PatchError> {
        let mut out = Vec::new();
        for name in names {
            for tag in expand(name)? {
                out.push(*self.index.get(&tag).ok_or(PatchError::UnknownVertex(tag))?);
            }
        }
        Ok(out)
    }

    /// Adds a triangle, turned round if that is how it fits the edges made so far.
    fn face(&mut self, a: u16, b: u16, c: u16) -> Result<(), PatchError> {
        for [a, b, c] in [[a, b, c], [a, c, b]] {
            let edges = [(a, b), (b, c), (c, a)];
            if edges.iter().all(|e| !self.edges.contains_key(e)) {
                for e in edges {
                    self.edges.insert(e, self.faces.len());
                }
                self.faces.push([a, b, c]);
                return Ok(());
            }
        }
        let name = |v: u16| self.tags[v as usize].clone();
        Err(PatchError::ThirdFace(name(a), name(b), name(c)))
    }

    fn run(&mut self, verb: &Verb) -> Result<(), PatchError> {
        match verb {
            Verb::Grid { name, rows, cols, flip, holes, cross, alias } => {
                for (new, old) in alias {
                    let (new_tags, old) = (expand(new)?, self.chain(std::slice::from_ref(old))?);
                    if new_tags.len() != old.len() {
                        return Err(PatchError::AliasLength(new.clone(), format!("{} vertices", old.len())));
                    }
                    self.index.extend(new_tags.into_iter().zip(old));
                }
                self.grid(name, *rows, *cols, *flip, holes, cross)
            }
            Verb::Band { from, name, closed } => {
                let from = self.chain(from)?;
                let row: Vec<u16> = (0..from.len()).map(|k| self.vertex(&format!("{name}.{k}"))).collect();
                let n = from.len();
                for k in 0..if *closed { n } else { n - 1 } {
                    let (a, b, c, d) = (from[k], from[(k + 1) % n], row[(k + 1) % n], row[k]);
                    self.face(a, b, c)?;
                    self.face(a, c, d)?;
                }
                Ok(())
            }
            Verb::Ring { from, name, count, from_deg, ring_deg } => {
                let from = self.chain(from)?;
                let increasing = |d: &[f64]| d.windows(2).all(|w| w[0] < w[1]);
                if from_deg.len() != from.len()
                    || ring_deg.len() != *count
                    || !increasing(from_deg)
                    || !increasing(ring_deg)
                {
                    return Err(PatchError::RingAngles(name.clone()));
                }
                let row: Vec<u16> = (0..*count).map(|k| self.vertex(&format!("{name}.{k}"))).collect();
                self.zip_closed(&from, from_deg, &row, ring_deg)
            }
            Verb::Points(names) => {
                for name in names {
                    for tag in expand(name)? {
                        self.vertex(&tag);
                    }
                }
                Ok(())
            }
            Verb::Strip(a, b) => {
                let (a, b) = (self.chain(a)?, self.chain(b)?);
                self.strip(&a, &b)
            }
            Verb::Pole { from, name } => {
                let from = self.chain(from)?;
                let pole = self.vertex(name);
                for k in 0..from.len() {
                    self.face(from[k], from[(k + 1) % from.len()], pole)?;
                }
                Ok(())
            }
        }
    }

    fn grid(
        &mut self,
        name: &str,
        rows: (i32, i32),
        cols: (i32, i32),
        flip: bool,
        holes: &[(i32, i32, i32, i32)],
        cross: &[(i32, i32)],
    ) -> Result<(), PatchError> {
        let inside = |i: i32, j: i32| holes.iter().any(|&(r, c, h, w)| i > r && i < r + h && j > c && j < c + w);
        let cell_out = |i: i32, j: i32| holes.iter().any(|&(r, c, h, w)| i >= r && i < r + h && j >= c && j < c + w);
        for i in rows.0..=rows.1 {
            for j in cols.0..=cols.1 {
                if !inside(i, j) {
                    self.vertex(&format!("{name}.{i}.{j}"));
                }
            }
        }
        for i in rows.0..rows.1 {
            for j in cols.0..cols.1 {
                if cell_out(i, j) {
                    continue;
                }
                let at = |b: &mut Self, i: i32, j: i32| b.vertex(&format!("{name}.{i}.{j}"));
                let (a, b, c, d) = (at(self, i, j), at(self, i, j + 1), at(self, i + 1, j + 1), at(self, i + 1, j));
                let tris = if cross.contains(&(i, j)) { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] };
                for [p, q, r] in tris {
                    if p == q || q == r || r == p {
                        continue;
                    }
                    if flip { self.face(p, r, q)? } else { self.face(p, q, r)? }
                }
            }
        }
        Ok(())
    }

    /// Joins two closed rows by walking both by angle; the smaller next angle gives the next triangle.
    fn zip_closed(&mut self, a: &[u16], ta: &[f64], b: &[u16], tb: &[f64]) -> Result<(), PatchError> {
        let (n, m) = (a.len(), b.len());
        let turn = |t: &[f64], k: usize| t[k % t.len()] + 360.0 * (k / t.len()) as f64;
        let (mut i, mut j) = (0, 0);
        while i < n || j < m {
            let next_a = (turn(ta, i) + turn(ta, i + 1)) / 2.0;
            let next_b = (turn(tb, j) + turn(tb, j + 1)) / 2.0;
            if j >= m || (i < n && next_a <= next_b) {
                self.face(a[i % n], a[(i + 1) % n], b[j % m])?;
                i += 1;
            } else {
                self.face(a[i % n], b[(j + 1) % m], b[j % m])?;
                j += 1;
            }
        }
        Ok(())
    }

    /// Joins two open chains by arc position; shared ends make single triangles.
    fn strip(&mut self, a: &[u16], b: &[u16]) -> Result<(), PatchError> {
        let (n, m) = (a.len() - 1, b.len() - 1);
        let (mut i, mut j) = (0, 0);
        while i < n || j < m {
            let step_a = j >= m || (i < n && (i + 1) * m <= (j + 1) * n);
            let (p, q, r) = if step_a { (a[i], a[i + 1], b[j]) } else { (a[i], b[j + 1], b[j]) };
            if step_a {
                i += 1
            } else {
                j += 1
            }
            if p != q && q != r && r != p {
                self.face(p, q, r)?;
            }
        }
        Ok(())
    }
}

/// The vertices that chains name.
///
/// # Errors
/// A name that is none, or that the mesh has not.
pub fn vertices(half: &HalfMesh, chains: &[String]) -> Result<Vec<u16>, PatchError> {
    let mut out = Vec::new();
    for chain in chains {
        for tag in expand(chain)? {
            let found = half.tags.iter().position(|t| *t == tag).ok_or(PatchError::UnknownVertex(tag))?;
            out.push(found as u16);
        }
    }
    Ok(out)
}

/// Runs a patch file; the base positions of the result are zero.
///
/// # Errors
/// [`PatchError`] names the first vertex or triangle that does not fit.
pub fn build(file: &PatchFile) -> Result<HalfMesh, PatchError> {
    let mut b = Builder { tags: Vec::new(), index: BTreeMap::new(), faces: Vec::new(), edges: BTreeMap::new() };
    for verb in &file.verbs {
        b.run(verb)?;
    }
    let mut midline = vec![false; b.tags.len()];
    for v in b.chain(&file.midline)? {
        midline[v as usize] = true;
    }
    let mut regions = vec![None; b.tags.len()];
    for (region, chain) in &file.regions {
        for v in b.chain(chain)? {
            regions[v as usize] = Some(*region);
        }
    }
    let regions = regions
        .into_iter()
        .enumerate()
        .map(|(v, r)| r.ok_or_else(|| PatchError::NoRegion(b.tags[v].clone())))
        .collect::<Result<_, _>>()?;
    let loops = file
        .loops
        .iter()
        .map(|(name, chain)| Ok((name.clone(), b.chain(chain)?)))
        .collect::<Result<_, PatchError>>()?;
    let landmarks = file
        .landmarks
        .iter()
        .map(|(id, name, tag)| Ok((id.clone(), name.clone(), b.chain(std::slice::from_ref(tag))?[0])))
        .collect::<Result<_, PatchError>>()?;
    let mut creases = Vec::new();
    for (name, chain, sharpness) in &file.creases {
        for pair in b.chain(chain)?.windows(2) {
            let (v, w) = (pair[0], pair[1]);
            if !b.edges.contains_key(&(v, w)) && !b.edges.contains_key(&(w, v)) {
                let tag = |v: u16| b.tags[v as usize].clone();
                return Err(PatchError::NoEdge(name.clone(), tag(v), tag(w)));
            }
            creases.push((v, w, *sharpness));
        }
    }
    let base = vec![[0.0; 3]; b.tags.len()];
    let (version, tags, faces, limits) = (1, b.tags, b.faces, Vec::new());
    Ok(HalfMesh { version, tags, midline, regions, faces, loops, landmarks, creases, limits, base })
}
