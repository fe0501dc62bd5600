//! Identifiers of Structured Text. Case does not count; no underscore stands at an end or beside another one.

use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Longest identifier; old tools take no longer ones.
const LONGEST: usize = 32;

/// Words that some compiler of Structured Text does not take as the name of a variable: keywords, words of
/// sequential charts and of instruction lists, types, standard functions and function blocks.
const RESERVED: &str = "
    abs abstract acos action add adr and andn any any_bit any_char any_chars any_date any_derived
    any_duration any_elementary any_int any_magnitude any_num any_real any_signed any_string
    any_unsigned array asin at atan atan2 bitadr bool by byte cal calc calcn case catch cd ceil char
    class concat config configuration constant continue cos ctd ctu ctud cu date date_and_time
    delete derivative dint div divtime do dref dt dword else elsif en end_action end_case end_class
    end_configuration end_for end_function end_function_block end_if end_interface end_method
    end_namespace end_program end_repeat end_resource end_step end_struct end_transition end_type
    end_union end_var end_while endtry eno eq exit exp expt extends f_edge f_trig false final
    finally find floor for from function function_block ge get gt hysteresis if implements inc
    initial_step insert int integral interface internal interval jmp jmpc jmpcn ld ldate ldn ldt le
    left len limit lint ln log lower_bound lreal lt ltime ltod lword main max method mid min mod
    move mul multime mux namespace ne nil non_retain not null of on or orn overlap override params
    persistent pid plc_prg pointer priority private program property protected public pv r1 r_edge
    r_trig ramp read_only read_write real ref ref_to reference repeat replace reset_ld resource ret
    retain retc retcn return right rol ror round rs rtc s1 sel self sema set shl shr sin single sint
    sizeof sqrt sr st stat step stn string struct sub super tan task then this throw time
    time_of_day to tod tof ton tp transition true trunc try type udint uint ulint union union_end
    until upper_bound using usint var var_access var_config var_external var_global var_in_out
    var_input var_output var_temp wchar while with word wstring xor xorn
";

/// Standard functions that some compiler has once for each type as well, as `max_time`.
const TYPED: &str = "
    abs acos add and any asin atan concat cos ctd ctu ctud div divtime eq exp ge gt le limit ln log
    lt max min mod move mul multime mux ne not or sel sin sqrt sub tan xor
";

/// Words of the names of types, and those between them in names of conversions.
const TYPES: &str = "
    any bool byte word dword lword sint int dint lint usint uint udint ulint real lreal time date
    tod dt string wstring of day and bcd
";

/// Constants of the C library: matiec makes C of the text, with all names in capitals.
const CONSTANTS_OF_C: &str = "
    aio_prio_delta_max bc_base_max bc_dim_max bc_scale_max bc_string_max big_endian bufsiz
    byte_order char_bit char_max char_min charclass_name_max coll_weights_max dbl_decimal_dig
    dbl_dig dbl_epsilon dbl_has_subnorm dbl_mant_dig dbl_max dbl_max_10_exp dbl_max_exp dbl_min
    dbl_min_10_exp dbl_min_exp dbl_true_min decimal_dig delaytimer_max en_eno en_eno_params eof
    epoch_year exit_failure exit_success expr_nest_max fd_setsize filename_max flt_decimal_dig
    flt_dig flt_epsilon flt_eval_method flt_has_subnorm flt_mant_dig flt_max flt_max_10_exp
    flt_max_exp flt_min flt_min_10_exp flt_min_exp flt_radix flt_rounds flt_true_min fopen_max
    fp_ilogb0 fp_ilogbnan fp_infinite fp_nan fp_normal fp_subnormal fp_zero host_name_max huge_val
    huge_valf huge_vall iec_types_all_h iec_types_h infinity int16_max int16_min int32_max int32_min
    int64_max int64_min int8_max int8_min int_fast16_max int_fast16_min int_fast32_max
    int_fast32_min int_fast64_max int_fast64_min int_fast8_max int_fast8_min int_least16_max
    int_least16_min int_least32_max int_least32_min int_least64_max int_least64_min int_least8_max
    int_least8_min int_max int_min intmax_max intmax_min intptr_max intptr_min ldbl_decimal_dig
    ldbl_dig ldbl_epsilon ldbl_has_subnorm ldbl_mant_dig ldbl_max ldbl_max_10_exp ldbl_max_exp
    ldbl_min ldbl_min_10_exp ldbl_min_exp ldbl_true_min line_max little_endian llong_max llong_min
    login_name_max long_max long_min m_1_pi m_2_pi m_2_sqrtpi m_e m_ln10 m_ln2 m_log10e m_log2e m_pi
    m_pi_2 m_pi_4 m_sqrt1_2 m_sqrt2 math_errexcept math_errno max_canon max_input mb_cur_max
    mb_len_max mq_prio_max name_max nan nfdbits ngroups_max path_max pdp_endian pipe_buf
    pthread_destructor_iterations pthread_keys_max pthread_stack_min ptrdiff_max ptrdiff_min
    rand_max re_dup_max rtsig_max schar_max schar_min seconds_per_day seconds_per_hour
    seconds_per_minute seek_cur seek_end seek_set sem_value_max shrt_max shrt_min sig_atomic_max
    sig_atomic_min size_max ssize_max str_max_len tmp_max tty_name_max uchar_max uint16_max
    uint32_max uint64_max uint8_max uint_fast16_max uint_fast32_max uint_fast64_max uint_fast8_max
    uint_least16_max uint_least32_max uint_least64_max uint_least8_max uint_max uintmax_max
    uintptr_max ullong_max ulong_max ushrt_max wchar_max wchar_min wcontinued wexited wint_max
    wint_min wnohang wnowait wstopped wuntraced xattr_list_max xattr_name_max xattr_size_max
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
        let mut stem = plain(wanted);
        let mut reason = if stem == wanted { "" } else { "an underscore at an end or beside another one" };
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
    static WORDS: LazyLock<[BTreeSet<&str>; 4]> = LazyLock::new(|| {
        [RESERVED, CONSTANTS_OF_C, TYPED, TYPES].map(|words| words.split_whitespace().collect())
    });
    let [reserved, constants, typed, types] = &*WORDS;
    let name = name.to_ascii_lowercase();
    let are_types = |words: &str| words.split('_').all(|word| types.contains(word));
    reserved.contains(name.as_str())
        || constants.contains(name.as_str())
        || name.split_once('_').is_some_and(|(function, of)| typed.contains(function) && are_types(of))
        || name.split_once("_to_").is_some_and(|(from, to)| are_types(from) && are_types(to))
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
        let given: Vec<_> = ["max_time", "Dint_to_LReal", "nan", "max_speed"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["max_time_v", "Dint_to_LReal_v", "nan_v", "max_speed"]);
    }
}
