//! Sorted maps and sets behave like the maps and sets of the standard library.

use std::collections::{BTreeMap, BTreeSet};

use mms_symbolic::sorted::{SortedMap, SortedSet};
use proptest::collection::vec;
use proptest::prelude::*;

proptest! {
    #[test]
    fn a_map_is_like_a_tree(steps in vec((0_u8..5, 0_u8..12, any::<u8>()), 0..60)) {
        let (mut map, mut tree) = (SortedMap::new(), BTreeMap::new());
        for (step, key, value) in steps {
            match step {
                0 => prop_assert_eq!(map.insert(key, value), tree.insert(key, value)),
                1 => prop_assert_eq!(map.remove(&key), tree.remove(&key)),
                2 => {
                    *map.get_or_insert_with(key, || value) ^= 1;
                    *tree.entry(key).or_insert(value) ^= 1;
                }
                3 => {
                    map.retain(|key, own| key % 3 > 0 || *own < value);
                    tree.retain(|key, own| key % 3 > 0 || *own < value);
                }
                _ => {
                    map.values_mut().for_each(|own| *own = own.wrapping_add(value));
                    tree.values_mut().for_each(|own| *own = own.wrapping_add(value));
                    prop_assert_eq!(map.get_mut(&key), tree.get_mut(&key));
                }
            }
            prop_assert_eq!(map.get(&key), tree.get(&key));
            prop_assert_eq!(map.contains_key(&key), tree.contains_key(&key));
            prop_assert_eq!(map.len(), tree.len());
            prop_assert!(map.iter().eq(&tree) && map.keys().eq(tree.keys()));
        }
        prop_assert_eq!(&map, &SortedMap::from_iter(tree.clone().into_iter().rev()));
        prop_assert_eq!(format!("{map:?}"), format!("{tree:?}"));
        prop_assert_eq!(map.pop_last(), tree.pop_last());
        prop_assert!(map.into_iter().eq(tree));
    }

    #[test]
    fn a_set_is_like_a_tree(steps in vec((0_u8..3, 0_u8..12), 0..60), others in vec(0_u8..12, 0..4)) {
        let (mut set, mut tree) = (SortedSet::new(), BTreeSet::new());
        let others = [SortedSet::from_iter(others.clone()), SortedSet::from([others.len() as u8])];
        for (step, element) in steps {
            match step {
                0 => prop_assert_eq!(set.insert(element), tree.insert(element)),
                1 => prop_assert_eq!(set.remove(&element), tree.remove(&element)),
                _ => {
                    set.retain(|own| own % 5 != element % 5);
                    tree.retain(|own| own % 5 != element % 5);
                }
            }
            prop_assert_eq!(set.contains(&element), tree.contains(&element));
            prop_assert!(set.iter().eq(&tree));
        }
        for other in others {
            let tree_of_other = BTreeSet::from_iter(other.iter().copied());
            prop_assert_eq!(set.is_disjoint(&other), tree.is_disjoint(&tree_of_other));
        }
        prop_assert_eq!(format!("{set:?}"), format!("{tree:?}"));
        prop_assert!(set.into_iter().eq(tree));
    }
}
