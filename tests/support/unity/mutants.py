"""Faults that the tests must find: each replaces one text that is in the sources once."""

from typing import NamedTuple


class Mutant(NamedTuple):
    """A fault: what it is, the source below ``unity_importer``, what is there and what takes its place."""

    name: str
    source: str
    old: str
    new: str


USDA, USDC, DATA, PACKAGE = "Core/Usda/", "Core/Usdc/", "Core/Data/", "Core/Package/"
COMPOSE, SCENE = "Core/Compose/", "Core/Scene/"

MUTANTS = (
    # ---- texts
    Mutant(
        "decimal-rounding",
        DATA + "DecimalNumber.cs",
        "mantissa += mantissa & 1;",
        "",
    ),
    Mutant(
        "decimal-digits-beyond-nineteen",
        USDA + "UsdaScanner.cs",
        "double size = count <= 19 ?",
        "double size = count <= 20 ?",
    ),
    Mutant(
        "half-ties",
        DATA + "DecimalNumber.cs",
        "Math.Round(size / step, MidpointRounding.ToEven)",
        "Math.Round(size / step, MidpointRounding.AwayFromZero)",
    ),
    Mutant(
        "escaped-quotes",
        USDA + "UsdaScanner.cs",
        "if (escaped) { return Unescaped(start, i); }",
        "",
    ),
    Mutant(
        "relative-paths",
        DATA + "UsdPaths.cs",
        "if (path[0] != '/') { AddParts(parts, prim); }",
        "",
    ),
    Mutant(
        "samples-unsorted",
        DATA + "UsdValue.cs",
        "ascending &= times[i - 1] < times[i];",
        "ascending &= times[i - 1] < times[i] || i > 0;",
    ),
    Mutant(
        "equal-prims-with-relative-paths",
        USDA + "UsdaReader.cs",
        "if (RelativePaths == relativeBefore) { KeepPrim(child, line, known as KnownPrim); }",
        "KeepPrim(child, line, known as KnownPrim);",
    ),
    Mutant(
        "equal-prims-by-their-first-line",
        USDA + "KnownPrim.cs",
        "return Length <= end - place && ByteRuns.AreEqual(text, start, place, Length);",
        "return Length <= end - place;",
    ),
    Mutant(
        "equal-lines-with-metadata",
        USDA + "UsdaReader.cs",
        "if (Next() != '(' && prim.Properties.Add(property)) { return true; }",
        "if (prim.Properties.Add(property)) { return true; }",
    ),
    Mutant(
        "equal-bytes-in-eights-alone",
        USDA + "ByteRuns.cs",
        "if (text[first] != text[second]) { return false; }",
        "",
    ),
    Mutant(
        "names-found-after-a-new-order",
        DATA + "NamedList.cs",
        "items = ordered;\n            table = null;",
        "items = ordered;",
    ),
    # ---- crates
    Mutant(
        "lz4-overlapping-copies",
        USDC + "CrateBytes.cs",
        "if (back >= length && length > 32)",
        "if (length > 32)",
    ),
    Mutant(
        "lz4-least-match",
        USDC + "CrateBytes.cs",
        "length += 4;",
        "length += 3;",
    ),
    Mutant(
        "lz4-chunks",
        USDC + "CrateBytes.cs",
        "written = Lz4(place, place + size, written, most);",
        "written = Lz4(place, place + size, 0, most);",
    ),
    Mutant(
        "integer-differences",
        USDC + "CrateBytes.cs",
        "case 0: number += common; break;",
        "case 0: number = common; break;",
    ),
    Mutant(
        "integer-width-sixteen",
        USDC + "CrateBytes.cs",
        "number += (short)(from[at] | from[at + 1] << 8);",
        "number += from[at] | from[at + 1] << 8;",
    ),
    Mutant(
        "integer-width-of-longs",
        USDC + "CrateBytes.cs",
        "code == 1 ? BitConverter.ToInt16(from, at)",
        "code == 1 ? BitConverter.ToUInt16(from, at)",
    ),
    Mutant(
        "half-bits",
        DATA + "DecimalNumber.cs",
        "(mantissa + 1024) * Math.Pow(2, exponent - 25)",
        "(mantissa + 1024) * Math.Pow(2, exponent - 24)",
    ),
    Mutant(
        "half-subnormal",
        DATA + "DecimalNumber.cs",
        "exponent == 0 ? mantissa * 5.9604644775390625e-08",
        "exponent == 0 ? mantissa * 0.0",
    ),
    Mutant(
        "quaternion-order",
        USDC + "CrateValues.cs",
        "if (UsdTypes.IsQuaternion(type)) { RealFirst(numbers); }",
        "",
    ),
    Mutant(
        "path-map-jumps",
        USDC + "CratePaths.cs",
        "bool hasChild = jump > 0 || jump == -1",
        "bool hasChild = jump > 0",
    ),
    Mutant(
        "crate-child-order",
        USDC + "CrateReader.cs",
        "order.Key.Children.Order(order.Value);",
        "",
    ),
    Mutant(
        "crate-payload-offset",
        USDC + "CrateValues.cs",
        "if (version >= 8)",
        "if (version >= 99)",
    ),
    Mutant(
        "crate-inlined-double",
        USDC + "CrateValues.cs",
        "new[] { (double)FloatOf(payload) }",
        "new[] { (double)payload }",
    ),
    # ---- packages
    Mutant(
        "zip-local-extra",
        PACKAGE + "UsdzPackage.cs",
        "long start = header + 30 + nameLength + UShort(local + 28);",
        "long start = header + 30 + nameLength;",
    ),
    Mutant(
        "zip-first-layer",
        PACKAGE + "UsdzPackage.cs",
        "if (header < firstPlace)",
        "if (header < long.MaxValue)",
    ),
    Mutant(
        "escape-of-the-folder",
        PACKAGE + "AssetResolver.cs",
        "if (parts.Count == 0) { return null; }",
        "if (parts.Count == 0) { continue; }",
    ),
    Mutant(
        "escape-over-a-link",
        PACKAGE + "AssetResolver.cs",
        "if (areLinks[part]) { return true; }",
        "",
    ),
    Mutant(
        "links-of-the-last-element-alone",
        PACKAGE + "AssetResolver.cs",
        "slash = file.IndexOf('/', slash + 1);",
        "slash = -1;",
    ),
    Mutant(
        "folder-with-the-root-s-name-as-its-beginning",
        PACKAGE + "AssetResolver.cs",
        "TrimEnd('/') + \"/\";",
        "TrimEnd('/');",
    ),
    Mutant(
        "formats-that-are-not-read",
        DATA + "LayerReader.cs",
        "one => name.EndsWith(one, StringComparison.OrdinalIgnoreCase)",
        "one => true",
    ),
    Mutant(
        "types-as-written",
        USDC + "DeclaredTypes.cs",
        "return value.AsFloating(type);",
        "return value;",
    ),
    Mutant(
        "brackets-in-strings",
        USDA + "UsdaValueReader.cs",
        "case '\"': case '\\'': QuotedString(); break;\n                    case '@': AssetPath(); break;",
        "case '@': AssetPath(); break;",
    ),
    Mutant(
        "type-that-is-left-open",
        COMPOSE + "UsdPrim.cs",
        "if (TypeName.Length == 0 && spec.TypeName != AnyType)",
        "if (TypeName.Length == 0)",
    ),
    # ---- composition
    Mutant(
        "list-edit-prepend",
        DATA + "ListOp.cs",
        "list.InsertRange(0, Unique(Prepended));",
        "list.AddRange(Unique(Prepended));",
    ),
    Mutant(
        "list-edit-delete",
        DATA + "ListOp.cs",
        "Remove(list, Deleted);",
        "",
    ),
    Mutant(
        "list-edit-append-moves",
        DATA + "ListOp.cs",
        "Remove(list, Appended);",
        "",
    ),
    Mutant(
        "list-edit-reorder",
        DATA + "ListOp.cs",
        "if (Ordered != null && Ordered.Count > 0) { Reorder(list, Ordered); }",
        "",
    ),
    Mutant(
        "strength-inherits-and-variants",
        COMPOSE + "ArcNode.cs",
        "Root, Inherit, Variant, Relocate,",
        "Root, Variant, Inherit, Relocate,",
    ),
    Mutant(
        "strength-references-and-payloads",
        COMPOSE + "ArcNode.cs",
        "Reference, Payload, Specialize,",
        "Payload, Reference, Specialize,",
    ),
    Mutant(
        "strength-of-depth",
        COMPOSE + "ArcStrength.cs",
        "if (one.Depth != other.Depth) { return other.Depth.CompareTo(one.Depth); }\n            return Ref",
        "if (one.Depth != other.Depth) { return one.Depth.CompareTo(other.Depth); }\n            return Ref",
    ),
    Mutant(
        "specializes-last",
        COMPOSE + "ClassArcs.cs",
        "MoveToRoot(root, node, node.ToRoot, node);",
        "",
    ),
    Mutant(
        "sublayer-order",
        COMPOSE + "LayerLibrary.cs",
        "foreach (SubLayer sub in layer.SubLayers)",
        "foreach (SubLayer sub in System.Linq.Enumerable.Reverse(layer.SubLayers))",
    ),
    Mutant(
        "sublayer-offsets",
        COMPOSE + "LayerLibrary.cs",
        "offset.After(Rated(sub.Offset, layer, inner))",
        "Rated(sub.Offset, layer, inner).After(offset)",
    ),
    Mutant(
        "offsets-of-samples",
        COMPOSE + "UsdProperty.cs",
        "times[k] = offset.Scale * samples.Times[k] + offset.Offset;",
        "times[k] = samples.Times[k] + offset.Offset;",
    ),
    Mutant(
        "first-sample",
        COMPOSE + "UsdProperty.cs",
        "samples.Values[0] :",
        "samples.Values[samples.Values.Length - 1] :",
    ),
    Mutant(
        "blocked-values",
        COMPOSE + "UsdPrim.cs",
        "if (ReferenceEquals(spec.Default, UsdValue.Blocked)) { return null; }",
        "if (ReferenceEquals(spec.Default, UsdValue.Blocked)) { continue; }",
    ),
    Mutant(
        "variant-of-the-strongest",
        COMPOSE + "VariantArcs.cs",
        "if (Speaks(node, path))\n            {\n                string place",
        "if (Speaks(node, path) && node.Parent != null)\n            {\n                string place",
    ),
    Mutant(
        "variants-of-a-target",
        COMPOSE + "ArcTree.cs",
        "if (IsOfStage && variants) {",
        "if (variants) {",
    ),
    Mutant(
        "ancestral-references",
        COMPOSE + "Composer.cs",
        "if (!tree.IsMovedAway()) { tree.Grow(); }\n            else",
        "if (tree.IsMovedAway())",
    ),
    Mutant(
        "implied-classes",
        COMPOSE + "ArcTree.cs",
        "if (node.IsClass) { AddTask(Step.ImplyClasses, StartOfClasses(node)); }",
        "if (node.IsClass) { }",
    ),
    Mutant(
        "prefix-of-a-longer-name",
        DATA + "UsdPaths.cs",
        "return next == '/' || next == '.' || next == '{';",
        "return true;",
    ),
    Mutant(
        "targets-outside-of-a-reference",
        COMPOSE + "PathMap.cs",
        "string mapped = best < 0 ? (keepsOthers ? path : null)",
        "string mapped = best < 0 ? path",
    ),
    Mutant(
        "inactive-prims",
        COMPOSE + "UsdPrim.cs",
        "if (!child.IsActive) { continue; }",
        "",
    ),
    Mutant(
        "instance-sharing-of-variants",
        COMPOSE + "Instancing.cs",
        "AddSelections(root, selections);",
        "",
    ),
    Mutant(
        "instance-sharing-of-offsets",
        COMPOSE + "Instancing.cs",
        "key.Append(' ').Append(InvariantText.Of(offset.Offset, offset.Scale))",
        "key",
    ),
    Mutant(
        "instance-local-opinions",
        COMPOSE + "Instancing.cs",
        "root.IsSilent = true;\n            SilenceOutside(root, false);",
        "SilenceOutside(root, false);",
    ),
    Mutant(
        "class-specifiers",
        COMPOSE + "UsdPrim.cs",
        "if (spec.Specifier == Specifier.Class && opinion.Node.IsInheritedDirectly)",
        "if (spec.Specifier == Specifier.Class && opinion.Node.IsClass && opinion.Node.IsAncestral)",
    ),
    Mutant(
        "dictionary-merge",
        COMPOSE + "UsdPrim.cs",
        "if (strong[key] == null) { strong[key] = weak[key]; }",
        "strong[key] = weak[key];",
    ),
    Mutant(
        "units-fallback",
        COMPOSE + "UsdStage.cs",
        'rootLayer.Number("metersPerUnit", 0.01);',
        'rootLayer.Number("metersPerUnit", 1);',
    ),
    # ---- places
    Mutant(
        "rotation-order",
        SCENE + "Xform.cs",
        "turned = Matrix4.Multiply(turned, Matrix4.Rotation(axis, v[axis]));",
        "turned = Matrix4.Multiply(Matrix4.Rotation(axis, v[axis]), turned);",
    ),
    Mutant(
        "rotation-sense",
        SCENE + "Matrix4.cs",
        "matrix[4 * a + b] = sin;",
        "matrix[4 * a + b] = -sin;",
    ),
    Mutant(
        "operation-order",
        SCENE + "Xform.cs",
        "Matrix4.Multiply(local, matrix);",
        "Matrix4.Multiply(matrix, local);",
    ),
    Mutant(
        "inverse-operations",
        SCENE + "Xform.cs",
        "if (inverts) { matrix = Matrix4.Inverse(matrix) ?? Matrix4.Identity(); }",
        "",
    ),
    Mutant(
        "reset-of-the-stack",
        SCENE + "Xform.cs",
        "resets = true;",
        "resets = false;",
    ),
    Mutant(
        "quaternion-sense",
        SCENE + "Matrix4.cs",
        "1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (z * x - y * w), 0,",
        "1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (z * x + y * w), 0,",
    ),
    Mutant(
        "axis-of-vectors",
        SCENE + "Matrix4.cs",
        "(isZUp ? vectors[i + 1] : -vectors[i + 2])",
        "(isZUp ? vectors[i + 1] : vectors[i + 2])",
    ),
    Mutant(
        "axis-of-directions",
        SCENE + "Matrix4.cs",
        "into[1] = isZUp ? z : y;",
        "into[1] = isZUp ? -z : y;",
    ),
    Mutant(
        "axis-of-rotations",
        SCENE + "Matrix4.cs",
        "new[] { w, -x, -z, -y }",
        "new[] { w, x, z, y }",
    ),
    Mutant(
        "units-of-matrices",
        SCENE + "Matrix4.cs",
        "turned[i] *= MetersPerUnit;",
        "turned[i] *= 1;",
    ),
    Mutant(
        "hidden-instances",
        SCENE + "SceneParts.cs",
        "hidden.Contains(ids == null ? i : (long)ids[i])",
        "hidden.Contains(i)",
    ),
    # ---- meshes
    Mutant(
        "winding",
        SCENE + "TriangleMesh.cs",
        'leftHanded = prim.Text("orientation", "rightHanded") == "leftHanded";',
        'leftHanded = prim.Text("orientation", "rightHanded") != "leftHanded";',
    ),
    Mutant(
        "left-handed-meshes",
        SCENE + "TriangleMesh.cs",
        'leftHanded = prim.Text("orientation", "rightHanded") == "leftHanded";',
        "leftHanded = false;",
    ),
    Mutant(
        "holes",
        SCENE + "TriangleMesh.cs",
        "if (isHole[face] || counts[face] < 3) { continue; }",
        "if (counts[face] < 3) { continue; }",
    ),
    Mutant(
        "concave-faces",
        SCENE + "FaceTriangles.cs",
        "checks < MostChecks ? BestEar() : 1",
        "1",
    ),
    Mutant(
        "ears-with-corners-in-them",
        SCENE + "FaceTriangles.cs",
        "if (!atCorner && Area(",
        "if (atCorner && Area(",
    ),
    Mutant(
        "face-varying-values",
        SCENE + "TriangleMesh.cs",
        'int element = channel.Interpolation == "faceVarying" ? corner',
        'int element = channel.Interpolation == "faceVarying" ? point',
    ),
    Mutant(
        "uniform-values",
        SCENE + "TriangleMesh.cs",
        'channel.Interpolation == "uniform" ? face\n                    : channel.Interpolation',
        'channel.Interpolation == "uniform" ? corner\n                    : channel.Interpolation',
    ),
    Mutant(
        "indexed-values",
        SCENE + "TriangleMesh.cs",
        "return channel.Indices == null ? element : channel.Indices[element];",
        "return element;",
    ),
    Mutant(
        "vertices-shared-by-unlike-corners",
        SCENE + "TriangleMesh.cs",
        "Others = others };",
        "Others = 0 };",
    ),
    Mutant(
        "normals-of-faces",
        SCENE + "TriangleMesh.cs",
        'ReadChannel("primvars:normals", 3) ?? ReadChannel("normals", 3) ?? MadeNormals();',
        "MadeNormals();",
    ),
    Mutant(
        "normals-made-smooth",
        SCENE + "TriangleMesh.cs",
        'bool smooth = prim.Text("subdivisionScheme", "catmullClark") != "none";',
        "bool smooth = true;",
    ),
    Mutant(
        "subset-faces",
        SCENE + "TriangleMesh.cs",
        "partOfFace[face] = parts.Count - 1;",
        "partOfFace[face] = 0;",
    ),
    Mutant(
        "meshes-alike-in-their-arrays-alone",
        SCENE + "MeshMemo.cs",
        "value == null || value.IsArray ? value : (object)value.Text ?? value.Number(0)",
        "value == null || value.IsArray ? value : null",
    ),
    Mutant(
        "meshes-alike-but-for-their-interpolation",
        SCENE + "MeshMemo.cs",
        'parts.Add(property.MetadataText("interpolation"));',
        "",
    ),
    # ---- materials and lights
    Mutant(
        "binding-purposes",
        SCENE + "MaterialBinding.cs",
        '"material:binding:" + purpose',
        '"material:binding:preview"',
    ),
    Mutant(
        "binding-strength",
        SCENE + "MaterialBinding.cs",
        "keepsGeneral = general != null && !above.isGeneralStrong;",
        "keepsGeneral = general != null;",
    ),
    Mutant(
        "texture-channel",
        SCENE + "MaterialData.cs",
        "input.Texture = TextureOf(stage, shader, output.Substring(8));",
        'input.Texture = TextureOf(stage, shader, "rgb");',
    ),
    Mutant(
        "texture-coordinates-behind-a-transform",
        SCENE + "MaterialData.cs",
        'Source(stage, transform, "inputs:in", out reader, out output);',
        "",
    ),
    Mutant(
        "light-normalize",
        SCENE + "SceneParts.cs",
        "return IsNormalized && size > 0 ? Emission / size : Emission;",
        "return Emission;",
    ),
    Mutant(
        "light-exposure",
        SCENE + "SceneParts.cs",
        "Intensity * Math.Pow(2, Exposure)",
        "Intensity * Math.Exp(Exposure)",
    ),
    Mutant(
        "light-units",
        SCENE + "SceneParts.cs",
        "case LightKind.Rect: return Width * Height * square;",
        "case LightKind.Rect: return Width * Height;",
    ),
    Mutant(
        "light-of-a-cylinder",
        SCENE + "SceneParts.cs",
        "return Sized(metersPerUnit) / Math.PI;",
        "return Sized(metersPerUnit) / 2;",
    ),
    # ---- arcs that follow from others
    Mutant(
        "moved-away",
        COMPOSE + "ChildNames.cs",
        "if (gone.Count > 0) { names.RemoveAll(gone.Contains); }",
        "",
    ),
    Mutant(
        "relocates-in-maps",
        COMPOSE + "ReferenceArcs.cs",
        "if (parent.Stack.Relocates != null) { map",
        "if (false) { map",
    ),
    Mutant(
        "selection-by-a-weaker-variant",
        COMPOSE + "VariantArcs.cs",
        "foreach (ArcTask waiting in tasks) { waiting.IsWaiting = false; }",
        "",
    ),
    Mutant(
        "variants-of-specialized-prims",
        COMPOSE + "ClassArcs.cs",
        "if (moved.IsSilent) { AddTask(Step.FindVariants, moved); }",
        "",
    ),
    Mutant(
        "variables-of-the-referring-layer",
        COMPOSE + "ExpressionVariables.cs",
        "merged[name] = stronger.values[name];",
        "merged[name] = merged[name] ?? stronger.values[name];",
    ),
    Mutant(
        "samples-of-a-weaker-layer",
        COMPOSE + "UsdPrim.cs",
        "if (spec.Samples != null) { break; }",
        "",
    ),
    Mutant(
        "colliders-under-uneven-scale",
        "Runtime/ColliderBuilder.cs",
        "if (isRound && !isScaledEvenly) {",
        "if (false) {",
    ),
    Mutant(
        "names-of-this-country",
        "Core/Data/InvariantText.cs",
        'numbers[i].ToString("R", CultureInfo.InvariantCulture);',
        'numbers[i].ToString("R", CultureInfo.CurrentCulture);',
    ),
    Mutant(
        "light-without-a-size",
        SCENE + "SceneParts.cs",
        "return IsNormalized ? Emission : Emission * Size(metersPerUnit);",
        "return Luminance(metersPerUnit) * Size(metersPerUnit);",
    ),
    Mutant(
        "transforms-of-coordinates-in-a-row",
        SCENE + "MaterialData.cs",
        "data.CoordinateScale[0] * scale[0]",
        "scale[0]",
    ),
)
