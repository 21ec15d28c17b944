//! Values that may be written in two ways. Visitors of their own, since serde's untagged enums lose the line and the
//! name of a key that is wrong.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, Expected, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::schema::{MaterialTable, RotationTable};

/// `true`, `false` or a name.
pub(super) enum SwitchOrName {
    Switch(bool),
    Name(String),
}

impl<'de> Deserialize<'de> for SwitchOrName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl Visitor<'_> for Reader {
            type Value = SwitchOrName;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("true, false or a name in quotes")
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<SwitchOrName, E> {
                Ok(SwitchOrName::Switch(value))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<SwitchOrName, E> {
                Ok(SwitchOrName::Name(value.into()))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// `"x"`, `"y"`, `"z"` or a vector.
pub(super) enum AxisTable {
    Name(String),
    Vector([f64; 3]),
}

impl<'de> Deserialize<'de> for AxisTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = AxisTable;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("\"x\", \"y\", \"z\" or three numbers")
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<AxisTable, E> {
                Ok(AxisTable::Name(value.into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<AxisTable, A::Error> {
                Ok(AxisTable::Vector(exactly(seq, &self)?))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// Reads N values, neither fewer nor more.
fn exactly<'de, A: SeqAccess<'de>, T: Deserialize<'de> + Copy + Default, const N: usize>(
    mut seq: A,
    expected: &dyn Expected,
) -> Result<[T; N], A::Error> {
    let mut values = [T::default(); N];
    for (k, value) in values.iter_mut().enumerate() {
        let next = seq.next_element()?;
        *value = next.ok_or_else(|| A::Error::invalid_length(k, expected))?;
    }
    match seq.next_element::<IgnoredAny>()? {
        None => Ok(values),
        Some(_) => Err(A::Error::invalid_length(N + 1, expected)),
    }
}

/// One rotation, or several, one after the other about the world's axes.
pub(super) struct RotationChoice(pub(super) Vec<RotationTable>);

impl<'de> Deserialize<'de> for RotationChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = RotationChoice;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("{ axis = \"z\", degrees = 30 }, a list of such, or { quaternion = [x, y, z, w] }")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RotationChoice, A::Error> {
                let turn = RotationTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(RotationChoice(vec![turn]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<RotationChoice, A::Error> {
                let turns = Deserialize::deserialize(SeqAccessDeserializer::new(seq))?;
                Ok(RotationChoice(turns))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// A preset's name, or a preset with some numbers changed.
pub(super) struct MaterialChoice(pub(super) MaterialTable);

impl<'de> Deserialize<'de> for MaterialChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = MaterialChoice;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a material's name, or { preset = \"glass\", strength = 30e6 }")
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<MaterialChoice, E> {
                Ok(MaterialChoice(MaterialTable {
                    preset: Some(value.into()),
                    ..MaterialTable::default()
                }))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialChoice, A::Error> {
                let table = MaterialTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MaterialChoice(table))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// A factor, or two: where a colour is 0, and where it is 1.
#[derive(Clone, Copy)]
pub(super) enum OneOrTwo {
    One(f32),
    Two([f32; 2]),
}

impl OneOrTwo {
    /// The two; of one alone the first is `unpainted`.
    pub(super) const fn two(self, unpainted: f32) -> [f32; 2] {
        match self {
            Self::One(painted) => [unpainted, painted],
            Self::Two(both) => both,
        }
    }

    /// The one, if it is one.
    pub(super) const fn one(self) -> Option<f32> {
        match self {
            Self::One(factor) => Some(factor),
            Self::Two(_) => None,
        }
    }
}

impl<'de> Deserialize<'de> for OneOrTwo {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = OneOrTwo;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, or two with `paint`")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<OneOrTwo, E> {
                Ok(OneOrTwo::One(value as f32))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<OneOrTwo, E> {
                Ok(OneOrTwo::One(value as f32))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<OneOrTwo, E> {
                Ok(OneOrTwo::One(value as f32))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<OneOrTwo, A::Error> {
                Ok(OneOrTwo::Two(exactly(seq, &self)?))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}
