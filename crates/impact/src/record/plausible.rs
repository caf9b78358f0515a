//! Records that hint at a slip in their units or their cut.

use crate::record::ForceRecord;

/// Longest record in s that nobody wonders at: impacts last microseconds to milliseconds.
const LONG_S: f64 = 1.0;
/// Share of the largest force at which a record may begin or end.
const SHARE: f64 = 0.05;

/// Sentences for the user, each with its numbers; none where a record is what one expects.
pub(crate) fn doubts(record: &ForceRecord) -> Vec<String> {
    let mut found = Vec::new();
    let [start_s, end_s] = record.span_s();
    let length_s = end_s - start_s;
    if length_s > LONG_S {
        found.push(format!(
            "the record lasts {length_s} s: an impact lasts microseconds to milliseconds; are its times in s?"
        ));
    }
    let largest_n = record.largest_n();
    let ends = [
        ("begins", "before it", record.force_n().first()),
        ("ends", "after it", record.force_n().last()),
    ];
    for (verb, side, force_n) in ends {
        if let Some(force_n) = force_n.filter(|force_n| force_n.abs() > SHARE * largest_n) {
            found.push(format!(
                "the record {verb} at {force_n} N, {:.0} % of its largest force, which jumps there from or to zero: what was {side} is missing, or a baseline is to be taken away",
                100.0 * force_n.abs() / largest_n
            ));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_told_with_their_numbers() {
        let of = |unit_s: f64, first_n: f64| {
            let time_s = vec![0.0, 10.0 * unit_s, 20.0 * unit_s];
            let record = ForceRecord::new(time_s, vec![first_n, 1000.0, 0.0]);
            doubts(&record.unwrap_or_else(|error| panic!("{error}")))
        };
        assert!(of(1e-6, 0.0).is_empty());
        assert!(of(1e-6, 40.0).is_empty());
        let seconds = of(1.0, 0.0);
        assert!(
            seconds.len() == 1 && seconds[0].contains("lasts 20 s"),
            "{seconds:?}"
        );
        let cut = of(1e-6, 500.0);
        assert!(
            cut.len() == 1 && cut[0].contains("begins at 500 N, 50 %"),
            "{cut:?}"
        );
    }
}
