//! A running sum of six fields with an error estimate.

use crate::field::{Point, Sense, Six};
use crate::integral::panels::PanelNodes;
use crate::integral::setting::Setting;
use crate::integral::spectrum::Wave;
use crate::numeric::lanes::{Lanes, WIDTH, total};
use pulp::{Simd, WithSimd};

/// Six fields and the squares of their likely errors, in blocks that are summed at the end.
///
/// The errors of panels and of rounding have random signs, so that their squares add up.
#[derive(Debug, Default)]
pub(crate) struct Sum {
    pub(crate) values: [[f64; WIDTH]; 6],
    pub(crate) squares: [[f64; WIDTH]; 6],
}

impl Sum {
    pub(crate) fn value(&self) -> Six {
        self.values.map(|block| total(&block))
    }

    /// Likely error of each field.
    pub(crate) fn error(&self) -> Six {
        self.squares.map(|block| total(&block).sqrt())
    }

    /// Adds `weight` times `term`, with the relative errors of displacements and stresses.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, [d, s]: [f64; 2], term: Six) {
        let relative = [d, d, s, s, s, s];
        for (f, relative) in relative.into_iter().enumerate() {
            let x = weight * term[f];
            self.values[f][0] += x;
            self.squares[f][0] += (relative * x) * (relative * x);
        }
    }
}

/// The nodes of one panel, which are added to a sum several at a time; a wave has one sense below slowness one, and
/// both above.
pub(crate) struct QuadraturePanel<'a, const N: i32> {
    pub(crate) setting: &'a Setting,
    pub(crate) at: Point,
    pub(crate) wave: Wave,
    pub(crate) sense: Option<Sense>,
    pub(crate) nodes: &'a PanelNodes,
    pub(crate) sum: &'a mut Sum,
}

impl<const N: i32> WithSimd for QuadraturePanel<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { setting, wave, .. } = self;
        let (nodes, sum) = (self.nodes, self.sum);
        let at = (self.at, setting.deep_digits);
        let [rule, weights] = nodes
            .rule
            .in_registers(S::F64_LANES)
            .map(|list| Lanes::registers(simd, list));
        for (i, (node, weight)) in rule.zip(weights).enumerate() {
            let (place, weight, error) = nodes.at(node, weight);
            let (jacobian, term) = match self.sense {
                Some(sense) => setting.fast_term::<N, _>(at, (wave, sense), place),
                None => setting.slow_term::<N, _>(at, wave, place),
            };
            let weight = weight * jacobian;
            // index in the block
            let i = i % (WIDTH / S::F64_LANES);
            for f in 0..6 {
                let x = weight * term[f];
                let error = error[usize::from(f >= 2)] * x;
                let value = &mut S::as_mut_simd_f64s(&mut sum.values[f]).0[i];
                *value = (Lanes::of(simd, *value) + x).register;
                let square = &mut S::as_mut_simd_f64s(&mut sum.squares[f]).0[i];
                *square = (Lanes::of(simd, *square) + error * error).register;
            }
        }
    }
}
