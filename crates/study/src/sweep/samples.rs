//! Where the samples of a drawn key lie.

use creepage_plan::hash::fnv1a;

/// How drawn keys are sampled.
///
/// A sample's value follows from the seed, the row (its `id`, or else its number), the key and the
/// number of the sample alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Samples {
    /// Samples at every point of the grid, or of every row; 0 if nothing is drawn.
    pub count: usize,
    /// Another seed gives other samples.
    pub seed: u64,
}

impl Samples {
    /// A number in (0, 1), evenly distributed: that of one `sample` of one `key` of the row `id`,
    /// which is empty in a grid.
    pub(super) fn share(self, key: &str, id: &str, sample: usize) -> f64 {
        /// Half the distance between two numbers of the generator: keeps 0 out.
        const HALF: f64 = 1.0 / (1_u64 << 54) as f64;
        let name = if id.is_empty() {
            key.to_owned()
        } else {
            format!("{key}\0{id}")
        };
        let stream = fastrand::Rng::with_seed(self.seed ^ fnv1a(name.bytes())).u64(..);
        // Generators of neighbouring seeds begin with related numbers, forks of them no more.
        let mut random = fastrand::Rng::with_seed(stream.wrapping_add(sample as u64)).fork();
        random.f64() + HALF
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two keys are drawn independently: with n samples, √n times their correlation is a standard
    /// normal number.
    #[test]
    fn samples_of_two_keys_are_independent() {
        const SAMPLES: usize = 1000;
        const PAIRS: u64 = 200;
        let draws = |seed, key| -> Vec<f64> {
            let samples = Samples { count: SAMPLES, seed };
            (0..SAMPLES).map(|k| samples.share(key, "", k) - 0.5).collect()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scores: Vec<f64> = (0..PAIRS)
            .map(|seed| {
                let (a, b) = (draws(seed, "duct.depth"), draws(seed, "friction.coefficient"));
                (SAMPLES as f64).sqrt() * dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt()
            })
            .collect();
        // By chance one of 200 is so large once in 700 times; the mean square is off by four
        // standard deviations.
        assert!(scores.iter().all(|z| z.abs() < 4.5), "{scores:?}");
        let mean_square = dot(&scores, &scores) / PAIRS as f64;
        assert!((mean_square - 1.0).abs() < 0.4, "{mean_square}");
    }
}
