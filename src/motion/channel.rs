//! The channels in which joints and soft parts move, by name; their limits are in `rigs/skeleton.ron`.

macro_rules! channels {
    ($($(#[doc = $doc:literal])+ $variant:ident $id:literal $median:literal;)*) => {
        /// A degree of freedom. Ids end in their unit; millimetres are those of a head with a skull of 200 mm.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Channel { $($(#[doc = $doc])+ $variant,)* }

        impl Channel {
            /// Every channel, in the order of the enum.
            pub const ALL: &[Channel] = &[$(Channel::$variant,)*];

            /// The name in files.
            pub const fn id(self) -> &'static str {
                match self { $(Channel::$variant => $id,)* }
            }

            /// Whether there is but one for the head, not one for each side.
            pub const fn is_median(self) -> bool {
                match self { $(Channel::$variant => $median,)* }
            }
        }
    };
}

channels! {
    /// The head turns about the neck: to the dog's left is positive.
    HeadTurn "head_turn_deg" true;
    /// The nose goes up.
    HeadNod "head_nod_deg" true;
    /// The crown goes to the dog's left shoulder.
    HeadTilt "head_tilt_deg" true;
    /// The head goes forward.
    HeadForward "head_forward_mm" true;
    /// The mandible turns about both condyles.
    JawGape "jaw_gape_deg" true;
    /// The mandible goes forward.
    JawProtrusion "jaw_protrusion_mm" true;
    /// The mandible goes to the dog's left.
    JawSlide "jaw_slide_mm" true;
    /// An eye turns to the dog's left.
    GazeTurn "gaze_turn_deg" false;
    /// An eye looks up.
    GazeLift "gaze_lift_deg" false;
    /// The pupils' diameter, beyond that at rest: both are alike, as light in one eye narrows both.
    Pupil "pupil_mm" true;
    /// A lid closes: 0 is open as at rest, 1 shut.
    LidClosed "lid_closed" false;
    /// The upper lid is raised beyond its rest, 0 to 1.
    LidRaised "lid_raised" false;
    /// The tongue's tip goes out of the mouth.
    TongueOut "tongue_out_mm" true;
    /// The tongue bends upwards along its free part (downwards where negative).
    TongueLift "tongue_lift_deg" true;
    /// Its tip curls up (down where negative).
    TongueCurl "tongue_curl_deg" true;
    /// It bends to the dog's left.
    TongueSide "tongue_side_deg" true;
    /// It widens and flattens, 0 to 1.
    TongueWide "tongue_wide" true;
    /// Lips part with the teeth together.
    LipsPart "lips_part_mm" false;
    /// The cheek is puffed out.
    CheekPuff "cheek_puff_mm" false;
    /// Masseter and temporalis press the jaws together and stand out, 0 to 1.
    Bite "bite" false;
    /// The flew swings after the head: to the dog's left.
    FlewSway "flew_sway_mm" false;
    /// The ear's base goes forward.
    EarForward "ear_forward_mm" false;
    /// The ear's base goes up.
    EarLift "ear_lift_mm" false;
    /// The ear's base goes towards the median plane.
    EarIn "ear_in_mm" false;
    /// The ear's opening turns outwards and back about the ear's length.
    EarTurn "ear_turn_deg" false;
    /// The ear lies back about its base.
    EarBack "ear_back_deg" false;
    /// The ear falls outwards about its base.
    EarOut "ear_out_deg" false;
    /// The leather's second joint bends back.
    EarBend "ear_bend_deg" false;
    /// The leather's second joint bends outwards.
    EarSway "ear_sway_deg" false;
}

impl Channel {
    /// Number of channels.
    pub const COUNT: usize = Self::ALL.len();

    /// Whether its sign tells left from right: positive is to the dog's left.
    pub const fn is_lateral(self) -> bool {
        matches!(
            self,
            Self::HeadTurn | Self::HeadTilt | Self::JawSlide | Self::GazeTurn | Self::TongueSide | Self::FlewSway
        )
    }

    /// Whether of two movements the larger one shows, not their sum: a mouth that one wish opens by 14 degrees and another
    /// by 20 stands open by 20.
    pub const fn takes_largest(self) -> bool {
        matches!(
            self,
            Self::JawGape
                | Self::LidClosed
                | Self::LidRaised
                | Self::TongueOut
                | Self::TongueLift
                | Self::TongueCurl
                | Self::TongueWide
                | Self::LipsPart
                | Self::CheekPuff
                | Self::Bite
        )
    }

    /// The channel of that name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|c| c.id() == id)
    }
}

impl<'de> serde::Deserialize<'de> for Channel {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let id = String::deserialize(deserializer)?;
        Self::from_id(&id).ok_or_else(|| {
            let all: Vec<&str> = Self::ALL.iter().map(|c| c.id()).collect();
            serde::de::Error::custom(format!("`{id}` is no channel; there are {}", all.join(", ")))
        })
    }
}

impl serde::Serialize for Channel {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.id())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_is_in_the_order_of_the_enum_and_ids_are_unique() {
        for (i, &channel) in Channel::ALL.iter().enumerate() {
            assert_eq!(channel as usize, i);
            assert_eq!(Channel::from_id(channel.id()), Some(channel));
        }
    }
}
