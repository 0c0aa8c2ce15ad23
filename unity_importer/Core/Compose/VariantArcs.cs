using System.Collections.Generic;

namespace Garage.Usd
{
    // variants, of the prim itself and of those above the target of an arc
    sealed partial class ArcTree
    {
        void FindVariants(ArcNode node)
        {
            if (!node.IsSilent) { FindVariants(node, node.Path, Step.ChooseVariant); }
        }

        void FindAncestralVariants(ArcNode node)
        {
            for (string path = UsdPaths.Parent(node.Path); path != null && path != "/"; path = UsdPaths.Parent(path))
            {
                if (!Speaks(node, path)) { continue; }
                FindVariants(node, path, Step.ChooseAncestralVariant);
                // those further up led here
                if (UsdPaths.IsVariant(path)) { break; }
            }
        }

        // whether opinions of a node's layers on a prim above it count
        static bool Speaks(ArcNode node, string path)
        {
            return node.SilentFrom == 0 || node.SilentFrom > UsdPaths.Elements(path);
        }

        void FindVariants(ArcNode node, string path, Step step)
        {
            IList<string> sets = node.Stack.VariantSetsAt(path);
            for (int i = 0; i < sets.Count; i++) { tasks.Add(new ArcTask(step, node, path, sets[i], i)); }
        }

        void ChooseVariant(ArcTask task)
        {
            ArcNode node = task.Node;
            if (!Speaks(node, task.Path)) { return; }
            string path = UsdPaths.WithoutVariants(task.Path), start;
            ArcNode from = HighestWith(node, path, out start);
            string selection = Chosen(from, start, task.Set);
            // an empty selection chooses none
            if (selection == null) { Select(from, start, task.Set, out selection); }
            bool isAncestral = task.Step == Step.ChooseAncestralVariant;
            if (string.IsNullOrEmpty(selection))
            {
                task.IsWaiting = true;
                tasks.Add(task);
                return;
            }
            string variant = UsdPaths.Moved(node.Path, task.Path, UsdPaths.Variant(task.Path, task.Set, selection));
            // a node that was moved may have been given it before
            if (Known(Arc.Variant, node, node.Stack, variant, PathMap.Identity, 0, false) != null) { return; }
            ArcNode added = Follow(Arc.Variant, node, node, node.Stack, variant, PathMap.Identity,
                task.SetNumber, UsdPaths.Depth(task.Path), new Terms
                {
                    HasAncestors = isAncestral, SkipsKnown = isAncestral && IsOfClass(node),
                });
            if (added == null) { return; }
            // it may select what others wait for
            foreach (ArcTask waiting in tasks) { waiting.IsWaiting = false; }
        }

        static bool IsOfClass(ArcNode node)
        {
            for (; node.Parent != null; node = node.Parent)
            {
                if (node.IsClass && node.DepthBelowIntroduction == 0 && !node.IsSilent) { return true; }
            }
            return false;
        }

        // the node nearest to the root in which a path of a node means something
        static ArcNode HighestWith(ArcNode node, string path, out string translated)
        {
            translated = path;
            if (node.Parent == null) { return node; }
            string inRoot = node.ToRoot.ToTarget(path);
            if (inRoot != null)
            {
                node = node.Root;
                translated = inRoot;
            }
            else
            {
                string above;
                while (node.Parent != null && (above = node.ToParent.ToTarget(translated)) != null)
                {
                    node = node.Parent;
                    translated = above;
                }
            }
            string introduced = node.PathAtIntroduction;
            if (UsdPaths.HasVariant(introduced))
            {
                string plain = UsdPaths.WithoutVariants(introduced);
                if (UsdPaths.HasPrefix(translated, plain))
                {
                    translated = UsdPaths.Moved(translated, plain, introduced);
                }
            }
            return node;
        }

        // the variant of a prim's set that is in the tree already, or null
        static string Chosen(ArcNode node, string path, string set)
        {
            if (node.Arc == Arc.Variant)
            {
                string introduced = node.PathAtIntroduction;
                int open = introduced.LastIndexOf('{'), equals = introduced.IndexOf('=', open);
                bool isSet = string.CompareOrdinal(introduced, open + 1, set, 0, set.Length) == 0
                    && equals == open + 1 + set.Length;
                string prim = introduced;
                while (UsdPaths.IsVariant(prim)) { prim = UsdPaths.Parent(prim); }
                if (isSet && prim == path) { return introduced.Substring(equals + 1, introduced.Length - equals - 2); }
            }
            foreach (ArcNode child in node.Children)
            {
                string below = child.ToParent.ToSource(UsdPaths.WithoutVariants(path));
                string found = below == null ? null : Chosen(child, below, set);
                if (found != null) { return found; }
            }
            return null;
        }

        bool Select(ArcNode node, string path, string set, out string selection)
        {
            composer.Pass();
            if (Speaks(node, path))
            {
                string place = path;
                if (node.Arc == Arc.Variant)
                {
                    string introduced = node.PathAtIntroduction, plain = UsdPaths.WithoutVariants(introduced);
                    if (UsdPaths.HasPrefix(path, plain)) { place = UsdPaths.Moved(path, plain, introduced); }
                }
                if (node.Stack.SelectionAt(place, set, out selection)) { return true; }
            }
            foreach (ArcNode child in node.Children)
            {
                string below = child.ToParent.ToSource(UsdPaths.WithoutVariants(path));
                if (below != null && Select(child, below, set, out selection)) { return true; }
            }
            selection = null;
            return false;
        }
    }
}
