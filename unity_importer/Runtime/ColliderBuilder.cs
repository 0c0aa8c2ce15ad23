using System;
using System.Collections.Generic;
using Garage.Usd;
using UnityEngine;
#if UNITY_6000_0_OR_NEWER
using Friction = UnityEngine.PhysicsMaterial;
#else
using Friction = UnityEngine.PhysicMaterial;
#endif

namespace Garage.Unity
{
    /// <summary>Unity's colliders for those of UsdPhysics.</summary>
    sealed class ColliderBuilder
    {
        // how much scale may differ by axis, as a share of it, and still be that of a ball
        const float EvenScale = 1e-4f;

        readonly SceneModel scene;
        readonly Basis basis;
        readonly ColliderMode mode;
        readonly ImportReport report;
        readonly Action<string, UnityEngine.Object> store;
        readonly Dictionary<string, Friction> byPath = new Dictionary<string, Friction>();
        readonly Dictionary<string, Friction> byKey = new Dictionary<string, Friction>();

        public ColliderBuilder(SceneModel scene, Basis basis, ColliderMode mode, ImportReport report,
            Action<string, UnityEngine.Object> store)
        {
            this.scene = scene;
            this.basis = basis;
            this.mode = mode;
            this.report = report;
            this.store = store;
        }

        /// <summary>Puts the collider of a node on its object; the mesh is what it shows, the path that of its physics
        /// material.</summary>
        public void Add(GameObject holder, SceneNode node, Mesh mesh, string material, bool isMirrored)
        {
            if (mode == ColliderMode.None || node.Collider == null) { return; }
            if (mesh == null)
            {
                report.Add("colliders without a mesh or a shape are left out", node.Prim.Path);
                return;
            }
            Collider collider = mode == ColliderMode.Boxes ? Box(holder, mesh.bounds)
                : node.Shape != null ? OfShape(holder, node.Shape, mesh, IsScaledEvenly(holder.transform))
                : OfMesh(holder, node, mesh);
            collider.enabled = node.Collider.IsEnabled;
            collider.sharedMaterial = FrictionAt(material);
            if (isMirrored) { report.Add("colliders stand under mirrored transforms", node.Prim.Path); }
        }

        /// <summary>
        /// Names the round colliders of an object and below it that stand under scale that differs by axis, where
        /// Unity keeps them round.
        /// </summary>
        public void CheckRound(GameObject made, string path)
        {
            bool isStretched = false;
            foreach (Collider collider in made.GetComponentsInChildren<Collider>(true))
            {
                bool isRound = collider is SphereCollider || collider is CapsuleCollider;
                isStretched |= isRound && !IsScaledEvenly(collider.transform);
            }
            if (isStretched) { report.Add("round colliders stay round under scale that differs by axis", path); }
        }

        static bool IsScaledEvenly(Transform place)
        {
            Matrix4x4 matrix = place.localToWorldMatrix;
            Vector3 middle = matrix.MultiplyPoint3x4(Vector3.zero);
            float x = Vector3.Distance(middle, matrix.MultiplyPoint3x4(new Vector3(1, 0, 0)));
            float y = Vector3.Distance(middle, matrix.MultiplyPoint3x4(new Vector3(0, 1, 0)));
            float z = Vector3.Distance(middle, matrix.MultiplyPoint3x4(new Vector3(0, 0, 1)));
            return Mathf.Abs(x - y) <= EvenScale * x && Mathf.Abs(x - z) <= EvenScale * x;
        }

        static Collider Box(GameObject holder, Bounds bounds)
        {
            BoxCollider box = holder.AddComponent<BoxCollider>();
            box.center = bounds.center;
            box.size = bounds.size;
            return box;
        }

        static Collider OfMesh(GameObject holder, Mesh mesh, bool isConvex)
        {
            MeshCollider collider = holder.AddComponent<MeshCollider>();
            collider.convex = isConvex;
            collider.sharedMesh = mesh;
            return collider;
        }

        Collider OfMesh(GameObject holder, SceneNode node, Mesh mesh)
        {
            switch (node.Collider.Approximation)
            {
                case "boundingCube": return Box(holder, mesh.bounds);
                case "boundingSphere":
                    SphereCollider sphere = holder.AddComponent<SphereCollider>();
                    sphere.center = mesh.bounds.center;
                    float radius = 0;
                    foreach (Vector3 point in mesh.vertices)
                    {
                        radius = Mathf.Max(radius, Vector3.Distance(point, sphere.center));
                    }
                    sphere.radius = radius;
                    CheckRound(holder, node.Prim.Path);
                    return sphere;
                case "convexHull": return OfMesh(holder, mesh, true);
                case "convexDecomposition":
                    report.Add("convex decompositions are single convex hulls", node.Prim.Path);
                    return OfMesh(holder, mesh, true);
                case "meshSimplification":
                    report.Add("colliders are not simplified", node.Prim.Path);
                    return OfMesh(holder, mesh, false);
                default: return OfMesh(holder, mesh, false);
            }
        }

        Collider OfShape(GameObject holder, ShapeData shape, Mesh mesh, bool isScaledEvenly)
        {
            float metres = (float)basis.MetersPerUnit;
            bool isRound = shape.Kind == "Sphere" || shape.Kind == "Capsule";
            // an ellipsoid, or a capsule with such ends, is no collider of Unity's
            if (isRound && !isScaledEvenly) { return OfMesh(holder, mesh, true); }
            switch (shape.Kind)
            {
                case "Cube": return Box(holder, mesh.bounds);
                case "Sphere":
                    SphereCollider sphere = holder.AddComponent<SphereCollider>();
                    sphere.center = Vector3.zero;
                    sphere.radius = (float)shape.Radius * metres;
                    return sphere;
                case "Capsule":
                    CapsuleCollider capsule = holder.AddComponent<CapsuleCollider>();
                    capsule.center = Vector3.zero;
                    capsule.radius = (float)shape.Radius * metres;
                    // Unity's height has the round ends in it
                    capsule.height = (float)(shape.Height + 2 * shape.Radius) * metres;
                    capsule.direction = shape.Axis == 'X' ? 0 : (shape.Axis == 'Z') == basis.IsZUp ? 1 : 2;
                    return capsule;
                default: return OfMesh(holder, mesh, shape.Kind != "Plane");
            }
        }

        Friction FrictionAt(string path)
        {
            Friction friction;
            if (path == null) { return null; }
            if (byPath.TryGetValue(path, out friction)) { return friction; }
            UsdPrim prim = scene.Stage.PrimAt(path);
            PhysicsMaterialData data = PhysicsMaterialData.Of(prim);
            if (data != null)
            {
                string key = "friction "
                    + InvariantText.Of(data.StaticFriction, data.DynamicFriction, data.Restitution);
                if (!byKey.TryGetValue(key, out friction))
                {
                    friction = new Friction(prim.Name)
                    {
                        staticFriction = (float)data.StaticFriction, dynamicFriction = (float)data.DynamicFriction,
                        bounciness = Mathf.Clamp01((float)data.Restitution),
                    };
                    byKey.Add(key, friction);
                    store(key, friction);
                }
            }
            byPath.Add(path, friction);
            return friction;
        }
    }
}
