using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// Which material a prim shows: one bound for a purpose, wherever that is, before one bound for all purposes.
    /// </summary>
    public struct MaterialBinding
    {
        readonly string special, general;
        readonly bool isSpecialStrong, isGeneralStrong;

        /// <summary>A binding for all purposes; path is null where there is none.</summary>
        public MaterialBinding(string path, bool isStrong) : this(null, false, path, isStrong)
        {
        }

        MaterialBinding(string special, bool isSpecialStrong, string general, bool isGeneralStrong)
        {
            this.special = special;
            this.isSpecialStrong = isSpecialStrong;
            this.general = general;
            this.isGeneralStrong = isGeneralStrong;
        }

        /// <summary>Path of the material, which need not exist; null where none is bound.</summary>
        public string Path
        {
            get { return special ?? general; }
        }

        /// <summary>Whether it wins over what is bound below for the same purpose.</summary>
        public bool IsStrong
        {
            get { return special != null ? isSpecialStrong : isGeneralStrong; }
        }

        /// <summary>
        /// What is bound to the prim itself, for a purpose ("preview", "full", "physics") and for all purposes.
        /// </summary>
        public static MaterialBinding Of(UsdPrim prim, string purpose)
        {
            bool isSpecialStrong, isGeneralStrong;
            string special = Direct(prim, "material:binding:" + purpose, out isSpecialStrong);
            string general = Direct(prim, "material:binding", out isGeneralStrong);
            return new MaterialBinding(special, isSpecialStrong, general, isGeneralStrong);
        }

        static string Direct(UsdPrim prim, string name, out bool isStrong)
        {
            isStrong = false;
            UsdProperty relationship = prim.Property(name);
            if (relationship == null || !relationship.IsRelationship) { return null; }
            IList<string> targets = relationship.Targets;
            if (targets.Count != 1 || UsdPaths.Prim(targets[0]) != targets[0]) { return null; }
            isStrong = relationship.MetadataText("bindMaterialAs") == "strongerThanDescendants";
            return targets[0];
        }

        /// <summary>This binding below those that it inherits.</summary>
        public MaterialBinding Under(MaterialBinding above)
        {
            bool keepsSpecial = special != null && !above.isSpecialStrong;
            bool keepsGeneral = general != null && !above.isGeneralStrong;
            return new MaterialBinding(
                keepsSpecial ? special : above.special, keepsSpecial ? isSpecialStrong : above.isSpecialStrong,
                keepsGeneral ? general : above.general, keepsGeneral ? isGeneralStrong : above.isGeneralStrong);
        }

        /// <summary>The same with other paths.</summary>
        public MaterialBinding Moved(Func<string, string> path)
        {
            string movedSpecial = special == null ? null : path(special);
            string movedGeneral = general == null ? null : path(general);
            return new MaterialBinding(movedSpecial, isSpecialStrong, movedGeneral, isGeneralStrong);
        }

        /// <summary>The material, or null where none is bound, or something else than a material.</summary>
        public UsdPrim Material(UsdStage stage)
        {
            UsdPrim bound = stage.PrimAt(Path);
            return bound != null && bound.TypeName == "Material" ? bound : null;
        }
    }
}
