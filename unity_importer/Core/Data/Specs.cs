using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Fields with names that this reader does not need to know: a few of them, in the order of the file.
    /// </summary>
    public sealed class FieldList
    {
        /// <summary>Names with a UsdValue, a UsdDictionary or null.</summary>
        public readonly List<KeyValuePair<string, object>> Fields = new List<KeyValuePair<string, object>>(2);

        /// <summary>The value of a field; null where it is not there.</summary>
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
    public sealed class PropertySpec : NamedSpec
    {
        /// <summary>Otherwise it is an attribute.</summary>
        public bool IsRelationship;

        /// <summary>Whether no schema knows it.</summary>
        public bool IsCustom;

        /// <summary>Whether it cannot change with time.</summary>
        public bool IsUniform;

        /// <summary>"color3f[]" and the like; empty for a relationship.</summary>
        public string TypeName = "";

        /// <summary>The value without time; UsdValue.Blocked for none, null where the layer does not say.</summary>
        public UsdValue Default;

        /// <summary>Null where there are none.</summary>
        public TimeSamples Samples;

        /// <summary>Targets of a relationship, connections of an attribute: absolute paths in this layer.</summary>
        public ListOp<string> Targets;

        /// <summary>Null where there is none.</summary>
        public FieldList Metadata;

        /// <summary>An attribute without a value.</summary>
        public PropertySpec(string name) : base(name)
        {
        }

        /// <summary>Adds a field of metadata.</summary>
        public void AddField(string name, object value)
        {
            Metadata = Metadata ?? new FieldList();
            Metadata.Fields.Add(new KeyValuePair<string, object>(name, value));
        }

        /// <summary>The same, to be changed.</summary>
        public PropertySpec Copy()
        {
            var copy = (PropertySpec)MemberwiseClone();
            if (Metadata == null) { return copy; }
            copy.Metadata = new FieldList();
            copy.Metadata.Fields.AddRange(Metadata.Fields);
            return copy;
        }
    }

    /// <summary>A variant set: a prim spec for each variant.</summary>
    public sealed class VariantSetSpec
    {
        /// <summary>Of the set.</summary>
        public readonly string Name;

        /// <summary>In the order of the layer.</summary>
        public readonly List<PrimSpec> Variants = new List<PrimSpec>();

        /// <summary>A set without variants.</summary>
        public VariantSetSpec(string name)
        {
            Name = name;
        }

        /// <summary>The variant with this name, or null.</summary>
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
    public sealed class PrimSpec : NamedSpec
    {
        /// <summary>"Mesh" and the like; empty where the layer does not say.</summary>
        public string TypeName = "";

        /// <summary>Null where the layer does not say, as are the other edits.</summary>
        public ListOp<ReferenceArc> References;

        /// <summary>Paths of classes; names of applied schemas.</summary>
        public ListOp<string> Inherits, ApiSchemas;

        /// <summary>Null where there is none.</summary>
        public FieldList Metadata;

        /// <summary>In the order of the layer.</summary>
        public NamedList<PrimSpec> Children;

        /// <summary>In the order of the layer.</summary>
        public NamedList<PropertySpec> Properties;

        /// <summary>Null where the layer does not say.</summary>
        public bool? IsActive, IsInstanceable;

        /// <summary>How the layer speaks of the prim.</summary>
        public Specifier Specifier = Specifier.Over;

        RareFields rare;

        // what few prims have, apart: large layers have very many prims
        sealed class RareFields
        {
            public ListOp<ReferenceArc> Payloads;
            public ListOp<string> Specializes, VariantSetNames;
            public Dictionary<string, string> VariantSelections;
            public List<VariantSetSpec> VariantSets;
            public List<string> ChildOrder, PropertyOrder;
        }

        /// <summary>A spec that says nothing.</summary>
        public PrimSpec(string name) : base(name)
        {
        }

        RareFields Rare
        {
            get { return rare ?? (rare = new RareFields()); }
        }

        /// <summary>As References.</summary>
        public ListOp<ReferenceArc> Payloads
        {
            get { return rare == null ? null : rare.Payloads; }
            set { Rare.Payloads = value; }
        }

        /// <summary>Paths of specialized prims.</summary>
        public ListOp<string> Specializes
        {
            get { return rare == null ? null : rare.Specializes; }
            set { Rare.Specializes = value; }
        }

        /// <summary>The sets that take part.</summary>
        public ListOp<string> VariantSetNames
        {
            get { return rare == null ? null : rare.VariantSetNames; }
            set { Rare.VariantSetNames = value; }
        }

        /// <summary>The variants chosen, by set; null where none are.</summary>
        public Dictionary<string, string> VariantSelections
        {
            get { return rare == null ? null : rare.VariantSelections; }
            set { Rare.VariantSelections = value; }
        }

        /// <summary>The sets that have variants in this layer; null where there are none.</summary>
        public List<VariantSetSpec> VariantSets
        {
            get { return rare == null ? null : rare.VariantSets; }
            set { Rare.VariantSets = value; }
        }

        /// <summary>Names of children in the order that they are to have; null where the layer does not say.</summary>
        public List<string> ChildOrder
        {
            get { return rare == null ? null : rare.ChildOrder; }
            set { Rare.ChildOrder = value; }
        }

        /// <summary>As ChildOrder, of properties.</summary>
        public List<string> PropertyOrder
        {
            get { return rare == null ? null : rare.PropertyOrder; }
            set { Rare.PropertyOrder = value; }
        }

        /// <summary>
        /// The property with this name as one that no other prim shares, so that it can be changed; null where there is
        /// none.
        /// </summary>
        public PropertySpec OwnProperty(string name)
        {
            PropertySpec property = Properties.Find(name);
            if (property == null) { return null; }
            PropertySpec own = property.Copy();
            Properties.Replace(own);
            return own;
        }

        /// <summary>The set with this name, or null.</summary>
        public VariantSetSpec FindVariantSet(string name)
        {
            if (VariantSets == null) { return null; }
            foreach (VariantSetSpec set in VariantSets)
            {
                if (set.Name == name) { return set; }
            }
            return null;
        }

        /// <summary>Adds a field of metadata.</summary>
        public void AddField(string name, object value)
        {
            Metadata = Metadata ?? new FieldList();
            Metadata.Fields.Add(new KeyValuePair<string, object>(name, value));
        }

        /// <summary>The value of a field of metadata; null where it is not there.</summary>
        public object Field(string name)
        {
            return Metadata == null ? null : Metadata.Find(name);
        }
    }
}
