//! Means of runs with other seeds, and how sure they are.

pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Half of the width of the 95 % interval of the mean, by Student's t; none of less than two values.
pub fn half_width(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    let degrees = values.len() - 1;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    let deviation = (squares / degrees as f64).sqrt();
    (degrees > 0).then(|| quantile(degrees) * deviation / (values.len() as f64).sqrt())
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

    #[test]
    fn an_interval_is_that_of_the_textbook() {
        // Mean 10, deviation 2 of five values: 2.776 * 2 / sqrt(5).
        let values = [8.0, 9.0, 9.0, 11.0, 13.0];
        assert_eq!(mean(&values), Some(10.0));
        assert!((half_width(&values).unwrap() - 2.483).abs() < 1e-3);
        assert_eq!(half_width(&[1.0]), None);
        assert_eq!(mean(&[]), None);
    }

    #[test]
    fn many_degrees_go_on_where_the_table_ends() {
        // The same table has 2.040 for 31, 2.000 for 60 and 1.984 for 100.
        for (degrees, wanted) in [(31, 2.040), (60, 2.000), (100, 1.984), (100_000, 1.960)] {
            assert!((quantile(degrees) - wanted).abs() < 6e-4, "{degrees}");
        }
    }
}
