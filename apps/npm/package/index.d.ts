/** Three numbers: an array, or an object with x, y and z (three.js, Rapier). */
export type Vector = readonly [number, number, number] | ArrayLike<number> & Iterable<number> | { x: number; y: number; z: number };

/** A quaternion of length 1, x, y, z, w: an array, or an object. */
export type Rotation = readonly [number, number, number, number] | ArrayLike<number> & Iterable<number> | { x: number; y: number; z: number; w: number };

/** Pose of a body: position of its centre of mass, m, and rotation. */
export interface Pose {
  position: Vector;
  rotation: Rotation;
}

/** The object that hits the body. */
export interface Striker {
  /** Mass, kg. Default: Infinity, an immovable striker. For an eccentric impact, give the effective mass at the contact. */
  mass?: number;
  /** Name of the material, default `'steel'`: `'glass'`, `'stone'`, `'wood'`, `'rubber'`, `'concrete'` … */
  material?: string;
  /** Radius of curvature at the contact, m. Default: the radius of a ball of this mass and material; flat if the mass is infinite. */
  radius?: number;
  /** Coefficient of restitution, 0 to 1. Default: the value of the material. */
  restitution?: number;
}

/** A contact, in the body's frame (origin at its centre of mass), or in world coordinates if `impact` gets a pose. */
export type Contact = {
  /** Contact point, m. */
  point: Vector;
  /** Direction of the push on the body, pointing into it, of any length. */
  normal: Vector;
  /** Approach speed along the normal just before the collision, m/s. */
  speed: number;
  striker?: Striker;
} | {
  point: Vector;
  /** Impulse of a scripted push, N·s, applied as a half-sine over `duration`, s. */
  impulse: Vector;
  duration: number;
};

/** A render mesh: the triangles of the body's original surface, followed by those of the crack faces. */
export interface Geometry {
  positions: Float32Array;
  normals: Float32Array;
  /** Texture coordinates: those of the mesh on the original surface, if it has any; elsewhere a box projection, in metres. */
  uvs: Float32Array;
  /** Further sets of texture coordinates of the mesh; zero on crack faces. */
  moreUvs: Float32Array[];
  /** Linear red, green, blue and opacity of each vertex, if the mesh has vertex colours; white on crack faces. */
  colors?: Float32Array;
  indices: Uint32Array;
  /** Number of leading indices that belong to the body's original surface. */
  outerIndices: number;
  /** Materials of the original surface, as indices into `looks.materials`; empty if the mesh has none. */
  groups: { start: number; count: number; material: number }[];
}

/** Looks of the mesh that was baked: they are also those of the original surface of each fragment. */
export interface Looks {
  /** Name of the mesh, which may be empty. */
  name: string;
  materials: Look[];
  /** Files of the images of the textures. */
  images: { name: string; type: 'image/png' | 'image/jpeg'; bytes: Uint8Array }[];
}

/** A material in the metallic-roughness model of glTF 2.0. */
export interface Look {
  name: string;
  /** Linear red, green, blue and opacity. */
  baseColor: [number, number, number, number];
  metallic: number;
  roughness: number;
  /** Linear red, green and blue of the emitted light. */
  emission: [number, number, number];
  doubleSided: boolean;
  /** `'auto'` blends if the base colour has an opacity below 1; `'mask'` leaves out points below `alphaCutoff`. */
  blending: 'auto' | 'blend' | 'mask';
  alphaCutoff?: number;
  textures: LookTexture[];
}

/** A texture of a material; offset, rotation and scale are those of `KHR_texture_transform`. */
export interface LookTexture {
  slot: 'baseColor' | 'metallicRoughness' | 'normal' | 'occlusion' | 'emission';
  /** Index into `looks.images`. */
  image: number;
  /** Set of texture coordinates: 0 is `uvs`, 1 the first of `moreUvs`. */
  uvSet: number;
  wrap: ['repeat' | 'clamp' | 'mirror', 'repeat' | 'clamp' | 'mirror'];
  pixelated: boolean;
  strength: number;
  offset: [number, number];
  rotation: number;
  scale: [number, number];
}

/** Properties that bodies and fragments share. */
export interface Solid {
  /** Mass, kg. */
  mass: number;
  /** Volume, m³. */
  volume: number;
  /** Centre of mass, m: for a fragment, in the frame of the body that broke; for a whole body, the origin. */
  centre: Float64Array;
  /** Inertia tensor about the centre of mass, kg·m², nine numbers, in the axes of the body that broke. */
  inertia: Float64Array;
  /** Render mesh in the solid's own frame, whose origin is its centre of mass. */
  geometry: Geometry;
  /** Convex parts for colliders: the points of each part, m, in the solid's own frame. */
  hulls: Float32Array[];
  /** True if a support fixes the solid in place; make it a fixed body in the physics engine. */
  supported: boolean;
}

export interface Fragment extends Solid {
  /** The closed surface, without duplicate vertices. */
  solid: { positions: Float32Array; indices: Uint32Array };
}

export interface Report {
  /** Duration of the contact, s. */
  contactDuration: number;
  /** Largest principal tensile stress at a weak point, Pa. */
  peakStress: number;
  /** Upper bound of that stress, Pa. */
  stressBound: number;
  /** Strength of the weakest point, Pa. */
  strength: number;
  /** Kinetic energy of the approach, J. */
  approachEnergy: number;
  /** Energy spent on cracks, J. */
  fractureEnergy: number;
  /** Area of the cracks, one side, m². */
  crackArea: number;
  /** Number of cracks. */
  cracks: number;
  /** Time of the first crack, s since the start of the contact. */
  firstCrackTime?: number;
  /** Time that the computation took, s. */
  seconds: number;
  /** Results for each contact. */
  contacts: ContactReport[];
}

/** Results for a contact. */
export interface ContactReport {
  /** Impulse, N·s. */
  impulse: number;
  /** Largest force, N. */
  peakForce: number;
  /** Duration, s. */
  duration: number;
  /** Speed at which striker and body separate, m/s. */
  departureSpeed: number;
  /** Energy spent on crushing, J. */
  crushingEnergy: number;
  /** Crushed volume, m³. */
  crushedVolume: number;
}

/** Linear velocity, m/s, and angular velocity, rad/s, in world axes. */
export interface Motion {
  linear: [number, number, number];
  angular: [number, number, number];
}

export interface Outcome {
  broke: boolean;
  /** Strength over an upper bound of the stress, which may be far above the stress itself; above 1, no crack started. 0 if the body broke. */
  margin: number;
  report: Report;
  /** The fragments, largest first; together they make up the body. Empty if it did not break. */
  fragments: Fragment[];
  /**
   * Computes the velocities of fragments and striker after the break. Momentum and angular momentum are conserved, and energy does not
   * increase. Pass the velocities just **before** the collision, without the engine's own collision response. A ball has flown through the
   * fragments in its way: let the engine ignore contacts between the two for 0.25 s. Defined only if the body broke.
   */
  motions?(before: {
    pose?: Pose;
    linear?: Vector;
    angular?: Vector;
    /** The striker, if it has a finite mass: kg, m (centre of mass, and radius for its inertia), m/s, rad/s. */
    striker?: { mass: number; position: Vector; radius?: number; inertia?: ArrayLike<number> & Iterable<number>; linear?: Vector; angular?: Vector };
  }): { fragments: (Motion & { position: [number, number, number]; rotation: [number, number, number, number] })[]; striker?: Motion };
  /**
   * Returns a fragment, by its index, as a body that can break again, in its own frame, with its share of the weak points and vibration modes
   * of its own. Computing the modes takes some tenths of a second, so use a `Workshop`. Defined only if the body broke and was loaded with
   * `again`. Returns `undefined` for a fragment that is too small for vibration modes.
   */
  body?(fragment: number): Body | undefined;
}

/** A kind of body: a shape and a material, baked by `frangible bake`. */
export class Breakable implements Solid {
  /**
   * Reads a baked body from a URL, bytes or a response. Rejects with a one-sentence message if the file is missing, truncated or of another
   * version. `module`: location of the WebAssembly module, if a bundler has moved it. `again`: let pieces break again (`Outcome.body`), which
   * loads the second, larger module instead of the first.
   */
  static load(source: string | URL | Uint8Array | ArrayBuffer | Response, options?: { module?: WebAssembly.Module | string | URL | Response; again?: boolean }): Promise<Breakable>;
  readonly name: string;
  readonly material: string;
  /** Name, materials and images of the mesh that was baked; undefined if it was made without one. */
  readonly looks?: Looks;
  readonly mass: number;
  readonly volume: number;
  readonly centre: Float64Array;
  readonly inertia: Float64Array;
  readonly geometry: Geometry;
  readonly hulls: Float32Array[];
  readonly supported: boolean;
  /** Tensile strength, Pa. */
  readonly strength: number;
  /** Makes one body of this kind. The seed, a whole number, selects its weak points; the same seed and blow give bit-identical pieces on every platform. */
  body(seed?: number): Body;
  /** Frees the memory now instead of at garbage collection. */
  free(): void;
}

/** One body, or a piece of one. It keeps the cracks of blows that did not break it. */
export class Body {
  /** The kind of this body; for a piece, the kind of the whole body. */
  readonly kind: Breakable;
  /**
   * Computes the outcome of contacts on the body. With a `pose`, contacts are in world coordinates. Throws an error that names an invalid value.
   */
  impact(contacts: Contact | Contact[], options?: { pose?: Pose }): Outcome;
  free(): void;
}

/** Loads the WebAssembly module in advance; `Breakable.load` also loads it. */
export function ready(module?: WebAssembly.Module | string | URL | Response): Promise<unknown>;
