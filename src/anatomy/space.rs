//! The space of breeds: how they differ, and dogs drawn at random from it.
//!
//! A dog is a point whose coordinates are the logarithm of the cranial length, which is its size, and one number for
//! each other measure, which is shape: a length that is always positive as the logarithm of its ratio to the cranial
//! length, any other length as that ratio, angles and ratios as they are.
//!
//! In it the breeds have a mean m and a covariance. With the n centred breeds as columns of A, divided by √(n - 1), the
//! covariance is A·Aᵀ, so that m + A·g has exactly that mean and covariance where the n numbers g are independent normal
//! deviates: nothing needs to be decomposed, and what no two breeds differ in never varies.

use super::{Breed, Hair, Locks, Look, ParamSpec, ParamTable, Unit, random_pattern};
use crate::math::ops;
use crate::math::rng::Rng;

/// The measure that all lengths refer to.
pub(super) const SIZE: &str = "cranial_length_mm";

/// How breeds lie to each other. Made once for a table and a list of breeds.
#[derive(Clone, Debug)]
pub struct Space {
    chart: Chart,
    /// One per row of the table.
    mean: Vec<f64>,
    /// For each row one number per breed: its distance from the mean, divided by √(n - 1).
    factor: Vec<Vec<f64>>,
    /// Least and greatest coordinate of a breed, one pair per row.
    span: Vec<[f64; 2]>,
}

/// Why there is no space.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpaceError {
    /// The table lacks the measure of size.
    #[error("rigs/anatomy.ron has no measure `{0}`, to which the proportions of dogs refer")]
    NoSize(&'static str),
    /// One breed does not vary.
    #[error("{0} breeds: at least two are needed to know how breeds differ")]
    TooFew(usize),
}

impl Space {
    /// The space of these breeds, whose values belong to the table.
    ///
    /// # Errors
    /// A table without a size, or fewer than two breeds.
    pub fn new(table: &ParamTable, breeds: &[Breed]) -> Result<Self, SpaceError> {
        let chart = Chart::new(table).ok_or(SpaceError::NoSize(SIZE))?;
        let n = breeds.len();
        if n < 2 {
            return Err(SpaceError::TooFew(n));
        }
        let points: Vec<Vec<f64>> = breeds.iter().map(|breed| chart.point(&breed.values)).collect();
        let (mut mean, mut factor, mut span) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..table.specs.len() {
            let middle = points.iter().map(|p| p[row]).sum::<f64>() / n as f64;
            mean.push(middle);
            factor.push(points.iter().map(|p| (p[row] - middle) / ops::sqrt((n - 1) as f64)).collect());
            let of_breeds = points.iter().map(|p| p[row]);
            span.push([of_breeds.clone().fold(f64::INFINITY, f64::min), of_breeds.fold(f64::NEG_INFINITY, f64::max)]);
        }
        Ok(Self { chart, mean, factor, span })
    }

    /// The coordinates of a dog: one per row of the table; `values` are SI, in the same order.
    pub fn point(&self, values: &[f32]) -> Vec<f64> {
        self.chart.point(values)
    }

    /// Covariance of two rows' coordinates over the breeds.
    pub fn covariance(&self, row: usize, other: usize) -> f64 {
        dot(&self.factor[row], &self.factor[other])
    }

    /// The dog in the middle of the breeds, with every value set and the default look.
    pub fn mean(&self, table: &ParamTable) -> Breed {
        self.dog(table, &self.mean)
    }

    /// A dog drawn from the covariance of the breeds, cut off at the most extreme of them (an ear's fold slants as in rose
    /// ears or not at all, but a normal deviate has two sides) and at the ends of each range, with the hair of one of `coats`
    /// (the default where there is none) in colours that genes allow. What `locks` name is `base`'s, bit for bit; the rest is drawn as it goes
    /// with that: a long ear that is kept asks for a head that goes with long ears.
    pub fn random(&self, table: &ParamTable, coats: &[Breed], base: &Breed, locks: &Locks, rng: &mut Rng) -> Breed {
        let mut deviates: Vec<f64> = (0..self.factor.first().map_or(0, Vec::len)).map(|_| rng.normal()).collect();
        self.condition(base, locks, &mut deviates, rng);
        let drawn = self.mean.iter().zip(&self.factor).map(|(m, row)| m + dot(row, &deviates));
        let point: Vec<f64> = drawn.zip(&self.span).map(|(x, [low, high])| x.clamp(*low, *high)).collect();
        let mut dog = self.dog(table, &point);
        let hair = coats.get(rng.below(coats.len())).map_or_else(Hair::default, |coat| coat.look.hair.clone());
        dog.look = Look { hair, ..Look::of(random_pattern(rng)) };
        locks.hold(base, &mut dog);
        dog
    }

    fn dog(&self, table: &ParamTable, point: &[f64]) -> Breed {
        let mut dog = Breed::defaults(table);
        self.chart.values(table, point, &mut dog.values);
        dog.set.fill(true);
        dog
    }

    /// Moves normal deviates to where the locked rows of `base` lead.
    ///
    /// The deviates of a Gaussian under a linear observation B·g + noise = d are g + Bᵀ·(B·Bᵀ + λ)⁻¹·(d - B·g - noise)
    /// (Matheron's rule; Journel and Huijbregts 1978, "Mining Geostatistics"), here in its form with n equations, one
    /// for each breed. Of a locked length its own logarithm is observed, of a locked signed length its ratio to the
    /// base's cranial length; every observation is divided by its deviation over the breeds.
    /// Departure: breeds are few, and a whole group of measures would tell which breed it is and leave no freedom. So
    /// the noise's variance λ grows with their number: one lock counts almost in full, many together like two.
    fn condition(&self, base: &Breed, locks: &Locks, deviates: &mut [f64], rng: &mut Rng) {
        let n = deviates.len();
        let point = self.chart.point(&base.values);
        let seen: Vec<(Vec<f64>, f64)> = locks.rows().filter_map(|row| self.observed(row, &point)).collect();
        let lambda = 0.02 + 0.5 * seen.len().saturating_sub(1) as f64;
        let mut matrix = vec![vec![0.0; n]; n];
        let mut right = vec![0.0; n];
        for (row, value) in &seen {
            let gap = value - dot(row, deviates) - ops::sqrt(lambda) * rng.normal();
            for i in 0..n {
                right[i] += row[i] * gap;
                for j in 0..n {
                    matrix[i][j] += row[i] * row[j];
                }
            }
        }
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] += lambda;
        }
        for (deviate, step) in deviates.iter_mut().zip(solve(matrix, right)) {
            *deviate += step;
        }
    }

    /// What a locked row tells of the deviates, and the value it has; none where the breeds do not differ in it.
    fn observed(&self, row: usize, point: &[f64]) -> Option<(Vec<f64>, f64)> {
        let (mut factor, mut value) = (self.factor[row].clone(), point[row] - self.mean[row]);
        if self.chart.scales[row] == Scale::LogLength {
            let size = self.chart.size;
            factor.iter_mut().zip(&self.factor[size]).for_each(|(f, s)| *f += s);
            value += point[size] - self.mean[size];
        }
        let deviation = ops::sqrt(dot(&factor, &factor));
        if deviation < 1e-9 {
            return None;
        }
        factor.iter_mut().for_each(|f| *f /= deviation);
        Some((factor, value / deviation))
    }
}

/// Values to coordinates and back.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    size: usize,
    scales: Vec<Scale>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// Logarithm of the size in metres.
    Size,
    /// Logarithm of the ratio to the size.
    LogLength,
    /// Ratio to the size.
    Length,
    /// Itself.
    Linear,
}

impl Chart {
    /// None where the table has no size.
    pub(super) fn new(table: &ParamTable) -> Option<Self> {
        let size = table.index_of(SIZE)?;
        let scale = |(row, spec): (usize, &ParamSpec)| match spec.unit {
            _ if row == size => Scale::Size,
            Unit::Millimetre if spec.min > 0.0 => Scale::LogLength,
            Unit::Millimetre => Scale::Length,
            Unit::Degree | Unit::Week | Unit::Kilogram | Unit::Ratio => Scale::Linear,
        };
        Some(Self { size, scales: table.specs.iter().enumerate().map(scale).collect() })
    }

    /// The coordinates of values (SI).
    pub(super) fn point(&self, values: &[f32]) -> Vec<f64> {
        let size = f64::from(values[self.size]);
        let coordinate = |(&scale, &value): (&Scale, &f32)| match (scale, f64::from(value)) {
            (Scale::Size, _) => ops::ln(size),
            (Scale::LogLength, value) => ops::ln(value / size),
            (Scale::Length, value) => value / size,
            (Scale::Linear, value) => value,
        };
        self.scales.iter().zip(values).map(coordinate).collect()
    }

    /// The values (SI) at coordinates, within their ranges, with as many digits as a person would write.
    pub(super) fn values(&self, table: &ParamTable, point: &[f64], values: &mut [f32]) {
        let write = |spec: &ParamSpec, si: f64| tidy(spec, si as f32).clamp(spec.min_si(), spec.max_si());
        values[self.size] = write(&table.specs[self.size], ops::exp(point[self.size]));
        let size = f64::from(values[self.size]);
        for (row, spec) in table.specs.iter().enumerate().filter(|(row, _)| *row != self.size) {
            let si = match self.scales[row] {
                Scale::Size | Scale::LogLength => size * ops::exp(point[row]),
                Scale::Length => size * point[row],
                Scale::Linear => point[row],
            };
            values[row] = write(spec, si);
        }
    }
}

/// Rounded to hundredths of a millimetre or degree, thousandths of a ratio.
fn tidy(spec: &ParamSpec, si: f32) -> f32 {
    let per_unit = if spec.unit == Unit::Ratio { 1000.0 } else { 100.0 };
    let wide = f64::from(si);
    let value = match spec.unit {
        Unit::Millimetre => wide * 1000.0,
        Unit::Degree => wide.to_degrees(),
        Unit::Week | Unit::Kilogram | Unit::Ratio => wide,
    };
    // Minus zero is written with a sign; adding zero takes it off.
    spec.to_si((value * per_unit).round() / per_unit + 0.0)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Solves a symmetric, positive definite system by elimination without pivoting.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        let pivot = matrix[k].clone();
        for i in k + 1..n {
            let part = matrix[i][k] / pivot[k];
            for j in k..n {
                matrix[i][j] -= part * pivot[j];
            }
            right[i] -= part * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}
