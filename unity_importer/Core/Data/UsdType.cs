using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The types of values, without their roles: a color3f is a Float3.</summary>
    public enum UsdType : byte
    {
        None, Bool, UChar, Int, UInt, Int64, UInt64, Half, Float, Double, TimeCode, String, Token, Asset,
        PathExpression, Matrix2d, Matrix3d, Matrix4d, Quatd, Quatf, Quath,
        Double2, Float2, Half2, Int2, Double3, Float3, Half3, Int3, Double4, Float4, Half4, Int4,
        Dictionary, Path,
    }

    /// <summary>What the numbers of a value are stored as.</summary>
    public enum Storage : byte
    {
        None, Bytes, Ints, UInts, Longs, ULongs, Floats, Doubles, Strings,
    }

    /// <summary>Storage and shape of every type.</summary>
    public static class UsdTypes
    {
        static readonly Dictionary<string, UsdType> ByName = MakeNames();

        /// <summary>The type with this name in a layer ("color3f"), or None.</summary>
        public static UsdType OfName(string name)
        {
            UsdType type;
            return ByName.TryGetValue(name, out type) ? type : UsdType.None;
        }

        /// <summary>Numbers in one element; 9 for a Matrix3d.</summary>
        public static int Components(UsdType type)
        {
            switch (type)
            {
                case UsdType.Double2: case UsdType.Float2: case UsdType.Half2: case UsdType.Int2: return 2;
                case UsdType.Double3: case UsdType.Float3: case UsdType.Half3: case UsdType.Int3: return 3;
                case UsdType.Double4: case UsdType.Float4: case UsdType.Half4: case UsdType.Int4: return 4;
                case UsdType.Quatd: case UsdType.Quatf: case UsdType.Quath: return 4;
                case UsdType.Matrix2d: return 4;
                case UsdType.Matrix3d: return 9;
                case UsdType.Matrix4d: return 16;
                default: return 1;
            }
        }

        /// <summary>Rows that a text gives separate parentheses; 1 for all but matrices.</summary>
        public static int Rows(UsdType type)
        {
            return type == UsdType.Matrix2d ? 2 : type == UsdType.Matrix3d ? 3 : type == UsdType.Matrix4d ? 4 : 1;
        }

        public static Storage StorageOf(UsdType type)
        {
            switch (type)
            {
                case UsdType.Bool: case UsdType.UChar: return Storage.Bytes;
                case UsdType.Int: case UsdType.Int2: case UsdType.Int3: case UsdType.Int4: return Storage.Ints;
                case UsdType.UInt: return Storage.UInts;
                case UsdType.Int64: return Storage.Longs;
                case UsdType.UInt64: return Storage.ULongs;
                case UsdType.Half: case UsdType.Half2: case UsdType.Half3: case UsdType.Half4: case UsdType.Quath:
                case UsdType.Float: case UsdType.Float2: case UsdType.Float3: case UsdType.Float4: case UsdType.Quatf:
                    return Storage.Floats;
                case UsdType.Double: case UsdType.TimeCode: case UsdType.Double2: case UsdType.Double3:
                case UsdType.Double4: case UsdType.Quatd: case UsdType.Matrix2d: case UsdType.Matrix3d:
                case UsdType.Matrix4d:
                    return Storage.Doubles;
                case UsdType.String: case UsdType.Token: case UsdType.Asset: case UsdType.PathExpression:
                case UsdType.Path:
                    return Storage.Strings;
                default: return Storage.None;
            }
        }

        public static bool IsHalf(UsdType type)
        {
            return type == UsdType.Half || type == UsdType.Half2 || type == UsdType.Half3 || type == UsdType.Half4
                || type == UsdType.Quath;
        }

        public static bool IsQuaternion(UsdType type)
        {
            return type == UsdType.Quatd || type == UsdType.Quatf || type == UsdType.Quath;
        }

        static Dictionary<string, UsdType> MakeNames()
        {
            var names = new Dictionary<string, UsdType>
            {
                { "bool", UsdType.Bool }, { "uchar", UsdType.UChar }, { "int", UsdType.Int }, { "uint", UsdType.UInt },
                { "int64", UsdType.Int64 }, { "uint64", UsdType.UInt64 }, { "half", UsdType.Half },
                { "float", UsdType.Float }, { "double", UsdType.Double }, { "timecode", UsdType.TimeCode },
                { "string", UsdType.String }, { "token", UsdType.Token }, { "asset", UsdType.Asset },
                { "pathExpression", UsdType.PathExpression }, { "dictionary", UsdType.Dictionary },
                { "matrix2d", UsdType.Matrix2d }, { "matrix3d", UsdType.Matrix3d }, { "matrix4d", UsdType.Matrix4d },
                { "frame4d", UsdType.Matrix4d }, { "quatd", UsdType.Quatd }, { "quatf", UsdType.Quatf },
                { "quath", UsdType.Quath }, { "double2", UsdType.Double2 }, { "double3", UsdType.Double3 },
                { "double4", UsdType.Double4 }, { "float2", UsdType.Float2 }, { "float3", UsdType.Float3 },
                { "float4", UsdType.Float4 }, { "half2", UsdType.Half2 }, { "half3", UsdType.Half3 },
                { "half4", UsdType.Half4 }, { "int2", UsdType.Int2 }, { "int3", UsdType.Int3 },
                { "int4", UsdType.Int4 },
            };
            foreach (string role in new[] { "point", "normal", "vector", "color", "texCoord" })
            {
                for (int count = 2; count <= 4; count++)
                {
                    bool exists = role == "color" ? count >= 3 : role == "texCoord" ? count <= 3 : count == 3;
                    if (!exists) { continue; }
                    names.Add(role + count + "d", (UsdType)((int)UsdType.Double2 + 4 * (count - 2)));
                    names.Add(role + count + "f", (UsdType)((int)UsdType.Float2 + 4 * (count - 2)));
                    names.Add(role + count + "h", (UsdType)((int)UsdType.Half2 + 4 * (count - 2)));
                }
            }
            foreach (string old in new[] { "Point", "PointFloat", "Normal", "NormalFloat", "Vector", "VectorFloat",
                "Color", "ColorFloat" })
            {
                names.Add(old, old.EndsWith("Float") ? UsdType.Float3 : UsdType.Double3);
            }
            names.Add("Vec2i", UsdType.Int2);
            names.Add("Vec3i", UsdType.Int3);
            names.Add("Vec4i", UsdType.Int4);
            names.Add("Vec2f", UsdType.Float2);
            names.Add("Vec3f", UsdType.Float3);
            names.Add("Vec4f", UsdType.Float4);
            names.Add("Vec2d", UsdType.Double2);
            names.Add("Vec3d", UsdType.Double3);
            names.Add("Vec4d", UsdType.Double4);
            names.Add("Transform", UsdType.Matrix4d);
            names.Add("Frame", UsdType.Matrix4d);
            names.Add("group", UsdType.None);
            names.Add("opaque", UsdType.None);
            return names;
        }
    }
}
