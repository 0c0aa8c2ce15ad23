using System;
using System.Collections.Generic;
using Garage.Usd;

namespace Garage.Unity
{
    /// <summary>Meshes of the shapes that USD knows without points: Cube, Sphere, Cylinder, Capsule, Cone and
    /// Plane.</summary>
    static class ShapeMeshes
    {
        const int Sides = 32;
        const int Rings = 8;

        public static MeshArrays Of(ShapeData shape)
        {
            var faces = new Faces();
            double half = shape.Height / 2, r = shape.Radius;
            switch (shape.Kind)
            {
                case "Cube": Box(faces, shape.Size / 2); break;
                case "Plane": Rectangle(faces, shape.Width / 2, shape.Length / 2); break;
                case "Cylinder":
                    Turned(faces, new[] { 0, -half, r, -half }, new[] { r, -half, r, half },
                        new[] { r, half, 0, half });
                    break;
                case "Cone": Turned(faces, new[] { 0, -half, r, -half }, new[] { r, -half, 0, half }); break;
                case "Sphere": Round(faces, r, 0); break;
                default: Round(faces, r, half); break;
            }
            return faces.Arrays(shape.Kind, shape.Axis);
        }

        static void Box(Faces faces, double h)
        {
            for (int axis = 0; axis < 3; axis++)
            {
                for (int sign = -1; sign <= 1; sign += 2)
                {
                    var normal = new double[3];
                    normal[axis] = sign;
                    for (int corner = 0; corner < 4; corner++)
                    {
                        // counterclockwise about the normal
                        double a = corner == 1 || corner == 2 ? h : -h, b = corner >= 2 ? h : -h;
                        var point = new double[3];
                        point[axis] = sign * h;
                        point[(axis + 1) % 3] = sign * a;
                        point[(axis + 2) % 3] = b;
                        faces.Add(point, normal);
                    }
                    faces.Quad(faces.Count - 4, faces.Count - 3, faces.Count - 2, faces.Count - 1);
                }
            }
        }

        static void Rectangle(Faces faces, double halfWidth, double halfLength)
        {
            var up = new double[] { 0, 0, 1 };
            faces.Add(new[] { -halfWidth, -halfLength, 0 }, up);
            faces.Add(new[] { halfWidth, -halfLength, 0 }, up);
            faces.Add(new[] { halfWidth, halfLength, 0 }, up);
            faces.Add(new[] { -halfWidth, halfLength, 0 }, up);
            faces.Quad(0, 1, 2, 3);
        }

        // lines (radius, height, radius, height) turned about z, from below to above, with an edge between each two
        static void Turned(Faces faces, params double[][] lines)
        {
            foreach (double[] line in lines)
            {
                double across = line[3] - line[1], along = line[0] - line[2],
                    length = Math.Sqrt(across * across + along * along);
                int start = faces.Count;
                for (int side = 0; side <= Sides; side++)
                {
                    double angle = 2 * Math.PI * side / Sides, cos = Math.Cos(angle), sin = Math.Sin(angle);
                    var normal = new[] { across / length * cos, across / length * sin, along / length };
                    faces.Add(new[] { line[0] * cos, line[0] * sin, line[1] }, normal);
                    faces.Add(new[] { line[2] * cos, line[2] * sin, line[3] }, normal);
                }
                for (int side = 0; side < Sides; side++)
                {
                    int at = start + 2 * side;
                    if (line[0] > 0) { faces.Triangle(at, at + 2, at + 1); }
                    if (line[2] > 0) { faces.Triangle(at + 1, at + 2, at + 3); }
                }
            }
        }

        // two halves of a ball, apart by twice the half
        static void Round(Faces faces, double radius, double half)
        {
            for (int ring = 0; ring <= 2 * Rings + 1; ring++)
            {
                bool above = ring > Rings;
                double latitude = (ring - (above ? Rings + 1 : Rings)) * Math.PI / (2 * Rings);
                double z = Math.Sin(latitude), r = Math.Cos(latitude);
                for (int side = 0; side <= Sides; side++)
                {
                    double angle = 2 * Math.PI * side / Sides;
                    var normal = new[] { r * Math.Cos(angle), r * Math.Sin(angle), z };
                    double height = radius * z + (above ? half : -half);
                    faces.Add(new[] { radius * normal[0], radius * normal[1], height }, normal);
                }
            }
            for (int ring = 0; ring <= 2 * Rings; ring++)
            {
                if (ring == Rings && half == 0) { continue; }
                for (int side = 0; side < Sides; side++)
                {
                    int at = ring * (Sides + 1) + side, next = at + Sides + 1;
                    if (ring > 0) { faces.Triangle(at, at + 1, next); }
                    if (ring < 2 * Rings) { faces.Triangle(at + 1, next + 1, next); }
                }
            }
        }

        /// <summary>Vertices about z, and the triangles between them.</summary>
        sealed class Faces
        {
            readonly List<double[]> points = new List<double[]>(), normals = new List<double[]>();
            readonly List<int> triangles = new List<int>();

            public int Count
            {
                get { return points.Count; }
            }

            public void Add(double[] point, double[] normal)
            {
                points.Add(point);
                normals.Add(normal);
            }

            public void Triangle(int a, int b, int c)
            {
                triangles.Add(a);
                triangles.Add(b);
                triangles.Add(c);
            }

            public void Quad(int a, int b, int c, int d)
            {
                Triangle(a, b, c);
                Triangle(a, c, d);
            }

            public MeshArrays Arrays(string name, char axis)
            {
                float[] turned = Turned(points, axis);
                var arrays = new MeshArrays { Name = name, Points = turned, Normals = Turned(normals, axis) };
                arrays.Triangles.Add(triangles.ToArray());
                return arrays;
            }

            // the axes follow each other in their order, so that nothing is mirrored
            static float[] Turned(List<double[]> vectors, char axis)
            {
                int z = axis == 'X' ? 0 : axis == 'Y' ? 1 : 2;
                var numbers = new float[3 * vectors.Count];
                for (int i = 0; i < vectors.Count; i++)
                {
                    for (int k = 0; k < 3; k++) { numbers[3 * i + (z + 1 + k) % 3] = (float)vectors[i][k]; }
                }
                return numbers;
            }
        }
    }
}
