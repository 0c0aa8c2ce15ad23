"""Traversal of a composed stage, by UsdGeom's own computations, with each prototype visited once."""
# Over 300 lines: prims, instances and points of instancers are visited by each other.

from dataclasses import dataclass, field, replace
from functools import cache
from typing import NamedTuple

import numpy as np
from pxr import Kind, Usd, UsdGeom

from garage2usd.scenes.prims import (
    NOTHING,
    OBJECT_TAXONOMY,
    SQUARE_TAXONOMY,
    DrawnPart,
    Inherited,
    Matrix,
    PlacedObject,
    PrimType,
    PrimTypes,
    handed_down,
    is_imageable,
    is_visible,
    label_of,
    labels_name,
    purpose_of,
)
from garage2usd.scenes.values import READ_AT, numbers_of

_DRAWN_PURPOSES = frozenset({UsdGeom.Tokens.default_, UsdGeom.Tokens.render})
_POINT_PROTOTYPES = Usd.PrimIsActive & Usd.PrimIsLoaded
"""Traversal predicate for prototypes of point instancers, which may be overs or classes to hide the originals."""
_VISIBILITY, _PURPOSE = UsdGeom.Tokens.visibility, UsdGeom.Tokens.purpose
_TRANSFORM = UsdGeom.Tokens.xformOpOrder
_CLASS, _SQUARE = labels_name(OBJECT_TAXONOMY), labels_name(SQUARE_TAXONOMY)
_IDENTITY = np.eye(4)
_IDENTITY.setflags(write=False)


def placed_objects(
    stage: Usd.Stage, to_world: Matrix, *, with_looks: bool = True, within: Usd.Prim | None = None
) -> list[PlacedObject]:
    """Find every object that a stage draws, in the order of its prims.

    Parameters
    ----------
    stage
        The stage in its current composition; instances and point instancers are followed.
    to_world
        From the stage's space to that of the results, for example `garage2usd.scenes.values.metres_y_up`.
    with_looks
        False to leave out the appearance that parts inherit, where shapes alone are of interest.
    within
        A root prim, to search only this prim and those below it; all prims if left out.

    Raises
    ------
    StageError
        If the type of a label or of a point instancer's number differs from its schema.

    Notes
    -----
    An object is a prim with a label of the taxonomy ``class``, without labelled prims below; a point of an instancer,
    with the nearest label; and without a label, a component, an instance, or a single prim. Transforms, visibility and
    purpose are computed by UsdGeom at `READ_AT`: invisible prims are omitted with their descendants, as are materials,
    guides and proxies. A transform that is not finite counts as the identity.
    """
    walk = _Walk(stage, with_looks=with_looks)
    at = _At("", "", to_world, to_world)
    for prim in [within] if within else stage.GetPseudoRoot().GetChildren():
        walk.visit(prim, at)
    return [found for found in at.found if found.parts]


@dataclass(eq=False, slots=True)
class _At:
    """A prim during the traversal of a stage.

    Attributes
    ----------
    path, twin
        Paths of the prim, from the root of the walk.
    matrix
        From its space to that of the walk's root.
    square, purpose, inherited
        Inherited values.
    stage_matrix
        From the stage's space to that of the walk's root: origin of a reset transform stack.
    holder
        The object that contains the prim, if any.
    within
        From its space to the holder's.
    predicate
        Predicate of the children to visit.
    found
        Objects found so far.
    is_twin_whole
        True if `twin` starts at the stage's root, as for the points of instancers, wherever the walk began.
    """

    path: str
    twin: str
    matrix: Matrix
    stage_matrix: Matrix
    square: str = ""
    purpose: str = UsdGeom.Tokens.default_
    inherited: Inherited = NOTHING
    holder: PlacedObject | None = None
    within: Matrix = field(default_factory=lambda: _IDENTITY)
    predicate: "Usd._PrimFlagsPredicate" = Usd.PrimDefaultPredicate
    found: list[PlacedObject] = field(default_factory=list)
    is_twin_whole: bool = False


class _Prototype(NamedTuple):
    """Contents of a prototype in its own space: objects with paths from its root, and parts outside all objects."""

    objects: list[PlacedObject]
    parts: tuple[DrawnPart, ...]


class _Walk:
    """Traversal of prims that visits those of each prototype once."""

    def __init__(self, stage: Usd.Stage, *, with_looks: bool) -> None:
        self._stage = stage
        self._with_looks = with_looks
        self._places = UsdGeom.XformCache(READ_AT)
        self._prototypes: dict[object, _Prototype] = {}
        self._types = PrimTypes()
        self._has_labels = cache(_has_labels)
        self._resets = cache(_resets)

    def visit(self, prim: Usd.Prim, above: _At) -> None:
        """Find objects at and below a prim; `above` is its parent."""
        # materials are nearly half of a garage's prims, and UsdImaging does not draw below them either
        kind = self._types.of(prim)
        if kind.is_material:
            return
        # most prims author few properties, and reading a property that is not authored is slow
        said = prim.GetAuthoredPropertyNames()
        if _VISIBILITY in said and not is_visible(prim):
            return
        matrix, within, holder = above.matrix, above.within, above.holder
        if _TRANSFORM in said:
            place, is_reset = self._place(prim)
            matrix = place @ (above.stage_matrix if is_reset else above.matrix)
            if holder is not None:
                within = matrix @ np.linalg.pinv(holder.matrix) if is_reset else place @ above.within
        name = f"/{prim.GetName()}"
        at = _At(
            above.path + name,
            above.twin + name,
            matrix,
            above.stage_matrix,
            (label_of(prim, SQUARE_TAXONOMY) if _SQUARE in said else "") or above.square,
            purpose_of(prim, above.purpose) if _PURPOSE in said else above.purpose,
            handed_down(prim, said, above.inherited) if self._hands_down(prim, kind) else above.inherited,
            holder,
            within,
            above.predicate,
            above.found,
            above.is_twin_whole,
        )
        label = label_of(prim) if _CLASS in said else ""
        if kind.is_instancer:
            self._visit_points(prim, at, label)
            return
        if label or (holder is None and self._is_whole(prim)):
            at.holder = PlacedObject(at.path, at.twin, label, at.square, at.matrix, is_twin_whole=at.is_twin_whole)
            at.within = _IDENTITY
            at.found.append(at.holder)
        self._visit_contents(prim, kind, at)

    def _visit_contents(self, prim: Usd.Prim, kind: PrimType, at: _At) -> None:
        """Find the drawn parts of a prim, and the objects below it."""
        if kind.draws(prim) and at.purpose in _DRAWN_PURPOSES and at.holder is not None:
            source = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
            _append(at.holder, [DrawnPart(source, at.path.removeprefix(at.holder.path), at.within, at.inherited)])
        is_instance = prim.IsInstance()
        if is_instance and not self._resets(prototype := prim.GetPrototype()):
            self._take(self._prototype(prototype, at), at)
            return
        is_proxied = is_instance or prim.IsInstanceProxy()
        below = Usd.TraverseInstanceProxies(at.predicate) if is_proxied else at.predicate
        for child in prim.GetFilteredChildren(below):
            self.visit(child, at)

    def _visit_points(self, prim: Usd.Prim, at: _At, label: str) -> None:
        """Find the objects of a point instancer."""
        instancer = UsdGeom.PointInstancer(prim)
        roots = [self._stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
        indices = numbers_of(instancer.GetProtoIndicesAttr(), np.int64)
        places = instancer.ComputeInstanceTransformsAtTime(
            READ_AT, READ_AT, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        if len(places) != len(indices):
            return
        mask = instancer.ComputeMaskAtTime(READ_AT) or [True] * len(indices)
        above = at.holder.label if at.holder else ""
        for point, (index, place, is_shown) in enumerate(zip(indices.tolist(), places, mask, strict=False)):
            if is_shown and 0 <= index < len(roots) and roots[index]:
                root, path = roots[index], f"{at.path}[{point}]"
                matrix = np.array(place) @ at.matrix
                is_whole = at.is_twin_whole or not root.IsInPrototype()
                named = label_of(root) or label or above
                holder = PlacedObject(path, _twin(root), named, at.square, matrix, is_twin_whole=is_whole)
                at.found.append(holder)
                here = replace(
                    at,
                    path=path,
                    twin=holder.twin,
                    matrix=matrix,
                    holder=holder,
                    within=_IDENTITY,
                    is_twin_whole=is_whole,
                )
                self._take(self._point_prototype(root, at.inherited if root.IsInPrototype() else NOTHING), here)

    def _prototype(self, prototype: Usd.Prim, at: _At) -> _Prototype:
        """Return the contents of an instance prototype, for an instance with the inherited values of `at`."""
        inherited = at.inherited.by_instance(at.path)
        key = prototype, at.purpose, inherited, at.holder is not None
        if key not in self._prototypes:
            inside = _inside(at.purpose, inherited, is_held=at.holder is not None)
            for child in prototype.GetChildren():
                self.visit(child, inside)
            self._prototypes[key] = _held(inside)
        return self._prototypes[key]

    def _point_prototype(self, root: Usd.Prim, inherited: Inherited) -> _Prototype:
        """Return the contents of a point instancer's prototype; its own transform is part of the points' transforms."""
        key = root, inherited
        if key not in self._prototypes:
            self._prototypes[key] = _Prototype([], ())  # stops the recursion if a prototype contains itself
            purpose = UsdGeom.Imageable(root).ComputePurpose() if is_imageable(root) else UsdGeom.Tokens.default_
            inside = _inside(str(purpose), inherited, is_held=True)
            if is_visible(root) and root.IsA(UsdGeom.PointInstancer):
                self._visit_points(root, inside, "")
            elif is_visible(root):
                self._visit_contents(root, self._types.of(root), replace(inside, predicate=_POINT_PROTOTYPES))
            self._prototypes[key] = _held(inside)
        return self._prototypes[key]

    @staticmethod
    def _take(prototype: _Prototype, at: _At) -> None:
        """Add the contents of a prototype to the objects found at an instance."""
        above = at.holder.label if at.holder else ""
        for inner in prototype.objects:
            at.found.append(
                PlacedObject(
                    at.path + inner.path,
                    inner.twin if inner.is_twin_whole else at.twin + inner.twin,
                    inner.label or above,
                    inner.square or at.square,
                    inner.matrix @ at.matrix,
                    inner.parts,
                    at.is_twin_whole or inner.is_twin_whole,
                )
            )
        if at.holder is None:
            return
        if at.holder.path == at.path and not at.holder.parts:
            at.holder.parts = prototype.parts
            return
        after = at.path.removeprefix(at.holder.path)
        _append(
            at.holder,
            [part._replace(path=after + part.path, matrix=part.matrix @ at.within) for part in prototype.parts],
        )

    def _place(self, prim: Usd.Prim) -> tuple[Matrix, bool]:
        """Return the matrix from a prim's space to its parent's, or to the stage's if its transform stack is reset."""
        matrix, is_reset = self._places.GetLocalTransformation(prim)
        place = np.array(matrix)
        return (place if np.isfinite(place).all() else _IDENTITY), is_reset

    def _is_whole(self, prim: Usd.Prim) -> bool:
        """Return True if a prim without a label counts as an object."""
        if prim.IsInstance():
            return not self._has_labels(prim.GetPrototype())
        if Kind.Registry.IsA(Usd.ModelAPI(prim).GetKind(), Kind.Tokens.component):
            return not _has_labels(prim)
        return self._types.of(prim).draws(prim)

    def _hands_down(self, prim: Usd.Prim, kind: PrimType) -> bool:
        """Return True if an instance that inherits is possible at or below a prim; most drawn prims have none."""
        return self._with_looks and (not kind.is_drawn or prim.IsInstance() or bool(prim.GetAllChildrenNames()))


def _inside(purpose: str, inherited: Inherited, *, is_held: bool) -> _At:
    """Return the start of a prototype's traversal; its contents belong to the object that contains the instance."""
    holder = PlacedObject("", "", "", "", _IDENTITY) if is_held else None
    return _At("", "", _IDENTITY, _IDENTITY, purpose=purpose, inherited=inherited, holder=holder)


def _held(inside: _At) -> _Prototype:
    objects = [found for found in inside.found if found.parts]
    return _Prototype(objects, tuple(inside.holder.parts) if inside.holder else ())


def _twin(root: Usd.Prim) -> str:
    """Return the path of a point instancer's prototype, relative to the instance prototype that contains it, if any."""
    path = root.GetPath()
    return str(path).removeprefix(str(path.GetPrefixes()[0])) if root.IsInPrototype() else str(path)


def _append(holder: PlacedObject, parts: list[DrawnPart]) -> None:
    if not isinstance(holder.parts, list):
        holder.parts = list(holder.parts)
    holder.parts += parts


def _has_labels(root: Usd.Prim) -> bool:
    return any(label_of(prim) for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies()))


def _resets(prototype: Usd.Prim) -> bool:
    """Return True if a prim in a prototype resets its transform stack, so that its place differs between instances."""
    below = Usd.PrimRange(prototype, Usd.TraverseInstanceProxies())
    return any(UsdGeom.Xformable(prim).GetResetXformStack() for prim in below)
