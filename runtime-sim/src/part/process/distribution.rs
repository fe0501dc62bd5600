//! Times of a process: always the same, or drawn.

use crate::part::Settings;

/// A time is drawn by the inverse of the distribution function, so that a number drawn gives a longer time in a
/// distribution of longer times. Milliseconds.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    Fixed(u64),
    Uniform {
        shortest: f64,
        longest: f64,
    },
    Triangular {
        shortest: f64,
        likeliest: f64,
        longest: f64,
    },
    /// Without the times that are not within its limits.
    Normal {
        mean: f64,
        deviation: f64,
        within: [f64; 2],
    },
    /// The same.
    Exponential {
        mean: f64,
        within: [f64; 2],
    },
}

/// No process takes less or more, ms.
const LIMITS: [f64; 2] = [1.0, 1e9];

/// Steps by which an interval of doubles is halved until nothing is left of it.
const HALVINGS: usize = 80;

/// The settings of one kind, ms.
pub struct Times {
    pub time: Option<u64>,
    pub shortest: Option<u64>,
    pub longest: Option<u64>,
    pub deviation: Option<u64>,
}

/// The word of a distribution and the settings of times that it needs and may have.
const DISTRIBUTIONS: [(&str, &[&str], &[&str]); 5] = [
    ("fixed", &["time"], &[]),
    ("triangular", &["time"], &["shortest", "longest"]),
    ("uniform", &["shortest", "longest"], &[]),
    ("normal", &["time", "deviation"], &["shortest", "longest"]),
    ("exponential", &["time"], &["shortest", "longest"]),
];

/// The settings that are times.
pub const TIMES: [&str; 4] = ["time", "shortest", "longest", "deviation"];

impl Distribution {
    /// The word of the setting, or the one without it; an error if times are missing or have no meaning for it.
    pub fn word(settings: &Settings) -> Result<&'static str, String> {
        let word = match settings.has("distribution") {
            true => settings.word("distribution")?,
            false if settings.has("shortest") || settings.has("longest") => "triangular",
            false => "fixed",
        };
        let known = DISTRIBUTIONS.iter().find(|(name, ..)| *name == word);
        let Some((word, needed, possible)) = known else {
            let names = DISTRIBUTIONS.map(|(name, ..)| name).join(", ");
            return Err(format!("there is no distribution `{word}`: distributions are {names}"));
        };
        if let Some(missing) = needed.iter().find(|name| !settings.has(name)) {
            return Err(format!("a {word} time needs the setting {missing}"));
        }
        let foreign = TIMES
            .iter()
            .find(|name| settings.has(name) && !needed.contains(name) && !possible.contains(name));
        match foreign {
            Some(foreign) => Err(format!("a {word} time has no {foreign}")),
            None => Ok(word),
        }
    }

    /// `word` is one of [`Self::word`], whose times are all there.
    pub fn new(word: &str, times: &Times) -> Result<Self, String> {
        let given = |time: Option<u64>| time.map(|ms| ms as f64);
        let time = given(times.time);
        let within = [given(times.shortest).unwrap_or(LIMITS[0]), given(times.longest).unwrap_or(LIMITS[1])];
        let [shortest, longest] = match word {
            // A time alone is the shortest and the longest, too.
            "fixed" | "triangular" => [given(times.shortest).or(time), given(times.longest).or(time)],
            _ => within.map(Some),
        }
        .map(Option::unwrap_or_default);
        let middle = time.unwrap_or(shortest);
        if shortest < LIMITS[0] || shortest > middle || middle > longest {
            return Err("its times are not in order: shortest, time, longest".into());
        }
        Ok(match word {
            "fixed" => Self::Fixed(times.time.unwrap_or_default()),
            "triangular" => Self::Triangular { shortest, likeliest: middle, longest },
            "uniform" => Self::Uniform { shortest, longest },
            "exponential" => Self::Exponential { mean: middle, within },
            _ => match given(times.deviation).filter(|deviation| *deviation > 0.0) {
                Some(deviation) => Self::Normal { mean: middle, deviation, within },
                None => return Err("its deviation has to be over 0".into()),
            },
        })
    }

    /// No time is shorter, ms.
    pub fn shortest_ms(&self) -> u64 {
        match self {
            Self::Fixed(time) => *time,
            Self::Uniform { shortest, .. } | Self::Triangular { shortest, .. } => *shortest as u64,
            Self::Normal { within, .. } | Self::Exponential { within, .. } => within[0] as u64,
        }
    }

    /// Whether two cycles may take different times.
    pub fn is_drawn(&self) -> bool {
        match self {
            Self::Fixed(_) => false,
            Self::Uniform { shortest, longest } | Self::Triangular { shortest, longest, .. } => {
                shortest < longest
            }
            Self::Normal { within, .. } | Self::Exponential { within, .. } => within[0] < within[1],
        }
    }

    /// The time for a number between 0 and 1, of which a share `drawn` of all times is shorter; whole milliseconds.
    pub fn time_ms(&self, drawn: f64) -> u64 {
        let time = match *self {
            Self::Fixed(time) => time as f64,
            Self::Uniform { shortest, longest } => shortest + drawn * (longest - shortest),
            Self::Triangular { shortest, likeliest, longest } => {
                let (rises, all) = (likeliest - shortest, longest - shortest);
                match drawn * all < rises {
                    true => shortest + (drawn * rises * all).sqrt(),
                    false => longest - ((1.0 - drawn) * (longest - likeliest) * all).sqrt(),
                }
            }
            Self::Normal { mean, deviation, within } => {
                let below = |time: f64| normal_below((time - mean) / deviation);
                let [first, last] = within.map(below);
                let wanted = first + drawn * (last - first);
                halved(within, |time| below(time) < wanted)
            }
            Self::Exponential { mean, within } => {
                let above = within.map(|time| libm::exp(-(time - within[0]) / mean));
                within[0] - mean * libm::log(1.0 - drawn * (above[0] - above[1]))
            }
        };
        libm::round(time) as u64
    }
}

/// Share of a normal distribution with the mean 0 and the deviation 1 that is below a number.
fn normal_below(number: f64) -> f64 {
    libm::erfc(-number / std::f64::consts::SQRT_2) / 2.0
}

/// Where `is_below` changes from true to false.
fn halved([mut low, mut high]: [f64; 2], is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = low + (high - low) / 2.0;
        match is_below(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    high
}

#[cfg(test)]
mod tests;
