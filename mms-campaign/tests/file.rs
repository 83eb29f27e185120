//! Campaign files: how they are read, and the messages for mistakes.

use std::time::Duration;

use mms_campaign::template::Template;
use mms_campaign::{Campaign, read};

/// The first file that a user writes.
const FILE: &str = r#"
[solver]
name    = "my code"
run     = "python3 run.py --cells {cells} --dt {time_step} --end {end} --state {state} --out {output}"
output  = "{output}/particles_*.vtu"
threads = 1
can     = { dimensions = [2], loads = ["traction"], moving_walls = true, start_moving = false, start_deformed = false }
[[study]]
field = "axis_aligned_2d"
cells = [8, 16, 32, 64]
order = 2
"#;

fn parsed(text: &str) -> Campaign {
    read("c.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn the_first_file_is_read() {
    let campaign = parsed(FILE);
    let solver = &campaign.solver;
    assert_eq!((solver.name.as_str(), solver.threads.get()), ("my code", 1));
    assert_eq!(solver.time_limit, Duration::from_secs(3600));
    assert_eq!(solver.run.len(), 12);
    assert_eq!(solver.state(), Some("vtu"), "the default format");
    let can = solver.can.as_ref().expect("what it can");
    assert_eq!(
        (can.dimensions.as_slice(), can.materials.as_slice()),
        (&[2][..], &["neo_hookean".to_owned()][..])
    );
    assert!(can.tractions && can.moving_walls && can.dynamics);
    assert!(!can.start_moving && !can.start_deformed && !can.graded);
    let study = &campaign.studies[0];
    assert_eq!(
        (study.name.as_str(), study.cells.as_slice()),
        ("axis_aligned_2d", &[8, 16, 32, 64][..])
    );
    assert_eq!((study.order[0].value.as_str(), study.tolerance, study.courant), ("2", 0.15, 0.4));
    assert_eq!((study.time_steps.as_ref(), study.end, study.levels()), (None, None, 4));
}

#[test]
fn all_keys_are_read() {
    let campaign = parsed(
        r#"
        solver = { run = ["a b", "{{{cells}}}", ""], output = "*.csv", directory = "{output}", threads = 4, time_limit = 0.5,
            version = "2", sources = ["*.c"], emit = "c", state = "npz" }
        [[study]]
        name = "it's one"
        field = "fields/x.toml"
        cells = [8]
        time_steps = [0.1, 5e-2]
        courant = 0.2
        end = 1
        order = ["2", "H1=1"]
        tolerance = 0.1
        quantity = "u"
        map = ["X=x0,y0", "u=disp"]
        h = [0.5, 0.5]
        time = [0.5, 1]
        weight = "volume"
        start = "projection"
        part = true
        max_memory = 100
        set = { young = 1e6, nu = "1/3" }
        [[study]]
        field = "fields/x.toml"
        cells = [1, 2]
        "#,
    );
    let words: Vec<_> = campaign
        .solver
        .run
        .iter()
        .map(|word| word.fill(|it| it.name().into(), str::to_owned))
        .collect();
    assert_eq!(words, ["a b", "{cells}", ""]);
    assert_eq!(campaign.solver.state(), Some("npz"));
    let study = &campaign.studies[0];
    assert_eq!((study.name.as_str(), study.levels(), study.end), ("it's one", 2, Some(1.0)));
    assert_eq!(study.time_steps, Some(vec![0.1, 0.05]));
    assert_eq!(study.set, ["nu=1/3", "young=1e6"]);
    let texts = |words: &[mms_spec::source::Spanned<String>]| -> Vec<String> {
        words.iter().map(|word| word.value.clone()).collect()
    };
    assert_eq!(texts(&study.order), ["2", "H1=1"]);
    assert_eq!(texts(&study.map), ["X=x0,y0", "u=disp"]);
    assert_eq!(study.start.as_ref().map(|it| it.value.as_str()), Some("projection"));
    assert_eq!((study.part, study.max_memory), (true, Some(100)));
    let other = &campaign.studies[1];
    assert_eq!((other.name.as_str(), other.part, other.max_memory), ("x", false, None));
}

/// Combines each number of cells with each time step; h is the size of the cells.
#[test]
fn a_grid_has_a_level_for_each_pair() {
    let campaign = parsed(
        r#"
        solver = { run = "a {particles_per_cell}", output = "{output}" }
        [[study]]
        field = "x"
        cells = [8, 16, 32]
        time_steps = [0.1, 0.05, 0.025, 0.0125]
        h = [1, 0.5, 0.25]
        grid = true
        particles_per_cell = "3x2"
        "#,
    );
    let study = &campaign.studies[0];
    assert_eq!(study.levels(), 12);
    let of = |level: usize| (study.cells_of(level), study.time_step_of(level), study.h_of(level));
    assert_eq!(of(1), (8, Some(0.1), Some(1.0)));
    assert_eq!(of(4), (8, Some(0.0125), Some(1.0)));
    assert_eq!(of(5), (16, Some(0.1), Some(0.5)));
    assert_eq!(of(12), (32, Some(0.0125), Some(0.25)));
    assert_eq!(study.particles_per_cell.as_ref().map(|it| it.value.as_str()), Some("3x2"));
}

/// Each mistake with the place and some words of its message.
#[test]
fn each_mistake_is_told_at_its_place() {
    let solver = "[solver]\nrun = \"a\"\noutput = \"{output}\"\n";
    let study = "[[study]]\nfield = \"x\"\ncells = [1, 2]\n";
    for (text, place, words) in [
        ("", "c.toml:1:1", "missing table [solver]"),
        ("[solver\n", "c.toml:1:8", "unclosed table"),
        ("[solver]\noutput = \"{output}\"\n", "c.toml:1:1", "missing key `run`"),
        ("[solver]\nrun = \"a\"\n", "c.toml:1:1", "missing key `output`"),
        ("[solver]\nrun = \"a\"\noutput = \"x.csv\"\n", "c.toml:3:10", "write to the same place"),
        (
            "[solver]\nrun = 3\noutput = \"{output}\"\n",
            "c.toml:2:7",
            "expected a command in quotes",
        ),
        (
            "[solver]\nrun = [1]\noutput = \"{output}\"\n",
            "c.toml:2:7",
            "expected a command in quotes",
        ),
        (
            "[solver]\nrun = \"a 'b\"\noutput = \"{output}\"\n",
            "c.toml:2:7",
            "a quote is not closed",
        ),
        (
            "[solver]\nrun = \"a {cels}\"\noutput = \"{output}\"\n",
            "c.toml:2:7",
            "did you mean `{cells}`? the placeholders are name, field",
        ),
        ("[solver]\nrun = \"a {\"\noutput = \"{output}\"\n", "c.toml:2:7", "a lone `{`"),
        (
            "[solver]\nrun = \"a {emitted}\"\noutput = \"{output}\"\n",
            "c.toml:1:1",
            "missing key `emit`",
        ),
        (&format!("{solver}tread = 1\n"), "c.toml:4:1", "unknown key `tread`"),
        (&format!("{solver}thread = 1\n"), "c.toml:4:1", "did you mean `threads`?"),
        (&format!("{solver}threads = 0\n"), "c.toml:4:11", "a whole number from 1 on"),
        (&format!("{solver}time_limit = -1\n"), "c.toml:4:14", "a positive number"),
        (&format!("{solver}time_limit = nan\n"), "c.toml:4:14", "a positive number"),
        (&format!("{solver}state = \"vtk\"\n"), "c.toml:4:9", "did you mean `vtu`?"),
        (&format!("{solver}can = {{ dimensions = [4] }}\n"), "c.toml:4:22", "some of 1, 2 and 3"),
        (
            &format!("{solver}can = {{ loads = [\"tractions\"], dimensions = [1] }}\n"),
            "c.toml:4:18",
            "did you mean `traction`?",
        ),
        (
            &format!("{solver}can = {{ moving_wall = true, dimensions = [1] }}\n"),
            "c.toml:4:9",
            "did you mean `moving_walls`?",
        ),
        (&format!("{solver}can = {{ }}\n"), "c.toml:4:7", "missing key `dimensions`"),
        (&format!("{solver}{study}{study}"), "c.toml:7:1", "two studies are called `x`"),
        (&format!("{solver}[[study]]\ncells = [1]\n"), "c.toml:4:1", "missing key `field`"),
        (&format!("{solver}[[study]]\nfield = \"x\"\n"), "c.toml:4:1", "missing key `cells`"),
        (
            &format!("{solver}[[study]]\nfield = \"x\"\ncells = []\n"),
            "c.toml:6:9",
            "whole numbers from 1 on",
        ),
        (
            &format!("{solver}[[study]]\nfield = \"x\"\ncells = [0.5]\n"),
            "c.toml:6:9",
            "whole numbers from 1 on",
        ),
        (
            &format!("{solver}{study}time_steps = [1]\n"),
            "c.toml:7:14",
            "`time_steps` has 1 values, and there are 2 levels",
        ),
        (&format!("{solver}{study}h = [1, 2, 3]\n"), "c.toml:7:5", "`h` has 3 values"),
        (&format!("{solver}{study}grid = true\n"), "c.toml:6:9", "`grid`: `cells` has 2 values"),
        (
            &format!("{solver}{study}grid = true\n"),
            "c.toml:4:1",
            "`grid`: `time_steps` has 0 values",
        ),
        (&format!("{solver}{study}grid = 1\n"), "c.toml:7:8", "true or false"),
        (&format!("{solver}{study}particles_per_cell = []\n"), "c.toml:7:22", "a whole number"),
        (&format!("{solver}{study}h = [1, inf]\n"), "c.toml:7:5", "an array of positive numbers"),
        (&format!("{solver}{study}name = \"a/b\"\n"), "c.toml:7:8", "the name of a folder"),
        (&format!("{solver}{study}name = \"..\"\n"), "c.toml:7:8", "the name of a folder"),
        (
            &format!("{solver}[[study]]\nfield = \"a/.toml\"\ncells = [1]\n"),
            "c.toml:5:9",
            "the name of a folder",
        ),
        (&format!("{solver}{study}set = [1]\n"), "c.toml:7:7", "a table of numbers"),
        (&format!("{solver}{study}set = {{ load = [] }}\n"), "c.toml:7:16", "a list of one number"),
        (
            &format!("{solver}{study}set = {{ load = [[1]] }}\n"),
            "c.toml:7:16",
            "a list of one number",
        ),
        (&format!("{solver}{study}set = {{ load = true }}\n"), "c.toml:7:16", "expected a number"),
        (
            &format!("{solver}{study}set = {{ a = [1, 2], c = 1, load = [1, 2, 3] }}\n"),
            "c.toml:7:35",
            "`load` has 3 values, and `a` 2",
        ),
        (
            &format!("{solver}{study}set = {{ load = [1, 2, 1] }}\n"),
            "c.toml:7:16",
            "two steps are `load=1`",
        ),
        (&format!("{solver}{study}order = true\n"), "c.toml:7:9", "a text in quotes"),
        (&format!("{solver}[study]\n"), "c.toml:4:1", "an array of tables"),
    ] {
        let said = match read("c.toml", text) {
            Ok(_) => panic!("no mistake in\n{text}"),
            Err(mistakes) => mistakes.to_string(),
        };
        assert!(said.contains(place) && said.contains(words), "{place} `{words}`:\n{said}");
    }
}

#[test]
fn lists_of_parameters_are_studies_of_their_own() {
    let text = FILE.to_owned()
        + "set = { load = [0.25, \"1/2\"], nu = 0.3, a = [1, -2e-3] }\n[[study]]\nfield = \"x\"\ncells = [1]\n";
    let campaign = parsed(&text);
    let found: Vec<_> = campaign.studies.iter().map(|it| (it.name.as_str(), &it.set[..])).collect();
    let set = |words: [&str; 3]| words.map(str::to_owned);
    let [first, second] =
        [set(["a=1", "load=0.25", "nu=0.3"]), set(["a=-2e-3", "load=1/2", "nu=0.3"])];
    assert_eq!(
        found,
        [
            ("axis_aligned_2d@a=1,load=0.25", &first[..]),
            ("axis_aligned_2d@a=-2e-3,load=1_2", &second[..]),
            ("x", &[])
        ]
    );
    let families: Vec<_> = campaign.studies.iter().map(|it| it.family.as_str()).collect();
    assert_eq!(families, ["axis_aligned_2d", "axis_aligned_2d", "x"]);
}

/// No text makes the reader panic.
#[test]
fn any_text_is_read_or_refused() {
    for end in 0..FILE.len() {
        let _ = read("c.toml", &FILE[..end]);
        let _ = read("c.toml", &FILE[end..]);
        let _ = Template::words(&FILE[end..]);
    }
}
