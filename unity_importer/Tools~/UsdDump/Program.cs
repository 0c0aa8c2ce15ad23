using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Text;

namespace Garage.Usd.Dump
{
    /// <summary>
    /// Prints what the readers make of a file as one line of JSON: <c>layer FILE</c> one layer,
    /// <c>stage FILE [ROOT]</c> the composed prims, <c>scene FILE</c> what is to be shown;
    /// <c>time SECONDS FILE...</c> how long it takes to read all of them, <c>fuzz FILE</c> tells only whether that ends well; <c>basis FILE W X Y Z</c>
    /// takes a quaternion and its vector to the axes of Unity; <c>batch</c> takes such commands from lines of the
    /// standard input, parts separated by tabs.
    /// </summary>
    static class Program
    {
        const long MostDumped = 20000;

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
                Console.Error.WriteLine("usage: UsdDump layer|stage|scene FILE | time SECONDS FILE... | batch");
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
                switch (command[0])
                {
                    case "layer": return LayerDump.Of(LayerReader.Read(File.ReadAllBytes(command[1]), command[1]));
                    case "stage": return StageDump.Of(command.Length > 2 ? UsdStage.Open(command[1], command[2])
                        : UsdStage.Open(command[1]));
                    case "scene": return SceneDump.Of(UsdStage.Open(command[1]));
                    case "fuzz": return Survival(command[1]);
                    case "basis": return InUnity(command[1], Number(command[2]), Number(command[3]),
                        Number(command[4]), Number(command[5]));
                    case "time": return Time(Number(command[1]), Rest(command, 2));
                    default: return "{\"error\":\"unknown command\"}";
                }
            }
            catch (UsdFormatException refusal)
            {
                var json = new JsonText();
                json.Open('{');
                json.Key("refused");
                json.Open('[');
                json.String(refusal.File);
                json.String(refusal.Place);
                json.String(refusal.Reason);
                json.Close(']');
                json.Close('}');
                return json.ToString();
            }
        }

        /// <summary>Whether reading the file ends well: with a scene or a refusal, and what it costs.</summary>
        static string Survival(string path)
        {
            var json = new JsonText();
            json.Open('{');
            long bytesBefore = GC.GetTotalMemory(true);
            TimeSpan before = Process.GetCurrentProcess().UserProcessorTime;
            try
            {
                UsdStage stage = UsdStage.Open(path);
                StageDump.Of(stage);
                // what is shown at very many places is not written out for each of them
                if (new SceneModel(stage).ShownCount <= MostDumped) { SceneDump.Of(stage); }
            }
            catch (UsdFormatException refusal)
            {
                json.Key("refused");
                json.String(refusal.Message);
            }
            catch (Exception crash)
            {
                json.Key("crash");
                json.String(crash.ToString());
            }
            json.Key("cpu_s");
            json.Number((Process.GetCurrentProcess().UserProcessorTime - before).TotalSeconds);
            json.Key("bytes");
            json.Number(GC.GetTotalMemory(false) - bytesBefore);
            json.Close('}');
            return json.ToString();
        }

        static string[] Rest(string[] command, int first)
        {
            var rest = new string[command.Length - first];
            Array.Copy(command, first, rest, 0, rest.Length);
            return rest;
        }

        static double Number(string text)
        {
            return double.Parse(text, CultureInfo.InvariantCulture);
        }

        static string InUnity(string path, double w, double x, double y, double z)
        {
            Basis basis = Basis.Of(UsdStage.Open(path));
            var direction = new double[3];
            basis.Direction(x, y, z, direction);
            float[] point = basis.Vectors(new[] { (float)x, (float)y, (float)z }, true);
            double[] placed = Matrix4.Multiply(Matrix4.Quaternion(w, x, y, z), Matrix4.Translation(x, y, z));
            var json = new JsonText();
            json.Open('{');
            Numbers(json, "direction", direction);
            Numbers(json, "point", Array.ConvertAll(point, delegate(float number) { return (double)number; }));
            Numbers(json, "rotation", basis.Rotation(w, x, y, z));
            Numbers(json, "matrix", basis.Matrix(placed));
            json.Close('}');
            return json.ToString();
        }

        static void Numbers(JsonText json, string key, double[] numbers)
        {
            json.Key(key);
            json.Open('[');
            foreach (double number in numbers) { json.Number(number); }
            json.Close(']');
        }

        /// <summary>
        /// Processor seconds that reading all files takes, in rounds until the given seconds are over; the first is not
        /// counted.
        /// </summary>
        static string Time(double seconds, string[] paths)
        {
            var files = new List<byte[]>();
            long size = 0;
            foreach (string path in paths)
            {
                files.Add(File.ReadAllBytes(path));
                size += files[files.Count - 1].Length;
            }
            int rounds = -1;
            double spent = 0;
            while (spent < seconds)
            {
                GC.Collect();
                double before = ProcessorSeconds();
                for (int i = 0; i < paths.Length; i++) { LayerReader.Read(files[i], paths[i]); }
                if (rounds++ >= 0) { spent += ProcessorSeconds() - before; }
            }
            var json = new JsonText();
            json.Open('{');
            json.Key("bytes");
            json.Number(size);
            json.Key("seconds");
            json.Number(spent / rounds);
            json.Close('}');
            return json.ToString();
        }

        static double ProcessorSeconds()
        {
            return Process.GetCurrentProcess().TotalProcessorTime.TotalSeconds;
        }
    }
}
