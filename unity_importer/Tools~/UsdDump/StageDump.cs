using System.Collections.Generic;

namespace Garage.Usd.Dump
{
    /// <summary>The composed prims as JSON.</summary>
    static class StageDump
    {
        public static string Of(UsdStage stage)
        {
            var json = new JsonText();
            json.Open('{');
            json.Key("metersPerUnit");
            json.Number(stage.MetersPerUnit);
            json.Key("isZUp");
            json.Bool(stage.IsZUp);
            json.Key("prims");
            json.Open('{');
            foreach (UsdPrim child in stage.Root.Children) { Prim(json, child); }
            for (int i = 0; i < stage.Prototypes.Count; i++)
            {
                foreach (UsdPrim child in stage.Prototypes[i].Children) { Prim(json, child); }
            }
            json.Close('}');
            json.Key("warnings");
            json.Open('[');
            foreach (string warning in stage.Warnings) { json.String(warning); }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }

        static void Prim(JsonText json, UsdPrim prim)
        {
            json.Key(prim.Path);
            json.Open('{');
            json.Key("specifier");
            json.String(prim.Specifier.ToString());
            json.Key("type");
            json.String(prim.TypeName);
            json.Key("apis");
            json.Open('[');
            foreach (string api in prim.ApiSchemas) { json.String(api); }
            json.Close(']');
            json.Key("children");
            json.Open('[');
            foreach (UsdPrim child in prim.Children) { json.String(child.Name); }
            json.Close(']');
            if (prim.IsInstance)
            {
                json.Key("prototype");
                json.String(prim.Prototype.Path);
            }
            IDictionary<string, string> selections = prim.VariantSelections;
            if (selections.Count > 0)
            {
                json.Key("variants");
                json.Open('{');
                foreach (KeyValuePair<string, string> one in selections)
                {
                    json.Key(one.Key);
                    json.String(one.Value);
                }
                json.Close('}');
            }
            foreach (string field in new[] { "kind", "customData", "assetInfo" })
            {
                object value = prim.Metadata(field);
                if (value == null) { continue; }
                json.Key(field);
                json.Anything(value);
            }
            json.Key("properties");
            json.Open('{');
            foreach (string name in prim.PropertyNames) { Property(json, prim.Property(name)); }
            json.Close('}');
            json.Close('}');
            foreach (UsdPrim child in prim.Children) { Prim(json, child); }
        }

        static void Property(JsonText json, UsdProperty property)
        {
            json.Key(property.Name);
            json.Open('{');
            json.Key("type");
            json.String(property.TypeName);
            UsdValue value = property.Value;
            if (value != null)
            {
                json.Key("value");
                json.Value(value);
            }
            TimeSamples samples = property.Samples;
            if (samples != null)
            {
                json.Key("times");
                json.Open('[');
                foreach (double time in samples.Times) { json.Number(time); }
                json.Close(']');
            }
            if (property.Targets.Count > 0)
            {
                json.Key("targets");
                json.Open('[');
                foreach (string target in property.Targets) { json.String(target); }
                json.Close(']');
            }
            string interpolation = property.MetadataText("interpolation");
            if (interpolation != null)
            {
                json.Key("interpolation");
                json.String(interpolation);
            }
            json.Close('}');
        }
    }
}
