using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;

namespace Garage.Usd
{
    /// <summary>
    /// One TriangleMesh for all mesh prims that hold the very same values: a crate has the arrays of equal meshes once.
    /// </summary>
    sealed class MeshMemo
    {
        readonly Dictionary<Source, TriangleMesh> meshes = new Dictionary<Source, TriangleMesh>();

        /// <summary>As TriangleMesh.Build.</summary>
        public TriangleMesh Of(UsdPrim prim, out string reason)
        {
            // parts of a mesh that have materials of their own are prims of their own
            if (prim.Children.Count > 0) { return TriangleMesh.Build(prim, out reason); }
            reason = null;
            var source = new Source(prim);
            TriangleMesh mesh;
            if (meshes.TryGetValue(source, out mesh)) { return mesh; }
            mesh = TriangleMesh.Build(prim, out reason);
            if (mesh != null) { meshes.Add(source, mesh); }
            return mesh;
        }

        /// <summary>All that a mesh is made of, arrays by identity.</summary>
        sealed class Source : IEquatable<Source>
        {
            readonly List<object> parts = new List<object>();
            readonly int hash;

            public Source(UsdPrim prim)
            {
                foreach (string name in prim.PropertyNames)
                {
                    if (!TriangleMesh.Reads(name)) { continue; }
                    UsdProperty property = prim.Property(name);
                    UsdValue value = property.Value;
                    parts.Add(name);
                    parts.Add(value == null || value.IsArray ? value : (object)value.Text ?? value.Number(0));
                    parts.Add(property.MetadataText("interpolation"));
                    hash = hash * 31 + (value == null || !value.IsArray ? 0 : RuntimeHelpers.GetHashCode(value));
                }
            }

            public bool Equals(Source other)
            {
                if (hash != other.hash || parts.Count != other.parts.Count) { return false; }
                for (int i = 0; i < parts.Count; i++)
                {
                    if (!Equals(parts[i], other.parts[i])) { return false; }
                }
                return true;
            }

            public override bool Equals(object other)
            {
                var source = other as Source;
                return source != null && Equals(source);
            }

            public override int GetHashCode()
            {
                return hash;
            }
        }
    }
}
