using System;
using System.Collections.Generic;
using System.Globalization;

namespace Garage.Usd
{
    /// <summary>Reads the values of a text layer, of known types and of those that only their text tells.</summary>
    class UsdaValueReader : UsdaScanner
    {
        protected const int DeepestValue = 40;

        /// <summary>What is read.</summary>
        protected readonly Layer layer;

        readonly UsdaValues values = new UsdaValues();

        protected UsdaValueReader(byte[] bytes, string identifier) : base(bytes, identifier)
        {
            layer = new Layer(identifier);
        }

        /// <summary>True or false, as a word or a number.</summary>
        protected bool Truth()
        {
            string word = TryName();
            if (word == null) { return Number() != 0; }
            if (word == "true") { return true; }
            if (word == "false") { return false; }
            switch (word.ToLowerInvariant())
            {
                case "true": case "yes": case "on": return true;
                case "false": case "no": case "off": return false;
                default: throw Unexpected("true or false");
            }
        }

        /// <summary>The name of the type of arrays of a type, one string for each.</summary>
        protected string ArrayName(string typeName)
        {
            return values.ArrayName(typeName);
        }

        /// <summary>Passes the brackets of a type of arrays.</summary>
        protected bool TakeBrackets()
        {
            if (!Take('[')) { return false; }
            Expect(']');
            return true;
        }

        protected bool TakeNone()
        {
            if (Next() != 'N' || text[at + 1] != 'o' || text[at + 2] != 'n' || text[at + 3] != 'e') { return false; }
            at += 4;
            return true;
        }

        /// <summary>A value of the type with this name; null for one that this reader passes over.</summary>
        protected UsdValue ReadValue(string typeName)
        {
            Skip();
            if (text[at] == 'N' && TakeNone()) { return UsdValue.Blocked; }
            if (text[at] == 'A' && TryName() == "AnimationBlock") { return null; }
            UsdType type;
            bool isArray = values.Resolve(typeName, out type);
            if (type == UsdType.None || type == UsdType.Dictionary)
            {
                // a type of somebody's plugin: its text is passed
                ReadAnything(0);
                layer.SkipType(typeName);
                return null;
            }
            if (isArray && text[at] == 'e' && TryName() == "edit")
            {
                Expect('[');
                SkipRest();
                layer.SkipEdits();
                return null;
            }
            return isArray ? ReadArray(type) : ReadScalar(type);
        }

        /// <summary>Passes everything up to the bracket that closes the one just read.</summary>
        protected void SkipRest()
        {
            for (int depth = 1; depth > 0;)
            {
                byte letter = Next();
                if (at >= end) { throw Unexpected("a closing bracket"); }
                switch ((char)letter)
                {
                    case '"': case '\'': QuotedString(); break;
                    case '@': AssetPath(); break;
                    case '<': PathText(); break;
                    default:
                        depth += letter == '{' || letter == '[' || letter == '(' ? 1
                            : letter == '}' || letter == ']' || letter == ')' ? -1 : 0;
                        at++;
                        break;
                }
            }
        }

        UsdValue ReadScalar(UsdType type)
        {
            Storage storage = UsdTypes.StorageOf(type);
            if (storage == Storage.Strings) { return UsdValue.OfString(type, ReadText(type)); }
            if (storage == Storage.Floats)
            {
                var floats = new float[UsdTypes.Components(type)];
                ReadTuple(floats, 0, floats.Length);
                for (int i = 0; UsdTypes.IsHalf(type) && i < floats.Length; i++)
                {
                    floats[i] = HalfNumber.Nearest(floats[i]);
                }
                return new UsdValue(type, false, floats);
            }
            values.Start(type);
            ReadElement(type);
            return values.Finish(type, false);
        }

        UsdValue ReadArray(UsdType type)
        {
            Expect('[');
            values.Start(type);
            int components = UsdTypes.Components(type);
            if (UsdTypes.StorageOf(type) == Storage.Floats && UsdTypes.Rows(type) == 1)
            {
                ReadFloats(components);
                if (UsdTypes.IsHalf(type)) { values.RoundHalves(); }
                return values.Finish(type, true);
            }
            while (!Take(']'))
            {
                ReadElement(type);
                if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
            return values.Finish(type, true);
        }

        // the elements of an array of floats and its closing bracket: the loop that large layers spend their time in
        void ReadFloats(int components)
        {
            float[] floats = values.Floats;
            int count = 0;
            while (!Take(']'))
            {
                if (count + components > floats.Length)
                {
                    Array.Resize(ref floats, floats.Length * 2);
                    values.Floats = floats;
                }
                ReadTuple(floats, count, components);
                count += components;
                if (text[at] == ',') { at++; }
                else if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
            values.Count = count;
        }

        void ReadTuple(float[] into, int first, int components)
        {
            if (components == 1)
            {
                into[first] = (float)Number();
                return;
            }
            Expect('(');
            for (int i = first; i < first + components; i++)
            {
                if (i > first && text[at] != ',') { Expect(','); }
                else if (i > first) { at++; }
                into[i] = (float)Number();
            }
            if (text[at] == ')') { at++; }
            else { EndTuple(); }
        }

        // a last comma may be there
        void EndTuple()
        {
            Take(',');
            Expect(')');
        }

        string ReadText(UsdType type)
        {
            return type == UsdType.Asset && !AtQuote() ? AssetPath()
                : type == UsdType.Path ? PathText() : QuotedString();
        }

        void ReadElement(UsdType type)
        {
            int components = UsdTypes.Components(type);
            if (components == 1)
            {
                ReadComponent(type);
                return;
            }
            int rows = UsdTypes.Rows(type), columns = components / rows;
            if (rows > 1) { Expect('('); }
            for (int row = 0; row < rows; row++)
            {
                if (row > 0) { Expect(','); }
                Expect('(');
                for (int column = 0; column < columns; column++)
                {
                    if (column > 0) { Expect(','); }
                    ReadComponent(type);
                }
                EndTuple();
            }
            if (rows > 1) { EndTuple(); }
        }

        void ReadComponent(UsdType type)
        {
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Floats:
                    float number = (float)Number();
                    values.Add(UsdTypes.IsHalf(type) ? HalfNumber.Nearest(number) : number);
                    break;
                case Storage.Doubles: values.Add(Number()); break;
                case Storage.Ints: values.Add((int)Integer(int.MinValue, int.MaxValue)); break;
                case Storage.UInts: values.Add((uint)Integer(0, uint.MaxValue)); break;
                case Storage.Longs: values.Add(Integer(long.MinValue, long.MaxValue)); break;
                case Storage.ULongs: values.Add(UnsignedLong()); break;
                case Storage.Bytes:
                    if (type == UsdType.Bool) { values.Add((byte)(Truth() ? 1 : 0)); }
                    else { values.Add((byte)Integer(0, 255)); }
                    break;
                default:
                    values.Add(ReadText(type));
                    break;
            }
        }

        /// <summary>
        /// A value whose type only its text tells; tuples and lists of numbers are flat arrays of doubles.
        /// </summary>
        protected object ReadAnything(int depth)
        {
            if (depth > DeepestValue) { throw Error("values are nested more than " + DeepestValue + " deep"); }
            byte letter = Next();
            switch ((char)letter)
            {
                case '"': case '\'': return UsdValue.OfString(UsdType.String, QuotedString());
                case '@': return UsdValue.OfString(UsdType.Asset, AssetPath());
                case '<': return UsdValue.OfString(UsdType.Path, PathText());
                case '{': return ReadDictionary(depth);
                case '[': return ReadList(']', depth);
                case '(': return ReadList(')', depth);
            }
            if ((letter >= '0' && letter <= '9') || letter == '-' || letter == '.')
            {
                return new UsdValue(UsdType.Double, false, new[] { Number() });
            }
            string word = TryName();
            if (word == null) { throw Unexpected("a value"); }
            if (word == "None") { return UsdValue.Blocked; }
            if (word == "true" || word == "false")
            {
                return new UsdValue(UsdType.Bool, false, new[] { (byte)(word == "true" ? 1 : 0) });
            }
            if (word == "inf") { return new UsdValue(UsdType.Double, false, new[] { double.PositiveInfinity }); }
            if (word == "nan") { return new UsdValue(UsdType.Double, false, new[] { double.NaN }); }
            return UsdValue.OfString(UsdType.Token, word);
        }

        UsdValue ReadList(char closing, int depth)
        {
            at++;
            var texts = new List<string>();
            var numbers = new List<double>();
            while (!Take(closing))
            {
                var item = ReadAnything(depth + 1) as UsdValue;
                if (item != null && item.Data is string[]) { texts.AddRange(item.Texts); }
                else if (item != null) { numbers.AddRange(item.Doubles()); }
                // a reference with its offset
                if (Next() == '<' || Next() == '(') { continue; }
                if (!Take(',') && !Take(';') && Next() != (byte)closing)
                {
                    throw Unexpected("',' or '" + closing + "'");
                }
            }
            return texts.Count > 0 ? new UsdValue(UsdType.String, true, texts.ToArray())
                : new UsdValue(UsdType.Double, true, numbers.ToArray());
        }

        UsdDictionary ReadDictionary(int depth)
        {
            if (depth > DeepestValue) { throw Error("dictionaries are nested more than " + DeepestValue + " deep"); }
            at++;
            var dictionary = new UsdDictionary();
            for (;;)
            {
                SkipSeparators();
                if (Take('}')) { return dictionary; }
                byte letter = text[at];
                if (letter == '"' || letter == '\'' || letter == '<' || letter == '-'
                    || (letter >= '0' && letter <= '9'))
                {
                    // pairs without types: prefixes, times
                    object pairKey = ReadAnything(depth + 1);
                    Expect(':');
                    object pairValue = ReadAnything(depth + 1);
                    var named = (UsdValue)pairKey;
                    string number = named.Number(0).ToString("R", CultureInfo.InvariantCulture);
                    dictionary[named.Text ?? number] = pairValue;
                    Take(',');
                    continue;
                }
                string typeName = Name();
                if (TakeBrackets()) { typeName = values.ArrayName(typeName); }
                string key = AtQuote() ? QuotedString() : Name();
                Expect('=');
                if (typeName == "dictionary" && Next() == '{') { dictionary[key] = ReadDictionary(depth + 1); }
                else { dictionary[key] = ReadValue(typeName) ?? UsdValue.Blocked; }
                Take(',');
            }
        }
    }
}
