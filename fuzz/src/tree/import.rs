//! Files of other programs by choices: descriptions of arms in XML, parameters in YAML, layouts of vehicles in JSON.

use super::json;
use crate::dictionary::NUMBERS;
use arbitrary::{Result, Unstructured};

pub fn import(u: &mut Unstructured) -> Result<String> {
    match u.int_in_range(0..=2)? {
        0 => urdf(u),
        1 => opw(u),
        _ => lif(u),
    }
}

/// Now and then anything else.
fn or_else(u: &mut Unstructured, usual: &str, others: &[&str]) -> Result<String> {
    Ok(if u.ratio(1, 30)? { u.choose(others)?.to_string() } else { usual.into() })
}

fn length(u: &mut Unstructured) -> Result<String> {
    Ok(match u.int_in_range(0..=40)? {
        0 => u.choose(&NUMBERS)?.to_string(),
        1 | 2 => "nan".into(),
        3..=15 => "0".into(),
        _ => format!("{}", f64::from(u.int_in_range(-100..=100)?) / 100.0),
    })
}

fn point(u: &mut Unstructured) -> Result<String> {
    Ok([length(u)?, length(u)?, length(u)?].join(" "))
}

/// Six joints that could be an arm, with links and shapes.
fn urdf(u: &mut Unstructured) -> Result<String> {
    const AXES: [&str; 6] = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"];
    const ANGLES: [&str; 5] = ["0", "1.5707963267948966", "-1.5707963267948966", "3.141592653589793", "0.3"];
    let mut text =
        format!("<{} name=\"a\">\n", or_else(u, "robot", &["sdf", "robot x=\"1\"", "!DOCTYPE robot"])?);
    for link in 0..=6 {
        let shape = match u.int_in_range(0..=5)? {
            0 => format!("<box size=\"{}\"/>", point(u)?),
            1 => format!("<cylinder radius=\"0.1\" length=\"{}\"/>", length(u)?),
            2 => "<sphere radius=\"0.1\"/>".into(),
            3 => "<mesh filename=\"package://a/b.stl\"/>".into(),
            _ => String::new(),
        };
        let origin = format!("<origin xyz=\"{}\" rpy=\"0 {} 0\"/>", point(u)?, u.choose(&ANGLES)?);
        text += &match shape.is_empty() {
            true => format!("<link name=\"l{link}\"/>\n"),
            false => format!(
                "<link name=\"l{link}\"><collision>{origin}<geometry>{shape}</geometry></collision></link>\n"
            ),
        };
    }
    for (joint, axis) in AXES.iter().enumerate() {
        let kind = or_else(u, "revolute", &["fixed", "prismatic", "continuous", "?"])?;
        let parent = or_else(u, &format!("l{joint}"), &["l0", "l6", "?"])?;
        // The wrist's joints lie in one point most times.
        let (x, y, z) = match joint {
            0 => ("0".into(), "0".into(), length(u)?),
            4 => ("0".into(), "0".into(), "0".into()),
            5 => (length(u)?, "0".into(), "0".into()),
            _ => (length(u)?, or_else(u, "0", &["0.1"])?, length(u)?),
        };
        let axis = or_else(u, axis, &["0 0 0", "0 0 -1", "1 1 1"])?;
        text += &format!(
            "<joint name=\"j{joint}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"l{}\"/>\
             <origin xyz=\"{x} {y} {z}\"/><axis xyz=\"{axis}\"/><limit lower=\"-{}\" upper=\"3\" velocity=\"{}\"/></joint>\n",
            joint + 1,
            u.int_in_range(0..=8)?,
            u.int_in_range(0..=3)?,
        );
    }
    Ok(text + "</robot>\n")
}

fn opw(u: &mut Unstructured) -> Result<String> {
    let mut text = String::new();
    let mut indent = "";
    if u.ratio(1, 4)? {
        text += "manipulator:\n";
        indent = "  ";
    }
    text += &format!("{indent}opw_kinematics_geometric_parameters:\n");
    for name in ["a1", "a2", "b", "c1", "c2", "c3", "c4"] {
        let name = or_else(u, name, &["", "a1", "x", "- a1"])?;
        text += &format!("{indent}  {name}: {}\n", length(u)?);
    }
    for (key, values) in
        [("offsets", ["0", "deg(90)", "-1.57", "rad(1)"]), ("sign_corrections", ["1", "-1", "1", "1"])]
    {
        let mut written = Vec::new();
        for _ in 0..6 {
            let usual = *u.choose(&values)?;
            written.push(or_else(u, usual, &["", "[", "&a", "2", ".nan"])?);
        }
        text += &format!("{indent}opw_kinematics_joint_{key}: [{}]\n", written.join(", "));
    }
    Ok(text)
}

fn lif(u: &mut Unstructured) -> Result<String> {
    let id = |u: &mut Unstructured| Ok(format!("\"n{}\"", u.int_in_range(0..=6)?));
    let nodes = json::list(u, 7, |u| {
        let (x, y) = (json::metres(u)?, json::metres(u)?);
        let at = json::object(u, &[("x", x), ("y", y)])?;
        let own = id(u)?;
        json::object(u, &[("nodeId", own), ("nodePosition", at)])
    })?;
    let edges = json::list(u, 7, |u| {
        let kind = json::object(u, &[("vehicleTypeId", "\"v\"".into()), ("maxSpeed", "1.5".into())])?;
        let (own, from, to) = (u.int_in_range(0..=99)?, id(u)?, id(u)?);
        let members = [
            ("edgeId", format!("\"e{own}\"")),
            ("startNodeId", from),
            ("endNodeId", to),
            ("vehicleTypeEdgeProperties", format!("[{kind}]")),
        ];
        json::object(u, &members)
    })?;
    let layout = json::object(u, &[("nodes", nodes), ("edges", edges), ("stations", "[]".into())])?;
    let meta =
        json::object(u, &[("lifVersion", "\"1.0.0\"".into()), ("projectIdentification", "\"p\"".into())])?;
    json::object(u, &[("metaInformation", meta), ("layouts", format!("[{layout}]"))])
}
