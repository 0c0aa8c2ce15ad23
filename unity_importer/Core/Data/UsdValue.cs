using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// One value, scalar or array: its numbers or strings in one flat array. A quaternion is (w, x, y, z), a matrix its
    /// rows, a half a float that a half can hold.
    /// </summary>
    public sealed class UsdValue
    {
        /// <summary>The opinion that there is no value ("None").</summary>
        public static readonly UsdValue Blocked = new UsdValue(UsdType.None, false, new byte[0]);

        /// <summary>Of one element.</summary>
        public readonly UsdType Type;

        /// <summary>Whether there may be any number of elements.</summary>
        public readonly bool IsArray;

        /// <summary>
        /// byte[], int[], uint[], long[], ulong[], float[], double[] or string[], as UsdTypes.StorageOf says.
        /// </summary>
        public readonly Array Data;

        /// <summary>Of data as UsdTypes.StorageOf says; it is not copied.</summary>
        public UsdValue(UsdType type, bool isArray, Array data)
        {
            Type = type;
            IsArray = isArray;
            Data = data;
        }

        /// <summary>One string, token or the like.</summary>
        public static UsdValue OfString(UsdType type, string text)
        {
            return new UsdValue(type, false, new[] { text });
        }

        /// <summary>Elements; 1 for a scalar.</summary>
        public int Count
        {
            get { return Data.Length / UsdTypes.Components(Type); }
        }

        /// <summary>The first string, or null where this holds numbers or nothing.</summary>
        public string Text
        {
            get
            {
                var texts = Data as string[];
                return texts != null && texts.Length > 0 ? texts[0] : null;
            }
        }

        /// <summary>All strings; empty for numbers.</summary>
        public string[] Texts
        {
            get { return Data as string[] ?? new string[0]; }
        }

        /// <summary>The first number, or the given one where there is none.</summary>
        public double Number(double otherwise)
        {
            return Data.Length == 0 || Data is string[] ? otherwise : NumberAt(0);
        }

        /// <summary>Whether the first number is not 0, or the given answer where there is none.</summary>
        public bool Truth(bool otherwise)
        {
            return Number(otherwise ? 1 : 0) != 0;
        }

        /// <summary>All numbers as double; empty for strings.</summary>
        public double[] Doubles()
        {
            var doubles = Data as double[];
            if (doubles != null) { return doubles; }
            if (Data is string[]) { return new double[0]; }
            var converted = new double[Data.Length];
            for (int i = 0; i < converted.Length; i++) { converted[i] = NumberAt(i); }
            return converted;
        }

        /// <summary>All numbers as float, the stored array itself where it is one; empty for strings.</summary>
        public float[] Floats()
        {
            var floats = Data as float[];
            if (floats != null) { return floats; }
            if (Data is string[]) { return new float[0]; }
            var converted = new float[Data.Length];
            for (int i = 0; i < converted.Length; i++) { converted[i] = (float)NumberAt(i); }
            return converted;
        }

        /// <summary>
        /// All numbers as int, the stored array itself where it is one; empty for strings and what no int holds.
        /// </summary>
        public int[] Ints()
        {
            var ints = Data as int[];
            if (ints != null) { return ints; }
            if (Data is string[]) { return new int[0]; }
            var converted = new int[Data.Length];
            for (int i = 0; i < converted.Length; i++)
            {
                double number = NumberAt(i);
                if (!(number >= int.MinValue && number <= int.MaxValue)) { return new int[0]; }
                converted[i] = (int)number;
            }
            return converted;
        }

        /// <summary>
        /// The same numbers as a type of floating point numbers; this itself where the type or what is here is none of
        /// as many numbers an element.
        /// </summary>
        public UsdValue AsFloating(UsdType type)
        {
            Storage storage = UsdTypes.StorageOf(type);
            bool isFloat = storage == Storage.Floats, isNumber = isFloat || storage == Storage.Doubles;
            bool isAlike = !(Data is string[]) && UsdTypes.Components(type) == UsdTypes.Components(Type);
            if (!isNumber || !isAlike) { return this; }
            if (!isFloat) { return new UsdValue(type, IsArray, Doubles()); }
            float[] floats = Floats();
            if (UsdTypes.IsHalf(type)) { floats = Array.ConvertAll(floats, HalfNumber.Nearest); }
            return new UsdValue(type, IsArray, floats);
        }

        double NumberAt(int i)
        {
            switch (UsdTypes.StorageOf(Type))
            {
                case Storage.Bytes: return ((byte[])Data)[i];
                case Storage.Ints: return ((int[])Data)[i];
                case Storage.UInts: return ((uint[])Data)[i];
                case Storage.Longs: return ((long[])Data)[i];
                case Storage.ULongs: return ((ulong[])Data)[i];
                case Storage.Floats: return ((float[])Data)[i];
                case Storage.Doubles: return ((double[])Data)[i];
                default: return 0;
            }
        }
    }

    /// <summary>Names with values, in the order of the file; a value is a UsdValue or another dictionary.</summary>
    public sealed class UsdDictionary
    {
        readonly Dictionary<string, object> values = new Dictionary<string, object>();
        readonly List<string> keys = new List<string>();

        /// <summary>The names.</summary>
        public IList<string> Keys
        {
            get { return keys; }
        }

        /// <summary>The value under a name, or null; a new name comes last.</summary>
        public object this[string key]
        {
            get
            {
                object value;
                return values.TryGetValue(key, out value) ? value : null;
            }
            set
            {
                if (!values.ContainsKey(key)) { keys.Add(key); }
                values[key] = value;
            }
        }

        /// <summary>The string under a key, or null.</summary>
        public string Text(string key)
        {
            var value = this[key] as UsdValue;
            return value == null ? null : value.Text;
        }
    }

    /// <summary>Values over time, times ascending.</summary>
    public sealed class TimeSamples
    {
        /// <summary>In time codes of the layer, ascending.</summary>
        public readonly double[] Times;

        /// <summary>At each of the times.</summary>
        public readonly UsdValue[] Values;

        /// <summary>Of samples in any order.</summary>
        public TimeSamples(double[] times, UsdValue[] values)
        {
            bool ascending = true;
            for (int i = 1; i < times.Length; i++) { ascending &= times[i - 1] < times[i]; }
            if (!ascending)
            {
                // a later sample of the same time replaces the earlier one
                var latest = new SortedDictionary<double, UsdValue>();
                for (int i = 0; i < times.Length; i++) { latest[times[i]] = values[i]; }
                times = new double[latest.Count];
                values = new UsdValue[latest.Count];
                latest.Keys.CopyTo(times, 0);
                latest.Values.CopyTo(values, 0);
            }
            Times = times;
            Values = values;
        }
    }
}
