//! Fewer keys: one that lies on the line between those that stay is left out.

use crate::math::ops;
use glam::Quat;

/// Numbers of the keys that stay of so many, the first and the last among them; `is_on_line(a, b, k)`: whether key `k` lies
/// on the line from `a` to `b`.
pub(super) fn reduced(n: usize, is_on_line: impl Fn(usize, usize, usize) -> bool) -> Vec<usize> {
    let mut kept = vec![0];
    let mut start = 0;
    for end in 1..n {
        let goes_on = end + 1 < n && (start + 1..=end).all(|k| is_on_line(start, end + 1, k));
        if !goes_on {
            kept.push(end);
            start = end;
        }
    }
    kept
}

/// Along the shorter arc, as clients go between two keys.
pub(super) fn slerp(a: Quat, b: Quat, part: f32) -> Quat {
    let dot = a.dot(b);
    let (b, dot) = if dot < 0.0 { (-b, -dot) } else { (b, dot) };
    if dot > 0.9999 {
        return (a * (1.0 - part) + b * part).normalize();
    }
    let angle = ops::acos(dot.min(1.0));
    (a * ops::sin((1.0 - part) * angle) + b * ops::sin(part * angle)).normalize()
}

#[cfg(test)]
mod tests {
    use super::reduced;

    #[test]
    fn keys_on_a_line_stay_or_others_go() {
        let values = [0.0_f32, 1.0, 2.0, 3.0, 3.0, 3.0, 0.0];
        let on_line = |a: usize, b: usize, k: usize| {
            let part = (k - a) as f32 / (b - a) as f32;
            (values[a] + (values[b] - values[a]) * part - values[k]).abs() < 1e-4
        };
        assert_eq!(reduced(values.len(), on_line), [0, 3, 5, 6]);
        assert_eq!(reduced(1, on_line), [0]);
        assert_eq!(reduced(2, on_line), [0, 1]);
    }
}
