using System.Collections.Generic;

namespace Garage.Usd
{
    // inherited and specialized prims, and those that follow from them in the layers around
    sealed partial class ArcTree
    {
        void FollowClasses(ArcNode node, Arc arc)
        {
            if (node.IsSilent) { return; }
            var paths = new List<string>();
            for (int i = node.Specs.Length - 1; i >= 0; i--)
            {
                ListOp<string> op = arc == Arc.Inherit ? node.Specs[i].Spec.Inherits : node.Specs[i].Spec.Specializes;
                if (op != null) { op.ApplyTo(paths); }
            }
            for (int i = 0; i < paths.Count; i++)
            {
                if (paths[i] == "/" || UsdPaths.HasVariant(paths[i]) || paths[i].IndexOf('.') >= 0) { continue; }
                FollowClass(arc, node, node, MapOfArc(paths[i], node, true, LayerOffset.Identity), i, null);
            }
        }

        // the class by way of a map, as relocations change where it is; what is there already is not added
        ArcNode FollowClass(Arc arc, ArcNode parent, ArcNode origin, PathMap map, int sibling, ArcNode implying)
        {
            string path = ClassPath(parent.Path, map);
            if (path == null) { return null; }
            ArcNode known = KnownClass(arc, parent, path, map, origin.DepthBelowIntroduction);
            if (known != null) { return known; }
            bool says = path != parent.Path && !(implying != null && implying.IsAt(parent.Stack, path));
            return Follow(arc, parent, origin, parent.Stack, path, map, sibling, new Terms
            {
                IsSilent = !says, SkipsKnown = says, HasAncestors = says && UsdPaths.Depth(path) > 1,
            });
        }

        // the place that the parent's path comes from; where that is in a variant, the class is in the same one
        static string ClassPath(string parent, PathMap map)
        {
            if (!UsdPaths.HasVariant(parent)) { return map.ToSource(parent); }
            string variant = parent.Substring(0, parent.LastIndexOf('}') + 1);
            string plain = UsdPaths.WithoutVariants(variant);
            string path = map.ToSource(UsdPaths.WithoutVariants(parent));
            return path == null || !UsdPaths.HasPrefix(path, plain) ? path : UsdPaths.Moved(path, plain, variant);
        }

        ArcNode KnownClass(Arc arc, ArcNode parent, string path, PathMap map, int depth)
        {
            bool isMoved = (parent.Parent != null || IsOfStage ? parent.Arc : around.Arc) == Arc.Relocate;
            return Known(arc, parent, parent.Stack, path, map, depth, isMoved);
        }

        // below an old place, paths of classes need not mean anything
        static ArcNode Known(Arc arc, ArcNode parent, LayerStack stack, string path, PathMap map, int depth,
            bool isMoved)
        {
            foreach (ArcNode child in parent.Children)
            {
                if (isMoved ? child.Arc == arc && child.ToParent.Equals(map)
                    && child.Origin.DepthBelowIntroduction == depth : child.IsAt(stack, path))
                {
                    return child;
                }
            }
            return null;
        }

        static bool HasClass(ArcNode node)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.IsClass) { return true; }
            }
            return false;
        }

        // ---- implied classes

        // where to begin, so that a class of a class is implied together with the class that it belongs to
        static ArcNode StartOfClasses(ArcNode node)
        {
            while (node.IsClass)
            {
                ArcNode first = ArcStrength.InstanceOf(node);
                node = first.Parent;
                if (node.IsClass && UsdPaths.HasPrefix(first.Path, node.PathAtIntroduction)) { break; }
            }
            return node;
        }

        /// <summary>
        /// What inherits a class in a referenced layer inherits the class of the same name in the layers that refer to
        /// it too.
        /// </summary>
        void ImplyClasses(ArcNode node)
        {
            // what is below a specialized prim is implied where it was before it was moved
            if (node.Parent == null || node.IsMovedToRoot || !HasClass(node)) { return; }
            ImplyClasses(node.Parent, node, node.ToParent.KeepingOthers(), true);
        }

        void ImplyClasses(ArcNode to, ArcNode from, PathMap transfer, bool isStart)
        {
            if (to.Arc == Arc.Relocate)
            {
                ImplyClasses(to.Parent, from, to.ToParent.KeepingOthers().After(transfer), isStart);
                AddTask(Step.ImplyClasses, to);
                return;
            }
            foreach (ArcNode child in from.ChildrenNow())
            {
                if (!child.IsClass) { continue; }
                // a class of the class that this one is, not of a prim below it
                if (isStart && from.IsClass && from.DepthBelowIntroduction == child.DepthBelowIntroduction)
                {
                    continue;
                }
                PathMap map = ImpliedMap(transfer, child.ToParent);
                bool isMovedAnyway = IsOfStage && to.Parent == null && child.Arc == Arc.Specialize
                    && child.IsAt(to.Stack, ClassPath(to.Path, map));
                if (isMovedAnyway) { continue; }
                ArcNode implied = null;
                foreach (ArcNode one in to.Children)
                {
                    if (ReferenceEquals(one.Origin, child) && one.ToParent.Equals(map))
                    {
                        implied = one;
                        break;
                    }
                }
                implied = implied ?? FollowClass(child.Arc, to, child, map, child.Sibling, child);
                if (implied == null || !HasClass(child)) { continue; }
                ImplyClasses(implied, child, map.Inverse().After(transfer.After(child.ToParent)), false);
            }
        }

        static PathMap ImpliedMap(PathMap transfer, PathMap map)
        {
            return ReferenceEquals(transfer, PathMap.Identity) ? map
                : transfer.After(map.After(transfer.Inverse())).KeepingOthers();
        }

        // ---- specialized prims

        static bool HasSpecialized(ArcNode node)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.Arc == Arc.Specialize) { return true; }
            }
            return false;
        }

        static ArcNode StartOfSpecialized(ArcNode node)
        {
            ArcNode start = null;
            for (; node.Parent != null; node = node.Parent)
            {
                if (node.Arc == Arc.Specialize) { start = node; }
            }
            return start;
        }

        /// <summary>
        /// Moves specialized prims below the root, where they are weaker than all else. What is found below one there is
        /// brought back to where it was before, so that its classes are implied from there, and moved again.
        /// </summary>
        void ImplySpecialized(ArcNode node)
        {
            if (node.Parent == null) { return; }
            if (!node.IsMovedToRoot)
            {
                MoveSpecialized(node);
                return;
            }
            foreach (ArcNode child in node.ChildrenNow()) { BringBack(node.Origin, child, child.ToParent, node); }
        }

        void MoveSpecialized(ArcNode node)
        {
            bool isPlaceholder = node.Parent != null && !ReferenceEquals(node.Parent, node.Origin)
                && node.Parent.Arc == Arc.Relocate && node.IsAt(node.Parent.Stack, node.Parent.Path);
            if (isPlaceholder) { return; }
            if (node.Arc == Arc.Specialize)
            {
                // what was brought back is silent, and must not be when it is moved again
                bool wasSilent = node.IsSilent;
                int silentFrom = node.SilentFrom;
                if (wasSilent) { node.IsSilent = false; }
                MoveToRoot(root, node, node.ToRoot, node);
                if (wasSilent) { node.SilentFrom = silentFrom; }
            }
            foreach (ArcNode child in node.ChildrenNow()) { MoveSpecialized(child); }
        }

        void MoveToRoot(ArcNode parent, ArcNode node, PathMap map, ArcNode top)
        {
            ArcNode moved = Moved(parent, node, map, top, true, false);
            if (moved == null) { return; }
            foreach (ArcNode child in node.ChildrenNow())
            {
                if (child.Arc != Arc.Specialize) { MoveToRoot(moved, child, child.ToParent, top); }
            }
        }

        void BringBack(ArcNode parent, ArcNode node, PathMap map, ArcNode top)
        {
            ArcNode moved = Moved(parent, node, map, top, false, true);
            if (moved == null) { return; }
            foreach (ArcNode child in node.ChildrenNow()) { BringBack(moved, child, child.ToParent, top); }
        }

        // a node as it is below another parent; it says nothing any longer where it was
        ArcNode Moved(ArcNode parent, ArcNode node, PathMap map, ArcNode top, bool isImplied, bool isFollowed)
        {
            if (ReferenceEquals(node.Parent, parent)) { return node; }
            ArcNode moved = Known(node.Arc, parent, node.Stack, node.Path, map, node.DepthBelowIntroduction,
                parent.Arc == Arc.Relocate);
            bool isTop = ReferenceEquals(node, top);
            // classes that follow from others below the top do so again
            if (moved == null && !(node.IsImpliedClass && node.Origin.IsWithin(top)))
            {
                moved = Follow(node.Arc, parent, isTop || node.IsImpliedClass ? node : parent, node.Stack, node.Path,
                    map, node.Sibling, isTop ? parent.Level : node.Depth, new Terms
                    {
                        IsSilent = node.IsSilent, IsImplied = isImplied, IsFollowed = isFollowed,
                    });
            }
            if (moved == null)
            {
                node.Silence(false);
                return null;
            }
            if (ReferenceEquals(node.MovedTo, moved))
            {
                node.IsSilent = true;
                return moved;
            }
            // one that says nothing is no reason for what came elsewhere to say nothing
            if (node.IsSilent) { return moved; }
            int silentFrom = moved.SilentFrom;
            if (moved.IsSilent) { AddTask(Step.FindVariants, moved); }
            moved.IsSilent = false;
            moved.MovedTo = null;
            node.IsSilent = true;
            node.MovedTo = moved;
            if (silentFrom != 0) { node.SilentFrom = silentFrom; }
            return moved;
        }
    }
}
