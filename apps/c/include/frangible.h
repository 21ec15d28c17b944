/*
 * Frangible: physically based brittle fracture for C and C++. Made by cbindgen from the Rust code: do not edit.
 *
 * Every function that can fail returns a status, and writes nothing through its pointers unless that is FRANGIBLE_STATUS_OK;
 * frangible_error_text() says what is wrong and how to mend it. SI units. Vectors are three numbers, x, y, z; rotations are
 * quaternions x, y, z, w; matrices have nine numbers, column by column.
 *
 * Handles are numbers. All zeros is no handle. A handle that was freed, or that the library has not made, is told: the call
 * fails. Every function may be called from any thread.
 *
 * A struct that begins with `size` is given with its sizeof there, also where a function fills it:
 *   frangible_report report = {.size = sizeof report};
 * A library that is older than the program's header refuses the struct; a newer one knows the older layouts.
 */

#ifndef FRANGIBLE_H
#define FRANGIBLE_H

#include <stddef.h>
#include <stdint.h>

/**
 * A surface is opaque, or blends with what is behind it if the opacity of its base colour is below 1.
 */
#define FRANGIBLE_BLENDING_AUTO 0

/**
 * A surface blends with what is behind it; opacities of textures and vertices count, too.
 */
#define FRANGIBLE_BLENDING_BLEND 1

/**
 * Points with less opacity than `alpha_cutoff` are not drawn, the others are opaque.
 */
#define FRANGIBLE_BLENDING_MASK 2

/**
 * Multiplies base colour and opacity; sRGB.
 */
#define FRANGIBLE_TEXTURE_BASE_COLOR 0

/**
 * Green multiplies the roughness, blue the metallic share.
 */
#define FRANGIBLE_TEXTURE_METALLIC_ROUGHNESS 1

/**
 * Normals in tangent space.
 */
#define FRANGIBLE_TEXTURE_NORMAL 2

/**
 * Red is the share of ambient light that arrives.
 */
#define FRANGIBLE_TEXTURE_OCCLUSION 3

/**
 * Multiplies the emitted light; sRGB.
 */
#define FRANGIBLE_TEXTURE_EMISSION 4

/**
 * Beyond its border an image begins anew.
 */
#define FRANGIBLE_WRAP_REPEAT 0

/**
 * Beyond its border an image's border goes on.
 */
#define FRANGIBLE_WRAP_CLAMP 1

/**
 * Beyond its border an image begins anew, mirrored.
 */
#define FRANGIBLE_WRAP_MIRROR 2

/**
 * Format of an image.
 */
#define FRANGIBLE_IMAGE_PNG 0

/**
 * Format of an image.
 */
#define FRANGIBLE_IMAGE_JPEG 1

/**
 * Version of the header: a million times the major version, plus a thousand times the minor one, plus the patch. Compare it with
 * `frangible_version()`.
 */
#define FRANGIBLE_VERSION 1000

/**
 * A striker that does not move, such as a floor: `mass` and all that follows it count for nothing.
 */
#define FRANGIBLE_STRIKER_FIXED 0

/**
 * A ball, or anything else that is hit centrally: it strikes with its whole mass.
 */
#define FRANGIBLE_STRIKER_BALL 1

/**
 * A rigid body of any shape: it strikes with what its mass, centre and inertia are at the contact.
 */
#define FRANGIBLE_STRIKER_BODY 2

/**
 * A breakable body: as a rigid one, and it vibrates under the blow.
 */
#define FRANGIBLE_STRIKER_BREAKABLE 3

/**
 * Status of a call.
 */
enum frangible_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * It succeeded.
   */
  FRANGIBLE_STATUS_OK = 0,
  /**
   * A pointer is null or misaligned.
   */
  FRANGIBLE_STATUS_POINTER = 1,
  /**
   * A handle is zero, was freed, or is not one of this library.
   */
  FRANGIBLE_STATUS_HANDLE = 2,
  /**
   * The `size` of a struct is not one that this version knows.
   */
  FRANGIBLE_STATUS_SIZE = 3,
  /**
   * A number, a name or an array is invalid.
   */
  FRANGIBLE_STATUS_INPUT = 4,
  /**
   * An index or a count does not fit.
   */
  FRANGIBLE_STATUS_RANGE = 5,
  /**
   * A file cannot be read, or the bytes are not a baked body of this version.
   */
  FRANGIBLE_STATUS_FILE = 6,
  /**
   * A fragment is too small for vibration modes, so it cannot break again.
   */
  FRANGIBLE_STATUS_TOO_SMALL = 7,
  /**
   * An error of the library itself. Please report it with the text.
   */
  FRANGIBLE_STATUS_INTERNAL = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum frangible_status frangible_status;
#else
typedef int32_t frangible_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A motion: velocity of the centre of mass, m/s, and angular velocity, rad/s, in world axes.
 */
typedef struct {
  /**
   * Velocity of the centre of mass, m/s.
   */
  double linear[3];
  /**
   * Angular velocity, rad/s.
   */
  double angular[3];
} frangible_motion;

/**
 * Handle of one body, or of a piece of one. It keeps the cracks of blows that did not break it.
 */
typedef struct {
  /**
   * Its number.
   */
  uint64_t id;
} frangible_body;

/**
 * Striker of a body. `frangible_striker_of` fills it for a material.
 */
typedef struct {
  /**
   * sizeof(frangible_striker).
   */
  uint32_t size;
  /**
   * FRANGIBLE_STRIKER_FIXED, FRANGIBLE_STRIKER_BALL, FRANGIBLE_STRIKER_BODY or FRANGIBLE_STRIKER_BREAKABLE.
   */
  uint32_t kind;
  /**
   * Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid striker.
   */
  double contact_modulus;
  /**
   * Pressure that crushes or dents its surface, Pa; infinite if none does.
   */
  double crushing_pressure;
  /**
   * Coefficient of restitution, 0 to 1.
   */
  double restitution;
  /**
   * Radius of curvature at the contact, m; infinite for a flat striker.
   */
  double radius;
  /**
   * Mass, kg.
   */
  double mass;
  /**
   * Centre of mass, m, in the frame of the contacts.
   */
  double centre[3];
  /**
   * Inertia about it, kg·m², in the axes of the contacts. For a ball it may be zero, which stands for that of a ball of `radius`.
   */
  double inertia[9];
  /**
   * Its motion just before the blow, for `frangible_outcome_motions`.
   */
  frangible_motion motion;
  /**
   * The body, of a FRANGIBLE_STRIKER_BREAKABLE. The radius of curvature is its own.
   */
  frangible_body body;
  /**
   * The rotation of that body, from its frame to that of the contacts.
   */
  double rotation[4];
} frangible_striker;

/**
 * Handle of a kind of body: a shape and a material, baked by `frangible bake`. Any number of bodies share it.
 */
typedef struct {
  /**
   * Its number.
   */
  uint64_t id;
} frangible_breakable;

/**
 * A contact of a blow: a striker that comes, or a push of a script.
 */
typedef struct {
  /**
   * sizeof(frangible_contact).
   */
  uint32_t size;
  /**
   * Index of its striker among those of the call. Contacts with the same striker share its mass.
   */
  uint32_t striker;
  /**
   * Point of contact, m, in the frame of the body, whose origin is its centre of mass, or in world axes if the call gives a pose.
   */
  double point[3];
  /**
   * Direction of the push on the body, into it, of any length.
   */
  double normal[3];
  /**
   * Speed of approach along the normal just before the blow, m/s.
   */
  double speed;
  /**
   * Friction on the body per newton of normal force: the direction in which the striker drags the surface, times the coefficient of friction.
   * Its part along the normal counts for nothing. It counts in the blow on the body, not in `frangible_outcome_motions`.
   */
  double friction[3];
  /**
   * Impulse of a script's push, N·s.
   */
  double impulse[3];
  /**
   * Duration of a script's push, s; zero for a contact with a striker. If it is above zero, only `point` and `impulse` count.
   */
  double duration;
} frangible_contact;

/**
 * A pose: position of the centre of mass, m, and rotation, a quaternion x, y, z, w of length 1.
 */
typedef struct {
  /**
   * Position of the centre of mass, m.
   */
  double position[3];
  /**
   * Rotation.
   */
  double rotation[4];
} frangible_pose;

/**
 * Handle of the outcome of a blow.
 */
typedef struct {
  /**
   * Its number.
   */
  uint64_t id;
} frangible_outcome;

/**
 * Properties of a kind of body.
 */
typedef struct {
  /**
   * sizeof(frangible_about).
   */
  uint32_t size;
  /**
   * 1 if a support holds the body in place, else 0.
   */
  uint32_t supported;
  /**
   * Its name, UTF-8, which is valid while the handle is.
   */
  const char *name;
  /**
   * The name of its material.
   */
  const char *material;
  /**
   * Tensile strength, Pa.
   */
  double strength;
  /**
   * Coefficient of friction.
   */
  double friction;
  /**
   * Coefficient of restitution.
   */
  double restitution;
} frangible_about;

/**
 * Masses of a body or of a fragment.
 */
typedef struct {
  /**
   * sizeof(frangible_solid).
   */
  uint32_t size;
  /**
   * 1 if a support holds it in place: it is a fixed body of a physics engine. Else 0.
   */
  uint32_t supported;
  /**
   * Mass, kg.
   */
  double mass;
  /**
   * Volume, m³.
   */
  double volume;
  /**
   * Centre of mass, m, of a fragment in the frame of the body that broke.
   */
  double centre[3];
  /**
   * Inertia about the centre, kg·m², in the axes of that frame.
   */
  double inertia[9];
  /**
   * Principal moments of inertia, kg·m², for engines that take these three.
   */
  double moments[3];
  /**
   * The rotation from the principal axes to those of that frame.
   */
  double axes[4];
} frangible_solid;

/**
 * Triangles of one look, see `frangible_breakable_look`.
 */
typedef struct {
  /**
   * First index.
   */
  size_t first;
  /**
   * Number of indices.
   */
  size_t count;
  /**
   * Number of the look.
   */
  size_t look;
} frangible_group;

/**
 * A mesh to draw, in the frame of the body or of the fragment: its origin is the centre of mass. The arrays are valid while the handle is.
 */
typedef struct {
  /**
   * sizeof(frangible_geometry).
   */
  uint32_t size;
  /**
   * Zero.
   */
  uint32_t reserved;
  /**
   * Number of vertices.
   */
  size_t vertices;
  /**
   * Positions, m, three numbers per vertex.
   */
  const float *positions;
  /**
   * Unit normals, three numbers per vertex; null for the closed surface of a fragment, which has none.
   */
  const float *normals;
  /**
   * Texture coordinates, two numbers per vertex; null for the closed surface of a fragment.
   */
  const float *uvs;
  /**
   * Number of indices, three per triangle, counter-clockwise seen from outside.
   */
  size_t indices_count;
  /**
   * Number of indices that come first and belong to the body's original surface; those after them are crack faces.
   */
  size_t outer_indices;
  /**
   * The indices.
   */
  const uint32_t *indices;
  /**
   * Number of further sets of texture coordinates.
   */
  size_t more_uv_sets;
  /**
   * Those sets one after the other, two numbers per vertex each, zero on crack faces; null if there are none.
   */
  const float *more_uvs;
  /**
   * Linear red, green, blue and opacity of each vertex, white on crack faces; null if the mesh that was baked has no vertex colours.
   */
  const float *colors;
  /**
   * Number of groups.
   */
  size_t groups_count;
  /**
   * Ranges of the first `outer_indices` indices, one for each look; null if the mesh that was baked has no materials.
   */
  const frangible_group *groups;
} frangible_geometry;

/**
 * Convex parts for colliders, in the frame of the body or of the fragment. The arrays are valid while the handle is.
 */
typedef struct {
  /**
   * sizeof(frangible_hulls).
   */
  uint32_t size;
  /**
   * Zero.
   */
  uint32_t reserved;
  /**
   * Number of parts.
   */
  size_t count;
  /**
   * Points of all parts one after the other, m, three numbers per point.
   */
  const float *points;
  /**
   * For each part the number of points up to its end: part k has the points from `ends[k - 1]`, or 0, to `ends[k]`.
   */
  const size_t *ends;
} frangible_hulls;

/**
 * Looks of the mesh that was baked. Fragments have them, too.
 */
typedef struct {
  /**
   * sizeof(frangible_looks).
   */
  uint32_t size;
  /**
   * Zero.
   */
  uint32_t reserved;
  /**
   * Name of the mesh, UTF-8, which may be empty. The texts are valid while the handle is.
   */
  const char *name;
  /**
   * Number of looks, for `frangible_breakable_look`.
   */
  size_t looks;
  /**
   * Number of images, for `frangible_breakable_image`.
   */
  size_t images;
} frangible_looks;

/**
 * A material of the mesh that was baked, in the metallic-roughness model of glTF 2.0.
 */
typedef struct {
  /**
   * sizeof(frangible_look).
   */
  uint32_t size;
  /**
   * 1 if triangles are seen from behind, too, else 0.
   */
  uint32_t double_sided;
  /**
   * Its name, UTF-8, which may be empty.
   */
  const char *name;
  /**
   * Linear red, green, blue and opacity.
   */
  float base_color[4];
  /**
   * Light that it emits: linear red, green and blue.
   */
  float emission[3];
  /**
   * 0 (dielectric) to 1 (metal).
   */
  float metallic;
  /**
   * 0 (mirror) to 1 (matt).
   */
  float roughness;
  /**
   * Opacity below which points are not drawn, of a FRANGIBLE_BLENDING_MASK.
   */
  float alpha_cutoff;
  /**
   * FRANGIBLE_BLENDING_AUTO, FRANGIBLE_BLENDING_BLEND or FRANGIBLE_BLENDING_MASK.
   */
  uint32_t blending;
  /**
   * Zero.
   */
  uint32_t reserved;
  /**
   * Number of textures, for `frangible_breakable_texture`.
   */
  size_t textures;
} frangible_look;

/**
 * A texture of a look. Texture coordinates are scaled, rotated, then moved, as in `KHR_texture_transform`.
 */
typedef struct {
  /**
   * sizeof(frangible_texture).
   */
  uint32_t size;
  /**
   * FRANGIBLE_TEXTURE_BASE_COLOR and so on.
   */
  uint32_t slot;
  /**
   * Number of its image.
   */
  size_t image;
  /**
   * Set of texture coordinates: 0 is `uvs`, 1 the first of `more_uvs`.
   */
  uint32_t uv_set;
  /**
   * FRANGIBLE_WRAP_REPEAT, FRANGIBLE_WRAP_CLAMP or FRANGIBLE_WRAP_MIRROR, along u and v.
   */
  uint32_t wrap[2];
  /**
   * 1 if texels keep hard edges when they are enlarged, else 0.
   */
  uint32_t pixelated;
  /**
   * Scale of normals, or strength of occlusion; 1 for the others.
   */
  float strength;
  /**
   * Shift of the origin of the texture coordinates.
   */
  float offset[2];
  /**
   * Counter-clockwise, rad.
   */
  float rotation;
  /**
   * Along u and v.
   */
  float scale[2];
} frangible_texture;

/**
 * A file of an image. The bytes are valid while the handle is.
 */
typedef struct {
  /**
   * sizeof(frangible_image).
   */
  uint32_t size;
  /**
   * FRANGIBLE_IMAGE_PNG or FRANGIBLE_IMAGE_JPEG.
   */
  uint32_t kind;
  /**
   * Its name, UTF-8, which may be empty.
   */
  const char *name;
  /**
   * Bytes of the file.
   */
  const uint8_t *bytes;
  /**
   * Number of bytes.
   */
  size_t length;
} frangible_image;

/**
 * Result of a blow.
 */
typedef struct {
  /**
   * sizeof(frangible_report).
   */
  uint32_t size;
  /**
   * 1 if the body broke, else 0.
   */
  uint32_t broke;
  /**
   * Number of fragments, which together are the body; 0 if it did not break. They are in the order of their sizes, the largest first.
   */
  size_t fragments;
  /**
   * Number of contacts that were integrated, for `frangible_outcome_contact`.
   */
  size_t contacts;
  /**
   * Number of cracks that started.
   */
  size_t cracks;
  /**
   * Strength over an upper bound of the stress, which may be far above the stress itself; above 1 no crack started. 0 if the body broke.
   */
  double margin;
  /**
   * Duration of the contact, s.
   */
  double contact_duration;
  /**
   * Largest principal tensile stress at a weak point, Pa.
   */
  double peak_stress;
  /**
   * Upper bound of that stress, Pa.
   */
  double stress_bound;
  /**
   * Strength of the weakest point, Pa.
   */
  double strength;
  /**
   * Kinetic energy of the approach, J.
   */
  double approach_energy;
  /**
   * Energy spent on cracks, J.
   */
  double fracture_energy;
  /**
   * Sum of the impulses of all contacts on the body along their normals, N·s, in its frame.
   */
  double impulse[3];
  /**
   * Area of the cracks, one side, m².
   */
  double crack_area;
  /**
   * Time of the first crack since the start of the contact, s; NaN if there is none.
   */
  double first_crack_time;
  /**
   * Time that the computation took, s. The only number that is not the same in every run.
   */
  double seconds;
} frangible_report;

/**
 * Result of a blow at one contact.
 */
typedef struct {
  /**
   * sizeof(frangible_contact_report).
   */
  uint32_t size;
  /**
   * Zero.
   */
  uint32_t reserved;
  /**
   * Point on the surface, m, in the frame of the body.
   */
  double point[3];
  /**
   * Unit direction of the force on the body, in its frame.
   */
  double normal[3];
  /**
   * Impulse, N·s.
   */
  double impulse;
  /**
   * Largest force, N.
   */
  double peak_force;
  /**
   * Duration, s.
   */
  double duration;
  /**
   * Speed at which striker and body separate, m/s; below zero if the striker goes on into the body.
   */
  double departure_speed;
  /**
   * Energy spent on crushing, J.
   */
  double crushing_energy;
  /**
   * Crushed volume, m³.
   */
  double crushed_volume;
} frangible_contact_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Fills a striker with the numbers of a named material: "steel", "glass", "stone", "wood", "rubber", "concrete" … It is fixed and flat: set its
 * kind, mass, radius and centre if it is not.
 */
frangible_status frangible_striker_of(const char *material,
                                      frangible_striker *out);

/**
 * Makes a body of a kind. The seed selects its weak points; the same seed and blow give the same pieces, to the bit, on every machine. Free it with
 * `frangible_body_free`.
 */
frangible_status frangible_body_new(frangible_breakable breakable,
                                    uint64_t seed,
                                    frangible_body *out);

/**
 * Frees a body. A handle of zero is left alone.
 */
frangible_status frangible_body_free(frangible_body body);

/**
 * Computes the outcome of a blow: all contacts that meet the body at one time. `strikers` are those that the contacts name by their index; it may be
 * null if all are pushes of a script. With a `pose`, which may be null, contacts and strikers are in world axes. If the body holds, it keeps the
 * cracks of the blow. The body itself stays as it is if it breaks: replace it by the fragments. Free the outcome with `frangible_outcome_free`.
 */
frangible_status frangible_body_impact(frangible_body body,
                                       const frangible_contact *contacts,
                                       size_t contact_count,
                                       const frangible_striker *strikers,
                                       size_t striker_count,
                                       const frangible_pose *pose,
                                       frangible_outcome *out);

/**
 * Writes 1 if the blow would break the body, else 0. It computes no fragments and changes nothing. The arguments are those of
 * `frangible_body_impact`.
 */
frangible_status frangible_body_would_break(frangible_body body,
                                            const frangible_contact *contacts,
                                            size_t contact_count,
                                            const frangible_striker *strikers,
                                            size_t striker_count,
                                            const frangible_pose *pose,
                                            int32_t *out);

/**
 * Writes the strength over the largest stress at a weak point. Above 1 no crack starts; at or below 1 cracks start, which may or may not part the
 * body. Every weak point is computed, so it takes longer than `frangible_body_would_break`. It changes nothing. The arguments are those of
 * `frangible_body_impact`.
 */
frangible_status frangible_body_margin(frangible_body body,
                                       const frangible_contact *contacts,
                                       size_t contact_count,
                                       const frangible_striker *strikers,
                                       size_t striker_count,
                                       const frangible_pose *pose,
                                       double *out);

/**
 * Saves the state of a body, its cracks: all that a body is besides its kind and its seed. Writes the number of bytes to `length`, and the bytes to
 * `buffer`, which has room for `capacity`. Call it with a null `buffer` and a capacity of 0 to learn the length. Too little room is an error, and
 * nothing is written.
 */
frangible_status frangible_body_save(frangible_body body,
                                     uint8_t *buffer,
                                     size_t capacity,
                                     size_t *length);

/**
 * Restores a state that was saved of a body of the same kind and seed. A piece is restored by the blow that made it: its parent's kind, seed, state
 * and contacts make it again, to the bit; its own state comes on top.
 */
frangible_status frangible_body_restore(frangible_body body,
                                        const uint8_t *bytes,
                                        size_t length);

/**
 * Makes a kind from the bytes of a `.frangible` file. The bytes are copied. Free it with `frangible_breakable_free`.
 */
frangible_status frangible_breakable_from_bytes(const uint8_t *bytes, size_t length, frangible_breakable *out);

/**
 * Makes a kind from a `.frangible` file. `path` is UTF-8. Free it with `frangible_breakable_free`.
 */
frangible_status frangible_breakable_load(const char *path, frangible_breakable *out);

/**
 * Makes a kind that is `factor` times as large in every direction. Scale the kind that was loaded, not one that was scaled: roundings add up. Free
 * it with `frangible_breakable_free`.
 */
frangible_status frangible_breakable_scaled(frangible_breakable breakable,
                                            double factor,
                                            frangible_breakable *out);

/**
 * Frees a kind. Its bodies stay; the arrays and texts that the kind gave are gone. A handle of zero is left alone.
 */
frangible_status frangible_breakable_free(frangible_breakable breakable);

/**
 * Tells what a kind is.
 */
frangible_status frangible_breakable_about(frangible_breakable breakable, frangible_about *out);

/**
 * Gives the masses of a kind. Its centre of mass is the origin.
 */
frangible_status frangible_breakable_solid(frangible_breakable breakable, frangible_solid *out);

/**
 * Gives the mesh of a kind, to draw. Texture coordinates are those of the mesh that was baked, if it has any, else a box projection in metres.
 */
frangible_status frangible_breakable_geometry(frangible_breakable breakable,
                                              frangible_geometry *out);

/**
 * Gives the convex parts of a kind, for colliders.
 */
frangible_status frangible_breakable_hulls(frangible_breakable breakable, frangible_hulls *out);

/**
 * Returns what was wrong in the last call of this thread that failed, and how to mend it, as UTF-8; an empty text if none failed. The text belongs
 * to the library. It is valid until the next call of this thread that fails, and until the thread ends.
 */
const char *frangible_error_text(void);

/**
 * Tells the name of the mesh that was baked, and how many looks and images it has.
 */
frangible_status frangible_breakable_looks(frangible_breakable breakable, frangible_looks *out);

/**
 * Gives a look, a material of the mesh that was baked.
 */
frangible_status frangible_breakable_look(frangible_breakable breakable, size_t look, frangible_look *out);

/**
 * Gives a texture of a look.
 */
frangible_status frangible_breakable_texture(frangible_breakable breakable,
                                             size_t look,
                                             size_t index,
                                             frangible_texture *out);

/**
 * Gives the file of an image.
 */
frangible_status frangible_breakable_image(frangible_breakable breakable, size_t image, frangible_image *out);

/**
 * Frees an outcome, and the arrays that it gave. A handle of zero is left alone.
 */
frangible_status frangible_outcome_free(frangible_outcome outcome);

/**
 * Tells whether the body broke, into how many fragments, and the numbers of the blow.
 */
frangible_status frangible_outcome_report(frangible_outcome outcome, frangible_report *out);

/**
 * Tells what came of the blow at one contact.
 */
frangible_status frangible_outcome_contact(frangible_outcome outcome, size_t index, frangible_contact_report *out);

/**
 * Gives the masses of a fragment.
 */
frangible_status frangible_outcome_solid(frangible_outcome outcome, size_t fragment, frangible_solid *out);

/**
 * Gives the mesh of a fragment, to draw, in the frame of the fragment: its origin is its centre of mass, its axes are those of the body that broke.
 * Cracks within it are drawn from both sides.
 */
frangible_status frangible_outcome_geometry(frangible_outcome outcome,
                                            size_t fragment,
                                            frangible_geometry *out);

/**
 * Gives the closed surface of a fragment, in the frame of the fragment: no vertex is doubled, and there are no normals and texture coordinates.
 */
frangible_status frangible_outcome_surface(frangible_outcome outcome,
                                           size_t fragment,
                                           frangible_geometry *out);

/**
 * Gives the convex parts of a fragment, for colliders, in the frame of the fragment.
 */
frangible_status frangible_outcome_hulls(frangible_outcome outcome, size_t fragment, frangible_hulls *out);

/**
 * Makes a fragment a body that can break again, in its own frame, with its share of the weak points and cracks, and with vibration modes of its
 * own. Computing the modes takes some tenths of a second: call it from another thread than that of the frames. Fails with
 * FRANGIBLE_STATUS_TOO_SMALL if the fragment is too small for that. Free it with `frangible_body_free`.
 */
frangible_status frangible_outcome_piece(frangible_outcome outcome,
                                         size_t fragment,
                                         frangible_body *out);

/**
 * Computes where the fragments are and how they move after the break, and how the striker does. A ball has flown through the fragments in its way.
 * Momentum and angular momentum are conserved, and energy does not increase. `pose` and `body` are the pose and the motion of the body just **before**
 * the blow, without any response of the engine. `striker` is the one that came, in world axes with its motion before the blow; null, or fixed, if it
 * does not give way. `poses` and `motions` have room for `count` fragments, which is their number; `poses` and `striker_after` may be null.
 *
 * If the body **held** the blow, `count` is 1, and the row is that of the body. Leave the contact out of the engine's step then. A blow whose report
 * has no contacts was refused by a bound, and changes nothing here: leave it to the engine.
 */
frangible_status frangible_outcome_motions(frangible_outcome outcome,
                                           const frangible_pose *pose,
                                           const frangible_motion *body,
                                           const frangible_striker *striker,
                                           frangible_pose *poses,
                                           frangible_motion *motions,
                                           size_t count,
                                           frangible_motion *striker_after);

/**
 * Returns the number of handles that were made and are not freed, of all sorts: zero at the end of a program that frees what it makes.
 */
size_t frangible_live_handles(void);

/**
 * The version of the library, as `FRANGIBLE_VERSION` is that of the header.
 */
uint32_t frangible_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FRANGIBLE_H */
