using System.Collections.Generic;

namespace Garage.Usd
{
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
                Warn(layer.Identifier + ": timeCodesPerSecond of " + InvariantText.Of(rate) + " is taken for "
                    + InvariantText.Of(layer.TimeCodesPerSecond));
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

        /// <summary>
        /// The stack of an asset that a layer of another stack names, or null (with a warning) where there is none.
        /// </summary>
        public LayerStack Find(LayerStack from, Layer anchor, string asset)
        {
            asset = from.Evaluated(asset, anchor);
            string identifier = string.IsNullOrEmpty(asset) ? null : Resolve(anchor, asset);
            return identifier == null ? null : StackOf(identifier, from.Variables);
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

        /// <summary>
        /// The stack with a root layer, where whoever refers to it has these variables; null for the stage itself.
        /// </summary>
        public LayerStack StackOf(string identifier, ExpressionVariables around)
        {
            Layer layer = LayerOf(identifier);
            ExpressionVariables variables = ExpressionVariables.Of(layer, around);
            string key = identifier + "\n" + variables.Key;
            LayerStack stack;
            if (!stacks.TryGetValue(key, out stack))
            {
                stack = new LayerStack(stacks.Count, variables, Warn);
                AddLayers(stack, layer, LayerOffset.Identity, new List<string>());
                stack.FindRelocates();
                stacks.Add(key, stack);
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
                string asset = stack.Evaluated(sub.Asset, layer);
                string identifier = string.IsNullOrEmpty(asset) ? null : Resolve(layer, asset);
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
                Warn(outer.Identifier + ": the offset " + InvariantText.Of(offset.Offset) + " and scale "
                    + InvariantText.Of(offset.Scale) + " of "
                    + inner.Identifier + " are no times");
                offset = LayerOffset.Identity;
            }
            double ratio = outer.TimeCodesPerSecond / inner.TimeCodesPerSecond;
            return ratio == 1 ? offset : new LayerOffset(offset.Offset, offset.Scale * ratio);
        }
    }
}
