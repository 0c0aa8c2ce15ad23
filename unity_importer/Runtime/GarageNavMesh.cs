using System.Collections.Generic;
using UnityEngine;
using UnityEngine.AI;

namespace Garage.Unity
{
    /// <summary>A NavMesh of the colliders below its object: floors and ramps to go on, all else in the way.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/Garage NavMesh")]
    public sealed class GarageNavMesh : MonoBehaviour
    {
        [Tooltip("Number of the agent's settings in the Navigation window.")]
        [SerializeField] int agent;

        [Tooltip("Metres that the agent keeps from walls; 0 takes those of its settings. About 1 for cars.")]
        [SerializeField] float radius;

        [Tooltip("Labels (class) of what is left out: all that hangs too high to be in the way, and what moves.")]
        [SerializeField] string[] leftOut =
        {
            "ceiling", "beam", "duct", "cable_tray", "sprinkler", "light", "exit_sign", "lane_sign",
            "fire_shutter", "sky", "car", "van", "truck", "number_plate", "barrier",
        };

        [SerializeField] bool buildsOnStart = true;

        NavMeshDataInstance added;

        /// <summary>What was built last; null before.</summary>
        public NavMeshData Data { get; private set; }

        void Start()
        {
            if (buildsOnStart) { Build(); }
        }

        void OnDestroy()
        {
            added.Remove();
        }

        /// <summary>Builds the NavMesh anew and adds it to the scene. Meshes of colliders have to be readable, as
        /// imported ones are.</summary>
        [ContextMenu("Build")]
        public NavMeshData Build()
        {
            var sources = new List<NavMeshBuildSource>();
            NavMeshBuilder.CollectSources(transform, ~0, NavMeshCollectGeometry.PhysicsColliders, 0,
                new List<NavMeshBuildMarkup>(), sources);
            var high = new HashSet<string>(leftOut);
            sources.RemoveAll(source => IsLeftOut(source.component, high));
            NavMeshBuildSettings settings = NavMesh.GetSettingsByIndex(agent);
            if (radius > 0) { settings.agentRadius = radius; }
            added.Remove();
            Data = NavMeshBuilder.BuildNavMeshData(settings, sources, BoundsOf(sources), Vector3.zero,
                Quaternion.identity);
            added = NavMesh.AddNavMeshData(Data);
            return Data;
        }

        static bool IsLeftOut(Component collider, HashSet<string> labels)
        {
            SemanticLabels owner = collider == null ? null : collider.GetComponentInParent<SemanticLabels>();
            return owner != null && labels.Contains(owner.ClassLabel);
        }

        static Bounds BoundsOf(List<NavMeshBuildSource> sources)
        {
            var all = new Bounds();
            bool isFirst = true;
            foreach (NavMeshBuildSource source in sources)
            {
                var collider = source.component as Collider;
                if (collider == null) { continue; }
                if (isFirst) { all = collider.bounds; }
                else { all.Encapsulate(collider.bounds); }
                isFirst = false;
            }
            all.Expand(1);
            return all;
        }
    }
}
