//! The caller's thread and those that help it.
//!
//! The caller works too, and whoever is free takes the next piece. Systems put a thread that wakes another to sleep on the
//! same core as that other, where the two take turns; a caller that goes on working keeps its core, and the helper gets one
//! of its own. A helper that comes late finds less to do, and nobody waits for it.

use std::sync::{Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

/// More threads than any machine has use for; a larger number is taken as this one.
const MAX_THREADS: usize = 256;

/// The caller alone, or with helpers.
#[derive(Debug, Default)]
pub(super) struct Team {
    helpers: Option<ThreadPool>,
}

impl Team {
    /// Nobody but the caller.
    pub(super) const ALONE: Team = Team { helpers: None };

    /// A team of `n`, the caller among them; 0 means the caller alone. So it is where the system gives no more threads.
    pub(super) fn of(n: usize) -> Team {
        let n_helpers = n.clamp(1, MAX_THREADS) - 1;
        let pool = || ThreadPoolBuilder::new().num_threads(n_helpers).build().ok();
        Team { helpers: if n_helpers == 0 { None } else { pool() } }
    }

    /// Whether [`Team::of`] would give a team of another size.
    pub(super) fn is_of(&self, n: usize) -> bool {
        self.size() == n.clamp(1, MAX_THREADS)
    }

    /// Members, the caller among them.
    pub(super) fn size(&self) -> usize {
        1 + self.helpers.as_ref().map_or(0, ThreadPool::current_num_threads)
    }

    /// Has each piece worked on once, by one member. A member has one of the states to itself; where there are fewer
    /// states than members, some members rest.
    pub(super) fn share_with<S: Send, T>(
        &self,
        states: &mut [S],
        pieces: impl DoubleEndedIterator<Item = T> + ExactSizeIterator + Send,
        work: impl Fn(&mut S, T) + Sync,
    ) {
        let n_pieces = pieces.len();
        let Some((own, others)) = states.split_first_mut() else {
            assert_eq!(n_pieces, 0, "a state for the caller at least");
            return;
        };
        match &self.helpers {
            Some(helpers) if n_pieces > 1 => {
                let pieces = Mutex::new(pieces);
                let locked = || pieces.lock().unwrap_or_else(PoisonError::into_inner);
                let help = |state: &mut S| {
                    while let Some(piece) = { locked().next_back() } {
                        work(state, piece);
                    }
                };
                let n_helpers = helpers.current_num_threads().min(n_pieces - 1);
                helpers.in_place_scope(|scope| {
                    for state in others.iter_mut().take(n_helpers) {
                        let help = &help;
                        scope.spawn(move |_| help(state));
                    }
                    while let Some(piece) = { locked().next() } {
                        work(own, piece);
                    }
                });
            }
            _ => pieces.for_each(|piece| work(own, piece)),
        }
    }

    /// The same for work that needs no state.
    pub(super) fn share<T>(
        &self,
        pieces: impl DoubleEndedIterator<Item = T> + ExactSizeIterator + Send,
        work: impl Fn(T) + Sync,
    ) {
        // Takes no memory: the states have no size.
        self.share_with(&mut vec![(); self.size()], pieces, |(), piece| work(piece));
    }
}

#[cfg(test)]
mod tests {
    use super::Team;

    #[test]
    fn a_piece_is_left_out_or_done_twice() {
        for n in [0, 1, 2, 3, 8] {
            let team = Team::of(n);
            assert!(team.is_of(n));
            for n_pieces in [0, 1, 2, 7, 1000] {
                let mut pieces = vec![0; n_pieces];
                team.share(pieces.iter_mut().enumerate(), |(i, piece)| *piece += i + 1);
                assert!(pieces.iter().enumerate().all(|(i, &piece)| piece == i + 1), "{n} {n_pieces}");
                let mut done = vec![0; team.size()];
                team.share_with(&mut done, 0..n_pieces, |done, _| *done += 1);
                assert_eq!(done.iter().sum::<usize>(), n_pieces, "{n}");
            }
        }
    }

    #[test]
    #[should_panic(expected = "a piece that cannot be done")]
    fn a_panic_of_a_helper_is_lost() {
        Team::of(3).share(0..100, |i| assert!(i != 50, "a piece that cannot be done"));
    }
}
