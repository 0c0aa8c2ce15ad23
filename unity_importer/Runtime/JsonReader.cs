using System;
using System.Globalization;
using System.Text;

namespace Garage.Unity
{
    /// <summary>Reads JSON value by value. All that is wrong is a FormatException that names the byte.</summary>
    sealed class JsonReader
    {
        readonly byte[] json;
        int at;

        public JsonReader(byte[] json)
        {
            this.json = json;
        }

        /// <summary>An error at the place that is read.</summary>
        public FormatException Wrong(string what)
        {
            return new FormatException("byte " + at + ": " + what);
        }

        byte Next()
        {
            while (at < json.Length && json[at] <= ' ') { at++; }
            if (at >= json.Length) { throw Wrong("the text ends too early"); }
            return json[at];
        }

        void Expect(char letter)
        {
            if (Next() != letter) { throw Wrong("'" + letter + "' is missing"); }
            at++;
        }

        /// <summary>Reads what stands between two brackets, one by one.</summary>
        public void Each(char open, char close, Action one)
        {
            Expect(open);
            if (Next() == close)
            {
                at++;
                return;
            }
            for (;;)
            {
                one();
                if (Next() == close)
                {
                    at++;
                    return;
                }
                Expect(',');
            }
        }

        /// <summary>Reads an object: the action reads each value, given its key.</summary>
        public void EachKey(Action<string> one)
        {
            Each('{', '}', () =>
            {
                string key = Text();
                Expect(':');
                one(key);
            });
        }

        /// <summary>Reads a string.</summary>
        public string Text()
        {
            Expect('"');
            int start = at;
            bool isPlain = true;
            while (at < json.Length && json[at] != '"')
            {
                isPlain &= json[at] != '\\';
                at += json[at] == '\\' ? 2 : 1;
            }
            if (at >= json.Length) { throw Wrong("a string does not end"); }
            string text = Encoding.UTF8.GetString(json, start, at - start);
            at++;
            return isPlain ? text : Unescaped(text);
        }

        string Unescaped(string text)
        {
            var plain = new StringBuilder();
            for (int i = 0; i < text.Length; i++)
            {
                if (text[i] != '\\')
                {
                    plain.Append(text[i]);
                    continue;
                }
                char letter = text[++i];
                int code;
                int known = "nrtbf".IndexOf(letter);
                if (letter != 'u')
                {
                    plain.Append(known < 0 ? letter : "\n\r\t\b\f"[known]);
                    continue;
                }
                string digits = text.Substring(Math.Min(i + 1, text.Length - 1), Math.Min(4, text.Length - i - 1));
                if (!int.TryParse(digits, NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out code))
                {
                    throw Wrong("a letter is told wrongly");
                }
                plain.Append((char)code);
                i += digits.Length;
            }
            return plain.ToString();
        }

        /// <summary>Reads a whole number that is not negative.</summary>
        public int Whole()
        {
            Next();
            long number = 0;
            int start = at;
            for (; at < json.Length && json[at] >= '0' && json[at] <= '9' && number <= int.MaxValue; at++)
            {
                number = 10 * number + json[at] - '0';
            }
            if (at == start || number > int.MaxValue) { throw Wrong("this is no whole number"); }
            return (int)number;
        }

        /// <summary>Reads a number.</summary>
        public double Number()
        {
            Next();
            int start = at;
            while (at < json.Length && "+-.eE0123456789".IndexOf((char)json[at]) >= 0) { at++; }
            double number;
            if (!double.TryParse(Encoding.ASCII.GetString(json, start, at - start), NumberStyles.Float,
                CultureInfo.InvariantCulture, out number))
            {
                throw Wrong("this is no number");
            }
            return number;
        }

        /// <summary>Passes over a value of any kind.</summary>
        public void Skip()
        {
            Skip(0);
        }

        void Skip(int depth)
        {
            byte letter = Next();
            if (depth > 100) { throw Wrong("values are nested too deep"); }
            if (letter == '"') { Text(); }
            else if (letter == '[') { Each('[', ']', () => Skip(depth + 1)); }
            else if (letter == '{') { EachKey(key => Skip(depth + 1)); }
            else
            {
                while (at < json.Length && json[at] != ',' && json[at] != ']' && json[at] != '}') { at++; }
            }
        }
    }
}
