using System;
using System.Text;

namespace Garage.Usd
{
    /// <summary>The words, numbers and strings of a text layer, read from its bytes.</summary>
    class UsdaScanner
    {
        // letters, digits, '_' and everything beyond ASCII; then the same with ':'
        static readonly bool[] InName = new bool[256];
        static readonly bool[] InNamespacedName = new bool[256];

        // the text with two newlines behind its end, so that looking at one byte needs no comparison with the length
        protected readonly byte[] text;
        protected readonly int end;
        protected int at;

        readonly string file;
        readonly int length;
        readonly TextMemo strings;

        static UsdaScanner()
        {
            for (int i = 0; i < 256; i++)
            {
                InName[i] = (i >= 'a' && i <= 'z') || (i >= 'A' && i <= 'Z') || (i >= '0' && i <= '9') || i == '_'
                    || i >= 128;
                InNamespacedName[i] = InName[i] || i == ':';
            }
        }

        protected UsdaScanner(byte[] bytes, string file)
        {
            this.file = file;
            length = bytes.Length;
            // layers that USD writes end in two newlines; these need no copy, which costs as much as a pass over them
            bool isEnded = bytes[length - 2] == '\n' && bytes[length - 1] == '\n';
            end = isEnded ? length - 2 : length;
            text = isEnded ? bytes : Ended(bytes);
            strings = new TextMemo(text, end);
        }

        static byte[] Ended(byte[] bytes)
        {
            var text = new byte[bytes.Length + 2];
            Buffer.BlockCopy(bytes, 0, text, 0, bytes.Length);
            text[bytes.Length] = text[bytes.Length + 1] = (byte)'\n';
            return text;
        }

        protected UsdFormatException Error(string reason)
        {
            return ErrorAt(at, reason);
        }

        UsdFormatException ErrorAt(int place, string reason)
        {
            int line = 1, stop = place < end ? place : length;
            for (int i = 0; i < stop; i++)
            {
                if (text[i] == '\n') { line++; }
            }
            return new UsdFormatException(file, "line " + line, reason);
        }

        protected UsdFormatException Unexpected(string wanted)
        {
            string found = at >= end ? "the end of the file"
                : "'" + Encoding.UTF8.GetString(text, at, Math.Min(20, end - at)) + "'";
            return Error("expected " + wanted + ", found " + found);
        }

        /// <summary>Passes white space and comments.</summary>
        protected void Skip()
        {
            byte[] s = text;
            int i = at;
            byte letter = s[i];
            while (letter == ' ') { letter = s[++i]; }
            at = i;
            if (letter <= ' ' || letter == '#' || letter == '/') { SkipLines(); }
        }

        void SkipLines()
        {
            byte[] s = text;
            int i = at;
            while (i < end)
            {
                byte letter = s[i];
                if (letter == '\n')
                {
                    i++;
                    // a line is mostly indented
                    while (i + 8 <= end && ByteRuns.Eight(s, i) == ByteRuns.Spaces) { i += 8; }
                }
                else if (letter == ' ' || letter == '\t' || letter == '\r')
                {
                    i++;
                }
                else if (letter == '#' || (letter == '/' && s[i + 1] == '/'))
                {
                    while (i < end && s[i] != '\n' && s[i] != '\r') { i++; }
                }
                else if (letter == '/' && s[i + 1] == '*')
                {
                    int start = i;
                    i += 2;
                    while (i < end && !(s[i] == '*' && s[i + 1] == '/')) { i++; }
                    if (i >= end) { throw ErrorAt(start, "a comment does not end"); }
                    i += 2;
                }
                else
                {
                    break;
                }
            }
            at = i;
        }

        /// <summary>Passes white space and semicolons between statements.</summary>
        protected void SkipSeparators()
        {
            Skip();
            while (text[at] == ';')
            {
                at++;
                Skip();
            }
        }

        protected bool Take(char symbol)
        {
            Skip();
            if (text[at] != symbol) { return false; }
            at++;
            return true;
        }

        protected void Expect(char symbol)
        {
            if (!Take(symbol)) { throw Unexpected("'" + symbol + "'"); }
        }

        protected byte Next()
        {
            Skip();
            return text[at];
        }

        /// <summary>A name, perhaps with namespaces; null where none is here.</summary>
        protected string TryName()
        {
            Skip();
            byte[] s = text;
            int i = at;
            int hash = 0;
            byte letter = s[i];
            if (letter >= '0' && letter <= '9') { return null; }
            bool[] inName = InNamespacedName;
            while (inName[letter])
            {
                hash = hash * 31 + letter;
                letter = s[++i];
            }
            if (i == at) { return null; }
            string name = strings.Shared(at, i - at, hash);
            at = i;
            return name;
        }

        protected string Name()
        {
            string name = TryName();
            if (name == null) { throw Unexpected("a name"); }
            return name;
        }

        protected bool AtQuote()
        {
            byte letter = Next();
            return letter == '"' || letter == '\'';
        }

        /// <summary>A string in one or three single or double quotes.</summary>
        protected string QuotedString()
        {
            return QuotedString(true);
        }

        /// <summary>As QuotedString; tells whether the same text may come often.</summary>
        protected string QuotedString(bool isShared)
        {
            Skip();
            byte[] s = text;
            byte quote = s[at];
            if (quote != '"' && quote != '\'') { throw Unexpected("a string"); }
            int i = at + 1;
            if (s[i] == quote && s[i + 1] == quote) { return LongString(quote); }
            int hash = 0;
            bool escaped = false;
            int start = i;
            for (;;)
            {
                byte letter = s[i];
                if (letter == quote) { break; }
                if (letter == '\n' || letter == '\r' || i >= end) { throw Error("a string does not end on its line"); }
                if (letter == '\\')
                {
                    escaped = true;
                    i++;
                }
                hash = hash * 31 + letter;
                i++;
            }
            at = i + 1;
            if (escaped) { return Unescaped(start, i); }
            int length = i - start;
            return isShared && length <= 64 ? strings.Shared(start, length, hash) : strings.Decoded(start, length);
        }

        string LongString(byte quote)
        {
            byte[] s = text;
            int start = at + 3, i = start;
            bool escaped = false;
            while (!(s[i] == quote && s[i + 1] == quote && s[i + 2] == quote))
            {
                if (i >= end) { throw Error("a string in three quotes does not end"); }
                if (s[i] == '\\')
                {
                    escaped = true;
                    i++;
                }
                i++;
            }
            at = i + 3;
            return escaped ? Unescaped(start, i) : strings.Decoded(start, i - start);
        }

        string Unescaped(int start, int stop)
        {
            var bytes = new byte[stop - start];
            int count = 0;
            for (int i = start; i < stop; i++)
            {
                byte letter = text[i];
                if (letter != '\\' || i + 1 >= stop)
                {
                    bytes[count++] = letter;
                    continue;
                }
                letter = text[++i];
                switch ((char)letter)
                {
                    case 'a': bytes[count++] = 7; break;
                    case 'b': bytes[count++] = 8; break;
                    case 'f': bytes[count++] = 12; break;
                    case 'n': bytes[count++] = 10; break;
                    case 'r': bytes[count++] = 13; break;
                    case 't': bytes[count++] = 9; break;
                    case 'v': bytes[count++] = 11; break;
                    case 'x':
                        int value = 0;
                        for (int digits = 0; digits < 2 && i + 1 < stop && HexDigit(text[i + 1]) >= 0; digits++)
                        {
                            value = value * 16 + HexDigit(text[++i]);
                        }
                        bytes[count++] = (byte)value;
                        break;
                    default:
                        if (letter < '0' || letter > '7')
                        {
                            bytes[count++] = letter;
                            break;
                        }
                        int octal = letter - '0';
                        for (int digits = 1; digits < 3 && i + 1 < stop && text[i + 1] >= '0'
                            && text[i + 1] <= '7'; digits++)
                        {
                            octal = octal * 8 + (text[++i] - '0');
                        }
                        bytes[count++] = (byte)octal;
                        break;
                }
            }
            return Encoding.UTF8.GetString(bytes, 0, count);
        }

        static int HexDigit(byte letter)
        {
            return letter >= '0' && letter <= '9' ? letter - '0' : letter >= 'a' && letter <= 'f' ? letter - 'a' + 10
                : letter >= 'A' && letter <= 'F' ? letter - 'A' + 10 : -1;
        }

        /// <summary>An asset path: @a@ or @@@a@@@.</summary>
        protected string AssetPath()
        {
            Expect('@');
            byte[] s = text;
            if (s[at] == '@' && s[at + 1] == '@')
            {
                at += 2;
                var path = new StringBuilder();
                int start = at;
                for (;;)
                {
                    if (at >= end) { throw Error("an asset path does not end"); }
                    bool three = s[at] == '@' && s[at + 1] == '@' && s[Math.Min(at + 2, end)] == '@';
                    if (three && at > start && s[at - 1] == '\\')
                    {
                        path.Append(Encoding.UTF8.GetString(s, start, at - 1 - start)).Append("@@@");
                        at += 3;
                        start = at;
                    }
                    else if (three)
                    {
                        // of more than three, the last three end the path
                        while (s[Math.Min(at + 3, end)] == '@') { at++; }
                        path.Append(Encoding.UTF8.GetString(s, start, at - start));
                        at += 3;
                        return path.ToString();
                    }
                    else
                    {
                        at++;
                    }
                }
            }
            int first = at;
            while (s[at] != '@')
            {
                if (at >= end || s[at] == '\n') { throw Error("an asset path does not end on its line"); }
                at++;
            }
            at++;
            return strings.Decoded(first, at - 1 - first);
        }

        /// <summary>What stands between angle brackets.</summary>
        protected string PathText()
        {
            Expect('<');
            byte[] s = text;
            int start = at, hash = 0;
            while (s[at] != '>')
            {
                if (at >= end || s[at] == '\n') { throw Error("a path does not end on its line"); }
                hash = hash * 31 + s[at];
                at++;
            }
            int length = at - start;
            at++;
            return length <= 128 ? strings.Shared(start, length, hash) : strings.Decoded(start, length);
        }

        /// <summary>A number of any form; an integer is exact up to 2^64.</summary>
        protected double Number()
        {
            byte[] s = text;
            int i = at;
            byte letter = s[i];
            while (letter == ' ' || (letter == '\n' && i < end)) { letter = s[++i]; }
            bool negative = letter == '-';
            if (negative) { letter = s[++i]; }
            int start = i;
            ulong digits = 0;
            while ((uint)(letter - '0') <= 9)
            {
                digits = digits * 10 + (uint)(letter - '0');
                letter = s[++i];
            }
            int count = i - start, exponent = 0;
            if (letter == '.')
            {
                int point = i;
                letter = s[++i];
                while ((uint)(letter - '0') <= 9)
                {
                    digits = digits * 10 + (uint)(letter - '0');
                    letter = s[++i];
                }
                exponent = point + 1 - i;
                count -= exponent;
            }
            if (count == 0)
            {
                return OddNumber();
            }
            if ((letter | 32) == 'e')
            {
                int sign = s[i + 1] == '-' ? -1 : 1;
                int digit = s[i + 1] == '-' || s[i + 1] == '+' ? i + 2 : i + 1;
                if ((uint)(s[digit] - '0') <= 9)
                {
                    int power = 0;
                    for (i = digit; (uint)(s[i] - '0') <= 9; i++)
                    {
                        power = Math.Min(power * 10 + (s[i] - '0'), 100000);
                    }
                    exponent += sign * power;
                }
            }
            at = i;
            double size = count <= 19 ? DecimalNumber.Nearest(digits, exponent) : DecimalNumber.Parse(s, start, i);
            return negative ? -size : size;
        }

        // white space other than spaces and newlines, comments, inf and nan
        double OddNumber()
        {
            int before = at;
            Skip();
            if (at != before && (text[at] == '-' || text[at] == '.' || (text[at] >= '0' && text[at] <= '9')))
            {
                return Number();
            }
            bool negative = text[at] == '-';
            int start = at;
            if (negative) { at++; }
            string word = InName[text[at]] ? TryName() : null;
            if (word == "inf") { return negative ? double.NegativeInfinity : double.PositiveInfinity; }
            if (word == "nan") { return BitConverter.Int64BitsToDouble(0x7FF8000000000000); }
            at = start;
            throw Unexpected("a number");
        }

        /// <summary>A whole number; a fraction is cut off.</summary>
        protected long Integer(long least, long most)
        {
            Skip();
            byte[] s = text;
            int i = at;
            bool negative = s[i] == '-';
            if (negative) { i++; }
            int start = i;
            long number = 0;
            while ((uint)(s[i] - '0') <= 9 && i - start < 18)
            {
                number = number * 10 + (s[i] - '0');
                i++;
            }
            byte letter = s[i];
            if (i == start || letter == '.' || (letter | 32) == 'e' || (uint)(letter - '0') <= 9)
            {
                return LongInteger(least, most);
            }
            at = i;
            number = negative ? -number : number;
            if (number < least || number > most) { throw Error(number + " is not between " + least + " and " + most); }
            return number;
        }

        long LongInteger(long least, long most)
        {
            int start = at;
            int digits = start + (text[start] == '-' ? 1 : 0), stop = digits;
            while ((uint)(text[stop] - '0') <= 9) { stop++; }
            double number = Number();
            long exact;
            if (at == stop && long.TryParse(Encoding.ASCII.GetString(text, start, stop - start), out exact))
            {
                if (exact >= least && exact <= most) { return exact; }
            }
            else if (at != stop && number > -9.2e18 && number < 9.2e18 && (long)number >= least && (long)number <= most)
            {
                return (long)number;
            }
            at = start;
            throw Error("a number is not between " + least + " and " + most);
        }

        protected ulong UnsignedLong()
        {
            Skip();
            int start = at, stop = at;
            while ((uint)(text[stop] - '0') <= 9) { stop++; }
            ulong exact;
            if (stop == start || stop - start > 20
                || !ulong.TryParse(Encoding.ASCII.GetString(text, start, stop - start), out exact))
            {
                throw Unexpected("a whole number from 0 to " + ulong.MaxValue);
            }
            at = stop;
            return exact;
        }
    }
}
