//! Values that may be written in two ways. Visitors of their own, since serde's untagged enums lose the line and the
//! name of a key that is wrong.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

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
                let vector = Deserialize::deserialize(SeqAccessDeserializer::new(seq))?;
                Ok(AxisTable::Vector(vector))
            }
        }
        deserializer.deserialize_any(Reader)
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
