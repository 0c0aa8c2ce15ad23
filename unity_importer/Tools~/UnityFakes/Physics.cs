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
            return new Bounds(center,
                new Vector3(direction == 0 ? along : across, direction == 1 ? along : across, direction == 2 ? along
                : across));
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

namespace UnityEngine
{
    public struct RaycastHit
    {
        internal Collider struck;

        public Collider collider { get { return struck; } }
        public float distance { get; set; }
    }

    /// <summary>Strikes boxes and meshes whose objects were made one by one; clones are not known.</summary>
    public class Physics
    {
        static readonly List<WeakReference> Known = new List<WeakReference>();
        static int countToSweep = 10000;

        internal static void Know(Collider collider)
        {
            if (Known.Count > countToSweep)
            {
                Known.RemoveAll(one => !one.IsAlive);
                countToSweep = Math.Max(10000, 2 * Known.Count);
            }
            Known.Add(new WeakReference(collider));
        }

        public static void SyncTransforms()
        {
        }

        public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit hitInfo)
        {
            hitInfo = new RaycastHit { distance = float.PositiveInfinity };
            foreach (WeakReference one in Known)
            {
                var collider = one.Target as Collider;
                if (collider == null || !collider.enabled || !collider.gameObject.activeInHierarchy) { continue; }
                Matrix4x4 matrix = collider.transform.localToWorldMatrix;
                foreach (Vector3[] triangle in Triangles(collider))
                {
                    Vector3 a = matrix.MultiplyPoint3x4(triangle[0]), b = matrix.MultiplyPoint3x4(triangle[1]),
                        c = matrix.MultiplyPoint3x4(triangle[2]);
                    float distance = Distance(origin, direction.normalized, a, b, c);
                    if (distance < hitInfo.distance)
                    {
                        hitInfo = new RaycastHit { struck = collider, distance = distance };
                    }
                }
            }
            return hitInfo.struck != null;
        }

        // fronts only, as of meshes that are not convex
        static float Distance(Vector3 origin, Vector3 direction, Vector3 a, Vector3 b, Vector3 c)
        {
            Vector3 normal = Vector3.Cross(b - a, c - a);
            float along = Vector3.Dot(normal, direction);
            if (along >= 0) { return float.PositiveInfinity; }
            float distance = Vector3.Dot(normal, a - origin) / along;
            Vector3 point = origin + direction * distance;
            bool isInside = Vector3.Dot(Vector3.Cross(b - a, point - a), normal) >= 0
                && Vector3.Dot(Vector3.Cross(c - b, point - b), normal) >= 0
                && Vector3.Dot(Vector3.Cross(a - c, point - c), normal) >= 0;
            return isInside && distance >= 0 ? distance : float.PositiveInfinity;
        }

        static IEnumerable<Vector3[]> Triangles(Collider collider)
        {
            var box = collider as BoxCollider;
            var mesh = collider as MeshCollider;
            if (mesh != null)
            {
                Vector3[] points = mesh.sharedMesh.vertices;
                int[] triangles = mesh.sharedMesh.triangles;
                for (int i = 0; i < triangles.Length; i += 3)
                {
                    yield return new[] { points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]] };
                }
            }
            for (int side = 0; box != null && side < 6; side++)
            {
                var corners = new Vector3[4];
                for (int corner = 0; corner < 4; corner++)
                {
                    float sign = side < 3 ? 1 : -1, u = corner == 1 || corner == 2 ? 1 : -1, v = corner >= 2 ? 1 : -1;
                    var offset = new[] { sign, sign * u, v };
                    int axis = side % 3;
                    var own = new Vector3(offset[(3 - axis) % 3], offset[(4 - axis) % 3], offset[(5 - axis) % 3]);
                    corners[corner] = box.center + Vector3.Scale(own, box.size * 0.5f);
                }
                yield return new[] { corners[0], corners[1], corners[2] };
                yield return new[] { corners[0], corners[2], corners[3] };
            }
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
            return new NavMeshBuildSettings { agentRadius = 0.5f, agentHeight = 2, agentSlope = 45,
                agentClimb = 0.75f };
        }

        public static NavMeshDataInstance AddNavMeshData(NavMeshData navMeshData)
        {
            return new NavMeshDataInstance { data = navMeshData };
        }
    }

    public static class NavMeshBuilder
    {
        public static void CollectSources(Transform root, int includedLayerMask, NavMeshCollectGeometry geometry,
            int defaultArea,
            List<NavMeshBuildMarkup> markups, List<NavMeshBuildSource> results)
        {
            results.Clear();
            if (geometry != NavMeshCollectGeometry.PhysicsColliders)
            {
                throw new NotSupportedException("only colliders are collected here");
            }
            foreach (Collider collider in root.GetComponentsInChildren<Collider>())
            {
                if ((1 << collider.gameObject.layer & includedLayerMask) == 0) { continue; }
                results.Add(new NavMeshBuildSource
                {
                    shape = collider is BoxCollider ? NavMeshBuildSourceShape.Box
                        : NavMeshBuildSourceShape.Mesh, component = collider,
                    transform = collider.transform.localToWorldMatrix,
                });
            }
        }

        public static NavMeshData BuildNavMeshData(NavMeshBuildSettings buildSettings,
            List<NavMeshBuildSource> sources, Bounds localBounds, Vector3 position,
            Quaternion rotation)
        {
            return new NavMeshData { sources = new List<NavMeshBuildSource>(sources), sourceBounds = localBounds };
        }
    }
}
