// Geometries, materials and objects for three.js. three.d.ts documents the interface.
import {
  BufferAttribute,
  BufferGeometry,
  ClampToEdgeWrapping,
  Color,
  DoubleSide,
  FrontSide,
  LinearFilter,
  LinearMipmapLinearFilter,
  Mesh,
  MeshStandardMaterial,
  MirroredRepeatWrapping,
  NearestFilter,
  RepeatWrapping,
  SRGBColorSpace,
  Texture,
} from 'three';

/** Makes a BufferGeometry with a group for each material of the original surface, or group 0 for all of it, and a last one for the crack faces. */
export function bufferGeometry({ positions, normals, uvs, moreUvs = [], colors, indices, outerIndices, groups = [] }, materials = 1) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
  moreUvs.slice(0, 3).forEach((set, i) => geometry.setAttribute(`uv${i + 1}`, new BufferAttribute(set, 2)));
  if (colors) geometry.setAttribute('color', new BufferAttribute(colors, 4));
  geometry.setIndex(new BufferAttribute(indices, 1));
  const outside = materials > 1 && groups.length ? groups : [{ start: 0, count: outerIndices, material: 0 }];
  for (const { start, count, material } of outside) geometry.addGroup(start, count, material);
  geometry.addGroup(outerIndices, indices.length - outerIndices, materials);
  return geometry;
}

/** Makes a Mesh of a whole body or a fragment. */
export function mesh(solid, outer, inner = Array.isArray(outer) ? outer[0] : outer) {
  const outside = Array.isArray(outer) ? outer : [outer];
  return new Mesh(bufferGeometry(solid.geometry, outside.length), [...outside, inner]);
}

/** Makes the meshes of all fragments of a break, at the pose of the body; `motions` is the result of `outcome.motions(…)`. */
export function meshes(outcome, motions, outer, inner) {
  return outcome.fragments.map((fragment, i) => {
    const piece = mesh(fragment, outer, inner);
    piece.position.fromArray(motions.fragments[i].position);
    piece.quaternion.fromArray(motions.fragments[i].rotation);
    return piece;
  });
}

const WRAPS = { repeat: RepeatWrapping, clamp: ClampToEdgeWrapping, mirror: MirroredRepeatWrapping };

/** Makes the materials of the original surface of a body and of its fragments. */
export function materials({ looks, geometry }) {
  const images = (looks?.images ?? []).map(imageOf);
  return (looks?.materials ?? []).map((look) => materialOf(look, images, geometry.colors !== undefined));
}

function materialOf(look, images, vertexColors) {
  const [red, green, blue, opacity] = look.baseColor;
  const blends = look.blending === 'blend' || (look.blending === 'auto' && opacity < 1);
  const material = new MeshStandardMaterial({
    name: look.name,
    color: new Color(red, green, blue),
    opacity,
    metalness: look.metallic,
    roughness: look.roughness,
    emissive: new Color(...look.emission),
    side: look.doubleSided ? DoubleSide : FrontSide,
    transparent: blends,
    depthWrite: !blends,
    alphaTest: look.alphaCutoff ?? 0,
    vertexColors,
  });
  for (const given of look.textures) {
    const texture = textureOf(given, images[given.image]);
    if (given.slot === 'baseColor') material.map = texture;
    if (given.slot === 'metallicRoughness') material.roughnessMap = material.metalnessMap = texture;
    if (given.slot === 'normal') {
      material.normalMap = texture;
      material.normalScale.setScalar(given.strength);
    }
    if (given.slot === 'occlusion') {
      material.aoMap = texture;
      material.aoMapIntensity = given.strength;
    }
    if (given.slot === 'emission') material.emissiveMap = texture;
  }
  return material;
}

function textureOf({ slot, uvSet, wrap, pixelated, offset, rotation, scale }, image) {
  const texture = new Texture();
  texture.name = image.name;
  texture.channel = uvSet;
  [texture.wrapS, texture.wrapT] = wrap.map((name) => WRAPS[name]);
  texture.magFilter = pixelated ? NearestFilter : LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.offset.fromArray(offset);
  texture.repeat.fromArray(scale);
  texture.rotation = rotation;
  // v runs down, as in glTF.
  texture.flipY = false;
  if (slot === 'baseColor' || slot === 'emission') texture.colorSpace = SRGBColorSpace;
  image.pixels?.then((pixels) => {
    texture.image = pixels;
    texture.needsUpdate = true;
  });
  return texture;
}

/** The pixels of an image file come later; outside browsers nothing decodes them. */
function imageOf({ name, type, bytes }) {
  const decodes = typeof createImageBitmap === 'function';
  return { name, pixels: decodes ? createImageBitmap(new Blob([bytes], { type }), { colorSpaceConversion: 'none' }) : undefined };
}
