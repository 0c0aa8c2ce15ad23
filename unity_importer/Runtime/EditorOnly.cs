using UnityEngine;
#if UNITY_EDITOR
using UnityEditor;
#endif

namespace Garage.Unity
{
    /// <summary>What only the editor can do; in players none of it happens.</summary>
    static class EditorOnly
    {
        /// <summary>Gives a mesh texture coordinates for lightmaps.</summary>
        public static void Unwrap(Mesh mesh)
        {
#if UNITY_EDITOR
            Unwrapping.GenerateSecondaryUVSet(mesh);
#endif
        }

        /// <summary>Marks an object that never moves; static batching would win over GPU instancing.</summary>
        public static void MarkStatic(GameObject made, bool isInstanced)
        {
#if UNITY_EDITOR
            StaticEditorFlags flags = StaticEditorFlags.ContributeGI | StaticEditorFlags.OccluderStatic
                | StaticEditorFlags.OccludeeStatic | StaticEditorFlags.ReflectionProbeStatic;
            if (!isInstanced) { flags |= StaticEditorFlags.BatchingStatic; }
            GameObjectUtility.SetStaticEditorFlags(made, flags);
#endif
        }

        /// <summary>Makes a light of an area for the lightmapper; false where there is none.</summary>
        public static bool MakeBaked(Light light, LightType type, Vector2 size)
        {
#if UNITY_EDITOR
            light.type = type;
            light.areaSize = size;
            light.lightmapBakeType = LightmapBakeType.Baked;
            return true;
#else
            return false;
#endif
        }
    }
}
