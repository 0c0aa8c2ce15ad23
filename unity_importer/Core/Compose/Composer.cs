using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Finds all opinions on the prims of a stage, and keeps the work within what its layers can need.</summary>
    sealed class Composer
    {
        const int MostNodes = 4096;
        const int DeepestArc = 150;
        const long LeastNodeBudget = 300000;
        const long NodesPerSpec = 400;

        /// <summary>Looking at a node costs this much less than making it.</summary>
        public const int NodesPassedPerCharge = 16;

        readonly LayerLibrary library;
        readonly Dictionary<string, ArcNode> targets = new Dictionary<string, ArcNode>();
        long nodesMade;
        int nodesPassed, depth;

        /// <summary>What is built depends on what it will be hung into, as that has a part of it already.</summary>
        public bool IsPeculiar;

        public Composer(LayerLibrary library)
        {
            this.library = library;
        }

        public LayerLibrary Library
        {
            get { return library; }
        }

        static UsdFormatException Error(ArcNode node, string reason)
        {
            return new UsdFormatException(node.Stack.Root.Identifier, "<" + node.Path + ">", reason);
        }

        /// <summary>The opinions on the root of a stack.</summary>
        public static ArcNode RootOf(LayerStack stack)
        {
            return ArcNode.Of(stack, "/");
        }

        /// <summary>The opinions on a child, from those on its parent.</summary>
        public ArcNode Child(ArcNode parent, string name)
        {
            ArcNode root = parent.Extended(name);
            root.Renumber();
            var tree = new ArcTree(this, root, null);
            if (!tree.IsMovedAway())
            {
                tree.Grow();
                WarnOfMissing(root);
            }
            root.Prune();
            Charge(root, root.Size);
            return root;
        }

        // ---- targets of arcs

        /// <summary>
        /// The tree of an arc's target, with what the prims above it lead to, but without variants, which are chosen
        /// where the arc is; the target itself may say nothing.
        /// </summary>
        public ArcNode Target(PendingArc arc, bool speaks)
        {
            bool isUsual = speaks && !arc.SkipsKnown;
            for (PendingArc around = arc; around != null; around = around.Around)
            {
                isUsual &= around.Arc != Arc.Relocate;
            }
            if (!isUsual) { return Grown(arc, arc.Path, speaks); }
            string key = arc.Stack.Number + arc.Path;
            ArcNode known;
            if (targets.TryGetValue(key, out known) && Fits(known, arc)) { return known.Copy(); }
            bool wasPeculiar = IsPeculiar;
            IsPeculiar = false;
            ArcNode grown = Grown(arc, arc.Path, true);
            if (!IsPeculiar && known == null) { targets.Add(key, grown.Copy()); }
            IsPeculiar |= wasPeculiar;
            return grown;
        }

        ArcNode Grown(PendingArc arc, string path, bool speaks)
        {
            if (UsdPaths.IsVariant(path))
            {
                ArcNode variant = ArcNode.Of(arc.Stack, path);
                if (!speaks) { variant.IsSilent = true; }
                new ArcTree(this, variant, arc).Grow();
                return variant;
            }
            if (path == "/") { return RootOf(arc.Stack); }
            CheckDepth(arc.Parent, ++depth);
            ArcNode parent = Grown(arc, UsdPaths.Parent(path), true);
            if (Instancing.IsInstance(parent)) { Instancing.SilenceOutside(parent); }
            ArcNode root = parent.Extended(UsdPaths.Name(path));
            Charge(root, root.Size);
            if (!speaks) { root.IsSilent = true; }
            var tree = new ArcTree(this, root, arc);
            if (!tree.IsMovedAway()) { tree.Grow(); }
            else
            {
                library.Warn("<" + arc.Parent.Path + "> leads to <" + path + "> of " + arc.Stack.Root.Identifier
                    + ", which is relocated: nothing is there");
            }
            depth--;
            return root;
        }

        // whether none of it is in the trees that it is to be hung into
        bool Fits(ArcNode known, PendingArc arc)
        {
            for (; arc != null; arc = arc.Around)
            {
                for (ArcNode above = arc.Parent; above != null; above = above.Parent)
                {
                    if (Crosses(known, above)) { return false; }
                }
                if (Shares(known, arc.Parent.Root)) { return false; }
            }
            return true;
        }

        bool Crosses(ArcNode node, ArcNode above)
        {
            Pass();
            if (ReferenceEquals(node.Stack, above.Stack) && (UsdPaths.HasPrefix(node.Path, above.Path)
                || UsdPaths.HasPrefix(above.Path, node.Path)))
            {
                return true;
            }
            foreach (ArcNode child in node.Children)
            {
                if (Crosses(child, above)) { return true; }
            }
            return false;
        }

        bool Shares(ArcNode node, ArcNode root)
        {
            Pass();
            if (ArcTree.Has(root, node.Stack, node.Path)) { return true; }
            foreach (ArcNode child in node.Children)
            {
                if (Shares(child, root)) { return true; }
            }
            return false;
        }

        // ---- what is missing, and what is too much

        void WarnOfMissing(ArcNode node)
        {
            bool isArc = node.Arc == Arc.Reference || node.Arc == Arc.Payload;
            if (isArc && !node.IsAncestral && !HasSpecs(node))
            {
                library.Warn(node.Parent.Stack.Root.Identifier + ": <" + UsdPaths.WithoutVariants(node.Parent.Path)
                    + "> refers to <" + node.Path + "> of " + node.Stack.Root.Identifier + ", which does not exist");
            }
            foreach (ArcNode child in node.Children) { WarnOfMissing(child); }
        }

        static bool HasSpecs(ArcNode node)
        {
            if (node.Specs.Length > 0) { return true; }
            foreach (ArcNode child in node.Children)
            {
                if (HasSpecs(child)) { return true; }
            }
            return false;
        }

        /// <summary>Counts work that hostile references could multiply without end.</summary>
        public void Charge(ArcNode node, int count)
        {
            nodesMade += count;
            if (nodesMade > LeastNodeBudget + NodesPerSpec * library.SpecCount)
            {
                throw Error(node, "references lead to more places than the stage can need");
            }
        }

        /// <summary>Counts a node that was looked at.</summary>
        public void Pass()
        {
            if (++nodesPassed < NodesPassedPerCharge) { return; }
            nodesPassed = 0;
            nodesMade++;
        }

        /// <summary>Refuses arcs that lead from one to the next without end.</summary>
        public void CheckDepth(ArcNode place, int arcs)
        {
            Pass();
            if (arcs > DeepestArc) { throw Error(place, "references lead more than " + DeepestArc + " deep"); }
        }

        /// <summary>Refuses trees that are larger than any prim can need.</summary>
        public void CheckSize(ArcNode place, int size)
        {
            if (size > MostNodes) { throw Error(place, "references lead to more places than a prim can need"); }
        }
    }
}
