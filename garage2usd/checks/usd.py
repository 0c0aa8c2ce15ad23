"""Rules of USD: findings of the USD validators, and faults that the validators miss."""

from collections.abc import Iterator
from pathlib import Path, PureWindowsPath

from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.profiles import Profile, Severity
from garage2usd.reading.files import usd_text
from garage2usd.scenes.prims import LABELS, LABELS_SCHEMA, labels_of
from garage2usd.scenes.values import metres_per_unit

BOOK = RuleBook()
_UNRESOLVED = "UnresolvableDependency"
_APPROXIMATIONS = {
    "none",
    "boundingCube",
    "boundingSphere",
    "convexHull",
    "convexDecomposition",
    "meshSimplification",
}


def _prims(stage: Usd.Stage | None) -> Iterator[Usd.Prim]:
    """Yield every prim of a stage, with each prototype's prims once in place of those of its instances."""
    if stage is None:
        return
    yield from stage.Traverse()
    for prototype in stage.GetPrototypes():
        for prim in Usd.PrimRange(prototype):
            if prim != prototype:
                yield prim


@BOOK.rule("stage-units", asks="a stage is in metres and has a default prim", severity=Severity.WARNING)
def _units(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    stage = level.stage
    if stage is None:
        return
    metres = metres_per_unit(stage)
    if not UsdGeom.LinearUnitsAre(metres, UsdGeom.LinearUnits.meters):
        yield Miss("/", None, "the stage is not in metres", metres, 1.0)
    if not stage.GetDefaultPrim():
        yield Miss("/", None, "the stage has no default prim")


@BOOK.rule("nested-rigid-body", asks="no rigid body lies in another one")
def _nested_rigid_bodies(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    stage = level.stage
    if stage is None or not any(prim.HasAPI(UsdPhysics.RigidBodyAPI) for prim in _prims(stage)):
        return
    # only instance proxies show that an instance lies below a rigid body
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            above = prim.GetParent()
            while above and not above.HasAPI(UsdPhysics.RigidBodyAPI):
                above = above.GetParent()
            if above:
                yield _miss(prim, f"a rigid body inside the rigid body {above.GetPath()}")


@BOOK.rule("collider-approximation", asks="a collision mesh names an approximation that physics engines know")
def _approximations(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for prim in _prims(level.stage):
        if prim.HasAPI(UsdPhysics.CollisionAPI) and prim.IsA(UsdGeom.Mesh):
            token = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr()
            named = prim.HasAPI(UsdPhysics.MeshCollisionAPI) and token.HasAuthoredValue()
            if not named:
                yield _miss(prim, "a collision mesh without an approximation")
            elif token.Get() not in _APPROXIMATIONS:
                yield _miss(prim, f"a collision mesh with the unknown approximation {token.Get()!r}")


@BOOK.rule("collider-without-shape", asks="a collider is a shape")
def _colliders_without_shape(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for prim in _prims(level.stage):
        if prim.HasAPI(UsdPhysics.CollisionAPI) and not prim.IsA(UsdGeom.Gprim):
            yield _miss(prim, f"a collider on a prim of the type {prim.GetTypeName() or 'none'}")


@BOOK.rule("empty-label", asks="a semantic label is not empty")
def _empty_labels(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for prim in _prims(level.stage):
        for schema in prim.GetAppliedSchemas():
            name, _, taxonomy = schema.partition(":")
            if name == LABELS_SCHEMA:
                labels = labels_of(prim, taxonomy)
                if not labels or not all(labels):
                    yield _miss(prim, "an empty label")


@BOOK.rule("label-without-schema", asks="a semantic label has its schema, so that readers find it")
def _labels_without_schema(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for prim in _prims(level.stage):
        authored = prim.GetAuthoredPropertiesInNamespace(LABELS)
        schemas = prim.GetAppliedSchemas() if authored else ()
        for label in authored:
            if f"{LABELS_SCHEMA}:{label.GetBaseName()}" not in schemas:
                yield _miss(prim, f"the label {label.GetBaseName()!r} without its schema")


@BOOK.rule("unlabelled-shape", asks="every shape belongs to something with a semantic label", severity=Severity.WARNING)
def _unlabelled(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for thing in level.things if level.stage else ():
        if not thing.label:
            yield Miss(thing.name, None, "a shape without a label of the taxonomy 'class', on it or above it")


@BOOK.rule("opinion-in-instance", asks="no layer says anything below an instance, which composition ignores")
def _opinions_inside_instances(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for layer in level.stage.GetUsedLayers() if level.stage else ():
        found: list[Sdf.Path] = []

        def visit(path: Sdf.Path, layer: Sdf.Layer = layer, found: list[Sdf.Path] = found) -> None:
            spec = layer.GetPrimAtPath(path) if path.IsPrimPath() else None
            if spec is not None and spec.instanceable and spec.nameChildren:
                found.append(path)

        layer.Traverse(Sdf.Path.absoluteRootPath, visit)
        for path in found:
            yield Miss(str(path), None, f"opinions below an instance in {Path(layer.identifier).name}")


@BOOK.rule("absolute-path", asks="no file is referred to by an absolute path, which is missing on other machines")
def _absolute_paths(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for path, layer in _absolute(level.stage):
        yield Miss(path, None, f"an absolute path in {layer}")


def _absolute(stage: Usd.Stage | None) -> Iterator[tuple[str, str]]:
    """Yield each absolute asset path, with the name of its layer."""
    for layer in stage.GetUsedLayers() if stage else ():
        if layer.anonymous:
            continue
        for paths in UsdUtils.ExtractExternalReferences(layer.identifier):
            for path in paths:
                if Path(path).is_absolute() or PureWindowsPath(path).is_absolute():
                    yield path, Path(layer.identifier).name


@BOOK.rule("unbound-mesh", asks="every mesh has a material")
def _unbound_meshes(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for prim in _prims(level.stage):
        if prim.IsA(UsdGeom.Mesh) and not UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]:
            yield _miss(prim, "a mesh without a material")


@BOOK.rule("usd-validation", asks="UsdValidation finds nothing")
def _validation(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    if level.stage is None:
        return
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    shared = [
        prim for prototype in level.stage.GetPrototypes() for prim in Usd.PrimRange(prototype) if prim != prototype
    ]
    errors = [*context.Validate(level.stage, Usd.PrimDefaultPredicate), *(context.Validate(shared) if shared else ())]
    seen = set()
    absolute = [path for path, _ in _absolute(level.stage)]
    for error in errors:
        message = usd_text(error.GetMessage)
        # another rule reports absolute paths
        if error.GetName() == _UNRESOLVED and any(path in message for path in absolute):
            continue
        sites = [str(site.GetPrim().GetPath()) for site in error.GetSites() if site.IsPrim()]
        miss = Miss(sites[0] if sites else "/", None, f"{error.GetName()}: {message}")
        if miss not in seen:
            seen.add(miss)
            yield miss


def _miss(prim: Usd.Prim, message: str) -> Miss:
    return Miss(_place(prim), None, message)


def _place(prim: Usd.Prim) -> str:
    """Return the path of a prim; for a prim in a prototype, its path in the first instance."""
    if not prim.IsInPrototype():
        return str(prim.GetPath())
    prototype = prim
    while not prototype.IsPrototype():
        prototype = prototype.GetParent()
    first = min((str(instance.GetPath()) for instance in prototype.GetInstances()), default="")
    return first + str(prim.GetPath()).removeprefix(str(prototype.GetPath()))
