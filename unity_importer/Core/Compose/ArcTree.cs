using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>An arc whose target is built as a tree of its own, before it is hung below its parent.</summary>
    sealed class PendingArc
    {
        public Arc Arc;
        public ArcNode Parent;

        /// <summary>The path of the prim that is wanted; a tree for it begins with those of the prims above.</summary>
        public string Path;

        public LayerStack Stack;

        /// <summary>Whether what is anywhere in the tree already is not added again.</summary>
        public bool SkipsKnown;

        /// <summary>The arc in whose tree the parent is; null where that is the tree of the stage.</summary>
        public PendingArc Around;
    }

    /// <summary>
    /// Grows the tree of all places that have opinions on a prim, arc by arc: local, inherited, of variants, moved,
    /// referenced, of payloads and specialized ones, in this order of strength at each place.
    /// </summary>
    sealed partial class ArcTree
    {
        readonly Composer composer;
        readonly ArcNode root;
        readonly PendingArc around;
        readonly List<ArcTask> tasks = new List<ArcTask>();

        /// <summary>Of the first nodes; those of an arc's target where one is given.</summary>
        public ArcTree(Composer composer, ArcNode root, PendingArc around)
        {
            this.composer = composer;
            this.root = root;
            this.around = around;
        }

        // variants of an arc's target are chosen in the tree that the arc is in, which may select them
        bool IsOfStage
        {
            get { return around == null; }
        }

        /// <summary>Follows all arcs.</summary>
        public void Grow()
        {
            AddTasksBelow(root, false, false, false);
            while (tasks.Count > 0)
            {
                int next = 0;
                for (int i = 1; i < tasks.Count; i++)
                {
                    if (tasks[i].IsBefore(tasks[next])) { next = i; }
                }
                composer.Charge(root, 1 + tasks.Count / Composer.NodesPassedPerCharge);
                ArcTask task = tasks[next];
                tasks[next] = tasks[tasks.Count - 1];
                tasks.RemoveAt(tasks.Count - 1);
                Do(task);
            }
        }

        void Do(ArcTask task)
        {
            ArcNode node = task.Node;
            switch (task.Step)
            {
                case Step.Relocate: FollowRelocate(node); break;
                case Step.ImplyRelocate: ImplyRelocate(node); break;
                case Step.Reference: FollowReferences(node, Arc.Reference); break;
                case Step.Payload: FollowReferences(node, Arc.Payload); break;
                case Step.Inherit: FollowClasses(node, Arc.Inherit); break;
                case Step.ImplyClasses: ImplyClasses(node); break;
                case Step.Specialize: FollowClasses(node, Arc.Specialize); break;
                case Step.FindAncestralVariants: FindAncestralVariants(node); break;
                case Step.ImplySpecialized: ImplySpecialized(node); break;
                case Step.FindVariants: FindVariants(node); break;
                case Step.ChooseAncestralVariant: case Step.ChooseVariant: ChooseVariant(task); break;
            }
        }

        // ---- what is to be done

        void AddTask(Step step, ArcNode node)
        {
            if (step == Step.ImplyClasses || step == Step.ImplySpecialized)
            {
                foreach (ArcTask task in tasks)
                {
                    if (task.Step == step && ReferenceEquals(task.Node, node)) { return; }
                }
            }
            tasks.Add(new ArcTask(step, node));
        }

        void AddTasks(ArcNode node, bool isFollowed, bool isImplied, bool hasAncestors)
        {
            if (!isImplied)
            {
                if (node.IsClass) { AddTask(Step.ImplyClasses, StartOfClasses(node)); }
                else if (HasClass(node)) { AddTask(Step.ImplyClasses, node); }
                if (IsOfStage)
                {
                    ArcNode start = StartOfSpecialized(node);
                    if (start != null) { AddTask(Step.ImplySpecialized, start); }
                    else if (HasSpecialized(node)) { AddTask(Step.ImplySpecialized, node); }
                }
            }
            AddTasksBelow(node, isFollowed, isImplied, hasAncestors);
        }

        void AddTasksBelow(ArcNode node, bool isFollowed, bool isImplied, bool hasAncestors)
        {
            foreach (ArcNode child in node.Children) { AddTasksBelow(child, isFollowed, isImplied, hasAncestors); }
            bool references = false, payloads = false, inherits = false, specializes = false, variants = false;
            for (int i = 0; i < node.Specs.Length && !node.IsSilent; i++)
            {
                PrimSpec spec = node.Specs[i].Spec;
                references |= spec.References != null;
                inherits |= spec.Inherits != null;
                payloads |= spec.Payloads != null;
                specializes |= spec.Specializes != null;
                variants |= spec.VariantSetNames != null;
            }
            if (IsOfStage && variants) { AddTask(Step.FindVariants, node); }
            if (isImplied) { return; }
            if (IsOfStage && hasAncestors) { AddTask(Step.FindAncestralVariants, node); }
            if (!isFollowed)
            {
                if (specializes) { AddTask(Step.Specialize, node); }
                if (inherits) { AddTask(Step.Inherit, node); }
                if (payloads) { AddTask(Step.Payload, node); }
                if (references) { AddTask(Step.Reference, node); }
                if (node.Stack.Relocates != null && !node.IsSilent) { AddTask(Step.Relocate, node); }
            }
            if (node.Arc == Arc.Relocate) { AddTask(Step.ImplyRelocate, node); }
        }

        // ---- arcs

        /// <summary>How an arc's target is added.</summary>
        struct Terms
        {
            /// <summary>The target itself says nothing: it is there for what it leads to.</summary>
            public bool IsSilent;

            /// <summary>What the prims above the target lead to is added too.</summary>
            public bool HasAncestors;

            /// <summary>The target is left out where the tree has it already.</summary>
            public bool SkipsKnown;

            /// <summary>Classes below the target have been implied.</summary>
            public bool IsImplied;

            /// <summary>Arcs that the target states have been followed.</summary>
            public bool IsFollowed;
        }

        ArcNode Follow(Arc arc, ArcNode parent, ArcNode origin, LayerStack stack, string path, PathMap map, int sibling,
            Terms terms)
        {
            return Follow(arc, parent, origin, stack, path, map, sibling, parent.Level, terms);
        }

        /// <summary>Adds the target of an arc; null where the arc leads back or what it brings is known.</summary>
        ArcNode Follow(Arc arc, ArcNode parent, ArcNode origin, LayerStack stack, string path, PathMap map, int sibling,
            int depth, Terms terms)
        {
            if (LeadsBack(arc, parent, origin, stack, path))
            {
                composer.Library.Warn("<" + parent.Path + "> leads back to <" + path + ">");
                return null;
            }
            terms.SkipsKnown |= around != null && around.SkipsKnown;
            if (terms.SkipsKnown && IsKnown(parent, stack, path)) { return null; }
            ArcNode node;
            if (!terms.HasAncestors)
            {
                node = ArcNode.Of(stack, path);
                if (terms.IsSilent)
                {
                    node.IsSilent = true;
                    node.SilentFrom = 1;
                }
            }
            else
            {
                var pending = new PendingArc
                {
                    Arc = arc, Parent = parent, Stack = stack, Path = path, SkipsKnown = terms.SkipsKnown,
                    Around = around,
                };
                node = composer.Target(pending, !terms.IsSilent);
            }
            composer.CheckSize(parent, root.Size + node.Size);
            composer.Charge(parent, node.Size);
            parent.Add(node, arc, origin, map, depth, sibling);
            AddTasks(node, terms.IsFollowed || terms.HasAncestors, terms.IsImplied, terms.HasAncestors);
            return node;
        }

        // whether a place is that of a node or of one above it, or around or within it
        bool LeadsBack(Arc arc, ArcNode parent, ArcNode origin, LayerStack stack, string path)
        {
            if (arc == Arc.Variant) { return false; }
            bool isImplied = (arc == Arc.Inherit || arc == Arc.Specialize) && !ReferenceEquals(parent, origin);
            if (isImplied && IsOfRelocate(parent)) { return false; }
            PendingArc pending = around;
            int arcs = 0;
            for (ArcNode node = parent; node != null;)
            {
                for (ArcNode above = node; above != null; above = above.Parent)
                {
                    composer.CheckDepth(parent, ++arcs);
                    if (ReferenceEquals(above.Stack, stack) && (UsdPaths.HasPrefix(above.Path, path)
                        || UsdPaths.HasPrefix(path, above.Path)))
                    {
                        if (!ReferenceEquals(node, parent)) { composer.IsPeculiar = true; }
                        return true;
                    }
                }
                if (pending == null) { return false; }
                path = PathWhenHung(path, node.Root, pending);
                node = pending.Parent;
                pending = pending.Around;
            }
            return false;
        }

        // where a place of a tree will be when the tree is that of the wanted prim, which may be below the one at hand
        static string PathWhenHung(string path, ArcNode root, PendingArc pending)
        {
            return UsdPaths.HasPrefix(pending.Path, root.Path) ? UsdPaths.Moved(pending.Path, root.Path, path) : path;
        }

        bool IsOfRelocate(ArcNode node)
        {
            PendingArc pending = around;
            while (node != null)
            {
                Arc arc = node.Parent != null || pending == null ? node.Arc : pending.Arc;
                if (arc != Arc.Inherit && arc != Arc.Specialize) { return arc == Arc.Relocate; }
                if (node.Parent != null) { node = node.Parent; }
                else
                {
                    node = pending.Parent;
                    pending = pending.Around;
                }
            }
            return false;
        }

        // whether the tree, or one that it will be hung into, has a place
        bool IsKnown(ArcNode parent, LayerStack stack, string path)
        {
            PendingArc pending = around;
            for (ArcNode top = parent.Root; ; top = pending.Parent.Root, pending = pending.Around)
            {
                if (Has(top, stack, path))
                {
                    composer.IsPeculiar |= !ReferenceEquals(pending, around);
                    return true;
                }
                if (pending == null) { return false; }
                path = PathWhenHung(path, top, pending);
            }
        }

        public static bool Has(ArcNode node, LayerStack stack, string path)
        {
            if (node.IsAt(stack, path)) { return true; }
            foreach (ArcNode child in node.Children)
            {
                if (Has(child, stack, path)) { return true; }
            }
            return false;
        }
    }
}
