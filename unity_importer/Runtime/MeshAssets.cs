using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity
{
    /// <summary>What a Mesh is made of, in the axes and units of the stage.</summary>
    sealed class MeshArrays
    {
        public string Name;

        /// <summary>Three numbers a vertex.</summary>
        public float[] Points, Normals;

        /// <summary>Two numbers a vertex; null where there are none.</summary>
        public float[] Coordinates;

        /// <summary>Three numbers a vertex; null where there are none.</summary>
        public float[] Colors;

        /// <summary>Three vertices a triangle, counterclockwise as seen from outside, for each submesh.</summary>
        public List<int[]> Triangles = new List<int[]>();

        public bool IsDoubleSided;

        /// <summary>With the named texture coordinates, else those named "st", else the first ones.</summary>
        public static MeshArrays Of(TriangleMesh mesh, string coordinates)
        {
            var arrays = new MeshArrays
            {
                Points = mesh.Points, Normals = mesh.Normals, Colors = mesh.Colors, IsDoubleSided = mesh.IsDoubleSided,
            };
            foreach (SubMesh part in mesh.SubMeshes) { arrays.Triangles.Add(part.Triangles); }
            if (mesh.TextureCoordinates.TryGetValue(coordinates, out arrays.Coordinates)
                || mesh.TextureCoordinates.TryGetValue("st", out arrays.Coordinates))
            {
                return arrays;
            }
            foreach (float[] first in mesh.TextureCoordinates.Values)
            {
                arrays.Coordinates = first;
                break;
            }
            return arrays;
        }

        public long Digest()
        {
            long digest = IsDoubleSided ? 1 : 0;
            foreach (float[] numbers in new[] { Points, Normals, Coordinates, Colors })
            {
                if (numbers == null) { continue; }
                foreach (float number in numbers) { digest = digest * 1099511628211 + number.GetHashCode(); }
            }
            foreach (int[] part in Triangles)
            {
                foreach (int vertex in part) { digest = digest * 1099511628211 + vertex; }
                digest++;
            }
            return digest;
        }

        public bool Equals(MeshArrays other)
        {
            bool same = IsDoubleSided == other.IsDoubleSided && Triangles.Count == other.Triangles.Count
                && Same(Points, other.Points)
                && Same(Normals, other.Normals) && Same(Coordinates, other.Coordinates) && Same(Colors, other.Colors);
            for (int i = 0; same && i < Triangles.Count; i++) { same = Same(Triangles[i], other.Triangles[i]); }
            return same;
        }

        static bool Same<T>(T[] a, T[] b) where T : struct, IEquatable<T>
        {
            if (ReferenceEquals(a, b)) { return true; }
            if (a == null || b == null || a.Length != b.Length) { return false; }
            for (int i = 0; i < a.Length; i++)
            {
                if (!a[i].Equals(b[i])) { return false; }
            }
            return true;
        }
    }

    /// <summary>One Mesh for all that hold the same.</summary>
    sealed class MeshAssets
    {
        readonly Basis basis;
        readonly bool unwraps;
        readonly Action<string, UnityEngine.Object> store;
        readonly Dictionary<KeyValuePair<object, string>, Mesh> bySource =
            new Dictionary<KeyValuePair<object, string>, Mesh>();

        readonly Dictionary<long, List<KeyValuePair<MeshArrays, Mesh>>> byDigest =
            new Dictionary<long, List<KeyValuePair<MeshArrays, Mesh>>>();


        public MeshAssets(Basis basis, bool unwraps, Action<string, UnityEngine.Object> store)
        {
            this.basis = basis;
            this.unwraps = unwraps;
            this.store = store;
        }

        /// <summary>The Mesh of a mesh prim, with the named primvar as its texture coordinates.</summary>
        public Mesh Of(TriangleMesh source, string coordinates, string name)
        {
            var key = new KeyValuePair<object, string>(source, coordinates);
            Mesh mesh;
            if (!bySource.TryGetValue(key, out mesh))
            {
                MeshArrays arrays = MeshArrays.Of(source, coordinates);
                arrays.Name = name;
                mesh = Of(arrays);
                bySource.Add(key, mesh);
            }
            return mesh;
        }

        public Mesh Of(MeshArrays arrays)
        {
            long digest = arrays.Digest();
            List<KeyValuePair<MeshArrays, Mesh>> alike;
            if (!byDigest.TryGetValue(digest, out alike))
            {
                alike = new List<KeyValuePair<MeshArrays, Mesh>>();
                byDigest.Add(digest, alike);
            }
            foreach (KeyValuePair<MeshArrays, Mesh> one in alike)
            {
                if (one.Key.Equals(arrays)) { return one.Value; }
            }
            Mesh mesh = Make(arrays);
            alike.Add(new KeyValuePair<MeshArrays, Mesh>(arrays, mesh));
            store("mesh " + digest.ToString("x16") + (alike.Count > 1 ? "." + alike.Count : ""), mesh);
            return mesh;
        }

        Mesh Make(MeshArrays arrays)
        {
            int count = arrays.Points.Length / 3, all = arrays.IsDoubleSided ? 2 * count : count;
            IndexFormat format = all > 65535 ? IndexFormat.UInt32 : IndexFormat.UInt16;
            var mesh = new Mesh { name = arrays.Name, indexFormat = format };
            mesh.vertices = Vectors(arrays.Points, all, true, 1);
            mesh.normals = Vectors(arrays.Normals, all, false, -1);
            if (arrays.Coordinates != null)
            {
                var coordinates = new Vector2[all];
                for (int i = 0; i < all; i++)
                {
                    int at = 2 * (i % count);
                    // both begin below on the left
                    coordinates[i] = new Vector2(arrays.Coordinates[at], arrays.Coordinates[at + 1]);
                }
                mesh.uv = coordinates;
            }
            if (arrays.Colors != null)
            {
                var colors = new Color[all];
                for (int i = 0; i < all; i++)
                {
                    int at = 3 * (i % count);
                    colors[i] = new Color(arrays.Colors[at], arrays.Colors[at + 1], arrays.Colors[at + 2]);
                }
                mesh.colors = colors;
            }
            mesh.subMeshCount = arrays.Triangles.Count;
            for (int part = 0; part < arrays.Triangles.Count; part++)
            {
                mesh.SetTriangles(Wound(arrays.Triangles[part], arrays.IsDoubleSided ? count : 0), part);
            }
            if (arrays.Coordinates != null) { mesh.RecalculateTangents(); }
            if (unwraps) { EditorOnly.Unwrap(mesh); }
            return mesh;
        }

        // the backs of double-sided meshes follow their fronts
        Vector3[] Vectors(float[] numbers, int all, bool withUnits, float sign)
        {
            float[] turned = basis.Vectors(numbers, withUnits);
            int count = turned.Length / 3;
            var vectors = new Vector3[all];
            for (int i = 0; i < count; i++)
            {
                vectors[i] = new Vector3(turned[3 * i], turned[3 * i + 1], turned[3 * i + 2]);
            }
            for (int i = count; i < all; i++) { vectors[i] = vectors[i - count] * sign; }
            return vectors;
        }

        // the basis mirrors, so that fronts turn the other way around
        static int[] Wound(int[] triangles, int backs)
        {
            var wound = new int[backs > 0 ? 2 * triangles.Length : triangles.Length];
            for (int i = 0; i < triangles.Length; i += 3)
            {
                wound[i] = triangles[i];
                wound[i + 1] = triangles[i + 2];
                wound[i + 2] = triangles[i + 1];
            }
            for (int i = triangles.Length; i < wound.Length; i++)
            {
                wound[i] = triangles[i - triangles.Length] + backs;
            }
            return wound;
        }
    }
}
