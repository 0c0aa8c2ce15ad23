using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>How a place of opinions comes to a prim, the strongest first.</summary>
    enum Arc : byte
    {
        Root, Inherit, Variant, Reference, Payload, Specialize,
    }

    /// <summary>What a layer of a stack says at the place of a node.</summary>
    struct LayerSpec
    {
        public readonly int Layer;
        public readonly PrimSpec Spec;

        public LayerSpec(int layer, PrimSpec spec)
        {
            Layer = layer;
            Spec = spec;
        }
    }

    /// <summary>
    /// One place in one layer stack that has opinions on a prim, with the places that it refers to below it.
    /// </summary>
    sealed class ArcNode
    {
        static readonly LayerSpec[] NoSpecs = new LayerSpec[0];
        static readonly List<string> NoNames = new List<string>(0);

        public readonly LayerStack Stack;
        public readonly string Path;
        public readonly Arc Arc;

        /// <summary>
        /// The prim at which the arc was introduced, counted from the root: a deeper one is stronger.
        /// </summary>
        public readonly int Depth;

        /// <summary>Prefixes of paths in this node's stack and in that of the parent.</summary>
        public readonly string From, To;

        /// <summary>Whether other paths mean the same in both stacks.</summary>
        public readonly bool KeepsOtherPaths;

        /// <summary>Time in the parent's stack.</summary>
        public readonly LayerOffset Offset;

        /// <summary>"set=selection" of a variant.</summary>
        public readonly string Variant;

        public LayerSpec[] Specs = NoSpecs;
        public ArcNode Parent;
        public List<ArcNode> Children;

        /// <summary>The arc was introduced at a prim above this one.</summary>
        public bool IsAncestral;

        /// <summary>References, payloads and classes of this place are below it already.</summary>
        public bool IsExpanded;

        /// <summary>Names of variant sets that have a variant below this node.</summary>
        public List<string> ChosenSets;

        List<string> variantSets;

        /// <summary>Names of the variant sets that the specs give, in the order in which they are chosen.</summary>
        public List<string> VariantSets
        {
            get
            {
                if (variantSets != null) { return variantSets; }
                variantSets = NoNames;
                for (int i = Specs.Length - 1; i >= 0; i--)
                {
                    ListOp<string> op = Specs[i].Spec.VariantSetNames;
                    if (op == null) { continue; }
                    if (ReferenceEquals(variantSets, NoNames)) { variantSets = new List<string>(1); }
                    op.ApplyTo(variantSets);
                }
                return variantSets;
            }
        }

        /// <summary>Of a root: how many nodes are below it, itself included.</summary>
        public int Size;

        public ArcNode(LayerStack stack, string path, Arc arc, int depth, string from, string to, bool keepsOtherPaths,
            LayerOffset offset, string variant)
        {
            Stack = stack;
            Path = path;
            Arc = arc;
            Depth = depth;
            From = from;
            To = to;
            KeepsOtherPaths = keepsOtherPaths;
            Offset = offset;
            Variant = variant;
        }

        public static ArcNode OfRoot(LayerStack stack, string path, int depth)
        {
            return new ArcNode(stack, path, Arc.Root, depth, null, null, true, LayerOffset.Identity, null);
        }

        public bool IsClass
        {
            get { return Arc == Arc.Inherit || Arc == Arc.Specialize; }
        }

        /// <summary>
        /// Whether the prim itself inherits this place, directly or by way of others, and not a prim above it.
        /// </summary>
        public bool IsInheritedDirectly
        {
            get
            {
                for (ArcNode node = this; node.Parent != null; node = node.Parent)
                {
                    if (node.IsClass && UsdPaths.Depth(node.Parent.Path) == node.Depth) { return true; }
                }
                return false;
            }
        }

        /// <summary>Adds a child at its place by strength, behind equally strong ones.</summary>
        public void Add(ArcNode child)
        {
            child.Parent = this;
            Children = Children ?? new List<ArcNode>(2);
            int place = Children.Count;
            while (place > 0 && IsStronger(child, Children[place - 1])) { place--; }
            Children.Insert(place, child);
        }

        static bool IsStronger(ArcNode one, ArcNode other)
        {
            return one.Arc != other.Arc ? one.Arc < other.Arc : one.Depth > other.Depth;
        }

        /// <summary>
        /// A path of this node's stack as the parent's stack means it; null where it means nothing there.
        /// </summary>
        public string PathInParent(string path)
        {
            if (From == null) { return path; }
            if (UsdPaths.HasPrefix(path, From))
            {
                return From == To ? path : To == "/" ? path.Substring(From.Length)
                    : To + path.Substring(From == "/" ? 0 : From.Length);
            }
            // what stands at the parent's place there is hidden by what this node brings to that place
            return KeepsOtherPaths && !UsdPaths.HasPrefix(path, To) ? path : null;
        }

        /// <summary>A copy of a node, of its place and its specs, without what is around it.</summary>
        public ArcNode Copy(int depth)
        {
            return new ArcNode(Stack, Path, Arc, depth, From, To, KeepsOtherPaths, Offset, Variant)
            {
                Specs = Specs, variantSets = variantSets, IsAncestral = IsAncestral, IsExpanded = IsExpanded,
                ChosenSets = ChosenSets == null ? null : new List<string>(ChosenSets),
            };
        }

        /// <summary>The node of a child prim, or null where no opinions are below this one.</summary>
        public ArcNode Extended(string name)
        {
            int count = 0;
            foreach (LayerSpec spec in Specs)
            {
                if (spec.Spec.Children.Find(name) != null) { count++; }
            }
            var extended = new ArcNode(Stack, UsdPaths.Child(Path, name), Arc, Depth, From, To, KeepsOtherPaths,
                Offset, Variant);
            if (count > 0)
            {
                extended.Specs = new LayerSpec[count];
                count = 0;
                foreach (LayerSpec spec in Specs)
                {
                    PrimSpec child = spec.Spec.Children.Find(name);
                    if (child != null) { extended.Specs[count++] = new LayerSpec(spec.Layer, child); }
                }
            }
            extended.IsAncestral = Arc != Arc.Root;
            if (Children != null)
            {
                foreach (ArcNode child in Children)
                {
                    ArcNode below = child.Extended(name);
                    if (below == null) { continue; }
                    below.Parent = extended;
                    extended.Children = extended.Children ?? new List<ArcNode>(2);
                    extended.Children.Add(below);
                }
            }
            return extended.Specs.Length == 0 && extended.Children == null && Arc != Arc.Root ? null : extended;
        }

        /// <summary>All nodes that have opinions, strongest first; whatever is specialized comes last.</summary>
        public void AddByStrength(List<ArcNode> list)
        {
            List<ArcNode> specialized = null;
            AddButSpecialized(list, ref specialized);
            if (specialized == null) { return; }
            // what a specialized prim specializes comes before other specialized prims
            foreach (ArcNode one in specialized) { one.AddByStrength(list); }
        }

        void AddButSpecialized(List<ArcNode> list, ref List<ArcNode> specialized)
        {
            if (Specs.Length > 0) { list.Add(this); }
            if (Children == null) { return; }
            foreach (ArcNode child in Children)
            {
                if (child.Arc != Arc.Specialize)
                {
                    child.AddButSpecialized(list, ref specialized);
                    continue;
                }
                specialized = specialized ?? new List<ArcNode>(2);
                specialized.Add(child);
            }
        }
    }
}
