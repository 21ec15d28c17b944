// Geometries and objects for three.js. three.d.ts documents the interface.
import { BufferAttribute, BufferGeometry, Mesh } from 'three';

/** Makes a BufferGeometry with two groups: 0 for the original surface, 1 for the crack faces. */
export function bufferGeometry({ positions, normals, uvs, indices, outerIndices }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
  geometry.setIndex(new BufferAttribute(indices, 1));
  geometry.addGroup(0, outerIndices, 0);
  geometry.addGroup(outerIndices, indices.length - outerIndices, 1);
  return geometry;
}

/** Makes a Mesh of a whole body or a fragment, with one material, or one for the original surface and one for the crack faces. */
export function mesh(solid, outer, inner = outer) {
  return new Mesh(bufferGeometry(solid.geometry), [outer, inner]);
}

/** Makes the meshes of all fragments of a break, at the pose of the body; `motions` is the result of `outcome.motions(…)`. */
export function meshes(outcome, motions, outer, inner = outer) {
  return outcome.fragments.map((fragment, i) => {
    const piece = mesh(fragment, outer, inner);
    piece.position.fromArray(motions.fragments[i].position);
    piece.quaternion.fromArray(motions.fragments[i].rotation);
    return piece;
  });
}
