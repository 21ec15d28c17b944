import type { BakeOptions, MeshInput, Placed } from './bake.js';
import type { Body, Breakable, Contact, Outcome, Pose } from './index.js';

type Before = Parameters<NonNullable<Outcome['motions']>>[0];
type After = ReturnType<NonNullable<Outcome['motions']>>;

/** An outcome whose motions, and bodies of fragments, are found in the worker. */
export interface RemoteOutcome extends Omit<Outcome, 'motions' | 'body'> {
  motions?(before: Before): Promise<After>;
  body?(fragment: number): Promise<RemoteBody | undefined>;
}

/** A body in the worker. */
export interface RemoteBody {
  impact(contacts: Contact | Contact[], options?: { pose?: Pose }): Promise<RemoteOutcome>;
  free(): Promise<void>;
}

/** A kind of body in the worker, with all that is known of it here. */
export interface RemoteBreakable extends Omit<Breakable, 'body' | 'free'> {
  body(seed?: number): Promise<RemoteBody>;
  free(): Promise<void>;
}

/** A worker that holds bodies and breaks them, so that frames keep coming. Calls are answered in their order. */
export class Workshop {
  /**
   * Reads a baked body there: an address or bytes. `module`: address of the WebAssembly module, where a bundler has moved it. `again`: its
   * pieces break again, by the second module.
   */
  load(source: string | URL | Uint8Array | ArrayBuffer, options?: { module?: string | URL; again?: boolean }): Promise<RemoteBreakable>;
  /** Bakes a mesh there: the bytes are for `load`. */
  bake(mesh: MeshInput, options?: Omit<BakeOptions, 'module'> & { module?: string | URL }): Promise<Placed & { bytes: Uint8Array }>;
  /** Ends the worker; what still waits is rejected. */
  close(): Promise<void>;
}
