//! Compressed and damaged files: only the needed and declared bytes are unpacked, within the memory limit.

use allocation_counter::measure;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::{compress_to_vec, compress_to_vec_zlib};
use mms_results::names::{KNOWN, Role, everything, recognise, wanted};
use mms_results::wanted::Wanted;
use mms_results::{Contents, Mistake, Snapshot, parse};
use proptest::prelude::*;
use rawzip::crc32;

const MEGABYTE: usize = 1 << 20;

fn one(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    match parse(bytes, wanted)? {
        Contents::Snapshots(mut found) => Ok(found.remove(0)),
        other => panic!("{other:?}"),
    }
}

/// The message of a file that is refused using little memory.
#[track_caller]
fn refused_cheaply(bytes: &[u8], wanted: &Wanted<'_>) -> String {
    let mut said = String::new();
    let most = MEGABYTE / 2 + 4 * bytes.len();
    let taken = measure(|| said = one(bytes, wanted).unwrap_err().what).bytes_max as usize;
    assert!(taken < most, "{taken} bytes for {}: {said}", bytes.len());
    said
}

/// A NumPy array of this shape, followed by this many bytes of 0.
fn npy(shape: &str, bytes: usize) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut all = b"\x93NUMPY\x01\x00".to_vec();
    all.extend((header.len() as u16).to_le_bytes());
    all.extend(header.as_bytes());
    all.resize(all.len() + bytes, 0);
    all
}

/// An array in an archive: its name, its bytes, and their claimed number and checksum.
struct Entry<'a> {
    name: &'a str,
    bytes: &'a [u8],
    length: usize,
    crc: u32,
}

impl<'a> Entry<'a> {
    fn honest(name: &'a str, bytes: &'a [u8]) -> Self {
        Entry { name, bytes, length: bytes.len(), crc: crc32(bytes) }
    }
}

/// An archive in deflate, by APPNOTE.TXT of PKWARE, sections 4.3.7, 4.3.12 and 4.3.16.
fn npz(entries: &[Entry<'_>]) -> Vec<u8> {
    let (mut all, mut directory) = (Vec::new(), Vec::new());
    for Entry { name, bytes, length, crc } in entries {
        let packed = compress_to_vec(bytes, 6);
        let name = format!("{name}.npy");
        let mut common = vec![20, 0, 0, 0, 8, 0, 0, 0, 0, 0];
        common.extend(crc.to_le_bytes());
        common.extend((packed.len() as u32).to_le_bytes());
        common.extend((*length as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        common.extend([0; 2]);
        let place = all.len() as u32;
        directory.extend([&b"PK\x01\x02\x14\x00"[..], &common, &[0; 10]].concat());
        directory.extend(place.to_le_bytes());
        directory.extend(name.as_bytes());
        all.extend([&b"PK\x03\x04"[..], &common, name.as_bytes(), &packed].concat());
    }
    let (start, count) = (all.len() as u32, (entries.len() as u16).to_le_bytes());
    all.extend(&directory);
    all.extend([&b"PK\x05\x06\0\0\0\0"[..], &count, &count].concat());
    all.extend((directory.len() as u32).to_le_bytes());
    all.extend(start.to_le_bytes());
    all.extend([0; 2]);
    all
}

/// An archive of named arrays.
pub fn archive(arrays: &[(&str, &[u8])]) -> Vec<u8> {
    npz(&arrays.iter().map(|(name, bytes)| Entry::honest(name, bytes)).collect::<Vec<_>>())
}

#[test]
fn an_archive_is_held_to_its_checksums() {
    let u = npy("(2,)", 16);
    let said =
        |entry: Entry<'_>| one(&npz(&[entry]), &everything(&KNOWN)).map(|it| it.of_points.len());
    assert_eq!(said(Entry::honest("u", &u)), Ok(1));
    let damaged = said(Entry { crc: crc32(&u) ^ 1, ..Entry::honest("u", &u) }).unwrap_err().what;
    assert!(damaged.starts_with("`u`: its checksum (CRC-32) is another"), "{damaged}");
    // A stored array with one changed bit.
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/numpy.npz");
    let mut bytes = std::fs::read(path).unwrap();
    assert!(one(&bytes, &everything(&KNOWN)).is_ok());
    let number = 0.5_f64.to_le_bytes();
    let at = bytes.windows(8).position(|it| it == number).unwrap();
    bytes[at] ^= 1;
    assert!(one(&bytes, &everything(&KNOWN)).unwrap_err().what.contains("checksum"));
}

#[test]
fn an_archive_unpacks_what_is_needed_and_declared() {
    let bomb = npy("(2,)", 16 * MEGABYTE);
    let said = refused_cheaply(&npz(&[Entry::honest("u", &bomb)]), &everything(&KNOWN));
    assert!(said.contains("and its shape needs"), "{said}");
    let claimed = Entry { length: npy("(2,)", 16).len(), ..Entry::honest("u", &bomb) };
    let said = refused_cheaply(&npz(&[claimed]), &everything(&KNOWN));
    assert!(said.contains("not what its header says"), "{said}");
    let honest = npy("(2097152,)", 16 * MEGABYTE);
    let bytes = npz(&[Entry::honest("u", &honest), Entry::honest("junk", &bomb)]);
    let scarce = everything(&KNOWN).within(20 << 20, "do something");
    let said = refused_cheaply(&bytes, &scarce);
    assert_eq!(said, "`u` takes 34 MB of memory to read, and there are 20 MB: do something");
    let snapshot = one(&bytes, &wanted(&KNOWN, &|_| true).within(40 << 20, "")).unwrap();
    assert_eq!((snapshot.of_points.len(), snapshot.unread), (1, vec!["junk".to_owned()]));
}

/// Blocks of a megabyte of 0, in zlib, as VTK writes them.
fn blocks(count: u32) -> String {
    let packed = compress_to_vec_zlib(&vec![0; MEGABYTE], 6);
    let sizes = std::iter::repeat_n(packed.len() as u32, count as usize);
    let header: Vec<u8> =
        [count, MEGABYTE as u32, 0].into_iter().chain(sizes).flat_map(u32::to_le_bytes).collect();
    STANDARD.encode(header) + &STANDARD.encode(packed.repeat(count as usize))
}

/// A VTK file with these arrays: name, format, and content.
fn vtu(points: usize, arrays: &[(&str, &str, &str)]) -> Vec<u8> {
    let array = |(name, format, text): &(&str, &str, &str)| {
        format!("<DataArray type=\"Float64\" Name=\"{name}\" {format}>{text}</DataArray>")
    };
    let arrays: String = arrays.iter().map(array).collect();
    format!(
        "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece \
         NumberOfPoints=\"{points}\" NumberOfCells=\"0\"><PointData>{arrays}</PointData></Piece></UnstructuredGrid>"
    )
    .into_bytes()
}

#[test]
fn vtk_unpacks_what_is_needed_and_declared() {
    let packed = blocks(32);
    let end = b"</VTKFile>";
    let inline = |points: usize, name: &str| {
        [&vtu(points, &[(name, "format=\"binary\"", &packed)])[..], end].concat()
    };
    let said = refused_cheaply(&inline(1, "u"), &everything(&KNOWN));
    assert!(said.contains("`u`: 33554432 bytes of numbers, and expected 8"), "{said}");
    let said = refused_cheaply(&inline(4 << 20, "u"), &everything(&KNOWN).within(40 << 20, ""));
    assert!(said.contains("`u`: it takes 68 MB of memory"), "{said}");
    assert_eq!(one(&inline(1, "junk"), &wanted(&KNOWN, &|_| true)).unwrap().unread, ["junk"]);
    // Many arrays may share the appended bytes, but each needs its own memory.
    let at = "format=\"appended\" offset=\"0\"";
    let names: Vec<String> = (0..100).map(|at| format!("n{at}")).collect();
    let arrays: Vec<_> = names.iter().map(|name| (name.as_str(), at, "")).collect();
    let appended =
        format!("<AppendedData encoding=\"base64\">_{}</AppendedData></VTKFile>", blocks(1));
    let bytes = [vtu(131_072, &arrays), appended.into_bytes()].concat();
    let mut said = String::new();
    let scarce = everything(&KNOWN).within(4 << 20, "");
    let taken = measure(|| said = one(&bytes, &scarce).unwrap_err().what).bytes_max;
    assert!(said.contains("takes 3 MB of memory") && taken < 8 << 20, "{taken} bytes: {said}");
}

#[test]
fn a_block_of_vtk_is_held_to_its_checksum() {
    let mut packed = compress_to_vec_zlib(&1.5_f64.to_le_bytes(), 6);
    let read = |packed: &[u8]| {
        let header = [1, 8, 0, packed.len() as u32].map(u32::to_le_bytes).concat();
        let text = STANDARD.encode(header) + &STANDARD.encode(packed);
        let bytes = [&vtu(1, &[("u", "format=\"binary\"", &text)])[..], b"</VTKFile>"].concat();
        one(&bytes, &everything(&KNOWN)).map(|it| it.of_points[0].values.clone())
    };
    assert_eq!(read(&packed), Ok(vec![1.5]));
    *packed.last_mut().unwrap() ^= 1;
    assert!(read(&packed).unwrap_err().what.contains("not zlib"));
}

#[test]
fn words_in_an_array_of_a_known_name_are_refused() {
    let text = |name: &str| {
        let text = String::from_utf8(vtu(1, &[(name, "", "0")])).unwrap() + "</VTKFile>";
        text.replace("type=\"Float64\"", "type=\"String\"")
    };
    let read = |name: &str| one(text(name).as_bytes(), &everything(&KNOWN));
    assert_eq!(read("label").unwrap().unread, ["label"]);
    assert!(read("u").unwrap_err().what.contains("`u`: expected numbers, found words"));
}

/// Skipped arrays do not change the others, in any format.
#[test]
fn arrays_that_are_not_needed_are_passed_over() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
    let mut count = 0;
    let u = |role: Role| role == Role::Displacement;
    let folders = [folder.to_owned(), format!("{folder}/vtk_more")];
    for entry in folders.iter().flat_map(|it| std::fs::read_dir(it).unwrap()) {
        let path = entry.unwrap().path();
        let Ok(bytes) = std::fs::read(&path) else { continue };
        let Ok(Contents::Snapshots(all)) = parse(&bytes, &everything(&KNOWN)) else { continue };
        let few = one(&bytes, &wanted(&KNOWN, &u)).unwrap();
        let Ok([meaning]) = recognise(&all[0], &KNOWN, &u).map(<[_; 1]>::try_from).unwrap() else {
            continue;
        };
        let of_few = &recognise(&few, &KNOWN, &u).unwrap()[0];
        let dimension = meaning.dimension();
        let numbers = meaning.values(&all[0], dimension).unwrap().numbers;
        assert_eq!(of_few.values(&few, dimension).unwrap().numbers, numbers, "{}", path.display());
        assert_eq!((few.time, &few.cells), (all[0].time, &all[0].cells), "{}", path.display());
        assert!(few.unread.len() >= all[0].of_points.len() - few.of_points.len());
        count += 1;
    }
    assert!(count > 25, "{count} files");
}

proptest! {
    /// Arrays with changed bytes in an archive with matching checksums.
    #[test]
    fn archives_of_changed_arrays_are_survived(
        start in prop::sample::select(vec!["(2,)", "(2, 2)", "(0, 3)", "()", "(9999999999,)"]),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = npy(start, 32);
        for (at, byte) in flips {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        for name in ["u", "time", "junk"] {
            let archive = npz(&[Entry::honest(name, &bytes)]);
            let _ = one(&archive, &everything(&KNOWN));
            let _ = one(&archive, &wanted(&KNOWN, &|_| true).within(100, ""));
        }
    }
}
