//! When the replications of a point are enough.

use super::interval::Sample;

/// Half of the width of the 95 % interval of the seconds per order, as a fraction of their mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision(f64);

/// Runs before the first look: fewer say too little about how far runs differ.
pub const FEWEST: usize = 5;
/// Runs of a point where `--replications` does not say how many at most.
pub const MOST: u32 = 100;

impl Precision {
    /// Such as `2%` or `0.5%`: more than nothing, less than all.
    pub fn parse(text: &str) -> Option<Self> {
        let percent: f64 = text.strip_suffix('%')?.trim_end().parse().ok()?;
        (percent > 0.0 && percent < 100.0).then_some(Self(percent / 100.0))
    }

    /// The sequential rule of Chow and Robbins, On the asymptotic theory of fixed-width sequential confidence intervals
    /// for the mean, Annals of Mathematical Statistics 36 (1965), for a relative width: Law, Simulation Modeling and
    /// Analysis, section 9.4.1. The sample is checked after each run, in the order of the replications.
    pub fn is_reached(self, seconds_per_order: &Sample) -> bool {
        let figures = seconds_per_order.half_width().zip(seconds_per_order.mean());
        seconds_per_order.count >= FEWEST && figures.is_some_and(|(half, mean)| half <= self.0 * mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_precision_is_a_percentage() {
        assert_eq!(Precision::parse("2%"), Some(Precision(0.02)));
        assert_eq!(Precision::parse("0.5%"), Some(Precision(0.005)));
        for text in ["", "%", "2", "0%", "-1%", "100%", "NaN%", "inf%", "two%"] {
            assert_eq!(Precision::parse(text), None, "{text}");
        }
    }

    #[test]
    fn it_is_reached_with_the_run_that_the_rule_says() {
        // By Python's `statistics`, t[n] * stdev(v[:n]) / sqrt(n) / mean(v[:n]) with t of a printed table is 0.0352,
        // 0.0238, 0.0205 and 0.0165 for the first 4, 5, 6 and 7 values.
        let values = [99.0, 101.0, 103.0, 98.0, 100.0, 102.5, 100.5];
        let stop = |percent: &str| {
            let precision = Precision::parse(percent).expect("a percentage");
            let mut sample = Sample::default();
            values.iter().position(|value| {
                sample.take(*value);
                precision.is_reached(&sample)
            })
        };
        assert_eq!(stop("50%"), Some(4), "never before the fifth");
        assert_eq!(stop("2.4%"), Some(4));
        assert_eq!(stop("2.1%"), Some(5));
        assert_eq!(stop("2%"), Some(6));
        assert_eq!(stop("1%"), None);
    }
}
