//! The numbers of all presets and their sources.

use std::f64::consts::TAU;

use super::{LOSS_FREQUENCY, MASS_DAMPING, Numbers, Preset};
use crate::fatigue::Fatigue;
use crate::laminate::Laminate;
use crate::material::energy_depth;

/// Branching constant of glass over its toughness: √13 / 1.24 ([`presets`](super) say why).
const BRANCHING_OF_GLASS: f64 = 2.908;

/// A real material's published numbers, before the derived ones are filled in.
struct Published {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    /// E, Pa.
    youngs_modulus: f64,
    poisson_ratio: f64,
    density: f64,
    /// Tensile strength, Pa.
    strength: f64,
    toughness: Toughness,
    loss_factor: f64,
    weak_point_density: f64,
    /// Amplitude and wavelength, m.
    roughness: [f64; 2],
    /// Pressure that crushes it, Pa.
    crushing_pressure: f64,
    restitution: f64,
    friction: f64,
}

enum Toughness {
    /// K_Ic, Pa·√m.
    Intensity(f64),
    /// G_c, J/m².
    Energy(f64),
}

const fn real(p: Published) -> Preset {
    let (fracture_toughness, fracture_energy) = match p.toughness {
        Toughness::Intensity(k) => (
            k,
            k * k * (1.0 - p.poisson_ratio * p.poisson_ratio) / p.youngs_modulus,
        ),
        Toughness::Energy(g) => (0.0, g),
    };
    Preset {
        name: p.name,
        summary: p.summary,
        source: p.source,
        fracture_toughness,
        weibull_modulus: 0.0,
        specimen: Preset::SPECIMEN,
        dynamic_increase: 1.0,
        fatigue: None,
        numbers: Numbers {
            youngs_modulus: p.youngs_modulus,
            poisson_ratio: p.poisson_ratio,
            density: p.density,
            strength: p.strength,
            fracture_energy,
            stiffness_damping: p.loss_factor / (TAU * LOSS_FREQUENCY),
            mass_damping: MASS_DAMPING,
            energy_depth: energy_depth(p.youngs_modulus, fracture_energy, p.strength),
            weak_point_density: p.weak_point_density,
            branching_constant: BRANCHING_OF_GLASS,
            roughness: p.roughness,
            crushing_pressure: p.crushing_pressure,
            restitution: p.restitution,
            friction: p.friction,
            residual_stress: 0.0,
            laminate: None,
        },
    }
}

/// Weibull modulus of the strength, and the volume of the specimens that had it, m³.
const fn scattered(preset: Preset, weibull_modulus: f64, specimen: f64) -> Preset {
    Preset {
        weibull_modulus,
        specimen,
        ..preset
    }
}

/// A preset with a branching constant of its own, over its toughness.
const fn branching(preset: Preset, branching_constant: f64) -> Preset {
    let numbers = Numbers {
        branching_constant,
        ..preset.numbers
    };
    Preset { numbers, ..preset }
}

/// A preset whose number for the strength is that of a slow test, as strong as under a blow.
const fn under_blows(preset: Preset, dynamic_increase: f64) -> Preset {
    let numbers = preset.numbers;
    let strength = numbers.strength * dynamic_increase;
    Preset {
        dynamic_increase,
        numbers: Numbers {
            strength,
            energy_depth: energy_depth(numbers.youngs_modulus, numbers.fracture_energy, strength),
            ..numbers
        },
        ..preset
    }
}

/// Soda-lime glass with static fatigue: in tests at 2 MPa/s its strength is smaller than under a blow by the dynamic increase factor.
const fn tired(preset: Preset) -> Preset {
    Preset {
        fatigue: Some(Fatigue {
            exponent: 16.0,
            rate: 2e6,
            increase: preset.dynamic_increase,
        }),
        ..preset
    }
}

/// One line of the paper's Table 1, on top of a real material.
struct Table1 {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    youngs_modulus: f64,
    stiffness_damping: f64,
    mass_damping: f64,
    strength: f64,
    fracture_energy: f64,
}

const fn paper(row: Table1, rest: &Preset) -> Preset {
    Preset {
        name: row.name,
        summary: row.summary,
        source: row.source,
        fracture_toughness: 0.0,
        weibull_modulus: 0.0,
        specimen: Preset::SPECIMEN,
        dynamic_increase: 1.0,
        fatigue: None,
        numbers: Numbers {
            youngs_modulus: row.youngs_modulus,
            stiffness_damping: row.stiffness_damping,
            mass_damping: row.mass_damping,
            strength: row.strength,
            fracture_energy: row.fracture_energy,
            crushing_pressure: f64::INFINITY,
            ..rest.numbers
        },
    }
}

const GLASS: Preset = real(Published {
    name: "glass",
    summary: "soda-lime glass, annealed: windows, bottles, tumblers",
    source: "E 71 GPa, ν 0.23, tensile strength in slow tests 41 MPa, K_Ic 0.75 MPa√m: makeitfrom.com, Annealed Soda-Lime Glass \
             (K_Ic 0.75 also in Wikipedia, Soda-lime glass); ρ 2500 kg/m³: EN 572-1. G_c = K²(1−ν²)/E = 7.5 J/m². \
             The first page also gives 100 MPa in bending: the strength of glass is that of its surface. \
             A handled surface bears 1.52 times as much where stress rises by 5.6e6 MPa/s, as under a blow, as where it rises by 2 MPa/s \
             (ring on ring; 1.85 times as received: Meyland et al., Glass Structures & Engineering, 10.1007/s40940-018-0089-2, abstract): 62 MPa. \
             Static fatigue with n 16, as in ASTM E1300. \
             Weibull modulus 7: annealed float glass scatters with 5 to 9 (Haldimann, Luible, Overend, Structural Use of Glass, 2008, not re-checked). \
             Crushing pressure 5.5 GPa, its Vickers hardness (usual for soda-lime glass, not re-checked).",
    youngs_modulus: 71e9,
    poisson_ratio: 0.23,
    density: 2500.0,
    strength: 41e6,
    toughness: Toughness::Intensity(0.75e6),
    loss_factor: 6e-4,
    weak_point_density: 4e7,
    roughness: [0.1e-3, 6e-3],
    crushing_pressure: 5.5e9,
    restitution: 0.5,
    friction: 0.4,
});

/// Glass of another surface: how strong it is in a slow test, Pa, and how much stronger under a blow.
const fn surface(
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    strength: f64,
    increase: f64,
) -> Preset {
    let preset = Preset {
        name,
        summary,
        source,
        ..GLASS
    };
    let numbers = Numbers {
        strength,
        ..GLASS.numbers
    };
    under_blows(Preset { numbers, ..preset }, increase)
}

const GLASS_NEW: Preset = surface(
    "glass-new",
    "soda-lime glass with its surface as it left the factory",
    "as `glass`, but for its surface: new float glass breaks at 70 to 100 MPa in slow bending tests, in the mean of series (not re-checked); \
     the lower end is taken. Where stress rises by 5.6e6 MPa/s it bears 1.85 times as much as where it rises by 2 MPa/s, as received \
     (ring on ring: Meyland et al., Glass Structures & Engineering, 10.1007/s40940-018-0089-2, abstract): 130 MPa. G_c = K²(1−ν²)/E = 7.5 J/m².",
    70e6,
    1.85,
);

const GLASS_ABRADED: Preset = surface(
    "glass-abraded",
    "soda-lime glass with a worn surface: old windows, tumblers after years of use",
    "as `glass`, but for its surface: windows after decades and used tumblers break at 30 to 40 MPa in slow tests (not re-checked); the lower end is taken, \
     and under a blow the increase of a handled surface, 1.52 (as for `glass`): 46 MPa. G_c = K²(1−ν²)/E = 7.5 J/m².",
    30e6,
    1.52,
);

/// Handled glass whose faces a thermal treatment has pressed together, by so much, Pa.
const fn tempered(
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    compression: f64,
) -> Preset {
    let glass = tired(scattered(under_blows(GLASS, 1.52), 7.0, Preset::SPECIMEN));
    let numbers = Numbers {
        residual_stress: compression,
        ..glass.numbers
    };
    Preset {
        name,
        summary,
        source,
        numbers,
        ..glass
    }
}

const TEMPERED_GLASS: Preset = tempered(
    "tempered-glass",
    "soda-lime glass, thermally toughened: side windows of cars, shower doors; falls into dice",
    "as `glass`, with a compression of 100 MPa at the faces: at least 69 MPa make toughened glass and 100 MPa safety glass \
     (azglassclasses.com, Tempered glass properties, as in Wikipedia), and EN 12150-1 is met from some 90 MPa on (Mognato et al. 2011, \
     Thermally toughened safety glass, not re-checked). The middle has half of it as tension, of a parabola that sums to zero. \
     Dice follow from the branching constant of `glass`. G_c = K²(1−ν²)/E = 7.5 J/m².",
    100e6,
);

const HEAT_STRENGTHENED_GLASS: Preset = tempered(
    "heat-strengthened-glass",
    "soda-lime glass, heat-strengthened: facades; bears more than `glass`, and breaks into large pieces",
    "as `glass`, with a compression of 45 MPa at the faces: ASTM C1048 has 24 to 52 MPa (not re-checked). The middle has half of it as tension. \
     G_c = K²(1−ν²)/E = 7.5 J/m².",
    45e6,
);

const LAMINATED_GLASS: Preset = {
    let glass = tired(scattered(under_blows(GLASS, 1.52), 7.0, Preset::SPECIMEN));
    Preset {
        name: "laminated-glass",
        summary: "two plies of soda-lime glass on a film of PVB: windscreens, shop fronts; holds together when it breaks",
        source: "plies as `glass`, on a film of PVB, 0.76 mm. Its shear modulus 150 MPa: Prony series of van Duser et al. (J. Eng. Mech. 125 (1999) 435) at 20 °C after 1 ms; \
                 8 MPa after 3 s (neither re-checked). It carries 20 MPa while it is drawn out and tears at 10 mm: PVB bears 20 to 30 MPa (not re-checked), and the opening is an estimate. \
                 Loss factor 0.05 from the film's shear, an estimate. ρ 2300 kg/m³, of glass with 2500 and PVB with 1070 in a windscreen of 2.1 + 0.76 + 2.1 mm. G_c = K²(1−ν²)/E = 7.5 J/m².",
        numbers: Numbers {
            density: 2300.0,
            stiffness_damping: 5e-2 / (TAU * LOSS_FREQUENCY),
            laminate: Some(Laminate::PVB),
            ..glass.numbers
        },
        ..glass
    }
};

const PORCELAIN: Preset = real(Published {
    name: "porcelain",
    summary: "feldspathic porcelain: cups, plates, piggy banks",
    source: "E 70 GPa, K_Ic 1.19 MPa√m (indentation, nepheline-syenite porcelain; feldspathic ones 65–70 GPa and 0.99–1.26): Quinn et al., \
             as tabled in Dental Materials 24 (2008) 1477, Table 1; tensile strength 40 MPa (diametral, gingival; opaque 29 MPa, bending 88 MPa): \
             The shear strength of dental porcelain, J. Dent. Res. 59 (1980) 1409; ρ 2400 kg/m³: material-properties.org, Porcelain; \
             ν 0.22: usual for whiteware, an estimate. G_c = K²(1−ν²)/E = 19.3 J/m². The loss factor is taken a little below glass. \
             Weibull modulus 10, an estimate: fine ceramics have 10 to 20; its specimen is the disc of the diametral test, 6 × 3 mm. \
             Crushing pressure 6.5 GPa: feldspathic porcelain has a Vickers hardness of 6 to 7 GPa (not re-checked).",
    youngs_modulus: 70e9,
    poisson_ratio: 0.22,
    density: 2400.0,
    strength: 40e6,
    toughness: Toughness::Intensity(1.19e6),
    loss_factor: 5e-4,
    weak_point_density: 4e7,
    roughness: [0.3e-3, 5e-3],
    crushing_pressure: 6.5e9,
    restitution: 0.5,
    friction: 0.45,
});

const BRICK: Preset = real(Published {
    name: "brick",
    summary: "fired clay brick, solid",
    source: "E 12 GPa = 400 × compressive strength (30 MPa): Vermeltfoort, Properties of some clay bricks under varying loading conditions \
             (Masonry International); tensile strength 2.5 MPa and G_c 73 J/m² = 0.029 mm × strength, the ductility index recommended by \
             Lourenço, Almeida, Barros, Experimental investigation of bricks under uniaxial tensile testing, Masonry International 18 (2005) \
             (van der Pluijm 1999: 1.5–3.5 MPa, 60–130 J/m²; both not re-checked against these texts); ρ 1900 kg/m³ and ν 0.15: usual, estimates. \
             The corresponding K_Ic = √(G_c E/(1−ν²)) is 0.95 MPa√m. \
             Weibull modulus 6: flaws that fill space alike at all sizes, as their number falls with the cube of the size and the strength with its root; \
             the strength of bricks scatters by some 20 %, which is 5.5 (m = 1.10 mean/deviation: Appl. Sci. 9 (2019) 1575, abstract). Its specimen, 100 cm³, is an estimate. \
             Crushing pressure 390 MPa, an estimate: the law that concrete follows, at the strength in compression above.",
    youngs_modulus: 12e9,
    poisson_ratio: 0.15,
    density: 1900.0,
    strength: 2.5e6,
    toughness: Toughness::Energy(73.0),
    loss_factor: 1e-2,
    weak_point_density: 8e6,
    roughness: [1e-3, 8e-3],
    crushing_pressure: 3.9e8,
    restitution: 0.3,
    friction: 0.6,
});

const CONCRETE: Preset = real(Published {
    name: "concrete",
    summary: "normal concrete, C30/37, without reinforcement",
    source: "fib Model Code 2010, f_ck 30 MPa, f_cm 38 MPa: E = 21.5 GPa (f_cm/10)^⅓ = 33.6 GPa, mean tensile strength 0.3 f_ck^⅔ = 2.9 MPa, \
             G_F = 73 f_cm^0.18 = 140 J/m², ν 0.2, ρ 2400 kg/m³. The corresponding K_Ic = √(G_F E/(1−ν²)) is 2.2 MPa√m \
             (small laboratory specimens give 0.2–1.4). Under a blow 1.3 times the strength: (σ̇ / 0.03 MPa/s)^0.018 of the same code at 6e4 MPa/s \
             (not re-checked); its cube-root branch above is mostly inertia, which is computed here. \
             Weibull modulus 7, derived: of the same code the 5 % fractile of the tensile strength is 0.7 times its mean. Its specimen is a cylinder of 150 × 300 mm. \
             Crushing pressure 434 MPa = 82.6 (f_cm/MPa)^−0.544 f_cm, the resistance of concrete to a rigid projectile: Forrestal et al., \
             Int. J. Impact Eng. 15 (1994) 395 (not re-checked).",
    youngs_modulus: 33.6e9,
    poisson_ratio: 0.2,
    density: 2400.0,
    strength: 2.9e6,
    toughness: Toughness::Energy(140.0),
    loss_factor: 6e-3,
    weak_point_density: 1e6,
    roughness: [2e-3, 8e-3],
    crushing_pressure: 4.34e8,
    restitution: 0.3,
    friction: 0.6,
});

const MARBLE: Preset = real(Published {
    name: "marble",
    summary: "white marble: statues, table tops",
    source: "E 54 GPa, ν 0.2, tensile strength 9 MPa, ρ 2700 kg/m³: makeitfrom.com, Marble (Carrara in bending: 14.9 MPa, Spagnoli et al., \
             Frattura ed Integrità Strutturale 33 (2015) 80, Table 1); K_Ic 0.9 MPa√m: middle of about 0.6–1.3 for Carrara in Atkinson & Meredith, \
             Experimental fracture mechanics data for rocks and minerals, 1987 (not re-checked). G_c = K²(1−ν²)/E = 14.4 J/m². \
             Loss factor from Q ≈ 300, an estimate. \
             Weibull modulus 6, flaws that fill space alike at all sizes, an estimate; its specimen, 100 cm³, too. \
             Crushing pressure 1.2 GPa: calcite has a Vickers hardness of 1.0 to 1.3 GPa (not re-checked).",
    youngs_modulus: 54e9,
    poisson_ratio: 0.2,
    density: 2700.0,
    strength: 9e6,
    toughness: Toughness::Intensity(0.9e6),
    loss_factor: 3e-3,
    weak_point_density: 4e7,
    roughness: [0.6e-3, 5e-3],
    crushing_pressure: 1.2e9,
    restitution: 0.4,
    friction: 0.5,
});

const ICE: Preset = real(Published {
    name: "ice",
    summary: "polycrystalline fresh-water ice at about −10 °C",
    source: "tensile strength 1.5 MPa (0.7–3.1) and K_Ic 0.1 MPa√m (0.05–0.15): Petrovic, Mechanical properties of ice and snow, \
             J. Mater. Sci. 38 (2003) 1; E 9.3 GPa, ν 0.33 (isotropic polycrystal at high rate), ρ 917 kg/m³: Schulson & Duval, Creep and Fracture of Ice, 2009 \
             (not re-checked). G_c = K²(1−ν²)/E = 0.96 J/m². Loss factor an estimate. \
             Weibull modulus 6, flaws that fill space alike at all sizes, an estimate; its specimen, 100 cm³, too. \
             Crushing pressure 33 MPa: under a falling striker the peak pressures were 25 MPa at −0.5 °C and 41 MPa at −14.5 °C in the mean \
             (Gagnon & Gammon, J. Glaciology 43 (1997), abstract).",
    youngs_modulus: 9.3e9,
    poisson_ratio: 0.33,
    density: 917.0,
    strength: 1.5e6,
    toughness: Toughness::Intensity(0.1e6),
    loss_factor: 1e-2,
    weak_point_density: 4e7,
    roughness: [0.3e-3, 6e-3],
    crushing_pressure: 3.3e7,
    restitution: 0.3,
    friction: 0.05,
});

const SUGAR: Preset = real(Published {
    name: "sugar",
    summary: "hard sugar glass: boiled sweets, stunt bottles",
    source: "no measurements of the glass were found; estimates from sucrose crystals (E 33–38 GPa: Ramos & Bahr, J. Mater. Res. 22 (2007), nanoindentation; \
             K_Ic 0.08 MPa√m: Duncan-Hewitt & Weatherly, J. Mater. Sci. Lett. 8 (1989) 1350, not re-checked): E 8 GPa, between glassy polymers and the crystal; \
             ν 0.3; ρ 1500 kg/m³; K_Ic as the crystal's; tensile strength 4 MPa from K_Ic and a flaw of 0.1 mm. G_c = K²(1−ν²)/E = 0.73 J/m². Loss factor an estimate. \
             Crushing pressure 640 MPa, that of sucrose crystals in the last source; Ramos & Bahr have 1.5 GPa under a needle.",
    youngs_modulus: 8e9,
    poisson_ratio: 0.3,
    density: 1500.0,
    strength: 4e6,
    toughness: Toughness::Intensity(0.08e6),
    loss_factor: 5e-3,
    weak_point_density: 4e7,
    roughness: [0.1e-3, 6e-3],
    crushing_pressure: 6.4e8,
    restitution: 0.3,
    friction: 0.5,
});

const CHOCOLATE: Preset = real(Published {
    name: "chocolate",
    summary: "dark chocolate at room temperature",
    source: "estimates of the right order: E 1 GPa, tensile strength 1.5 MPa (Brazilian test; it grows with the loading rate: Nedomová et al., J. Texture Stud. 2025, \
             10.1111/jtxs.70021), K_Ic 0.2 MPa√m (fracture energies fall with temperature: Samaras et al., Soft Matter 2024, 10.1039/d4sm00264d), \
             ν 0.3, ρ 1300 kg/m³; both papers were read in abstract only and published moduli differ by a factor of ten between methods. \
             G_c = K²(1−ν²)/E = 36.4 J/m². Loss factor as for a soft plastic. \
             Weibull modulus 6, flaws that fill space alike at all sizes, an estimate; its specimen, 100 cm³, too. \
             No crushing pressure: none at the rate of a blow was found.",
    youngs_modulus: 1e9,
    poisson_ratio: 0.3,
    density: 1300.0,
    strength: 1.5e6,
    toughness: Toughness::Intensity(0.2e6),
    loss_factor: 5e-2,
    weak_point_density: 2e7,
    roughness: [0.4e-3, 3e-3],
    crushing_pressure: f64::INFINITY,
    restitution: 0.2,
    friction: 0.5,
});

const PMMA: Preset = real(Published {
    name: "pmma",
    summary: "acrylic glass (PMMA), cast sheet",
    source: "E 5.0 GPa, ν 0.345 at 10 kHz, derived: slow tests (some 0.005 Hz) find 3.2 GPa and 0.374 (Seleš et al., Procedia Structural Integrity 42 (2022) 1721, Table 1), \
             waves of some 2 MHz 5.7 GPa and 0.335 (2690 and 1340 m/s: CRC Handbook of Chemistry and Physics, read in a table that cites it), \
             and between them E grows with the logarithm of the frequency (Frequency and temperature dependence of elastic moduli of polymers, 10² to 10⁶ Hz, abstract). \
             Tensile strength 59.8 MPa, K_Ic 1.207 MPa√m (ASTM E399), both of slow tests: Seleš et al., too; \
             ρ 1190 kg/m³: designerdata.nl, PMMA (cast). G_c = K²(1−ν²)/E = 257 J/m². \
             Weibull modulus 13, derived: bars of 80 mm³ bent at three points break at 125.2 ± 6.8 MPa where they are milled from factory blocks \
             (109.7 ± 14.1 cured by hand; 10 bars each: Eur. J. Dent. 2024, 10.1055/s-0044-1791965, abstract), tension bars of 3.2 cm³ at the strength above, \
             and (3.2 cm³ · 2 (m+1)² / 80 mm³)^(1/m) = 125.2/59.8 gives 13; the scatter, m = 1.10 mean/deviation (Appl. Sci. 9 (2019) 1575, abstract), gives 20 and 9. \
             Branching constant, derived: a crack splits where the energy that flows into its tip is 11 MN/s (Nishioka et al., J. Soc. Mat. Sci. Japan 61 (2012), no. 11, abstract). \
             At speed v that is v (1 − v/c_R) J, most at half of c_R = 1167 m/s; so J = 4 · 11 MN/s / c_R = 38 kJ/m² at least, K = 14.6 MPa√m = 12.1 K_Ic, and σ √r = K/1.24. \
             Crushing pressure, derived: shocked it yields at some 0.75 GPa (Schuler & Nunziato, J. Appl. Phys. 47 (1976) 2995, abstract), so Y = 0.75 GPa · (1−2ν)/(1−ν) = 0.36 GPa, \
             and a ball is pressed in at (2Y/3)(1 + 3 ln c/a), c/a = 1.9 (Kent, J. Phys. D 14 (1981) 601, and thesis, Univ. of Surrey, abstracts). The yield stress of slow tests gives their hardness of 0.2 GPa so.",
    youngs_modulus: 5.0e9,
    poisson_ratio: 0.345,
    density: 1190.0,
    strength: 59.8e6,
    toughness: Toughness::Intensity(1.207e6),
    loss_factor: 3e-2,
    // As the strength scatters, their number is a resolution: under a small ball stress falls within a millimetre, where 1e9 gave a star
    // of 1 mm 3.8 arms at 80 m/s and four times as many 7.0.
    weak_point_density: 4e9,
    roughness: [0.1e-3, 6e-3],
    crushing_pressure: 0.69e9,
    restitution: 0.5,
    friction: 0.4,
});

pub(super) const STEEL: Preset = real(Published {
    name: "steel",
    summary: "structural steel: balls, anvils; a striker",
    source: "E 210 GPa, ν 0.3, ultimate strength 360 MPa (S235): EN 1993-1-1; ρ 7850 kg/m³: EN 1991-1-1; K_Ic 140 MPa√m (mild steel): \
             Ashby & Jones, Engineering Materials 1 (not re-checked). G_c = K²(1−ν²)/E = 84933 J/m². \
             No crushing pressure: balls and hammers that strike are hardened.",
    youngs_modulus: 210e9,
    poisson_ratio: 0.3,
    density: 7850.0,
    strength: 360e6,
    toughness: Toughness::Intensity(140e6),
    loss_factor: 2e-4,
    weak_point_density: 1e7,
    roughness: [0.2e-3, 3e-3],
    crushing_pressure: f64::INFINITY,
    restitution: 0.6,
    friction: 0.4,
});

const RUBBER: Preset = real(Published {
    name: "rubber",
    summary: "vulcanised natural rubber: balls, mallets; a striker",
    source: "ρ 950 kg/m³, tensile strength 28 MPa: matweb.com, Natural Rubber, Vulcanized; E 2.5 MPa (1.5–2.5) and G_c 10000 J/m² (tearing energy, order of magnitude): \
             Ashby & Jones, Engineering Materials 1 (not re-checked). ν 0.49 keeps linear finite elements clear of the incompressible limit. \
             The corresponding K_Ic = √(G_c E/(1−ν²)) is 0.18 MPa√m.",
    youngs_modulus: 2.5e6,
    poisson_ratio: 0.49,
    density: 950.0,
    strength: 28e6,
    toughness: Toughness::Energy(10_000.0),
    loss_factor: 1e-1,
    weak_point_density: 1e7,
    roughness: [0.2e-3, 3e-3],
    crushing_pressure: f64::INFINITY,
    restitution: 0.75,
    friction: 0.9,
});

pub(super) const WOOD: Preset = real(Published {
    name: "wood",
    summary: "white oak, loaded across the grain: floors, table tops; a striker",
    source: "Forest Products Laboratory, Wood Handbook, 2010 (FPL-GTR-190), white oak at 12 % moisture: E 2.2 GPa = 0.163 × 13.5 GPa (radial), ν 0.37 (LR), \
             ρ 760 kg/m³, tension across the grain 5.5 MPa, K_Ic 0.45 MPa√m (mode I along the grain, 0.22–0.55; not re-checked). \
             G_c = K²(1−ν²)/E = 79.4 J/m². Wood is orthotropic; this stands for its contact only. \
             Crushing pressure 60 MPa: its side hardness is 6 kN on 1 cm².",
    youngs_modulus: 2.2e9,
    poisson_ratio: 0.37,
    density: 760.0,
    strength: 5.5e6,
    toughness: Toughness::Intensity(0.45e6),
    loss_factor: 1e-2,
    weak_point_density: 1e7,
    roughness: [0.5e-3, 4e-3],
    crushing_pressure: 6e7,
    restitution: 0.4,
    friction: 0.5,
});

pub(super) const STONE: Preset = real(Published {
    name: "stone",
    summary: "granite: floors, kerbs; a floor",
    source: "E 55 GPa, modulus of rupture 10–70 MPa, E 30–60 GPa for granites: Conservation of Historic Stone Buildings and Monuments, National Academy Press 1982, p. 64; \
             tensile strength 10 MPa: its lower end, as Westerly granite in direct tension; ν 0.25: makeitfrom.com, Granite; ρ 2650 kg/m³; \
             K_Ic 1.7 MPa√m: Westerly granite in Atkinson & Meredith, 1987 (not re-checked; see Schmidt & Lutz, ASTM STP 678 (1979) 166). \
             G_c = K²(1−ν²)/E = 49.3 J/m². Loss factor from Q ≈ 200, an estimate. \
             No crushing pressure: its minerals are harder than what is dropped on them.",
    youngs_modulus: 55e9,
    poisson_ratio: 0.25,
    density: 2650.0,
    strength: 10e6,
    toughness: Toughness::Intensity(1.7e6),
    loss_factor: 5e-3,
    weak_point_density: 4e7,
    roughness: [0.8e-3, 5e-3],
    crushing_pressure: f64::INFINITY,
    restitution: 0.4,
    friction: 0.6,
});

const SLAB: Table1 = Table1 {
    name: "paper-slab",
    summary: "the paper's slab, moderate mesh",
    source: "[G12 Table 1], slab moderate: E, α, β, R_c, G_c. The paper gives no ρ, ν, γ, weak points, roughness, restitution or friction: those are `glass`. \
             R_c 1 GPa is over twenty times the strength of real glass.",
    youngs_modulus: 100e9,
    stiffness_damping: 1e-10,
    mass_damping: 5.0,
    strength: 1e9,
    fracture_energy: 100.0,
};

pub(super) static PRESETS: [Preset; 25] = [
    tired(scattered(under_blows(GLASS, 1.52), 7.0, Preset::SPECIMEN)),
    tired(scattered(GLASS_NEW, 7.0, Preset::SPECIMEN)),
    tired(scattered(GLASS_ABRADED, 7.0, Preset::SPECIMEN)),
    TEMPERED_GLASS,
    HEAT_STRENGTHENED_GLASS,
    LAMINATED_GLASS,
    scattered(PORCELAIN, 10.0, 8.5e-8),
    scattered(BRICK, 6.0, Preset::SPECIMEN),
    scattered(under_blows(CONCRETE, 1.3), 7.0, 5.3e-3),
    scattered(MARBLE, 6.0, Preset::SPECIMEN),
    scattered(ICE, 6.0, Preset::SPECIMEN),
    SUGAR,
    scattered(CHOCOLATE, 6.0, Preset::SPECIMEN),
    scattered(branching(PMMA, 9.77), 13.0, 3.2e-6),
    STEEL,
    RUBBER,
    WOOD,
    STONE,
    paper(
        Table1 {
            name: "paper-glass",
            summary: "the paper's drinking glass",
            source: "[G12 Table 1], glass: E, α, β, R_c, G_c. The paper gives no ρ, ν, γ, weak points, roughness, restitution or friction: those are `glass`. \
                     R_c 4 GPa is a hundred times the strength of real glass.",
            youngs_modulus: 200e9,
            stiffness_damping: 1e-9,
            mass_damping: 5.0,
            strength: 4e9,
            fracture_energy: 150.0,
        },
        &GLASS,
    ),
    paper(
        Table1 {
            name: "paper-piggy",
            summary: "the paper's piggy bank",
            source: "[G12 Table 1], piggy bank: E, α, β, R_c, G_c. The paper gives no ρ, ν, γ, weak points, roughness, restitution or friction: those are `porcelain`.",
            youngs_modulus: 200e9,
            stiffness_damping: 1e-8,
            mass_damping: 3.0,
            strength: 5e8,
            fracture_energy: 500.0,
        },
        &PORCELAIN,
    ),
    paper(
        Table1 {
            name: "paper-slab-low",
            summary: "the paper's slab, coarse mesh",
            source: "[G12 Table 1], slab low: E, α, β, R_c, G_c; the numbers of `paper-slab`, only the paper's mesh differs. The rest is `glass`.",
            ..SLAB
        },
        &GLASS,
    ),
    paper(SLAB, &GLASS),
    paper(
        Table1 {
            name: "paper-slab-high",
            summary: "the paper's slab, fine mesh, as in its Fig. 7",
            source: "[G12 Table 1], slab high: E, α, β, R_c; G_c 90 J/m² is the middle one of the three of Fig. 7 (150, 90, 60). The rest is `glass`.",
            fracture_energy: 90.0,
            ..SLAB
        },
        &GLASS,
    ),
    paper(
        Table1 {
            name: "paper-slab-very-high",
            summary: "the paper's slab, finest mesh",
            source: "[G12 Table 1], slab very high: E, α, β (10 1/s here), R_c, G_c. The rest is `glass`.",
            mass_damping: 10.0,
            ..SLAB
        },
        &GLASS,
    ),
    paper(
        Table1 {
            name: "paper-rabbit",
            summary: "the paper's bunny",
            source: "[G12 Table 1], bunny: E, α, β, R_c, G_c. The paper gives no ρ, ν, γ, weak points, roughness, restitution or friction: those are `porcelain`. \
                     E 1 GPa with R_c 0.5 GPa means a strain of one half at fracture: a figure, not a material.",
            youngs_modulus: 1e9,
            stiffness_damping: 2e-9,
            mass_damping: 5.0,
            strength: 5e8,
            fracture_energy: 100.0,
        },
        &PORCELAIN,
    ),
];
