"""Small stages, one for each rule of places and materials."""

BOUND = 'prepend apiSchemas = ["MaterialBindingAPI"]'


def bound(name: str, *targets: str) -> str:
    body = "\n    ".join(targets)
    return f'def Mesh "{name}" ( {BOUND} ) {{ {body} }}\n'


SCENES = {
    "bindings of materials": {
        "root.usd": f"""
def Material "M" {{}}
def Material "N" {{}}
def Scope "S" {{}}
def "P" ( {BOUND} ) {{ rel material:binding = </M>
    {bound("Missing", "rel material:binding = </Nothing>")}
    {bound("NoMaterial", "rel material:binding = </S>")}
    {bound("PreviewMissing", "rel material:binding:preview = </Nothing>", "rel material:binding = </N>")}
    {bound("Preview", "rel material:binding:preview = </N>")}
    {bound("Full", "rel material:binding:full = </N>")}
    {bound("Physics", "rel material:binding:physics = </N>")}
    {bound("Two", "rel material:binding = [</N>, </M>]")}
    {bound("Empty", "rel material:binding = []")}
    {bound("Cleared", "rel material:binding = None")}
    {bound("Property", "rel material:binding = </N.x>")}
    def "Between" {{ {bound("Below", "float x = 1")} }} }}
def "Preview" ( {BOUND} ) {{ rel material:binding:preview = </M>
    {bound("General", "rel material:binding = </N>")} }}
def "Strong" ( {BOUND} ) {{ rel material:binding = </M> ( bindMaterialAs = "strongerThanDescendants" )
    rel material:binding:physics = </N>
    {bound("General", "rel material:binding = </N>")}
    {bound("Special", "rel material:binding:preview = </N>", "rel material:binding:physics = </M>")}
    def "Deeper" ( {BOUND} ) {{ rel material:binding = </N> ( bindMaterialAs = "strongerThanDescendants" )
        {bound("X", "rel material:binding = </S>")} }} }}
def "StrongPreview" ( {BOUND} ) {{ rel material:binding:preview = </M> ( bindMaterialAs = "strongerThanDescendants" )
    {bound("General", "rel material:binding = </N> ( bindMaterialAs = 'strongerThanDescendants' )")} }}
def "Weak" ( {BOUND} ) {{ rel material:binding = </M> ( bindMaterialAs = "weakerThanDescendants" )
    {bound("General", "rel material:binding = </N>")} }}
def "Referenced" ( references = </P> ) {{ over "Preview" {{ rel material:binding:preview = </M> }} }}
def "Instance" ( instanceable = true
    references = </P> ) {{}}
""",
    },
    "places": {
        "root.usd": """(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Turned" { float3 xformOp:rotateXYZ = (10, 20, 30)
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    def "NoType" { double3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Xform "Below" { float xformOp:rotateY = 90
            uniform token[] xformOpOrder = ["xformOp:rotateY"] } }
    def Scope "Scope" { double3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Xform "Below" { half3 xformOp:scale = (0.1, 2, 3)
            uniform token[] xformOpOrder = ["xformOp:scale"] } }
    def Xform "Operations" { float3 xformOp:translate = (1, 2, 3)
        half3 xformOp:scale = (0.1, 2, 3)
        quatd xformOp:orient = (0.5, -0.5, 0.5, 0.5)
        double xformOp:rotateX:a = 30
        matrix4d xformOp:transform = ( (0, 1, 0, 0), (1, 0, 0, 0), (0, 0, 2, 0), (5, 6, 7, 1) )
        uniform token[] xformOpOrder = ["xformOp:translate", "!invert!xformOp:rotateX:a", "xformOp:scale",
            "xformOp:orient", "xformOp:transform", "!invert!xformOp:translate"] }
    def Xform "Reset" { float3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate", "!resetXformStack!", "xformOp:translate"]
        def Xform "Below" { double xformOp:translateX = 5
            uniform token[] xformOpOrder = ["xformOp:translateX"] } }
    def Xform "Unused" { float3 xformOp:translate = (1, 2, 3) }
    def Xform "Sampled" { double3 xformOp:translate.timeSamples = { 1: (1, 2, 3), 2: (3, 4, 5) }
        float xformOp:rotateZ = 45
        float xformOp:rotateZ.timeSamples = { 1: 3, 2: 50 }
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"] }
    def Xform "Blocked" { double3 xformOp:translate = None
        float xformOp:rotateZ = 45
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"] }
}
def "Copy" ( references = </Turned> ) { over "Reset" { float3 xformOp:translate = (7, 7, 7) }
    over "Operations" { float3 xformOp:translate = None } }
def "Instance" ( references = </Turned>
    instanceable = true ) { double3 xformOp:translate = (9, 9, 9) }
""",
    },
    "units and axis of the root alone": {
        "root.usd": """(
    subLayers = [@weak.usd@]
)
def Xform "A" ( references = @b.usd@</B> ) {}
""",
        "weak.usd": """(
    metersPerUnit = 2
    upAxis = "Z"
)
""",
        "b.usd": """(
    metersPerUnit = 3
    upAxis = "Z"
)
def Xform "B" { double3 xformOp:translate = (1, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"] }
""",
    },
    "a material and what refers to it": {
        "root.usd": """
def Scope "Looks" { def Material "Paint" ( references = @paint.usd@</Paint> ) {
    color3f inputs:tint = (1, 0, 0) }
    def Material "Darker" ( specializes = </Looks/Paint> ) { color3f inputs:tint = (0.1, 0, 0) } }
def "Car" ( instanceable = true
    references = @paint.usd@</Car> ) {}
""",
        "paint.usd": """
def Material "Paint" { color3f inputs:tint = (0, 0, 0)
    token outputs:surface.connect = </Paint/S.outputs:surface>
    def Shader "S" { uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </Paint.inputs:tint>
        asset inputs:file = @textures/a.png@ ( colorSpace = "sRGB" )
        token outputs:surface } }
def Xform "Car" { def Mesh "Body" ( prepend apiSchemas = ["MaterialBindingAPI"] ) {
        rel material:binding = </Car/Looks/Red> }
    def Scope "Looks" { def Material "Red" ( references = </Paint> ) {} } }
""",
    },
}
