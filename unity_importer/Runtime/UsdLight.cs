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
        /// <summary>Rect, Disk, Sphere, Cylinder, Distant or Dome.</summary>
        public LightKind kind;

        /// <summary>Linear.</summary>
        public Color color = Color.white;

        /// <summary>inputs:intensity.</summary>
        public float intensity;

        /// <summary>inputs:exposure: doublings of the intensity.</summary>
        public float exposure;

        /// <summary>Whether a larger light is no stronger.</summary>
        public bool isNormalized;

        /// <summary>Of a rectangle, along x.</summary>
        public float width;

        /// <summary>Of a rectangle, along y.</summary>
        public float height;

        /// <summary>Of a disk, a sphere or a cylinder.</summary>
        public float radius;

        /// <summary>Of a cylinder, along x.</summary>
        public float length;

        /// <summary>Degrees that a distant light spans.</summary>
        public float angle;

        /// <summary>Half of the cone, in degrees; 90 where the light is not shaped.</summary>
        public float coneAngle = 90;

        /// <summary>Kelvin; 0 where the color alone counts.</summary>
        public float colorTemperature;

        /// <summary>Units of the stage a square metre; candela where one unit is one.</summary>
        public float luminance;

        /// <summary>Straight ahead, in units of the stage; 0 for lights at infinity.</summary>
        public float candela;

        /// <summary>Of a light with an area, in units of the stage.</summary>
        public float lumen;

        /// <summary>On a surface that faces a distant light, in units of the stage.</summary>
        public float lux;

        /// <summary>What garage:light:luminance says: the true candela a square metre; 0 where it is not
        /// said.</summary>
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
