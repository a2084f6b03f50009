//! [`colour`]: the scale of colours of a map.
//!
//! Nine colours of `cividis` (Nuñez, Anderton and Renslow, PLOS ONE 13(7), 2018), which readers with and without a deficiency of
//! colour vision order alike; between them straight lines.

/// From the least number to the largest.
const COLOURS: [[f64; 3]; 9] = [
    [0.0, 34.0, 78.0],
    [26.0, 56.0, 111.0],
    [64.0, 77.0, 107.0],
    [92.0, 97.0, 110.0],
    [119.0, 119.0, 121.0],
    [151.0, 145.0, 119.0],
    [185.0, 172.0, 112.0],
    [219.0, 200.0, 92.0],
    [254.0, 232.0, 56.0],
];
/// The colour at a share of the scale.
pub(super) fn colour(share: f64) -> String {
    let last = COLOURS.len() - 1;
    #[expect(clippy::cast_precision_loss, reason = "nine colours")]
    let place = share.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8")]
    let before = (place.floor() as usize).min(last - 1);
    #[expect(clippy::cast_precision_loss, reason = "nine colours")]
    let part = place - before as f64;
    let of = |k: usize| COLOURS[before][k] + part * (COLOURS[before + 1][k] - COLOURS[before][k]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
    let byte = |k: usize| of(k).round() as u8;
    format!("#{:02X}{:02X}{:02X}", byte(0), byte(1), byte(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_rise_in_lightness() {
        let lightness = |share: f64| -> f64 {
            let text = colour(share);
            let byte =
                |at: usize| f64::from(u8::from_str_radix(&text[at..at + 2], 16).expect("hex"));
            0.2126 * byte(1) + 0.7152 * byte(3) + 0.0722 * byte(5)
        };
        let all: Vec<f64> = (0..=20).map(|k| lightness(f64::from(k) / 20.0)).collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
    }
}
