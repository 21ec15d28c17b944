//! Report of a repair.

use std::fmt;

/// Counts of repairs and of remaining faults.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RepairReport {
    /// Vertices after.
    pub vertices_out: usize,
    /// Triangles after.
    pub faces_out: usize,
    /// Faces with fewer than three vertices, which the reader has passed over.
    pub skipped: usize,
    /// Vertices merged into others at the same place; texture seams are the usual reason.
    pub welded: usize,
    /// Vertices that no triangle used.
    pub loose: usize,
    /// Triangles without area, dropped.
    pub degenerate: usize,
    /// Triangles that repeated another, dropped; of pairs back to back without anything between, both.
    pub duplicate: usize,
    /// Triangles whose winding was turned.
    pub flipped: usize,
    /// Holes: connected chains of edges with one triangle.
    pub boundary_loops: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Edges with more than two triangles.
    pub non_manifold_edges: usize,
    /// Parts connected across edges of two triangles.
    pub shells: usize,
    /// Shells with a boundary, or that have one side only.
    pub open_shells: usize,
    /// Shells that have one side only, as a Möbius strip does.
    pub one_sided: usize,
    /// Closed shells that bound a hollow inside another, wound inwards.
    pub cavities: usize,
    /// Closed shells inside another and wound like it: solid within solid. Turned, they would be cavities.
    pub nested_alike: usize,
}

impl RepairReport {
    /// Returns true if every edge has two triangles and every shell two sides.
    #[must_use]
    pub fn is_watertight(&self) -> bool {
        self.open_shells == 0 && self.non_manifold_edges == 0
    }
}

/// One line about the repairs and the remaining faults; empty when there are none.
impl fmt::Display for RepairReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |count: usize, before: &str, one: &str, many: &str, after: &str| {
            let noun = if count == 1 { one } else { many };
            (count > 0).then(|| format!("{before}{count} {noun}{after}"))
        };
        let face = |count, before| counted(count, before, "triangle", "triangles", "");
        let parts = [
            counted(
                self.skipped,
                "skipped ",
                "face",
                "faces",
                " with fewer than three vertices",
            ),
            counted(self.welded, "welded ", "vertex", "vertices", ""),
            face(self.degenerate, "dropped degenerate: "),
            face(self.duplicate, "dropped duplicate: "),
            face(self.flipped, "flipped "),
            counted(self.boundary_loops, "", "hole remains", "holes remain", ""),
            counted(
                self.non_manifold_edges,
                "",
                "edge has",
                "edges have",
                " more than two triangles",
            ),
            counted(
                self.one_sided,
                "",
                "part has",
                "parts have",
                " only one side",
            ),
            counted(
                self.nested_alike,
                "",
                "shell lies",
                "shells lie",
                " inside another, taken as solid",
            ),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        f.write_str(&parts.join(", "))
    }
}
