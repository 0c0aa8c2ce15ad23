using System;

namespace Garage.Usd
{
    /// <summary>Decimal text to the nearest double, ties to even, the same on every runtime.</summary>
    public static class DecimalNumber
    {
        const int ReciprocalLimit = 54;
        const int MostDigits = 800;

        static readonly double[] ExactPowers =
        {
            1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
            1e19, 1e20, 1e21, 1e22,
        };

        // 5^q for q in -54..54, normalised to 128 bits; truncated for q >= 0, rounded up for q < 0
        static readonly ulong[] PowerHigh = new ulong[2 * ReciprocalLimit + 1];
        static readonly ulong[] PowerLow = new ulong[2 * ReciprocalLimit + 1];

        static DecimalNumber()
        {
            ulong high = 0, low = 1;
            for (int q = 0; q <= ReciprocalLimit; q++)
            {
                ulong normalHigh = high, normalLow = low;
                while (normalHigh >> 63 == 0)
                {
                    normalHigh = normalHigh << 1 | normalLow >> 63;
                    normalLow <<= 1;
                }
                PowerHigh[ReciprocalLimit + q] = normalHigh;
                PowerLow[ReciprocalLimit + q] = normalLow;
                if (q > 0) { StoreReciprocal(q, high, low); }
                // times five
                ulong twiceHigh = high << 2 | low >> 62;
                ulong twiceLow = low << 2;
                ulong sum = twiceLow + low;
                high = twiceHigh + high + (sum < twiceLow ? 1UL : 0UL);
                low = sum;
            }
        }

        static void StoreReciprocal(int q, ulong high, ulong low)
        {
            ulong restHigh = 0, restLow = 1, quotientHigh = 0, quotientLow = 0;
            while (quotientHigh >> 63 == 0)
            {
                restHigh = restHigh << 1 | restLow >> 63;
                restLow <<= 1;
                quotientHigh = quotientHigh << 1 | quotientLow >> 63;
                quotientLow <<= 1;
                if (restHigh > high || (restHigh == high && restLow >= low))
                {
                    restHigh -= high + (restLow < low ? 1UL : 0UL);
                    restLow -= low;
                    quotientLow |= 1;
                }
            }
            quotientLow++;
            if (quotientLow == 0) { quotientHigh++; }
            PowerHigh[ReciprocalLimit - q] = quotientHigh;
            PowerLow[ReciprocalLimit - q] = quotientLow;
        }

        /// <summary>
        /// digits * 10^exponent; the fast path that callers may inline is digits below 2^53, |exponent| up to 22.
        /// </summary>
        public static double Nearest(ulong digits, int exponent)
        {
            if (digits < 1UL << 53)
            {
                if (exponent == 0) { return digits; }
                if (exponent < 0 && exponent >= -22) { return digits / ExactPowers[-exponent]; }
                if (exponent > 0 && exponent <= 22) { return digits * ExactPowers[exponent]; }
            }
            if (digits == 0) { return 0; }
            double nearest;
            if (exponent >= -ReciprocalLimit && exponent <= ReciprocalLimit && ByProduct(digits, exponent, out nearest))
            {
                return nearest;
            }
            string text = digits.ToString(System.Globalization.CultureInfo.InvariantCulture);
            var bytes = new byte[text.Length];
            for (int i = 0; i < bytes.Length; i++) { bytes[i] = (byte)text[i]; }
            return Exact(bytes, bytes.Length, exponent);
        }

        /// <summary>The number in ASCII without sign: digits, perhaps a point, perhaps an exponent.</summary>
        public static double Parse(byte[] text, int start, int end)
        {
            var digits = new byte[Math.Min(end - start, MostDigits + 1)];
            int count = 0, exponent = 0, i = start;
            bool point = false, dropped = false;
            for (; i < end; i++)
            {
                byte letter = text[i];
                if (letter == '.')
                {
                    point = true;
                    continue;
                }
                if (letter < '0' || letter > '9') { break; }
                if (point) { exponent--; }
                if (count == 0 && letter == '0') { continue; }
                if (count < MostDigits)
                {
                    digits[count++] = letter;
                }
                else
                {
                    dropped |= letter != '0';
                    exponent++;
                }
            }
            if (i < end)
            {
                i++;
                bool negative = i < end && text[i] == '-';
                if (i < end && (text[i] == '-' || text[i] == '+')) { i++; }
                int power = 0;
                for (; i < end; i++) { power = Math.Min(power * 10 + (text[i] - '0'), 100000); }
                exponent += negative ? -power : power;
            }
            if (dropped) { digits[count - 1] |= 1; }
            return count == 0 ? 0 : Exact(digits, count, exponent);
        }

        static bool ByProduct(ulong digits, int exponent, out double nearest)
        {
            // Eisel and Lemire: the upper bits of digits * 5^exponent decide, but for a few cases left to Exact
            int zeros = 0;
            while (digits >> 63 == 0)
            {
                digits <<= 1;
                zeros++;
            }
            ulong low;
            ulong high = Product(digits, PowerHigh[ReciprocalLimit + exponent], out low);
            if ((high & 0x1FF) == 0x1FF)
            {
                ulong unused;
                ulong second = Product(digits, PowerLow[ReciprocalLimit + exponent], out unused);
                low += second;
                if (low < second) { high++; }
            }
            nearest = 0;
            if (low == ulong.MaxValue && exponent < -27) { return false; }
            int upper = (int)(high >> 63);
            ulong mantissa = high >> (upper + 9);
            int power = (((152170 + 65536) * exponent) >> 16) + 63 + upper - zeros + 1023;
            if (power <= 0 || power >= 2046) { return false; }
            if (low <= 1 && exponent >= -4 && exponent <= 23 && (mantissa & 3) == 1 && mantissa << (upper + 9) == high)
            {
                mantissa &= ~1UL;
            }
            mantissa += mantissa & 1;
            mantissa >>= 1;
            if (mantissa >= 2UL << 52)
            {
                mantissa = 1UL << 52;
                power++;
            }
            nearest = BitConverter.Int64BitsToDouble((long)((mantissa & ~(1UL << 52)) | (ulong)power << 52));
            return true;
        }

        static ulong Product(ulong a, ulong b, out ulong low)
        {
            ulong aHigh = a >> 32, aLow = a & 0xFFFFFFFF, bHigh = b >> 32, bLow = b & 0xFFFFFFFF;
            ulong lows = aLow * bLow, crossed = aHigh * bLow, other = aLow * bHigh;
            ulong middle = (lows >> 32) + (crossed & 0xFFFFFFFF) + (other & 0xFFFFFFFF);
            low = middle << 32 | (lows & 0xFFFFFFFF);
            return aHigh * bHigh + (crossed >> 32) + (other >> 32) + (middle >> 32);
        }

        static double Exact(byte[] digits, int count, int exponent)
        {
            if (count + exponent > 310) { return double.PositiveInfinity; }
            if (count + exponent < -326) { return 0; }
            // a guess that is off by a few units in the last place, then whole numbers decide
            double guess = 0;
            int taken = Math.Min(count, 17);
            for (int i = 0; i < taken; i++) { guess = guess * 10 + (digits[i] - '0'); }
            int power = exponent + count - taken;
            guess = power < -290 ? guess * Math.Pow(10, power + 100) * 1e-100 : guess * Math.Pow(10, power);
            if (double.IsInfinity(guess)) { guess = double.MaxValue; }
            long bits = BitConverter.DoubleToInt64Bits(guess);
            uint[] number = WholeNumber.OfDigits(digits, count);
            if (exponent > 0) { number = WholeNumber.TimesPowerOfFive(number, exponent); }
            while (CompareWithMiddle(number, exponent, bits) > 0) { bits++; }
            while (bits > 0 && CompareWithMiddle(number, exponent, bits - 1) < 0) { bits--; }
            // on the very middle between two: to the even one
            if (bits > 0 && (bits & 1) == 1 && CompareWithMiddle(number, exponent, bits - 1) == 0) { bits--; }
            if ((bits & 1) == 1 && CompareWithMiddle(number, exponent, bits) == 0) { bits++; }
            return BitConverter.Int64BitsToDouble(bits);
        }

        // the number against the middle between the double with these bits and the next one
        static int CompareWithMiddle(uint[] number, int exponent, long bits)
        {
            if (bits >= 0x7FF0000000000000) { return -1; }
            int biased = (int)(bits >> 52);
            ulong mantissa = (ulong)bits & 0xFFFFFFFFFFFFF;
            if (biased > 0) { mantissa |= 1UL << 52; }
            int shift = Math.Max(biased, 1) - 1075 - 1;
            ulong middle = 2 * mantissa + 1;
            // number * 10^exponent against middle * 2^shift; the fives of a positive exponent are in the number already
            var right = new[] { (uint)middle, (uint)(middle >> 32) };
            if (exponent < 0) { right = WholeNumber.TimesPowerOfFive(right, -exponent); }
            int shiftLeft = exponent - shift;
            uint[] left = number;
            if (shiftLeft > 0) { left = WholeNumber.ShiftLeft(left, shiftLeft); }
            if (shiftLeft < 0) { right = WholeNumber.ShiftLeft(right, -shiftLeft); }
            return WholeNumber.Compare(left, right);
        }
    }

    /// <summary>Natural numbers of any size, 32 bits a digit, least first.</summary>
    static class WholeNumber
    {
        public static uint[] OfDigits(byte[] digits, int count)
        {
            var number = new uint[count / 9 + 2];
            for (int i = 0; i < count; i++) { MultiplyAdd(number, 10, (uint)(digits[i] - '0')); }
            return number;
        }

        public static uint[] TimesPowerOfFive(uint[] number, int power)
        {
            var product = new uint[number.Length + power * 7 / 96 + 2];
            number.CopyTo(product, 0);
            for (; power >= 13; power -= 13) { MultiplyAdd(product, 1220703125, 0); }
            for (; power > 0; power--) { MultiplyAdd(product, 5, 0); }
            return product;
        }

        public static uint[] ShiftLeft(uint[] number, int shift)
        {
            int words = shift / 32, bits = shift % 32;
            var shifted = new uint[number.Length + words + 1];
            for (int i = 0; i < number.Length; i++)
            {
                ulong wide = (ulong)number[i] << bits;
                shifted[i + words] |= (uint)wide;
                shifted[i + words + 1] |= (uint)(wide >> 32);
            }
            return shifted;
        }

        public static int Compare(uint[] left, uint[] right)
        {
            for (int i = Math.Max(left.Length, right.Length) - 1; i >= 0; i--)
            {
                uint a = i < left.Length ? left[i] : 0, b = i < right.Length ? right[i] : 0;
                if (a != b) { return a < b ? -1 : 1; }
            }
            return 0;
        }

        static void MultiplyAdd(uint[] number, uint factor, uint carry)
        {
            ulong rest = carry;
            for (int i = 0; i < number.Length; i++)
            {
                rest += (ulong)number[i] * factor;
                number[i] = (uint)rest;
                rest >>= 32;
            }
        }
    }

    /// <summary>Half precision numbers, which are kept as floats.</summary>
    public static class HalfNumber
    {
        /// <summary>The float of 16 bits.</summary>
        public static float OfBits(int bits)
        {
            int exponent = bits >> 10 & 31, mantissa = bits & 1023;
            double size = exponent == 31 ? (mantissa == 0 ? double.PositiveInfinity : double.NaN)
                : exponent == 0 ? mantissa * 5.9604644775390625e-08
                : (mantissa + 1024) * Math.Pow(2, exponent - 25);
            return (float)((bits & 0x8000) != 0 ? -size : size);
        }

        /// <summary>The nearest number that a half can hold, ties to even.</summary>
        public static float Nearest(float number)
        {
            double size = Math.Abs((double)number);
            if (double.IsNaN(size) || double.IsInfinity(size)) { return number; }
            if (size >= 65520) { return number < 0 ? float.NegativeInfinity : float.PositiveInfinity; }
            // adding and taking away a number whose last place is that of the half rounds to it
            int exponent = (int)((BitConverter.DoubleToInt64Bits(size) >> 52) - 1023);
            double step = Math.Pow(2, Math.Max(exponent, -14) - 10);
            double rounded = Math.Round(size / step, MidpointRounding.ToEven) * step;
            return (float)(number < 0 ? -rounded : number == 0 ? number : rounded);
        }
    }
}
