using System;
using System.Collections.Generic;
using System.Text;

namespace Garage.Usd
{
    /// <summary>The variables of expressions in a layer stack: those of whoever refers to it, then its own.</summary>
    sealed class ExpressionVariables
    {
        static readonly ExpressionVariables None = new ExpressionVariables(new UsdDictionary());

        readonly UsdDictionary values;

        /// <summary>The same text for the same variables.</summary>
        public readonly string Key;

        ExpressionVariables(UsdDictionary values)
        {
            this.values = values;
            var names = new List<string>(values.Keys);
            names.Sort(StringComparer.Ordinal);
            var key = new StringBuilder();
            foreach (string name in names)
            {
                key.Append('\n').Append(name);
                var value = values[name] as UsdValue;
                if (value == null) { continue; }
                key.Append('=').Append(value.Type);
                foreach (object item in value.Data) { key.Append('\t').Append(item); }
            }
            Key = key.ToString();
        }

        /// <summary>Of a layer, and stronger ones of those who refer to it; null for none.</summary>
        public static ExpressionVariables Of(Layer layer, ExpressionVariables stronger)
        {
            var own = layer.Root.Field("expressionVariables") as UsdDictionary;
            if (own == null) { return stronger ?? None; }
            if (stronger == null || ReferenceEquals(stronger, None)) { return new ExpressionVariables(own); }
            var merged = new UsdDictionary();
            foreach (string name in own.Keys) { merged[name] = own[name]; }
            foreach (string name in stronger.values.Keys) { merged[name] = stronger.values[name]; }
            return new ExpressionVariables(merged);
        }

        /// <summary>The value of a variable; its kind is one of those of expressions.</summary>
        public bool Find(string name, out object value)
        {
            value = null;
            object found = values[name];
            if (found == null) { return false; }
            var one = found as UsdValue;
            if (one == null) { throw new FormatException("has a dictionary for '" + name + "'"); }
            if (ReferenceEquals(one, UsdValue.Blocked)) { return true; }
            var items = new List<object>();
            foreach (object item in one.Data)
            {
                items.Add(item is string ? item : one.Type == UsdType.Bool ? (object)((byte)item != 0)
                    : item is int || item is long ? (object)Convert.ToInt64(item) : null);
                if (items[items.Count - 1] == null)
                {
                    throw new FormatException("has a value for '" + name + "' that is no text, number or truth");
                }
            }
            value = one.IsArray ? items : items.Count > 0 ? items[0] : null;
            return true;
        }
    }
}
