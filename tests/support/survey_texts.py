"""A small survey in each format, by its suffix: stalls given in every way that the format has, and lanes."""

import json

GEOJSON = {
    "type": "FeatureCollection",
    "coordinates": "metres",
    "features": [
        {
            "type": "Feature",
            "id": 3,
            "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [2.5, 0], [2.5, 5], [0, 5], [0, 0]]]},
            "properties": {"kind": "stall", "use": "ev"},
        },
        {
            "type": "Feature",
            "geometry": {"type": "LineString", "coordinates": [[0, 8], [20, 8]]},
            "properties": {"kind": "lane", "width": 5, "oneway": "yes"},
        },
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [3, 3]}, "properties": {"kind": "column"}},
    ],
}
TEXTS = {
    "csv": "id,x,y,width_m,length_m,heading_deg,use\na,0,0,2.5,5,90,ev\nb,3,0,2.5,5,90,\n",
    "toml": """outline = [[0, 0], [40, 0], [40, 30], [0, 30]]
[[stalls]]
corners = [[1, 1], [1, 6], [3.5, 6], [3.5, 1]]
mouth = 1
[[runs]]
first = [2, 6]
last = [37, 6]
side = "left"
kind = "angled"
angle_deg = 60
width_m = 2.5
[[lanes]]
points = [[0, 8], [30, 8]]
""",
    "geojson": json.dumps(GEOJSON),
    "osm": """<osm version="0.6">
<node id="1" lat="49.00000" lon="9.00000"/><node id="2" lat="49.00000" lon="9.00003"/>
<node id="3" lat="49.00005" lon="9.00003"/><node id="4" lat="49.00005" lon="9.00000"/>
<node id="5" lat="49.00010" lon="9.00000"/><node id="6" lat="49.00010" lon="9.00020"/>
<way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="amenity" v="parking_space"/></way>
<way id="2"><nd ref="5"/><nd ref="6"/><tag k="highway" v="service"/><tag k="service" v="parking_aisle"/></way>
<way id="3"><nd ref="4"/><nd ref="3"/></way>
<way id="4"><nd ref="1"/><nd ref="3"/><tag k="type" v="parking_space"/><tag k="width" v="2.5"/></way>
<relation id="1"><member type="way" ref="2" role="left"/><member type="way" ref="3" role="right"/>
<tag k="type" v="lanelet"/></relation>
</osm>""",
    "xodr": """<OpenDRIVE><road id="1" length="40"><planView>
<geometry s="0" x="0" y="0" hdg="0" length="20"><spiral curvStart="0" curvEnd="0.05"/></geometry>
<geometry s="20" x="19" y="3" hdg="0.5" length="20">
<paramPoly3 aU="0" bU="20" cU="1" dU="0" aV="0" bV="0" cV="2" dV="1"/></geometry>
</planView><lanes><laneOffset s="0" a="1" b="0" c="0" d="0"/><laneSection s="0"><left><lane id="1" type="driving">
<width sOffset="0" a="3" b="0.1" c="0" d="0"/></lane></left></laneSection></lanes><objects>
<object id="1" type="parkingSpace" s="5" t="9" hdg="0.2" width="2.5" length="5">
<repeat s="0" length="30" distance="3" tStart="9" tEnd="8"/></object>
<object id="2" type="parkingSpace" s="5" t="-9"><outlines><outline>
<cornerRoad s="5" t="-9"/><cornerRoad s="8" t="-9"/><cornerRoad s="8" t="-4"/><cornerRoad s="5" t="-4"/>
</outline></outlines></object>
</objects></road></OpenDRIVE>""",
}  # fmt: skip
