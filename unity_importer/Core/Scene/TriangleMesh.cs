using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// A part of a mesh with a material of its own: the faces of a GeomSubset, or those that no subset has.
    /// </summary>
    public sealed class SubMesh
    {
        /// <summary>Path of the subset; null for the faces of none.</summary>
        public string SubsetPath;

        /// <summary>The material bound to the subset; null where the mesh's own counts.</summary>
        public string MaterialPath;

        /// <summary>Three vertices a triangle, counterclockwise as seen from outside.</summary>
        public int[] Triangles;
    }

    /// <summary>A mesh as graphics cards want it, in the axes and units of the stage.</summary>
    public sealed class TriangleMesh
    {
        /// <summary>Three numbers a vertex.</summary>
        public float[] Points { get; private set; }

        /// <summary>Three numbers a vertex, of length 1 where the mesh gives none of its own.</summary>
        public float[] Normals { get; private set; }

        /// <summary>Two numbers a vertex, by the name of the primvar ("st").</summary>
        public Dictionary<string, float[]> TextureCoordinates { get; private set; }

        /// <summary>primvars:displayColor, three numbers a vertex; null where there is none.</summary>
        public float[] Colors { get; private set; }

        /// <summary>The triangles, by material.</summary>
        public List<SubMesh> SubMeshes { get; private set; }

        /// <summary>Whether the backs of faces are seen.</summary>
        public bool IsDoubleSided { get; private set; }

        /// <summary>The point of the mesh that each vertex is.</summary>
        public int[] PointOfVertex { get; private set; }

        sealed class Channel
        {
            public string Name;
            public int Size;
            public float[] Values;
            public int[] Indices;
            public string Interpolation;
            public float[] Result;
        }

        static readonly HashSet<string> Attributes = new HashSet<string>
        {
            "points", "faceVertexCounts", "faceVertexIndices", "holeIndices", "orientation", "normals",
            "subdivisionScheme", "doubleSided",
        };

        /// <summary>Whether an attribute has to do with what the mesh is.</summary>
        internal static bool Reads(string attribute)
        {
            return Attributes.Contains(attribute) || attribute.StartsWith("primvars:", StringComparison.Ordinal);
        }

        /// <summary>Triangles of a Mesh prim; null, with the reason, where its arrays contradict each other.</summary>
        public static TriangleMesh Build(UsdPrim prim, out string reason)
        {
            var builder = new Builder(prim);
            reason = builder.Read();
            return reason == null ? builder.Make() : null;
        }

        sealed class Builder
        {
            readonly UsdPrim prim;
            readonly List<Channel> channels = new List<Channel>();
            float[] points;
            int[] counts, indices, faceStarts;
            bool[] isHole;
            FaceTriangles faces;
            bool leftHanded;

            public Builder(UsdPrim prim)
            {
                this.prim = prim;
            }

            public string Read()
            {
                UsdValue pointsValue = prim.Value("points"), countsValue = prim.Value("faceVertexCounts"),
                    indicesValue = prim.Value("faceVertexIndices");
                if (pointsValue == null || countsValue == null || indicesValue == null)
                {
                    return "has no points or faces";
                }
                points = pointsValue.Floats();
                counts = countsValue.Ints();
                indices = indicesValue.Ints();
                faces = new FaceTriangles(points, indices);
                int pointCount = points.Length / 3;
                faceStarts = new int[counts.Length + 1];
                long total = 0;
                for (int face = 0; face < counts.Length; face++)
                {
                    if (counts[face] < 0) { return "a face has a negative count of vertices"; }
                    faceStarts[face] = (int)total;
                    total += counts[face];
                    if (total > indices.Length) { return "faceVertexCounts need more indices than there are"; }
                }
                faceStarts[counts.Length] = (int)total;
                if (total != indices.Length)
                {
                    return "faceVertexCounts need " + total + " indices, but there are " + indices.Length;
                }
                foreach (int index in indices)
                {
                    if ((uint)index >= (uint)pointCount) { return "an index of a face is not that of a point"; }
                }
                isHole = new bool[counts.Length];
                UsdValue holes = prim.Value("holeIndices");
                foreach (int hole in holes == null ? new int[0] : holes.Ints())
                {
                    if ((uint)hole < (uint)counts.Length) { isHole[hole] = true; }
                }
                leftHanded = prim.Text("orientation", "rightHanded") == "leftHanded";
                ReadChannels();
                return null;
            }

            void ReadChannels()
            {
                Channel normals = ReadChannel("primvars:normals", 3) ?? ReadChannel("normals", 3) ?? MadeNormals();
                normals.Name = "normals";
                channels.Add(normals);
                foreach (string name in prim.PropertyNames)
                {
                    if (!name.StartsWith("primvars:", StringComparison.Ordinal) || name == "primvars:normals")
                    {
                        continue;
                    }
                    UsdValue value = prim.Value(name);
                    bool isColor = name == "primvars:displayColor";
                    if (value == null || UsdTypes.Components(value.Type) != (isColor ? 3 : 2)) { continue; }
                    Channel channel = ReadChannel(name, isColor ? 3 : 2);
                    if (channel == null) { continue; }
                    channel.Name = isColor ? "color" : name.Substring(9);
                    channels.Add(channel);
                }
            }

            Channel ReadChannel(string name, int size)
            {
                UsdProperty property = prim.Property(name);
                UsdValue value = property == null ? null : property.Value;
                if (value == null || value.Data.Length < size || UsdTypes.Components(value.Type) != size)
                {
                    return null;
                }
                UsdValue indicesValue = prim.Value(name + ":indices");
                string otherwise = name == "normals" ? "vertex" : "constant";
                var channel = new Channel
                {
                    Size = size, Values = value.Floats(), Indices = indicesValue == null ? null : indicesValue.Ints(),
                    Interpolation = property.MetadataText("interpolation") ?? otherwise,
                };
                int items = channel.Values.Length / size;
                int elements = channel.Indices == null ? items : channel.Indices.Length;
                int needed = channel.Interpolation == "faceVarying" ? indices.Length
                    : channel.Interpolation == "uniform" ? counts.Length
                    : channel.Interpolation == "constant" ? 1 : points.Length / 3;
                if (elements < needed)
                {
                    prim.Stage.Composer.Library.Warn("<" + prim.Path + "." + name + "> has " + elements
                        + " elements where " + needed + " are needed");
                    return null;
                }
                if (channel.Indices != null)
                {
                    foreach (int index in channel.Indices)
                    {
                        if ((uint)index < (uint)items) { continue; }
                        prim.Stage.Composer.Library.Warn("<" + prim.Path + "." + name
                            + "> has an index out of its values");
                        return null;
                    }
                }
                return channel;
            }

            // smooth ones for subdivision surfaces, flat ones for others
            Channel MadeNormals()
            {
                bool smooth = prim.Text("subdivisionScheme", "catmullClark") != "none";
                var normals = new float[smooth ? points.Length : 3 * counts.Length];
                var normal = new double[3];
                var sums = new double[smooth ? points.Length : 0];
                for (int face = 0; face < counts.Length; face++)
                {
                    faces.Normal(faceStarts[face], counts[face], normal);
                    if (leftHanded)
                    {
                        for (int k = 0; k < 3; k++) { normal[k] = -normal[k]; }
                    }
                    if (!smooth)
                    {
                        Unit(normal, 0, normals, 3 * face);
                        continue;
                    }
                    for (int corner = faceStarts[face]; corner < faceStarts[face + 1]; corner++)
                    {
                        for (int k = 0; k < 3; k++) { sums[3 * indices[corner] + k] += normal[k]; }
                    }
                }
                for (int i = 0; smooth && i + 2 < points.Length; i += 3) { Unit(sums, i, normals, i); }
                return new Channel { Size = 3, Values = normals, Interpolation = smooth ? "vertex" : "uniform" };
            }

            static void Unit(double[] from, int at, float[] into, int place)
            {
                double length = Math.Sqrt(from[at] * from[at] + from[at + 1] * from[at + 1]
                    + from[at + 2] * from[at + 2]);
                for (int k = 0; k < 3; k++)
                {
                    into[place + k] = length > 0 ? (float)(from[at + k] / length) : k == 1 ? 1 : 0;
                }
            }

            public TriangleMesh Make()
            {
                int[] vertexOfCorner;
                int[] pointOfVertex = SplitVertices(out vertexOfCorner);
                var mesh = new TriangleMesh
                {
                    PointOfVertex = pointOfVertex, TextureCoordinates = new Dictionary<string, float[]>(),
                    SubMeshes = new List<SubMesh>(),
                    IsDoubleSided = prim.Truth("doubleSided", false), Points = new float[3 * pointOfVertex.Length],
                };
                for (int vertex = 0; vertex < pointOfVertex.Length; vertex++)
                {
                    Array.Copy(points, 3 * pointOfVertex[vertex], mesh.Points, 3 * vertex, 3);
                }
                foreach (Channel channel in channels)
                {
                    if (channel.Name == "normals") { mesh.Normals = channel.Result; }
                    else if (channel.Name == "color") { mesh.Colors = channel.Result; }
                    else { mesh.TextureCoordinates[channel.Name] = channel.Result; }
                }
                AddSubMeshes(mesh, vertexOfCorner);
                return mesh;
            }

            static int Element(Channel channel, int corner, int face, int point)
            {
                int element = channel.Interpolation == "faceVarying" ? corner
                    : channel.Interpolation == "uniform" ? face
                    : channel.Interpolation == "constant" ? 0 : point;
                return channel.Indices == null ? element : channel.Indices[element];
            }

            struct Key : IEquatable<Key>
            {
                public int Point, First;
                public long Others;

                public bool Equals(Key other)
                {
                    return Point == other.Point && First == other.First && Others == other.Others;
                }

                public override int GetHashCode()
                {
                    return (Point * 486187739 + First) * 486187739 + (int)Others + (int)(Others >> 32) * 31;
                }
            }

            /// <summary>One vertex for all corners that agree in everything; gives the point of each vertex.</summary>
            int[] SplitVertices(out int[] vertexOfCorner)
            {
                bool splits = false;
                foreach (Channel channel in channels)
                {
                    splits |= channel.Interpolation == "faceVarying" || channel.Interpolation == "uniform";
                }
                vertexOfCorner = indices;
                int[] pointOfVertex;
                int[] cornerOfVertex = null, faceOfVertex = null;
                if (!splits)
                {
                    pointOfVertex = new int[points.Length / 3];
                    for (int i = 0; i < pointOfVertex.Length; i++) { pointOfVertex[i] = i; }
                }
                else
                {
                    Split(out pointOfVertex, out cornerOfVertex, out faceOfVertex, out vertexOfCorner);
                }
                foreach (Channel channel in channels)
                {
                    channel.Result = new float[channel.Size * pointOfVertex.Length];
                    for (int vertex = 0; vertex < pointOfVertex.Length; vertex++)
                    {
                        int corner = splits ? cornerOfVertex[vertex] : 0, face = splits ? faceOfVertex[vertex] : 0;
                        int element = Element(channel, corner, face, pointOfVertex[vertex]);
                        for (int k = 0; k < channel.Size; k++)
                        {
                            channel.Result[channel.Size * vertex + k] = channel.Values[channel.Size * element + k];
                        }
                    }
                }
                return pointOfVertex;
            }

            void Split(out int[] pointOfVertex, out int[] cornerOfVertex, out int[] faceOfVertex,
                out int[] vertexOfCorner)
            {
                // elements with equal values count as one, so that smooth edges stay closed
                var canonical = new List<int[]>();
                foreach (Channel channel in channels) { canonical.Add(FirstEqual(channel)); }
                var vertices = new Dictionary<Key, int>(indices.Length);
                var ofPoint = new List<int>();
                var ofCorner = new List<int>();
                var ofFace = new List<int>();
                var combined = new Dictionary<KeyValuePair<long, int>, int>();
                vertexOfCorner = new int[indices.Length];
                for (int face = 0; face < counts.Length; face++)
                {
                    for (int corner = faceStarts[face]; corner < faceStarts[face + 1]; corner++)
                    {
                        long others = 0;
                        for (int i = 1; i < channels.Count; i++)
                        {
                            int element = canonical[i][Element(channels[i], corner, face, indices[corner])];
                            if (i == 1)
                            {
                                others = element;
                                continue;
                            }
                            // several further channels: a number for each pair of what came so far and the next
                            var pair = new KeyValuePair<long, int>(others, element);
                            int number;
                            if (!combined.TryGetValue(pair, out number))
                            {
                                number = combined.Count;
                                combined.Add(pair, number);
                            }
                            others = ((long)i << 40) + number;
                        }
                        int first = canonical[0][Element(channels[0], corner, face, indices[corner])];
                        var key = new Key { Point = indices[corner], First = first, Others = others };
                        int vertex;
                        if (!vertices.TryGetValue(key, out vertex))
                        {
                            vertex = ofPoint.Count;
                            vertices.Add(key, vertex);
                            ofPoint.Add(indices[corner]);
                            ofCorner.Add(corner);
                            ofFace.Add(face);
                        }
                        vertexOfCorner[corner] = vertex;
                    }
                }
                pointOfVertex = ofPoint.ToArray();
                cornerOfVertex = ofCorner.ToArray();
                faceOfVertex = ofFace.ToArray();
            }

            struct Triple : IEquatable<Triple>
            {
                public float X, Y, Z;

                public bool Equals(Triple other)
                {
                    return X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z);
                }

                public override int GetHashCode()
                {
                    return (X.GetHashCode() * 486187739 + Y.GetHashCode()) * 486187739 + Z.GetHashCode();
                }
            }

            static int[] FirstEqual(Channel channel)
            {
                var first = new Dictionary<Triple, int>();
                var equal = new int[channel.Values.Length / channel.Size];
                for (int i = 0; i < equal.Length; i++)
                {
                    int at = channel.Size * i;
                    var triple = new Triple { X = channel.Values[at], Y = channel.Values[at + 1] };
                    if (channel.Size > 2) { triple.Z = channel.Values[at + 2]; }
                    int found;
                    if (!first.TryGetValue(triple, out found))
                    {
                        found = i;
                        first.Add(triple, i);
                    }
                    equal[i] = found;
                }
                return equal;
            }

            void AddSubMeshes(TriangleMesh mesh, int[] vertexOfCorner)
            {
                var partOfFace = new int[counts.Length];
                var parts = new List<SubMesh> { new SubMesh() };
                foreach (UsdPrim child in prim.Children)
                {
                    if (child.TypeName != "GeomSubset" || child.Text("elementType", "face") != "face") { continue; }
                    MaterialBinding binding = MaterialBinding.Of(child, "preview");
                    UsdValue faces = child.Value("indices");
                    if (faces == null || (binding.Path == null && child.Text("familyName", "") != "materialBind"))
                    {
                        continue;
                    }
                    parts.Add(new SubMesh { SubsetPath = child.Path, MaterialPath = binding.Path });
                    foreach (int face in faces.Ints())
                    {
                        if ((uint)face < (uint)counts.Length && partOfFace[face] == 0)
                        {
                            partOfFace[face] = parts.Count - 1;
                        }
                    }
                }
                var triangles = new List<int>[parts.Count];
                for (int i = 0; i < triangles.Length; i++)
                {
                    triangles[i] = new List<int>(i == 0 ? 3 * Math.Max(0, indices.Length - 2 * counts.Length) : 0);
                }
                var corners = new List<int>();
                for (int face = 0; face < counts.Length; face++)
                {
                    if (isHole[face] || counts[face] < 3) { continue; }
                    corners.Clear();
                    faces.Cut(faceStarts[face], counts[face], corners);
                    List<int> into = triangles[partOfFace[face]];
                    for (int i = 0; i < corners.Count; i += 3)
                    {
                        into.Add(vertexOfCorner[corners[i]]);
                        into.Add(vertexOfCorner[corners[leftHanded ? i + 2 : i + 1]]);
                        into.Add(vertexOfCorner[corners[leftHanded ? i + 1 : i + 2]]);
                    }
                }
                if (faces.IsCrude)
                {
                    prim.Stage.Composer.Library.Warn("<" + prim.Path + "> has faces with too many corners to cut them all"
                        + " into triangles within them");
                }
                for (int i = 0; i < parts.Count; i++)
                {
                    parts[i].Triangles = triangles[i].ToArray();
                    if (parts[i].Triangles.Length > 0 || parts.Count == 1) { mesh.SubMeshes.Add(parts[i]); }
                }
            }
        }
    }
}
