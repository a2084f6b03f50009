//! The picture of docs/imbalance-map.md: the error over speed and share of the wheel in the modal mass, with contours of 1, 3
//! and 10 %.

use precess::report::cells::{CellMap, MapAxis};

use super::page::by_speeds;

/// Speeds over the natural frequency, from 0.2 in these steps.
const SPEEDS: u32 = 53;
const STEP: f64 = 0.025;
/// Shares of the modal mass, in equal ratios.
const SHARES: u32 = 29;
const SHARE: [f64; 2] = [1e-3, 0.5];

/// The picture as an SVG file.
pub(crate) fn picture() -> Result<String, String> {
    let speeds: Vec<f64> = (0..SPEEDS).map(|k| 0.2 + STEP * f64::from(k)).collect();
    let ratio = SHARE[1] / SHARE[0];
    let last = f64::from(SHARES - 1);
    let shares: Vec<f64> =
        (0..SHARES).map(|k| SHARE[0] * ratio.powf(f64::from(k) / last)).collect();
    let by_share: Result<Vec<Vec<f64>>, String> =
        shares.iter().map(|share| by_speeds(&speeds, *share)).collect();
    let by_share = by_share?;
    // The share fastest.
    let at = |speed: usize| by_share.iter().map(move |of| 100.0 * of[speed]);
    let numbers: Vec<f64> = (0..speeds.len()).flat_map(at).collect();
    let axis = |label: &str, values: Vec<f64>, logarithmic| MapAxis {
        label: label.to_owned(),
        values,
        logarithmic,
    };
    let map = CellMap {
        description: "Error of the usual model, in percent, over the speed by the natural frequency of the wheel on its \
                      bracket, and over the share of the wheel's inertia in the modal mass; contours of 1, 3 and 10 percent."
            .to_owned(),
        title: "Error of the usual model on a flexible bracket".to_owned(),
        axes: [
            axis("Speed over natural frequency", speeds, false),
            axis("Share of the wheel in the modal mass", shares, true),
        ],
        numbers,
        scale: "error (%)".to_owned(),
        logarithmic: true,
        contours: [1.0, 3.0, 10.0].map(|level| (format!("{level} %"), level)).to_vec(),
    };
    map.file().map_err(|error| error.to_string())
}
