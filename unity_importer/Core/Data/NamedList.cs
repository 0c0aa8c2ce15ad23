using System;

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

    /// <summary>Specs in the order of the layer, each with a name of its own by which it is found.</summary>
    public struct NamedList<T> where T : NamedSpec
    {
        // up to here, looking at each is as quick as a table
        const int MostWithoutTable = 10;

        T[] items;

        // places in items plus 1, each at the hash of its name or behind it; 0 where there is none
        int[] table;

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

        /// <summary>Adds an item behind the others; false where there is one of its name already.</summary>
        public bool Add(T item)
        {
            int slot;
            if (PlaceOf(item.Name, out slot) >= 0) { return false; }
            if (items == null) { items = new T[3]; }
            if (Count == items.Length)
            {
                Array.Resize(ref items, 2 * Count);
                table = null;
            }
            items[Count++] = item;
            if (table != null) { table[slot] = Count; }
            return true;
        }

        /// <summary>The item with this name; null where there is none.</summary>
        public T Find(string name)
        {
            int slot, place = PlaceOf(name, out slot);
            return place < 0 ? null : items[place];
        }

        /// <summary>Puts an item at the place of the one with its name.</summary>
        public void Replace(T item)
        {
            int slot;
            items[PlaceOf(item.Name, out slot)] = item;
        }

        // -1 where there is none; slot is then where the table has room for it
        int PlaceOf(string name, out int slot)
        {
            slot = 0;
            if (Count <= MostWithoutTable)
            {
                for (int i = Count - 1; i >= 0; i--)
                {
                    string other = items[i].Name;
                    if (other.Length == name.Length && other == name) { return i; }
                }
                return -1;
            }
            if (table == null) { MakeTable(); }
            int mask = table.Length - 1;
            for (slot = name.GetHashCode() & mask; table[slot] != 0; slot = (slot + 1) & mask)
            {
                if (items[table[slot] - 1].Name == name) { return table[slot] - 1; }
            }
            return -1;
        }

        void MakeTable()
        {
            int size = 16;
            while (size < 2 * items.Length) { size *= 2; }
            table = new int[size];
            for (int i = 0; i < Count; i++)
            {
                int slot = items[i].Name.GetHashCode() & (size - 1);
                while (table[slot] != 0) { slot = (slot + 1) & (size - 1); }
                table[slot] = i + 1;
            }
        }

        /// <summary>Puts the items in the order of the names, those without a name there last.</summary>
        public void Order(string[] names)
        {
            bool isOrdered = names.Length >= Count;
            for (int i = 0; i < Count && isOrdered; i++) { isOrdered = items[i].Name == names[i]; }
            if (isOrdered) { return; }
            var ordered = new T[Count];
            var isPlaced = new bool[Count];
            int next = 0;
            foreach (string name in names)
            {
                int slot, place = PlaceOf(name, out slot);
                if (place < 0 || isPlaced[place]) { continue; }
                isPlaced[place] = true;
                ordered[next++] = items[place];
            }
            for (int i = 0; i < Count; i++)
            {
                if (!isPlaced[i]) { ordered[next++] = items[i]; }
            }
            items = ordered;
            table = null;
        }
    }
}
