import type { BufferGeometry, Material, Mesh } from 'three';
import type { Geometry, Outcome, Solid } from './index.js';

/** A BufferGeometry with two groups: 0 is the body's own outside, 1 its crack faces. */
export function bufferGeometry(geometry: Geometry): BufferGeometry;

/** A Mesh of a whole body or a fragment: one material, or one for the outside and one for the crack faces. */
export function mesh(solid: Pick<Solid, 'geometry'>, outer: Material, inner?: Material): Mesh;

/** Meshes of all fragments of a break, placed as the body was: `motions` are those of `outcome.motions(…)`. */
export function meshes(outcome: Outcome, motions: ReturnType<NonNullable<Outcome['motions']>>, outer: Material, inner?: Material): Mesh[];
