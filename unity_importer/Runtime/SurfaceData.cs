using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>How light gets through a surface.</summary>
    enum Opacity
    {
        Opaque,

        /// <summary>There or not, by a threshold.</summary>
        Cutout,

        /// <summary>What is not there does not shine either.</summary>
        Fade,

        /// <summary>As glass: its reflections stay.</summary>
        Transparent,
    }

    /// <summary>A number that may come of one channel of a texture.</summary>
    struct SurfaceNumber
    {
        public float Value;

        /// <summary>Null where the number is constant.</summary>
        public TextureData Texture;
    }

    /// <summary>A UsdPreviewSurface as Unity's lit shaders want it. Colors are linear.</summary>
    sealed class SurfaceData
    {
        public Color BaseColor;
        public TextureData BaseTexture;
        public SurfaceNumber Alpha, Metallic, Roughness, Occlusion;
        public Opacity Opacity;
        public float Cutoff;
        public TextureData NormalTexture;
        public Color Emission;
        public TextureData EmissionTexture;
        public float Clearcoat;

        /// <summary>The primvar with texture coordinates.</summary>
        public string Coordinates = "st";

        public Vector2 CoordinateScale = Vector2.one, CoordinateOffset = Vector2.zero;

        /// <summary>Whether it reads a texture, so that coordinates matter.</summary>
        public bool IsTextured
        {
            get
            {
                return BaseTexture != null || NormalTexture != null || EmissionTexture != null || Alpha.Texture != null
                    || Metallic.Texture != null || Roughness.Texture != null || Occlusion.Texture != null;
            }
        }

        public bool Glows
        {
            get { return Emission.maxColorComponent > 0; }
        }

        /// <summary>What a surface without a material looks like.</summary>
        public static SurfaceData OfColor(float[] color)
        {
            return new SurfaceData
            {
                BaseColor = new Color(color[0], color[1], color[2]), Alpha = new SurfaceNumber { Value = 1 },
                Roughness = new SurfaceNumber { Value = 0.5f },
                Occlusion = new SurfaceNumber { Value = 1 },
            };
        }

        public static SurfaceData Of(MaterialData data, ImportReport report)
        {
            var surface = new SurfaceData
            {
                Alpha = NumberOf(data, "opacity"), Metallic = NumberOf(data, "metallic"),
                Roughness = NumberOf(data, "roughness"),
                Occlusion = NumberOf(data, "occlusion"), Clearcoat = data.Value("clearcoat")[0],
                Cutoff = data.Value("opacityThreshold")[0],
                NormalTexture = Found(data.Texture("normal")),
            };
            surface.BaseTexture = ColorOf(data, "diffuseColor", out surface.BaseColor, report);
            surface.EmissionTexture = ColorOf(data, "emissiveColor", out surface.Emission, report);
            bool isSolid = surface.Alpha.Texture == null && surface.Alpha.Value >= 1;
            MaterialInput mode;
            bool isPresence = data.Inputs.TryGetValue("opacityMode", out mode) && mode.Text == "presence";
            surface.Opacity = isSolid ? Opacity.Opaque : surface.Cutoff > 0 ? Opacity.Cutout
                : isPresence ? Opacity.Fade : Opacity.Transparent;
            surface.FindCoordinates(data, report);
            if (data.Value("useSpecularWorkflow")[0] > 0)
            {
                report.Add("the specular workflow is shown as the metallic one", data.Path);
            }
            if (data.Texture("clearcoat") != null) { report.Add("textures of clearcoats are left out", data.Path); }
            surface.NameWhatIsLeftOut(data, report);
            foreach (KeyValuePair<string, MaterialInput> input in data.Inputs)
            {
                if (input.Value.Primvar != null)
                {
                    report.Add("materials do not read primvars but for texture coordinates", data.Path + "."
                        + input.Key);
                }
            }
            return surface;
        }

        void NameWhatIsLeftOut(MaterialData data, ImportReport report)
        {
            if (data.Texture("displacement") != null || data.Value("displacement")[0] != 0)
            {
                report.Add("displacement is left out", data.Path);
            }
            float[] normal = data.Value("normal");
            bool isTilted = data.Texture("normal") == null && (normal[0] != 0 || normal[1] != 0);
            if (isTilted) { report.Add("constant normals are left out", data.Path); }
            if (data.Value("ior")[0] != 1.5f || data.Texture("ior") != null)
            {
                report.Add("the index of refraction is taken for 1.5", data.Path);
            }
            if (Clearcoat > 0 && (data.Value("clearcoatRoughness")[0] != 0.01f
                || data.Texture("clearcoatRoughness") != null))
            {
                report.Add("the roughness of clearcoats is left out", data.Path);
            }
            foreach (string input in Numbers)
            {
                TextureData texture = data.Texture(input);
                if (texture != null && texture.Channel == "rgb")
                {
                    report.Add("a number reads red where the stage connects a color", data.Path + "." + input);
                }
            }
            foreach (string input in new[] { "diffuseColor", "emissiveColor", "normal" })
            {
                TextureData texture = data.Texture(input);
                if (texture != null && texture.Channel != "rgb")
                {
                    report.Add("a color reads all channels where the stage connects one", data.Path + "." + input);
                }
            }
        }

        static readonly string[] Numbers = { "opacity", "metallic", "roughness", "occlusion" };

        static TextureData Found(TextureData texture)
        {
            return texture == null || texture.Identifier == null ? null : texture;
        }

        static SurfaceNumber NumberOf(MaterialData data, string input)
        {
            TextureData texture = data.Texture(input);
            if (texture == null) { return new SurfaceNumber { Value = data.Value(input)[0] }; }
            int channel = Math.Max(0, "rgba".IndexOf(texture.Channel, StringComparison.Ordinal));
            // a missing file shows its fallback
            return new SurfaceNumber { Value = texture.Fallback[channel], Texture = Found(texture) };
        }

        // the tint where there is a texture, else the color
        static TextureData ColorOf(MaterialData data, string input, out Color color, ImportReport report)
        {
            TextureData texture = data.Texture(input);
            float[] numbers = data.Value(input);
            if (texture != null)
            {
                numbers = texture.Identifier == null ? texture.Fallback : texture.Scale;
                bool shifts = texture.Bias[0] != 0 || texture.Bias[1] != 0 || texture.Bias[2] != 0;
                if (shifts) { report.Add("the bias of a texture of colors is left out", data.Path + "." + input); }
            }
            color = new Color(numbers[0], numbers[1], numbers[2]);
            return Found(texture);
        }

        void FindCoordinates(MaterialData data, ImportReport report)
        {
            TextureData first = null;
            foreach (string input in new[] { "diffuseColor", "normal", "roughness", "metallic", "occlusion", "opacity",
                "emissiveColor" })
            {
                TextureData texture = Found(data.Texture(input));
                if (texture == null) { continue; }
                if (first == null)
                {
                    first = texture;
                    continue;
                }
                bool same = first.Primvar == texture.Primvar
                    && first.CoordinateRotationDegrees == texture.CoordinateRotationDegrees;
                for (int k = 0; k < 2; k++)
                {
                    same &= first.CoordinateScale[k] == texture.CoordinateScale[k]
                        && first.CoordinateTranslation[k] == texture.CoordinateTranslation[k];
                }
                if (!same)
                {
                    report.Add("all textures of a material use the coordinates of its first one", data.Path + "."
                        + input);
                }
            }
            if (first == null) { return; }
            Coordinates = first.Primvar;
            CoordinateScale = new Vector2(first.CoordinateScale[0], first.CoordinateScale[1]);
            CoordinateOffset = new Vector2(first.CoordinateTranslation[0], first.CoordinateTranslation[1]);
            if (first.CoordinateRotationDegrees != 0)
            {
                report.Add("the rotation of texture coordinates is left out", data.Path);
            }
        }

        /// <summary>The same text for surfaces that look the same.</summary>
        public string Key()
        {
            var key = new StringBuilder();
            foreach (float number in new[]
            {
                BaseColor.r, BaseColor.g, BaseColor.b, Emission.r, Emission.g, Emission.b, Clearcoat, Cutoff,
                (float)Opacity, CoordinateScale.x, CoordinateScale.y,
                CoordinateOffset.x, CoordinateOffset.y,
            })
            {
                key.Append(number.ToString("R", CultureInfo.InvariantCulture)).Append(' ');
            }
            foreach (SurfaceNumber number in new[] { Alpha, Metallic, Roughness, Occlusion })
            {
                key.Append(number.Value.ToString("R", CultureInfo.InvariantCulture)).Append(' ');
                key.Append(KeyOf(number.Texture)).Append(' ');
            }
            string[] rest = { Coordinates, KeyOf(BaseTexture), KeyOf(NormalTexture), KeyOf(EmissionTexture) };
            return key.Append(string.Join(" ", rest)).ToString();
        }

        /// <summary>The same text for textures that are read the same way.</summary>
        public static string KeyOf(TextureData texture)
        {
            if (texture == null) { return "-"; }
            var key = new StringBuilder(texture.Identifier + "|" + texture.Channel + "|" + texture.WrapS + "|"
                + texture.WrapT + "|" + texture.SourceColorSpace);
            foreach (float number in texture.Scale)
            {
                key.Append('|').Append(number.ToString("R", CultureInfo.InvariantCulture));
            }
            foreach (float number in texture.Bias)
            {
                key.Append('|').Append(number.ToString("R", CultureInfo.InvariantCulture));
            }
            return key.ToString();
        }
    }
}
