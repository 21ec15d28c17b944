//! A mesh written in every format and variant.

use std::fmt::Write;

/// Cubes of six tetrahedra each, with the triangles of the side x = 0 in group 7 and the tetrahedra in group 3.
pub(crate) struct Sample {
    pub(crate) nodes: Vec<[f64; 3]>,
    /// Four or ten nodes from 0, middles 01, 12, 02, 03, 13, 23.
    pub(crate) tets: Vec<Vec<u32>>,
    pub(crate) faces: Vec<[u32; 3]>,
}

pub(crate) const ENDS: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

pub(crate) fn sample(counts: [usize; 3], quadratic: bool) -> Sample {
    let [nx, ny, nz] = counts;
    let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let mut nodes = Vec::new();
    for k in 0..=nz {
        for j in 0..=ny {
            for i in 0..=nx {
                // Dyadic, so that text and f32 hold it exactly.
                nodes.push([
                    i as f64 * 0.125,
                    j as f64 * 0.25,
                    k as f64 * 0.125 + i as f64 * 0.03125,
                ]);
            }
        }
    }
    let mut tets = Vec::new();
    let orders = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                for (o, order) in orders.iter().enumerate() {
                    let mut at = [i, j, k];
                    let mut tet = vec![node(at[0], at[1], at[2])];
                    for &axis in order {
                        at[axis] += 1;
                        tet.push(node(at[0], at[1], at[2]));
                    }
                    if o > 2 {
                        tet.swap(2, 3);
                    }
                    tets.push(tet);
                }
            }
        }
    }
    let mut faces = Vec::new();
    for k in 0..nz {
        for j in 0..ny {
            faces.push([node(0, j, k), node(0, j + 1, k + 1), node(0, j + 1, k)]);
            faces.push([node(0, j, k), node(0, j, k + 1), node(0, j + 1, k + 1)]);
        }
    }
    let mut sample = Sample { nodes, tets, faces };
    if quadratic {
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for tet in &mut sample.tets {
            for [a, b] in ENDS {
                let edge = [tet[a].min(tet[b]), tet[a].max(tet[b])];
                let corners = (nx + 1) * (ny + 1) * (nz + 1);
                let at = edges.iter().position(|e| *e == edge).unwrap_or_else(|| {
                    let [p, q] = edge.map(|v| sample.nodes[v as usize]);
                    sample.nodes.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
                    edges.push(edge);
                    edges.len() - 1
                });
                tet.push((corners + at) as u32);
            }
        }
    }
    sample
}

/// Gmsh's order of the middles.
fn gmsh(tet: &[u32]) -> Vec<u32> {
    let mut tet = tet.to_vec();
    if tet.len() == 10 {
        tet.swap(8, 9);
    }
    tet
}

fn words<T: ToString>(values: impl IntoIterator<Item = T>) -> String {
    let words: Vec<String> = values.into_iter().map(|v| v.to_string()).collect();
    words.join(" ")
}

/// Numbers as text or in bytes of either order.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum As {
    Text,
    Little,
    Big,
}

struct Out(Vec<u8>, As);

impl Out {
    fn text(&mut self, text: &str) {
        self.0.extend(text.as_bytes());
    }
    fn put(&mut self, text: String, little: &[u8]) {
        match self.1 {
            As::Text => self.text(&(text + " ")),
            As::Little => self.0.extend(little),
            As::Big => self.0.extend(little.iter().rev()),
        }
    }
    fn int(&mut self, x: i32) {
        self.put(x.to_string(), &x.to_le_bytes());
    }
    fn size(&mut self, x: u64) {
        self.put(x.to_string(), &x.to_le_bytes());
    }
    fn real(&mut self, x: f64) {
        self.put(x.to_string(), &x.to_le_bytes());
    }
    fn end_line(&mut self) {
        self.text("\n");
    }
}

const NAMES: &str = "$PhysicalNames\n2\n2 7 \"the side\"\n3 3 \"body\"\n$EndPhysicalNames\n";

fn msh_start(version: &str, coding: As) -> Out {
    let mut out = Out(Vec::new(), coding);
    let binary = u8::from(coding != As::Text);
    out.text(&format!("$MeshFormat\n{version} {binary} 8\n"));
    if binary == 1 {
        out.int(1);
        out.end_line();
    }
    out.text("$EndMeshFormat\n");
    out.text(NAMES);
    out
}

/// Nodes are numbered from `first` in steps of `step`.
pub(crate) fn msh2(s: &Sample, coding: As, first: u32, step: u32) -> Vec<u8> {
    let mut out = msh_start("2.2", coding);
    let number = |v: u32| (first + step * v) as i32;
    out.text(&format!("$Nodes\n{}\n", s.nodes.len()));
    for (v, p) in s.nodes.iter().enumerate() {
        out.int(number(v as u32));
        p.iter().for_each(|&x| out.real(x));
    }
    out.text(&format!(
        "\n$EndNodes\n$Elements\n{}\n",
        s.faces.len() + s.tets.len()
    ));
    let faces = s.faces.iter().map(|f| (2, 7, f.to_vec()));
    let kind = if s.tets[0].len() == 4 { 4 } else { 11 };
    let tets = s.tets.iter().map(|t| (kind, 3, gmsh(t)));
    for (i, (kind, group, nodes)) in faces.chain(tets).enumerate() {
        let head = if coding == As::Text {
            [i as i32 + 1, kind, 2]
        } else {
            [kind, 1, 2]
        };
        head.iter().for_each(|&x| out.int(x));
        if coding != As::Text {
            out.int(i as i32 + 1);
        }
        out.int(group);
        out.int(1);
        nodes.iter().for_each(|&v| out.int(number(v)));
    }
    out.text("\n$EndElements\n");
    out.0
}

pub(crate) fn msh4(s: &Sample, coding: As) -> Vec<u8> {
    let mut out = msh_start("4.1", coding);
    out.text("$Entities\n");
    [0, 0, 1, 1].iter().for_each(|&x| out.size(x));
    for (tag, group) in [(5, 7), (9, 3)] {
        out.int(tag);
        (0..6).for_each(|_| out.real(0.0));
        out.size(1);
        out.int(group);
        out.size(0);
    }
    out.text("\n$EndEntities\n$Nodes\n");
    let n = s.nodes.len() as u64;
    [1, n, 1, n].iter().for_each(|&x| out.size(x));
    [3, 9, 0].iter().for_each(|&x| out.int(x));
    out.size(n);
    (1..=n).for_each(|tag| out.size(tag));
    s.nodes.iter().flatten().for_each(|&x| out.real(x));
    out.text("\n$EndNodes\n$Elements\n");
    let all = (s.faces.len() + s.tets.len()) as u64;
    [2, all, 1, all].iter().for_each(|&x| out.size(x));
    let mut number = 0;
    let kind = if s.tets[0].len() == 4 { 4 } else { 11 };
    let faces: Vec<Vec<u32>> = s.faces.iter().map(|f| f.to_vec()).collect();
    let tets: Vec<Vec<u32>> = s.tets.iter().map(|t| gmsh(t)).collect();
    for (dimension, entity, kind, elements) in [(2, 5, 2, faces), (3, 9, kind, tets)] {
        [dimension, entity, kind].iter().for_each(|&x| out.int(x));
        out.size(elements.len() as u64);
        for nodes in elements {
            number += 1;
            out.size(number);
            nodes.iter().for_each(|&v| out.size(u64::from(v) + 1));
        }
    }
    out.text("\n$EndElements\n");
    out.0
}

/// Text of the .node, the .ele and the .face.
pub(crate) fn tetgen(s: &Sample, first: u32) -> [String; 3] {
    let mut node = format!("# made by hand\n{} 3 0 0\n", s.nodes.len());
    for (v, p) in s.nodes.iter().enumerate() {
        writeln!(node, "  {}  {}  # a node", v as u32 + first, words(p)).unwrap();
    }
    // Another order of the middles than ours.
    let order = [0, 1, 2, 3, 9, 8, 4, 7, 6, 5];
    let mut ele = format!("{} {} 1\n\n", s.tets.len(), s.tets[0].len());
    for (e, tet) in s.tets.iter().enumerate() {
        let nodes = order.iter().filter_map(|&k| tet.get(k)).map(|v| v + first);
        writeln!(ele, "{} {} 3", e as u32 + first, words(nodes)).unwrap();
    }
    let mut face = format!("{} 1\n", s.faces.len() + 1);
    for (f, nodes) in s.faces.iter().enumerate() {
        writeln!(
            face,
            "{} {} 7",
            f as u32 + first,
            words(nodes.map(|v| v + first))
        )
        .unwrap();
    }
    writeln!(
        face,
        "{} {} 0",
        s.faces.len(),
        words([0, 1, 2].map(|v| v + first))
    )
    .unwrap();
    [node, ele, face]
}

pub(crate) fn medit(s: &Sample) -> Vec<u8> {
    let mut out = String::from("MeshVersionFormatted 2\nDimension\n3\n# a comment\nVertices\n");
    writeln!(out, "{}", s.nodes.len()).unwrap();
    for p in &s.nodes {
        writeln!(out, "{} 0", words(p)).unwrap();
    }
    writeln!(out, "Edges 1\n1 2 4\nTriangles\n{}", s.faces.len()).unwrap();
    for f in &s.faces {
        writeln!(out, "{} 7", words(f.map(|v| v + 1))).unwrap();
    }
    let keyword = if s.tets[0].len() == 4 {
        "Tetrahedra"
    } else {
        "TetrahedraP2"
    };
    writeln!(out, "{keyword}\n{}", s.tets.len()).unwrap();
    let order = [0, 1, 2, 3, 4, 6, 7, 5, 8, 9];
    for t in &s.tets {
        let nodes = order.iter().filter_map(|&k| t.get(k)).map(|v| v + 1);
        writeln!(out, "{} 3", words(nodes)).unwrap();
    }
    out.push_str("End\n");
    out.into_bytes()
}
