using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The names of the children of a prim, in the order that all layers together give them.</summary>
    sealed class ChildNames
    {
        List<string> names = new List<string>();
        readonly HashSet<string> known = new HashSet<string>();
        // of prims that were moved away, which no weaker layer brings back
        readonly HashSet<string> gone = new HashSet<string>();

        public IList<string> Names
        {
            get { return names; }
        }

        /// <summary>Of the opinions on a prim.</summary>
        public ChildNames(ArcNode root)
        {
            var order = new List<ArcNode>();
            root.AddByStrength(order);
            for (int i = order.Count - 1; i >= 0; i--)
            {
                if (order[i].Stack.Relocates != null) { Move(order[i].Stack.Relocates, order[i].Path); }
                for (int k = order[i].Specs.Length - 1; k >= 0; k--) { Add(order[i].Specs[k].Spec); }
            }
            if (gone.Count > 0) { names.RemoveAll(gone.Contains); }
        }

        void Add(PrimSpec spec)
        {
            for (int i = 0; i < spec.Children.Count; i++)
            {
                string name = spec.Children[i].Name;
                if (known.Add(name)) { names.Add(name); }
            }
            if (spec.ChildOrder != null) { ListOp<string>.Reorder(names, spec.ChildOrder); }
        }

        void Move(Relocates relocates, string parent)
        {
            var renamed = new Dictionary<string, string>();
            foreach (KeyValuePair<string, string> one in relocates.Targets)
            {
                if (UsdPaths.Parent(one.Key) != parent) { continue; }
                bool stays = one.Value.Length > 0 && UsdPaths.Parent(one.Value) == parent;
                renamed.Add(UsdPaths.Name(one.Key), stays ? UsdPaths.Name(one.Value) : null);
                gone.Add(UsdPaths.Name(one.Key));
            }
            var come = new List<string>();
            foreach (KeyValuePair<string, string> one in relocates.Sources)
            {
                bool comes = UsdPaths.Parent(one.Key) == parent && UsdPaths.Parent(one.Value) != parent;
                if (comes && !known.Contains(UsdPaths.Name(one.Key))) { come.Add(UsdPaths.Name(one.Key)); }
            }
            var kept = new List<string>(names.Count);
            foreach (string name in names)
            {
                string other;
                if (!renamed.TryGetValue(name, out other))
                {
                    kept.Add(name);
                    continue;
                }
                known.Remove(name);
                // the new name may be there already
                if (other != null && known.Add(other)) { kept.Add(other); }
            }
            come.Sort(StringComparer.Ordinal);
            foreach (string name in come)
            {
                known.Add(name);
                kept.Add(name);
            }
            names = kept;
        }
    }
}
