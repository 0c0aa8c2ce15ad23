using System;

namespace Garage.Usd
{
    /// <summary>Looks at eight bytes of a text at a time, several times as fast as at each.</summary>
    static class ByteRuns
    {
        /// <summary>Eight spaces.</summary>
        public const ulong Spaces = 0x2020202020202020;

        const ulong Newlines = 0x0A0A0A0A0A0A0A0A;
        const ulong Ones = 0x0101010101010101;
        const ulong Highest = 0x8080808080808080;

        /// <summary>The eight bytes from a place, all of which are there.</summary>
        public static ulong Eight(byte[] text, int start)
        {
            return (ulong)BitConverter.ToInt64(text, start);
        }

        /// <summary>Whether any of eight bytes is a newline.</summary>
        public static bool HasNewline(ulong eight)
        {
            // those that are 0 borrow from the bit above
            ulong zeros = eight ^ Newlines;
            return ((zeros - Ones) & ~zeros & Highest) != 0;
        }

        /// <summary>Whether the same bytes are at both places.</summary>
        public static bool AreEqual(byte[] text, int first, int second, int length)
        {
            int stop = first + length;
            for (; first + 8 <= stop; first += 8, second += 8)
            {
                if (BitConverter.ToInt64(text, first) != BitConverter.ToInt64(text, second)) { return false; }
            }
            for (; first < stop; first++, second++)
            {
                if (text[first] != text[second]) { return false; }
            }
            return true;
        }
    }
}
