using System;

namespace Garage.Usd
{
    /// <summary>One layer from its bytes, in whichever format these are.</summary>
    public static class LayerReader
    {
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
