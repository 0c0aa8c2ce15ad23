using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;
using UnityEngine.Rendering;

namespace Garage.Unity
{
    /// <summary>Puts what a node is on its object: mesh, collider, light, camera.</summary>
    sealed class PartBuilder
    {
        readonly SceneModel scene;
        readonly ImportSettings settings;
        readonly Basis basis;
        readonly ImportReport report;
        readonly HashSet<string> movable;
        readonly MeshAssets meshes;
        readonly MaterialAssets materials;
        readonly LightBuilder lights;
        readonly ColliderBuilder colliders;

        public PartBuilder(SceneModel scene, ImportSettings settings, bool isAsset, Basis basis,
            HashSet<string> movable, ImportReport report, Action<string, UnityEngine.Object> store)
        {
            this.scene = scene;
            this.settings = settings;
            this.basis = basis;
            this.report = report;
            this.movable = movable;
            bool unwraps = settings.lightmapCoordinates || settings.lightMode == LightMode.BakedRectangle;
            meshes = new MeshAssets(basis, unwraps, store);
            var textures = new TextureAssets(scene.Stage, settings.compressTextures, isAsset, report, store);
            materials = new MaterialAssets(scene, settings, textures, report, store);
            lights = new LightBuilder(basis, settings, report);
            colliders = new ColliderBuilder(scene, basis, settings.colliders, report, store);
        }

        /// <summary>Whether a node is no more than a place.</summary>
        public static bool IsBare(SceneNode node)
        {
            return node.Mesh == null && node.Light == null && node.Camera == null && node.Shape == null
                && node.Collider == null && node.Curves == null && node.PointInstancer == null;
        }

        /// <summary>Puts the parts of a node on its object; beside it are the nodes that it stands among.</summary>
        public void Add(GameObject made, SceneNode node, BuildContext context, IList<SceneNode> beside)
        {
            Mesh mesh = null;
            if (node.Mesh != null) { mesh = MeshOf(node, context); }
            else if (node.Shape != null) { mesh = meshes.Of(ShapeMeshes.Of(node.Shape)); }
            if (mesh != null && context.IsDrawn)
            {
                made.AddComponent<MeshFilter>().sharedMesh = mesh;
                made.AddComponent<MeshRenderer>().sharedMaterials = MaterialsOf(node, context);
            }
            if (node.Collider != null) { colliders.Add(made, node, mesh, context.Physics.Path, context.IsMirrored); }
            if (node.Light != null) { AddLight(made, node, context, beside); }
            if (node.Camera != null && settings.cameras) { AddCamera(made, node); }
            if (node.Curves != null && context.IsDrawn) { report.Add("curves are not drawn", node.Prim.Path); }
        }

        /// <summary>Names what a copy of an object cannot be where it stands.</summary>
        public void CheckCopy(GameObject made, SceneNode node)
        {
            colliders.CheckRound(made, node.Prim.Path);
        }

        Mesh MeshOf(SceneNode node, BuildContext context)
        {
            if (node.Mesh.Points.Length == 0 || node.Mesh.SubMeshes.Count == 0) { return null; }
            string coordinates = null;
            foreach (SubMesh part in node.Mesh.SubMeshes)
            {
                SurfaceData surface = materials.Surface(context.MaterialOf(part), node.Mesh.Colors);
                if (!surface.IsTextured) { continue; }
                if (!node.Mesh.TextureCoordinates.ContainsKey(surface.Coordinates))
                {
                    report.Add("meshes lack the texture coordinates that their materials read", node.Prim.Path);
                }
                coordinates = coordinates ?? surface.Coordinates;
                if (surface.Coordinates != coordinates)
                {
                    report.Add("all materials of a mesh use the texture coordinates of the first one", node.Prim.Path);
                }
            }
            coordinates = coordinates ?? "st";
            if (node.Mesh.TextureCoordinates.Count > 1)
            {
                report.Add("meshes keep one set of texture coordinates", node.Prim.Path);
            }
            string name = context.Component.Length > 0 ? context.Component + " " + node.Prim.Name : node.Prim.Name;
            return meshes.Of(node.Mesh, coordinates, name);
        }

        Material[] MaterialsOf(SceneNode node, BuildContext context)
        {
            if (node.Mesh == null) { return new[] { MaterialAt(context.Material.Path, null) }; }
            var all = new Material[node.Mesh.SubMeshes.Count];
            for (int i = 0; i < all.Length; i++)
            {
                all[i] = MaterialAt(context.MaterialOf(node.Mesh.SubMeshes[i]), node.Mesh.Colors);
            }
            return all;
        }

        Material MaterialAt(string path, float[] colors)
        {
            return materials.Of(materials.Surface(path, colors), path == null ? "Default" : UsdPaths.Name(path));
        }

        void AddLight(GameObject made, SceneNode node, BuildContext context, IList<SceneNode> beside)
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
            bool isBaked = settings.lightMode == LightMode.BakedRectangle;
            if (panel == null || isBaked || node.Light.Intensity <= 0 || Glows(beside, context)) { return; }
            var glow = new GameObject("Glow");
            glow.transform.SetParent(made.transform, false);
            if (basis.IsZUp && holder == made) { glow.transform.localRotation = Quaternion.Euler(-90, 0, 0); }
            glow.AddComponent<MeshFilter>().sharedMesh = meshes.Of(panel);
            MeshRenderer renderer = glow.AddComponent<MeshRenderer>();
            renderer.sharedMaterials = new[] { materials.Of(lights.Glow(node.Light), "Glow") };
            renderer.shadowCastingMode = ShadowCastingMode.Off;
        }

        // whether a mesh among these nodes and what is below them shines by itself
        bool Glows(IList<SceneNode> nodes, BuildContext context)
        {
            foreach (SceneNode node in nodes)
            {
                if (SceneBuilder.IsUnseen(node)) { continue; }
                BuildContext below = context.Under(node, movable);
                if (node.Mesh != null)
                {
                    foreach (SubMesh part in node.Mesh.SubMeshes)
                    {
                        if (materials.Glows(below.MaterialOf(part))) { return true; }
                    }
                }
                if (node.Prim.Prototype == null && Glows(scene.ChildrenOf(node), below)) { return true; }
            }
            return false;
        }

        void AddCamera(GameObject made, SceneNode node)
        {
            CameraData data = node.Camera;
            Transform place = made.transform;
            if (basis.IsZUp) { place.localRotation = place.localRotation * Quaternion.Euler(90, 0, 0); }
            Camera camera = made.AddComponent<Camera>();
            camera.enabled = false;
            camera.orthographic = data.IsOrthographic;
            double metres = basis.MetersPerUnit;
            // a tenth of a unit each, and half of the height
            if (data.IsOrthographic) { camera.orthographicSize = (float)(data.VerticalAperture / 20 * metres); }
            else { camera.fieldOfView = (float)data.VerticalFieldOfViewDegrees; }
            camera.nearClipPlane = Mathf.Max(0.01f, (float)(data.Near * metres));
            camera.farClipPlane = Mathf.Clamp((float)(data.Far * metres), camera.nearClipPlane + 0.01f, 100000);
            foreach (string name in node.Prim.PropertyNames)
            {
                bool isPlace = name.StartsWith("xformOp:", StringComparison.Ordinal);
                if (!isPlace || node.Prim.Property(name).Samples == null) { continue; }
                report.Add("what moves stands where it is at first", node.Prim.Path);
                return;
            }
        }
    }
}
