//! The skin's texture coordinates: laid out without fold or overlap, mirrored, cut where nobody looks, little stretched,
//! and right at every level.
#![cfg(feature = "head")]

use glam::{Vec2, Vec3};
use londra::anatomy::{ParamTable, library};
use londra::frame::{Part, Pipeline, Uv};
use londra::rig::{HEAD_UV, HalfUv, Rig};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

struct World {
    table: ParamTable,
    rig: Arc<Rig>,
    uv: HalfUv,
}

fn world() -> World {
    let table = ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"));
    let rig = Arc::new(Rig::embedded(&table).unwrap_or_else(|e| panic!("{e}")));
    let uv = HalfUv::parse(HEAD_UV, rig.half()).unwrap_or_else(|e| panic!("{e}"));
    World { table, rig, uv }
}

fn pipeline(world: &World, level: u32) -> Pipeline {
    let mut pipeline = Pipeline::new(world.rig.clone(), level).unwrap_or_else(|e| panic!("{e}"));
    pipeline.set_uv(true).unwrap_or_else(|e| panic!("{e}"));
    pipeline
}

/// Runs with the skin of a breed at a level, with texture coordinates.
fn with_skin<T>(world: &World, level: u32, breed: &str, run: impl FnOnce(&Part<'_>, &Uv) -> T) -> T {
    let mut pipeline = pipeline(world, level);
    let breed = library::breed(&world.table, breed).unwrap_or_else(|e| panic!("{e}"));
    let frame = pipeline.update(&breed);
    let skin = &frame.parts[0];
    run(skin, skin.uv.expect("asked for"))
}

/// Exact: multiples of 2⁻²⁶.
fn whole(p: Vec2) -> [i128; 2] {
    p.to_array().map(|x| (f64::from(x) * f64::from(1 << 26)).round() as i128)
}

/// Twice the area, positive where the triangle is counter-clockwise as one sees the texture (v downwards).
fn turn([p, q, r]: [[i128; 2]; 3]) -> i128 {
    -((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]))
}

/// Pairs of triangles with a common inner point. Two triangles have none just if all of the one lies beyond a side of the
/// other, or the other way round.
fn overlaps(triangles: &[[Vec2; 3]]) -> Vec<(usize, usize)> {
    const CELLS: f32 = 128.0;
    let exact: Vec<[[i128; 2]; 3]> = triangles.iter().map(|t| t.map(whole)).collect();
    let beyond = |a: &[[i128; 2]; 3], b: &[[i128; 2]; 3]| {
        (0..3).any(|k| b.iter().all(|&p| turn([a[k], a[(k + 1) % 3], p]) <= 0))
    };
    let mut cells: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    let mut out = BTreeSet::new();
    for (i, t) in triangles.iter().enumerate() {
        let low = (t[0].min(t[1]).min(t[2]) * CELLS).floor();
        let high = (t[0].max(t[1]).max(t[2]) * CELLS).floor();
        for y in low.y as u32..=high.y as u32 {
            for x in low.x as u32..=high.x as u32 {
                let here = cells.entry((x, y)).or_default();
                let crossing = here.iter().filter(|&&j| !beyond(&exact[i], &exact[j]) && !beyond(&exact[j], &exact[i]));
                out.extend(crossing.map(|&j| (j, i)));
                here.push(i);
            }
        }
    }
    out.into_iter().collect()
}

fn triangles_of(uv: &Uv) -> Vec<[Vec2; 3]> {
    uv.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|v| uv.coordinates[v as usize])).collect()
}

#[test]
fn a_triangle_of_the_texture_is_flipped_or_lies_over_another() {
    let world = world();
    let (values, corners) = world.uv.corners(world.rig.half());
    let control: Vec<[Vec2; 3]> =
        corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|v| values[v as usize])).collect();
    let refined = |level| with_skin(&world, level, "labrador", |_, uv| triangles_of(uv));
    for (what, triangles) in
        [("control mesh", control), ("level 1", refined(1)), ("level 2", refined(2)), ("level 3", refined(3))]
    {
        let flipped = triangles.iter().filter(|t| turn(t.map(whole)) <= 0).count();
        assert_eq!(flipped, 0, "{what}: flipped of {}", triangles.len());
        let overlaps = overlaps(&triangles);
        let (first, n) = (overlaps.first().map(|o| (triangles[o.0], triangles[o.1])), overlaps.len());
        assert_eq!(n, 0, "{what}: pairs that overlap, the first {first:?}");
        println!("{what}: {} triangles, none flipped, none over another", triangles.len());
    }
}

#[test]
fn the_texture_is_not_its_own_mirror_image() {
    let world = world();
    let (values, corners) = world.uv.corners(world.rig.half());
    let n = world.rig.half().faces.len();
    for f in 0..n {
        for k in 0..3 {
            let (left, right) =
                (values[corners[3 * f + k] as usize], values[corners[3 * (n + f) + (3 - k) % 3] as usize]);
            assert_eq!((left.x + right.x, left.y.to_bits()), (1.0, right.y.to_bits()), "face {f}");
            assert!(left.x >= 0.5 && right.x <= 0.5, "face {f} lies in the other side's half");
        }
    }
    // Refined, every place has its image.
    with_skin(&world, 2, "labrador", |_, uv| {
        let key = |p: Vec2| ((p.x * 1e5).round() as i32, (p.y * 1e5).round() as i32);
        let all: BTreeSet<_> = uv.coordinates.iter().map(|&p| key(p)).collect();
        for &p in &uv.coordinates {
            let (x, y) = key(Vec2::new(1.0 - p.x, p.y));
            assert!((-1..=1).any(|i| (-1..=1).any(|j| all.contains(&(x + i, y + j)))), "{p}");
        }
    });
}

/// The seams, each by its name and the vertices it may run along. All are where nobody looks: in the mouth, behind the
/// lids, inside the nostrils, under throat and chin, along the border of the ear and in the fold at its base.
const SEAMS: [(&str, &[&str]); 7] = [
    ("ventral midline", &["l.3.9..14", "l.3..19.14", "ml.3.1"]),
    // And along their edge for one step beside the corner of the mouth.
    ("lips inside", &["mu.3..10.1", "ml.3..10.1", "s.9..10.9", "l.9.9"]),
    ("midline of the mouth's lining", &["mu.3.1..3", "mu.3..10.3", "ml.3.1..3", "ml.3..10.3"]),
    ("lids inside", &["ei.0..11"]),
    ("nostril inside", &["ni.0..9"]),
    ("ear base", &["a0.0..11"]),
    ("ear rim", &["a0..7.0", "a0..7.6", "a8.0..4"]),
];

/// `a.3..5.1` is `a.3.1`, `a.4.1`, `a.5.1`; the first part may have a range too.
fn expand(chain: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    for part in chain.replace("..", "~").split('.') {
        let split = part.find(|c: char| c.is_ascii_digit()).unwrap_or(part.len());
        let (name, numbers) = part.split_at(split);
        let choices: Vec<String> = match numbers.split_once('~') {
            None => vec![part.to_owned()],
            Some((a, b)) => {
                let (a, b): (u32, u32) = (a.parse().unwrap(), b.parse().unwrap());
                (a..=b).map(|k| format!("{name}{k}")).collect()
            }
        };
        let dot = if out[0].is_empty() { "" } else { "." };
        out = out.iter().flat_map(|head| choices.iter().map(move |c| format!("{head}{dot}{c}"))).collect();
    }
    out
}

#[test]
fn a_seam_runs_where_it_is_seen() {
    let world = world();
    let (half, mesh) = (world.rig.half(), world.rig.mesh());
    let (_, corners) = world.uv.corners(half);
    let mirror = half.mirror();
    let tag = |v: londra::mesh::VertexId| {
        let own = (0..half.n_half()).find(|&h| h == v.index() || mirror[h] == v.0).expect("one side or the other");
        half.tags[own].as_str()
    };
    let seams: Vec<(&str, BTreeSet<String>)> =
        SEAMS.iter().map(|(name, chains)| (*name, chains.iter().flat_map(|c| expand(c)).collect())).collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for dedge in mesh.dedges() {
        let Some(twin) = mesh.twin(dedge).filter(|&twin| dedge < twin) else { continue };
        let value = |d: londra::mesh::DedgeId| corners[d.index()];
        if value(dedge) == value(twin.next()) && value(dedge.next()) == value(twin) {
            continue;
        }
        let (a, b) = (tag(mesh.origin(dedge)), tag(mesh.target(dedge)));
        let name = seams.iter().find(|(_, own)| own.contains(a) && own.contains(b));
        let (name, _) = name.unwrap_or_else(|| panic!("a seam from {a} to {b}"));
        *counts.entry(name).or_default() += 1;
    }
    println!("edges on seams, both sides: {counts:?}");
    assert_eq!(counts.len(), SEAMS.len(), "{counts:?}");
}

/// From the texture to the skin: larger and smaller singular value, texture area.
fn stretch(uv: [Vec2; 3], at: [Vec3; 3]) -> (f64, f64, f64) {
    let [p, q, r] = uv.map(|p| p.as_dvec2());
    let [x, y, z] = at.map(|p| p.as_dvec3());
    let area = (q - p).perp_dot(r - p) / 2.0;
    let s = (x * (q.y - r.y) + y * (r.y - p.y) + z * (p.y - q.y)) / (2.0 * area);
    let t = (x * (r.x - q.x) + y * (p.x - r.x) + z * (q.x - p.x)) / (2.0 * area);
    let (a, b, c) = (s.dot(s), s.dot(t), t.dot(t));
    let root = ((a - c).powi(2) + 4.0 * b * b).sqrt();
    (((a + c + root) / 2.0).sqrt(), ((a + c - root) / 2.0).max(0.0).sqrt(), area.abs())
}

#[test]
fn the_texture_is_stretched_too_much() {
    let world = world();
    let half = world.rig.half();
    let mut chart_of = vec![0; 2 * half.faces.len()];
    for (k, chart) in world.uv.charts.iter().enumerate() {
        for &f in &chart.faces {
            chart_of[f as usize] = k;
            chart_of[half.faces.len() + f as usize] = k;
        }
    }
    // By place in the texture the chart of a refined triangle is hard to tell; on the control mesh it is known.
    let (values, corners) = world.uv.corners(half);
    let mut pipeline = pipeline(&world, 4);
    let n = world.uv.charts.len();
    // Sander, Snyder, Gortler and Hoppe 2001: L2 is the root of the mean square of the stretches, weighted by area.
    let mut lines = Vec::new();
    for id in library::ids() {
        let breed = library::breed(&world.table, id).unwrap();
        let frame = pipeline.update(&breed);
        let skin = frame.parts[0].positions;
        let mut all: Vec<Vec<(f64, f64, f64)>> = vec![Vec::new(); n];
        for (f, (t, v)) in corners.chunks_exact(3).zip(world.rig.mesh().indices().chunks_exact(3)).enumerate() {
            let uv = [t[0], t[1], t[2]].map(|c| values[c as usize]);
            all[chart_of[f]].push(stretch(uv, [v[0], v[1], v[2]].map(|v| skin[v as usize])));
        }
        let l2: Vec<(f64, f64, f64)> = all
            .iter()
            .map(|chart| {
                let skin_area: f64 = chart.iter().map(|(a, b, area)| a * b * area).sum();
                let uv_area: f64 = chart.iter().map(|s| s.2).sum();
                let squares: f64 = chart.iter().map(|(a, b, area)| (a * a + b * b) / 2.0 * a * b * area).sum();
                let scale = (uv_area / skin_area).sqrt();
                let mut ratios: Vec<f64> = chart.iter().map(|(a, b, _)| a / b).collect();
                ratios.sort_by(f64::total_cmp);
                let pick = |q: f64| ratios[((ratios.len() - 1) as f64 * q) as usize];
                ((squares / skin_area).sqrt() * scale, pick(0.5), pick(0.95))
            })
            .collect();
        lines.push((id, l2));
    }
    for (k, chart) in world.uv.charts.iter().enumerate() {
        let mut all: Vec<((f64, f64, f64), &str)> = lines.iter().map(|(id, l2)| (l2[k], *id)).collect();
        all.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let (middle, (worst, id)) = (all[all.len() / 2].0, all[all.len() - 1]);
        println!(
            "{:<10} L2 {:.3} in the median breed, {:.3} in {id}; length against width {:.2} median, {:.2} in 19 of 20",
            chart.name, middle.0, worst.0, middle.1, middle.2
        );
        assert!(middle.0 < 1.35 && worst.0 < 2.2, "{}: {middle:?} {worst:?} {id}", chart.name);
    }
}

#[test]
fn charts_lie_closer_than_four_texels_of_a_thousand() {
    let world = world();
    let segment = |p: Vec2, a: Vec2, b: Vec2| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + (b - a) * t)
    };
    let half = world.rig.half();
    // A chart of one side with its sides, both sides' charts apart; those that join are one.
    let mut pieces: Vec<(bool, Vec<[Vec2; 2]>)> = Vec::new();
    for chart in &world.uv.charts {
        let at = |v: u16| Vec2::from(chart.uvs[chart.vertices.partition_point(|&w| w < v)]);
        let sides = chart.faces.iter().flat_map(|&f| {
            let [a, b, c] = half.faces[f as usize].map(at);
            [[a, b], [b, c], [c, a]]
        });
        let sides: Vec<[Vec2; 2]> = sides.collect();
        let image = sides.iter().map(|s| s.map(|p| Vec2::new(1.0 - p.x, p.y))).collect();
        let joins = chart.uvs.iter().any(|uv| uv[0] == 0.5);
        pieces.push((joins, sides));
        pieces.push((joins, image));
    }
    let mut least = f32::INFINITY;
    for (i, (a_joins, a)) in pieces.iter().enumerate() {
        for (b_joins, b) in &pieces[..i] {
            if *a_joins && *b_joins {
                continue;
            }
            for s in a {
                for t in b {
                    least = least.min(segment(s[0], t[0], t[1])).min(segment(t[0], s[0], s[1]));
                }
            }
        }
    }
    println!("charts lie {:.2} texels of 1024 apart", least * 1024.0);
    assert!(least * 1024.0 >= 4.0, "{} texels", least * 1024.0);
}

#[test]
fn what_is_drawn_with_seams_is_another_surface() {
    let world = world();
    for level in 0..=5 {
        with_skin(&world, level, "borzoi", |skin, uv| {
            let at = |v: u32| {
                let [a, b] = uv.vertices[v as usize];
                (skin.positions[a as usize].as_dvec3() + skin.positions[b as usize].as_dvec3()) / 2.0
            };
            let size = |[p, q, r]: [glam::DVec3; 3]| ((q - p).cross(r - p).length() / 2.0, p.dot(q.cross(r)) / 6.0);
            let own = skin.topology.indices.chunks_exact(3);
            let sum =
                |sizes: &mut dyn Iterator<Item = (f64, f64)>| sizes.fold((0.0, 0.0), |s, x| (s.0 + x.0, s.1 + x.1));
            let plain = sum(&mut own.map(|t| size([t[0], t[1], t[2]].map(|v| skin.positions[v as usize].as_dvec3()))));
            let drawn = sum(&mut uv.indices.chunks_exact(3).map(|t| size([t[0], t[1], t[2]].map(at))));
            assert!((plain.0 - drawn.0).abs() < 1e-9 * plain.0, "level {level}: area {plain:?} {drawn:?}");
            assert!((plain.1 - drawn.1).abs() < 1e-9 * plain.1.abs(), "level {level}: volume {plain:?} {drawn:?}");
            let extra = uv.indices.len() - skin.topology.indices.len();
            assert_eq!(extra > 0, level % 2 == 1, "level {level}: only odd levels cut faces");
            assert_eq!(uv.coordinates.len(), uv.vertices.len());
            assert!(uv.coordinates.iter().flat_map(|p| p.to_array()).all(|x| (0.0..=1.0).contains(&x)));
            let used: BTreeSet<u32> = uv.vertices.iter().flatten().copied().collect();
            assert_eq!(used.len(), skin.topology.n_vertices, "level {level}: every vertex is drawn");
            let n: usize = uv.ranges.iter().map(|r| r.count as usize).sum();
            assert_eq!(n, uv.indices.len());
            println!("level {level}: {} vertices, {} with seams", skin.topology.n_vertices, uv.vertices.len());
        });
    }
}
