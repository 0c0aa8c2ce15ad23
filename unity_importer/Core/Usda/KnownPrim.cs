namespace Garage.Usd
{
    /// <summary>A prim without children that was read from a place of a text, for equal text at other places.</summary>
    sealed class KnownPrim
    {
        // in bytes; a longer prim is read anew, so that comparing is never much of the work
        const int Longest = 2048;

        /// <summary>What all prims with this text share.</summary>
        public PrimSpec Prim { get; private set; }

        /// <summary>Of its text, in bytes.</summary>
        public int Length { get; private set; }

        int start;

        /// <summary>Whether a prim is such a one: short, and with nothing below it.</summary>
        public static bool MayBe(PrimSpec prim, int length)
        {
            return length <= Longest && prim.Children.Count == 0 && prim.VariantSets == null;
        }

        /// <summary>Takes the place of what was known before.</summary>
        public void Set(PrimSpec prim, int start, int length)
        {
            Prim = prim;
            this.start = start;
            Length = length;
        }

        /// <summary>Whether the same text is at another place of a text that has so many bytes.</summary>
        public bool IsAt(byte[] text, int place, int end)
        {
            return Length <= end - place && ByteRuns.AreEqual(text, start, place, Length);
        }
    }
}
