using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Stalls and the lane graph from what garage2usd writes: attributes of stalls' prims, and curves with one
    /// value of each attribute a curve.</summary>
    sealed class LaneGraphBuilder
    {
        readonly Basis basis;
        readonly ImportReport report;
        readonly Dictionary<string, Stall> stalls = new Dictionary<string, Stall>();
        readonly List<KeyValuePair<Stall, Vector3[]>> withoutGraph = new List<KeyValuePair<Stall, Vector3[]>>();
        readonly List<Parked> parked = new List<Parked>();
        readonly List<KeyValuePair<GameObject, SceneNode[]>> graphs = new List<KeyValuePair<GameObject, SceneNode[]>>();

        /// <summary>A stall with the paths of its prim and of its car's.</summary>
        const string Perpendicular = "perpendicular", Standard = "standard";

        struct Parked
        {
            public readonly Stall Stall;
            public readonly string Own, Car;

            public Parked(Stall stall, string own, string car)
            {
                Stall = stall;
                Own = own;
                Car = car;
            }
        }

        public LaneGraphBuilder(Basis basis, ImportReport report)
        {
            this.basis = basis;
            this.report = report;
        }

        /// <summary>Whether a prim describes itself as a stall.</summary>
        public static bool IsStall(SceneNode node)
        {
            return node.Curves == null && node.Prim.Value("garage:stall:id") != null;
        }

        /// <summary>Whether curves are part of a lane graph, and so are not to be drawn.</summary>
        public static bool IsPart(SceneNode node)
        {
            return node.Curves != null
                && (node.Prim.Value("garage:lane:kind") != null || node.Prim.Value("garage:lane:from") != null
                || node.Prim.Value("garage:stall:id") != null);
        }

        /// <summary>Fills a stall from its prim; its corners follow at the end.</summary>
        public void AddStall(Stall stall, SceneNode node)
        {
            UsdPrim prim = node.Prim;
            UsdValue square = prim.Value("garage:stall:square"), corners = prim.Value("garage:stall:corners");
            int[] place = square == null ? new int[0] : square.Ints();
            Vector2Int own = place.Length == 2 ? new Vector2Int(place[0], place[1]) : new Vector2Int(-1, -1);
            string level = LevelOf(prim), number = prim.Text("garage:stall:number", "");
            stall.Set(level + prim.Text("garage:stall:id", ""), number == "" ? "" : level + number,
                prim.Text("garage:stall:type", ""), prim.Text("garage:stall:use", "standard"),
                prim.Text("garage:stall:entryEdge", ""), own, prim.Truth("garage:stall:occupied", false));
            UsdValue angle = prim.Value("garage:stall:angleRad");
            float[] angles = angle == null ? new float[0] : angle.Floats();
            stall.SetShape(prim.Text("garage:stall:kind", Perpendicular), prim.Text("garage:stall:size", Standard),
                angles.Length == 1 ? angles[0] : Mathf.PI / 2);
            IList<string> targets = prim.Targets("garage:stall:car");
            if (stall.IsOccupied && targets.Count > 0) { parked.Add(new Parked(stall, prim.Path, targets[0])); }
            if (stalls.ContainsKey(stall.Id)) { report.Add("stalls have the same id", prim.Path); }
            stalls[stall.Id] = stall;
            float[] numbers = corners == null ? new float[0] : corners.Floats();
            if (numbers.Length != 8) { return; }
            // x and z of the world
            var points = new float[12];
            for (int i = 0; i < 4; i++)
            {
                points[3 * i] = numbers[2 * i];
                points[3 * i + 2] = numbers[2 * i + 1];
            }
            withoutGraph.Add(new KeyValuePair<Stall, Vector3[]>(stall, Points(points)));
        }

        // what ids and numbers of a garage of several levels begin with, "U2/"; stalls' prims have those of their level
        static string LevelOf(UsdPrim prim)
        {
            while (prim != null && prim.Value("garage:level") == null) { prim = prim.Parent; }
            return prim == null ? "" : prim.Text("garage:level", "") + "/";
        }

        /// <summary>Notes the curves below an object that are a lane graph.</summary>
        public void AddGraph(GameObject holder, IEnumerable<SceneNode> children)
        {
            var parts = new SceneNode[3];
            foreach (SceneNode child in children)
            {
                if (!IsPart(child)) { continue; }
                int part = child.Prim.Value("garage:lane:kind") != null ? 0
                    : child.Prim.Value("garage:lane:from") != null ? 1 : 2;
                parts[part] = child;
            }
            if (parts[0] != null || parts[2] != null)
            {
                graphs.Add(new KeyValuePair<GameObject, SceneNode[]>(holder, parts));
            }
        }

        /// <summary>Makes the graphs once all stalls are there; stalls that only a graph knows become objects below
        /// it.</summary>
        public void Finish(Transform root)
        {
            foreach (Parked pair in parked) { pair.Stall.SetCar(Relative(pair.Stall.transform, pair.Own, pair.Car)); }
            foreach (KeyValuePair<GameObject, SceneNode[]> graph in graphs)
            {
                Transform place = graph.Key.transform;
                SceneNode nodes = graph.Value[0], edges = graph.Value[1], outlines = graph.Value[2];
                LaneNode[] all = nodes == null ? new LaneNode[0] : Nodes(nodes);
                Stall[] found = outlines == null ? new Stall[0] : Stalls(outlines, place, all.Length);
                LaneEdge[] ways = edges == null ? new LaneEdge[0] : Edges(edges, all.Length);
                graph.Key.AddComponent<LaneGraph>().Set(all, ways, found);
            }
            foreach (KeyValuePair<Stall, Vector3[]> pair in withoutGraph)
            {
                if (pair.Key.AccessNode < 0) { SetPlace(pair.Key, pair.Value, root, -1); }
            }
        }

        // from the object of one prim to that of another, by their paths
        static Transform Relative(Transform from, string own, string target)
        {
            string[] up = own.Split('/'), down = target.Split('/');
            int common = 0;
            while (common < up.Length && common < down.Length && up[common] == down[common]) { common++; }
            for (int i = up.Length; i > common && from != null; i--) { from = from.parent; }
            return from == null ? null : from.Find(string.Join("/", down, common, down.Length - common));
        }

        // where tiles share prototypes, stalls have no prims that say who they are: the second stall of a tile is
        // called as its car is, "Stall_2" and "Car_2", and "Stall_r03_c07_2" stands on "Row_r03/Tile_r03_c07", there
        // in the part "Parking", which earlier stages lack; "U2/Stall_r03_c07_2" does so below "Levels/U2"
        static void ParkOnTile(Stall stall, Transform garage)
        {
            string[] parts = stall.Id.Split('_');
            if (garage != null && stall.Level != "") { garage = garage.Find("Levels/" + stall.Level); }
            if (garage == null || parts.Length != 4) { return; }
            string tile = "Row_" + parts[1] + "/Tile_" + parts[1] + "_" + parts[2];
            string car = "/Car_" + parts[3];
            Transform found = garage.Find("Tiles/" + tile + "/Parking" + car);
            stall.SetCar(found != null ? found : garage.Find("Tiles/" + tile + car));
        }

        Vector3[] Points(float[] numbers)
        {
            float[] turned = basis.Vectors(numbers, true);
            var points = new Vector3[turned.Length / 3];
            for (int i = 0; i < points.Length; i++)
            {
                points[i] = new Vector3(turned[3 * i], turned[3 * i + 1], turned[3 * i + 2]);
            }
            return points;
        }

        static int[] Ints(SceneNode node, string name, int count)
        {
            UsdValue value = node.Prim.Value(name);
            int[] numbers = value == null ? new int[0] : value.Ints();
            return numbers.Length == count ? numbers : new int[count];
        }

        static float[] Floats(SceneNode node, string name, int count)
        {
            UsdValue value = node.Prim.Value(name);
            float[] numbers = value == null ? new float[0] : value.Floats();
            return numbers.Length == count ? numbers : new float[count];
        }

        static string[] Texts(SceneNode node, string name, int count)
        {
            UsdValue value = node.Prim.Value(name);
            string[] texts = value == null ? new string[0] : value.Texts;
            if (texts.Length == count) { return texts; }
            texts = new string[count];
            for (int i = 0; i < count; i++) { texts[i] = ""; }
            return texts;
        }

        LaneNode[] Nodes(SceneNode curves)
        {
            int count = curves.Curves.VertexCounts.Length, at = 0;
            Vector3[] points = Points(curves.Curves.Points);
            string[] kinds = Texts(curves, "garage:lane:kind", count);
            int[] rows = Ints(curves, "garage:lane:row", count), columns = Ints(curves, "garage:lane:column", count);
            int[] levels = Ints(curves, "garage:lane:level", count);
            float[] widths = Floats(curves, "garage:lane:widths", 2 * count);
            float metres = (float)basis.MetersPerUnit;
            var nodes = new LaneNode[count];
            for (int i = 0; i < count; i++)
            {
                Vector3 sum = Vector3.zero;
                int corners = curves.Curves.VertexCounts[i];
                for (int k = 0; k < corners; k++) { sum += points[at++]; }
                nodes[i] = new LaneNode
                {
                    position = sum / Mathf.Max(1, corners), kind = kinds[i], row = rows[i], column = columns[i],
                    level = levels[i],
                    widths = new Vector2(widths[2 * i] * metres, widths[2 * i + 1] * metres),
                };
            }
            return nodes;
        }

        LaneEdge[] Edges(SceneNode curves, int nodeCount)
        {
            int count = curves.Curves.VertexCounts.Length;
            int[] from = Ints(curves, "garage:lane:from", count), to = Ints(curves, "garage:lane:to", count);
            float[] lengths = Floats(curves, "garage:lane:length", count),
                widths = Floats(curves, "garage:lane:width", count);
            string[] directions = Texts(curves, "garage:lane:direction", count);
            float metres = (float)basis.MetersPerUnit;
            var edges = new List<LaneEdge>(count);
            for (int i = 0; i < count; i++)
            {
                if ((uint)from[i] >= (uint)nodeCount || (uint)to[i] >= (uint)nodeCount)
                {
                    report.Add("edges of the lane graph lead to no node", curves.Prim.Path + "[" + i + "]");
                    continue;
                }
                edges.Add(new LaneEdge
                {
                    from = from[i], to = to[i], length = lengths[i] * metres, width = widths[i] * metres,
                    isOneWay = directions[i] == "forward",
                });
            }
            return edges.ToArray();
        }

        Stall[] Stalls(SceneNode curves, Transform graph, int nodeCount)
        {
            int count = curves.Curves.VertexCounts.Length, at = 0;
            string[] ids = Texts(curves, "garage:stall:id", count),
                numbers = Texts(curves, "garage:stall:number", count),
                types = Texts(curves, "garage:stall:type", count);
            string[] uses = Texts(curves, "garage:stall:use", count),
                sides = Texts(curves, "garage:stall:entryEdge", count);
            int[] rows = Ints(curves, "garage:stall:row", count), columns = Ints(curves, "garage:stall:column", count);
            int[] access = Ints(curves, "garage:stall:accessNode", count),
                occupied = Ints(curves, "garage:stall:occupied", count);
            string[] kinds = Texts(curves, "garage:stall:kind", count),
                sizes = Texts(curves, "garage:stall:size", count);
            float[] angles = Floats(curves, "garage:stall:angleRad", count);
            Vector3[] points = Points(curves.Curves.Points);
            Transform holder = null;
            var found = new List<Stall>(count);
            for (int i = 0; i < count; i++)
            {
                int corners = curves.Curves.VertexCounts[i];
                at += corners;
                if (corners != 4 || (uint)access[i] >= (uint)nodeCount)
                {
                    string place = curves.Prim.Path + "[" + i + "]";
                    report.Add("stalls of the lane graph have no four corners or no node", place);
                    continue;
                }
                var outline = new Vector3[4];
                Array.Copy(points, at - 4, outline, 0, 4);
                Stall stall;
                if (!stalls.TryGetValue(ids[i], out stall))
                {
                    if (holder == null)
                    {
                        holder = new GameObject(curves.Prim.Name).transform;
                        holder.SetParent(graph, false);
                    }
                    stall = Made(ids[i], holder, outline);
                    stall.Set(ids[i], numbers[i], types[i], uses[i], sides[i], new Vector2Int(rows[i], columns[i]),
                        occupied[i] == 1);
                    stall.SetShape(kinds[i] == "" ? Perpendicular : kinds[i], sizes[i] == "" ? Standard : sizes[i],
                        kinds[i] == "" ? Mathf.PI / 2 : angles[i]);
                    stalls.Add(ids[i], stall);
                    if (stall.IsOccupied) { ParkOnTile(stall, graph.parent); }
                }
                SetPlace(stall, outline, graph, access[i]);
                found.Add(stall);
            }
            return found.ToArray();
        }

        // in the middle, from the mouth to the rear
        static Stall Made(string name, Transform holder, Vector3[] outline)
        {
            var place = new GameObject(name);
            place.transform.SetParent(holder, false);
            Vector3 into = outline[2] + outline[3] - outline[0] - outline[1];
            place.transform.localPosition = (outline[0] + outline[1] + outline[2] + outline[3]) * 0.25f;
            if (into.magnitude > 0) { place.transform.localRotation = Quaternion.LookRotation(into, Vector3.up); }
            return place.AddComponent<Stall>();
        }

        static void SetPlace(Stall stall, Vector3[] outline, Transform space, int node)
        {
            Matrix4x4 own = stall.transform.worldToLocalMatrix * space.localToWorldMatrix;
            var corners = new Vector3[4];
            for (int i = 0; i < 4; i++) { corners[i] = own.MultiplyPoint3x4(outline[i]); }
            stall.SetPlace(corners, node);
        }
    }
}
