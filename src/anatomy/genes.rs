//! The coat of a dog of no breed, as the genes of dogs allow it.
//!
//! Loci, after Kaelin and Barsh 2013, "Genetics of pigmentation in dogs and cats": E (red, masked or neither), K (solid,
//! brindle or neither), A (fawn or sable, agouti, tan points, recessive black), B and D (the form of eumelanin), M (merle),
//! S (white), T (ticking), and how intense phaeomelanin is. How often each is drawn is an estimate of what is met among
//! dogs of no breed, the rare ones more often than that.

use super::{Eumelanin, Marking, MarkingKind, Paint, Pattern, Pigments};
use crate::math::rng::Rng;

/// True once in so many draws.
fn once_in(n: usize, rng: &mut Rng) -> bool {
    rng.below(n) == 0
}

/// A seed of a marking.
fn seed(rng: &mut Rng) -> f32 {
    rng.below(1000) as f32
}

/// A coat drawn at random. The same stream gives the same coat.
pub fn random_pattern(rng: &mut Rng) -> Pattern {
    let (is_brown, is_dilute) = (once_in(5, rng), once_in(7, rng));
    let eumelanin = match (is_brown, is_dilute) {
        (false, false) => Eumelanin::Black,
        (true, false) => Eumelanin::Brown,
        (false, true) => Eumelanin::Blue,
        (true, true) => Eumelanin::Lilac,
    };
    let pigments = Pigments { eumelanin, phaeomelanin: (0.5 + 0.22 * rng.normal() as f32).clamp(0.0, 1.0) };
    let mut markings = Vec::new();
    // E: e/e makes no eumelanin in hair, whatever the other loci say; Em has a mask.
    let (is_red, has_mask) = (once_in(5, rng), once_in(4, rng));
    let base = if is_red {
        markings.push(Marking::new(MarkingKind::Urajiro, Paint::White).by(rng.between(0.05, 0.30)));
        Paint::Phaeomelanin(None)
    } else {
        agouti(pigments, rng, &mut markings)
    };
    if has_mask && !is_red && matches!(base, Paint::Phaeomelanin(_)) {
        let mask = Marking::new(MarkingKind::Mask, Paint::Eumelanin);
        markings.push(mask.with("extent", rng.between(0.4, 0.66)).with("eyes", rng.between(0.1, 0.5)));
    }
    white(rng, &mut markings);
    Pattern { pigments, base, markings }
}

/// K and A, and M where there is eumelanin: the base, and markings on it.
fn agouti(pigments: Pigments, rng: &mut Rng, markings: &mut Vec<Marking>) -> Paint {
    let merle = once_in(9, rng).then(|| {
        let patches = Marking::new(MarkingKind::Merle, Paint::Eumelanin).with("seed", seed(rng));
        patches.with("size_mm", rng.between(20.0, 45.0)).with("cover", rng.between(0.3, 0.55))
    });
    let kb = rng.below(10);
    // Dilution by merle is that of the pigment halfway to white.
    let dark = match merle {
        Some(_) => Paint::Colour(pigments.colour(Paint::Eumelanin).lerp(pigments.colour(Paint::White), 0.28)),
        None => Paint::Eumelanin,
    };
    let points = |rng: &mut Rng| {
        let tan = Marking::new(MarkingKind::TanPoints, Paint::Phaeomelanin(None));
        tan.with("brows", rng.between(0.35, 0.6))
            .with("muzzle", rng.between(0.5, 0.75))
            .with("cheeks", rng.between(0.3, 0.6))
    };
    if kb < 3 {
        // Solid: A does not show.
        markings.extend(merle);
        return dark;
    }
    let is_brindle = kb == 3;
    let brindle = |rng: &mut Rng| {
        let stripes = Marking::new(MarkingKind::Brindle, Paint::Eumelanin).with("seed", seed(rng));
        stripes.with("width", rng.between(0.35, 0.65)).with("spacing_mm", rng.between(5.0, 9.0))
    };
    match rng.below(8) {
        // Fawn, or sable with dark tips.
        0..=3 => {
            markings.extend(is_brindle.then(|| brindle(rng)));
            let sable = Marking::new(MarkingKind::Sable, Paint::Eumelanin);
            markings.push(sable.with("extent", rng.between(0.2, 0.6)).by(rng.between(0.1, 0.8)));
            markings.push(Marking::new(MarkingKind::Urajiro, Paint::White).by(rng.between(0.05, 0.35)));
            Paint::Phaeomelanin(None)
        }
        // Agouti.
        4 => {
            markings.push(Marking::new(MarkingKind::Grizzle, Paint::Eumelanin).with("density", rng.between(0.3, 0.5)));
            markings.push(Marking::new(MarkingKind::Sable, Paint::Eumelanin).by(0.7));
            markings.push(Marking::new(MarkingKind::Urajiro, Paint::White).by(rng.between(0.5, 0.9)));
            Paint::Phaeomelanin(Some((pigments.phaeomelanin * 0.8).clamp(0.0, 1.0)))
        }
        // Tan points.
        5 | 6 => {
            markings.extend(merle);
            markings.push(points(rng));
            dark
        }
        _ => {
            markings.extend(merle);
            dark
        }
    }
}

/// S and T.
fn white(rng: &mut Rng, markings: &mut Vec<Marking>) {
    let mut add = |marking: Marking| markings.push(marking);
    let new = |kind| Marking::new(kind, Paint::White);
    let is_ticked = once_in(4, rng);
    match rng.below(10) {
        // A little on the throat.
        4 | 5 => add(new(MarkingKind::Throat).with("extent", rng.between(0.3, 0.5))),
        // Irish.
        6 | 7 => {
            add(new(MarkingKind::Muzzle).with("extent", rng.between(0.15, 0.5)));
            add(new(MarkingKind::Blaze).with("width_mm", rng.between(6.0, 22.0)).with("top", rng.between(0.3, 0.9)));
            add(new(MarkingKind::Throat).with("extent", 0.6));
            add(new(MarkingKind::Collar).with("width_mm", rng.between(10.0, 60.0)));
        }
        // Piebald.
        8 | 9 => {
            let piebald = new(MarkingKind::Piebald).with("extent", rng.between(0.3, 0.75)).with("seed", seed(rng));
            let sides = [rng.between(0.4, 1.2), rng.between(0.4, 1.2)];
            add(piebald.with("left", sides[0]).with("right", sides[1]).with("ragged", rng.between(0.1, 0.6)));
            if is_ticked {
                let flecks = Marking::new(MarkingKind::Ticking, Paint::Eumelanin).with("seed", seed(rng));
                add(flecks.with("density", rng.between(0.2, 0.8)));
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_random_coat_is_always_the_same_or_not_what_genes_allow() {
        let coat = |seed| random_pattern(&mut Rng::new(seed));
        let mut kinds = Vec::new();
        for seed in 0..300 {
            let Pattern { base, markings, .. } = coat(seed);
            assert_eq!(coat(seed).markings, markings);
            let has = |kind| markings.iter().any(|m| m.kind == kind);
            // A mask needs phaeomelanin to be seen on, and stripes need fawn.
            assert!(!has(MarkingKind::Mask) || matches!(base, Paint::Phaeomelanin(_)), "{markings:?}");
            assert!(!(has(MarkingKind::Brindle) && has(MarkingKind::TanPoints)), "{markings:?}");
            assert!(!(has(MarkingKind::Merle) && base == Paint::Eumelanin), "{markings:?}");
            kinds.extend(markings.iter().map(|m| m.kind));
        }
        for kind in [MarkingKind::Mask, MarkingKind::Merle, MarkingKind::Brindle, MarkingKind::Piebald] {
            assert!(kinds.iter().filter(|k| **k == kind).count() > 5, "{}", kind.name());
        }
    }
}
