using System;

namespace Garage.Usd
{
    /// <summary>The one exception of the readers: which file, where in it, and what is wrong.</summary>
    public sealed class UsdFormatException : Exception
    {
        /// <summary>The layer or package.</summary>
        public string File { get; private set; }

        /// <summary>A line ("line 12"), a section ("PATHS"), or a prim path.</summary>
        public string Place { get; private set; }

        /// <summary>What is wrong there.</summary>
        public string Reason { get; private set; }

        /// <summary>Of a file, a place in it and a reason.</summary>
        public UsdFormatException(string file, string place, string reason)
            : base(file + ": " + place + ": " + reason)
        {
            File = file;
            Place = place;
            Reason = reason;
        }
    }
}
