using System;
using System.Globalization;
using System.Text;

namespace Garage.Usd.Dump
{
    /// <summary>JSON, written piece by piece.</summary>
    sealed class JsonText
    {
        readonly StringBuilder text = new StringBuilder();
        bool needsComma;

        public override string ToString()
        {
            return text.ToString();
        }

        void Separate()
        {
            if (needsComma) { text.Append(','); }
            needsComma = true;
        }

        public void Open(char bracket)
        {
            Separate();
            text.Append(bracket);
            needsComma = false;
        }

        public void Close(char bracket)
        {
            text.Append(bracket);
            needsComma = true;
        }

        public void Key(string name)
        {
            Separate();
            Quote(name);
            text.Append(':');
            needsComma = false;
        }

        public void String(string value)
        {
            Separate();
            Quote(value);
        }

        public void Number(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
            {
                String(double.IsNaN(value) ? "nan" : value > 0 ? "inf" : "-inf");
                return;
            }
            Separate();
            text.Append(value.ToString("R", CultureInfo.InvariantCulture));
        }

        public void Null()
        {
            Separate();
            text.Append("null");
        }

        public void Bool(bool value)
        {
            Separate();
            text.Append(value ? "true" : "false");
        }

        void Quote(string value)
        {
            text.Append('"');
            foreach (char letter in value)
            {
                if (letter == '"' || letter == '\\') { text.Append('\\').Append(letter); }
                else if (letter < ' ' || letter >= 127) { text.Append("\\u").Append(((int)letter).ToString("x4")); }
                else { text.Append(letter); }
            }
            text.Append('"');
        }

        /// <summary>Type and bytes of a value; of long ones the count and the CRC.</summary>
        public void Value(UsdValue value)
        {
            if (ReferenceEquals(value, UsdValue.Blocked))
            {
                String("blocked");
                return;
            }
            Open('[');
            String(value.Type.ToString() + (value.IsArray ? "[]" : ""));
            var strings = value.Data as string[];
            if (strings != null)
            {
                Open('[');
                foreach (string item in strings) { String(item); }
                Close(']');
            }
            else
            {
                var bytes = new byte[Buffer.ByteLength(value.Data)];
                Buffer.BlockCopy(value.Data, 0, bytes, 0, bytes.Length);
                String(bytes.Length <= 64 ? Hex(bytes) : value.Data.Length + ":" + Crc.Of(bytes).ToString("x8"));
            }
            Close(']');
        }

        static string Hex(byte[] bytes)
        {
            var hex = new StringBuilder(2 * bytes.Length);
            foreach (byte b in bytes) { hex.Append(b.ToString("x2")); }
            return hex.ToString();
        }

        /// <summary>A value of any kind as plain JSON, without its type.</summary>
        public void Anything(object value)
        {
            var dictionary = value as UsdDictionary;
            if (dictionary != null)
            {
                Open('{');
                foreach (string key in dictionary.Keys)
                {
                    Key(key);
                    Anything(dictionary[key]);
                }
                Close('}');
                return;
            }
            var one = value as UsdValue;
            if (one == null || ReferenceEquals(one, UsdValue.Blocked))
            {
                Null();
                return;
            }
            bool many = one.IsArray || one.Data.Length != 1;
            if (many) { Open('['); }
            foreach (string item in one.Texts) { String(item); }
            foreach (double item in one.Doubles()) { Number(item); }
            if (many) { Close(']'); }
        }
    }

    static class Crc
    {
        static readonly uint[] Table = new uint[256];

        static Crc()
        {
            for (uint i = 0; i < 256; i++)
            {
                uint rest = i;
                for (int bit = 0; bit < 8; bit++) { rest = (rest & 1) != 0 ? 0xEDB88320 ^ (rest >> 1) : rest >> 1; }
                Table[i] = rest;
            }
        }

        public static uint Of(byte[] bytes)
        {
            uint crc = 0xFFFFFFFF;
            foreach (byte b in bytes) { crc = Table[(crc ^ b) & 255] ^ (crc >> 8); }
            return crc ^ 0xFFFFFFFF;
        }
    }
}
