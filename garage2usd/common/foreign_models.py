"""Reading of models from other programs (USD of any units and axes, GLB) as triangles with surfaces."""
# Over 300 lines: two formats are read into the same data structure.

import hashlib
import io
import logging
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.common.extras import of_extra
from garage2usd.common.glb_container import read_glb

__all__ = ["MODEL_SUFFIXES", "ForeignPart", "ForeignSurface", "model_digest", "read_model"]

MODEL_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz", ".glb")
"""Extensions of model files."""
_MOST_BYTES = 256 * 1024 * 1024
_MOST_TRIANGLES = 400_000
_LARGEST_PX = 1024
_FLIPPED_IN = 0.0
_BYTE = 255.0
_WORD_TO_BYTE = 257
_COORDINATES = ("texCoord2f", "float2", "texCoord2d", "double2", "texCoord2h", "half2")
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
    if path.suffix.lower() == ".glb":
        container = read_glb(path, field=field, max_bytes=_MOST_BYTES)
        told = [container.data, *(data for _, data in sorted(container.files.items()))]
    else:
        from pxr import Tf, UsdUtils  # noqa: PLC0415 - few garages have models of one's own

        quiet = UsdUtils.CoalescingDiagnosticDelegate()
        try:
            layers, assets, missing = UsdUtils.ComputeAllDependencies(str(path))
        except (Tf.ErrorException, UnicodeDecodeError):
            raise ConfigError(field, str(path), "a file of USD that can be read") from None
        finally:
            del quiet
        # other files that are missing count where they are read
        missing = [name for name in missing if name.lower().endswith(MODEL_SUFFIXES)]
        if missing:
            raise ConfigError(field, f"{path} without {min(missing)}", "a model whose references lead to files")
        files = [Path(layer.realPath) for layer in layers] + [Path(asset) for asset in assets]
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
    is_glb = path.suffix.lower() == ".glb"
    try:
        parts = tuple(part for part in (_of_glb if is_glb else _of_usd_quietly)(path, field) if len(part.st))
    except Garage2UsdError:
        raise
    except Exception:  # noqa: BLE001 - whatever the tables of a file of others hold
        kind = "a GLB whose tables are whole" if is_glb else "a file of USD whose values are those of its schemas"
        raise ConfigError(field, str(path), kind) from None
    count = sum(len(part.st) for part in parts)
    if not 0 < count <= _MOST_TRIANGLES:
        raise ConfigError(field, f"{path} of {count} triangles", f"models of 1 to {_MOST_TRIANGLES} triangles")
    if not all(np.isfinite(part.triangles_m).all() for part in parts):
        raise ConfigError(field, str(path), "a model whose points are finite")
    return parts


def _of_glb(path: Path, field: str) -> Iterator[ForeignPart]:
    with of_extra("a model as GLB"):
        import trimesh  # noqa: PLC0415 - of an extra
    logging.getLogger("trimesh").addHandler(logging.NullHandler())
    container = read_glb(path, field=field, max_bytes=_MOST_BYTES)
    scene: Any = trimesh.load_scene(
        io.BytesIO(container.data), file_type="glb", process=False, resolver=dict(container.files)
    )
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
    title = str(getattr(material, "name", "") or "")

    def image(name: str) -> Image.Image | None:
        given = getattr(material, name, None)
        return None if given is None else _image(given, f"{path}, {name} of the material '{title}'", field)

    packed, normals, occlusion = map(image, ("metallicRoughnessTexture", "normalTexture", "occlusionTexture"))
    coloured = image("baseColorTexture")
    rough, metal = factor("roughnessFactor", 1.0), factor("metallicFactor", 0.0 if coloured else 1.0)
    if packed is not None:
        metal = factor("metallicFactor", 1.0)
        _, green, blue = packed.split()
        packed = _packed(occlusion.getchannel("R") if occlusion else 1.0, _times(green, rough), _times(blue, metal))
    return ForeignSurface(
        title,
        (round(float(colour[0]), 4), round(float(colour[1]), 4), round(float(colour[2]), 4)),
        rough,
        metal,
        round(float(colour[3]), 4) if getattr(material, "alphaMode", None) == "BLEND" else 1.0,
        b"" if coloured is None else _png(coloured),
        b"" if packed is None else _png(packed),
        b"" if normals is None else _png(normals),
    )


def _image(picture: Any, place: str, field: str) -> Image.Image:  # noqa: ANN401 - a picture, or the bytes of one
    """Convert an image to RGB, and reduce it to the size limit of garages."""
    try:
        image: Image.Image = Image.open(io.BytesIO(picture)) if isinstance(picture, bytes) else picture
        if image.mode.startswith("I"):  # 16 bits of grey, which `convert` would cut off at 255
            image = Image.fromarray((np.asarray(image) // _WORD_TO_BYTE).clip(0, 255).astype(np.uint8))
        image = image.convert("RGB")
        if max(image.size) > _LARGEST_PX:
            scale = _LARGEST_PX / max(image.size)
            width, height = (max(1, round(side * scale)) for side in image.size)
            image = image.resize((width, height), Image.Resampling.BOX)
    except UnidentifiedImageError:
        raise ConfigError(field, place, "a picture of a known format, such as PNG or JPEG") from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise ConfigError(field, place, f"a picture that can be read ({error})") from None
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


def _of_usd_quietly(path: Path, field: str) -> list[ForeignPart]:
    """Read a model of USD; USD's own warnings about it are no lines of a command."""
    from pxr import UsdUtils  # noqa: PLC0415 - few garages have models of one's own

    quiet = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        return list(_of_usd(path, field))
    finally:
        del quiet


def _of_usd(path: Path, field: str) -> Iterator[ForeignPart]:
    from pxr import Tf, Usd, UsdGeom, UsdShade  # noqa: PLC0415 - few garages have models of one's own

    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException:
        raise ConfigError(field, str(path), "a file of USD that can be read") from None
    is_z_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    turn = _Z_UP_TO_Y_UP if is_z_up else np.eye(3)
    metres = float(stage.GetMetadata(UsdGeom.Tokens.metersPerUnit))
    if not 0 < metres < np.inf:
        raise ConfigError(field, f"{path} with metersPerUnit = {metres:g}", "metres per unit above 0")
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

    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()  # beside the default prim there may be a ground or a studio
    for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies()):
        if not _is_drawn(prim, time):
            continue
        mesh = UsdGeom.Mesh(prim)
        points, counts, indices = _faces(mesh, time, path, field)
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
            chosen = _chosen(subset, len(counts), time, path, field)
            left &= ~chosen
            kept = chosen[face_of]
            yield ForeignPart(str(subset.GetPath()), triangles[kept], st[kept], surface_of(subset.GetPrim()), is_z_up)
        yield ForeignPart(str(prim.GetPath()), triangles[left[face_of]], st[left[face_of]], surface_of(prim), is_z_up)


def _faces(
    mesh: Any,  # noqa: ANN401 - of pxr
    time: Any,  # noqa: ANN401
    path: Path,
    field: str,
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Points of a mesh, the corners of each face, and the point of each corner."""
    points = np.asarray(mesh.GetPointsAttr().Get(time) or (), dtype=np.float64).reshape(-1, 3)
    counts, indices = (
        np.asarray(attribute.Get(time) or (), dtype=np.int64)
        for attribute in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
    )
    is_whole = (counts >= 0).all() and counts.sum() == len(indices)
    if not is_whole or (len(indices) and not 0 <= indices.min() <= indices.max() < len(points)):
        raise ConfigError(field, f"{path}, {mesh.GetPath()}", "meshes whose faces name their points")
    return points, counts, indices


def _chosen(subset: Any, count: int, time: Any, path: Path, field: str) -> NDArray[np.bool_]:  # noqa: ANN401 - of pxr
    """True for each of `count` faces that belongs to a subset."""
    faces = np.asarray(subset.GetIndicesAttr().Get(time) or (), dtype=np.int64)
    wrong = faces[(faces < 0) | (faces >= count)].tolist()
    if wrong:
        raise ConfigError(field, f"{path}, {subset.GetPath()} with face {wrong[0]}", f"faces 0 to {count - 1}")
    chosen = np.zeros(count, dtype=bool)
    chosen[faces] = True
    return chosen


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

    given = UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithValues()
    for primvar in sorted(given, key=lambda primvar: primvar.GetPrimvarName() != "st"):
        if str(primvar.GetTypeName().scalarType) not in _COORDINATES:  # whose hash is not that of its text
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
        named = file.Get() if file else None
        if not named or not named.path or "<UDIM>" in named.path:
            return None
        asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(named.resolvedPath))
        if not asset:
            raise ConfigError(field, f"{path} without {named.path}", "a model whose references lead to files")
        with asset:
            return _image(bytes(asset.GetBuffer()), f"{path}, {named.path}", field), str(source.sourceName)

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
