using System;

namespace Garage.Usd
{
    /// <summary>One layer from its bytes, in whichever format these are.</summary>
    public static class LayerReader
    {
        static readonly string[] Endings = { ".usd", ".usda", ".usdc" };

        /// <summary>Whether a name is that of a layer, and not of a format that is not read, such as .mtlx.</summary>
        public static bool Knows(string identifier)
        {
            string name = identifier.TrimEnd(']');
            return Array.Exists(Endings, one => name.EndsWith(one, StringComparison.OrdinalIgnoreCase));
        }

        /// <summary>Throws UsdFormatException, and nothing else, where the bytes are no layer.</summary>
        public static Layer Read(byte[] bytes, string identifier)
        {
            try
            {
                if (UsdaReader.Knows(bytes)) { return UsdaReader.Read(bytes, identifier); }
                if (CrateReader.Knows(bytes)) { return CrateReader.Read(bytes, identifier); }
            }
            catch (OutOfMemoryException)
            {
                throw new UsdFormatException(identifier, "values", "does not fit into memory");
            }
            throw new UsdFormatException(identifier, "byte 0", "is neither a text nor a crate layer");
        }
    }
}
