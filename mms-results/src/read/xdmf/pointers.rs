//! Paths in XML and the elements that they select: the paths that programs write, of "XML Path Language" (W3C).

use roxmltree::Node;

use super::super::xml::at;
use super::{Reader, is};
use crate::Mistake;

/// The most different pointers of a file, since each needs a search of the whole file.
const MOST_POINTERS: usize = 200;

impl<'b, 'c> Reader<'_, 'b, 'c> {
    /// The elements that a path selects, from the root on.
    pub fn pointed(&self, from: Node<'b, 'c>, path: &'b str) -> Result<Vec<Node<'b, 'c>>, Mistake> {
        if let Some(known) = self.pointed.borrow().get(path) {
            return Ok(known.clone());
        }
        if self.pointed.borrow().len() >= MOST_POINTERS {
            return Err(at(from, format!("more than {MOST_POINTERS} different pointers")));
        }
        let mut found = vec![self.root.document().root()];
        let (mut rest, mut is_anywhere) = (path, false);
        while !rest.is_empty() {
            let Some(step) = rest.strip_prefix('/') else { return Ok(Vec::new()) };
            if let Some(after) = step.strip_prefix('/') {
                (is_anywhere, rest) = (true, &rest[1..]);
                found = if after.is_empty() { Vec::new() } else { found };
                continue;
            }
            // A name or `*`, and conditions in brackets, in which there may be a slash.
            let mut depth = 0;
            let end = step.find(|it| {
                depth += i32::from(it == '[') - i32::from(it == ']');
                it == '/' && depth == 0
            });
            let (step, after) = step.split_at(end.unwrap_or(step.len()));
            let mut next = Vec::new();
            for node in found {
                let inner: Vec<_> = match is_anywhere {
                    true => node.descendants().skip(1).filter(|it| fits(it, step)).collect(),
                    false => node.children().filter(|it| fits(it, step)).collect(),
                };
                match position(step) {
                    Some(position) => next.extend(inner.get(position.wrapping_sub(1))),
                    None => next.extend(inner),
                }
            }
            (found, rest, is_anywhere) = (next, after, false);
        }
        self.pointed.borrow_mut().insert(path, found.clone());
        Ok(found)
    }
}

/// Whether a node satisfies a step of a path: a name, or one of those in brackets, with the attributes in brackets.
fn fits(node: &Node<'_, '_>, step: &str) -> bool {
    let (name, rest) = step.split_at(step.find('[').unwrap_or(step.len()));
    let conditions = rest.split(['[', ']']).filter(|it| !it.is_empty());
    let holds = |condition: &str| match condition.strip_prefix('@') {
        Some(condition) => condition.split_once('=').is_some_and(|(name, value)| {
            node.attribute(name.trim()) == Some(value.trim().trim_matches(['"', '\'']))
        }),
        None if condition.starts_with("self::") => condition
            .split(" or ")
            .any(|it| it.trim().strip_prefix("self::") == Some(node.tag_name().name())),
        None => condition.parse::<usize>().is_ok(),
    };
    node.is_element() && (name == "*" || is(node, name)) && conditions.into_iter().all(holds)
}

/// The position in a step of a path, from 1 on.
fn position(step: &str) -> Option<usize> {
    step.split(['[', ']']).find_map(|it| it.parse().ok())
}
