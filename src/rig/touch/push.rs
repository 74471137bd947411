//! The least push: the shortest list of numbers for which every demand is met.
//!
//! A quadratic programme, minimise |x|² where a·x ≥ b for each demand, by Hildreth 1957, "A quadratic programming
//! procedure": each demand in turn is met exactly, and gives back what later ones made needless. A fixed number of rounds in
//! a fixed order, so that the same demands give the same bits.

/// Numbers that one demand can ask of.
const TERMS: usize = 4;
/// Rounds over all demands: what is left over after them is asked for again by the next query.
const ROUNDS: usize = 12;

/// One demand: the sum of factors times numbers is at least so much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// Number and its factor; a factor of 0 for terms that there are not.
    pub terms: [(u16, f32); TERMS],
    /// What the sum is at least.
    pub least: f32,
}

impl Demand {
    /// Of two numbers.
    pub fn of_two(a: (usize, f32), b: (usize, f32), least: f32) -> Self {
        Self { terms: [(a.0 as u16, a.1), (b.0 as u16, b.1), (0, 0.0), (0, 0.0)], least }
    }
}

/// Demands and what has been given to each; the buffer of a frame.
#[derive(Clone, Debug, Default)]
pub struct Push {
    demands: Vec<(Demand, f32)>,
}

impl Push {
    /// Forgets all demands.
    pub fn clear(&mut self) {
        self.demands.clear();
    }

    /// Whether there is no demand.
    pub fn is_empty(&self) -> bool {
        self.demands.is_empty()
    }

    /// One more demand; its numbers are below the length that [`Push::solve`] is given.
    pub fn add(&mut self, demand: Demand) {
        self.demands.push((demand, 0.0));
    }

    /// Writes the least push.
    pub fn solve(&mut self, x: &mut [f32]) {
        x.fill(0.0);
        for _ in 0..ROUNDS {
            for (Demand { terms, least }, given) in &mut self.demands {
                let size: f32 = terms.iter().map(|(_, a)| a * a).sum();
                if size <= 1e-12 {
                    // Nothing can be asked of.
                    continue;
                }
                let now: f32 = terms.iter().map(|&(k, a)| a * x[usize::from(k)]).sum();
                let more = ((*least - now) / size).max(-*given);
                *given += more;
                terms.iter().for_each(|&(k, a)| x[usize::from(k)] += a * more);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Demand, Push};

    fn solved<const N: usize>(demands: &[Demand]) -> [f32; N] {
        let (mut push, mut x) = (Push::default(), [0.0; N]);
        demands.iter().for_each(|d| push.add(*d));
        push.solve(&mut x);
        x
    }

    #[test]
    fn a_push_is_longer_than_it_need_be() {
        // Both share what one could do alone.
        let [a, b] = solved(&[Demand::of_two((0, 0.5), (1, 0.5), 1.0)]);
        assert!((a - 1.0).abs() < 1e-6 && (b - 1.0).abs() < 1e-6, "{a} {b}");
        // The second demand makes the first one needless.
        let first = Demand::of_two((0, 1.0), (0, 0.0), 1.0);
        let [a] = solved(&[first, Demand { least: 3.0, ..first }, Demand { least: 2.0, ..first }]);
        assert!((a - 3.0).abs() < 1e-6, "{a}");
        // A corner: the nearest point of x + y ≥ 2 and x ≥ 1.5 is (1.5, 0.5).
        let [x, y] = solved(&[Demand::of_two((0, 1.0), (1, 1.0), 2.0), Demand::of_two((0, 1.0), (1, 0.0), 1.5)]);
        assert!((x - 1.5).abs() < 1e-3 && (y - 0.5).abs() < 1e-3, "{x} {y}");
    }

    #[test]
    fn a_demand_of_nothing_is_not_passed_over() {
        assert_eq!(solved(&[Demand::of_two((0, 0.0), (1, 0.0), 1.0)]), [0.0, 0.0]);
    }
}
