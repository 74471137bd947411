//! What may touch in a mouth: spheres that cover, tables that miss nothing, and teeth, tongue, lips and eyes that stay out
//! of each other.
//!
//! Millimetres are those of a head with a skull of 200 mm. `--nocapture` prints the tables of worst cases.
#![cfg(feature = "head")]

#[path = "support/mouths.rs"]
mod mouths;
#[path = "support/settings.rs"]
mod settings;

use londra::rig::touch::*;
use mouths::Maker;
use settings::World;

#[test]
fn explore() {
    let world = World::embedded();
    let mut maker = Maker::new(&world.table, &world.rig);
    for breed in world.spanning() {
        let shape = maker.shape(breed);
        let t = std::time::Instant::now();
        let spheres = Spheres::new(&maker.head(&shape));
        let t1 = t.elapsed();
        let t = std::time::Instant::now();
        let swept = maker.swept(&shape);
        let t2 = t.elapsed();
        let counts: Vec<usize> = Part::ALL.iter().map(|p| spheres.of(*p).len()).collect();
        let fits: Vec<(f32, f32)> = spheres.fits.iter().map(|f| (f.0 / spheres.unit * 1.0, f.1 / spheres.unit)).collect();
        println!("{}: {counts:?} {fits:.2?} {t1:?} {t2:?}", breed.id);
        for t in &swept.tables { let cell = t.cell(Params::default(), 0.0).unwrap(); println!("   at rest {}", t.list(cell).len());
            println!("   cells {} kept {} longest {} bytes {} mean {}", t.n_cells(), t.kept().len(), t.longest(), t.n_bytes(), (0..t.n_cells()).map(|c| t.list(c).len()).sum::<usize>() / t.n_cells());
        }
        let mut touching = swept.buffers();
        for gape in [0.0_f32, 5.0, 15.0, 30.0, 57.0] {
            let params = Params::default().with_gape(gape.to_radians());
            let moved = swept.spheres.joints().at(params);
            Group::ALL.iter().for_each(|&g| swept.place(g, &moved, Stray::default(), &mut touching.centres));
            swept.query(params, Stray::default(), &mut touching);
            let mut by: std::collections::BTreeMap<[Part; 2], (usize, f32)> = Default::default();
            for c in &touching.contacts {
                let e = by.entry(swept.parts(c)).or_default();
                e.0 += 1;
                e.1 = e.1.max(c.depth / spheres.unit * 1.0);
            }
            println!("   {gape}: {by:?}");
        }
    }
}
