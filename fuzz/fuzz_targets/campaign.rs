//! Reads any text as a campaign file: reading must end, with a campaign or its mistakes, and so must counting its levels
//! and filling its words.

#![no_main]

use libfuzzer_sys::fuzz_target;
use mms_campaign::read;
use mms_campaign::template::Template;

fuzz_target!(|text: &str| {
    let _ = Template::words(text);
    match read("campaign.toml", text) {
        Err(mistakes) => drop(mistakes.to_string()),
        Ok(campaign) => {
            for study in &campaign.studies {
                for level in 1..=study.levels().min(1000) {
                    let _ = (study.cells_of(level), study.time_step_of(level), study.h_of(level));
                }
            }
            let fill = |it: &Template| it.fill(|placeholder| placeholder.name().to_owned());
            let words: Vec<String> = campaign.solver.run.iter().map(fill).collect();
            assert_eq!(words.len(), campaign.solver.run.len());
        }
    }
});
