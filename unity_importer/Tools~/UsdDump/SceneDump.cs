using System;
using System.Collections.Generic;

namespace Garage.Usd.Dump
{
    /// <summary>The scene as JSON: every node at every place where it stands, by its path through instances.</summary>
    sealed class SceneDump
    {
        readonly JsonText json = new JsonText();
        readonly SceneModel scene;
        readonly HashSet<string> materials = new HashSet<string>();

        SceneDump(SceneModel scene)
        {
            this.scene = scene;
        }

        public static string Of(UsdStage stage)
        {
            return new SceneDump(new SceneModel(stage)).Write();
        }

        string Write()
        {
            json.Open('{');
            json.Key("nodes");
            json.Open('{');
            var none = new MaterialBinding(null, false);
            foreach (SceneNode node in scene.Roots)
            {
                Node(node, node.Prim.Path, Matrix4.Identity(), none, none, "", "");
            }
            json.Close('}');
            json.Key("materials");
            json.Open('{');
            foreach (string path in materials) { Material(path); }
            json.Close('}');
            json.Key("warnings");
            json.Open('[');
            foreach (string warning in scene.Stage.Warnings) { json.String(warning); }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }

        // within instances, paths of the prototype stand for those of the instance
        static string Shown(string path, string prototype, string instance)
        {
            return path != null && prototype.Length > 0 && UsdPaths.HasPrefix(path, prototype)
                ? instance + path.Substring(prototype.Length) : path;
        }

        void Node(SceneNode node, string path, double[] above, MaterialBinding material, MaterialBinding physics,
            string prototype, string instance)
        {
            double[] world = node.ResetsTransform ? node.Local : Matrix4.Multiply(node.Local, above);
            material = Rebased(node.Material, prototype, instance).Under(material);
            physics = Rebased(node.PhysicsMaterial, prototype, instance).Under(physics);
            json.Key(path);
            json.Open('{');
            json.Key("world");
            Numbers(world);
            if (material.Material(scene.Stage) != null)
            {
                Text("material", material.Path);
                materials.Add(material.Path);
            }
            if (node.Visibility != "inherited") { Text("visibility", node.Visibility); }
            Text("purpose", node.Purpose);
            if (node.Mesh != null) { Mesh(node.Mesh); }
            if (node.Light != null) { Light(node.Light); }
            if (node.Camera != null) { Camera(node.Camera); }
            if (node.Shape != null) { Shape(node.Shape); }
            if (node.Curves != null) { Curves(node.Curves); }
            if (node.Collider != null)
            {
                Text("collider", node.Collider.IsEnabled ? node.Collider.Approximation : "disabled");
                PhysicsMaterialData data = PhysicsMaterialData.Of(physics.Material(scene.Stage));
                if (data != null)
                {
                    Number("friction", data.StaticFriction);
                    Number("slidingFriction", data.DynamicFriction);
                    Number("restitution", data.Restitution);
                    Number("density", data.Density);
                }
            }
            if (node.Labels != null)
            {
                json.Key("labels");
                json.Open('{');
                foreach (KeyValuePair<string, string[]> label in node.Labels)
                {
                    json.Key(label.Key);
                    json.Open('[');
                    foreach (string one in label.Value) { json.String(one); }
                    json.Close(']');
                }
                json.Close('}');
            }
            if (node.PointInstancer != null) { PointInstancer(node.PointInstancer); }
            json.Close('}');
            if (node.Prim.Prototype != null)
            {
                prototype = node.Prim.Prototype.Path;
                instance = path;
            }
            foreach (SceneNode child in scene.ChildrenOf(node))
            {
                Node(child, UsdPaths.Child(path, child.Prim.Name), world, material, physics, prototype, instance);
            }
        }

        static MaterialBinding Rebased(MaterialBinding binding, string prototype, string instance)
        {
            return binding.Moved(delegate(string path) { return Shown(path, prototype, instance); });
        }

        void Text(string key, string value)
        {
            if (value == null) { return; }
            json.Key(key);
            json.String(value);
        }

        void Number(string key, double value)
        {
            json.Key(key);
            json.Number(value);
        }

        void Numbers(string key, IEnumerable<float> numbers)
        {
            json.Key(key);
            Floats(numbers);
        }

        void Numbers(string key, IEnumerable<int> numbers)
        {
            json.Key(key);
            json.Open('[');
            foreach (int number in numbers) { json.Number(number); }
            json.Close(']');
        }

        void Numbers(IEnumerable<double> numbers)
        {
            json.Open('[');
            foreach (double number in numbers) { json.Number(number); }
            json.Close(']');
        }

        void Floats(IEnumerable<float> numbers)
        {
            json.Open('[');
            foreach (float number in numbers) { json.Number(number); }
            json.Close(']');
        }

        void Mesh(TriangleMesh mesh)
        {
            double area = 0;
            int triangles = 0;
            var sum = new double[3];
            foreach (SubMesh part in mesh.SubMeshes)
            {
                triangles += part.Triangles.Length / 3;
                for (int i = 0; i < part.Triangles.Length; i += 3)
                {
                    int a = 3 * part.Triangles[i], b = 3 * part.Triangles[i + 1], c = 3 * part.Triangles[i + 2];
                    var cross = new double[3];
                    for (int k = 0; k < 3; k++)
                    {
                        int u = (k + 1) % 3, v = (k + 2) % 3;
                        float[] p = mesh.Points;
                        cross[k] = ((double)p[b + u] - p[a + u]) * ((double)p[c + v] - p[a + v]) - (
                            (double)p[b + v] - p[a + v]) * ((double)p[c + u] - p[a + u]);
                        sum[k] += cross[k] / 2;
                    }
                    area += Math.Sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]) / 2;
                }
            }
            json.Key("mesh");
            json.Open('{');
            json.Key("triangles");
            json.Number(triangles);
            json.Key("vertices");
            json.Number(mesh.PointOfVertex.Length);
            json.Key("area");
            json.Number(area);
            json.Key("sum");
            Numbers(sum);
            json.Key("isDoubleSided");
            json.Bool(mesh.IsDoubleSided);
            json.Key("parts");
            json.Open('[');
            foreach (SubMesh part in mesh.SubMeshes) { json.Number(part.Triangles.Length / 3); }
            json.Close(']');
            json.Key("materials");
            json.Open('[');
            foreach (SubMesh part in mesh.SubMeshes) { json.String(part.MaterialPath ?? ""); }
            json.Close(']');
            if (triangles <= 200)
            {
                // each corner in full, so that a test can look at all of them
                json.Key("corners");
                json.Open('[');
                foreach (SubMesh part in mesh.SubMeshes)
                {
                    foreach (int vertex in part.Triangles) { json.Number(mesh.PointOfVertex[vertex]); }
                }
                json.Close(']');
                json.Key("normals");
                Corners(mesh, mesh.Normals, 3);
                if (mesh.Colors != null)
                {
                    json.Key("colors");
                    Corners(mesh, mesh.Colors, 3);
                }
                foreach (KeyValuePair<string, float[]> channel in mesh.TextureCoordinates)
                {
                    json.Key("primvars:" + channel.Key);
                    Corners(mesh, channel.Value, 2);
                }
            }
            json.Close('}');
        }

        void Corners(TriangleMesh mesh, float[] values, int size)
        {
            json.Open('[');
            foreach (SubMesh part in mesh.SubMeshes)
            {
                foreach (int vertex in part.Triangles)
                {
                    for (int k = 0; k < size; k++) { json.Number(values[size * vertex + k]); }
                }
            }
            json.Close(']');
        }

        void Light(LightData light)
        {
            double metres = scene.Stage.MetersPerUnit;
            json.Key("light");
            json.Open('{');
            Text("kind", light.Kind.ToString());
            Numbers("color", light.Color);
            Number("luminance", light.Luminance(metres));
            Number("candela", light.Candela(metres));
            Number("lumen", light.Lumen(metres));
            Number("lux", light.Lux);
            Number("cone", light.ConeAngleDegrees);
            Number("softness", light.ConeSoftness);
            Number("temperature", light.ColorTemperature);
            json.Close('}');
        }

        void Camera(CameraData camera)
        {
            json.Key("camera");
            json.Open('{');
            Number("fieldOfView", camera.VerticalFieldOfViewDegrees);
            Number("horizontalAperture", camera.HorizontalAperture);
            Number("near", camera.Near);
            Number("far", camera.Far);
            json.Key("isOrthographic");
            json.Bool(camera.IsOrthographic);
            json.Close('}');
        }

        void Shape(ShapeData shape)
        {
            json.Key("shape");
            json.Open('{');
            Text("kind", shape.Kind);
            Text("axis", shape.Axis.ToString());
            Number("size", shape.Size);
            Number("radius", shape.Radius);
            Number("height", shape.Height);
            Number("width", shape.Width);
            Number("length", shape.Length);
            json.Close('}');
        }

        void Curves(CurvesData curves)
        {
            json.Key("curves");
            json.Open('{');
            Text("type", curves.IsLinear ? "linear" : curves.Basis);
            Text("wrap", curves.Wrap);
            Numbers("counts", curves.VertexCounts);
            Numbers("points", curves.Points);
            Numbers("widths", curves.Widths);
            json.Close('}');
        }

        void PointInstancer(PointInstancerData instancer)
        {
            json.Key("prototypes");
            json.Open('[');
            foreach (string path in instancer.Prototypes) { json.String(path); }
            json.Close(']');
            Numbers("numbers", instancer.Numbers);
            Numbers("prototypeOf", instancer.PrototypeOf);
            json.Key("instances");
            json.Open('[');
            foreach (double[] matrix in instancer.Matrices) { Numbers(matrix); }
            json.Close(']');
        }

        void Material(string path)
        {
            MaterialData data = scene.Material(path);
            if (data == null) { return; }
            json.Key(path);
            json.Open('{');
            foreach (KeyValuePair<string, MaterialInput> input in data.Inputs)
            {
                json.Key(input.Key);
                json.Open('{');
                TextureData texture = input.Value.Texture;
                if (input.Value.Value != null)
                {
                    json.Key("value");
                    Floats(input.Value.Value);
                }
                Text("primvar", input.Value.Primvar);
                if (texture != null)
                {
                    Text("asset", texture.AssetPath);
                    Text("identifier", texture.Identifier);
                    Text("channel", texture.Channel);
                    Text("wrapS", texture.WrapS);
                    Text("colorSpace", texture.SourceColorSpace);
                    Text("coordinates", texture.Primvar);
                    json.Key("scale");
                    Floats(texture.Scale);
                    json.Key("bias");
                    Floats(texture.Bias);
                    json.Key("transform");
                    json.Open('[');
                    Floats(texture.CoordinateScale);
                    json.Number(texture.CoordinateRotationDegrees);
                    Floats(texture.CoordinateTranslation);
                    json.Close(']');
                }
                json.Close('}');
            }
            json.Close('}');
        }
    }
}
