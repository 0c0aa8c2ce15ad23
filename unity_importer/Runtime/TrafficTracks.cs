using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;

namespace Garage.Unity
{
    /// <summary>
    /// Tracks of a garage in operation, as <c>garage2usd traffic</c> writes them: a table (.csv) with a row for each
    /// sample of an agent, and the agents in a file (.json) of the same name beside it.
    /// </summary>
    public sealed class TrafficTracks
    {
        const int Form = 1;

        static readonly string[] Numbers =
        {
            "x_m", "y_m", "z_m", "yaw_rad", "pitch_rad", "speed_m_s", "steering_rad", "time_s", "level",
        };

        readonly List<TrafficAgent> agents = new List<TrafficAgent>();
        readonly Dictionary<string, TrafficAgent> byName = new Dictionary<string, TrafficAgent>();

        /// <summary>Seconds from the beginning to the end.</summary>
        public double Duration { get; private set; }

        /// <summary>Cars, people and others, in the order of their first rows.</summary>
        public int AgentCount
        {
            get { return agents.Count; }
        }

        /// <summary>An agent by its number. Throws ArgumentOutOfRangeException.</summary>
        public TrafficAgent AgentAt(int number)
        {
            return agents[number];
        }

        /// <summary>The agent of a name; null where there is none.</summary>
        public TrafficAgent Find(string name)
        {
            TrafficAgent agent;
            return byName.TryGetValue(name, out agent) ? agent : null;
        }

        /// <summary>Reads both files. Throws FormatException where they are damaged or do not belong to each
        /// other.</summary>
        public static TrafficTracks Read(byte[] table, byte[] heading)
        {
            var tracks = new TrafficTracks();
            int samples = tracks.ReadHeading(heading), rows = tracks.ReadTable(table);
            if (rows != samples)
            {
                throw new FormatException(rows + " of " + samples + " samples are in the table");
            }
            foreach (TrafficAgent agent in tracks.agents)
            {
                if (agent.Count == 0) { throw new FormatException(agent.Name + " has no row in the table"); }
            }
            return tracks;
        }

        int ReadHeading(byte[] heading)
        {
            var reader = new JsonReader(heading);
            int samples = -1, form = -1;
            reader.EachKey(key =>
            {
                switch (key)
                {
                    case "form": form = reader.Whole(); break;
                    case "samples": samples = reader.Whole(); break;
                    case "duration_s": Duration = reader.Number(); break;
                    case "agents": reader.Each('[', ']', () => ReadAgent(reader)); break;
                    default: reader.Skip(); break;
                }
            });
            if (form != Form) { throw new FormatException("the form of the tracks is " + form + ", not " + Form); }
            return samples;
        }

        void ReadAgent(JsonReader reader)
        {
            var words = new Dictionary<string, string>();
            var sizes = new Dictionary<string, double>();
            reader.EachKey(key =>
            {
                if (key.EndsWith("_m", StringComparison.Ordinal)) { sizes[key] = reader.Number(); }
                else { words[key] = reader.Text(); }
            });
            var agent = new TrafficAgent(words, sizes);
            if (byName.ContainsKey(agent.Name)) { throw new FormatException(agent.Name + " is there twice"); }
            byName.Add(agent.Name, agent);
            agents.Add(agent);
        }

        int ReadTable(byte[] table)
        {
            var cells = new List<string>();
            int at = NextRow(table, 0, cells), rows = 0;
            int agent = Column(cells, "agent"), state = Column(cells, "state"), stall = Column(cells, "stall");
            int[] columns = Array.ConvertAll(Numbers, name => Column(cells, name));
            var known = new Dictionary<string, string>();
            TrafficAgent last = null;
            int width = cells.Count;
            for (; at < table.Length; rows++)
            {
                int start = at;
                at = NextRow(table, at, cells);
                if (cells.Count != width) { throw Wrong(start, "a row of " + cells.Count + " cells"); }
                if (last == null || last.Name != cells[agent]) { last = Find(cells[agent]); }
                if (last == null) { throw Wrong(start, cells[agent] + " is no agent of the tracks"); }
                var numbers = new double[Numbers.Length];
                for (int k = 0; k < numbers.Length; k++) { numbers[k] = Number(cells[columns[k]], start); }
                double time = numbers[7];
                if (last.Count > 0 && !(time > last.Ends)) { throw Wrong(start, "times of an agent do not ascend"); }
                var row = new double[TrafficAgent.Columns];
                Array.Copy(numbers, row, 7);
                last.Add(time, row, Same(known, cells[state]), Same(known, cells[stall]), (int)numbers[8]);
            }
            return rows;
        }

        static double Number(string text, int start)
        {
            double number;
            if (!double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out number))
            {
                throw Wrong(start, text + " is no number");
            }
            return number;
        }

        static FormatException Wrong(int start, string what)
        {
            return new FormatException("byte " + start + " of the table: " + what);
        }

        static int Column(List<string> names, string name)
        {
            int column = names.IndexOf(name);
            if (column < 0) { throw new FormatException("the table has no column " + name); }
            return column;
        }

        // one string for all equal ones
        static string Same(Dictionary<string, string> known, string text)
        {
            string same;
            if (known.TryGetValue(text, out same)) { return same; }
            known.Add(text, text);
            return text;
        }

        // cells of the row at a byte; where the next row begins
        static int NextRow(byte[] table, int at, List<string> cells)
        {
            cells.Clear();
            for (;;)
            {
                int start = at;
                bool isQuoted = at < table.Length && table[at] == '"';
                if (isQuoted)
                {
                    // a quote within is doubled
                    for (at++; at < table.Length && (table[at] != '"' || Follows(table, at, '"')); at++)
                    {
                        if (table[at] == '"') { at++; }
                    }
                    if (at >= table.Length) { throw Wrong(start, "a text does not end"); }
                    at++;
                    cells.Add(Encoding.UTF8.GetString(table, start + 1, at - start - 2).Replace("\"\"", "\""));
                }
                else
                {
                    while (at < table.Length && table[at] != ',' && table[at] != '\n') { at++; }
                    cells.Add(Encoding.UTF8.GetString(table, start, at - start).TrimEnd('\r'));
                }
                if (at < table.Length && table[at] == '\r') { at++; }
                bool isLast = at >= table.Length || table[at] == '\n';
                if (!isLast && table[at] != ',') { throw Wrong(at, "a comma is missing"); }
                at++;
                if (isLast) { return at; }
            }
        }

        static bool Follows(byte[] table, int at, char letter)
        {
            return at + 1 < table.Length && table[at + 1] == letter;
        }
    }
}
