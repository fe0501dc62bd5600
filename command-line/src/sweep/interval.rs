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

/// The 0.975 quantile of Student's t for 1 to 30 degrees of freedom (NIST/SEMATECH e-Handbook of Statistical Methods,
/// 1.3.6.7.2).
const QUANTILES: [f64; 30] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
];
/// The same of the normal distribution.
const NORMAL: f64 = 1.959_964;

fn quantile(degrees: usize) -> f64 {
    QUANTILES.get(degrees - 1).copied().unwrap_or_else(|| {
        // Cornish-Fisher, two terms: Abramowitz and Stegun, 26.7.5.
        let (n, z) = (degrees as f64, NORMAL);
        let first = (z.powi(3) + z) / 4.0;
        let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
        z + first / n + second / (n * n)
    })
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
        // The variance is 30: 3.182 * sqrt(30) / 2.
        assert!((far.half_width().unwrap() - 8.7143).abs() < 1e-3);
    }

    #[test]
    fn many_degrees_go_on_where_the_table_ends() {
        // The same table has 2.040 for 31, 2.000 for 60 and 1.984 for 100.
        for (degrees, wanted) in [(31, 2.040), (60, 2.000), (100, 1.984), (100_000, 1.960)] {
            assert!((quantile(degrees) - wanted).abs() < 6e-4, "{degrees}");
        }
    }
}
