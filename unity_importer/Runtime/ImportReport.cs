using System;
using System.Collections.Generic;

namespace Garage.Unity
{
    /// <summary>What was left out or changed, by reason.</summary>
    [Serializable]
    public sealed class ImportReport
    {
        const int MostExamples = 5;

        /// <summary>One reason with how often it came up and the first few places.</summary>
        [Serializable]
        public sealed class Entry
        {
            /// <summary>What happened, for all these places.</summary>
            public string reason;
            /// <summary>How often.</summary>
            public int count;
            /// <summary>The first few places, such as paths of prims.</summary>
            public List<string> places = new List<string>();

            /// <summary>Reason, count and places in a line.</summary>
            public override string ToString()
            {
                return reason + " (" + count + "): " + string.Join(", ", places.ToArray())
                    + (count > places.Count ? ", ..." : "");
            }
        }

        /// <summary>All reasons in the order in which they came up.</summary>
        public List<Entry> entries = new List<Entry>();

        /// <summary>Makes places readable; null leaves them as they are.</summary>
        [NonSerialized] internal Func<string, string> Readable;

        /// <summary>Notes a place, such as a prim's path, under a reason.</summary>
        public void Add(string reason, string place)
        {
            place = Readable == null ? place : Readable(place);
            Entry entry = entries.Find(one => one.reason == reason);
            if (entry == null)
            {
                entry = new Entry { reason = reason };
                entries.Add(entry);
            }
            entry.count++;
            if (entry.places.Count < MostExamples && !entry.places.Contains(place)) { entry.places.Add(place); }
        }
    }
}
