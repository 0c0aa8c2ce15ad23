using System;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Colors of what glows for its heat.</summary>
    static class Blackbody
    {
        /// <summary>Linear Rec. 709 of luminance 1 for 1000 to 10000 kelvin; what lies outside of the colors of a
        /// screen is cut off.</summary>
        public static Color Color(float kelvin)
        {
            double t = Math.Max(1667, Math.Min(25000, kelvin)), x, y;
            // the Planckian locus by the cubic fits of Kim, Cho, Ihm and Kim, 2002
            if (t <= 4000) { x = -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910; }
            else { x = -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + 0.2226347e3 / t + 0.240390; }
            if (t <= 2222) { y = -1.1063814 * x * x * x - 1.34811020 * x * x + 2.18555832 * x - 0.20219683; }
            else if (t <= 4000) { y = -0.9549476 * x * x * x - 1.37418593 * x * x + 2.09137015 * x - 0.16748867; }
            else { y = 3.0817580 * x * x * x - 5.87338670 * x * x + 3.75112997 * x - 0.37001483; }
            double big = x / y, small = (1 - x - y) / y;
            double r = Math.Max(0, 3.2404542 * big - 1.5371385 - 0.4985314 * small),
                g = Math.Max(0, -0.9692660 * big + 1.8760108 + 0.0415560 * small);
            double b = Math.Max(0, 0.0556434 * big - 0.2040259 + 1.0572252 * small);
            double luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            return new Color((float)(r / luminance), (float)(g / luminance), (float)(b / luminance));
        }
    }
}
