#if UNITY_EDITOR
using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    [Flags]
    public enum StaticEditorFlags { ContributeGI = 1, OccluderStatic = 2, BatchingStatic = 4, OccludeeStatic = 16, ReflectionProbeStatic = 64 }

    public sealed class GameObjectUtility
    {
        public static void SetStaticEditorFlags(GameObject go, StaticEditorFlags flags)
        {
            go.staticFlags = (int)flags;
        }

        public static StaticEditorFlags GetStaticEditorFlags(GameObject go)
        {
            return (StaticEditorFlags)go.staticFlags;
        }
    }

    public sealed class Unwrapping
    {
        /// <summary>Each triangle in a square of its own.</summary>
#if UNITY_6000_0_OR_NEWER
        public static bool GenerateSecondaryUVSet(Mesh src)
#else
        public static void GenerateSecondaryUVSet(Mesh src)
#endif
        {
            var coordinates = new Vector2[src.vertexCount];
            int side = (int)Math.Ceiling(Math.Sqrt(src.vertexCount));
            for (int i = 0; i < coordinates.Length; i++) { coordinates[i] = new Vector2((i % side + 0.5f) / side, (i / side + 0.5f) / side); }
            src.uv2 = coordinates;
#if UNITY_6000_0_OR_NEWER
            return true;
#endif
        }
    }
}
#endif
