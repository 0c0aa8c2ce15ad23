"""Small stages of kinds that others make: file names and texts, the first file the root, and what is warned of."""

OF_MANY_FOLDERS = {
    "scenes/shots/shot.usd": """(
    subLayers = [@../../common/axis.usd@, @./../look.usd@]
)
def "Chair" ( references = @../../assets/chair/chair.usd@ ) {}
def "Lamp" ( payload = @../../assets/./lamp//../lamp/lamp.usd@</Lamp> ) {}
def "Set" ( references = @../set.usd@ ) { asset picture = @../../textures/wood.png@ }
""",
    "common/axis.usd": """
def "Axis" { float length = 1 }
""",
    "scenes/look.usd": """
over "Chair" { token look = "old" }
""",
    "scenes/set.usd": """( defaultPrim = "Set" )
def "Set" ( references = @shots/../../assets/lamp/lamp.usd@</Lamp> ) { float width = 4 }
""",
    "assets/chair/chair.usd": """( defaultPrim = "Chair" )
def "Chair" { float height = 0.9
    def "Cloth" ( references = @../../materials/cloth.usd@</Cloth> ) {}
    asset picture = @../../textures/cloth.png@
}
""",
    "assets/lamp/lamp.usd": """
def "Lamp" ( references = @../chair/../../materials/cloth.usd@</Cloth> ) { float watts = 8 }
""",
    "materials/cloth.usd": """
def "Cloth" { color3f color = (1, 0, 0) }
""",
}

OF_OTHER_FORMATS = {
    "scene.usd": """(
    subLayers = [@settings.json@, @axis.usd@]
)
def "Ball" ( references = [@ball.mtlx@</MaterialX>, @axis.usd@</Axis>] ) { float radius = 2 }
def "Cat" ( payload = @cat.obj@ ) { float weight = 4 }
def "Dog" ( references = @DOG@ ) { float weight = 9 }
""",
    "axis.usd": """
def "Axis" { float length = 1 }
""",
    "settings.json": '{"a": 1}',
    "ball.mtlx": '<?xml version="1.0"?>\n<materialx version="1.38">\n</materialx>\n',
    "cat.obj": "v 0 0 0\n",
    "DOG": "#usda 1.0\n",
}

FOREIGN = {
    "folders beside each other": (OF_MANY_FOLDERS, []),
    "formats that are not read": (
        OF_OTHER_FORMATS,
        [
            "scene.usd: @settings.json@ is of a format that is not read",
            "scene.usd: @ball.mtlx@ is of a format that is not read",
            "scene.usd: @cat.obj@ is of a format that is not read",
            "scene.usd: @DOG@ is of a format that is not read",
        ],
    ),
    "types that are left open": (
        {
            "root.usd": """
def __AnyType__ "Over" ( references = </Mesh> ) {}
def "Under" ( references = </Over> ) {}
def Mesh "Mesh" ( references = </Open> ) {}
def __AnyType__ "Open" {}
""",
        },
        [],
    ),
    "types that are not known": (
        {
            "root.usd": """
def "A" { uint2 pair = (0, 1)
    uint2[] pairs = [(0, 1), (2, 3)]
    uint2 declared
    float known = 1
}
""",
        },
        [
            "root.usd: values of the type 'uint2', which is not known, are left out",
            "root.usd: values of the type 'uint2[]', which is not known, are left out",
        ],
    ),
}
"""Stages that are equal to those of ``pxr``, with the warnings of each."""

NAMED = {
    "value clips": (
        {
            "root.usd": """
def "A" ( clips = { dictionary default = { asset[] assetPaths = [@clip.usd@]
    asset manifestAssetPath = @clip.usd@
    string primPath = "/A"
    double2[] active = [(0, 0)]
    double2[] times = [(0, 0), (10, 10)]
    } }
) { double y
    float kept = 1
}
""",
            "clip.usd": """
over "A" { double y.timeSamples = { 0: 5, 10: 9 } }
""",
        },
        "</A>: value clips are left out: attributes are as they are without them",
    ),
    "path expressions": (
        {
            "root.usd": """
def "A" ( references = </B> ) { float kept = 1 }
def "B" { pathExpression e = ".//x" }
""",
        },
        "</A.e>: the path expression '/B//x' is as its layer says it",
    ),
    "splines": (
        {
            "root.usd": """
def "A" { double x.spline = {
        bezier,
        1: 8; post held,
        5: 10,
    }
    float kept = 3
}
""",
        },
        "root.usd: the spline of 'x' is left out",
    ),
    "edits of arrays": (
        {
            "root.usd": """
def "A" ( references = </B> ) { int[] a = edit [append 3; prepend 4; write 5 to [0]]
    string[] b = edit [append "]"; append "x"]
    float kept = 1
}
def "B" { int[] a = [1, 2]
    string[] b = ["y"]
}
""",
        },
        "root.usd: edits of arrays are left out",
    ),
    "time that runs backwards": (
        {
            "root.usd": """(
    subLayers = [@inner.usd@]
    timeCodesPerSecond = -1
)
""",
            "inner.usd": """
def "A" { float x.timeSamples = { 0: 1, 5: 2 } }
""",
        },
        "root.usd: timeCodesPerSecond of -1 is taken for 24",
    ),
}
"""Stages that differ from those of ``pxr``, with the warning that says why."""
