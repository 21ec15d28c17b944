//! Machine on which the figures were measured.

use serde::Serialize;

/// A machine in general words.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The processor as it names itself.
    pub processor: String,
    /// Threads it runs at once.
    pub cores: usize,
    /// Operating system and instruction set.
    pub system: String,
    /// Other load of the machine, where it was high and the system tells: times are then too long.
    pub busy: Option<String>,
}

impl Machine {
    /// This one. Where the system does not name the processor, its instruction set stands in.
    #[must_use]
    pub fn this() -> Self {
        let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            processor: model(&about).unwrap_or_else(|| std::env::consts::ARCH.into()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{}, {}", std::env::consts::OS, std::env::consts::ARCH),
            busy: busy(&std::fs::read_to_string("/proc/loadavg").unwrap_or_default()),
        }
    }
}

/// The load of the last five minutes in the text of `/proc/loadavg`, where it is more than a measurement makes by itself.
fn busy(about: &str) -> Option<String> {
    const OWN: f64 = 3.0;
    let load: f64 = about.split_whitespace().nth(1)?.parse().ok()?;
    (load > OWN).then(|| format!("{load:.1}"))
}

/// The first processor's model in the text of `/proc/cpuinfo`.
fn model(about: &str) -> Option<String> {
    let line = about.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    let words: Vec<&str> = name.split_whitespace().collect();
    (!words.is_empty()).then(|| words.join(" "))
}

#[cfg(test)]
mod tests {
    use super::{busy, model};

    #[test]
    fn the_model_is_read() {
        let about = "processor\t: 0\nmodel name\t: Some  CPU @ 2.3GHz\nmodel name\t: another\n";
        assert_eq!(model(about).as_deref(), Some("Some CPU @ 2.3GHz"));
        assert_eq!(model("processor : 0"), None);
    }

    #[test]
    fn a_load_that_is_not_our_own_is_told() {
        assert_eq!(busy("0.10 9.81 8.00 3/400 1\n").as_deref(), Some("9.8"));
        assert_eq!(busy("9.00 1.90 1.00 3/400 1\n"), None);
        assert_eq!(busy(""), None);
    }
}
