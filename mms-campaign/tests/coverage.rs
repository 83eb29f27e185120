//! The smallest set of fields that shows all.

use std::collections::BTreeSet;

use mms_campaign::coverage::*;

fn candidates(all: &[(f64, &str)]) -> Vec<Candidate> {
    let terms = |text: &str| text.chars().map(String::from).collect();
    all.iter().map(|(cost, text)| Candidate { cost: *cost, terms: terms(text) }).collect()
}

#[test]
fn fewest_then_cheapest_and_cheapest_first() {
    for (all, chosen) in [
        (&[][..], &[][..]),
        (&[(1.0, "")], &[]),
        // Choosing the largest first would end with three.
        (&[(1.0, "abcd"), (1.0, "abe"), (1.0, "cdf")], &[1, 2]),
        (&[(5.0, "ab"), (3.0, "ab"), (4.0, "c")], &[1, 2]),
        (&[(9.0, "abc"), (1.0, "a"), (1.0, "b"), (1.0, "c")], &[0]),
        (&[(5.0, "ab"), (3.0, "cd")], &[1, 0]),
    ] {
        assert_eq!(smallest(&candidates(all)), chosen, "{all:?}");
    }
}

/// Compares with all subsets, one after the other.
#[test]
fn no_smaller_set_shows_as_much() {
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        state >> 33
    };
    for _ in 0..60 {
        let words: Vec<String> =
            (0..8).map(|_| "abcdefgh".chars().filter(|_| random() % 3 == 0).collect()).collect();
        let costs: Vec<f64> = (0..8).map(|_| (random() % 9) as f64).collect();
        let all: Vec<_> = costs.iter().copied().zip(words.iter().map(String::as_str)).collect();
        let all = candidates(&all);
        let shown = |set: &[usize]| -> BTreeSet<&String> {
            set.iter().flat_map(|&at| &all[at].terms).collect()
        };
        let whole = shown(&(0..8).collect::<Vec<_>>());
        let subsets = (0..256_u32).map(|bits| (0..8).filter(|at| bits >> at & 1 == 1).collect());
        let showing = subsets.filter(|set: &Vec<usize>| shown(set) == whole);
        let cost = |set: &[usize]| set.iter().map(|&at| all[at].cost).sum::<f64>();
        let least = showing
            .map(|set| (set.len(), cost(&set)))
            .min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let found = smallest(&all);
        assert_eq!(shown(&found), whole);
        assert_eq!(Some((found.len(), cost(&found))), least);
    }
}
