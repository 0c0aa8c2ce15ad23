using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>
    /// A prim as a scene shows it. Nodes of a prototype are there once, however many instances share them.
    /// </summary>
    public sealed class SceneNode
    {
        static readonly List<SceneNode> None = new List<SceneNode>();

        /// <summary>The prim itself.</summary>
        public UsdPrim Prim { get; private set; }

        /// <summary>To the parent's space, in the axes and units of the stage.</summary>
        public double[] Local { get; private set; }

        /// <summary>Whether Local leads to the world instead.</summary>
        public bool ResetsTransform { get; private set; }

        /// <summary>"inherited" or "invisible".</summary>
        public string Visibility { get; private set; }

        /// <summary>"default", "render", "proxy", "guide"; null where the prim does not say.</summary>
        public string Purpose { get; private set; }

        /// <summary>Bindings of the node itself; those above it count where it has none.</summary>
        public MaterialBinding Material { get; private set; }

        /// <summary>As Material, for the purpose "physics".</summary>
        public MaterialBinding PhysicsMaterial { get; private set; }

        /// <summary>Null where the prim is no mesh, or a bad one.</summary>
        public TriangleMesh Mesh { get; private set; }

        /// <summary>Null where the prim is no light.</summary>
        public LightData Light { get; private set; }

        /// <summary>Null where the prim is no camera.</summary>
        public CameraData Camera { get; private set; }

        /// <summary>Null where the prim is no cube, sphere or the like.</summary>
        public ShapeData Shape { get; private set; }

        /// <summary>Null where nothing can collide with the prim.</summary>
        public ColliderData Collider { get; private set; }

        /// <summary>Null where the prim is no curves.</summary>
        public CurvesData Curves { get; private set; }

        /// <summary>Null where the prim is no PointInstancer.</summary>
        public PointInstancerData PointInstancer { get; private set; }

        /// <summary>Labels of UsdSemantics by taxonomy ("class").</summary>
        public Dictionary<string, string[]> Labels { get; private set; }

        /// <summary>The shared children of an instance belong to its prototype: see SceneModel.ChildrenOf.</summary>
        public List<SceneNode> Children { get; internal set; }

        internal SceneNode(UsdPrim prim, MeshMemo meshes)
        {
            Prim = prim;
            bool resets;
            Local = Xform.Local(prim, out resets);
            ResetsTransform = resets;
            Visibility = prim.Text("visibility", "inherited");
            Purpose = prim.Text("purpose", null);
            Material = MaterialBinding.Of(prim, "preview");
            PhysicsMaterial = MaterialBinding.Of(prim, "physics");
            Children = None;
            if (prim.TypeName == "Mesh")
            {
                string reason;
                Mesh = meshes.Of(prim, out reason);
                if (Mesh == null) { prim.Stage.Composer.Library.Warn("<" + prim.Path + ">: the mesh " + reason); }
            }
            Light = LightData.Of(prim);
            Camera = CameraData.Of(prim);
            Shape = ShapeData.Of(prim);
            Collider = ColliderData.Of(prim);
            Curves = CurvesData.Of(prim);
            PointInstancer = PointInstancerData.Of(prim);
            foreach (string api in prim.ApiSchemas)
            {
                if (!api.StartsWith("SemanticsLabelsAPI:", StringComparison.Ordinal)) { continue; }
                UsdValue value = prim.Value("semantics:labels:" + api.Substring(19));
                Labels = Labels ?? new Dictionary<string, string[]>();
                Labels[api.Substring(19)] = value == null ? new string[0] : value.Texts;
            }
        }
    }

    /// <summary>All that a scene shows of a stage.</summary>
    public sealed class SceneModel
    {
        const long MostShown = 10000000;

        readonly Dictionary<UsdPrim, List<SceneNode>> prototypes = new Dictionary<UsdPrim, List<SceneNode>>();
        readonly Dictionary<UsdPrim, long> shownBelow = new Dictionary<UsdPrim, long>();
        readonly MeshMemo meshes = new MeshMemo();
        readonly Dictionary<string, MaterialData> materials = new Dictionary<string, MaterialData>();

        /// <summary>The stage that is shown.</summary>
        public UsdStage Stage { get; private set; }

        /// <summary>From the stage's axes and units to Unity's.</summary>
        public Basis Basis { get; private set; }

        /// <summary>Root prims that define something.</summary>
        public List<SceneNode> Roots { get; private set; }

        /// <summary>Prims that the scene shows, at all places of all instances.</summary>
        public long ShownCount { get; private set; }

        /// <summary>
        /// Throws UsdFormatException where instances within instances stand for more prims than anything can show.
        /// </summary>
        public SceneModel(UsdStage stage)
        {
            Stage = stage;
            Basis = Basis.Of(stage);
            Roots = Nodes(stage.Root.Children);
            ShownCount = Shown(Roots);
        }

        long Shown(List<SceneNode> nodes)
        {
            long count = nodes.Count;
            foreach (SceneNode node in nodes)
            {
                UsdPrim prototype = node.Prim.Prototype;
                long below;
                if (prototype == null || !shownBelow.TryGetValue(prototype, out below))
                {
                    below = Shown(ChildrenOf(node));
                    if (prototype != null) { shownBelow.Add(prototype, below); }
                }
                count += below;
                if (count > MostShown)
                {
                    throw new UsdFormatException(Stage.Identifier, "<" + node.Prim.Path + ">",
                        "instances stand for more than " + MostShown + " prims");
                }
            }
            return count;
        }

        List<SceneNode> Nodes(IList<UsdPrim> prims)
        {
            var nodes = new List<SceneNode>();
            foreach (UsdPrim prim in prims)
            {
                if (prim.Specifier != Specifier.Def) { continue; }
                var node = new SceneNode(prim, meshes);
                if (prim.Prototype == null) { node.Children = Nodes(prim.Children); }
                nodes.Add(node);
            }
            return nodes;
        }

        /// <summary>The children of a node, those of its prototype where it is an instance.</summary>
        public List<SceneNode> ChildrenOf(SceneNode node)
        {
            if (node.Prim.Prototype == null) { return node.Children; }
            List<SceneNode> shared;
            if (!prototypes.TryGetValue(node.Prim.Prototype, out shared))
            {
                shared = Nodes(node.Prim.Prototype.Children);
                prototypes.Add(node.Prim.Prototype, shared);
            }
            return shared;
        }

        /// <summary>
        /// A node for the prim at a path, such as a prototype of a PointInstancer; null where there is none.
        /// </summary>
        public SceneNode NodeAt(string path)
        {
            UsdPrim prim = Stage.PrimAt(path);
            return prim == null || prim.Specifier != Specifier.Def ? null : Nodes(new[] { prim })[0];
        }

        /// <summary>The preview surface at a path, or null.</summary>
        public MaterialData Material(string path)
        {
            MaterialData data;
            if (path == null) { return null; }
            if (!materials.TryGetValue(path, out data))
            {
                UsdPrim prim = Stage.PrimAt(path);
                data = prim == null ? null : MaterialData.Of(Stage, prim);
                materials.Add(path, data);
            }
            return data;
        }
    }
}
