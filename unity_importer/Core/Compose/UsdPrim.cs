using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>One opinion on a prim: a spec, its layer, and how paths and times of it get to the stage.</summary>
    struct Opinion
    {
        public readonly ArcNode Node;
        public readonly LayerSpec Spec;

        public Opinion(ArcNode node, LayerSpec spec)
        {
            Node = node;
            Spec = spec;
        }

        public Layer Layer
        {
            get { return Node.Stack.Layers[Spec.Layer]; }
        }

        public LayerOffset Offset
        {
            get { return Node.ToRoot.Offset.After(Node.Stack.Offsets[Spec.Layer]); }
        }

        /// <summary>A path of the layer as the stage means it; null where it means nothing there.</summary>
        public string PathInRoot(string path)
        {
            path = Node.ToRoot.ToTarget(path);
            Relocates relocates = Node.Root.Stack.Relocates;
            bool isFromElsewhere = !ReferenceEquals(Node.Stack, Node.Root.Stack);
            return path != null && relocates != null && isFromElsewhere && relocates.Moves(path) ? null : path;
        }
    }

    /// <summary>A prim of a stage.</summary>
    public sealed class UsdPrim
    {
        const int Deepest = 600;

        // what a layer calls the type of a prim that it leaves open
        const string AnyType = "__AnyType__";

        static readonly List<UsdPrim> NoPrims = new List<UsdPrim>();

        readonly string prototypeSource, prototypePath;
        Opinion[] opinions;
        ArcNode index;
        List<UsdPrim> children;
        Dictionary<string, UsdPrim> childrenByName;
        string[] propertyNames;
        List<string> apiSchemas;

        /// <summary>The stage that it belongs to.</summary>
        public UsdStage Stage { get; private set; }

        /// <summary>Null for the root and for prototypes.</summary>
        public UsdPrim Parent { get; private set; }

        /// <summary>Of the stage: "/A/B"; below "/__Prototype_1" for what instances share.</summary>
        public string Path { get; private set; }

        /// <summary>Whether anything defines the prim.</summary>
        public Specifier Specifier { get; private set; }

        /// <summary>"Mesh" and the like; empty where none is given.</summary>
        public string TypeName { get; private set; }

        /// <summary>What shares its children with other instances; null where this is no instance.</summary>
        public UsdPrim Prototype { get; private set; }

        internal UsdPrim(UsdStage stage, UsdPrim parent, string path, ArcNode node, string source, string prototype)
        {
            Stage = stage;
            Parent = parent;
            Path = path;
            index = node;
            stage.CountPrim(path);
            // below a prototype, paths are those of the instance that it was made of
            prototypeSource = parent != null ? parent.prototypeSource : source;
            prototypePath = parent != null ? parent.prototypePath : source == null ? null : path;
            var order = new List<ArcNode>();
            node.AddByStrength(order);
            int count = 0;
            foreach (ArcNode one in order) { count += one.Specs.Length; }
            opinions = new Opinion[count];
            count = 0;
            foreach (ArcNode one in order)
            {
                foreach (LayerSpec spec in one.Specs) { opinions[count++] = new Opinion(one, spec); }
            }
            FindSpecifierAndType();
            WarnOfClips();
            if (parent == null) { Specifier = Specifier.Def; }
        }

        void FindSpecifierAndType()
        {
            Specifier = Specifier.Over;
            TypeName = "";
            bool isInheritedClass = false, isFound = false;
            foreach (Opinion opinion in opinions)
            {
                PrimSpec spec = opinion.Spec.Spec;
                if (TypeName.Length == 0 && spec.TypeName != AnyType) { TypeName = spec.TypeName; }
                if (isFound || spec.Specifier == Specifier.Over) { continue; }
                if (spec.Specifier == Specifier.Class && opinion.Node.IsInheritedDirectly)
                {
                    isInheritedClass = true;
                    continue;
                }
                Specifier = spec.Specifier;
                isFound = true;
            }
            // that a class is inherited makes a class of a prim that nothing else defines
            if (!isFound && isInheritedClass) { Specifier = Specifier.Class; }
        }

        // what clips give is not read
        void WarnOfClips()
        {
            foreach (Opinion opinion in opinions)
            {
                if (opinion.Spec.Spec.Field("clips") == null) { continue; }
                Stage.Composer.Library.Warn("<" + Path + ">: value clips are left out: attributes are as they are without"
                    + " them");
                return;
            }
        }

        internal string SourcePath
        {
            get { return index == null ? Path : index.Path; }
        }

        /// <summary>The last element of the path.</summary>
        public string Name
        {
            get { return UsdPaths.Name(Path); }
        }

        /// <summary>Whether the prim is there at all.</summary>
        public bool IsActive
        {
            get
            {
                foreach (Opinion opinion in opinions)
                {
                    if (opinion.Spec.Spec.IsActive != null) { return opinion.Spec.Spec.IsActive.Value; }
                }
                return true;
            }
        }

        /// <summary>Whether this is a class or below one: something to refer to, not to show.</summary>
        public bool IsAbstract
        {
            get { return Specifier == Specifier.Class || (Parent != null && Parent.IsAbstract); }
        }

        /// <summary>Whether the children are those of Prototype.</summary>
        public bool IsInstance
        {
            get { return Prototype != null; }
        }

        /// <summary>
        /// Names of applied schemas, with their instances: "MaterialBindingAPI", "SemanticsLabelsAPI:class".
        /// </summary>
        public IList<string> ApiSchemas
        {
            get
            {
                if (apiSchemas == null)
                {
                    var names = new List<string>();
                    for (int i = opinions.Length - 1; i >= 0; i--)
                    {
                        ListOp<string> op = opinions[i].Spec.Spec.ApiSchemas;
                        if (op != null) { op.ApplyTo(names); }
                    }
                    apiSchemas = names;
                }
                return apiSchemas;
            }
        }

        /// <summary>Whether a schema is applied.</summary>
        public bool HasApi(string schema)
        {
            return ApiSchemas.Contains(schema);
        }

        /// <summary>The names of sets with the variants in force.</summary>
        public IDictionary<string, string> VariantSelections
        {
            get
            {
                var selections = new Dictionary<string, string>();
                foreach (Opinion opinion in opinions)
                {
                    if (opinion.Spec.Spec.VariantSelections == null) { continue; }
                    foreach (KeyValuePair<string, string> one in opinion.Spec.Spec.VariantSelections)
                    {
                        if (!selections.ContainsKey(one.Key)) { selections.Add(one.Key, one.Value); }
                    }
                }
                return selections;
            }
        }

        /// <summary>
        /// A field of the prim such as "kind": a UsdValue, a UsdDictionary (of all layers together), or null.
        /// </summary>
        public object Metadata(string name)
        {
            UsdDictionary merged = null;
            foreach (Opinion opinion in opinions)
            {
                object value = opinion.Spec.Spec.Field(name);
                if (value == null) { continue; }
                var dictionary = value as UsdDictionary;
                if (dictionary == null) { return merged ?? value; }
                merged = merged ?? new UsdDictionary();
                Merge(merged, dictionary);
            }
            return merged;
        }

        static void Merge(UsdDictionary strong, UsdDictionary weak)
        {
            foreach (string key in weak.Keys)
            {
                var inner = weak[key] as UsdDictionary;
                if (inner == null)
                {
                    if (strong[key] == null) { strong[key] = weak[key]; }
                    continue;
                }
                if (strong[key] == null) { strong[key] = new UsdDictionary(); }
                var target = strong[key] as UsdDictionary;
                if (target != null) { Merge(target, inner); }
            }
        }

        /// <summary>Active children; none for an instance, whose prototype has them.</summary>
        public IList<UsdPrim> Children
        {
            get
            {
                if (children == null) { ComposeChildren(); }
                return children;
            }
        }

        /// <summary>Finds whether this is an instance: known as soon as its parent's children are.</summary>
        void FindPrototype()
        {
            if (Parent != null && Instancing.IsInstance(index))
            {
                Prototype = Stage.PrototypeOf(Instancing.Key(index), this);
            }
        }

        /// <summary>
        /// The opinions on an instance without those from outside of its arcs, which do not count below it.
        /// </summary>
        internal ArcNode SharedPart()
        {
            ArcNode shared = index.Copy();
            Instancing.SilenceOutside(shared);
            return shared;
        }

        void ComposeChildren()
        {
            children = NoPrims;
            if (Prototype != null || index == null) { return; }
            IList<string> names = new ChildNames(index).Names;
            if (names.Count > 0)
            {
                int depth = 0;
                for (UsdPrim above = this; above != null; above = above.Parent) { depth++; }
                if (depth > Deepest)
                {
                    throw new UsdFormatException(opinions[0].Layer.Identifier, "<" + Path + ">",
                        "prims are nested more than " + Deepest + " deep");
                }
                var made = new List<UsdPrim>(names.Count);
                foreach (string name in names)
                {
                    ArcNode node = Stage.Composer.Child(index, name);
                    var child = new UsdPrim(Stage, this, UsdPaths.Child(Path, name), node, null, null);
                    if (!child.IsActive) { continue; }
                    child.FindPrototype();
                    made.Add(child);
                }
                children = made;
            }
            index = null;
        }

        /// <summary>The active child with this name, or null.</summary>
        public UsdPrim Child(string name)
        {
            IList<UsdPrim> all = Children;
            if (all.Count <= 8)
            {
                foreach (UsdPrim child in all)
                {
                    if (child.Name == name) { return child; }
                }
                return null;
            }
            if (childrenByName == null)
            {
                childrenByName = new Dictionary<string, UsdPrim>();
                foreach (UsdPrim child in all) { childrenByName[child.Name] = child; }
            }
            UsdPrim found;
            return childrenByName.TryGetValue(name, out found) ? found : null;
        }

        // ---- properties

        /// <summary>Names of all properties that any layer gives, in the order of the alphabet.</summary>
        public IList<string> PropertyNames
        {
            get
            {
                if (propertyNames == null)
                {
                    var names = new HashSet<string>();
                    foreach (Opinion opinion in opinions)
                    {
                        NamedList<PropertySpec> properties = opinion.Spec.Spec.Properties;
                        for (int i = 0; i < properties.Count; i++) { names.Add(properties[i].Name); }
                    }
                    propertyNames = new string[names.Count];
                    names.CopyTo(propertyNames);
                    Array.Sort(propertyNames, StringComparer.Ordinal);
                }
                return propertyNames;
            }
        }

        /// <summary>The property with this name, or null where no layer gives it.</summary>
        public UsdProperty Property(string name)
        {
            int first = -1, count = 0;
            for (int i = 0; i < opinions.Length; i++)
            {
                if (opinions[i].Spec.Spec.Properties.Find(name) == null) { continue; }
                if (count++ == 0) { first = i; }
            }
            if (count == 0) { return null; }
            var specs = new PropertySpec[count];
            var places = new Opinion[count];
            count = 0;
            for (int i = first; i < opinions.Length; i++)
            {
                PropertySpec spec = opinions[i].Spec.Spec.Properties.Find(name);
                if (spec == null) { continue; }
                specs[count] = spec;
                places[count++] = opinions[i];
            }
            return new UsdProperty(this, specs, places);
        }

        /// <summary>The value of an attribute (see UsdProperty.Value), or null.</summary>
        public UsdValue Value(string name)
        {
            foreach (Opinion opinion in opinions)
            {
                PropertySpec spec = opinion.Spec.Spec.Properties.Find(name);
                if (spec == null || (spec.Default == null && spec.Samples == null)) { continue; }
                if (spec.Samples != null) { break; }
                if (ReferenceEquals(spec.Default, UsdValue.Blocked)) { return null; }
                if (spec.Default.Type != UsdType.TimeCode) { return spec.Default; }
                break;
            }
            UsdProperty property = Property(name);
            return property == null ? null : property.Value;
        }

        /// <summary>The first string of an attribute, or the given one.</summary>
        public string Text(string name, string otherwise)
        {
            UsdValue value = Value(name);
            return value == null ? otherwise : value.Text ?? otherwise;
        }

        /// <summary>The first number of an attribute, or the given one.</summary>
        public double Number(string name, double otherwise)
        {
            UsdValue value = Value(name);
            return value == null ? otherwise : value.Number(otherwise);
        }

        /// <summary>Whether the first number of an attribute is not 0, or the given answer.</summary>
        public bool Truth(string name, bool otherwise)
        {
            UsdValue value = Value(name);
            return value == null ? otherwise : value.Truth(otherwise);
        }

        /// <summary>The targets of a relationship; empty where there are none.</summary>
        public IList<string> Targets(string name)
        {
            UsdProperty property = Property(name);
            return property == null ? new List<string>() : property.Targets;
        }

        internal string InPrototype(string path)
        {
            if (path == null || prototypeSource == null || !UsdPaths.HasPrefix(path, prototypeSource)) { return path; }
            return prototypePath + path.Substring(prototypeSource.Length);
        }
    }
}
