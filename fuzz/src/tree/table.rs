//! Tables by choices: rows of a small line's points with addresses that may overlap.

use crate::dictionary::NUMBERS;
use arbitrary::{Result, Unstructured};

const POINTS: [(&str, &str); 16] = [
    ("", "run_permit"),
    ("", "start"),
    ("", "running"),
    ("", "fault_code"),
    ("belt", "belt_hold"),
    ("belt", "belt_sees[1]"),
    ("kitting", "kitting_grip"),
    ("kitting", "kitting_cmd"),
    ("agv1", "agv1_got"),
    ("agv1", "agv1_ack"),
    ("agv1", "agv1_error"),
    ("agv1", "agv1_pos_x"),
    ("agv1", "agv1_goal_x"),
    ("agv1", "agv1_cmd"),
    ("gantry", "gantry_cmd"),
    ("as1", "as1_got"),
];

pub fn table(u: &mut Unstructured) -> Result<String> {
    if u.ratio(1, 5)? {
        return figures(u);
    }
    let separator = *u.choose(&[",", ",", ";", "\t"])?;
    let end = *u.choose(&["\n", "\r\n", "\r"])?;
    let mut lines = vec!["robot,name,address,raw type,scale,offset,inversion".replace(',', separator)];
    for _ in 0..u.int_in_range(0..=12)? {
        let (robot, name) = *u.choose(&POINTS)?;
        let fields = [robot.into(), name.into(), address(u)?, raw(u)?, number(u)?, number(u)?, inversion(u)?];
        lines.push(fields.join(separator));
    }
    Ok(lines.join(end) + end)
}

fn address(u: &mut Unstructured) -> Result<String> {
    let area = *u.choose(&["I", "Q", "M"])?;
    let number = match u.ratio(1, 16)? {
        true => u.choose(&NUMBERS)?.to_string(),
        false => u.int_in_range(0..=40)?.to_string(),
    };
    Ok(match *u.choose(&["X", "B", "W", "D", "L", ""])? {
        "X" => format!("%{area}X{number}.{}", u.int_in_range(0..=8)?),
        size => format!("%{area}{size}{number}"),
    })
}

fn raw(u: &mut Unstructured) -> Result<String> {
    Ok(u.choose(&["BOOL", "SINT", "USINT", "INT", "UINT", "DINT", "dint", "REAL", ""])?.to_string())
}

fn number(u: &mut Unstructured) -> Result<String> {
    Ok(match u.int_in_range(0..=3)? {
        0 => format!("{}", f64::from(u.int_in_range(-2000..=2000)?) / 1000.0),
        1 => u.choose(&NUMBERS)?.to_string(),
        _ => String::new(),
    })
}

fn inversion(u: &mut Unstructured) -> Result<String> {
    Ok(u.choose(&["", "", "TRUE", "FALSE", "1"])?.to_string())
}

/// Figures that stand beside a sweep.
fn figures(u: &mut Unstructured) -> Result<String> {
    let mut text = String::from("layout,agv.capacity,seconds_per_order\n");
    for _ in 0..u.int_in_range(0..=6)? {
        text += &format!("small,{},{}\n", u.int_in_range(1..=12)?, number(u)?);
    }
    Ok(text)
}
