using System;
using System.Collections.Generic;
using System.Text;

namespace Garage.Usd
{
    /// <summary>A .usdz: a zip whose entries are stored without compression.</summary>
    public sealed class UsdzPackage
    {
        const int MostEntries = 65535;

        readonly byte[] bytes;
        readonly Dictionary<string, KeyValuePair<int, int>> entries = new Dictionary<string, KeyValuePair<int, int>>();

        /// <summary>The layer that stands for the package.</summary>
        public string First { get; private set; }

        /// <summary>Reads the directory of the package. Throws UsdFormatException.</summary>
        public UsdzPackage(byte[] bytes, string file)
        {
            this.bytes = bytes;
            int end = -1;
            for (int i = bytes.Length - 22; i >= 0 && i >= bytes.Length - 22 - 65535 && end < 0; i--)
            {
                if (UInt(i) == 0x06054b50) { end = i; }
            }
            if (end < 0) { throw new UsdFormatException(file, "end", "is no zip: it has no directory"); }
            int count = UShort(end + 10);
            long at = UInt(end + 16), firstPlace = long.MaxValue;
            for (int i = 0; i < count && i < MostEntries; i++)
            {
                string place = "entry " + (i + 1);
                if (at > bytes.Length - 46 || UInt((int)at) != 0x02014b50)
                {
                    throw new UsdFormatException(file, place, "the directory is damaged");
                }
                int entry = (int)at;
                int flags = UShort(entry + 8), method = UShort(entry + 10), nameLength = UShort(entry + 28);
                long packed = UInt(entry + 20), size = UInt(entry + 24), header = UInt(entry + 42);
                at += 46L + nameLength + UShort(entry + 30) + UShort(entry + 32);
                if (at > bytes.Length) { throw new UsdFormatException(file, place, "the directory is cut off"); }
                string name = Encoding.UTF8.GetString(bytes, entry + 46, nameLength);
                if (name.EndsWith("/", StringComparison.Ordinal)) { continue; }
                if (method != 0 || packed != size)
                {
                    throw new UsdFormatException(file, name, "is compressed; a usdz only stores");
                }
                if ((flags & 1) != 0) { throw new UsdFormatException(file, name, "is encrypted"); }
                if (AssetPaths.Normal("", name) != name)
                {
                    throw new UsdFormatException(file, name, "is no plain path within the package");
                }
                Add(file, name, header, size, nameLength, entry + 46);
                if (header < firstPlace)
                {
                    firstPlace = header;
                    First = name;
                }
            }
            if (First == null) { throw new UsdFormatException(file, "directory", "the package is empty"); }
        }

        void Add(string file, string name, long header, long size, int nameLength, int nameAt)
        {
            if (header > bytes.Length - 30 || UInt((int)header) != 0x04034b50)
            {
                throw new UsdFormatException(file, name, "has no header where the directory says");
            }
            int local = (int)header;
            bool same = UShort(local + 26) == nameLength && header + 30 + nameLength <= bytes.Length;
            for (int i = 0; same && i < nameLength; i++) { same = bytes[local + 30 + i] == bytes[nameAt + i]; }
            if (!same)
            {
                throw new UsdFormatException(file, name, "has another name in its header than in the directory");
            }
            long start = header + 30 + nameLength + UShort(local + 28);
            if (start + size > bytes.Length)
            {
                throw new UsdFormatException(file, name, "ends beyond the end of the package");
            }
            if (entries.ContainsKey(name)) { throw new UsdFormatException(file, name, "is in the package twice"); }
            entries.Add(name, new KeyValuePair<int, int>((int)start, (int)size));
        }

        /// <summary>Whether there is an entry of this name.</summary>
        public bool Has(string entry)
        {
            return entries.ContainsKey(entry);
        }

        /// <summary>The bytes of an entry that there is.</summary>
        public byte[] Read(string entry)
        {
            KeyValuePair<int, int> place = entries[entry];
            var data = new byte[place.Value];
            Buffer.BlockCopy(bytes, place.Key, data, 0, data.Length);
            return data;
        }

        int UShort(int place)
        {
            return bytes[place] | bytes[place + 1] << 8;
        }

        long UInt(int place)
        {
            return (uint)(UShort(place) | UShort(place + 2) << 16);
        }
    }
}
