"""The check of signatures tells what is declared from what is not; here on sources of our own."""

import pytest
from check_signatures import used_members
from declarations import Member, declarations, matches, stripped
from support.unity import reader
from support.unity.layer import UNITY_6

SOURCE = """
using System;
namespace Outer.Space
{
    // public extern int commented { get; set; }
    [Obsolete("use another")]
    public partial class Thing<T> : Base, IOther where T : struct
    {
        public Thing([NotNull] string name) { if (name == "}") { return; } }
        [NativeName("x")] extern public float range { get; set; }
        public Color[] colors { get => null; private set { } }
        public static readonly int count = 3, other;
        [Obsolete("no", false)]
        public void Old(int a, params Object[] rest) {}
        extern public static bool Find([Unmarshalled] System.Collections.Generic.List<UnityEngine.Vector3> into,
            out int n, [DefaultValue("null")] Object obj = null);
        public T Get<T>(string key) where T : class => default;
        internal void Hidden() {}
        public static implicit operator bool(Thing<T> it) { return true; }
        public int width => 3;
#if !KNOWN
        public int Never() { return 1; }
#else
        public int Always() { return 1; }
#endif
        public enum Kind { A, B = 1 << 3, [InspectorName("c")] C, D = 'x' == 'y' ? 1 : 2 }
    }
}
"""


def state_of(kind, name, result="", *parameters, is_static=False):
    (part,) = declarations(stripped(SOURCE), "Outer.Space", "Thing")
    member = Member(kind, "Outer.Space", "Thing", name, result, parameters, is_static)
    return next(filter(None, (matches(member, header, body) for header, body in part.members)), None)


@pytest.mark.parametrize(
    ("state", "member"),
    [
        ("declared", ("get", "range", "float")),
        ("declared", ("set", "range", "float")),
        (None, ("get", "range", "int")),
        (None, ("get", "commented", "int")),
        ("declared", ("get", "colors", "Color[]")),
        (None, ("set", "colors", "Color[]")),
        ("obsolete", ("method", "Old", "void", "int", "Object[]")),
        (None, ("method", "Old", "void", "int")),
        (None, ("method", "Old", "int", "int", "Object[]")),
        ("declared", ("method", "Get", "T", "string")),
        (None, ("method", "Hidden", "void")),
        ("declared", ("constructor", ".ctor", "", "string")),
        (None, ("constructor", ".ctor", "", "int")),
        ("declared", ("get", "width", "int")),
        (None, ("set", "width", "int")),
        (None, ("method", "Never", "int")),
        ("declared", ("method", "Always", "int")),
    ],
)
def test_members(state, member):
    assert state_of(*member) == state


def test_static_members():
    parameters = "List<Vector3>", "ref int", "Object"
    assert state_of("method", "Find", "bool", *parameters, is_static=True) == "declared"
    assert state_of("method", "Find", "bool", *parameters) is None
    assert state_of("field", "other", "int", is_static=True) == "declared"
    assert state_of("method", "op_Implicit", "bool", "Thing<T>", is_static=True) == "declared"
    assert state_of("method", "op_Equality", "bool", "Thing<T>", is_static=True) is None


def test_types():
    text = stripped(SOURCE)
    (part,) = declarations(text, "Outer.Space", "Thing")
    assert part.bases == ["Base", "IOther"]
    assert part.is_obsolete
    assert not list(declarations(text, "Outer", "Thing"))
    (kind,) = declarations(text, "Outer.Space", "Thing.Kind")
    assert kind.values == {"A": 0, "B": 8, "C": 9, "D": None}


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
def test_everything_that_the_package_calls_is_looked_up(tmp_path):
    """A few members that are used in different ways, each found in the compiled code or in the sources."""
    found = {(member.kind, member.type, member.name) for member in used_members(tmp_path, UNITY_6)}
    assert found >= {
        ("constructor", "PhysicsMaterial", ".ctor"),
        ("method", "ImageConversion", "LoadImage"),
        ("set", "Light", "areaSize"),
        ("value", "LightType", "Rectangle"),
        ("method", "ScriptedImporter", "OnImportAsset"),
        ("constructor", "ScriptedImporterAttribute", ".ctor"),
        ("field", "Vector3", "x"),
        ("type", "MonoBehaviour", ""),
    }
    assert not [key for key in found if key[1] == "PhysicMaterial"]
