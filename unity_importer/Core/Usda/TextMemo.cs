using System.Text;

namespace Garage.Usd
{
    /// <summary>Strings made of the bytes of a text; short ones that come often are made once.</summary>
    sealed class TextMemo
    {
        readonly byte[] text;
        readonly char[] ascii = new char[128];
        string[] strings;
        int[] starts, lengths;
        int count;

        /// <summary>Of UTF-8, of which so many bytes count.</summary>
        public TextMemo(byte[] text, int length)
        {
            this.text = text;
            int slots = 1024;
            while (slots < 65536 && slots < length / 256) { slots *= 2; }
            MakeSlots(slots);
        }

        void MakeSlots(int size)
        {
            strings = new string[size];
            starts = new int[size];
            lengths = new int[size];
        }

        /// <summary>The string of some bytes.</summary>
        public string Decoded(int start, int length)
        {
            // plain ASCII needs no decoder, whose calls cost more than short texts
            if (length > ascii.Length) { return Encoding.UTF8.GetString(text, start, length); }
            byte[] s = text;
            for (int i = 0; i < length; i++)
            {
                byte letter = s[start + i];
                if (letter >= 128) { return Encoding.UTF8.GetString(s, start, length); }
                ascii[i] = (char)letter;
            }
            return new string(ascii, 0, length);
        }

        /// <summary>One string for equal bytes; hash is the sum of hash * 31 + byte.</summary>
        public string Shared(int start, int length, int hash)
        {
            hash ^= hash >> 15;
            int mask = strings.Length - 1;
            int slot = (hash ^ length) & mask;
            byte[] s = text;
            // few probes, as a file can be made to have colliding names
            for (int probes = 0; strings[slot] != null; probes++)
            {
                if (probes == 16) { return Decoded(start, length); }
                if (lengths[slot] == length)
                {
                    int other = starts[slot], i = 0;
                    while (i < length && s[other + i] == s[start + i]) { i++; }
                    if (i == length) { return strings[slot]; }
                }
                slot = (slot + 1) & mask;
            }
            string made = Decoded(start, length);
            strings[slot] = made;
            starts[slot] = start;
            lengths[slot] = length;
            if (++count * 2 > strings.Length) { Grow(); }
            return made;
        }

        void Grow()
        {
            string[] oldStrings = strings;
            int[] oldStarts = starts, oldLengths = lengths;
            MakeSlots(4 * strings.Length);
            int mask = strings.Length - 1;
            for (int i = 0; i < oldStrings.Length; i++)
            {
                if (oldStrings[i] == null) { continue; }
                int hash = 0;
                for (int k = 0; k < oldLengths[i]; k++) { hash = hash * 31 + text[oldStarts[i] + k]; }
                hash ^= hash >> 15;
                int slot = (hash ^ oldLengths[i]) & mask;
                while (strings[slot] != null) { slot = (slot + 1) & mask; }
                strings[slot] = oldStrings[i];
                starts[slot] = oldStarts[i];
                lengths[slot] = oldLengths[i];
            }
        }
    }
}
