using System;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>What stands for a light with an area, which Unity draws in real time in HDRP alone.</summary>
    public enum LightMode
    {
        /// <summary>A spot as wide and as strong, in real time.</summary>
        SpotProxy,

        /// <summary>A rectangle or a disc for the lightmapper; in a player, where nothing bakes, a spot.</summary>
        BakedRectangle,

        /// <summary>No light at all, only surfaces that glow.</summary>
        EmissiveOnly,
    }

    /// <summary>Which colliders a prefab gets.</summary>
    public enum ColliderMode
    {
        /// <summary>As each prim's physics:approximation says.</summary>
        AsAuthored,

        /// <summary>A box around everything that collides.</summary>
        Boxes,

        /// <summary>No colliders.</summary>
        None,
    }

    /// <summary>For whose shaders materials are made.</summary>
    public enum PipelineKind
    {
        /// <summary>That of the project.</summary>
        Automatic,

        /// <summary>Standard.</summary>
        BuiltIn,

        /// <summary>Universal Render Pipeline/Lit.</summary>
        Universal,

        /// <summary>HDRP/Lit.</summary>
        HighDefinition,
    }

    /// <summary>How a stage becomes a prefab.</summary>
    [Serializable]
    public sealed class ImportSettings
    {
        /// <summary>Metres in Unity for each metre of the stage.</summary>
        [Tooltip("Metres in Unity for each metre of the stage.")]
        public float scale = 1;

        /// <summary>What stands for lights with an area.</summary>
        [Tooltip("What stands for lights with an area.")]
        public LightMode lightMode = LightMode.SpotProxy;

        /// <summary>Doubles all lights and glowing surfaces for each whole number; negative ones halve.</summary>
        [Tooltip("Doubles all lights and glowing surfaces for each whole number; negative ones halve.")]
        public float exposureStops;

        /// <summary>HDRP only: candela a square metre for each unit of intensity; garage2usd's is 27.</summary>
        [Tooltip("HDRP only: candela a square metre for each unit of intensity; 27 for stages of garage2usd.")]
        public float nitsPerUnit = 1;

        /// <summary>Whether spots and distant lights cast shadows. Every one costs a map of its own.</summary>
        [Tooltip("Whether spots and distant lights cast shadows. Every one costs a map of its own.")]
        public bool lightShadows;

        /// <summary>Which colliders are made.</summary>
        [Tooltip("Which colliders are made.")]
        public ColliderMode colliders = ColliderMode.AsAuthored;

        /// <summary>GPU instancing on all materials. Static batching is left off then, as it would win.</summary>
        [Tooltip("GPU instancing on all materials. Static batching is left off then, as it would win.")]
        public bool gpuInstancing = true;

        /// <summary>Marks what never moves as static for global illumination, occlusion and reflections (editor
        /// only).</summary>
        [Tooltip("Marks what never moves as static for global illumination, occlusion and reflections (editor only).")]
        public bool staticFlags = true;

        /// <summary>Labels (class) of objects that may move, and so are not static.</summary>
        [Tooltip("Labels (class) of objects that may move, and so are not static.")]
        public string[] movableLabels = { "car", "van", "truck", "person", "number_plate", "barrier" };

        /// <summary>Makes cameras of the stage's, switched off.</summary>
        [Tooltip("Makes cameras of the stage's, switched off.")]
        public bool cameras = true;

        /// <summary>Compresses textures whose sides are multiples of four.</summary>
        [Tooltip("Compresses textures whose sides are multiples of four.")]
        public bool compressTextures = true;

        /// <summary>Unwraps meshes for lightmaps (editor only); BakedRectangle does so anyway.</summary>
        [Tooltip("Unwraps meshes for lightmaps (editor only); BakedRectangle does so anyway.")]
        public bool lightmapCoordinates;

        /// <summary>For whose shaders materials are made.</summary>
        [Tooltip("For whose shaders materials are made.")]
        public PipelineKind pipeline = PipelineKind.Automatic;
    }
}
