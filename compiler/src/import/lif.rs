//! Tracks of vehicles from LIF, the Layout Interchange Format of the VDMA: nodes, edges and stations, in JSON.

mod read;
mod text;
mod track;

use super::Imported;
use crate::diagnostic::{Diagnostic, sort};
use crate::layout::decode::Decoder;
use crate::layout::json;
use crate::source::{FileId, Sources};

pub struct Options<'a> {
    /// The type of vehicle whose edges are taken; without it the only one of the file.
    pub vehicle: Option<&'a str>,
    /// Name of the device.
    pub name: Option<&'a str>,
}

/// A device text with a device for each track of the file.
pub fn import(sources: &Sources, file: FileId, options: &Options) -> Result<Imported, Vec<Diagnostic>> {
    let (json, diagnostics) = json::parse(&sources.file(file).text, file);
    let mut decoder = Decoder::new(diagnostics);
    let network = json.and_then(|json| read::network(&mut decoder, &json, options.vehicle));
    let tracks = network.as_ref().and_then(|network| track::find(&mut decoder, network));
    let mut diagnostics = decoder.diagnostics;
    sort(&mut diagnostics);
    match (network, tracks) {
        (Some(network), Some(tracks)) if diagnostics.is_empty() => {
            let name = options.name.unwrap_or(&network.project);
            Ok(text::of_tracks(&network, &tracks, name, &sources.file(file).name))
        }
        _ => Err(diagnostics),
    }
}
