"""Models of other programs, as USD of any units and axes or as glTF: triangles with plain surfaces."""
# Over 300 lines: two formats are read into the same parts, with the same limits and refusals.

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pxr import Tf, Usd, UsdGeom, UsdLux, UsdUtils

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError, Garage2UsdError, StageError
from garage2usd.scenes.gltf_file import GLTF_SUFFIXES, GltfFile
from garage2usd.scenes.gltf_meshes import GltfMeshes
from garage2usd.scenes.gltf_surfaces import GltfSurfaces
from garage2usd.scenes.looks import MeshLooks
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles
from garage2usd.scenes.pictures import Pictures
from garage2usd.scenes.plain_surfaces import PlainSurface, plain_surface_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.skins import pose_skins
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.textures import LEFT_OUT, MISSING_PICTURE, Layout
from garage2usd.scenes.values import READ_AT, metres_per_unit, metres_y_up, numbers_of
from garage2usd.scenes.walk import placed_objects

_MOST_BYTES = 256 * 1024 * 1024
_MOST_TRIANGLES = 400_000
_MOST_COLOURS = 32
"""Greatest number of parts that a mesh with a colour at each point is divided into."""
_SAME_COLOUR = 1 / 512
_BYTE = 255


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
        Coordinates of all the surface's pictures at the corners, V upwards; float64, shape (n, 3, 2).
    normals
        Unit normals at the corners; float64, shape (n, 3, 3); None if the file gives none.
    surface
        Its surface.
    double_sided
        True if the back is visible.
    is_z_up
        True if Z is up in the file.
    """

    name: str
    triangles_m: NDArray[np.float64]
    st: NDArray[np.float64]
    normals: NDArray[np.float64] | None
    surface: PlainSurface
    double_sided: bool = False
    is_z_up: bool = False


class ForeignModel(NamedTuple):
    """A model of another program.

    Attributes
    ----------
    parts
        Its meshes.
    remarks
        Lines on the parts and properties that are ignored or changed, one for each kind.
    """

    parts: tuple[ForeignPart, ...]
    remarks: tuple[str, ...]


class _Drawn(NamedTuple):
    """Triangles of a model in metres with Y up, and their surface."""

    name: str
    triangles: Triangles
    look: SurfaceLook
    is_z_up: bool = False


def model_digest(path: Path, *, field: str) -> str:
    """Compute the SHA-256 of a model's file and of all files that it refers to.

    Raises
    ------
    ConfigError
        If a file cannot be read, or a reference cannot be resolved.
    """
    if path.suffix.lower() in GLTF_SUFFIXES:
        with _whole(path, field):
            told = GltfFile(path, field=field, max_bytes=_MOST_BYTES).told
    else:
        with _Quiet():
            try:
                layers, assets, missing = UsdUtils.ComputeAllDependencies(str(path))
            except (Tf.ErrorException, UnicodeDecodeError):
                raise ConfigError(field, str(path), "a file of USD that can be read") from None
        # other missing files count only when they are read
        missing = [name for name in missing if Path(name).suffix.lower().startswith(".usd")]
        if missing:
            raise ConfigError(field, f"{path} without {min(missing)}", "a model whose references lead to files")
        files = [Path(layer.realPath) for layer in layers] + [Path(asset) for asset in assets]
        inner = {file for file in files if "[" not in str(file) and file != path}
        told = [read_bytes(file, field=field, max_bytes=_MOST_BYTES) for file in (path, *sorted(inner))]
    return hashlib.sha256(b"".join(hashlib.sha256(data).digest() for data in told)).hexdigest()


def read_model(path: Path, *, field: str) -> ForeignModel:
    """Read a model.

    Parameters
    ----------
    path
        A file of USD or glTF.
    field
        Name of the setting, for the error.

    Raises
    ------
    ConfigError
        If the file is damaged, lacks a picture, has no triangle, or exceeds the limits on a model.
    MissingExtraError
        If the file is compressed, and the package that decompresses it is not installed.
    """
    is_gltf = path.suffix.lower() in GLTF_SUFFIXES
    remarks, pictures = Remarks(), Pictures()
    with _whole(path, field), np.errstate(all="ignore"):
        drawn, count = list[_Drawn](), 0
        for mesh in (_of_gltf if is_gltf else _of_usd)(path, field, remarks, pictures):
            drawn.append(mesh)
            count += len(mesh.triangles.indices)
            if count > _MOST_TRIANGLES:
                raise ConfigError(field, f"{path} of {count} triangles or more", f"at most {_MOST_TRIANGLES} triangles")
        _check_pictures(path, field, remarks)
        plain: dict[tuple[SurfaceLook, str], tuple[PlainSurface, Layout | None]] = {}
        parts: list[ForeignPart] = []
        for each in drawn:
            key = each.look, each.look.name  # looks that differ in name only compare equal
            if key not in plain:
                plain[key] = plain_surface_of(each.look, pictures, remarks)
            parts += _parts(each, *plain[key], remarks)
    if not parts:
        raise ConfigError(field, f"{path} of 0 triangles", f"models of 1 to {_MOST_TRIANGLES} triangles")
    if not all(np.isfinite(part.triangles_m).all() for part in parts):
        raise ConfigError(field, str(path), "a model whose points are finite")
    return ForeignModel(tuple(parts), tuple(remarks.lines()))


@contextmanager
def _whole(path: Path, field: str) -> Iterator[None]:
    """Context that converts any failure on an invalid file to one error."""
    try:
        yield
    except StageError as error:
        raise ConfigError(field, f"{path}, {error.reason}", "values of the types of their schemas") from None
    except Garage2UsdError:
        raise
    except Exception:  # noqa: BLE001 - as libraries fail in every way
        is_gltf = path.suffix.lower() in GLTF_SUFFIXES
        kind = (
            "a file whose tables are those of glTF 2.0" if is_gltf else "a file whose values are those of USD's schemas"
        )
        raise ConfigError(field, str(path), kind) from None


def _check_pictures(path: Path, field: str, remarks: Remarks) -> None:
    """Refuse a model that lacks a picture, or whose pictures cannot be read."""
    for _, place in remarks.ending(MISSING_PICTURE):
        raise ConfigError(field, f"{path} without {place}", "a model whose references lead to files")
    for reason, place in remarks.ending(LEFT_OUT):
        shown = place if place.startswith(str(path)) else f"{path}, {place}"
        raise ConfigError(field, shown, f"a picture of a known format, such as PNG or JPEG, instead of {reason}")


def _of_gltf(path: Path, field: str, remarks: Remarks, pictures: Pictures) -> Iterator[_Drawn]:
    file = GltfFile(path, field=field, max_bytes=_MOST_BYTES)
    file.add_remarks(remarks)
    meshes, surfaces = GltfMeshes(file, remarks), GltfSurfaces(file, pictures, remarks)
    for mesh in meshes.drawn():
        look, double_sided = surfaces.surface(mesh.primitive)
        triangles = meshes.triangles(mesh, look, double_sided=double_sided)
        if triangles is not None:
            placed = triangles if mesh.matrix is None else triangles.moved(mesh.matrix)
            yield _Drawn(mesh.name, placed, look)


def _of_usd(path: Path, field: str, remarks: Remarks, pictures: Pictures) -> Iterator[_Drawn]:
    with _Quiet():
        try:
            stage = Usd.Stage.Open(str(path))
        except Tf.ErrorException:
            raise ConfigError(field, str(path), "a file of USD that can be read") from None
        metres = metres_per_unit(stage)
        if not 0 < metres < np.inf:
            raise ConfigError(field, f"{path} with metersPerUnit = {metres:g}", "metres per unit above 0")
        is_z_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
        pose_skins(stage)
        looks = MeshLooks(is_apart_by_name=True, remarks=remarks, pictures=pictures)
        root = _root(stage, remarks)
        if any(len(layer.ListAllTimeSamples()) > 1 for layer in stage.GetUsedLayers()):
            remarks.add("animations are read at rest or at their first frame", path.name)
        for placed in placed_objects(stage, metres_y_up(stage), within=root):
            for part in placed.parts:
                name, kind = placed.path + part.path, part.prim.GetTypeName()
                if part.prim.HasAPI(UsdLux.LightAPI):
                    remarks.add("lights are not used", name)
                elif kind not in DRAWN_TYPES:
                    remarks.add(f"prims of the type {kind} are left out", name)
                else:
                    if kind == "Mesh":
                        _check(UsdGeom.Mesh(part.prim), path, field, remarks)
                    matrix = part.matrix @ placed.matrix
                    for mesh, surface, subset in looks.of_part(placed, part):
                        whole = f"{name}/{subset}" if subset else name
                        triangles = looks.meshes.values[mesh].moved(matrix)
                        yield _Drawn(whole, triangles, looks.surfaces.values[surface], is_z_up)


def _root(stage: Usd.Stage, remarks: Remarks) -> Usd.Prim | None:
    """Return the root prim that holds the default prim; other root prims may be a ground or a studio."""
    default = stage.GetDefaultPrim()
    if not default:
        return None
    root = stage.GetPrimAtPath(default.GetPath().GetPrefixes()[0])
    for other in stage.GetPseudoRoot().GetChildren():
        below = Usd.PrimRange(other, Usd.TraverseInstanceProxies())
        if other != root and any(prim.IsA(UsdGeom.Gprim) for prim in below):
            remarks.add("what stands beside the default prim is left out", other.GetPath())
    return root


def _check(mesh: UsdGeom.Mesh, path: Path, field: str, remarks: Remarks) -> None:
    """Refuse a mesh whose faces name points that it lacks."""
    counts, corners = (
        numbers_of(given, np.int64) for given in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
    )
    points = len(numbers_of(mesh.GetPointsAttr(), np.float32, width=3))
    is_whole = (counts >= 0).all() and counts.sum() == len(corners)
    if not is_whole or (len(corners) and not 0 <= corners.min() <= corners.max() < points):
        raise ConfigError(field, f"{path}, {mesh.GetPath()}", "meshes whose faces name their points")
    scheme = mesh.GetSubdivisionSchemeAttr()
    if scheme.HasAuthoredValue() and scheme.Get(READ_AT) != UsdGeom.Tokens.none:
        remarks.add("subdivision surfaces are read as their meshes, not subdivided", mesh.GetPath())


def _parts(drawn: _Drawn, surface: PlainSurface, layout: Layout | None, remarks: Remarks) -> Iterator[ForeignPart]:
    """Convert triangles to parts; triangles with vertex colours become one part for each colour."""
    mesh = drawn.triangles
    corners = mesh.indices
    st = np.zeros((len(corners), 3, 2))
    if layout is not None:
        number = drawn.look.sets.index(layout.coordinates)
        st = layout.placed(mesh.coordinates[:, number].astype(np.float64))[corners]
    normals = mesh.normals.astype(np.float64)[corners] if mesh.has_normals else None
    triangles_m = mesh.positions_m.astype(np.float64)[corners]

    def part(surface: PlainSurface, kept: NDArray[np.bool_] | slice) -> ForeignPart:
        own = None if normals is None else normals[kept]
        return ForeignPart(drawn.name, triangles_m[kept], st[kept], own, surface, mesh.double_sided, drawn.is_z_up)

    if mesh.colours is None:
        yield part(surface, slice(None))
        return
    shades = mesh.colours.astype(np.float64)[corners]
    colours, which = _palette(shades.mean(axis=1))
    if np.abs(colours[which][:, None] - shades).max() > _SAME_COLOUR:
        remarks.add(f"colours by point are carried as {len(colours)} colours by face", drawn.name)
    tint = np.array(surface.colour_rgb) if drawn.look.colour_texture else np.ones(3)
    for number, colour in enumerate(colours):
        red, green, blue = np.round(colour * tint, 6).tolist()
        yield part(replace(surface, colour_rgb=(red, green, blue)), which == number)


def _palette(colours: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return at most `_MOST_COLOURS` colours, shape (k, 3), and the number of each given colour's, shape (n,)."""
    found, which = np.unique(np.round(colours, 6), axis=0, return_inverse=True)
    if len(found) <= _MOST_COLOURS:
        return found, which.ravel()
    # by median cut, in steps that look alike
    shown = np.rint(np.sqrt(colours.clip(0, 1)) * _BYTE).astype(np.uint8)[None]
    quantised = Image.fromarray(shown).quantize(_MOST_COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    numbers, which = np.unique(np.asarray(quantised)[0], return_inverse=True)
    means = np.stack([colours[which.ravel() == number].mean(axis=0) for number in range(len(numbers))])
    return means, which.ravel()


class _Quiet:
    """Context in which USD's own warnings about a model are not printed by commands."""

    def __enter__(self) -> None:
        self._delegate: object = UsdUtils.CoalescingDiagnosticDelegate()

    def __exit__(self, *_: object) -> None:
        self._delegate = None
