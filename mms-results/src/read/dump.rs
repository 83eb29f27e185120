//! Dumps of particles as LAMMPS and Karamelo write them: blocks of `ITEM:` sections, one block for each time
//! (<https://docs.lammps.org/dump.html>).

use super::table::block;
use super::text::{Style, number};
use crate::wanted::Wanted;
use crate::{Mistake, Snapshot, Time};

/// The beginning of a section.
pub const MARK: &[u8] = b"ITEM:";

/// The lines of a file, with their numbers.
type Lines<'a> = dyn Iterator<Item = (usize, &'a str)> + 'a;

/// Reads all blocks. The number of a step is no time: only `ITEM: TIME` gives one.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + memchr::memchr_iter(b'\n', &bytes[..error.valid_up_to()]).count();
        Mistake::at(
            line,
            "expected a dump in text; a binary one is written by `dump_modify` of another style",
        )
    })?;
    let mut lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim()));
    let (mut found, mut time, mut count) = (Vec::new(), None, None);
    while let Some((at, line)) = lines.next() {
        let Some(item) = line.strip_prefix("ITEM:").map(str::trim) else {
            if line.is_empty() {
                continue;
            }
            return Err(Mistake::at(at, format!("expected `ITEM:`, found `{line}`")));
        };
        match item.split_once(char::is_whitespace).unwrap_or((item, "")) {
            ("TIME", _) => time = Some(moment(at, &mut lines)?),
            ("NUMBER", _) => count = Some(whole(at, &mut lines)?),
            ("ATOMS" | "ENTRIES", names) => {
                let count = count.take().ok_or_else(|| {
                    Mistake::at(at, "expected `ITEM: NUMBER OF ATOMS` before the particles")
                })?;
                let snapshot = particles((at, names), count, &mut lines, wanted)?;
                found.push(Snapshot { time: time.take(), ..snapshot });
            }
            ("TIMESTEP" | "UNITS", _) => drop(lines.next()),
            ("BOX", _) => drop(lines.by_ref().take(3).count()),
            _ => return Err(Mistake::at(at, format!("`ITEM: {item}` is not known"))),
        }
    }
    if found.is_empty() {
        return Err(Mistake::new("a dump without `ITEM: ATOMS`: it holds no particles"));
    }
    Ok(found)
}

/// Reads the particles below a line of names.
fn particles(
    (at, names): (usize, &str),
    count: usize,
    lines: &mut Lines<'_>,
    wanted: &Wanted<'_>,
) -> Result<Snapshot, Mistake> {
    let rows: Vec<(usize, &str)> = lines.take(count).collect();
    let is_cut = rows.len() < count;
    if let Some((line, _)) = rows.iter().find(|(_, row)| row.starts_with("ITEM:")) {
        let what = format!("expected {count} particles before the next `ITEM:`");
        return Err(Mistake::at(*line, what));
    }
    if is_cut {
        let what =
            format!("the dump ends after {} of {count} particles: was it cut off?", rows.len());
        return Err(Mistake::at(at + rows.len(), what));
    }
    block((at, names), &rows, wanted)
}

fn next<'a>(at: usize, lines: &mut Lines<'a>) -> Result<(usize, &'a str), Mistake> {
    lines.next().ok_or_else(|| Mistake::at(at, "the dump ends here: was it cut off?"))
}

fn moment(at: usize, lines: &mut Lines<'_>) -> Result<Time, Mistake> {
    let (at, text) = next(at, lines)?;
    let expected = || Mistake::at(at, format!("expected a time, found `{text}`"));
    let value = number(text).filter(|it| it.is_finite()).ok_or_else(expected)?;
    let mut style = Style::default();
    style.see(text);
    Ok(Time { value, rounding: style.stored().rounding(value) })
}

fn whole(at: usize, lines: &mut Lines<'_>) -> Result<usize, Mistake> {
    let (at, text) = next(at, lines)?;
    let expected =
        || Mistake::at(at, format!("expected how many particles there are, found `{text}`"));
    text.parse().map_err(|_| expected())
}
