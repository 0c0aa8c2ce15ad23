"""Small stages, one for each rule of what many opinions say together."""

OPINIONS = {
    "list edits of every arc": {
        "root.usd": """(
    subLayers = [@middle.usd@, @weak.usd@]
)
over "Prepended" ( prepend inherits = </I3>
    prepend references = @c.usd@</C3>
    prepend payload = @c.usd@</C5>
    prepend specializes = </S3>
    prepend variantSets = "v3" ) {}
over "Appended" ( append inherits = </I1>
    append references = @c.usd@</C1>
    append payload = @c.usd@</C4>
    append specializes = </S1>
    append variantSets = "v3" ) {}
over "Added" ( add inherits = [</I3>, </I1>]
    add references = [@c.usd@</C3>, @c.usd@</C1>]
    add payload = @c.usd@</C5>
    add specializes = </S3>
    add variantSets = ["v3", "v1"] ) {}
over "Deleted" ( delete inherits = [</I1>, </I4>]
    delete references = @c.usd@</C1>
    delete payload = @c.usd@</C4>
    delete specializes = </S1>
    delete variantSets = "v1" ) {}
over "Reordered" ( reorder inherits = [</I2>, </I1>]
    reorder references = [@c.usd@</C2>, @c.usd@</C1>]
    reorder specializes = [</S2>, </S1>]
    reorder variantSets = ["v2", "v1"] ) {}
over "Replaced" ( inherits = </I3>
    references = @c.usd@</C3>
    payload = @c.usd@</C5>
    specializes = </S3>
    variantSets = "v3" ) {}
over "Emptied" ( inherits = None
    references = None
    payload = None
    specializes = None ) {}
""",
        "middle.usd": """
over "Appended" ( prepend inherits = </I3>
    delete references = @c.usd@</C2> ) {}
over "Deleted" ( append inherits = </I4> ) {}
""",
        "weak.usd": "\n".join(
            f"""
def "{name}" ( inherits = [</I1>, </I2>]
    references = [@c.usd@</C1>, @c.usd@</C2>]
    payload = @c.usd@</C4>
    specializes = [</S1>, </S2>]
    variantSets = ["v1", "v2"]
    variants = {{ string v1 = "a"
        string v2 = "a"
        string v3 = "a" }} ) {{
    variantSet "v1" = {{ "a" {{ float v = 1
        float v1 = 1 }} }}
    variantSet "v2" = {{ "a" {{ float v = 2
        float v2 = 1 }} }}
    variantSet "v3" = {{ "a" {{ float v = 3
        float v3 = 1 }} }}
}}
"""
            for name in ("Prepended", "Appended", "Added", "Deleted", "Reordered", "Replaced", "Emptied")
        )
        + "\n".join(f'class "I{i}" {{ float i = {i}\n    float i{i} = 1 }}' for i in range(1, 5))
        + "\n"
        + "\n".join(f'def "S{i}" {{ float s = {i}\n    float s{i} = 1 }}' for i in range(1, 4)),
        "c.usd": "\n".join(f'def "C{i}" {{ float c = {i}\n    float c{i} = 1 }}' for i in range(1, 6)),
    },
    "list edits of targets across references": {
        "root.usd": """
def "A" ( references = @car.usd@</Car> ) {
    prepend rel edited = </A/Mine>
    delete rel edited = </A/Body>
    append rel edited = </A/Wheel>
    rel replaced = </A/Wheel>
    delete rel lessened = </A/Wheel>
    reorder rel turned = [</A/Wheel>, </A/Body>]
    prepend float f.connect = </A/Body.out>
}
""",
        "car.usd": """
def "Car" { rel edited = [</Car/Body>, </Car/Door>, </Car/Wheel>, </Elsewhere>]
    rel replaced = </Car/Body>
    rel lessened = [</Car/Body>, </Car/Wheel>]
    rel turned = [</Car/Body>, </Car/Door>, </Car/Wheel>]
    float f.connect = [</Car/Door.out>, </Car/Body.out>]
    def "Body" { float out = 1 } }
""",
    },
    "times that run backwards or stand still": {
        "root.usd": """(
    subLayers = [@strong.usd@ (offset = 10; scale = -2)]
)
def "A" ( references = @c.usd@</C> (offset = 5; scale = -1) ) {}
def "Still" ( payload = @c.usd@</C> (offset = 5; scale = 0) ) {}
""",
        "strong.usd": """
def "B" { float x.timeSamples = { 1: 10, 2: 20, 3: 30 }
    timecode t = 4
    timecode[] ts.timeSamples = { 0: [1, 2], 4: [3] } }
""",
        "c.usd": """
def "C" { float x.timeSamples = { 0: 1, 10: 2 }
    string[] names.timeSamples = { 0: ["a"], 10: ["b", "c"] }
    timecode t = 4 }
""",
    },
    "values of every type in several layers": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
over "A" { half[] halves = [1, 0.1, 65504]
    token[] tokens = []
    asset texture = @other.png@
    matrix4d m = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1e-320, 0.1, 0, 1) )
    quath[] qs = [(1, 0.1, 0, 0), (0, 0, 0, 1)] }
""",
        "weak.usd": """
def "A" { half[] halves = [2]
    token[] tokens = ["a", "b"]
    asset texture = @weak.png@
    asset[] textures = [@a.png@, @b.png@]
    matrix4d m = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )
    matrix3d[] ms = [( (1, 2, 3), (4, 5, 6), (7, 8, 9) )]
    quath[] qs = [(1, 0, 0, 0)]
    quatd q = (0.1, 0.2, 0.3, 0.4)
    double3[] ds = [(0.1, 1e300, -0), (nan, inf, -inf)]
    uint64 big = 18446744073709551615
    string text = "weak"
    bool[] flags = [0, 1, 1]
    uchar[] bytes = [0, 255] }
""",
    },
    "order of properties and root prims": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
reorder rootPrims = ["C", "A"]
def "A" { reorder properties = ["z", "a"]
    float a = 1
    float z = 2 }
def "B" {}
""",
        "weak.usd": """
reorder rootPrims = ["B", "C"]
def "C" {}
def "D" {}
def "A" { float m = 1 }
""",
    },
    "inactive by other layers": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
over "Off" ( active = false ) {}
over "On" ( active = true ) { over "k" ( active = false ) {} }
def "Ref" ( references = @weak.usd@</On> ) {}
def "Instance" ( instanceable = true
    references = @weak.usd@</Parts> ) {}
""",
        "weak.usd": """
def "Off" { def "k" {} }
def "On" ( active = false ) { def "k" {}
    def "l" ( active = false ) {} }
def "Parts" { def "a" ( active = false ) {}
    def "b" {} }
""",
    },
    "properties that layers disagree on": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
over "A" { custom float a = 1
    uniform token t
    float f
    float g.connect = </A.a>
    rel r }
""",
        "weak.usd": """
def "A" { float a = 2 (
        interpolation = "vertex"
    )
    uniform token t = "weak"
    float f = 5
    float g = 6
    rel r = </A> }
""",
    },
    "dictionaries of many layers": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
over "A" ( customData = { dictionary deep = { int x = 1
            dictionary deeper = { string only = "root" } }
        int[] list = [1, 2] } ) {}
def "Ref" ( references = @weak.usd@</A>
    customData = { dictionary deep = { int y = 9 } } ) {}
def "Class" ( inherits = </_c>
    assetInfo = { string name = "mine" } ) {}
class "_c" ( assetInfo = { string name = "class"
        string version = "1" } ) {}
""",
        "weak.usd": """
def "A" ( customData = { dictionary deep = { int x = 2
            int y = 2
            dictionary deeper = { string only = "weak"
                double too = 0.1 } }
        int[] list = [3]
        bool flag = true }
    assetInfo = { asset identifier = @./a.usd@ } ) {}
""",
    },
}
