//! The likely causes of a study that does not pass, each with the option that avoids it.

use mms_convergence::{ExpectedOrder, Verdict};
use mms_exact::Input;
use mms_judge::next::{Words, command};
use mms_options::field::Variant;
use mms_report::UnstartedLevel;
use mms_runtime::Transfer;
use mms_runtime::failure::Cause as Stop;
use mms_runtime::integrator::{Integrator, IntegratorVisitor};
use mms_runtime::study::Refinement;
use mms_runtime::{Division, Failure, FormulationName, IntegratorName, Method, Run, ShapeName};
use mms_symbolic::expr::Symbol;

use super::super::next::changed;
use super::super::warned::{Warned, warned};
use super::usual::is_box;

/// A study that has ended.
pub struct Ended<'a> {
    /// The field, as it was named.
    pub field: &'a str,
    /// The field in the form that the method takes.
    pub input: &'a Input,
    /// The variant of the field.
    pub variant: Variant,
    /// Parameters that were set.
    pub set: &'a [String],
    /// The method.
    pub method: &'a Method,
    /// All methods that are studied, this one among them.
    pub studied: &'a [Named],
    /// The words of this method.
    pub own: &'a Named,
    /// The refined lengths.
    pub refinement: Refinement,
    /// The levels, from coarse to fine.
    pub levels: &'a [Result<Run, UnstartedLevel>],
    /// The expected order.
    pub expected: ExpectedOrder,
    /// The verdict.
    pub verdict: Verdict,
    /// The words of the command.
    pub words: &'a [String],
}

/// The options that name a method, with their values.
pub type Named = Vec<(&'static str, String)>;

/// A likely cause, and the options that avoid it, by their names and values; none, if no option does.
struct Cause {
    says: String,
    options: Vec<(&'static str, String)>,
}

impl Cause {
    fn new(says: impl Into<String>, options: &[(&'static str, &str)]) -> Self {
        let options = options.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
        Cause { says: says.into(), options }
    }
}

/// The most cells along an edge of a finer mesh that is proposed, in one to three dimensions.
const MOST_CELLS: [usize; 3] = [1024, 64, 16];

impl Ended<'_> {
    /// The causes in sentences, and the command to type next.
    pub fn explained(&self) -> anyhow::Result<(Vec<String>, Words)> {
        let mut causes = self.of_time_step();
        causes.extend(self.of_integrator());
        causes.extend(self.of_transfer());
        if self.refinement != Refinement::Time {
            causes.extend(self.of_shape());
            causes.extend(self.of_field()?);
            causes.extend(self.of_rest());
        }
        causes.extend(self.of_stops());
        causes.extend(self.of_few_levels().filter(|_| causes.is_empty()));
        let options = causes.iter().map(|it| &it.options);
        let options = options.into_iter().find(|it| !it.is_empty() && self.is_new(it));
        let next = match options {
            Some(options) => changed(self.words, &self.alone(options)),
            None => {
                let set = self.set.iter().map(|it| format!("--set={it}"));
                let head = ["check".to_owned(), self.field.to_owned()];
                command(head.into_iter().chain(set).chain(self.variant.arguments()))
            }
        };
        Ok((causes.into_iter().map(|it| it.says).collect(), next))
    }

    /// The options of this method and no other, with some changed.
    fn alone(&self, options: &[(&'static str, String)]) -> Named {
        let mut own = Vec::new();
        if self.studied.len() > 1 {
            own.clone_from(self.own);
            own.retain(|(name, _)| options.iter().all(|(other, _)| other != name));
        }
        own.into_iter().chain(options.iter().cloned()).collect()
    }

    /// Whether options lead to a study other than this command's.
    fn is_new(&self, options: &[(&'static str, String)]) -> bool {
        let changed = self.alone(options);
        let is_of = |method: &Named| changed.iter().all(|it| method.contains(it));
        self.studied.len() == 1 || !self.studied.iter().any(is_of)
    }

    /// The runs that stopped, from coarse to fine.
    fn failures(&self) -> impl Iterator<Item = &Failure> {
        self.levels.iter().flatten().filter_map(|run| run.level.errors.as_ref().err())
    }

    /// A time step in which a wave may cross a cell.
    fn of_time_step(&self) -> Vec<Cause> {
        let courant = self.failures().filter_map(|it| match it.cause {
            Stop::UnstableStep { courant, .. } => Some(courant),
            _ => None,
        });
        let Some(stable) = courant.reduce(f64::min) else { return Vec::new() };
        let digits = (2.0 - stable.log10().floor()).max(0.0) as i32;
        let scale = 10f64.powi(digits);
        let courant = ((stable * scale).floor() / scale).to_string();
        let says = format!(
            "the time step is above the stable one: `--courant {courant}` is below it; `--allow-unstable` runs it anyway"
        );
        vec![Cause::new(says, &[("courant", &courant)])]
    }

    /// An integrator of a lower order.
    fn of_integrator(&self) -> Option<Cause> {
        struct Formal;
        impl IntegratorVisitor for Formal {
            type Output = i32;
            fn visit<I: Integrator>(self) -> i32 {
                I::FORMAL_ORDER
            }
        }
        let order = self.method.integrator.visit(Formal);
        let best = IntegratorName::Leapfrog;
        let is_low = f64::from(order) < self.expected.order.min(f64::from(best.visit(Formal)));
        let has_time = self.refinement != Refinement::Space && !self.method.setup.relax;
        (is_low && has_time).then(|| {
            let says = format!(
                "`{}` is of order {order} in time: `--integrator {best}` is of order {}",
                self.method.integrator,
                best.visit(Formal)
            );
            Cause::new(says, &[("integrator", best.name())])
        })
    }

    /// A transfer that damps.
    fn of_transfer(&self) -> Option<Cause> {
        let transfer = self.method.setup.transfer;
        let damps = match transfer {
            Transfer::Pic => true,
            Transfer::Flip { fraction } => fraction < 1.0,
            Transfer::Apic | Transfer::Xpic { .. } => false,
        };
        let has_time = self.refinement != Refinement::Space && !self.method.setup.relax;
        (damps && has_time && self.expected.order > 1.0).then(|| {
            let says = "particles lose part of their velocity to the grid in each step, which is an error of order 1 in time: \
                        `--transfer flip` keeps it";
            let fraction = matches!(transfer, Transfer::Flip { .. });
            let flip = Cause::new(says, &[("transfer", "flip")]);
            let whole = ("flip-fraction", "1".to_owned());
            Cause { options: flip.options.into_iter().chain(fraction.then_some(whole)).collect(), ..flip }
        })
    }

    /// A shape function that loses its order on such a body.
    fn of_shape(&self) -> Option<Cause> {
        let Method { shape, formulation, .. } = self.method;
        let field = &self.input.compiled.field;
        let linear: &[(&str, &str)] = &[("formulation", "total"), ("shape", "linear")];
        let cpdi: &[(&str, &str)] = &[("formulation", "updated"), ("shape", "cpdi")];
        let (best, words) = match is_box(field) {
            true => (linear, "--formulation total --shape linear"),
            false => (cpdi, "--shape cpdi"),
        };
        let what = match (formulation, shape) {
            (FormulationName::Updated, ShapeName::Cpdi) => return None,
            (FormulationName::Updated, ShapeName::Cpgimp) if field.dimension == 1 => {
                self.failures().next()?;
                "particles get as wide as cells, or cross them".to_owned()
            }
            (FormulationName::Updated, ShapeName::Cpgimp) => {
                "particles cross cells, and their boxes do not shear: they leave gaps and overlap"
                    .into()
            }
            (FormulationName::Updated, ShapeName::Ugimp) => {
                "the domains of particles keep their size: they leave gaps and overlap as the body deforms"
                    .into()
            }
            (FormulationName::Updated, other) => {
                format!("particles cross cells, where `{other}` loses its order")
            }
            (FormulationName::Total, ShapeName::CubicBspline) if is_box(field) => {
                "the lumped mass lowers the order of cubic splines at the faces".into()
            }
            (FormulationName::Total, _) if is_box(field) => return None,
            (FormulationName::Total, _) => {
                "curved faces cut cells, some of which hold few particles".into()
            }
        };
        Some(Cause::new(format!("{what}; `{words}` avoids it"), best))
    }

    /// The warning of `mms check` about the motion, with a smaller amplitude.
    fn of_field(&self) -> anyhow::Result<Option<Cause>> {
        let found = warned(self.input, self.set, &self.variant)?;
        Ok(found.map(|Warned { says, half }| {
            let options = half.into_iter().map(|half| ("set", half)).collect();
            Cause { says, options }
        }))
    }

    /// A field that does not move, in a study that follows its motion.
    fn of_rest(&self) -> Option<Cause> {
        let compiled = &self.input.compiled;
        let is_timed = |u| compiled.graph.symbols(u).contains(&Symbol::Time);
        let moves = compiled.model.displacement.iter().any(|u| is_timed(*u));
        (!moves && !self.input.is_static()).then(|| {
            let says = "nothing moves in this field, so the study measures the vibration of its errors; a file without `time` \
                        under [domain] is brought to its equilibrium by `--relax`";
            Cause::new(says, &[])
        })
    }

    /// Runs that stopped for a reason other than an unstable time step. If finer meshes stop sooner, smaller steps and more
    /// cells do not help.
    fn of_stops(&self) -> Option<Cause> {
        let is_unstable = |it: &&Failure| matches!(it.cause, Stop::UnstableStep { .. });
        let stops: Vec<&Failure> = self.failures().filter(|it| !is_unstable(it)).collect();
        let last = stops.last()?;
        let is_finest = self.levels.last()?.as_ref().is_ok_and(|run| run.level.errors.is_err());
        let sooner = stops.windows(2).all(|pair| pair[1].time <= pair[0].time);
        let times: Vec<_> = stops.iter().map(|it| format!("{:.2e}", it.time)).collect();
        if matches!(last.cause, Stop::LostInRelaxation { .. })
            && self.method.formulation == FormulationName::Updated
            && !is_box(&self.input.compiled.field)
        {
            let total = [
                ("formulation", "total"),
                ("shape", "quadratic_bspline"),
                ("particles-per-cell", "4"),
            ];
            let says = format!("a run stopped: {}", last.cause.advice());
            return Some(Cause::new(says, &total));
        }
        Some(match (is_finest && sooner, stops.len()) {
            _ if matches!(last.cause, Stop::NoReferencePosition { .. }) => Cause::new(
                "the motion has no inverse beside the body, where the updated formulation has nodes: `--formulation total` needs \
                 none",
                match is_box(&self.input.compiled.field) {
                    true => &[("formulation", "total"), ("shape", "linear")][..],
                    false => &[
                        ("formulation", "total"),
                        ("shape", "quadratic_bspline"),
                        ("particles-per-cell", "4"),
                    ],
                },
            ),
            (true, 2..) => Cause::new(
                format!(
                    "finer meshes stop sooner, at t = {}: smaller steps and more cells do not help",
                    times.join(", ")
                ),
                &[],
            ),
            _ => Cause::new(format!("a run stopped: {}", last.cause.advice()), &[]),
        })
    }

    /// Levels that are not conclusive: proposes one more level, with twice the cells or a smaller time step.
    fn of_few_levels(&self) -> Option<Cause> {
        if self.verdict != Verdict::NotAsymptotic {
            return None;
        }
        if self.refinement == Refinement::Time {
            let levels = (self.levels.len() + 1).to_string();
            let says = "the levels are not conclusive: add a smaller time step";
            return (self.levels.len() < 8).then(|| Cause::new(says, &[("levels", &levels)]));
        }
        let mut cells: Vec<Division> =
            self.levels.iter().flatten().map(|run| run.level.cells).collect();
        let finer = match *cells.last()? {
            Division::Uniform(number) => Division::Uniform(2 * number),
            Division::PerAxis(each, given) => Division::PerAxis(each.map(|it| 2 * it), given),
        };
        let most = MOST_CELLS[self.input.compiled.field.dimension - 1];
        let is_small = finer.numbers().iter().all(|it| *it <= most);
        cells.push(finer);
        let cells: Vec<_> = cells.iter().map(Division::to_string).collect();
        let says = "the levels are not conclusive: add a finer mesh";
        is_small.then(|| Cause::new(says, &[("cells", &cells.join(","))]))
    }
}
