using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Whether a spec defines a prim, says something of one that others define, or is only there to be inherited.
    /// </summary>
    public enum Specifier : byte
    {
        Def, Over, Class,
    }

    /// <summary>time in the outer layer = Scale * time in the inner layer + Offset.</summary>
    public struct LayerOffset
    {
        /// <summary>The same time in both.</summary>
        public static readonly LayerOffset Identity = new LayerOffset(0, 1);

        /// <summary>In time codes of the outer layer.</summary>
        public readonly double Offset;

        /// <summary>Time codes of the outer layer in one of the inner.</summary>
        public readonly double Scale;

        /// <summary>Of these numbers.</summary>
        public LayerOffset(double offset, double scale)
        {
            Offset = offset;
            Scale = scale;
        }

        /// <summary>This after the inner one.</summary>
        public LayerOffset After(LayerOffset inner)
        {
            return new LayerOffset(Scale * inner.Offset + Offset, Scale * inner.Scale);
        }

        /// <summary>From the outer layer to the inner.</summary>
        public LayerOffset Inverse()
        {
            return new LayerOffset(-Offset / Scale, 1 / Scale);
        }
    }

    /// <summary>
    /// A reference or payload: Asset is empty for one into the same layer stack, Path for the default prim.
    /// </summary>
    public sealed class ReferenceArc : IEquatable<ReferenceArc>
    {
        /// <summary>As the layer names it.</summary>
        public readonly string Asset;

        /// <summary>Of the prim that is referred to.</summary>
        public readonly string Path;

        /// <summary>Of the time of what is referred to.</summary>
        public readonly LayerOffset Offset;

        /// <summary>To a prim of an asset.</summary>
        public ReferenceArc(string asset, string path, LayerOffset offset)
        {
            Asset = asset;
            Path = path;
            Offset = offset;
        }

        /// <summary>Whether both say the same.</summary>
        public bool Equals(ReferenceArc other)
        {
            return other != null && Asset == other.Asset && Path == other.Path && Offset.Offset == other.Offset.Offset
                && Offset.Scale == other.Offset.Scale;
        }

        /// <summary>Whether both say the same.</summary>
        public override bool Equals(object other)
        {
            return Equals(other as ReferenceArc);
        }

        /// <summary>Equal for arcs that say the same.</summary>
        public override int GetHashCode()
        {
            return Asset.GetHashCode() * 31 + Path.GetHashCode();
        }
    }

    /// <summary>A sublayer as a layer names it.</summary>
    public struct SubLayer
    {
        /// <summary>As the layer names it.</summary>
        public readonly string Asset;

        /// <summary>Of the time of the sublayer.</summary>
        public readonly LayerOffset Offset;

        /// <summary>Of an asset.</summary>
        public SubLayer(string asset, LayerOffset offset)
        {
            Asset = asset;
            Offset = offset;
        }
    }

    /// <summary>One file's opinions.</summary>
    public sealed class Layer
    {
        const int MostSkipped = 100;

        /// <summary>A path, with the entry of a package in brackets: "a/b.usdz[c.usdc]".</summary>
        public readonly string Identifier;

        /// <summary>The prim whose children are the root prims and whose metadata is the layer's.</summary>
        public readonly PrimSpec Root = new PrimSpec("");

        /// <summary>The strongest first.</summary>
        public readonly List<SubLayer> SubLayers = new List<SubLayer>();

        /// <summary>Paths of prims with the paths at which they are to be instead, empty for nowhere.</summary>
        public readonly List<KeyValuePair<string, string>> Relocates = new List<KeyValuePair<string, string>>();

        /// <summary>What the file has and this does not, each with its name; in the order of the file.</summary>
        public IList<string> Skipped
        {
            get { return skipped; }
        }

        readonly List<string> skipped = new List<string>();

        void Skip(string what)
        {
            if (skipped.Count < MostSkipped && !skipped.Contains(what)) { skipped.Add(what); }
        }

        internal void SkipType(string name)
        {
            Skip("values of the type '" + name + "', which is not known, are left out");
        }

        internal void SkipSpline(string property)
        {
            Skip("the spline of '" + property + "' is left out");
        }

        internal void SkipEdits()
        {
            Skip("edits of arrays are left out");
        }

        /// <summary>Specs of prims, variants included.</summary>
        public int SpecCount;

        /// <summary>An empty layer.</summary>
        public Layer(string identifier)
        {
            Identifier = identifier;
        }

        /// <summary>A string or token of the layer's metadata, or null.</summary>
        public string Text(string field)
        {
            var value = Root.Field(field) as UsdValue;
            return value == null ? null : value.Text;
        }

        /// <summary>A number of the layer's metadata, or the given one.</summary>
        public double Number(string field, double otherwise)
        {
            var value = Root.Field(field) as UsdValue;
            return value == null ? otherwise : value.Number(otherwise);
        }

        /// <summary>Of the layer itself; 24 where it does not say.</summary>
        public double TimeCodesPerSecond
        {
            get
            {
                double rate = Number("timeCodesPerSecond", Number("framesPerSecond", 24));
                return rate > 0 ? rate : 24;
            }
        }

        /// <summary>The prim spec at an absolute path of a prim, or of a variant "/A{set=variant}"; or null.</summary>
        public PrimSpec Find(string path)
        {
            PrimSpec spec = Root;
            for (int start = 1; spec != null && start < path.Length;)
            {
                int end;
                if (path[start] == '{')
                {
                    int equals = path.IndexOf('=', start);
                    end = path.IndexOf('}', equals);
                    VariantSetSpec set = spec.FindVariantSet(path.Substring(start + 1, equals - start - 1));
                    spec = set == null ? null : set.Find(path.Substring(equals + 1, end - equals - 1));
                    start = end + 1;
                }
                else
                {
                    end = path.IndexOfAny(Ends, start);
                    if (end < 0) { end = path.Length; }
                    spec = spec.Children.Find(path.Substring(start, end - start));
                    start = end < path.Length && path[end] == '{' ? end : end + 1;
                    continue;
                }
                if (start < path.Length && path[start] == '/') { start++; }
            }
            return spec;
        }

        static readonly char[] Ends = { '/', '{' };
    }
}
