import type { BufferGeometry } from 'three';
import type { Breakable } from './index.js';

/**
 * A mesh of triangles that enclose a volume. Split or duplicate vertices, duplicate or inverted faces, and holes are repaired. Pieces keep normals, all
 * sets of texture coordinates (`uv`, `uv1`, `uv2`, `uv3`), vertex colours, and the material index of each group; tangents are not kept.
 */
export type MeshInput = BufferGeometry | {
  positions: ArrayLike<number>;
  indices?: ArrayLike<number>;
  normals?: ArrayLike<number>;
  uvs?: ArrayLike<number>;
  /** Further sets of texture coordinates, two numbers per vertex. */
  moreUvs?: ArrayLike<number>[];
  /** Linear colours of the vertices, three or four numbers each, 0 to 1. */
  colors?: ArrayLike<number> & Iterable<number>;
  /** Ranges of indices with the number of their material. */
  groups?: { start: number; count: number; material: number }[];
};

export interface BakeOptions {
  /** Name of the material, default `'glass'`, with handling damage; `'glass-new'` and `'glass-abraded'` differ in their surface, `'tempered-glass'` falls into dice, `'laminated-glass'` holds together; both must be panes. Strength scatters as given by the material. */
  material?: string;
  name?: string;
  /** Length of the longest side, m. Default: the mesh is in metres. */
  size?: number;
  /** Make a wall of this thickness, m, along the surface. Default: a solid body. */
  wall?: number;
  /** Approximate number of tetrahedra of the fracture mesh, default 1500. If walls are too thin for it, the error states the number that they need. */
  tetrahedra?: number;
  /** Number of vibration modes, default 40. */
  modes?: number;
  /**
   * Choice of one body from a mesh of several separate parts, which is refused without it: `'largest'` for the largest alone, `'weld'` for one body
   * of all. For a body of each part, bake them one by one.
   */
  parts?: 'largest' | 'weld';
  /** With `'weld'`, fill gaps between the parts up to this width, m. Default: only parts that touch. */
  gap?: number;
  /** Called with the current stage and its completed share, 0 to 1. */
  onProgress?(stage: string, share: number): void;
  /** Location of the second WebAssembly module, if a bundler has moved it. */
  module?: WebAssembly.Module | string | URL | Response;
}

/** Transform from the mesh to the body: a point p of the mesh is at `scale * p + offset` in the body's frame, m, whose origin is its centre of mass. */
export interface Placed {
  scale: number;
  offset: [number, number, number];
}

/**
 * Bakes a mesh and returns the bytes of a `.frangible` file for `Breakable.load`. Takes seconds: call it in a worker (`Workshop.bake`), or once
 * ahead of time.
 */
export function bake(mesh: MeshInput, options?: BakeOptions): Promise<Placed & { bytes: Uint8Array }>;

/** Bakes a mesh and loads the result, with pieces that can break again. */
export function breakable(mesh: MeshInput, options?: BakeOptions): Promise<Breakable & Placed>;
