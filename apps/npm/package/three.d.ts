import type { BufferGeometry, Material, Mesh } from 'three';
import type { Geometry, Outcome, Solid } from './index.js';

/** Makes a BufferGeometry with two groups: 0 for the original surface, 1 for the crack faces. */
export function bufferGeometry(geometry: Geometry): BufferGeometry;

/** Makes a Mesh of a whole body or a fragment, with one material, or one for the original surface and one for the crack faces. */
export function mesh(solid: Pick<Solid, 'geometry'>, outer: Material, inner?: Material): Mesh;

/** Makes the meshes of all fragments of a break, at the pose of the body; `motions` is the result of `outcome.motions(…)`. */
export function meshes(outcome: Outcome, motions: ReturnType<NonNullable<Outcome['motions']>>, outer: Material, inner?: Material): Mesh[];
