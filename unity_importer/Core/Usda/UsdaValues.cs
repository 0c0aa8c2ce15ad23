using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>The buffers in which the numbers of a value gather, and the types by name.</summary>
    sealed class UsdaValues
    {
        public float[] Floats = new float[256];
        public int Count;

        double[] doubles = new double[64];
        int[] ints = new int[256];
        List<string> strings = new List<string>();
        List<long> longs = new List<long>();
        List<ulong> ulongs = new List<ulong>();
        List<uint> uints = new List<uint>();
        List<byte> bytes = new List<byte>();

        readonly Dictionary<string, KeyValuePair<UsdType, bool>> types
            = new Dictionary<string, KeyValuePair<UsdType, bool>>();
        readonly Dictionary<string, string> arrayNames = new Dictionary<string, string>();
        string lastName;
        KeyValuePair<UsdType, bool> lastType;

        public string ArrayName(string name)
        {
            string array;
            if (!arrayNames.TryGetValue(name, out array))
            {
                array = name + "[]";
                arrayNames.Add(name, array);
            }
            return array;
        }

        /// <summary>The type with this name, and whether it is an array.</summary>
        public bool Resolve(string typeName, out UsdType type)
        {
            if (!ReferenceEquals(typeName, lastName))
            {
                if (!types.TryGetValue(typeName, out lastType))
                {
                    bool isArray = typeName.EndsWith("[]", StringComparison.Ordinal);
                    string element = isArray ? typeName.Substring(0, typeName.Length - 2) : typeName;
                    lastType = new KeyValuePair<UsdType, bool>(UsdTypes.OfName(element), isArray);
                    types.Add(typeName, lastType);
                }
                lastName = typeName;
            }
            type = lastType.Key;
            return lastType.Value;
        }

        public void Start(UsdType type)
        {
            Count = 0;
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Strings: strings.Clear(); break;
                case Storage.Longs: longs.Clear(); break;
                case Storage.ULongs: ulongs.Clear(); break;
                case Storage.UInts: uints.Clear(); break;
                case Storage.Bytes: bytes.Clear(); break;
            }
        }

        public void Add(float number)
        {
            if (Count == Floats.Length) { Array.Resize(ref Floats, 2 * Count); }
            Floats[Count++] = number;
        }

        public void Add(double number)
        {
            if (Count == doubles.Length) { Array.Resize(ref doubles, 2 * Count); }
            doubles[Count++] = number;
        }

        public void Add(int number)
        {
            if (Count == ints.Length) { Array.Resize(ref ints, 2 * Count); }
            ints[Count++] = number;
        }

        public void Add(uint number)
        {
            uints.Add(number);
        }

        public void Add(long number)
        {
            longs.Add(number);
        }

        public void Add(ulong number)
        {
            ulongs.Add(number);
        }

        public void Add(byte number)
        {
            bytes.Add(number);
        }

        public void Add(string value)
        {
            strings.Add(value);
        }

        public void RoundHalves()
        {
            for (int i = 0; i < Count; i++) { Floats[i] = HalfNumber.Nearest(Floats[i]); }
        }

        public UsdValue Finish(UsdType type, bool isArray)
        {
            Array data;
            switch (UsdTypes.StorageOf(type))
            {
                case Storage.Floats: data = new float[Count]; Array.Copy(Floats, data, Count); break;
                case Storage.Doubles: data = new double[Count]; Array.Copy(doubles, data, Count); break;
                case Storage.Ints: data = new int[Count]; Array.Copy(ints, data, Count); break;
                case Storage.UInts: data = uints.ToArray(); break;
                case Storage.Longs: data = longs.ToArray(); break;
                case Storage.ULongs: data = ulongs.ToArray(); break;
                case Storage.Bytes: data = bytes.ToArray(); break;
                default: data = strings.ToArray(); break;
            }
            return new UsdValue(type, isArray, data);
        }
    }
}
