//! Points along the duct: fine where friction fronts start, at ends and clamps, coarse between.

/// Most of these pieces to a stretch.
const PIECES: f64 = 80.0;
/// Growth of the spacing from one piece to the next.
const GROWTH: f64 = 1.15;

/// Points from the first to the last of `breaks` \[m\], which ascend and are all among them, with spacings from about
/// `finest` \[m\] at each break.
pub(crate) fn graded(breaks: &[f64], finest: f64) -> Vec<f64> {
    let mut points = vec![breaks[0]];
    for pair in breaks.windows(2) {
        let length = pair[1] - pair[0];
        let coarsest = (length / PIECES).max(finest);
        // One half, from its break to the middle, then stretched to fit.
        let mut half = Vec::new();
        let (mut reached, mut spacing) = (0.0, finest);
        while reached < 0.5 * length {
            half.push(spacing);
            reached += spacing;
            spacing = (spacing * GROWTH).min(coarsest);
        }
        let scale = 0.5 * length / reached;
        let mut at = pair[0];
        let pieces: Vec<f64> = half.iter().chain(half.iter().rev()).copied().collect();
        for (index, piece) in pieces.iter().enumerate() {
            at += scale * piece;
            points.push(if index + 1 == pieces.len() { pair[1] } else { at });
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_are_points_and_spacings_grow_away_from_them() {
        let points = graded(&[0.0, 40.0, 300.0], 0.5);
        assert!(points.contains(&40.0) && points[0] == 0.0 && points.last() == Some(&300.0));
        let spacings: Vec<f64> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(spacings.iter().all(|&h| h > 0.0 && h < 4.0));
        assert!(spacings[0] <= 0.5);
        assert!(points.len() < 250);
    }
}
