using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>An edit of a list, or a whole list (Explicit).</summary>
    public sealed class ListOp<T>
    {
        /// <summary>Whether Explicit takes the place of whatever weaker opinions say.</summary>
        public bool IsExplicit;

        /// <summary>Null where this says nothing of the kind.</summary>
        public List<T> Explicit, Added, Prepended, Appended, Deleted, Ordered;

        /// <summary>A whole list.</summary>
        public static ListOp<T> Whole(List<T> items)
        {
            return new ListOp<T> { IsExplicit = true, Explicit = items };
        }

        /// <summary>The same, to be changed.</summary>
        public ListOp<T> Copy()
        {
            return (ListOp<T>)MemberwiseClone();
        }

        /// <summary>The edit of other items; those that become null are left out.</summary>
        public ListOp<U> Converted<U>(Func<T, U> convert) where U : class
        {
            return new ListOp<U>
            {
                IsExplicit = IsExplicit, Explicit = Converted(Explicit, convert), Added = Converted(Added, convert),
                Prepended = Converted(Prepended, convert), Appended = Converted(Appended, convert),
                Deleted = Converted(Deleted, convert), Ordered = Converted(Ordered, convert),
            };
        }

        static List<U> Converted<U>(List<T> items, Func<T, U> convert) where U : class
        {
            if (items == null) { return null; }
            var converted = new List<U>(items.Count);
            foreach (T item in items)
            {
                U one = convert(item);
                if (one != null) { converted.Add(one); }
            }
            return converted;
        }

        /// <summary>Applies the edit to what weaker opinions made of the list.</summary>
        public void ApplyTo(List<T> list)
        {
            if (IsExplicit)
            {
                list.Clear();
                var seen = new HashSet<T>();
                foreach (T item in Explicit)
                {
                    if (seen.Add(item)) { list.Add(item); }
                }
                return;
            }
            Remove(list, Deleted);
            if (Added != null && Added.Count > 0)
            {
                var present = new HashSet<T>(list);
                foreach (T item in Added)
                {
                    if (present.Add(item)) { list.Add(item); }
                }
            }
            if (Prepended != null && Prepended.Count > 0)
            {
                Remove(list, Prepended);
                list.InsertRange(0, Unique(Prepended));
            }
            if (Appended != null && Appended.Count > 0)
            {
                Remove(list, Appended);
                list.AddRange(Unique(Appended));
            }
            if (Ordered != null && Ordered.Count > 0) { Reorder(list, Ordered); }
        }

        /// <summary>
        /// Puts the named items in the named order; each takes along the unnamed ones that follow it.
        /// </summary>
        public static void Reorder(List<T> list, List<T> order)
        {
            var named = new Dictionary<T, int>();
            foreach (T item in order)
            {
                if (!named.ContainsKey(item)) { named.Add(item, named.Count); }
            }
            var runs = new List<T>[named.Count];
            var reordered = new List<T>(list.Count);
            List<T> run = reordered;
            foreach (T item in list)
            {
                int place;
                if (named.TryGetValue(item, out place))
                {
                    run = new List<T>();
                    runs[place] = run;
                }
                run.Add(item);
            }
            foreach (List<T> moved in runs)
            {
                if (moved != null) { reordered.AddRange(moved); }
            }
            list.Clear();
            list.AddRange(reordered);
        }

        static void Remove(List<T> list, List<T> items)
        {
            if (items == null || items.Count == 0 || list.Count == 0) { return; }
            var gone = new HashSet<T>(items);
            list.RemoveAll(gone.Contains);
        }

        static List<T> Unique(List<T> items)
        {
            var seen = new HashSet<T>();
            var unique = new List<T>(items.Count);
            foreach (T item in items)
            {
                if (seen.Add(item)) { unique.Add(item); }
            }
            return unique;
        }
    }
}
