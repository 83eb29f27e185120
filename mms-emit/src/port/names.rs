//! Names of users as names of a language.

/// The rules of a language for names.
pub struct Rules {
    /// Words that must not name a member.
    pub words: &'static [&'static str],
    /// Words that must not name a file or an item named after it.
    pub modules: &'static [&'static str],
    /// Whether names that differ in case alone are one.
    pub folds_case: bool,
    /// The largest length of a name.
    pub longest: usize,
}

/// Functions of a field, and their arguments: in some languages the module or class around them must not have such a name.
pub const FUNCTIONS: &str = "\
    default_parameters prepare at_time lower upper inner outer theta time_window density wave_speed \
    displacement position velocity acceleration displacement_gradient deformation_gradient jacobian \
    right_cauchy_green left_cauchy_green green_lagrange mass_density strain_energy \
    first_piola_kirchhoff nominal_stress cauchy_stress kirchhoff_stress div_p div_sigma body_force \
    body_force_density current_body_force_density traction now field parameters out t";

impl Rules {
    fn same(&self, a: &str, b: &str) -> bool {
        if self.folds_case { a.eq_ignore_ascii_case(b) } else { a == b }
    }

    fn is_kept(&self, name: &str, words: &[&str]) -> bool {
        let mut lists = words.iter().flat_map(|words| words.split_whitespace());
        lists.any(|word| self.same(word, name))
    }
}

/// A name that the language accepts, close to `name`: letters, digits and underscores, with no digit or underscore at the
/// beginning, and an underscore at the end only if the name is a word of the language.
pub fn sanitised(name: &str, rules: &Rules, words: &[&str]) -> String {
    let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut own: String = name.chars().map(word).collect();
    if !own.starts_with(|first: char| first.is_ascii_alphabetic()) {
        own.insert_str(0, if own.starts_with('_') { "p" } else { "field_" });
    }
    own.truncate(rules.longest);
    while rules.is_kept(&own, words) {
        own = suffixed(&own, "_", rules.longest);
    }
    own
}

/// The name of the module or class around the functions: in a language where it must differ from their names, it also
/// differs from the names of their faces for C.
pub fn of_holder(name: &str, rules: &Rules, functions: &[&str]) -> String {
    let mut own = sanitised(name, rules, rules.modules);
    let keeps = rules.modules.contains(&FUNCTIONS);
    let is = |function: &str, own: &str| {
        rules.same(function, own) || rules.same(&format!("{function}_c"), own)
    };
    while keeps && functions.iter().any(|function| is(function, &own)) {
        own = suffixed(&own, "_", rules.longest);
    }
    own
}

/// Names that emitted code and its check programs use inside functions, in some language.
const INNER: &str = "\
    default_parameters prepare at_time now field fields parameters out t x y z set point found expected of_c \
    rows given at worst failures points_count sets_count compare check_defaults prepare_all defaults value self \
    wp dp count index result check_open check_table check_unit check_accepted";

/// The name of a function of a file's own quantity, given the names of the other functions.
pub fn of_own(name: &str, rules: &Rules, functions: &[&str]) -> String {
    let mut own = sanitised(name, rules, rules.words);
    let is_inner = |own: &str| {
        let letters = own.trim_end_matches(|it: char| it.is_ascii_digit());
        let is_numbered = letters.len() < own.len()
            && ["q", "w", "n", "h"].iter().any(|it| it.eq_ignore_ascii_case(letters));
        let mut inner = INNER.split_whitespace();
        is_numbered || inner.any(|word| word.eq_ignore_ascii_case(own))
    };
    while is_inner(&own) || functions.iter().any(|function| rules.same(function, &own)) {
        own = suffixed(&own, "_", rules.longest);
    }
    own
}

/// Distinct names as distinct names of the language: if two collide, the one that had to be changed is renamed, or the
/// later one.
pub fn unique(names: &[&str], rules: &Rules) -> Vec<String> {
    let wished: Vec<String> =
        names.iter().map(|name| sanitised(name, rules, rules.words)).collect();
    let mut taken: Vec<String> = Vec::new();
    let own = |index: usize| wished[index] == names[index];
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|index| !own(*index));
    let mut result = vec![String::new(); names.len()];
    for index in order {
        let mut name = wished[index].clone();
        let mut count = 1;
        while taken.iter().any(|other| rules.same(other, &name))
            || rules.is_kept(&name, rules.words)
        {
            count += 1;
            name = suffixed(&wished[index], &format!("_{count}"), rules.longest);
        }
        taken.push(name.clone());
        result[index] = name;
    }
    result
}

fn suffixed(name: &str, suffix: &str, longest: usize) -> String {
    let kept = name.len().min(longest - suffix.len());
    format!("{}{suffix}", &name[..kept])
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: Rules =
        Rules { words: &["end if"], modules: &["math"], folds_case: true, longest: 8 };

    #[test]
    fn names_stay_apart() {
        let names = ["end", "end_", "End", "a", "A", "_", "a_rather_long", "a_rather_low"];
        let own = ["end__2", "end_", "End__2", "a", "A_2", "p_", "a_rather", "a_rath_2"];
        let found = unique(&names, &RULES);
        assert_eq!(found[1], own[1]);
        for (index, name) in found.iter().enumerate() {
            assert!(name.len() <= RULES.longest && !RULES.is_kept(name, RULES.words), "{name}");
            assert!(!found[..index].iter().any(|other| RULES.same(other, name)), "{found:?}");
        }
        assert_eq!((found[3].as_str(), found[4].as_str()), ("a", "A_2"));
        assert_eq!(found, unique(&names, &RULES));
    }

    #[test]
    fn a_stem_may_hold_anything() {
        let stem = |name| sanitised(name, &RULES, RULES.modules);
        assert_eq!(stem("2d"), "field_2d");
        assert_eq!(stem("\u{3bb}-x"), "p__x");
        assert_eq!(stem("math"), "math_");
        assert_eq!(stem("end"), "end");
        let rules = Rules { modules: &[FUNCTIONS], longest: 57, ..RULES };
        let holder = |name, rules| of_holder(name, rules, &["x_max_traction"]);
        assert_eq!(holder("X_max_traction", &rules), "X_max_traction_");
        assert_eq!(holder("x_max_traction_c", &rules), "x_max_traction_c_");
        assert_eq!(holder("jacobian", &rules), "jacobian_");
        assert_eq!(holder("x_max_traction", &Rules { modules: &[], ..rules }), "x_max_traction");
    }
}
