using System;
using System.Globalization;
using System.IO;
using System.Reflection;
using Garage.Unity.Samples;
using Garage.Usd.Dump;
using UnityEditor;
using UnityEngine;

namespace Garage.Unity.Dump
{
    /// <summary>Plays the scene of the sample.</summary>
    static class SceneDump
    {
        /// <summary>
        /// Starts the scene of a stage that was imported from the current project's folder Assets, with fields that are
        /// given as Type.field=value, and tells where the car is every tenth of a second.
        /// </summary>
        public static string Play(GameObject prefab, string stage, string[] fields)
        {
            AssetDatabase.CreateAsset(prefab, stage.Substring(Directory.GetCurrentDirectory().Length + 1));
            DriveAlongLanes driver = new GameObject("Car").AddComponent<DriveAlongLanes>();
            GarageScene scene = new GameObject("Garage").AddComponent<GarageScene>();
            driver.enabled = false;
            Set(scene, "car", driver);
            for (int i = 1; i < fields.Length; i++)
            {
                string[] pair = fields[i].Split('=');
                string[] name = pair[0].Split('.');
                Set(name[0] == "GarageScene" ? (Component)scene : driver, name[1], pair[1]);
            }
            Call(scene, "Start");
            var json = new JsonText();
            json.Open('{');
            json.Key("garage");
            json.String(scene.Garage == null ? "" : scene.Garage.name + " in " + scene.Garage.transform.parent.name);
            json.Key("drives");
            json.String(driver.enabled ? "yes" : "no");
            json.Key("body");
            json.String(driver.transform.childCount == 1 ? driver.transform.GetChild(0).name : "");
            if (driver.enabled) { Call(driver, "Start"); }
            json.Key("steps");
            json.Open('[');
            for (int i = 0; driver.enabled && i < int.Parse(fields[0]); i++)
            {
                json.Open('{');
                LaneDump.Vector(json, "position", driver.transform.GetChild(0).position);
                LaneDump.Vector(json, "forward", driver.transform.GetChild(0).forward);
                LaneDump.Number(json, "length", driver.Path.Length);
                json.Close('}');
                driver.Drive(0.1f);
            }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }

        static void Set(Component component, string name, object value)
        {
            FieldInfo field = Field(component, name);
            field.SetValue(component, Convert.ChangeType(value, field.FieldType, CultureInfo.InvariantCulture));
        }

        static FieldInfo Field(Component component, string name)
        {
            FieldInfo found = component.GetType().GetField(name, BindingFlags.Instance | BindingFlags.NonPublic);
            if (found == null || !found.IsDefined(typeof(SerializeField), false))
            {
                throw new MissingFieldException(component.GetType().Name, name);
            }
            return found;
        }

        static void Call(Component component, string name)
        {
            component.GetType().GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(component, null);
        }
    }
}
