using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// What paths and times of one place mean at another: pairs of a source and a target, of which the longest one
    /// that is a prefix counts.
    /// </summary>
    sealed class PathMap : IEquatable<PathMap>
    {
        const double OffsetTolerance = 1e-6;

        /// <summary>All paths mean the same.</summary>
        public static readonly PathMap Identity = new PathMap(new List<Pair>(0), true, LayerOffset.Identity);

        // a target of null hides what is below the source
        struct Pair
        {
            public string Source, Target;
        }

        readonly List<Pair> pairs;
        readonly bool keepsOthers;

        /// <summary>Time at the source seen from the target.</summary>
        public readonly LayerOffset Offset;

        PathMap(List<Pair> pairs, bool keepsOthers, LayerOffset offset)
        {
            this.pairs = pairs;
            this.keepsOthers = keepsOthers;
            Offset = offset;
        }

        /// <summary>Of one pair of prims, and whether all other paths mean the same.</summary>
        public static PathMap Of(string source, string target, bool keepsOthers, LayerOffset offset)
        {
            return Of(new Dictionary<string, string> { { source, target } }, keepsOthers, offset);
        }

        /// <summary>Of pairs of prims, and whether all other paths mean the same.</summary>
        public static PathMap Of(IDictionary<string, string> targets, bool keepsOthers, LayerOffset offset)
        {
            var pairs = new List<Pair>(targets.Count);
            foreach (KeyValuePair<string, string> one in targets)
            {
                if (one.Key == "/" && one.Value == "/") { keepsOthers = true; }
                else { pairs.Add(new Pair { Source = one.Key, Target = one.Value }); }
            }
            return Canonical(pairs, keepsOthers, offset);
        }

        // in one order and without pairs that say what others say already, so that equal maps look the same
        static PathMap Canonical(List<Pair> pairs, bool keepsOthers, LayerOffset offset)
        {
            if (pairs.Count > 1)
            {
                pairs.Sort(delegate(Pair one, Pair other)
                {
                    int order = UsdPaths.Depth(one.Source).CompareTo(UsdPaths.Depth(other.Source));
                    return order != 0 ? order : string.CompareOrdinal(one.Source, other.Source);
                });
            }
            for (int i = 0; i < pairs.Count;)
            {
                bool mayBeSaid = pairs.Count > 1 || keepsOthers || pairs[i].Target == null;
                if (!mayBeSaid) { break; }
                Pair pair = pairs[i];
                pairs.RemoveAt(i);
                if (new PathMap(pairs, keepsOthers, offset).ToTarget(pair.Source) == pair.Target) { continue; }
                pairs.Insert(i++, pair);
            }
            return new PathMap(pairs, keepsOthers, offset);
        }

        /// <summary>A path of the source as the target means it; null where it means nothing there.</summary>
        public string ToTarget(string path)
        {
            return Mapped(path, false);
        }

        /// <summary>A path of the target as the source means it; null where it means nothing there.</summary>
        public string ToSource(string path)
        {
            return Mapped(path, true);
        }

        string Mapped(string path, bool isInverse)
        {
            int best = Best(path, isInverse, -1);
            string mapped = best < 0 ? (keepsOthers ? path : null)
                : Moved(path, From(best, isInverse), From(best, !isInverse));
            if (mapped == null) { return null; }
            // a path must mean itself on the way back
            int back = Best(mapped, !isInverse, best);
            int least = best < 0 ? -1 : UsdPaths.Depth(From(best, !isInverse));
            return back >= 0 && UsdPaths.Depth(From(back, !isInverse)) >= least ? null : mapped;
        }

        static string Moved(string path, string prefix, string to)
        {
            return to == null ? null : UsdPaths.Moved(path, prefix, to);
        }

        string From(int pair, bool isTarget)
        {
            return isTarget ? pairs[pair].Target : pairs[pair].Source;
        }

        int Best(string path, bool isInverse, int except)
        {
            int best = -1, longest = -1;
            for (int i = 0; i < pairs.Count; i++)
            {
                string prefix = From(i, isInverse);
                if (i == except || prefix == null || prefix.Length <= longest || !UsdPaths.HasPrefix(path, prefix))
                {
                    continue;
                }
                best = i;
                longest = prefix.Length;
            }
            return best;
        }

        /// <summary>This after the inner one.</summary>
        public PathMap After(PathMap inner)
        {
            if (ReferenceEquals(this, Identity)) { return inner; }
            if (ReferenceEquals(inner, Identity)) { return this; }
            var composed = new List<Pair>(pairs.Count + inner.pairs.Count);
            foreach (Pair pair in inner.pairs)
            {
                composed.Add(new Pair
                {
                    Source = pair.Source, Target = pair.Target == null ? null : ToTarget(pair.Target),
                });
            }
            int innerCount = composed.Count;
            foreach (Pair pair in pairs)
            {
                string source = inner.ToSource(pair.Source);
                bool isKnown = source == null;
                for (int i = 0; i < innerCount && !isKnown; i++) { isKnown = composed[i].Source == source; }
                if (!isKnown) { composed.Add(new Pair { Source = source, Target = pair.Target }); }
            }
            return Canonical(composed, keepsOthers && inner.keepsOthers, Offset.After(inner.Offset));
        }

        /// <summary>From the target to the source.</summary>
        public PathMap Inverse()
        {
            var inverse = new List<Pair>(pairs.Count);
            foreach (Pair pair in pairs)
            {
                if (pair.Target != null) { inverse.Add(new Pair { Source = pair.Target, Target = pair.Source }); }
            }
            return Canonical(inverse, keepsOthers, Offset.Inverse());
        }

        /// <summary>The same, but that all other paths mean themselves.</summary>
        public PathMap KeepingOthers()
        {
            return keepsOthers ? this : Canonical(new List<Pair>(pairs), true, Offset);
        }

        public bool Equals(PathMap other)
        {
            if (ReferenceEquals(this, other)) { return true; }
            bool same = keepsOthers == other.keepsOthers && pairs.Count == other.pairs.Count
                && Math.Abs(Offset.Offset - other.Offset.Offset) < OffsetTolerance
                && Math.Abs(Offset.Scale - other.Offset.Scale) < OffsetTolerance;
            for (int i = 0; same && i < pairs.Count; i++)
            {
                same = pairs[i].Source == other.pairs[i].Source && pairs[i].Target == other.pairs[i].Target;
            }
            return same;
        }

        public override bool Equals(object other)
        {
            var map = other as PathMap;
            return map != null && Equals(map);
        }

        public override int GetHashCode()
        {
            return pairs.Count == 0 ? 0 : pairs[0].Source.GetHashCode();
        }
    }
}
