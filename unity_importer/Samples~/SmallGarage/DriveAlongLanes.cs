using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity.Samples
{
    /// <summary>
    /// Drives its object, such as a camera, from an entrance to stalls drawn at random, one after the other, and out of
    /// an exit; then all over
    /// again. Give it the garage in the scene.
    /// </summary>
    [AddComponentMenu("Garage/Samples/Drive Along Lanes")]
    public sealed class DriveAlongLanes : MonoBehaviour
    {
        [Tooltip("A garage in the scene.")]
        [SerializeField] GameObject garage;

        [SerializeField] float metresPerSecond = 4;

        [Tooltip("Metres over the floor.")]
        [SerializeField] float eyeHeight = 1.4f;

        [Tooltip("Metres that the object looks ahead, which rounds its corners.")]
        [SerializeField] float lookAhead = 3;

        [SerializeField] int stallsARound = 3;
        [SerializeField] int seed = 1;

        LanePath path;
        float driven;
        System.Random random;

        /// <summary>The way of this round; null before the first one.</summary>
        public LanePath Path
        {
            get { return path; }
        }

        void Start()
        {
            random = new System.Random(seed);
            SetOut(garage);
        }

        /// <summary>Begins a round through a garage. Throws MissingReferenceException where that has no lane
        /// graph.</summary>
        public void SetOut(GameObject through)
        {
            garage = through;
            random = random ?? new System.Random(seed);
            LaneGraph graph = garage == null ? null : garage.GetComponentInChildren<LaneGraph>();
            if (graph == null)
            {
                throw new MissingReferenceException("Give DriveAlongLanes a garage with a lane graph.");
            }
            path = Round(graph);
            driven = 0;
            Place();
        }

        // from an entrance by way of stalls to an exit
        LanePath Round(LaneGraph graph)
        {
            List<int> entrances = graph.NodesOfKind("entrance"), exits = graph.NodesOfKind("exit");
            var points = new List<Vector3>();
            int at = entrances[random.Next(entrances.Count)];
            for (int i = 0; i < stallsARound; i++)
            {
                Stall stall = graph.StallAt(random.Next(graph.StallCount));
                if (!stall.TakesCars || !Follow(graph, at, stall.AccessNode, points)) { continue; }
                points.Add(stall.Mouth);
                at = stall.AccessNode;
            }
            Follow(graph, at, exits[random.Next(exits.Count)], points);
            return new LanePath(points);
        }

        static bool Follow(LaneGraph graph, int from, int to, List<Vector3> points)
        {
            List<int> way = graph.FindPath(from, to);
            if (way == null) { return false; }
            foreach (int node in way) { points.Add(graph.PositionOf(node)); }
            return true;
        }

        void Update()
        {
            Drive(Time.deltaTime);
        }

        /// <summary>Drives on for so many seconds.</summary>
        public void Drive(float seconds)
        {
            driven += metresPerSecond * seconds;
            if (driven > path.Length) { SetOut(garage); }
            else { Place(); }
        }

        void Place()
        {
            Vector3 direction, up = Vector3.up * eyeHeight;
            Vector3 here = path.At(driven, out direction), ahead = path.At(driven + lookAhead, out direction);
            transform.position = here + up;
            if ((ahead - here).sqrMagnitude > 0.01f)
            {
                transform.rotation = Quaternion.LookRotation(ahead - here, Vector3.up);
            }
        }
    }
}
