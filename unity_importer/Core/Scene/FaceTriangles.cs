using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Cuts the faces of a mesh into triangles, concave ones and such as are not quite plane too.</summary>
    sealed class FaceTriangles
    {
        // looking for ears takes the cube of the corners at worst
        const long MostChecks = 200000000;

        readonly float[] points;
        readonly int[] indices;

        long checks;

        /// <summary>Whether faces have so many corners that not all were looked at: some may be cut wrongly.</summary>
        public bool IsCrude
        {
            get { return checks >= MostChecks; }
        }

        // the face at hand: its direction, its corners in the plane, and those not cut off yet
        readonly double[] normal = new double[3];
        readonly List<int> rest = new List<int>();
        double[] x = new double[4], y = new double[4];

        /// <summary>Of points, three numbers each, and the numbers of those at the corners of all faces.</summary>
        public FaceTriangles(float[] points, int[] indices)
        {
            this.points = points;
            this.indices = indices;
        }

        /// <summary>Twice the area times the direction of the face with these corners, by Newell.</summary>
        public void Normal(int start, int count, double[] into)
        {
            into[0] = into[1] = into[2] = 0;
            for (int corner = start; corner < start + count; corner++)
            {
                int a = 3 * indices[corner], b = 3 * indices[corner + 1 < start + count ? corner + 1 : start];
                into[0] += ((double)points[a + 1] - points[b + 1]) * ((double)points[a + 2] + points[b + 2]);
                into[1] += ((double)points[a + 2] - points[b + 2]) * ((double)points[a] + points[b]);
                into[2] += ((double)points[a] - points[b]) * ((double)points[a + 1] + points[b + 1]);
            }
        }

        /// <summary>
        /// Adds three corners for each triangle of the face with these corners, turning as the face does.
        /// </summary>
        public void Cut(int start, int count, List<int> corners)
        {
            if (count == 3)
            {
                AddTriangle(corners, start, start + 1, start + 2);
                return;
            }
            // the plane in which the face is largest
            Normal(start, count, normal);
            int drop = Math.Abs(normal[0]) > Math.Abs(normal[1])
                ? (Math.Abs(normal[0]) > Math.Abs(normal[2]) ? 0 : 2)
                : Math.Abs(normal[1]) > Math.Abs(normal[2]) ? 1 : 2;
            int u = (drop + 1) % 3, v = (drop + 2) % 3;
            double sign = normal[drop] < 0 ? -1 : 1;
            if (x.Length < count)
            {
                x = new double[count];
                y = new double[count];
            }
            rest.Clear();
            for (int i = 0; i < count; i++)
            {
                x[i] = points[3 * indices[start + i] + u];
                y[i] = sign * points[3 * indices[start + i] + v];
                rest.Add(i);
            }
            while (rest.Count > 3)
            {
                int ear = checks < MostChecks ? BestEar() : 1;
                int before = rest[(ear + rest.Count - 1) % rest.Count], after = rest[(ear + 1) % rest.Count];
                AddTriangle(corners, start + before, start + rest[ear], start + after);
                rest.RemoveAt(ear);
            }
            AddTriangle(corners, start + rest[0], start + rest[1], start + rest[2]);
        }

        static void AddTriangle(List<int> corners, int a, int b, int c)
        {
            corners.Add(a);
            corners.Add(b);
            corners.Add(c);
        }

        // the first corner that can be cut off without crossing the rest; whichever is least bad where the face
        // crosses itself
        int BestEar()
        {
            int best = 1;
            double largest = double.NegativeInfinity;
            for (int i = 1; i <= rest.Count; i++)
            {
                int ear = i % rest.Count;
                int a = rest[(ear + rest.Count - 1) % rest.Count], b = rest[ear], c = rest[(ear + 1) % rest.Count];
                double area = Area(a, b, c);
                if (area > largest)
                {
                    largest = area;
                    best = ear;
                }
                if (area <= 0) { continue; }
                bool isFree = true;
                checks += rest.Count;
                foreach (int other in rest)
                {
                    if (other == a || other == b || other == c) { continue; }
                    bool atCorner = (x[other] == x[a] && y[other] == y[a]) || (x[other] == x[b] && y[other] == y[b])
                        || (x[other] == x[c] && y[other] == y[c]);
                    if (!atCorner && Area(a, b, other) >= 0 && Area(b, c, other) >= 0
                        && Area(c, a, other) >= 0)
                    {
                        isFree = false;
                        break;
                    }
                }
                if (isFree) { return ear; }
            }
            return best;
        }

        double Area(int a, int b, int c)
        {
            return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]);
        }
    }
}
