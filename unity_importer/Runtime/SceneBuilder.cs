using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity
{
    /// <summary>
    /// Makes GameObjects of a scene, a few at a step. Instances and points are clones of the first one of their kind, and all share their
    /// meshes and materials.
    /// </summary>
    public sealed class SceneBuilder
    {
        const float LargestShear = 1e-4f;

        // what is there for others to refer to
        static readonly HashSet<string> Unseen = new HashSet<string>
        {
            "Material", "Shader", "NodeGraph", "GeomSubset", "PhysicsScene", "PhysicsCollisionGroup", "RenderSettings", "RenderProduct", "RenderVar", "Backdrop",
        };

        static readonly HashSet<string> Known = new HashSet<string>
        {
            "", "Xform", "Scope", "Mesh", "Camera", "BasisCurves", "PointInstancer", "RectLight", "DiskLight", "SphereLight", "CylinderLight", "DistantLight", "DomeLight",
            "DomeLight_1", "Cube", "Sphere", "Cylinder", "Capsule", "Cone", "Plane",
        };

        readonly SceneModel scene;
        readonly LabelTable table;
        readonly ImportSettings settings;
        readonly Basis basis;
        readonly MeshAssets meshes;
        readonly MaterialAssets materials;
        readonly LightBuilder lights;
        readonly ColliderBuilder colliders;
        readonly LaneGraphBuilder lanes;
        readonly HashSet<string> movable;
        readonly Dictionary<TemplateKey, GameObject> templates = new Dictionary<TemplateKey, GameObject>();
        readonly Dictionary<string, SceneNode> prototypes = new Dictionary<string, SceneNode>();
        readonly Dictionary<string, UnityEngine.Object> assets = new Dictionary<string, UnityEngine.Object>();
        readonly Stack<Frame> frames = new Stack<Frame>();
        bool isFinished;

        /// <summary>The prefab, whole once Step has returned false.</summary>
        public GameObject Root { get; private set; }

        /// <summary>Meshes, materials, textures and physic materials by identifiers that stay the same as long as the assets do.</summary>
        public IDictionary<string, UnityEngine.Object> Assets
        {
            get { return assets; }
        }

        /// <summary>What was left out so far.</summary>
        public ImportReport Report { get; private set; }

        /// <summary>0 to 1.</summary>
        public float Progress { get; private set; }

        /// <summary>What holds for everything below a node.</summary>
        sealed class Context
        {
            public MaterialBinding Material, Physics;
            public string Purpose = "default";

            /// <summary>Name of the asset that this is part of.</summary>
            public string Component = "";

            public bool IsHidden, IsMovable, IsMirrored;

            /// <summary>Whether prims stand for those of all instances.</summary>
            public bool IsShared;

            public Context Under(SceneNode node, HashSet<string> movable)
            {
                var below = (Context)MemberwiseClone();
                below.Material = node.Material.Under(Material);
                below.Physics = node.PhysicsMaterial.Under(Physics);
                below.Purpose = node.Purpose ?? Purpose;
                below.IsHidden = false;
                below.IsShared |= node.Prim.Prototype != null;
                var asset = node.Prim.Metadata("assetInfo") as UsdDictionary;
                below.Component = (asset == null ? null : asset.Text("name")) ?? (node.Prim.Prototype != null ? node.Prim.Name : Component);
                string[] labels;
                if (node.Labels != null && node.Labels.TryGetValue(SemanticLabels.Class, out labels))
                {
                    foreach (string label in labels) { below.IsMovable |= movable.Contains(label); }
                }
                return below;
            }
        }

        /// <summary>Nodes that are still to be made, all below one object.</summary>
        sealed class Frame
        {
            public IList<SceneNode> Nodes;

            /// <summary>Matrices and names of points; null where those of the nodes count.</summary>
            public IList<double[]> Matrices;

            public IList<string> Names;
            public int Next;
            public Transform Parent;
            public Context Context;
            public float From, Span;
        }

        /// <summary>What decides whether one object may be a clone of another.</summary>
        struct TemplateKey : IEquatable<TemplateKey>
        {
            public object Source;
            public string Material, Physics, Purpose;
            public int Flags;

            public bool Equals(TemplateKey other)
            {
                return ReferenceEquals(Source, other.Source) && Flags == other.Flags && Material == other.Material && Physics == other.Physics && Purpose == other.Purpose;
            }

            public override int GetHashCode()
            {
                return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(Source) * 31 + Flags;
            }
        }

        /// <summary>Begins a prefab with a name; a scene is read best on another thread before. The table of labels may be null.</summary>
        public SceneBuilder(SceneModel scene, LabelTable table, ImportSettings settings, string name)
        {
            this.scene = scene;
            this.table = table;
            this.settings = settings;
            basis = new Basis(scene.Stage.IsZUp, scene.Stage.MetersPerUnit * settings.scale);
            Report = new ImportReport { Readable = Readable };
            meshes = new MeshAssets(basis, settings.lightmapCoordinates || settings.lightMode == LightMode.BakedRectangle, Store);
            materials = new MaterialAssets(scene, settings, Report, Store);
            lights = new LightBuilder(basis, settings, Report);
            colliders = new ColliderBuilder(scene, basis, settings.colliders, Report, Store);
            lanes = new LaneGraphBuilder(basis, Report);
            movable = new HashSet<string>(settings.movableLabels);
            Root = new GameObject(name);
            if (QualitySettings.activeColorSpace != ColorSpace.Linear) { Report.Add("the project's color space is not linear: colors and lights are off", name); }
            frames.Push(new Frame { Nodes = scene.Roots, Parent = Root.transform, Context = new Context(), Span = 1 });
        }

        /// <summary>Makes one more node, or a whole instance of what there is already; false once all is done.</summary>
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
                if (!Unseen.Contains(node.Prim.TypeName))
                {
                    Make(node, isPoint ? frame.Matrices[number] : node.Local, isPoint ? frame.Names[number] : node.Prim.Name, isPoint, frame, span);
                }
                return true;
            }
            if (!isFinished) { Finish(); }
            return false;
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
            Context context = frame.Context;
            bool isBare = node.Mesh == null && node.Light == null && node.Camera == null && node.Shape == null && node.Collider == null && node.Curves == null
                && node.PointInstancer == null;
            object source = isPoint ? (object)node : isBare ? node.Prim.Prototype : null;
            bool isStall = LaneGraphBuilder.IsStall(node);
            if (source == null && node.Prim.TypeName == "Scope")
            {
                Unfold(node, frame, span);
                return;
            }
            if (LaneGraphBuilder.IsPart(node)) { return; }
            GameObject made = null;
            var key = new TemplateKey();
            if (source != null)
            {
                key = KeyOf(source, node, context, isStall);
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
            Placement placement = Place(made, node, local, context);
            if (node.Labels != null) { Dress<SemanticLabels>(made, isClone).Set(node.Labels); }
            if (isStall) { lanes.AddStall(Dress<Stall>(made, isClone), node); }
            if (isClone) { return; }

            if (node.Visibility == "invisible" || context.IsHidden) { made.SetActive(false); }
            Context below = context.Under(node, movable);
            below.IsMirrored ^= placement.Scale.x < 0;
            if (settings.staticFlags && !below.IsMovable) { EditorOnly.MarkStatic(made, settings.gpuInstancing); }
            if (!isBare) { AddParts(made, node, below, frame); }
            if (!Known.Contains(node.Prim.TypeName)) { Report.Add("prims of the type " + node.Prim.TypeName + " are left out", node.Prim.Path); }
            if (node.PointInstancer != null)
            {
                Scatter(made, node, below, span);
                return;
            }
            List<SceneNode> children = scene.ChildrenOf(node);
            if (children.Count == 0) { return; }
            if (node.Prim.Prototype == null && !context.IsShared) { lanes.AddGraph(made, children); }
            frames.Push(new Frame { Nodes = children, Parent = made.transform, Context = below, From = Progress, Span = span });
        }

        // a Scope has no place of its own: what is in it stands in its parent
        void Unfold(SceneNode node, Frame frame, float span)
        {
            List<SceneNode> children = scene.ChildrenOf(node);
            if (children.Count == 0) { return; }
            Context below = frame.Context.Under(node, movable);
            below.IsHidden = frame.Context.IsHidden || node.Visibility == "invisible";
            frames.Push(new Frame { Nodes = children, Parent = frame.Parent, Context = below, From = Progress, Span = span });
        }

        static TemplateKey KeyOf(object source, SceneNode node, Context context, bool isStall)
        {
            MaterialBinding material = node.Material.Under(context.Material), physics = node.PhysicsMaterial.Under(context.Physics);
            return new TemplateKey
            {
                Source = source, Material = material.Path, Physics = physics.Path, Purpose = node.Purpose ?? context.Purpose,
                Flags = (material.IsStrong ? 1 : 0) | (physics.IsStrong ? 2 : 0) | (context.IsHidden || node.Visibility == "invisible" ? 4 : 0) | (context.IsMovable ? 8 : 0)
                    | (isStall ? 16 : 0) | (node.Labels != null ? 32 : 0) | (context.IsMirrored ? 64 : 0),
            };
        }

        static T Dress<T>(GameObject made, bool isClone) where T : Component
        {
            return isClone ? made.GetComponent<T>() : made.AddComponent<T>();
        }

        Placement Place(GameObject made, SceneNode node, double[] local, Context context)
        {
            if (node.ResetsTransform)
            {
                if (context.IsShared) { Report.Add("transforms that leave their parents aside are not left aside within instances", node.Prim.Path); }
                else { made.transform.SetParent(Root.transform, false); }
            }
            Placement placement = Placement.Of(basis, local);
            if (placement.Shear > LargestShear) { Report.Add("sheared transforms stand as the nearest ones that are not sheared", node.Prim.Path); }
            placement.ApplyTo(made.transform);
            return placement;
        }

        void AddParts(GameObject made, SceneNode node, Context context, Frame frame)
        {
            Mesh mesh = node.Mesh != null ? MeshOf(node, context) : node.Shape != null ? meshes.Of(ShapeMeshes.Of(node.Shape)) : null;
            bool isDrawn = context.Purpose == "default" || context.Purpose == "render";
            if (mesh != null && isDrawn)
            {
                made.AddComponent<MeshFilter>().sharedMesh = mesh;
                made.AddComponent<MeshRenderer>().sharedMaterials = MaterialsOf(node, context);
            }
            if (node.Collider != null) { colliders.Add(made, node, mesh, context.Physics.Path, context.IsMirrored); }
            if (node.Light != null) { AddLight(made, node, context, frame); }
            if (node.Camera != null && settings.cameras) { AddCamera(made, node); }
            if (node.Curves != null && isDrawn) { Report.Add("curves are not drawn", node.Prim.Path); }
        }

        static string PathOf(SubMesh part, Context context)
        {
            return context.Material.IsStrong ? context.Material.Path : part.MaterialPath ?? context.Material.Path;
        }

        Mesh MeshOf(SceneNode node, Context context)
        {
            if (node.Mesh.Points.Length == 0 || node.Mesh.SubMeshes.Count == 0) { return null; }
            string coordinates = materials.Surface(PathOf(node.Mesh.SubMeshes[0], context), null).Coordinates;
            if (node.Mesh.TextureCoordinates.Count > 1) { Report.Add("meshes keep one set of texture coordinates", node.Prim.Path); }
            return meshes.Of(node.Mesh, coordinates, context.Component.Length > 0 ? context.Component + " " + node.Prim.Name : node.Prim.Name);
        }

        Material[] MaterialsOf(SceneNode node, Context context)
        {
            if (node.Mesh == null) { return new[] { MaterialAt(context.Material.Path, null) }; }
            var all = new Material[node.Mesh.SubMeshes.Count];
            for (int i = 0; i < all.Length; i++) { all[i] = MaterialAt(PathOf(node.Mesh.SubMeshes[i], context), node.Mesh.Colors); }
            return all;
        }

        Material MaterialAt(string path, float[] colors)
        {
            return materials.Of(materials.Surface(path, colors), path == null ? "Default" : UsdPaths.Name(path));
        }

        void AddLight(GameObject made, SceneNode node, Context context, Frame frame)
        {
            GameObject holder = made;
            if (basis.IsZUp && scene.ChildrenOf(node).Count > 0)
            {
                // what is below the light does not turn with it
                holder = new GameObject("Light");
                holder.transform.SetParent(made.transform, false);
            }
            lights.Add(holder, node);
            MeshArrays panel = LightBuilder.Panel(node.Light);
            if (panel == null || node.Light.Intensity <= 0 || settings.lightMode == LightMode.BakedRectangle || Glows(frame.Nodes, context)) { return; }
            var glow = new GameObject("Glow");
            glow.transform.SetParent(made.transform, false);
            if (basis.IsZUp && holder == made) { glow.transform.localRotation = Quaternion.Euler(-90, 0, 0); }
            glow.AddComponent<MeshFilter>().sharedMesh = meshes.Of(panel);
            MeshRenderer renderer = glow.AddComponent<MeshRenderer>();
            renderer.sharedMaterials = new[] { materials.Of(lights.Glow(node.Light), "Glow") };
            renderer.shadowCastingMode = ShadowCastingMode.Off;
        }

        // whether a mesh among these nodes and what is below them shines by itself
        bool Glows(IList<SceneNode> nodes, Context context)
        {
            foreach (SceneNode node in nodes)
            {
                if (Unseen.Contains(node.Prim.TypeName)) { continue; }
                Context below = context.Under(node, movable);
                if (node.Mesh != null)
                {
                    foreach (SubMesh part in node.Mesh.SubMeshes)
                    {
                        if (materials.Glows(PathOf(part, below))) { return true; }
                    }
                }
                if (node.Prim.Prototype == null && Glows(scene.ChildrenOf(node), below)) { return true; }
            }
            return false;
        }

        void AddCamera(GameObject made, SceneNode node)
        {
            CameraData data = node.Camera;
            if (basis.IsZUp) { made.transform.localRotation = made.transform.localRotation * Quaternion.Euler(90, 0, 0); }
            Camera camera = made.AddComponent<Camera>();
            camera.enabled = false;
            camera.orthographic = data.IsOrthographic;
            // a tenth of a unit each, and half of the height
            if (data.IsOrthographic) { camera.orthographicSize = (float)(data.VerticalAperture / 20 * basis.MetersPerUnit); }
            else { camera.fieldOfView = (float)data.VerticalFieldOfViewDegrees; }
            camera.nearClipPlane = Mathf.Max(0.01f, (float)(data.Near * basis.MetersPerUnit));
            camera.farClipPlane = Mathf.Clamp((float)(data.Far * basis.MetersPerUnit), camera.nearClipPlane + 0.01f, 100000);
            foreach (string name in node.Prim.PropertyNames)
            {
                if (!name.StartsWith("xformOp:", StringComparison.Ordinal) || node.Prim.Property(name).Samples == null) { continue; }
                Report.Add("what moves stands where it is at first", node.Prim.Path);
                return;
            }
        }

        void Scatter(GameObject holder, SceneNode node, Context context, float span)
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
                Nodes = new List<SceneNode>(), Matrices = new List<double[]>(), Names = new List<string>(), Parent = holder.transform, Context = context, From = Progress, Span = span,
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
            Root.AddComponent<ImportedStage>().Set(Root.name, scene.Stage.IsZUp ? "Z" : "Y", scene.Stage.MetersPerUnit, Report);
        }
    }
}
