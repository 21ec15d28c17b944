import type { BufferGeometry, Material, Mesh, MeshStandardMaterial } from 'three';
import type { Breakable, Geometry, Outcome, Solid } from './index.js';

/**
 * Makes a BufferGeometry with a group for each material of the original surface if there are several `materials`, otherwise group 0 for all of it,
 * and a last one, whose index is `materials`, for the crack faces. Default: 1.
 */
export function bufferGeometry(geometry: Geometry, materials?: number): BufferGeometry;

/**
 * Makes a Mesh of a whole body or a fragment: with one material, or one for each material of the mesh that was baked (see `materials`), and one for
 * the crack faces.
 */
export function mesh(solid: Pick<Solid, 'geometry'>, outer: Material | Material[], inner?: Material): Mesh;

/** Makes the meshes of all fragments of a break, at the pose of the body; `motions` is the result of `outcome.motions(…)`. */
export function meshes(outcome: Outcome, motions: ReturnType<NonNullable<Outcome['motions']>>, outer: Material | Material[], inner?: Material): Mesh[];

/**
 * Makes the materials of the mesh that was baked, with its names, colours, emission, sides and textures; empty if it has none. They are those of the
 * fragments, too. In a browser the pixels of textures arrive soon after.
 */
export function materials(kind: Breakable): MeshStandardMaterial[];
