using System;
using System.Collections.Generic;
using System.Text;

namespace Garage.Usd
{
    /// <summary>What instances share: whatever comes by arcs of their own, and not of prims above them.</summary>
    static class Instancing
    {
        /// <summary>Whether a prim is marked as an instance and has an arc that others may share.</summary>
        public static bool IsInstance(ArcNode root)
        {
            return IsMarked(root) == true && HasShared(root, false);
        }

        static bool? IsMarked(ArcNode node)
        {
            for (int i = 0; i < node.Specs.Length && !node.IsSilent; i++)
            {
                if (node.Specs[i].Spec.IsInstanceable != null) { return node.Specs[i].Spec.IsInstanceable; }
            }
            foreach (ArcNode child in node.Children)
            {
                bool? isMarked = IsMarked(child);
                if (isMarked != null) { return isMarked; }
            }
            return null;
        }

        static bool HasShared(ArcNode node, bool isBelowOwnArc)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.IsElided) { continue; }
                bool isOwn = isBelowOwnArc || !child.IsAncestral;
                if ((isOwn && child.Specs.Length > 0) || HasShared(child, isOwn)) { return true; }
            }
            return false;
        }

        /// <summary>Makes opinions from outside of the arcs of an instance count for nothing below it.</summary>
        public static void SilenceOutside(ArcNode root)
        {
            root.IsSilent = true;
            SilenceOutside(root, false);
        }

        static void SilenceOutside(ArcNode node, bool isBelowOwnArc)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.IsElided) { continue; }
                bool isOwn = isBelowOwnArc || !child.IsAncestral;
                if (isOwn && child.Specs.Length > 0) { continue; }
                child.IsSilent = true;
                SilenceOutside(child, isOwn);
            }
        }

        /// <summary>The same text for instances that share all below them.</summary>
        public static string Key(ArcNode root)
        {
            var key = new StringBuilder();
            AddArcs(root, false, key);
            var selections = new SortedDictionary<string, string>(StringComparer.Ordinal);
            AddSelections(root, selections);
            foreach (KeyValuePair<string, string> one in selections)
            {
                key.Append('{').Append(one.Key).Append('=').Append(one.Value);
            }
            return key.ToString();
        }

        static void AddArcs(ArcNode node, bool isBelowOwnArc, StringBuilder key)
        {
            foreach (ArcNode child in node.Children)
            {
                if (child.IsElided) { continue; }
                bool isOwn = isBelowOwnArc || !child.IsAncestral;
                if (!isOwn || child.Specs.Length == 0)
                {
                    AddArcs(child, isOwn, key);
                    continue;
                }
                // what is below it follows from it
                LayerOffset offset = child.ToRoot.Offset;
                key.Append((int)child.Arc).Append(' ').Append(child.Stack.Number).Append(' ').Append(child.Path);
                key.Append(' ').Append(InvariantText.Of(offset.Offset, offset.Scale)).Append('\n');
            }
        }

        static void AddSelections(ArcNode node, IDictionary<string, string> selections)
        {
            for (int i = 0; i < node.Specs.Length && !node.IsSilent; i++)
            {
                Dictionary<string, string> own = node.Specs[i].Spec.VariantSelections;
                if (own == null) { continue; }
                foreach (KeyValuePair<string, string> one in own)
                {
                    if (!selections.ContainsKey(one.Key)) { selections.Add(one.Key, one.Value); }
                }
            }
            foreach (ArcNode child in node.Children) { AddSelections(child, selections); }
        }
    }
}
