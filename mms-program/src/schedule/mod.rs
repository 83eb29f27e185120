//! Schedules expressions as straight-line code, in four steps.
//!
//! * `flat`: sums and products, of any number of operands, are grouped by stage, so that no value is computed later than it is
//!   known.
//! * `cse`: common subexpressions. The most frequent pair of operands becomes an operation of its own, and so on, until no
//!   pair occurs twice.
//! * `lower`: the result becomes binary operations, operands of one stage first; equal operations are one value.
//! * `signs`: -((a - b) c) becomes (b - a) c, if nothing else reads the product.
//!
//! Every output is scheduled by itself, as several candidates, of which the cheapest is used; common values of outputs are
//! still one value. So other outputs do not change the cost of an output. Candidates with the same operations are tried once,
//! but the budget is charged for each. If it saves operations at a point, numbers are multiplied into sums whose terms all have
//! a factor that is known earlier: 256 X (a Y + b), a and b of the stage Time, becomes X ((256 a) Y + 256 b).

mod cse;
mod flat;
mod lower;
mod signs;

use cse::Scope;
use flat::{Flat, Grouping, Item, Scaling};
use lower::Builder;

use crate::fusion::Fusion;
use crate::program::{Instr, Key, Program, Value, needed};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{Expr, Graph, STEPS_OF_NODE, reachable};
use mms_symbolic::sorted::SortedMap;

/// The cost of operations, compared in the order of the fields: operations that depend on X come first, since they run at every
/// point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost {
    /// Operations of the stages Point and PointTime.
    pub per_point: usize,
    /// Operations of all stages.
    pub total: usize,
    /// Operations of the stage PointTime: the remaining ones for a caller that stores the part of X.
    pub late: usize,
}

impl Cost {
    /// Whether `other` is worth using instead of this for callers that store the part of X: operations that need X and t count
    /// twice. Other callers must have about as much to compute as before.
    pub fn is_worth(self, other: Cost) -> bool {
        let weight = |cost: Cost| cost.per_point + cost.late;
        self.is_about(other) && weight(other) + 2 * WORTH_APART <= weight(self)
    }

    /// Whether `other` costs at most about as much at a point.
    fn is_about(self, other: Cost) -> bool {
        let more = other.per_point.saturating_sub(self.per_point);
        ROOM * more <= self.per_point
    }
}

/// The cost of an output in one function of a position, if an added product takes no step of its own: steps at a point first,
/// then operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Steps {
    /// Steps of the stages Point and PointTime.
    pub per_point: usize,
    /// Operations.
    pub cost: Cost,
    /// Steps of the stage PointTime.
    pub late: usize,
}

impl Steps {
    /// Whether `other` has fewer steps than this, no more steps that need t, about as many operations at a point, and no more
    /// operations elsewhere than the saved steps are worth.
    pub fn is_worth(self, other: Steps) -> bool {
        let spared = self.per_point.saturating_sub(other.per_point);
        let once = |cost: Cost| cost.total - cost.per_point;
        spared > 0
            && other.late <= self.late
            && self.cost.is_about(other.cost)
            && once(other.cost) <= once(self.cost) + ONCE_FOR_EVERY_POINT * spared
    }
}

/// The number of operations at a point that must be saved before an output uses a candidate of its own: it then has less in
/// common with others.
const WORTH_APART: usize = 2;

/// One more operation for each of this many operations that depend on X still counts as about as much.
const ROOM: usize = 16;

/// The program of `outputs`, with only the instructions that they need.
pub fn schedule<K: Key>(graph: &Graph, outputs: &SortedMap<K, Vec<Expr>>) -> Program<K> {
    let program = lowered(outputs, &|components| cheapest_of_all(graph, components));
    named(outputs, in_stage_order(signs::carried(in_stage_order(program))))
}

/// The program of `outputs` as their expressions are written: only equal expressions are shared. Once the budget is spent, the
/// remaining outputs have no value.
pub fn schedule_plainly<K: Key>(graph: &Graph, outputs: &SortedMap<K, Vec<Expr>>) -> Program<K> {
    let program = lowered(outputs, &|components| {
        let (flat, roots) = match graph.work().is_over() {
            true => Flat::undefined(components.len()),
            false => {
                let all = (&graph.reachable(components)[..], components);
                Flat::new(graph, all, Grouping::Staged, Scaling::Factors)
            }
        };
        graph.work().spend(STEPS_OF_OPERAND * flat.forms.len() as u64);
        (flat, roots)
    });
    named(outputs, in_stage_order(program))
}

/// A program whose outputs are in the order of their keys. No pass uses the keys, so each pass is compiled once for all key
/// types.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Unnamed {
    instrs: Vec<Instr>,
    outputs: Vec<Vec<Value>>,
}

/// A program with the keys of its outputs.
fn named<K: Key>(outputs: &SortedMap<K, Vec<Expr>>, made: Unnamed) -> Program<K> {
    Program { instrs: made.instrs, outputs: outputs.keys().copied().zip(made.outputs).collect() }
}

/// Lowers all outputs, each as `written` returns it.
fn lowered<K: Key>(
    outputs: &SortedMap<K, Vec<Expr>>,
    written: &dyn Fn(&[Expr]) -> FlatProgram,
) -> Unnamed {
    let mut builder = Builder::default();
    let lower = |components: &Vec<Expr>| {
        let (flat, roots) = written(components);
        builder.lower(&flat, &roots)
    };
    let outputs = outputs.values().map(lower).collect();
    Unnamed { instrs: builder.instrs, outputs }
}

/// The number of operations done once that may save one at every point.
const ONCE_FOR_EVERY_POINT: usize = 8;

/// An upper bound of the cost of the components of one output: the emitted program has more candidates.
pub fn cost(graph: &Graph, components: &[Expr]) -> Cost {
    let scopes = [Scope::All];
    let ways = written(graph, components, Scaling::Factors, &scopes);
    cheapest(graph, &ways, &scopes).0
}

/// The cost of the components of one output, in steps.
pub fn steps(graph: &Graph, components: &[Expr]) -> Steps {
    let (flat, roots) = cheapest_of_all(graph, components);
    let mut builder = Builder::default();
    let roots = builder.lower(&flat, &roots);
    let needed = vec![true; builder.instrs.len()];
    let steps = |stages: &[Stage]| {
        let fusion = Fusion::new(&builder.instrs, &roots, &needed, stages);
        counted(&builder, stages) - fusion.absorbed.iter().filter(|absorbed| **absorbed).count()
    };
    Steps {
        per_point: steps(&AT_POINTS),
        cost: cost_in(&builder),
        late: steps(&[Stage::PointTime]),
    }
}

/// The steps of writing an operand and of making an operation with it.
const STEPS_OF_OPERAND: u64 = 50;

/// Components as operations, with the item of each.
type FlatProgram = (Flat, Vec<Item>);

/// Writes components as n-ary operations, with the values that need X separate from those that need t too, and, if that
/// differs, together.
fn written(
    graph: &Graph,
    components: &[Expr],
    scaling: Scaling,
    scopes: &[Scope],
) -> Vec<FlatProgram> {
    let reached = graph.reachable(components);
    let new = |grouping| Flat::new(graph, (&reached, components), grouping, scaling);
    let mut ways = vec![new(Grouping::Staged)];
    let flat = &ways[0].0;
    let operands = flat.forms.iter().map(|form| 1 + form.size() as u64).sum::<u64>();
    graph.work().spend(STEPS_OF_OPERAND * (2 + 2 * scopes.len() as u64) * operands);
    if graph.work().is_over() {
        return ways;
    }
    graph.work().spend(STEPS_OF_NODE * reached.len() as u64);
    let joint = flat.is_grouped.then(|| new(Grouping::Joint));
    let joint = joint.filter(|joint| joint.0.forms != flat.forms);
    ways.extend(joint);
    ways
}

/// The cheapest of the written candidates, with its cost; of equals, the first.
fn cheapest(graph: &Graph, written: &[FlatProgram], scopes: &[Scope]) -> (Cost, FlatProgram) {
    let (plain, work) = (&written[0], graph.work());
    let cost_of_plain = cost_of(plain);
    if work.is_over() {
        return (cost_of_plain, plain.clone());
    }
    let mut best: Option<(Cost, FlatProgram)> = None;
    let mut spent = vec![0; written.len()];
    for scope in scopes {
        for (way, spent) in written.iter().zip(&mut spent) {
            // If all operations are needed, both scopes give the same result.
            if *scope == Scope::Reachable && *spent > 0 && is_needed(way) {
                work.spend(*spent);
                continue;
            }
            let before = work.left();
            let (mut flat, roots) = way.clone();
            cse::share(&mut flat, &roots, *scope, work);
            *spent = before - work.left();
            let way = (flat, roots);
            let cost = cost_of(&way);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, way));
            }
        }
    }
    best.filter(|(cost, _)| *cost <= cost_of_plain)
        .unwrap_or_else(|| (cost_of_plain, plain.clone()))
}

/// Whether the roots need all operations.
fn is_needed((flat, roots): &FlatProgram) -> bool {
    let needed = reachable(roots, Item::index, |item| flat.form(item).operands());
    needed.len() == flat.forms.len()
}

/// The cheapest candidate, with numbers multiplied into sums if that saves operations at a point. It rarely does, so it is only
/// tried for emitted programs and close decisions, and not for all comparisons.
fn cheapest_of_all(graph: &Graph, components: &[Expr]) -> FlatProgram {
    let scopes = [Scope::All, Scope::Reachable];
    let before = graph.work().left();
    let unscaled = written(graph, components, Scaling::Factors, &scopes);
    let (cost, plain) = cheapest(graph, &unscaled, &scopes);
    if graph.work().is_over() {
        return plain;
    }
    if unscaled.iter().all(|(flat, _)| !flat.is_scalable) {
        graph.work().spend(before - graph.work().left());
        return plain;
    }
    let scaled = written(graph, components, Scaling::Sums, &scopes);
    let (other, scaled) = cheapest(graph, &scaled, &scopes);
    let saved = cost.per_point.saturating_sub(other.per_point);
    let is_worth_it =
        saved >= WORTH_APART && other.total <= cost.total + (ONCE_FOR_EVERY_POINT - 1) * saved;
    if is_worth_it { scaled } else { plain }
}

fn cost_of((flat, roots): &FlatProgram) -> Cost {
    let mut builder = Builder::default();
    builder.lower(flat, roots);
    cost_in(&builder)
}

/// The stages that run at every point.
const AT_POINTS: [Stage; 2] = [Stage::Point, Stage::PointTime];

/// The cost of all lowered operations.
fn cost_in(builder: &Builder) -> Cost {
    Cost {
        per_point: counted(builder, &AT_POINTS),
        total: counted(builder, &Stage::ALL),
        late: counted(builder, &[Stage::PointTime]),
    }
}

/// The number of lowered operations of these stages.
fn counted(builder: &Builder, stages: &[Stage]) -> usize {
    let instrs = builder.instrs.iter();
    instrs.filter(|instr| instr.op.is_counted() && stages.contains(&instr.stage)).count()
}

/// Drops instructions that no output needs, and sorts by stage; within a stage the order stays.
fn in_stage_order(program: Unnamed) -> Unnamed {
    let Unnamed { instrs, mut outputs } = program;
    let needed = needed(&instrs, &mut outputs.iter().flatten().copied());
    let mut order: Vec<usize> = (0..instrs.len()).filter(|index| needed[*index]).collect();
    order.sort_by_key(|index| instrs[*index].stage);
    let mut renamed = vec![Value(0); instrs.len()];
    for (new, old) in order.iter().enumerate() {
        renamed[*old] = Value(new as u32);
    }
    let rename = |value: Value| renamed[value.index()];
    for value in outputs.iter_mut().flatten() {
        *value = rename(*value);
    }
    let instr = |old: usize| Instr { op: instrs[old].op.map(rename), stage: instrs[old].stage };
    Unnamed { instrs: order.into_iter().map(instr).collect(), outputs }
}
