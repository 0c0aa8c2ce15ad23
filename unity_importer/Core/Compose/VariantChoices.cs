using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Variants of the prims above a class, where those who refer to the layer of the class choose others than the
    /// layer does.
    /// </summary>
    sealed class VariantChoices
    {
        readonly Dictionary<string, string> selections = new Dictionary<string, string>();

        public string Key { get; private set; }

        /// <summary>
        /// What places around a node choose above a path of its layers; null where they choose nothing.
        /// </summary>
        public static VariantChoices Of(ArcNode node, string path)
        {
            VariantChoices choices = null;
            string above = path;
            while ((above = UsdPaths.Parent(above)) != null && above != "/")
            {
                string seen = above;
                for (ArcNode place = node; place.Parent != null && seen != null; place = place.Parent)
                {
                    seen = place.PathInParent(seen);
                    if (seen == null || ReferenceEquals(place.Parent.Stack, node.Stack)) { continue; }
                    // the outermost place comes last and wins
                    LayerSpec[] specs = place.Parent.Stack.SpecsAt(seen);
                    for (int i = specs.Length - 1; i >= 0; i--)
                    {
                        if (specs[i].Spec.VariantSelections == null) { continue; }
                        choices = choices ?? new VariantChoices();
                        foreach (KeyValuePair<string, string> one in specs[i].Spec.VariantSelections)
                        {
                            choices.selections[above + "{" + one.Key] = one.Value;
                        }
                    }
                }
            }
            if (choices == null) { return null; }
            foreach (KeyValuePair<string, string> one in choices.selections)
            {
                choices.Key += "{" + one.Key + "=" + one.Value;
            }
            return choices;
        }

        public string Find(string path, string set)
        {
            string selection;
            return selections.TryGetValue(path + "{" + set, out selection) ? selection : null;
        }
    }
}
