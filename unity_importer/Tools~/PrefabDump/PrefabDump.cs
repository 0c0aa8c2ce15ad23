using System;
using System.Collections.Generic;
using Garage.Usd.Dump;
using UnityEditor.AssetImporters;
using UnityEngine;
using UnityEngine.AI;
#if UNITY_6000_0_OR_NEWER
using Friction = UnityEngine.PhysicsMaterial;
#else
using Friction = UnityEngine.PhysicMaterial;
#endif

namespace Garage.Unity.Dump
{
    /// <summary>A prefab and its assets as JSON. Objects tell their assets by identifiers.</summary>
    sealed class PrefabDump
    {
        const int MostVerticesInFull = 3000;

        readonly JsonText json;
        readonly AssetImportContext context;
        readonly Dictionary<UnityEngine.Object, string> names = new Dictionary<UnityEngine.Object, string>();

        public PrefabDump(JsonText json, AssetImportContext context)
        {
            this.json = json;
            this.context = context;
        }

        public void Write()
        {
            foreach (KeyValuePair<string, UnityEngine.Object> one in context.objects) { names.Add(one.Value, one.Key); }
            json.Key("assets");
            json.Open('{');
            foreach (KeyValuePair<string, UnityEngine.Object> one in context.objects)
            {
                if (one.Value is GameObject) { continue; }
                json.Key(one.Key);
                json.Open('{');
                Text("type", one.Value.GetType().Name);
                Text("name", one.Value.name);
                Asset(one.Value);
                json.Close('}');
            }
            json.Close('}');
            var root = (GameObject)context.mainObject;
            json.Key("objects");
            json.Open('[');
            foreach (Transform place in root.GetComponentsInChildren<Transform>(true)) { Object(place.gameObject); }
            json.Close(']');
            LaneGraph[] graphs = root.GetComponentsInChildren<LaneGraph>(true);
            if (graphs.Length > 0)
            {
                json.Key("graph");
                LaneDump.Write(json, graphs[0]);
            }
            GarageNavMesh mesh = root.AddComponent<GarageNavMesh>();
            NavMeshData data = mesh.Build();
            json.Key("navMesh");
            json.Open('{');
            json.Key("classes");
            json.Open('[');
            foreach (NavMeshBuildSource source in data.sources)
            {
                SemanticLabels owner = source.component.GetComponentInParent<SemanticLabels>();
                json.String(owner == null ? "" : owner.ClassLabel);
            }
            json.Close(']');
            LaneDump.Vector(json, "size", data.sourceBounds.size);
            json.Close('}');
        }

        void Text(string key, string value)
        {
            json.Key(key);
            if (value == null) { json.Null(); }
            else { json.String(value); }
        }

        void Number(string key, double value)
        {
            json.Key(key);
            json.Number(value);
        }

        void Truth(string key, bool value)
        {
            json.Key(key);
            json.Bool(value);
        }

        void Numbers(string key, IEnumerable<float> values)
        {
            json.Key(key);
            json.Open('[');
            foreach (float value in values) { json.Number(value); }
            json.Close(']');
        }

        void Vector(string key, Vector3 vector)
        {
            LaneDump.Vector(json, key, vector);
        }

        // an asset that was not added would be lost with the import
        string NameOf(UnityEngine.Object asset)
        {
            if (asset == null) { return null; }
            if (!names.ContainsKey(asset))
            {
                throw new InvalidOperationException(asset + " is used and no part of the asset");
            }
            return names[asset];
        }

        void Object(GameObject made)
        {
            json.Open('{');
            Text("path", PathOf(made.transform));
            Truth("active", made.activeSelf);
            Truth("shown", made.activeInHierarchy);
            Number("static", made.staticFlags);
            Matrix4x4 m = made.transform.localToWorldMatrix;
            // row by row, a column vector from the right
            Numbers("world", new[] { m.m00, m.m01, m.m02, m.m03, m.m10, m.m11, m.m12, m.m13, m.m20, m.m21, m.m22,
                m.m23 });
            Quaternion turn = made.transform.localRotation;
            Numbers("turn", new[] { turn.x, turn.y, turn.z, turn.w });
            MeshFilter filter = made.GetComponent<MeshFilter>();
            if (filter != null) { Text("mesh", NameOf(filter.sharedMesh)); }
            MeshRenderer renderer = made.GetComponent<MeshRenderer>();
            if (renderer != null)
            {
                json.Key("materials");
                json.Open('[');
                foreach (Material material in renderer.sharedMaterials) { json.String(NameOf(material)); }
                json.Close(']');
            }
            Components(made);
            json.Close('}');
        }

        void Components(GameObject made)
        {
            foreach (Collider collider in made.GetComponents<Collider>()) { Collider(collider); }
            SemanticLabels labels = made.GetComponent<SemanticLabels>();
            if (labels != null)
            {
                Number("instance", labels.InstanceId);
                json.Key("labels");
                json.Open('{');
                for (int i = 0; i < labels.TaxonomyCount; i++)
                {
                    SemanticLabels.Taxonomy taxonomy = labels.TaxonomyAt(i);
                    json.Key(taxonomy.name);
                    json.Open('[');
                    foreach (string label in taxonomy.labels) { json.String(label); }
                    json.Close(']');
                }
                json.Close('}');
            }
            Light light = made.GetComponent<Light>();
            if (light != null) { Light(light, made.transform.forward); }
            UsdLight given = made.GetComponent<UsdLight>();
            if (given != null)
            {
                json.Key("usdLight");
                json.Open('{');
                Text("kind", given.kind.ToString());
                Number("intensity", given.intensity);
                Number("luminance", given.luminance);
                Number("candela", given.candela);
                Number("lumen", given.lumen);
                Number("lux", given.lux);
                Number("stated", given.statedLuminance);
                Numbers("size", new[] { given.width, given.height, given.radius, given.length });
                json.Close('}');
            }
            Camera camera = made.GetComponent<Camera>();
            if (camera != null)
            {
                json.Key("camera");
                json.Open('{');
                Truth("enabled", camera.enabled);
                Number("fieldOfView", camera.fieldOfView);
                Truth("orthographic", camera.orthographic);
                Number("orthographicSize", camera.orthographicSize);
                Number("near", camera.nearClipPlane);
                Number("far", camera.farClipPlane);
                Vector("forward", made.transform.forward);
                json.Close('}');
            }
            Stall stall = made.GetComponent<Stall>();
            if (stall != null) { Stall(stall); }
            ImportedStage stage = made.GetComponent<ImportedStage>();
            if (stage != null)
            {
                Numbers("stage", new[] { stage.MetersPerUnit, stage.UpAxis == "Z" ? 1 : 0, stage.LeftOutCount });
            }
        }

        void Collider(Collider collider)
        {
            json.Key("collider");
            json.Open('{');
            Text("type", collider.GetType().Name);
            Truth("enabled", collider.enabled);
            Text("material", NameOf(collider.sharedMaterial));
            var box = collider as BoxCollider;
            var sphere = collider as SphereCollider;
            var capsule = collider as CapsuleCollider;
            var mesh = collider as MeshCollider;
            if (box != null)
            {
                Vector("center", box.center);
                Vector("size", box.size);
            }
            if (sphere != null)
            {
                Vector("center", sphere.center);
                Number("radius", sphere.radius);
            }
            if (capsule != null)
            {
                Number("radius", capsule.radius);
                Number("height", capsule.height);
                Number("direction", capsule.direction);
            }
            if (mesh != null)
            {
                Text("mesh", NameOf(mesh.sharedMesh));
                Truth("convex", mesh.convex);
            }
            json.Close('}');
        }

        void Light(Light light, Vector3 forward)
        {
            json.Key("light");
            json.Open('{');
            Text("type", light.type.ToString());
            Truth("enabled", light.enabled);
            Number("intensity", light.intensity);
            Numbers("color", new[] { light.color.r, light.color.g, light.color.b });
            Number("range", light.range);
            Number("spotAngle", light.spotAngle);
            Number("innerSpotAngle", light.innerSpotAngle);
            Numbers("area", new[] { light.areaSize.x, light.areaSize.y });
            Text("baked", light.lightmapBakeType.ToString());
            Text("shadows", light.shadows.ToString());
            Vector("forward", forward);
            json.Close('}');
        }

        static string PathOf(Transform place)
        {
            string path = place.name;
            for (Transform above = place.parent; above != null; above = above.parent)
            {
                path = above.name + "/" + path;
            }
            return path;
        }

        void Stall(Stall stall)
        {
            json.Key("stall");
            json.Open('{');
            Text("id", stall.Id);
            Text("level", stall.Level);
            Text("number", stall.Number);
            Text("type", stall.Type);
            Text("use", stall.Use);
            Text("edge", stall.EntryEdge);
            Numbers("square", new float[] { stall.Square.x, stall.Square.y });
            json.Key("occupied");
            json.Bool(stall.IsOccupied);
            Text("car", stall.Car == null ? "" : PathOf(stall.Car));
            Number("node", stall.AccessNode);
            json.Key("corners");
            json.Open('[');
            for (int i = 0; i < 4; i++)
            {
                Vector3 corner = stall.Corner(i);
                foreach (float number in new[] { corner.x, corner.y, corner.z }) { json.Number(number); }
            }
            json.Close(']');
            Vector("centre", stall.Centre);
            Vector("mouth", stall.Mouth);
            Vector("forward", stall.transform.forward);
            json.Close('}');
        }

        void Asset(UnityEngine.Object asset)
        {
            var mesh = asset as Mesh;
            var material = asset as Material;
            var texture = asset as Texture2D;
            var friction = asset as Friction;
            if (mesh != null) { Mesh(mesh); }
            if (material != null) { Material(material); }
            if (texture != null) { Texture(texture); }
            if (friction != null)
            {
                Numbers("friction", new[] { friction.staticFriction, friction.dynamicFriction, friction.bounciness });
            }
        }

        void Mesh(Mesh mesh)
        {
            Number("vertexCount", mesh.vertexCount);
            Vector("center", mesh.bounds.center);
            Vector("size", mesh.bounds.size);
            Truth("has32BitIndices", mesh.indexFormat == UnityEngine.Rendering.IndexFormat.UInt32);
            Number("tangents", mesh.tangents.Length);
            Number("lightmapCoordinates", mesh.uv2.Length);
            json.Key("parts");
            json.Open('[');
            bool isFull = mesh.vertexCount <= MostVerticesInFull;
            for (int part = 0; part < mesh.subMeshCount; part++)
            {
                int[] triangles = mesh.GetTriangles(part);
                if (!isFull)
                {
                    json.Number(triangles.Length / 3);
                    continue;
                }
                json.Open('[');
                foreach (int vertex in triangles) { json.Number(vertex); }
                json.Close(']');
            }
            json.Close(']');
            if (!isFull) { return; }
            Numbers("vertices", Flat(mesh.vertices));
            Numbers("normals", Flat(mesh.normals));
            var coordinates = new List<float>();
            foreach (Vector2 one in mesh.uv)
            {
                coordinates.Add(one.x);
                coordinates.Add(one.y);
            }
            Numbers("uv", coordinates);
        }

        static IEnumerable<float> Flat(Vector3[] vectors)
        {
            foreach (Vector3 vector in vectors)
            {
                yield return vector.x;
                yield return vector.y;
                yield return vector.z;
            }
        }

        void Material(Material material)
        {
            Text("shader", material.shader.name);
            Number("queue", material.renderQueue);
            Truth("instancing", material.enableInstancing);
            Text("illumination", material.globalIlluminationFlags.ToString());
            json.Key("keywords");
            json.Open('[');
            foreach (string keyword in material.keywords) { json.String(keyword); }
            json.Close(']');
            json.Key("floats");
            json.Open('{');
            foreach (KeyValuePair<string, float> one in material.floats) { Number(one.Key, one.Value); }
            json.Close('}');
            json.Key("colors");
            json.Open('{');
            foreach (KeyValuePair<string, Color> one in material.colors)
            {
                Numbers(one.Key, new[] { one.Value.r, one.Value.g, one.Value.b, one.Value.a });
            }
            json.Close('}');
            json.Key("textures");
            json.Open('{');
            foreach (KeyValuePair<string, Texture> one in material.textures) { Text(one.Key, NameOf(one.Value)); }
            json.Close('}');
            json.Key("coordinates");
            json.Open('{');
            foreach (KeyValuePair<string, Vector2> one in material.scales)
            {
                Vector2 offset = material.offsets[one.Key];
                Numbers(one.Key, new[] { one.Value.x, one.Value.y, offset.x, offset.y });
            }
            json.Close('}');
        }

        void Texture(Texture2D texture)
        {
            Number("width", texture.width);
            Number("height", texture.height);
            Truth("linear", texture.isLinear);
            Truth("mipmaps", texture.hasMipmaps);
            Truth("compressed", texture.isCompressed);
            Truth("readable", texture.isReadable);
            Text("wrap", texture.wrapModeU + " " + texture.wrapModeV);
            if (texture.file != null && texture.file[0] == 0xff)
            {
                Number("bytes", texture.file.Length);
                return;
            }
            Color32[] pixels = texture.Stored();
            var bytes = new byte[4 * pixels.Length];
            for (int i = 0; i < pixels.Length; i++)
            {
                bytes[4 * i] = pixels[i].r;
                bytes[4 * i + 1] = pixels[i].g;
                bytes[4 * i + 2] = pixels[i].b;
                bytes[4 * i + 3] = pixels[i].a;
            }
            Text("pixels", Convert.ToBase64String(bytes));
        }
    }
}
