using System;
using System.Collections.Generic;
using System.Reflection;
using System.Reflection.Emit;
using System.Text;

namespace Garage.Unity.Members
{
    /// <summary>
    /// Prints which members of an assembly others use, a line each: kind, type, name, result and parameters, separated
    /// by tabs. Usage: MemberList
    /// USED.dll USER.dll ... It reads the compiled code, so that nothing that is called is missed; constants of
    /// enumerations are not in it.
    /// </summary>
    static class Program
    {
        static readonly Dictionary<short, OpCode> Codes = MakeCodes();
        static readonly SortedSet<string> Found = new SortedSet<string>(StringComparer.Ordinal);
        static readonly Dictionary<Type, string> Short = new Dictionary<Type, string>
        {
            { typeof(void), "void" }, { typeof(bool), "bool" }, { typeof(byte), "byte" }, { typeof(int), "int" },
                { typeof(uint), "uint" }, { typeof(long), "long" },
            { typeof(ulong), "ulong" }, { typeof(float), "float" }, { typeof(double), "double" },
                { typeof(string), "string" }, { typeof(object), "object" },
        };

        const BindingFlags All = BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public
            | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;
        static Assembly used;

        static int Main(string[] arguments)
        {
            used = Assembly.LoadFrom(arguments[0]);
            for (int i = 1; i < arguments.Length; i++)
            {
                foreach (Type type in Assembly.LoadFrom(arguments[i]).GetTypes()) { Look(type); }
            }
            foreach (Type type in used.GetExportedTypes())
            {
                if (!type.IsEnum) { continue; }
                foreach (string name in Enum.GetNames(type))
                {
                    Note("enum", type, name, Convert.ToInt64(Enum.Parse(type, name)).ToString());
                }
            }
            foreach (string line in Found) { Console.WriteLine(line); }
            return 0;
        }

        static Dictionary<short, OpCode> MakeCodes()
        {
            var codes = new Dictionary<short, OpCode>();
            foreach (FieldInfo field in typeof(OpCodes).GetFields(BindingFlags.Public | BindingFlags.Static))
            {
                var code = (OpCode)field.GetValue(null);
                codes[code.Value] = code;
            }
            return codes;
        }

        static void Look(Type type)
        {
            if (type.BaseType != null) { Note(type.BaseType); }
            Attributes(type.GetCustomAttributesData());
            foreach (FieldInfo field in type.GetFields(All))
            {
                Note(field.FieldType);
                Attributes(field.GetCustomAttributesData());
            }
            foreach (PropertyInfo property in type.GetProperties(All))
            {
                Attributes(property.GetCustomAttributesData());
            }
            foreach (MethodInfo method in type.GetMethods(All))
            {
                Note(method.ReturnType);
                Attributes(method.GetCustomAttributesData());
                MethodInfo first = method.GetBaseDefinition();
                if (first != method) { Note(first); }
                Body(method, type.IsGenericType ? type.GetGenericArguments() : null, method.IsGenericMethod
                    ? method.GetGenericArguments() : null);
            }
            foreach (ConstructorInfo constructor in type.GetConstructors(All))
            {
                Body(constructor, type.IsGenericType ? type.GetGenericArguments() : null, null);
            }
        }

        static void Attributes(IEnumerable<CustomAttributeData> attributes)
        {
            foreach (CustomAttributeData attribute in attributes) { Note(attribute.Constructor); }
        }

        static void Body(MethodBase method, Type[] ofType, Type[] ofMethod)
        {
            foreach (ParameterInfo parameter in method.GetParameters()) { Note(parameter.ParameterType); }
            MethodBody body = method.GetMethodBody();
            if (body == null) { return; }
            foreach (LocalVariableInfo local in body.LocalVariables) { Note(local.LocalType); }
            byte[] code = body.GetILAsByteArray();
            for (int at = 0; at < code.Length;)
            {
                short value = code[at++];
                if (value == 0xfe) { value = (short)(0xfe00 | code[at++]); }
                OpCode operation = Codes[value];
                switch (operation.OperandType)
                {
                    case OperandType.InlineMethod: case OperandType.InlineField:
                    case OperandType.InlineType: case OperandType.InlineTok:
                        Note(method.Module.ResolveMember(BitConverter.ToInt32(code, at), ofType, ofMethod));
                        break;
                    case OperandType.InlineSwitch: at += 4 * BitConverter.ToInt32(code, at); break;
                }
                at += Size(operation.OperandType);
            }
        }

        static int Size(OperandType type)
        {
            switch (type)
            {
                case OperandType.InlineNone: return 0;
                case OperandType.ShortInlineBrTarget: case OperandType.ShortInlineI: return 1;
                case OperandType.ShortInlineVar: return 1;
                case OperandType.InlineVar: return 2;
                case OperandType.InlineI8: case OperandType.InlineR: return 8;
                default: return 4;
            }
        }

        static void Note(MemberInfo member)
        {
            var type = member as Type;
            var method = member as MethodBase;
            var field = member as FieldInfo;
            if (type != null)
            {
                while (type.HasElementType) { type = type.GetElementType(); }
                if (type.IsGenericType)
                {
                    foreach (Type argument in type.GetGenericArguments()) { Note(argument); }
                }
                if (type.Assembly == used && !type.IsGenericParameter) { Note("type", type, "", ""); }
                return;
            }
            Type owner = member.DeclaringType;
            if (owner == null || owner.Assembly != used) { return; }
            Note(owner);
            if (field != null) { Note(owner.IsEnum ? "value" : "field", owner, field.Name, Name(field.FieldType)); }
            if (method == null) { return; }
            var info = method as MethodInfo;
            if (info != null && info.IsGenericMethod) { method = info = info.GetGenericMethodDefinition(); }
            ParameterInfo[] parameters = method.GetParameters();
            bool isAccessor = method.IsSpecialName
                && (method.Name.StartsWith("get_", StringComparison.Ordinal)
                || method.Name.StartsWith("set_", StringComparison.Ordinal));
            if (isAccessor)
            {
                string value = Name(method.Name[0] == 'g' ? info.ReturnType
                    : parameters[parameters.Length - 1].ParameterType);
                Note(method.Name.Substring(0, 3), owner, method.Name.Substring(4), (method.IsStatic ? "static " : "")
                    + value);
                return;
            }
            var text = new StringBuilder();
            text.Append(method.IsStatic && !method.IsConstructor ? "static " : "").Append(info == null ? ""
                : Name(info.ReturnType));
            foreach (ParameterInfo parameter in parameters) { text.Append('\t').Append(Name(parameter.ParameterType)); }
            Note(method.IsConstructor ? "constructor" : "method", owner, method.Name, text.ToString());
        }

        static void Note(string kind, Type type, string name, string rest)
        {
            Found.Add(kind + "\t" + type.Namespace + "\t" + (type.IsNested ? type.DeclaringType.Name + "." : "")
                + type.Name + "\t" + name + "\t" + rest);
        }

        // as sources write it, without namespaces
        static string Name(Type type)
        {
            string name;
            if (type.IsByRef) { return "ref " + Name(type.GetElementType()); }
            if (type.IsArray) { return Name(type.GetElementType()) + "[]"; }
            if (Short.TryGetValue(type, out name)) { return name; }
            if (!type.IsGenericType) { return type.Name; }
            var arguments = new List<string>();
            foreach (Type argument in type.GetGenericArguments()) { arguments.Add(Name(argument)); }
            return type.Name.Substring(0, type.Name.IndexOf('`')) + "<" + string.Join(",", arguments.ToArray()) + ">";
        }
    }
}
