using System;
using System.Diagnostics;
using System.IO;
using System.Threading;
using System.Threading.Tasks;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>A stage that was loaded while the program runs. Dispose destroys its objects and assets.</summary>
    public sealed class LoadedStage : IDisposable
    {
        readonly SceneBuilder builder;

        internal LoadedStage(SceneBuilder builder)
        {
            this.builder = builder;
        }

        /// <summary>The stage's root object.</summary>
        public GameObject Root
        {
            get { return builder.Root; }
        }

        /// <summary>What was left out.</summary>
        public ImportReport Report
        {
            get { return builder.Report; }
        }

        /// <summary>Destroys the objects, meshes, materials and textures.</summary>
        public void Dispose()
        {
            builder.Abandon();
        }
    }

    /// <summary>Loads stages in players: reads on another thread, makes objects a few milliseconds a frame.</summary>
    public static class StageLoader
    {
        const int MillisecondsPerFrame = 8;

        /// <summary>
        /// Loads a .usda, .usdc or .usdz, which may refer to files in its folder and below, under a parent or none.
        /// Call it on the main thread. Throws UsdFormatException for what cannot be read, InvalidOperationException
        /// without the pipeline's shader, OperationCanceledException.
        /// </summary>
        public static Task<LoadedStage> LoadAsync(string path, ImportSettings settings, Transform parent,
            IProgress<float> progress, CancellationToken cancel)
        {
            string root = Path.GetDirectoryName(Path.GetFullPath(path));
            return LoadAsync(path, root, settings, parent, progress, cancel);
        }

        /// <summary>The same for a stage of a root folder, which may refer to files anywhere in that folder.</summary>
        public static Task<LoadedStage> LoadAsync(string path, string root, ImportSettings settings, Transform parent,
            IProgress<float> progress, CancellationToken cancel)
        {
            var files = new FolderResolver(root);
            string stage = files.NameOf(path);
            LabelTable table = null;
            return MakeAsync(() =>
            {
                if (stage == null) { throw new UsdFormatException(path, "file", "is not in the root folder " + root); }
                table = StageReader.Labels(files, Path.ChangeExtension(stage, null));
                return StageReader.Read(files, stage);
            }, () => table, Path.GetFileNameWithoutExtension(path), settings, parent, progress, cancel);
        }

        /// <summary>The same for a .usdz that is in memory, such as one that was downloaded.</summary>
        public static Task<LoadedStage> LoadAsync(byte[] package, string name, ImportSettings settings,
            Transform parent, IProgress<float> progress, CancellationToken cancel)
        {
            return MakeAsync(() => StageReader.Whole(UsdStage.OpenPackage(package, name + ".usdz")), () => null, name,
                settings, parent, progress, cancel);
        }

        static async Task<LoadedStage> MakeAsync(Func<SceneModel> read, Func<LabelTable> labels, string name,
            ImportSettings settings, Transform parent, IProgress<float> progress, CancellationToken cancel)
        {
#if UNITY_WEBGL && !UNITY_EDITOR
            // the web has no threads
            SceneModel scene = read();
#else
            SceneModel scene = await Task.Run(read, cancel);
#endif
            cancel.ThrowIfCancellationRequested();
            var builder = new SceneBuilder(scene, labels(), settings, name, false);
            try
            {
                builder.Root.SetActive(false);
                var clock = Stopwatch.StartNew();
                while (builder.Step())
                {
                    if (clock.ElapsedMilliseconds < MillisecondsPerFrame) { continue; }
                    if (progress != null) { progress.Report(builder.Progress); }
                    await Task.Yield();
                    cancel.ThrowIfCancellationRequested();
                    clock.Reset();
                    clock.Start();
                }
                if (parent != null) { builder.Root.transform.SetParent(parent, false); }
                builder.Root.SetActive(true);
                if (progress != null) { progress.Report(1); }
                return new LoadedStage(builder);
            }
            catch
            {
                builder.Abandon();
                throw;
            }
        }
    }
}
