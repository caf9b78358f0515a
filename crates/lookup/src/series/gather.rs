//! Sum over the nodes of a stencil, the most expensive part of a lookup.

use crate::content::FIELDS;
use crate::series::stencil::Stencil;
use halfspace::{Field, Six};
use pulp::{Arch, Simd, WithSimd};

/// Number of rows that are added at a time.
const ROWS_AT_A_TIME: usize = 8;

/// The nodes of a patch.
pub(crate) struct PatchNodes {
    /// Complete groups of nodes, each node with its weights for fields that are even and odd across r = 0.
    groups: Vec<([usize; ROWS_AT_A_TIME], [[f64; ROWS_AT_A_TIME]; 2])>,
    /// Factor that makes the interpolation of a constant exact.
    scale: f64,
}

impl PatchNodes {
    /// The nodes of a patch `across` by `down` of a grid with `depths` depths; nodes of zero weight are skipped.
    pub(crate) fn new(across: &Stencil, down: &Stencil, depths: usize) -> Self {
        let most = across.nodes().len() * down.nodes().len();
        let mut groups: Vec<([usize; ROWS_AT_A_TIME], [[f64; ROWS_AT_A_TIME]; 2])> =
            Vec::with_capacity(most.div_ceil(ROWS_AT_A_TIME));
        let (mut slot, mut rounded) = (ROWS_AT_A_TIME, 0.0);
        for ((&i, &even), &odd) in across.nodes().iter().zip(across.even()).zip(across.odd()) {
            for (&k, &own) in down.nodes().iter().zip(down.even()) {
                let (node, weights) = (i * depths + k, [even * own, odd * own].map(exact_weight));
                if weights == [0.0; 2] {
                    continue;
                }
                if slot == ROWS_AT_A_TIME {
                    // unused places contain the first node with zero weight
                    groups.push(([node; ROWS_AT_A_TIME], [[0.0; ROWS_AT_A_TIME]; 2]));
                    slot = 0;
                }
                if let Some((places, [even, odd])) = groups.last_mut() {
                    places[slot] = node;
                    [even[slot], odd[slot]] = weights;
                }
                slot += 1;
                rounded += weights[0];
            }
        }
        Self {
            groups,
            scale: 1.0 / rounded,
        }
    }

    /// Weighted sums over slices of the first `used` of `length` numbers of each field, in vector registers; the result
    /// is bit-identical on every machine.
    pub(crate) fn sums(&self, slices: &[(&[f32], f64)], length: usize, used: usize) -> Vec<Six> {
        if used == 0 {
            return Vec::new();
        }
        let work = GatherSum(self, slices, [length, used]);
        // longer registers are not faster at conversion
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return Simd::vectorize(simd, work);
        }
        Arch::new().dispatch(work)
    }
}

/// The weight rounded to 29 of 53 bits, so that its product with a number in single precision is exact.
fn exact_weight(weight: f64) -> f64 {
    const HALF: u64 = 1 << (f64::MANTISSA_DIGITS - 29 - 1);
    f64::from_bits((weight.to_bits() + HALF) & !(2 * HALF - 1))
}

struct GatherSum<'a>(&'a PatchNodes, &'a [(&'a [f32], f64)], [usize; 2]);

impl WithSimd for GatherSum<'_> {
    type Output = Vec<Six>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<Six> {
        // the product is exact, see `exact_weight`, so that a fused operation changes no bit of the sum
        let add = |weight: f64, value: f32, sum: f64| {
            if S::IS_SCALAR || cfg!(target_family = "wasm") {
                weight * f64::from(value) + sum
            } else {
                weight.mul_add(f64::from(value), sum)
            }
        };
        let Self(nodes, slices, [length, used]) = self;
        let is_even = (nodes.groups.iter()).all(|(_, [even, odd])| even == odd);
        let mut found = vec![Six::default(); used];
        for &(values, weight) in slices {
            // a register that spans two cache lines takes twice as long
            let mut room = vec![0.0; FIELDS * used + ROWS_AT_A_TIME];
            let start = room.as_ptr().align_offset(64).min(ROWS_AT_A_TIME);
            let sums = &mut room[start..][..FIELDS * used];
            let mut field = 0;
            while field < FIELDS {
                // adjacent fields with the same weights are added in one run
                let same = |&end: &usize| is_even || ODD[end] == ODD[field];
                let others = (field + 1..FIELDS).take_while(same).count();
                let fields = if used == length { 1 + others } else { 1 };
                let count = fields * used;
                let sums = &mut sums[field * used..][..count];
                for (places, weights) in &nodes.groups {
                    let row = |node| &values[(node * FIELDS + field) * length..][..count];
                    let (rows, own) = (places.map(row), weights[usize::from(ODD[field])]);
                    for (t, sum) in sums.iter_mut().enumerate() {
                        let mut total = *sum;
                        for k in 0..ROWS_AT_A_TIME {
                            total = add(own[k], rows[k][t], total);
                        }
                        *sum = total;
                    }
                }
                field += fields;
            }
            let weight = weight * nodes.scale;
            let fields: [&[f64]; FIELDS] = std::array::from_fn(|f| &sums[f * used..][..used]);
            for (t, found) in found.iter_mut().enumerate() {
                for (found, sums) in found.iter_mut().zip(fields) {
                    *found += weight * sums[t];
                }
            }
        }
        found
    }
}

/// Whether each field is odd across r = 0, in the order of [`halfspace::FIELDS`].
const ODD: [bool; FIELDS] = {
    let mut odd = [false; FIELDS];
    let mut field = 0;
    while field < FIELDS {
        odd[field] = Field::is_odd_in_r(halfspace::FIELDS[field]);
        field += 1;
    }
    odd
};

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: usize = 11;
    const SIDE: usize = 9;

    fn values(seed: f64) -> Vec<f32> {
        let one = |i: usize| (seed * (1.0 + i as f64)).sin() as f32;
        (0..SIDE * SIDE * FIELDS * LENGTH).map(one).collect()
    }

    fn axis() -> Vec<f64> {
        (0..SIDE).map(|i| 0.1 * (i * i + i) as f64).collect()
    }

    #[test]
    fn sums_are_those_of_the_weights_with_the_same_bits_fused_or_not() {
        let (axis, lists) = (axis(), [values(0.37), values(0.11)]);
        let slices = [(&lists[0][..], 1.3), (&lists[1][..], -0.3)];
        // near the axis odd fields have other weights, and groups are not full
        for (mesh, x) in [(0, 0.03), (4, 2.1)] {
            let across = Stencil::mirrored(&axis, mesh, x, 8);
            let down = Stencil::one_sided(&axis, 3, 1.7, 8);
            let nodes = PatchNodes::new(&across, &down, SIDE);
            for used in [3, LENGTH] {
                let found = nodes.sums(&slices, LENGTH, used);
                let work = GatherSum(&nodes, &slices, [LENGTH, used]);
                assert_eq!(found, Simd::vectorize(pulp::Scalar::new(), work));
                for (t, six) in found.iter().enumerate() {
                    for (field, &sum) in six.iter().enumerate() {
                        let mut exact = 0.0;
                        for (a, &i) in across.nodes().iter().enumerate() {
                            for (b, &k) in down.nodes().iter().enumerate() {
                                let weights = if ODD[field] {
                                    across.odd()
                                } else {
                                    across.even()
                                };
                                let place = ((i * SIDE + k) * FIELDS + field) * LENGTH + t;
                                for (values, weight) in slices {
                                    let own = weight * weights[a] * down.even()[b];
                                    exact += own * f64::from(values[place]);
                                }
                            }
                        }
                        assert!((sum - exact).abs() < 1e-8, "{sum} {exact}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_constant_stays_what_it_is() {
        let (axis, ones) = (axis(), vec![1.0; SIDE * SIDE * FIELDS * LENGTH]);
        let across = Stencil::mirrored(&axis, 4, 2.3, 8);
        let down = Stencil::one_sided(&axis, 0, 0.1, 8);
        let found = PatchNodes::new(&across, &down, SIDE).sums(&[(&ones, 1.0)], LENGTH, LENGTH);
        let is_one = |x: &f64| (x - 1.0).abs() < 1e-14;
        assert!(found.iter().flatten().all(is_one), "{found:?}");
    }
}
