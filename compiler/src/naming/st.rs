//! Identifiers of Structured Text. Case does not count; no underscore stands at an end or beside another one.

use std::collections::BTreeSet;

/// Longest identifier; old tools take no longer ones.
const LONGEST: usize = 32;

/// Words that some compiler of Structured Text does not take as the name of a variable: keywords, words of
/// sequential charts and of instruction lists, types, standard functions and function blocks.
const RESERVED: &str = "
    abs abstract acos action add adr and andn any any_bit any_int any_num any_real array asin at atan
    atan2 bitadr bool by byte cal calc calcn case catch cd char class concat configuration constant
    continue cos ctd ctu ctud cu date date_and_time delete dint div do dt dword else elsif en end_action
    end_case end_class end_configuration end_for end_function end_function_block end_if end_interface
    end_method end_namespace end_program end_repeat end_resource end_step end_struct end_transition
    end_type end_union end_var end_while endtry eno eq exit exp expt extends f_edge f_trig false final
    finally find floor for from function function_block ge get gt if implements inc initial_step insert
    int interface internal interval jmp jmpc jmpcn ld ldate ldn ldt le left len limit lint ln log
    lower_bound lreal lt ltime ltod lword main max method mid min mod move mul mux namespace ne nil
    non_retain not null of on or orn overlap override persistent plc_prg pointer priority private
    program property protected public pv r1 r_edge r_trig read_only read_write real ref ref_to reference
    repeat replace reset_ld resource ret retain retc retcn return right rol ror round rs rtc s1 sel self
    sema set shl shr sin single sint sizeof sqrt sr st stat step stn string struct sub super tan task
    then this throw time time_of_day to tod tof ton tp transition true trunc try type udint uint ulint
    union union_end until upper_bound using usint var var_access var_config var_external var_global
    var_in_out var_input var_output var_temp wchar while with word wstring xor xorn
";

/// A name that could not stay as the specification has it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Renamed {
    pub wanted: String,
    pub name: String,
    pub reason: &'static str,
}

/// Names that stand side by side, all different even if case is ignored.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// In lower case.
    taken: BTreeSet<String>,
    renamed: Vec<Renamed>,
}

impl Scope {
    pub fn new(taken: &[&str]) -> Self {
        Self { taken: taken.iter().map(|name| name.to_ascii_lowercase()).collect(), renamed: Vec::new() }
    }

    /// A scope inside this one: no name of this one is given again.
    pub fn inner(&self) -> Self {
        Self { taken: self.taken.clone(), renamed: Vec::new() }
    }

    pub fn take(&mut self, wanted: &str) -> String {
        self.take_all(wanted, &[""]).concat()
    }

    /// One identifier for each suffix, with the same beginning: the wanted one, cut if it is too long, with
    /// `_v` behind it if it is reserved, with a number behind it if it was given away before.
    pub fn take_all(&mut self, wanted: &str, suffixes: &[&str]) -> Vec<String> {
        let longest = LONGEST - suffixes.iter().map(|s| s.len()).max().unwrap_or(0);
        let mut reason = "";
        let mut stem = plain(wanted);
        if stem.len() > longest {
            stem = cut(&stem, longest);
            reason = "longer than 32 characters";
        }
        if suffixes.iter().any(|suffix| is_reserved(&format!("{stem}{suffix}"))) {
            stem = format!("{}_v", cut(&stem, longest - 2));
            reason = "reserved word";
        }
        let mut found = stem.clone();
        for number in 2.. {
            if suffixes.iter().all(|suffix| !self.taken.contains(&lower(&found, suffix))) {
                break;
            }
            let tail = format!("_{number}");
            found = cut(&stem, longest - tail.len()) + &tail;
            reason = "name given away before; case does not count";
        }
        suffixes
            .iter()
            .map(|suffix| {
                self.taken.insert(lower(&found, suffix));
                let name = format!("{found}{suffix}");
                if !reason.is_empty() {
                    self.renamed.push(Renamed {
                        wanted: format!("{wanted}{suffix}"),
                        name: name.clone(),
                        reason,
                    });
                }
                name
            })
            .collect()
    }

    pub fn renamed(&self) -> &[Renamed] {
        &self.renamed
    }
}

fn lower(stem: &str, suffix: &str) -> String {
    format!("{stem}{suffix}").to_ascii_lowercase()
}

pub fn is_reserved(name: &str) -> bool {
    RESERVED.split_whitespace().any(|word| word.eq_ignore_ascii_case(name))
}

/// Without underscores at the ends or beside each other.
fn plain(name: &str) -> String {
    name.split('_').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

fn cut(name: &str, longest: usize) -> String {
    plain(&name.chars().take(longest).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_renamed_by_rule() {
        let mut scope = Scope::new(&["state"]);
        let given: Vec<_> = ["step", "State", "x", "X", "a__b_"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["step_v", "State_2", "x", "X_2", "a_b"]);
        let long = "a_name_that_is_longer_than_old_tools_take";
        assert_eq!(scope.take(long), "a_name_that_is_longer_than_old_t");
        assert_eq!(
            scope.take_all(long, &["_x", "_y"]),
            ["a_name_that_is_longer_than_old_x", "a_name_that_is_longer_than_old_y"]
        );
        assert_eq!(scope.take(long), "a_name_that_is_longer_than_old_2");
        assert_eq!(scope.take_all("at", &["_x", "_y", "_z"]), ["at_x", "at_y", "at_z"]);
    }
}
