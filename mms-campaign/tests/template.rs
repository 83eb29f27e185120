//! Templates of commands.

use mms_campaign::template::*;

fn filled(text: &str) -> Result<Vec<String>, Wrong> {
    let value = |it: Placeholder| match it {
        Placeholder::Cells => "8".to_owned(),
        Placeholder::Output => "a b/it's \"$HOME\"".to_owned(),
        other => other.name().to_uppercase(),
    };
    let parameter = |name: &str| format!("<{name}>");
    Ok(Template::words(text)?.iter().map(|word| word.fill(value, parameter)).collect())
}

#[test]
fn words_are_split_before_values_are_put_in() {
    let output = "a b/it's \"$HOME\"";
    for (text, words) in [
        ("run --cells {cells}", vec!["run", "--cells", "8"]),
        ("run --out={output}", vec!["run", &format!("--out={output}")]),
        ("run '{output}'", vec!["run", output]),
        (r#"run "a b"\ c '$HOME' ''"#, vec!["run", "a b c", "$HOME", ""]),
        ("run {{cells}} }}{cells}{{", vec!["run", "{cells}", "}8{"]),
        ("echo $HOME; rm *", vec!["echo", "$HOME;", "rm", "*"]),
        ("run -p={set.load} {{set.a}}", vec!["run", "-p=<load>", "{set.a}"]),
    ] {
        assert_eq!(filled(text).unwrap(), words, "{text}");
    }
}

#[test]
fn what_is_wrong_is_said() {
    for (text, wrong) in [
        ("run {cels}", Wrong::Unknown("cels".into())),
        ("run {", Wrong::Unpaired('{')),
        ("run }", Wrong::Unpaired('}')),
        ("run {}", Wrong::Unknown(String::new())),
        ("run {set.}", Wrong::Unknown("set.".into())),
        ("run 'x", Wrong::Unclosed),
        ("run x\\", Wrong::Unclosed),
        (" ", Wrong::Empty),
    ] {
        assert_eq!(filled(text), Err(wrong), "{text}");
    }
}
