using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
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
        readonly byte[] json;
        int at;

        LabelTable(byte[] json)
        {
            this.json = json;
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
            var table = new LabelTable(json);
            table.Each('{', '}', () =>
            {
                bool isObjects = table.Key() == "objects";
                if (isObjects) { table.Each('{', '}', table.Objects); }
                else { table.Skip(0); }
            });
            return table;
        }

        void Objects()
        {
            string above = Key();
            Each('[', ']', () =>
            {
                string name = null;
                int id = 0, column = 0;
                Each('[', ']', () =>
                {
                    if (column == 0) { name = Text(); }
                    else if (column == 1) { id = Number(); }
                    else { Skip(0); }
                    column++;
                });
                if (id <= 0) { throw Wrong("an object needs a name and an id"); }
                ids[above + "/" + name] = id;
            });
        }

        FormatException Wrong(string what)
        {
            return new FormatException("byte " + at + ": " + what);
        }

        byte Next()
        {
            while (at < json.Length && json[at] <= ' ') { at++; }
            if (at >= json.Length) { throw Wrong("the text ends too early"); }
            return json[at];
        }

        void Expect(char letter)
        {
            if (Next() != letter) { throw Wrong("'" + letter + "' is missing"); }
            at++;
        }

        void Each(char open, char close, Action one)
        {
            Expect(open);
            if (Next() == close)
            {
                at++;
                return;
            }
            for (;;)
            {
                one();
                if (Next() == close)
                {
                    at++;
                    return;
                }
                Expect(',');
            }
        }

        string Key()
        {
            string key = Text();
            Expect(':');
            return key;
        }

        string Text()
        {
            Expect('"');
            int start = at;
            bool isPlain = true;
            while (at < json.Length && json[at] != '"')
            {
                isPlain &= json[at] != '\\';
                at += json[at] == '\\' ? 2 : 1;
            }
            if (at >= json.Length) { throw Wrong("a string does not end"); }
            string text = Encoding.UTF8.GetString(json, start, at - start);
            at++;
            return isPlain ? text : Unescaped(text);
        }

        string Unescaped(string text)
        {
            var plain = new StringBuilder();
            for (int i = 0; i < text.Length; i++)
            {
                if (text[i] != '\\')
                {
                    plain.Append(text[i]);
                    continue;
                }
                char letter = text[++i];
                int code;
                int known = "nrtbf".IndexOf(letter);
                if (letter != 'u')
                {
                    plain.Append(known < 0 ? letter : "\n\r\t\b\f"[known]);
                    continue;
                }
                string digits = text.Substring(Math.Min(i + 1, text.Length - 1), Math.Min(4, text.Length - i - 1));
                if (!int.TryParse(digits, NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out code))
                {
                    throw Wrong("a letter is told wrongly");
                }
                plain.Append((char)code);
                i += digits.Length;
            }
            return plain.ToString();
        }

        int Number()
        {
            Next();
            long number = 0;
            int start = at;
            for (; at < json.Length && json[at] >= '0' && json[at] <= '9' && number <= int.MaxValue; at++)
            {
                number = 10 * number + json[at] - '0';
            }
            if (at == start || number > int.MaxValue) { throw Wrong("an id is no whole number"); }
            return (int)number;
        }

        void Skip(int depth)
        {
            byte letter = Next();
            if (depth > 100) { throw Wrong("values are nested too deep"); }
            if (letter == '"') { Text(); }
            else if (letter == '[') { Each('[', ']', () => Skip(depth + 1)); }
            else if (letter == '{')
            {
                Each('{', '}', () =>
                {
                    Key();
                    Skip(depth + 1);
                });
            }
            else
            {
                while (at < json.Length && json[at] != ',' && json[at] != ']' && json[at] != '}') { at++; }
            }
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

        static string PathOf(Transform place, Dictionary<Transform, string> known)
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
