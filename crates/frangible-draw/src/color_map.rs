//! Converts numbers to colours.

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

/// The colour of a value of 0..=1, sRGB. A value outside has the colour of the nearer end.
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
        let [r, g, b] = linear(color);
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

    /// Matrices that simulate colour vision without one kind of cones, linear light (Machado, Oliveira and Fernandes 2009, severity 1).
    const LACKING: [(&str, [[f32; 3]; 3]); 3] = [
        (
            "protanopia",
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
        ),
        (
            "deuteranopia",
            [
                [0.367_322, 0.860_646, -0.227_968],
                [0.280_085, 0.672_501, 0.047_413],
                [-0.011_820, 0.042_940, 0.968_881],
            ],
        ),
        (
            "tritanopia",
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ),
    ];

    fn linear(color: [u8; 3]) -> [f32; 3] {
        color.map(|code| {
            let c = f32::from(code) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        })
    }

    /// CIE L*a*b* of linear sRGB under daylight (D65).
    fn lab(rgb: [f32; 3]) -> [f32; 3] {
        let [r, g, b] = rgb.map(|part| part.clamp(0.0, 1.0));
        let white = [
            (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505,
            0.2126 * r + 0.7152 * g + 0.0722 * b,
            (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089,
        ];
        let [x, y, z] = white.map(|part| {
            if part > 0.008_856 {
                part.cbrt()
            } else {
                7.787 * part + 16.0 / 116.0
            }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn values_are_told_apart_in_order_by_the_colour_blind_and_in_grey() {
        let steps = 16;
        for (who, matrix) in LACKING {
            let seen: Vec<[f32; 3]> = (0..=steps)
                .map(|i| {
                    let rgb = linear(color_of(i as f32 / steps as f32));
                    lab(matrix.map(|row| row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]))
                })
                .collect();
            for (i, pair) in seen.windows(2).enumerate() {
                let [a, b] = [pair[0], pair[1]];
                assert!(
                    b[0] > a[0] + 1.5,
                    "{who}: step {i} is not lighter: {a:?} {b:?}"
                );
            }
            for i in 0..seen.len() {
                for j in i + 2..seen.len() {
                    let apart: f32 = (0..3).map(|k| (seen[i][k] - seen[j][k]).powi(2)).sum();
                    // A difference of 2.3 is just seen; an eighth of the scale is three times that.
                    assert!(
                        apart.sqrt() > 7.0,
                        "{who}: {i} and {j} are alike: {}",
                        apart.sqrt()
                    );
                }
            }
        }
    }

    #[test]
    fn values_out_of_range_and_nan_have_a_colour() {
        assert_eq!(color_of(-3.0), color_of(0.0));
        assert_eq!(color_of(7.0), color_of(1.0));
        let _ = color_of(f32::NAN);
    }
}
