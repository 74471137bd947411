//! Damped springs in fixed steps, so that the same time gives the same bits however often pictures are drawn.

/// The length of a step, seconds: a power of two, so that the time of a step is exact.
pub const STEP_SECS: f64 = 1.0 / 256.0;

/// How many whole steps lie between 0 and a time, in seconds; none before 0 or where there is no such number.
pub fn steps_until(time: f64) -> u64 {
    // Conversion saturates and makes 0 of what is no number.
    (time / STEP_SECS).floor() as u64
}

/// A value that follows another one with inertia.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spring {
    /// Where it is.
    pub at: f32,
    /// How fast it goes, per second.
    pub speed: f32,
}

impl Spring {
    /// One step towards `to`: `hz`, how often a second it would swing undamped, at most 20; `damping`, 1 where it just does
    /// not swing over. Semi-implicit Euler, which is stable below 1 / (pi [`STEP_SECS`]) Hz.
    pub fn step(&mut self, to: f32, hz: f32, damping: f32) {
        let omega = std::f32::consts::TAU * hz.clamp(0.0, 20.0);
        let pull = omega * (omega * (to - self.at) - 2.0 * damping * self.speed);
        self.speed += STEP_SECS as f32 * pull;
        self.at += STEP_SECS as f32 * self.speed;
        // Nobody sees a tenth of a thousandth of a degree, but a head that is at rest costs nothing.
        if (to - self.at).abs() < 1e-4 && self.speed.abs() < 1e-3 {
            *self = Self { at: to, speed: 0.0 };
        }
    }
}
