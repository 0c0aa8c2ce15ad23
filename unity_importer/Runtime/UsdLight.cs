using System;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>What the stage says of a light, whatever stands for it here. Lengths are metres of the scene.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/USD Light")]
    public sealed class UsdLight : MonoBehaviour
    {
        [Tooltip("Rect, Disk, Sphere, Cylinder, Distant or Dome.")]
        public LightKind kind;

        [Tooltip("Linear.")]
        public Color color = Color.white;

        public float intensity;
        public float exposure;
        public bool isNormalized;
        public float width;
        public float height;
        public float radius;
        public float length;

        [Tooltip("Degrees that a distant light spans.")]
        public float angle;

        [Tooltip("Half of the cone, in degrees; 90 where the light is not shaped.")]
        public float coneAngle = 90;

        [Tooltip("Kelvin; 0 where the color alone counts.")]
        public float colorTemperature;

        [Tooltip("Units of the stage a square metre; candela where one unit is one.")]
        public float luminance;

        [Tooltip("Straight ahead, in units of the stage; 0 for lights at infinity.")]
        public float candela;

        [Tooltip("Of a light with an area, in units of the stage.")]
        public float lumen;

        [Tooltip("On a surface that faces a distant light, in units of the stage.")]
        public float lux;

        [Tooltip("What garage:light:luminance says: the true candela a square metre; 0 where it is not said.")]
        public float statedLuminance;

        /// <summary>Fills this from a prim's light.</summary>
        internal void Set(LightData light, double metersPerUnit, double stated)
        {
            kind = light.Kind;
            color = new Color(light.Color[0], light.Color[1], light.Color[2]);
            intensity = (float)light.Intensity;
            exposure = (float)light.Exposure;
            isNormalized = light.IsNormalized;
            width = (float)(light.Width * metersPerUnit);
            height = (float)(light.Height * metersPerUnit);
            radius = (float)(light.Radius * metersPerUnit);
            length = (float)(light.Length * metersPerUnit);
            angle = (float)light.AngleDegrees;
            coneAngle = (float)light.ConeAngleDegrees;
            colorTemperature = (float)light.ColorTemperature;
            luminance = (float)light.Luminance(metersPerUnit);
            candela = (float)light.Candela(metersPerUnit);
            lumen = (float)light.Lumen(metersPerUnit);
            lux = (float)light.Lux;
            statedLuminance = (float)stated;
        }
    }
}
