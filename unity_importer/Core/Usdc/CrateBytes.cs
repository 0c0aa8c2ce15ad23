using System;

namespace Garage.Usd
{
    /// <summary>The bytes of a crate: numbers at places, compressed blocks, and how much may come of them.</summary>
    sealed class CrateBytes
    {
        // what all values of a layer may take: crates compress well, but none by this much
        const long LeastBudget = 256L << 20;
        const long BudgetPerByte = 64;

        static float[] halves;

        readonly byte[] bytes;
        readonly string file;
        long budget;
        byte[] unpacked = new byte[0];

        public CrateBytes(byte[] bytes, string file)
        {
            this.bytes = bytes;
            this.file = file;
            budget = LeastBudget + BudgetPerByte * bytes.Length;
        }

        public int Length
        {
            get { return bytes.Length; }
        }

        public UsdFormatException Error(long place, string reason)
        {
            return new UsdFormatException(file, "byte " + place, reason);
        }

        /// <summary>Accounts for memory that a value takes, before it is taken.</summary>
        public void Charge(long place, long size)
        {
            budget -= size;
            if (budget < 0)
            {
                throw Error(place, "the values of the file take more memory than a file of this size can need");
            }
        }

        void Check(long place, long size)
        {
            if (place < 0 || size < 0 || place > bytes.Length - size)
            {
                throw Error(place, "the file ends before what is here");
            }
        }

        public byte Byte(long place)
        {
            Check(place, 1);
            return bytes[place];
        }

        public int Int(long place)
        {
            Check(place, 4);
            int i = (int)place;
            return bytes[i] | bytes[i + 1] << 8 | bytes[i + 2] << 16 | bytes[i + 3] << 24;
        }

        public long Long(long place)
        {
            return (uint)Int(place) | (long)Int(place + 4) << 32;
        }

        public double Double(long place)
        {
            return BitConverter.Int64BitsToDouble(Long(place));
        }

        /// <summary>A count of things of which each takes some bytes of the file.</summary>
        public int Count(long place, int sizeOfEach)
        {
            long count = Long(place);
            if (count < 0 || count > (bytes.Length - place) / sizeOfEach)
            {
                throw Error(place, "a count of " + count + " is more than the file holds");
            }
            return (int)count;
        }

        /// <summary>Copies plain numbers into an array, whose element size is given.</summary>
        public void Copy(long place, Array into, int elementSize)
        {
            Check(place, (long)into.Length * elementSize);
            Buffer.BlockCopy(bytes, (int)place, into, 0, into.Length * elementSize);
        }

        public float[] Halves(long place, int count)
        {
            Check(place, 2L * count);
            Charge(place, 4L * count);
            float[] table = HalfTable();
            var floats = new float[count];
            int at = (int)place;
            for (int i = 0; i < count; i++, at += 2) { floats[i] = table[bytes[at] | bytes[at + 1] << 8]; }
            return floats;
        }

        static float[] HalfTable()
        {
            if (halves == null)
            {
                var made = new float[65536];
                for (int i = 0; i < made.Length; i++) { made[i] = HalfNumber.OfBits(i); }
                halves = made;
            }
            return halves;
        }

        /// <summary>A compressed block of known size; the result is valid until the next call.</summary>
        public byte[] Unpack(long place, long packedSize, long size)
        {
            return Unpack(place, packedSize, size, size);
        }

        /// <summary>A compressed block of a size between two; the result is valid until the next call.</summary>
        byte[] Unpack(long place, long packedSize, long least, long most)
        {
            Check(place, packedSize);
            // LZ4 makes at most 255 bytes of one
            if (packedSize < 1 || least < 0 || least > 255 * packedSize)
            {
                throw Error(place, "a compressed block is too short for what it should hold");
            }
            most = Math.Min(most, 255 * packedSize + 64);
            if (most > int.MaxValue - 64) { throw Error(place, "a compressed block is too large"); }
            if (unpacked.Length < most + 8)
            {
                Charge(place, most + 8);
                unpacked = new byte[most + 8];
            }
            long end = place + packedSize;
            int chunks = bytes[place++];
            long written = 0;
            if (chunks == 0)
            {
                written = Lz4(place, end, 0, most);
            }
            for (int chunk = 0; chunk < chunks; chunk++)
            {
                int size = Int(place);
                place += 4;
                if (size < 0 || size > end - place)
                {
                    throw Error(place, "a compressed chunk is longer than its block");
                }
                written = Lz4(place, place + size, written, most);
                place += size;
            }
            if (written < least) { throw Error(place, "a compressed block holds less than it should"); }
            Array.Clear(unpacked, (int)written, (int)Math.Min(most - written + 8, 8));
            unpackedCount = written;
            return unpacked;
        }

        long unpackedCount;

        long Lz4(long from, long fromEnd, long to, long toEnd)
        {
            byte[] source = bytes, target = unpacked;
            int at = (int)from, end = (int)fromEnd, written = (int)to, limit = (int)toEnd, first = (int)to;
            while (at < end)
            {
                int token = source[at++];
                int length = token >> 4;
                if (length == 15)
                {
                    int more;
                    do
                    {
                        if (at >= end) { throw Error(at, "a compressed block is cut off"); }
                        more = source[at++];
                        length += more;
                    }
                    while (more == 255 && length < limit);
                }
                if (length > end - at || length > limit - written) { throw Error(at, "a compressed block is damaged"); }
                if (length < 16)
                {
                    for (int i = 0; i < length; i++) { target[written + i] = source[at + i]; }
                }
                else
                {
                    Buffer.BlockCopy(source, at, target, written, length);
                }
                at += length;
                written += length;
                if (at >= end) { break; }
                if (at + 2 > end) { throw Error(at, "a compressed block is cut off"); }
                int back = source[at] | source[at + 1] << 8;
                at += 2;
                length = token & 15;
                if (length == 15)
                {
                    int more;
                    do
                    {
                        if (at >= end) { throw Error(at, "a compressed block is cut off"); }
                        more = source[at++];
                        length += more;
                    }
                    while (more == 255 && length < limit);
                }
                length += 4;
                if (back == 0 || back > written - first || length > limit - written)
                {
                    throw Error(at, "a compressed block is damaged");
                }
                int match = written - back;
                if (back >= length && length > 32)
                {
                    Buffer.BlockCopy(target, match, target, written, length);
                }
                else
                {
                    for (int i = 0; i < length; i++) { target[written + i] = target[match + i]; }
                }
                written += length;
            }
            return written;
        }

        /// <summary>Integers behind the size of their compressed block; place moves behind it.</summary>
        public int[] PackedInts(ref long place, int count)
        {
            long size = Long(place);
            long start = place + 8;
            Check(start, size);
            place = start + size;
            if (count == 0) { return new int[0]; }
            int codes = (int)((2L * count + 7) / 8);
            byte[] from = Unpack(start, size, 4L + codes, 4L + codes + 4L * count);
            Charge(start, 4L * count);
            var numbers = new int[count];
            int common = from[0] | from[1] << 8 | from[2] << 16 | from[3] << 24;
            int at = 4 + codes, number = 0;
            long end = unpackedCount;
            for (int i = 0; i < count; i++)
            {
                switch (from[4 + (i >> 2)] >> (2 * (i & 3)) & 3)
                {
                    case 0: number += common; break;
                    case 1: number += (sbyte)from[at++]; break;
                    case 2:
                        number += (short)(from[at] | from[at + 1] << 8);
                        at += 2;
                        break;
                    default:
                        number += from[at] | from[at + 1] << 8 | from[at + 2] << 16 | from[at + 3] << 24;
                        at += 4;
                        break;
                }
                if (at > end) { throw Error(start, "compressed integers are cut off"); }
                numbers[i] = number;
            }
            return numbers;
        }

        /// <summary>As PackedInts, of 64 bits.</summary>
        public long[] PackedLongs(ref long place, int count)
        {
            long size = Long(place);
            long start = place + 8;
            Check(start, size);
            place = start + size;
            if (count == 0) { return new long[0]; }
            int codes = (int)((2L * count + 7) / 8);
            byte[] from = Unpack(start, size, 8L + codes, 8L + codes + 8L * count);
            Charge(start, 8L * count);
            var numbers = new long[count];
            long common = BitConverter.ToInt64(from, 0), number = 0, end = unpackedCount;
            int at = 8 + codes;
            for (int i = 0; i < count; i++)
            {
                int code = from[8 + (i >> 2)] >> (2 * (i & 3)) & 3;
                int width = code == 0 ? 0 : code == 1 ? 2 : code == 2 ? 4 : 8;
                if (at + width > end) { throw Error(start, "compressed integers are cut off"); }
                number += code == 0 ? common : code == 1 ? BitConverter.ToInt16(from, at)
                    : code == 2 ? BitConverter.ToInt32(from, at) : BitConverter.ToInt64(from, at);
                at += width;
                numbers[i] = number;
            }
            return numbers;
        }
    }
}
