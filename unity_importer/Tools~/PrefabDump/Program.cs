using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Reflection;
using System.Text;
using System.Threading;
using Garage.Unity;
using Garage.Unity.Editor;
using Garage.Usd;
using Garage.Usd.Dump;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity.Dump
{
    /// <summary>The pipelines' assets, told by their names alone.</summary>
    sealed class UniversalRenderPipelineAsset : RenderPipelineAsset
    {
    }

    sealed class HDRenderPipelineAsset : RenderPipelineAsset
    {
    }

    /// <summary>
    /// Imports a stage on fakes of Unity's classes and prints what it became as a line of JSON. <c>prefab FILE
    /// [SETTING=VALUE ...]</c> all of it,
    /// <c>time FILE COUNT</c> what it costs, <c>load FILE</c> what the loader of players makes, <c>ways FILE FROM TO
    /// ...</c> ways between
    /// stalls, <c>near FILE X Y Z ...</c> the nearest lanes, <c>drive FILE COUNT</c> where the sample is at so many
    /// tenths of a second, <c>traffic FILE TABLE SECOND ...</c> where agents of tracks are; <c>batch</c> takes such commands from lines of the standard input, parts separated
    /// by tabs.
    /// </summary>
    static class Program
    {
        static int Main(string[] arguments)
        {
            Console.InputEncoding = new UTF8Encoding(false);
            var output = new StreamWriter(Console.OpenStandardOutput(), new UTF8Encoding(false), 1 << 16);
            if (arguments.Length == 1 && arguments[0] == "batch")
            {
                string line;
                while ((line = Console.In.ReadLine()) != null)
                {
                    output.WriteLine(Answer(line.Split('\t')));
                    output.Flush();
                }
                return 0;
            }
            if (arguments.Length < 2)
            {
                Console.Error.WriteLine("usage: PrefabDump prefab FILE [SETTING=VALUE ...] | time FILE COUNT | load FILE"
                    + " | ways FILE FROM TO ... | near FILE X Y Z ... | drive FILE COUNT | scene FILE COUNT FIELD=VALUE ... | traffic FILE TABLE SECOND ..."
                    + " | batch");
                return 2;
            }
            output.WriteLine(Answer(arguments));
            output.Flush();
            return 0;
        }

        static string Answer(string[] command)
        {
            try
            {
                return Made(command);
            }
            catch (Exception crash)
            {
                var json = new JsonText();
                json.Open('{');
                json.Key("crash");
                json.String(crash.ToString());
                json.Close('}');
                return json.ToString();
            }
        }

        static string Made(string[] command)
        {
            string file = Path.GetFullPath(command[1]);
            var rest = new string[command.Length - 2];
            Array.Copy(command, 2, rest, 0, rest.Length);
            switch (command[0])
            {
                case "prefab": return Prefab(file, rest);
                case "time": return Times(file, int.Parse(rest[0]));
                case "load": return Load(file, rest);
                case "ways": return LaneDump.Ways(Imported(file, new string[0]), rest);
                case "drive": return LaneDump.Drive(Imported(file, new string[0]), int.Parse(rest[0]));
                case "scene": return SceneDump.Play(Imported(file, new string[0]), file, rest);
                case "near": return LaneDump.Near(Imported(file, new string[0]), rest);
                case "traffic": return TrafficDump.Play(Imported(file, new string[0]), rest);
                default: return "{\"error\":\"unknown command\"}";
            }
        }

        // the project is the folder around Assets or Packages, else that above the file's
        static AssetImportContext Import(string file, string[] settings, out UsdImporter importer)
        {
            int top = Math.Max(file.IndexOf("/Assets/", StringComparison.Ordinal),
                file.IndexOf("/Packages/", StringComparison.Ordinal));
            string project = top >= 0 ? file.Substring(0, top) : Path.GetDirectoryName(Path.GetDirectoryName(file));
            Directory.SetCurrentDirectory(project);
            var context = new AssetImportContext { assetPath = file.Substring(project.Length).TrimStart('/') };
            importer = new UsdImporter();
            Apply(settings, importer.Settings);
            importer.OnImportAsset(context);
            return context;
        }

        static GameObject Imported(string file, string[] settings)
        {
            UsdImporter importer;
            AssetImportContext context = Import(file, settings, out importer);
            return (GameObject)context.mainObject;
        }

        /// <summary>Fields of the settings, and a few words on the project itself.</summary>
        static void Apply(string[] pairs, ImportSettings settings)
        {
            GraphicsSettings.inUse = null;
            GraphicsSettings.lightsUseLinearIntensity = true;
            QualitySettings.inUse = ColorSpace.Linear;
            Shader.areFound = true;
            Resources.stored.Clear();
            EditorUtility.looks = 0;
            EditorUtility.looksToCancel = int.MaxValue;
            foreach (string pair in pairs)
            {
                int equals = pair.IndexOf('=');
                string name = pair.Substring(0, equals), value = pair.Substring(equals + 1);
                switch (name)
                {
                    case "project": GraphicsSettings.inUse = value == "URP" ? new UniversalRenderPipelineAsset()
                        : (RenderPipelineAsset)new HDRenderPipelineAsset(); break;
                    case "curved": GraphicsSettings.lightsUseLinearIntensity = false; break;
                    case "reference":
                        Resources.stored["GarageMaterials/Lit"] = ReferenceMaterials.Make(PipelineKind.Automatic)[0];
                        break;
                    case "stripped": Shader.areFound = false; break;
                    case "gamma": QualitySettings.inUse = ColorSpace.Gamma; break;
                    case "cancel": EditorUtility.looksToCancel = int.Parse(value); break;
                    default:
                        FieldInfo field = typeof(ImportSettings).GetField(name);
                        object parsed = field.FieldType.IsEnum ? Enum.Parse(field.FieldType, value)
                            : field.FieldType == typeof(string[]) ? value.Split(',')
                            : Convert.ChangeType(value, field.FieldType,
                            System.Globalization.CultureInfo.InvariantCulture);
                        field.SetValue(settings, parsed);
                        break;
                }
            }
        }

        static string Prefab(string file, string[] settings)
        {
            UsdImporter importer;
            AssetImportContext context = Import(file, settings, out importer);
            var json = new JsonText();
            json.Open('{');
            Texts(json, "errors", context.errors);
            Texts(json, "warnings", context.warnings);
            Texts(json, "sources", context.sources);
            Texts(json, "dependencies", context.dependencies);
            json.Key("progressBarLeft");
            json.Bool(EditorUtility.isShown);
            Texts(json, "inspector", Inspector(importer, context.mainObject));
            if (context.mainObject != null) { new PrefabDump(json, context).Write(); }
            json.Close('}');
            return json.ToString();
        }

        static void Texts(JsonText json, string key, IEnumerable<string> texts)
        {
            json.Key(key);
            json.Open('[');
            foreach (string text in texts) { json.String(text); }
            json.Close(']');
        }

        static List<string> Inspector(UsdImporter importer, UnityEngine.Object shown)
        {
            EditorGUILayout.drawn.Clear();
            new UsdImporterEditor { edited = importer, shown = shown }.OnInspectorGUI();
            return new List<string>(EditorGUILayout.drawn);
        }

        /// <summary>Seconds of the processor for each of several imports: reading and composing, then making the
        /// prefab.</summary>
        static string Times(string file, int count)
        {
            var json = new JsonText();
            json.Open('{');
            json.Key("imports");
            json.Open('[');
            for (int i = 0; i < count; i++)
            {
                GC.Collect();
                TimeSpan start = Process.GetCurrentProcess().TotalProcessorTime;
                var files = new FolderResolver(Path.GetDirectoryName(file));
                SceneModel scene = StageReader.Read(files, Path.GetFileName(file));
                LabelTable table = StageReader.Labels(files, Path.GetFileNameWithoutExtension(file));
                TimeSpan read = Process.GetCurrentProcess().TotalProcessorTime;
                var builder = new SceneBuilder(scene, table, new ImportSettings(), "garage", true);
                builder.Run();
                TimeSpan made = Process.GetCurrentProcess().TotalProcessorTime;
                json.Open('{');
                Number(json, "read_s", (read - start).TotalSeconds);
                Number(json, "make_s", (made - read).TotalSeconds);
                Number(json, "total_s", (made - start).TotalSeconds);
                Number(json, "objects", builder.Root.GetComponentsInChildren<Transform>(true).Length);
                Number(json, "renderers", builder.Root.GetComponentsInChildren<MeshRenderer>(true).Length);
                Number(json, "assets", builder.Assets.Count);
                json.Close('}');
            }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }

        static void Number(JsonText json, string key, double value)
        {
            json.Key(key);
            json.Number(value);
        }

        sealed class Steps : IProgress<float>
        {
            public readonly List<float> Seen = new List<float>();
            public Action<float> Then = value => { };

            public void Report(float value)
            {
                lock (Seen) { Seen.Add(value); }
                Then(value);
            }
        }

        static string Load(string file, string[] settings)
        {
            var options = new ImportSettings();
            string root = Path.GetDirectoryName(file);
            if (settings.Length > 0 && settings[0].StartsWith("root=", StringComparison.Ordinal))
            {
                root = settings[0].Substring(5);
                settings = new string[0];
            }
            Apply(settings, options);
            var json = new JsonText();
            json.Open('{');
            var steps = new Steps();
            using (var cancel = new CancellationTokenSource())
            {
                if (EditorUtility.looksToCancel == 1) { cancel.Cancel(); }
                else if (EditorUtility.looksToCancel == 2) { steps.Then = value => cancel.Cancel(); }
                var parent = new GameObject("Parent");
                Texture2D.dropped = 0;
                try
                {
                    LoadedStage loaded = file.EndsWith(".usdz", StringComparison.Ordinal)
                        ? StageLoader.LoadAsync(File.ReadAllBytes(file), Path.GetFileNameWithoutExtension(file),
                        options, parent.transform, steps, cancel.Token).GetAwaiter().GetResult()
                        : StageLoader.LoadAsync(file, root, options, parent.transform, steps,
                        cancel.Token).GetAwaiter().GetResult();
                    Number(json, "objects", loaded.Root.GetComponentsInChildren<Transform>(true).Length);
                    Number(json, "renderers", parent.GetComponentsInChildren<MeshRenderer>().Length);
                    Number(json, "steps", steps.Seen.Count);
                    Number(json, "droppedTextures", Texture2D.dropped);
                    Number(json, "last", steps.Seen[steps.Seen.Count - 1]);
                    loaded.Dispose();
                }
                catch (Exception failure)
                {
                    json.Key("failure");
                    json.String(failure.GetType().Name + ": " + failure.Message);
                }
                Number(json, "left", parent.transform.childCount);
            }
            json.Close('}');
            return json.ToString();
        }
    }
}
