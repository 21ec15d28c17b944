import type { BakeOptions, MeshInput, Placed } from './bake.js';
import type { Body, Breakable, Contact, Outcome, Pose } from './index.js';

type Before = Parameters<NonNullable<Outcome['motions']>>[0];
type After = ReturnType<NonNullable<Outcome['motions']>>;

/** An outcome whose motions and bodies of fragments are computed in the worker. */
export interface RemoteOutcome extends Omit<Outcome, 'motions' | 'body'> {
  motions?(before: Before): Promise<After>;
  body?(fragment: number): Promise<RemoteBody | undefined>;
}

/** A body in the worker. */
export interface RemoteBody {
  impact(contacts: Contact | Contact[], options?: { pose?: Pose }): Promise<RemoteOutcome>;
  free(): Promise<void>;
}

/** A kind of body in the worker; its properties are available here. */
export interface RemoteBreakable extends Omit<Breakable, 'body' | 'free'> {
  body(seed?: number): Promise<RemoteBody>;
  free(): Promise<void>;
}

/** A worker that stores and breaks bodies without blocking the page. Calls are answered in order. */
export class Workshop {
  /**
   * Reads a baked body in the worker, from a URL or bytes. `module`: URL of the WebAssembly module, if a bundler has moved it. `again`: let
   * pieces break again, which loads the second module.
   */
  load(source: string | URL | Uint8Array | ArrayBuffer, options?: { module?: string | URL; again?: boolean }): Promise<RemoteBreakable>;
  /** Bakes a mesh in the worker; pass the resulting bytes to `load`. */
  bake(mesh: MeshInput, options?: Omit<BakeOptions, 'module'> & { module?: string | URL }): Promise<Placed & { bytes: Uint8Array }>;
  /** Ends the worker and rejects pending calls. */
  close(): Promise<void>;
}
