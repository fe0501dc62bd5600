//! The warm-up of a run: orders that say how the line starts and not how it continues.

use std::fmt;

/// How many of the first orders are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WarmUp {
    /// By MSER-5.
    Auto,
    Orders(u32),
    /// Those made until then, in seconds from the start of the run.
    Seconds(f64),
}

/// Observations of a batch: the 5 of MSER-5.
const BATCH: usize = 5;

impl WarmUp {
    /// `auto`, `20orders` or `600s`.
    pub fn parse(text: &str) -> Option<Self> {
        let is_number = |text: &&str| text.starts_with(|c: char| c.is_ascii_digit());
        if text == "auto" {
            return Some(Self::Auto);
        }
        if let Some(orders) = text.strip_suffix("orders").filter(is_number) {
            return Some(Self::Orders(orders.parse().ok()?));
        }
        let seconds = text.strip_suffix('s').filter(is_number)?;
        seconds.parse().ok().filter(|s: &f64| s.is_finite()).map(Self::Seconds)
    }

    /// How many of the first orders are cut, of those made at these times in seconds, in their order.
    pub fn cut(self, made: &[f64]) -> usize {
        match self {
            Self::Auto => BATCH * truncation(&batch_means(made)),
            Self::Orders(orders) => made.len().min(orders as usize),
            Self::Seconds(seconds) => made.partition_point(|at| *at <= seconds),
        }
    }
}

impl fmt::Display for WarmUp {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Orders(orders) => write!(f, "{orders}orders"),
            Self::Seconds(seconds) => write!(f, "{seconds}s"),
        }
    }
}

/// Mean of the times between the orders after the first `cut`, in seconds; `None` if no order is left.
pub fn seconds_per_order(made: &[f64], cut: usize) -> Option<f64> {
    let left = made.len().checked_sub(cut).filter(|left| *left > 0)?;
    Some((made[made.len() - 1] - before(made, cut)) / left as f64)
}

/// When the order before this one was made; the first is counted from the start of the run.
fn before(made: &[f64], order: usize) -> f64 {
    order.checked_sub(1).map_or(0.0, |last| made[last])
}

/// Means of five times between orders, one batch behind the other; an incomplete last batch is left out.
fn batch_means(made: &[f64]) -> Vec<f64> {
    let batches = made.len() / BATCH;
    (0..batches)
        .map(|batch| (made[(batch + 1) * BATCH - 1] - before(made, batch * BATCH)) / BATCH as f64)
        .collect()
}

/// How many of the first means to cut: that number which makes the marginal standard error of the rest least, the
/// smallest of several. White, An effective truncation heuristic for bias reduction in simulation output, Simulation
/// 69 (1997); batches of five and the search in the first half only: White, Cobb and Spratt, A comparison of five
/// steady-state truncation heuristics for simulation, Winter Simulation Conference (2000).
fn truncation(means: &[f64]) -> usize {
    let error = |cut: usize| {
        let rest = &means[cut..];
        let mean = rest.iter().sum::<f64>() / rest.len() as f64;
        let squares: f64 = rest.iter().map(|value| (value - mean) * (value - mean)).sum();
        squares / (rest.len() * rest.len()) as f64
    };
    // The standard error of one mean is not known.
    let cuts = (0..=means.len() / 2).filter(|cut| *cut + 2 <= means.len());
    let errors = cuts.map(|cut| (error(cut), cut));
    errors.reduce(|least, next| if next.0 < least.0 { next } else { least }).map_or(0, |(_, cut)| cut)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[round(100 + 150*0.7**i + random.gauss(0, 9)) for i in range(58)]` with Python's `random.seed(11)`.
    const TIMES: [u32; 58] = [
        239, 208, 182, 147, 124, 125, 122, 122, 98, 94, 111, 107, 116, 110, 100, 98, 124, 98, 93, 90, 101,
        101, 97, 99, 102, 106, 110, 102, 84, 106, 87, 98, 87, 100, 93, 102, 130, 100, 108, 88, 97, 106, 99,
        103, 101, 91, 105, 93, 117, 95, 106, 100, 109, 95, 109, 99, 111, 106,
    ];

    fn made(times: impl IntoIterator<Item = u32>) -> Vec<f64> {
        let mut now = 0.0;
        let add = |time| {
            now += f64::from(time);
            now
        };
        times.into_iter().map(add).collect()
    }

    /// The values are those of this program in Python, for `x` the times between orders:
    ///
    /// ```python
    /// def mser5(x):
    ///     z = [sum(x[5*j:5*j+5])/5 for j in range(len(x)//5)]
    ///     def error(d): r = z[d:]; m = sum(r)/len(r); return sum((a-m)**2 for a in r)/len(r)**2
    ///     return 5*min(range(len(z)//2+1), key=error)
    /// d = mser5(x); print(d, sum(x[d:])/len(x[d:]), sum(x)/len(x))  # 15 101.06976744186046 109.5
    /// ```
    #[test]
    fn the_least_marginal_standard_error_is_that_of_an_independent_program() {
        let made = made(TIMES);
        assert_eq!(WarmUp::Auto.cut(&made), 15);
        let mean = |cut| seconds_per_order(&made, cut).expect("orders are left");
        assert!((mean(15) - 101.069_767_441_860_46).abs() < 1e-9);
        assert!((mean(0) - 109.5).abs() < 1e-9);
    }

    #[test]
    fn a_steady_line_keeps_all_and_a_falling_one_half() {
        let cut = |times: &[u32]| WarmUp::Auto.cut(&made(times.iter().copied()));
        assert_eq!(cut(&[100; 20]), 0);
        // The same program says 20 for `range(100, 60, -1)`.
        assert_eq!(cut(&(61..=100).rev().collect::<Vec<u32>>()), 20);
        // Two batches at least are left.
        assert_eq!(cut(&[900, 10, 10, 10, 10, 10, 10, 10, 10]), 0);
        assert_eq!(cut(&[900, 10, 10, 10, 10, 10, 10, 10, 10, 10]), 0);
        assert_eq!(cut(&[[900; 5], [10; 5], [10; 5]].concat()), 5);
        assert_eq!(cut(&[]), 0);
    }

    #[test]
    fn orders_and_seconds_are_cut_as_they_are_written() {
        let made = made([10, 20, 30]);
        let cut = |text: &str| WarmUp::parse(text).map(|warm_up| warm_up.cut(&made));
        assert_eq!(cut("0orders"), Some(0));
        assert_eq!(cut("2orders"), Some(2));
        assert_eq!(cut("7orders"), Some(3));
        assert_eq!(cut("29.9s"), Some(1));
        assert_eq!(cut("30s"), Some(2));
        assert_eq!(seconds_per_order(&made, 2), Some(30.0));
        assert_eq!(seconds_per_order(&made, 3), None);
        for text in
            ["", "s", "orders", "20", "-1orders", "+1s", "infs", "NaNs", "1e400s", "1.5orders", "Auto"]
        {
            assert_eq!(WarmUp::parse(text), None, "{text}");
        }
        for text in ["auto", "20orders", "600s", "0.5s"] {
            assert_eq!(WarmUp::parse(text).map(|warm_up| warm_up.to_string()).as_deref(), Some(text));
        }
    }
}
