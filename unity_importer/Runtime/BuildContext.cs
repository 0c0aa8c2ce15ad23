using System;
using System.Collections.Generic;
using Garage.Usd;

namespace Garage.Unity
{
    /// <summary>What holds for everything below a node.</summary>
    sealed class BuildContext
    {
        public MaterialBinding Material, Physics;
        public string Purpose = "default";

        /// <summary>Name of the asset that this is part of.</summary>
        public string Component = "";

        public bool IsHidden, IsMovable, IsMirrored;

        /// <summary>Whether prims stand for those of all instances.</summary>
        public bool IsShared;

        /// <summary>Whether it is drawn; guides and proxies only collide.</summary>
        public bool IsDrawn
        {
            get { return Purpose == "default" || Purpose == "render"; }
        }

        /// <summary>What holds below a node, of which some classes are movable.</summary>
        public BuildContext Under(SceneNode node, HashSet<string> movable)
        {
            var below = (BuildContext)MemberwiseClone();
            below.Material = node.Material.Under(Material);
            below.Physics = node.PhysicsMaterial.Under(Physics);
            below.Purpose = node.Purpose ?? Purpose;
            below.IsHidden = false;
            below.IsShared |= node.Prim.Prototype != null;
            var asset = node.Prim.Metadata("assetInfo") as UsdDictionary;
            string own = node.Prim.Prototype != null ? node.Prim.Name : Component;
            below.Component = (asset == null ? null : asset.Text("name")) ?? own;
            string[] labels;
            if (node.Labels != null && node.Labels.TryGetValue(SemanticLabels.Class, out labels))
            {
                foreach (string label in labels) { below.IsMovable |= movable.Contains(label); }
            }
            return below;
        }

        /// <summary>The material of a part of a mesh.</summary>
        public string MaterialOf(SubMesh part)
        {
            return Material.IsStrong ? Material.Path : part.MaterialPath ?? Material.Path;
        }
    }

    /// <summary>What decides whether one object may be a clone of another.</summary>
    struct TemplateKey : IEquatable<TemplateKey>
    {
        readonly object source;
        readonly string material, physics, purpose;
        readonly int flags;

        /// <summary>Of a node whose content the source decides, as it would be within a context.</summary>
        public TemplateKey(object source, SceneNode node, BuildContext context, bool isStall)
        {
            MaterialBinding shown = node.Material.Under(context.Material);
            MaterialBinding rubs = node.PhysicsMaterial.Under(context.Physics);
            this.source = source;
            material = shown.Path;
            physics = rubs.Path;
            purpose = node.Purpose ?? context.Purpose;
            bool isHidden = context.IsHidden || node.Visibility == "invisible";
            flags = (shown.IsStrong ? 1 : 0) | (rubs.IsStrong ? 2 : 0) | (isHidden ? 4 : 0)
                | (context.IsMovable ? 8 : 0) | (isStall ? 16 : 0)
                | (node.Labels != null ? 32 : 0) | (context.IsMirrored ? 64 : 0);
        }

        public bool Equals(TemplateKey other)
        {
            return ReferenceEquals(source, other.source) && flags == other.flags && material == other.material
                && physics == other.physics && purpose == other.purpose;
        }

        public override int GetHashCode()
        {
            return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(source) * 31 + flags;
        }
    }
}
