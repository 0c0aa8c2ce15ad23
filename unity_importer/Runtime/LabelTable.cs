using System;
using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>
    /// The ids of labelled objects by the paths of their prims, as the table says that garage2usd writes beside a
    /// stage; a point of an instancer has the path "/Garage/StallNumbers[7]".
    /// </summary>
    public sealed class LabelTable
    {
        readonly Dictionary<string, int> ids = new Dictionary<string, int>();

        LabelTable()
        {
        }

        /// <summary>Number of objects.</summary>
        public int Count
        {
            get { return ids.Count; }
        }

        /// <summary>Whether there is an object at a path, and its id.</summary>
        public bool TryFind(string path, out int id)
        {
            return ids.TryGetValue(path, out id);
        }

        /// <summary>Reads the "objects" of a JSON file: by the path of the prim above them, rows that begin with name
        /// and id. Throws FormatException.</summary>
        public static LabelTable Read(byte[] json)
        {
            var table = new LabelTable();
            var reader = new JsonReader(json);
            reader.EachKey(key =>
            {
                if (key == "objects") { reader.EachKey(above => table.Objects(reader, above)); }
                else { reader.Skip(); }
            });
            return table;
        }

        void Objects(JsonReader reader, string above)
        {
            reader.Each('[', ']', () =>
            {
                string name = null;
                int id = 0, column = 0;
                reader.Each('[', ']', () =>
                {
                    if (column == 0) { name = reader.Text(); }
                    else if (column == 1) { id = reader.Whole(); }
                    else { reader.Skip(); }
                    column++;
                });
                if (id <= 0) { throw reader.Wrong("an object needs a name and an id"); }
                ids[above + "/" + name] = id;
            });
        }

        /// <summary>Numbers all labelled objects below a root: as the table says, and on from its largest id where it
        /// says nothing or there is none.</summary>
        internal static void Apply(LabelTable table, Transform root)
        {
            var paths = new Dictionary<Transform, string> { { root, "" } };
            var rest = new List<SemanticLabels>();
            int largest = 0;
            foreach (SemanticLabels labels in root.GetComponentsInChildren<SemanticLabels>(true))
            {
                int id;
                if (table == null || !table.TryFind(PathOf(labels.transform, paths), out id))
                {
                    rest.Add(labels);
                    continue;
                }
                labels.InstanceId = id;
                largest = Math.Max(largest, id);
            }
            foreach (SemanticLabels labels in rest) { labels.InstanceId = ++largest; }
        }

        /// <summary>The path of the prim that an object comes of; those that are known hold its root.</summary>
        internal static string PathOf(Transform place, Dictionary<Transform, string> known)
        {
            string path;
            if (known.TryGetValue(place, out path)) { return path; }
            string above = PathOf(place.parent, known), name = place.name, holder = place.parent.name;
            bool isPoint = name.Length > holder.Length && name[holder.Length] == '['
                && name.StartsWith(holder, StringComparison.Ordinal);
            path = isPoint ? above + name.Substring(holder.Length) : above + "/" + name;
            known.Add(place, path);
            return path;
        }
    }
}
