//! The graphics card's evaluation against the processor's, on the software driver.
//!
//! A card may keep more digits than it must and add in pairs, so bits are not compared: positions agree within 2e-6 of the
//! size (16 units in the last place over some steps), normals within 1e-3 radians where the surface is not crumpled.
#![cfg(feature = "graphics")]

use std::sync::Arc;

use glam::Vec3;
use londra::anatomy::{ParamTable, library};
use londra::frame::Pipeline;
use londra::mesh::shapes::{cabinet, grid_with_hole};
use londra::mesh::{DedgeId, FaceId, VertexId};
use londra::render::{Camera, Drawing, Gpu, Lens, Offscreen, ShaderSources, SubdividePass, View};
use londra::rig::Rig;
use londra::subdiv::{Normals, Plan, PlanError, PlanOptions, Positions, Scheme, Tags, evaluate_once};

fn gpu() -> Gpu {
    Gpu::open_software().unwrap_or_else(|e| panic!("{e}"))
}

fn output(gpu: &Gpu, n: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("output"),
        size: (12 * n) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Vec<Vec3> {
    let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("staging"),
        size: buffer.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
    gpu.queue.submit([encoder.finish()]);
    staging.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.expect("readable"));
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    let bytes = staging.slice(..).get_mapped_range().expect("mapped").to_vec();
    let floats: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
    floats.chunks_exact(3).map(Vec3::from_slice).collect()
}

fn check(gpu: &Gpu, pass: &SubdividePass, plan: &Plan, control: &[Vec3], what: &str) {
    assert!(SubdividePass::takes(&gpu.device, plan), "{what}");
    let n = plan.n_vertices();
    let (positions, normals) = (output(gpu, n), output(gpu, n));
    let buffers = pass.load(&gpu.device, &gpu.queue, plan, &positions, &normals);
    // Twice: the second evaluation must not see anything of the first.
    for moved in [1.5, 1.0] {
        let control: Vec<Vec3> = control.iter().map(|p| *p * moved).collect();
        buffers.write_control(&gpu.queue, &control);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        pass.record(&mut encoder, &buffers);
        gpu.queue.submit([encoder.finish()]);
        let (expected, expected_normals) = evaluate_once(plan, &control);
        let size = expected.iter().fold(0.0_f32, |s, p| s.max(p.abs().max_element()));
        for (v, (ours, theirs)) in read(gpu, &positions).iter().zip(&expected).enumerate() {
            assert!((*ours - *theirs).length() <= 2e-6 * size, "{what}: vertex {v} at {ours}, not {theirs}");
        }
        // The two sides of a pillow cancel: what is left around its vertices is rounding.
        if plan.options().normals != Normals::None && !what.starts_with("pillow") {
            let close =
                read(gpu, &normals).iter().zip(&expected_normals).filter(|(a, b)| a.dot(**b) > 1.0 - 1e-6).count();
            assert!(close as f32 >= 0.999 * n as f32, "{what}: only {close} of {n} normals");
        }
    }
}

#[test]
fn the_card_puts_a_vertex_elsewhere() {
    let gpu = gpu();
    let pass = SubdividePass::new(&gpu.device, &ShaderSources::default()).unwrap_or_else(|e| panic!("{e}"));
    for shape in cabinet() {
        let mesh = shape.mesh().expect("in the cabinet");
        for scheme in Scheme::ALL {
            let plan = Plan::build(&mesh, scheme, 2).expect("small");
            check(&gpu, &pass, &plan, &shape.positions, &format!("{} {scheme:?}", shape.name));
        }
    }
    let shape = grid_with_hole();
    let tags = Tags {
        creases: vec![(VertexId(14), VertexId(15), 1.5)],
        holes: vec![FaceId(44)],
        frozen: vec![FaceId(0)],
        ..Tags::default()
    };
    let mesh = shape.mesh().expect("a grid");
    for normals in [Normals::Faces, Normals::None] {
        let options = PlanOptions { normals, ..PlanOptions::new(Scheme::Sqrt3, 4) };
        let plan = Plan::build_with(&mesh, &tags, &options).expect("small");
        check(&gpu, &pass, &plan, &shape.positions, "tagged");
    }
}

#[test]
fn the_card_has_another_limit() {
    let gpu = gpu();
    let pass = SubdividePass::new(&gpu.device, &ShaderSources::default()).unwrap_or_else(|e| panic!("{e}"));
    for shape in cabinet() {
        let mesh = shape.mesh().expect("in the cabinet");
        let tags = Tags { creases: vec![(mesh.origin(DedgeId(0)), mesh.target(DedgeId(0)), 1.5)], ..Tags::default() };
        for scheme in Scheme::ALL {
            for positions in [Positions::Level, Positions::Limit] {
                for normals in [Normals::Limit, Normals::Faces, Normals::None] {
                    for levels in 0..3 {
                        let options = PlanOptions { positions, normals, ..PlanOptions::new(scheme, levels) };
                        let tags = if scheme.has_creases() { &tags } else { &Tags::default() };
                        match Plan::build_with(&mesh, tags, &options) {
                            Ok(plan) => {
                                check(&gpu, &pass, &plan, &shape.positions, &format!("{} {options:?}", shape.name));
                            }
                            Err(e) => assert!(matches!(e, PlanError::NoLimits { .. }), "{e}"),
                        }
                    }
                }
            }
        }
    }
}

/// The head with the skin that the card works out, beside that of the processor: the switch of the window.
#[test]
fn a_picture_shows_who_evaluated_it() {
    let table = ParamTable::embedded().expect("the table of the program");
    let rig = Arc::new(Rig::embedded(&table).expect("the rig of the program"));
    let mut pipeline = Pipeline::new(rig, 3).expect("a level in range");
    let mut offscreen = Offscreen::new(gpu()).unwrap_or_else(|e| panic!("{e}"));
    let mut pictures = Vec::new();
    for id in ["pug", "beagle", "pug"] {
        let breed = library::breed(&table, id).expect("a breed of the program");
        let frame = pipeline.update(&breed);
        let mut camera = Camera::at(View::Portrait, None, Lens::default());
        camera.fit(frame.parts.iter().flat_map(|p| p.positions), 1.0, 0.05);
        let drawing = Drawing::new(camera);
        let processor = offscreen.draw(&frame, &drawing, [160, 160]).expect("drawn");
        let card = offscreen.draw(&frame, &Drawing { on_card: true, ..drawing }, [160, 160]).expect("drawn");
        let differing = processor.rgba.iter().zip(&card.rgba).filter(|(a, b)| a.abs_diff(**b) > 8).count();
        assert!(differing < processor.rgba.len() / 200, "{id}: {differing} of {} bytes differ", processor.rgba.len());
        // And from the card alone, with nothing uploaded before.
        offscreen.forget();
        let alone = offscreen.draw(&frame, &Drawing { on_card: true, ..drawing }, [160, 160]).expect("drawn");
        assert!(alone.rgba == card.rgba, "{id}: the card needs what was uploaded");
        pictures.push(card.rgba);
    }
    assert!(pictures[0] == pictures[2] && pictures[0] != pictures[1], "the card draws the head before");
}
