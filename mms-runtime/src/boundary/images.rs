//! Nodes beyond a face, and the nodes inside that they repeat.

use crate::nodal::Nodal;
use crate::real::Real;

/// Pairs of a node outside and one inside, in layers from the face outward.
///
/// A grid extends for as many layers as any particle might need; mass is seldom in more than the first. The images skip layers
/// beyond the last one with mass: no particle reads them. They use whole layers, because a node beyond two faces is folded to a
/// node that is still beyond the second face, and that node may have had no mass before.
pub struct Images {
    pairs: Vec<(usize, usize)>,
    /// The number of pairs up to each layer.
    layers: Vec<usize>,
    /// The number of pairs in the layers up to the last one with mass.
    reached: usize,
}

impl Images {
    /// Pairs of nodes, each with the number of its layer, counted from 0.
    pub fn new(pairs: impl IntoIterator<Item = (usize, (usize, usize))>) -> Self {
        let mut layered: Vec<Vec<(usize, usize)>> = Vec::new();
        for (layer, pair) in pairs {
            layered.resize_with(layered.len().max(layer + 1), Vec::new);
            layered[layer].push(pair);
        }
        let layers = layered.iter().scan(0, |sum, layer| {
            *sum += layer.len();
            Some(*sum)
        });
        Self { layers: layers.collect(), pairs: layered.concat(), reached: 0 }
    }

    /// Finds the layers with mass. To be called before any is folded.
    pub fn reach<T: Real>(&mut self, momentum: &[Nodal<T>]) {
        let heavy = |pair: &(usize, usize)| momentum[pair.0].last() != T::zero();
        let last = self.pairs.iter().rposition(heavy);
        self.reached = last.map_or(0, |last| {
            let layer = self.layers.partition_point(|&end| end <= last);
            self.layers[layer]
        });
    }

    /// q_inside += the image of q_outside; empties the nodes outside.
    pub fn fold<T: Real>(&self, extensive: &mut [Nodal<T>], image: impl Fn(Nodal<T>) -> Nodal<T>) {
        for &(outside, inside) in &self.pairs[..self.reached] {
            let folded = std::mem::replace(&mut extensive[outside], Nodal::zero());
            extensive[inside] += image(folded);
        }
    }

    /// q_outside = the image of q_inside.
    pub fn copy<T: Real>(&self, intensive: &mut [Nodal<T>], image: impl Fn(Nodal<T>) -> Nodal<T>) {
        for &(outside, inside) in &self.pairs[..self.reached] {
            intensive[outside] = image(intensive[inside]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Images, Nodal};

    #[test]
    fn layers_are_taken_up_to_the_last_one_with_mass() {
        // Two layers beyond node 2, two nodes wide; inside are 10 and more.
        let mut images = Images::new([(1, (0, 10)), (0, (1, 11)), (0, (4, 14)), (1, (3, 13))]);
        let mass = |mass: f64| Nodal([0.0, 0.0, 0.0, mass]);
        for (heavy, reached) in [(None, 0), (Some(1), 2), (Some(4), 2), (Some(3), 4), (Some(0), 4)]
        {
            let mut nodes = [mass(0.0); 20];
            if let Some(node) = heavy {
                nodes[node] = mass(1.0);
            }
            images.reach(&nodes);
            assert_eq!(images.reached, reached, "{heavy:?}");
            images.fold(&mut nodes, |node| node);
            let folded = nodes.iter().position(|node| node.last() == 1.0);
            assert_eq!(folded, heavy.map(|node| node + 10));
            images.copy(&mut nodes, |node| node * 2.0);
            assert!(heavy.is_none_or(|node| nodes[node].last() == 2.0));
        }
    }
}
