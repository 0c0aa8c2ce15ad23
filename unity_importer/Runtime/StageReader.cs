using System;
using System.Collections.Generic;
using Garage.Usd;

namespace Garage.Unity
{
    /// <summary>Reads stages without touching an object of Unity's, so that any thread may do it.</summary>
    static class StageReader
    {
        /// <summary>The scene of a file of the resolver's folder, with all that it holds read. Throws
        /// UsdFormatException.</summary>
        public static SceneModel Read(IAssetResolver files, string name)
        {
            string reason;
            string identifier = files.Resolve("", name, out reason);
            if (identifier == null) { throw new UsdFormatException(name, "file", reason); }
            return Whole(UsdStage.Open(files.Read(identifier), identifier, files));
        }

        /// <summary>The table that stands beside a stage as "NAME_labels.json"; null where there is none. Throws
        /// UsdFormatException.</summary>
        public static LabelTable Labels(IAssetResolver files, string name)
        {
            string file = name + "_labels.json", reason, identifier = files.Resolve("", file, out reason);
            if (identifier == null) { return null; }
            try
            {
                return LabelTable.Read(files.Read(identifier));
            }
            catch (FormatException failure)
            {
                throw new UsdFormatException(file, "labels", failure.Message);
            }
        }

        /// <summary>The scene of a stage, with all that it holds read. Throws UsdFormatException.</summary>
        public static SceneModel Whole(UsdStage stage)
        {
            var scene = new SceneModel(stage);
            var seen = new HashSet<UsdPrim>();
            var rest = new Stack<SceneNode>(scene.Roots);
            while (rest.Count > 0)
            {
                SceneNode node = rest.Pop();
                if (node.Prim.Prototype != null && !seen.Add(node.Prim.Prototype)) { continue; }
                foreach (SceneNode child in scene.ChildrenOf(node)) { rest.Push(child); }
            }
            return scene;
        }
    }
}
