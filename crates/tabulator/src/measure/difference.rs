//! Comparison of two tables.

use lookup::{Content, Slice};

/// Descriptions of all differences of `first` and `second`, one line each, except creation time and software version.
pub fn differences<'a>(first: &'a Content, second: &'a Content) -> Vec<String> {
    let mut found = Vec::new();
    for (name, same) in [
        ("grid", first.origin.grid == second.origin.grid),
        ("r", first.r == second.r),
        ("z", first.z == second.z),
        ("cell_width", first.cell_width == second.cell_width),
        (
            "stencil_points",
            first.stencil_points == second.stencil_points,
        ),
        ("between", first.between == second.between),
        ("pulse_length", first.pulse_lengths == second.pulse_lengths),
    ] {
        if !same {
            found.push(format!("{name} differs"));
        }
    }
    let comparable = first.r.len() == second.r.len() && first.z.len() == second.z.len();
    let only = |slice: &Slice, place| {
        let ratio = slice.poisson_ratio;
        format!("nu = {ratio} is in the {place} table only")
    };
    let beside = |slices: &'a [Slice], slice: &Slice| {
        let mut slices = slices.iter();
        slices.find(|other| other.poisson_ratio == slice.poisson_ratio)
    };
    for slice in &first.slices {
        match beside(&second.slices, slice) {
            Some(other) if comparable && other.cells == slice.cells => {
                values(slice, other, &mut found);
            }
            Some(_) => found.push("time differs".to_owned()),
            None => found.push(only(slice, "first")),
        }
    }
    for slice in &second.slices {
        if beside(&first.slices, slice).is_none() {
            found.push(only(slice, "second"));
        }
    }
    found
}

fn values<'a>(a: &'a Slice, b: &'a Slice, found: &mut Vec<String>) {
    let lists = |slice: &'a Slice| slice.lists().into_iter().chain(slice.verification.lists());
    for ((dataset, first), (_, second)) in lists(a).zip(lists(b)) {
        let pairs = first.iter().zip(second).filter(|(x, y)| x != y);
        let (count, largest) = pairs.fold((0, 0.0_f64), |(count, most), (x, y)| {
            (count + 1, most.max((f64::from(*x) - f64::from(*y)).abs()))
        });
        if count > 0 {
            found.push(format!(
                "nu = {}: {count} values of {dataset} differ, by up to {largest:.1e}",
                a.poisson_ratio
            ));
        }
    }
}
