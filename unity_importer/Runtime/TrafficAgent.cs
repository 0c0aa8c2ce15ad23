using System;
using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>An agent at a time, in Unity's axes and metres of the stage.</summary>
    public struct TrafficPose
    {
        /// <summary>The middle of its footprint on the floor.</summary>
        public Vector3 Position;

        /// <summary>Forward is its nose, up or down with the floor.</summary>
        public Quaternion Rotation;

        /// <summary>Metres a second along the floor, negative in reverse.</summary>
        public float Speed;

        /// <summary>Degrees of the front wheels, positive to the right.</summary>
        public float Steering;

        /// <summary>Metres driven since its first row, less those in reverse.</summary>
        public float Rolled;

        /// <summary>"drives", "waits", "manoeuvres", "parked", "walks" or "stands".</summary>
        public string State;

        /// <summary>The stall that it parks in or leaves; empty otherwise.</summary>
        public string Stall;

        /// <summary>Number of its level, from 0.</summary>
        public int Level;
    }

    /// <summary>A car, a person or another agent of tracks, with its states over time.</summary>
    public sealed class TrafficAgent
    {
        // columns of numbers, of which the last one is not in the table
        internal const int X = 0, Y = 1, Z = 2, Yaw = 3, Pitch = 4, Speed = 5, Steering = 6, Rolled = 7, Columns = 8;

        readonly List<double> times = new List<double>();
        readonly List<double[]> rows = new List<double[]>();
        readonly List<string> states = new List<string>(), stalls = new List<string>();
        readonly List<int> levels = new List<int>();
        readonly Dictionary<string, double> sizes;
        readonly Dictionary<string, string> words;

        internal TrafficAgent(Dictionary<string, string> words, Dictionary<string, double> sizes)
        {
            this.words = words;
            this.sizes = sizes;
        }

        /// <summary>Unique name: "car_0041".</summary>
        public string Name
        {
            get { return Word("name"); }
        }

        /// <summary>Semantic class: "car", "van", "truck", "person" and others.</summary>
        public string Kind
        {
            get { return Word("kind"); }
        }

        /// <summary>Special behaviour by which it is labelled; empty for usual ones.</summary>
        public string Behaviour
        {
            get { return Word("behaviour"); }
        }

        /// <summary>Body of the catalogue.</summary>
        public string Body
        {
            get { return Word("body"); }
        }

        /// <summary>Paint of a car.</summary>
        public string Paint
        {
            get { return Word("paint"); }
        }

        /// <summary>Path of the prim of a parked car of the stage that it is; empty for others.</summary>
        public string Prim
        {
            get { return Word("prim"); }
        }

        /// <summary>Metres across, up and along.</summary>
        public Vector3 Size
        {
            get { return new Vector3(Metres("width_m"), Metres("height_m"), Metres("length_m")); }
        }

        /// <summary>Metres from the middle back to the rear axle.</summary>
        public float RearAxle
        {
            get { return Metres("rear_axle_m"); }
        }

        /// <summary>Metres between the axles; 0 for agents without wheels.</summary>
        public float Wheelbase
        {
            get { return Metres("wheelbase_m"); }
        }

        /// <summary>Second at which it comes: 0 for a car of the stage.</summary>
        public double Begins
        {
            get { return Prim.Length > 0 ? 0 : times[0]; }
        }

        /// <summary>Second at which it leaves.</summary>
        public double Ends
        {
            get { return times[times.Count - 1]; }
        }

        internal int Count
        {
            get { return times.Count; }
        }

        string Word(string key)
        {
            string word;
            return words.TryGetValue(key, out word) ? word : "";
        }

        float Metres(string key)
        {
            double number;
            return sizes.TryGetValue(key, out number) ? (float)number : 0;
        }

        internal void Add(double time, double[] row, string state, string stall, int level)
        {
            if (rows.Count > 0)
            {
                double[] last = rows[rows.Count - 1];
                double east = row[X] - last[X], up = row[Y] - last[Y], south = row[Z] - last[Z];
                double yaw = (row[Yaw] + last[Yaw]) / 2;
                double along = -east * Math.Sin(yaw) - south * Math.Cos(yaw);
                row[Rolled] = last[Rolled] + Math.Sign(along) * Math.Sqrt(east * east + up * up + south * south);
            }
            times.Add(time);
            rows.Add(row);
            states.Add(state);
            stalls.Add(stall);
            levels.Add(level);
        }

        /// <summary>Its pose at a second, linear between rows; false where it is not in the garage.</summary>
        public bool At(double seconds, out TrafficPose pose)
        {
            pose = new TrafficPose();
            if (!(seconds >= Begins && seconds <= Ends)) { return false; }
            int found = times.BinarySearch(seconds), before = Math.Max(found >= 0 ? found : ~found - 1, 0);
            int after = Math.Min(before + 1, times.Count - 1);
            double span = times[after] - times[before];
            double share = span > 0 ? Math.Max(seconds - times[before], 0) / span : 0;
            double[] one = rows[before], other = rows[after];
            var now = new double[Columns];
            for (int k = 0; k < Columns; k++) { now[k] = one[k] + (other[k] - one[k]) * share; }
            pose.Position = new Vector3((float)now[X], (float)now[Y], (float)-now[Z]);
            pose.Rotation = Turn(now[Yaw], Vector3.up) * Turn(now[Pitch], new Vector3(1, 0, 0));
            pose.Speed = (float)now[Speed];
            pose.Steering = Degrees(-now[Steering]);
            pose.Rolled = (float)now[Rolled];
            pose.State = states[before];
            pose.Stall = stalls[before];
            pose.Level = levels[before];
            return true;
        }

        // what turns left or up about a right-handed axis turns the other way in Unity
        static Quaternion Turn(double radians, Vector3 axis)
        {
            return Quaternion.AngleAxis(Degrees(-radians), axis);
        }

        static float Degrees(double radians)
        {
            return (float)(radians * 180 / Math.PI);
        }
    }
}
