using System;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity
{
    /// <summary>The maps of a surface; null where it has none.</summary>
    struct SurfaceMaps
    {
        public Texture2D Base, Normal, Mask, Emission;
    }

    /// <summary>The lit shader of a pipeline: what its properties are called and which keywords go with them.</summary>
    abstract class LitShader
    {
        public abstract string Name { get; }

        /// <summary>Whether it shows a clearcoat.</summary>
        public virtual bool HasClearcoat
        {
            get { return false; }
        }

        public static LitShader Of(PipelineKind kind)
        {
            if (kind == PipelineKind.Automatic) { kind = InUse(); }
            if (kind == PipelineKind.HighDefinition) { return new HighDefinitionLit(); }
            return kind == PipelineKind.Universal ? (LitShader)new UniversalLit() : new BuiltInLit();
        }

        /// <summary>The project's pipeline, told by the type of its asset, so that no pipeline's package is needed to
        /// compile.</summary>
        public static PipelineKind InUse()
        {
            RenderPipelineAsset asset = GraphicsSettings.currentRenderPipeline;
            string type = asset == null ? "" : asset.GetType().Name;
            return type.StartsWith("HDRenderPipeline", StringComparison.Ordinal) ? PipelineKind.HighDefinition
                : type.StartsWith("UniversalRenderPipeline", StringComparison.Ordinal) ? PipelineKind.Universal
                : PipelineKind.BuiltIn;
        }

        /// <summary>Writes the surface into a new material of this shader; the emission times a factor.</summary>
        public void Write(Material material, SurfaceData surface, SurfaceMaps maps, float emission)
        {
            Color color = surface.BaseColor.gamma;
            color.a = surface.Alpha.Texture == null ? surface.Alpha.Value : 1;
            WriteMaps(material, surface, maps, color);
            if (surface.Glows)
            {
                material.globalIlluminationFlags = MaterialGlobalIlluminationFlags.BakedEmissive;
                Color glow = surface.Emission * emission;
                glow.a = 1;
                WriteEmission(material, glow, maps.Emission);
            }
            if (surface.Opacity == Opacity.Opaque) { return; }
            bool isCutout = surface.Opacity == Opacity.Cutout;
            material.SetOverrideTag("RenderType", isCutout ? "TransparentCutout" : "Transparent");
            material.renderQueue = (int)(isCutout ? RenderQueue.AlphaTest : RenderQueue.Transparent);
            if (isCutout) { material.EnableKeyword("_ALPHATEST_ON"); }
            else
            {
                bool isGlass = surface.Opacity == Opacity.Transparent;
                material.SetFloat("_SrcBlend", (float)(isGlass || BlendsInShader ? BlendMode.One : BlendMode.SrcAlpha));
                material.SetFloat("_DstBlend", (float)BlendMode.OneMinusSrcAlpha);
                material.SetFloat("_ZWrite", 0);
            }
            WriteOpacity(material, surface);
        }

        protected virtual bool BlendsInShader
        {
            get { return false; }
        }

        protected abstract void WriteMaps(Material material, SurfaceData surface, SurfaceMaps maps, Color color);

        protected abstract void WriteEmission(Material material, Color glow, Texture2D map);

        protected abstract void WriteOpacity(Material material, SurfaceData surface);

        protected static void SetMap(Material material, string property, Texture2D map, string keyword)
        {
            if (map == null) { return; }
            material.SetTexture(property, map);
            if (keyword != null) { material.EnableKeyword(keyword); }
        }

        protected static void SetCoordinates(Material material, string property, SurfaceData surface)
        {
            material.SetTextureScale(property, surface.CoordinateScale);
            material.SetTextureOffset(property, surface.CoordinateOffset);
        }
    }

    /// <summary>Standard, of the built-in pipeline.</summary>
    sealed class BuiltInLit : LitShader
    {
        public override string Name
        {
            get { return "Standard"; }
        }

        protected override void WriteMaps(Material material, SurfaceData surface, SurfaceMaps maps, Color color)
        {
            material.SetColor("_Color", color);
            SetMap(material, "_MainTex", maps.Base, null);
            SetCoordinates(material, "_MainTex", surface);
            SetMap(material, "_BumpMap", maps.Normal, "_NORMALMAP");
            material.SetFloat("_Metallic", surface.Metallic.Value);
            material.SetFloat("_Glossiness", 1 - surface.Roughness.Value);
            if (maps.Mask == null) { return; }
            // red and alpha of the one, green of the other
            SetMap(material, "_MetallicGlossMap", maps.Mask, "_METALLICGLOSSMAP");
            SetMap(material, "_OcclusionMap", maps.Mask, null);
            material.SetFloat("_GlossMapScale", 1);
            material.SetFloat("_OcclusionStrength", 1);
        }

        protected override void WriteEmission(Material material, Color glow, Texture2D map)
        {
            material.SetColor("_EmissionColor", glow);
            material.EnableKeyword("_EMISSION");
            SetMap(material, "_EmissionMap", map, null);
        }

        protected override void WriteOpacity(Material material, SurfaceData surface)
        {
            // as the shader's inspector counts: 1 cutout, 2 fade, 3 transparent
            material.SetFloat("_Mode", (float)surface.Opacity);
            if (surface.Opacity == Opacity.Cutout) { material.SetFloat("_Cutoff", surface.Cutoff); }
            else
            {
                material.EnableKeyword(surface.Opacity == Opacity.Fade ? "_ALPHABLEND_ON" : "_ALPHAPREMULTIPLY_ON");
            }
        }
    }

    /// <summary>Lit, of the Universal Render Pipeline.</summary>
    sealed class UniversalLit : LitShader
    {
        public override string Name
        {
            get { return "Universal Render Pipeline/Lit"; }
        }

        protected override void WriteMaps(Material material, SurfaceData surface, SurfaceMaps maps, Color color)
        {
            material.SetColor("_BaseColor", color);
            SetMap(material, "_BaseMap", maps.Base, null);
            SetCoordinates(material, "_BaseMap", surface);
            SetMap(material, "_BumpMap", maps.Normal, "_NORMALMAP");
            material.SetFloat("_Metallic", surface.Metallic.Value);
            material.SetFloat("_Smoothness", maps.Mask == null ? 1 - surface.Roughness.Value : 1);
            if (maps.Mask == null) { return; }
            SetMap(material, "_MetallicGlossMap", maps.Mask, "_METALLICSPECGLOSSMAP");
            SetMap(material, "_OcclusionMap", maps.Mask, "_OCCLUSIONMAP");
            material.SetFloat("_OcclusionStrength", 1);
        }

        protected override void WriteEmission(Material material, Color glow, Texture2D map)
        {
            material.SetColor("_EmissionColor", glow);
            material.EnableKeyword("_EMISSION");
            SetMap(material, "_EmissionMap", map, null);
        }

        protected override void WriteOpacity(Material material, SurfaceData surface)
        {
            if (surface.Opacity == Opacity.Cutout)
            {
                material.SetFloat("_AlphaClip", 1);
                material.SetFloat("_Cutoff", surface.Cutoff);
                return;
            }
            material.SetFloat("_Surface", 1);
            material.SetFloat("_Blend", 0);
            material.EnableKeyword("_SURFACE_TYPE_TRANSPARENT");
            bool isGlass = surface.Opacity == Opacity.Transparent;
            if (isGlass) { material.EnableKeyword("_ALPHAPREMULTIPLY_ON"); }
            // of later versions
            if (material.HasProperty("_BlendModePreserveSpecular"))
            {
                material.SetFloat("_BlendModePreserveSpecular", isGlass ? 1 : 0);
            }
            if (!material.HasProperty("_DstBlendAlpha")) { return; }
            material.SetFloat("_SrcBlendAlpha", (float)BlendMode.One);
            material.SetFloat("_DstBlendAlpha", (float)BlendMode.OneMinusSrcAlpha);
        }
    }

    /// <summary>Lit, of the High Definition Render Pipeline.</summary>
    sealed class HighDefinitionLit : LitShader
    {
        public override string Name
        {
            get { return "HDRP/Lit"; }
        }

        public override bool HasClearcoat
        {
            get { return true; }
        }

        protected override bool BlendsInShader
        {
            get { return true; }
        }

        protected override void WriteMaps(Material material, SurfaceData surface, SurfaceMaps maps, Color color)
        {
            material.SetColor("_BaseColor", color);
            SetMap(material, "_BaseColorMap", maps.Base, null);
            SetCoordinates(material, "_BaseColorMap", surface);
            // the others read as the base does
            SetCoordinates(material, "_EmissiveColorMap", surface);
            SetMap(material, "_NormalMap", maps.Normal, "_NORMALMAP");
            material.EnableKeyword("_NORMALMAP_TANGENT_SPACE");
            SetMap(material, "_MaskMap", maps.Mask, "_MASKMAP");
            material.SetFloat("_Metallic", surface.Metallic.Value);
            material.SetFloat("_Smoothness", 1 - surface.Roughness.Value);
            material.SetFloat("_CoatMask", surface.Clearcoat);
            if (surface.Clearcoat > 0) { material.EnableKeyword("_MATERIAL_FEATURE_CLEAR_COAT"); }
            // what the inspector writes, so that reflections in the screen reach the material
            material.SetFloat("_StencilRefDepth", 8);
            material.SetFloat("_StencilRefGBuffer", 10);
            material.SetFloat("_StencilRefMV", 40);
            // what the lightmapper reads
            material.SetColor("_Color", color);
            SetMap(material, "_MainTex", maps.Base, null);
        }

        protected override void WriteEmission(Material material, Color glow, Texture2D map)
        {
            material.SetColor("_EmissiveColor", glow);
            material.SetFloat("_UseEmissiveIntensity", 0);
            material.SetFloat("_EmissiveExposureWeight", 1);
            SetMap(material, "_EmissiveColorMap", map, "_EMISSIVE_COLOR_MAP");
        }

        protected override void WriteOpacity(Material material, SurfaceData surface)
        {
            if (surface.Opacity == Opacity.Cutout)
            {
                material.SetFloat("_AlphaCutoffEnable", 1);
                material.SetFloat("_AlphaCutoff", surface.Cutoff);
                material.SetFloat("_Cutoff", surface.Cutoff);
                return;
            }
            bool isGlass = surface.Opacity == Opacity.Transparent;
            material.SetFloat("_SurfaceType", 1);
            material.SetFloat("_BlendMode", 0);
            material.SetFloat("_AlphaSrcBlend", (float)BlendMode.One);
            material.SetFloat("_AlphaDstBlend", (float)BlendMode.OneMinusSrcAlpha);
            material.SetFloat("_EnableBlendModePreserveSpecularLighting", isGlass ? 1 : 0);
            material.EnableKeyword("_SURFACE_TYPE_TRANSPARENT");
            material.EnableKeyword("_ENABLE_FOG_ON_TRANSPARENT");
            material.EnableKeyword("_BLENDMODE_ALPHA");
            if (isGlass) { material.EnableKeyword("_BLENDMODE_PRESERVE_SPECULAR_LIGHTING"); }
        }
    }
}
