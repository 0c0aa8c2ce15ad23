"""Text that the grammar of .usda allows: white space, comments, separators, and what may be left out."""

import pytest
from pxr import Sdf
from support.unity.agreement import same

TEXTS = {
    "spaces before brackets": """
def "A" {
 int [] a = [1, 2]
 uniform token [ ] b = ["x"]
 custom float3\t[] c = []
}
""",
    "brackets in dictionaries": """
def "A" (customData = { float3 [] c = [(1,2,3)]
 dictionary d = { int[ ] e = [1] } })
{
}
""",
    "spaces around dots": """
def "A" {
 int b
 int a .connect = </A.b>
 int c. timeSamples = { 0 : 1, }
}
""",
    "types with dots": """
def Foo.Bar "A" {
}
def Foo . Baz "B" {
}
def Foo::Bar "C" {
}
""",
    "last commas": """
def "A" {
 float3 a = (1, 2, 3,)
 float3[] b = [(1,2,3),(4,5,6,),]
 matrix2d m = ((1, 2,), (3, 4),)
 rel r = [</B>, </C>,]
}
""",
    "no default prim to refer to": """
def "A" (references = <>)
{
}
def "B" (prepend payload = [<>, </C>,])
{
}
def "C" {
 int c = 1
}
""",
    "the default prim itself": """
(
 defaultPrim = "C"
)
def "A" (references = <>)
{
}
def "B" (payload = [<> (offset = 3; scale = 2)])
{
}
def "C" {
 int c.timeSamples = {1: 1}
}
""",
    "comments everywhere": """
/* a */ def /* b */ "A" /* c */ ( # d
 kind = "x" // e
) /* f */ { /* g */ int a /* h */ = /* i */ 1 # j
 int[] b = [ # k
 1, /* l */ 2, // m
 ]
}  # n
""",
    "returns": """
def "A" {\r
 int a = 1 # c\r
 int b = 2\r
}\r

""",
    "semicolons": """
def "A" ( kind = "a"; doc = "b"; ) { int a = 1; int b = 2; }
""",
    "empty lists": """
(subLayers = [ ])
def "A" (references = [] )
{
 rel r = [ ]
 int[] a = [ ]
}
""",
    "offsets": """
def "A" (references = </B> (
 offset = 3
 scale = 2;
 customData = { int a = 1 } ))
{
}
def "B" (references = </C> ())
{
}
def "C" {
 int z.timeSamples = {1:1}
}
""",
    "words of the grammar as names": """
def "def" {
 int class = 1
 float default = 2
 float add = 3
 int rel = 1
}
""",
    "numbers": """
def "A" {
 float[] a = [1., .5, -.5, 1e3, -1E-3, inf, -inf, nan]
 bool[] b = [true, false, 1, 0]
}
""",
    "metadata of all kinds": """
def "A" {
 float a = 1 ("c"; customData = { int b = 1 };)
 float b (doc = "x")
 rel r ( )
}
""",
}


@pytest.mark.parametrize("name", TEXTS)
def test_text(usd_dump, tmp_path, name):
    path = tmp_path / "text.usda"
    path.write_bytes(f"#usda 1.0\n{TEXTS[name]}".encode())
    assert Sdf.Layer.FindOrOpen(str(path)), "pxr does not read it either"
    same(usd_dump, path)
