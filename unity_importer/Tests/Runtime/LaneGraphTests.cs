using NUnit.Framework;
using UnityEngine;

namespace Garage.Unity.Tests
{
    /// <summary>Ways over a square of lanes, of which one is for one direction.</summary>
    public sealed class LaneGraphTests
    {
        GameObject holder;
        LaneGraph graph;

        [SetUp]
        public void MakeSquare()
        {
            holder = new GameObject("Lanes");
            holder.transform.localPosition = new Vector3(0, 0, 100);
            graph = holder.AddComponent<LaneGraph>();
            var nodes = new LaneNode[4];
            for (int i = 0; i < 4; i++)
            {
                nodes[i] = new LaneNode { position = new Vector3(i == 1 || i == 2 ? 10 : 0, 0, i >= 2 ? 10 : 0),
                    kind = i == 0 ? "entrance" : "straight" };
            }
            var edges = new[]
            {
                new LaneEdge { from = 0, to = 1, length = 10, isOneWay = true },
                    new LaneEdge { from = 1, to = 2, length = 10 }, new LaneEdge { from = 2, to = 3, length = 10 },
                new LaneEdge { from = 3, to = 0, length = 10 },
            };
            graph.Set(nodes, edges, new Stall[0]);
        }

        [TearDown]
        public void Remove()
        {
            Object.DestroyImmediate(holder);
        }

        [Test]
        public void Ways_keep_to_directions()
        {
            Assert.AreEqual(new[] { 0, 1 }, graph.FindPath(0, 1).ToArray());
            Assert.AreEqual(new[] { 1, 2, 3, 0 }, graph.FindPath(1, 0).ToArray());
        }

        [Test]
        public void Nodes_stand_where_the_graph_stands()
        {
            Assert.AreEqual(110f, graph.PositionOf(2).z, 1e-4f);
            Assert.AreEqual(new[] { 0 }, graph.NodesOfKind("entrance").ToArray());
        }

        [Test]
        public void The_nearest_lane_is_found()
        {
            LanePoint point;
            Assert.IsTrue(graph.NearestLane(new Vector3(12, 0, 104), out point));
            Assert.AreEqual(1, point.Edge);
            Assert.AreEqual(2f, point.Distance, 1e-4f);
            Assert.AreEqual(0.4f, point.Fraction, 1e-4f);
        }

        [Test]
        public void Paths_are_walked_by_metres()
        {
            var path = new LanePath(new[] { Vector3.zero, Vector3.zero, new Vector3(3, 0, 0), new Vector3(3, 0, 4) });
            Vector3 direction;
            Assert.AreEqual(7f, path.Length, 1e-4f);
            Assert.AreEqual(3, path.Count);
            Assert.AreEqual(2f, path.At(5, out direction).z, 1e-4f);
            Assert.AreEqual(1f, direction.z, 1e-4f);
        }
    }
}
