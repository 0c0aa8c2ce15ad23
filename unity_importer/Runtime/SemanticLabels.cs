using System;
using System.Collections.Generic;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>What an object is, in one or more taxonomies, and which one of all labelled objects.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/Semantic Labels")]
    public sealed class SemanticLabels : MonoBehaviour
    {
        /// <summary>The taxonomy that the stages of garage2usd use.</summary>
        public const string Class = "class";

        /// <summary>The labels of one taxonomy.</summary>
        [Serializable]
        public struct Taxonomy
        {
            /// <summary>Such as "class".</summary>
            public string name;

            /// <summary>All that the object is in it.</summary>
            public string[] labels;
        }

        [SerializeField] Taxonomy[] taxonomies = new Taxonomy[0];
        [SerializeField] int instanceId;

        /// <summary>1 for the first labelled object of the prefab, then one more for each; as the table of labels says
        /// where there was one.</summary>
        public int InstanceId
        {
            get { return instanceId; }
            internal set { instanceId = value; }
        }

        /// <summary>The first label of the taxonomy "class"; empty where there is none.</summary>
        public string ClassLabel
        {
            get
            {
                string[] labels = LabelsOf(Class);
                return labels.Length > 0 ? labels[0] : "";
            }
        }

        /// <summary>How many taxonomies say something.</summary>
        public int TaxonomyCount
        {
            get { return taxonomies.Length; }
        }

        /// <summary>A taxonomy with its labels. Throws IndexOutOfRangeException.</summary>
        public Taxonomy TaxonomyAt(int index)
        {
            return taxonomies[index];
        }

        /// <summary>All labels of a taxonomy; empty where there are none.</summary>
        public string[] LabelsOf(string taxonomy)
        {
            foreach (Taxonomy one in taxonomies)
            {
                if (one.name == taxonomy) { return one.labels; }
            }
            return new string[0];
        }

        internal void Set(Dictionary<string, string[]> labels)
        {
            taxonomies = new Taxonomy[labels.Count];
            int count = 0;
            foreach (KeyValuePair<string, string[]> one in labels)
            {
                taxonomies[count++] = new Taxonomy { name = one.Key, labels = one.Value };
            }
        }
    }
}
