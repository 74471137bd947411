//! Words of the command line as values. Each error says what would be right.

use super::args::{Frames, Lids};
use crate::anatomy::{colour, nearest};
use crate::coat;
use crate::export::TEXTURE_SIZES;
use crate::render::{Background, Dress, Preset, View};
use crate::subdiv::Scheme;
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// `ID=VALUE`, not yet compared with the table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setting {
    pub id: String,
    pub value: f64,
}

/// `NAME=WEIGHT` or `FILE=WEIGHT`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Share {
    pub breed: String,
    pub weight: f32,
}

/// `NAME` or `NAME=WEIGHT`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mixture {
    pub name: String,
    pub weight: f32,
}

/// `ID=VALUE` with a value from 0 to 1; which units there are, the table knows.
pub(super) fn unit(text: &str) -> Result<Setting, String> {
    let (id, value) = text.split_once('=').ok_or("say ID=VALUE, such as AU101=0.7 or EAD103L=1")?;
    let value = number(value)?;
    if !(0.0..=1.0).contains(&value) {
        return Err(format!("{} is {value}, allowed 0 to 1", id.trim()));
    }
    Ok(Setting { id: id.trim().to_owned(), value })
}

pub(super) fn mixed(text: &str) -> Result<Mixture, String> {
    let (name, weight) = match text.split_once('=') {
        Some((name, weight)) => (name, number(weight)?),
        None => (text, 1.0),
    };
    if !(0.0..=1.0).contains(&weight) {
        return Err(format!("the weight is {weight}, allowed 0 to 1"));
    }
    Ok(Mixture { name: name.trim().to_owned(), weight: weight as f32 })
}

/// Seconds of a motion.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    let seconds = number(text)?;
    match (0.0..=3600.0).contains(&seconds) {
        true => Ok(seconds),
        false => Err(format!("the time is {seconds}, allowed 0 to 3600 seconds")),
    }
}

/// `A..B`: the frames from A on, before B.
pub(super) fn frames(text: &str) -> Result<Frames, String> {
    let pair = text.split_once("..").and_then(|(a, b)| Some(a.trim().parse().ok()?..b.trim().parse().ok()?));
    pair.filter(|frames: &Frames| frames.start < frames.end && frames.len() <= MOST_FRAMES).ok_or_else(|| {
        format!("say A..B, the first frame and the one behind the last, at most {MOST_FRAMES} of them, such as 0..48")
    })
}

/// The longest film.
pub(super) const MOST_FRAMES: usize = 36_000;

pub(super) fn setting(text: &str) -> Result<Setting, String> {
    let (id, value) = text.split_once('=').ok_or("say ID=VALUE, such as stop_angle_deg=40")?;
    let value = number(value)?;
    Ok(Setting { id: id.trim().to_owned(), value })
}

pub(super) fn share(text: &str) -> Result<Share, String> {
    // A path may contain `=`, a weight may not.
    let (breed, weight) = text.rsplit_once('=').ok_or("say NAME=WEIGHT or FILE.ron=WEIGHT, such as pug=0.3")?;
    let weight = number(weight)?;
    if !(0.0..=1.0).contains(&weight) {
        return Err(format!("the weight is {weight}, allowed 0 to 1"));
    }
    Ok(Share { breed: breed.to_owned(), weight: weight as f32 })
}

/// `WIDTHxHEIGHT`, pixels.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let side = |s: &str| s.trim().parse::<u32>().ok().filter(|n| (1..=16_384).contains(n));
    let pair = sides.and_then(|(w, h)| Some([side(w)?, side(h)?]));
    pair.ok_or_else(|| "say WIDTHxHEIGHT in pixels, each 1 to 16384, such as 1024x768".into())
}

/// What shall stand behind the head; which colours that is may depend on the preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ground {
    Plain,
    Gradient,
    Own(Background),
}

impl Ground {
    pub(super) fn of(self, preset: Preset) -> Background {
        match self {
            Self::Plain => preset.plain(),
            Self::Gradient => preset.gradient(),
            Self::Own(background) => background,
        }
    }
}

/// `plain`, `gradient`, `transparent` or `none`, a name, or `rrggbb` with or without `#` (which shells take for a comment).
pub(super) fn background(text: &str) -> Result<Ground, String> {
    const NAMED: [(&str, [u8; 3]); 5] =
        [("white", [255; 3]), ("black", [0; 3]), ("grey", [128; 3]), ("gray", [128; 3]), ("silver", [192; 3])];
    const KINDS: [(&str, Ground); 4] = [
        ("plain", Ground::Plain),
        ("gradient", Ground::Gradient),
        ("transparent", Ground::Own(Background::None)),
        ("none", Ground::Own(Background::None)),
    ];
    if let Some((_, kind)) = KINDS.iter().find(|(name, _)| *name == text) {
        return Ok(*kind);
    }
    if let Some((_, rgb)) = NAMED.iter().find(|(name, _)| *name == text) {
        return Ok(Ground::Own(Background::Plain(*rgb)));
    }
    let hex = format!("#{}", text.trim_start_matches('#'));
    let known = colour::from_hex(&hex).map(|linear| Ground::Own(Background::Plain(colour::to_srgb8(linear))));
    known.ok_or_else(|| {
        let near = nearest(
            text,
            NAMED.iter().map(|(name, _)| *name).chain(KINDS.iter().map(|(name, _)| *name)).map(|n| (n, n)),
        );
        format!(
            "say plain, gradient, transparent, white, black, grey, silver or rrggbb such as 20242c{}",
            did_you_mean(&near)
        )
    })
}

/// Strands of hair: a level's name or a number.
pub(super) fn hair(text: &str) -> Result<u32, String> {
    let named = coat::LEVELS.iter().find(|(name, _)| *name == text).map(|(_, n)| *n);
    let n = named.or_else(|| text.parse().ok()).filter(|&n| n <= coat::MAX_STRANDS);
    n.map(|n| n as u32).ok_or_else(|| {
        let near = nearest(text, coat::LEVELS.iter().map(|(name, _)| (*name, *name)));
        format!("say off, low, medium, high or a number from 0 to {}{}", coat::MAX_STRANDS, did_you_mean(&near))
    })
}

/// A part of something: 0 to 1.
pub(super) fn part(text: &str) -> Result<f32, String> {
    between(text, 1.0)
}

/// Times the breed's length of hair.
pub(super) fn fur_length(text: &str) -> Result<f32, String> {
    between(text, 3.0)
}

fn between(text: &str, most: f64) -> Result<f32, String> {
    let number = number(text)?;
    match (0.0..=most).contains(&number) {
        true => Ok(number as f32),
        false => Err(format!("{number} is not allowed, say 0 to {most}")),
    }
}

/// How many times larger.
pub(super) fn zoom(text: &str) -> Result<f32, String> {
    let times = number(text)?;
    if !(1.0..=40.0).contains(&times) {
        return Err(format!("the zoom is {times}, allowed 1 (all of the head) to 40 times"));
    }
    Ok(times as f32)
}

/// Texels of a texture's side.
pub(super) fn texture(text: &str) -> Result<u32, String> {
    let wrong = || format!("a texture of {text} texels cannot be made: take 256, 512, 1024, 2048 or 4096");
    let size: u32 = text.parse().map_err(|_| wrong())?;
    let [least, most] = TEXTURE_SIZES;
    if size.is_power_of_two() && (least..=most).contains(&size) { Ok(size) } else { Err(wrong()) }
}

/// Degrees, as radians.
pub(super) fn pitch(text: &str) -> Result<f32, String> {
    let degrees = number(text)?;
    if !(-90.0..=90.0).contains(&degrees) {
        return Err(format!("the pitch is {degrees}, allowed -90 to 90 degrees"));
    }
    Ok(degrees.to_radians() as f32)
}

/// How far the lids are closed: one number for both sides, or the left one's and the right one's.
pub(super) fn lids_closed(text: &str) -> Result<Lids, String> {
    let one = |word: &str| {
        let part = number(word.trim())?;
        match (0.0..=1.0).contains(&part) {
            true => Ok(part as f32),
            false => Err(format!("lids are {part} closed, allowed 0 (as the measures say) to 1 (shut)")),
        }
    };
    let (left, right) = text.split_once(',').unwrap_or((text, text));
    Ok(Lids([one(left)?, one(right)?]))
}

/// A list of views with commas between; two numbers in a row are one view.
pub(super) fn views(text: &str) -> Result<Vec<View>, String> {
    let mut views = Vec::new();
    let mut words = text.split(',').map(str::trim);
    while let Some(word) = words.next() {
        let is_number = word.parse::<f32>().is_ok();
        let view = match (is_number, is_number.then(|| words.next()).flatten()) {
            (true, Some(elevation)) => format!("{word},{elevation}").parse(),
            _ => word.parse::<View>(),
        };
        views.push(view.map_err(|e| e.to_string())?);
    }
    Ok(views)
}

/// Degrees from 0 to 180, as radians.
pub(super) fn angle(text: &str) -> Result<f64, String> {
    let degrees = number(text)?;
    if !(0.0..=180.0).contains(&degrees) {
        return Err(format!("the angle is {degrees}, allowed 0 to 180 degrees"));
    }
    Ok(degrees.to_radians())
}

/// A tolerance: 0 or more.
pub(super) fn epsilon(text: &str) -> Result<f64, String> {
    let epsilon = number(text)?;
    if epsilon < 0.0 {
        return Err(format!("the tolerance is {epsilon}, allowed 0 or more"));
    }
    Ok(epsilon)
}

/// A scheme of subdivision by its name.
pub(super) fn scheme() -> impl TypedValueParser<Value = Scheme> {
    word(&Scheme::ALL.map(|scheme| (scheme.name(), scheme)))
}

/// One of a few words, each with what it stands for.
pub(super) fn word<T: Copy + Send + Sync + 'static>(
    words: &[(&'static str, T)],
) -> impl TypedValueParser<Value = T> + use<T> {
    let words = words.to_vec();
    let names: Vec<&'static str> = words.iter().map(|(name, _)| *name).collect();
    PossibleValuesParser::new(names).try_map(move |text| {
        let found = words.iter().find(|(name, _)| *name == text);
        found.map(|(_, value)| *value).ok_or("no such word")
    })
}

/// A dress of a sheet's heads.
pub(super) fn dress() -> impl TypedValueParser<Value = Dress> {
    word(&Dress::ALL.map(|dress| (dress.name(), dress)))
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
    number.ok_or_else(|| format!("'{text}' is no number"))
}

/// ` (did you mean a or b?)`, or nothing.
pub(super) fn did_you_mean(names: &[impl AsRef<str>]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    if names.is_empty() { String::new() } else { format!(" (did you mean {}?)", names.join(" or ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_and_shares_are_read_and_refused() {
        assert_eq!(setting("stop_deg=-4.5").unwrap(), Setting { id: "stop_deg".into(), value: -4.5 });
        for text in ["stop_deg", "a=b", "a=", "a=nan", "a=inf", "a=1e999", "a=1,5", "a=2*3"] {
            assert!(setting(text).is_err(), "{text}");
        }
        assert_eq!(share("x=y.ron=0.25").unwrap(), Share { breed: "x=y.ron".into(), weight: 0.25 });
        for text in ["pug", "pug=", "pug=1.1", "pug=-0.1", "pug=NaN"] {
            assert!(share(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_colours_and_views_are_read_and_refused() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for text in ["640", "0x5", "5x0", "x", "-5x5", "99999x5", "1e3x5", "640x480x3"] {
            assert!(size(text).is_err(), "{text}");
        }
        let own = |background| Ok(Ground::Own(background));
        assert_eq!([background("none"), background("transparent")], [own(Background::None), own(Background::None)]);
        assert_eq!([background("plain"), background("gradient")], [Ok(Ground::Plain), Ok(Ground::Gradient)]);
        assert_eq!(background("#102030"), own(Background::Plain([16, 32, 48])));
        assert_eq!(background("102030"), background("#102030"));
        assert!(background("whit").unwrap_err().contains("did you mean white?"));
        assert!(background("12345").is_err());
        let angles = |a: f32, e: f32| View::Angles { azimuth: a.to_radians(), elevation: e.to_radians() };
        assert_eq!(views("front,-30,10,top").unwrap(), [View::Front, angles(-30.0, 10.0), View::Top]);
        for text in ["", "front,", "30", "front,30", "10,side"] {
            assert!(views(text).is_err(), "{text}");
        }
        assert_eq!([hair("off"), hair("medium"), hair("70")], [Ok(0), Ok(90_000), Ok(70)]);
        for text in ["", "-1", "500001", "1e3", "lots"] {
            assert!(hair(text).is_err(), "{text}");
        }
        assert!(hair("hihg").unwrap_err().contains("did you mean high?"));
        assert_eq!(zoom("2.5"), Ok(2.5));
        assert!(zoom("0.5").is_err() && zoom("nan").is_err() && zoom("41").is_err());
        assert_eq!((frames("0..48"), frames("7..8")), (Ok(0..48), Ok(7..8)));
        for text in ["", "5", "5..5", "6..5", "-1..5", "0..99999", "0..=5", "a..b"] {
            assert!(frames(text).is_err(), "{text}");
        }
        assert_eq!(unit("AU101=0.7"), Ok(Setting { id: "AU101".into(), value: 0.7 }));
        assert!(unit("AU101").is_err() && unit("AU101=2").is_err() && unit("AU101=nan").is_err());
        assert_eq!(mixed("fear=0.5"), Ok(Mixture { name: "fear".into(), weight: 0.5 }));
        assert_eq!(mixed("fear"), Ok(Mixture { name: "fear".into(), weight: 1.0 }));
        assert!(mixed("fear=-1").is_err() && seconds("-1").is_err() && seconds("1e9").is_err());
        assert!(pitch("91").is_err() && pitch("x").is_err());
        assert_eq!(angle("180"), Ok(std::f64::consts::PI));
        assert!(angle("-1").is_err() && angle("181").is_err() && angle("nan").is_err());
    }
}
