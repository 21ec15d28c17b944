//! Entities, nodes and elements of MSH 4.1.

use std::collections::BTreeMap;

use glam::DVec3;

use super::builder::Builder;
use super::cursor::Cursor;
use super::msh::{add, kind};
use crate::read::ReadError;

/// Physical groups of each entity that has any, by dimension and number.
#[derive(Default)]
pub(super) struct Entities(BTreeMap<(i64, i64), Vec<i64>>);

pub(super) fn entities(cursor: &mut Cursor<'_>) -> Result<Entities, ReadError> {
    let inside = "$Entities";
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.count(8, inside)?;
    }
    let mut groups = BTreeMap::new();
    for (dimension, count) in (0..).zip(counts) {
        for _ in 0..count {
            let tag = cursor.integer(4, inside)?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.real(8, inside)?;
            }
            let mut physical = Vec::new();
            for _ in 0..cursor.count(8, inside)? {
                physical.push(cursor.integer(4, inside)?);
            }
            if dimension > 0 {
                for _ in 0..cursor.count(8, inside)? {
                    cursor.integer(4, inside)?;
                }
            }
            if !physical.is_empty() {
                groups.insert((dimension, tag), physical);
            }
        }
    }
    Ok(Entities(groups))
}

pub(super) fn nodes(cursor: &mut Cursor<'_>, builder: &mut Builder) -> Result<(), ReadError> {
    let inside = "$Nodes";
    let blocks = cursor.count(8, inside)?;
    // Their number, and the least and greatest tag: found out by reading.
    for _ in 0..3 {
        cursor.count(8, inside)?;
    }
    let mut tags = Vec::new();
    for _ in 0..blocks {
        let dimension = cursor.count(4, inside)?;
        cursor.integer(4, inside)?;
        let parametric = cursor.integer(4, inside)? != 0;
        tags.clear();
        for _ in 0..cursor.count(8, inside)? {
            tags.push(cursor.count(8, inside)?);
        }
        let parameters = if parametric { dimension.min(3) } else { 0 };
        for &tag in &tags {
            let mut next = || cursor.real(8, inside);
            builder.node(tag, DVec3::new(next()?, next()?, next()?))?;
            for _ in 0..parameters {
                next()?;
            }
        }
    }
    Ok(())
}

pub(super) fn elements(
    cursor: &mut Cursor<'_>,
    entities: &Entities,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let inside = "$Elements";
    let blocks = cursor.count(8, inside)?;
    for _ in 0..3 {
        cursor.count(8, inside)?;
    }
    let mut nodes = Vec::new();
    for _ in 0..blocks {
        let dimension = cursor.integer(4, inside)?;
        let entity = cursor.integer(4, inside)?;
        let element_kind = cursor.integer(4, inside)?;
        let count = cursor.count(8, inside)?;
        let (node_count, usage) = kind(cursor, element_kind)?;
        let groups = entities.0.get(&(dimension, entity));
        let groups = groups.map_or(&[][..], Vec::as_slice);
        for _ in 0..count {
            let number = cursor.count(8, inside)?;
            nodes.clear();
            for _ in 0..node_count {
                nodes.push(cursor.count(8, inside)?);
            }
            add(builder, number, usage, &mut nodes, groups)?;
        }
    }
    Ok(())
}
