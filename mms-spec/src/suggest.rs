//! Suggestions ("did you mean ...?"): the valid name that is nearest to a wrong one.

/// The longest names that are compared: the cost grows with the product of the lengths.
const MAX_LENGTH: usize = 64;

/// The candidate that `name` was most likely meant to be: one that differs by case only, or by few enough edits for its length.
/// Among equally near candidates the first is returned.
pub fn did_you_mean<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let mut best: Option<(usize, &'a str)> = None;
    for candidate in candidates {
        let Some(distance) = likely_distance(name, candidate) else { continue };
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The distance of two names, if it is small enough to be a slip. A third of the letters may differ, so names of one or two
/// letters may differ in case only.
fn likely_distance(name: &str, candidate: &str) -> Option<usize> {
    if name.len() > MAX_LENGTH || candidate.len() > MAX_LENGTH || name == candidate {
        return None;
    }
    if name.eq_ignore_ascii_case(candidate) {
        return Some(0);
    }
    let (a, b): (Vec<char>, Vec<char>) = (name.chars().collect(), candidate.chars().collect());
    let likely = a.len().max(b.len()) / 3;
    // Each additional letter is an edit.
    if a.len().abs_diff(b.len()) > likely {
        return None;
    }
    let distance = edit_distance(&a, &b);
    (distance <= likely).then_some(distance)
}

/// The number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    rows[0] = (0..=b.len()).collect();
    for i in 1..=a.len() {
        rows[i][0] = i;
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let shifted = rows[i - 1][j].min(rows[i][j - 1]) + 1;
            rows[i][j] = replaced.min(shifted);
            let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if swapped {
                rows[i][j] = rows[i][j].min(rows[i - 2][j - 2] + 1);
            }
        }
    }
    rows[a.len()][b.len()]
}

/// Advice on an unknown name: the name that was probably meant, else the result of `otherwise`, which gets a list of all names.
pub fn advice<'a>(
    name: &str,
    known: impl IntoIterator<Item = &'a str> + Clone,
    otherwise: impl FnOnce(&str) -> String,
) -> String {
    match did_you_mean(name, known.clone()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => otherwise(&known.into_iter().collect::<Vec<_>>().join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{advice, did_you_mean};

    #[test]
    fn finds_slips_and_leaves_strangers_alone() {
        let names = ["length", "young", "rho0", "amplitude", "mu"];
        assert_eq!(did_you_mean("lenght", names), Some("length"));
        assert_eq!(did_you_mean("rho", names), Some("rho0"));
        assert_eq!(did_you_mean("Mu", names), Some("mu"));
        assert_eq!(did_you_mean("m", names), None);
        assert_eq!(did_you_mean("temperature", names), None);
    }

    #[test]
    fn prefers_the_nearest_then_the_first() {
        assert_eq!(did_you_mean("x_mun", ["x_max", "x_min"]), Some("x_min"));
        assert_eq!(did_you_mean("abcd", ["abce", "abcf"]), Some("abce"));
    }

    #[test]
    fn advice_is_what_is_near_or_else_all() {
        let of = |name| advice(name, ["x_min", "x_max"], |all| format!("there are {all}"));
        assert_eq!(of("x_mni"), "did you mean `x_min`?");
        assert_eq!(of("temperature"), "there are x_min, x_max");
    }

    #[test]
    fn long_names_cost_nothing() {
        let long = "a".repeat(1 << 20);
        assert_eq!(did_you_mean(&long, [long.as_str(), "a"]), None);
    }
}
