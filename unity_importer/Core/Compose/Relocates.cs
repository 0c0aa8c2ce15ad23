using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Which prims the layers of a stack move, and where to.</summary>
    sealed class Relocates
    {
        /// <summary>The new path by the old one, as authored; empty for a prim that is taken away.</summary>
        public readonly SortedDictionary<string, string> Targets
            = new SortedDictionary<string, string>(System.StringComparer.Ordinal);

        /// <summary>The old path by the new one, as authored.</summary>
        public readonly Dictionary<string, string> Sources = new Dictionary<string, string>();

        // by the path that a prim has before all moves of those above it
        readonly Dictionary<string, string> targetsOfOrigins = new Dictionary<string, string>();
        readonly Dictionary<string, PathMap> maps = new Dictionary<string, PathMap>();

        Relocates()
        {
        }

        /// <summary>Of layers, strongest first; null where they move nothing. Names what cannot be moved.</summary>
        public static Relocates Of(IList<Layer> layers, System.Action<string> warn)
        {
            Relocates relocates = null;
            foreach (Layer layer in layers)
            {
                foreach (KeyValuePair<string, string> one in layer.Relocates)
                {
                    relocates = relocates ?? new Relocates();
                    if (!IsPossible(one.Key, one.Value))
                    {
                        warn(layer.Identifier + ": <" + one.Key + "> cannot be relocated to <" + one.Value + ">");
                    }
                    else if (!relocates.Targets.ContainsKey(one.Key)) { relocates.Targets.Add(one.Key, one.Value); }
                }
            }
            if (relocates == null) { return null; }
            relocates.RemoveConflicts(layers[0].Identifier, warn);
            if (relocates.Targets.Count == 0) { return null; }
            foreach (KeyValuePair<string, string> one in relocates.Targets)
            {
                if (one.Value.Length > 0) { relocates.Sources.Add(one.Value, one.Key); }
            }
            foreach (KeyValuePair<string, string> one in relocates.Targets)
            {
                relocates.targetsOfOrigins[relocates.Origin(one.Key, 0)] = one.Value;
            }
            return relocates;
        }

        static bool IsPossible(string source, string target)
        {
            if (UsdPaths.Depth(source) < 2 || UsdPaths.HasVariant(source)) { return false; }
            return target.Length == 0 || (target != "/" && !UsdPaths.HasVariant(target)
                && !UsdPaths.HasPrefix(target, source) && !UsdPaths.HasPrefix(source, target));
        }

        // a path is said once, and as it is after all other moves
        void RemoveConflicts(string identifier, System.Action<string> warn)
        {
            var wrong = new HashSet<string>();
            var byTarget = new Dictionary<string, string>();
            foreach (KeyValuePair<string, string> one in Targets)
            {
                string other;
                if (one.Value.Length > 0 && byTarget.TryGetValue(one.Value, out other))
                {
                    wrong.Add(one.Key);
                    wrong.Add(other);
                }
                else if (one.Value.Length > 0) { byTarget.Add(one.Value, one.Key); }
                if (one.Value.Length > 0 && Targets.ContainsKey(one.Value))
                {
                    wrong.Add(one.Key);
                    wrong.Add(one.Value);
                }
                if (one.Value.Length > 0 && HasMovedAncestor(one.Value, 0)) { wrong.Add(one.Key); }
                if (HasMovedAncestor(one.Key, 1)) { wrong.Add(one.Key); }
            }
            foreach (string source in wrong)
            {
                warn(identifier + ": the relocation of <" + source + "> to <" + Targets[source]
                    + "> contradicts another one");
            }
            foreach (string source in wrong) { Targets.Remove(source); }
        }

        /// <summary>Whether a path is that of a prim that is moved elsewhere, or below one.</summary>
        public bool Moves(string path)
        {
            for (path = UsdPaths.Prim(path); path != "/"; path = UsdPaths.Parent(path))
            {
                string target;
                if (Targets.TryGetValue(path, out target)) { return target.Length > 0; }
            }
            return false;
        }

        bool HasMovedAncestor(string path, int highest)
        {
            for (path = UsdPaths.Parent(path); UsdPaths.Depth(path) > highest; path = UsdPaths.Parent(path))
            {
                if (Targets.ContainsKey(path)) { return true; }
            }
            return false;
        }

        string Origin(string source, int depth)
        {
            for (string above = source; depth <= Sources.Count && above != "/"; above = UsdPaths.Parent(above))
            {
                string from;
                if (Sources.TryGetValue(above, out from))
                {
                    return UsdPaths.Moved(source, above, Origin(from, depth + 1));
                }
            }
            return source;
        }

        /// <summary>What paths mean after the moves below a path.</summary>
        public PathMap At(string path)
        {
            PathMap map;
            if (maps.TryGetValue(path, out map)) { return map; }
            var moved = new Dictionary<string, string>();
            var seen = new HashSet<string>();
            foreach (IEnumerable<KeyValuePair<string, string>> all in new IEnumerable<KeyValuePair<string, string>>[]
            {
                targetsOfOrigins, Targets,
            })
            {
                foreach (KeyValuePair<string, string> one in all)
                {
                    if (one.Value.Length > 0 && UsdPaths.HasPrefix(one.Key, path) && one.Key != path
                        && !moved.ContainsKey(one.Key)
                        && seen.Add(one.Value))
                    {
                        moved.Add(one.Key, one.Value);
                    }
                }
            }
            map = moved.Count == 0 ? PathMap.Identity : PathMap.Of(moved, true, LayerOffset.Identity);
            maps.Add(path, map);
            return map;
        }
    }
}
