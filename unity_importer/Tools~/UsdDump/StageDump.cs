using System.Collections.Generic;

namespace Garage.Usd.Dump
{
    /// <summary>The composed prims as JSON, each with its place in the world and the materials that it shows.</summary>
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
            var none = new MaterialBinding(null, false);
            foreach (UsdPrim child in stage.Root.Children) { Prim(json, child, Matrix4.Identity(), none, none); }
            for (int i = 0; i < stage.Prototypes.Count; i++)
            {
                foreach (UsdPrim child in stage.Prototypes[i].Children)
                {
                    Prim(json, child, Matrix4.Identity(), none, none);
                }
            }
            json.Close('}');
            json.Key("warnings");
            json.Open('[');
            foreach (string warning in stage.Warnings) { json.String(warning); }
            json.Close(']');
            json.Close('}');
            return json.ToString();
        }

        // transform and bindings are those of the parent, within a prototype those of the prototype alone
        static void Prim(JsonText json, UsdPrim prim, double[] world, MaterialBinding material, MaterialBinding physics)
        {
            bool resets;
            double[] local = Xform.Local(prim, out resets);
            world = resets ? local : Matrix4.Multiply(local, world);
            material = MaterialBinding.Of(prim, "preview").Under(material);
            physics = MaterialBinding.Of(prim, "physics").Under(physics);
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
            if (prim.Property("xformOpOrder") != null)
            {
                json.Key("world");
                json.Open('[');
                foreach (double number in world) { json.Number(number); }
                json.Close(']');
            }
            Binding(json, "material", material.Material(prim.Stage));
            Binding(json, "physicsMaterial", physics.Material(prim.Stage));
            json.Key("properties");
            json.Open('{');
            foreach (string name in prim.PropertyNames) { Property(json, prim.Property(name)); }
            json.Close('}');
            json.Close('}');
            foreach (UsdPrim child in prim.Children) { Prim(json, child, world, material, physics); }
        }

        static void Binding(JsonText json, string key, UsdPrim material)
        {
            if (material == null) { return; }
            json.Key(key);
            json.String(material.Path);
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
