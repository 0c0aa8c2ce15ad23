using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Finds all opinions on a prim: local, inherited, of variants, references, payloads and specialized prims, in this
    /// order of strength at each place.
    /// </summary>
    sealed class Composer
    {
        const int MostNodes = 4096;
        const int DeepestArc = 150;
        const long LeastNodeBudget = 300000;
        const long NodesPerSpec = 400;

        // looking at a node costs this much less than making it
        const int NodesPassedPerCharge = 16;

        readonly LayerLibrary library;
        readonly Dictionary<string, ArcNode> templates = new Dictionary<string, ArcNode>();
        readonly HashSet<string> inProgress = new HashSet<string>();
        long nodesMade;

        public Composer(LayerLibrary library)
        {
            this.library = library;
        }

        public LayerLibrary Library
        {
            get { return library; }
        }

        UsdFormatException Error(ArcNode node, string reason)
        {
            return new UsdFormatException(node.Stack.Root.Identifier, "<" + node.Path + ">", reason);
        }

        /// <summary>The opinions on the root of a stack.</summary>
        public static ArcNode RootOf(LayerStack stack)
        {
            ArcNode root = ArcNode.OfRoot(stack, "/", 0);
            root.Specs = stack.SpecsAt("/");
            root.IsExpanded = true;
            return root;
        }

        /// <summary>The opinions on a child, from those on its parent.</summary>
        public ArcNode Child(ArcNode parent, string name)
        {
            ArcNode root = parent.Extended(name);
            Expand(root, true, null);
            Charge(root, root.Size);
            return root;
        }

        // the opinions on a prim as an arc's target sees them: its variants are chosen by whoever refers to it
        ArcNode Template(LayerStack stack, string path, bool withVariants, bool withAncestors, VariantChoices choices)
        {
            string key = stack.Number + (withVariants ? "+" : withAncestors ? "-" : "=") + path
                + (choices == null ? "" : choices.Key);
            ArcNode made;
            if (templates.TryGetValue(key, out made)) { return made; }
            if (!inProgress.Add(key)) { return null; }
            if (inProgress.Count > DeepestArc)
            {
                throw new UsdFormatException(stack.Root.Identifier, "<" + path + ">",
                    "references lead more than " + DeepestArc + " deep");
            }
            string parentPath = UsdPaths.Parent(path);
            ArcNode root;
            if (parentPath == "/" || parentPath == null || !withAncestors)
            {
                root = ArcNode.OfRoot(stack, path, UsdPaths.Depth(path));
                root.Specs = stack.SpecsAt(path);
            }
            else
            {
                ArcNode parent = Template(stack, parentPath, true, true, choices);
                if (parent == null)
                {
                    inProgress.Remove(key);
                    return null;
                }
                root = parent.Extended(UsdPaths.Name(path));
            }
            Expand(root, withVariants, choices);
            inProgress.Remove(key);
            templates.Add(key, root);
            return root;
        }

        void Expand(ArcNode root, bool withVariants, VariantChoices choices)
        {
            var pending = new List<ArcNode>();
            root.Size = Count(root);
            AddUnexpanded(root, pending);
            for (;;)
            {
                for (int i = 0; i < pending.Count; i++) { ExpandNode(pending[i]); }
                pending.Clear();
                if (!withVariants) { return; }
                ArcNode variant = NextVariant(root, choices);
                if (variant == null) { return; }
                pending.Add(variant);
            }
        }

        static void AddUnexpanded(ArcNode node, List<ArcNode> list)
        {
            if (!node.IsExpanded && node.Specs.Length > 0) { list.Add(node); }
            if (node.Children == null) { return; }
            foreach (ArcNode child in node.Children) { AddUnexpanded(child, list); }
        }

        // ---- references, payloads, classes

        void ExpandNode(ArcNode node)
        {
            node.IsExpanded = true;
            bool references = false, payloads = false, inherits = false, specializes = false;
            foreach (LayerSpec spec in node.Specs)
            {
                references |= spec.Spec.References != null;
                payloads |= spec.Spec.Payloads != null;
                inherits |= spec.Spec.Inherits != null;
                specializes |= spec.Spec.Specializes != null;
            }
            if (references) { AddReferences(node, Arc.Reference); }
            if (payloads) { AddReferences(node, Arc.Payload); }
            if (inherits) { AddClasses(node, Arc.Inherit); }
            if (specializes) { AddClasses(node, Arc.Specialize); }
        }

        sealed class Target : IEquatable<Target>
        {
            public LayerStack Stack;
            public string Path;
            public LayerOffset Offset;
            public bool IsInternal;

            public bool Equals(Target other)
            {
                return ReferenceEquals(Stack, other.Stack) && Path == other.Path && Offset.Offset == other.Offset.Offset
                    && Offset.Scale == other.Offset.Scale;
            }

            public override bool Equals(object other)
            {
                var target = other as Target;
                return target != null && Equals(target);
            }

            public override int GetHashCode()
            {
                return Stack.Number * 31 + Path.GetHashCode();
            }
        }

        void AddReferences(ArcNode node, Arc arc)
        {
            var targets = new List<Target>();
            for (int i = node.Specs.Length - 1; i >= 0; i--)
            {
                ListOp<ReferenceArc> op = arc == Arc.Reference ? node.Specs[i].Spec.References
                    : node.Specs[i].Spec.Payloads;
                if (op == null) { continue; }
                int layer = node.Specs[i].Layer;
                Converted(op, delegate(ReferenceArc one) { return Resolve(node, layer, one); }).ApplyTo(targets);
            }
            foreach (Target target in targets)
            {
                Attach(node, arc, target.Stack, target.Path, target.Offset, target.IsInternal, true);
            }
        }

        Target Resolve(ArcNode node, int layerNumber, ReferenceArc arc)
        {
            Layer layer = node.Stack.Layers[layerNumber];
            LayerStack stack = arc.Asset.Length == 0 ? node.Stack : library.Find(layer, arc.Asset);
            if (stack == null) { return null; }
            string path = arc.Path.Length > 0 ? arc.Path : stack.DefaultPrim;
            if (path == null || path == "/")
            {
                library.Warn(layer.Identifier + ": <" + node.Path + "> refers to " + stack.Root.Identifier
                    + ", which has no default prim");
                return null;
            }
            LayerOffset offset = node.Stack.Offsets[layerNumber].After(library.Rated(arc.Offset, layer, stack.Root));
            return new Target { Stack = stack, Path = path, Offset = offset, IsInternal = arc.Asset.Length == 0 };
        }

        static ListOp<Target> Converted(ListOp<ReferenceArc> op, Func<ReferenceArc, Target> convert)
        {
            return new ListOp<Target>
            {
                IsExplicit = op.IsExplicit, Explicit = Converted(op.Explicit, convert),
                Added = Converted(op.Added, convert),
                Prepended = Converted(op.Prepended, convert), Appended = Converted(op.Appended, convert),
                Deleted = Converted(op.Deleted, convert), Ordered = Converted(op.Ordered, convert),
            };
        }

        static List<Target> Converted(List<ReferenceArc> arcs, Func<ReferenceArc, Target> convert)
        {
            if (arcs == null) { return null; }
            var targets = new List<Target>(arcs.Count);
            foreach (ReferenceArc arc in arcs)
            {
                Target target = convert(arc);
                if (target != null) { targets.Add(target); }
            }
            return targets;
        }

        void AddClasses(ArcNode node, Arc arc)
        {
            var paths = new List<string>();
            for (int i = node.Specs.Length - 1; i >= 0; i--)
            {
                ListOp<string> op = arc == Arc.Inherit ? node.Specs[i].Spec.Inherits : node.Specs[i].Spec.Specializes;
                if (op != null) { op.ApplyTo(paths); }
            }
            foreach (string path in paths)
            {
                ArcNode added = Attach(node, arc, node.Stack, path, LayerOffset.Identity, true, true);
                if (added != null) { Imply(added); }
            }
        }

        /// <summary>Adds a copy of all opinions on the target below a node; null where that is impossible.</summary>
        ArcNode Attach(ArcNode node, Arc arc, LayerStack stack, string path, LayerOffset offset, bool keepsOtherPaths,
            bool withAncestors)
        {
            if (Repeats(node, stack, path))
            {
                library.Warn("<" + node.Path + "> leads back to <" + path + ">");
                return null;
            }
            bool isClass = arc == Arc.Inherit || arc == Arc.Specialize;
            ArcNode template = Template(stack, path, false, withAncestors, isClass && withAncestors
                ? VariantChoices.Of(node, path) : null);
            if (template == null)
            {
                library.Warn("<" + node.Path + "> leads in a circle by <" + path + ">");
                return null;
            }
            if (template.Specs.Length == 0 && template.Children == null && !isClass)
            {
                library.Warn(node.Stack.Root.Identifier + ": <" + node.Path + "> refers to <" + path + "> of "
                    + stack.Root.Identifier + ", which does not exist");
            }
            var root = new ArcNode(stack, path, arc, UsdPaths.Depth(node.Path), path, node.Path, keepsOtherPaths,
                offset, null)
            {
                Specs = template.Specs, IsExpanded = template.IsExpanded,
                ChosenSets = template.ChosenSets == null ? null : new List<string>(template.ChosenSets),
            };
            node.Add(root);
            CountIn(node, 1);
            CopyChildren(node, template, root);
            if (!isClass && root.Children != null)
            {
                foreach (ArcNode child in root.Children.ToArray())
                {
                    if (child.IsClass) { Imply(child); }
                }
            }
            return root;
        }

        // work that hostile references could multiply without end
        void Charge(ArcNode node, int count)
        {
            nodesMade += count;
            if (nodesMade > LeastNodeBudget + NodesPerSpec * library.SpecCount)
            {
                throw Error(node, "references lead to more places than the stage can need");
            }
        }

        void CountIn(ArcNode place, int count)
        {
            ArcNode root = place;
            while (root.Parent != null) { root = root.Parent; }
            root.Size += count;
            if (root.Size > MostNodes) { throw Error(place, "references lead to more places than a prim can need"); }
            Charge(place, count);
        }

        static int Count(ArcNode node)
        {
            int count = 1;
            if (node.Children != null)
            {
                foreach (ArcNode child in node.Children) { count += Count(child); }
            }
            return count;
        }

        void CopyChildren(ArcNode place, ArcNode from, ArcNode to)
        {
            if (from.Children == null) { return; }
            foreach (ArcNode child in from.Children)
            {
                if (Repeats(place, child.Stack, child.Path) && child.Arc != Arc.Variant)
                {
                    library.Warn("<" + place.Path + "> leads back to <" + child.Path + ">");
                    continue;
                }
                CountIn(place, 1);
                ArcNode copy = child.Copy(child.Depth);
                copy.IsAncestral = false;
                copy.Parent = to;
                to.Children = to.Children ?? new List<ArcNode>(from.Children.Count);
                to.Children.Add(copy);
                CopyChildren(place, child, copy);
            }
        }

        // whether a place is that of a node or of one above it, or around or within it
        static bool Repeats(ArcNode node, LayerStack stack, string path)
        {
            for (; node != null; node = node.Parent)
            {
                if (ReferenceEquals(node.Stack, stack) && (UsdPaths.HasPrefix(node.Path, path)
                    || UsdPaths.HasPrefix(path, node.Path)))
                {
                    return true;
                }
            }
            return false;
        }

        // ---- implied classes

        /// <summary>
        /// What inherits a class in a referenced layer inherits the class of the same name in the layers that refer to
        /// it too.
        /// </summary>
        void Imply(ArcNode added)
        {
            // a class of a class goes with the class that it belongs to
            var chain = new List<ArcNode> { added };
            while (chain[0].Parent.IsClass) { chain.Insert(0, chain[0].Parent); }
            ArcNode place = chain[0].Parent;
            var paths = new List<string>();
            foreach (ArcNode one in chain) { paths.Add(one.Path); }
            while (place.Parent != null)
            {
                ArcNode above = place.Parent;
                bool moved = !ReferenceEquals(above.Stack, place.Stack);
                for (int i = 0; i < paths.Count; i++)
                {
                    string path = place.PathInParent(paths[i]) ?? paths[i];
                    moved |= path != paths[i];
                    paths[i] = path;
                }
                place = above;
                if (!moved) { continue; }
                ImplyBelow(place, chain, paths);
                return;
            }
        }

        void ImplyBelow(ArcNode place, List<ArcNode> chain, List<string> paths)
        {
            ArcNode at = place;
            for (int i = 0; i < chain.Count; i++)
            {
                ArcNode found = null;
                if (at.Children != null)
                {
                    foreach (ArcNode child in at.Children)
                    {
                        if (child.Arc == chain[i].Arc && child.Path == paths[i]
                            && ReferenceEquals(child.Stack, at.Stack))
                        {
                            found = child;
                        }
                    }
                }
                if (found == null)
                {
                    if (Repeats(at, at.Stack, paths[i])) { return; }
                    // what the class inherits from its ancestors comes by the class that this one is implied by
                    found = Attach(at, chain[i].Arc, at.Stack, paths[i], LayerOffset.Identity, true, false);
                    if (found == null) { return; }
                    Imply(found);
                }
                at = found;
            }
            foreach (ArcNode deeper in (chain[chain.Count - 1].Children ?? new List<ArcNode>()).ToArray())
            {
                if (deeper.IsClass) { Imply(deeper); }
            }
        }

        // ---- variants

        ArcNode NextVariant(ArcNode root, VariantChoices choices)
        {
            var order = new List<ArcNode>();
            root.AddByStrength(order);
            Charge(root, 1 + order.Count / NodesPassedPerCharge);
            foreach (ArcNode node in order)
            {
                foreach (string set in node.VariantSets)
                {
                    if (node.ChosenSets != null && node.ChosenSets.Contains(set)) { continue; }
                    string selection = (choices == null ? null : choices.Find(root.Path, set))
                        ?? SelectionOf(order, set);
                    if (selection == null) { continue; }
                    node.ChosenSets = node.ChosenSets ?? new List<string>(1);
                    node.ChosenSets.Add(set);
                    ArcNode variant = MakeVariant(node, set, selection);
                    if (variant != null) { return variant; }
                }
            }
            return null;
        }

        static string SelectionOf(List<ArcNode> order, string set)
        {
            foreach (ArcNode one in order)
            {
                foreach (LayerSpec spec in one.Specs)
                {
                    string selection;
                    Dictionary<string, string> selections = spec.Spec.VariantSelections;
                    if (selections != null && selections.TryGetValue(set, out selection)) { return selection; }
                }
            }
            return null;
        }

        ArcNode MakeVariant(ArcNode node, string set, string selection)
        {
            var specs = new List<LayerSpec>();
            foreach (LayerSpec spec in node.Specs)
            {
                VariantSetSpec sets = spec.Spec.FindVariantSet(set);
                PrimSpec found = sets == null ? null : sets.Find(selection);
                if (found != null) { specs.Add(new LayerSpec(spec.Layer, found)); }
            }
            if (specs.Count == 0) { return null; }
            var variant = new ArcNode(node.Stack, node.Path, Arc.Variant, UsdPaths.Depth(node.Path), null, null, true,
                LayerOffset.Identity, set + "=" + selection)
            {
                Specs = specs.ToArray(),
            };
            node.Add(variant);
            CountIn(node, 1);
            return variant;
        }
    }
}
