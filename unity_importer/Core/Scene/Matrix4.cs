using System;

namespace Garage.Usd
{
    /// <summary>
    /// 4x4 matrices as USD has them: 16 numbers, row by row, translation in the last row, a point times the matrix.
    /// </summary>
    public static class Matrix4
    {
        /// <summary>What leaves every point where it is.</summary>
        public static double[] Identity()
        {
            return new double[] { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
        }

        /// <summary>A move.</summary>
        public static double[] Translation(double x, double y, double z)
        {
            return new[] { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1 };
        }

        /// <summary>Factors along the axes.</summary>
        public static double[] Scaling(double x, double y, double z)
        {
            return new[] { x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1 };
        }

        /// <summary>A turn about x (0), y (1) or z (2).</summary>
        public static double[] Rotation(int axis, double degrees)
        {
            double angle = degrees * Math.PI / 180, cos = Math.Cos(angle), sin = Math.Sin(angle);
            double[] matrix = Identity();
            int a = (axis + 1) % 3, b = (axis + 2) % 3;
            matrix[5 * a] = cos;
            matrix[5 * b] = cos;
            matrix[4 * a + b] = sin;
            matrix[4 * b + a] = -sin;
            return matrix;
        }

        /// <summary>
        /// The rotation of a quaternion: about (x, y, z), whatever its length, by the angle of whose half w is the
        /// cosine.
        /// </summary>
        public static double[] Quaternion(double w, double x, double y, double z)
        {
            double length = Math.Sqrt(x * x + y * y + z * z);
            if (!(length > 1e-10)) { return Identity(); }
            w = Math.Max(-1, Math.Min(1, w));
            double scale = Math.Sqrt(1 - w * w) / length;
            x *= scale;
            y *= scale;
            z *= scale;
            return new[]
            {
                1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (z * x - y * w), 0,
                2 * (x * y - z * w), 1 - 2 * (z * z + x * x), 2 * (y * z + x * w), 0,
                2 * (z * x + y * w), 2 * (y * z - x * w), 1 - 2 * (y * y + x * x), 0,
                0, 0, 0, 1,
            };
        }

        /// <summary>The first, then the second.</summary>
        public static double[] Multiply(double[] first, double[] second)
        {
            var product = new double[16];
            for (int row = 0; row < 4; row++)
            {
                for (int column = 0; column < 4; column++)
                {
                    double sum = 0;
                    for (int k = 0; k < 4; k++) { sum += first[4 * row + k] * second[4 * k + column]; }
                    product[4 * row + column] = sum;
                }
            }
            return product;
        }

        /// <summary>The inverse, or null where there is none.</summary>
        public static double[] Inverse(double[] matrix)
        {
            var rest = (double[])matrix.Clone();
            double[] inverse = Identity();
            for (int column = 0; column < 4; column++)
            {
                int pivot = column;
                for (int row = column + 1; row < 4; row++)
                {
                    if (Math.Abs(rest[4 * row + column]) > Math.Abs(rest[4 * pivot + column])) { pivot = row; }
                }
                double size = rest[4 * pivot + column];
                if (size == 0 || double.IsNaN(size)) { return null; }
                for (int k = 0; k < 4; k++)
                {
                    Swap(rest, 4 * pivot + k, 4 * column + k);
                    Swap(inverse, 4 * pivot + k, 4 * column + k);
                }
                for (int k = 0; k < 4; k++)
                {
                    rest[4 * column + k] /= size;
                    inverse[4 * column + k] /= size;
                }
                for (int row = 0; row < 4; row++)
                {
                    double factor = rest[4 * row + column];
                    if (row == column || factor == 0) { continue; }
                    for (int k = 0; k < 4; k++)
                    {
                        rest[4 * row + k] -= factor * rest[4 * column + k];
                        inverse[4 * row + k] -= factor * inverse[4 * column + k];
                    }
                }
            }
            return inverse;
        }

        static void Swap(double[] numbers, int a, int b)
        {
            double kept = numbers[a];
            numbers[a] = numbers[b];
            numbers[b] = kept;
        }
    }

    /// <summary>From a stage's axes and units to Unity's: left-handed, Y up, metres.</summary>
    public struct Basis
    {
        readonly bool isZUp;

        /// <summary>Metres of one unit of the stage.</summary>
        public readonly double MetersPerUnit;

        /// <summary>Of a stage with +Z, otherwise +Y, pointing up.</summary>
        public Basis(bool isZUp, double metersPerUnit)
        {
            this.isZUp = isZUp;
            MetersPerUnit = metersPerUnit;
        }

        /// <summary>Of a stage.</summary>
        public static Basis Of(UsdStage stage)
        {
            return new Basis(stage.IsZUp, stage.MetersPerUnit);
        }

        /// <summary>Whether +Z points up in the stage; otherwise +Y does.</summary>
        public bool IsZUp
        {
            get { return isZUp; }
        }

        /// <summary>(x, z, y) for Z up, (x, y, -z) for Y up, without units.</summary>
        public void Direction(double x, double y, double z, double[] into)
        {
            into[0] = x;
            into[1] = isZUp ? z : y;
            into[2] = isZUp ? y : -z;
        }

        /// <summary>(w, x, y, z) of the same rotation in Unity's axes.</summary>
        public double[] Rotation(double w, double x, double y, double z)
        {
            return isZUp ? new[] { w, -x, -z, -y } : new[] { w, -x, -y, z };
        }

        /// <summary>Vectors of three numbers in a new array, with or without units.</summary>
        public float[] Vectors(float[] vectors, bool withUnits)
        {
            var turned = new float[vectors.Length];
            double scale = withUnits ? MetersPerUnit : 1;
            for (int i = 0; i + 2 < vectors.Length; i += 3)
            {
                turned[i] = (float)(vectors[i] * scale);
                turned[i + 1] = (float)((isZUp ? vectors[i + 2] : vectors[i + 1]) * scale);
                turned[i + 2] = (float)((isZUp ? vectors[i + 1] : -vectors[i + 2]) * scale);
            }
            return turned;
        }

        /// <summary>B M B^-1, translation in metres.</summary>
        public double[] Matrix(double[] matrix)
        {
            var basis = isZUp ? new double[] { 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1 }
                : Matrix4.Scaling(1, 1, -1);
            // both bases are their own inverses
            double[] turned = Matrix4.Multiply(Matrix4.Multiply(basis, matrix), basis);
            for (int i = 12; i < 15; i++) { turned[i] *= MetersPerUnit; }
            return turned;
        }
    }
}
