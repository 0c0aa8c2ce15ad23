using System;
using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>A lane square or a portal.</summary>
    [Serializable]
    public struct LaneNode
    {
        /// <summary>Its middle, in metres of the graph's space.</summary>
        public Vector3 position;

        /// <summary>"straight", "t_junction", "crossroads", "entrance", "exit".</summary>
        public string kind;

        /// <summary>Row of its square.</summary>
        public int row;

        /// <summary>Column of its square.</summary>
        public int column;

        /// <summary>Number of its level, 0 at the top; 0 in a garage of one level.</summary>
        public int level;

        /// <summary>Metres of carriageway along the stage's x and z.</summary>
        public Vector2 widths;
    }

    /// <summary>A straight way between two nodes.</summary>
    [Serializable]
    public struct LaneEdge
    {
        /// <summary>Number of the node where it begins.</summary>
        public int from;

        /// <summary>Number of the node where it ends.</summary>
        public int to;

        /// <summary>Metres from node to node.</summary>
        public float length;

        /// <summary>Metres of carriageway.</summary>
        public float width;

        /// <summary>Whether cars drive from the one node to the other only.</summary>
        public bool isOneWay;
    }

    /// <summary>A place on a lane.</summary>
    public struct LanePoint
    {
        /// <summary>Number of the edge.</summary>
        public int Edge;

        /// <summary>0 where the edge begins, 1 where it ends.</summary>
        public float Fraction;

        /// <summary>In the world.</summary>
        public Vector3 Position;

        /// <summary>Metres from what was asked for.</summary>
        public float Distance;
    }

    /// <summary>Where cars drive: nodes, the ways between them, and the stalls beside them.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/Lane Graph")]
    public sealed class LaneGraph : MonoBehaviour
    {
        [SerializeField] LaneNode[] nodes = new LaneNode[0];
        [SerializeField] LaneEdge[] edges = new LaneEdge[0];
        [SerializeField] Stall[] stalls = new Stall[0];
        [NonSerialized] List<int>[] edgesOfNode;

        /// <summary>Lane squares and portals.</summary>
        public int NodeCount
        {
            get { return nodes.Length; }
        }

        /// <summary>Ways between nodes.</summary>
        public int EdgeCount
        {
            get { return edges.Length; }
        }

        /// <summary>Stalls of the stage, also those where nobody parks.</summary>
        public int StallCount
        {
            get { return stalls.Length; }
        }

        /// <summary>A node by its number. Throws IndexOutOfRangeException.</summary>
        public LaneNode Node(int number)
        {
            return nodes[number];
        }

        /// <summary>An edge by its number. Throws IndexOutOfRangeException.</summary>
        public LaneEdge Edge(int number)
        {
            return edges[number];
        }

        /// <summary>The stalls in the order of the stage.</summary>
        public Stall StallAt(int number)
        {
            return stalls[number];
        }

        internal void Set(LaneNode[] ownNodes, LaneEdge[] ownEdges, Stall[] ownStalls)
        {
            nodes = ownNodes;
            edges = ownEdges;
            stalls = ownStalls;
            edgesOfNode = null;
        }

        /// <summary>The middle of a node, in the world.</summary>
        public Vector3 PositionOf(int node)
        {
            return transform.TransformPoint(nodes[node].position);
        }

        /// <summary>The nodes of a kind, such as "entrance".</summary>
        public List<int> NodesOfKind(string kind)
        {
            var found = new List<int>();
            for (int i = 0; i < nodes.Length; i++)
            {
                if (nodes[i].kind == kind) { found.Add(i); }
            }
            return found;
        }

        /// <summary>The stall with this id, or else with this painted number; null where there is none.</summary>
        public Stall FindStall(string idOrNumber)
        {
            Stall numbered = null;
            foreach (Stall stall in stalls)
            {
                if (stall.Id == idOrNumber) { return stall; }
                if (stall.Number == idOrNumber && numbered == null) { numbered = stall; }
            }
            return numbered;
        }

        /// <summary>The place on a lane that is nearest to one in the world; false where the graph has no
        /// edges.</summary>
        public bool NearestLane(Vector3 position, out LanePoint nearest)
        {
            nearest = new LanePoint { Edge = -1, Distance = float.PositiveInfinity };
            for (int i = 0; i < edges.Length; i++)
            {
                Vector3 start = PositionOf(edges[i].from), way = PositionOf(edges[i].to) - start;
                float square = way.sqrMagnitude;
                float fraction = square > 0 ? Mathf.Clamp01(Vector3.Dot(position - start, way) / square) : 0;
                Vector3 point = start + way * fraction;
                float distance = Vector3.Distance(point, position);
                if (distance < nearest.Distance)
                {
                    nearest = new LanePoint { Edge = i, Fraction = fraction, Position = point, Distance = distance };
                }
            }
            return nearest.Edge >= 0;
        }

        /// <summary>The nodes of a shortest way that respects the directions, both ends among them; null where there is
        /// no way.</summary>
        public List<int> FindPath(int from, int to)
        {
            if ((uint)from >= (uint)nodes.Length || (uint)to >= (uint)nodes.Length)
            {
                throw new ArgumentOutOfRangeException();
            }
            if (edgesOfNode == null) { FindNeighbours(); }
            var distance = new float[nodes.Length];
            var before = new int[nodes.Length];
            for (int i = 0; i < nodes.Length; i++) { distance[i] = float.PositiveInfinity; }
            var queue = new NodeQueue();
            distance[from] = 0;
            before[from] = -1;
            queue.Add(from, 0);
            int node;
            float reached;
            while (queue.Take(out node, out reached))
            {
                if (node == to) { break; }
                if (reached > distance[node]) { continue; }
                foreach (int number in edgesOfNode[node])
                {
                    LaneEdge edge = edges[number];
                    int next = edge.from == node ? edge.to : edge.from;
                    float further = reached + edge.length;
                    if (further >= distance[next]) { continue; }
                    distance[next] = further;
                    before[next] = node;
                    queue.Add(next, further);
                }
            }
            if (float.IsPositiveInfinity(distance[to])) { return null; }
            var path = new List<int>();
            for (int at = to; at >= 0; at = before[at]) { path.Add(at); }
            path.Reverse();
            return path;
        }

        void FindNeighbours()
        {
            edgesOfNode = new List<int>[nodes.Length];
            for (int i = 0; i < nodes.Length; i++) { edgesOfNode[i] = new List<int>(); }
            for (int i = 0; i < edges.Length; i++)
            {
                edgesOfNode[edges[i].from].Add(i);
                if (!edges[i].isOneWay) { edgesOfNode[edges[i].to].Add(i); }
            }
        }

        /// <summary>A shortest way from the middle of a stall over the lanes into that of another; null where there is
        /// none.</summary>
        public LanePath FindPath(Stall from, Stall to)
        {
            List<int> way = FindPath(from.AccessNode, to.AccessNode);
            if (way == null) { return null; }
            var points = new List<Vector3> { from.Centre, from.Mouth };
            foreach (int node in way) { points.Add(PositionOf(node)); }
            points.Add(to.Mouth);
            points.Add(to.Centre);
            return new LanePath(points);
        }

        void OnDrawGizmosSelected()
        {
            Gizmos.color = Color.cyan;
            foreach (LaneEdge edge in edges)
            {
                Vector3 start = PositionOf(edge.from), end = PositionOf(edge.to);
                Gizmos.DrawLine(start, end);
                if (!edge.isOneWay) { continue; }
                Vector3 way = (end - start).normalized, side = Vector3.Cross(Vector3.up, way);
                Gizmos.DrawLine(end, end - way + side * 0.5f);
                Gizmos.DrawLine(end, end - way - side * 0.5f);
            }
            for (int i = 0; i < nodes.Length; i++)
            {
                bool isPortal = nodes[i].kind == "entrance" || nodes[i].kind == "exit";
                Gizmos.color = isPortal ? Color.green : Color.cyan;
                Gizmos.DrawWireSphere(PositionOf(i), isPortal ? 0.8f : 0.3f);
            }
        }

        /// <summary>A binary heap of nodes by their distance.</summary>
        sealed class NodeQueue
        {
            readonly List<KeyValuePair<float, int>> heap = new List<KeyValuePair<float, int>>();

            public void Add(int node, float distance)
            {
                heap.Add(new KeyValuePair<float, int>(distance, node));
                for (int at = heap.Count - 1; at > 0 && heap[at].Key < heap[(at - 1) / 2].Key; at = (at - 1) / 2)
                {
                    Swap(at, (at - 1) / 2);
                }
            }

            public bool Take(out int node, out float distance)
            {
                node = -1;
                distance = 0;
                if (heap.Count == 0) { return false; }
                node = heap[0].Value;
                distance = heap[0].Key;
                Swap(0, heap.Count - 1);
                heap.RemoveAt(heap.Count - 1);
                for (int at = 0; ;)
                {
                    int least = at;
                    for (int child = 2 * at + 1; child <= 2 * at + 2 && child < heap.Count; child++)
                    {
                        if (heap[child].Key < heap[least].Key) { least = child; }
                    }
                    if (least == at) { return true; }
                    Swap(at, least);
                    at = least;
                }
            }

            void Swap(int a, int b)
            {
                KeyValuePair<float, int> kept = heap[a];
                heap[a] = heap[b];
                heap[b] = kept;
            }
        }
    }
}
