using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Values of a crate as the types that their attributes are declared to have: a crate says both, and programs write
    /// whole numbers for attributes of fractions.
    /// </summary>
    sealed class DeclaredTypes
    {
        readonly CrateBytes bytes;
        readonly Layer layer;
        readonly Dictionary<string, UsdType> types = new Dictionary<string, UsdType>();

        /// <summary>The layer is told of types that are not known.</summary>
        public DeclaredTypes(CrateBytes bytes, Layer layer)
        {
            this.bytes = bytes;
            this.layer = layer;
        }

        /// <summary>Makes the values of a property what its type says; of a type that is not known it has none.</summary>
        public void Apply(PropertySpec property)
        {
            if (property.Default == null && property.Samples == null) { return; }
            UsdType type = TypeOf(property.TypeName);
            if (property.Default != null) { property.Default = Converted(property.Default, type, property.TypeName); }
            if (property.Samples != null) { property.Samples = Converted(property.Samples, type, property.TypeName); }
        }

        UsdType TypeOf(string name)
        {
            UsdType type;
            if (!types.TryGetValue(name, out type))
            {
                bool isArray = name.EndsWith("[]", StringComparison.Ordinal);
                type = UsdTypes.OfName(isArray ? name.Substring(0, name.Length - 2) : name);
                types.Add(name, type);
            }
            return type;
        }

        UsdValue Converted(UsdValue value, UsdType type, string name)
        {
            if (value.Type == type || ReferenceEquals(value, UsdValue.Blocked)) { return value; }
            if (type != UsdType.None)
            {
                bytes.Charge(0, 8L * value.Data.Length + 64);
                return value.AsFloating(type);
            }
            layer.SkipType(name);
            return null;
        }

        TimeSamples Converted(TimeSamples samples, UsdType type, string name)
        {
            if (Array.TrueForAll(samples.Values, one => one.Type == type)) { return samples; }
            bytes.Charge(0, 16L * samples.Values.Length);
            var values = new UsdValue[samples.Values.Length];
            for (int i = 0; i < values.Length; i++)
            {
                values[i] = Converted(samples.Values[i], type, name);
                if (values[i] == null) { return null; }
            }
            return new TimeSamples(samples.Times, values);
        }
    }
}
