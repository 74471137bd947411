//! Which schemes there are, what a step of each does to the counts, and the options of a plan.

/// A subdivision scheme. The set is closed: it is matched exhaustively, and each scheme has its file of masks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scheme {
    /// √3 subdivision, Kobbelt 2000: three triangles for one.
    #[default]
    Sqrt3,
    /// Interpolating √3 subdivision, Labsik and Greiner 2000: the faces of √3, and control points that stay.
    Sqrt3Interpolating,
    /// Loop 1987: four triangles for one.
    Loop,
    /// Modified butterfly, Zorin, Schröder and Sweldens 1996: the faces of Loop, and control points that stay.
    Butterfly,
    /// Catmull and Clark 1978: a quadrilateral for each corner of a polygon.
    CatmullClark,
    /// Doo and Sabin 1978: a face for each vertex, edge and face of a polygon mesh.
    DooSabin,
}

/// How a step cuts faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Split {
    /// A triangle into three, with flipped edges.
    Thirds,
    /// A triangle into four.
    Quarters,
    /// A polygon into a quadrilateral for each corner.
    Corners,
    /// A face for each face, edge and vertex.
    Dual,
}

/// What a step of √3 does at the boundary and along creases. It alternates over the whole plan, from level 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundaryStep {
    /// Steps 0, 2, 4…: boundary edges and vertices stay as they are.
    Keep,
    /// Steps 1, 3, 5…: each boundary edge becomes three.
    Trisect,
}

impl BoundaryStep {
    /// The kind of step that leads from `level` to `level + 1`.
    pub fn from_level(level: u32) -> BoundaryStep {
        if level.is_multiple_of(2) { BoundaryStep::Keep } else { BoundaryStep::Trisect }
    }
}

impl Scheme {
    /// All schemes.
    pub const ALL: [Scheme; 6] = [
        Scheme::Sqrt3,
        Scheme::Sqrt3Interpolating,
        Scheme::Loop,
        Scheme::Butterfly,
        Scheme::CatmullClark,
        Scheme::DooSabin,
    ];

    /// The name used in fingerprints, files and arguments; it never changes.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::Sqrt3 => "sqrt3",
            Scheme::Sqrt3Interpolating => "sqrt3-interpolating",
            Scheme::Loop => "loop",
            Scheme::Butterfly => "butterfly",
            Scheme::CatmullClark => "catmull-clark",
            Scheme::DooSabin => "doo-sabin",
        }
    }

    /// The scheme of that name.
    pub fn from_name(name: &str) -> Option<Scheme> {
        Scheme::ALL.into_iter().find(|scheme| scheme.name() == name)
    }

    /// Whether it refines triangles only; the others take polygons of any size.
    pub fn is_triangular(self) -> bool {
        matches!(self.split(), Split::Thirds | Split::Quarters)
    }

    /// Whether control points stay where they are.
    pub fn is_interpolating(self) -> bool {
        matches!(self, Scheme::Sqrt3Interpolating | Scheme::Butterfly)
    }

    /// Whether edges and vertices can be tagged as sharp.
    pub fn has_creases(self) -> bool {
        matches!(self, Scheme::Sqrt3 | Scheme::Loop | Scheme::Butterfly | Scheme::CatmullClark)
    }

    /// Whether it has masks of limit positions and tangents of its own. Interpolating schemes have the positions.
    pub fn has_limits(self) -> bool {
        matches!(self, Scheme::Sqrt3 | Scheme::Loop)
    }

    /// How many faces one triangle becomes in one step, on the boundary too; none for polygon schemes.
    pub fn faces_per_face(self) -> Option<u64> {
        match self.split() {
            Split::Thirds => Some(3),
            Split::Quarters => Some(4),
            Split::Corners | Split::Dual => None,
        }
    }

    pub(super) fn split(self) -> Split {
        match self {
            Scheme::Sqrt3 | Scheme::Sqrt3Interpolating => Split::Thirds,
            Scheme::Loop | Scheme::Butterfly => Split::Quarters,
            Scheme::CatmullClark => Split::Corners,
            Scheme::DooSabin => Split::Dual,
        }
    }
}

/// How far an old vertex moves in a step of Loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LoopWeights {
    /// Loop 1987: (5/8 - (3/8 + cos(2π/n)/4)²) shared by the neighbours.
    #[default]
    Loop,
    /// Warren 1995: 3/8 shared by the neighbours, for three of them 9/16.
    Warren,
}

/// What becomes of vertices on a boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BoundaryRule {
    /// Boundaries are smooth curves.
    #[default]
    EdgeOnly,
    /// So they are, but boundary vertices with a single face stay: corners.
    EdgeAndCorner,
}

/// How the sharpness of an edge passes to its parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Creasing {
    /// Less by one a step.
    #[default]
    Uniform,
    /// Averaged along the crease first (DeRose, Kass and Truong 1998, section 4.2, after Chaikin).
    Chaikin,
}

/// Which positions a plan delivers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Positions {
    /// Those of the last level.
    #[default]
    Level,
    /// Where the vertices of the last level go in the limit.
    Limit,
}

/// Which normals a plan delivers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Normals {
    /// Area-weighted over the faces around, at the positions delivered.
    #[default]
    Faces,
    /// Those of the limit surface, from its tangents.
    Limit,
    /// None: positions are all that is wanted.
    None,
}

/// What to build a plan for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PlanOptions {
    /// The scheme of all steps.
    pub scheme: Scheme,
    /// Number of steps.
    pub levels: u32,
    /// Masks of Loop; other schemes pass it over.
    pub loop_weights: LoopWeights,
    /// What becomes of boundary vertices.
    pub boundary: BoundaryRule,
    /// How sharpness is passed on.
    pub creasing: Creasing,
    /// Which positions to deliver.
    pub positions: Positions,
    /// Which normals to deliver.
    pub normals: Normals,
}

impl PlanOptions {
    /// A scheme and a depth; everything else as by default.
    pub fn new(scheme: Scheme, levels: u32) -> PlanOptions {
        PlanOptions { scheme, levels, ..PlanOptions::default() }
    }
}
