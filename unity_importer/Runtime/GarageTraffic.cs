using System;
using System.Collections.Generic;
using System.Text.RegularExpressions;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>
    /// Plays tracks of a garage in operation: cars drive, steer, park and leave, people walk. An agent is the object of
    /// its name, where the stage was imported with its traffic layer, else a copy of a model, else a plain figure.
    /// Parked cars of the stage that move are hidden.
    /// </summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/Garage Traffic")]
    public sealed class GarageTraffic : MonoBehaviour
    {
        static readonly Regex CarOfStage = new Regex(@"(^|/)Car_(\d+)$");

        [Tooltip("The garage in the scene; by default this object.")]
        [SerializeField] GameObject garage;

        [Tooltip("The table of tracks, such as run.csv.")]
        [SerializeField] TextAsset table;

        [Tooltip("The file beside it, such as run.json.")]
        [SerializeField] TextAsset heading;

        [Tooltip("A model for cars, vans and trucks, which looks along its z; its origin is on the floor below the "
            + "rear axle. A plain figure of the agent's size where this is empty.")]
        [SerializeField] GameObject vehicleModel;

        [Tooltip("A model for people, which looks along its z; its origin is on the floor.")]
        [SerializeField] GameObject personModel;

        [Tooltip("Metres in Unity for a metre of the stage, as in the importer's settings.")]
        [SerializeField] float scale = 1;

        [Tooltip("Seconds of the tracks in a second.")]
        [SerializeField] float rate = 1;

        [SerializeField] bool loops = true;
        [SerializeField] bool playsOnStart = true;

        readonly List<Body> bodies = new List<Body>();
        readonly List<GameObject> hidden = new List<GameObject>(), made = new List<GameObject>();
        GameObject holder;
        double seconds;

        /// <summary>What was loaded; null before.</summary>
        public TrafficTracks Tracks { get; private set; }

        /// <summary>Whether time passes.</summary>
        public bool IsPlaying { get; set; }

        /// <summary>Seconds of the tracks in a second.</summary>
        public float Rate
        {
            get { return rate; }
            set { rate = value; }
        }

        /// <summary>Second of the tracks that is shown; setting it shows another one.</summary>
        public double Seconds
        {
            get { return seconds; }
            set
            {
                seconds = value;
                foreach (Body body in bodies) { body.Show(seconds, holder.transform); }
            }
        }

        void Start()
        {
            if (Tracks == null && table != null && heading != null) { Load(table.bytes, heading.bytes, garage); }
        }

        void Update()
        {
            if (IsPlaying) { Advance(Time.deltaTime); }
        }

        void OnDestroy()
        {
            Clear();
        }

        /// <summary>Shows the tracks of a table and of the file beside it in a garage, and plays them if so set. Throws
        /// FormatException where they are damaged.</summary>
        public void Load(byte[] tableBytes, byte[] headingBytes, GameObject within)
        {
            TrafficTracks tracks = TrafficTracks.Read(tableBytes, headingBytes);
            Clear();
            Tracks = tracks;
            garage = within == null ? gameObject : within;
            ImportedStage stage = garage.GetComponentInChildren<ImportedStage>();
            Transform root = stage == null ? garage.transform : stage.transform;
            holder = new GameObject("Traffic");
            holder.transform.SetParent(root, false);
            holder.transform.localScale = new Vector3(scale, scale, scale);
            Dictionary<string, GameObject> byPath = ObjectsOf(root);
            int instance = 0;
            foreach (SemanticLabels labels in root.GetComponentsInChildren<SemanticLabels>(true))
            {
                instance = Mathf.Max(instance, labels.InstanceId);
            }
            for (int i = 0; i < tracks.AgentCount; i++)
            {
                TrafficAgent agent = tracks.AgentAt(i);
                Hide(byPath, agent.Prim);
                GameObject own;
                if (!byPath.TryGetValue("/Garage/" + Regex.Replace(agent.Name, "[^A-Za-z0-9_]", "_"), out own))
                {
                    own = Make(agent);
                    own.AddComponent<SemanticLabels>().Set(new Dictionary<string, string[]>
                    {
                        { SemanticLabels.Class, new[] { agent.Kind } },
                    });
                    own.GetComponent<SemanticLabels>().InstanceId = ++instance;
                }
                bodies.Add(new Body(agent, own));
            }
            IsPlaying = playsOnStart;
            Seconds = 0;
        }

        /// <summary>Passes so many seconds, times the rate; from the end over to the beginning where the tracks
        /// loop, else they stop there.</summary>
        public void Advance(float passed)
        {
            if (Tracks == null) { return; }
            double next = seconds + passed * (double)rate;
            double duration = Tracks.Duration;
            if (next > duration || next < 0)
            {
                IsPlaying &= loops;
                next = !loops || duration <= 0 ? Math.Max(0, Math.Min(next, duration))
                    : next - duration * Math.Floor(next / duration);
            }
            Seconds = next;
        }

        /// <summary>The object of an agent; null where there is none.</summary>
        public GameObject ObjectOf(string agent)
        {
            foreach (Body body in bodies)
            {
                if (body.Agent.Name == agent) { return body.Own; }
            }
            return null;
        }

        /// <summary>Removes all agents, and shows the parked cars again.</summary>
        public void Clear()
        {
            foreach (GameObject one in hidden)
            {
                if (one != null) { one.SetActive(true); }
            }
            foreach (GameObject one in made) { Destroy(one); }
            if (holder != null) { Destroy(holder); }
            hidden.Clear();
            made.Clear();
            bodies.Clear();
            Tracks = null;
            IsPlaying = false;
            seconds = 0;
        }

        GameObject Make(TrafficAgent agent)
        {
            GameObject model = agent.Wheelbase > 0 ? vehicleModel : agent.Kind == "person" ? personModel : null;
            GameObject own = model == null ? TrafficFigures.Make(agent) : Instantiate(model, holder.transform);
            own.transform.SetParent(holder.transform, false);
            own.name = agent.Name;
            made.Add(own);
            return own;
        }

        void Hide(Dictionary<string, GameObject> byPath, string prim)
        {
            if (prim.Length == 0) { return; }
            // its number plates have prims of their own
            foreach (string path in new[] { prim, CarOfStage.Replace(prim, "$1NumberPlate_$2") })
            {
                GameObject parked;
                if (!byPath.TryGetValue(path, out parked) || !parked.activeSelf) { continue; }
                parked.SetActive(false);
                hidden.Add(parked);
            }
        }

        static Dictionary<string, GameObject> ObjectsOf(Transform root)
        {
            var known = new Dictionary<Transform, string> { { root, "" } };
            var found = new Dictionary<string, GameObject>();
            foreach (Transform place in root.GetComponentsInChildren<Transform>(true))
            {
                found[LabelTable.PathOf(place, known)] = place.gameObject;
            }
            return found;
        }

        /// <summary>An agent and its object.</summary>
        sealed class Body
        {
            public readonly TrafficAgent Agent;
            public readonly GameObject Own;
            readonly Transform[] wheels = new Transform[TrafficFigures.Wheels.Length];
            readonly Transform walking, standing;

            public Body(TrafficAgent agent, GameObject own)
            {
                Agent = agent;
                Own = own;
                for (int i = 0; i < wheels.Length; i++) { wheels[i] = own.transform.Find(TrafficFigures.Wheels[i]); }
                walking = own.transform.Find("Walking");
                standing = own.transform.Find("Standing");
            }

            public void Show(double seconds, Transform stage)
            {
                TrafficPose pose;
                bool isThere = Agent.At(seconds, out pose);
                if (Own.activeSelf != isThere) { Own.SetActive(isThere); }
                if (!isThere) { return; }
                Vector3 back = pose.Rotation * new Vector3(0, 0, -Agent.RearAxle);
                Own.transform.position = stage.TransformPoint(pose.Position + back);
                Own.transform.rotation = stage.rotation * pose.Rotation;
                for (int i = 0; i < wheels.Length; i++)
                {
                    if (wheels[i] == null) { continue; }
                    // the hub is as high over the floor as the wheel's radius
                    float turn = pose.Rolled / Mathf.Max(wheels[i].localPosition.y, 0.1f) * Mathf.Rad2Deg;
                    Quaternion roll = Quaternion.AngleAxis(turn, new Vector3(1, 0, 0));
                    wheels[i].localRotation = i < 2 ? Quaternion.AngleAxis(pose.Steering, Vector3.up) * roll : roll;
                }
                bool walks = pose.State == "walks";
                // a person who never stands has one figure alone
                if (walking != null) { walking.gameObject.SetActive(walks || standing == null); }
                if (standing != null) { standing.gameObject.SetActive(!walks || walking == null); }
            }
        }
    }
}
