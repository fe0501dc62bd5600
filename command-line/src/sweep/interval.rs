//! Means of runs with other seeds, and how sure they are.

/// Running figures of a sample, by Welford's recurrence (Knuth, The Art of Computer Programming 2, 4.2.2).
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    pub count: usize,
    mean: f64,
    /// Sum of the squares of what the values differ from their mean.
    squares: f64,
}

impl Sample {
    pub fn take(&mut self, value: f64) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
    }

    /// `None` without a value.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.mean)
    }

    /// Half of the width of the 95 % interval of the mean, by Student's t; none of less than two values.
    pub fn half_width(&self) -> Option<f64> {
        let degrees = self.count.checked_sub(1).filter(|degrees| *degrees > 0)?;
        let deviation = (self.squares / degrees as f64).sqrt();
        Some(quantile(degrees) * deviation / (self.count as f64).sqrt())
    }
}

/// Of the normal distribution, the quantile 0.975.
const NORMAL: f64 = 1.959_963_984_540_054;
/// Up to so many degrees of freedom the quantile is found by halving.
const HALVED: usize = 100;
/// Steps by which an interval of doubles is halved until nothing is left of it.
const HALVINGS: usize = 60;

/// The 0.975 quantile of Student's t. Formulas are those of Abramowitz and Stegun, Handbook of Mathematical Functions.
fn quantile(degrees: usize) -> f64 {
    let n = degrees as f64;
    if degrees > HALVED {
        let z = NORMAL;
        // 26.7.5
        let terms = [
            (z.powi(3) + z) / 4.0,
            (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0,
            (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0,
            (79.0 * z.powi(9) + 776.0 * z.powi(7) + 1482.0 * z.powi(5) - 1920.0 * z.powi(3) - 945.0 * z)
                / 92_160.0,
        ];
        return terms.iter().rev().fold(0.0, |sum, term| (sum + term) / n) + z;
    }
    let [mut low, mut high] = [0.0, std::f64::consts::FRAC_PI_2];
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if within(degrees, middle) < 0.95 { low = middle } else { high = middle }
    }
    n.sqrt() * low.tan()
}

/// The probability that t is at most `n.sqrt() * angle.tan()` away from 0: 26.7.3 and 26.7.4.
fn within(degrees: usize, angle: f64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let is_odd = degrees % 2 == 1;
    let mut term = if is_odd { cosine } else { 1.0 };
    let mut sum = if degrees == 1 { 0.0 } else { term };
    for next in (if is_odd { 3 } else { 2 }..degrees).step_by(2) {
        term *= cosine * cosine * (next - 1) as f64 / next as f64;
        sum += term;
    }
    if is_odd { (angle + sine * sum) * std::f64::consts::FRAC_2_PI } else { sine * sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(values: &[f64]) -> Sample {
        let mut sample = Sample::default();
        values.iter().for_each(|value| sample.take(*value));
        sample
    }

    #[test]
    fn an_interval_is_that_of_the_textbook() {
        // Mean 10, deviation 2 of five values: 2.776 * 2 / sqrt(5).
        let five = sample(&[8.0, 9.0, 9.0, 11.0, 13.0]);
        assert_eq!(five.mean(), Some(10.0));
        assert!((five.half_width().unwrap() - 2.483).abs() < 1e-3);
        assert_eq!(sample(&[1.0]).half_width(), None);
        assert_eq!((sample(&[]).mean(), sample(&[]).half_width()), (None, None));
    }

    #[test]
    fn like_values_have_no_width_and_a_far_mean_costs_no_digits() {
        assert_eq!(sample(&[0.1; 7]).half_width(), Some(0.0));
        assert_eq!(sample(&[0.1; 7]).mean(), Some(0.1));
        let far = sample(&[1e9 + 4.0, 1e9 + 7.0, 1e9 + 13.0, 1e9 + 16.0]);
        // The variance is 30: 3.18245 * sqrt(30) / 2.
        assert!((far.half_width().unwrap() - 8.7155).abs() < 1e-4);
    }

    #[test]
    fn quantiles_are_those_of_other_software() {
        // By SciPy: `scipy.stats.t.ppf(0.975, n)`.
        let known = [
            (1, 12.706_204_736_174_694),
            (2, 4.302_652_729_749_462),
            (3, 3.182_446_305_283_707_8),
            (4, 2.776_445_105_197_793_4),
            (5, 2.570_581_835_636_314_6),
            (6, 2.446_911_851_144_978_6),
            (9, 2.262_157_162_798_205),
            (10, 2.228_138_851_986_274),
            (30, 2.042_272_456_301_237_8),
            (31, 2.039_513_446_396_408),
            (60, 2.000_297_822_014_260_4),
            (99, 1.984_216_951_586_417_4),
            (100, 1.983_971_518_523_551_8),
            (101, 1.983_731_002_955_606),
            (120, 1.979_930_405_082_440_2),
            (1000, 1.962_339_080_826_408_3),
            (100_000, 1.959_987_707_534_609_5),
        ];
        for (degrees, wanted) in known {
            assert!((quantile(degrees) / wanted - 1.0).abs() < 1e-9, "{degrees}: {}", quantile(degrees));
        }
    }
}
