using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The values of a crate, from the 64 bits by which it refers to each.</summary>
    sealed class CrateValues
    {
        const int DeepestValue = 40;

        // arrays shorter than this are never compressed
        const int LeastPacked = 16;

        static readonly UsdType[] Types = MakeTypes();

        readonly CrateBytes bytes;
        readonly int version;
        readonly string[] tokens;
        readonly int[] strings;
        readonly Func<int, string> path;
        readonly Layer layer;
        readonly Dictionary<ulong, UsdValue> shared = new Dictionary<ulong, UsdValue>();

        /// <summary>path gives the text of the path with an index; the layer is told what is left out.</summary>
        public CrateValues(CrateBytes bytes, int version, string[] tokens, int[] strings, Func<int, string> path,
            Layer layer)
        {
            this.bytes = bytes;
            this.version = version;
            this.tokens = tokens;
            this.strings = strings;
            this.path = path;
            this.layer = layer;
        }

        static UsdType[] MakeTypes()
        {
            var types = new UsdType[64];
            var ordered = new[]
            {
                UsdType.Bool, UsdType.UChar, UsdType.Int, UsdType.UInt, UsdType.Int64, UsdType.UInt64, UsdType.Half,
                UsdType.Float, UsdType.Double, UsdType.String, UsdType.Token, UsdType.Asset, UsdType.Matrix2d,
                UsdType.Matrix3d, UsdType.Matrix4d, UsdType.Quatd, UsdType.Quatf, UsdType.Quath, UsdType.Double2,
                UsdType.Float2, UsdType.Half2, UsdType.Int2, UsdType.Double3, UsdType.Float3, UsdType.Half3,
                UsdType.Int3, UsdType.Double4, UsdType.Float4, UsdType.Half4, UsdType.Int4,
            };
            ordered.CopyTo(types, 1);
            types[56] = UsdType.TimeCode;
            types[57] = UsdType.PathExpression;
            return types;
        }

        public string Token(long place, int index)
        {
            if (index < 0 || index >= tokens.Length) { throw bytes.Error(place, "there is no token " + index); }
            return tokens[index];
        }

        public string String(long place, int index)
        {
            if (index < 0 || index >= strings.Length) { throw bytes.Error(place, "there is no string " + index); }
            return Token(place, strings[index]);
        }

        /// <summary>
        /// A UsdValue, or what the field needs: ListOp, TimeSamples, UsdDictionary, Dictionary of strings,
        /// LayerOffset[]. Null for splines and other things that this reader passes over.
        /// </summary>
        public object Read(ulong rep, long place, int depth)
        {
            if (depth > DeepestValue)
            {
                throw bytes.Error(place, "values are nested more than " + DeepestValue + " deep");
            }
            int type = (int)(rep >> 48 & 0xFF);
            bool isArray = rep >> 63 != 0, isInlined = (rep >> 62 & 1) != 0;
            long payload = (long)(rep & 0xFFFFFFFFFFFF);
            if ((rep >> 60 & 1) != 0)
            {
                layer.SkipEdits();
                return null;
            }
            UsdType plain = type < Types.Length ? Types[type] : UsdType.None;
            if (plain != UsdType.None)
            {
                UsdValue value;
                if (!isInlined && shared.TryGetValue(rep, out value)) { return value; }
                bytes.Charge(place, 64);
                value = isArray ? ReadArray(plain, payload, (rep >> 61 & 1) != 0)
                    : isInlined ? Inlined(plain, (uint)payload, place) : ReadScalar(plain, payload);
                if (!isInlined) { shared.Add(rep, value); }
                return value;
            }
            bytes.Charge(place, 64);
            switch (type)
            {
                case 31: return isInlined ? new UsdDictionary() : ReadDictionary(ref payload, depth);
                case 32: return TokenOp(payload);
                case 33: return StringOp(payload);
                case 34: return PathOp(payload);
                case 35: return ReferenceOp(payload, depth);
                case 55: return PayloadOp(payload);
                case 40: return Texts(payload, UsdType.Path);
                case 41: return Texts(payload, UsdType.Token);
                case 50: return Texts(payload, UsdType.String);
                case 42: case 43: case 44: return new UsdValue(UsdType.Int, false, new[] { (int)payload });
                case 45: return Selections(payload);
                case 46: return Samples(payload, depth);
                case 47: return OnePayload(payload);
                case 48: return Doubles(payload);
                case 49: return Offsets(payload);
                case 51: return UsdValue.Blocked;
                case 52: case 53:
                    long at = payload + bytes.Long(payload);
                    return Read((ulong)bytes.Long(at), at, depth + 1);
                case 58: return RelocatePairs(payload);
                default: return null;
            }
        }

        // ---- plain values

        UsdValue Inlined(UsdType type, uint payload, long place)
        {
            int components = UsdTypes.Components(type);
            switch (type)
            {
                case UsdType.Token: case UsdType.Asset: return UsdValue.OfString(type, Token(place, (int)payload));
                case UsdType.String: case UsdType.PathExpression:
                    return UsdValue.OfString(type, String(place, (int)payload));
                case UsdType.Bool: return new UsdValue(type, false, new[] { (byte)(payload != 0 ? 1 : 0) });
                case UsdType.UChar: return new UsdValue(type, false, new[] { (byte)payload });
                case UsdType.Int: return new UsdValue(type, false, new[] { (int)payload });
                case UsdType.UInt: return new UsdValue(type, false, new[] { payload });
                case UsdType.Int64: return new UsdValue(type, false, new[] { (long)(int)payload });
                case UsdType.UInt64: return new UsdValue(type, false, new[] { (ulong)payload });
                case UsdType.Half: return new UsdValue(type, false, new[] { HalfNumber.OfBits((int)payload & 0xFFFF) });
                case UsdType.Float: return new UsdValue(type, false, new[] { FloatOf(payload) });
                case UsdType.Double: case UsdType.TimeCode:
                    return new UsdValue(type, false, new[] { (double)FloatOf(payload) });
                case UsdType.Half2:
                    float first = HalfNumber.OfBits((int)(payload & 0xFFFF));
                    float second = HalfNumber.OfBits((int)(payload >> 16));
                    return new UsdValue(type, false, new[] { first, second });
                case UsdType.Matrix2d: case UsdType.Matrix3d: case UsdType.Matrix4d:
                    int size = UsdTypes.Rows(type);
                    var matrix = new double[components];
                    for (int i = 0; i < size; i++) { matrix[i * (size + 1)] = (sbyte)(payload >> (8 * i)); }
                    return new UsdValue(type, false, matrix);
            }
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Ints:
                    var ints = new int[components];
                    for (int i = 0; i < components; i++) { ints[i] = (sbyte)(payload >> (8 * i)); }
                    return new UsdValue(type, false, ints);
                case Storage.Floats:
                    var floats = new float[components];
                    for (int i = 0; i < components; i++) { floats[i] = (sbyte)(payload >> (8 * i)); }
                    return new UsdValue(type, false, floats);
                default:
                    var doubles = new double[components];
                    for (int i = 0; i < components; i++) { doubles[i] = (sbyte)(payload >> (8 * i)); }
                    return new UsdValue(type, false, doubles);
            }
        }

        static float FloatOf(uint bits)
        {
            return BitConverter.ToSingle(BitConverter.GetBytes(bits), 0);
        }

        UsdValue ReadScalar(UsdType type, long place)
        {
            if (UsdTypes.StorageOf(type) == Storage.Strings)
            {
                int index = bytes.Int(place);
                return UsdValue.OfString(type, type == UsdType.Token ? Token(place, index) : String(place, index));
            }
            return new UsdValue(type, false, Plain(type, place, 1));
        }

        // numbers as they lie in memory
        Array Plain(UsdType type, long place, int count)
        {
            int length = count * UsdTypes.Components(type);
            Array numbers;
            if (UsdTypes.IsHalf(type))
            {
                numbers = bytes.Halves(place, length);
            }
            else
            {
                int size = SizeOf(type);
                bytes.Charge(place, (long)length * size);
                switch (UsdTypes.StorageOf(type))
                {
                    case Storage.Bytes: numbers = new byte[length]; break;
                    case Storage.Ints: numbers = new int[length]; break;
                    case Storage.UInts: numbers = new uint[length]; break;
                    case Storage.Longs: numbers = new long[length]; break;
                    case Storage.ULongs: numbers = new ulong[length]; break;
                    case Storage.Floats: numbers = new float[length]; break;
                    default: numbers = new double[length]; break;
                }
                bytes.Copy(place, numbers, size);
            }
            if (UsdTypes.IsQuaternion(type)) { RealFirst(numbers); }
            return numbers;
        }

        // a crate has the real part of a quaternion last
        static void RealFirst(Array numbers)
        {
            var floats = numbers as float[];
            var doubles = numbers as double[];
            for (int i = 0; floats != null && i < floats.Length; i += 4)
            {
                float real = floats[i + 3];
                Array.Copy(floats, i, floats, i + 1, 3);
                floats[i] = real;
            }
            for (int i = 0; doubles != null && i < doubles.Length; i += 4)
            {
                double real = doubles[i + 3];
                Array.Copy(doubles, i, doubles, i + 1, 3);
                doubles[i] = real;
            }
        }

        // bytes of one number in the file
        static int SizeOf(UsdType type)
        {
            if (UsdTypes.IsHalf(type)) { return 2; }
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Bytes: return 1;
                case Storage.Ints: case Storage.UInts: case Storage.Floats: case Storage.Strings: return 4;
                default: return 8;
            }
        }

        UsdValue ReadArray(UsdType type, long place, bool isPacked)
        {
            if (place == 0) { return new UsdValue(type, true, Empty(type)); }
            long start = place;
            // before 0.5 a rank, which is 1; before 0.7 counts of 32 bits
            if (version < 5) { place += 4; }
            long count = version < 7 ? (uint)bytes.Int(place) : bytes.Long(place);
            place += version < 7 ? 4 : 8;
            // the densest compression takes a byte for a thousand integers
            long limit = isPacked ? 1024L * bytes.Length
                : bytes.Length / ((long)SizeOf(type) * UsdTypes.Components(type));
            if (count < 0 || count > limit || count > int.MaxValue / 32)
            {
                throw bytes.Error(start, "an array of " + count + " is more than the file holds");
            }
            if (UsdTypes.StorageOf(type) == Storage.Strings)
            {
                var texts = new string[(int)count];
                bytes.Charge(start, 8 * count);
                for (int i = 0; i < texts.Length; i++)
                {
                    int index = bytes.Int(place + 4L * i);
                    texts[i] = type == UsdType.Token ? Token(place, index) : String(place, index);
                }
                return new UsdValue(type, true, texts);
            }
            if (!isPacked || count < LeastPacked) { return new UsdValue(type, true, Plain(type, place, (int)count)); }
            return new UsdValue(type, true, Packed(type, place, (int)count));
        }

        static Array Empty(UsdType type)
        {
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Bytes: return new byte[0];
                case Storage.Ints: return new int[0];
                case Storage.UInts: return new uint[0];
                case Storage.Longs: return new long[0];
                case Storage.ULongs: return new ulong[0];
                case Storage.Floats: return new float[0];
                case Storage.Doubles: return new double[0];
                default: return new string[0];
            }
        }

        Array Packed(UsdType type, long place, int count)
        {
            switch (type)
            {
                case UsdType.Int: return bytes.PackedInts(ref place, count);
                case UsdType.UInt:
                    int[] signed = bytes.PackedInts(ref place, count);
                    var unsigned = new uint[count];
                    Buffer.BlockCopy(signed, 0, unsigned, 0, 4 * count);
                    return unsigned;
                case UsdType.Int64: return bytes.PackedLongs(ref place, count);
                case UsdType.UInt64:
                    long[] longs = bytes.PackedLongs(ref place, count);
                    var ulongs = new ulong[count];
                    Buffer.BlockCopy(longs, 0, ulongs, 0, 8 * count);
                    return ulongs;
                case UsdType.Half: case UsdType.Float: case UsdType.Double: break;
                default: throw bytes.Error(place, "an array of " + type + " cannot be compressed");
            }
            byte code = bytes.Byte(place++);
            bool isDouble = type == UsdType.Double;
            if (code == (byte)'i')
            {
                int[] whole = bytes.PackedInts(ref place, count);
                bytes.Charge(place, 8L * count);
                var floats = new float[isDouble ? 0 : count];
                var doubles = new double[isDouble ? count : 0];
                for (int i = 0; i < doubles.Length; i++) { doubles[i] = whole[i]; }
                for (int i = 0; i < floats.Length; i++) { floats[i] = whole[i]; }
                return isDouble ? (Array)doubles : floats;
            }
            if (code != (byte)'t') { throw bytes.Error(place, "unknown compression of floating point numbers"); }
            int size = bytes.Int(place);
            place += 4;
            if (size < 0 || size > bytes.Length)
            {
                throw bytes.Error(place, "a table of " + size + " is more than the file holds");
            }
            Array table = Plain(type, place, size);
            place += (long)size * SizeOf(type);
            int[] indices = bytes.PackedInts(ref place, count);
            bytes.Charge(place, 8L * count);
            for (int i = 0; i < count; i++)
            {
                if ((uint)indices[i] >= (uint)size)
                {
                    throw bytes.Error(place, "an index leads out of a table of numbers");
                }
            }
            return isDouble ? (Array)Picked((double[])table, indices) : Picked((float[])table, indices);
        }

        static T[] Picked<T>(T[] table, int[] indices)
        {
            var picked = new T[indices.Length];
            for (int i = 0; i < picked.Length; i++) { picked[i] = table[indices[i]]; }
            return picked;
        }

        // ---- structures

        UsdDictionary ReadDictionary(ref long place, int depth)
        {
            int count = bytes.Count(place, 12);
            place += 8;
            var dictionary = new UsdDictionary();
            for (int i = 0; i < count; i++)
            {
                bytes.Charge(place, 100);
                string key = String(place, bytes.Int(place));
                place += 4;
                long at = place + bytes.Long(place);
                dictionary[key] = Read((ulong)bytes.Long(at), at, depth + 1);
                place = at + 8;
            }
            return dictionary;
        }

        ListOp<T> Op<T>(long place, Func<T> next, Action<long> start)
        {
            int header = bytes.Byte(place);
            start(place + 1);
            var op = new ListOp<T> { IsExplicit = (header & 1) != 0 };
            if ((header & 2) != 0 || op.IsExplicit) { op.Explicit = (header & 2) != 0 ? Items(next) : new List<T>(); }
            if ((header & 4) != 0) { op.Added = Items(next); }
            if ((header & 32) != 0) { op.Prepended = Items(next); }
            if ((header & 64) != 0) { op.Appended = Items(next); }
            if ((header & 8) != 0) { op.Deleted = Items(next); }
            if ((header & 16) != 0) { op.Ordered = Items(next); }
            return op;
        }

        long cursor;

        List<T> Items<T>(Func<T> next)
        {
            int count = bytes.Count(cursor, 4);
            cursor += 8;
            bytes.Charge(cursor, 16L * count);
            var items = new List<T>(count);
            for (int i = 0; i < count; i++) { items.Add(next()); }
            return items;
        }

        int NextInt()
        {
            int number = bytes.Int(cursor);
            cursor += 4;
            return number;
        }

        void MoveTo(long place)
        {
            cursor = place;
        }

        ListOp<string> TokenOp(long place)
        {
            return Op<string>(place, delegate { return Token(cursor, NextInt()); }, MoveTo);
        }

        ListOp<string> StringOp(long place)
        {
            return Op<string>(place, delegate { return String(cursor, NextInt()); }, MoveTo);
        }

        ListOp<string> PathOp(long place)
        {
            return Op<string>(place, delegate { return path(NextInt()); }, MoveTo);
        }

        ListOp<ReferenceArc> ReferenceOp(long place, int depth)
        {
            return Op<ReferenceArc>(place, delegate
            {
                string asset = String(cursor, NextInt());
                string prim = path(NextInt());
                var offset = new LayerOffset(bytes.Double(cursor), bytes.Double(cursor + 8));
                cursor += 16;
                ReadDictionary(ref cursor, depth);
                return new ReferenceArc(asset, prim, offset);
            }, MoveTo);
        }

        ListOp<ReferenceArc> PayloadOp(long place)
        {
            return Op<ReferenceArc>(place, NextPayload, MoveTo);
        }

        ReferenceArc NextPayload()
        {
            string asset = String(cursor, NextInt());
            string prim = path(NextInt());
            LayerOffset offset = LayerOffset.Identity;
            if (version >= 8)
            {
                offset = new LayerOffset(bytes.Double(cursor), bytes.Double(cursor + 8));
                cursor += 16;
            }
            return new ReferenceArc(asset, prim, offset);
        }

        ListOp<ReferenceArc> OnePayload(long place)
        {
            cursor = place;
            return ListOp<ReferenceArc>.Whole(new List<ReferenceArc> { NextPayload() });
        }

        UsdValue Texts(long place, UsdType type)
        {
            int count = bytes.Count(place, 4);
            bytes.Charge(place, 8L * count);
            var texts = new string[count];
            for (int i = 0; i < count; i++)
            {
                int index = bytes.Int(place + 8 + 4L * i);
                texts[i] = type == UsdType.Path ? path(index) : type == UsdType.Token ? Token(place, index)
                    : String(place, index);
            }
            return new UsdValue(type, true, texts);
        }

        UsdValue Doubles(long place)
        {
            return new UsdValue(UsdType.Double, true, Plain(UsdType.Double, place + 8, bytes.Count(place, 8)));
        }

        LayerOffset[] Offsets(long place)
        {
            int count = bytes.Count(place, 16);
            bytes.Charge(place, 16L * count);
            var offsets = new LayerOffset[count];
            for (int i = 0; i < count; i++)
            {
                offsets[i] = new LayerOffset(bytes.Double(place + 8 + 16L * i), bytes.Double(place + 16 + 16L * i));
            }
            return offsets;
        }

        List<KeyValuePair<string, string>> RelocatePairs(long place)
        {
            int count = bytes.Count(place, 8);
            bytes.Charge(place, 100L * count);
            var pairs = new List<KeyValuePair<string, string>>(count);
            for (int i = 0; i < count; i++)
            {
                long at = place + 8 + 8L * i;
                pairs.Add(new KeyValuePair<string, string>(path(bytes.Int(at)), path(bytes.Int(at + 4))));
            }
            return pairs;
        }

        Dictionary<string, string> Selections(long place)
        {
            int count = bytes.Count(place, 8);
            bytes.Charge(place, 100L * count);
            var selections = new Dictionary<string, string>();
            for (int i = 0; i < count; i++)
            {
                selections[String(place, bytes.Int(place + 8 + 8L * i))] = String(place,
                    bytes.Int(place + 12 + 8L * i));
            }
            return selections;
        }

        TimeSamples Samples(long place, int depth)
        {
            long timesAt = place + bytes.Long(place);
            var times = Read((ulong)bytes.Long(timesAt), timesAt, depth + 1) as UsdValue;
            place = timesAt + 8;
            long valuesAt = place + bytes.Long(place);
            int count = bytes.Count(valuesAt, 8);
            if (times == null || times.Type != UsdType.Double || times.Data.Length != count)
            {
                throw bytes.Error(place, "time samples have not as many times as values");
            }
            bytes.Charge(place, 16L * count);
            var values = new UsdValue[count];
            for (int i = 0; i < count; i++)
            {
                long at = valuesAt + 8 + 8L * i;
                values[i] = Read((ulong)bytes.Long(at), at, depth + 1) as UsdValue ?? UsdValue.Blocked;
            }
            return new TimeSamples((double[])times.Data, values);
        }
    }
}
