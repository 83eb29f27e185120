//! Errors of a field against arbitrary precision: every quantity, in every precision and form, as declared and at extremes.
//!
//! The interpreter is measured, whose results have the same bits as emitted code. Each precision gets random inputs that it
//! represents exactly, and the reference, the same program in arbitrary precision, gets the same numbers. The reference has 256
//! bits. If 1536 bits change a value by more than 2^-136 of its quantity, it has 1536, and then 4096; a quantity that needs
//! more is left out.
//!
//! Infinite and NaN components enter no error. They are counted (`not_finite`), and among them the components whose true value
//! is beyond the range (`overflowed`). Components whose true value is not real enter no error either, and have their own count
//! (`undefined`). Magnitudes below the least normal number count as the least normal number.

mod errors;
mod points;
pub mod probe;
pub mod regime;
mod variants;

use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread;

use mms_math::{Double, Scalar as _};

pub use errors::Errors;
use errors::Tally;
pub use points::{Input, SampleRegion, inputs};

use probe::Search;
use regime::{Case, REGIMES, Regime};
pub use variants::Compile;
use variants::{Variants, first_line};

use mms_codegen::compile::{Compiled, Failure, Options};
use mms_codegen::variation::Variation;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Binary;
use mms_program::precision::{Digits, Precision};
use mms_spec::Form;
use mms_spec::foreign::Foreign;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

/// The least number of points at which J is searched. A regime is therefore the same for all requested numbers of points up to
/// this one.
const SEARCHED: usize = 1000;

/// The number of points at which the digits of the reference are checked.
const CHECKED: usize = 4;

/// The number of bits, relative to the largest value of a quantity, to which two references must agree.
const SETTLED: i32 = 136;

/// The reason for a quantity that is not measured.
const UNSETTLED: &str = "1233 digits do not determine the true values, which may be 0 by a cancellation that \
                         no formula shows";

/// The fields, quantities and regimes to measure.
#[derive(Clone, Debug)]
pub struct Request {
    /// The parameters that are set, the rigid motion and the limits. Quantities and form are ignored.
    pub options: Options,
    /// The quantities.
    pub quantities: Vec<Quantity>,
    /// The precisions.
    pub precisions: Vec<Precision>,
    /// The forms.
    pub forms: Vec<Form>,
    /// The names of the regimes, and of the field's own extremes; `None` for all.
    pub regimes: Option<Vec<String>>,
    /// The number of points.
    pub points: usize,
}

impl Default for Request {
    fn default() -> Self {
        Request {
            options: Options::default(),
            quantities: Quantity::ALL.to_vec(),
            precisions: Precision::ALL.to_vec(),
            forms: Form::ALL.to_vec(),
            regimes: None,
            points: 1000,
        }
    }
}

/// The errors of one quantity in one regime.
#[derive(Clone, Debug)]
pub struct AccuracyRow {
    /// The name of the regime.
    pub regime: Foreign,
    /// The quantity.
    pub quantity: Quantity,
    /// The precision.
    pub precision: Precision,
    /// The form.
    pub form: Form,
    /// The errors.
    pub errors: Errors,
}

/// A regime that could not be made, or a quantity that could not be measured in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The name of the regime.
    pub regime: Foreign,
    /// The quantity; `None` if the whole regime is left out.
    pub quantity: Option<Quantity>,
    /// The precision; `None` if the regime is left out in all.
    pub precision: Option<Precision>,
    /// The reason.
    pub reason: String,
}

/// All measured errors of a field.
#[derive(Clone, Debug, Default)]
pub struct Accuracy {
    /// The errors by regime, quantity, precision and form.
    pub rows: Vec<AccuracyRow>,
    /// The regimes and quantities that were not measured, and why.
    pub left_out: Vec<LeftOut>,
}

/// A field in a regime, for callers that run it: the variation, and the parameters that are set, by index.
#[derive(Clone, Debug)]
pub struct Varied {
    /// The variation of the field.
    pub variation: Variation,
    /// The values of parameters.
    pub values: SortedMap<usize, Rational>,
}

/// Puts a field in a regime; the error is the reason why that is impossible. If the body is shifted, the box in which it is
/// declared is shifted too (`Variation::Moved`).
pub fn vary(compile: Compile<'_>, options: &Options, regime: &Regime) -> Result<Varied, String> {
    let subject = Variants::new(compile, options, &[]).map_err(|failure| first_line(&failure))?;
    let case = regime.case(&subject, Search::Everywhere)?;
    let values = case.values(Precision::F64);
    let variation = match case.variation {
        Variation::Shifted => Variation::Moved,
        other => other,
    };
    variation.fits(&subject.plain().field)?;
    Ok(Varied { variation, values })
}

/// The names of the regimes of a field: first the regimes of all fields, then the field's own.
pub fn names(own: &[mms_spec::ExtremeSpec]) -> Vec<Foreign> {
    let shared = REGIMES.iter().map(|regime| regime.name.into());
    shared.chain(own.iter().map(|extreme| extreme.name.value.clone())).collect()
}

/// Measures the requested errors. Calls `progress` with the name of every regime before it begins.
pub fn measure(
    compile: Compile<'_>,
    request: &Request,
    mut progress: impl FnMut(&Foreign),
) -> Result<Accuracy, Failure> {
    let subject = Variants::new(compile, &request.options, &request.quantities)?;
    let mut accuracy = Accuracy::default();
    let wanted = |name: &str| match &request.regimes {
        Some(names) => names.iter().any(|wanted| wanted == name),
        None => true,
    };
    let shared = REGIMES.iter().map(|regime| (Foreign::from(regime.name), Maker::Shared(regime)));
    let own = subject.plain().field.extremes.iter().enumerate();
    let own = own.map(|(index, extreme)| (extreme.name.value.clone(), Maker::Own(index)));
    for (name, maker) in shared.chain(own).filter(|(name, _)| wanted(name.raw())) {
        progress(&name);
        let case = match maker {
            Maker::Shared(regime) => {
                regime.case(&subject, Search::Points(request.points.max(SEARCHED)))
            }
            Maker::Own(index) => Ok(Case::extreme(index)),
        };
        accuracy.add(&name, case, &subject, request);
    }
    Ok(accuracy)
}

/// The source of a regime.
enum Maker {
    Shared(&'static Regime),
    Own(usize),
}

impl Accuracy {
    fn add(
        &mut self,
        name: &Foreign,
        case: Result<Case, String>,
        subject: &Variants,
        request: &Request,
    ) {
        let mut leave_out = |quantity, precision, reason: String| {
            self.left_out.push(LeftOut { regime: name.clone(), quantity, precision, reason });
        };
        let made = case.and_then(|case| CompiledRegime::new(case, subject, request));
        let made = match made {
            Ok(made) => made,
            Err(reason) => return leave_out(None, None, reason),
        };
        let mut rows = Vec::new();
        for (precision, found) in request.precisions.iter().zip(made.all_errors(request)) {
            let PrecisionErrors { errors, unsettled } = match found {
                Ok(found) => found,
                Err(reason) => {
                    leave_out(None, Some(*precision), reason);
                    continue;
                }
            };
            for quantity in unsettled {
                leave_out(Some(quantity), Some(*precision), UNSETTLED.into());
            }
            rows.extend(errors.into_iter().map(|(quantity, form, errors)| AccuracyRow {
                regime: name.clone(),
                quantity,
                precision: *precision,
                form,
                errors,
            }));
        }
        // Stable, so that forms and precisions stay in the order of the request.
        rows.sort_by_key(|row| row.quantity);
        self.rows.extend(rows);
    }
}

/// The errors that were measured in one precision.
struct PrecisionErrors {
    /// The errors of each quantity and form.
    errors: Vec<(Quantity, Form, Errors)>,
    /// The quantities whose true values are not known.
    unsettled: Vec<Quantity>,
}

/// A regime of a field, compiled.
struct CompiledRegime {
    case: Case,
    reference: Arc<Compiled>,
    forms: Vec<(Form, Arc<Compiled>)>,
}

impl CompiledRegime {
    fn new(case: Case, subject: &Variants, request: &Request) -> Result<Self, String> {
        let compiled = |form: &Form| Ok((*form, subject.of_case(&case, *form)?));
        let forms = request.forms.iter().map(compiled).collect::<Result<_, String>>()?;
        let reference = subject.of_case(&case, Form::Stable)?;
        Ok(CompiledRegime { case, reference, forms })
    }

    /// Computes the errors in each precision, in parallel.
    fn all_errors(&self, request: &Request) -> Vec<Result<PrecisionErrors, String>> {
        thread::scope(|scope| {
            let start = |precision: &Precision| match precision {
                Precision::F32 => scope.spawn(|| self.errors::<f32>(request)),
                Precision::F64 => scope.spawn(|| self.errors::<f64>(request)),
                Precision::Wide => scope.spawn(|| self.errors::<Double>(request)),
            };
            let started: Vec<_> = request.precisions.iter().map(start).collect();
            let joined = started.into_iter().map(|thread| thread.join());
            joined.map(|found| found.unwrap_or_else(|panic| resume_unwind(panic))).collect()
        })
    }

    /// Computes the errors of each quantity and form in a precision; the error is the reason why there are none.
    fn errors<T: Digits>(&self, request: &Request) -> Result<PrecisionErrors, String> {
        let set = self.case.values(T::PRECISION);
        if self.case.variation == Variation::Nothing {
            self.reference.accepts(&set).map_err(|failure| first_line(&failure))?;
        }
        let parameters = self.reference.parameters::<T>(&set);
        let named = parameters.iter().zip(&self.reference.model.parameters);
        if let Some((_, odd)) = named.into_iter().find(|(value, _)| !value.is_number()) {
            return Err(format!("`{}` is beyond the range of {}", odd.name, T::PRECISION.name()));
        }
        let inputs = inputs(&self.reference, &parameters, self.case.place, request.points);
        if inputs.is_empty() {
            return Err("0 is neither in the body nor in the time window".into());
        }
        let run = RegimeInputs { made: self, parameters, inputs };
        let mut found =
            PrecisionErrors { errors: Vec::new(), unsettled: request.quantities.clone() };
        // Enough bits that more do not change the values. The largest numbers have 1024 before the point.
        run.decide::<256, 1536>(&mut found)?;
        run.decide::<1536, 4096>(&mut found)?;
        run.decide::<4096, 8192>(&mut found)?;
        Ok(found)
    }
}

/// The inputs of a regime in a precision.
struct RegimeInputs<'a, T> {
    made: &'a CompiledRegime,
    parameters: Vec<T>,
    inputs: Vec<Input<T>>,
}

/// The program of a form at some point.
struct Evaluation<'a, T: mms_program::interpret::Number> {
    interpreter: Interpreter<'a, T, Output>,
    plan: Vec<bool>,
}

impl<'a, T: mms_program::interpret::Number> Evaluation<'a, T> {
    fn new(compiled: &'a Compiled, parameters: &[T], outputs: &[Output]) -> Self {
        let interpreter = Interpreter::new(&compiled.program, parameters);
        let plan = interpreter.plan(outputs);
        Evaluation { interpreter, plan }
    }

    fn set(&mut self, input: &Input<T>) {
        self.interpreter.set_time(&input.time);
        let Input { coordinates, normal, .. } = input;
        self.interpreter.set_point(&self.plan, Point { coordinates, normal, gradient: &[] });
    }
}

impl<T: Digits> RegimeInputs<'_, T> {
    /// Adds the errors of quantities for which references of different digits agree.
    fn decide<const BITS: usize, const MORE: usize>(
        &self,
        found: &mut PrecisionErrors,
    ) -> Result<(), String> {
        if found.unsettled.is_empty() {
            return Ok(());
        }
        let mut settled = self.agreeing::<BITS, MORE>(&found.unsettled);
        // J, the last of the outputs, determines which points count.
        let counts = settled.pop() == Some(true) || self.made.case.least_jacobian.is_none();
        let mut settled = settled.into_iter().map(|it| it && counts);
        let (settled, unsettled): (Vec<_>, Vec<_>) =
            found.unsettled.iter().partition(|_| settled.next() == Some(true));
        if !settled.is_empty() {
            found.errors.extend(self.compare::<BITS>(&settled)?);
        }
        found.unsettled = unsettled;
        Ok(())
    }

    fn reference<const BITS: usize>(&self, outputs: &[Output]) -> Evaluation<'_, Binary<BITS>> {
        Evaluation::new(&self.made.reference, &precisely(&self.parameters), outputs)
    }

    /// Whether references of different digits agree at the checked points: for each quantity, and for J.
    fn agreeing<const BITS: usize, const MORE: usize>(&self, quantities: &[Quantity]) -> Vec<bool> {
        let outputs = outputs(quantities);
        let (mut some, mut more) =
            (self.reference::<BITS>(&outputs), self.reference::<MORE>(&outputs));
        let step = self.inputs.len().div_ceil(CHECKED);
        let mut agreements: Vec<_> = outputs.iter().map(|_| Agreement::<MORE>::default()).collect();
        for input in self.inputs.iter().step_by(step) {
            some.set(&precise_input(input));
            more.set(&precise_input(input));
            for (output, agreement) in outputs.iter().zip(&mut agreements) {
                let found = some.interpreter.output(*output);
                for (some, more) in found.iter().zip(more.interpreter.output(*output)) {
                    agreement.see(&some.with_bits(), more);
                }
            }
        }
        agreements.iter().map(Agreement::is_close).collect()
    }

    /// Computes the errors of some quantities in each form; the error is the reason why there are none.
    fn compare<const BITS: usize>(
        &self,
        quantities: &[Quantity],
    ) -> Result<Vec<(Quantity, Form, Errors)>, String> {
        let outputs = outputs(quantities);
        let mut reference = self.reference::<BITS>(&outputs);
        let forms = self.made.forms.iter();
        let mut evaluations: Vec<_> = forms
            .map(|(_, compiled)| Evaluation::new(compiled, &self.parameters, &outputs))
            .collect();
        let tallies = || quantities.iter().map(|_| Tally::<BITS>::new(T::PRECISION));
        let mut tallies: Vec<Vec<_>> = evaluations.iter().map(|_| tallies().collect()).collect();
        let mut counted = 0;
        for input in &self.inputs {
            reference.set(&precise_input(input));
            if !self.counts(&reference) {
                continue;
            }
            counted += 1;
            evaluations.iter_mut().for_each(|evaluation| evaluation.set(input));
            for (place, output) in outputs[..quantities.len()].iter().enumerate() {
                let expected = reference.interpreter.output(*output);
                for (evaluation, tallies) in evaluations.iter().zip(&mut tallies) {
                    let found = evaluation.interpreter.output(*output);
                    for (found, expected) in found.into_iter().zip(&expected) {
                        tallies[place].compare(found, expected);
                    }
                }
            }
        }
        if counted == 0 {
            return Err("J is below 1/2 at every point".into());
        }
        let named = self.made.forms.iter().zip(tallies);
        let errors = named.flat_map(|((form, _), tallies)| {
            let of =
                |(quantity, tally): (&Quantity, Tally<BITS>)| (*quantity, *form, tally.finish());
            quantities.iter().zip(tallies).map(of).collect::<Vec<_>>()
        });
        Ok(errors.collect())
    }

    /// Whether the regime includes the present point of the reference.
    fn counts<const BITS: usize>(&self, reference: &Evaluation<'_, Binary<BITS>>) -> bool {
        let Some(least) = self.made.case.least_jacobian else { return true };
        let jacobian = reference.interpreter.output(Output::Quantity(Quantity::Jacobian));
        jacobian.iter().all(|jacobian| Binary::from_f64(least).at_most(jacobian))
    }
}

/// The outputs that are evaluated for some quantities: these, and J.
fn outputs(quantities: &[Quantity]) -> Vec<Output> {
    quantities.iter().chain([&Quantity::Jacobian]).map(|it| Output::Quantity(*it)).collect()
}

fn precisely<T: Digits, const BITS: usize>(values: &[T]) -> Vec<Binary<BITS>> {
    values.iter().map(|value| value.precisely()).collect()
}

fn precise_input<T: Digits, const BITS: usize>(input: &Input<T>) -> Input<Binary<BITS>> {
    Input {
        coordinates: precisely(&input.coordinates),
        time: input.time.precisely(),
        normal: precisely(&input.normal),
    }
}

/// The largest difference of two references of a quantity, over all checked points and components, since one component alone
/// may be 0, and consist of round-off in both.
struct Agreement<const BITS: usize> {
    difference: Binary<BITS>,
    largest: Binary<BITS>,
    is_defined_alike: bool,
}

impl<const BITS: usize> Default for Agreement<BITS> {
    fn default() -> Self {
        let zero = Binary::from_f64(0.0);
        Agreement { difference: zero.clone(), largest: zero, is_defined_alike: true }
    }
}

impl<const BITS: usize> Agreement<BITS> {
    fn see(&mut self, some: &Binary<BITS>, more: Binary<BITS>) {
        self.is_defined_alike &= some.is_defined() == more.is_defined();
        let difference = (some.clone() - more.clone()).magnitude();
        if difference.is_defined() && !difference.at_most(&self.difference) {
            self.difference = difference;
        }
        let size = more.magnitude();
        if size.is_defined() && !size.at_most(&self.largest) {
            self.largest = size;
        }
    }

    fn is_close(&self) -> bool {
        let bound = self.largest.clone() * Binary::from_f64(2f64.powi(-SETTLED));
        self.is_defined_alike && self.difference.at_most(&bound)
    }
}
