using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Paths of prims and properties as text: "/A/B", "/A/B.name".</summary>
    public static class UsdPaths
    {
        /// <summary>
        /// The path as seen from a prim, absolute and without "..", or null where it leads above the root.
        /// </summary>
        public static string Absolute(string prim, string path)
        {
            var parts = new List<string>();
            string property = "";
            if (path[0] != '/') { AddParts(parts, prim); }
            if (path[0] == '.' && path.Length > 1 && path[1] != '.' && path[1] != '/')
            {
                return (prim == "/" ? "" : prim) + path;
            }
            int dot = path.LastIndexOf('.');
            if (dot > 0 && dot > path.LastIndexOf('/') && dot + 1 < path.Length && path[dot - 1] != '.')
            {
                property = path.Substring(dot);
                path = path.Substring(0, dot);
            }
            return AddParts(parts, path) ? "/" + string.Join("/", parts.ToArray()) + property : null;
        }

        static bool AddParts(List<string> parts, string path)
        {
            foreach (string part in path.Split('/'))
            {
                if (part.Length == 0 || part == ".") { continue; }
                if (part != "..")
                {
                    parts.Add(part);
                    continue;
                }
                if (parts.Count == 0) { return false; }
                parts.RemoveAt(parts.Count - 1);
            }
            return true;
        }

        /// <summary>Whether a path is the prefix itself or below it.</summary>
        public static bool HasPrefix(string path, string prefix)
        {
            if (prefix == "/") { return true; }
            if (!path.StartsWith(prefix, System.StringComparison.Ordinal)) { return false; }
            if (path.Length == prefix.Length || prefix[prefix.Length - 1] == '}') { return true; }
            char next = path[prefix.Length];
            return next == '/' || next == '.' || next == '{';
        }

        /// <summary>A path below a prefix as the path below another one.</summary>
        public static string Moved(string path, string prefix, string to)
        {
            if (prefix == to) { return path; }
            string rest = prefix == "/" ? (path == "/" ? "" : path) : path.Substring(prefix.Length);
            if (rest.Length == 0) { return to; }
            bool isBare = rest[0] != '/' && rest[0] != '.' && rest[0] != '{';
            if (to == "/") { return isBare ? "/" + rest : rest; }
            bool intoVariant = to[to.Length - 1] == '}';
            return isBare ? to + (intoVariant ? "" : "/") + rest
                : to + (intoVariant && rest[0] == '/' ? rest.Substring(1) : rest);
        }

        /// <summary>The path of a child.</summary>
        public static string Child(string parent, string name)
        {
            return parent == "/" || parent[parent.Length - 1] == '}' ? parent + name : parent + "/" + name;
        }

        /// <summary>The prim above, or the prim with a variant; null above the root.</summary>
        public static string Parent(string path)
        {
            if (path == "/") { return null; }
            if (path[path.Length - 1] == '}') { return path.Substring(0, path.LastIndexOf('{')); }
            int end = path.LastIndexOfAny(Ends);
            return end <= 0 ? "/" : path.Substring(0, path[end] == '}' ? end + 1 : end);
        }

        static readonly char[] Ends = { '/', '}' };

        /// <summary>How many prims a path of a prim names: 2 for "/A/B" and for "/A{set=variant}B".</summary>
        public static int Depth(string path)
        {
            if (path == "/") { return 0; }
            int depth = 0;
            for (int i = 0; i < path.Length; i++)
            {
                bool isAfterVariant = path[i] == '}' && i + 1 < path.Length && path[i + 1] != '{';
                if (path[i] == '/' || isAfterVariant) { depth++; }
            }
            return depth;
        }

        /// <summary>How many prims and variants a path of a prim names: 3 for "/A{set=variant}B".</summary>
        public static int Elements(string path)
        {
            int elements = Depth(path);
            foreach (char letter in path)
            {
                if (letter == '{') { elements++; }
            }
            return elements;
        }

        /// <summary>Whether a path leads through a variant.</summary>
        public static bool HasVariant(string path)
        {
            return path.IndexOf('{') >= 0;
        }

        /// <summary>Whether a path ends in a variant.</summary>
        public static bool IsVariant(string path)
        {
            return path[path.Length - 1] == '}';
        }

        /// <summary>The path of a variant of a set.</summary>
        public static string Variant(string prim, string set, string variant)
        {
            return prim + "{" + set + "=" + variant + "}";
        }

        /// <summary>The path in the namespace of the stage, which has no variants.</summary>
        public static string WithoutVariants(string path)
        {
            int open;
            while ((open = path.IndexOf('{')) >= 0)
            {
                int close = path.IndexOf('}', open);
                string rest = path.Substring(close + 1);
                bool isBare = rest.Length > 0 && rest[0] != '/' && rest[0] != '.' && rest[0] != '{';
                path = path.Substring(0, open) + (isBare ? "/" : "") + rest;
            }
            return path;
        }

        /// <summary>The path without its property.</summary>
        public static string Prim(string path)
        {
            int dot = path.IndexOf('.', path.LastIndexOf('/') + 1);
            return dot < 0 ? path : path.Substring(0, dot);
        }

        /// <summary>The last element of a path.</summary>
        public static string Name(string path)
        {
            return path.Substring(path.LastIndexOfAny(Ends) + 1);
        }
    }
}
