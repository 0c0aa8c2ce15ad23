using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Textures as Unity's lit shaders want them, each made once.</summary>
    sealed class TextureAssets
    {
        const int Anisotropy = 8;

        readonly UsdStage stage;
        readonly bool compresses, keepsPixels;
        readonly ImportReport report;
        readonly Action<string, UnityEngine.Object> store;
        readonly Dictionary<string, Texture2D> made = new Dictionary<string, Texture2D>();
        readonly Dictionary<string, Pixels> read = new Dictionary<string, Pixels>();

        sealed class Pixels
        {
            public int Width, Height;
            public Color32[] Values;
        }

        public TextureAssets(UsdStage stage, bool compresses, bool keepsPixels, ImportReport report,
            Action<string, UnityEngine.Object> store)
        {
            this.stage = stage;
            this.compresses = compresses;
            this.keepsPixels = keepsPixels;
            this.report = report;
            this.store = store;
        }

        /// <summary>Colors; with the alpha where that comes of a texture. Null where both are constant or no image can
        /// be read.</summary>
        public Texture2D Base(TextureData color, SurfaceNumber alpha)
        {
            bool isOneFile = alpha.Texture == null
                || (color != null && alpha.Texture.Identifier == color.Identifier && alpha.Texture.Channel == "a"
                && alpha.Texture.Scale[3] == 1 && alpha.Texture.Bias[3] == 0);
            if (isOneFile) { return color == null ? null : Colors(color); }
            return Made("base " + SurfaceData.KeyOf(color) + " " + SurfaceData.KeyOf(alpha.Texture), () =>
            {
                Pixels body = color == null ? null : Read(color), mask = Read(alpha.Texture);
                if (mask == null) { return null; }
                Pixels size = body != null && body.Width * body.Height > mask.Width * mask.Height ? body : mask;
                var values = new Color32[size.Width * size.Height];
                float[] levels = Levels(alpha);
                for (int i = 0; i < values.Length; i++)
                {
                    Color32 value = body == null ? new Color32(255, 255, 255, 255) : At(body, size, i);
                    value.a = Byte(levels[Channel(At(mask, size, i), alpha.Texture.Channel)]);
                    values[i] = value;
                }
                return Written(size, values, color ?? alpha.Texture, color != null && IsRaw(color));
            });
        }

        public Texture2D Colors(TextureData texture)
        {
            bool isRaw = IsRaw(texture);
            return Made("color " + isRaw + FileKey(texture), () => Loaded(texture, isRaw));
        }

        /// <summary>A map of normals between 0 and 1, y along the second texture coordinate.</summary>
        public Texture2D Normals(TextureData texture)
        {
            bool isUsual = true, isBare = true;
            for (int k = 0; k < 3; k++)
            {
                isUsual &= texture.Scale[k] == 2 && texture.Bias[k] == -1;
                isBare &= texture.Scale[k] == 1 && texture.Bias[k] == 0;
            }
            if (isBare)
            {
                report.Add("maps of normals without scale and bias are taken to hold (n + 1) / 2", texture.AssetPath);
            }
            if (isUsual || isBare) { return Made("normal " + FileKey(texture), () => Loaded(texture, true)); }
            return Made("normal " + SurfaceData.KeyOf(texture), () =>
            {
                Pixels pixels = Read(texture);
                if (pixels == null) { return null; }
                var values = new Color32[pixels.Values.Length];
                for (int i = 0; i < values.Length; i++)
                {
                    Color32 value = pixels.Values[i];
                    values[i] = new Color32(Packed(value.r, texture, 0), Packed(value.g, texture, 1),
                        Packed(value.b, texture, 2), 255);
                }
                return Written(pixels, values, texture, true);
            });
        }

        static byte Packed(byte value, TextureData texture, int channel)
        {
            return Byte((value / 255f * texture.Scale[channel] + texture.Bias[channel] + 1) / 2);
        }

        /// <summary>
        /// Metallic, occlusion, 0 and smoothness in red, green, blue and alpha, as all three pipelines read them; null
        /// where all are constant.
        /// </summary>
        public Texture2D Mask(SurfaceNumber metallic, SurfaceNumber occlusion, SurfaceNumber roughness)
        {
            var numbers = new[] { metallic, occlusion, roughness };
            string key = "mask";
            TextureData any = null;
            foreach (SurfaceNumber number in numbers)
            {
                any = any ?? number.Texture;
                key += " " + (number.Texture == null
                    ? number.Value.ToString("R", System.Globalization.CultureInfo.InvariantCulture)
                    : SurfaceData.KeyOf(number.Texture));
            }
            if (any == null) { return null; }
            return Made(key, () =>
            {
                var sources = new Pixels[3];
                var levels = new float[3][];
                Pixels size = null;
                for (int i = 0; i < 3; i++)
                {
                    sources[i] = numbers[i].Texture == null ? null : Read(numbers[i].Texture);
                    levels[i] = sources[i] == null ? null : Levels(numbers[i]);
                    if (sources[i] != null
                        && (size == null || sources[i].Width * sources[i].Height > size.Width * size.Height))
                    {
                        size = sources[i];
                    }
                }
                if (size == null) { return null; }
                var values = new Color32[size.Width * size.Height];
                for (int i = 0; i < values.Length; i++)
                {
                    float r = Value(numbers[2], sources[2], levels[2], size, i);
                    values[i] = new Color32(Byte(Value(numbers[0], sources[0], levels[0], size, i)),
                        Byte(Value(numbers[1], sources[1], levels[1], size, i)), 0, Byte(1 - r));
                }
                return Written(size, values, any, true);
            });
        }

        static float Value(SurfaceNumber number, Pixels source, float[] levels, Pixels size, int place)
        {
            return source == null ? number.Value : levels[Channel(At(source, size, place), number.Texture.Channel)];
        }

        // what each of the 256 values of a channel means
        static float[] Levels(SurfaceNumber number)
        {
            TextureData texture = number.Texture;
            int channel = Math.Max(0, "rgba".IndexOf(texture.Channel, StringComparison.Ordinal));
            bool isCurved = texture.SourceColorSpace == "sRGB" && channel < 3;
            var levels = new float[256];
            for (int i = 0; i < 256; i++)
            {
                float value = isCurved ? Mathf.GammaToLinearSpace(i / 255f) : i / 255f;
                levels[i] = Mathf.Clamp01(value * texture.Scale[channel] + texture.Bias[channel]);
            }
            return levels;
        }

        static byte Byte(float value)
        {
            return (byte)(Mathf.Clamp01(value) * 255 + 0.5f);
        }

        static byte Channel(Color32 pixel, string channel)
        {
            return channel == "a" ? pixel.a : channel == "b" ? pixel.b : channel == "g" ? pixel.g : pixel.r;
        }

        static Color32 At(Pixels source, Pixels size, int place)
        {
            if (source.Width == size.Width && source.Height == size.Height) { return source.Values[place]; }
            int x = place % size.Width * source.Width / size.Width;
            int y = place / size.Width * source.Height / size.Height;
            return source.Values[y * source.Width + x];
        }

        // "auto" means colors where there is color
        static bool IsRaw(TextureData texture)
        {
            return texture.SourceColorSpace == "raw";
        }

        static string FileKey(TextureData texture)
        {
            return texture.Identifier + "|" + texture.WrapS + "|" + texture.WrapT;
        }

        Texture2D Made(string key, Func<Texture2D> make)
        {
            Texture2D texture;
            if (!made.TryGetValue(key, out texture))
            {
                texture = make();
                made.Add(key, texture);
                if (texture != null) { store("texture " + key, texture); }
            }
            return texture;
        }

        Texture2D Loaded(TextureData source, bool isLinear)
        {
            Texture2D texture = Decoded(source, isLinear);
            return texture == null ? null : Finished(texture, source);
        }

        Texture2D Decoded(TextureData source, bool isLinear)
        {
            var texture = new Texture2D(2, 2, TextureFormat.RGBA32, true, isLinear);
            if (texture.LoadImage(stage.Read(source.Identifier))) { return texture; }
            report.Add("images other than PNG and JPEG are left out", source.AssetPath);
            UnityEngine.Object.DestroyImmediate(texture);
            return null;
        }

        Pixels Read(TextureData source)
        {
            Pixels pixels;
            if (!read.TryGetValue(source.Identifier, out pixels))
            {
                Texture2D texture = Decoded(source, true);
                if (texture != null)
                {
                    Color32[] values = texture.GetPixels32();
                    pixels = new Pixels { Width = texture.width, Height = texture.height, Values = values };
                    UnityEngine.Object.DestroyImmediate(texture);
                }
                read.Add(source.Identifier, pixels);
            }
            return pixels;
        }

        Texture2D Written(Pixels size, Color32[] values, TextureData source, bool isLinear)
        {
            var texture = new Texture2D(size.Width, size.Height, TextureFormat.RGBA32, true, isLinear);
            texture.SetPixels32(values);
            texture.Apply(true, false);
            return Finished(texture, source);
        }

        Texture2D Finished(Texture2D texture, TextureData source)
        {
            string path = source.AssetPath;
            texture.name = path.Substring(path.LastIndexOf('/') + 1);
            texture.wrapModeU = Wrap(source.WrapS, path);
            texture.wrapModeV = Wrap(source.WrapT, path);
            texture.anisoLevel = Anisotropy;
            if (compresses && texture.width % 4 == 0 && texture.height % 4 == 0) { texture.Compress(true); }
            if (!keepsPixels) { texture.Apply(false, true); }
            return texture;
        }

        TextureWrapMode Wrap(string mode, string path)
        {
            if (mode == "black") { report.Add("textures are clamped where they should be black outside", path); }
            if (mode == "mirror") { return TextureWrapMode.Mirror; }
            return mode == "clamp" || mode == "black" ? TextureWrapMode.Clamp : TextureWrapMode.Repeat;
        }
    }
}
