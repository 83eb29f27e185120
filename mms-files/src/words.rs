//! Durations and sizes in words.

/// A duration in seconds, with its unit.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-4 => format!("{:.0} us", s * 1e6),
        s if s < 1.0 => format!("{:.1} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}

/// A number of bytes, with its unit.
pub fn bytes(count: f64) -> String {
    let (unit, size) = match count {
        c if c < 1e6 => ("kB", 1e3),
        c if c < 1e9 => ("MB", 1e6),
        _ => ("GB", 1e9),
    };
    format!("{:.1} {unit}", count / size)
}
