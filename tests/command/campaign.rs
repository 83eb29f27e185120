//! `mms campaign`: a solver that is a script of the shell writes the exact u of the bar plus C h^p.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use super::mms::{Folder, Run, timeless};
use super::sampled::sampled_count;

/// At the end of the window the bar has u = a X (2 - X), with a = 0.2. The solver logs each of its runs in `log`.
const SOLVER: &str = r#"
echo "run of $2 cells"
echo "$2" >> "$(dirname "$0")/log.txt"
[ "$2" = "$4" ] && { echo "the matrix is singular" >&2; exit 7; }
[ "$2" = "$5" ] && sleep 60
sleep "${6:-0}"
mkdir -p "$1/the results"
awk -v n="$2" -v p="$3" 'BEGIN {
    print "X,u"
    for (i = 0; i < n; i++) { X = (i + 0.5) / n; printf "%.17g,%.17g\n", X, 0.2 * X * (2 - X) + 0.1 / n ^ p }
}' > "$1/the results/u '$2'.csv"
"#;

/// A campaign whose solver gets additional words as arguments.
fn file(words: &str, studies: &str) -> String {
    format!(
        "[solver]\nname = \"tiny\"\nrun = \"sh 'my solver.sh' {{output}} {{cells}} {words}\"\n\
         output = \"{{output}}/the results/*.csv\"\ntime_limit = 2\n{studies}"
    )
}

const BAR: &str = "[[study]]\nfield = \"bar_1d\"\ncells = [8, 16, 32]\n";

/// A folder with odd characters in its name.
const ODD: &str = "it's [a] \"place\"";

fn folder(words: &str, studies: &str) -> Folder {
    let folder = Folder::new();
    folder.write(&format!("{ODD}/my solver.sh"), SOLVER);
    folder.write(&format!("{ODD}/c.toml"), &file(words, studies));
    folder
}

fn campaign(folder: &Folder, options: &[&str]) -> Run {
    let path = format!("{ODD}/c.toml");
    folder.run(&[&["campaign", &path, "--jobs", "2"], options].concat())
}

/// The cells of the runs that were made, sorted.
fn runs(folder: &Folder) -> Vec<usize> {
    let log = folder.path(&format!("{ODD}/log.txt"));
    let log = fs::read_to_string(log).unwrap_or_default();
    let mut cells: Vec<usize> = log.lines().map(|line| line.parse().expect("cells")).collect();
    cells.sort_unstable();
    cells
}

#[test]
fn a_solver_that_converges_passes_and_nothing_is_done_twice() {
    let folder = folder("2", BAR);
    let run = campaign(&folder, &["--json"]).exits(0);
    let document = run.json();
    let study = &document["studies"][0];
    assert_eq!((&study["verdict"], &document["passed"]), (&"pass".into(), &1.into()));
    let together = document["excluded"].as_array().expect("what is excluded");
    let by =
        |name: &str| &together.iter().find(|it| it["hypothesis"] == name).expect("a name")["by"];
    assert_eq!((by("force_sign"), by("lambda_factor")), (&"bar_1d".into(), &Value::Null));
    for (level, cells) in
        study["judgement"]["levels"].as_array().expect("levels").iter().zip([8, 16, 32])
    {
        let h = 1.0 / f64::from(cells);
        for norm in ["l1", "l2", "linf"] {
            let error = level[norm].as_f64().expect("an error");
            assert!((error / (0.1 * h * h) - 1.0).abs() < 1e-9, "{norm} {error}");
        }
        assert_eq!(level["cell_size"], h);
    }
    assert_eq!(runs(&folder), [8, 16, 32]);
    let again = campaign(&folder, &[]).exits(0);
    again.complains("3 of 3 runs: bar_1d/").complains("was done before");
    again.prints("pass: observed order 2.00").prints("1 of 1 studies pass");
    assert_eq!(runs(&folder), [8, 16, 32]);
}

#[test]
fn a_run_is_made_again_where_its_command_its_program_its_results_or_its_version_changed() {
    let folder = folder("2", "[[study]]\nfield = \"bar_1d\"\ncells = [8]\n");
    let count = || {
        campaign(&folder, &[]).exits(1);
        runs(&folder).len()
    };
    assert_eq!((count(), count()), (1, 1));
    let path = format!("{ODD}/my solver.sh");
    folder.write(&path, &format!("{SOLVER}\n# another one"));
    assert_eq!((count(), count()), (2, 2));
    let text = file("2", "version = \"2\"\n[[study]]\nfield = \"bar_1d\"\ncells = [8]\n");
    folder.write(&format!("{ODD}/c.toml"), &text);
    assert_eq!((count(), count()), (3, 3));
    folder.write(&format!("{ODD}/c.toml"), &text.replace("} 2", "} 3"));
    assert_eq!((count(), count()), (4, 4));
    let text = text.replace("version", "sources = [\"*.h\"]\nversion");
    folder.write(&format!("{ODD}/c.toml"), &text.replace("} 2", "} 3"));
    campaign(&folder, &[]).exits(2).complains("c.toml:6:12").complains("there is no such file");
    folder.write(&format!("{ODD}/one.h"), "1");
    assert_eq!((count(), count()), (5, 5));
    folder.write(&format!("{ODD}/one.h"), "2");
    assert_eq!((count(), count()), (6, 6));
    // The name of the solver and the time limit do not change results.
    folder.write(
        &format!("{ODD}/c.toml"),
        &text.replace("} 2", "} 3").replace("limit = 2", "limit = 3"),
    );
    assert_eq!(count(), 6);
    let result = find(&folder.path("target"), "u '8'.csv");
    fs::remove_file(result.last().expect("a result")).expect("it is removed");
    result[..result.len() - 1].iter().for_each(|it| fs::remove_file(it).expect("it is removed"));
    assert_eq!((count(), count()), (7, 7));
}

/// All files of a name, at any depth.
fn find(folder: &Path, name: &str) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(find(&path, name));
        } else if path.ends_with(name) {
            found.push(path);
        }
    }
    found
}

#[test]
fn a_lower_order_fails() {
    let folder = folder("1", BAR);
    campaign(&folder, &[])
        .exits(1)
        .prints("fail: observed order 1.00")
        .prints("0 of 1 studies pass");
    folder.write(&format!("{ODD}/c.toml"), &file("1", &format!("{BAR}order = 1\n")));
    campaign(&folder, &[]).exits(0).prints("3 of 3 runs are done; 1 of 1 studies pass");
    assert_eq!(runs(&folder), [8, 16, 32], "an order makes no other results");
}

#[test]
fn a_run_that_fails_is_named_and_ends_no_other() {
    let folder = folder(
        "2 16",
        &format!("{BAR}[[study]]\nname = \"other\"\nfield = \"bar_1d\"\ncells = [4, 8]\n"),
    );
    let run = campaign(&folder, &["--output", "out"]).exits(3);
    run.prints("bar_1d/2 failed: it ended with exit code 7\n    the matrix is singular\n");
    run.prints("a run stopped").prints("4 of 5 runs are done; 1 of 2 studies pass");
    let document: Value = serde_json::from_str(&folder.read("out/campaign.json")).expect("JSON");
    let failed = &document["studies"][0]["runs"][1];
    assert_eq!(
        (&failed["status"], &failed["last_words"][0]),
        (&"failed".into(), &"the matrix is singular".into())
    );
    // Only the failed run is tried again.
    campaign(&folder, &[]).exits(3);
    // A run that two studies need is made once.
    assert_eq!(runs(&folder), [4, 8, 16, 16, 32]);
    let page = folder.mms("report out").exits(1);
    page.prints("1 of 2 verdicts is not as expected");
}

#[test]
fn a_run_that_hangs_is_ended_at_its_limit() {
    let folder = folder("2 0 16", BAR);
    let run = campaign(&folder, &[]).exits(3);
    run.prints("bar_1d/2 failed: stopped after 2 s, its limit (`time_limit`)\n    run of 16 cells");
    run.prints("2 of 3 runs are done");
}

#[test]
fn results_that_are_none_are_told_and_end_no_other_study() {
    let studies = format!(
        "{BAR}[[study]]\nname = \"other\"\nfield = \"bar_1d\"\ncells = [4, 8, 16]\nset = {{ amplitude = 0.1 }}\nmap = \"u=v\"\n"
    );
    let folder = folder("2", &studies);
    let run = campaign(&folder, &[]).exits(3);
    run.prints("other: ")
        .prints("pass: observed order 2.00")
        .prints("not judged: its results are no evidence");
    folder.write(&format!("{ODD}/c.toml"), &file("2", BAR).replace("*.csv", "*.vtu"));
    let run = campaign(&folder, &[]).exits(3);
    run.prints("it ended well, but").prints("no file fits the pattern");
}

#[test]
fn runs_are_shown_and_listed_and_made_one_by_one() {
    let folder = folder("2", BAR);
    let shown = campaign(&folder, &["--dry-run"]).exits(0);
    shown.prints(
        "bar_1d/1: to do; 8 cells, h 1.250e-1, dt 1.581e-3, 40 steps\n  sh 'my solver.sh' /",
    );
    let listed = campaign(&folder, &["--list", "--store", "my [s]tore"]).exits(0);
    let lines: Vec<&str> = listed.stdout.lines().collect();
    assert_eq!(lines.len(), 3);
    assert_eq!(runs(&folder), [0; 0], "nothing is run");
    for line in &lines[1..] {
        // A shell reads it back.
        let program = env!("CARGO_BIN_EXE_mms");
        let line = line.replacen("mms", &format!("'{program}'"), 1);
        let status = Command::new("sh").args(["-c", &line]).current_dir(folder.path("")).status();
        assert!(status.expect("a shell").success(), "{line}");
    }
    assert_eq!(runs(&folder), [16, 32]);
    let left = campaign(&folder, &["--list", "--store", "my [s]tore"]).exits(0);
    assert_eq!(left.stdout.lines().collect::<Vec<_>>(), lines[..1]);
    campaign(&folder, &["--store", "my [s]tore", "--only", "bar_1d"]).exits(0).prints("pass");
    assert_eq!(runs(&folder), [8, 16, 32]);
    campaign(&folder, &["--list", "--store", "my [s]tore"]).exits(0).complains("all runs are done");
}

#[test]
fn what_is_not_there_is_told() {
    let folder = folder("2", BAR);
    for (only, words) in [
        ("bar_2d", "did you mean `bar_1d`?"),
        ("bar_1d/4", "`bar_1d` has levels 1 to 3"),
        ("bar_1d/0", "`bar_1d` has levels 1 to 3"),
    ] {
        campaign(&folder, &["--only", only]).exits(2).complains(words).prints_nothing();
    }
    for (study, place, words) in [
        ("field = \"bar_2d\"\ncells = [8]", "c.toml:7:9", "did you mean `bar_1d`?"),
        (
            "field = \"bar_1d\"\ncells = [8]\nquantity = \"speed\"",
            "c.toml:9:12",
            "unknown quantity `speed`",
        ),
        ("field = \"bar_1d\"\ncells = [8]\nmap = \"u\"", "c.toml:9:7", "expected QUANTITY=COLUMN"),
        (
            "field = \"bar_1d\"\ncells = [8]\norder = \"two\"",
            "c.toml:9:9",
            "expected a finite number",
        ),
        (
            "field = \"bar_1d\"\ncells = [8]\nweight = \"size\"",
            "c.toml:9:10",
            "expected volume or mass",
        ),
        (
            "field = \"bar_1d\"\ncells = [8]\nstart = \"rest\"",
            "c.toml:9:9",
            "expected interpolation or projection",
        ),
        (
            "field = \"bar_1d\"\ncells = [8]\nend = 7",
            "c.toml:6:1",
            "the time window of the field is 0.0 to",
        ),
        (
            "field = \"bar_1d\"\ncells = [8]\nset = { yong = 1 }",
            "c.toml:7:9",
            "did you mean `young`?",
        ),
        ("field = \"nowhere.toml\"\ncells = [8]", "c.toml:7:9", "cannot read"),
    ] {
        folder.write(&format!("{ODD}/c.toml"), &file("2", &format!("[[study]]\n{study}\n")));
        campaign(&folder, &[]).exits(2).complains(place).complains(words);
    }
    folder.write(&format!("{ODD}/c.toml"), &file("2", &format!("emit = \"phyton\"\n{BAR}")));
    campaign(&folder, &[]).exits(2).complains("c.toml:6:8").complains("did you mean `python`?");
    folder.write(&format!("{ODD}/c.toml"), &file("2", ""));
    campaign(&folder, &[]).exits(2).complains("it has no [[study]]; `mms campaign FILE --suggest`");
    campaign(&folder, &["--suggest"]).exits(2).complains("needs the abilities of the solver");
    assert_eq!(runs(&folder), [0; 0]);
}

#[test]
fn the_field_is_written_before_a_run() {
    let folder = Folder::new();
    folder.write("solver.sh", "ls \"$1\" > \"$2/names.txt\"; cp \"$1\"/bar_1d.c \"$2\"; exit 3");
    folder.write(
        "c.toml",
        &format!("[solver]\nrun = \"sh solver.sh {{emitted}} {{output}}\"\noutput = \"{{output}}\"\nemit = \"c\"\n{BAR}set = {{ young = 2e6 }}\n"),
    );
    folder.mms("campaign c.toml --only bar_1d/1").exits(3);
    let names = find(&folder.path("target"), "names.txt");
    assert_eq!(fs::read_to_string(&names[0]).expect("names"), "bar_1d.c\nbar_1d.h\n");
    folder.mms("emit bar_1d --target c -o own --set young=2e6").exits(0);
    let emitted = find(&folder.path("target"), "output/bar_1d.c");
    assert_eq!(fs::read_to_string(&emitted[0]).expect("a source"), folder.read("own/bar_1d.c"));
}

/// After its period the bar is back at its start: its initial state and an error are the results at the end. Only the
/// state shows the solver the number of cells.
#[test]
fn a_run_gets_the_exact_state_of_its_level() {
    let folder = Folder::new();
    folder.write(
        "solver.sh",
        r#"echo run >> log.txt
awk -F, 'NR == FNR { n = (FNR - 1) / 2; next }
    FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; print "X,u"; next }
    { printf "%s,%.17g\n", $at["X"], $at["u"] + 0.1 / n ^ 2 }' "$1" "$1" > "$2/u.csv""#,
    );
    let solver = "[solver]\nrun = \"sh solver.sh {state} {output}\"\noutput = \"{output}/u.csv\"\n";
    let study = format!("{BAR}set = {{ amplitude = 0.05 }}\n");
    folder.write("c.toml", &format!("{solver}state = \"csv\"\n{study}"));
    let run = folder.mms("campaign c.toml --json").exits(0).json();
    let levels = run["studies"][0]["judgement"]["levels"].as_array().expect("levels");
    for (level, cells) in levels.iter().zip([8.0, 16.0, 32.0]) {
        let error = level["linf"].as_f64().expect("an error");
        assert!((error * cells * cells / 0.1 - 1.0).abs() < 1e-9, "{cells} cells: {error}");
    }
    folder.mms("campaign c.toml").exits(0);
    assert_eq!(folder.read("log.txt").lines().count(), 3, "nothing is done twice");
    folder.mms("state bar_1d --cells 32 --time 0 --set amplitude=0.05 -o own.csv").exits(0);
    let own = folder.read("own.csv");
    let states = find(&folder.path("target"), "state.csv");
    assert_eq!(states.len(), 3);
    assert!(states.iter().any(|it| fs::read_to_string(it).expect("a state") == own));
    // A state of another format makes another run, with any result.
    folder.write("c.toml", &format!("{solver}state = \"npz\"\n{study}"));
    folder.mms("campaign c.toml --only bar_1d/1");
    assert_eq!(folder.read("log.txt").lines().count(), 4);
}

#[test]
fn the_exact_state_of_vtk_is_read_as_a_result() {
    let folder = Folder::new();
    folder.write("run.sh", "cp \"$1\" \"$2/particles_0.vtu\"");
    folder.write(
        "c.toml",
        "[solver]\nrun = \"sh run.sh {state} {output}\"\noutput = \"{output}/particles_*.vtu\"\n\
         [[study]]\nfield = \"axis_aligned_2d\"\ncells = [8, 16, 32]\n",
    );
    let run = folder.mms("campaign c.toml").exits(1);
    run.complains("the solver was given all values that were compared: displacement, velocity");
    run.prints("0 of 1 studies pass");
}

#[test]
fn a_state_that_cannot_be_written_ends_no_other_run() {
    let folder = Folder::new();
    folder.write("run.sh", "cp \"$1\" \"$2/u.vtu\"");
    folder.write(
        "c.toml",
        "[solver]\nrun = \"sh run.sh {state} {output}\"\noutput = \"{output}\"\n\
         [[study]]\nfield = \"axis_aligned_2d\"\ncells = [1000000, 4]\ntime_steps = [0.01, 0.01]\n",
    );
    let run = folder.mms("campaign c.toml --jobs 1").exits(3);
    run.complains("axis_aligned_2d/1: it was not started: the exact state at the start: the scene has 4e12 particles");
    run.complains("axis_aligned_2d/2: done in ").prints("1 of 2 runs are done");
}

#[test]
fn dt_alone_may_be_refined() {
    let folder = Folder::new();
    folder.write(
        "solver.sh",
        "awk -v dt=\"$2\" 'BEGIN { print \"X,u\"; for (X = 0.1; X < 1; X += 0.2) printf \"%.17g,%.17g\\n\", X, 0.2 * X * (2 - X) + dt }' > \"$1/u.csv\"",
    );
    let study = "[[study]]\nname = \"in time\"\nfield = \"bar_1d\"\ncells = [4]\ntime_steps = [0.01, 0.005, 0.0025]\norder = 1\n";
    folder.write(
        "c.toml",
        &format!("[solver]\nrun = \"sh solver.sh {{output}} {{time_step}}\"\noutput = \"{{output}}/u.csv\"\n{study}"),
    );
    let run = folder.mms("campaign c.toml").exits(0);
    run.prints("pass: ").prints("pass: observed order 1.00").prints("dt 1.000e-2 to dt 2.500e-3");
}

/// Three meshes with three time steps each are fitted by A h^p + B dt^q; solver and state have the same particles per cell.
#[test]
fn space_and_time_are_refined_each_by_itself() {
    let folder = Folder::new();
    folder.write(
        "solver.sh",
        "[ \"$4\" = 3 ] || exit 1\n[ \"$(wc -l < \"$5\")\" = $((1 + 3*$3)) ] || exit 2\n\
         awk -v dt=\"$2\" -v n=\"$3\" 'BEGIN { print \"X,u\"; for (X = 0.1; X < 1; X += 0.2) printf \"%.17g,%.17g\\n\", X, 0.2 * X * (2 - X) + 0.5/n^2 + dt }' > \"$1/u.csv\"",
    );
    let study = "[[study]]\nfield = \"bar_1d\"\ncells = [8, 16, 32]\ntime_steps = [0.01, 0.005, 0.0025]\n\
                 grid = true\nparticles_per_cell = 3\norder = [\"2\", \"time=1\"]\n";
    let solver = "[solver]\nrun = \"sh solver.sh {output} {time_step} {cells} {particles_per_cell} {state}\"\n\
                  output = \"{output}/u.csv\"\nstate = \"csv\"\n";
    folder.write("c.toml", &format!("{solver}{study}"));
    let run = folder.mms("campaign c.toml").exits(0);
    run.prints("9 of 9 runs are done; 1 of 1 studies pass");
    run.prints("l2 = 5.000e-1 h^2.00 +1.000e0 dt^1.00 in all runs");
    folder.write("c.toml", &format!("{solver}{}", study.replace("= 3\n", "= \"3x2\"\n")));
    folder
        .mms("campaign c.toml")
        .exits(2)
        .complains("`particles_per_cell`: `particles_per_cell 3x2`: 2 numbers for 1 dimension");
    let judge = "judge bar_1d solver.sh --expected-order time=1";
    folder.write("a.csv", "time,X,u\n0.01,0.5,0\n");
    folder
        .mms(&judge.replace("solver.sh", "a.csv"))
        .exits(2)
        .complains("`--expected-order time=..`: it is not judged");
}

/// Sends a signal of this name.
fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.expect("kill").success());
}

fn start(folder: &Folder) -> Child {
    let path = format!("{ODD}/c.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mms"));
    command.args(["campaign", &path, "--jobs", "1"]).current_dir(folder.path(""));
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts")
}

/// A campaign is killed at many moments. The same command continues it, and each time at most one run is lost. The document
/// is the document of an undisturbed campaign, in folders of the same names.
#[test]
fn killed_anywhere_it_loses_one_run_at_most_and_ends_with_the_same_document() {
    const CELLS: [usize; 8] = [4, 8, 12, 16, 20, 24, 28, 32];
    let study = format!("[[study]]\nfield = \"bar_1d\"\ncells = {CELLS:?}\n");
    let folder = folder("2 0 0 0.05", &study);
    let document = || timeless(&campaign(&folder, &["--json"]).exits(0).json());
    let undisturbed = document();
    assert_eq!(undisturbed["studies"][0]["verdict"], "pass");
    // Ends a campaign that was killed `kills` times, and removes it.
    let end = |kills: usize| {
        assert_eq!(document(), undisturbed);
        let made = runs(&folder);
        assert!(made.len() <= CELLS.len() + kills, "{made:?}");
        assert!(CELLS.iter().all(|cells| made.contains(cells)), "{made:?}");
        let store = folder.path("target/mms/campaign/c");
        for entry in fs::read_dir(&store).expect("a store") {
            let path = entry.expect("an entry").path();
            assert!(path.is_dir() || path.extension().is_some_and(|it| it == "json"), "{path:?}");
        }
        campaign(&folder, &[]).exits(0);
        assert_eq!(runs(&folder), made, "nothing is left to be done");
        fs::remove_dir_all(store).expect("it is removed");
        fs::remove_file(folder.path(&format!("{ODD}/log.txt"))).expect("it is removed");
    };
    end(0);
    let (mut kills, mut wait) = (0, 0);
    for _ in 0..sampled_count(50, 5) {
        let mut child = start(&folder);
        wait = (wait + 37) % 160;
        sleep(Duration::from_millis(wait));
        // A campaign that has ended makes room for the next.
        if child.try_wait().expect("a child").is_some() {
            end(kills);
            kills = 0;
            child = start(&folder);
            sleep(Duration::from_millis(wait));
        }
        signal(&child, "-KILL");
        child.wait().expect("it ends");
        kills += 1;
    }
    end(kills);
}

#[test]
fn an_interrupted_campaign_ends_its_runs_and_goes_on() {
    let folder = folder("2 0 0 0.3", BAR);
    let mut child = start(&folder);
    while runs(&folder).len() < 2 {
        sleep(Duration::from_millis(20));
    }
    signal(&child, "-INT");
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
    campaign(&folder, &[]).exits(0);
    assert_eq!(runs(&folder).len(), 4, "one run was lost, and none is made twice");
}

#[test]
fn proposals_show_what_can_be_shown_and_can_be_pasted() {
    let folder = folder("2", "");
    let can = "can = { dimensions = [1, 2], loads = [\"traction\"], moving_walls = true, start_moving = true, start_deformed = true }\n";
    folder.write(&format!("{ODD}/c.toml"), &file("2", can));
    let run = campaign(&folder, &["--suggest"]).exits(0);
    run.prints("[[study]]\nfield = \"travelling_wave_2d\"\ncells = [8, 16, 32, 64]\norder = 2\n");
    run.prints("# not seen:\n").prints(
        "graded_density: rho0 is the same at all X (graded_bar shows it, and needs `graded`)",
    );
    run.prints("name = \"uniform_stretch in time\"");
    folder.write(&format!("{ODD}/c.toml"), &file("2", &format!("{can}{}", run.stdout)));
    campaign(&folder, &["--list"])
        .exits(0)
        .prints("--only=travelling_wave_2d/4")
        .prints("in time/4");
    // A solver that can only start at rest gets the field that does.
    let little = "can = { dimensions = [2] }\n";
    folder.write(&format!("{ODD}/c.toml"), &file("2", little));
    let run = campaign(&folder, &["--suggest", "--json"]).exits(0).json();
    assert_eq!(run["fields"].as_array().map(Vec::len), Some(1));
    assert_eq!(run["fields"][0]["field"], "starting_square_2d");
    let unseen = run["unseen"].as_array().expect("terms");
    let start = unseen.iter().find(|it| it["term"] == "initial_velocity").expect("a start");
    assert!(start["needs"].as_array().expect("keys").iter().any(|key| key == "start_moving"));
    // A solver that also solves in R and Z gets a body of revolution.
    let rings = "can = { dimensions = [2], axisymmetric = true, start_moving = true }\n";
    folder.write(&format!("{ODD}/c.toml"), &file("2", rings));
    campaign(&folder, &["--suggest"])
        .exits(0)
        .prints("field = \"axisymmetric_rod\"")
        .prints("hoop");
    let none = "can = { dimensions = [3], materials = [\"gent\"] }\n";
    folder.write(&format!("{ODD}/c.toml"), &file("2", none));
    campaign(&folder, &["--suggest"])
        .exits(0)
        .prints("# this solver can run no field of the gallery");
}
