//! Files in the classic format of netCDF, in its three versions ("The NetCDF Classic Format Specification", Unidata).

use crate::{Set, Storage, Type, Value, letters};

/// The largest number of dimensions, variables or attributes of a list.
const MOST: usize = 20_000;

/// The place of a variable's numbers.
struct Variable {
    name: String,
    axes: Vec<usize>,
    /// Whether each number of the first axis is in a separate record.
    is_record: bool,
    kind: Type,
    attributes: Vec<(String, Value)>,
    begin: u64,
}

/// A file in the classic format.
pub struct Classic {
    bytes: Vec<u8>,
    attributes: Vec<(String, Value)>,
    variables: Vec<Variable>,
    /// The number of bytes from a record to the next.
    stride: u64,
}

/// The header, from its front on.
struct Head<'a> {
    rest: &'a [u8],
    version: u8,
}

fn ends() -> String {
    "the file ends within its header: was it cut off?".into()
}

impl<'a> Head<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(ends)?;
        self.rest = rest;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u64, String> {
        let found: [u8; 4] = self.take(4)?.try_into().map_err(|_| ends())?;
        Ok(u64::from(u32::from_be_bytes(found)))
    }

    fn long(&mut self) -> Result<u64, String> {
        let found: [u8; 8] = self.take(8)?.try_into().map_err(|_| ends())?;
        Ok(u64::from_be_bytes(found))
    }

    /// A count or a length.
    fn count(&mut self) -> Result<usize, String> {
        let found = if self.version == 5 { self.long()? } else { self.word()? };
        usize::try_from(found).map_err(|_| "a count that no file has".into())
    }

    fn name(&mut self) -> Result<String, String> {
        let length = self.count()?;
        self.padded(length).map(|it| String::from_utf8_lossy(it).into_owned())
    }

    /// Reads `length` bytes, and skips the padding up to a multiple of 4.
    fn padded(&mut self, length: usize) -> Result<&'a [u8], String> {
        let found = self.take(length)?;
        self.take(length.wrapping_neg() % 4)?;
        Ok(found)
    }

    /// The number of members of a list that begins with this mark, or is absent.
    fn list(&mut self, mark: u64) -> Result<usize, String> {
        let (found, count) = (self.word()?, self.count()?);
        match (found, count) {
            (0, 0) => Ok(0),
            (found, count) if found == mark && count <= MOST => Ok(count),
            _ => Err("its header has a list that is none: the file is damaged".into()),
        }
    }

    fn kind(&mut self) -> Result<(Type, usize), String> {
        Ok(match self.word()? {
            1 => (Type::Signed(1), 1),
            2 => (Type::Words, 1),
            3 => (Type::Signed(2), 2),
            4 => (Type::Signed(4), 4),
            5 => (Type::Float(4), 4),
            6 => (Type::Float(8), 8),
            7 => (Type::Unsigned(1), 1),
            8 => (Type::Unsigned(2), 2),
            9 => (Type::Unsigned(4), 4),
            10 => (Type::Signed(8), 8),
            11 => (Type::Unsigned(8), 8),
            other => return Err(format!("no type of numbers: {other}")),
        })
    }

    fn attributes(&mut self) -> Result<Vec<(String, Value)>, String> {
        let mut all = Vec::new();
        for _ in 0..self.list(0x0c)? {
            let (name, (kind, size), count) = (self.name()?, self.kind()?, self.count()?);
            let bytes = self.padded(count.checked_mul(size).ok_or_else(ends)?)?;
            let value = match kind {
                Type::Words => Value::Words(letters(bytes, bytes.len())),
                kind => Value::Numbers(kind, true, bytes.to_vec()),
            };
            all.push((name, value));
        }
        Ok(all)
    }
}

/// The number of values of an array with these axes.
fn count(axes: &[usize]) -> Option<u64> {
    axes.iter().try_fold(1, |all: u64, &axis| all.checked_mul(axis as u64))
}

impl Variable {
    fn size(&self) -> u64 {
        self.kind.bytes().unwrap_or(1) as u64
    }

    /// The number of bytes of the variable in one record, or in the file.
    fn slab(&self) -> Option<u64> {
        count(&self.axes[usize::from(self.is_record)..])?.checked_mul(self.size())
    }
}

impl Classic {
    /// Reads the header.
    pub fn open(bytes: Vec<u8>) -> Result<Classic, String> {
        let version = bytes.get(3).copied().unwrap_or(0);
        if !matches!(version, 1 | 2 | 5) {
            return Err(format!("version {version} of netCDF: expected 1, 2 or 5"));
        }
        let mut head = Head { rest: bytes.get(4..).unwrap_or_default(), version };
        let records = if version == 5 { head.long()? } else { head.word()? };
        let is_open = records == if version == 5 { u64::MAX } else { u64::from(u32::MAX) };
        let mut dimensions = Vec::new();
        for _ in 0..head.list(0x0a)? {
            head.name()?;
            dimensions.push(head.count()?);
        }
        let attributes = head.attributes()?;
        let mut variables = Vec::new();
        for _ in 0..head.list(0x0b)? {
            let (name, rank) = (head.name()?, head.count()?);
            let (mut axes, mut is_record) = (Vec::new(), false);
            for at in 0..rank {
                let axis = head.count()?;
                let length = dimensions.get(axis).copied();
                let length = length.ok_or_else(|| format!("`{name}`: no dimension {axis}"))?;
                is_record |= at == 0 && length == 0;
                axes.push(length);
            }
            let (attributes, (kind, _)) = (head.attributes()?, head.kind()?);
            head.count()?;
            let begin = if version == 1 { head.word()? } else { head.long()? };
            variables.push(Variable { name, axes, is_record, kind, attributes, begin });
        }
        let mut classic = Classic { bytes, attributes, variables, stride: 0 };
        classic.count_records(if is_open { None } else { Some(records) })?;
        Ok(classic)
    }

    /// Sets the first axis of record variables. A file that is still being written does not contain the number of records.
    fn count_records(&mut self, records: Option<u64>) -> Result<(), String> {
        let damaged = || String::from("its records are longer than any: the file is damaged");
        let of_records = || self.variables.iter().filter(|it| it.is_record);
        let is_only = of_records().count() == 1;
        let pad = |slab: u64| if is_only { Some(slab) } else { slab.checked_next_multiple_of(4) };
        let slabs = of_records().map(|it| pad(it.slab()?));
        let sum = slabs
            .map(|it| it.ok_or_else(damaged))
            .try_fold(0, |all: u64, it| all.checked_add(it?).ok_or_else(damaged))?;
        let first = of_records().map(|it| it.begin).min().unwrap_or(0);
        let there = (self.bytes.len() as u64).saturating_sub(first) / sum.max(1);
        let records = usize::try_from(records.unwrap_or(there)).map_err(|_| damaged())?;
        self.stride = sum;
        for variable in self.variables.iter_mut().filter(|it| it.is_record) {
            variable.axes[0] = records;
        }
        Ok(())
    }

    fn set_at(&self, at: usize) -> Set {
        let Variable { name, axes, kind, .. } = &self.variables[at];
        let (path, shape) = (name.clone(), axes.clone());
        Set { path, shape, kind: *kind, is_big: true, place: Storage::Classic(at) }
    }

    pub fn sets(&self) -> Vec<Set> {
        (0..self.variables.len()).map(|at| self.set_at(at)).collect()
    }

    pub fn set(&self, path: &str) -> Option<Set> {
        let at = self.variables.iter().position(|it| it.name == path)?;
        Some(self.set_at(at))
    }

    pub fn attribute(&self, path: &str, name: &str) -> Option<Value> {
        let all = match path {
            "" => &self.attributes,
            path => &self.variables.iter().find(|it| it.name == path)?.attributes,
        };
        let (_, found) = all.iter().find(|(it, _)| it == name)?;
        Some(match found {
            Value::Words(words) => Value::Words(words.clone()),
            Value::Numbers(kind, is_big, bytes) => Value::Numbers(*kind, *is_big, bytes.clone()),
        })
    }

    /// The bytes of a variable; `needed` is their number.
    pub fn bytes(&self, at: usize, needed: usize) -> Result<Vec<u8>, String> {
        let ends = || String::from("its numbers end with the file: was it cut off?");
        let variable = &self.variables[at];
        let slab = variable.slab().and_then(|it| usize::try_from(it).ok()).ok_or_else(ends)?;
        if needed > self.bytes.len() {
            return Err(ends());
        }
        let part = |record: u64| {
            let start = record.checked_mul(self.stride)?.checked_add(variable.begin)?;
            let start = usize::try_from(start).ok()?;
            self.bytes.get(start..start.checked_add(slab)?)
        };
        if !variable.is_record {
            return part(0).map(<[u8]>::to_vec).ok_or_else(ends);
        }
        let mut all = Vec::with_capacity(needed);
        for record in 0..variable.axes[0] as u64 {
            all.extend(part(record).filter(|it| !it.is_empty()).ok_or_else(ends)?);
        }
        Ok(all)
    }
}
