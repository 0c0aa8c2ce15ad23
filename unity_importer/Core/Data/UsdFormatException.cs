using System;

namespace Garage.Usd
{
    /// <summary>The one exception of the readers: which file, where in it, and what is wrong.</summary>
    public sealed class UsdFormatException : Exception
    {
        public string File { get; private set; }

        /// <summary>A line ("line 12"), a section ("PATHS"), or a prim path.</summary>
        public string Place { get; private set; }

        public string Reason { get; private set; }

        public UsdFormatException(string file, string place, string reason)
            : base(file + ": " + place + ": " + reason)
        {
            File = file;
            Place = place;
            Reason = reason;
        }
    }
}
