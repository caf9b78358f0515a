//! When a force begins and ends.

/// When a force begins: the last time before it is not zero any more.
pub(crate) fn onset_s(time_s: &[f64], force_n: &[f64]) -> f64 {
    let first = force_n.iter().position(|&force| force != 0.0);
    first.map_or(0.0, |i| time_s[i.saturating_sub(1)])
}

/// When a force ends: the first time from which on it is zero; the last time where it is not.
pub(crate) fn end_s(time_s: &[f64], force_n: &[f64]) -> f64 {
    let last = force_n.iter().rposition(|&force| force != 0.0).unwrap_or(0);
    time_s[(last + 1).min(time_s.len() - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_begins_where_it_leaves_zero() {
        let time = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let force = [0.0, 0.0, 3.0, 1.0, 0.0, 0.0];
        assert_eq!((onset_s(&time, &force), end_s(&time, &force)), (1.0, 4.0));
        assert_eq!(onset_s(&time, &[2.0; 6]), 0.0);
        assert_eq!(end_s(&time, &[2.0; 6]), 5.0);
    }
}
