//! Peers in C: SymPy's common subexpressions, compiled by gcc. They are written and compiled again for
//! every run, and skipped with a message if Python, SymPy or gcc is missing.

use std::error::Error;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{COUNT, Case, Contender, Run};

/// The contender that ratios refer to.
pub const REFERENCE: &str = "SymPy cse, gcc -O3";

/// The peer compiled with options that make gcc use vector functions.
const VECTORISED: &str = "SymPy cse, gcc vectorised";

struct Peer {
    contender: &'static str,
    program: PathBuf,
    input: Vec<u8>,
    components: usize,
    seconds: Vec<f64>,
    results: Vec<Vec<f64>>,
    /// The folder of the program.
    _folder: std::rc::Rc<tempfile::TempDir>,
}

impl Contender for Peer {
    fn round(&mut self) -> Result<(), Box<dyn Error>> {
        let mut child =
            Command::new(&self.program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        // The program reads everything before it writes.
        child.stdin.take().ok_or("no pipe")?.write_all(&self.input)?;
        let mut output = Vec::new();
        child.stdout.take().ok_or("no pipe")?.read_to_end(&mut output)?;
        if !child.wait()?.success() {
            return Err(format!("{} failed", self.program.display()).into());
        }
        let numbers: Vec<f64> = output
            .chunks_exact(8)
            .map(|bytes| f64::from_ne_bytes(bytes.try_into().expect("eight bytes")))
            .collect();
        self.seconds.push(numbers[0]);
        self.results = numbers[1..].chunks_exact(COUNT).map(<[f64]>::to_vec).collect();
        assert_eq!(self.results.len(), self.components);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Run {
        Run {
            contender: self.contender,
            precision: "f64",
            mode: "scalar",
            seconds: self.seconds,
            slots: None,
            results: self.results,
        }
    }
}

/// Both peers, if Python, SymPy and gcc are installed.
pub fn contenders(case: &Case) -> Result<Vec<Box<dyn Contender>>, Box<dyn Error>> {
    let folder = std::rc::Rc::new(tempfile::tempdir()?);
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/forcing/peers");
    let python = std::env::var_os("MMS_PYTHON").unwrap_or_else(|| "python3".into());
    let written =
        Command::new(&python).arg(sources.join("sympy_cse.py")).arg(folder.path()).output();
    if let Some(why) = failure(written) {
        eprintln!("{}: skipped the peers, which need Python with SymPy: {why}", case.name);
        return Ok(Vec::new());
    }
    let flags: [(&str, &[&str]); 2] = [
        (REFERENCE, &["-O3", "-march=native"]),
        (VECTORISED, &["-O3", "-march=native", "-ffast-math", "-mprefer-vector-width=512"]),
    ];
    let mut contenders: Vec<Box<dyn Contender>> = Vec::new();
    for (index, (contender, flags)) in flags.into_iter().enumerate() {
        let name = case.name.to_lowercase();
        let program = folder.path().join(format!("{name}{index}"));
        let header = folder.path().join(format!("{name}.h"));
        let compiled = Command::new("gcc")
            .args(flags)
            .arg(format!("-DHEADER=\"{}\"", header.display()))
            .arg(sources.join("time.c"))
            .arg("-o")
            .arg(&program)
            .arg("-lm")
            .output();
        if let Some(why) = failure(compiled) {
            eprintln!("{}: skipped `{contender}`, which needs gcc: {why}", case.name);
            continue;
        }
        let head = [COUNT as f64, 1.0, case.time];
        let numbers = head.iter().chain(case.parameters).chain(case.points.iter().flatten());
        contenders.push(Box::new(Peer {
            contender,
            program,
            input: numbers.flat_map(|number| number.to_ne_bytes()).collect(),
            components: case.points.len(),
            seconds: Vec::new(),
            results: Vec::new(),
            _folder: folder.clone(),
        }));
    }
    Ok(contenders)
}

/// The reason why a program failed, in one line; `None` if it succeeded.
fn failure(output: std::io::Result<std::process::Output>) -> Option<String> {
    match output {
        Ok(output) if output.status.success() => None,
        Ok(output) => {
            let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
            Some(stderr.lines().last().unwrap_or("no reason given").to_string())
        }
        Err(error) => Some(error.to_string()),
    }
}
