using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>One Material for all surfaces that look the same.</summary>
    sealed class MaterialAssets
    {
        /// <summary>Where the reference materials are, whose shaders then come with a player.</summary>
        public const string ReferencePath = "GarageMaterials/Lit";

        const string Colored = "color ";

        readonly SceneModel scene;
        readonly bool isInstanced;
        readonly float emission;
        readonly ImportReport report;
        readonly Action<string, UnityEngine.Object> store;
        readonly TextureAssets textures;
        readonly LitShader lit;
        readonly Dictionary<string, SurfaceData> surfaces = new Dictionary<string, SurfaceData>();
        readonly Dictionary<SurfaceData, Material> bySurface = new Dictionary<SurfaceData, Material>();
        readonly Dictionary<string, Material> byKey = new Dictionary<string, Material>();
        Shader shader;

        public MaterialAssets(SceneModel scene, ImportSettings settings, TextureAssets textures, ImportReport report,
            Action<string, UnityEngine.Object> store)
        {
            this.scene = scene;
            this.textures = textures;
            this.report = report;
            this.store = store;
            isInstanced = settings.gpuInstancing;
            lit = LitShader.Of(settings.pipeline);
            emission = Mathf.Pow(2, settings.exposureStops) * (lit is HighDefinitionLit ? settings.nitsPerUnit : 1);
        }

        /// <summary>The surface of the material at a path; that of a plain color where there is none.</summary>
        public SurfaceData Surface(string path, float[] color)
        {
            string key = path;
            MaterialData data = scene.Material(path);
            if (data == null)
            {
                color = color ?? new[] { 0.18f, 0.18f, 0.18f };
                key = Colored + InvariantText.Of(color[0], color[1], color[2]);
            }
            SurfaceData surface;
            if (!surfaces.TryGetValue(key, out surface))
            {
                surface = data == null ? SurfaceData.OfColor(color) : SurfaceData.Of(data, report);
                if (data == null && path != null)
                {
                    report.Add("materials without a UsdPreviewSurface are grey", path);
                }
                if (surface.Clearcoat > 0 && !lit.HasClearcoat) { report.Add(lit.Name + " shows no clearcoat", path); }
                surfaces.Add(key, surface);
            }
            return surface;
        }

        /// <summary>Whether the material at a path shines by itself.</summary>
        public bool Glows(string path)
        {
            return scene.Material(path) != null && Surface(path, null).Glows;
        }

        /// <summary>The Material of a surface. Throws InvalidOperationException where the pipeline's shader is not in
        /// the build.</summary>
        public Material Of(SurfaceData surface, string name)
        {
            Material material;
            if (bySurface.TryGetValue(surface, out material)) { return material; }
            string key = surface.Key();
            if (!byKey.TryGetValue(key, out material))
            {
                material = Make(surface);
                material.name = name;
                byKey.Add(key, material);
                store("material " + key, material);
            }
            bySurface.Add(surface, material);
            return material;
        }

        Material Make(SurfaceData surface)
        {
            if (shader == null) { shader = FindShader(); }
            var material = new Material(shader) { enableInstancing = isInstanced };
            var maps = new SurfaceMaps
            {
                Base = textures.Base(surface.BaseTexture, surface.Alpha),
                Mask = textures.Mask(surface.Metallic, surface.Occlusion, surface.Roughness),
                Normal = surface.NormalTexture == null ? null : textures.Normals(surface.NormalTexture),
                Emission = surface.EmissionTexture == null ? null : textures.Colors(surface.EmissionTexture),
            };
            lit.Write(material, surface, maps, emission);
            return material;
        }

        Shader FindShader()
        {
            Shader found = Shader.Find(lit.Name);
            if (found != null) { return found; }
            var reference = Resources.Load<Material>(ReferencePath);
            if (reference != null && reference.shader != null && reference.shader.name == lit.Name)
            {
                return reference.shader;
            }
            throw new InvalidOperationException("The shader " + lit.Name
                + " is not in this build: make reference materials (Tools > Garage), or add it to the shaders that are"
                + " always included.");
        }
    }
}
