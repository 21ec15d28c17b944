//! Nodes and elements of MSH 2.2.

use glam::DVec3;

use super::builder::Builder;
use super::cursor::{Coding, Cursor};
use super::msh::{add, kind};
use crate::read::ReadError;

pub(super) fn nodes(
    cursor: &mut Cursor<'_>,
    coding: Coding,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let count = counted(cursor, coding, "$Nodes")?;
    for _ in 0..count {
        let inside = "$Nodes";
        let tag = cursor.count(4, inside)?;
        let mut next = || cursor.real(8, inside);
        let position = DVec3::new(next()?, next()?, next()?);
        builder.node(tag, position)?;
    }
    Ok(())
}

pub(super) fn elements(
    cursor: &mut Cursor<'_>,
    coding: Coding,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let inside = "$Elements";
    let count = counted(cursor, coding, inside)?;
    let mut nodes = Vec::new();
    let mut done = 0;
    while done < count {
        // Binary elements come in blocks of one type.
        let text = coding == Coding::Text;
        let mut number = if text { cursor.count(4, inside)? } else { 0 };
        let element_kind = cursor.integer(4, inside)?;
        let block = if text { 1 } else { cursor.count(4, inside)? };
        let tags = cursor.count(4, inside)?;
        let (node_count, usage) = kind(cursor, element_kind)?;
        if block == 0 {
            return Err(cursor.malformed("an element block is empty"));
        }
        for _ in 0..block {
            if !text {
                number = cursor.count(4, inside)?;
            }
            let mut physical = 0;
            for tag in 0..tags {
                let value = cursor.integer(4, inside)?;
                if tag == 0 {
                    physical = value;
                }
            }
            nodes.clear();
            for _ in 0..node_count {
                nodes.push(cursor.count(4, inside)?);
            }
            let groups: &[i64] = if physical == 0 { &[] } else { &[physical] };
            add(builder, number, usage, &mut nodes, groups)?;
        }
        done = done.saturating_add(block);
    }
    Ok(())
}

/// The count that opens a section, always text; the rest of the section is in `coding`.
fn counted(cursor: &mut Cursor<'_>, coding: Coding, inside: &str) -> Result<u64, ReadError> {
    let count = cursor.count(4, inside)?;
    if coding != Coding::Text {
        cursor.rest_of_line();
    }
    cursor.coding = coding;
    Ok(count)
}
