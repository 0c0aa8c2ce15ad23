using System.IO;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Garage.Unity.Editor.Tests
{
    /// <summary>What becomes of a stage that lies in the project's Assets.</summary>
    public sealed class UsdImporterTests
    {
        const string Folder = "Assets/GarageImporterTests";
        const string Stage = Folder + "/room.usda";

        const string Room = @"#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = ""Z""
)
def Xform ""Room"" (
    prepend apiSchemas = [""SemanticsLabelsAPI:class""]
)
{
    token[] semantics:labels:class = [""room""]
    def Mesh ""Floor"" (
        prepend apiSchemas = [""PhysicsCollisionAPI"", ""PhysicsMeshCollisionAPI"", ""MaterialBindingAPI""]
    )
    {
        point3f[] points = [(0, 0, 0), (400, 0, 0), (400, 300, 0), (0, 300, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        uniform token subdivisionScheme = ""none""
        rel material:binding = </Look>
    }
    def Xform ""Marker""
    {
        double3 xformOp:translate = (100, 200, 50)
        uniform token[] xformOpOrder = [""xformOp:translate""]
    }
    def RectLight ""Panel""
    {
        float inputs:intensity = 100
        float inputs:width = 200
        float inputs:height = 50
        double3 xformOp:translate = (200, 150, 250)
        uniform token[] xformOpOrder = [""xformOp:translate""]
    }
    def Sphere ""First"" { double radius = 20 }
    def Sphere ""Second"" { double radius = 20 }
}
def Material ""Look""
{
    token outputs:surface.connect = </Look/Surface.outputs:surface>
    def Shader ""Surface""
    {
        uniform token info:id = ""UsdPreviewSurface""
        color3f inputs:diffuseColor = (0.5, 0.25, 0.1)
        float inputs:roughness = 0.75
        token outputs:surface
    }
}
";

        GameObject prefab;

        [SetUp]
        public void ImportRoom()
        {
            Directory.CreateDirectory(Folder);
            File.WriteAllText(Stage, Room);
            AssetDatabase.ImportAsset(Stage);
            prefab = AssetDatabase.LoadAssetAtPath<GameObject>(Stage);
        }

        [TearDown]
        public void RemoveRoom()
        {
            AssetDatabase.DeleteAsset(Folder);
        }

        [Test]
        public void The_stage_is_a_prefab_named_after_its_file()
        {
            Assert.IsNotNull(prefab);
            Assert.AreEqual("room", prefab.name);
            Assert.AreEqual("Z", prefab.GetComponent<ImportedStage>().UpAxis);
        }

        [Test]
        public void Centimetres_with_z_up_stand_in_metres_with_y_up()
        {
            Vector3 place = prefab.transform.Find("Room/Marker").position;
            Assert.AreEqual(1f, place.x, 1e-5f);
            Assert.AreEqual(0.5f, place.y, 1e-5f);
            Assert.AreEqual(2f, place.z, 1e-5f);
        }

        [Test]
        public void The_floor_looks_up()
        {
            Mesh mesh = prefab.transform.Find("Room/Floor").GetComponent<MeshFilter>().sharedMesh;
            Vector3[] points = mesh.vertices;
            int[] triangles = mesh.triangles;
            for (int i = 0; i < triangles.Length; i += 3)
            {
                Vector3 a = points[triangles[i]], b = points[triangles[i + 1]], c = points[triangles[i + 2]];
                Assert.Greater(Vector3.Cross(b - a, c - a).y, 0);
                Assert.AreEqual(1f, mesh.normals[triangles[i]].y, 1e-5f);
            }
            Assert.AreEqual(4f, mesh.bounds.size.x, 1e-5f);
            Assert.AreEqual(3f, mesh.bounds.size.z, 1e-5f);
        }

        [Test]
        public void Equal_shapes_share_a_mesh()
        {
            Mesh first = prefab.transform.Find("Room/First").GetComponent<MeshFilter>().sharedMesh;
            Assert.AreSame(first, prefab.transform.Find("Room/Second").GetComponent<MeshFilter>().sharedMesh);
        }

        [Test]
        public void The_panel_shines_down()
        {
            Transform panel = prefab.transform.Find("Room/Panel");
            Assert.AreEqual(-1f, panel.forward.y, 1e-5f);
            Assert.AreEqual(100f, panel.GetComponent<UsdLight>().luminance, 1e-3f);
            Assert.AreEqual(100f, panel.GetComponent<UsdLight>().candela, 1e-3f);
            Assert.Greater(panel.GetComponent<Light>().intensity, 0);
        }

        [Test]
        public void What_was_labelled_says_so()
        {
            SemanticLabels labels = prefab.transform.Find("Room").GetComponent<SemanticLabels>();
            Assert.AreEqual("room", labels.ClassLabel);
            Assert.AreEqual(1, labels.InstanceId);
        }

        [Test]
        public void The_floor_collides_and_has_its_material()
        {
            Transform floor = prefab.transform.Find("Room/Floor");
            Assert.AreSame(floor.GetComponent<MeshFilter>().sharedMesh, floor.GetComponent<MeshCollider>().sharedMesh);
            Material material = floor.GetComponent<MeshRenderer>().sharedMaterial;
            Assert.AreEqual("Look", material.name);
            Assert.IsTrue(material.enableInstancing);
            Assert.AreSame(material.shader, Shader.Find(LitShader.Of(PipelineKind.Automatic).Name));
        }

        [Test]
        public void A_stage_is_copied_with_what_belongs_to_it()
        {
            string source = Path.Combine(Path.GetTempPath(), "garage_" + System.Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(source + "/hall_assets/textures");
            File.WriteAllText(source + "/hall.usda", Room);
            File.WriteAllText(source + "/hall_labels.json", "{}");
            File.WriteAllText(source + "/hall_assets/textures/wall.txt", "a wall");
            Assert.AreEqual(Folder + "/hall.usda", GarageMenu.CopyStage(source + "/hall.usda", Folder));
            Assert.AreEqual(Room, File.ReadAllText(Folder + "/hall.usda"));
            Assert.AreEqual("{}", File.ReadAllText(Folder + "/hall_labels.json"));
            Assert.AreEqual("a wall", File.ReadAllText(Folder + "/hall_assets/textures/wall.txt"));
            bool isRefused = false;
            try
            {
                GarageMenu.CopyStage(source + "/hall.usda", Folder);
            }
            catch (IOException)
            {
                isRefused = true;
            }
            Assert.IsTrue(isRefused);
            Directory.Delete(source, true);
        }

        [Test]
        public void A_stage_may_refer_to_other_folders_of_the_project()
        {
            Directory.CreateDirectory(Folder + "/Shots/First");
            string shot = Folder + "/Shots/First/shot.usda";
            File.WriteAllText(shot, "#usda 1.0\n(\n metersPerUnit = 1\n)\n"
                + "def \"Here\" ( references = @../../room.usda@</Room> ) {}\n");
            AssetDatabase.ImportAsset(shot);
            GameObject made = AssetDatabase.LoadAssetAtPath<GameObject>(shot);
            Assert.IsNotNull(made.transform.Find("Here/Marker"));
        }

        [Test]
        public void Reference_materials_cover_every_set_of_keywords_once()
        {
            var seen = new System.Collections.Generic.HashSet<string>();
            foreach (Material material in ReferenceMaterials.Make(PipelineKind.Automatic))
            {
                string[] keywords = material.shaderKeywords;
                System.Array.Sort(keywords, System.StringComparer.Ordinal);
                Assert.IsTrue(seen.Add(string.Join(" ", keywords)), material.name);
            }
            Assert.Greater(seen.Count, 10);
        }
    }
}
