//! Settings that a search chooses from: everything of a run except its field and its grid.

use std::fmt;

use mms_options::method::{Arithmetic, Precision};
use mms_runtime::{FormulationName, IntegratorName, Method, Setup, ShapeName, Transfer};
use mms_spec::Form;

/// The Courant numbers that are tried.
pub const COURANT: [f64; 11] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// The numbers of particles per cell and direction that are tried.
pub const PARTICLES: [usize; 4] = [1, 2, 3, 4];

/// The transfers that are tried.
const TRANSFERS: [Transfer; 4] =
    [Transfer::FLIP, Transfer::Apic, Transfer::Xpic { order: 2 }, Transfer::Pic];

/// A method with its numbers, and how they are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The formulation.
    pub formulation: FormulationName,
    /// The shape function.
    pub shape: ShapeName,
    /// The time integrator.
    pub integrator: IntegratorName,
    /// The transfer.
    pub transfer: Transfer,
    /// Particles per cell along each axis.
    pub particles: usize,
    /// The Courant number.
    pub courant: f64,
    /// The precision, and the form of the field's quantities.
    pub arithmetic: Arithmetic,
}

impl Default for Setting {
    /// The setting of `mms run` without options.
    fn default() -> Self {
        let Method { shape, integrator, formulation, setup } = Method::default();
        let Setup { transfer, courant, .. } = setup;
        let arithmetic = Arithmetic::default();
        Setting { formulation, shape, integrator, transfer, particles: 2, courant, arithmetic }
    }
}

/// The axes in which settings differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Formulation and shape function, of which not all combinations are possible.
    Kind,
    /// The transfer.
    Transfer,
    /// The integrator.
    Integrator,
    /// Particles per cell.
    Particles,
    /// The Courant number.
    Courant,
    /// Single or double precision.
    Precision,
    /// The stable form or the fast one.
    Form,
}

impl Axis {
    /// All axes.
    pub const ALL: [Axis; 7] = [
        Axis::Kind,
        Axis::Transfer,
        Axis::Integrator,
        Axis::Particles,
        Axis::Courant,
        Axis::Precision,
        Axis::Form,
    ];
}

impl Setting {
    /// The default with every shape function in every formulation that takes it, the default itself first.
    pub fn kinds() -> Vec<Setting> {
        let default = Setting::default();
        let mut kinds = vec![default];
        for &formulation in FormulationName::ALL {
            for &shape in ShapeName::ALL {
                let method = Method { formulation, shape, ..Method::default() };
                let kind = Setting { formulation, shape, ..default };
                if kind != default && method.validate().is_ok() {
                    kinds.push(kind);
                }
            }
        }
        kinds
    }

    /// The rows of settings that differ from this one along an axis; each row is followed as long as it improves.
    pub fn neighbours(&self, axis: Axis) -> Vec<Vec<Setting>> {
        let one = |setting| vec![setting];
        match axis {
            Axis::Kind => {
                Setting::kinds().into_iter().map(|kind| one(self.of_kind(&kind))).collect()
            }
            Axis::Transfer => {
                let others = TRANSFERS.into_iter().filter(|it| *it != self.transfer);
                others.map(|transfer| one(Setting { transfer, ..*self })).collect()
            }
            Axis::Integrator => {
                let others = IntegratorName::ALL.iter().filter(|it| **it != self.integrator);
                others.map(|&integrator| one(Setting { integrator, ..*self })).collect()
            }
            Axis::Particles => both_ways(
                &PARTICLES,
                |it| it.cmp(&self.particles),
                |particles| Setting { particles, ..*self },
            ),
            Axis::Courant => both_ways(
                &COURANT,
                |it| it.total_cmp(&self.courant),
                |courant| Setting { courant, ..*self },
            ),
            Axis::Precision => {
                let precision = match self.arithmetic.precision {
                    Precision::F32 => Precision::F64,
                    Precision::F64 => Precision::F32,
                };
                vec![one(self.computed(Arithmetic { precision, ..self.arithmetic }))]
            }
            Axis::Form => {
                let others = Form::ALL.into_iter().filter(|it| *it != self.arithmetic.form);
                others
                    .map(|form| one(self.computed(Arithmetic { form, ..self.arithmetic })))
                    .collect()
            }
        }
    }

    /// The setting with another formulation and shape function.
    fn of_kind(&self, kind: &Setting) -> Setting {
        Setting { formulation: kind.formulation, shape: kind.shape, ..*self }
    }

    /// The setting with another precision and form.
    fn computed(&self, arithmetic: Arithmetic) -> Setting {
        Setting { arithmetic, ..*self }
    }

    /// Whether only the Courant number differs: then a step takes the same time per particle.
    pub fn same_step(&self, other: &Setting) -> bool {
        *self == Setting { courant: self.courant, ..*other }
    }

    /// The options of `mms run`, without defaults.
    pub fn options(&self) -> Vec<String> {
        let default = Setting::default();
        let mut options = Vec::new();
        let mut option = |name: &str, value: String, usual: String| {
            if value != usual {
                options.extend([format!("--{name}"), value]);
            }
        };
        option("formulation", self.formulation.to_string(), default.formulation.to_string());
        option("shape", self.shape.to_string(), default.shape.to_string());
        option("integrator", self.integrator.to_string(), default.integrator.to_string());
        option("transfer", self.transfer.to_string(), default.transfer.to_string());
        option("particles-per-cell", self.particles.to_string(), default.particles.to_string());
        option("courant", self.courant.to_string(), default.courant.to_string());
        let [own, usual] = [self.arithmetic, default.arithmetic];
        option("precision", own.precision.name().into(), usual.precision.name().into());
        option("form", own.form.name().into(), usual.form.name().into());
        options
    }

    /// The value on an axis, in words.
    pub fn word(&self, axis: Axis) -> String {
        match axis {
            Axis::Kind => format!("{} {}", self.formulation, self.shape),
            Axis::Transfer => self.transfer.to_string(),
            Axis::Integrator => self.integrator.to_string(),
            Axis::Particles if self.particles == 1 => "1 particle per cell and direction".into(),
            Axis::Particles => format!("{} particles per cell and direction", self.particles),
            Axis::Courant => format!("Courant {}", self.courant),
            Axis::Precision => self.arithmetic.precision.name().into(),
            Axis::Form => format!("{} form", self.arithmetic.form.name()),
        }
    }
}

impl fmt::Display for Setting {
    /// Writes the setting in words, without its defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let default = Setting::default();
        let [kind, integrator] = [Axis::Kind, Axis::Integrator].map(|axis| self.word(axis));
        write!(f, "{kind} {integrator}")?;
        if self.transfer != default.transfer {
            write!(f, " {}", self.word(Axis::Transfer))?;
        }
        let [particles, courant] = [Axis::Particles, Axis::Courant].map(|axis| self.word(axis));
        write!(f, ", {}, {particles}, {courant}", self.arithmetic)
    }
}

/// The values above a value, nearest first, and the values below it.
fn both_ways<T: Copy>(
    ladder: &[T],
    order: impl Fn(&T) -> std::cmp::Ordering,
    setting: impl Fn(T) -> Setting,
) -> Vec<Vec<Setting>> {
    let above = ladder.iter().copied().filter(|it| order(it).is_gt()).map(&setting).collect();
    let below = ladder.iter().copied().filter(|it| order(it).is_lt()).rev().map(&setting).collect();
    vec![above, below]
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_options::Study;

    /// Every searched setting can be run: its options are understood, and compatible.
    #[test]
    fn options_are_those_of_a_run() {
        for kind in Setting::kinds() {
            for axis in Axis::ALL {
                for setting in kind.neighbours(axis).into_iter().flatten() {
                    let mut words = vec!["bar_1d".to_owned(), "--cells".into(), "8".into()];
                    words.extend(setting.options());
                    let study = Study::of_words(&words).unwrap();
                    let method = study.method.method(1).unwrap();
                    let found = Setting {
                        formulation: method.formulation,
                        shape: method.shape,
                        integrator: method.integrator,
                        transfer: method.setup.transfer,
                        particles: method.setup.particles_per_cell.along(0),
                        courant: method.setup.courant,
                        arithmetic: study.method.arithmetic,
                    };
                    assert_eq!(found, setting, "{words:?}");
                    assert!(method.validate().is_ok());
                }
            }
        }
        assert_eq!(Setting::default().options(), [] as [&str; 0]);
    }

    #[test]
    fn neighbours_lie_on_both_sides_from_near_to_far() {
        let rows = Setting::default().neighbours(Axis::Courant);
        let numbers = rows.iter().map(|row| row.iter().map(|it| it.courant).collect::<Vec<_>>());
        assert_eq!(
            numbers.collect::<Vec<_>>(),
            [vec![0.5, 0.6, 0.7, 0.8, 0.9, 1.0], vec![0.3, 0.2, 0.1, 0.05]]
        );
    }
}
