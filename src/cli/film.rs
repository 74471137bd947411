//! `londra render` of more than one frame: numbered pictures, a GIF, or an MP4 through an installed ffmpeg.

use super::args::{Frames, Render};
use super::motion::Director;
use super::picture::{MARGIN, drawing, hair_of, offscreen};
use super::rigs::Rigs;
use super::turntable::Pattern;
use super::values::MOST_FRAMES;
use super::{Failure, output, subject};
use crate::anatomy::Breed;
use crate::app::disk::write_atomic;
use crate::frame::Pipeline;
use crate::render::{Camera, Picture};
use glam::Vec3;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Moments at which a film is looked at before it is drawn, so that no frame leaves the picture.
const PROBES: u32 = 12;

/// Whether the words ask for a film and not for one picture.
pub(super) fn is_asked_for(args: &Render) -> bool {
    let output = &args.target.output;
    args.frames.is_some() || Container::of(output).is_some() || output.to_string_lossy().contains('%')
}

/// Draws the frames one after another.
pub(super) fn run(args: &Render) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    if args.motion.time.is_some() {
        return Err(Failure::Use("a film has a time of its own: leave out --time".into()));
    }
    let rigs = Rigs::open()?;
    let mut director = Director::new(&args.motion, args.scene.lids_closed)?;
    director.let_time_pass();
    let frames = frames(args, &director)?;
    let mut reel = Reel::open(args)?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    super::picture::prepared(&mut pipeline, &args.scene, &args.motion)?;
    let mut offscreen = offscreen()?;

    let time = |frame: u32| f64::from(frame) / f64::from(args.fps);
    let n_strands = hair_of(&args.scene);
    // The camera stands still; it is placed without hair, which would only cost time.
    pipeline.set_hair(0);
    let camera = camera(args, &rigs, &director, &mut pipeline, &breed, (time(frames.start), time(frames.end - 1)));
    pipeline.set_hair(n_strands as usize);

    let bar = progress(frames.len() as u64);
    let mut film = director.film(&rigs, &breed);
    for number in frames.clone() {
        pipeline.set_pose(film.at(time(number)));
        let frame = pipeline.update(&breed);
        let picture = offscreen.draw(&frame, &drawing(&args.scene, camera), args.size).map_err(Failure::work)?;
        reel.add(number, &picture)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    reel.finish()?;
    let name = args.target.output.display().to_string();
    if args.target.report.json {
        let [width, height] = args.size;
        return output::json(&json!({
            "output": name, "first": frames.start, "frames": frames.len(), "fps": args.fps, "width": width,
            "height": height, "breed": breed.id, "label": breed.label, "level": args.detail.level,
        }));
    }
    output::message(&format!("wrote {} frames to {name}", frames.len()));
    Ok(())
}

/// Those that were asked for, or as many as clips and expressions take.
fn frames(args: &Render, director: &Director) -> Result<Frames, Failure> {
    if let Some(frames) = &args.frames {
        return Ok(frames.clone());
    }
    let seconds = director.seconds().ok_or_else(|| {
        Failure::Use("how long shall the film be? Say --frames A..B, or name a clip or an expression".into())
    })?;
    let n = (seconds * f64::from(args.fps)).round().clamp(1.0, MOST_FRAMES as f64);
    Ok(0..n as u32)
}

fn camera(
    args: &Render,
    rigs: &Rigs,
    director: &Director,
    pipeline: &mut Pipeline,
    breed: &Breed,
    (first, last): (f64, f64),
) -> Camera {
    let mut film = director.film(rigs, breed);
    let mut points: Vec<Vec3> = Vec::new();
    for probe in 0..=PROBES {
        let time = first + (last - first) * f64::from(probe) / f64::from(PROBES);
        pipeline.set_pose(film.at(time));
        points.extend(pipeline.update(breed).outline());
    }
    let mut camera = Camera::at(args.view, args.scene.pitch, args.scene.lens);
    camera.fit(points.iter(), args.size[0] as f32 / args.size[1] as f32, MARGIN);
    camera.zoom(args.zoom);
    camera
}

/// A bar on stderr where somebody looks at it.
fn progress(n: u64) -> ProgressBar {
    let is_seen = std::io::stderr().is_terminal();
    let target = if is_seen { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} frames, {eta} left");
    ProgressBar::with_draw_target(Some(n), target).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// A file that holds all frames.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Container {
    Gif,
    Mp4,
}

impl Container {
    fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "gif" => Some(Self::Gif),
            "mp4" => Some(Self::Mp4),
            _ => None,
        }
    }
}

/// Where frames go.
enum Reel {
    Pictures(Pattern),
    Gif { encoder: Box<gif::Encoder<Vec<u8>>>, path: PathBuf, fps: u32, n: u32 },
    Mp4 { child: Child },
}

impl Reel {
    fn open(args: &Render) -> Result<Self, Failure> {
        let path = &args.target.output;
        match Container::of(path) {
            Some(Container::Gif) => {
                let [width, height] = args.size.map(|side| side as u16);
                let mut encoder = gif::Encoder::new(Vec::new(), width, height, &[]).map_err(Failure::work)?;
                encoder.set_repeat(gif::Repeat::Infinite).map_err(Failure::work)?;
                Ok(Self::Gif { encoder: Box::new(encoder), path: path.clone(), fps: args.fps, n: 0 })
            }
            Some(Container::Mp4) => Ok(Self::Mp4 { child: ffmpeg(path, args.size, args.fps)? }),
            None => Pattern::parse(&path.to_string_lossy())
                .map(Self::Pictures)
                .map_err(|error| Failure::Use(format!("{error}, or a file that ends in .gif or .mp4"))),
        }
    }

    fn add(&mut self, number: u32, picture: &Picture) -> Result<(), Failure> {
        match self {
            Self::Pictures(pattern) => output::bytes(&pattern.path(number), &picture.to_png().map_err(Failure::work)?),
            Self::Gif { encoder, fps, n, .. } => {
                let (width, height) = (picture.width as u16, picture.height as u16);
                let mut frame = gif::Frame::from_rgba_speed(width, height, &mut picture.rgba.clone(), 10);
                // Delays are whole hundredths of a second: what one frame is too short, a later one is longer.
                let until = |n: u32| (100 * u64::from(n) / u64::from(*fps)) as u16;
                frame.delay = until(*n + 1) - until(*n);
                frame.dispose = gif::DisposalMethod::Background;
                *n += 1;
                encoder.write_frame(&frame).map_err(Failure::work)
            }
            Self::Mp4 { child, .. } => {
                let pipe = child.stdin.as_mut().ok_or_else(|| Failure::work("ffmpeg takes no pictures"))?;
                // Why it stopped listening is told by `finish`.
                let _ = pipe.write_all(&picture.rgba);
                Ok(())
            }
        }
    }

    fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Pictures(_) => Ok(()),
            Self::Gif { encoder, path, .. } => {
                let bytes = encoder.into_inner().map_err(Failure::work)?;
                Ok(write_atomic(&path, &bytes)?)
            }
            Self::Mp4 { mut child } => {
                drop(child.stdin.take());
                let done = child.wait_with_output().map_err(Failure::work)?;
                if done.status.success() {
                    return Ok(());
                }
                let said = String::from_utf8_lossy(&done.stderr);
                let last = said.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("no reason");
                Err(Failure::work(format!("ffmpeg could not make the film: {last}")))
            }
        }
    }
}

fn ffmpeg(path: &Path, [width, height]: [u32; 2], fps: u32) -> Result<Child, Failure> {
    let mut command = Command::new("ffmpeg");
    command
        .args(["-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"])
        .args(["-s", &format!("{width}x{height}"), "-r", &fps.to_string(), "-i", "-"])
        // Most players take even sizes and this form of colours alone; which form it is, they only guess unless they are told.
        .args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"])
        .args(["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"])
        // Fine enough for fur, and a film that plays while it loads.
        .args(["-crf", "18", "-movflags", "+faststart"])
        .arg(path)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command.spawn().map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => Failure::work(
            "an .mp4 needs the program ffmpeg, which is not installed (Debian: apt install ffmpeg); a .gif or numbered \
            pictures (frames_%04d.png) need none",
        ),
        _ => Failure::work(format!("ffmpeg cannot be started: {error}")),
    })
}
