// Breaks a surface with three-pinata: node break.mjs SURFACE.obj SEEDS.json RUNS OUT.obj
// Prints RESULT and a line of JSON: processor seconds of each run. The pieces go to OUT.obj, one object each.

import { readFileSync, writeFileSync } from "node:fs";
import * as THREE from "three";
import { DestructibleMesh, FractureOptions } from "@dgreenheck/three-pinata";

const [surface, seeds, runs, out] = process.argv.slice(2);
const geometry = read(surface);
const seedPoints = JSON.parse(readFileSync(seeds, "utf8")).map(([x, y, z]) => new THREE.Vector3(x, y, z));
const seconds = [];
let pieces = [];
// The first run is for the compiler.
for (let run = 0; run <= Number(runs); run += 1) {
  const mesh = new DestructibleMesh(geometry.clone(), new THREE.MeshBasicMaterial(), new THREE.MeshBasicMaterial());
  const options = new FractureOptions({
    fractureMethod: "voronoi",
    fragmentCount: seedPoints.length,
    voronoiOptions: { mode: "3D", seedPoints },
    seed: 1,
  });
  const before = process.cpuUsage();
  pieces = mesh.fracture(options);
  const { user, system } = process.cpuUsage(before);
  if (run > 0) seconds.push(1e-6 * (user + system));
}
write(out, pieces);
console.log("RESULT", JSON.stringify({ seconds, version: THREE.REVISION }));

function read(path) {
  const positions = [];
  const index = [];
  for (const line of readFileSync(path, "utf8").split("\n")) {
    const words = line.split(/\s+/);
    if (words[0] === "v") positions.push(...words.slice(1, 4).map(Number));
    if (words[0] === "f") index.push(...words.slice(1, 4).map((word) => Number.parseInt(word, 10) - 1));
  }
  const read = new THREE.BufferGeometry();
  read.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  read.setIndex(index);
  read.computeVertexNormals();
  return read;
}

function write(path, meshes) {
  const lines = [];
  let before = 1;
  meshes.forEach(({ geometry: piece }, number) => {
    const position = piece.attributes.position;
    const corners = piece.index ? piece.index.array : [...Array(position.count).keys()];
    lines.push(`o piece${number}`);
    for (let v = 0; v < position.count; v += 1) lines.push(`v ${position.getX(v)} ${position.getY(v)} ${position.getZ(v)}`);
    for (let c = 0; c < corners.length; c += 3) {
      lines.push(`f ${corners[c] + before} ${corners[c + 1] + before} ${corners[c + 2] + before}`);
    }
    before += position.count;
  });
  writeFileSync(path, `${lines.join("\n")}\n`);
}
