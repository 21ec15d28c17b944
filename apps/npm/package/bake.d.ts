import type { BufferGeometry } from 'three';
import type { Breakable } from './index.js';

/** A mesh: any triangles that enclose something. Splits, doubles, turned faces and holes are mended. */
export type MeshInput = BufferGeometry | { positions: ArrayLike<number>; indices?: ArrayLike<number>; normals?: ArrayLike<number>; uvs?: ArrayLike<number> };

export interface BakeOptions {
  /** Named material, default `'glass'`: handled, as most is; `'glass-new'` and `'glass-abraded'` have another surface. Its strength scatters as the material's does. */
  material?: string;
  name?: string;
  /** Longest side, m. Default: the mesh's unit is the metre. */
  size?: number;
  /** Thickness, m, of a wall along the surface; default: the body is what the surface encloses. */
  wall?: number;
  /** How many tetrahedra it has for cracks, default 1500. Walls too thin for them are refused with the number that they need. */
  tetrahedra?: number;
  /** Vibration modes, default 40. */
  modes?: number;
  /** Told meanwhile: the stage, and its share that is done, 0 to 1. */
  onProgress?(stage: string, share: number): void;
  /** Where the second WebAssembly module is, where a bundler has moved it. */
  module?: WebAssembly.Module | string | URL | Response;
}

/** Where the mesh lies: a place p of it is at `scale * p + offset` in the body's frame, m, whose origin is the centre of mass. */
export interface Placed {
  scale: number;
  offset: [number, number, number];
}

/**
 * Bakes a mesh: the bytes of a `.frangible` file, for `Breakable.load`. It takes seconds: do it in a worker (`Workshop.bake`), or once, ahead of
 * time.
 */
export function bake(mesh: MeshInput, options?: BakeOptions): Promise<Placed & { bytes: Uint8Array }>;

/** The same, ready to be broken, and its pieces again. */
export function breakable(mesh: MeshInput, options?: BakeOptions): Promise<Breakable & Placed>;
