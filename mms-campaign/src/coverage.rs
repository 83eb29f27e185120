//! The smallest set of candidates that shows every term that any candidate shows.

use std::collections::BTreeSet;

/// A candidate: the terms that it shows, and its cost.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The cost of the candidate.
    pub cost: f64,
    /// The names of the terms that it shows.
    pub terms: BTreeSet<String>,
}

/// The positions, sorted by cost, of the smallest set of candidates that shows every term that any candidate shows: the cheapest
/// of several such sets.
pub fn smallest(candidates: &[Candidate]) -> Vec<usize> {
    let wanted: BTreeSet<&String> = candidates.iter().flat_map(|it| &it.terms).collect();
    let mut search = Search { candidates, best: None };
    for count in 0..=candidates.len() {
        search.extend(&mut Vec::new(), &wanted, count);
        if search.best.is_some() {
            break;
        }
    }
    let mut best = search.best.map(|(_, chosen)| chosen).unwrap_or_default();
    best.sort_by(|a, b| candidates[*a].cost.total_cmp(&candidates[*b].cost).then(a.cmp(b)));
    best
}

struct Search<'a> {
    candidates: &'a [Candidate],
    best: Option<(f64, Vec<usize>)>,
}

impl Search<'_> {
    /// Tries every candidate that shows the rarest remaining term, until all terms are shown.
    fn extend(&mut self, chosen: &mut Vec<usize>, left: &BTreeSet<&String>, more: usize) {
        let showing = |term: &String| {
            let shows = |at: &usize| self.candidates[*at].terms.contains(term);
            (0..self.candidates.len()).filter(shows).collect::<Vec<_>>()
        };
        let Some(rarest) = left.iter().map(|term| showing(term)).min_by_key(Vec::len) else {
            let cost = chosen.iter().map(|&at| self.candidates[at].cost).sum();
            if self.best.as_ref().is_none_or(|(least, _)| cost < *least) {
                self.best = Some((cost, chosen.clone()));
            }
            return;
        };
        let most = self.candidates.iter().map(|it| it.terms.len()).max().unwrap_or(0);
        if left.len() > more * most {
            return;
        }
        for at in rarest {
            let terms = &self.candidates[at].terms;
            let rest = left.iter().copied().filter(|term| !terms.contains(*term)).collect();
            chosen.push(at);
            self.extend(chosen, &rest, more - 1);
            chosen.pop();
        }
    }
}
