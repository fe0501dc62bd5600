//! Drawn times beside closed forms. None of these forms is that of the drawing.

use super::{Distribution, normal_below};
use crate::random::Random;

const COUNT: usize = 200_000;

/// Sorted, s.
fn drawn(distribution: &Distribution) -> Vec<f64> {
    let mut random = Random::new(7);
    let mut times: Vec<f64> =
        (0..COUNT).map(|_| distribution.time_ms(random.fraction()) as f64 / 1000.0).collect();
    times.sort_by(f64::total_cmp);
    times
}

/// Mean and standard deviation, within four of the deviations that a mean and a variance of so many numbers have; and
/// the share below each of some times, by a formula of its own, within four deviations too.
#[track_caller]
fn are(distribution: &Distribution, mean: f64, deviation: f64, below: impl Fn(f64) -> f64) {
    let times = drawn(distribution);
    let count = COUNT as f64;
    let found = times.iter().sum::<f64>() / count;
    assert!((found - mean).abs() < 4.0 * deviation / count.sqrt(), "mean {found}, {mean} expected");
    let moment = |power: i32| times.iter().map(|time| (time - found).powi(power)).sum::<f64>() / count;
    let (variance, fourth) = (moment(2), moment(4));
    let spread = ((fourth - variance * variance) / count).sqrt();
    assert!((variance - deviation * deviation).abs() < 4.0 * spread, "deviation {}", variance.sqrt());
    for part in 1..20 {
        // In the middle between two whole milliseconds, where rounding has no effect.
        let time = (times[COUNT * part / 20] * 1000.0).floor() / 1000.0 + 0.0005;
        let (share, expected) = (times.partition_point(|other| *other < time) as f64 / count, below(time));
        let noise = 4.0 * (expected * (1.0 - expected) / count).sqrt();
        assert!((share - expected).abs() < noise, "{share} below {time}, {expected} expected");
    }
}

#[test]
fn uniform_times() {
    let width = 15.0_f64;
    let times = Distribution::Uniform { shortest: 85_000.0, longest: 100_000.0 };
    are(&times, 92.5, width / 12.0_f64.sqrt(), |time| (time - 85.0) / width);
}

/// Mean of a triangle: a third of the sum. Its variance: (a2 + b2 + c2 - ab - ac - bc) / 18.
#[test]
fn triangular_times() {
    let (a, b, c) = (85.0_f64, 90.0, 100.0);
    let variance = (a * a + b * b + c * c - a * b - a * c - b * c) / 18.0;
    let times = Distribution::Triangular { shortest: 85_000.0, likeliest: 90_000.0, longest: 100_000.0 };
    are(&times, (a + b + c) / 3.0, variance.sqrt(), |time| match time < b {
        true => (time - a) * (time - a) / ((c - a) * (b - a)),
        false => 1.0 - (c - time) * (c - time) / ((c - a) * (c - b)),
    });
}

/// The density of the normal distribution, summed by Simpson's rule from the lower limit.
fn normal_share(mean: f64, deviation: f64, from: f64, to: f64) -> f64 {
    let density = |time: f64| {
        (-((time - mean) / deviation).powi(2) / 2.0).exp() / (deviation * (2.0 * std::f64::consts::PI).sqrt())
    };
    let steps = 2000;
    let step = (to - from) / f64::from(steps);
    let weight = |i: i32| if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=steps).map(|i| weight(i) * density(from + f64::from(i) * step)).sum::<f64>() * step / 3.0
}

#[test]
fn normal_times() {
    let far = [1.0, 1e9];
    let times = Distribution::Normal { mean: 90_000.0, deviation: 2_000.0, within: far };
    are(&times, 90.0, 2.0, |time| normal_share(90.0, 2.0, 70.0, time));
    // Cut at one deviation on the left and two on the right. With f the density and F the share below, the mean is off
    // by (f(-1) - f(2)) / (F(2) - F(-1)) deviations; the variance is 1 + (-f(-1) - 2 f(2)) / (F(2) - F(-1)) less the
    // square of that.
    let times = Distribution::Normal { mean: 90_000.0, deviation: 2_000.0, within: [88_000.0, 94_000.0] };
    let density = |x: f64| (-x * x / 2.0).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let all = normal_share(0.0, 1.0, -1.0, 2.0);
    let off = (density(-1.0) - density(2.0)) / all;
    let variance = 1.0 + (-density(-1.0) - 2.0 * density(2.0)) / all - off * off;
    are(&times, 90.0 + 2.0 * off, 2.0 * variance.sqrt(), |time| normal_share(90.0, 2.0, 88.0, time) / all);
}

#[test]
fn exponential_times() {
    let times = Distribution::Exponential { mean: 20_000.0, within: [1.0, 1e9] };
    are(&times, 20.001, 20.0, |time| 1.0 - (-(time - 0.001) / 20.0).exp());
    // Cut at 5 s, which moves it, and at 45 s, two means later: the mean is 1 - 2 e^-2 / (1 - e^-2) means after 5 s,
    // the mean of the squares 2 - (4 + 4) e^-2 / (1 - e^-2).
    let times = Distribution::Exponential { mean: 20_000.0, within: [5_000.0, 45_000.0] };
    let rest = (-2.0_f64).exp();
    let off = 1.0 - 2.0 * rest / (1.0 - rest);
    let squares = 2.0 - 8.0 * rest / (1.0 - rest);
    let deviation = 20.0 * (squares - off * off).sqrt();
    are(&times, 5.0 + 20.0 * off, deviation, |time| (1.0 - (-(time - 5.0) / 20.0).exp()) / (1.0 - rest));
}

#[test]
fn the_tails_of_the_normal_distribution() {
    // Abramowitz, Stegun, Handbook of Mathematical Functions, table 26.1.
    for (x, below) in [(0.0, 0.5), (1.0, 0.841_344_746_068_54), (2.0, 0.977_249_868_051_82)] {
        assert!((normal_below(x) - below).abs() < 1e-14, "{x}");
        assert!((normal_below(-x) - (1.0 - below)).abs() < 1e-14, "{x}");
    }
}

/// No number that is drawn gives a time outside the limits, and none panics.
#[test]
fn the_least_and_the_greatest_number() {
    let within = [88_000.0, 94_000.0];
    let all = [
        Distribution::Uniform { shortest: within[0], longest: within[1] },
        Distribution::Triangular { shortest: within[0], likeliest: within[0], longest: within[1] },
        Distribution::Normal { mean: within[0], deviation: 1.0, within },
        Distribution::Normal { mean: 90_000.0, deviation: 1e9, within },
        Distribution::Exponential { mean: 1.0, within },
        Distribution::Exponential { mean: 1e9, within },
    ];
    for distribution in all {
        for drawn in [0.0, f64::EPSILON / 4.0, 0.5, 1.0 - f64::EPSILON / 2.0] {
            assert!((88_000..=94_000).contains(&distribution.time_ms(drawn)), "{distribution:?} {drawn}");
        }
        assert_eq!(distribution.shortest_ms(), 88_000);
    }
}
