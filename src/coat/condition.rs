//! What a coat is like today: grown, clipped, wet, grey. Not of the breed, and nothing that a frame would have to make
//! anew: whoever draws the hair bends it.

/// The state of a coat, in which the breed's own numbers are changed where hair is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Times the breed's length, 0 to 3.
    pub length: f32,
    /// Part of the breed's hairs that are there, 0 to 1.
    pub density: f32,
    /// 0 as it grows, 1 all of it clipped to [`CLIPPED`].
    pub clipped: f32,
    /// 0 dry, 1 soaked.
    pub wet: f32,
    /// 0 as at two years, 1 as in a very old dog.
    pub grey: f32,
}

/// Length of hair that is clipped, metres.
pub const CLIPPED: f32 = 0.004;

/// One number of a [`Condition`], for options and sliders.
#[derive(Clone, Copy)]
pub struct ConditionField {
    /// The option's name.
    pub name: &'static str,
    /// The slider's.
    pub label: &'static str,
    /// The most; the least is 0.
    pub max: f32,
    /// What it does.
    pub tells: &'static str,
    /// The number.
    pub of: fn(&mut Condition) -> &mut f32,
}

impl Condition {
    /// Every number, in the order of the fields.
    pub const FIELDS: [ConditionField; 5] = [
        ConditionField {
            name: "fur-length",
            label: "Length",
            max: 3.0,
            tells: "Times the breed's length of hair",
            of: |c| &mut c.length,
        },
        ConditionField {
            name: "fur-density",
            label: "Density",
            max: 1.0,
            tells: "Part of the breed's hairs that are there",
            of: |c| &mut c.density,
        },
        ConditionField {
            name: "clipped",
            label: "Clipped",
            max: 1.0,
            tells: "0 as it grows, 1 all of it clipped to 4 mm",
            of: |c| &mut c.clipped,
        },
        ConditionField { name: "wet", label: "Wet", max: 1.0, tells: "0 dry, 1 soaked", of: |c| &mut c.wet },
        ConditionField {
            name: "grey",
            label: "Grey",
            max: 1.0,
            tells: "White hairs of age, from the chin backwards and around the eyes",
            of: |c| &mut c.grey,
        },
    ];
}

impl Default for Condition {
    /// As the breed is, dry.
    fn default() -> Self {
        Self { length: 1.0, density: 1.0, clipped: 0.0, wet: 0.0, grey: 0.0 }
    }
}
