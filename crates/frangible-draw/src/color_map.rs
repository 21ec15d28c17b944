//! From a number to a colour.

/// Viridis (Smith and van der Walt, CC0) at eighths, sRGB: its lightness rises evenly, also for those who tell few
/// colours apart, and in grey.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 82, 139],
    [44, 113, 142],
    [33, 145, 140],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// The colour of a value of 0..=1, sRGB; what lies outside has the colour of the nearer end.
pub(crate) fn color_of(value: f32) -> [u8; 3] {
    let at = value.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let below = (at as usize).min(VIRIDIS.len() - 2);
    let share = at - below as f32;
    std::array::from_fn(|channel| {
        let [a, b] = [below, below + 1].map(|i| f32::from(VIRIDIS[i][channel]));
        (a + share * (b - a) + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::color_of;

    /// CIE lightness L*, 0 to 100.
    fn lightness(color: [u8; 3]) -> f32 {
        let [r, g, b] = color.map(|code| {
            let c = f32::from(code) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        });
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        if luminance <= 0.008_856 {
            903.3 * luminance
        } else {
            116.0 * luminance.cbrt() - 16.0
        }
    }

    #[test]
    fn equal_steps_of_the_value_are_equal_steps_of_lightness() {
        let [dark, light] = [0.0, 1.0].map(|value| lightness(color_of(value)));
        assert!(light - dark > 70.0);
        for i in 0..=64_u8 {
            let value = f32::from(i) / 64.0;
            let even = dark + value * (light - dark);
            let found = lightness(color_of(value));
            // A sixteenth of the range: the table's own roundings and the straight lines between its entries.
            assert!((found - even).abs() < 4.8, "{value}: {found}, not {even}");
        }
    }

    #[test]
    fn values_out_of_range_and_nan_have_a_colour() {
        assert_eq!(color_of(-3.0), color_of(0.0));
        assert_eq!(color_of(7.0), color_of(1.0));
        let _ = color_of(f32::NAN);
    }
}
