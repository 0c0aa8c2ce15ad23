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
            string target = "Assets/" + Path.GetFileName(source);
            if (File.Exists(target))
            {
                EditorUtility.DisplayDialog("Import a stage", target + " exists already.", "OK");
                return;
            }
            File.Copy(source, target);
            string assets = Path.Combine(Path.GetDirectoryName(source), Path.GetFileNameWithoutExtension(source) + "_assets");
            if (Directory.Exists(assets)) { CopyFolder(assets, "Assets/" + Path.GetFileName(assets)); }
            AssetDatabase.Refresh();
            Selection.activeObject = AssetDatabase.LoadAssetAtPath<GameObject>(target);
        }

        static void CopyFolder(string source, string target)
        {
            Directory.CreateDirectory(target);
            foreach (string file in Directory.GetFiles(source)) { File.Copy(file, Path.Combine(target, Path.GetFileName(file)), true); }
            foreach (string folder in Directory.GetDirectories(source)) { CopyFolder(folder, Path.Combine(target, Path.GetFileName(folder))); }
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

        /// <summary>Makes materials of every kind that stages need, so that a player has the shader with all their variants.</summary>
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
