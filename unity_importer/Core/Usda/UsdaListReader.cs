using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Reads lists of a text layer: of paths, names and references, and edits of them.</summary>
    class UsdaListReader : UsdaValueReader
    {
        const int DeepestPrim = 400;

        // of the prims around the place that is read
        readonly string[] names = new string[DeepestPrim];
        int depth;
        string primPath;

        /// <summary>How many paths were read whose meaning depends on the prim that they are in.</summary>
        protected int RelativePaths { get; private set; }

        protected UsdaListReader(byte[] bytes, string identifier) : base(bytes, identifier)
        {
        }

        /// <summary>From here on, paths are relative to a child.</summary>
        protected void Enter(string name)
        {
            if (depth >= DeepestPrim) { throw Error("prims are nested more than " + DeepestPrim + " deep"); }
            names[depth++] = name;
            primPath = null;
        }

        /// <summary>From here on, paths are relative to the parent.</summary>
        protected void Leave()
        {
            depth--;
            primPath = null;
        }

        protected LayerOffset ReadOffset()
        {
            double offset = 0, scale = 1;
            for (;;)
            {
                SkipSeparators();
                Take(',');
                if (Take(')')) { return new LayerOffset(offset, scale); }
                string key = Name();
                Expect('=');
                if (key == "offset") { offset = Number(); }
                else if (key == "scale") { scale = Number(); }
                else { ReadAnything(0); }
            }
        }

        protected List<ReferenceArc> ArcList()
        {
            var arcs = new List<ReferenceArc>();
            if (TakeNone()) { return arcs; }
            bool many = Take('[');
            while (!(many && Take(']')))
            {
                bool hasAsset = Next() == '@';
                string asset = hasAsset ? AssetPath() : "";
                int stop = at;
                string path = "";
                bool hasPath = Next() == '<';
                if (hasPath)
                {
                    path = Absolute(PathText(), true);
                    stop = at;
                }
                if (!hasAsset && !hasPath) { throw Unexpected("an asset or a path"); }
                bool hasOffset = Take('(');
                arcs.Add(new ReferenceArc(asset, path, hasOffset ? ReadOffset() : LayerOffset.Identity));
                if (!many)
                {
                    // a line ends where its last word does
                    at = hasOffset ? at : stop;
                    break;
                }
                if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
            return arcs;
        }

        protected List<string> PathList()
        {
            var paths = new List<string>();
            if (TakeNone()) { return paths; }
            if (!Take('['))
            {
                paths.Add(Absolute(PathText(), false));
                return paths;
            }
            while (!Take(']'))
            {
                paths.Add(Absolute(PathText(), false));
                if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
            return paths;
        }

        protected List<string> NameList()
        {
            var list = new List<string>();
            if (TakeNone()) { return list; }
            if (!Take('['))
            {
                list.Add(QuotedString());
                return list;
            }
            while (!Take(']'))
            {
                list.Add(QuotedString());
                if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
            return list;
        }

        protected static ListOp<T> Edited<T>(ListOp<T> op, string edit, List<T> items)
        {
            // a whole list and edits of one replace each other; what is there may be shared
            op = op == null || edit == null || op.IsExplicit ? new ListOp<T>() : op.Copy();
            switch (edit)
            {
                case "prepend": op.Prepended = items; break;
                case "append": op.Appended = items; break;
                case "delete": op.Deleted = items; break;
                case "add": op.Added = items; break;
                case "reorder": op.Ordered = items; break;
                default:
                    op.IsExplicit = true;
                    op.Explicit = items;
                    break;
            }
            return op;
        }

        /// <summary>A path as seen from the prim that is read; an empty one may stay so.</summary>
        protected string Absolute(string path, bool mayBeEmpty)
        {
            if (path.Length == 0)
            {
                if (mayBeEmpty) { return path; }
                throw Error("a path is empty");
            }
            if (path[0] == '/' && path.IndexOf("..", StringComparison.Ordinal) < 0) { return path; }
            RelativePaths++;
            primPath = primPath ?? "/" + string.Join("/", names, 0, depth);
            string absolute = UsdPaths.Absolute(primPath, path);
            if (absolute == null) { throw Error("the path <" + path + "> leads out of the layer"); }
            return absolute;
        }
    }
}
