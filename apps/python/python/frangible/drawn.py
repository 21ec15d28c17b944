"""Meshes to draw, with the looks of the file that was baked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats, Ints, rows

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Drawn:
    """A mesh to draw: the outer surface as its author drew it, and crack faces.

    Vertices are split where normals or texture coordinates differ. For physics use the closed mesh of the body or fragment instead.

    Attributes:
        vertices: (n, 3) float64 vertices, m, in the body's frame.
        normals: (n, 3) float32 unit normals.
        uvs: (n, 2) float32 texture coordinates for each set of the file, with v down; on crack faces the first set is a box projection in metres,
            the others are zero.
        colors: (n, 4) float32 linear red, green, blue and opacity, white on crack faces; ``None`` if the file has no vertex colours.
        faces: (m, 3) int32 triangles, counter-clockwise seen from outside.
        is_fracture_face: (m,) bool: True for each crack face.
        material: (m,) int32 index into ``Looks.materials``; -1 on crack faces, and everywhere if the file has no materials.
    """

    vertices: Floats
    normals: Singles
    uvs: list[Singles]
    colors: Singles | None
    faces: Ints
    is_fracture_face: NDArray[np.bool_]
    material: Ints


@dataclass(frozen=True)
class TextureUse:
    """A texture of a material; ``offset``, ``rotation`` and ``scale`` are those of ``KHR_texture_transform``.

    Attributes:
        slot: ``"base_color"``, ``"metallic_roughness"``, ``"normal"``, ``"occlusion"`` or ``"emission"``.
        image: Index into ``Looks.images``.
        uv_set: Index into ``Drawn.uvs``.
        wrap: ``"repeat"``, ``"clamp"`` or ``"mirror"``, along u and v.
        pixelated: True if texels keep hard edges.
        strength: Scale of normals, or strength of occlusion.
        offset: Shift of the coordinates' origin.
        rotation: Counter-clockwise, rad.
        scale: Along u and v.
    """

    slot: str
    image: int
    uv_set: int
    wrap: tuple[str, str]
    pixelated: bool
    strength: float
    offset: tuple[float, float]
    rotation: float
    scale: tuple[float, float]


@dataclass(frozen=True)
class Look:
    """A material of the file, in the metallic-roughness model of glTF 2.0.

    Attributes:
        name: Its name, which may be empty.
        base_color: Linear red, green, blue and opacity.
        metallic: 0 (dielectric) to 1 (metal).
        roughness: 0 (mirror) to 1 (matt).
        emission: Light that it emits: linear red, green and blue.
        double_sided: True if triangles are seen from behind, too.
        blending: ``"auto"`` (blends if the base colour has an opacity below 1), ``"blend"`` or ``"mask"``.
        alpha_cutoff: Opacity below which points are not drawn, with ``"mask"``.
        textures: Its textures, at most one for each slot.
    """

    name: str
    base_color: tuple[float, float, float, float]
    metallic: float
    roughness: float
    emission: tuple[float, float, float]
    double_sided: bool
    blending: str
    alpha_cutoff: float | None
    textures: tuple[TextureUse, ...]


@dataclass(frozen=True)
class Image:
    """A file of an image: its name, its media type (``"image/png"`` or ``"image/jpeg"``) and its bytes."""

    name: str
    type: str
    data: bytes


@dataclass(frozen=True)
class Looks:
    """Looks of the mesh that was baked: the name of the mesh, its materials and the images of their textures."""

    name: str
    materials: tuple[Look, ...]
    images: tuple[Image, ...]


def drawn_of(given: dict[str, Any]) -> Drawn:
    """Returns the mesh of flat arrays."""
    faces = given["faces"].reshape(-1, 3).astype(np.int32)
    colors = given["colors"]
    return Drawn(
        vertices=rows(given["vertices"], 3),
        normals=given["normals"].reshape(-1, 3),
        uvs=[uvs.reshape(-1, 2) for uvs in given["uvs"]],
        colors=None if colors is None else colors.reshape(-1, 4),
        faces=faces,
        is_fracture_face=np.arange(len(faces)) >= given["outer_faces"],
        material=given["material"],
    )


def looks_of(given: dict[str, Any]) -> Looks:
    """Returns the looks of plain values."""

    def look(values: dict[str, Any]) -> Look:
        textures = (TextureUse(**{key: _fixed(value) for key, value in texture.items()}) for texture in values["textures"])
        plain = {key: _fixed(value) for key, value in values.items() if key != "textures"}
        return Look(**plain, textures=tuple(textures))

    images = (Image(*image) for image in given["images"])
    return Looks(given["name"], tuple(look(values) for values in given["materials"]), tuple(images))


def _fixed(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
