//! The methods, by name.

use std::fmt;

use frangible_mesh::did_you_mean;

/// A way to break a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Frangible's own: [`frangible::impact()`].
    #[default]
    Ours,
    /// A steady state in place of the vibration, after Müller, McMillan, Dorsey and Jagnow 2001.
    QuasiStatic,
    /// Cracks along the faces of the mesh's elements, as in Müller et al. 2001 and Smith, Witkin and Baraff 2001.
    Elements,
    /// Voronoi cells drawn by strain energy, kept apart by an energy criterion, after Zheng and James 2010.
    EnergyVoronoi,
    /// Voronoi cells around the impact point.
    Voronoi,
}

impl Method {
    /// All methods, in the order in which they are shown.
    pub const ALL: [Self; 5] = [
        Self::Ours,
        Self::QuasiStatic,
        Self::Elements,
        Self::EnergyVoronoi,
        Self::Voronoi,
    ];

    /// Its name in commands and files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ours => "ours",
            Self::QuasiStatic => "quasi-static",
            Self::Elements => "elements",
            Self::EnergyVoronoi => "energy-voronoi",
            Self::Voronoi => "voronoi",
        }
    }

    /// Short description of the method, for a heading.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Ours => "ours",
            Self::QuasiStatic => "quasi-static",
            Self::Elements => "element faces",
            Self::EnergyVoronoi => "Voronoi by energy",
            Self::Voronoi => "Voronoi at impact",
        }
    }

    /// The method of this [name](Self::name).
    ///
    /// # Errors
    /// A name that is none of them: says so, with the nearest one.
    pub fn from_name(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|method| method.name() == name);
        found.ok_or_else(|| {
            let known = Self::ALL.map(Self::name);
            let hint = did_you_mean(name, known);
            let known = known.join(", ");
            format!("there is no method `{name}`{hint}; methods: {known}")
        })
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
