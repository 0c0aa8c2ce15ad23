using System;
using System.IO;
using System.Threading;
using UnityEngine;

namespace Garage.Unity.Samples
{
    /// <summary>
    /// Opens a garage below its object when the scene starts, and lets a car drive through it that looks like one of
    /// those parked there.
    /// </summary>
    [AddComponentMenu("Garage/Samples/Garage Scene")]
    public sealed class GarageScene : MonoBehaviour
    {
        [Tooltip("An imported garage. Without one the editor opens the asset with the GUID, and a build the file.")]
        [SerializeField] GameObject prefab;

        [Tooltip("GUID of an imported garage, as its .meta file has it.")]
        [SerializeField] string assetGuid = "";

        [Tooltip("A stage in the StreamingAssets folder, for builds.")]
        [SerializeField] string file = "";

        [Tooltip("The car: it gets the body of a parked one, and drives.")]
        [SerializeField] DriveAlongLanes car;

        readonly CancellationTokenSource cancel = new CancellationTokenSource();
        LoadedStage loaded;

        /// <summary>The garage in the scene; null before it is open.</summary>
        public GameObject Garage { get; private set; }

        async void Start()
        {
            try
            {
                GameObject imported = prefab == null ? Imported(assetGuid) : prefab;
                if (imported == null)
                {
                    string path = Path.Combine(Application.streamingAssetsPath, file);
                    loaded = await StageLoader.LoadAsync(path, new ImportSettings(), transform, null, cancel.Token);
                    Begin(loaded.Root, car);
                }
                else
                {
                    Begin(Instantiate(imported, transform), car);
                }
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

        /// <summary>Gives a car the body of the first car that is parked in a garage of the scene, and lets it drive
        /// there.</summary>
        public void Begin(GameObject garage, DriveAlongLanes driver)
        {
            Garage = garage;
            foreach (Stall stall in garage.GetComponentsInChildren<Stall>())
            {
                if (stall.Car == null) { continue; }
                Transform body = Instantiate(stall.Car.gameObject, driver.transform).transform;
                body.localPosition = Vector3.zero;
                body.localRotation = Quaternion.identity;
                break;
            }
            driver.SetOut(garage);
            driver.enabled = true;
        }

        // the asset with a GUID, wherever the project has it; none in builds, which hold no GUIDs
        static GameObject Imported(string guid)
        {
#if UNITY_EDITOR
            return UnityEditor.AssetDatabase.LoadAssetAtPath<GameObject>(
                UnityEditor.AssetDatabase.GUIDToAssetPath(guid));
#else
            return null;
#endif
        }
    }
}
