namespace Garage.Usd
{
    /// <summary>
    /// What statements of a text were read as, by their first lines, so that equal ones are read once and share what
    /// they say.
    /// </summary>
    sealed class LineMemo
    {
        const int Longest = 256;
        const int SlotBits = 12;
        const ulong Mixer = 0x9E3779B97F4A7C15;

        readonly byte[] text;
        readonly int end;
        readonly int[] starts = new int[1 << SlotBits];
        readonly int[] lengths = new int[1 << SlotBits];
        readonly object[] values = new object[1 << SlotBits];
        readonly bool[] wasFound = new bool[1 << SlotBits];

        /// <summary>A line that was looked for.</summary>
        public struct Line
        {
            /// <summary>From its first byte to the newline.</summary>
            public int Start, Stop;

            /// <summary>Where it is kept; -1 where it is too long for that.</summary>
            public int Slot;
        }

        /// <summary>The text has a newline at its end.</summary>
        public LineMemo(byte[] text, int end)
        {
            this.text = text;
            this.end = end;
        }

        /// <summary>What the statement with the line from here was read as, or null.</summary>
        public object Find(int start, out Line line)
        {
            byte[] s = text;
            int stop = start, furthest = end - start > Longest ? start + Longest : end;
            ulong hash = 0;
            for (; stop + 8 <= furthest; stop += 8)
            {
                ulong eight = ByteRuns.Eight(s, stop);
                if (ByteRuns.HasNewline(eight)) { break; }
                hash = (hash ^ eight) * Mixer;
            }
            byte letter = s[stop];
            while (letter != '\n' && stop < furthest)
            {
                hash = (hash ^ letter) * Mixer;
                letter = s[++stop];
            }
            line.Start = start;
            line.Stop = stop;
            line.Slot = letter == '\n' ? (int)(hash >> (64 - SlotBits)) : -1;
            int slot = line.Slot;
            if (slot < 0 || values[slot] == null || lengths[slot] != stop - start) { return null; }
            if (!ByteRuns.AreEqual(s, starts[slot], start, stop - start)) { return null; }
            wasFound[slot] = true;
            return values[slot];
        }

        /// <summary>Keeps what the statement with a line was read as, which must be the same anywhere.</summary>
        public void Keep(Line line, object value)
        {
            int slot = line.Slot;
            if (slot < 0) { return; }
            // a line that has been of use stays for one more
            if (wasFound[slot])
            {
                wasFound[slot] = false;
                return;
            }
            starts[slot] = line.Start;
            lengths[slot] = line.Stop - line.Start;
            values[slot] = value;
        }
    }
}
