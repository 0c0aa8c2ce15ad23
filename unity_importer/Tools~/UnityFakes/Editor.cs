#if UNITY_EDITOR
using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEngine
{
    public struct Hash128
    {
        internal string text;

        public static Hash128 Compute(string data)
        {
            return new Hash128 { text = data };
        }
    }

    public class GUIStyle
    {
    }

    public class GUILayoutOption
    {
    }
}

namespace UnityEditor
{
    [Flags]
    public enum StaticEditorFlags { ContributeGI = 1, OccluderStatic = 2, BatchingStatic = 4, OccludeeStatic = 16,
        ReflectionProbeStatic = 64 }

    public sealed class GameObjectUtility
    {
        public static void SetStaticEditorFlags(GameObject go, StaticEditorFlags flags)
        {
            go.staticFlags = (int)flags;
        }
    }

    public sealed class Unwrapping
    {
        /// <summary>Each vertex in a place of its own.</summary>
#if UNITY_6000_0_OR_NEWER
        public static bool GenerateSecondaryUVSet(Mesh src)
#else
        public static void GenerateSecondaryUVSet(Mesh src)
#endif
        {
            var coordinates = new Vector2[src.vertexCount];
            int side = (int)Math.Ceiling(Math.Sqrt(src.vertexCount));
            for (int i = 0; i < coordinates.Length; i++)
            {
                coordinates[i] = new Vector2((i % side + 0.5f) / side, (i / side + 0.5f) / side);
            }
            src.uv2 = coordinates;
#if UNITY_6000_0_OR_NEWER
            return true;
#endif
        }
    }

    public sealed class InitializeOnLoadMethodAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public sealed class MenuItem : Attribute
    {
        public MenuItem(string itemName)
        {
        }

        public MenuItem(string itemName, bool isValidateFunction)
        {
        }
    }

    public sealed class CustomEditor : Attribute
    {
        public CustomEditor(Type inspectedType)
        {
        }
    }

    public class CanEditMultipleObjects : Attribute
    {
    }

    public class EditorUtility
    {
        /// <summary>Looks at the progress so far, and after how many of them the user gives up.</summary>
        internal static int looks, looksToCancel = int.MaxValue;

        internal static bool isShown;

        /// <summary>What the user picks.</summary>
        internal static string pickedFile = "";

        public static bool DisplayCancelableProgressBar(string title, string info, float progress)
        {
            if (!(progress >= 0 && progress <= 1)) { throw new ArgumentOutOfRangeException("progress"); }
            isShown = true;
            return ++looks >= looksToCancel;
        }

        public static void ClearProgressBar()
        {
            isShown = false;
        }

        public static string OpenFilePanel(string title, string directory, string extension)
        {
            return pickedFile;
        }

        public static bool DisplayDialog(string title, string message, string ok)
        {
            return true;
        }
    }

    public class AssetDatabase
    {
        internal static readonly Dictionary<string, Object> assets = new Dictionary<string, Object>();
        internal static readonly Dictionary<string, Hash128> dependencies = new Dictionary<string, Hash128>();

        public static void RegisterCustomDependency(string dependency, Hash128 hashOfValue)
        {
            dependencies[dependency] = hashOfValue;
        }

        public static bool IsAssetImportWorkerProcess()
        {
            return false;
        }

        public static void CreateAsset(Object asset, string path)
        {
            assets[path] = asset;
        }

        /// <summary>Runs the importer of the file's extension.</summary>
        public static void ImportAsset(string path)
        {
            foreach (Assembly assembly in AppDomain.CurrentDomain.GetAssemblies())
            {
                foreach (Type type in assembly.GetTypes())
                {
                    object[] marks = type.GetCustomAttributes(typeof(AssetImporters.ScriptedImporterAttribute), false);
                    string extension = System.IO.Path.GetExtension(path).TrimStart('.');
                    if (marks.Length == 0
                        || Array.IndexOf(((AssetImporters.ScriptedImporterAttribute)marks[0]).fileExtensions,
                        extension) < 0)
                    {
                        continue;
                    }
                    var context = new AssetImporters.AssetImportContext { assetPath = path };
                    ((AssetImporters.ScriptedImporter)Activator.CreateInstance(type)).OnImportAsset(context);
                    assets[path] = context.mainObject;
                }
            }
        }

        public static bool DeleteAsset(string path)
        {
            System.IO.Directory.Delete(path, true);
            return true;
        }

        public static T LoadAssetAtPath<T>(string assetPath) where T : Object
        {
            Object found;
            return assets.TryGetValue(assetPath, out found) ? found as T : null;
        }

        /// <summary>The path of an asset whose .meta in the folder Assets has a GUID; empty where there is none, as
        /// Unity's.</summary>
        public static string GUIDToAssetPath(string guid)
        {
            foreach (string meta in System.IO.Directory.GetFiles("Assets", "*.meta",
                System.IO.SearchOption.AllDirectories))
            {
                if (System.IO.File.ReadAllText(meta).Contains("guid: " + guid + "\n"))
                {
                    return System.IO.Path.ChangeExtension(meta, null).Replace('\\', '/');
                }
            }
            return "";
        }

        public static void SaveAssets()
        {
        }

        public static void Refresh()
        {
        }
    }

    public sealed class Selection
    {
        public static Object activeObject { get; set; }
    }

    public sealed class PrefabUtility
    {
        public static Object InstantiatePrefab(Object assetComponentOrGameObject)
        {
            return ((GameObject)assetComponentOrGameObject).Clone(null);
        }
    }

    public class Undo
    {
        public static void RegisterCreatedObjectUndo(Object objectToUndo, string name)
        {
        }
    }

    /// <summary>Knows the fields of its object.</summary>
    public class SerializedProperty
    {
        internal object value;
        internal string path;

        public SerializedProperty FindPropertyRelative(string relativePropertyPath)
        {
            return SerializedObject.Find(value, relativePropertyPath, path + "." + relativePropertyPath);
        }
    }

    public class SerializedObject
    {
        readonly Object target;

        internal SerializedObject(Object target)
        {
            this.target = target;
        }

        public SerializedProperty FindProperty(string propertyPath)
        {
            return Find(target, propertyPath, propertyPath);
        }

        internal static SerializedProperty Find(object holder, string name, string path)
        {
            FieldInfo field = holder.GetType().GetField(name, BindingFlags.Instance | BindingFlags.Public
                | BindingFlags.NonPublic);
            bool isSerialised = field != null && (field.IsPublic || field.IsDefined(typeof(SerializeField), false));
            return isSerialised ? new SerializedProperty { value = field.GetValue(holder), path = path } : null;
        }

        public void Update()
        {
        }

        public bool ApplyModifiedProperties()
        {
            return false;
        }
    }

    public class Editor : ScriptableObject
    {
        internal Object edited;

        public SerializedObject serializedObject { get { return new SerializedObject(edited); } }

        public virtual void OnInspectorGUI()
        {
        }
    }

    public enum MessageType { None, Info, Warning, Error }

    public sealed class EditorStyles
    {
        static readonly GUIStyle Bold = new GUIStyle();

        public static GUIStyle boldLabel { get { return Bold; } }
    }

    /// <summary>Notes what is drawn.</summary>
    public sealed class EditorGUILayout
    {
        internal static readonly List<string> drawn = new List<string>();

        public static void LabelField(string label, GUIStyle style, params GUILayoutOption[] options)
        {
            drawn.Add("# " + label);
        }

        public static bool PropertyField(SerializedProperty property, bool includeChildren,
            params GUILayoutOption[] options)
        {
            drawn.Add(property.path);
            return false;
        }

        public static void HelpBox(string message, MessageType type)
        {
            drawn.Add("! " + message);
        }

        public static void Space()
        {
        }
    }
}

namespace UnityEditor.AssetImporters
{
    /// <summary>What an importer made, and what it said.</summary>
    public class AssetImportContext
    {
        internal readonly Dictionary<string, Object> objects = new Dictionary<string, Object>();
        internal readonly List<string> warnings = new List<string>(), errors = new List<string>(),
            sources = new List<string>(), dependencies = new List<string>();

        public string assetPath { get; internal set; }
        public Object mainObject { get; private set; }

        public void AddObjectToAsset(string identifier, Object obj)
        {
            if (obj == null || string.IsNullOrEmpty(identifier))
            {
                throw new ArgumentException("an asset needs an object and an identifier");
            }
            objects.Add(identifier, obj);
        }

        public void SetMainObject(Object obj)
        {
            if (!objects.ContainsValue(obj)) { throw new ArgumentException("the main object has not been added"); }
            mainObject = obj;
        }

        public void DependsOnSourceAsset(string path)
        {
            if (path.IndexOf('\\') >= 0 || path.StartsWith("/", StringComparison.Ordinal))
            {
                throw new ArgumentException(path + " is no path of the project");
            }
            sources.Add(path);
        }

        public void DependsOnCustomDependency(string dependency)
        {
            dependencies.Add(dependency);
        }

        public void LogImportWarning(string msg, Object obj = null)
        {
            warnings.Add(msg);
        }

        public void LogImportError(string msg, Object obj = null)
        {
            errors.Add(msg);
        }
    }

    [AttributeUsage(AttributeTargets.Class, Inherited = false)]
    public class ScriptedImporterAttribute : Attribute
    {
        public ScriptedImporterAttribute(int version, string[] exts) : this(version, exts, null)
        {
        }

        public ScriptedImporterAttribute(int version, string[] exts, string[] overrideExts)
        {
            fileExtensions = exts;
            overrideFileExtensions = overrideExts;
        }

        public string[] fileExtensions { get; private set; }
        public string[] overrideFileExtensions { get; private set; }
    }

    public abstract class ScriptedImporter : AssetImporter
    {
        public abstract void OnImportAsset(AssetImportContext ctx);
    }

    public abstract class AssetImporterEditor : Editor
    {
        internal Object shown;

        protected internal Object assetTarget { get { return shown; } }

        protected void ApplyRevertGUI()
        {
        }
    }

    public class ScriptedImporterEditor : AssetImporterEditor
    {
    }
}

namespace UnityEditor
{
    public class AssetImporter : Object
    {
    }
}
#endif
