using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>How a place of opinions comes to a prim, the strongest first.</summary>
    enum Arc : byte
    {
        Root, Inherit, Variant, Relocate, Reference, Payload, Specialize,
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
    /// One place in one layer stack that has opinions on a prim, with the places that it leads to below it, the
    /// strongest first.
    /// </summary>
    sealed class ArcNode
    {
        static readonly LayerSpec[] NoSpecs = new LayerSpec[0];
        static readonly List<ArcNode> NoNodes = new List<ArcNode>(0);

        public readonly LayerStack Stack;

        /// <summary>Of the prim in its stack, with the variants that it is in.</summary>
        public readonly string Path;

        /// <summary>How many prims the path names.</summary>
        public readonly int Level;

        public Arc Arc { get; private set; }

        /// <summary>How paths and times of this place get to the one above it.</summary>
        public PathMap ToParent { get; private set; }

        /// <summary>The level of the prim at which the arc was introduced: a deeper one is stronger.</summary>
        public int Depth { get; private set; }

        /// <summary>Which of the arcs of its kind it is at its origin, from 0.</summary>
        public int Sibling { get; private set; }

        public ArcNode Parent { get; private set; }

        /// <summary>
        /// The node that gave rise to this one: the parent for an arc that a layer states, else the class that this one
        /// follows from.
        /// </summary>
        public ArcNode Origin { get; private set; }

        /// <summary>One that no other node of the tree has; larger for one that came later.</summary>
        public int Number { get; private set; }

        /// <summary>What the layers say at the place, whether that counts or not.</summary>
        public LayerSpec[] Specs = NoSpecs;

        /// <summary>The arc was introduced at a prim above this one.</summary>
        public bool IsAncestral;

        /// <summary>Elements of the path from which on nothing that the layers say counts; 0 if all does.</summary>
        public int SilentFrom;

        /// <summary>The node that has the opinions of this silent one in its place; null where there is none.</summary>
        public ArcNode MovedTo;

        /// <summary>Of a root: how many nodes are in the tree, itself included.</summary>
        public int Size = 1;

        List<ArcNode> children;
        PathMap toRoot;
        bool isSilent, isElided;
        int nextNumber = 1;

        // this node in a copy that is being made
        ArcNode twin;

        ArcNode(LayerStack stack, string path, int level)
        {
            Stack = stack;
            Path = path;
            Level = level;
            ToParent = PathMap.Identity;
        }

        /// <summary>A tree of one node.</summary>
        public static ArcNode Of(LayerStack stack, string path)
        {
            return new ArcNode(stack, path, UsdPaths.Depth(path)) { Specs = stack.SpecsAt(path) };
        }

        public IList<ArcNode> Children
        {
            get { return children ?? NoNodes; }
        }

        /// <summary>The same nodes, while others are added.</summary>
        public ArcNode[] ChildrenNow()
        {
            return (children ?? NoNodes).ToArray();
        }

        public ArcNode Root
        {
            get
            {
                ArcNode node = this;
                while (node.Parent != null) { node = node.Parent; }
                return node;
            }
        }

        public bool IsClass
        {
            get { return Arc == Arc.Inherit || Arc == Arc.Specialize; }
        }

        /// <summary>A class that no layer states here: it follows from one elsewhere.</summary>
        public bool IsImpliedClass
        {
            get { return IsClass && !ReferenceEquals(Parent, Origin); }
        }

        /// <summary>A specialized prim that was moved below the root, where it is weaker than all else.</summary>
        public bool IsMovedToRoot
        {
            get
            {
                return Arc == Arc.Specialize && Parent.Parent == null && Origin.Path == Path
                    && ReferenceEquals(Origin.Stack, Stack);
            }
        }

        /// <summary>Whether what the layers say here does not count.</summary>
        public bool IsSilent
        {
            get { return isSilent || isElided; }
            set
            {
                bool was = IsSilent;
                isSilent = value;
                if (value != was) { SilentFrom = IsSilent ? UsdPaths.Elements(Path) : 0; }
            }
        }

        /// <summary>Whether the node is there only because others came from it.</summary>
        public bool IsElided
        {
            get { return isElided; }
        }

        public bool HasOpinions
        {
            get { return !IsSilent && Specs.Length > 0; }
        }

        /// <summary>How many prims below the one that introduced the arc this one is.</summary>
        public int DepthBelowIntroduction
        {
            get { return Parent == null ? 0 : Parent.Level - Depth; }
        }

        /// <summary>The path of the prim that the arc leads to where it was introduced.</summary>
        public string PathAtIntroduction
        {
            get
            {
                string path = Path;
                for (int depth = DepthBelowIntroduction; depth > 0; depth--)
                {
                    while (UsdPaths.IsVariant(path)) { path = UsdPaths.Parent(path); }
                    path = UsdPaths.Parent(path);
                }
                return path;
            }
        }

        /// <summary>How paths and times of this place get to the root.</summary>
        public PathMap ToRoot
        {
            get
            {
                if (toRoot == null) { toRoot = Parent == null ? ToParent : Parent.ToRoot.After(ToParent); }
                return toRoot;
            }
        }

        public bool IsAt(LayerStack stack, string path)
        {
            return ReferenceEquals(Stack, stack) && Path == path;
        }

        /// <summary>Whether the prim itself inherits this place, and not a prim above it.</summary>
        public bool IsInheritedDirectly
        {
            get
            {
                for (ArcNode node = this; node.Parent != null; node = node.Parent)
                {
                    if (node.Arc == Arc.Inherit && !node.IsAncestral) { return true; }
                }
                return false;
            }
        }

        /// <summary>Whether this is another node or below it.</summary>
        public bool IsWithin(ArcNode other)
        {
            ArcNode node = this;
            while (node != null && !ReferenceEquals(node, other)) { node = node.Parent; }
            return node != null;
        }

        /// <summary>Hangs a tree below this node at its place by strength.</summary>
        public void Add(ArcNode child, Arc arc, ArcNode origin, PathMap toParent, int depth, int sibling)
        {
            child.Arc = arc;
            child.Parent = this;
            child.Origin = origin;
            child.ToParent = toParent;
            child.Depth = depth;
            child.Sibling = sibling;
            child.IsAncestral = false;
            ArcNode root = Root;
            child.Join(root.nextNumber);
            root.nextNumber += child.nextNumber;
            root.Size += child.Size;
            children = children ?? new List<ArcNode>(2);
            int place = children.Count;
            while (place > 0 && ArcStrength.Compare(child, children[place - 1]) < 0) { place--; }
            children.Insert(place, child);
        }

        void Join(int firstNumber)
        {
            Number += firstNumber;
            toRoot = null;
            foreach (ArcNode child in Children) { child.Join(firstNumber); }
        }

        /// <summary>Makes all nodes of the tree count for nothing, now and for prims above.</summary>
        public void Silence(bool elides)
        {
            if (elides) { isElided = true; }
            else { isSilent = true; }
            SilentFrom = 1;
            foreach (ArcNode child in Children) { child.Silence(elides); }
        }

        /// <summary>The whole tree anew.</summary>
        public ArcNode Copy()
        {
            return Copied(null);
        }

        /// <summary>The tree of a child prim as far as it comes from the arcs of this one's.</summary>
        public ArcNode Extended(string name)
        {
            return Copied(name);
        }

        ArcNode Copied(string name)
        {
            ArcNode copy = CopiedTree(name, null);
            CopyLinks();
            copy.Size = Size;
            copy.nextNumber = nextNumber;
            return copy;
        }

        ArcNode CopiedTree(string name, ArcNode parent)
        {
            string path = name == null ? Path : UsdPaths.Child(Path, name);
            twin = new ArcNode(Stack, path, name == null ? Level : Level + 1)
            {
                Arc = Arc, ToParent = ToParent, Depth = Depth, Sibling = Sibling, Parent = parent, Number = Number,
                Specs = name == null ? Specs : SpecsOfChild(name),
                IsAncestral = name == null ? IsAncestral : parent != null, SilentFrom = SilentFrom,
                toRoot = toRoot, isSilent = isSilent, isElided = isElided,
            };
            if (children == null) { return twin; }
            ArcNode made = twin;
            made.children = new List<ArcNode>(children.Count);
            foreach (ArcNode child in children) { made.children.Add(child.CopiedTree(name, made)); }
            return made;
        }

        void CopyLinks()
        {
            twin.Origin = Origin == null ? null : Origin.twin;
            twin.MovedTo = MovedTo == null ? null : MovedTo.twin;
            foreach (ArcNode child in Children) { child.CopyLinks(); }
        }

        LayerSpec[] SpecsOfChild(string name)
        {
            int count = 0;
            foreach (LayerSpec spec in Specs)
            {
                if (spec.Spec.Children.Find(name) != null) { count++; }
            }
            if (count == 0) { return NoSpecs; }
            var specs = new LayerSpec[count];
            count = 0;
            foreach (LayerSpec spec in Specs)
            {
                PrimSpec child = spec.Spec.Children.Find(name);
                if (child != null) { specs[count++] = new LayerSpec(spec.Layer, child); }
            }
            return specs;
        }

        /// <summary>Numbers the nodes anew, the strongest first.</summary>
        public void Renumber()
        {
            nextNumber = 0;
            Renumber(this);
        }

        void Renumber(ArcNode root)
        {
            Number = root.nextNumber++;
            foreach (ArcNode child in Children) { child.Renumber(root); }
        }

        /// <summary>The nodes whose opinions count, or that move prims, the strongest first.</summary>
        public void AddByStrength(List<ArcNode> list)
        {
            if (!IsSilent && (Specs.Length > 0 || Stack.Relocates != null)) { list.Add(this); }
            foreach (ArcNode child in Children) { child.AddByStrength(list); }
        }

        // ---- what says nothing and leads nowhere

        /// <summary>Takes the nodes of a root out that no opinion can come by.</summary>
        public void Prune()
        {
            foreach (ArcNode child in ChildrenNow())
            {
                if (!child.IsMovedToRoot) { continue; }
                var elided = new HashSet<KeyValuePair<LayerStack, string>>();
                child.Elide(elided);
                child.Origin.ElideAlike(elided);
            }
            foreach (ArcNode child in Children)
            {
                if (!child.IsMovedToRoot) { child.Elide(null); }
            }
            KeepOrigins();
            Size = 1 + RemoveElided();
        }

        bool Elide(HashSet<KeyValuePair<LayerStack, string>> elided)
        {
            bool isEmpty = true;
            foreach (ArcNode child in Children)
            {
                // what is specialized has its like below the root
                isEmpty &= child.Arc == Arc.Specialize ? child.isElided : child.Elide(elided);
            }
            if (isElided) { return true; }
            if (!isEmpty || HasOpinions || DepthBelowIntroduction == 0) { return false; }
            isElided = true;
            SilentFrom = UsdPaths.Elements(Path);
            if (elided != null) { elided.Add(new KeyValuePair<LayerStack, string>(Stack, Path)); }
            return true;
        }

        bool ElideAlike(HashSet<KeyValuePair<LayerStack, string>> elided)
        {
            bool isEmpty = true;
            foreach (ArcNode child in Children) { isEmpty &= child.ElideAlike(elided); }
            if (isEmpty && elided.Contains(new KeyValuePair<LayerStack, string>(Stack, Path)))
            {
                isElided = true;
                SilentFrom = UsdPaths.Elements(Path);
            }
            return isElided;
        }

        bool isKept;

        bool IsToBeRemoved
        {
            get { return isElided && !isKept; }
        }

        void KeepOrigins()
        {
            if (!isElided) { Keep(Origin); }
            foreach (ArcNode child in Children) { child.KeepOrigins(); }
        }

        static void Keep(ArcNode node)
        {
            if (node == null || !node.isElided || node.isKept) { return; }
            node.isKept = true;
            Keep(node.Parent);
            Keep(node.Origin);
        }

        int RemoveElided()
        {
            int count = 0;
            if (MovedTo != null && MovedTo.IsToBeRemoved) { MovedTo = null; }
            if (children == null) { return count; }
            children.RemoveAll(delegate(ArcNode child) { return child.IsToBeRemoved; });
            if (children.Count == 0) { children = null; }
            foreach (ArcNode child in Children) { count += 1 + child.RemoveElided(); }
            return count;
        }
    }
}
