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
            return path.Length == prefix.Length || path[prefix.Length] == '/' || path[prefix.Length] == '.';
        }

        /// <summary>The path of a child.</summary>
        public static string Child(string parent, string name)
        {
            return parent == "/" ? "/" + name : parent + "/" + name;
        }

        /// <summary>The prim above; null above the root.</summary>
        public static string Parent(string path)
        {
            if (path == "/") { return null; }
            int slash = path.LastIndexOf('/');
            return slash <= 0 ? "/" : path.Substring(0, slash);
        }

        /// <summary>How many prims a path of a prim names: 2 for "/A/B".</summary>
        public static int Depth(string path)
        {
            int depth = 0;
            foreach (char letter in path)
            {
                if (letter == '/') { depth++; }
            }
            return depth;
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
            return path.Substring(path.LastIndexOf('/') + 1);
        }
    }
}
