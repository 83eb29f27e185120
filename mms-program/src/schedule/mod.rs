//! From expressions to straight-line code, in four steps.
//!
//! * `flat`: sums and products, of any number of operands, are grouped by stage, so that nothing is computed later
//!   than it is known.
//! * `share`: common subexpressions. The pair of operands that most of them have in common becomes an operation of
//!   its own, and so on, until no pair occurs twice.
//! * `lower`: what is left becomes binary operations, those of one stage first, and equal ones one value.
//! * `signs`: -((a - b) c) becomes (b - a) c, where nothing else reads that.
//!
//! Every output is scheduled for itself, in several ways, and the cheapest is kept; values that outputs have in
//! common are one value all the same. So an output costs the same beside others as alone. Ways that come to the
//! same operations are tried once, and charged as often as they are named. Where that saves operations at a point,
//! numbers move into sums whose terms all have a factor that is known earlier: 256 X (a Y + b), a and b of the
//! stage Time, becomes X ((256 a) Y + 256 b).

mod flat;
mod lower;
mod share;
mod signs;

use flat::{Flat, Grouping, Item, Scaling};
use lower::Builder;
use share::Scope;

use crate::fusion::Fusion;
use crate::program::{Instr, Key, Program, Value, needed};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{Expr, Graph, STEPS_OF_NODE, reachable};
use mms_symbolic::sorted::SortedMap;

/// What operations cost: those that depend on X first, since they are done at every point, then
/// all; of two that are alike in both, the one that leaves less to t.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost {
    /// Operations of the stages Point and PointTime.
    pub per_point: usize,
    /// Operations of all stages.
    pub total: usize,
    /// Operations of the stage PointTime: all that is left to whoever keeps what X determines.
    pub late: usize,
}

impl Cost {
    /// Whether `other` is worth taking in place of this, where an operation that needs t counts twice: those who keep what
    /// X determines do it too. Those who do not shall have about as much to do as before.
    pub fn is_worth(self, other: Cost) -> bool {
        let weight = |cost: Cost| cost.per_point + cost.late;
        self.is_about(other) && weight(other) + 2 * WORTH_APART <= weight(self)
    }

    /// Whether `other` is no more than this at a point, or about as much.
    fn is_about(self, other: Cost) -> bool {
        let more = other.per_point.saturating_sub(self.per_point);
        ROOM * more <= self.per_point
    }
}

/// What an output takes, in one function of a position, where a product that is added takes no step of its own: steps at a
/// point first, then operations.
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
    /// Whether `other` has fewer steps than this, no more of them that need t, about as many operations at a point, and
    /// no more elsewhere than the steps are worth that it spares.
    pub fn is_worth(self, other: Steps) -> bool {
        let spared = self.per_point.saturating_sub(other.per_point);
        let once = |cost: Cost| cost.total - cost.per_point;
        spared > 0
            && other.late <= self.late
            && self.cost.is_about(other.cost)
            && once(other.cost) <= once(self.cost) + ONCE_FOR_EVERY_POINT * spared
    }
}

/// How many operations at a point must be saved before an output is written in a way of its own: it has less in common
/// with others then.
const WORTH_APART: usize = 2;

/// Of how many operations that depend on X one more is about as much.
const ROOM: usize = 16;

/// The program of `outputs`, without anything that they do not need.
pub fn schedule<K: Key>(graph: &Graph, outputs: &SortedMap<K, Vec<Expr>>) -> Program<K> {
    let program = lowered(outputs, &|components| cheapest_of_all(graph, components));
    named(outputs, in_stage_order(signs::carried(in_stage_order(program))))
}

/// The program of `outputs` as their expressions stand: nothing is shared but equal expressions. Where the budget is spent,
/// what is left has no value.
pub fn schedule_plainly<K: Key>(graph: &Graph, outputs: &SortedMap<K, Vec<Expr>>) -> Program<K> {
    let program = lowered(outputs, &|components| {
        let (flat, roots) = match graph.work().is_over() {
            true => Flat::void(components.len()),
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

/// A program whose outputs are in the order of their keys. No pass asks for the keys, so each is compiled once, whatever
/// they are.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Unnamed {
    instrs: Vec<Instr>,
    outputs: Vec<Vec<Value>>,
}

/// A program with the keys of its outputs.
fn named<K: Key>(outputs: &SortedMap<K, Vec<Expr>>, made: Unnamed) -> Program<K> {
    Program { instrs: made.instrs, outputs: outputs.keys().copied().zip(made.outputs).collect() }
}

/// All outputs, each as it is written.
fn lowered<K: Key>(outputs: &SortedMap<K, Vec<Expr>>, written: &dyn Fn(&[Expr]) -> Way) -> Unnamed {
    let mut builder = Builder::default();
    let lower = |components: &Vec<Expr>| {
        let (flat, roots) = written(components);
        builder.lower(&flat, &roots)
    };
    let outputs = outputs.values().map(lower).collect();
    Unnamed { instrs: builder.instrs, outputs }
}

/// How many operations that are done once may save one at every point.
const ONCE_FOR_EVERY_POINT: usize = 8;

/// What the components of one output cost, at most: more ways are tried of what is emitted.
pub fn cost(graph: &Graph, components: &[Expr]) -> Cost {
    let scopes = [Scope::Made];
    let ways = written(graph, components, Scaling::Factors, &scopes);
    cheapest(graph, &ways, &scopes).0
}

/// What the components of one output take, in steps.
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

/// What it takes to write an operand down and to make an operation with it.
const STEPS_OF_OPERAND: u64 = 50;

/// A way to write components down, with the items of these.
type Way = (Flat, Vec<Item>);

/// Components as n-ary operations, with what needs X apart from what needs t too and, where that differs, together.
fn written(graph: &Graph, components: &[Expr], scaling: Scaling, scopes: &[Scope]) -> Vec<Way> {
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

/// The cheapest way to compute what was written down, with what it costs; of equals, the first.
fn cheapest(graph: &Graph, written: &[Way], scopes: &[Scope]) -> (Cost, Way) {
    let (plain, work) = (&written[0], graph.work());
    let cost_of_plain = cost_of(plain);
    if work.is_over() {
        return (cost_of_plain, plain.clone());
    }
    let mut best: Option<(Cost, Way)> = None;
    let mut spent = vec![0; written.len()];
    for scope in scopes {
        for (way, spent) in written.iter().zip(&mut spent) {
            // Where all that was made is needed, both scopes come to the same.
            if *scope == Scope::Needed && *spent > 0 && is_needed(way) {
                work.spend(*spent);
                continue;
            }
            let before = work.left();
            let (mut flat, roots) = way.clone();
            share::share(&mut flat, &roots, *scope, work);
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
fn is_needed((flat, roots): &Way) -> bool {
    let needed = reachable(roots, Item::index, |item| flat.form(item).operands());
    needed.len() == flat.forms.len()
}

/// The cheapest way, numbers moved into sums where that saves operations at a point. It seldom does, so it is tried of
/// what is emitted and of what comes close to it, and not of all that is compared.
fn cheapest_of_all(graph: &Graph, components: &[Expr]) -> Way {
    let scopes = [Scope::Made, Scope::Needed];
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

fn cost_of((flat, roots): &Way) -> Cost {
    let mut builder = Builder::default();
    builder.lower(flat, roots);
    cost_in(&builder)
}

/// The stages of what is done at every point.
const AT_POINTS: [Stage; 2] = [Stage::Point, Stage::PointTime];

/// What all that was lowered costs.
fn cost_in(builder: &Builder) -> Cost {
    Cost {
        per_point: counted(builder, &AT_POINTS),
        total: counted(builder, &Stage::ALL),
        late: counted(builder, &[Stage::PointTime]),
    }
}

/// How many operations of these stages were lowered.
fn counted(builder: &Builder, stages: &[Stage]) -> usize {
    let instrs = builder.instrs.iter();
    instrs.filter(|instr| instr.op.is_counted() && stages.contains(&instr.stage)).count()
}

/// Drops what no output needs, and sorts by stage; within a stage the order stays.
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
