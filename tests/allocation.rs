//! A frame allocates nothing: counted by the allocator itself. Alone in its file, since the count is of the process.
#![allow(unsafe_code)] // An allocator that counts is one of the few things that cannot be written without.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use glam::Vec3;
use londra::mesh::shapes::cabinet;
#[cfg(feature = "head")]
use londra::motion::{Act, Build, Cue, Library, Life, Mixed, Stimulus, Temper};
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
