"""Small stages, one for each rule of composition."""

LETTERS = "ivrps"
"""Inherits, variants, references, payloads, specializes."""


def pairs(letter: str) -> str:
    """A property for each two kinds of arc of which this is one."""
    other = (sorted((letter, one), key=LETTERS.index) for one in LETTERS if one != letter)
    return "\n    ".join(f'token {one}{two} = "{letter}"' for one, two in other)


ARCS = {
    "strength of every arc against every other": {
        "root.usd": f"""
def "A" ( inherits = </I>
    references = </R>
    payload = </P>
    specializes = </S>
    variants = {{ string set = "v" }}
    prepend variantSets = "set" ) {{
    variantSet "set" = {{ "v" {{ {pairs("v")} }} }}
}}
class "I" {{ {pairs("i")} }}
def "R" {{ {pairs("r")} }}
def "P" {{ {pairs("p")} }}
def "S" {{ {pairs("s")} }}
""",
    },
    "sublayers with offsets": {
        "root.usd": """(
    subLayers = [@strong.usd@ (offset = 10; scale = 2), @weak.usd@ (offset = -5)]
)
over "A" { token mine = "root" }
""",
        "strong.usd": """(
    subLayers = [@deep.usd@ (offset = 1; scale = 3)]
    timeCodesPerSecond = 48
)
def Xform "A" { float x.timeSamples = { 0: 1, 5: 2, }
    float y = 1
    timecode t = 7
}
""",
        "deep.usd": """(
    timeCodesPerSecond = 24
)
def Xform "A" { float z.timeSamples = { 0: 1, 5: 2, }
    float y = 2
    timecode[] ts = [1, 2]
}
def "OnlyDeep" {}
""",
        "weak.usd": """
class "A" { token mine = "weak"
    float w.timeSamples = { 1: 1 }
    float x = 3
}
""",
    },
    "sublayers missing, absolute and circular": {
        "root.usd": """(
    subLayers = [@none.usd@, @other.usd@]
)
def "A" {}
""",
        "other.usd": """(
    subLayers = [@root.usd@]
)
def "B" {}
""",
    },
    "references": {
        "root.usd": """
def "Default" ( references = @assets/car.usd@ ) {}
def "Named" ( prepend references = @assets/car.usd@</Other> (offset = 4; scale = 0.5) ) { float size = 3 }
def "Several" ( references = [@assets/car.usd@</Other>, @assets/car.usd@</Car>, </Local>] ) {}
def "Internal" ( references = </Local/Inner> ) {}
def "Local" { rel r = [</Local/Inner>, </Named>, </Local>]
    def "Inner" { float a = 1
        rel up = </Local>
        float c.connect = </Local/Inner.a>
    }
}
def "Missing" ( references = [@nothing.usd@, @assets/car.usd@</None>, </Nowhere>] ) {}
def "None" ( references = None ) {}
""",
        "assets/car.usd": """(
    defaultPrim = "Car"
)
def Xform "Car" ( kind = "component" ) { float size = 1
    rel inside = [</Car/Body>, </Other>, </Car/Body.color>]
    def Mesh "Body" { color3f color = (1, 0, 0)
        asset texture = @./textures/paint.png@
        float glow.timeSamples = { 1: 1, 3: 3 }
    }
    def "Nested" ( references = @wheel.usd@ ) {}
}
def "Other" { float size = 2
    float b.timeSamples = { 0: 1, 10: 2 }
    def "Part" {}
}
""",
        "assets/wheel.usd": """(
    defaultPrim = "/Deep/Wheel"
)
def "Deep" { float never = 1
    def Sphere "Wheel" { double radius = 2
        rel self = </Deep/Wheel>
        rel outer = </Deep>
    }
}
""",
    },
    "ancestral references": {
        "root.usd": """
def "A" ( references = @b.usd@</B> ) { over "k" ( references = @c.usd@</C> ) { float x = 1 } }
def "Into" ( references = @b.usd@</B/k/deep> ) {}
def "Through" ( references = </A/k> ) {}
""",
        "b.usd": """
def "B" ( references = @c.usd@</D> ) { def "k" { float x = 2
        float y = 2
        def "deep" { float z = 1
            rel t = [</B/k>, </B/k/deep>] } }
}
""",
        "c.usd": """
def "C" { float y = 3
    float w = 3
    def "fromC" {}
    over "deep" { float q = 1 }
}
def "D" { over "k" { float w = 4
        over "deep" { float z = 5
            float d = 5 } } }
""",
    },
    "payloads": {
        "root.usd": """
def "A" ( payload = @b.usd@</B> ) {}
def "Both" ( prepend payload = [@b.usd@</B>, </Local>]
    references = @b.usd@</C> ) {}
def "Local" { float x = 9
    float l = 1 }
def "Shifted" ( payload = @b.usd@</B> (offset = 3) ) {}
""",
        "b.usd": """
def "B" { float x = 1
    float s.timeSamples = { 1: 2 }
    def "p" {} }
def "C" { float x = 2
    def "r" {} }
""",
    },
    "inherits": {
        "root.usd": """
class "_base" { float a = 1
    float b = 1
    def "kid" { float k = 1 }
    rel r = [</_base/kid>, </Elsewhere>, </_base>] }
class "_derived" ( inherits = </_base> ) { float b = 2
    over "kid" { float k = 2
        float l = 2 } }
def "One" ( inherits = </_derived> ) {}
def "Two" ( prepend inherits = [</_derived>, </_extra>] ) { float a = 7 }
class "_extra" { float b = 5
    float e = 5 }
def "Group" { class "local" { float g = 1 }
    def "Uses" ( inherits = </Group/local> ) {} }
def "Copy" ( references = </Group> ) { over "local" { float g = 2 } }
over "JustOver" ( inherits = </_base> ) {}
def "Missing" ( inherits = </_nowhere> ) {}
""",
    },
    "implied inherits": {
        "root.usd": """
class "_car" { float a = 10
    float b = 10 }
class "_vehicle" { float v = 10
    float w = 10 }
def "X" ( references = @mid.usd@</M> ) { over "in" { float q = 5 }
    over "kid" { float no = 1 } }
over "Y" ( references = @mid.usd@</M/kid> ) {}
""",
        "mid.usd": """
class "_car" { float b = 20
    float c = 20 }
def "M" ( references = @low.usd@</L> ) { float m = 1 }
""",
        "low.usd": """
class "_vehicle" { float v = 1
    float w = 1
    float x = 1 }
class "_car" ( inherits = </_vehicle> ) { float a = 1
    float b = 1
    float c = 1
    float d = 1
    float w = 2 }
def "L" ( inherits = </_car> ) { float d = 2
    class "in" { float q = 1
        float r = 1 }
    def "kid" ( inherits = </L/in> ) { float r = 2 } }
""",
    },
    "specializes": {
        "root.usd": """
def "Base" { float a = 1
    float b = 1
    float c = 1
    float d = 1 }
def "Special" ( specializes = </Base> ) { float b = 2
    float e = 2 }
def "Other" { float c = 3
    float a = 3 }
def "Use" ( references = [</Special>, </Other>] ) { float d = 4 }
def "Twice" ( specializes = </Special> ) { float e = 5 }
def "File" ( references = @b.usd@</R> ) {}
over "S" { float x = 9
    float y = 9 }
""",
        "b.usd": """
def "S" { float x = 1
    float y = 1
    float z = 1
    def "sk" { float s = 1 } }
def "R" ( specializes = </S>
    inherits = </I> ) { float y = 2
    over "sk" { float t = 1 } }
class "I" ( specializes = </S> ) { float z = 3 }
""",
    },
    "variants": {
        "root.usd": """
def "A" (
    variants = { string color = "red"
        string size = "big" }
    prepend variantSets = ["color", "size"]
) {
    float local = 1
    variantSet "color" = {
        "red" { float local = 2
            float v = 1
            def "OnlyRed" {} }
        "blue" ( kind = "component" ) { float v = 2 }
    }
    variantSet "size" = {
        "big" { float v = 3
            float s = 3 }
        "small" { float s = 4 }
    }
}
def "Strong" ( references = </A>
    variants = { string color = "blue" } ) {}
def "Unchosen" ( prepend variantSets = "v" ) { variantSet "v" = { "x" { float n = 1 } } }
def "Unknown" ( prepend variantSets = "v"
    variants = { string v = "nothing" } ) { variantSet "v" = { "x" { float n = 1 } } }
def "FromWeak" ( references = @b.usd@</B> ) {}
def "IntoVariant" ( references = </A/OnlyRed> ) {}
def "Classy" ( inherits = </_says> ) {}
class "_says" ( variants = { string v = "q" }
    prepend variantSets = "v" ) { variantSet "v" = { "q" { float chosen = 1
        def "sub" { rel r = [</_says/sub>, </A>] } } } }
""",
        "b.usd": """
def "B" ( variants = { string v = "one" }
    add variantSets = "v" ) { variantSet "v" = {
        "one" ( references = @c.usd@</C> ) { float one = 1 }
        "two" {} } }
""",
        "c.usd": """
def "C" { float c = 1
    float one = 2
    def "child" {} }
""",
    },
    "nested variants": {
        "root.usd": """
def "A" ( variants = { string outer = "o2" }
    prepend variantSets = "outer" ) {
    variantSet "outer" = {
        "o1" { float o = 1 }
        "o2" ( variants = { string inner = "i1" }
            prepend variantSets = "inner" ) { float o = 2
            variantSet "inner" = {
                "i1" { float i = 1
                    def "deep" ( inherits = </C> ) { float x = 2 } }
                "i2" { float i = 2 }
            }
        }
    }
}
def "B" ( references = </A>
    variants = { string inner = "i2" } ) {}
class "C" { float x = 1
    float y = 1 }
def "InVariant" ( variants = { string v = "a" }
    prepend variantSets = "v" ) { variantSet "v" = { "a" ( inherits = </C> ) { float x = 3 } } }
""",
    },
    "variants of a class across a reference": {
        "root.usd": """
class "_Light" ( variants = { string power = "off" } ) {}
def "Lamp" ( references = @lamp.usd@ ) {}
def "Own" ( references = @lamp.usd@
    variants = { string power = "on" } ) {}
""",
        "lamp.usd": """(
    defaultPrim = "Lamp"
)
class "_Light" {}
def "Lamp" ( inherits = </_Light>
    variants = { string power = "on" }
    prepend variantSets = "power" ) { variantSet "power" = {
        "on" { float intensity = 5 }
        "off" { float intensity = 0 } } }
""",
    },
    "list edits": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
over "A" (
    prepend apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]
    delete references = @c.usd@</C2>
    append references = @c.usd@</C3>
) {
    prepend rel r = </First>
    delete rel r = </Gone>
    append rel r = </Last>
    prepend float x.connect = </P.out>
}
""",
        "weak.usd": """
def "A" (
    apiSchemas = ["GeomModelAPI", "PhysicsCollisionAPI"]
    references = [@c.usd@</C1>, @c.usd@</C2>]
) {
    rel r = [</One>, </Gone>, </First>, </Last>, </Two>]
    float x.connect = [</Q.out>, </P.out>]
}
over "B" ( add apiSchemas = ["SemanticsLabelsAPI:class"] ) { add rel r = [</One>, </Two>]
    reorder rel r = [</Two>] }
def "C" ( delete apiSchemas = ["Nothing"] ) { rel r = None }
""",
        "c.usd": """
def "C1" { float a = 1 }
def "C2" { float a = 2
    float b = 2 }
def "C3" { float a = 3
    float c = 3 }
""",
    },
    "order of children": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
def "A" { reorder nameChildren = ["q", "z", "c"]
    def "z" {}
    def "c" {}
}
def "Ref" ( references = @weak.usd@</A> ) { def "new" {}
    def "b" {} }
""",
        "weak.usd": """
def "A" { reorder nameChildren = ["b", "a"]
    def "a" {}
    def "b" {}
    def "c" {}
    def "d" {} }
""",
    },
    "inactive": {
        "root.usd": """
def "A" ( active = false ) { def "under" {} }
def "B" ( references = </C> ) { over "k" ( active = true ) {} }
def "C" { def "k" ( active = false ) { def "deep" {} }
    def "l" {} }
def "D" ( references = </C> ) {}
""",
    },
    "instances": {
        "root.usd": """
def "World" {
    def "I1" ( instanceable = true
        references = @tree.usd@ ) { double3 xformOp:translate = (1, 0, 0) }
    def "I2" ( instanceable = true
        references = @tree.usd@ ) { double3 xformOp:translate = (2, 0, 0)
        over "trunk" { float ignored = 1 } }
    def "I3" ( instanceable = true
        references = @tree.usd@
        variants = { string season = "winter" } ) {}
    def "Not" ( references = @tree.usd@
        instanceable = false ) { over "trunk" { float kept = 1 } }
    def "Empty" ( instanceable = true ) { def "kid" {} }
    def "Payload" ( instanceable = true
        payload = @tree.usd@ ) {}
    def "Class" ( instanceable = true
        inherits = </_c> ) {}
    def "Class2" ( instanceable = true
        inherits = </_c> ) {}
    def "Shift" ( instanceable = true
        references = @tree.usd@ (offset = 2) ) {}
    def "Own" ( instanceable = true
        prepend variantSets = "v"
        variants = { string v = "a" } ) { def "lost" {}
        variantSet "v" = { "a" { def "kept" {} } } }
}
class "_c" { def "k" { rel out = [</_c>, </_c/k>, </World>] } }
""",
        "tree.usd": """(
    defaultPrim = "Tree"
)
def Xform "Tree" ( variants = { string season = "summer" }
    prepend variantSets = "season" ) {
    rel root = </Tree/trunk>
    def Cylinder "trunk" { rel material:binding = </Tree/Looks/Bark>
        rel up = </Tree> }
    def "Looks" { def Material "Bark" {} }
    variantSet "season" = {
        "summer" { def "Leaves" ( instanceable = true
            references = @leaf.usd@</Leaf> ) {} }
        "winter" {}
    }
}
""",
        "leaf.usd": """
def "Leaf" { def Sphere "geo" { double radius = 1
    rel up = </Leaf> } }
""",
    },
    "instances within a referenced layer": {
        "root.usd": """
def "Row1" ( references = @row.usd@</Row> ) {}
def "Row2" ( references = @row.usd@</Row> ) { over "a" { float local = 1 } }
def "Whole" ( references = @row.usd@</Row>
    instanceable = true ) {}
def "Whole2" ( references = @row.usd@</Row>
    instanceable = true ) {}
""",
        "row.usd": """
def "Row" { def "a" ( references = </Proto>
        instanceable = true ) {}
    def "b" ( references = </Proto>
        instanceable = true ) {}
    def "plain" { rel r = [</Row/a>, </Row/plain>] } }
def "Proto" { def Mesh "m" { int n = 1
    rel p = </Proto/m> } }
""",
    },
    "references in circles": {
        "root.usd": """
def "A" ( references = </B> ) { float a = 1 }
def "B" ( references = </A> ) { float b = 1 }
def "Self" ( references = </Self> ) {}
def "Up" { def "Down" ( references = </Up> ) { float d = 1 } }
def "Into" ( references = </Into/k> ) { def "k" {} }
def "Far" ( references = @other.usd@</F> ) {}
""",
        "other.usd": """
def "F" { def "g" ( references = @root.usd@</Far> ) { float g = 1 } }
""",
    },
    "blocks and samples": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
def "A" { float blocked = None
    float sampled.timeSamples = { 2: 20, 1: 10 }
    float both = 5
    float both.timeSamples = { 1: 6 }
    float holes.timeSamples = { 1: None, 2: 3 }
    float none
    float[] array.timeSamples = { 0: [1, 2, 3], 1: [] }
}
""",
        "weak.usd": """
def "A" { float blocked = 1
    float sampled = 2
    float both = 3
    float none = 4
    float weakSamples.timeSamples = { 3: 1 }
    custom uniform token kind = "x" (
        interpolation = "vertex"
    )
}
""",
    },
    "metadata of several layers": {
        "root.usd": """(
    subLayers = [@weak.usd@]
    upAxis = "Z"
    metersPerUnit = 0.5
)
over "A" ( customData = { int a = 1
        dictionary d = { int x = 1 } }
    kind = "group" ) {}
""",
        "weak.usd": """(
    upAxis = "Y"
    metersPerUnit = 2
)
def Scope "A" ( customData = { int a = 2
        int b = 2
        dictionary d = { int x = 2
            int y = 2 } }
    assetInfo = { string name = "n" }
    kind = "component" ) {}
""",
    },
    "specifiers": {
        "root.usd": """
class "C" { def "k" {} }
over "A" ( inherits = </C> ) {}
def "B" ( inherits = </C> ) {}
over "R" ( references = </C> ) {}
over "S" ( specializes = </C> ) {}
over "O" {}
def "D" { over "o" {}
    class "c" { def "in" {} } }
over "P" ( references = </D> ) {}
over "T" ( references = </Typed> ) {}
def Cube "Typed" {}
""",
    },
    "a class above a reference": {
        "root.usd": """
class "Classes" { class "Car" { float speed = 3
    over "Body" { color3f c = (1, 0, 0) } } }
def "G" { def "c1" ( prepend inherits = </Classes/Car>
    prepend references = @car.usd@ ) {}
    def "c2" ( prepend inherits = </Classes/Car>
    prepend references = @car.usd@
    instanceable = true ) {}
    def "c3" ( prepend inherits = </Classes/Car>
    prepend references = @car.usd@
    instanceable = true ) {} }
""",
        "car.usd": """(
    defaultPrim = "Car"
)
def "Car" { float speed = 1
    def "Body" { color3f c = (0, 0, 0)
        float m = 1 } }
""",
    },
    "a variant that refers": {
        "root.usd": """
def "A" ( prepend variantSets = "lod"
    variants = { string lod = "high" } ) { variantSet "lod" = {
    "high" ( prepend references = @p.usd@</High> ) { over "m" { float o = 1 } }
    "low" ( prepend payload = @p.usd@</Low> ) {} } }
def "B" ( references = </A>
    variants = { string lod = "low" } ) {}
def "C" ( references = </A>
    instanceable = true ) {}
""",
        "p.usd": """
def "High" { float h = 1
    def "m" { float o = 2
        rel r = </High/m> } }
def "Low" { float l = 1 }
""",
    },
    "a reference and an inherit of the parent": {
        "root.usd": """
class "_P" { over "k" { float x = 1
    float y = 1 } }
def "A" ( inherits = </_P> ) { def "k" ( references = </R> ) { } }
def "R" { float x = 2
    float z = 2 }
def "B" ( references = </Q> ) { over "k" ( inherits = </_I> ) {} }
class "_I" { float q = 3
    float i = 3 }
def "Q" { def "k" ( references = </R> ) { float q = 1
    float x = 4 } }
""",
    },
    "variants that the referring layer chooses decide what classes below them say": {
        "root.usd": """
def "G" ( references = @g.usd@</G>
    variants = { string fill = "empty" } ) {}
def "H" ( references = @g.usd@</G> ) {}
def "I" ( references = @middle.usd@</M>
    variants = { string fill = "empty" } ) {}
""",
        "middle.usd": """
def "M" ( references = @g.usd@</G>
    variants = { string fill = "full" } ) {}
""",
        "g.usd": """
def "G" ( variants = { string fill = "full" }
    prepend variantSets = ["fill"] )
{
    class "Classes" { class "Car" { float base = 1 } }
    def "Tile" { def "Car_1" ( inherits = </G/Classes/Car> ) { float own = 1 } }
    variantSet "fill" = {
        "empty" { over "Classes" { over "Car" ( active = false ) { token said = "empty" } } }
        "full" { over "Classes" { over "Car" { token said = "full" } } }
    }
}
""",
    },
    "folders": {
        "root.usd": """
def "A" ( references = @./sub/a.usd@</A> ) {}
def "Escapes" ( references = [@../outside.usd@</X>, @sub/../../outside.usd@</X>] ) {}
""",
        "sub/a.usd": """
def "A" ( references = @../b.usd@</B> ) { float a = 1 }
""",
        "b.usd": """
def "B" { float b = 1 }
""",
    },
    "long chain": {
        "root.usd": "\n".join(
            [f'def "P{i}" ( references = </P{i + 1}> ) {{ float f{i} = {i} }}' for i in range(30)] + ['def "P30" {}']
        ),
    },
    "names beyond ASCII": {
        "root.usd": """
def Xform "Größe" { string größe = "weiß"
    def "子" { rel r = </Größe/子> } }
def "R" ( references = </Größe> ) {}
""",
    },
}
