//! The evaluator, a test for each rule of the language.

use autogen_st_judge::listed;
use autogen_st_judge::machine::{Machine, RunError, TrapKind};

const GLOBALS: &str = "\
    b : BOOL; c : BOOL; i : DINT; j : DINT; k : DINT := 5; x : LREAL; y : LREAL; \
    a : ARRAY[0..3] OF DINT; r : ARRAY[0..1] OF LREAL; t : ARRAY[0..2] OF BOOL;";

fn machine(units: &str, locals: &str, body: &str) -> Machine {
    let externals: String = GLOBALS.replace(" := 5", "");
    let source = format!(
        "{units}\nPROGRAM Run\nVAR_EXTERNAL {externals} END_VAR\nVAR here : DINT := 7; {locals} END_VAR\n{body}\nEND_PROGRAM\n\
         CONFIGURATION Conf\nVAR_GLOBAL {GLOBALS} END_VAR\nRESOURCE Res ON PLC\n\
         TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\nPROGRAM Inst WITH Cyclic : Run;\nEND_RESOURCE\nEND_CONFIGURATION\n"
    );
    Machine::new(&source).unwrap_or_else(|findings| panic!("{}{source}", listed(&findings, &source)))
}

fn ran(body: &str) -> Machine {
    let mut machine = machine("", "", body);
    machine.scan().unwrap_or_else(|error| panic!("{body}: {error}"));
    machine
}

fn trap(body: &str) -> TrapKind {
    machine("", "", body).scan().expect_err(body).kind
}

#[test]
fn assignment_stores() {
    let machine = ran("i := 3; b := TRUE; x := 2.5E-3;");
    assert_eq!((machine.get("i"), machine.get("b"), machine.get("x")), (3.0, 1.0, 0.0025));
}

#[test]
fn names_are_compared_without_case() {
    assert_eq!(ran("I := 3;").get("i"), 3.0);
}

#[test]
fn whole_numbers_are_added_subtracted_multiplied() {
    assert_eq!(ran("i := (k * 3) - (k + 1);").get("i"), 9.0);
    assert_eq!(ran("i := -k;").get("i"), -5.0);
}

#[test]
fn whole_numbers_do_not_wrap() {
    for body in [
        "i := 2147483647; i := i + 1;",
        "i := -2147483648; i := i - 1;",
        "i := 65536; i := i * i;",
        "i := -2147483648; i := -i;",
        "i := -2147483648; i := i / (-1);",
        "i := -2147483648; i := ABS(i);",
        "x := 1.0E10; i := TRUNC(x);",
    ] {
        assert_eq!(trap(body), TrapKind::Overflow, "{body}");
    }
}

#[test]
fn division_truncates_towards_zero() {
    assert_eq!(ran("i := -7; i := i / 2;").get("i"), -3.0);
    assert_eq!(ran("i := 7; i := i / 2;").get("i"), 3.0);
}

#[test]
fn the_remainder_has_the_sign_of_the_left_side() {
    assert_eq!(ran("i := -7; i := i MOD 2;").get("i"), -1.0);
    assert_eq!(ran("i := 7; i := i MOD (-2);").get("i"), 1.0);
}

#[test]
fn nothing_is_divided_by_zero() {
    for body in ["i := k / j;", "i := k MOD j;", "x := 1.0 / y;"] {
        assert_eq!(trap(body), TrapKind::DivisionByZero, "{body}");
    }
}

#[test]
fn real_numbers_are_64_bit() {
    let machine = ran("x := 0.1 + 0.2; y := (1.0 / 3.0) * 3.0;");
    assert_eq!(machine.get("x").to_bits(), (0.1f64 + 0.2).to_bits());
    assert_eq!(machine.get("y").to_bits(), (1.0f64 / 3.0 * 3.0).to_bits());
    assert_eq!(ran("x := 0.0; x := -x;").get("x").to_bits(), (-0.0f64).to_bits());
}

#[test]
fn chains_go_from_left_to_right() {
    let machine = ran("x := 1.0E30; y := (x + (-1.0E30)) + 1.0; x := x + (-1.0E30) + 1.0;");
    assert_eq!((machine.get("x"), machine.get("y")), (1.0, 1.0));
}

#[test]
fn comparisons_of_nan_are_false_but_unequal() {
    let mut machine = machine("", "", "t[0] := x = x; t[1] := x <> x; t[2] := (x < y) OR (x >= y);");
    machine.set("x", f64::NAN);
    machine.scan().unwrap();
    assert_eq!([0, 1, 2].map(|i| machine.get(&format!("t[{i}]"))), [0.0, 1.0, 0.0]);
}

#[test]
fn infinite_is_no_trap_where_nothing_is_divided() {
    let mut machine = machine("", "", "x := y * 2.0; b := (y - y) = 0.0;");
    machine.set("y", f64::INFINITY);
    machine.scan().unwrap();
    assert_eq!((machine.get("x"), machine.get("b")), (f64::INFINITY, 0.0));
}

#[test]
fn whole_numbers_are_compared() {
    for (operator, results) in [
        ("<", [1., 0., 0.]),
        ("<=", [1., 1., 0.]),
        ("=", [0., 1., 0.]),
        ("<>", [1., 0., 1.]),
        (">=", [0., 1., 1.]),
        (">", [0., 0., 1.]),
    ] {
        let machine =
            ran(&format!("t[0] := 1 {operator} 2; t[1] := 2 {operator} 2; t[2] := 3 {operator} 2;"));
        assert_eq!([0, 1, 2].map(|i| machine.get(&format!("t[{i}]"))), results, "{operator}");
    }
}

#[test]
fn truths_are_combined() {
    for (operator, table) in [
        ("AND", [0., 0., 0., 1.]),
        ("OR", [0., 1., 1., 1.]),
        ("XOR", [0., 1., 1., 0.]),
        ("=", [1., 0., 0., 1.]),
        ("<>", [0., 1., 1., 0.]),
    ] {
        let operands = ["FALSE", "TRUE"];
        for (i, result) in table.into_iter().enumerate() {
            let machine = ran(&format!("b := {} {operator} {};", operands[i / 2], operands[i % 2]));
            assert_eq!(machine.get("b"), result, "{operator} {i}");
        }
    }
    assert_eq!(ran("c := FALSE; b := NOT c;").get("b"), 1.0);
}

#[test]
fn both_sides_of_and_and_or_are_evaluated() {
    assert_eq!(trap("b := (j <> 0) AND ((10 / j) > 1);"), TrapKind::DivisionByZero);
    assert_eq!(trap("b := (j = 0) OR ((10 / j) > 1);"), TrapKind::DivisionByZero);
    assert_eq!(trap("b := FALSE AND t[k];"), TrapKind::Index);
    assert_eq!(ran("IF j <> 0 THEN b := (10 / j) > 1; END_IF;").get("b"), 0.0);
}

#[test]
fn elements_stand_side_by_side() {
    let machine = ran("i := 0; WHILE i <= 3 DO a[i] := i * 10; i := i + 1; END_WHILE; j := a[a[0] + 2];");
    assert_eq!([0, 1, 2, 3].map(|i| machine.get(&format!("a[{i}]"))), [0., 10., 20., 30.]);
    assert_eq!((machine.get("j"), machine.get("k")), (20.0, 5.0));
}

#[test]
fn an_index_is_tested() {
    for body in ["j := a[k];", "a[k] := 1;", "i := -1; a[i] := 1;"] {
        assert_eq!(trap(body), TrapKind::Index, "{body}");
    }
}

#[test]
fn the_first_branch_that_holds_is_taken() {
    let body = "IF i > 2 THEN j := 1; ELSIF i > 1 THEN j := 2; ELSIF i > 0 THEN j := 3; ELSE j := 4; END_IF;";
    for (i, j) in [(3., 1.), (2., 2.), (1., 3.), (0., 4.)] {
        let mut machine = machine("", "", body);
        machine.set("i", i);
        machine.scan().unwrap();
        assert_eq!(machine.get("j"), j);
    }
}

#[test]
fn case_takes_the_branch_of_the_label_and_counts_it() {
    let body = "CASE i OF 1: j := 10; 2, -3: j := 20; ELSE j := 30; END_CASE;";
    let mut machine = machine("", "", body);
    for (i, j) in [(1., 10.), (2., 20.), (-3., 20.), (4., 30.)] {
        machine.set("i", i);
        machine.scan().unwrap();
        assert_eq!(machine.get("j"), j);
    }
    let entered: Vec<_> = machine.branches().into_iter().map(|b| (b.unit, b.label, b.entered)).collect();
    let run = "Run".to_string();
    assert_eq!(
        entered,
        [(run.clone(), "1".into(), 1), (run.clone(), "2, -3".into(), 2), (run.clone(), "ELSE".into(), 1)]
    );
}

#[test]
fn while_tests_before_and_exit_leaves_the_inner_loop() {
    assert_eq!(ran("WHILE FALSE DO i := 1; END_WHILE;").get("i"), 0.0);
    let body = "WHILE i < 3 DO j := 0; WHILE TRUE DO j := j + 1; IF j >= 2 THEN EXIT; END_IF; END_WHILE; \
                i := i + 1; a[0] := a[0] + j; END_WHILE;";
    assert_eq!(ran(body).get("a[0]"), 6.0);
}

#[test]
fn a_loop_without_end_is_an_error() {
    assert_eq!(trap("WHILE TRUE DO i := 1; END_WHILE;"), TrapKind::EndlessLoop);
}

#[test]
fn an_error_has_its_place() {
    let error: RunError = machine("", "", "i := 1;\n  j := k / (i - 1);").scan().unwrap_err();
    assert_eq!((error.line, error.column), (6, 8));
}

const ADDER: &str = "FUNCTION F_add : DINT\nVAR_INPUT p : DINT; q : DINT; END_VAR\nVAR n : DINT := 100; END_VAR\n\
                     n := n + p;\nF_add := n + q;\nEND_FUNCTION\n";

#[test]
fn a_function_takes_arguments_by_name_and_forgets_its_locals() {
    let mut machine =
        machine(ADDER, "", "i := F_add(q := 1, p := 20); j := F_add(p := F_add(p := 1, q := 2), q := 4);");
    for _ in 0..2 {
        machine.scan().unwrap();
        assert_eq!((machine.get("i"), machine.get("j")), (21.0, 7.0));
    }
}

#[test]
fn return_leaves_a_function() {
    let early = "FUNCTION F_sign : DINT\nVAR_INPUT p : DINT; END_VAR\nIF p < 0 THEN F_sign := -1; RETURN; END_IF;\nF_sign := 1;\nEND_FUNCTION\n";
    let mut machine = machine(early, "", "i := F_sign(p := -5); j := F_sign(p := 5);");
    machine.scan().unwrap();
    assert_eq!((machine.get("i"), machine.get("j")), (-1.0, 1.0));
}

const COUNTER: &str = "FUNCTION_BLOCK FB_Count\nVAR_INPUT by1 : DINT := 50; END_VAR\nVAR_OUTPUT total : DINT := 60; END_VAR\n\
                       VAR_EXTERNAL k : DINT; a : ARRAY[0..3] OF DINT; END_VAR\nVAR calls : DINT := 70; END_VAR\n\
                       calls := calls + 1;\ntotal := total + by1;\nk := calls;\na[1] := total;\nEND_FUNCTION_BLOCK\n";

#[test]
fn an_instance_keeps_its_values_and_others_have_their_own() {
    let mut machine = machine(
        COUNTER,
        "one : FB_Count; two : FB_Count;",
        "one(by1 := 2); one(by1 := 3); two(by1 := 10); i := one.total; j := two.total;",
    );
    machine.scan().unwrap();
    assert_eq!(
        (machine.get("i"), machine.get("j"), machine.get("k"), machine.get("a[1]")),
        (5.0, 10.0, 1.0, 10.0)
    );
    machine.scan().unwrap();
    assert_eq!((machine.get("i"), machine.get("j"), machine.get("k")), (10.0, 20.0, 2.0));
    assert_eq!((machine.get("one.calls"), machine.get("ONE.by1")), (4.0, 3.0));
}

#[test]
fn initial_values_of_blocks_do_not_count_and_those_of_programs_and_globals_do() {
    let mut machine = machine(COUNTER, "one : FB_Count;", "i := one.total; j := here; here := 8;");
    machine.scan().unwrap();
    assert_eq!((machine.get("i"), machine.get("j"), machine.get("k")), (0.0, 7.0, 5.0));
    machine.scan().unwrap();
    assert_eq!(machine.get("j"), 8.0);
}

#[test]
fn a_block_in_a_block() {
    let outer = format!(
        "{COUNTER}FUNCTION_BLOCK FB_Outer\nVAR_INPUT n : DINT; END_VAR\nVAR_OUTPUT m : DINT; END_VAR\nVAR inner : FB_Count; END_VAR\n\
         inner(by1 := n);\nm := inner.total * 2;\nEND_FUNCTION_BLOCK\n"
    );
    let mut machine = machine(&outer, "o : FB_Outer;", "o(n := 4); i := o.m;");
    machine.scan().unwrap();
    machine.scan().unwrap();
    assert_eq!((machine.get("i"), machine.get("o.inner.total")), (16.0, 8.0));
}

#[test]
fn var_in_out_is_copied_in_and_back() {
    let block = "FUNCTION_BLOCK FB_Swap\nVAR_IN_OUT p : DINT; q : DINT; END_VAR\nVAR n : DINT; END_VAR\nn := p;\np := q;\nq := n;\nEND_FUNCTION_BLOCK\n";
    let mut machine = machine(block, "swap : FB_Swap;", "i := 1; j := 2; swap(p := i, q := j);");
    machine.scan().unwrap();
    assert_eq!((machine.get("i"), machine.get("j")), (2.0, 1.0));
}

#[test]
fn standard_functions() {
    let whole = ran(
        "a[0] := MIN(3, -2); a[1] := MAX(3, -2); a[2] := LIMIT(0, 9, 4); a[3] := SEL(TRUE, 1, 2); i := ABS(-6); j := TRUNC(-2.7);",
    );
    assert_eq!([0, 1, 2, 3].map(|i| whole.get(&format!("a[{i}]"))), [-2., 3., 4., 2.]);
    assert_eq!((whole.get("i"), whole.get("j")), (6.0, -2.0));
    let real = ran(
        "r[0] := SQRT(2.0); r[1] := EXPT(2.0, 10.0); x := DINT_TO_LREAL(k); y := ATAN(1.0); i := BOOL_TO_DINT(TRUE);",
    );
    assert_eq!((real.get("r[0]"), real.get("r[1]")), (2f64.sqrt(), 1024.0));
    assert_eq!((real.get("x"), real.get("y"), real.get("i")), (5.0, 1f64.atan(), 1.0));
    assert_eq!(trap("x := SQRT(-1.0);"), TrapKind::Domain);
    assert_eq!(trap("x := LN(0.0);"), TrapKind::Domain);
}

#[test]
fn inputs_of_the_machine_stay_until_they_are_set_again() {
    let mut machine = machine("", "", "i := i + j;");
    machine.set("j", 2.0);
    machine.scan().unwrap();
    machine.scan().unwrap();
    assert_eq!(machine.get("i"), 4.0);
    assert!(
        machine.place("no_such").is_none() && machine.place("a[4]").is_none() && machine.place("a").is_none()
    );
    assert_eq!(machine.interval_ms(), Some(10));
}

#[test]
fn statements_are_counted() {
    let mut machine = machine("", "", "i := 1;\nIF i > 5 THEN\n  j := 2;\nELSE\n  j := 3;\nEND_IF;");
    machine.scan().unwrap();
    assert_eq!((machine.statements(), machine.executed()), (4, 3));
    assert_eq!(machine.never_executed(), [(7, "j := 2;".to_string())]);
}

#[test]
fn a_round_of_a_loop_counts_one_more() {
    // The loop, three rounds of a test and an assignment.
    assert_eq!(ran("WHILE i < 3 DO i := i + 1; END_WHILE;").executed(), 1 + 3 * 2);
}

#[test]
fn the_longest_call_of_a_unit_is_kept() {
    let source = "FUNCTION Twice : DINT\nVAR_INPUT a : DINT; END_VAR\nTwice := a + a;\nEND_FUNCTION\n\
        FUNCTION_BLOCK Count\nVAR_INPUT up : BOOL; END_VAR\nVAR n : DINT; END_VAR\n\
        IF up THEN\nn := Twice(a := n);\nn := n + 1;\nEND_IF;\nEND_FUNCTION_BLOCK\n\
        PROGRAM Run\nVAR_EXTERNAL going : BOOL; END_VAR\nVAR c : Count; END_VAR\n\
        c(up := going);\nc(up := FALSE);\nEND_PROGRAM\n\
        CONFIGURATION Conf\nVAR_GLOBAL going : BOOL; END_VAR\nRESOURCE Res ON PLC\n\
        TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\nPROGRAM Inst WITH Cyclic : Run;\n\
        END_RESOURCE\nEND_CONFIGURATION\n";
    let mut machine = Machine::new(source).unwrap_or_else(|findings| panic!("{findings:?}"));
    machine.scan().unwrap();
    assert_eq!(machine.most_executed(), [("Twice", 0), ("Count", 1), ("Run", 2)]);
    machine.set("going", 1.0);
    machine.scan().unwrap();
    machine.set("going", 0.0);
    machine.scan().unwrap();
    assert_eq!(machine.most_executed(), [("Twice", 0), ("Count", 4), ("Run", 2)]);
    assert_eq!(machine.executed(), 4 + 7 + 4);
}

#[test]
fn constructs_are_counted_by_the_part_that_is_executed() {
    let body = "IF i = 0 THEN j := 1; ELSIF i <> 1 THEN j := ABS(i); ELSE j := j / 2; END_IF;\n\
                WHILE j < 2 DO j := j * 2; END_WHILE;";
    let mut machine = machine("", "", body);
    machine.scan().unwrap();
    let counted = machine.constructs();
    let of = |name: &str| counted.get(name).copied();
    // A loop is one statement, however often it goes round.
    assert_eq!(
        (of("`=`"), of("`<>`"), of("`<`"), of("`*`"), of("`/`")),
        (Some(1), Some(0), Some(1), Some(1), Some(0))
    );
    assert_eq!((of("elsif_clause"), of("else_clause"), of("call of ABS")), (Some(0), Some(0), Some(0)));
    assert_eq!((of("while_statement"), of("`MOD`")), (Some(1), None));
    machine.set("i", 2.0);
    machine.scan().unwrap();
    let counted = machine.constructs();
    assert_eq!((counted["`<>`"], counted["call of ABS"], counted["elsif_clause"]), (1, 1, 1));
}

/// Raw values of the process image.
const IMAGE: &str = "s AT %IB0 : SINT; us AT %IB1 : USINT; n AT %IW4 : INT; u AT %QW4 : UINT := 7; \
    d AT %MD3 : DINT; bit AT %IX9.7 : BOOL; p : DINT; q : LREAL;";

fn with_image(image: &str, body: &str) -> Result<Machine, String> {
    let externals: String = image
        .split(';')
        .filter_map(|line| line.split_once(':'))
        .map(|(name, ty)| {
            let name = name.split(" AT ").next().unwrap_or_default();
            format!("{name} : {}; ", ty.split(":=").next().unwrap_or_default())
        })
        .collect();
    let source = format!(
        "PROGRAM Run\nVAR_EXTERNAL {externals} END_VAR\n{body}\nEND_PROGRAM\n\
         CONFIGURATION Conf\nVAR_GLOBAL {image} END_VAR\nRESOURCE Res ON PLC\n\
         TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\nPROGRAM Inst WITH Cyclic : Run;\nEND_RESOURCE\nEND_CONFIGURATION\n"
    );
    Machine::new(&source).map_err(|findings| listed(&findings, &source))
}

#[test]
fn raw_values_are_converted_without_a_change() {
    for (name, body, values) in [
        ("s", "p := SINT_TO_DINT(s);", [-128.0, 127.0]),
        ("us", "p := USINT_TO_DINT(us);", [0.0, 255.0]),
        ("n", "p := INT_TO_DINT(n);", [-32768.0, 32767.0]),
        ("u", "p := UINT_TO_DINT(u);", [0.0, 65535.0]),
    ] {
        let mut machine = with_image(IMAGE, body).expect(body);
        for value in values {
            machine.set(name, value);
            machine.scan().expect(body);
            assert_eq!(machine.get("p"), value, "{body}");
        }
    }
    assert_eq!(with_image(IMAGE, "p := 0;").expect("a clean text").get("u"), 7.0);
}

#[test]
fn a_number_that_a_raw_type_does_not_hold_ends_the_scan() {
    for (body, inside, outside) in [
        ("s := DINT_TO_SINT(p);", -128.0, 128.0),
        ("us := DINT_TO_USINT(p);", 255.0, -1.0),
        ("n := DINT_TO_INT(p);", 32767.0, -32769.0),
        ("u := DINT_TO_UINT(p);", 65535.0, 65536.0),
    ] {
        let mut machine = with_image(IMAGE, body).expect(body);
        machine.set("p", inside);
        machine.scan().expect(body);
        assert_eq!(machine.get(body.split(' ').next().expect("a name")), inside, "{body}");
        machine.set("p", outside);
        assert_eq!(machine.scan().expect_err(body).kind, TrapKind::Overflow, "{body}");
    }
}

#[test]
fn variables_are_found_by_their_address() {
    let machine = with_image(IMAGE, "d := 3; bit := TRUE;");
    let mut machine = machine.expect("a clean text");
    machine.scan().expect("a scan");
    let at = |address: &str| machine.at_address(address).map(|place| machine.read(place));
    assert_eq!((at("%MD3"), at("%IX9.7"), at("%IX9.6")), (Some(3.0), Some(1.0), None));
}

#[test]
fn raw_values_are_only_converted() {
    for (image, body, code) in [
        (IMAGE, "p := n;", "type"),
        (IMAGE, "n := p;", "type"),
        (IMAGE, "n := 1;", "type"),
        (IMAGE, "p := UINT_TO_DINT(n);", "argument"),
        (IMAGE, "n := DINT_TO_UINT(p);", "type"),
        (IMAGE, "n := n + n;", "type"),
        (IMAGE, "bit := n = n;", "type"),
        (IMAGE, "q := DINT_TO_LREAL(n);", "argument"),
        ("n : INT;", "n := DINT_TO_INT(1);", "narrow"),
        ("n AT %ID0 : INT;", "n := DINT_TO_INT(1);", "address"),
        ("n AT %IX0.0 : DINT;", "n := 1;", "address"),
        ("n AT %IX0.9 : BOOL;", "n := TRUE;", "address"),
        ("n AT %QW0 : UINT := -1;", "n := DINT_TO_UINT(1);", "type"),
        ("n AT %IX0.0 : BOOL; m AT %IX0.0 : BOOL;", "n := m;", "address"),
        ("n : ARRAY[0..1] OF INT;", "n[0] := DINT_TO_INT(1);", "array-element"),
    ] {
        let found = with_image(image, body).err().unwrap_or_default();
        assert!(found.contains(&format!(": {code}: ")), "{image} {body}: {found}");
    }
}
