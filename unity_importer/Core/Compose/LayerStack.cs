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

        public LayerStack(int number)
        {
            Number = number;
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
    }

    /// <summary>Reads each layer once and builds the stacks.</summary>
    sealed class LayerLibrary
    {
        const int MostLayers = 2000;
        const int DeepestSubLayer = 100;
        const int MostWarnings = 1000;

        readonly IAssetResolver resolver;
        readonly Dictionary<string, Layer> layers = new Dictionary<string, Layer>();
        readonly Dictionary<string, LayerStack> stacks = new Dictionary<string, LayerStack>();
        // identifiers of assets as each layer names them
        readonly Dictionary<Layer, Dictionary<string, string>> resolved
            = new Dictionary<Layer, Dictionary<string, string>>();

        readonly HashSet<string> warned = new HashSet<string>();
        readonly List<string> warnings = new List<string>();

        public LayerLibrary(IAssetResolver resolver)
        {
            this.resolver = resolver;
        }

        public IAssetResolver Resolver
        {
            get { return resolver; }
        }

        /// <summary>What was left out, such as files that do not exist.</summary>
        public IList<string> Warnings
        {
            get { return warnings; }
        }

        /// <summary>Specs of prims in all layers so far.</summary>
        public int SpecCount { get; private set; }

        public void Warn(string text)
        {
            if (warnings.Count < MostWarnings && warned.Add(text)) { warnings.Add(text); }
        }

        public void Add(Layer layer)
        {
            layers.Add(layer.Identifier, layer);
            SpecCount += layer.SpecCount;
            foreach (string one in layer.Skipped) { Warn(layer.Identifier + ": " + one); }
            double rate = layer.Number("timeCodesPerSecond", 1);
            if (!(rate > 0))
            {
                Warn(layer.Identifier + ": timeCodesPerSecond of " + rate + " is taken for "
                    + layer.TimeCodesPerSecond);
            }
        }

        Layer LayerOf(string identifier)
        {
            Layer layer;
            if (!layers.TryGetValue(identifier, out layer))
            {
                if (layers.Count >= MostLayers)
                {
                    throw new UsdFormatException(identifier, "layer",
                        "the stage has more than " + MostLayers + " layers");
                }
                layer = LayerReader.Read(resolver.Read(identifier), identifier);
                Add(layer);
            }
            return layer;
        }

        /// <summary>The stack of an asset that a layer names, or null (with a warning) where there is none.</summary>
        public LayerStack Find(Layer anchor, string asset)
        {
            string identifier = Resolve(anchor, asset);
            return identifier == null ? null : StackOf(identifier);
        }

        string Resolve(Layer anchor, string asset)
        {
            Dictionary<string, string> known;
            if (!resolved.TryGetValue(anchor, out known))
            {
                known = new Dictionary<string, string>();
                resolved.Add(anchor, known);
            }
            string identifier, reason;
            if (known.TryGetValue(asset, out identifier)) { return identifier; }
            identifier = resolver.Resolve(anchor.Identifier, asset, out reason);
            if (identifier != null && !LayerReader.Knows(identifier))
            {
                identifier = null;
                reason = "is of a format that is not read";
            }
            if (identifier == null) { Warn(anchor.Identifier + ": @" + asset + "@ " + reason); }
            known.Add(asset, identifier);
            return identifier;
        }

        public LayerStack StackOf(string identifier)
        {
            LayerStack stack;
            if (!stacks.TryGetValue(identifier, out stack))
            {
                stack = new LayerStack(stacks.Count);
                AddLayers(stack, LayerOf(identifier), LayerOffset.Identity, new List<string>());
                stacks.Add(identifier, stack);
            }
            return stack;
        }

        void AddLayers(LayerStack stack, Layer layer, LayerOffset offset, List<string> above)
        {
            if (above.Contains(layer.Identifier))
            {
                Warn(layer.Identifier + ": is its own sublayer");
                return;
            }
            if (above.Count >= DeepestSubLayer || stack.Layers.Count >= MostLayers)
            {
                throw new UsdFormatException(layer.Identifier, "subLayers", "there are too many sublayers");
            }
            stack.Layers.Add(layer);
            stack.Offsets.Add(offset);
            above.Add(layer.Identifier);
            foreach (SubLayer sub in layer.SubLayers)
            {
                string identifier = Resolve(layer, sub.Asset);
                if (identifier == null) { continue; }
                Layer inner = LayerOf(identifier);
                AddLayers(stack, inner, offset.After(Rated(sub.Offset, layer, inner)), above);
            }
            above.RemoveAt(above.Count - 1);
        }

        /// <summary>
        /// An offset between layers that count time differently; none where time would stand still or run backwards.
        /// </summary>
        public LayerOffset Rated(LayerOffset offset, Layer outer, Layer inner)
        {
            if (!(offset.Scale > 0) || double.IsInfinity(offset.Scale) || double.IsNaN(offset.Offset)
                || double.IsInfinity(offset.Offset))
            {
                Warn(outer.Identifier + ": the offset " + offset.Offset + " and scale " + offset.Scale + " of "
                    + inner.Identifier + " are no times");
                offset = LayerOffset.Identity;
            }
            double ratio = outer.TimeCodesPerSecond / inner.TimeCodesPerSecond;
            return ratio == 1 ? offset : new LayerOffset(offset.Offset, offset.Scale * ratio);
        }
    }
}
