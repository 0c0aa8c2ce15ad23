using System;

namespace UnityEngine
{
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class SerializeField : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field, Inherited = true, AllowMultiple = false)]
    public class TooltipAttribute : Attribute
    {
        public readonly string tooltip;

        public TooltipAttribute(string tooltip)
        {
            this.tooltip = tooltip;
        }
    }

    [AttributeUsage(AttributeTargets.Field, Inherited = true, AllowMultiple = false)]
    public sealed class MinAttribute : Attribute
    {
        public readonly float min;

        public MinAttribute(float min)
        {
            this.min = min;
        }
    }

    public sealed class AddComponentMenu : Attribute
    {
        public AddComponentMenu(string menuName)
        {
        }
    }

    public sealed class ContextMenu : Attribute
    {
        public ContextMenu(string itemName)
        {
        }
    }

    public sealed class DisallowMultipleComponent : Attribute
    {
    }

    public class Debug
    {
        public static void LogException(Exception exception, Object context)
        {
            Console.Error.WriteLine(exception);
        }

        public static void LogWarning(object message)
        {
            Console.Error.WriteLine(message);
        }
    }

    public class Application
    {
        internal static string streaming = "";

        public static string streamingAssetsPath { get { return streaming; } }
    }

    public class Resources
    {
        /// <summary>What a test puts there, by its path.</summary>
        internal static readonly System.Collections.Generic.Dictionary<string,
            Object> stored = new System.Collections.Generic.Dictionary<string, Object>();

        public static T Load<T>(string path) where T : Object
        {
            Object found;
            return stored.TryGetValue(path, out found) ? found as T : null;
        }
    }

    public class Time
    {
        public static float deltaTime { get; internal set; }
    }
}
