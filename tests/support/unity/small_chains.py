"""Small stages of arcs that follow from others: implied across them, moved, and chosen by expressions."""

LOOK = 'token outputs:surface\ndef Shader "S" { color3f inputs:diffuseColor = (1, 0, 0) }'

CHAINS = {
    "a specialized prim across a reference": {
        "root.usd": """
def "Root" ( references = @second.usd@</Second> ) {
    over "Looks" { over "Base" { over "S" { color3f inputs:diffuseColor = (0, 1, 0) } } }
}
""",
        "second.usd": f"""
def "Second" {{
    def "Looks" {{
        def "Base" {{ {LOOK} }}
        def "Special" ( specializes = </Second/Looks/Base> ) {{ float own = 1 }}
        def "Deeper" ( specializes = </Second/Looks/Special> ) {{ }}
    }}
}}
""",
    },
    "a specialized prim across payloads and variants": {
        "root.usd": """
def "Root" ( payload = @second.usd@</Second>
    variants = { string look = "green" }
) {
    over "Base" { token b = "root" }
}
""",
        "second.usd": """
def "Second" ( prepend variantSets = "look" ) {
    def "Base" { token a = "base"
        token b = "base"
        token c = "base"
        def "Child" { token d = "base" }
    }
    variantSet "look" = {
        "green" {
            def "Special" ( specializes = </Second/Base> ) { token c = "special" }
            over "Base" { token a = "green"
                over "Child" { token d = "green" }
            }
        }
    }
}
""",
    },
    "a class of a class across two references": {
        "root.usd": """
def "Root" ( references = @second.usd@</Second> ) { over "Outer" { token o = "root" }
    over "Inner" { token i = "root" }
}
""",
        "second.usd": """
def "Second" ( references = @third.usd@</Third> ) { over "Inner" { token i = "second"
    token j = "second" }
}
""",
        "third.usd": """
def "Third" {
    class "Outer" { token o = "third" }
    class "Inner" ( inherits = </Third/Outer> ) { token i = "third"
        token j = "third" }
    def "Instance" ( inherits = </Third/Inner> ) { }
    def "Special" ( specializes = </Third/Instance> ) { }
}
""",
    },
    "nested classes that bring children": {
        "root.usd": """
def "Rig" {
    class "Toe" { class "Bone" { token b = "toe" }
        def "Big" ( inherits = </Rig/Toe/Bone> ) { }
    }
    def "Left" ( inherits = </Rig/Toe> ) { over "Bone" { token b = "left"
        def "Tip" { } }
    }
    def "Right" ( references = </Rig/Left> ) { }
}
""",
    },
    "a variant of a specialized prim": {
        "root.usd": """
class "A" ( variants = { string inner = "x" }
    prepend variantSets = "inner"
) { variantSet "inner" = { "x" { token found = "in A" } } }
def "B" ( variants = { string outer = "y" }
    prepend variantSets = "outer"
) { variantSet "outer" = { "y" ( specializes = </A> ) { } } }
class "Chooses" ( variants = { string set = "z" }
    prepend variantSets = "set"
) { variantSet "set" = { "z" { token weak = "chosen" } } }
def "Made" ( specializes = </Chooses>
    prepend variantSets = "set"
) { variantSet "set" = { "z" { token strong = "made" } } }
def "Middle" ( specializes = </Made> ) { }
def "End" ( specializes = </Middle> ) { }
""",
    },
    "a variant selected by a variant of what is weaker": {
        "root.usd": """
class "Kind" ( add variantSets = ["chooser", "kind"] ) {
    variantSet "chooser" = { "cube" ( variants = { string kind = "cube" } ) { }
        "ball" ( variants = { string kind = "ball" } ) { } }
}
def "Bob" ( inherits = </Kind>
    variants = { string chooser = "cube" }
    prepend variantSets = "kind"
) { variantSet "kind" = { "cube" { def "geom" { token g = "cube" } }
    "ball" { def "geom" { token g = "ball" } } } }
def "Shape" ( references = </Bob/geom> ) { }
""",
    },
    "moved prims": {
        "root.usd": """(
    relocates = { </Char/Rig/Arm>: </Char/Anim/LeftArm>, </Char/Rig/Gone>: <>, </Char/Rig/Old>: </Char/Rig/New> }
)
def "Char" ( references = @rig.usd@</Rig> ) {
    over "Anim" { over "LeftArm" { token own = "char" } }
    over "Rig" { over "New" { token renamed = "yes" } }
    rel moved = </Char/Anim/LeftArm/Hand>
}
def "Twice" ( references = </Char> ) { }
""",
        "rig.usd": """
def "Rig" {
    def "Anim" { }
    def "Rig" {
        class "Limb" { token limb = "class"
            def "Hand" { } }
        def "Arm" ( inherits = </Rig/Rig/Limb> ) { token arm = "rig"
            rel hand = </Rig/Rig/Arm/Hand>
            token t.connect = </Rig/Rig/Arm.arm>
        }
        def "Gone" { token g = "gone" }
        def "Old" { token o = "old" }
        def "Uses" { rel arm = </Rig/Rig/Arm>
            rel old = </Rig/Rig/Old/Below> }
    }
}
""",
    },
    "moved prims of variants and of those who move again": {
        "root.usd": """(
    relocates = { </Model/Anim/Tail>: </Model/Tail> }
)
def "Model" ( payload = @inner.usd@</Inner>
    variants = { string tail = "long" }
) { over "Tail" { token where = "root" } }
""",
        "inner.usd": """(
    relocates = { </Inner/Rig/Tail>: </Inner/Anim/Tail> }
)
def "Inner" ( prepend variantSets = "tail" ) {
    def "Anim" { }
    def "Rig" { }
    variantSet "tail" = { "long" { over "Rig" { def "Tail" ( specializes = </Bone> ) { int length = 9
        def "Tip" { } } } }
        "short" { over "Rig" { def "Tail" { int length = 1 } } } }
}
class "Bone" { token bone = "inner" }
""",
    },
    "variables": {
        "root.usd": """(
    expressionVariables = { string WHICH = "low"
        string FILE = "`'${WHICH}_model'`"
        int LEVEL = 2
        bool FANCY = true
    }
    subLayers = [@`"${WHICH}_sub.usd"`@]
)
def "A" ( references = @`"./${FILE}.usd"`@</Model> ) { }
def "B" ( references = @`if(and(${FANCY}, geq(${LEVEL}, 2)), "low_model.usd", "none.usd")`@</Model> ) { }
def "C" ( variants = { string v = "`at(['a', 'b', 'c'], -1)`" }
    prepend variantSets = "v"
) { variantSet "v" = { "a" { int x = 1 }
    "c" { int x = 3 } } }
def "D" ( payload = @`if(contains(${WHICH}, "ow"), "low_model.usd")`@</Model> ) { }
def "E" ( references = @`if(not(${FANCY}), "low_model.usd")`@</Model> ) { }
""",
        "low_sub.usd": """
def "FromSub" ( references = @`"${WHICH}_model.usd"`@</Model> ) { }
""",
        "low_model.usd": """(
    expressionVariables = { string WHICH = "high"
        string OWN = "low_part" }
)
def "Model" ( references = [@`"${WHICH}_part.usd"`@</Part>, @`"${OWN}.usd"`@</Other>] ) { int model = 1 }
""",
        "low_part.usd": 'def "Part" { int low = 1 }\ndef "Other" { int other = 1 }',
        "high_part.usd": 'def "Part" { int high = 1 }',
    },
    "the default prim of the layer itself": {
        "root.usd": """(
    defaultPrim = "World"
)
def "World" { int w = 1 }
def "Other" ( references = <> ) { }
def "Third" ( payload = [<>, </Other>] ) { }
def "Fourth" ( references = @inner.usd@ ) { }
""",
        "inner.usd": """(
    defaultPrim = "Inner"
)
def "Inner" { def "Below" ( references = </Class> ) { } }
class "Class" { int c = 1 }
""",
    },
    "samples before what is without time": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
def "A" { double both = 0
    double both.timeSamples = { 0: 5, 10: 9 }
    double strong = 1
    double blocked.timeSamples = { 0: None, 1: 3 }
    double later = 2
}
""",
        "weak.usd": """
def "A" { double strong.timeSamples = { 0: 7 }
    double blocked = 4
    double weak.timeSamples = { 2: 8 }
    double later.timeSamples = { 0: 6 }
    double3 xformOp:translate = (0, 0, 0)
    double3 xformOp:translate.timeSamples = { 0: (0, 5, 0), 10: (0, 9, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
""",
    },
}
