using System;
using System.Collections;
using System.IO;
using System.Threading;
using System.Threading.Tasks;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Garage.Unity.Tests
{
    /// <summary>What a player loads while it runs.</summary>
    public sealed class StageLoaderTests
    {
        const string Hall = @"#usda 1.0
(
    metersPerUnit = 1
    upAxis = ""Y""
)
def Xform ""Hall"" (
    prepend apiSchemas = [""SemanticsLabelsAPI:class""]
)
{
    token[] semantics:labels:class = [""floor""]
    def Mesh ""Floor"" (
        prepend apiSchemas = [""PhysicsCollisionAPI"", ""PhysicsMeshCollisionAPI""]
    )
    {
        point3f[] points = [(0, 0, 0), (8, 0, 0), (8, 0, -6), (0, 0, -6)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        uniform token subdivisionScheme = ""none""
    }
    def Cube ""Post"" (
        prepend apiSchemas = [""PhysicsCollisionAPI""]
    )
    {
        double size = 1
        double3 xformOp:translate = (2, 0.5, -1)
        uniform token[] xformOpOrder = [""xformOp:translate""]
    }
}
";

        string path;

        [SetUp]
        public void WriteHall()
        {
            path = Path.Combine(Path.GetTempPath(), "garage_" + Guid.NewGuid().ToString("N") + ".usda");
            File.WriteAllText(path, Hall);
        }

        [TearDown]
        public void RemoveHall()
        {
            File.Delete(path);
        }

        static IEnumerator Until(Task task)
        {
            while (!task.IsCompleted) { yield return null; }
        }

        [UnityTest]
        public IEnumerator Objects_stand_below_the_parent_and_collide()
        {
            var parent = new GameObject("Parent");
            Task<LoadedStage> task = StageLoader.LoadAsync(path, new ImportSettings(), parent.transform, null,
                CancellationToken.None);
            yield return Until(task);
            LoadedStage loaded = task.GetAwaiter().GetResult();
            Assert.AreSame(parent.transform, loaded.Root.transform.parent);
            Physics.SyncTransforms();
            RaycastHit hit;
            Assert.IsTrue(Physics.Raycast(new Vector3(5, 3, 4), new Vector3(0, -1, 0), out hit));
            Assert.AreEqual(3f, hit.distance, 1e-3f);
            Assert.AreEqual("Floor", hit.collider.name);
            // the cube stands on the other side of the origin than it would in a mirror
            Assert.IsTrue(Physics.Raycast(new Vector3(2, 3, 1), new Vector3(0, -1, 0), out hit));
            Assert.AreEqual(2f, hit.distance, 1e-3f);
            Assert.IsFalse(Physics.Raycast(new Vector3(5, 3, -4), new Vector3(0, -1, 0), out hit));
            loaded.Dispose();
            yield return null;
            Assert.AreEqual(0, parent.transform.childCount);
            UnityEngine.Object.DestroyImmediate(parent);
        }

        [UnityTest]
        public IEnumerator A_stage_refers_to_files_of_the_root_folder_that_is_named()
        {
            string root = Path.GetDirectoryName(path), folder = path + "_shots";
            Directory.CreateDirectory(folder);
            string shot = Path.Combine(folder, "shot.usda");
            File.WriteAllText(shot, "#usda 1.0\ndef \"Here\" ( references = @../" + Path.GetFileName(path)
                + "@</Hall> ) {}\n");
            foreach (string named in new[] { root, folder })
            {
                Task<LoadedStage> task = StageLoader.LoadAsync(shot, named, new ImportSettings(), null, null,
                    CancellationToken.None);
                yield return Until(task);
                LoadedStage loaded = task.GetAwaiter().GetResult();
                bool isThere = loaded.Root.GetComponentsInChildren<MeshFilter>(true).Length > 0;
                Assert.AreEqual(named == root, isThere);
                loaded.Dispose();
            }
            Directory.Delete(folder, true);
        }

        [UnityTest]
        public IEnumerator A_stage_that_cannot_be_read_fails_with_its_reason()
        {
            File.WriteAllText(path, "#usda 1.0\ndef \"A\" {");
            Task<LoadedStage> task = StageLoader.LoadAsync(path, new ImportSettings(), null, null,
                CancellationToken.None);
            yield return Until(task);
            Assert.IsTrue(task.IsFaulted);
            Assert.IsTrue(task.Exception.GetBaseException() is Garage.Usd.UsdFormatException);
        }

        [UnityTest]
        public IEnumerator A_cancelled_load_leaves_nothing()
        {
            var parent = new GameObject("Parent");
            using (var cancel = new CancellationTokenSource())
            {
                cancel.Cancel();
                Task<LoadedStage> task = StageLoader.LoadAsync(path, new ImportSettings(), parent.transform, null,
                    cancel.Token);
                yield return Until(task);
                Assert.IsTrue(task.IsCanceled);
            }
            Assert.AreEqual(0, parent.transform.childCount);
            UnityEngine.Object.DestroyImmediate(parent);
        }
    }
}
