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

    /// <summary>A reference or payload: Asset is empty for one into the same layer stack, Path for the default prim.</summary>
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

    /// <summary>Fields with names that this reader does not need to know: a few of them, in the order of the file.</summary>
    public sealed class FieldList
    {
        public readonly List<KeyValuePair<string, object>> Fields = new List<KeyValuePair<string, object>>(2);

        public object Find(string name)
        {
            foreach (KeyValuePair<string, object> field in Fields)
            {
                if (field.Key == name) { return field.Value; }
            }
            return null;
        }
    }

    /// <summary>What one layer says of an attribute or relationship.</summary>
    public sealed class PropertySpec
    {
        public readonly string Name;
        public bool IsRelationship;
        public bool IsCustom;
        public bool IsUniform;
        public string TypeName = "";
        public UsdValue Default;
        public TimeSamples Samples;

        /// <summary>Targets of a relationship, connections of an attribute: absolute paths in this layer.</summary>
        public ListOp<string> Targets;

        public FieldList Metadata;

        public PropertySpec(string name)
        {
            Name = name;
        }

        public void AddField(string name, object value)
        {
            Metadata = Metadata ?? new FieldList();
            Metadata.Fields.Add(new KeyValuePair<string, object>(name, value));
        }
    }

    /// <summary>A variant set: a prim spec for each variant.</summary>
    public sealed class VariantSetSpec
    {
        public readonly string Name;
        public readonly List<PrimSpec> Variants = new List<PrimSpec>();

        public VariantSetSpec(string name)
        {
            Name = name;
        }

        public PrimSpec Find(string variant)
        {
            foreach (PrimSpec spec in Variants)
            {
                if (spec.Name == variant) { return spec; }
            }
            return null;
        }
    }

    /// <summary>What one layer says of a prim; a variant and the layer itself are such specs too.</summary>
    public sealed class PrimSpec
    {
        static readonly List<PrimSpec> NoChildren = new List<PrimSpec>(0);
        static readonly List<PropertySpec> NoProperties = new List<PropertySpec>(0);

        public readonly string Name;
        public Specifier Specifier = Specifier.Over;
        public string TypeName = "";
        public ListOp<ReferenceArc> References, Payloads;
        public ListOp<string> Inherits, Specializes, VariantSetNames, ApiSchemas;
        public Dictionary<string, string> VariantSelections;
        public List<VariantSetSpec> VariantSets;
        public List<string> ChildOrder, PropertyOrder;
        public bool? IsActive, IsInstanceable;
        public FieldList Metadata;

        List<PrimSpec> children = NoChildren;
        List<PropertySpec> properties = NoProperties;
        Dictionary<string, PrimSpec> childrenByName;
        Dictionary<string, PropertySpec> propertiesByName;

        public PrimSpec(string name)
        {
            Name = name;
        }

        public IList<PrimSpec> Children
        {
            get { return children; }
        }

        public IList<PropertySpec> Properties
        {
            get { return properties; }
        }

        /// <summary>Adds a child; false where one of that name is there already.</summary>
        public bool AddChild(PrimSpec child)
        {
            if (FindChild(child.Name) != null) { return false; }
            if (ReferenceEquals(children, NoChildren)) { children = new List<PrimSpec>(4); }
            children.Add(child);
            if (childrenByName != null) { childrenByName.Add(child.Name, child); }
            return true;
        }

        public void AddProperty(PropertySpec property)
        {
            if (ReferenceEquals(properties, NoProperties)) { properties = new List<PropertySpec>(4); }
            properties.Add(property);
            if (propertiesByName != null) { propertiesByName.Add(property.Name, property); }
        }

        public PrimSpec FindChild(string name)
        {
            if (children.Count <= 8)
            {
                for (int i = 0; i < children.Count; i++)
                {
                    if (children[i].Name == name) { return children[i]; }
                }
                return null;
            }
            if (childrenByName == null)
            {
                childrenByName = new Dictionary<string, PrimSpec>(children.Count * 2);
                foreach (PrimSpec child in children) { childrenByName.Add(child.Name, child); }
            }
            PrimSpec found;
            return childrenByName.TryGetValue(name, out found) ? found : null;
        }

        public PropertySpec FindProperty(string name)
        {
            if (properties.Count <= 12)
            {
                for (int i = properties.Count - 1; i >= 0; i--)
                {
                    if (properties[i].Name == name) { return properties[i]; }
                }
                return null;
            }
            if (propertiesByName == null)
            {
                propertiesByName = new Dictionary<string, PropertySpec>(properties.Count * 2);
                foreach (PropertySpec property in properties) { propertiesByName.Add(property.Name, property); }
            }
            PropertySpec found;
            return propertiesByName.TryGetValue(name, out found) ? found : null;
        }

        /// <summary>Puts the children in the order of the names.</summary>
        public void OrderChildren(List<string> names)
        {
            var places = new Dictionary<string, int>(names.Count);
            foreach (string name in names) { places[name] = places.Count; }
            var ordered = new PrimSpec[children.Count];
            var keys = new long[children.Count];
            for (int i = 0; i < children.Count; i++)
            {
                int place;
                if (!places.TryGetValue(children[i].Name, out place)) { place = names.Count; }
                ordered[i] = children[i];
                keys[i] = ((long)place << 32) + i;
            }
            Array.Sort(keys, ordered);
            children = new List<PrimSpec>(ordered);
        }

        public VariantSetSpec FindVariantSet(string name)
        {
            if (VariantSets == null) { return null; }
            foreach (VariantSetSpec set in VariantSets)
            {
                if (set.Name == name) { return set; }
            }
            return null;
        }

        public void AddField(string name, object value)
        {
            Metadata = Metadata ?? new FieldList();
            Metadata.Fields.Add(new KeyValuePair<string, object>(name, value));
        }

        public object Field(string name)
        {
            return Metadata == null ? null : Metadata.Find(name);
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
                spec = spec.FindChild(path.Substring(start, end - start));
                start = end + 1;
            }
            return spec;
        }
    }
}
