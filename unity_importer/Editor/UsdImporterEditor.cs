using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Garage.Unity.Editor
{
    /// <summary>Settings of the import, and what it left out.</summary>
    [CustomEditor(typeof(UsdImporter))]
    [CanEditMultipleObjects]
    public sealed class UsdImporterEditor : ScriptedImporterEditor
    {
        static readonly string[] Groups =
        {
            "Stage", "scale", "cameras", "", "Light", "lightMode", "exposureStops", "nitsPerUnit", "lightShadows",
            "lightmapCoordinates", "", "Materials", "pipeline",
            "gpuInstancing", "compressTextures", "", "Physics and flags", "colliders", "staticFlags", "movableLabels",
        };

        /// <summary>Draws the settings in groups; each group begins with its title after an empty name.</summary>
        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            SerializedProperty settings = serializedObject.FindProperty("settings");
            bool isTitle = true;
            foreach (string name in Groups)
            {
                if (name.Length == 0) { EditorGUILayout.Space(); }
                else if (isTitle) { EditorGUILayout.LabelField(name, EditorStyles.boldLabel); }
                else { EditorGUILayout.PropertyField(settings.FindPropertyRelative(name), true); }
                isTitle = name.Length == 0;
            }
            serializedObject.ApplyModifiedProperties();
            ApplyRevertGUI();
            var prefab = assetTarget as GameObject;
            ImportedStage stage = prefab == null ? null : prefab.GetComponent<ImportedStage>();
            for (int i = 0; stage != null && i < stage.LeftOutCount; i++)
            {
                EditorGUILayout.HelpBox(stage.LeftOut(i).ToString(), MessageType.Info);
            }
        }
    }
}
