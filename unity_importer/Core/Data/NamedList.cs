using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Something that a layer says under a name.</summary>
    public abstract class NamedSpec
    {
        /// <summary>Without the path.</summary>
        public readonly string Name;

        /// <summary>With this name.</summary>
        protected NamedSpec(string name)
        {
            Name = name;
        }
    }

    /// <summary>Specs in the order of the layer, which are also found by their names.</summary>
    public struct NamedList<T> where T : NamedSpec
    {
        // up to here, looking at each is as quick as a table
        const int MostWithoutTable = 10;

        T[] items;
        Dictionary<string, T> byName;

        /// <summary>How many there are.</summary>
        public int Count { get; private set; }

        /// <summary>The item at a place in the order.</summary>
        public T this[int index]
        {
            get { return items[index]; }
        }

        /// <summary>Makes room for as many items before the first is added.</summary>
        public void Reserve(int count)
        {
            if (items == null && count > 0) { items = new T[count]; }
        }

        /// <summary>Adds an item behind the others, also where there is one of its name.</summary>
        public void Add(T item)
        {
            if (items == null) { items = new T[2]; }
            if (Count == items.Length) { Array.Resize(ref items, 2 * Count); }
            items[Count++] = item;
            if (byName != null) { byName[item.Name] = item; }
        }

        /// <summary>The item with this name, the last of several; null where there is none.</summary>
        public T Find(string name)
        {
            if (Count <= MostWithoutTable)
            {
                for (int i = Count - 1; i >= 0; i--)
                {
                    if (items[i].Name == name) { return items[i]; }
                }
                return null;
            }
            if (byName == null)
            {
                byName = new Dictionary<string, T>(2 * Count);
                for (int i = 0; i < Count; i++) { byName[items[i].Name] = items[i]; }
            }
            T found;
            return byName.TryGetValue(name, out found) ? found : null;
        }

        /// <summary>Puts another item of the same name at the place of one.</summary>
        public void Replace(T item, T other)
        {
            items[Array.IndexOf(items, item, 0, Count)] = other;
            if (byName != null) { byName[other.Name] = other; }
        }

        /// <summary>Puts the items in the order of the names, those without a name there last.</summary>
        public void Order(string[] names)
        {
            bool isOrdered = names.Length >= Count;
            for (int i = 0; i < Count && isOrdered; i++) { isOrdered = items[i].Name == names[i]; }
            if (isOrdered) { return; }
            var places = new Dictionary<string, int>(names.Length);
            foreach (string name in names) { places[name] = places.Count; }
            var keys = new long[Count];
            for (int i = 0; i < Count; i++)
            {
                int place;
                if (!places.TryGetValue(items[i].Name, out place)) { place = names.Length; }
                keys[i] = ((long)place << 32) + i;
            }
            Array.Resize(ref items, Count);
            Array.Sort(keys, items);
        }
    }
}
