using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using Garage.Usd;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Garage.Unity.Editor
{
    /// <summary>
    /// Makes prefabs of .usda, .usdc and .usdz. Where Unity's own importer is installed as well, it is one that a file
    /// can be given by its inspector: two importers that claim the same extension would both be refused.
    /// </summary>
#if GARAGE_OTHER_USD_IMPORTER
    [ScriptedImporter(Version, new string[0], new[] { "usda", "usdc", "usdz" })]
#else
    [ScriptedImporter(Version, new[] { "usda", "usdc", "usdz" })]
#endif
    public sealed class UsdImporter : ScriptedImporter
    {
        const int Version = 1;
        const int MillisecondsPerLook = 100;
        const string Packages = "Packages/";

        /// <summary>Changes with the project's render pipeline, whose shaders the materials need.</summary>
        public const string PipelineDependency = "Garage.Unity/RenderPipeline";

        [SerializeField] ImportSettings settings = new ImportSettings();

        /// <summary>How the stage becomes a prefab.</summary>
        public ImportSettings Settings
        {
            get { return settings; }
        }

        [InitializeOnLoadMethod]
        static void WatchPipeline()
        {
            // workers learn it from the editor that they work for
            if (AssetDatabase.IsAssetImportWorkerProcess()) { return; }
            AssetDatabase.RegisterCustomDependency(PipelineDependency, Hash128.Compute(LitShader.InUse().ToString()));
        }

        /// <summary>Reads the stage and adds the prefab with its assets; what cannot be read is an error of the
        /// import.</summary>
        public override void OnImportAsset(AssetImportContext ctx)
        {
            ctx.DependsOnCustomDependency(PipelineDependency);
            string root = RootOf(ctx.assetPath), stage = ctx.assetPath.Substring(root.Length);
            string name = Path.GetFileNameWithoutExtension(stage);
            string folder = Path.GetFullPath(root.Length == 0 ? "." : root.TrimEnd('/'));
            var files = new RecordingResolver(new FolderResolver(folder));
            SceneBuilder builder = null;
            try
            {
                Look(name, "Reading", 0);
                SceneModel scene = StageReader.Read(files, stage);
                LabelTable labels = StageReader.Labels(files, Path.ChangeExtension(stage, null));
                builder = new SceneBuilder(scene, labels, settings, name, true);
                var clock = Stopwatch.StartNew();
                while (builder.Step())
                {
                    if (clock.ElapsedMilliseconds < MillisecondsPerLook) { continue; }
                    Look(name, "Making objects", builder.Progress);
                    clock.Reset();
                    clock.Start();
                }
                foreach (KeyValuePair<string, UnityEngine.Object> asset in builder.Assets)
                {
                    ctx.AddObjectToAsset(asset.Key, asset.Value);
                }
                ctx.AddObjectToAsset("prefab", builder.Root);
                ctx.SetMainObject(builder.Root);
                foreach (ImportReport.Entry entry in builder.Report.entries)
                {
                    ctx.LogImportWarning(ctx.assetPath + ": " + entry, builder.Root);
                }
            }
            catch (Exception failure)
            {
                if (builder != null) { builder.Abandon(); }
                bool isExpected = failure is UsdFormatException || failure is OperationCanceledException
                    || failure is InvalidOperationException;
                if (!isExpected) { throw; }
                ctx.LogImportError(ctx.assetPath + ": " + failure.Message);
            }
            finally
            {
                EditorUtility.ClearProgressBar();
            }
            foreach (string file in files.Files)
            {
                string path = root + file;
                if (path != ctx.assetPath && IsAsset(path, ctx.assetPath)) { ctx.DependsOnSourceAsset(path); }
            }
        }

        // what stages may refer to files in: the project's folder, or their package's, which may lie anywhere
        static string RootOf(string assetPath)
        {
            if (!assetPath.StartsWith(Packages, StringComparison.Ordinal)) { return ""; }
            return assetPath.Substring(0, assetPath.IndexOf('/', Packages.Length) + 1);
        }

        // the project has folders whose files are no assets, on which an import cannot depend
        static bool IsAsset(string path, string other)
        {
            string top = other.Substring(0, other.IndexOf('/') + 1);
            return path.StartsWith(top, StringComparison.Ordinal)
                || path.StartsWith(Packages, StringComparison.Ordinal);
        }

        static void Look(string name, string what, float progress)
        {
            if (EditorUtility.DisplayCancelableProgressBar("Importing " + name, what, progress))
            {
                throw new OperationCanceledException("the import was cancelled");
            }
        }
    }
}
