using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;

namespace Garage.Unity
{
    /// <summary>
    /// Makes GameObjects of a scene, a few at a step. Instances and points are clones of the first one of their kind,
    /// and all share their meshes and materials.
    /// </summary>
    public sealed class SceneBuilder
    {
        const float LargestShear = 1e-4f;

        static readonly HashSet<string> Unseen = new HashSet<string>
        {
            "Material", "Shader", "NodeGraph", "GeomSubset", "PhysicsScene", "PhysicsCollisionGroup", "RenderSettings",
            "RenderProduct", "RenderVar", "Backdrop",
        };

        static readonly HashSet<string> Known = new HashSet<string>
        {
            "", "Xform", "Scope", "Mesh", "Camera", "BasisCurves", "PointInstancer", "RectLight", "DiskLight",
            "SphereLight", "CylinderLight", "DistantLight", "DomeLight",
            "DomeLight_1", "Cube", "Sphere", "Cylinder", "Capsule", "Cone", "Plane",
        };

        readonly SceneModel scene;
        readonly LabelTable table;
        readonly ImportSettings settings;
        readonly Basis basis;
        readonly PartBuilder parts;
        readonly LaneGraphBuilder lanes;
        readonly HashSet<string> movable;
        readonly Dictionary<TemplateKey, GameObject> templates = new Dictionary<TemplateKey, GameObject>();
        readonly Dictionary<string, SceneNode> prototypes = new Dictionary<string, SceneNode>();
        readonly Dictionary<string, UnityEngine.Object> assets = new Dictionary<string, UnityEngine.Object>();
        readonly Stack<Frame> frames = new Stack<Frame>();
        bool isFinished;

        /// <summary>The prefab, whole once Step has returned false.</summary>
        public GameObject Root { get; private set; }

        /// <summary>Meshes, materials, textures and physic materials by identifiers that stay the same as long as the
        /// assets do.</summary>
        public IDictionary<string, UnityEngine.Object> Assets
        {
            get { return assets; }
        }

        /// <summary>What was left out so far.</summary>
        public ImportReport Report { get; private set; }

        /// <summary>0 to 1.</summary>
        public float Progress { get; private set; }

        /// <summary>Nodes that are still to be made, all below one object.</summary>
        sealed class Frame
        {
            public IList<SceneNode> Nodes;

            /// <summary>Matrices and names of points; null where those of the nodes count.</summary>
            public IList<double[]> Matrices;

            public IList<string> Names;
            public int Next;
            public Transform Parent;
            public BuildContext Context;
            public float From, Span;
        }

        /// <summary>
        /// Begins a prefab with a name; a scene is read best on another thread before. The table of labels may be null.
        /// Of what becomes an asset the textures keep their pixels, as they could not be saved without.
        /// </summary>
        public SceneBuilder(SceneModel scene, LabelTable table, ImportSettings settings, string name, bool isAsset)
        {
            this.scene = scene;
            this.table = table;
            this.settings = settings;
            basis = new Basis(scene.Stage.IsZUp, scene.Stage.MetersPerUnit * settings.scale);
            Report = new ImportReport { Readable = Readable };
            lanes = new LaneGraphBuilder(basis, Report);
            movable = new HashSet<string>(settings.movableLabels);
            parts = new PartBuilder(scene, settings, isAsset, basis, movable, Report, Store);
            Root = new GameObject(name);
            if (QualitySettings.activeColorSpace != ColorSpace.Linear)
            {
                Report.Add("the project's color space is not linear: colors and lights are off", name);
            }
            var whole = new BuildContext();
            frames.Push(new Frame { Nodes = scene.Roots, Parent = Root.transform, Context = whole, Span = 1 });
        }

        /// <summary>Makes one more node, or a whole instance of what there is already; false once all is
        /// done.</summary>
        public bool Step()
        {
            while (frames.Count > 0)
            {
                Frame frame = frames.Peek();
                if (frame.Next >= frame.Nodes.Count)
                {
                    frames.Pop();
                    continue;
                }
                int number = frame.Next++;
                float span = frame.Span / frame.Nodes.Count;
                Progress = frame.From + span * number;
                SceneNode node = frame.Nodes[number];
                bool isPoint = frame.Matrices != null;
                if (IsUnseen(node)) { return true; }
                if (isPoint) { Make(node, frame.Matrices[number], frame.Names[number], true, frame, span); }
                else { Make(node, node.Local, node.Prim.Name, false, frame, span); }
                return true;
            }
            if (!isFinished) { Finish(); }
            return false;
        }

        /// <summary>Whether a node is only there for others to refer to.</summary>
        internal static bool IsUnseen(SceneNode node)
        {
            return Unseen.Contains(node.Prim.TypeName);
        }

        /// <summary>Makes all that is left.</summary>
        public void Run()
        {
            while (Step()) { }
        }

        /// <summary>Takes back all that was made so far.</summary>
        public void Abandon()
        {
            frames.Clear();
            isFinished = true;
            if (Root != null) { UnityEngine.Object.DestroyImmediate(Root); }
            foreach (UnityEngine.Object asset in assets.Values) { UnityEngine.Object.DestroyImmediate(asset); }
            assets.Clear();
        }

        // a prototype's name is only a number: that of its asset says more
        string Readable(string place)
        {
            if (!place.StartsWith("/__Prototype_", StringComparison.Ordinal)) { return place; }
            int slash = place.IndexOf('/', 1);
            string root = slash < 0 ? place : place.Substring(0, slash);
            UsdPrim prim = scene.Stage.PrimAt(root);
            var asset = prim == null ? null : prim.Metadata("assetInfo") as UsdDictionary;
            string name = asset == null ? null : asset.Text("name");
            return name == null ? place : name + place.Substring(root.Length);
        }

        void Store(string key, UnityEngine.Object asset)
        {
            // FNV-1a
            ulong digest = 14695981039346656037;
            foreach (char letter in key) { digest = (digest ^ letter) * 1099511628211; }
            string identifier = asset.GetType().Name + " " + asset.name + " " + digest.ToString("x16");
            while (assets.ContainsKey(identifier)) { identifier += "'"; }
            assets.Add(identifier, asset);
        }

        void Make(SceneNode node, double[] local, string name, bool isPoint, Frame frame, float span)
        {
            BuildContext context = frame.Context;
            bool isBare = PartBuilder.IsBare(node);
            object source = isPoint ? (object)node : isBare ? node.Prim.Prototype : null;
            bool isStall = LaneGraphBuilder.IsStall(node);
            if (source == null && node.Prim.TypeName == "Scope")
            {
                Unfold(node, frame, span);
                return;
            }
            if (LaneGraphBuilder.IsPart(node)) { return; }
            Placement placement = Placement.Of(basis, local);
            GameObject made = null;
            var key = new TemplateKey();
            if (source != null)
            {
                key = new TemplateKey(source, node, context, placement.Scale.x < 0, isStall);
                GameObject first;
                if (templates.TryGetValue(key, out first))
                {
                    made = UnityEngine.Object.Instantiate(first, frame.Parent);
                    made.name = name;
                }
            }
            bool isClone = made != null;
            if (!isClone)
            {
                made = new GameObject(name);
                made.transform.SetParent(frame.Parent, false);
                if (source != null) { templates.Add(key, made); }
            }
            Place(made, node, placement, context);
            if (node.Labels != null) { Dress<SemanticLabels>(made, isClone).Set(node.Labels); }
            if (isStall) { lanes.AddStall(Dress<Stall>(made, isClone), node); }
            if (isClone)
            {
                parts.CheckCopy(made, node);
                return;
            }

            if (node.Visibility == "invisible" || context.IsHidden) { made.SetActive(false); }
            BuildContext below = context.Under(node, movable);
            below.IsMirrored ^= placement.Scale.x < 0;
            if (settings.staticFlags && !below.IsMovable) { EditorOnly.MarkStatic(made, settings.gpuInstancing); }
            if (!isBare) { parts.Add(made, node, below, frame.Nodes); }
            if (!Known.Contains(node.Prim.TypeName))
            {
                Report.Add("prims of the type " + node.Prim.TypeName + " are left out", node.Prim.Path);
            }
            if (node.PointInstancer != null)
            {
                Scatter(made, node, below, span);
                return;
            }
            List<SceneNode> children = scene.ChildrenOf(node);
            if (children.Count == 0) { return; }
            if (node.Prim.Prototype == null && !context.IsShared) { lanes.AddGraph(made, children); }
            frames.Push(new Frame
            {
                Nodes = children, Parent = made.transform, Context = below, From = Progress, Span = span,
            });
        }

        // a Scope has no place of its own: what is in it stands in its parent
        void Unfold(SceneNode node, Frame frame, float span)
        {
            List<SceneNode> children = scene.ChildrenOf(node);
            if (children.Count == 0) { return; }
            BuildContext below = frame.Context.Under(node, movable);
            below.IsHidden = frame.Context.IsHidden || node.Visibility == "invisible";
            frames.Push(new Frame
            {
                Nodes = children, Parent = frame.Parent, Context = below, From = Progress, Span = span,
            });
        }

        static T Dress<T>(GameObject made, bool isClone) where T : Component
        {
            return isClone ? made.GetComponent<T>() : made.AddComponent<T>();
        }

        void Place(GameObject made, SceneNode node, Placement placement, BuildContext context)
        {
            if (node.ResetsTransform)
            {
                if (context.IsShared)
                {
                    Report.Add("transforms that leave their parents aside are not left aside within instances",
                        node.Prim.Path);
                }
                else { made.transform.SetParent(Root.transform, false); }
            }
            if (placement.Shear > LargestShear)
            {
                Report.Add("sheared transforms stand as the nearest ones that are not sheared", node.Prim.Path);
            }
            placement.ApplyTo(made.transform);
        }

        void Scatter(GameObject holder, SceneNode node, BuildContext context, float span)
        {
            PointInstancerData points = node.PointInstancer;
            var kinds = new SceneNode[points.Prototypes.Count];
            for (int i = 0; i < kinds.Length; i++)
            {
                string path = points.Prototypes[i];
                if (!prototypes.TryGetValue(path, out kinds[i]))
                {
                    kinds[i] = scene.NodeAt(path);
                    prototypes.Add(path, kinds[i]);
                }
                if (kinds[i] == null) { Report.Add("prototypes of point instancers do not exist", path); }
            }
            var frame = new Frame
            {
                Nodes = new List<SceneNode>(), Matrices = new List<double[]>(), Names = new List<string>(),
                Parent = holder.transform, Context = context, From = Progress, Span = span,
            };
            for (int i = 0; i < points.Numbers.Length; i++)
            {
                SceneNode kind = kinds[points.PrototypeOf[i]];
                if (kind == null) { continue; }
                frame.Nodes.Add(kind);
                frame.Matrices.Add(Matrix4.Multiply(kind.Local, points.Matrices[i]));
                frame.Names.Add(node.Prim.Name + "[" + points.Numbers[i] + "]");
            }
            frames.Push(frame);
        }

        void Finish()
        {
            isFinished = true;
            Progress = 1;
            lanes.Finish(Root.transform);
            LabelTable.Apply(table, Root.transform);
            foreach (string warning in scene.Stage.Warnings) { Report.Add("the reader left out", warning); }
            string axis = scene.Stage.IsZUp ? "Z" : "Y";
            Root.AddComponent<ImportedStage>().Set(Root.name, axis, scene.Stage.MetersPerUnit, Report);
        }
    }
}
