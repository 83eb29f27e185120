//! Support texts: functions that a language lacks, written in the language. Only the called ones are emitted.
//!
//! The printer records the functions that the code of a field calls (`Calls`). The calls inside a support text are read
//! from the text, which is ours and the same for every field.

use mms_symbolic::sorted::SortedSet;

/// The names that printed code calls.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Calls(SortedSet<String>);

impl Calls {
    /// Records a name, and returns it to be printed.
    pub fn to<'a>(&mut self, name: &'a str) -> &'a str {
        self.0.insert(name.into());
        name
    }

    /// Records the calls of other code.
    pub fn extend(&mut self, other: &Calls) {
        self.0.extend(other.0.iter().cloned());
    }

    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

/// The parts of a support text: blocks separated by a blank line, or by two where the language separates definitions by
/// two. Each block defines one name.
pub struct Support {
    blocks: Vec<(String, &'static str)>,
}

impl Support {
    /// Splits a text into blocks. Leaves out a block that defines no name: it only makes the file complete on its own.
    /// `comment` lists the beginnings of comment lines.
    pub fn new(text: &'static str, comment: &[&str]) -> Self {
        let between = if text.contains("\n\n\n") { "\n\n\n" } else { "\n\n" };
        let blocks = text.split(between).map(|block| block.trim_matches('\n'));
        let blocks = blocks.filter_map(|block| Some((defined(block, comment)?, block))).collect();
        Support { blocks }
    }

    /// The blocks that are called, and the blocks that they call, in their order.
    pub fn needed(&self, calls: &Calls) -> Vec<&'static str> {
        let mut needed = vec![false; self.blocks.len()];
        let mut open: Vec<&str> = calls.names().collect();
        while let Some(called) = open.pop() {
            for (index, (name, block)) in self.blocks.iter().enumerate() {
                if name == called && !std::mem::replace(&mut needed[index], true) {
                    open.extend(names_in(block));
                }
            }
        }
        let blocks = self.blocks.iter().zip(needed);
        blocks.filter(|(_, needed)| *needed).map(|((_, block), _)| *block).collect()
    }

    /// Whether a block defines one of the names.
    pub fn defines_any(&self, calls: &Calls) -> bool {
        calls.names().any(|called| self.blocks.iter().any(|(name, _)| name == called))
    }
}

/// The name that a block defines: the word before the first bracket or equals sign of its first line that is not a comment.
fn defined(block: &str, comment: &[&str]) -> Option<String> {
    let is_comment = |line: &&str| comment.iter().any(|start| line.trim_start().starts_with(start));
    let line = block.lines().find(|line| !is_comment(line) && !line.trim().is_empty())?;
    let line = line.split_once(" :: ").map_or(line, |(_, rest)| rest);
    // `function result = name(arguments)` names its result first.
    let rest = line.strip_prefix("function ").and_then(|rest| rest.split_once(" = "));
    let line = rest.map_or(line, |(_, rest)| rest);
    let before = line.split_once(['(', '[', '=', ':', '{'])?.0;
    words(before).last().map(String::from)
}

/// The names in a block, without the names of members.
pub fn names_in(block: &str) -> impl Iterator<Item = &str> {
    words(block).filter(|word| {
        let before = &block[..word.as_ptr() as usize - block.as_ptr() as usize];
        !(before.ends_with('.') || before.ends_with("->") || before.ends_with('%'))
    })
}

/// The words of a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_called_is_emitted_with_what_it_calls() {
        let text = "#include <math.h>\n\n/* One. */\nstatic double one(void)\n{\n    return 1;\n}\n\n\
                    static double two(void)\n{\n    return one() + one();\n}\n\nstatic int other[3] = {0};\n";
        let support = Support::new(text, &["/*", "#"]);
        let needed = |name: &str| {
            let mut calls = Calls::default();
            assert_eq!(calls.to(name), name);
            assert_eq!(support.defines_any(&calls), !support.needed(&calls).is_empty(), "{name}");
            support.needed(&calls).len()
        };
        assert_eq!(["two", "one", "other", "twofold", "return"].map(needed), [2, 1, 1, 0, 0]);
        let read: Vec<&str> = names_in("x = p.one + p->two + p%other").collect();
        assert_eq!(read, ["x", "p", "p", "p"]);
    }
}
