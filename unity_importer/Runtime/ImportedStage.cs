using UnityEngine;

namespace Garage.Unity
{
    /// <summary>On the root of what a stage became: where it came from, and what was left out.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("")]
    public sealed class ImportedStage : MonoBehaviour
    {
        [SerializeField] string source = "";
        [SerializeField] string upAxis = "";
        [SerializeField] float metersPerUnit;
        [SerializeField] ImportReport.Entry[] leftOut = new ImportReport.Entry[0];

        /// <summary>Name of the stage.</summary>
        public string Source
        {
            get { return source; }
        }

        /// <summary>"Y" or "Z", as the stage had it; here Y is up.</summary>
        public string UpAxis
        {
            get { return upAxis; }
        }

        /// <summary>As the stage had them; here all is in metres.</summary>
        public float MetersPerUnit
        {
            get { return metersPerUnit; }
        }

        /// <summary>How many reasons there are to leave something out.</summary>
        public int LeftOutCount
        {
            get { return leftOut.Length; }
        }

        /// <summary>What was left out or changed, by reason.</summary>
        public ImportReport.Entry LeftOut(int index)
        {
            return leftOut[index];
        }

        internal void Set(string name, string axis, double metres, ImportReport report)
        {
            source = name;
            upAxis = axis;
            metersPerUnit = (float)metres;
            leftOut = report.entries.ToArray();
        }
    }
}
