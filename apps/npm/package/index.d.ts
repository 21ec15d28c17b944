/** Three numbers: an array, or an object with x, y and z (three.js, Rapier). */
export type Vector = readonly [number, number, number] | ArrayLike<number> & Iterable<number> | { x: number; y: number; z: number };

/** A quaternion of length 1, x, y, z, w: an array, or an object. */
export type Rotation = readonly [number, number, number, number] | ArrayLike<number> & Iterable<number> | { x: number; y: number; z: number; w: number };

/** Where a body is: its centre of mass, m, and its rotation. */
export interface Pose {
  position: Vector;
  rotation: Rotation;
}

/** What hits the body. */
export interface Striker {
  /** kg. Infinity, the default: it does not give way. Where the hit is not central: the mass as it is met at the contact. */
  mass?: number;
  /** Named material, default `'steel'`: `'glass'`, `'stone'`, `'wood'`, `'rubber'`, `'concrete'` … */
  material?: string;
  /** Radius of curvature at the contact, m. Default: a ball of this mass and material; flat if it does not give way. */
  radius?: number;
  /** Coefficient of restitution, 0 to 1; default the material's. */
  restitution?: number;
}

/** A contact, in the body's frame (origin at its centre of mass), or in world axes where a pose is given. */
export type Contact = {
  /** Where, m. */
  point: Vector;
  /** Direction of the push on the body, any length: into it. */
  normal: Vector;
  /** Speed of approach along the normal, before the collision, m/s. */
  speed: number;
  striker?: Striker;
} | {
  point: Vector;
  /** A push that a script asks for, N·s, as a half-sine of this duration, s. */
  impulse: Vector;
  duration: number;
};

/** A mesh to draw. Groups: the body's own outside first, then crack faces. */
export interface Geometry {
  positions: Float32Array;
  normals: Float32Array;
  /** Texture coordinates: the author's outside, where there were any; metres by box projection elsewhere. */
  uvs: Float32Array;
  indices: Uint32Array;
  /** How many of the indices are of the body's own outside. */
  outerIndices: number;
}

/** What bodies and fragments have in common. */
export interface Solid {
  /** kg, m³. */
  mass: number;
  volume: number;
  /** Centre of mass, m: of a fragment in the frame of the body that broke, of a whole body the origin. */
  centre: Float64Array;
  /** Moments of inertia about the centre of mass, kg·m², nine numbers, in the axes of the body that broke. */
  inertia: Float64Array;
  /** In its own frame: origin at its centre of mass. */
  geometry: Geometry;
  /** Convex parts for colliders: the points of each, m, in its own frame. */
  hulls: Float32Array[];
  /** Whether something outside holds it: make it a fixed body. */
  supported: boolean;
}

export interface Fragment extends Solid {
  /** The closed surface, without doubled vertices. */
  solid: { positions: Float32Array; indices: Uint32Array };
}

export interface Report {
  /** s. */
  contactDuration: number;
  /** Largest principal tension at a weak point, what bounds it, and the strength of the weakest point, Pa. */
  peakStress: number;
  stressBound: number;
  strength: number;
  /** What the blow brought, and what the cracks took, J. */
  approachEnergy: number;
  fractureEnergy: number;
  /** m², one side. */
  crackArea: number;
  cracks: number;
  /** s after the contact began. */
  firstCrackTime?: number;
  /** How long the computation took, s. */
  seconds: number;
  /** What became of each contact. */
  contacts: ContactReport[];
}

/** What became of a contact. */
export interface ContactReport {
  /** N·s. */
  impulse: number;
  /** N. */
  peakForce: number;
  /** s. */
  duration: number;
  /** How fast striker and body part, m/s. */
  departureSpeed: number;
  /** What crushing took, J, and the volume that it crushed, m³. */
  crushingEnergy: number;
  crushedVolume: number;
}

/** How something moves: m/s and rad/s, world axes. */
export interface Motion {
  linear: [number, number, number];
  angular: [number, number, number];
}

export interface Outcome {
  broke: boolean;
  /** Strength over a bound of the stress, which may be far above the stress itself: above 1 nothing happened. Of a body that broke: 0. */
  margin: number;
  report: Report;
  /** Largest first; together they are the body. Empty where it held. */
  fragments: Fragment[];
  /**
   * How fragments and striker move after the break: momentum and angular momentum stay, and energy does not rise. Give the motions
   * just **before** the collision; take away what the engine has done since. Only where it broke.
   */
  motions?(before: {
    pose?: Pose;
    linear?: Vector;
    angular?: Vector;
    /** What hit the body, if it gives way: kg, m (its centre of mass, and its radius for its inertia), m/s, rad/s. */
    striker?: { mass: number; position: Vector; radius?: number; inertia?: ArrayLike<number> & Iterable<number>; linear?: Vector; angular?: Vector };
  }): { fragments: (Motion & { position: [number, number, number]; rotation: [number, number, number, number] })[]; striker?: Motion };
  /**
   * A fragment, by its number, as a body that breaks again, in its own frame: with its share of the weak points, and vibration modes of its
   * own, which take some tenths of a second to find (do it in a `Workshop`). Only where it broke, and the kind was loaded with `again`.
   * `undefined`: a crumb, too small to have modes.
   */
  body?(fragment: number): Body | undefined;
}

/** A kind of body: what `frangible bake` made of a shape and a material. */
export class Breakable implements Solid {
  /**
   * Reads a baked body: an address, bytes, or a response. Rejects with one sentence if it is not there, cut short, or of another version.
   * `module`: where the WebAssembly module is, where a bundler has moved it. `again`: pieces break again (`Outcome.body`); this takes the
   * second, larger module in place of the first.
   */
  static load(source: string | URL | Uint8Array | ArrayBuffer | Response, options?: { module?: WebAssembly.Module | string | URL | Response; again?: boolean }): Promise<Breakable>;
  readonly name: string;
  readonly material: string;
  readonly mass: number;
  readonly volume: number;
  readonly centre: Float64Array;
  readonly inertia: Float64Array;
  readonly geometry: Geometry;
  readonly hulls: Float32Array[];
  readonly supported: boolean;
  /** Tensile strength, Pa. */
  readonly strength: number;
  /** One body of the kind. The seed, a whole number, decides its weak points: same seed, same blow, same pieces, bit for bit, everywhere. */
  body(seed?: number): Body;
  /** Gives its memory back now, and not when it is collected. */
  free(): void;
}

/** One body, or a piece of one. It remembers cracks of blows that it held. */
export class Body {
  /** The kind that it is of; of a piece that of the whole body. */
  readonly kind: Breakable;
  /**
   * What contacts do to the body. Throws where a number cannot be used, and names it. With a `pose`, contacts are in world axes.
   */
  impact(contacts: Contact | Contact[], options?: { pose?: Pose }): Outcome;
  free(): void;
}

/** Loads the WebAssembly module; `Breakable.load` does so by itself. */
export function ready(module?: WebAssembly.Module | string | URL | Response): Promise<unknown>;
