using System.IO;
using UnityEditor;
using UnityEngine;

namespace Garage.Unity.Editor
{
    /// <summary>Tools > Garage.</summary>
    public static class GarageMenu
    {
        const string ReferenceFolder = "Assets/Resources/GarageMaterials";

        /// <summary>Copies a stage into the project's Assets, which imports it.</summary>
        [MenuItem("Tools/Garage/Import Stage...")]
        public static void ImportStage()
        {
            string source = EditorUtility.OpenFilePanel("Import a stage", "", "usdz,usda,usdc");
            if (string.IsNullOrEmpty(source)) { return; }
            try
            {
                string target = CopyStage(source, "Assets");
                AssetDatabase.Refresh();
                Selection.activeObject = AssetDatabase.LoadAssetAtPath<GameObject>(target);
            }
            catch (IOException failure)
            {
                EditorUtility.DisplayDialog("Import a stage", failure.Message, "OK");
            }
        }

        /// <summary>
        /// Copies a stage with its folder of assets and its table of labels into a folder; gives the path of the stage.
        /// Throws IOException, also where the stage is there already.
        /// </summary>
        public static string CopyStage(string source, string folder)
        {
            string target = folder + "/" + Path.GetFileName(source), name = Path.GetFileNameWithoutExtension(source);
            string beside = Path.GetDirectoryName(source), labels = name + "_labels.json", assets = name + "_assets";
            File.Copy(source, target);
            if (File.Exists(Path.Combine(beside, labels)))
            {
                File.Copy(Path.Combine(beside, labels), folder + "/" + labels, true);
            }
            if (Directory.Exists(Path.Combine(beside, assets)))
            {
                CopyFolder(Path.Combine(beside, assets), folder + "/" + assets);
            }
            return target;
        }

        static void CopyFolder(string source, string target)
        {
            Directory.CreateDirectory(target);
            foreach (string file in Directory.GetFiles(source))
            {
                File.Copy(file, Path.Combine(target, Path.GetFileName(file)), true);
            }
            foreach (string folder in Directory.GetDirectories(source))
            {
                CopyFolder(folder, Path.Combine(target, Path.GetFileName(folder)));
            }
        }

        /// <summary>Puts the selected stage into the scene.</summary>
        [MenuItem("Tools/Garage/Place Selected Stage in Scene")]
        public static void PlaceStage()
        {
            var prefab = Selection.activeObject as GameObject;
            var placed = PrefabUtility.InstantiatePrefab(prefab) as GameObject;
            Undo.RegisterCreatedObjectUndo(placed, "Place stage");
            Selection.activeObject = placed;
        }

        [MenuItem("Tools/Garage/Place Selected Stage in Scene", true)]
        static bool CanPlaceStage()
        {
            var prefab = Selection.activeObject as GameObject;
            return prefab != null && prefab.GetComponent<ImportedStage>() != null;
        }

        /// <summary>Makes materials of every kind that stages need, so that a player has the shader with all their
        /// variants.</summary>
        [MenuItem("Tools/Garage/Make Reference Materials")]
        public static void MakeReferenceMaterials()
        {
            Directory.CreateDirectory(ReferenceFolder);
            foreach (Material material in ReferenceMaterials.Make(LitShader.InUse()))
            {
                AssetDatabase.CreateAsset(material, ReferenceFolder + "/" + material.name + ".mat");
            }
            AssetDatabase.SaveAssets();
        }
    }
}
