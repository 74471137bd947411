//! Commands and options, as clap reads them.

use super::turntable::Pattern;
use super::values::{self, Ground, Mixture, Setting, Share};
use crate::coat::Condition;
use crate::frame::Layers;
use crate::render::{Dress, Lens, Preset, Samples, View as Direction};
use crate::subdiv::{BoundaryRule, Creasing, LoopWeights, Rim, Scheme};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// The levels of subdivision that are offered.
pub(super) const MOST_LEVEL: i64 = 5;

/// A real-time, parametric dog's head.
#[derive(Debug, Parser)]
#[command(
    name = "londra",
    version,
    about = "A real-time, parametric dog's head: a window with sliders, pictures, glTF",
    after_help = "Without a command the window opens. Results go to stdout, messages to stderr.\n\
        Exit codes: 0 done, 1 failed, 2 wrong use, 3 no display or graphics adapter.\n\
        The folder named by the variable LONDRA_RIGS (with anatomy.ron and breeds/) overrides the built-in tables.\n\n\
        Examples:\n  \
        londra\n  \
        londra render --breed pug -o pug.png\n  \
        londra render --breed labrador --blend pug=0.3 --set stop_angle_deg=50 --view side -o mix.png\n  \
        londra export --breed borzoi -o borzoi.glb\n  \
        londra breed pug borzoi --litter 6 -o puppies\n  \
        londra sheet -o sheet.png\n  \
        londra subdivide cube.obj -o smooth.ply --scheme loop --level 3\n\n\
        'londra COMMAND --help' has more."
)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Open the window
    View(View),
    /// Draw a picture of a head as PNG
    Render(Render),
    /// Draw a contact sheet of breeds as PNG
    Sheet(Sheet),
    /// Draw a head that turns once round, as numbered PNG
    Turntable(Turntable),
    /// Draw what every measure, or every unit, does as PNG
    Atlas(Atlas),
    /// Have puppies of two dogs, or random dogs, as breed files
    Breed(Breed),
    /// Write a head as binary glTF
    Export(Export),
    /// Print a hash for each stage of a frame
    Hash(Hash),
    /// Print what a vet would measure
    Measure(Measure),
    /// Print every landmark's place, and in a view its pixel and whether it is seen
    Landmarks(Landmarks),
    /// List breeds, parameters, units, expressions or clips
    List(List),
    /// Find every mistake in breed files
    Check(Check),
    /// Draw the layout of the skin's texture as PNG
    Uv(UvLayout),
    /// Rebuild the baked assets in Londra's sources
    Bake(Bake),
    /// Subdivide any mesh
    Subdivide(Subdivide),
    /// Time a subdivision, frame by frame
    Bench(Bench),
    /// Report how similar the triangles of a mesh are and what that is worth
    Similarity(Similarity),
}

#[derive(Args, Debug, Default)]
#[command(after_help = "Examples:\n  londra view\n  londra view mine.ron\n  londra view --measure 200 --json\n  \
    londra view --measure 40 --size 1172x690 --hair low")]
pub(super) struct View {
    /// A breed's file to open
    #[arg(value_name = "FILE.ron")]
    pub file: Option<PathBuf>,
    /// Open no window: run so many of its pictures with a slider moving, and print what its own work takes
    #[arg(long, value_name = "PICTURES", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub measure: Option<u32>,
    /// Width and height of the window that is measured, pixels
    #[arg(long, value_name = "WxH", value_parser = values::size, requires = "measure")]
    pub size: Option<Size>,
    /// Level of subdivision to begin with, 0 to 5; without it 4, or 3 where a processor draws
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=MOST_LEVEL))]
    pub level: Option<u32>,
    #[command(flatten)]
    pub fur: Fur,
    /// Print a JSON object
    #[arg(long, requires = "measure")]
    pub json: bool,
}

/// Changes of a breed that every command understands.
#[derive(Args, Debug)]
pub(super) struct Changes {
    /// Which of the breed's coats it wears; without it, the first. 'londra list breeds' names them, and wherever a breed
    /// is named, NAME:COAT is understood
    #[arg(long, value_name = "NAME")]
    pub coat: Option<String>,
    /// Set a measure, in the unit its id ends in; may be repeated, the last one of an id holds
    #[arg(long = "set", value_name = "ID=VALUE", value_parser = values::setting)]
    pub set: Vec<Setting>,
    /// Mix in another breed; may be repeated, the breed itself keeps what is left of 1
    #[arg(long = "blend", value_name = "NAME|FILE.ron=WEIGHT", value_parser = values::share)]
    pub blend: Vec<Share>,
}

/// One head.
#[derive(Args, Debug)]
pub(super) struct Subject {
    /// A breed by name, or a file that ends in .ron
    #[arg(long, value_name = "NAME|FILE.ron")]
    pub breed: String,
    #[command(flatten)]
    pub changes: Changes,
}

/// How the result is told.
#[derive(Args, Debug)]
pub(super) struct Report {
    /// Print JSON: one object, or an array of objects where there are several
    #[arg(long)]
    pub json: bool,
}

/// How finely it is made.
#[derive(Args, Debug)]
pub(super) struct Detail {
    /// Level of subdivision, 0 to 5; each level has three times the triangles
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=MOST_LEVEL))]
    pub level: u32,
    /// Threads to compute with, 1 to 64; the result is the same to the bit
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub threads: u32,
}

/// From where and before what it is drawn.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct Scene {
    /// How far the nose is carried below the horizontal, degrees; each view has its own habit
    #[arg(long, value_name = "DEG", value_parser = values::pitch, allow_hyphen_values = true)]
    pub pitch: Option<f32>,
    /// Focal length in millimetres on 36 x 24, or ortho
    #[arg(long, value_name = "MM|ortho", default_value = "85")]
    pub lens: Lens,
    /// studio, daylight, clay (one matt colour without hair), plate (flat light before plain paper, for measuring), x-ray
    /// (bone through the skin), or silhouette (black on white): light, ground, layers and hair at once, each of which
    /// another option overrides
    #[arg(long, value_name = "NAME", default_value = "studio")]
    pub preset: Preset,
    /// plain or gradient (the preset's own colours), transparent, white, black, grey, silver, or rrggbb; without it, what
    /// the preset has
    #[arg(long, value_name = "plain|gradient|transparent|COLOUR", value_parser = values::background)]
    pub background: Option<Ground>,
    /// Samples of each pixel: 4 (fast), 16, 36 or 64 (smooth); without it 16
    #[arg(long, value_name = "N")]
    pub samples: Option<Samples>,
    /// What is there, with commas between: skin, eyes, whiskers, bone, teeth, mouth, tongue; skin=0.3 is seen
    /// through; without it, what the preset has, and what is seen in an open mouth where the head is asked to move
    #[arg(long, value_name = "A,B,C", value_parser = Layers::parse)]
    pub layers: Option<Layers>,
    #[command(flatten)]
    pub fur: Fur,
    /// How far the lids are closed, 0 to 1; two numbers with a comma: the left ones and the right ones
    #[arg(long, value_name = "PART|L,R", default_value = "0", value_parser = values::lids_closed)]
    pub lids_closed: Lids,
    /// Draw lines over the surfaces: the edges of the control mesh, or with =refined every edge
    #[arg(long, value_name = "control|refined", num_args = 0..=1, require_equals = true, default_missing_value = "control")]
    pub wireframe: Option<Wires>,
}

/// What the head does.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Motion")]
pub(super) struct Motion {
    /// Ask for a DogFACS unit, 0 to 1, with L or R on one side alone; may be repeated, the last one of a unit and side holds
    #[arg(long = "unit", value_name = "ID[L|R]=VALUE", value_parser = values::unit)]
    pub units: Vec<Setting>,
    /// Ask for units in DogFACS notation: codes joined by +, such as 101+12B+EAD103L; A to E are 0.2 to 1
    #[arg(long, value_name = "CODES")]
    pub facs: Option<String>,
    /// Mix in an expression, whole or by a weight of 0 to 1; may be repeated. Without --time as it shows itself best
    #[arg(long = "expression", value_name = "NAME[=WEIGHT]", value_parser = values::mixed)]
    pub expressions: Vec<Mixture>,
    /// Play a clip; may be repeated, the later ones lie over the earlier
    #[arg(long = "clip", value_name = "NAME")]
    pub clips: Vec<String>,
    /// Let it blink, breathe and look about by itself; the same seed gives the same life
    #[arg(long, value_name = "SEED", num_args = 0..=1, default_missing_value = "0")]
    pub life: Option<u64>,
    /// Seconds since clips, expressions and life began, 0 to 3600; without it clips and life are at their beginning
    #[arg(long, value_name = "SECONDS", value_parser = values::seconds, allow_hyphen_values = true)]
    pub time: Option<f64>,
}

impl Motion {
    /// Whether anything was asked for.
    pub(super) fn is_asked_for(&self) -> bool {
        let Self { units, facs, expressions, clips, life, time: _ } = self;
        !(units.is_empty() && facs.is_none() && expressions.is_empty() && clips.is_empty() && life.is_none())
    }
}

/// How much hair, and what it is like today.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(super) struct Fur {
    /// Strands of hair: off, low (10000), medium (90000), high (250000), or a number up to 500000; without it, medium for
    /// one head, low for a sheet, 1000 for a window that a processor draws, off for an atlas, below lines and where the preset
    /// has none
    #[arg(long, value_name = "off|low|medium|high|N", value_parser = values::hair)]
    pub hair: Option<u32>,
    /// Times the breed's length of hair, 0 to 3
    #[arg(long, value_name = "TIMES", value_parser = values::fur_length)]
    pub fur_length: Option<f32>,
    /// Part of the breed's hairs that are there, 0 to 1
    #[arg(long, value_name = "PART", value_parser = values::part)]
    pub fur_density: Option<f32>,
    /// How much of the coat is clipped to 4 mm, 0 to 1
    #[arg(long, value_name = "PART", value_parser = values::part)]
    pub clipped: Option<f32>,
    /// How wet it is, 0 to 1
    #[arg(long, value_name = "PART", value_parser = values::part)]
    pub wet: Option<f32>,
    /// How grey with age, 0 to 1: from the chin backwards and around the eyes
    #[arg(long, value_name = "PART", value_parser = values::part)]
    pub grey: Option<f32>,
}

impl Fur {
    /// What the coat is like today.
    pub(super) fn condition(&self) -> Condition {
        let usual = Condition::default();
        Condition {
            length: self.fur_length.unwrap_or(usual.length),
            density: self.fur_density.unwrap_or(usual.density),
            clipped: self.clipped.unwrap_or(usual.clipped),
            wet: self.wet.unwrap_or(usual.wet),
            grey: self.grey.unwrap_or(usual.grey),
        }
    }
}

/// How far the lids are closed, left and right.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lids(pub [f32; 2]);

/// Which lines.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Wires {
    /// Edges of the control mesh
    Control,
    /// Every edge of what is drawn
    Refined,
}

/// Where the result goes.
#[derive(Args, Debug)]
pub(super) struct Target {
    /// The file to write, - for stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    #[command(flatten)]
    pub report: Report,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    londra render --breed pug -o pug.png\n  \
    londra render --breed beagle --view side --size 800x600 --background none -o beagle.png\n  \
    londra render --breed pug --view side --preset x-ray -o xray.png\n  \
    londra render --breed pug --at K29 --zoom 8 -o eye.png\n  \
    londra render --breed labrador --expression fear=0.8 --unit AU101L=1 -o fear.png\n  \
    londra render --breed beagle --clip head_shake --fps 50 --size 320x320 -o shake.gif\n  \
    londra render --breed beagle --clip pant --frames 0..30 -o frames_%04d.png\n  \
    londra render --breed borzoi --blend pug=0.5 --view 120,20 --pitch 0 -o - | display")]
pub(super) struct Render {
    #[command(flatten)]
    pub subject: Subject,
    /// front, side, three-quarter, top, portrait, or AZIMUTH,ELEVATION in degrees (0 the face, 90 the dog's left)
    #[arg(
        long,
        value_name = "front|side|three-quarter|top|portrait|AZIMUTH,ELEVATION",
        default_value = "portrait",
        allow_hyphen_values = true
    )]
    pub view: Direction,
    /// Width and height of the picture, pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = values::size)]
    pub size: Size,
    /// How many times larger than the head that fills the picture, 1 to 40
    #[arg(long, value_name = "TIMES", default_value = "1", value_parser = values::zoom)]
    pub zoom: f32,
    /// The landmark in the middle of the picture, as 'londra landmarks' names them; of two, the left one, or with R the right
    #[arg(long, value_name = "ID[L|R]")]
    pub at: Option<String>,
    /// Draw a film: the frames from A on, before B, of which --fps make a second. OUT has %d or %04d for the frame's number,
    /// or ends in .gif, or in .mp4 where ffmpeg is installed. Without it a film has what its clips and expressions take
    #[arg(long, value_name = "A..B", value_parser = values::frames, conflicts_with = "time")]
    pub frames: Option<Frames>,
    /// Frames of a second of film, 1 to 240
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=240))]
    pub fps: u32,
    #[command(flatten)]
    pub scene: Scene,
    #[command(flatten)]
    pub motion: Motion,
    #[command(flatten)]
    pub detail: Detail,
    #[command(flatten)]
    pub target: Target,
}

#[derive(Args, Debug)]
#[command(after_help = "All frames have one scale, and the light stays where it is while the head turns under it.\n\n\
    Examples:\n  \
    londra turntable --breed pug -o turn_%04d.png\n  \
    londra turntable --breed borzoi --frames 360 --size 640x640 --background white -o frames/%03d.png")]
pub(super) struct Turntable {
    #[command(flatten)]
    pub subject: Subject,
    /// Where it begins, as for render
    #[arg(
        long,
        value_name = "front|side|three-quarter|top|portrait|AZIMUTH,ELEVATION",
        default_value = "portrait",
        allow_hyphen_values = true
    )]
    pub view: Direction,
    /// Pictures of the whole turn, 2 to 3600
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u32).range(2..=MOST_FRAMES))]
    pub frames: u32,
    /// Width and height of each picture, pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = values::size)]
    pub size: Size,
    #[command(flatten)]
    pub scene: Scene,
    #[command(flatten)]
    pub motion: Motion,
    #[command(flatten)]
    pub detail: Detail,
    /// The files to write: %d stands for the number of the frame, from 0 on, %04d for one of at least four digits
    #[arg(short, long, value_name = "OUT_%04d.png", value_parser = Pattern::parse)]
    pub output: Pattern,
    #[command(flatten)]
    pub report: Report,
}

/// How many pictures a turn has at most.
const MOST_FRAMES: i64 = 3600;

/// Width and height, pixels.
pub(super) type Size = [u32; 2];
/// Frames of a film.
pub(super) type Frames = std::ops::Range<u32>;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    londra sheet -o sheet.png\n  \
    londra sheet --breeds pug,borzoi,mine.ron --views front,side,-60,15 --fit -o three.png\n  \
    londra sheet --breeds pug,beagle --expression anger -o anger.png")]
pub(super) struct Sheet {
    /// Names or files with commas between, or all
    #[arg(long, value_name = "A,B,C|all", default_value = "all", value_delimiter = ',')]
    pub breeds: Vec<String>,
    /// One breed more or instead of all; may be repeated
    #[arg(long, value_name = "NAME|FILE.ron")]
    pub breed: Vec<String>,
    #[command(flatten)]
    pub changes: Changes,
    /// Views with commas between, as for render
    #[arg(
        long,
        value_name = "V1,V2",
        default_value = "portrait,front,side,top",
        value_parser = values::views,
        allow_hyphen_values = true
    )]
    pub views: Views,
    /// A column for each view in each of these, with commas between: clay, skin (colours without hair), coat; without it, as
    /// the scene has it
    #[arg(long, value_name = "clay,skin,coat", value_parser = values::dress(), value_delimiter = ',')]
    pub dress: Vec<Dress>,
    /// Width and height of the whole sheet, pixels; without it, cells of 320 by 320
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<Size>,
    /// Heads beside each other
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub columns: u32,
    /// A row for each head in each of these presets, with commas between, instead of in one
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', conflicts_with = "preset")]
    pub presets: Vec<Preset>,
    /// Let every head fill its cell instead of sharing one scale
    #[arg(long)]
    pub fit: bool,
    #[command(flatten)]
    pub scene: Scene,
    #[command(flatten)]
    pub motion: Motion,
    #[command(flatten)]
    pub detail: Detail,
    #[command(flatten)]
    pub target: Target,
}

#[derive(Args, Debug)]
#[command(
    after_help = "Each measure stands there at the low end, in the middle and at the high end of its range, all others as the \
    breed has them, under one camera.\n\
    'londra atlas --json' tells how much the two ends differ: the root mean square over the colours, of 255.\n\n\
    Examples:\n  \
    londra atlas -o docs/atlas.png\n  \
    londra atlas --breed pug --group ears --group nose --size 160x160 -o pug.png\n  \
    londra atlas --split -o docs/atlas.png\n  \
    londra atlas --units --breed beagle --size 320x320 -o units"
)]
pub(super) struct Atlas {
    /// A breed by name, or a file that ends in .ron
    #[arg(long, value_name = "NAME|FILE.ron", default_value = "labrador")]
    pub breed: String,
    /// Only this group of measures, such as ears or lips-and-jaw, or of units, such as upper-face; may be repeated
    #[arg(long, value_name = "GROUP")]
    pub group: Vec<String>,
    /// Width and height of one head, pixels; without it 68x68, or 240x240 for units
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<Size>,
    /// Measures beside each other
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=16))]
    pub columns: u32,
    /// Show every measure in this view, as for render; without it, in the one that shows it best
    #[arg(long, value_name = "front|side|three-quarter|top|portrait|AZIMUTH,ELEVATION", allow_hyphen_values = true)]
    pub view: Option<Direction>,
    #[command(flatten)]
    pub fur: Fur,
    /// Write a file for each group, such as atlas_ears.png beside atlas.png
    #[arg(long)]
    pub split: bool,
    /// Show DogFACS units instead of measures: OUT is a folder, with a file for each unit at 0, 0.5 and 1 from the front and
    /// at three quarters, and arrows from where landmarks are at rest to where they go
    #[arg(long, conflicts_with_all = ["split", "columns", "view"])]
    pub units: bool,
    #[command(flatten)]
    pub target: Target,
}

/// A list that is one word of the command line.
pub(super) type Views = std::vec::Vec<Direction>;

#[derive(Args, Debug)]
#[command(
    after_help = "Puppies (all of them grown) have each measure between their parents or a little beyond; how the ears are \
    carried, the coat and the iris come whole from one parent.\n\
    Random dogs differ as the breeds do, and each has the coat of one of them.\n\
    What --lock names stays as in --base (without it, as in the first parent), what --set names has that value; the rest of \
    a random dog goes with that.\n\
    The files are named A_x_B_1.ron and random_SEED_1.ron. The same words give the same bytes.\n\n\
    Examples:\n  \
    londra breed pug borzoi --litter 6 --seed 3 -o puppies\n  \
    londra breed --random --seed 7 -o dog.ron\n  \
    londra breed --random 12 --base beagle --lock ears --lock stop_angle_deg -o dogs\n  \
    londra breed --random 3 --set facial_length_mm=40 --json"
)]
pub(super) struct Breed {
    /// The two parents: breeds by name, or files that end in .ron
    #[arg(value_name = "A B", conflicts_with = "random")]
    pub parents: Vec<String>,
    /// How many puppies, 1 to 1000
    #[arg(long, value_name = "N", conflicts_with = "random", value_parser = clap::value_parser!(u32).range(1..=MOST_DOGS))]
    pub litter: Option<u32>,
    /// Random dogs instead of puppies; how many, 1 to 1000
    #[arg(
        long,
        value_name = "N",
        num_args = 0..=1,
        default_missing_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=MOST_DOGS)
    )]
    pub random: Option<u32>,
    /// What chance begins with; the same seed gives the same dogs
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// Keep a measure, a group such as ears or lips-and-jaw, or the coat; may be repeated
    #[arg(long, value_name = "ID|GROUP|coat")]
    pub lock: Vec<String>,
    /// The dog that locked values are taken from
    #[arg(long, value_name = "NAME|FILE.ron")]
    pub base: Option<String>,
    /// Give every dog this value, in the unit its id ends in; may be repeated
    #[arg(long = "set", value_name = "ID=VALUE", value_parser = values::setting)]
    pub set: Vec<Setting>,
    /// The folder to write into, made if need be; for one dog also a file that ends in .ron, - for stdout
    #[arg(short, long, value_name = "FOLDER|FILE.ron", required_unless_present = "json")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub report: Report,
}

/// How many dogs are made at a time.
const MOST_DOGS: i64 = 1000;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    londra export --breed pug -o pug.glb\n  \
    londra export --breed dalmatian --textures 2048 --threads 2 -o dalmatian.glb\n  \
    londra export --breed labrador --expression yawning -o yawn.glb\n  \
    londra export --breed beagle --units all --clips all --level 3 -o moving.glb\n  \
    londra export --breed beagle --units AU26,AU27,EAD103 --clips yawn,blink -o yawn.glb\n  \
    londra export --breed labrador --set ear_length_mm=150 --level 2 -o - > light.glb")]
pub(super) struct Export {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub motion: Motion,
    #[command(flatten)]
    pub detail: Detail,
    /// Paint the coat, the leather and the eyes into textures of so many texels a side (a power of two, 256 to 4096), instead of
    /// colours at the vertices
    #[arg(long, value_name = "SIZE", value_parser = values::texture)]
    pub textures: Option<u32>,
    /// Let the head move elsewhere: joints, and a morph target and a calibration reel for each of these DogFACS units
    #[arg(long = "units", value_name = "all|none|A,B,C", default_value = "none")]
    pub moving_units: String,
    /// Let the head move elsewhere: joints, and an animation for each of these expressions and clips
    #[arg(long = "clips", value_name = "all|none|A,B,C", default_value = "none")]
    pub moving_clips: String,
    /// Who holds the rights, as it shall stand in the file
    #[arg(long, value_name = "TEXT")]
    pub copyright: Option<String>,
    #[command(flatten)]
    pub target: Target,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    londra hash --breed pug\n  \
    londra hash --breed pug --clip pant --time 1.5\n  \
    londra hash --breed pug --blend borzoi=0.5 --level 2 --threads 8 --json")]
pub(super) struct Hash {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub motion: Motion,
    #[command(flatten)]
    pub detail: Detail,
    #[command(flatten)]
    pub report: Report,
}

#[derive(Args, Debug)]
#[command(
    after_help = "Lengths in millimetres, taken on the refined bone between its landmarks, and on the skin as on a live dog.\n\
    Percentiles are among the breeds of the tables in use.\n\n\
    Examples:\n  londra measure --breed pug\n  londra measure --breed labrador --set facial_length_mm=120 --json"
)]
pub(super) struct Measure {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub report: Report,
}

#[derive(Args, Debug)]
#[command(
    after_help = "Places are in millimetres in the head's frame: +x the dog's left, +y up, +z out of the nose; the origin lies \
    midway between the jaw's joints.\n\
    Pixels are those of 'londra render' with the same view, size, pitch and lens, from the top left corner.\n\n\
    Examples:\n  \
    londra landmarks --breed pug\n  \
    londra landmarks --breed labrador --blend pug=0.3 --json\n  \
    londra landmarks --breed borzoi --view front --size 800x600\n  \
    londra landmarks --breed labrador --unit AU27=1 --json\n  \
    londra landmarks --breed labrador --whiskers --json"
)]
pub(super) struct Landmarks {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub motion: Motion,
    /// Tell pixels too, in this view: as for render
    #[arg(long, value_name = "front|side|three-quarter|top|portrait|AZIMUTH,ELEVATION", allow_hyphen_values = true)]
    pub view: Option<Direction>,
    /// Width and height of the picture, pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = values::size, requires = "view")]
    pub size: Size,
    /// How far the nose is carried below the horizontal, degrees; each view has its own habit
    #[arg(long, value_name = "DEG", value_parser = values::pitch, allow_hyphen_values = true, requires = "view")]
    pub pitch: Option<f32>,
    /// Focal length in millimetres on 36 x 24, or ortho; without it, 85
    #[arg(long, value_name = "MM|ortho", requires = "view")]
    pub lens: Option<Lens>,
    /// Tell the whiskers instead: where each leaves the skin, which way, and how long it is
    #[arg(long, conflicts_with = "view")]
    pub whiskers: bool,
    #[command(flatten)]
    pub detail: Detail,
    #[command(flatten)]
    pub report: Report,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  londra list breeds\n  londra list parameters --json\n  londra list units")]
pub(super) struct List {
    /// What to list
    pub what: Listed,
    #[command(flatten)]
    pub report: Report,
}

/// What can be listed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Listed {
    /// Breeds by name
    Breeds,
    /// Measures with their ranges
    Parameters,
    /// DogFACS units
    Units,
    /// Expressions
    Expressions,
    /// Clips
    Clips,
}

#[derive(Args, Debug)]
#[command(after_help = "Prints path:line:column: message for the first syntax error or every error of meaning.\n\n\
    Examples:\n  londra check mine.ron\n  londra check rigs/breeds/*.ron --json")]
pub(super) struct Check {
    /// Breed files, or a table of parameters
    #[arg(value_name = "FILE.ron", required = true)]
    pub files: Vec<PathBuf>,
    #[command(flatten)]
    pub report: Report,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  londra uv -o uv.png\n  londra uv --size 4096 -o to_paint_over.png")]
pub(super) struct UvLayout {
    /// Pixels of a side
    #[arg(long, value_name = "PIXELS", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=8192))]
    pub size: u32,
    #[command(flatten)]
    pub target: Target,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  londra bake\n  londra bake --check")]
pub(super) struct Bake {
    /// Change nothing; fail if a file is not what the program makes
    #[arg(long)]
    pub check: bool,
    /// The folder of Londra's sources
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    pub root: PathBuf,
}

/// How fine at most. Faces run out long before: see [`MAX_FACES`](crate::subdiv::MAX_FACES).
const MOST_STEPS: i64 = 30;

#[derive(Args, Debug)]
#[command(
    after_help = "Reads obj (with the tags t crease, t corner and t hole), 3ds, stl, ply, gltf and glb; writes obj, ply and glb, \
    and pictures as png.\n\
    Triangle schemes cut polygons into fans; catmull-clark and doo-sabin keep them.\n\n\
    Examples:\n  \
    londra subdivide cube.obj -o smooth.obj --scheme catmull-clark --level 3\n  \
    londra subdivide part.stl -o part.ply --scheme loop --level 2 --crease-angle 40 --limit --normals\n  \
    londra subdivide head.ply -o honeycomb.obj --scheme sqrt3 --level 2 --dual\n  \
    londra subdivide head.glb --scheme sqrt3 --level 6 --adaptive 5 --json"
)]
pub(super) struct Subdivide {
    /// The mesh: a file, or - for stdin
    #[arg(value_name = "IN")]
    pub input: PathBuf,
    /// The file to write (.obj, .ply, .glb, or .png for a picture), - for OBJ on stdout
    #[arg(short, long, value_name = "OUT", required_unless_present = "json")]
    pub output: Option<PathBuf>,
    /// The scheme of all steps
    #[arg(long, value_parser = values::scheme())]
    pub scheme: Scheme,
    /// Number of steps
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=MOST_STEPS))]
    pub level: u32,
    /// Put the vertices where they go in the limit (sqrt3, loop; the interpolating schemes are there already)
    #[arg(long)]
    pub limit: bool,
    /// Write the three-connected dual of the last level (sqrt3, sqrt3-interpolating): 'middles' adds a vertex on each
    /// boundary edge that the last step has kept
    #[arg(
        long,
        value_name = "born|middles",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "born",
        conflicts_with_all = ["adaptive", "freeze_flatter_than"],
        value_parser = values::word(&[("born", Rim::Born), ("middles", Rim::Middles)])
    )]
    pub dual: Option<Rim>,
    /// Leave faces alone that no face of their two-ring is turned from by more than this, degrees (sqrt3)
    #[arg(long, value_name = "DEG", value_parser = values::angle, conflicts_with = "adaptive")]
    pub freeze_flatter_than: Option<f64>,
    /// Make edges sharp whose two faces are turned against each other by more than this, degrees
    #[arg(long, value_name = "DEG", value_parser = values::angle)]
    pub crease_angle: Option<f64>,
    /// What becomes of boundaries: smooth curves, or these with corners where a vertex has a single face
    #[arg(
        long,
        default_value = "edge",
        value_parser = values::word(&[("edge", BoundaryRule::EdgeOnly), ("edge-and-corner", BoundaryRule::EdgeAndCorner)])
    )]
    pub boundary: BoundaryRule,
    /// How sharpness is passed on: less by one a step, or averaged along the crease first
    #[arg(
        long,
        default_value = "uniform",
        value_parser = values::word(&[("uniform", Creasing::Uniform), ("chaikin", Creasing::Chaikin)])
    )]
    pub creasing: Creasing,
    /// Masks of loop: Loop's own or Warren's
    #[arg(
        long,
        default_value = "loop",
        value_parser = values::word(&[("loop", LoopWeights::Loop), ("warren", LoopWeights::Warren)])
    )]
    pub loop_weights: LoopWeights,
    /// Write normals too: of the faces, or with --limit of the limit surface
    #[arg(long)]
    pub normals: bool,
    /// Refine only where the surface is bent from a face by more than this, degrees (sqrt3); positions are of the limit
    #[arg(long, value_name = "DEG", value_parser = values::angle)]
    pub adaptive: Option<f64>,
    /// Print counts, bytes and times as a JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Args, Debug)]
#[command(
    after_help = "Every frame has other control positions. x_copy compares with copying all that is delivered.\n\n\
    Examples:\n  \
    londra bench --scheme sqrt3 --level 4 --normals\n  \
    londra bench --passes\n  \
    londra bench mesh.obj --scheme loop --level 3 --limit --threads 2 --json"
)]
pub(super) struct Bench {
    /// The mesh: a file, or - for stdin; without it, the head's control mesh
    #[arg(value_name = "MESH")]
    pub mesh: Option<PathBuf>,
    /// The scheme of all steps
    #[arg(long, value_parser = values::scheme(), default_value = "sqrt3")]
    pub scheme: Scheme,
    /// Number of steps
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=MOST_STEPS))]
    pub level: u32,
    /// Time what each pass of a picture of the head costs instead, for each level of hair
    #[arg(long, conflicts_with_all = ["mesh", "scheme", "threads", "limit", "normals"])]
    pub passes: bool,
    /// Width and height of that picture, pixels
    #[arg(long, value_name = "WxH", default_value = "800x600", value_parser = values::size, requires = "passes")]
    pub size: Size,
    /// The breed on it
    #[arg(long, value_name = "NAME|FILE.ron", default_value = "labrador", requires = "passes")]
    pub breed: String,
    /// Draw it as a window does on a software driver, whatever the driver is
    #[arg(long, requires = "passes")]
    pub draft: bool,
    /// Threads to compute with, 1 to 64
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub threads: u32,
    /// Deliver limit positions and limit normals (sqrt3, loop)
    #[arg(long, conflicts_with = "normals")]
    pub limit: bool,
    /// Deliver normals from faces
    #[arg(long)]
    pub normals: bool,
    /// Print a JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Args, Debug)]
#[command(
    after_help = "Three ways to a finer level, timed: subdividing one triangle of each class and mapping the rest, \
    subdividing anew, and evaluating a plan.\n\n\
    Examples:\n  \
    londra similarity icosahedron\n  \
    londra similarity part.stl --level 3 --folds --json"
)]
pub(super) struct Similarity {
    /// icosahedron, torus, a file, or - for stdin; tags of a file do not count
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,
    /// loop or butterfly
    #[arg(long, default_value = "loop", value_parser = values::scheme())]
    pub scheme: Scheme,
    /// The last level; without it 5 for the icosahedron and 2 for others
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=8))]
    pub level: Option<u32>,
    /// Largest weighted sum of measures at which triangles are similar
    #[arg(long, value_name = "E", default_value = "1e-8", value_parser = values::epsilon)]
    pub epsilon: f64,
    /// Compare the folds around triangles too: exact, and with more classes
    #[arg(long)]
    pub folds: bool,
    /// Take mirror images for different
    #[arg(long)]
    pub no_mirrored: bool,
    /// Print a JSON object
    #[arg(long)]
    pub json: bool,
}
