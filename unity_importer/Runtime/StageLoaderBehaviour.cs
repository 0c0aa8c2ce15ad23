using System;
using System.IO;
using System.Threading;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Loads a stage below its object when the scene starts.</summary>
    [AddComponentMenu("Garage/Stage Loader")]
    public sealed class StageLoaderBehaviour : MonoBehaviour
    {
        [Tooltip("A file, seen from the StreamingAssets folder unless it is absolute.")]
        [SerializeField] string path = "garage.usdz";

        [Tooltip("The folder in which the stage may refer to files, seen from the StreamingAssets folder; that of the "
            + "stage where this is empty.")]
        [SerializeField] string root = "";

        [SerializeField] ImportSettings settings = new ImportSettings();

        readonly CancellationTokenSource cancel = new CancellationTokenSource();
        LoadedStage loaded;

        /// <summary>The stage once it is there; null before and after a failure.</summary>
        public LoadedStage Loaded
        {
            get { return loaded; }
        }

        /// <summary>Raised when the stage is there.</summary>
        public event Action<LoadedStage> Finished;

        async void Start()
        {
            try
            {
                string full = Path.Combine(Application.streamingAssetsPath, path);
                string folder = string.IsNullOrEmpty(root) ? Path.GetDirectoryName(full)
                    : Path.Combine(Application.streamingAssetsPath, root);
                loaded = await StageLoader.LoadAsync(full, folder, settings, transform, null, cancel.Token);
                if (Finished != null) { Finished(loaded); }
            }
            catch (OperationCanceledException)
            {
            }
            catch (Exception failure)
            {
                Debug.LogException(failure, this);
            }
        }

        void OnDestroy()
        {
            cancel.Cancel();
            if (loaded != null) { loaded.Dispose(); }
        }
    }
}
