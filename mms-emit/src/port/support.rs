//! The text that a language lacks: functions in its own words, of which only those are emitted that
//! are called.

/// The parts of a support text: blocks between blank lines, two where the language leaves two, each the
/// definition of one name.
pub struct Support {
    blocks: Vec<(String, &'static str)>,
}

impl Support {
    /// The blocks of a text. One that defines no name is left out: it makes the file stand alone.
    /// `comment` is what a line of a comment begins with.
    pub fn new(text: &'static str, comment: &[&str]) -> Self {
        let between = if text.contains("\n\n\n") { "\n\n\n" } else { "\n\n" };
        let blocks = text.split(between).map(|block| block.trim_matches('\n'));
        let blocks = blocks.filter_map(|block| Some((defined(block, comment)?, block))).collect();
        Support { blocks }
    }

    /// The blocks that a text refers to, and those that they refer to, in their order.
    pub fn needed(&self, text: &str) -> Vec<&'static str> {
        let mut needed = vec![false; self.blocks.len()];
        let mut open = vec![text];
        while let Some(text) = open.pop() {
            for (index, (name, block)) in self.blocks.iter().enumerate() {
                if !needed[index] && called(text).any(|word| word == name) {
                    needed[index] = true;
                    open.push(block);
                }
            }
        }
        let blocks = self.blocks.iter().zip(needed);
        blocks.filter(|(_, needed)| *needed).map(|((_, block), _)| *block).collect()
    }
}

/// The name that a block defines: that before the first bracket or equals sign of its first line that
/// is no comment.
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

/// The names in a text but for those of members: they are a user's.
fn called(text: &str) -> impl Iterator<Item = &str> {
    words(text).filter(|word| {
        let before = &text[..word.as_ptr() as usize - text.as_ptr() as usize];
        !(before.ends_with('.') || before.ends_with("->") || before.ends_with('%'))
    })
}

/// The names in a text.
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
        assert_eq!(support.needed("x = two();").len(), 2);
        assert_eq!(support.needed("x = one();").len(), 1);
        assert_eq!(support.needed("other[0]").len(), 1);
        for other in ["x = twofold();", "p.one", "p->one", "p%one"] {
            assert!(support.needed(other).is_empty(), "{other}");
        }
    }
}
