"""What ``pxr`` says of a composed stage, in the form of the C# dump."""

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from support.unity.values_of_pxr import anything, dumped

SPECIFIERS = {Sdf.SpecifierDef: "Def", Sdf.SpecifierOver: "Over", Sdf.SpecifierClass: "Class"}
PREDICATE = Usd.PrimIsActive & Usd.PrimIsLoaded


def stage_dump(stage: Usd.Stage) -> dict:
    """As ``StageDump`` writes it, but for the warnings and the numbers of prototypes."""
    places, shown = {}, []
    for root in [stage.GetPseudoRoot(), *stage.GetPrototypes()]:
        places[root.GetPath()] = Gf.Matrix4d(1)
        for prim in Usd.PrimRange(root, PREDICATE):
            if prim != root:
                local, resets = local_transform(prim)
                places[prim.GetPath()] = local if resets else local * places[prim.GetPath().GetParentPath()]
                shown.append(prim)
    prims = {str(prim.GetPath()): prim_dump(prim, places[prim.GetPath()]) for prim in shown}
    for key, purpose in ("material", UsdShade.Tokens.preview), ("physicsMaterial", "physics"):
        bound, _ = UsdShade.MaterialBindingAPI.ComputeBoundMaterials(shown, purpose)
        for prim, material in zip(shown, bound, strict=True):
            if material:
                prims[str(prim.GetPath())][key] = str(material.GetPath())
    return {
        # of which UsdGeom raises where a layer has it in another type
        "metersPerUnit": float(stage.GetMetadata("metersPerUnit")),
        "isZUp": UsdGeom.GetStageUpAxis(stage) == "Z",
        "prims": prims,
    }


def local_transform(prim: Usd.Prim) -> tuple[Gf.Matrix4d, bool]:
    """To the parent at the earliest time; whether it leads to the world instead."""
    xformable = UsdGeom.Xformable(prim)
    if not xformable or not prim.GetAttribute("xformOpOrder").IsAuthored():
        return Gf.Matrix4d(1), False
    return xformable.GetLocalTransformation(Usd.TimeCode.EarliestTime()), xformable.GetResetXformStack()


def prim_dump(prim: Usd.Prim, world: Gf.Matrix4d) -> dict:
    out = {
        "specifier": SPECIFIERS[prim.GetSpecifier()],
        "type": prim.GetTypeName(),
        "apis": list(prim.GetPrimTypeInfo().GetAppliedAPISchemas()),
        "children": [child.GetName() for child in prim.GetFilteredChildren(PREDICATE)],
        "properties": {one.GetName(): property_dump(one) for one in prim.GetAuthoredProperties()},
    }
    if "xformOpOrder" in out["properties"]:
        out["world"] = world
    if prim.IsInstance():
        out["prototype"] = str(prim.GetPrototype().GetPath())
    stack = prim.GetPrimStack()
    variants = {}
    for spec in stack:
        for name, selection in spec.variantSelections.items():
            variants.setdefault(name, selection)
    if variants:
        out["variants"] = variants
    for field in ("kind", "customData", "assetInfo"):
        authored = [spec.GetInfo(field) for spec in stack if spec.HasInfo(field)]
        if authored:
            out[field] = anything(merged(authored) if isinstance(authored[0], dict) else authored[0])
    return out


def merged(dictionaries: list[dict]) -> dict:
    """All dictionaries together, the first strongest; ``pxr`` would add what the schema says of itself."""
    together = {}
    for one in dictionaries:
        for key, value in one.items():
            both = isinstance(value, dict) and isinstance(together.get(key), dict)
            together[key] = merged([together[key], value]) if both else together.get(key, value)
    return together


def property_dump(one) -> dict:
    if isinstance(one, Usd.Relationship):
        targets = [str(target) for target in one.GetTargets()]
        return {"type": ""} | ({"targets": targets} if targets else {})
    specs = one.GetPropertyStack()
    # the authored type: a schema may have another
    kind = next(spec.typeName for spec in specs if spec.typeName)
    out = {"type": str(kind)}
    # a value of another type than the schema's is nothing to the schema
    authored = [spec for spec in specs if spec.HasDefaultValue() or spec.layer.GetNumTimeSamplesForPath(spec.path)]
    if kind == one.GetTypeName():
        value = one.Get(Usd.TimeCode.EarliestTime()) if one.HasAuthoredValue() else None
    else:
        value = authored[0].default if authored else None
    value = dumped(kind, value)
    if value is not None:
        out["value"] = value
    times = one.GetTimeSamples()
    if times:
        out["times"] = list(times)
    targets = one.GetConnections()
    if targets:
        out["targets"] = [str(target) for target in targets]
    if one.HasAuthoredMetadata("interpolation"):
        out["interpolation"] = one.GetMetadata("interpolation")
    return out


def numbered_alike(wanted: dict, found: dict) -> None:
    """Rename the prototypes of the C# dump as ``pxr`` numbers them, by the first instances that both have."""
    names = {}
    for _ in range(8):  # prototypes within prototypes
        for path, prim in found["prims"].items():
            head = "/" + path.split("/")[1]
            if head.startswith("/__Prototype_") and head not in names:
                continue
            other = wanted["prims"].get(renamed(path, names), {})
            if "prototype" in prim and "prototype" in other:
                names.setdefault(prim["prototype"], other["prototype"])
    found["prims"] = {renamed(path, names): renamed_in(prim, names) for path, prim in found["prims"].items()}


def renamed(path: str, names: dict[str, str]) -> str:
    head, slash, rest = path[1:].partition("/")
    return names.get("/" + head, "/" + head) + slash + rest


def renamed_in(prim: dict, names: dict[str, str]) -> dict:
    for key in prim.keys() & {"prototype", "material", "physicsMaterial"}:
        prim[key] = renamed(prim[key], names)
    for one in prim["properties"].values():
        if "targets" in one:
            one["targets"] = [renamed(target, names) for target in one["targets"]]
    return prim


def misplaced(wanted: dict, found: dict) -> list[str]:
    """Prims that stand at different places; takes the places out of both dumps."""
    lines = []
    for path in wanted["prims"].keys() & found["prims"].keys():
        there, here = wanted["prims"][path].pop("world", None), found["prims"][path].pop("world", None)
        if there is None and here is None:
            continue
        if there is None or here is None or not np.allclose(np.array(there).ravel(), here, rtol=0, atol=1e-6):
            lines.append(f"{path}: pxr {there}, C# {here}")
    return lines
