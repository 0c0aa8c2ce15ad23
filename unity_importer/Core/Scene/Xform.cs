using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The transform that a prim's xformOps make.</summary>
    public static class Xform
    {
        // types without a place of their own: what such a prim says of a transform means nothing
        static readonly HashSet<string> Placeless = new HashSet<string>
        {
            "", "Backdrop", "BlendShape", "GeomSubset", "LODDistanceHeuristic", "LODScreenSizeHeuristic", "Material",
            "NodeGraph", "PhysicsCollisionGroup", "PhysicsDistanceJoint", "PhysicsFixedJoint", "PhysicsJoint",
            "PhysicsPrismaticJoint", "PhysicsRevoluteJoint", "PhysicsScene", "PhysicsSphericalJoint", "RenderPass",
            "RenderProduct", "RenderSettings", "RenderVar", "Scope", "Shader", "SkelAnimation",
        };

        /// <summary>The matrix to the parent's space; whether the prim leaves its parents' transforms aside.</summary>
        public static double[] Local(UsdPrim prim, out bool resets)
        {
            resets = false;
            double[] local = null;
            UsdValue order = prim.Value("xformOpOrder");
            if (order == null || Placeless.Contains(prim.TypeName)) { return Matrix4.Identity(); }
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
            bool isReal = value != null && (value.Data is float[] || value.Data is double[]);
            if (!isReal || !name.StartsWith("xformOp:", StringComparison.Ordinal)) { return null; }
            double[] v = value.Doubles();
            int end = name.IndexOf(':', 8);
            string kind = end < 0 ? name.Substring(8) : name.Substring(8, end - 8);
            bool isOfOneAxis = (kind.StartsWith("rotate", StringComparison.Ordinal) && kind.Length == 7)
                || (kind.StartsWith("translate", StringComparison.Ordinal) && kind.Length == 10)
                || (kind.StartsWith("scale", StringComparison.Ordinal) && kind.Length == 6);
            int needed = kind == "transform" ? 16 : kind == "orient" ? 4 : isOfOneAxis ? 1 : 3;
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
                case "rotateXYZ": case "rotateXZY": case "rotateYXZ":
                case "rotateYZX": case "rotateZXY": case "rotateZYX":
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
}
