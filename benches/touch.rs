//! What touches in a mouth over a yawn, by the tables, by testing every pair, and by trees of boxes, in one run.
//!
//! `cargo bench --no-default-features --features head --bench touch`. What counts are the ratios; nanoseconds belong to one
//! machine and day. All of them put the lips where the skin has them, find the same contacts, and allocate nothing.
//!
//! A tree is made once for each head over what is rigid, in its own frame; spheres of the other part are carried there and
//! looked up. So no tree is ever made anew or refitted, which is the best that a tree can do here.

#[path = "../tests/support/mouths.rs"]
mod mouths;

use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;
use londra::anatomy::{ParamTable, library};
use londra::rig::Rig;
use londra::rig::touch::table::{all_pairs, test_all};
use londra::rig::touch::{Contact, Follow, Group, Moved, Params, Part, Sphere, Spheres, Stray, Swept, Touching};
use mouths::Maker;
use rstar::{AABB, RTree, RTreeObject};
use std::cell::Cell;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const BREEDS: [&str; 5] = ["labrador", "german_shepherd", "pug", "borzoi", "chihuahua"];
/// Frames of a yawn, and its gape, degrees.
const FRAMES: usize = 115;
const YAWN: f32 = 57.0;
/// Turns of every way through a yawn.
const TURNS: usize = 25;

/// One frame of a yawn.
struct Moment {
    params: Params,
    skin: Vec<Vec3>,
}

/// A sphere in a tree.
#[derive(Clone, Copy)]
struct Leaf {
    number: u16,
    sphere: Sphere,
    node: usize,
}

impl Leaf {
    fn ends(&self) -> [[f32; 3]; 2] {
        let Sphere { centre, radius } = self.sphere;
        [centre - radius, centre + radius].map(|p| p.to_array())
    }
}

impl Bounded<f32, 3> for Leaf {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [low, high] = self.ends();
        Aabb::with_bounds(low.into(), high.into())
    }
}

impl BHShape<f32, 3> for Leaf {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }
    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl RTreeObject for Leaf {
    type Envelope = AABB<[f32; 3]>;
    fn envelope(&self) -> Self::Envelope {
        let [low, high] = self.ends();
        AABB::from_corners(low, high)
    }
}

/// A question to a tree that counts the boxes it is held against.
struct Counted<'a>(Aabb<f32, 3>, &'a Cell<usize>);

impl IntersectsAabb<f32, 3> for Counted<'_> {
    fn intersects_aabb(&self, aabb: &Aabb<f32, 3>) -> bool {
        self.1.set(self.1.get() + 1);
        self.0.intersects_aabb(aabb)
    }
}

/// The two kinds of tree over one part at rest.
struct Tree {
    part: Part,
    leaves: Vec<Leaf>,
    boxes: Bvh<f32, 3>,
    r_star: RTree<Leaf>,
}

impl Tree {
    fn new(spheres: &Spheres, part: Part) -> Tree {
        let leaf = |k: usize| Leaf { number: k as u16, sphere: spheres.at_rest[k], node: 0 };
        let mut leaves: Vec<Leaf> = spheres.of(part).map(leaf).collect();
        let boxes = Bvh::build(&mut leaves);
        let r_star = RTree::bulk_load(leaves.clone());
        Tree { part, leaves, boxes, r_star }
    }
}

/// One head, its yawn, and trees over what is rigid in it.
struct Case {
    swept: Swept,
    yawn: Vec<Moment>,
    trees: Vec<Tree>,
}

impl Case {
    fn new(maker: &mut Maker, id: &str) -> Case {
        let breed = library::breed(&maker.table, id).expect("an embedded breed");
        let shape = maker.shape(&breed);
        let swept = maker.swept(&shape);
        let at = |frame: usize| {
            let gape = (YAWN * frame as f32 / (FRAMES - 1) as f32).to_radians();
            let params = Params::default().with_gape(gape);
            let moved = swept.spheres.joints().at(params);
            let carried = |(p, &jaw): (&Vec3, &f32)| moved.carry(Follow { jaw, ..Follow::SKULL }, *p);
            Moment { params, skin: shape.skin.iter().zip(&maker.weights).map(carried).collect() }
        };
        let yawn = (0..FRAMES).map(at).collect();
        let trees =
            [Part::UpperTeeth, Part::LowerTeeth, Part::UpperJaw, Part::Eyes].map(|p| Tree::new(&swept.spheres, p));
        Case { swept, yawn, trees: trees.into() }
    }

    /// Lips stray from the turn of a sphere's mean weight by a few tenths of a millimetre.
    fn stray(&self) -> Stray {
        Stray { lips: 0.9 * self.swept.spheres.unit, tongue: 0.0 }
    }

    fn by_table(&self, moment: &Moment, touching: &mut Touching) {
        let moved = self.swept.spheres.joints().at(moment.params);
        for group in [Group::Hard, Group::TongueAbove, Group::TongueBelow] {
            self.swept.place(group, &moved, self.stray(), &mut touching.centres);
        }
        self.swept.place_hard(Group::Lips, &moved, self.stray(), &mut touching.centres);
        self.swept.spheres.place_lips(&moment.skin, &mut touching.centres);
        self.swept.query(moment.params, self.stray(), touching);
    }

    fn place(&self, parts: &[Part], moved: &Moved, moment: &Moment, centres: &mut [Vec3]) {
        for &part in parts {
            for k in self.swept.spheres.of(part) {
                centres[k] = self.swept.spheres.centre(k, moved);
            }
        }
        self.swept.spheres.place_lips(&moment.skin, centres);
    }

    fn by_all_pairs(&self, moment: &Moment, touching: &mut Touching) {
        let moved = self.swept.spheres.joints().at(moment.params);
        self.place(&[Part::LowerTeeth, Part::Mandible, Part::Tongue], &moved, moment, &mut touching.centres);
        touching.contacts.clear();
        for group in Group::ALL {
            test_all(&self.swept.spheres, group.pairings(), &touching.centres, &mut touching.contacts);
        }
    }

    /// `near`: what of a tree a sphere in its frame may touch.
    fn by_trees(&self, moment: &Moment, touching: &mut Touching, near: impl Fn(&Tree, &Leaf, &mut dyn FnMut(&Leaf))) {
        let spheres = &self.swept.spheres;
        let moved = spheres.joints().at(moment.params);
        self.place(&[Part::LowerTeeth, Part::Mandible, Part::Tongue], &moved, moment, &mut touching.centres);
        let Touching { centres, contacts } = touching;
        contacts.clear();
        for &[first, second] in Group::ALL.iter().flat_map(|g| g.pairings()) {
            let tree = self.trees.iter().find(|t| t.part == first).expect("every first part has a tree");
            for b in spheres.of(second) {
                // Into the frame of the tree.
                let centre = if first == Part::LowerTeeth { moved.back(centres[b]) } else { centres[b] };
                let asked = Leaf { number: b as u16, sphere: Sphere { centre, ..spheres.at_rest[b] }, node: 0 };
                near(tree, &asked, &mut |leaf| {
                    let between = centre - leaf.sphere.centre;
                    let reach = leaf.sphere.radius + asked.sphere.radius;
                    if between.length_squared() < reach * reach {
                        let distance = between.length();
                        let depth = reach - distance;
                        let direction = between / distance.max(f32::MIN_POSITIVE);
                        contacts.push(Contact { pair: [leaf.number, b as u16], depth, direction });
                    }
                });
            }
        }
    }

    fn by_boxes(&self, moment: &Moment, touching: &mut Touching) {
        self.by_trees(moment, touching, |tree, asked, visit| {
            tree.boxes.traverse_iterator(&asked.aabb(), &tree.leaves).for_each(visit);
        });
    }

    fn by_r_star(&self, moment: &Moment, touching: &mut Touching) {
        self.by_trees(moment, touching, |tree, asked, visit| {
            tree.r_star.locate_in_envelope_intersecting(asked.envelope()).for_each(visit);
        });
    }

    /// Pair tests of a frame on average: tables, every pair, trees; and the boxes that the tree is asked for.
    fn counts(&self, touching: &mut Touching) -> [usize; 4] {
        let spheres = &self.swept.spheres;
        let mut sums = [0; 4];
        for moment in &self.yawn {
            for (group, table) in Group::ALL.iter().zip(&self.swept.tables) {
                let stray = if *group == Group::Lips { self.stray().lips } else { 0.0 };
                sums[0] += table.list(table.cell(moment.params, stray).expect("a level")).len();
                sums[1] += all_pairs(spheres, group.pairings()).count();
            }
            let (boxes, leaves) = (Cell::new(0), Cell::new(0));
            self.by_trees(moment, touching, |tree, asked, visit| {
                let query = Counted(asked.aabb(), &boxes);
                tree.boxes.traverse_iterator(&query, &tree.leaves).for_each(|leaf| {
                    leaves.set(leaves.get() + 1);
                    visit(leaf);
                });
            });
            sums[2] += leaves.get();
            sums[3] += boxes.get();
        }
        sums.map(|sum| sum / self.yawn.len())
    }
}

fn sorted(touching: &Touching) -> Vec<[u16; 2]> {
    let mut pairs: Vec<[u16; 2]> = touching.contacts.iter().map(|c| c.pair).collect();
    pairs.sort_unstable();
    pairs
}

/// A way to find what touches at one moment.
type Way<'a> = &'a dyn Fn(&Moment, &mut Touching);

/// Nanoseconds of a frame of each way, the mean over the frames; of each frame the shortest time, since what else the machine
/// does can only add to it. The ways take turns.
fn contest<const N: usize>(yawn: &[Moment], ways: [Way; N], touching: &mut Touching) -> [f64; N] {
    let mut shortest = [(); N].map(|()| vec![f64::INFINITY; yawn.len()]);
    for _ in 0..TURNS {
        for (way, shortest) in ways.iter().zip(&mut shortest) {
            for (moment, shortest) in yawn.iter().zip(shortest) {
                let start = Instant::now();
                way(moment, touching);
                black_box(&touching.contacts);
                *shortest = shortest.min(start.elapsed().as_secs_f64() * 1e9);
            }
        }
    }
    shortest.map(|list| list.iter().sum::<f64>() / list.len() as f64)
}

fn benches(c: &mut Criterion) {
    let table = Arc::new(ParamTable::embedded().expect("the embedded table is tested"));
    let rig = Arc::new(Rig::embedded(&table).expect("the embedded rig is tested"));
    let mut maker = Maker::new(&table, &rig);
    eprintln!(
        "| Head | Spheres | Contacts | Tests: table | tree, and boxes | every pair | Table, ns | Tree / table | R* tree / table | Every pair / table | Tables, kB | Swept in, ms |"
    );
    eprintln!("{}|", "| --- ".repeat(12));
    for id in BREEDS {
        let case = Case::new(&mut maker, id);
        let mut touching = case.swept.buffers();
        let mut n_contacts = 0;
        let ways: [Way; 4] = [
            &|moment, t| case.by_table(moment, t),
            &|moment, t| case.by_boxes(moment, t),
            &|moment, t| case.by_r_star(moment, t),
            &|moment, t| case.by_all_pairs(moment, t),
        ];
        for moment in &case.yawn {
            let [by_table, by_boxes, by_r_star, by_all] = ways.map(|way| {
                way(moment, &mut touching);
                sorted(&touching)
            });
            assert_eq!(by_table, by_all, "{id}: the table finds other contacts");
            // Another frame rounds otherwise.
            let same = |a: &[[u16; 2]], b: &[[u16; 2]]| a.len().abs_diff(b.len()) <= 1;
            assert!(same(&by_all, &by_boxes) && same(&by_all, &by_r_star), "{id}: a tree finds other contacts");
            n_contacts += by_all.len();
        }
        let [by_table, by_boxes, by_r_star, by_all] = contest(&case.yawn, ways, &mut touching);
        let [tests, all, leaves, boxes] = case.counts(&mut touching);
        let shape = maker.shape(&library::breed(&maker.table, id).expect("an embedded breed"));
        let make = |_| {
            let start = Instant::now();
            black_box(maker.swept(&shape));
            start.elapsed().as_secs_f64() * 1e3
        };
        let made = (0..5).map(make).fold(f64::INFINITY, f64::min);
        let bytes: usize = case.swept.tables.iter().map(|t| t.n_bytes()).sum();
        eprintln!(
            "| `{id}` | {} | {:.1} | {tests} | {leaves}, {boxes} | {all} | {by_table:.0} | {:.1} | {:.1} | {:.0} | {} | {made:.0} |",
            case.swept.spheres.at_rest.len(),
            n_contacts as f64 / FRAMES as f64,
            by_boxes / by_table,
            by_r_star / by_table,
            by_all / by_table,
            bytes / 1000,
        );
    }
    let case = Case::new(&mut maker, BREEDS[0]);
    let mut touching = case.swept.buffers();
    let mut group = c.benchmark_group("touch");
    group.bench_function("frame_by_table", |b| {
        let mut frame = 0;
        b.iter(|| {
            frame = (frame + 1) % FRAMES;
            case.by_table(&case.yawn[frame], black_box(&mut touching));
        })
    });
    group.finish();
}

criterion_group!(touch, benches);
criterion_main!(touch);
