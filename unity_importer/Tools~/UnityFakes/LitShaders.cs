using System.Collections.Generic;

namespace UnityEngine
{
    /// <summary>Names of the properties of the lit shaders of the three pipelines, so that a misspelt one
    /// shows.</summary>
    static class LitShaders
    {
        public static IEnumerable<Shader> All()
        {
            yield return new Shader("Standard",
                "_Color _MainTex _Cutoff _Glossiness _GlossMapScale _SmoothnessTextureChannel _Metallic"
                + " _MetallicGlossMap _SpecularHighlights _GlossyReflections _BumpScale _BumpMap _Parallax"
                + " _ParallaxMap _OcclusionStrength _OcclusionMap _EmissionColor _EmissionMap _DetailMask"
                + " _DetailAlbedoMap _DetailNormalMapScale _DetailNormalMap _UVSec _Mode _SrcBlend _DstBlend"
                + " _ZWrite");
            // as of 2021.3: no separate blending of alpha
            yield return new Shader("Universal Render Pipeline/Lit",
                "_WorkflowMode _BaseMap _BaseColor _Cutoff _Smoothness _SmoothnessTextureChannel _Metallic"
                + " _MetallicGlossMap _SpecColor _SpecGlossMap _SpecularHighlights _EnvironmentReflections"
                + " _BumpScale _BumpMap _Parallax _ParallaxMap _OcclusionStrength _OcclusionMap _EmissionColor"
                + " _EmissionMap _DetailMask _DetailAlbedoMapScale _DetailAlbedoMap _DetailNormalMapScale"
                + " _DetailNormalMap _ClearCoatMask _ClearCoatSmoothness _Surface _Blend _Cull _AlphaClip"
                + " _SrcBlend _DstBlend _ZWrite _ReceiveShadows _QueueOffset _MainTex _Color _GlossMapScale"
                + " _Glossiness _GlossyReflections");
            yield return new Shader("HDRP/Lit",
                "_BaseColor _BaseColorMap _Metallic _Smoothness _MaskMap _MetallicRemapMin _MetallicRemapMax"
                + " _SmoothnessRemapMin _SmoothnessRemapMax _AlphaRemapMin _AlphaRemapMax _AORemapMin _AORemapMax"
                + " _NormalMap _NormalMapOS _NormalScale _CoatMask _CoatMaskMap _EmissiveColor _EmissiveColorLDR"
                + " _EmissiveColorMap _AlbedoAffectEmissive _UseEmissiveIntensity _EmissiveIntensity"
                + " _EmissiveExposureWeight _AlphaCutoffEnable _AlphaCutoff _AlphaCutoffShadow _Ior _SurfaceType"
                + " _BlendMode _SrcBlend _DstBlend _AlphaSrcBlend _AlphaDstBlend _ZWrite _TransparentZWrite"
                + " _CullMode _CullModeForward _EnableFogOnTransparent _EnableBlendModePreserveSpecularLighting"
                + " _DoubleSidedEnable _UVBase _NormalMapSpace _MaterialID _EmissiveColorMode _EmissionColor"
                + " _MainTex _Color _Cutoff _ZTestDepthEqualForOpaque _ZTestGBuffer _ZTestTransparent _StencilRef"
                + " _StencilWriteMask _StencilRefDepth _StencilWriteMaskDepth _StencilRefGBuffer"
                + " _StencilWriteMaskGBuffer _StencilRefMV _StencilWriteMaskMV _SupportDecals _ReceivesSSR"
                + " _ReceivesSSRTransparent");
        }
    }
}
