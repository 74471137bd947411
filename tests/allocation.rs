//! A frame allocates nothing: counted by the allocator itself. Alone in its file, since the count is of the process.
#![allow(unsafe_code)] // An allocator that counts is one of the few things that cannot be written without.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use glam::Vec3;
use londra::mesh::shapes::cabinet;
#[cfg(feature = "head")]
use londra::motion::{Act, Activation, Build, Cue, Library, Life, Mixed, Side, Stimulus, Temper};
use londra::subdiv::{Evaluator, Plan, Scheme};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call is passed on to the system's allocator unchanged; the count is a plain thread-local number.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn the_count_itself_sees_nothing() {
    assert!(allocations(|| drop(std::hint::black_box(vec![0_u8; 1000]))) > 0);
}

#[test]
fn a_frame_in_the_steady_state_allocates() {
    for shape in cabinet() {
        let mesh = shape.mesh().expect("in the cabinet");
        for levels in 0..=5 {
            let plan = Plan::build(&mesh, Scheme::Sqrt3, levels).expect("small");
            let mut evaluator = Evaluator::new(&plan);
            let mut colours = vec![Vec3::ZERO; plan.n_vertices()];
            let n = allocations(|| {
                for _ in 0..3 {
                    std::hint::black_box(evaluator.evaluate(&plan, &shape.positions));
                    evaluator.evaluate_attribute(&plan, &shape.positions, &mut colours);
                }
            });
            assert_eq!(n, 0, "{} level {levels}", shape.name);
        }
    }
}

#[cfg(feature = "head")]
#[test]
fn a_pose_in_the_steady_state_allocates() {
    let library = Library::embedded().expect("tables that can be read");
    let mut act = Act::new(Build::default());
    for clip in 0..library.clips.len() {
        act.player.layer(Cue::new(&library, clip, 0.0, 0.1));
    }
    act.expressions =
        (0..library.expressions.len()).map(|expression| Mixed { expression, weight: 0.3, start: Some(0.0) }).collect();
    act.life = Some(Life::new(1, Temper::default()));
    let mut overruled = 0;
    let n = allocations(|| {
        for frame in 0..30 {
            let time = f64::from(frame) / 30.0;
            std::hint::black_box(act.pose(&library, time, |_| Stimulus::default(), |_| overruled += 1));
        }
    });
    assert_eq!(n, 0);
    assert!(overruled > 0, "rules were at work");
}

#[cfg(feature = "head")]
#[test]
fn posing_a_head_in_the_steady_state_allocates() {
    use londra::anatomy::{ParamTable, library};
    use londra::rig::{Deformed, Rig, deform::ROUNDS};

    let table = ParamTable::embedded().expect("the embedded table is tested");
    let rig = Rig::embedded(&table).expect("the embedded rig is tested");
    let library = Library::embedded().expect("tables that can be read");
    let mut pressed = vec![Vec3::ZERO; rig.mesh().n_vertices()];
    for id in ["german_shepherd", "basset", "pug"] {
        let breed = library::breed(&table, id).expect("an embedded breed");
        let mut head = Deformed::default();
        rig.deform(&breed.values, ROUNDS, &mut head);
        let mut act = Act::new(Build::of(&table, &breed.values));
        act.life = Some(Life::new(1, Temper { blinks_per_min: 60.0, ..Temper::default() }));
        // Once, to make the buffers: shut lids, and a mouth as wide open as it goes, where most skin is kept off bone.
        let mut wide = Activation::default();
        for unit in ["AU27", "AU143"] {
            wide.set(library.units.find(unit).expect("a unit").0, Side::Both, 1.0);
        }
        rig.pose(&breed.values, &library.pose_of(&wide), &mut head);
        let mut moved = 0;
        let mut step = |act: &mut Act, time: f64| {
            let pose = act.pose(&library, time, |_| Stimulus { heat: 0.5, ..Stimulus::default() }, |_| ());
            rig.pose(&breed.values, &pose, &mut head);
            moved += usize::from(rig.pressed(&breed.values, &pose, &mut head, &mut pressed));
            std::hint::black_box(&head.control);
        };
        for expression in 0..library.expressions.len() {
            let mixed = Mixed { expression, weight: 1.0, start: Some(0.0) };
            act.expressions = vec![mixed];
            act.player = Default::default();
            act.restart();
            let seconds = library.expressions[expression].seconds();
            let n = allocations(|| (0..20).for_each(|k| step(&mut act, seconds * f64::from(k) / 20.0)));
            assert_eq!(n, 0, "{id}, {}", library.expressions[expression].id);
        }
        for clip in 0..library.clips.len() {
            act.expressions = vec![Mixed { expression: clip % library.expressions.len(), weight: 0.3, start: None }];
            act.player = Default::default();
            act.player.layer(Cue::new(&library, clip, 0.0, 0.1));
            act.restart();
            let seconds = library.clips[clip].seconds;
            let n = allocations(|| (0..60).for_each(|k| step(&mut act, seconds * f64::from(k) / 60.0)));
            assert_eq!(n, 0, "{id}, {}", library.clips[clip].id);
        }
        assert!(moved > 0, "skin was pressed");
    }
}

/// A posed frame lends out a list of its parts, which is all that it makes.
#[cfg(feature = "head")]
#[test]
fn a_posed_frame_allocates_more_than_its_list_of_parts() {
    use londra::anatomy::{ParamTable, library};
    use londra::frame::{Layers, Pipeline};
    use londra::rig::Rig;
    use std::sync::Arc;

    let table = ParamTable::embedded().expect("the embedded table is tested");
    let rig = Arc::new(Rig::embedded(&table).expect("the embedded rig is tested"));
    let breed = library::breed(&table, "german_shepherd").expect("an embedded breed");
    let library = Library::embedded().expect("tables that can be read");
    let mut pipeline = Pipeline::new(rig, 3).expect("a level that is allowed");
    pipeline.set_layers(Layers::default().with_open_mouth()).expect("the embedded meshes are tested");
    let anger = library.expression("anger").expect("an expression");
    let mut frame = |k: u32| {
        let moment = anger.moment(anger.seconds() * f64::from(k) / 30.0);
        pipeline.set_pose(library.pose(&moment, 0.0, |_| ()));
        pipeline.update(&breed).parts.len()
    };
    frame(15);
    let list = allocations(|| _ = std::hint::black_box(frame(15)));
    let n = allocations(|| (0..30).for_each(|k| _ = std::hint::black_box(frame(k))));
    assert_eq!(n, 30 * list, "a frame that is shown again makes {list}");
}

#[cfg(feature = "head")]
#[path = "support/mouths.rs"]
mod mouths;

#[cfg(feature = "head")]
#[test]
fn the_question_what_touches_allocates() {
    use londra::anatomy::{ParamTable, library};
    use londra::rig::Rig;
    use londra::rig::touch::{Group, Params, Resolution, Stray, free_jaw, free_lips, free_tongue};
    use std::sync::Arc;

    let table = Arc::new(ParamTable::embedded().expect("the embedded table is tested"));
    let rig = Arc::new(Rig::embedded(&table).expect("the embedded rig is tested"));
    let mut maker = mouths::Maker::new(&table, &rig);
    let shape = maker.shape(&library::breed(&table, "german_shepherd").expect("an embedded breed"));
    let swept = maker.swept(&shape);
    let (mut touching, mut resolution) = (swept.buffers(), Resolution::default());
    let mut skin = shape.skin.clone();
    let mut frame = |k: usize| {
        let params = Params([0.01 * k as f32, 0.001, 0.001, 0.0005 * k as f32, 0.2]);
        let params = free_jaw(&swept, swept.clamped(params), &mut touching);
        let moved = swept.spheres.joints().at(params);
        for group in Group::ALL {
            swept.place(group, &moved, Stray::default(), &mut touching.centres);
        }
        swept.query(params, Stray::default(), &mut touching);
        std::hint::black_box(free_tongue(&swept, &moved, 0.0, &mut touching, &mut resolution));
        // Lips that a hand presses in.
        skin.iter_mut().zip(&shape.skin).for_each(|(to, p)| *to = *p * 0.97);
        std::hint::black_box(free_lips(&swept, &moved, 0.004, &mut skin, &mut touching, &mut resolution));
    };
    // Once to make the buffers as large as they need be.
    (0..60).for_each(&mut frame);
    assert_eq!(allocations(|| (0..60).for_each(&mut frame)), 0);
}
