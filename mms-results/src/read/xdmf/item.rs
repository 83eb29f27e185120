//! Numbers of an element: in its text, or in a file beside it.

use std::rc::Rc;

use roxmltree::Node;

use super::super::hdf5;
use super::super::numbers::{ByteOrder, NumberType, count};
use super::super::text::{Style, number};
use super::super::xml::at;
use super::{Reader, said};
use crate::{Array, Mistake, Stored};

/// A file with numbers.
pub enum Heavy<'a> {
    Tree(hdf5::File<'a>),
    Raw(Vec<u8>),
}

impl<'a, 'b, 'c> Reader<'a, 'b, 'c> {
    /// The numbers of an element.
    pub fn item(&self, node: Node<'b, 'c>, name: &str) -> Result<Array, Mistake> {
        let node = match node.attribute("Reference") {
            None => node,
            Some(path) => {
                let path = if path == "XML" { node.text().unwrap_or("").trim() } else { path };
                let found = self.pointed(node, path)?.into_iter().next();
                let found = found.filter(|it| !it.has_attribute("Reference"));
                found.ok_or_else(|| at(node, format!("`{path}` points to no `<DataItem>`")))?
            }
        };
        let kind = said(node, ["ItemType"; 2], "uniform");
        if kind != "uniform" {
            let what = format!(
                "`{name}`: a `<DataItem>` `{kind}` is not read: write the numbers themselves"
            );
            return Err(at(node, what));
        }
        let found = self.numbers(node, name);
        found.map_err(|mistake| match mistake.line {
            None => at(node, format!("`{name}`: {}", mistake.what)),
            Some(_) => mistake,
        })
    }

    fn numbers(&self, node: Node<'b, 'c>, name: &str) -> Result<Array, Mistake> {
        let kind = kind(node)?;
        let shape = node.attribute("Dimensions").unwrap_or("");
        let axis = |it: &str| it.parse::<usize>().ok();
        let axes: Option<Vec<usize>> = shape.split_ascii_whitespace().map(axis).collect();
        let numbers =
            axes.and_then(|all| all.iter().try_fold(1, |all, it| count(all, *it, kind).ok()));
        let numbers = numbers
            .ok_or_else(|| Mistake::new(format!("Dimensions `{shape}`: expected lengths")))?;
        let text = node.text().unwrap_or("").trim();
        let take = |numbers: usize| self.wanted.reserve(&format!("`{name}`"), numbers);
        let array = |values, stored| Array {
            name: name.to_owned(),
            components: 1,
            values,
            stored,
            ..Array::default()
        };
        let found = match said(node, ["Format"; 2], "xml").as_str() {
            "xml" => {
                take(numbers.min(text.len() / 2))?;
                let mut style = Style::default();
                let value = |text: &str| {
                    style.see(text);
                    number(text)
                        .ok_or_else(|| Mistake::new(format!("expected a number, found `{text}`")))
                };
                let values =
                    text.split_ascii_whitespace().map(value).collect::<Result<Vec<_>, _>>()?;
                let is_whole = kind.stored() == Stored::Whole;
                array(values, if is_whole { Stored::Whole } else { style.stored() })
            }
            "hdf" => {
                let (file, path) = text
                    .split_once(':')
                    .ok_or_else(|| Mistake::new(format!("`{text}`: expected FILE:/PATH")))?;
                match &*self.file(file, true)? {
                    Heavy::Tree(tree) => Array { name: name.to_owned(), ..tree.at(path)? },
                    Heavy::Raw(_) => return Err(Mistake::new("expected HDF5")),
                }
            }
            "binary" => {
                let order = match said(node, ["Endian"; 2], "native").as_str() {
                    "big" => ByteOrder::Big,
                    _ => ByteOrder::Little,
                };
                if !["", "raw"].contains(&&*said(node, ["Compression"; 2], "")) {
                    return Err(Mistake::new(
                        "compressed numbers are not read: write them as they are",
                    ));
                }
                let seek = node.attribute("Seek").unwrap_or("0").trim();
                let seek: usize = seek
                    .parse()
                    .map_err(|_| Mistake::new(format!("Seek `{seek}`: expected a place")))?;
                let file = self.file(text, false)?;
                let Heavy::Raw(bytes) = &*file else {
                    return Err(Mistake::new("expected numbers alone"));
                };
                let own = bytes.get(seek..).and_then(|it| it.get(..numbers * kind.bytes()));
                let own =
                    own.ok_or_else(|| Mistake::new(format!("the file `{text}` ends before")))?;
                take(numbers)?;
                array(kind.read(own, order), kind.stored())
            }
            other => {
                return Err(Mistake::new(format!("Format `{other}`: expected XML, HDF or Binary")));
            }
        };
        match found.values.len() == numbers {
            true => Ok(found),
            false => Err(Mistake::new(format!(
                "{} numbers, and its Dimensions `{shape}` are {numbers}",
                found.values.len()
            ))),
        }
    }

    /// Opens a file beside this one, once. Its bytes stay in memory.
    fn file(&self, name: &str, is_tree: bool) -> Result<Rc<Heavy<'a>>, Mistake> {
        let key = format!("{is_tree}{name}");
        if let Some(known) = self.files.borrow().get(&key) {
            return Ok(known.clone());
        }
        let bytes = (self.beside)(name)?;
        self.wanted.reserve(&format!("the file `{name}`"), bytes.len() / 8)?;
        let heavy = Rc::new(match is_tree {
            true => Heavy::Tree(hdf5::File::open(bytes, self.wanted)?),
            false => Heavy::Raw(bytes),
        });
        self.files.borrow_mut().insert(key, heavy.clone());
        Ok(heavy)
    }
}

/// The type of numbers that an element declares.
fn kind(node: Node<'_, '_>) -> Result<NumberType, Mistake> {
    let name = said(node, ["NumberType", "DataType"], "float");
    let precision = node.attribute("Precision").unwrap_or("4");
    let bytes = precision.trim().parse().ok().filter(|it| [1, 2, 4, 8].contains(it));
    let found = bytes.and_then(|bytes| match name.as_str() {
        "float" if bytes >= 4 => Some(NumberType::Float(bytes)),
        "int" => Some(NumberType::Signed(bytes)),
        "uint" => Some(NumberType::Unsigned(bytes)),
        "char" => Some(NumberType::Signed(1)),
        "uchar" => Some(NumberType::Unsigned(1)),
        _ => None,
    });
    found.ok_or_else(|| {
        Mistake::new(format!(
            "numbers of type `{name}` and precision {precision}: expected Float or Int of 4 or 8"
        ))
    })
}
