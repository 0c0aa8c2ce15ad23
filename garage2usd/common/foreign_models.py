"""Reading of models from other programs (USD of any units and axes, GLB) as triangles with surfaces."""
# Over 300 lines: two formats are read into the same data structure.

import hashlib
import io
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError
from garage2usd.common.extras import of_extra

__all__ = ["MODEL_SUFFIXES", "ForeignPart", "ForeignSurface", "model_digest", "read_model"]

MODEL_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz", ".glb")
"""Extensions of model files."""
_MOST_BYTES = 256 * 1024 * 1024
_MOST_TRIANGLES = 400_000
_LARGEST_PX = 1024
_FLIPPED_IN = 0.0
_BYTE = 255.0
_Z_UP_TO_Y_UP = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]])


@dataclass(frozen=True)
class ForeignSurface:
    """Surface of a model's part.

    Attributes
    ----------
    name
        Name of the material in the file.
    colour_rgb
        Linear colour, or the tint of `picture`.
    roughness, metallic, opacity
        From 0 to 1.
    picture
        Base colour texture as PNG; empty for none.
    packed
        Texture of occlusion, roughness and metallic in the channels of a PNG, which replaces these numbers; empty for
        none.
    normals
        Normal map as PNG, in which 8 bits store (n + 1) / 2; empty for none.
    """

    name: str = ""
    colour_rgb: tuple[float, float, float] = (0.5, 0.5, 0.5)
    roughness: float = 0.5
    metallic: float = 0.0
    opacity: float = 1.0
    picture: bytes = b""
    packed: bytes = b""
    normals: bytes = b""


@dataclass(frozen=True, eq=False)
class ForeignPart:
    """A mesh of a model with one surface.

    Attributes
    ----------
    name
        Path of names in the file, separated by ``/``.
    triangles_m
        Corners in metres, Y up; float64, shape (n, 3, 3), counter-clockwise seen from outside.
    st
        Texture coordinates of the corners, V upwards; float64, shape (n, 3, 2).
    surface
        Its surface.
    is_z_up
        Whether Z is up in the file.
    """

    name: str
    triangles_m: NDArray[np.float64]
    st: NDArray[np.float64]
    surface: ForeignSurface
    is_z_up: bool = False


def model_digest(path: Path, *, field: str) -> str:
    """Compute the SHA-256 of a model's file and of all files that it refers to.

    Raises
    ------
    ConfigError
        If a file cannot be read, or a reference cannot be resolved.
    """
    files = [path]
    if path.suffix.lower() != ".glb":
        from pxr import Tf, UsdUtils  # noqa: PLC0415 - few garages have models of one's own

        try:
            layers, assets, missing = UsdUtils.ComputeAllDependencies(str(path))
        except Tf.ErrorException:
            raise ConfigError(field, str(path), "a file of USD that can be read") from None
        if missing:
            raise ConfigError(field, f"{path} without {min(missing)}", "a model whose references lead to files")
        files += [Path(layer.realPath) for layer in layers] + [Path(asset) for asset in assets]
    inner = {file for file in files if "[" not in str(file) and file != path}
    told = [read_bytes(file, field=field, max_bytes=_MOST_BYTES) for file in (path, *sorted(inner))]
    return hashlib.sha256(b"".join(hashlib.sha256(data).digest() for data in told)).hexdigest()


def read_model(path: Path, *, field: str) -> tuple[ForeignPart, ...]:
    """Read the parts of a model.

    Parameters
    ----------
    path
        A file with an extension in `MODEL_SUFFIXES`.
    field
        Name of the setting, for the error.

    Raises
    ------
    ConfigError
        If the file is damaged, has no triangle, or exceeds the limits on a model.
    MissingExtraError
        If the file is a GLB, and the package that reads it is not installed.
    """
    parts = tuple(part for part in (_of_glb if path.suffix.lower() == ".glb" else _of_usd)(path, field) if len(part.st))
    count = sum(len(part.st) for part in parts)
    if not 0 < count <= _MOST_TRIANGLES:
        raise ConfigError(field, f"{path} of {count} triangles", f"models of 1 to {_MOST_TRIANGLES} triangles")
    if not all(np.isfinite(part.triangles_m).all() for part in parts):
        raise ConfigError(field, str(path), "a model whose points are finite")
    return parts


def _of_glb(path: Path, field: str) -> Iterator[ForeignPart]:
    with of_extra("a model as GLB"):
        import trimesh  # noqa: PLC0415 - of an extra
    data = read_bytes(path, field=field, max_bytes=_MOST_BYTES)
    try:
        scene: Any = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)
    except Exception as error:  # noqa: BLE001 - trimesh raises whatever its parsers do
        raise ConfigError(field, str(path), f"a GLB that can be read ({type(error).__name__})") from None
    for node in sorted(scene.graph.nodes_geometry):
        matrix, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces") or not len(mesh.faces):
            continue
        faces = np.asarray(mesh.faces)
        corners = np.asarray(mesh.vertices, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
        uv = getattr(mesh.visual, "uv", None)
        st = np.zeros((len(faces), 3, 2)) if uv is None else np.asarray(uv, dtype=np.float64)[faces]
        triangles = corners[faces]
        if np.linalg.det(matrix[:3, :3]) < _FLIPPED_IN:
            triangles, st = triangles[:, ::-1], st[:, ::-1]
        surface = _of_pbr(getattr(mesh.visual, "material", None), path, field)
        yield ForeignPart(f"{node}/{name}", triangles, st, surface)


def _of_pbr(material: Any, path: Path, field: str) -> ForeignSurface:  # noqa: ANN401 - trimesh tells no types
    if material is None:
        return ForeignSurface()

    def factor(name: str, usual: float) -> float:
        value = getattr(material, name, None)
        return usual if value is None else float(value)

    given = getattr(material, "baseColorFactor", None)
    colour = np.ones(4) if given is None else np.asarray(given, dtype=np.float64) / _BYTE
    picture = getattr(material, "baseColorTexture", None)
    rough, metal = factor("roughnessFactor", 1.0), factor("metallicFactor", 0.0 if picture is not None else 1.0)
    packed, normals, occlusion = (
        None if given is None else _image(given, path, field)
        for given in (
            getattr(material, name, None) for name in ("metallicRoughnessTexture", "normalTexture", "occlusionTexture")
        )
    )
    if packed is not None:
        metal = factor("metallicFactor", 1.0)
        _, green, blue = packed.split()
        packed = _packed(occlusion.getchannel("R") if occlusion else 1.0, _times(green, rough), _times(blue, metal))
    return ForeignSurface(
        str(getattr(material, "name", "") or ""),
        (round(float(colour[0]), 4), round(float(colour[1]), 4), round(float(colour[2]), 4)),
        rough,
        metal,
        round(float(colour[3]), 4) if getattr(material, "alphaMode", None) == "BLEND" else 1.0,
        b"" if picture is None else _png(_image(picture, path, field)),
        b"" if packed is None else _png(packed),
        b"" if normals is None else _png(normals),
    )


def _image(picture: Any, path: Path, field: str) -> Image.Image:  # noqa: ANN401 - a picture, or the bytes of one
    """Convert an image to RGB, and reduce it to the size limit of garages."""
    try:
        image: Image.Image = Image.open(io.BytesIO(picture)) if isinstance(picture, bytes) else picture
        image = image.convert("RGB")
        if max(image.size) > _LARGEST_PX:
            scale = _LARGEST_PX / max(image.size)
            width, height = (max(1, round(side * scale)) for side in image.size)
            image = image.resize((width, height), Image.Resampling.BOX)
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise ConfigError(field, str(path), f"a model with textures that can be read ({error})") from None
    return image


def _png(image: Image.Image) -> bytes:
    stream = io.BytesIO()
    image.save(stream, format="PNG", compress_level=6)
    return stream.getvalue()


def _times(channel: Image.Image, factor: float) -> Image.Image:
    return channel.point([round(value * factor) for value in range(256)])


def _packed(*channels: Image.Image | float) -> Image.Image:
    """Pack three channels into one image, with the size of the largest texture among them."""
    size = max(channel.size for channel in channels if isinstance(channel, Image.Image))
    return Image.merge(
        "RGB",
        [
            channel.resize(size, Image.Resampling.BOX)
            if isinstance(channel, Image.Image)
            else Image.new("L", size, round(_BYTE * channel))
            for channel in channels
        ],
    )


def _of_usd(path: Path, field: str) -> Iterator[ForeignPart]:
    from pxr import Tf, Usd, UsdGeom, UsdShade  # noqa: PLC0415 - few garages have models of one's own

    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException:
        raise ConfigError(field, str(path), "a file of USD that can be read") from None
    is_z_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    turn = _Z_UP_TO_Y_UP if is_z_up else np.eye(3)
    metres = float(stage.GetMetadata(UsdGeom.Tokens.metersPerUnit))
    time = Usd.TimeCode.EarliestTime()
    places = UsdGeom.XformCache(time)
    surfaces: dict[str, ForeignSurface] = {}

    def surface_of(prim: Usd.Prim) -> ForeignSurface:
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        key = str(material.GetPath()) if material else ""
        if not key:
            colours = UsdGeom.Gprim(prim).GetDisplayColorAttr().Get(time) if prim.IsA(UsdGeom.Gprim) else None
            return ForeignSurface(colour_rgb=_rgb(colours[0])) if colours else ForeignSurface()
        if key not in surfaces:
            surfaces[key] = _of_preview(material, path, field)
        return surfaces[key]

    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not _is_drawn(prim, time):
            continue
        mesh = UsdGeom.Mesh(prim)
        points = np.asarray(mesh.GetPointsAttr().Get(time) or (), dtype=np.float64).reshape(-1, 3)
        counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get(time) or (), dtype=np.int64)
        indices = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(time) or (), dtype=np.int64)
        if counts.sum() != len(indices) or (len(indices) and not 0 <= indices.min() <= indices.max() < len(points)):
            raise ConfigError(field, f"{path}, {prim.GetPath()}", "meshes whose faces name their points")
        matrix = np.asarray(places.GetLocalToWorldTransform(prim), dtype=np.float64)
        world = (points @ matrix[:3, :3] + matrix[3, :3]) @ turn.T * metres
        fans, face_of = _fans(counts)
        st = _coordinates(mesh, indices, len(points), time)[fans]
        triangles = world[indices[fans]]
        is_left = mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded
        if (np.linalg.det(matrix[:3, :3]) < _FLIPPED_IN) != is_left:
            triangles, st = triangles[:, ::-1], st[:, ::-1]
        left = np.ones(len(counts), dtype=bool)
        for subset in UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets():
            chosen = np.zeros(len(counts), dtype=bool)
            chosen[np.asarray(subset.GetIndicesAttr().Get(time) or (), dtype=np.int64)] = True
            left &= ~chosen
            kept = chosen[face_of]
            yield ForeignPart(str(subset.GetPath()), triangles[kept], st[kept], surface_of(subset.GetPrim()), is_z_up)
        yield ForeignPart(str(prim.GetPath()), triangles[left[face_of]], st[left[face_of]], surface_of(prim), is_z_up)


def _is_drawn(prim: Any, time: Any) -> bool:  # noqa: ANN401 - of pxr
    from pxr import UsdGeom  # noqa: PLC0415 - as above

    if not prim.IsA(UsdGeom.Mesh) or UsdGeom.Imageable(prim).ComputeVisibility(time) == UsdGeom.Tokens.invisible:
        return False
    return UsdGeom.Imageable(prim).ComputePurpose() in {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}


def _fans(counts: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Triangulate polygons by fans: indices of corners, shape (n, 3), and the polygon of each triangle."""
    starts = np.cumsum(counts) - counts
    each = np.maximum(counts - 2, 0)
    face_of = np.repeat(np.arange(len(counts)), each)
    step = np.arange(each.sum()) - np.repeat(np.cumsum(each) - each, each)
    first = starts[face_of]
    return np.stack([first, first + step + 1, first + step + 2], axis=1), face_of


def _coordinates(mesh: Any, indices: NDArray[np.int64], points: int, time: Any) -> NDArray[np.float64]:  # noqa: ANN401
    """Texture coordinates of each corner, zeros if there are none; shape (corners, 2)."""
    from pxr import UsdGeom  # noqa: PLC0415 - as above

    for primvar in UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithValues():
        if primvar.GetTypeName().scalarType not in {"texCoord2f", "float2"}:
            continue
        values = np.asarray(primvar.ComputeFlattened(time) or (), dtype=np.float64).reshape(-1, 2)
        if len(values) == len(indices):
            return values
        if len(values) == points:
            return values[indices]
    return np.zeros((len(indices), 2))


def _of_preview(material: Any, path: Path, field: str) -> ForeignSurface:  # noqa: ANN401
    from pxr import Ar, UsdShade  # noqa: PLC0415 - as above

    surface, *_ = material.ComputeSurfaceSource()
    name = material.GetPrim().GetName()
    if not surface:
        return ForeignSurface(name)

    def value(key: str, usual: Any) -> Any:  # noqa: ANN401 - of the input
        given = surface.GetInput(key)
        found = given.Get() if given and not given.HasConnectedSource() else None
        return usual if found is None else found

    def texture(key: str) -> tuple[Image.Image, str] | None:
        """Image that an input is connected to, and the name of the reader's output."""
        given = surface.GetInput(key)
        if not given or not given.HasConnectedSource():
            return None
        source = given.GetConnectedSources()[0][0]
        reader = UsdShade.Shader(source.source.GetPrim())
        file = reader.GetInput("file") if reader else None
        asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(file.Get().resolvedPath)) if file and file.Get() else None
        if not asset:
            return None
        with asset:
            return _image(bytes(asset.GetBuffer()), path, field), str(source.sourceName)

    def channel(key: str, number: float) -> Image.Image | float:
        found = texture(key)
        return found[0].getchannel({"g": "G", "b": "B"}.get(found[1], "R")) if found else number

    colour, normals = texture("diffuseColor"), texture("normal")
    rough, metal = float(value("roughness", 0.5)), float(value("metallic", 0.0))
    finish = channel("occlusion", 1.0), channel("roughness", rough), channel("metallic", metal)
    is_packed = any(isinstance(each, Image.Image) for each in finish[1:])
    return ForeignSurface(
        name,
        (1.0, 1.0, 1.0) if colour else _rgb(value("diffuseColor", (0.18, 0.18, 0.18))),
        rough,
        metal,
        float(value("opacity", 1.0)),
        _png(colour[0]) if colour else b"",
        _png(_packed(*finish)) if is_packed else b"",
        _png(normals[0]) if normals else b"",
    )


def _rgb(colour: Any) -> tuple[float, float, float]:  # noqa: ANN401 - three numbers
    red, green, blue = (round(float(channel), 4) for channel in colour)
    return red, green, blue
