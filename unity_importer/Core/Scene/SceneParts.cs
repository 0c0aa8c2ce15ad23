using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The shapes of UsdLux lights.</summary>
    public enum LightKind
    {
        Rect, Disk, Sphere, Cylinder, Distant, Dome,
    }

    /// <summary>A UsdLux light. It shines along -Z; a cylinder lies along X.</summary>
    public sealed class LightData
    {
        /// <summary>The shape.</summary>
        public LightKind Kind { get; private set; }

        /// <summary>Linear red, green, blue.</summary>
        public float[] Color { get; private set; }

        /// <summary>inputs:intensity, before exposure and normalization: see Luminance.</summary>
        public double Intensity { get; private set; }

        /// <summary>Powers of two by which the intensity is multiplied.</summary>
        public double Exposure { get; private set; }

        /// <summary>Whether the intensity is divided by the area that shines.</summary>
        public bool IsNormalized { get; private set; }

        /// <summary>In units of the stage.</summary>
        public double Width { get; private set; }

        /// <summary>In units of the stage.</summary>
        public double Height { get; private set; }

        /// <summary>In units of the stage.</summary>
        public double Radius { get; private set; }

        /// <summary>In units of the stage.</summary>
        public double Length { get; private set; }

        /// <summary>Degrees that a distant light spans.</summary>
        public double AngleDegrees { get; private set; }

        /// <summary>Half of the cone in degrees; 90 where the light is not shaped.</summary>
        public double ConeAngleDegrees { get; private set; }

        /// <summary>Share of the cone in which the light fades, 0 to 1.</summary>
        public double ConeSoftness { get; private set; }

        /// <summary>Kelvin; 0 where the light's color alone counts.</summary>
        public double ColorTemperature { get; private set; }

        /// <summary>The light of a prim; null where it is none.</summary>
        public static LightData Of(UsdPrim prim)
        {
            LightKind kind;
            switch (prim.TypeName)
            {
                case "RectLight": kind = LightKind.Rect; break;
                case "DiskLight": kind = LightKind.Disk; break;
                case "SphereLight": kind = LightKind.Sphere; break;
                case "CylinderLight": kind = LightKind.Cylinder; break;
                case "DistantLight": kind = LightKind.Distant; break;
                case "DomeLight": case "DomeLight_1": kind = LightKind.Dome; break;
                default: return null;
            }
            UsdValue color = prim.Value("inputs:color");
            return new LightData
            {
                Kind = kind, Color = color == null || color.Data.Length < 3 ? new[] { 1f, 1, 1 } : color.Floats(),
                Intensity = prim.Number("inputs:intensity", kind == LightKind.Distant ? 50000 : 1),
                Exposure = prim.Number("inputs:exposure", 0),
                IsNormalized = prim.Truth("inputs:normalize", false), Width = prim.Number("inputs:width", 1),
                Height = prim.Number("inputs:height", 1),
                Radius = prim.Number("inputs:radius", 0.5), Length = prim.Number("inputs:length", 1),
                AngleDegrees = prim.Number("inputs:angle", 0.53),
                ConeAngleDegrees = prim.Number("inputs:shaping:cone:angle", 90),
                ConeSoftness = prim.Number("inputs:shaping:cone:softness", 0),
                ColorTemperature = prim.Truth("inputs:enableColorTemperature", false)
                    ? prim.Number("inputs:colorTemperature", 6500) : 0,
            };
        }

        /// <summary>Square metres that shine.</summary>
        public double Area(double metersPerUnit)
        {
            double square = metersPerUnit * metersPerUnit;
            switch (Kind)
            {
                case LightKind.Rect: return Width * Height * square;
                case LightKind.Disk: return Math.PI * Radius * Radius * square;
                case LightKind.Sphere: return 4 * Math.PI * Radius * Radius * square;
                case LightKind.Cylinder: return 2 * Math.PI * Radius * Length * square;
                default: return 1;
            }
        }

        // what the intensity of a normalized light is divided by; a distant light without an angle has all its light
        // in one direction
        double Size(double metersPerUnit)
        {
            if (Kind != LightKind.Distant) { return Area(metersPerUnit); }
            double half = Math.Min(AngleDegrees, 360) * Math.PI / 360, square = Math.Sin(half) * Math.Sin(half);
            return half <= 0 ? 1 : Math.PI * (half <= Math.PI / 2 ? square : 2 - square);
        }

        double Emission
        {
            get { return Intensity * Math.Pow(2, Exposure); }
        }

        /// <summary>
        /// Candela a square metre; for a normalized light without a size, which has infinitely many, its intensity.
        /// </summary>
        public double Luminance(double metersPerUnit)
        {
            double size = Size(metersPerUnit);
            return IsNormalized && size > 0 ? Emission / size : Emission;
        }

        // what is divided by the size and multiplied by it again: a normalized light may well have none
        double Sized(double metersPerUnit)
        {
            return IsNormalized ? Emission : Emission * Size(metersPerUnit);
        }

        /// <summary>Candela straight ahead, across the axis for a cylinder; 0 for lights at infinity.</summary>
        public double Candela(double metersPerUnit)
        {
            switch (Kind)
            {
                case LightKind.Rect: case LightKind.Disk: return Sized(metersPerUnit);
                // of the sphere's surface, a disk of a quarter is seen; of the cylinder's, a rectangle
                case LightKind.Sphere: return Sized(metersPerUnit) / 4;
                case LightKind.Cylinder: return Sized(metersPerUnit) / Math.PI;
                default: return 0;
            }
        }

        /// <summary>All lumens of a light with an area.</summary>
        public double Lumen(double metersPerUnit)
        {
            return Kind == LightKind.Distant || Kind == LightKind.Dome ? 0 : Math.PI * Sized(metersPerUnit);
        }

        /// <summary>Lux on a surface that faces a distant light.</summary>
        public double Lux
        {
            get { return Kind != LightKind.Distant ? 0 : Sized(1); }
        }
    }

    /// <summary>
    /// A camera that looks along -Z. Lengths of lens and film are tenths of a unit of the stage, as in USD.
    /// </summary>
    public sealed class CameraData
    {
        /// <summary>Whether lines of sight are parallel.</summary>
        public bool IsOrthographic { get; private set; }

        /// <summary>In tenths of a unit of the stage.</summary>
        public double FocalLength { get; private set; }

        /// <summary>In tenths of a unit of the stage.</summary>
        public double HorizontalAperture { get; private set; }

        /// <summary>In tenths of a unit of the stage.</summary>
        public double VerticalAperture { get; private set; }

        /// <summary>Distance of the near clipping plane in units of the stage.</summary>
        public double Near { get; private set; }

        /// <summary>Distance of the far clipping plane in units of the stage.</summary>
        public double Far { get; private set; }

        /// <summary>Degrees from the lower to the upper edge of the picture.</summary>
        public double VerticalFieldOfViewDegrees
        {
            get { return 2 * Math.Atan(VerticalAperture / (2 * FocalLength)) * 180 / Math.PI; }
        }

        /// <summary>The camera of a prim; null where it is none.</summary>
        public static CameraData Of(UsdPrim prim)
        {
            if (prim.TypeName != "Camera") { return null; }
            UsdValue range = prim.Value("clippingRange");
            double[] clip = range == null || range.Data.Length < 2 ? new double[] { 1, 1000000 } : range.Doubles();
            return new CameraData
            {
                IsOrthographic = prim.Text("projection", "perspective") == "orthographic",
                FocalLength = prim.Number("focalLength", 50),
                HorizontalAperture = prim.Number("horizontalAperture", 20.955),
                VerticalAperture = prim.Number("verticalAperture", 15.2908),
                Near = clip[0], Far = clip[1],
            };
        }
    }

    /// <summary>Cube, Sphere, Cylinder, Capsule, Cone or Plane.</summary>
    public sealed class ShapeData
    {
        /// <summary>The type of the prim.</summary>
        public string Kind { get; private set; }

        /// <summary>Edge of a cube.</summary>
        public double Size { get; private set; }

        /// <summary>In units of the stage, as are all lengths here.</summary>
        public double Radius { get; private set; }

        /// <summary>Along the axis; without the caps for a capsule.</summary>
        public double Height { get; private set; }

        /// <summary>Of a plane.</summary>
        public double Width { get; private set; }

        /// <summary>Of a plane.</summary>
        public double Length { get; private set; }

        /// <summary>'X', 'Y' or 'Z', along which it is high.</summary>
        public char Axis { get; private set; }

        /// <summary>The shape of a prim; null where it is none.</summary>
        public static ShapeData Of(UsdPrim prim)
        {
            switch (prim.TypeName)
            {
                case "Cube": case "Sphere": case "Cylinder": case "Capsule": case "Cone": case "Plane": break;
                default: return null;
            }
            string axis = prim.Text("axis", "Z");
            return new ShapeData
            {
                Kind = prim.TypeName, Size = prim.Number("size", 2),
                Radius = prim.Number("radius", prim.TypeName == "Capsule" ? 0.5 : 1),
                Height = prim.Number("height", prim.TypeName == "Capsule" ? 1 : 2), Width = prim.Number("width", 2),
                Length = prim.Number("length", 2),
                Axis = axis == "X" ? 'X' : axis == "Y" ? 'Y' : 'Z',
            };
        }
    }

    /// <summary>UsdPhysics on a prim: what collides, and how heavy it is.</summary>
    public sealed class ColliderData
    {
        /// <summary>physics:collisionEnabled.</summary>
        public bool IsEnabled { get; private set; }

        /// <summary>
        /// "none", "convexHull", "convexDecomposition", "boundingCube", "boundingSphere", "meshSimplification".
        /// </summary>
        public string Approximation { get; private set; }

        /// <summary>The collider of a prim; null where it has none.</summary>
        public static ColliderData Of(UsdPrim prim)
        {
            if (!prim.HasApi("PhysicsCollisionAPI")) { return null; }
            return new ColliderData
            {
                IsEnabled = prim.Truth("physics:collisionEnabled", true),
                Approximation = prim.Text("physics:approximation", "none"),
            };
        }
    }

    /// <summary>Friction and the like.</summary>
    public sealed class PhysicsMaterialData
    {
        /// <summary>Coefficient of what stands still.</summary>
        public double StaticFriction { get; private set; }

        /// <summary>Coefficient of what slides.</summary>
        public double DynamicFriction { get; private set; }

        /// <summary>Share of the speed that is kept, 0 to 1.</summary>
        public double Restitution { get; private set; }

        /// <summary>Mass units a cubic unit of the stage; 0 where the prim does not say.</summary>
        public double Density { get; private set; }

        /// <summary>The physics material of a prim; null where it has none, or for no prim.</summary>
        public static PhysicsMaterialData Of(UsdPrim prim)
        {
            if (prim == null || !prim.HasApi("PhysicsMaterialAPI")) { return null; }
            return new PhysicsMaterialData
            {
                StaticFriction = prim.Number("physics:staticFriction", 0),
                DynamicFriction = prim.Number("physics:dynamicFriction", 0),
                Restitution = prim.Number("physics:restitution", 0), Density = prim.Number("physics:density", 0),
            };
        }
    }

    /// <summary>BasisCurves.</summary>
    public sealed class CurvesData
    {
        /// <summary>Whether points are joined by straight lines.</summary>
        public bool IsLinear { get; private set; }

        /// <summary>"bezier", "bspline" or "catmullRom", where the curves are cubic.</summary>
        public string Basis { get; private set; }

        /// <summary>"nonperiodic", "periodic" or "pinned".</summary>
        public string Wrap { get; private set; }

        /// <summary>Points of each curve.</summary>
        public int[] VertexCounts { get; private set; }

        /// <summary>Three numbers a point.</summary>
        public float[] Points { get; private set; }

        /// <summary>In units of the stage; empty where none are given.</summary>
        public float[] Widths { get; private set; }

        /// <summary>The curves of a prim; null where it has none, or counts that do not fit its points.</summary>
        public static CurvesData Of(UsdPrim prim)
        {
            if (prim.TypeName != "BasisCurves") { return null; }
            UsdValue counts = prim.Value("curveVertexCounts"), points = prim.Value("points"),
                widths = prim.Value("widths");
            if (counts == null || points == null) { return null; }
            long total = 0;
            foreach (int count in counts.Ints())
            {
                if (count < 0) { return null; }
                total += count;
            }
            if (total * 3 != points.Data.Length) { return null; }
            return new CurvesData
            {
                IsLinear = prim.Text("type", "cubic") == "linear", Basis = prim.Text("basis", "bezier"),
                Wrap = prim.Text("wrap", "nonperiodic"),
                VertexCounts = counts.Ints(), Points = points.Floats(),
                Widths = widths == null ? new float[0] : widths.Floats(),
            };
        }
    }

    /// <summary>A PointInstancer: which prototype stands where.</summary>
    public sealed class PointInstancerData
    {
        /// <summary>Paths of the prototypes.</summary>
        public IList<string> Prototypes { get; private set; }

        /// <summary>
        /// Of each visible instance: the number in the arrays, that of its prototype, and its matrix.
        /// </summary>
        public int[] Numbers { get; private set; }

        /// <summary>Of each visible instance: the number of its prototype.</summary>
        public int[] PrototypeOf { get; private set; }

        /// <summary>Of each visible instance: to the space of the instancer.</summary>
        public double[][] Matrices { get; private set; }

        /// <summary>The instances of a prim; null where it has none.</summary>
        public static PointInstancerData Of(UsdPrim prim)
        {
            UsdValue which = prim.TypeName != "PointInstancer" ? null : prim.Value("protoIndices"),
                where = which == null ? null : prim.Value("positions");
            if (where == null) { return null; }
            int[] kinds = which.Ints();
            float[] positions = where.Floats();
            IList<string> prototypes = prim.Targets("prototypes");
            if (positions.Length < 3 * kinds.Length) { return null; }
            UsdValue turns = prim.Value("orientationsf") ?? prim.Value("orientations"), sizes = prim.Value("scales"),
                names = prim.Value("ids");
            float[] orientations = turns == null || turns.Data.Length < 4 * kinds.Length ? null : turns.Floats();
            float[] scales = sizes == null || sizes.Data.Length < 3 * kinds.Length ? null : sizes.Floats();
            HashSet<long> hidden = Hidden(prim);
            double[] ids = names == null || names.Data.Length < kinds.Length ? null : names.Doubles();
            var numbers = new List<int>();
            var prototypeOf = new List<int>();
            var matrices = new List<double[]>();
            for (int i = 0; i < kinds.Length; i++)
            {
                if ((uint)kinds[i] >= (uint)prototypes.Count || hidden.Contains(ids == null ? i : (long)ids[i]))
                {
                    continue;
                }
                double[] matrix = scales == null ? Matrix4.Identity()
                    : Matrix4.Scaling(scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]);
                if (orientations != null)
                {
                    matrix = Matrix4.Multiply(matrix, Matrix4.Quaternion(orientations[4 * i], orientations[4 * i + 1],
                        orientations[4 * i + 2], orientations[4 * i + 3]));
                }
                for (int k = 0; k < 3; k++) { matrix[12 + k] = positions[3 * i + k]; }
                numbers.Add(i);
                prototypeOf.Add(kinds[i]);
                matrices.Add(matrix);
            }
            return new PointInstancerData
            {
                Prototypes = prototypes, Numbers = numbers.ToArray(), PrototypeOf = prototypeOf.ToArray(),
                Matrices = matrices.ToArray(),
            };
        }

        static HashSet<long> Hidden(UsdPrim prim)
        {
            var hidden = new HashSet<long>();
            UsdValue invisible = prim.Value("invisibleIds");
            foreach (double id in invisible == null ? new double[0] : invisible.Doubles()) { hidden.Add((long)id); }
            return hidden;
        }
    }
}
