//! Which layers of the head a frame has.

/// What is there, and how much of the skin is seen. By default what is seen of a dog with its mouth closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    /// Opacity of the skin, 0 to 1; at 0 it is not there.
    pub skin: f32,
    /// Eyeballs, third eyelids and lines of tears.
    pub eyes: bool,
    /// Whiskers.
    pub whiskers: bool,
    /// Muscles of the face, as fibres.
    pub muscles: bool,
    /// Skull and mandible.
    pub bone: bool,
    /// Crowns of the teeth.
    pub teeth: bool,
    /// Gums, palate and floor of the mouth.
    pub mouth: bool,
    /// Tongue.
    pub tongue: bool,
}

impl Default for Layers {
    fn default() -> Self {
        Self { skin: 1.0, eyes: true, whiskers: true, ..Self::NONE }
    }
}

/// Why a list of layers is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LayersError {
    /// There is no such layer.
    #[error("there is no layer `{0}`; there are {names}", names = Layers::NAMES.join(", "))]
    Unknown(String),
    /// Not a number, or out of range.
    #[error("`{0}` is no opacity: write skin=0 to skin=1")]
    Opacity(String),
    /// Only the skin can be seen through.
    #[error("`{0}` cannot be seen through; only skin takes an opacity")]
    Solid(String),
}

impl Layers {
    /// The names that [`Layers::parse`] knows.
    pub const NAMES: [&'static str; 8] = ["skin", "eyes", "whiskers", "muscles", "bone", "teeth", "mouth", "tongue"];

    /// Nothing.
    pub const NONE: Layers =
        Layers { skin: 0.0, eyes: false, whiskers: false, muscles: false, bone: false, teeth: false, mouth: false, tongue: false };

    /// The same and what is seen in an open mouth.
    #[must_use]
    pub const fn with_open_mouth(self) -> Self {
        Self { teeth: true, mouth: true, tongue: true, ..self }
    }

    /// From a list with commas between: `bone,teeth,skin=0.3`. What is not named is not there.
    ///
    /// # Errors
    /// An unknown name, or an opacity that is none.
    pub fn parse(text: &str) -> Result<Self, LayersError> {
        let mut layers = Self::NONE;
        for word in text.split(',').map(str::trim).filter(|word| !word.is_empty()) {
            let (name, opacity) = word.split_once('=').map_or((word, None), |(name, n)| (name.trim(), Some(n.trim())));
            match (name, opacity) {
                ("skin", None) => layers.skin = 1.0,
                ("skin", Some(n)) => {
                    let opacity = n.parse::<f32>().ok().filter(|o| (0.0..=1.0).contains(o));
                    layers.skin = opacity.ok_or_else(|| LayersError::Opacity(word.to_owned()))?;
                }
                (name, Some(_)) if Self::NAMES.contains(&name) => return Err(LayersError::Solid(word.to_owned())),
                ("eyes", None) => layers.eyes = true,
                ("whiskers", None) => layers.whiskers = true,
                ("muscles", None) => layers.muscles = true,
                ("bone", None) => layers.bone = true,
                ("teeth", None) => layers.teeth = true,
                ("mouth", None) => layers.mouth = true,
                ("tongue", None) => layers.tongue = true,
                _ => return Err(LayersError::Unknown(name.to_owned())),
            }
        }
        Ok(layers)
    }
}

#[cfg(test)]
mod tests {
    use super::{Layers, LayersError};

    #[test]
    fn a_list_of_layers_is_read_wrong() {
        let xray = Layers::parse("bone, teeth ,skin=0.3").expect("a list");
        assert_eq!(xray, Layers { skin: 0.3, bone: true, teeth: true, ..Layers::NONE });
        assert_eq!(Layers::parse("skin,eyes,whiskers"), Ok(Layers::default()));
        let inside = Layers { bone: true, teeth: true, mouth: true, tongue: true, ..Layers::NONE };
        assert_eq!(Layers::parse("tongue,mouth,teeth,bone"), Ok(inside));
        assert!(matches!(Layers::parse("skin=2"), Err(LayersError::Opacity(_))));
        assert!(matches!(Layers::parse("skin=NaN"), Err(LayersError::Opacity(_))));
        assert!(matches!(Layers::parse("tongue=0.5"), Err(LayersError::Solid(_))));
        assert!(Layers::NAMES.iter().all(|name| Layers::parse(name).is_ok_and(|l| l != Layers::NONE)));
        assert!(matches!(Layers::parse("fur"), Err(LayersError::Unknown(_))));
    }
}
