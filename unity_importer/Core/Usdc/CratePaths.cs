using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The paths of a crate, by their numbers.</summary>
    sealed class CratePaths
    {
        const int Deepest = 500;

        // parents of the root, and of a number that has no path
        const int NoParent = -1, NoPath = -2;

        readonly CrateBytes bytes;
        readonly string file;
        readonly string[] tokens;
        readonly int[] parents, elements;
        readonly bool[] areProperties;
        readonly string[] texts;
        int[] order;

        /// <summary>Reads the section at a place. Throws UsdFormatException.</summary>
        public CratePaths(CrateBytes bytes, string file, long place, string[] tokens)
        {
            this.bytes = bytes;
            this.file = file;
            this.tokens = tokens;
            int count = CountAt(place, 1024L * bytes.Length), encoded = CountAt(place + 8, count);
            place += 16;
            int[] numbers = bytes.PackedInts(ref place, encoded);
            int[] names = bytes.PackedInts(ref place, encoded);
            int[] jumps = bytes.PackedInts(ref place, encoded);
            bytes.Charge(place, 40L * count);
            parents = new int[count];
            elements = new int[count];
            areProperties = new bool[count];
            texts = new string[count];
            for (int i = 0; i < count; i++) { parents[i] = NoPath; }
            ReadTree(numbers, names, jumps);
        }

        /// <summary>Numbers that there may be paths of.</summary>
        public int Count
        {
            get { return parents.Length; }
        }

        /// <summary>The numbers of all paths, each behind that of its parent.</summary>
        public int[] Order
        {
            get { return order; }
        }

        /// <summary>Number of the path above; negative where there is none.</summary>
        public int ParentOf(int path)
        {
            return parents[path];
        }

        /// <summary>Whether the path is that of a property.</summary>
        public bool IsProperty(int path)
        {
            return areProperties[path];
        }

        /// <summary>The last element: a name, or a variant as "{set=name}".</summary>
        public string Element(int path)
        {
            return tokens[elements[path]];
        }

        /// <summary>
        /// The path without variant selections; "" for the number of no path. Throws UsdFormatException.
        /// </summary>
        public string Text(int path)
        {
            if (path == -1) { return ""; }
            if ((uint)path >= (uint)texts.Length) { throw Error("there is no path " + path); }
            if (texts[path] != null) { return texts[path]; }
            if (parents[path] == NoPath) { return ""; }
            if (parents[path] == NoParent) { return "/"; }
            string above = Text(parents[path]), element = Element(path);
            bool isVariant = element.Length > 0 && element[0] == '{';
            string text = areProperties[path] ? above + "." + element : isVariant ? above
                : UsdPaths.Child(above, element);
            bytes.Charge(0, 2L * text.Length + 32);
            texts[path] = text;
            return text;
        }

        UsdFormatException Error(string reason)
        {
            return new UsdFormatException(file, "PATHS", reason);
        }

        int CountAt(long place, long most)
        {
            long count = bytes.Long(place);
            if (count < 0 || count > most) { throw Error("a count of " + count + " is more than the file holds"); }
            return (int)count;
        }

        void ReadTree(int[] numbers, int[] names, int[] jumps)
        {
            order = new int[numbers.Length];
            var depths = new int[parents.Length];
            // entries whose siblings wait until all below them is read, with the parent of these
            var waiting = new Stack<KeyValuePair<int, int>>();
            int at = 0, parent = NoParent, read = 0;
            while (numbers.Length > 0)
            {
                if ((uint)at >= (uint)numbers.Length) { throw Error("a jump leads out of the table"); }
                int path = numbers[at];
                if ((uint)path >= (uint)parents.Length || parents[path] != NoPath)
                {
                    throw Error("a path is missing or twice in the table");
                }
                // the number of a property's name is negative
                areProperties[path] = names[at] < 0;
                elements[path] = areProperties[path] ? -names[at] : names[at];
                if (parent >= 0 && (uint)elements[path] >= (uint)tokens.Length)
                {
                    throw Error("there is no token " + names[at]);
                }
                parents[path] = parent;
                depths[path] = parent < 0 ? 0 : depths[parent] + 1;
                if (depths[path] > Deepest) { throw Error("paths are nested more than " + Deepest + " deep"); }
                order[read++] = path;
                int jump = jumps[at];
                bool hasChild = jump > 0 || jump == -1, hasSibling = jump >= 0;
                if (parent < 0 && hasSibling && jump != 0) { throw Error("the root has a sibling"); }
                if (hasChild)
                {
                    if (hasSibling) { waiting.Push(new KeyValuePair<int, int>(at + jump, parent)); }
                    parent = path;
                    at++;
                }
                else if (hasSibling && parent >= 0)
                {
                    at++;
                }
                else if (waiting.Count > 0)
                {
                    KeyValuePair<int, int> next = waiting.Pop();
                    at = next.Key;
                    parent = next.Value;
                }
                else
                {
                    break;
                }
            }
            Array.Resize(ref order, read);
        }
    }
}
