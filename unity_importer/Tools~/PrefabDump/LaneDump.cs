using System.Collections.Generic;
using System.Globalization;
using Garage.Unity.Samples;
using Garage.Usd.Dump;
using UnityEngine;

namespace Garage.Unity.Dump
{
    /// <summary>The lane graph of a prefab, and its answers.</summary>
    static class LaneDump
    {
        public static void Write(JsonText json, LaneGraph graph)
        {
            json.Open('{');
            json.Key("nodes");
            json.Open('[');
            for (int i = 0; i < graph.NodeCount; i++)
            {
                LaneNode node = graph.Node(i);
                json.Open('{');
                Vector(json, "position", graph.PositionOf(i));
                json.Key("kind");
                json.String(node.kind);
                json.Key("square");
                json.Open('[');
                json.Number(node.row);
                json.Number(node.column);
                json.Close(']');
                Number(json, "level", node.level);
                json.Key("widths");
                json.Open('[');
                json.Number(node.widths.x);
                json.Number(node.widths.y);
                json.Close(']');
                json.Close('}');
            }
            json.Close(']');
            json.Key("edges");
            json.Open('[');
            for (int i = 0; i < graph.EdgeCount; i++)
            {
                LaneEdge edge = graph.Edge(i);
                json.Open('{');
                Number(json, "from", edge.from);
                Number(json, "to", edge.to);
                Number(json, "length", edge.length);
                Number(json, "width", edge.width);
                json.Key("isOneWay");
                json.Bool(edge.isOneWay);
                json.Close('}');
            }
            json.Close(']');
            json.Key("stalls");
            json.Open('[');
            for (int i = 0; i < graph.StallCount; i++) { json.String(graph.StallAt(i).Id); }
            json.Close(']');
            json.Close('}');
        }

        public static void Vector(JsonText json, string key, Vector3 vector)
        {
            json.Key(key);
            json.Open('[');
            json.Number(vector.x);
            json.Number(vector.y);
            json.Number(vector.z);
            json.Close(']');
        }

        public static void Number(JsonText json, string key, double value)
        {
            json.Key(key);
            json.Number(value);
        }

        /// <summary>Ways between pairs of stalls, told by id or painted number.</summary>
        public static string Ways(GameObject prefab, string[] ends)
        {
            LaneGraph graph = prefab.GetComponentsInChildren<LaneGraph>(true)[0];
            var json = new JsonText();
            json.Open('[');
            for (int i = 0; i + 1 < ends.Length; i += 2)
            {
                Stall from = graph.FindStall(ends[i]), to = graph.FindStall(ends[i + 1]);
                List<int> nodes = graph.FindPath(from.AccessNode, to.AccessNode);
                LanePath path = graph.FindPath(from, to);
                json.Open('{');
                json.Key("from");
                json.String(from.Id);
                json.Key("to");
                json.String(to.Id);
                if (nodes != null)
                {
                    json.Key("nodes");
                    json.Open('[');
                    foreach (int node in nodes) { json.Number(node); }
                    json.Close(']');
                    Number(json, "length", path.Length);
                    Vector3 direction;
                    Vector(json, "start", path.At(0, out direction));
                    Vector(json, "startDirection", direction);
                    Vector(json, "middle", path.At(path.Length / 2, out direction));
                    Vector(json, "end", path.At(path.Length + 1, out direction));
                }
                json.Close('}');
            }
            json.Close(']');
            return json.ToString();
        }

        /// <summary>The nearest lane of each place.</summary>
        public static string Near(GameObject prefab, string[] numbers)
        {
            LaneGraph graph = prefab.GetComponentsInChildren<LaneGraph>(true)[0];
            var json = new JsonText();
            json.Open('[');
            for (int i = 0; i + 2 < numbers.Length; i += 3)
            {
                LanePoint point;
                graph.NearestLane(new Vector3(Parsed(numbers[i]), Parsed(numbers[i + 1]), Parsed(numbers[i + 2])),
                    out point);
                json.Open('{');
                Number(json, "edge", point.Edge);
                Number(json, "fraction", point.Fraction);
                Number(json, "distance", point.Distance);
                Vector(json, "position", point.Position);
                json.Close('}');
            }
            json.Close(']');
            return json.ToString();
        }

        /// <summary>Where the sample drives, every tenth of a second.</summary>
        public static string Drive(GameObject prefab, int count)
        {
            DriveAlongLanes driver = new GameObject("Eye").AddComponent<DriveAlongLanes>();
            driver.SetOut(prefab);
            var json = new JsonText();
            json.Open('[');
            for (int i = 0; i < count; i++)
            {
                json.Open('{');
                Vector(json, "position", driver.transform.position);
                Vector(json, "forward", driver.transform.forward);
                Number(json, "length", driver.Path.Length);
                json.Close('}');
                driver.Drive(0.1f);
            }
            json.Close(']');
            return json.ToString();
        }

        static float Parsed(string number)
        {
            return float.Parse(number, CultureInfo.InvariantCulture);
        }
    }
}
