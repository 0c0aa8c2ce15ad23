namespace Garage.Usd
{
    /// <summary>What is left to do at a node, in the order in which it is done.</summary>
    enum Step : byte
    {
        Relocate, ImplyRelocate, Reference, Payload, Inherit, ImplyClasses, Specialize, FindAncestralVariants,
        ChooseAncestralVariant, ImplySpecialized, FindVariants, ChooseVariant, WaitForSelection,
    }

    /// <summary>A step at a node; of a variant set, the path of the prim and the name of the set.</summary>
    sealed class ArcTask
    {
        public readonly ArcNode Node;
        public readonly string Path, Set;
        public readonly int SetNumber;

        readonly Step step;

        /// <summary>What is to be done; a set without a selection waits until something may have selected.</summary>
        public Step Step
        {
            get { return IsWaiting ? Step.WaitForSelection : step; }
        }

        public bool IsWaiting;

        public ArcTask(Step step, ArcNode node)
        {
            this.step = step;
            Node = node;
        }

        public ArcTask(Step step, ArcNode node, string path, string set, int setNumber) : this(step, node)
        {
            Path = path;
            Set = set;
            SetNumber = setNumber;
        }

        /// <summary>Whether this is done before another one.</summary>
        public bool IsBefore(ArcTask other)
        {
            if (Step != other.Step) { return Step < other.Step; }
            if (Step == Step.ChooseVariant || Step == Step.ChooseAncestralVariant)
            {
                // a selection may come of any stronger place
                int order = ArcStrength.CompareAnywhere(Node, other.Node);
                if (order == 0) { order = string.CompareOrdinal(Path, other.Path); }
                return order < 0 || (order == 0 && SetNumber < other.SetNumber);
            }
            // classes are implied from below
            return Step == Step.ImplyClasses ? Node.Number > other.Node.Number : Node.Number < other.Node.Number;
        }
    }
}
