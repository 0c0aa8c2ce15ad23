using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    public enum Specifier : byte
    {
        Def, Over, Class,
    }

    /// <summary>time in the outer layer = Scale * time in the inner layer + Offset.</summary>
    public struct LayerOffset
    {
        public static readonly LayerOffset Identity = new LayerOffset(0, 1);

        public readonly double Offset;
        public readonly double Scale;

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
    }

    /// <summary>
    /// A reference or payload: Asset is empty for one into the same layer stack, Path for the default prim.
    /// </summary>
    public sealed class ReferenceArc : IEquatable<ReferenceArc>
    {
        public readonly string Asset;
        public readonly string Path;
        public readonly LayerOffset Offset;

        public ReferenceArc(string asset, string path, LayerOffset offset)
        {
            Asset = asset;
            Path = path;
            Offset = offset;
        }

        public bool Equals(ReferenceArc other)
        {
            return other != null && Asset == other.Asset && Path == other.Path && Offset.Offset == other.Offset.Offset
                && Offset.Scale == other.Offset.Scale;
        }

        public override bool Equals(object other)
        {
            return Equals(other as ReferenceArc);
        }

        public override int GetHashCode()
        {
            return Asset.GetHashCode() * 31 + Path.GetHashCode();
        }
    }

    /// <summary>A sublayer as a layer names it.</summary>
    public struct SubLayer
    {
        public readonly string Asset;
        public readonly LayerOffset Offset;

        public SubLayer(string asset, LayerOffset offset)
        {
            Asset = asset;
            Offset = offset;
        }
    }

    /// <summary>One file's opinions.</summary>
    public sealed class Layer
    {
        /// <summary>A path, with the entry of a package in brackets: "a/b.usdz[c.usdc]".</summary>
        public readonly string Identifier;

        /// <summary>The prim whose children are the root prims and whose metadata is the layer's.</summary>
        public readonly PrimSpec Root = new PrimSpec("");

        public readonly List<SubLayer> SubLayers = new List<SubLayer>();

        /// <summary>Specs of prims, variants included.</summary>
        public int SpecCount;

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

        public double TimeCodesPerSecond
        {
            get
            {
                double rate = Number("timeCodesPerSecond", Number("framesPerSecond", 24));
                return rate > 0 ? rate : 24;
            }
        }

        /// <summary>The prim spec at an absolute prim path without variants, or null.</summary>
        public PrimSpec Find(string path)
        {
            PrimSpec spec = Root;
            int start = 1;
            while (spec != null && start < path.Length)
            {
                int end = path.IndexOf('/', start);
                if (end < 0) { end = path.Length; }
                spec = spec.Children.Find(path.Substring(start, end - start));
                start = end + 1;
            }
            return spec;
        }
    }
}
