//! What the bodies of a machine are made of, for the world.

use super::{Described, Schema};
use super::settings::{Form, Setting, Settings};

pub const SCHEMA: Schema = Schema::new(
    "material",
    "Material of the bodies of a machine without a chain, for the world.",
    &[
        Setting::new("colour", Form::Numbers, "", "red, green and blue, each from 0 to 1"),
        Setting::new("friction", Form::Number, "", "coefficient of the surfaces").optional(),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub colour: [f64; 3],
    pub friction: Option<f64>,
}

impl Described for Material {
    fn new(settings: &Settings) -> Result<Self, String> {
        let colour = settings.numbers("colour")?;
        let colour = <[f64; 3]>::try_from(colour);
        let colour = colour.map_err(|_| "the setting colour has not three numbers".to_string())?;
        let friction = settings.optional("friction", Settings::number)?;
        Ok(Self { colour, friction })
    }
}

