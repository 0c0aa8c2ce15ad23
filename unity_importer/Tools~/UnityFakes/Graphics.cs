using System;
using System.Collections.Generic;
using UnityEngine.Rendering;

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }

    public enum ShadowCastingMode { Off, On, TwoSided, ShadowsOnly }

    public enum BlendMode
    {
        Zero, One, DstColor, SrcColor, OneMinusDstColor, SrcAlpha, OneMinusSrcColor, DstAlpha, OneMinusDstAlpha,
            SrcAlphaSaturate, OneMinusSrcAlpha,
    }

    public enum RenderQueue { Background = 1000, Geometry = 2000, AlphaTest = 2450, GeometryLast = 2500,
        Transparent = 3000, Overlay = 4000 }

    public abstract class RenderPipelineAsset : ScriptableObject
    {
    }

    public sealed class GraphicsSettings : Object
    {
        /// <summary>What a test sets; null is the built-in pipeline.</summary>
        internal static RenderPipelineAsset inUse;

        public static RenderPipelineAsset currentRenderPipeline { get { return inUse; } }

        /// <summary>False in new projects with the built-in pipeline; the others set it.</summary>
        public static bool lightsUseLinearIntensity { get; set; }
    }
}

namespace UnityEngine
{
    public enum ColorSpace { Uninitialized = -1, Gamma = 0, Linear = 1 }

    public sealed class QualitySettings : Object
    {
        internal static ColorSpace inUse = ColorSpace.Linear;

        public static ColorSpace activeColorSpace { get { return inUse; } }
    }

    public sealed class Mesh : Object
    {
        Vector3[] points = new Vector3[0];
        Vector3[] directions = new Vector3[0];
        Vector4[] sideways = new Vector4[0];
        Vector2[] first = new Vector2[0], second = new Vector2[0];
        Color[] vertexColors = new Color[0];
        int[][] parts = { new int[0] };

        public IndexFormat indexFormat { get; set; }
        public Bounds bounds { get; set; }
        public int vertexCount { get { return points.Length; } }

        public Vector3[] vertices
        {
            get { return (Vector3[])points.Clone(); }
            set
            {
                points = (Vector3[])value.Clone();
                RecalculateBounds();
            }
        }

        public Vector3[] normals
        {
            get { return (Vector3[])directions.Clone(); }
            set { directions = Fitting(value); }
        }

        public Vector4[] tangents
        {
            get { return (Vector4[])sideways.Clone(); }
            set { sideways = Fitting(value); }
        }

        public Vector2[] uv
        {
            get { return (Vector2[])first.Clone(); }
            set { first = Fitting(value); }
        }

        public Vector2[] uv2
        {
            get { return (Vector2[])second.Clone(); }
            set { second = Fitting(value); }
        }

        public Color[] colors
        {
            get { return (Color[])vertexColors.Clone(); }
            set { vertexColors = Fitting(value); }
        }

        T[] Fitting<T>(T[] values)
        {
            if (values.Length != 0 && values.Length != points.Length)
            {
                throw new ArgumentException(values.Length + " values for " + points.Length + " vertices");
            }
            return (T[])values.Clone();
        }

        public int subMeshCount
        {
            get { return parts.Length; }
            set
            {
                int before = parts.Length;
                Array.Resize(ref parts, value);
                for (int i = before; i < value; i++) { parts[i] = new int[0]; }
            }
        }

        public int[] triangles
        {
            get
            {
                var all = new List<int>();
                foreach (int[] part in parts) { all.AddRange(part); }
                return all.ToArray();
            }
        }

        public int[] GetTriangles(int submesh)
        {
            return (int[])parts[submesh].Clone();
        }

        public void SetTriangles(int[] triangles, int submesh)
        {
            if ((uint)submesh >= (uint)parts.Length) { throw new ArgumentException("there is no submesh " + submesh); }
            if (triangles.Length % 3 != 0) { throw new ArgumentException("triangles need three indices each"); }
            if (indexFormat == IndexFormat.UInt16 && points.Length > 65535)
            {
                throw new ArgumentException("more vertices than 16 bits can tell");
            }
            foreach (int index in triangles)
            {
                if ((uint)index >= (uint)points.Length)
                {
                    throw new ArgumentException("an index of a triangle is not that of a vertex");
                }
            }
            parts[submesh] = (int[])triangles.Clone();
            RecalculateBounds();
        }

        public void RecalculateBounds()
        {
            if (points.Length == 0)
            {
                bounds = new Bounds();
                return;
            }
            Vector3 low = points[0], high = points[0];
            foreach (Vector3 point in points)
            {
                if (point.x < low.x) { low.x = point.x; }
                if (point.y < low.y) { low.y = point.y; }
                if (point.z < low.z) { low.z = point.z; }
                if (point.x > high.x) { high.x = point.x; }
                if (point.y > high.y) { high.y = point.y; }
                if (point.z > high.z) { high.z = point.z; }
            }
            bounds = new Bounds((low + high) * 0.5f, high - low);
        }

        /// <summary>Along the first texture coordinate; w is -1 where the second one runs against the cross
        /// product.</summary>
        public void RecalculateTangents()
        {
            if (first.Length == 0 || directions.Length == 0) { return; }
            var along = new Vector3[points.Length];
            var across = new Vector3[points.Length];
            foreach (int[] part in parts)
            {
                for (int i = 0; i < part.Length; i += 3)
                {
                    int a = part[i], b = part[i + 1], c = part[i + 2];
                    Vector3 p = points[b] - points[a], q = points[c] - points[a];
                    float s = first[b].x - first[a].x, t = first[b].y - first[a].y, u = first[c].x - first[a].x,
                        v = first[c].y - first[a].y;
                    float area = s * v - u * t;
                    if (area == 0) { continue; }
                    Vector3 one = (p * v - q * t) / area, other = (q * s - p * u) / area;
                    foreach (int vertex in new[] { a, b, c })
                    {
                        along[vertex] += one;
                        across[vertex] += other;
                    }
                }
            }
            sideways = new Vector4[points.Length];
            for (int i = 0; i < points.Length; i++)
            {
                Vector3 normal = directions[i],
                    tangent = (along[i] - normal * Vector3.Dot(normal, along[i])).normalized;
                sideways[i] = new Vector4(tangent.x, tangent.y, tangent.z,
                    Vector3.Dot(Vector3.Cross(normal, tangent), across[i]) < 0 ? -1 : 1);
            }
        }
    }

    public enum TextureFormat { Alpha8 = 1, RGB24 = 3, RGBA32 = 4, ARGB32 = 5, DXT1 = 10, DXT5 = 12 }

    public enum TextureWrapMode { Repeat, Clamp, Mirror, MirrorOnce }

    public enum FilterMode { Point, Bilinear, Trilinear }

    public class Texture : Object
    {
        public virtual int width { get; set; }
        public virtual int height { get; set; }
        public TextureWrapMode wrapModeU { get; set; }
        public TextureWrapMode wrapModeV { get; set; }
        public FilterMode filterMode { get; set; }
        public int anisoLevel { get; set; }
    }

    public sealed class Texture2D : Texture
    {
        internal byte[] file;
        internal readonly bool isLinear, hasMipmaps;
        internal bool isCompressed, isReadOnce;
        Color32[] pixels;

        public Texture2D(int width, int height, TextureFormat textureFormat, bool mipChain, bool linear)
        {
            this.width = width;
            this.height = height;
            format = textureFormat;
            hasMipmaps = mipChain;
            isLinear = linear;
        }

        public static Texture2D whiteTexture
        {
            get
            {
                var white = new Texture2D(4, 4, TextureFormat.RGBA32, true, false);
                var values = new Color32[16];
                for (int i = 0; i < 16; i++) { values[i] = new Color32(255, 255, 255, 255); }
                white.SetPixels32(values);
                return white;
            }
        }

        public TextureFormat format { get; internal set; }
        public bool isReadable { get { return !isReadOnce; } }

        internal void Load(byte[] data)
        {
            int wide, high;
            bool hasAlpha;
            ImageFile.ReadHeader(data, out wide, out high, out hasAlpha);
            width = wide;
            height = high;
            format = hasAlpha ? TextureFormat.ARGB32 : TextureFormat.RGB24;
            file = data;
            pixels = null;
        }

        /// <summary>Textures whose pixels only the graphics card has left, so that a test sees that players drop them.</summary>
        internal static int dropped;

        public Color32[] GetPixels32()
        {
            if (isReadOnce || isCompressed) { throw new InvalidOperationException("the texture cannot be read"); }
            if (pixels == null) { pixels = file == null ? new Color32[width * height] : ImageFile.Decode(file); }
            return (Color32[])pixels.Clone();
        }

        public void SetPixels32(Color32[] colors)
        {
            if (colors.Length != width * height)
            {
                throw new ArgumentException(colors.Length + " pixels for " + width + " x " + height);
            }
            pixels = (Color32[])colors.Clone();
            file = null;
        }

        public void Apply(bool updateMipmaps, bool makeNoLongerReadable)
        {
            isReadOnce |= makeNoLongerReadable;
            if (makeNoLongerReadable) { dropped++; }
        }

        public void Compress(bool highQuality)
        {
            if (width % 4 != 0 || height % 4 != 0)
            {
                throw new InvalidOperationException("only textures of whole blocks of 4 x 4 can be compressed");
            }
            isCompressed = true;
            format = format == TextureFormat.RGB24 ? TextureFormat.DXT1 : TextureFormat.DXT5;
        }

        /// <summary>What was loaded or set, for a test.</summary>
        internal Color32[] Stored()
        {
            return pixels ?? (file == null ? null : ImageFile.Decode(file));
        }
    }

    public static class ImageConversion
    {
        public static bool LoadImage(this Texture2D tex, byte[] data)
        {
            if (!ImageFile.IsImage(data)) { return false; }
            tex.Load(data);
            return true;
        }
    }

    public sealed class Shader : Object
    {
        static readonly Dictionary<string, Shader> Known = new Dictionary<string, Shader>();

        internal readonly HashSet<string> properties;

        internal Shader(string name, string properties)
        {
            this.name = name;
            this.properties = new HashSet<string>(properties.Split(' '));
        }

        public static Shader Find(string name)
        {
            Shader shader;
            if (Known.Count == 0)
            {
                foreach (Shader one in LitShaders.All()) { Known.Add(one.name, one); }
            }
            return Known.TryGetValue(name, out shader) ? shader : null;
        }
    }

    [Flags]
    public enum MaterialGlobalIlluminationFlags { None = 0, RealtimeEmissive = 1, BakedEmissive = 2,
        EmissiveIsBlack = 4, AnyEmissive = 3 }

    /// <summary>Refuses properties that its shader does not have.</summary>
    public class Material : Object
    {
        internal readonly Dictionary<string, float> floats = new Dictionary<string, float>();
        internal readonly Dictionary<string, Color> colors = new Dictionary<string, Color>();
        internal readonly Dictionary<string, Texture> textures = new Dictionary<string, Texture>();
        internal readonly Dictionary<string, Vector2> scales = new Dictionary<string, Vector2>(),
            offsets = new Dictionary<string, Vector2>();
        internal readonly Dictionary<string, string> tags = new Dictionary<string, string>();
        internal readonly SortedSet<string> keywords = new SortedSet<string>(StringComparer.Ordinal);

        public Material(Shader shader)
        {
            if (shader == null) { throw new ArgumentNullException("shader"); }
            this.shader = shader;
            renderQueue = -1;
        }

        public Material(Material source) : this(source.shader)
        {
            foreach (KeyValuePair<string, float> one in source.floats) { floats.Add(one.Key, one.Value); }
            foreach (KeyValuePair<string, Color> one in source.colors) { colors.Add(one.Key, one.Value); }
            foreach (KeyValuePair<string, Texture> one in source.textures) { textures.Add(one.Key, one.Value); }
            foreach (string keyword in source.keywords) { keywords.Add(keyword); }
        }

        public Shader shader { get; set; }
        public int renderQueue { get; set; }
        public bool enableInstancing { get; set; }
        public bool doubleSidedGI { get; set; }
        public MaterialGlobalIlluminationFlags globalIlluminationFlags { get; set; }

        string Known(string name)
        {
            if (!shader.properties.Contains(name))
            {
                throw new ArgumentException("the shader " + shader.name + " has no property " + name);
            }
            return name;
        }

        public bool HasProperty(string name) { return shader.properties.Contains(name); }
        public void SetFloat(string name, float value) { floats[Known(name)] = value; }
        public void SetColor(string name, Color value) { colors[Known(name)] = value; }
        public void SetTexture(string name, Texture value) { textures[Known(name)] = value; }
        public void SetTextureScale(string name, Vector2 value) { scales[Known(name)] = value; }
        public void SetTextureOffset(string name, Vector2 value) { offsets[Known(name)] = value; }
        public void SetOverrideTag(string tag, string val) { tags[tag] = val; }
        public void EnableKeyword(string keyword) { keywords.Add(keyword); }
        public string[] shaderKeywords { get { return new List<string>(keywords).ToArray(); } }
        public bool IsKeywordEnabled(string keyword) { return keywords.Contains(keyword); }

        public float GetFloat(string name)
        {
            float value;
            return floats.TryGetValue(Known(name), out value) ? value : 0;
        }

        public Color GetColor(string name)
        {
            Color value;
            return colors.TryGetValue(Known(name), out value) ? value : Color.white;
        }

        public Texture GetTexture(string name)
        {
            Texture value;
            return textures.TryGetValue(Known(name), out value) ? value : null;
        }
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh { get; set; }
    }

    public class Renderer : Component
    {
        Material[] materials = new Material[0];

        public bool enabled { get; set; }
        public ShadowCastingMode shadowCastingMode { get; set; }

        public Renderer()
        {
            enabled = true;
            shadowCastingMode = ShadowCastingMode.On;
        }

        public Material[] sharedMaterials
        {
            get { return (Material[])materials.Clone(); }
            set { materials = (Material[])value.Clone(); }
        }

        public Material sharedMaterial
        {
            get { return materials.Length == 0 ? null : materials[0]; }
            set { materials = new[] { value }; }
        }
    }

    public class MeshRenderer : Renderer
    {
    }

    public enum LightType { Spot = 0, Directional = 1, Point = 2, Rectangle = 3, Disc = 4 }

    public enum LightShadows { None, Hard, Soft }

    [Flags]
    public enum LightmapBakeType { Realtime = 4, Baked = 2, Mixed = 1 }

    public sealed class Light : Behaviour
    {
        public Light()
        {
            type = LightType.Point;
            color = Color.white;
            intensity = 1;
            range = 10;
            spotAngle = 30;
            innerSpotAngle = 21.8f;
        }

        public LightType type { get; set; }
        public Color color { get; set; }
        public float intensity { get; set; }
        public float range { get; set; }
        public float spotAngle { get; set; }
        public float innerSpotAngle { get; set; }
        public LightShadows shadows { get; set; }
#if UNITY_EDITOR
        public Vector2 areaSize { get; set; }
        public LightmapBakeType lightmapBakeType { get; set; }
#endif
    }

    public sealed class Camera : Behaviour
    {
        public float fieldOfView { get; set; }
        public float nearClipPlane { get; set; }
        public float farClipPlane { get; set; }
        public bool orthographic { get; set; }
        public float orthographicSize { get; set; }
    }

    public sealed class Gizmos
    {
        /// <summary>Lines drawn so far, so that a test sees that there are any.</summary>
        internal static int lines;

        public static Color color { get; set; }
        public static Matrix4x4 matrix { get; set; }

        public static void DrawLine(Vector3 from, Vector3 to)
        {
            lines++;
        }

        public static void DrawWireSphere(Vector3 center, float radius)
        {
            lines++;
        }
    }
}
