using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>A texture as a UsdUVTexture reads it.</summary>
    public sealed class TextureData
    {
        /// <summary>For UsdStage.Read; null where the file is missing.</summary>
        public string Identifier;

        /// <summary>As the layer names it.</summary>
        public string AssetPath;

        /// <summary>"r", "g", "b", "a" or "rgb".</summary>
        public string Channel;

        /// <summary>"repeat", "mirror", "clamp", "black" or "useMetadata"; "raw", "sRGB" or "auto".</summary>
        public string WrapS, WrapT, SourceColorSpace;

        /// <summary>Four numbers each: a pixel times Scale plus Bias; what stands for a missing file.</summary>
        public float[] Scale, Bias, Fallback;

        /// <summary>The primvar with the texture coordinates.</summary>
        public string Primvar = "st";

        /// <summary>UsdTransform2d: scale, then rotation, then translation.</summary>
        public float[] CoordinateScale = { 1, 1 };

        /// <summary>UsdTransform2d: counterclockwise.</summary>
        public float CoordinateRotationDegrees;

        /// <summary>UsdTransform2d.</summary>
        public float[] CoordinateTranslation = { 0, 0 };
    }

    /// <summary>A number, a color, a texture or a primvar.</summary>
    public sealed class MaterialInput
    {
        /// <summary>The constant; null where none is given.</summary>
        public float[] Value;

        /// <summary>The constant of an input that is a word, such as "opacityMode".</summary>
        public string Text;

        /// <summary>Null where the value comes from no texture.</summary>
        public TextureData Texture;

        /// <summary>Name of the primvar that gives the value.</summary>
        public string Primvar;
    }

    /// <summary>A UsdPreviewSurface.</summary>
    public sealed class MaterialData
    {
        const int LongestConnection = 16;

        /// <summary>Path of the material.</summary>
        public string Path { get; private set; }

        /// <summary>By name: "diffuseColor", "roughness"; only what is given.</summary>
        public Dictionary<string, MaterialInput> Inputs { get; private set; }

        // UsdPreviewSurface's own values for what is not given
        static readonly Dictionary<string, float[]> Fallbacks = new Dictionary<string, float[]>
        {
            { "diffuseColor", new[] { 0.18f, 0.18f, 0.18f } }, { "emissiveColor", new float[3] },
            { "useSpecularWorkflow", new float[1] },
            { "specularColor", new float[3] }, { "metallic", new float[1] }, { "roughness", new[] { 0.5f } },
            { "clearcoat", new float[1] },
            { "clearcoatRoughness", new[] { 0.01f } }, { "opacity", new[] { 1f } },
            { "opacityThreshold", new float[1] },
            { "ior", new[] { 1.5f } }, { "normal", new[] { 0f, 0f, 1f } }, { "displacement", new float[1] },
            { "occlusion", new[] { 1f } },
        };

        /// <summary>The constant of an input, or UsdPreviewSurface's fallback.</summary>
        public float[] Value(string input)
        {
            MaterialInput found;
            float[] fallback;
            if (Inputs.TryGetValue(input, out found) && found.Value != null) { return found.Value; }
            return Fallbacks.TryGetValue(input, out fallback) ? fallback : new float[1];
        }

        /// <summary>The texture of an input; null where it has none.</summary>
        public TextureData Texture(string input)
        {
            MaterialInput found;
            return Inputs.TryGetValue(input, out found) ? found.Texture : null;
        }

        /// <summary>The preview surface of a material; null where it has none.</summary>
        public static MaterialData Of(UsdStage stage, UsdPrim material)
        {
            UsdPrim shader = null;
            UsdProperty output = material.Property("outputs:surface");
            for (int i = 0; output != null && i < LongestConnection; i++)
            {
                IList<string> targets = output.Targets;
                if (targets.Count == 0) { break; }
                shader = stage.PrimAt(UsdPaths.Prim(targets[0]));
                if (shader == null || shader.TypeName == "Shader") { break; }
                output = shader.Property(PropertyName(targets[0]));
            }
            if (shader == null || shader.Text("info:id", "") != "UsdPreviewSurface") { return null; }
            var data = new MaterialData { Path = material.Path, Inputs = new Dictionary<string, MaterialInput>() };
            foreach (string name in shader.PropertyNames)
            {
                if (name.StartsWith("inputs:", StringComparison.Ordinal))
                {
                    data.Inputs[name.Substring(7)] = Input(stage, shader, name);
                }
            }
            return data;
        }

        static string PropertyName(string path)
        {
            return path.Substring(UsdPaths.Prim(path).Length).TrimStart('.');
        }

        // follows connections to where a value comes from: the place of it, or a shader
        static UsdProperty Source(UsdStage stage, UsdPrim prim, string name, out UsdPrim shader, out string output)
        {
            shader = null;
            output = null;
            UsdProperty property = prim.Property(name);
            for (int i = 0; property != null && i < LongestConnection; i++)
            {
                IList<string> targets = property.Targets;
                if (targets.Count == 0) { return property; }
                UsdPrim target = stage.PrimAt(UsdPaths.Prim(targets[0]));
                if (target == null) { return property; }
                output = PropertyName(targets[0]);
                if (target.TypeName == "Shader" && output.StartsWith("outputs:", StringComparison.Ordinal))
                {
                    shader = target;
                    return property;
                }
                property = target.Property(output);
            }
            return property;
        }

        static MaterialInput Input(UsdStage stage, UsdPrim prim, string name)
        {
            var input = new MaterialInput();
            UsdPrim shader;
            string output;
            UsdProperty place = Source(stage, prim, name, out shader, out output);
            UsdValue value = place == null ? null : place.Value;
            if (value != null && !(value.Data is string[])) { input.Value = value.Floats(); }
            if (value != null) { input.Text = value.Text; }
            if (shader == null) { return input; }
            string id = shader.Text("info:id", "");
            if (id == "UsdUVTexture") { input.Texture = TextureOf(stage, shader, output.Substring(8)); }
            else if (id.StartsWith("UsdPrimvarReader", StringComparison.Ordinal))
            {
                input.Primvar = TextOf(stage, shader, "inputs:varname", "");
                // what a reader gives where there is no primvar
                UsdPrim from;
                UsdProperty fallback = Source(stage, shader, "inputs:fallback", out from, out output);
                UsdValue otherwise = fallback == null ? null : fallback.Value;
                if (otherwise != null && !(otherwise.Data is string[])) { input.Value = otherwise.Floats(); }
            }
            return input;
        }

        static string TextOf(UsdStage stage, UsdPrim prim, string name, string otherwise)
        {
            UsdPrim shader;
            string output;
            UsdProperty place = Source(stage, prim, name, out shader, out output);
            UsdValue value = place == null ? null : place.Value;
            return value == null ? otherwise : value.Text ?? otherwise;
        }

        static float[] FloatsOf(UsdStage stage, UsdPrim prim, string name, float[] otherwise)
        {
            UsdPrim shader;
            string output;
            UsdProperty place = Source(stage, prim, name, out shader, out output);
            UsdValue value = place == null ? null : place.Value;
            return value == null || value.Data.Length < otherwise.Length ? otherwise : value.Floats();
        }

        static TextureData TextureOf(UsdStage stage, UsdPrim texture, string channel)
        {
            var data = new TextureData
            {
                Channel = channel, WrapS = TextOf(stage, texture, "inputs:wrapS", "useMetadata"),
                WrapT = TextOf(stage, texture, "inputs:wrapT", "useMetadata"),
                SourceColorSpace = TextOf(stage, texture, "inputs:sourceColorSpace", "auto"),
                Scale = FloatsOf(stage, texture, "inputs:scale", new[] { 1f, 1, 1, 1 }),
                Bias = FloatsOf(stage, texture, "inputs:bias", new float[4]),
                Fallback = FloatsOf(stage, texture, "inputs:fallback", new[] { 0f, 0, 0, 1 }),
            };
            UsdPrim shader;
            string output;
            UsdProperty file = Source(stage, texture, "inputs:file", out shader, out output);
            if (file != null && file.Value != null)
            {
                string reason;
                data.AssetPath = file.Value.Text;
                data.Identifier = file.ResolvedAsset(out reason);
                if (data.Identifier == null)
                {
                    stage.Composer.Library.Warn("<" + texture.Path + ">: @" + data.AssetPath + "@ " + reason);
                }
            }
            UsdPrim reader;
            Source(stage, texture, "inputs:st", out reader, out output);
            for (int i = 0; i < LongestConnection && reader != null
                && reader.Text("info:id", "") == "UsdTransform2d"; i++)
            {
                Precede(data, stage, reader);
                UsdPrim transform = reader;
                Source(stage, transform, "inputs:in", out reader, out output);
            }
            if (reader != null) { data.Primvar = TextOf(stage, reader, "inputs:varname", "st"); }
            return data;
        }

        // puts a transform before those that were found: what they scale and move is what it makes of the coordinates
        static void Precede(TextureData data, UsdStage stage, UsdPrim transform)
        {
            float[] scale = FloatsOf(stage, transform, "inputs:scale", new[] { 1f, 1 });
            float[] translation = FloatsOf(stage, transform, "inputs:translation", new float[2]);
            float rotation = FloatsOf(stage, transform, "inputs:rotation", new float[1])[0];
            var moved = new float[2];
            double angle = data.CoordinateRotationDegrees * Math.PI / 180;
            double x = translation[0] * data.CoordinateScale[0], y = translation[1] * data.CoordinateScale[1];
            moved[0] = (float)(x * Math.Cos(angle) - y * Math.Sin(angle)) + data.CoordinateTranslation[0];
            moved[1] = (float)(x * Math.Sin(angle) + y * Math.Cos(angle)) + data.CoordinateTranslation[1];
            bool isEven = data.CoordinateScale[0] == data.CoordinateScale[1];
            if (rotation != 0 && !isEven)
            {
                stage.Composer.Library.Warn("<" + transform.Path
                    + "> turns texture coordinates that are then scaled by axis: they are scaled first");
            }
            data.CoordinateTranslation = moved;
            data.CoordinateScale = new[] { data.CoordinateScale[0] * scale[0], data.CoordinateScale[1] * scale[1] };
            data.CoordinateRotationDegrees += rotation;
        }
    }
}
