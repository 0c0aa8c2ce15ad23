using System;
using System.Collections.Generic;

namespace UnityEngine
{
#if UNITY_6000_0_OR_NEWER
    public class PhysicsMaterial : Object
    {
        public PhysicsMaterial(string name)
        {
            this.name = name;
        }
#else
    public class PhysicMaterial : Object
    {
        public PhysicMaterial(string name)
        {
            this.name = name;
        }
#endif

        public float dynamicFriction { get; set; }
        public float staticFriction { get; set; }
        public float bounciness { get; set; }
    }

    public class Collider : Component
    {
        public Collider()
        {
            enabled = true;
        }

        public bool enabled { get; set; }

        internal virtual Bounds Own()
        {
            return new Bounds();
        }

        /// <summary>In the world, around the box of its own space.</summary>
        public Bounds bounds
        {
            get
            {
                Bounds own = Own();
                Matrix4x4 matrix = transform.localToWorldMatrix;
                var all = new Bounds(matrix.MultiplyPoint3x4(own.center), Vector3.zero);
                for (int corner = 0; corner < 8; corner++)
                {
                    var offset = new Vector3((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
                    all.Encapsulate(matrix.MultiplyPoint3x4(own.center + Vector3.Scale(offset, own.extents)));
                }
                return all;
            }
        }

#if UNITY_6000_0_OR_NEWER
        public PhysicsMaterial sharedMaterial { get; set; }
#else
        public PhysicMaterial sharedMaterial { get; set; }
#endif
    }

    public class BoxCollider : Collider
    {
        public Vector3 center { get; set; }
        public Vector3 size { get; set; }

        internal override Bounds Own()
        {
            return new Bounds(center, size);
        }
    }

    public class SphereCollider : Collider
    {
        public Vector3 center { get; set; }
        public float radius { get; set; }

        internal override Bounds Own()
        {
            return new Bounds(center, Vector3.one * (2 * radius));
        }
    }

    public class CapsuleCollider : Collider
    {
        public Vector3 center { get; set; }
        public float radius { get; set; }
        public float height { get; set; }

        /// <summary>0, 1, 2 for x, y, z.</summary>
        public int direction { get; set; }

        internal override Bounds Own()
        {
            float along = Math.Max(height, 2 * radius), across = 2 * radius;
            return new Bounds(center, new Vector3(direction == 0 ? along : across, direction == 1 ? along : across, direction == 2 ? along : across));
        }
    }

    public class MeshCollider : Collider
    {
        public Mesh sharedMesh { get; set; }
        public bool convex { get; set; }

        internal override Bounds Own()
        {
            return sharedMesh.bounds;
        }
    }
}

namespace UnityEngine.AI
{
    public enum NavMeshCollectGeometry { RenderMeshes, PhysicsColliders }

    public enum NavMeshBuildSourceShape { Mesh, Terrain, Box, Sphere, Capsule, ModifierBox }

    public struct NavMeshBuildSource
    {
        public NavMeshBuildSourceShape shape { get; set; }
        public Matrix4x4 transform { get; set; }
        public Component component { get; set; }
    }

    public struct NavMeshBuildMarkup
    {
    }

    public struct NavMeshBuildSettings
    {
        public int agentTypeID { get; set; }
        public float agentRadius { get; set; }
        public float agentHeight { get; set; }
        public float agentSlope { get; set; }
        public float agentClimb { get; set; }
    }

    /// <summary>What it was built of.</summary>
    public sealed class NavMeshData : Object
    {
        internal List<NavMeshBuildSource> sources;

        public Bounds sourceBounds { get; internal set; }
    }

    public struct NavMeshDataInstance
    {
        internal NavMeshData data;

        public bool valid { get { return data != null; } }

        public void Remove()
        {
            data = null;
        }
    }

    public static class NavMesh
    {
        public static NavMeshBuildSettings GetSettingsByIndex(int index)
        {
            return new NavMeshBuildSettings { agentRadius = 0.5f, agentHeight = 2, agentSlope = 45, agentClimb = 0.75f };
        }

        public static NavMeshDataInstance AddNavMeshData(NavMeshData navMeshData)
        {
            return new NavMeshDataInstance { data = navMeshData };
        }
    }

    public static class NavMeshBuilder
    {
        public static void CollectSources(Transform root, int includedLayerMask, NavMeshCollectGeometry geometry, int defaultArea,
            List<NavMeshBuildMarkup> markups, List<NavMeshBuildSource> results)
        {
            results.Clear();
            if (geometry != NavMeshCollectGeometry.PhysicsColliders) { throw new NotSupportedException("only colliders are collected here"); }
            foreach (Collider collider in root.GetComponentsInChildren<Collider>())
            {
                if ((1 << collider.gameObject.layer & includedLayerMask) == 0) { continue; }
                results.Add(new NavMeshBuildSource
                {
                    shape = collider is BoxCollider ? NavMeshBuildSourceShape.Box : NavMeshBuildSourceShape.Mesh, component = collider,
                    transform = collider.transform.localToWorldMatrix,
                });
            }
        }

        public static NavMeshData BuildNavMeshData(NavMeshBuildSettings buildSettings, List<NavMeshBuildSource> sources, Bounds localBounds, Vector3 position,
            Quaternion rotation)
        {
            return new NavMeshData { sources = new List<NavMeshBuildSource>(sources), sourceBounds = localBounds };
        }
    }
}
