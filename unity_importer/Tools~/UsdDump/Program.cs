using System;
using System.Diagnostics;
using System.IO;
using System.Text;

namespace Garage.Usd.Dump
{
    /// <summary>
    /// Prints what the readers make of a file as one line of JSON: <c>layer FILE</c> one layer,
    /// <c>stage FILE</c> the composed prims, <c>scene FILE</c> what is to be shown; <c>time FILE COUNT</c> reads it several
    /// times; <c>batch</c> takes such commands from lines of the standard input, parts separated by tabs.
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
                Console.Error.WriteLine("usage: UsdDump layer|stage|scene FILE | time FILE COUNT | batch");
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
                    case "stage": return StageDump.Of(UsdStage.Open(command[1]));
                    case "scene": return SceneDump.Of(UsdStage.Open(command[1]));
                    case "time": return Time(command[1], int.Parse(command[2]));
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

        static string Time(string path, int count)
        {
            byte[] bytes = File.ReadAllBytes(path);
            var json = new JsonText();
            json.Open('{');
            json.Key("megabytes_per_s");
            json.Open('[');
            for (int i = 0; i < count; i++)
            {
                TimeSpan before = Process.GetCurrentProcess().UserProcessorTime;
                LayerReader.Read(bytes, path);
                json.Number(Math.Round(bytes.Length / 1e6 / (Process.GetCurrentProcess().UserProcessorTime - before).TotalSeconds, 1));
            }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }
    }
}
