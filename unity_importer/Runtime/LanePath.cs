using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>A way along straight lines, in metres of the world.</summary>
    public sealed class LanePath
    {
        readonly Vector3[] points;
        readonly float[] reached;

        /// <summary>Points that follow each other at the same place count once; at least one is needed.</summary>
        public LanePath(IEnumerable<Vector3> points)
        {
            var different = new List<Vector3>();
            foreach (Vector3 point in points)
            {
                if (different.Count == 0 || Vector3.Distance(different[different.Count - 1], point) > 1e-4f)
                {
                    different.Add(point);
                }
            }
            this.points = different.ToArray();
            reached = new float[different.Count];
            for (int i = 1; i < reached.Length; i++)
            {
                reached[i] = reached[i - 1] + Vector3.Distance(different[i - 1], different[i]);
            }
        }

        /// <summary>Points between which the way is straight.</summary>
        public int Count
        {
            get { return points.Length; }
        }

        /// <summary>A point, in the world. Throws IndexOutOfRangeException.</summary>
        public Vector3 this[int index]
        {
            get { return points[index]; }
        }

        /// <summary>Metres from end to end.</summary>
        public float Length
        {
            get { return reached[reached.Length - 1]; }
        }

        /// <summary>The place after so many metres, and which way the path leads there; the ends for what lies
        /// outside.</summary>
        public Vector3 At(float metres, out Vector3 direction)
        {
            if (points.Length == 1)
            {
                direction = Vector3.forward;
                return points[0];
            }
            int next = 1;
            while (next < points.Length - 1 && reached[next] < metres) { next++; }
            Vector3 start = points[next - 1], end = points[next];
            direction = (end - start).normalized;
            return Vector3.Lerp(start, end, (metres - reached[next - 1]) / (reached[next] - reached[next - 1]));
        }
    }
}
