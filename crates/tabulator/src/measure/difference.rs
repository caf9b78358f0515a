//! How two tables differ.

use lookup::{Content, Slice};

/// The differences between two tables; equal ones give none.
#[derive(Debug, Clone, PartialEq)]
pub enum Difference {
    /// A setting or an axis is not the same.
    Setting { name: &'static str },
    /// A slice is in one table only.
    Slice {
        /// Its Poisson ratio.
        poisson_ratio: f64,
        /// Whether the first table has it; else the second.
        in_first: bool,
    },
    /// Numbers of a slice differ.
    Values {
        /// Poisson's ratio of the slice.
        poisson_ratio: f64,
        /// Name of the dataset.
        dataset: &'static str,
        /// How many numbers differ.
        count: usize,
        /// Largest absolute difference.
        largest: f64,
    },
}

/// Everything in which `first` and `second` differ, apart from creation time and software version.
#[must_use]
pub fn differences(first: &Content, second: &Content) -> Vec<Difference> {
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
            found.push(Difference::Setting { name });
        }
    }
    let comparable = first.r.len() == second.r.len() && first.z.len() == second.z.len();
    for slice in &first.slices {
        match second
            .slices
            .iter()
            .find(|other| other.poisson_ratio == slice.poisson_ratio)
        {
            Some(other) if comparable && other.cells == slice.cells => {
                values(slice, other, &mut found);
            }
            Some(_) => found.push(Difference::Setting { name: "time" }),
            None => found.push(Difference::Slice {
                poisson_ratio: slice.poisson_ratio,
                in_first: true,
            }),
        }
    }
    for slice in &second.slices {
        if !first
            .slices
            .iter()
            .any(|other| other.poisson_ratio == slice.poisson_ratio)
        {
            found.push(Difference::Slice {
                poisson_ratio: slice.poisson_ratio,
                in_first: false,
            });
        }
    }
    found
}

fn values<'a>(a: &'a Slice, b: &'a Slice, found: &mut Vec<Difference>) {
    let lists = |slice: &'a Slice| slice.lists().into_iter().chain(slice.verification.lists());
    for ((dataset, first), (_, second)) in lists(a).zip(lists(b)) {
        let pairs = first.iter().zip(second).filter(|(x, y)| x != y);
        let (count, largest) = pairs.fold((0, 0.0_f64), |(count, most), (x, y)| {
            (count + 1, most.max((f64::from(*x) - f64::from(*y)).abs()))
        });
        if count > 0 {
            found.push(Difference::Values {
                poisson_ratio: a.poisson_ratio,
                dataset,
                count,
                largest,
            });
        }
    }
}
