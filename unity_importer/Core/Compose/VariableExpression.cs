using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;

namespace Garage.Usd
{
    /// <summary>
    /// Evaluates texts in backquotes, such as `"${FOLDER}/a.usda"` or `if(eq(${LOD}, "low"), "a", "b")`. Values are texts,
    /// whole numbers, truths, lists of these, and null for None.
    /// </summary>
    sealed class VariableExpression
    {
        const int Deepest = 50;

        readonly string text;
        readonly ExpressionVariables variables;
        readonly List<string> around;
        int at, depth;

        VariableExpression(string text, ExpressionVariables variables, List<string> around)
        {
            this.text = text;
            this.variables = variables;
            this.around = around;
        }

        /// <summary>Whether a text is to be evaluated.</summary>
        public static bool Is(string text)
        {
            return text.Length > 2 && text[0] == '`' && text[text.Length - 1] == '`';
        }

        /// <summary>What a text that is to be evaluated says. Throws FormatException where it says nothing.</summary>
        public static string Text(string text, ExpressionVariables variables)
        {
            object value = Value(text, variables, new List<string>());
            if (value == null) { return ""; }
            var said = value as string;
            if (said == null) { throw new FormatException("is " + Kind(value) + ", not a text"); }
            return said;
        }

        static object Value(string text, ExpressionVariables variables, List<string> around)
        {
            var expression = new VariableExpression(text, variables, around) { at = 1 };
            object value = expression.Any(true);
            if (expression.at != text.Length - 1) { throw expression.Unexpected(); }
            return value;
        }

        FormatException Unexpected()
        {
            return new FormatException("has an unexpected '" + (at < text.Length ? text.Substring(at, 1) : "end")
                + "' at character " + at);
        }

        static string Kind(object value)
        {
            return value == null ? "None" : value is string ? "a text" : value is long ? "a number"
                : value is bool ? "a truth" : "a list";
        }

        char Next
        {
            get { return at < text.Length ? text[at] : '`'; }
        }

        void SkipSpaces()
        {
            while (Next == ' ') { at++; }
        }

        object Any(bool mayBeList)
        {
            if (++depth > Deepest) { throw new FormatException("is nested more than " + Deepest + " deep"); }
            object value = Next == '[' && mayBeList ? List() : Scalar();
            depth--;
            return value;
        }

        object Scalar()
        {
            char first = Next;
            if (first == '"' || first == '\'') { return Quoted(first); }
            if (first == '$') { return Variable(); }
            if (first == '-' || (first >= '0' && first <= '9')) { return Number(); }
            string name = Name();
            switch (name)
            {
                case "true": case "True": return true;
                case "false": case "False": return false;
                case "none": case "None": return null;
            }
            SkipSpaces();
            if (Next != '(') { throw Unexpected(); }
            List<object> arguments = Items(')', true);
            SkipSpaces();
            return name == "defined" ? IsDefined(arguments) : Call(name, arguments);
        }

        object List()
        {
            List<object> items = Items(']', false);
            foreach (object item in items)
            {
                if (item == null || item.GetType() != items[0].GetType())
                {
                    throw new FormatException("has a list of several kinds of values");
                }
            }
            return items;
        }

        List<object> Items(char close, bool mayBeLists)
        {
            at++;
            var items = new List<object>();
            SkipSpaces();
            while (Next != close)
            {
                items.Add(Any(mayBeLists));
                SkipSpaces();
                if (Next == close) { break; }
                if (Next != ',') { throw Unexpected(); }
                at++;
                SkipSpaces();
                if (Next == close) { throw Unexpected(); }
            }
            at++;
            return items;
        }

        string Name()
        {
            int start = at;
            while (Next == '_' || (Next < 128 && char.IsLetter(Next)) || (at > start && Next >= '0' && Next <= '9'))
            {
                at++;
            }
            if (at == start) { throw Unexpected(); }
            return text.Substring(start, at - start);
        }

        object Number()
        {
            int start = at++;
            while (Next >= '0' && Next <= '9') { at++; }
            long number;
            if (!long.TryParse(text.Substring(start, at - start), NumberStyles.AllowLeadingSign,
                CultureInfo.InvariantCulture, out number))
            {
                throw new FormatException("has a number that is none or too large");
            }
            return number;
        }

        string VariableName()
        {
            if (at + 1 >= text.Length || text[at + 1] != '{') { throw Unexpected(); }
            at += 2;
            string name = Name();
            if (Next != '}') { throw Unexpected(); }
            at++;
            return name;
        }

        object Variable()
        {
            object value;
            string name = VariableName();
            if (!Find(name, out value)) { throw new FormatException("has no value for the variable '" + name + "'"); }
            return value;
        }

        bool Find(string name, out object value)
        {
            if (around.Contains(name)) { throw new FormatException("leads back to the variable '" + name + "'"); }
            if (!variables.Find(name, out value)) { return false; }
            var inner = value as string;
            if (inner == null || !Is(inner)) { return true; }
            around.Add(name);
            value = Value(inner, variables, around);
            around.RemoveAt(around.Count - 1);
            return true;
        }

        string Quoted(char quote)
        {
            var said = new StringBuilder();
            for (at++; Next != quote;)
            {
                if (at >= text.Length - 1) { throw Unexpected(); }
                if (Next == '\\')
                {
                    Escaped(said);
                    continue;
                }
                if (Next != '$' || text[at + 1] != '{')
                {
                    said.Append(text[at++]);
                    continue;
                }
                int start = at;
                string name = VariableName();
                object value;
                // a variable without a value stays for whoever reads the text
                if (!Find(name, out value)) { said.Append(text, start, at - start); }
                else if (value is string) { said.Append((string)value); }
                else if (value != null)
                {
                    throw new FormatException("has " + Kind(value) + " for '" + name + "' within a text");
                }
            }
            at++;
            return said.ToString();
        }

        // as C has it
        void Escaped(StringBuilder said)
        {
            char letter = text[++at];
            int plain = "abfnrtv".IndexOf(letter);
            if (plain >= 0)
            {
                said.Append("\a\b\f\n\r\t\v"[plain]);
                at++;
            }
            else if (letter == 'x') { Coded(said, 16, 2, at + 1); }
            else if (letter >= '0' && letter <= '7') { Coded(said, 8, 3, at); }
            else
            {
                said.Append(letter);
                at++;
            }
        }

        void Coded(StringBuilder said, int radix, int longest, int start)
        {
            int code = 0;
            for (at = start; at < start + longest; at++)
            {
                int digit = "0123456789abcdef".IndexOf(char.ToLowerInvariant(Next));
                if (digit < 0 || digit >= radix) { break; }
                code = code * radix + digit;
            }
            said.Append((char)code);
        }

        // ---- functions

        static object Call(string name, List<object> arguments)
        {
            switch (name)
            {
                case "if": return If(arguments);
                case "eq": case "neq": case "lt": case "leq": case "gt": case "geq": return Compare(name, arguments);
                case "and": case "or": return Combine(name, arguments);
                case "not":
                    Require(name, arguments, 1, 1);
                    return !Truth(name, arguments[0]);
                case "contains": return Contains(arguments);
                case "at": return At(arguments);
                case "len":
                    Require(name, arguments, 1, 1);
                    return Length(name, arguments[0]);
                default: throw new FormatException("calls '" + name + "', which is no function");
            }
        }

        object IsDefined(List<object> arguments)
        {
            Require("defined", arguments, 1, int.MaxValue);
            bool areDefined = true;
            foreach (object argument in arguments)
            {
                object value;
                var name = argument as string;
                if (name == null) { throw new FormatException("calls 'defined' with " + Kind(argument)); }
                areDefined &= variables.Find(name, out value);
            }
            return areDefined;
        }

        static void Require(string name, List<object> arguments, int least, int most)
        {
            if (arguments.Count < least || arguments.Count > most)
            {
                throw new FormatException("calls '" + name + "' with " + arguments.Count + " values");
            }
        }

        static bool Truth(string name, object value)
        {
            if (value is bool) { return (bool)value; }
            throw new FormatException("calls '" + name + "' with " + Kind(value) + " where a truth is wanted");
        }

        static object If(List<object> arguments)
        {
            Require("if", arguments, 2, 3);
            bool condition = Truth("if", arguments[0]);
            object yes = arguments[1], no = arguments.Count > 2 ? arguments[2] : null;
            if (yes != null && no != null && Kind(yes) != Kind(no))
            {
                throw new FormatException("calls 'if' with " + Kind(yes) + " and " + Kind(no));
            }
            return condition ? yes : no;
        }

        static object Compare(string name, List<object> arguments)
        {
            Require(name, arguments, 2, 2);
            object one = arguments[0], other = arguments[1];
            bool isOrder = name != "eq" && name != "neq";
            if (Kind(one) != Kind(other) || one is List<object> || (one == null && isOrder))
            {
                throw new FormatException("compares " + Kind(one) + " with " + Kind(other));
            }
            int order = one == null ? 0 : one is string ? string.CompareOrdinal((string)one, (string)other)
                : ((IComparable)one).CompareTo(other);
            switch (name)
            {
                case "eq": return order == 0;
                case "neq": return order != 0;
                case "lt": return order < 0;
                case "leq": return order <= 0;
                case "gt": return order > 0;
                default: return order >= 0;
            }
        }

        static object Combine(string name, List<object> arguments)
        {
            Require(name, arguments, 2, int.MaxValue);
            bool isAnd = name == "and", result = isAnd;
            foreach (object argument in arguments)
            {
                bool truth = Truth(name, argument);
                result = isAnd ? result & truth : result | truth;
            }
            return result;
        }

        static object Contains(List<object> arguments)
        {
            Require("contains", arguments, 2, 2);
            var items = arguments[0] as List<object>;
            if (items != null)
            {
                if (items.Count > 0 && Kind(items[0]) != Kind(arguments[1]))
                {
                    throw new FormatException("looks for " + Kind(arguments[1]) + " in a list of other values");
                }
                return items.Contains(arguments[1]);
            }
            var said = arguments[0] as string;
            var part = arguments[1] as string;
            if (said == null || part == null)
            {
                throw new FormatException("looks for " + Kind(arguments[1]) + " in " + Kind(arguments[0]));
            }
            return said.IndexOf(part, StringComparison.Ordinal) >= 0;
        }

        static object At(List<object> arguments)
        {
            Require("at", arguments, 2, 2);
            if (!(arguments[1] is long)) { throw new FormatException("calls 'at' with " + Kind(arguments[1])); }
            long length = Length("at", arguments[0]), index = (long)arguments[1];
            if (index < 0) { index += length; }
            if (index < 0 || index >= length) { throw new FormatException("calls 'at' beyond the end"); }
            var items = arguments[0] as List<object>;
            return items != null ? items[(int)index]
                : Encoding.UTF8.GetString(Encoding.UTF8.GetBytes((string)arguments[0]), (int)index, 1);
        }

        static long Length(string name, object value)
        {
            var items = value as List<object>;
            if (items != null) { return items.Count; }
            var said = value as string;
            if (said == null) { throw new FormatException("calls '" + name + "' with " + Kind(value)); }
            // bytes, as in USD
            return Encoding.UTF8.GetByteCount(said);
        }
    }
}
