//! The knobs one by one.

use frangible::internals::DurationModel;

use super::{Kind, Knob};

/// In a material, by a field; numbers of the knob's own unit.
macro_rules! of_material {
    ($name:literal, $label:literal, $unit:literal, $factor:expr, $range:expr, $kind:expr, $field:ident, $rebakes:expr, $help:literal) => {
        Knob {
            name: $name,
            label: $label,
            unit: $unit,
            factor: $factor,
            range: $range,
            kind: $kind,
            help: $help,
            rebakes: $rebakes,
            get: |s| s.material.$field,
            set: |s, x| s.material.$field = x,
        }
    };
}

/// A switch of the fracture.
macro_rules! switch {
    ($name:literal, $label:literal, $field:ident, $help:literal) => {
        Knob {
            name: $name,
            label: $label,
            unit: "",
            factor: 1.0,
            range: [0.0, 1.0],
            kind: Kind::Switch,
            help: $help,
            rebakes: false,
            get: |s| f64::from(u8::from(s.fracture.$field)),
            set: |s, x| s.fracture.$field = x > 0.5,
        }
    };
}

/// Names of the duration models, in the order of their numbers.
const DURATIONS: [&str; 4] = ["integrated", "Hertz", "modal Hertz", "as printed"];

/// All knobs, in the order of the panel.
pub static KNOBS: [Knob; 20] = [
    of_material!(
        "strength",
        "strength R_c",
        "MPa",
        1e6,
        [0.01, 10_000.0],
        Kind::Factor,
        strength,
        false,
        "a crack starts at a weak point where the principal tension σ₁ > R_c"
    ),
    of_material!(
        "toughness",
        "fracture energy G_c",
        "J/m²",
        1.0,
        [0.1, 1e6],
        Kind::Factor,
        fracture_energy,
        false,
        "energy needed per crack area: E = A G_c [Eq. 11]; a crack runs while the strain energy suffices"
    ),
    of_material!(
        "gamma",
        "energy depth γ",
        "mm",
        1e-3,
        [0.01, 1000.0],
        Kind::Factor,
        energy_depth,
        false,
        "depth of the material whose strain energy feeds a crack: W = γ A ½ σ:ε [Eq. 12]"
    ),
    of_material!(
        "weak-points",
        "weak points",
        "1/cm³",
        1e6,
        [0.001, 10_000.0],
        Kind::Factor,
        weak_point_density,
        false,
        "a tetrahedron of volume V is weak with probability 1 − exp(−density V)"
    ),
    of_material!(
        "noise",
        "roughness",
        "mm",
        1e-3,
        [0.0, 10.0],
        Kind::Even,
        roughness_amplitude,
        false,
        "amplitude of the noise on a crack's plane: s(x) = n·(x − x₀) + a N(x / wavelength) [Eq. 6-10]"
    ),
    of_material!(
        "wavelength",
        "roughness wavelength",
        "mm",
        1e-3,
        [0.1, 200.0],
        Kind::Factor,
        roughness_wavelength,
        false,
        "wavelength of the noise on a crack's plane: s(x) = n·(x − x₀) + a N(x / wavelength)"
    ),
    of_material!(
        "youngs-modulus",
        "Young's modulus E",
        "GPa",
        1e9,
        [0.001, 1000.0],
        Kind::Factor,
        youngs_modulus,
        false,
        "K ~ E: every frequency scales with √(E/ρ), the stress at a given strain with E; the modes are rescaled without a new bake"
    ),
    of_material!(
        "density",
        "density ρ",
        "kg/m³",
        1.0,
        [50.0, 25_000.0],
        Kind::Factor,
        density,
        false,
        "M ~ ρ: every frequency scales with √(E/ρ), the mass with ρ; the modes are rescaled without a new bake"
    ),
    of_material!(
        "poisson",
        "Poisson's ratio ν",
        "",
        1.0,
        [0.0, 0.495],
        Kind::Even,
        poisson_ratio,
        true,
        "λ = E ν / ((1 + ν)(1 − 2ν)); changes the modes, so the body is baked again in the background"
    ),
    of_material!(
        "alpha",
        "stiffness damping α",
        "µs",
        1e-6,
        [0.0, 1000.0],
        Kind::Even,
        stiffness_damping,
        false,
        "D = α K + β M: d_i = α λ_i + β, damps high frequencies most [Table 1]"
    ),
    of_material!(
        "beta",
        "mass damping β",
        "1/s",
        1.0,
        [0.0, 10_000.0],
        Kind::Even,
        mass_damping,
        false,
        "D = α K + β M: d_i = α λ_i + β, the same for all modes [Table 1]"
    ),
    Knob {
        name: "modes",
        label: "modes",
        unit: "",
        factor: 1.0,
        range: [1.0, 400.0],
        kind: Kind::Whole,
        rebakes: true,
        help: "number of columns of Φ in u = Φ q, lowest frequencies first; the body is baked again in the background",
        get: |s| s.modes as f64,
        set: |s, x| s.modes = x as usize,
    },
    Knob {
        name: "duration",
        label: "contact duration",
        unit: "",
        factor: 1.0,
        range: [0.0, 3.0],
        kind: Kind::Choice(&DURATIONS),
        rebakes: false,
        help: "integrated: computed from striker, contact spring and vibration; Hertz: t_d = 2.868 (m² / (E² R v))^⅕ for the two bodies [Eq. 1]; modal Hertz: for the most excited mode; as printed: Eq. 2",
        get: |s| match s.fracture.duration {
            DurationModel::Integrated => 0.0,
            DurationModel::Hertz => 1.0,
            DurationModel::ModalHertz => 2.0,
            _ => 3.0,
        },
        set: |s, x| {
            s.fracture.duration = match x as usize {
                0 => DurationModel::Integrated,
                1 => DurationModel::Hertz,
                2 => DurationModel::ModalHertz,
                _ => DurationModel::AsPrinted {
                    c: s.printed_coefficient,
                },
            }
        },
    },
    Knob {
        name: "duration-coefficient",
        label: "its coefficient c",
        unit: "m^⅕ s^⅖",
        factor: 1.0,
        range: [1e-6, 10.0],
        kind: Kind::Factor,
        rebakes: false,
        help: "c of Eq. 2, used only by the model “as printed”",
        get: |s| s.printed_coefficient,
        set: |s, x| {
            s.printed_coefficient = x;
            if let DurationModel::AsPrinted { c } = &mut s.fracture.duration {
                *c = x;
            }
        },
    },
    switch!(
        "admissible",
        "admissible duration",
        admissible_duration,
        "t_d is increased until the energy of the modes does not exceed the approach energy: Σ ½(q̇² + λ q²) ≤ ½ m v²"
    ),
    Knob {
        name: "samples",
        label: "samples per period",
        unit: "",
        factor: 1.0,
        range: [2.0, 128.0],
        kind: Kind::Even,
        rebakes: false,
        help: "Δt = 2π / (ω_high samples), ω_high of the highest relevant mode [Eq. 3]",
        get: |s| s.fracture.samples_per_period,
        set: |s, x| s.fracture.samples_per_period = x,
    },
    switch!(
        "culling",
        "culling",
        culling,
        "reject blows that cannot break the body by the bound σ₁ ≤ Σ |q_i| max|σ_i|; affects speed, not the result"
    ),
    switch!(
        "sized-flaws",
        "flaw size",
        sized_flaws,
        "test a weak point with the mean stress over a flaw of depth a = (K_Ic / 1.12 R)² / π, not the stress at a point"
    ),
    Knob {
        name: "load-duration",
        label: "load duration",
        unit: "s",
        factor: 1.0,
        range: [1e-3, 1e10],
        kind: Kind::Factor,
        rebakes: false,
        help: "σⁿ t / B = R^(n−2) − S^(n−2): strength of glass after static fatigue under a sustained load; no effect on blows",
        get: |s| s.fracture.load_duration,
        set: |s, x| s.fracture.load_duration = x,
    },
    Knob {
        name: "seed",
        label: "seed",
        unit: "",
        factor: 1.0,
        range: [0.0, 1e6],
        kind: Kind::Whole,
        rebakes: false,
        help: "selects the random weak points and crack roughness; everything else stays the same",
        get: |s| s.seed as f64,
        set: |s, x| s.seed = x as u64,
    },
];
