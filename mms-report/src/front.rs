//! The Pareto front.

/// The positions of the points (cost, error) that no other point beats in both, from cheap to accurate; the first of equal
/// points.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut positions: Vec<usize> = (0..points.len()).collect();
    let key = |at: usize| points[at];
    positions.sort_by(|&a, &b| key(a).0.total_cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
    let mut least = f64::INFINITY;
    positions.retain(|&at| {
        let better = key(at).1 < least;
        least = least.min(key(at).1);
        better
    });
    positions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_on_the_front_is_beaten_and_all_else_is() {
        let points = [
            (3.0, 1.0),
            (1.0, 9.0),
            (2.0, 4.0),
            (2.0, 5.0),
            (4.0, 1.0),
            (3.0, 1.0),
            (5.0, f64::NAN),
        ];
        assert_eq!(front(&points), [1, 2, 0]);
        assert_eq!(front(&[]), [] as [usize; 0]);
    }
}
