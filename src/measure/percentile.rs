//! Where a number stands among others.

/// The part of `among` that lies below `value`, those that equal it counted half; 0 to 100. Nothing where there is nobody
/// to compare with.
pub fn percentile(value: f32, among: impl Iterator<Item = f32>) -> Option<f32> {
    let (mut below, mut n) = (0.0_f32, 0.0_f32);
    for other in among {
        n += 1.0;
        below += match other.total_cmp(&value) {
            std::cmp::Ordering::Less => 1.0,
            std::cmp::Ordering::Equal => 0.5,
            std::cmp::Ordering::Greater => 0.0,
        };
    }
    (n > 0.0).then(|| 100.0 * below / n)
}

#[cfg(test)]
mod tests {
    use super::percentile;

    #[test]
    fn a_rank_is_counted_wrong() {
        assert_eq!(percentile(2.0, [1.0, 2.0, 3.0].into_iter()), Some(50.0));
        assert_eq!(percentile(0.0, [1.0, 2.0].into_iter()), Some(0.0));
        assert_eq!(percentile(9.0, [1.0, 2.0].into_iter()), Some(100.0));
        assert_eq!(percentile(9.0, [].into_iter()), None);
    }
}
