using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Fields with names that this reader does not need to know: a few of them, in the order of the file.
    /// </summary>
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
    public sealed class PropertySpec : NamedSpec
    {
        public bool IsRelationship;
        public bool IsCustom;
        public bool IsUniform;
        public string TypeName = "";
        public UsdValue Default;
        public TimeSamples Samples;

        /// <summary>Targets of a relationship, connections of an attribute: absolute paths in this layer.</summary>
        public ListOp<string> Targets;

        public FieldList Metadata;

        public PropertySpec(string name) : base(name)
        {
        }

        public void AddField(string name, object value)
        {
            Metadata = Metadata ?? new FieldList();
            Metadata.Fields.Add(new KeyValuePair<string, object>(name, value));
        }

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
    public sealed class PrimSpec : NamedSpec
    {
        public string TypeName = "";
        public ListOp<ReferenceArc> References;
        public ListOp<string> Inherits, ApiSchemas;
        public FieldList Metadata;
        public NamedList<PrimSpec> Children;
        public NamedList<PropertySpec> Properties;
        public bool? IsActive, IsInstanceable;
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

        public PrimSpec(string name) : base(name)
        {
        }

        RareFields Rare
        {
            get { return rare ?? (rare = new RareFields()); }
        }

        public ListOp<ReferenceArc> Payloads
        {
            get { return rare == null ? null : rare.Payloads; }
            set { Rare.Payloads = value; }
        }

        public ListOp<string> Specializes
        {
            get { return rare == null ? null : rare.Specializes; }
            set { Rare.Specializes = value; }
        }

        public ListOp<string> VariantSetNames
        {
            get { return rare == null ? null : rare.VariantSetNames; }
            set { Rare.VariantSetNames = value; }
        }

        public Dictionary<string, string> VariantSelections
        {
            get { return rare == null ? null : rare.VariantSelections; }
            set { Rare.VariantSelections = value; }
        }

        public List<VariantSetSpec> VariantSets
        {
            get { return rare == null ? null : rare.VariantSets; }
            set { Rare.VariantSets = value; }
        }

        public List<string> ChildOrder
        {
            get { return rare == null ? null : rare.ChildOrder; }
            set { Rare.ChildOrder = value; }
        }

        public List<string> PropertyOrder
        {
            get { return rare == null ? null : rare.PropertyOrder; }
            set { Rare.PropertyOrder = value; }
        }

        /// <summary>Adds a child; false where one of that name is there already.</summary>
        public bool AddChild(PrimSpec child)
        {
            if (Children.Find(child.Name) != null) { return false; }
            Children.Add(child);
            return true;
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
            Properties.Replace(property, own);
            return own;
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
}
