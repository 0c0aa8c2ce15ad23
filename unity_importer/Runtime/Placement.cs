using System;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Where something stands in its parent, in Unity's axes: a matrix taken apart.</summary>
    public struct Placement
    {
        /// <summary>Metres.</summary>
        public Vector3 Position;

        /// <summary>Of what the scale has stretched.</summary>
        public Quaternion Rotation;

        /// <summary>x is negative where the matrix mirrors.</summary>
        public Vector3 Scale;

        /// <summary>The largest cosine between two axes: 0 for a matrix that is not sheared, so that the parts say it
        /// all.</summary>
        public float Shear;

        /// <summary>B M B^-1 of a matrix of the stage, taken apart.</summary>
        public static Placement Of(Basis basis, double[] matrix)
        {
            double[] m = basis.Matrix(matrix);
            double x = Length(m, 0), y = Length(m, 4), z = Length(m, 8);
            var placement = new Placement
            {
                Position = new Vector3((float)m[12], (float)m[13], (float)m[14]), Rotation = Quaternion.identity,
                Scale = new Vector3((float)x, (float)y, (float)z),
            };
            if (!(x > 1e-12 && y > 1e-12 && z > 1e-12)) { return placement; }
            if (Determinant(m) < 0)
            {
                x = -x;
                placement.Scale.x = (float)x;
            }
            for (int k = 0; k < 3; k++)
            {
                m[k] /= x;
                m[4 + k] /= y;
                m[8 + k] /= z;
            }
            placement.Shear = (float)Math.Max(Math.Abs(Dot(m, 0, 4)),
                Math.Max(Math.Abs(Dot(m, 4, 8)), Math.Abs(Dot(m, 8, 0))));
            if (placement.Shear > 1e-6) { MakeSquare(m); }
            placement.Rotation = Turn(m);
            return placement;
        }

        /// <summary>Puts a transform there.</summary>
        public void ApplyTo(Transform transform)
        {
            transform.localPosition = Position;
            transform.localRotation = Rotation;
            transform.localScale = Scale;
        }

        static double Length(double[] m, int row)
        {
            return Math.Sqrt(Dot(m, row, row));
        }

        static double Dot(double[] m, int a, int b)
        {
            return m[a] * m[b] + m[a + 1] * m[b + 1] + m[a + 2] * m[b + 2];
        }

        static double Determinant(double[] m)
        {
            return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8])
                + m[2] * (m[4] * m[9] - m[5] * m[8]);
        }

        // keeps the first axis, turns the second one within their plane
        static void MakeSquare(double[] m)
        {
            double along = Dot(m, 0, 4);
            for (int k = 0; k < 3; k++) { m[4 + k] -= along * m[k]; }
            double length = Length(m, 4);
            for (int k = 0; k < 3; k++) { m[4 + k] /= length; }
            m[8] = m[1] * m[6] - m[2] * m[5];
            m[9] = m[2] * m[4] - m[0] * m[6];
            m[10] = m[0] * m[5] - m[1] * m[4];
        }

        // rows are what becomes of the axes
        static Quaternion Turn(double[] m)
        {
            double trace = m[0] + m[5] + m[10];
            if (trace > 0)
            {
                double s = 2 * Math.Sqrt(trace + 1);
                return new Quaternion((float)((m[6] - m[9]) / s), (float)((m[8] - m[2]) / s),
                    (float)((m[1] - m[4]) / s), (float)(s / 4));
            }
            if (m[0] > m[5] && m[0] > m[10])
            {
                double s = 2 * Math.Sqrt(1 + m[0] - m[5] - m[10]);
                return new Quaternion((float)(s / 4), (float)((m[1] + m[4]) / s), (float)((m[8] + m[2]) / s),
                    (float)((m[6] - m[9]) / s));
            }
            if (m[5] > m[10])
            {
                double s = 2 * Math.Sqrt(1 + m[5] - m[0] - m[10]);
                return new Quaternion((float)((m[1] + m[4]) / s), (float)(s / 4), (float)((m[6] + m[9]) / s),
                    (float)((m[8] - m[2]) / s));
            }
            double size = 2 * Math.Sqrt(1 + m[10] - m[0] - m[5]);
            return new Quaternion((float)((m[8] + m[2]) / size), (float)((m[6] + m[9]) / size), (float)(size / 4),
                (float)((m[1] - m[4]) / size));
        }
    }
}
