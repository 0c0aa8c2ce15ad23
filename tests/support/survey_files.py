"""A small survey in each format that a program writes, by its suffix: a drawing, a building model and a venue."""

import io
import json
import zipfile

W_M, L_M = 2.5, 5.0
COUNT = 4
_IFC = """ISO-10303-21;
HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('','',(''),(''),'','','');FILE_SCHEMA(('IFC4'));ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#2=IFCUNITASSIGNMENT((#1));
#3=IFCCARTESIANPOINT((0.,0.,0.));
#4=IFCAXIS2PLACEMENT3D(#3,$,$);
#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#4,$);
#6=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',$,'P',$,$,$,$,(#5),#2);
#7=IFCLOCALPLACEMENT($,#4);
#8=IFCSITE('3rNg3N55f4CxBGVIOBbC1v',$,'S',$,$,#7,$,$,.ELEMENT.,$,$,$,$,$);
#9=IFCBUILDING('1hOSvn6df7F8_7GcBWlR72',$,'B',$,$,#7,$,$,.ELEMENT.,$,$,$);
#10=IFCBUILDINGSTOREY('2FCZDorxHDT8NI01kdXi8P',$,'UG1',$,$,#7,$,$,.ELEMENT.,-3.2);
#11=IFCRELAGGREGATES('0DWgwt6o1FOx7466fPk$jl',$,$,$,#6,(#8));
#12=IFCRELAGGREGATES('3cUkl32yn9qRSPvBJVyWw5',$,$,$,#8,(#9));
#13=IFCRELAGGREGATES('2O2Fr$t4X7Zf8NOew3FLOH',$,$,$,#9,(#10));
#14=IFCDIRECTION((0.,0.,1.));
#15=IFCCARTESIANPOINT((0.,0.));
#16=IFCAXIS2PLACEMENT2D(#15,$);
#17=IFCRECTANGLEPROFILEDEF(.AREA.,$,#16,2.5,5.);
#18=IFCEXTRUDEDAREASOLID(#17,#4,#14,2.4);
#19=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#18));
#20=IFCPRODUCTDEFINITIONSHAPE($,$,(#19));
%s
ENDSEC;
END-ISO-10303-21;
"""


def drawing() -> bytes:
    """A DXF drawing of a row of stalls with numbers, a lane and a column, on layers that say so."""
    import ezdxf

    document = ezdxf.new(units=6)
    space = document.modelspace()
    for number in range(COUNT):
        x = number * W_M
        corners = [(x, 0), (x + W_M, 0), (x + W_M, L_M), (x, L_M)]
        space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "STALLS"})
        space.add_text(str(number + 1), dxfattribs={"layer": "STALLS", "insert": (x + 1, 2)})
    space.add_line((-5, 8), (20, 8), dxfattribs={"layer": "LANES"})
    space.add_circle((0, 5.3), 0.3, dxfattribs={"layer": "COLUMNS"})
    text = io.StringIO()
    document.write(text)
    return text.getvalue().encode()


def model() -> bytes:
    """An IFC model of a storey with a row of spaces named as stalls."""
    lines = []
    for number in range(COUNT):
        at = 100 + 10 * number
        lines += [
            f"#{at}=IFCCARTESIANPOINT(({number * W_M + 1.25:g},2.5,0.));",
            f"#{at + 1}=IFCAXIS2PLACEMENT3D(#{at},$,$);",
            f"#{at + 2}=IFCLOCALPLACEMENT(#7,#{at + 1});",
            (
                f"#{at + 3}=IFCSPACE('0000000000000000000{number:03}',$,'Parking {number + 1}',$,$,#{at + 2},#20,$,"
                ".ELEMENT.,.PARKING.,$);"
            ),
        ]
    spaces = ",".join(f"#{103 + 10 * number}" for number in range(COUNT))
    lines.append(f"#99=IFCRELAGGREGATES('0MzFTAFZf9MACaK8g3Ldoc',$,$,$,#10,({spaces}));")
    return (_IFC % "\n".join(lines)).encode()


def venue() -> bytes:
    """An archive in IMDF of a level with a row of units of the category parking."""

    def area(kind, name, x, width, length, /, **properties):
        ring = [(x, 0), (x + width, 0), (x + width, length), (x, length), (x, 0)]
        degrees = [[9 + east / 73_000, 49 + north / 111_200] for east, north in ring]
        geometry = {"type": "Polygon", "coordinates": [degrees]}
        return {"type": "Feature", "id": name, "feature_type": kind, "geometry": geometry, "properties": properties}

    level = area("level", "l", -2, 20, 15, ordinal=0, short_name={"en": "P1"}, category="parking")
    units = [
        area("unit", f"u{number}", number * W_M, W_M, L_M, category="parking", level_id="l", name={"en": str(number)})
        for number in range(COUNT)
    ]
    files = {"manifest.json": {"version": "1.0.0"}}
    for name, features in (("level", [level]), ("unit", units)):
        files[f"{name}.geojson"] = {"type": "FeatureCollection", "features": features}
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, document in files.items():
            archive.writestr(zipfile.ZipInfo(name), json.dumps(document))
    return data.getvalue()


def program_files() -> dict[str, list[bytes]]:
    """The files by suffix."""
    return {".dxf": [drawing()], ".ifc": [model()], ".zip": [venue()]}
