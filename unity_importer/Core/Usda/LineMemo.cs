using System;

namespace Garage.Usd
{
    /// <summary>
    /// What whole lines of a text were read as, so that equal lines are read once and share what they say.
    /// </summary>
    sealed class LineMemo
    {
        const int Longest = 256;
        const int Slots = 4096;

        readonly byte[] text;
        readonly int end;
        readonly int[] starts = new int[Slots];
        readonly int[] lengths = new int[Slots];
        readonly object[] values = new object[Slots];
        readonly bool[] wasFound = new bool[Slots];
        int lastStart = -1, lastStop, lastSlot;

        /// <summary>The text needs a byte behind its end.</summary>
        public LineMemo(byte[] text, int end)
        {
            this.text = text;
            this.end = end;
        }

        /// <summary>What the line from here was read as, or null; stop is where the line ends.</summary>
        public object Find(int start, out int stop)
        {
            byte[] s = text;
            stop = Array.IndexOf(s, (byte)'\n', start, Math.Min(Longest, end - start));
            lastStart = -1;
            if (stop < 0) { return null; }
            int length = stop - start, hash = length;
            for (int i = start; i < stop; i += 3) { hash = hash * 31 + s[i]; }
            int slot = (hash ^ hash >> 12) & (Slots - 1);
            lastStart = start;
            lastStop = stop;
            lastSlot = slot;
            if (values[slot] == null || lengths[slot] != length) { return null; }
            for (int i = start, other = starts[slot]; i < stop; i++, other++)
            {
                if (s[i] != s[other]) { return null; }
            }
            wasFound[slot] = true;
            return values[slot];
        }

        /// <summary>
        /// Keeps what the line was read as that Find looked for last, if it began and ended at these places and does
        /// not depend on where it stands.
        /// </summary>
        public void Keep(int start, int stop, object value)
        {
            if (start != lastStart || stop != lastStop) { return; }
            // a line that has been of use stays for one more
            if (wasFound[lastSlot])
            {
                wasFound[lastSlot] = false;
                return;
            }
            for (int i = start; i < stop; i++)
            {
                // a relative path
                if ((text[i] == '<' && text[i + 1] != '/') || (text[i] == '.' && text[i + 1] == '.')) { return; }
            }
            starts[lastSlot] = start;
            lengths[lastSlot] = stop - start;
            values[lastSlot] = value;
        }
    }
}
