using System;

namespace UnityEngine
{
    public struct Vector2 : IEquatable<Vector2>
    {
        public float x, y;

        public Vector2(float x, float y)
        {
            this.x = x;
            this.y = y;
        }

        public static Vector2 zero { get { return new Vector2(0, 0); } }
        public static Vector2 one { get { return new Vector2(1, 1); } }

        public static bool operator ==(Vector2 a, Vector2 b) { return (a.x - b.x) * (a.x - b.x)
            + (a.y - b.y) * (a.y - b.y) < 9.99999944E-11f; }
        public static bool operator !=(Vector2 a, Vector2 b) { return !(a == b); }
        public bool Equals(Vector2 other) { return x == other.x && y == other.y; }
        public override bool Equals(object other) { return other is Vector2 && Equals((Vector2)other); }
        public override int GetHashCode() { return x.GetHashCode() ^ (y.GetHashCode() << 2); }
    }

    public struct Vector2Int
    {
        public int x { get; set; }
        public int y { get; set; }

        public Vector2Int(int x, int y) : this()
        {
            this.x = x;
            this.y = y;
        }
    }

    public struct Vector3 : IEquatable<Vector3>
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }

        public static Vector3 zero { get { return new Vector3(0, 0, 0); } }
        public static Vector3 one { get { return new Vector3(1, 1, 1); } }
        public static Vector3 up { get { return new Vector3(0, 1, 0); } }
        public static Vector3 forward { get { return new Vector3(0, 0, 1); } }
        public float magnitude { get { return (float)Math.Sqrt(sqrMagnitude); } }
        public float sqrMagnitude { get { return x * x + y * y + z * z; } }

        public Vector3 normalized
        {
            get { return magnitude > 1E-05f ? this / magnitude : zero; }
        }

        public static float Dot(Vector3 lhs, Vector3 rhs) { return lhs.x * rhs.x + lhs.y * rhs.y + lhs.z * rhs.z; }

        public static Vector3 Cross(Vector3 lhs, Vector3 rhs)
        {
            return new Vector3(lhs.y * rhs.z - lhs.z * rhs.y, lhs.z * rhs.x - lhs.x * rhs.z,
                lhs.x * rhs.y - lhs.y * rhs.x);
        }

        public static float Distance(Vector3 a, Vector3 b) { return (a - b).magnitude; }
        public static Vector3 Scale(Vector3 a, Vector3 b) { return new Vector3(a.x * b.x, a.y * b.y, a.z * b.z); }

        public static Vector3 Lerp(Vector3 a, Vector3 b, float t)
        {
            t = Mathf.Clamp01(t);
            return a + (b - a) * t;
        }

        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
        public static Vector3 operator -(Vector3 a) { return new Vector3(-a.x, -a.y, -a.z); }
        public static Vector3 operator *(Vector3 a, float d) { return new Vector3(a.x * d, a.y * d, a.z * d); }
        public static Vector3 operator *(float d, Vector3 a) { return a * d; }
        public static Vector3 operator /(Vector3 a, float d) { return new Vector3(a.x / d, a.y / d, a.z / d); }
        public static bool operator ==(Vector3 lhs, Vector3 rhs) { return (lhs - rhs).sqrMagnitude < 9.99999944E-11f; }
        public static bool operator !=(Vector3 lhs, Vector3 rhs) { return !(lhs == rhs); }
        public bool Equals(Vector3 other) { return x == other.x && y == other.y && z == other.z; }
        public override bool Equals(object other) { return other is Vector3 && Equals((Vector3)other); }
        public override int GetHashCode() { return x.GetHashCode() ^ (y.GetHashCode() << 2) ^ (z.GetHashCode() >> 2); }
        public override string ToString() { return "(" + x + ", " + y + ", " + z + ")"; }
    }

    public struct Vector4
    {
        public float x, y, z, w;

        public Vector4(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }
    }

    public struct Quaternion
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion identity { get { return new Quaternion(0, 0, 0, 1); } }

        /// <summary>About z, then x, then y.</summary>
        public static Quaternion Euler(float x, float y, float z)
        {
            return AngleAxis(y, new Vector3(0, 1, 0)) * AngleAxis(x, new Vector3(1, 0, 0)) * AngleAxis(z,
                new Vector3(0, 0, 1));
        }

        public static Quaternion AngleAxis(float angle, Vector3 axis)
        {
            double half = angle * Math.PI / 360;
            Vector3 v = axis.normalized * (float)Math.Sin(half);
            return new Quaternion(v.x, v.y, v.z, (float)Math.Cos(half));
        }

        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards)
        {
            Vector3 z = forward.normalized, x = Vector3.Cross(upwards, z).normalized, y = Vector3.Cross(z, x);
            double w = Math.Sqrt(Math.Max(0, 1 + x.x + y.y + z.z)) / 2,
                a = Math.Sqrt(Math.Max(0, 1 + x.x - y.y - z.z)) / 2;
            double b = Math.Sqrt(Math.Max(0, 1 - x.x + y.y - z.z)) / 2,
                c = Math.Sqrt(Math.Max(0, 1 - x.x - y.y + z.z)) / 2;
            return new Quaternion((float)Signed(a, y.z - z.y), (float)Signed(b, z.x - x.z),
                (float)Signed(c, x.y - y.x), (float)w);
        }

        static double Signed(double size, double sign) { return sign < 0 ? -size : size; }

        public static Quaternion Slerp(Quaternion a, Quaternion b, float t)
        {
            t = Mathf.Clamp01(t);
            double dot = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w, sign = dot < 0 ? -1 : 1;
            double angle = Math.Acos(Math.Min(1, Math.Abs(dot))), sine = Math.Sin(angle);
            double first = sine < 1e-6 ? 1 - t
                : Math.Sin((1 - t) * angle) / sine, second = sign * (sine < 1e-6 ? t : Math.Sin(t * angle) / sine);
            return new Quaternion((float)(first * a.x + second * b.x), (float)(first * a.y + second * b.y),
                (float)(first * a.z + second * b.z),
                (float)(first * a.w + second * b.w));
        }

        public static Quaternion operator *(Quaternion lhs, Quaternion rhs)
        {
            return new Quaternion(lhs.w * rhs.x + lhs.x * rhs.w + lhs.y * rhs.z - lhs.z * rhs.y, lhs.w * rhs.y
                + lhs.y * rhs.w + lhs.z * rhs.x - lhs.x * rhs.z,
                lhs.w * rhs.z + lhs.z * rhs.w
                    + lhs.x * rhs.y - lhs.y * rhs.x, lhs.w * rhs.w - lhs.x * rhs.x - lhs.y * rhs.y - lhs.z * rhs.z);
        }

        public static Vector3 operator *(Quaternion rotation, Vector3 point)
        {
            var axis = new Vector3(rotation.x, rotation.y, rotation.z);
            Vector3 twice = 2 * Vector3.Cross(axis, point);
            return point + rotation.w * twice + Vector3.Cross(axis, twice);
        }

        public static Quaternion Inverse(Quaternion rotation) { return new Quaternion(-rotation.x, -rotation.y,
            -rotation.z, rotation.w); }
    }

    public struct Matrix4x4
    {
        /// <summary>mRC: row, column; a column vector is multiplied from the right.</summary>
        public float m00, m10, m20, m30, m01, m11, m21, m31, m02, m12, m22, m32, m03, m13, m23, m33;

        public static Matrix4x4 identity
        {
            get { return new Matrix4x4 { m00 = 1, m11 = 1, m22 = 1, m33 = 1 }; }
        }

        public static Matrix4x4 TRS(Vector3 pos, Quaternion q, Vector3 s)
        {
            Vector3 x = q * new Vector3(s.x, 0, 0), y = q * new Vector3(0, s.y, 0), z = q * new Vector3(0, 0, s.z);
            return new Matrix4x4
            {
                m00 = x.x, m10 = x.y, m20 = x.z, m01 = y.x, m11 = y.y, m21 = y.z, m02 = z.x, m12 = z.y, m22 = z.z,
                    m03 = pos.x, m13 = pos.y, m23 = pos.z, m33 = 1,
            };
        }

        public static Matrix4x4 operator *(Matrix4x4 a, Matrix4x4 b)
        {
            // of matrices whose last row is (0, 0, 0, 1)
            Vector3 x = a.MultiplyVector(new Vector3(b.m00, b.m10, b.m20)),
                y = a.MultiplyVector(new Vector3(b.m01, b.m11, b.m21));
            Vector3 z = a.MultiplyVector(new Vector3(b.m02, b.m12, b.m22)),
                p = a.MultiplyPoint3x4(new Vector3(b.m03, b.m13, b.m23));
            return new Matrix4x4
            {
                m00 = x.x, m10 = x.y, m20 = x.z, m01 = y.x, m11 = y.y, m21 = y.z, m02 = z.x, m12 = z.y, m22 = z.z,
                    m03 = p.x, m13 = p.y, m23 = p.z, m33 = 1,
            };
        }

        public Vector3 MultiplyPoint3x4(Vector3 point)
        {
            return MultiplyVector(point) + new Vector3(m03, m13, m23);
        }

        public Vector3 MultiplyVector(Vector3 v)
        {
            return new Vector3(m00 * v.x + m01 * v.y + m02 * v.z, m10 * v.x + m11 * v.y + m12 * v.z, m20 * v.x
                + m21 * v.y + m22 * v.z);
        }

        public Matrix4x4 inverse
        {
            get
            {
                Vector3 x = new Vector3(m00, m10, m20), y = new Vector3(m01, m11, m21), z = new Vector3(m02, m12, m22);
                Vector3 yz = Vector3.Cross(y, z), zx = Vector3.Cross(z, x), xy = Vector3.Cross(x, y);
                float determinant = Vector3.Dot(x, yz);
                yz /= determinant;
                zx /= determinant;
                xy /= determinant;
                var inverse = new Matrix4x4
                {
                    m00 = yz.x, m01 = yz.y, m02 = yz.z, m10 = zx.x, m11 = zx.y, m12 = zx.z, m20 = xy.x, m21 = xy.y,
                        m22 = xy.z, m33 = 1,
                };
                Vector3 back = inverse.MultiplyVector(new Vector3(m03, m13, m23));
                inverse.m03 = -back.x;
                inverse.m13 = -back.y;
                inverse.m23 = -back.z;
                return inverse;
            }
        }
    }

    public struct Color
    {
        public float r, g, b, a;

        public Color(float r, float g, float b, float a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }

        public Color(float r, float g, float b) : this(r, g, b, 1)
        {
        }

        public static Color white { get { return new Color(1, 1, 1, 1); } }
        public static Color black { get { return new Color(0, 0, 0, 1); } }
        public static Color green { get { return new Color(0, 1, 0, 1); } }
        public static Color yellow { get { return new Color(1, 0.921568632f, 0.0156862754f, 1); } }
        public static Color cyan { get { return new Color(0, 1, 1, 1); } }

        /// <summary>Of a linear colour, as a screen's sRGB.</summary>
        public Color gamma
        {
            get
            {
                return new Color(Mathf.LinearToGammaSpace(r), Mathf.LinearToGammaSpace(g), Mathf.LinearToGammaSpace(b),
                    a);
            }
        }

        public float maxColorComponent { get { return Math.Max(r, Math.Max(g, b)); } }

        public static Color operator *(Color a, float b) { return new Color(a.r * b, a.g * b, a.b * b, a.a * b); }
    }

    public struct Color32
    {
        public byte r, g, b, a;

        public Color32(byte r, byte g, byte b, byte a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }
    }

    public struct Bounds
    {
        public Bounds(Vector3 center, Vector3 size) : this()
        {
            this.center = center;
            extents = size * 0.5f;
        }

        public Vector3 center { get; set; }
        public Vector3 extents { get; set; }

        public Vector3 size
        {
            get { return extents * 2; }
            set { extents = value * 0.5f; }
        }

        public Vector3 min { get { return center - extents; } }
        public Vector3 max { get { return center + extents; } }

        public void Encapsulate(Vector3 point)
        {
            var low = new Vector3(Math.Min(min.x, point.x), Math.Min(min.y, point.y), Math.Min(min.z, point.z));
            var high = new Vector3(Math.Max(max.x, point.x), Math.Max(max.y, point.y), Math.Max(max.z, point.z));
            center = (low + high) * 0.5f;
            extents = (high - low) * 0.5f;
        }

        public void Encapsulate(Bounds bounds)
        {
            Encapsulate(bounds.min);
            Encapsulate(bounds.max);
        }

        public void Expand(float amount)
        {
            extents += new Vector3(amount, amount, amount) * 0.5f;
        }
    }

    public struct Mathf
    {
        public const float PI = (float)Math.PI;
        public const float Deg2Rad = PI * 2 / 360;
        public const float Rad2Deg = 1 / Deg2Rad;

        public static float Sqrt(float f) { return (float)Math.Sqrt(f); }
        public static float Pow(float f, float p) { return (float)Math.Pow(f, p); }
        public static float Acos(float f) { return (float)Math.Acos(f); }
        public static float Abs(float f) { return Math.Abs(f); }
        public static float Max(float a, float b) { return a > b ? a : b; }
        public static int Max(int a, int b) { return a > b ? a : b; }
        public static float Min(float a, float b) { return a < b ? a : b; }
        public static int Min(int a, int b) { return a < b ? a : b; }
        public static float Clamp(float value, float min, float max) { return value < min ? min : value > max ? max
            : value; }
        public static float Clamp01(float value) { return Clamp(value, 0, 1); }
        public static int RoundToInt(float f) { return (int)Math.Round(f); }

        public static float LinearToGammaSpace(float value)
        {
            return value <= 0.0031308f ? 12.92f * value : 1.055f * (float)Math.Pow(value, 1 / 2.4) - 0.055f;
        }

        public static float GammaToLinearSpace(float value)
        {
            return value <= 0.04045f ? value / 12.92f : (float)Math.Pow((value + 0.055) / 1.055, 2.4);
        }
    }
}
