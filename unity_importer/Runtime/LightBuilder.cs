using System;
using Garage.Usd;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity
{
    /// <summary>Unity's lights for those of a stage.</summary>
    sealed class LightBuilder
    {
        /// <summary>
        /// Outer and inner angle of a spot that shines straight ahead as strongly as a flat panel and with as many
        /// lumens. Its strength falls off as ((cos a - cos o) / (cos i - cos o))^2 between the halves i and o of the
        /// angles, and to have pi lumens a candela cos i must be 3/4 - cos o / 2.
        /// </summary>
        const float PanelAngle = 160;

        const float PanelInnerAngle = 96.94f;

        /// <summary>What a light brings to a white surface where it ends; 1 is white.</summary>
        const float FaintestIlluminance = 0.05f;

        readonly Basis basis;
        readonly ImportSettings settings;
        readonly ImportReport report;
        readonly float factor, stops;

        public LightBuilder(Basis basis, ImportSettings settings, ImportReport report)
        {
            this.basis = basis;
            this.settings = settings;
            this.report = report;
            stops = Mathf.Pow(2, settings.exposureStops);
            // where shaders leave out the 1 / pi of a white surface, lights have it
            bool isPhysical = LitShader.Of(settings.pipeline) is HighDefinitionLit;
            factor = stops * (isPhysical ? settings.nitsPerUnit : 1 / Mathf.PI);
        }

        /// <summary>Whether a light may stand for this one in the settings' mode.</summary>
        public bool Makes(LightData light)
        {
            bool isInfinite = light.Kind == LightKind.Distant;
            return light.Kind != LightKind.Dome && (isInfinite || settings.lightMode != LightMode.EmissiveOnly);
        }

        /// <summary>Puts the light of a prim on an object that it may turn, so that the light shines where the prim's
        /// does.</summary>
        public void Add(GameObject holder, SceneNode node)
        {
            LightData data = node.Light;
            holder.AddComponent<UsdLight>().Set(data, basis.MetersPerUnit,
                node.Prim.Number("garage:light:luminance", 0));
            if (data.Kind == LightKind.Dome)
            {
                report.Add("dome lights are left out: the sky belongs to the scene", node.Prim.Path);
            }
            if (!Makes(data)) { return; }
            // USD's -Z is Unity's +Z where Y is up, and -Y where Z is
            if (basis.IsZUp)
            {
                holder.transform.localRotation = holder.transform.localRotation * Quaternion.Euler(90, 0, 0);
            }
            Light light = holder.AddComponent<Light>();
            light.shadows = settings.lightShadows ? LightShadows.Soft : LightShadows.None;
            float strength = Shape(light, data, node.Prim.Path);
            SetColor(light, data, strength);
            light.enabled = strength > 0;
            if (!light.enabled && data.Intensity > 0)
            {
                report.Add("lights without a size give no light, as they are not normalized", node.Prim.Path);
            }
        }

        float Shape(Light light, LightData data, string path)
        {
            double metres = basis.MetersPerUnit;
            if (data.Kind == LightKind.Distant)
            {
                light.type = LightType.Directional;
                return (float)data.Lux * factor;
            }
            bool isPanel = data.Kind == LightKind.Rect || data.Kind == LightKind.Disk;
            bool isRound = data.Kind == LightKind.Disk;
            Vector2 size = isRound ? new Vector2((float)(data.Radius * metres), 0)
                : new Vector2((float)(data.Width * metres), (float)(data.Height * metres));
            light.range = Range(data);
            bool hasArea = data.Area(metres) > 0;
            if (settings.lightMode == LightMode.BakedRectangle && isPanel && hasArea
                && EditorOnly.MakeBaked(light, isRound ? LightType.Disc : LightType.Rectangle, size))
            {
                return (float)data.Luminance(metres) * factor;
            }
            bool isShaped = data.ConeAngleDegrees < PanelAngle / 2;
            light.type = isPanel || isShaped ? LightType.Spot : LightType.Point;
            light.spotAngle = isShaped ? Mathf.Max(1, 2 * (float)data.ConeAngleDegrees) : PanelAngle;
            light.innerSpotAngle = isShaped ? light.spotAngle * (1 - Mathf.Clamp01((float)data.ConeSoftness))
                : PanelInnerAngle;
            if (data.Kind == LightKind.Cylinder)
            {
                report.Add("cylinder lights shine as points, as strongly as across their axes", path);
            }
            return (float)data.Candela(metres) * factor;
        }

        float Range(LightData data)
        {
            float strength = (float)data.Candela(basis.MetersPerUnit) / Mathf.PI * stops;
            return Mathf.Clamp(Mathf.Sqrt(strength / FaintestIlluminance), 1, 100);
        }

        static void SetColor(Light light, LightData data, float strength)
        {
            var color = new Color(data.Color[0], data.Color[1], data.Color[2]);
            if (data.ColorTemperature > 0)
            {
                Color heat = Blackbody.Color((float)data.ColorTemperature);
                color = new Color(color.r * heat.r, color.g * heat.g, color.b * heat.b);
            }
            float largest = color.maxColorComponent;
            if (!(largest > 0))
            {
                light.intensity = 0;
                return;
            }
            color = new Color(color.r / largest, color.g / largest, color.b / largest);
            strength *= largest;
            // of one that is off, too: whoever turns it on finds it there
            light.color = color.gamma;
            // otherwise Unity takes color times intensity for a color of the screen
            if (strength > 0 && !GraphicsSettings.lightsUseLinearIntensity
                && QualitySettings.activeColorSpace == ColorSpace.Linear)
            {
                Color shown = new Color(color.r * strength, color.g * strength, color.b * strength).gamma;
                strength = shown.maxColorComponent;
                light.color = new Color(shown.r / strength, shown.g / strength, shown.b / strength);
            }
            light.intensity = strength;
        }

        /// <summary>The glowing surface of a panel, where nothing else beside it glows; null for other lights,
        /// and for one without a size.</summary>
        public static MeshArrays Panel(LightData light)
        {
            bool isPanel = light.Kind == LightKind.Rect || light.Kind == LightKind.Disk;
            if (!isPanel || !(light.Area(1) > 0)) { return null; }
            int count = light.Kind == LightKind.Rect ? 4 : 32;
            var arrays = new MeshArrays
            {
                Name = light.Kind.ToString(), Points = new float[3 * count], Normals = new float[3 * count],
            };
            for (int i = 0; i < count; i++)
            {
                double angle = 2 * Math.PI * i / count;
                bool isRound = count > 4;
                arrays.Points[3 * i] = (float)(isRound ? light.Radius * Math.Cos(angle)
                    : (i == 1 || i == 2 ? 0.5 : -0.5) * light.Width);
                arrays.Points[3 * i + 1] = (float)(isRound ? light.Radius * Math.Sin(angle)
                    : (i >= 2 ? 0.5 : -0.5) * light.Height);
                arrays.Normals[3 * i + 2] = -1;
            }
            var triangles = new int[3 * (count - 2)];
            for (int i = 0; i < count - 2; i++)
            {
                triangles[3 * i + 1] = i + 2;
                triangles[3 * i + 2] = i + 1;
            }
            arrays.Triangles.Add(triangles);
            return arrays;
        }

        /// <summary>What such a panel looks like.</summary>
        public SurfaceData Glow(LightData light)
        {
            SurfaceData surface = SurfaceData.OfColor(new float[3]);
            float luminance = (float)light.Luminance(basis.MetersPerUnit);
            surface.Emission = new Color(light.Color[0] * luminance, light.Color[1] * luminance,
                light.Color[2] * luminance);
            return surface;
        }
    }
}
