using System;
using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Materials with every set of keywords that surfaces get, so that a build does not leave their variants
    /// out.</summary>
    static class ReferenceMaterials
    {
        /// <summary>One for each set; the first one is called "Lit". Throws InvalidOperationException without the
        /// pipeline's shader.</summary>
        public static List<Material> Make(PipelineKind pipeline)
        {
            LitShader lit = LitShader.Of(pipeline);
            Shader shader = Shader.Find(lit.Name);
            if (shader == null)
            {
                throw new InvalidOperationException("The shader " + lit.Name + " is not in this project.");
            }
            var made = new List<Material>();
            var seen = new HashSet<string>();
            // a map only has to be there: what it holds makes no variant
            Texture2D map = Texture2D.whiteTexture;
            for (int kind = 0; kind < 128; kind++)
            {
                SurfaceData surface = SurfaceData.OfColor(new[] { 1f, 1, 1 });
                surface.Opacity = (Opacity)(kind & 3);
                surface.Emission = (kind & 4) != 0 ? Color.white : Color.black;
                surface.Clearcoat = (kind & 8) != 0 ? 1 : 0;
                var maps = new SurfaceMaps
                {
                    Normal = (kind & 16) != 0 ? map : null, Mask = (kind & 32) != 0 ? map : null,
                    Emission = (kind & 64) != 0 ? map : null,
                };
                var material = new Material(shader) { enableInstancing = true };
                lit.Write(material, surface, maps, 1);
                string[] keywords = material.shaderKeywords;
                Array.Sort(keywords, StringComparer.Ordinal);
                if (seen.Add(string.Join(" ", keywords)))
                {
                    material.name = made.Count == 0 ? "Lit" : "Lit" + made.Count;
                    made.Add(material);
                }
                else { UnityEngine.Object.DestroyImmediate(material); }
            }
            return made;
        }
    }
}
