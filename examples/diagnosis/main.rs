//! Writes docs/diagnosis.md: how often `mms diagnose` names a mistake, and how often wrongly.
//!
//! `cargo run --release --example diagnosis -- SEED CASES > docs/diagnosis.md`; a case in a plane takes some 20 s. The scripts in
//! `elements` add the sections about an independent solver.
//!
//! A case is drawn, not chosen: a field, a mistake with a size, a method, meshes, a layout of particles, a time. It counts if it
//! does not stop, and if its error exceeds three times the error of the right run.

mod case;

use std::collections::BTreeMap;
use std::error::Error;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

use case::{Case, Outcome};
use mms_diagnosis::exact::Exact;
use mms_diagnosis::list::listed;
use mms_exact::gallery;
use mms_runtime::scene::Scene;

/// The text before the table.
const INTRODUCTION: &str = "\
# Diagnosis, measured

A solver makes a mistake of some size on a field of the gallery, and writes its displacements at two times, on one mesh or two.
`mms diagnose` gets only these results. A seed determines fields, mistakes, sizes, meshes, times and methods: shape function,
integrator, transfer, formulation, jitter, offset of the grid. A case is drawn again if a run stops, or if its error is at most
three times the error of the right run. The list of hypotheses belongs to this version (its hash is printed), and was not
changed after the seed was drawn. These solvers are not independent of the hypotheses: both use the same code of the mistakes,
and methods of this project.

* closed: the mistake is in the list. The answer is right if the mistake is the first name, or equivalent to it.
* open: the family of the mistake is removed from the list, so that every name is wrong.
* two: two mistakes at once, of different families, in computed quantities. The answer is right if it names one of them.
* right: no mistake, integrators of second order.

`share alone right` counts the cases in which the mistake explains the largest part of the error, whether or not the answer
names it.

`conformal_sector_2d` is left out: it is unstable under its own loads, so no solver can follow it. Intervals
are for 95 %, after Wilson.
";

/// Fields that are left out: no solver can follow them.
const UNSTABLE: &[&str] = &["conformal_sector_2d"];

/// How a set of cases ended.
#[derive(Default)]
struct Tally {
    cases: usize,
    right: usize,
    wrong: usize,
    unexplained: usize,
    nothing: usize,
    /// The cases in which the mistake explains the largest part of the error, named or not.
    by_share_alone: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Vec<u64> =
        std::env::args().skip(1).map(|it| it.parse()).collect::<Result<_, _>>()?;
    let [seed, count] = numbers[..] else {
        return Err("expected a seed and a number of cases".into());
    };
    let mut random = fastrand::Rng::with_seed(seed);
    let mut scenes = Vec::new();
    for entry in gallery::FIELDS {
        let compiled = entry.compile().map_err(|failure| failure.to_string())?;
        // In space a case takes minutes.
        if compiled.field.dimension < 3 && !UNSTABLE.contains(&entry.name) {
            scenes.push((
                entry.name,
                mms_interpreted::scene(Arc::new(compiled), &Default::default())?,
            ));
        }
    }
    let list = hash(scenes.iter().map(|(_, scene)| scene));
    println!(
        "{INTRODUCTION}\nSeed {seed}, {count} cases of each set; the list of hypotheses is {list:016x}.\n"
    );
    println!(
        "| set | cases | named right | named wrong | unexplained | nothing | share alone right |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut wrong = Vec::new();
    let mut of_mistakes: BTreeMap<&'static str, Tally> = BTreeMap::new();
    for set in [Case::Closed, Case::Open, Case::Two, Case::Right] {
        let mut tally = Tally::default();
        while tally.cases < count as usize {
            let (name, scene) = &scenes[random.usize(..scenes.len())];
            let outcome = match scene {
                Scene::Line(field) => case::drawn(name, field.as_ref(), set, &mut random),
                Scene::Plane(field) => case::drawn(name, field.as_ref(), set, &mut random),
                Scene::Space(_) => None,
            };
            let Some(outcome) = outcome else { continue };
            eprintln!("{outcome:?}");
            tally.add(&outcome);
            if set == Case::Closed {
                of_mistakes.entry(outcome.name).or_default().add(&outcome);
            }
            if outcome.finding == "wrong" {
                wrong.push((set, outcome));
            }
        }
        println!("{}", tally.row(set));
    }
    println!("\nThe closed set, by mistake:\n");
    println!(
        "| mistake | cases | right | wrong | unexplained | nothing |\n|---|---|---|---|---|---|"
    );
    for (name, it) in of_mistakes {
        println!(
            "| `{name}` | {} | {} | {} | {} | {} |",
            it.cases, it.right, it.wrong, it.unexplained, it.nothing
        );
    }
    println!(
        "\nWrong names:\n\n| set | field | mistake | named | explains |\n|---|---|---|---|---|"
    );
    for (set, it) in wrong {
        println!(
            "| {} | `{}` | {} | {} | {:.1} % |",
            set.name(),
            it.field,
            it.mistake,
            it.first,
            100.0 * it.explained
        );
    }
    Ok(())
}

/// A hash of the hypotheses about these fields.
fn hash<'a>(scenes: impl Iterator<Item = &'a Scene<f64>>) -> u64 {
    let mut hasher = DefaultHasher::new();
    let listed = scenes.flat_map(|scene| match scene {
        Scene::Line(field) => listed(&Exact::new(field.as_ref(), 1.0, 1.0)),
        Scene::Plane(field) => listed(&Exact::new(field.as_ref(), 1.0, 1.0)),
        Scene::Space(_) => Vec::new(),
    });
    for it in listed {
        (it.title, it.says, it.changes).hash(&mut hasher);
    }
    hasher.finish()
}

impl Tally {
    fn add(&mut self, outcome: &Outcome) {
        self.cases += 1;
        self.by_share_alone += usize::from(outcome.is_right_by_share);
        match outcome.finding {
            "right" => self.right += 1,
            "wrong" => self.wrong += 1,
            "unexplained" => self.unexplained += 1,
            _ => self.nothing += 1,
        }
    }

    fn row(&self, set: Case) -> String {
        let of = |count: usize| {
            let [low, high] = wilson(count, self.cases);
            format!("{count} ({low:.0} to {high:.0} %)")
        };
        let alone = if set == Case::Closed { of(self.by_share_alone) } else { "-".into() };
        let each = [self.right, self.wrong, self.unexplained, self.nothing].map(of);
        format!("| {} | {} | {} | {alone} |", set.name(), self.cases, each.join(" | "))
    }
}

/// The interval of Wilson of a share, in percent.
fn wilson(count: usize, all: usize) -> [f64; 2] {
    let (n, z) = (all as f64, 1.96);
    let share = count as f64 / n;
    let middle = share + z * z / (2.0 * n);
    let width = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    [middle - width, middle + width].map(|it| (100.0 * it / (1.0 + z * z / n)).max(0.0))
}
