//! Words that some compiler of Structured Text does not take as a name. Case does not count.

use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Keywords, words of sequential charts and of instruction lists, types, standard functions and function blocks.
const WORDS: &str = "
    abs abstract acos action add adr and and_then andn any any_bit any_char any_chars any_date
    any_chars any_derived any_duration any_elementary any_int any_magnitude any_num any_real any_signed
    any_string any_unsigned adrinst array asin at atan atan2 bit bitadr bool by byte cal calc calcn case catch
    cd ceil char class concat config configuration constant continue cos ctd ctu ctud cu date
    date_and_time delete derivative dint div divtime do dref dt dword else elsif en end_action
    end_case end_class end_configuration end_for end_function end_function_block end_get end_if
    end_interface end_method end_namespace end_program end_property end_repeat end_resource end_set
    end_step end_struct end_task end_test_function_block end_test_program end_transition end_type
    end_union end_var end_while endtry eno eq exit exp expt extends f_edge f_trig false final
    finally find floor for from function function_block ge get gt hysteresis if implements inc
    indexof ini initial_step insert int integral interface internal interval jmp jmpc jmpcn ld ldate
    ldate_and_time ldn ldt le left len limit lint ln log lower_bound lreal lt ltime ltime_of_day
    ltod lword main max method mid min mod move mul multime mux namespace ne new nil non_retain not
    null of on or or_else orn overlap override params persistent pid plc_prg pointer priority private
    program property protected public pv r r1 r_edge r_trig ramp read_only read_write real ref ref_to
    reference repeat replace reset_ld resource ret retain retc retcn return right rol ror round rs
    rtc s s1 sel self sema set shl shr sin single sint sizeof sqrt sr st stat step stn string struct
    sub super tan task test_and_set test_function_block test_program then this throw time time_of_day to tod tof
    ton tp transition true trunc trunc_int try type udint uint ulint union union_end until upper_bound using
    usint uxint var var_access var_config var_external var_generic var_global var_in_out var_inst var_input var_output var_stat
    var_temp wchar while with word wstring xint xor xorn
    xsizeof xword
";

/// Function blocks of the library of OpenPLC's runtime v3 that stand in no other list.
const BLOCKS_OF_OPENPLC: &str = "
    rotary_switch slm_04thm_config slm_analog_in_4 slm_analog_in_8 slm_analog_out_4 slm_analog_out_8
    slm_discrete_in_16 slm_discrete_in_8 slm_discrete_out_15 slm_discrete_out_16 slm_discrete_out_8
    slm_init slm_temperature_4 sm_16din sm_16relay sm_4rel4in sm_8din sm_8mosfet sm_8relay sm_bas
    sm_home sm_industrial sm_rtd tcp_close tcp_connect tcp_receive tcp_send
";

/// Standard functions that some compiler has once for each type as well, as `max_time`.
const TYPED: &str = "
    abs acos add and any asin atan concat cos ctd ctu ctud div divtime eq exp ge gt le limit ln log
    lt max min mod move mul multime mux ne not or sel sin sqrt sub tan xor
";

/// Words of the names of types, and those between them in names of conversions.
const TYPES: &str = "
    any bool byte char wchar word dword lword sint int dint lint usint uint udint ulint real lreal time date
    tod dt string wstring of day and bcd
";

/// Macros in capitals of the C headers below the text, with their source in the lines of `#`.
const MACROS_OF_C: &str = include_str!("macros_of_c.txt");

/// What matiec finds inside of words too: it looks for the end of a unit before it knows words, and for the
/// first step of a chart at the beginning of a body.
const END: &str = "end_";
const ENDED: [&str; 5] = ["program", "function", "configuration", "action", "transition"];
const FOUND_IN_FRONT: &str = "initial_step";

/// Whether a compiler refuses the whole word.
pub fn is_reserved(name: &str) -> bool {
    static LISTED: LazyLock<[BTreeSet<&str>; 3]> = LazyLock::new(|| {
        let macros = MACROS_OF_C.lines().filter(|line| !line.starts_with('#'));
        let words = [WORDS, BLOCKS_OF_OPENPLC].into_iter().chain(macros).flat_map(str::split_whitespace);
        [words.collect(), TYPED.split_whitespace().collect(), TYPES.split_whitespace().collect()]
    });
    let [words, typed, types] = &*LISTED;
    let name = name.to_ascii_lowercase();
    let are_types = |words: &str| words.split('_').all(|word| types.contains(word));
    words.contains(name.as_str())
        || name.strip_prefix("to_").or_else(|| name.strip_suffix("_to")).is_some_and(are_types)
        || name.split_once('_').is_some_and(|(function, of)| typed.contains(function) && are_types(of))
        || name.split_once("_to_").is_some_and(|(from, to)| are_types(from) && are_types(to))
}

/// Where matiec would take a part of a name for a keyword: the place of the underscore within that keyword.
pub fn keyword_inside(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    if name.starts_with(FOUND_IN_FRONT) {
        return FOUND_IN_FRONT.find('_');
    }
    let ends = name.match_indices(END).map(|(at, _)| at + END.len());
    let mut ends = ends.filter(|end| ENDED.iter().any(|unit| name[*end..].starts_with(unit)));
    ends.next().map(|end| end - 1)
}
