using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Which of the nodes of a tree is stronger: negative for the first, as comparisons are.</summary>
    static class ArcStrength
    {
        /// <summary>Of any two nodes of a tree.</summary>
        public static int CompareAnywhere(ArcNode one, ArcNode other)
        {
            if (ReferenceEquals(one, other)) { return 0; }
            List<ArcNode> ones = FromRoot(one), others = FromRoot(other);
            int common = 0;
            while (common < ones.Count && common < others.Count && ReferenceEquals(ones[common], others[common]))
            {
                common++;
            }
            // what is above is stronger
            if (common == ones.Count) { return -1; }
            return common == others.Count ? 1 : Compare(ones[common], others[common]);
        }

        static List<ArcNode> FromRoot(ArcNode node)
        {
            var nodes = new List<ArcNode>();
            for (; node != null; node = node.Parent) { nodes.Add(node); }
            nodes.Reverse();
            return nodes;
        }

        /// <summary>Of two children of a node.</summary>
        public static int Compare(ArcNode one, ArcNode other)
        {
            if (one.Arc != other.Arc) { return one.Arc.CompareTo(other.Arc); }
            int order = one.Arc == Arc.Specialize ? OfSpecialized(one, other) : OfOthers(one, other);
            return order != 0 ? order : one.Sibling.CompareTo(other.Sibling);
        }

        static int OfOthers(ArcNode one, ArcNode other)
        {
            if (one.Depth != other.Depth) { return other.Depth.CompareTo(one.Depth); }
            return ReferenceEquals(one.Origin, other.Origin) ? 0 : First(one.Root, one.Origin, other.Origin);
        }

        static int OfSpecialized(ArcNode one, ArcNode other)
        {
            int oneSteps, otherSteps;
            ArcNode oneStart = Start(one, out oneSteps), otherStart = Start(other, out otherSteps);
            // what is specialized is weaker than what specializes it, however deep either was introduced
            bool areNested = oneStart.IsWithin(otherStart) || otherStart.IsWithin(oneStart);
            if (!areNested && one.Depth != other.Depth) { return other.Depth.CompareTo(one.Depth); }
            bool isOneStated = !one.IsImpliedClass, isOtherStated = !other.IsImpliedClass;
            if (ReferenceEquals(one.Origin, other.Origin))
            {
                return isOneStated || isOtherStated ? 0 : OfMoved(one, other);
            }
            if (!ReferenceEquals(oneStart, otherStart)) { return First(one.Root, oneStart, otherStart); }
            int oneDepth = isOneStated ? 0 : DepthOfInstance(one.Origin);
            int otherDepth = isOtherStated ? 0 : DepthOfInstance(other.Origin);
            if (oneDepth != otherDepth) { return oneDepth.CompareTo(otherDepth); }
            // the more arcs it was implied across, the nearer it is to the root
            if (oneSteps != otherSteps) { return otherSteps.CompareTo(oneSteps); }
            LayerStack nearest = one.Root.Stack;
            if (ReferenceEquals(one.Stack, nearest) && ReferenceEquals(other.Stack, nearest) && !isOneStated
                && !isOtherStated)
            {
                int order = OfMoved(one, other);
                if (order != 0) { return order; }
            }
            return First(one.Root, one.Origin, other.Origin);
        }

        // what was implied is nearer than what was moved to the root only to be weak
        static int OfMoved(ArcNode one, ArcNode other)
        {
            bool isOneMoved = one.IsAt(one.Origin.Stack, one.Origin.Path);
            bool isOtherMoved = other.IsAt(other.Origin.Stack, other.Origin.Path);
            return isOneMoved.CompareTo(isOtherMoved);
        }

        static ArcNode Start(ArcNode node, out int steps)
        {
            for (steps = 0; !ReferenceEquals(node.Origin, node.Parent); steps++) { node = node.Origin; }
            return node;
        }

        static int DepthOfInstance(ArcNode node)
        {
            ArcNode instance = InstanceOf(node).Parent;
            while (instance.Arc == Arc.Relocate) { instance = instance.Parent; }
            return instance.Depth;
        }

        /// <summary>
        /// The first class of the chain of classes that a class is in: its parent is the instance of the chain.
        /// </summary>
        public static ArcNode InstanceOf(ArcNode node)
        {
            int depth = node.DepthBelowIntroduction;
            while (node.Parent.IsClass && node.Parent.DepthBelowIntroduction == depth) { node = node.Parent; }
            return node;
        }

        static int First(ArcNode from, ArcNode one, ArcNode other)
        {
            if (ReferenceEquals(from, one)) { return -1; }
            if (ReferenceEquals(from, other)) { return 1; }
            foreach (ArcNode child in from.Children)
            {
                int order = First(child, one, other);
                if (order != 0) { return order; }
            }
            return 0;
        }
    }
}
