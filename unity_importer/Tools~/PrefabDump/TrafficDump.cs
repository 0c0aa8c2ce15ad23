using System.Globalization;
using System.IO;
using Garage.Usd.Dump;
using UnityEngine;

namespace Garage.Unity.Dump
{
    /// <summary>Tracks played in a prefab.</summary>
    static class TrafficDump
    {
        /// <summary>All agents at seconds: whether they are there, where their objects stand and look, how their front
        /// wheels stand; and the boxes around plain figures.</summary>
        public static string Play(GameObject prefab, string[] rest)
        {
            GarageTraffic traffic = new GameObject("Player").AddComponent<GarageTraffic>();
            int before = Shown(prefab);
            traffic.Load(File.ReadAllBytes(rest[0]), File.ReadAllBytes(Path.ChangeExtension(rest[0], ".json")), prefab);
            var json = new JsonText();
            json.Open('{');
            json.Key("steps");
            json.Open('[');
            for (int i = 1; i < rest.Length; i++)
            {
                traffic.Seconds = double.Parse(rest[i], CultureInfo.InvariantCulture);
                json.Open('{');
                for (int k = 0; k < traffic.Tracks.AgentCount; k++)
                {
                    json.Key(traffic.Tracks.AgentAt(k).Name);
                    Agent(json, traffic.ObjectOf(traffic.Tracks.AgentAt(k).Name));
                }
                json.Close('}');
            }
            json.Close(']');
            json.Key("shown");
            json.Open('{');
            foreach (Transform place in prefab.GetComponentsInChildren<Transform>(true))
            {
                if (!place.name.StartsWith("Car_", System.StringComparison.Ordinal)
                    && !place.name.StartsWith("NumberPlate_", System.StringComparison.Ordinal))
                {
                    continue;
                }
                json.Key(PathOf(place));
                json.Bool(place.gameObject.activeSelf);
            }
            json.Close('}');
            traffic.Clear();
            json.Key("left");
            json.Number(Shown(prefab) - before);
            json.Close('}');
            return json.ToString();
        }

        static int Shown(GameObject prefab)
        {
            return prefab.GetComponentsInChildren<Transform>().Length;
        }

        static string PathOf(Transform place)
        {
            return place.parent == null ? "" : PathOf(place.parent) + "/" + place.name;
        }

        static void Agent(JsonText json, GameObject agent)
        {
            json.Open('{');
            json.Key("there");
            json.Bool(agent.activeInHierarchy);
            LaneDump.Vector(json, "position", agent.transform.position);
            LaneDump.Vector(json, "forward", agent.transform.forward);
            LaneDump.Vector(json, "up", agent.transform.TransformDirection(Vector3.up));
            json.Key("label");
            json.String(agent.GetComponent<SemanticLabels>().ClassLabel);
            json.Key("instance");
            json.Number(agent.GetComponent<SemanticLabels>().InstanceId);
            Transform wheel = agent.transform.Find("FrontLeftWheel");
            if (wheel != null)
            {
                LaneDump.Vector(json, "axle", wheel.localRotation * new Vector3(1, 0, 0));
                LaneDump.Vector(json, "spoke", wheel.localRotation * Vector3.up);
                LaneDump.Vector(json, "hub", wheel.localPosition);
            }
            foreach (string pose in new[] { "Walking", "Standing" })
            {
                Transform figure = agent.transform.Find(pose);
                if (figure == null) { continue; }
                json.Key(pose.ToLowerInvariant());
                json.Bool(figure.gameObject.activeSelf);
            }
            Collider[] parts = agent.GetComponentsInChildren<Collider>();
            if (parts.Length > 0)
            {
                Bounds all = parts[0].bounds;
                foreach (Collider part in parts) { all.Encapsulate(part.bounds); }
                LaneDump.Vector(json, "low", all.min);
                LaneDump.Vector(json, "high", all.max);
            }
            json.Close('}');
        }
    }
}
