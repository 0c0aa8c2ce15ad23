"""Text that the grammar of .usda allows: white space, comments, separators, and what may be left out."""

import pytest
from pxr import Sdf
from support.unity.agreement import same

TEXTS = {
    "spaces before brackets": 'def "A" {\n int [] a = [1, 2]\n uniform token [ ] b = ["x"]\n custom float3\t[] c = []\n}',
    "brackets in dictionaries": 'def "A" (customData = { float3 [] c = [(1,2,3)]\n dictionary d = { int[ ] e = [1] } })\n{\n}',
    "spaces around dots": 'def "A" {\n int b\n int a .connect = </A.b>\n int c. timeSamples = { 0 : 1, }\n}',
    "types with dots": 'def Foo.Bar "A" {\n}\ndef Foo . Baz "B" {\n}\ndef Foo::Bar "C" {\n}',
    "last commas": 'def "A" {\n float3 a = (1, 2, 3,)\n float3[] b = [(1,2,3),(4,5,6,),]\n matrix2d m = ((1, 2,), (3, 4),)\n'
    " rel r = [</B>, </C>,]\n}",
    "no default prim to refer to": 'def "A" (references = <>)\n{\n}\ndef "B" (prepend payload = [<>, </C>,])\n{\n}\n'
    'def "C" {\n int c = 1\n}',
    "the default prim itself": '(\n defaultPrim = "C"\n)\ndef "A" (references = <>)\n{\n}\n'
    'def "B" (payload = [<> (offset = 3; scale = 2)])\n{\n}\ndef "C" {\n int c.timeSamples = {1: 1}\n}',
    "comments everywhere": '/* a */ def /* b */ "A" /* c */ ( # d\n kind = "x" // e\n) /* f */ {'
    " /* g */ int a /* h */ = /* i */ 1 # j\n int[] b = [ # k\n 1, /* l */ 2, // m\n ]\n}  # n",
    "returns": 'def "A" {\r\n int a = 1 # c\r\n int b = 2\r\n}\r\n',
    "semicolons": 'def "A" ( kind = "a"; doc = "b"; ) { int a = 1; int b = 2; }',
    "empty lists": '(subLayers = [ ])\ndef "A" (references = [] )\n{\n rel r = [ ]\n int[] a = [ ]\n}',
    "offsets": 'def "A" (references = </B> (\n offset = 3\n scale = 2;\n customData = { int a = 1 } ))\n{\n}\n'
    'def "B" (references = </C> ())\n{\n}\ndef "C" {\n int z.timeSamples = {1:1}\n}',
    "words of the grammar as names": 'def "def" {\n int class = 1\n float default = 2\n float add = 3\n int rel = 1\n}',
    "numbers": 'def "A" {\n float[] a = [1., .5, -.5, 1e3, -1E-3, inf, -inf, nan]\n bool[] b = [true, false, 1, 0]\n}',
    "metadata of all kinds": 'def "A" {\n float a = 1 ("c"; customData = { int b = 1 };)\n float b (doc = "x")\n rel r ( )\n}',
}


@pytest.mark.parametrize("name", TEXTS)
def test_text(usd_dump, tmp_path, name):
    path = tmp_path / "text.usda"
    path.write_bytes(f"#usda 1.0\n{TEXTS[name]}".encode())
    assert Sdf.Layer.FindOrOpen(str(path)), "pxr does not read it either"
    same(usd_dump, path)
