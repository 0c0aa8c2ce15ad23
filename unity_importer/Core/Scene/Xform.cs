using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The transform that a prim's xformOps make.</summary>
    public static class Xform
    {
        /// <summary>The matrix to the parent's space; whether the prim leaves its parents' transforms aside.</summary>
        public static double[] Local(UsdPrim prim, out bool resets)
        {
            resets = false;
            double[] local = null;
            UsdValue order = prim.Value("xformOpOrder");
            if (order == null) { return Matrix4.Identity(); }
            string[] names = order.Texts;
            int first = 0;
            for (int i = 0; i < names.Length; i++)
            {
                if (names[i] != "!resetXformStack!") { continue; }
                resets = true;
                first = i + 1;
            }
            // the last operation is nearest to the points
            for (int i = names.Length - 1; i >= first; i--)
            {
                bool inverts = names[i].StartsWith("!invert!", StringComparison.Ordinal);
                string name = inverts ? names[i].Substring(8) : names[i];
                double[] matrix = Operation(name, prim.Value(name));
                if (matrix == null) { continue; }
                if (inverts) { matrix = Matrix4.Inverse(matrix) ?? Matrix4.Identity(); }
                local = local == null ? matrix : Matrix4.Multiply(local, matrix);
            }
            return local ?? Matrix4.Identity();
        }

        static double[] Operation(string name, UsdValue value)
        {
            if (value == null || !name.StartsWith("xformOp:", StringComparison.Ordinal)) { return null; }
            double[] v = value.Doubles();
            int end = name.IndexOf(':', 8);
            string kind = end < 0 ? name.Substring(8) : name.Substring(8, end - 8);
            int needed = kind == "transform" ? 16 : kind == "orient" ? 4 : kind.Length == 7 && kind.StartsWith("rotate", StringComparison.Ordinal) ? 1
                : kind.StartsWith("translate", StringComparison.Ordinal) && kind.Length == 10 ? 1
                : kind.StartsWith("scale", StringComparison.Ordinal) && kind.Length == 6 ? 1 : 3;
            if (v.Length < needed) { return null; }
            switch (kind)
            {
                case "translate": return Matrix4.Translation(v[0], v[1], v[2]);
                case "translateX": return Matrix4.Translation(v[0], 0, 0);
                case "translateY": return Matrix4.Translation(0, v[0], 0);
                case "translateZ": return Matrix4.Translation(0, 0, v[0]);
                case "scale": return Matrix4.Scaling(v[0], v[1], v[2]);
                case "scaleX": return Matrix4.Scaling(v[0], 1, 1);
                case "scaleY": return Matrix4.Scaling(1, v[0], 1);
                case "scaleZ": return Matrix4.Scaling(1, 1, v[0]);
                case "rotateX": return Matrix4.Rotation(0, v[0]);
                case "rotateY": return Matrix4.Rotation(1, v[0]);
                case "rotateZ": return Matrix4.Rotation(2, v[0]);
                case "orient": return Matrix4.Quaternion(v[0], v[1], v[2], v[3]);
                case "transform": return v.Length == 16 ? (double[])v.Clone() : null;
                case "rotateXYZ": case "rotateXZY": case "rotateYXZ": case "rotateYZX": case "rotateZXY": case "rotateZYX":
                    double[] turned = Matrix4.Identity();
                    for (int i = 6; i < 9; i++)
                    {
                        int axis = kind[i] - 'X';
                        turned = Matrix4.Multiply(turned, Matrix4.Rotation(axis, v[axis]));
                    }
                    return turned;
                default: return null;
            }
        }
    }

    /// <summary>Which material a prim shows.</summary>
    public struct MaterialBinding
    {
        /// <summary>Path of the material; null where none is bound.</summary>
        public readonly string Path;

        /// <summary>Whether it wins over what is bound below.</summary>
        public readonly bool IsStrong;

        public MaterialBinding(string path, bool isStrong)
        {
            Path = path;
            IsStrong = isStrong;
        }

        /// <summary>
        /// The binding of the prim itself for a purpose ("preview", "full", "physics"), and for all purposes where there is none
        /// for this one.
        /// </summary>
        public static MaterialBinding Of(UsdPrim prim, string purpose)
        {
            MaterialBinding special = Direct(prim, "material:binding:" + purpose);
            return special.Path != null ? special : Direct(prim, "material:binding");
        }

        static MaterialBinding Direct(UsdPrim prim, string name)
        {
            UsdProperty relationship = prim.Property(name);
            if (relationship == null || !relationship.IsRelationship) { return new MaterialBinding(null, false); }
            IList<string> targets = relationship.Targets;
            if (targets.Count == 0) { return new MaterialBinding(null, false); }
            return new MaterialBinding(targets[0], relationship.MetadataText("bindMaterialAs") == "strongerThanDescendants");
        }

        /// <summary>This binding below one that it inherits.</summary>
        public MaterialBinding Under(MaterialBinding above)
        {
            return Path == null || above.IsStrong ? above : this;
        }
    }
}
