//! One head's spheres with the tables of its whole motion, made once for each head; and the buffers of a frame.

use super::motion::{AXES, Moved, Params};
use super::parts::{Head, Part, Spheres};
use super::table::{Contact, Pair, Pairing, Table, test_all};
use crate::motion::JointLimits;
use glam::Vec3;
use std::collections::BTreeMap;

/// Pairs of parts that one table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Teeth, bones and eyes: rigid with skull or mandible.
    Hard,
    /// Lips with teeth.
    Lips,
    /// Tongue with the upper teeth.
    TongueAbove,
    /// Tongue with the lower teeth, which the jaw does not move against each other.
    TongueBelow,
}

impl Group {
    /// All of them, in the order of [`Swept::tables`].
    pub const ALL: [Group; 4] = [Group::Hard, Group::Lips, Group::TongueAbove, Group::TongueBelow];

    /// Which parts may not go through each other.
    pub const fn pairings(self) -> &'static [Pairing] {
        match self {
            Group::Hard => &[
                [Part::UpperTeeth, Part::LowerTeeth],
                [Part::UpperTeeth, Part::Mandible],
                [Part::UpperJaw, Part::LowerTeeth],
                // The coronoid process comes forwards beside the eye.
                [Part::Eyes, Part::Mandible],
            ],
            Group::Lips => &[
                [Part::UpperTeeth, Part::UpperLip],
                [Part::UpperTeeth, Part::LowerLip],
                [Part::LowerTeeth, Part::UpperLip],
                [Part::LowerTeeth, Part::LowerLip],
            ],
            Group::TongueAbove => &[[Part::UpperTeeth, Part::Tongue]],
            Group::TongueBelow => &[[Part::LowerTeeth, Part::Tongue]],
        }
    }

    /// Cells on each axis: gape, protrusion, slide, tongue out, lift.
    const fn cells(self) -> [usize; AXES] {
        match self {
            Group::Hard => [52, 2, 3, 1, 1],
            Group::Lips => [26, 1, 1, 1, 1],
            Group::TongueAbove => [13, 1, 1, 6, 8],
            Group::TongueBelow => [1, 1, 1, 12, 16],
        }
    }

    /// How far soft parts may stray at each level, canonical millimetres.
    const fn levels(self) -> &'static [f32] {
        match self {
            Group::Hard => &[0.0],
            Group::Lips => &[1.0, 4.0, 10.0],
            Group::TongueAbove | Group::TongueBelow => &[1.0, 4.0],
        }
    }
}

/// The spheres and tables of one head.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Its spheres.
    pub spheres: Spheres,
    /// One for each of [`Group::ALL`].
    pub tables: [Table; 4],
    /// Ends of the parameters.
    ends: [Params; 2],
    /// Pairs that overlap at rest or, of what is hard, while the jaw opens straight, ascending, and how deep at most.
    bred: Vec<(Pair, f32)>,
}

/// The jaw is opened by so much, radians, from one look at what touches to the next: incisors move by an eighth of a
/// canonical millimetre, and the deepest of a pair on the way is missed by less than its arrow, a thousandth of that.
const OPENED_BY: f32 = 0.001;

/// How far what is soft is from where the parameters alone put it, at most, metres: [`Spheres::stray`] tells, or who moves
/// it knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stray {
    /// Lips.
    pub lips: f32,
    /// Tongue.
    pub tongue: f32,
}

/// The buffers of a frame: made once, written again. As many centres as spheres.
#[derive(Clone, Debug, Default)]
pub struct Touching {
    /// Where the spheres are. What no table keeps is only moved where a part strays beyond its tables.
    pub centres: Vec<Vec3>,
    /// What touches, in the order of the pairings.
    pub contacts: Vec<Contact>,
}

impl Swept {
    /// Sweeps the motion of a head between those limits.
    pub fn new(head: &Head, limits: &JointLimits) -> Self {
        let spheres = Spheres::new(head);
        let ends = Params::limits(limits, spheres.unit);
        let tables = Group::ALL.map(|group| {
            let levels = group.levels().iter().map(|mm| mm * spheres.unit).collect();
            Table::new(&spheres, group.pairings(), ends, group.cells(), levels)
        });
        let mut out = Self { spheres, tables, ends, bred: Vec::new() };
        out.bred = out.as_bred();
        out
    }

    fn as_bred(&self) -> Vec<(Pair, f32)> {
        let mut touching = self.buffers();
        self.query(Params::default(), Stray::default(), &mut touching);
        let mut bred: BTreeMap<Pair, f32> = touching.contacts.iter().map(|c| (c.pair, c.depth)).collect();
        let steps = (self.ends[1].0[0] / OPENED_BY) as usize;
        for step in 1..=steps.min(10_000) {
            let moved = self.spheres.joints().at(Params::default().with_gape(OPENED_BY * step as f32));
            self.place(Group::Hard, &moved, Stray::default(), &mut touching.centres);
            touching.contacts.clear();
            self.find(Group::Hard, moved.params(), Stray::default(), &touching.centres, &mut touching.contacts);
            for contact in &touching.contacts {
                let deepest = bred.entry(contact.pair).or_default();
                *deepest = deepest.max(contact.depth);
            }
        }
        bred.into_iter().collect()
    }

    /// Buffers with every sphere at rest, which no query makes larger but one that strays beyond the tables.
    pub fn buffers(&self) -> Touching {
        let most = self.tables.iter().map(Table::longest).sum();
        let centres = self.spheres.at_rest.iter().map(|s| s.centre).collect();
        Touching { centres, contacts: Vec::with_capacity(most) }
    }

    /// The parameters within the limits that the tables were swept for.
    #[must_use]
    pub fn clamped(&self, params: Params) -> Params {
        params.clamped(&self.ends)
    }

    /// Puts the spheres of a group that can touch where the parameters put them; all of its pairings' where its soft parts
    /// stray beyond the table. What is soft can then be put where it is.
    pub fn place(&self, group: Group, moved: &Moved, stray: Stray, centres: &mut [Vec3]) {
        self.place_those(group, moved, stray, centres, |_| true);
    }

    /// The same, but for soft parts, which stay where they have been put.
    pub fn place_hard(&self, group: Group, moved: &Moved, stray: Stray, centres: &mut [Vec3]) {
        self.place_those(group, moved, stray, centres, |part| !part.is_soft());
    }

    fn place_those(
        &self,
        group: Group,
        moved: &Moved,
        stray: Stray,
        centres: &mut [Vec3],
        wanted: impl Fn(Part) -> bool,
    ) {
        let table = &self.tables[group as usize];
        let within = table.cell(moved.params(), of(group, stray)).is_some();
        for &part in Part::ALL.iter().filter(|&&part| wanted(part)) {
            let own = self.spheres.of(part);
            let mut put = |k: usize| centres[k] = self.spheres.centre(k, moved);
            if within {
                table.kept_in(own).iter().for_each(|&k| put(usize::from(k)));
            } else if group.pairings().iter().flatten().any(|&asked| asked == part) {
                own.for_each(put);
            }
        }
    }

    /// Appends the contacts of a group: by its table, or by testing every pair where its soft parts stray beyond it. The
    /// parameters are within the limits, and its spheres in their places.
    pub fn find(&self, group: Group, params: Params, stray: Stray, centres: &[Vec3], out: &mut Vec<Contact>) {
        let table = &self.tables[group as usize];
        match table.cell(params, of(group, stray)) {
            Some(cell) => table.query(&self.spheres, cell, centres, out),
            None => test_all(&self.spheres, group.pairings(), centres, out),
        }
    }

    /// Finds the contacts of all groups, the spheres being in their places.
    pub fn query(&self, params: Params, stray: Stray, touching: &mut Touching) {
        touching.contacts.clear();
        for group in Group::ALL {
            self.find(group, params, stray, &touching.centres, &mut touching.contacts);
        }
    }

    /// How much deeper two spheres are in each other than they may be as the dog was bred: at rest and, of what is hard,
    /// while the jaw opens straight.
    pub fn beyond(&self, contact: &Contact) -> f32 {
        contact.depth - self.bred(contact.pair)
    }

    /// How deep two spheres may be in each other as the dog was bred, metres; 0 where they are apart.
    pub fn bred(&self, pair: Pair) -> f32 {
        self.bred.binary_search_by_key(&pair, |(pair, _)| *pair).map_or(0.0, |k| self.bred[k].1)
    }

    /// The parts of a contact.
    pub fn parts(&self, contact: &Contact) -> Pairing {
        contact.pair.map(|k| self.spheres.part(usize::from(k)))
    }
}

fn of(group: Group, stray: Stray) -> f32 {
    match group {
        Group::Hard => 0.0,
        Group::Lips => stray.lips,
        Group::TongueAbove | Group::TongueBelow => stray.tongue,
    }
}
