using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>A layer with its sublayers, strongest first, each with the offset of its time.</summary>
    sealed class LayerStack
    {
        public readonly List<Layer> Layers = new List<Layer>();
        public readonly List<LayerOffset> Offsets = new List<LayerOffset>();

        /// <summary>A number that no other stack of the stage has.</summary>
        public readonly int Number;

        /// <summary>What expressions in the layers may name.</summary>
        public readonly ExpressionVariables Variables;

        /// <summary>Prims that the layers move; null where they move none.</summary>
        public Relocates Relocates { get; private set; }

        readonly Action<string> warn;
        readonly Dictionary<string, List<string>> variantSets = new Dictionary<string, List<string>>();

        public LayerStack(int number, ExpressionVariables variables, Action<string> warn)
        {
            Number = number;
            Variables = variables;
            this.warn = warn;
        }

        /// <summary>When all layers are there.</summary>
        public void FindRelocates()
        {
            Relocates = Relocates.Of(Layers, warn);
        }

        public Layer Root
        {
            get { return Layers[0]; }
        }

        public string DefaultPrim
        {
            get
            {
                string name = Root.Text("defaultPrim");
                return string.IsNullOrEmpty(name) ? null : name[0] == '/' ? name : "/" + name;
            }
        }

        /// <summary>What the layers say at a path, the strongest first.</summary>
        public LayerSpec[] SpecsAt(string path)
        {
            var specs = new List<LayerSpec>(1);
            for (int i = 0; i < Layers.Count; i++)
            {
                PrimSpec spec = Layers[i].Find(path);
                if (spec != null) { specs.Add(new LayerSpec(i, spec)); }
            }
            return specs.ToArray();
        }

        /// <summary>The variant sets of a prim, in the order in which they are chosen.</summary>
        public IList<string> VariantSetsAt(string path)
        {
            List<string> sets;
            if (variantSets.TryGetValue(path, out sets)) { return sets; }
            sets = new List<string>(0);
            LayerSpec[] specs = SpecsAt(path);
            for (int i = specs.Length - 1; i >= 0; i--)
            {
                ListOp<string> op = specs[i].Spec.VariantSetNames;
                if (op != null) { op.ApplyTo(sets); }
            }
            variantSets.Add(path, sets);
            return sets;
        }

        /// <summary>The variant that the layers select, empty for none; false where they do not say.</summary>
        public bool SelectionAt(string path, string set, out string selection)
        {
            foreach (LayerSpec spec in SpecsAt(path))
            {
                Dictionary<string, string> selections = spec.Spec.VariantSelections;
                if (selections == null || !selections.TryGetValue(set, out selection)) { continue; }
                selection = Evaluated(selection, Layers[spec.Layer]) ?? "";
                return true;
            }
            selection = null;
            return false;
        }

        /// <summary>What a text says that may be an expression; null, with a warning, where it says nothing.</summary>
        public string Evaluated(string text, Layer layer)
        {
            if (!VariableExpression.Is(text)) { return text; }
            try
            {
                return VariableExpression.Text(text, Variables);
            }
            catch (FormatException failure)
            {
                warn(layer.Identifier + ": the expression " + text + " " + failure.Message);
                return null;
            }
        }
    }

}
