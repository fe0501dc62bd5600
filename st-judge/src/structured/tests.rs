use super::*;

const TYPES: &str = "TYPE E_Slot :\n(\n    Empty := 0,\n    Full := 1\n);\nEND_TYPE\n\
    TYPE ST_Point :\nSTRUCT\n    x : LREAL;\n    y : LREAL;\nEND_STRUCT;\nEND_TYPE\n\
    TYPE ST_Tray :\nSTRUCT\n    open : BOOL;\n    slots : ARRAY[0..2] OF E_Slot;\n    place : ST_Point;\n\
    END_STRUCT;\nEND_TYPE\n";
const LIST: &str = "{attribute 'qualified_only'}\nVAR_GLOBAL\n    trays : ARRAY[0..1] OF ST_Tray;\n    \
    fault : DINT := -1;\n    pairs : ARRAY[0..1, 0..2] OF DINT := [2(7), 1, 2, 3, 4];\nEND_VAR\n";
const BLOCK: &str = "FUNCTION_BLOCK FB_One\nVAR_INPUT\n    row : DINT;\n    goal : ST_Point;\nEND_VAR\n\
    VAR_OUTPUT\n    reached : ST_Point;\nEND_VAR\nVAR_IN_OUT\n    trays : ARRAY[0..1] OF ST_Tray;\n    \
    fault : DINT;\nEND_VAR\nVAR\n    slot : E_Slot;\nEND_VAR\n\
    trays[row].slots[row + 1] := E_Slot.Full; (* full *)\nslot := trays[row].slots[0];\n\
    IF (slot = E_Slot.Empty) AND (NOT trays[row].open) THEN\n    fault := 3;\nEND_IF;\n\
    trays[row].place := goal;\nreached.x := goal.x;\nEND_FUNCTION_BLOCK\n";
const MAIN: &str = "PROGRAM MAIN\nVAR\n    one : FB_One;\n    spot : ST_Point;\nEND_VAR\n\
    clock_ms := TIME_TO_DINT(TIME());\nspot.x := DINT_TO_LREAL(fault);\n\
    one(row := pairs[1, 2], goal := spot, trays := trays, fault := fault);\nspot := one.reached;\nEND_PROGRAM\n";

fn read(block: &str, main: &str) -> Result<String, String> {
    portable(&[
        Object { name: "MAIN.st", text: main },
        Object { name: "types.st", text: TYPES },
        Object { name: "FB_One.st", text: block },
        Object { name: "GVL.st", text: LIST },
    ])
}

#[test]
fn it_says_the_same_in_the_portable_core() {
    let text = read(BLOCK, MAIN).expect("a project");
    for part in [
        "trays_slots : ARRAY[0..5] OF DINT;",
        "trays_place_y : ARRAY[0..1] OF LREAL;",
        "trays_slots[((row) * 3) + (row + 1 )] := 1;",
        "slot := trays_slots[((row) * 3) + (0)];",
        "trays_place_y[row] := goal_y;",
        "one(row := pairs[((1) * 3) + (2)], goal_x := spot_x, goal_y := spot_y)",
        "spot_y := one.reached_y;",
        "pairs[5] := 4;",
        "fault : DINT := -1;",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    crate::judge(&text).unwrap_or_else(|found| panic!("{}\n{text}", crate::listed(&found, &text)));
}

#[test]
fn what_codesys_would_refuse_or_take_otherwise_is_found() {
    for (from, to) in [
        ("E_Slot.Full", "E_Slot.Half"),
        ("E_Slot.Full", "1"),
        ("slot = E_Slot.Empty", "slot + 1 = 2"),
        ("trays[row].open", "trays[row].shut"),
        ("trays[row].open", "trays.open"),
        ("VAR_IN_OUT", "VAR_EXTERNAL"),
        ("    fault : DINT;\n", ""),
        (".place := goal", ".place := trays"),
        ("slot : E_Slot;", "slot : E_Slot; SLOT : DINT;"),
        ("goal : ST_Point", "goal : ST_Place"),
        ("reached.x := goal.x", "goal.x := 1.0"),
    ] {
        assert!(BLOCK.contains(from), "{from}");
        assert!(read(&BLOCK.replacen(from, to, 1), MAIN).is_err(), "{to}");
    }
    for (from, to) in [
        (", fault := fault", ""),
        ("trays := trays", "trays := pairs"),
        ("goal := spot", "goal := fault"),
        ("one.reached", "one.slot"),
        ("one.reached", "one.goal"),
        ("goal := spot", "aim := spot"),
    ] {
        assert!(MAIN.contains(from), "{from}");
        assert!(read(BLOCK, &MAIN.replacen(from, to, 1)).is_err(), "{to}");
    }
}
