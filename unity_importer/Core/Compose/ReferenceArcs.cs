using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    // references and payloads, and prims that a layer moves
    sealed partial class ArcTree
    {
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

        void FollowReferences(ArcNode node, Arc arc)
        {
            if (node.IsSilent) { return; }
            var targets = new List<Target>();
            for (int i = node.Specs.Length - 1; i >= 0; i--)
            {
                ListOp<ReferenceArc> op = arc == Arc.Reference ? node.Specs[i].Spec.References
                    : node.Specs[i].Spec.Payloads;
                if (op == null) { continue; }
                int layer = node.Specs[i].Layer;
                op.Converted(delegate(ReferenceArc one) { return Resolve(node, layer, one); }).ApplyTo(targets);
            }
            for (int i = 0; i < targets.Count; i++)
            {
                Target target = targets[i];
                var terms = new Terms { HasAncestors = UsdPaths.Depth(target.Path) > 1 };
                Follow(arc, node, node, target.Stack, target.Path,
                    MapOfArc(target.Path, node, target.IsInternal, target.Offset), i, terms);
            }
        }

        Target Resolve(ArcNode node, int layerNumber, ReferenceArc arc)
        {
            Layer layer = node.Stack.Layers[layerNumber];
            LayerStack stack = arc.Asset.Length == 0 ? node.Stack
                : composer.Library.Find(node.Stack, layer, arc.Asset);
            if (stack == null) { return null; }
            string path = arc.Path.Length > 0 ? arc.Path : stack.DefaultPrim;
            if (path == null || path == "/")
            {
                composer.Library.Warn(layer.Identifier + ": <" + node.Path + "> refers to " + stack.Root.Identifier
                    + ", which has no default prim");
                return null;
            }
            if (UsdPaths.HasVariant(path) || path.IndexOf('.') >= 0)
            {
                composer.Library.Warn(layer.Identifier + ": <" + node.Path + "> refers to <" + path
                    + ">, which is no prim");
                return null;
            }
            LayerOffset offset = node.Stack.Offsets[layerNumber].After(composer.Library.Rated(arc.Offset, layer,
                stack.Root));
            return new Target { Stack = stack, Path = path, Offset = offset, IsInternal = arc.Asset.Length == 0 };
        }

        // what paths of an arc's target mean at its parent, with what is moved there
        static PathMap MapOfArc(string target, ArcNode parent, bool keepsOthers, LayerOffset offset)
        {
            string path = UsdPaths.WithoutVariants(parent.Path);
            PathMap map = PathMap.Of(target, path, false, offset);
            if (parent.Stack.Relocates != null) { map = parent.Stack.Relocates.At(path).After(map); }
            return keepsOthers ? map.KeepingOthers() : map;
        }

        // ---- moved prims

        // a prim that was moved here has what its old place leads to, in place of what the prim above leads to here
        void FollowRelocate(ArcNode node)
        {
            if (node.IsSilent && node.DepthBelowIntroduction == 0) { return; }
            string source;
            if (!node.Stack.Relocates.Sources.TryGetValue(node.Path, out source)) { return; }
            foreach (ArcNode child in node.Children)
            {
                if (child.Arc != Arc.Variant) { child.Silence(true); }
            }
            ArcNode old = Follow(Arc.Relocate, node, node, node.Stack, source, PathMap.Identity, 0,
                new Terms { IsSilent = true, HasAncestors = true });
            if (old != null) { SilenceMovedAway(old); }
        }

        // other relocations may move what is below to yet another prim
        static void SilenceMovedAway(ArcNode node)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.Arc == Arc.Relocate) { continue; }
                bool isMoved = !child.IsSilent && child.Stack.Relocates != null
                    && child.Stack.Relocates.Targets.ContainsKey(child.Path);
                if (isMoved) { child.Silence(true); }
                else { SilenceMovedAway(child); }
            }
        }

        void ImplyRelocate(ArcNode node)
        {
            ArcNode parent = node.Parent, place = parent == null ? null : parent.Parent;
            if (node.IsAncestral || place == null) { return; }
            string source = parent.ToParent.ToTarget(node.Path);
            if (source == null) { return; }
            foreach (ArcNode child in place.Children)
            {
                if (child.Arc == Arc.Relocate && child.Path == source) { return; }
            }
            Follow(Arc.Relocate, place, node, place.Stack, source, PathMap.Identity, 0, new Terms { IsSilent = true });
        }

        /// <summary>
        /// Where an arc leads to the old place of a prim that was moved, nothing is there: all nodes count for nothing.
        /// </summary>
        public bool IsMovedAway()
        {
            if (!IsMovedAway(root)) { return false; }
            root.IsSilent = true;
            foreach (ArcNode child in root.Children) { child.Silence(true); }
            return true;
        }

        static bool IsMovedAway(ArcNode node)
        {
            if (node.IsElided) { return false; }
            if (!node.IsSilent && node.Stack.Relocates != null && node.Stack.Relocates.Targets.ContainsKey(node.Path))
            {
                return true;
            }
            foreach (ArcNode child in node.Children)
            {
                if (IsMovedAway(child)) { return true; }
            }
            return false;
        }
    }
}
