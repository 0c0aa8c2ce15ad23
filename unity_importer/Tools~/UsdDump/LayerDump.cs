using System;
using System.Collections.Generic;

namespace Garage.Usd.Dump
{
    /// <summary>The opinions of one layer as JSON.</summary>
    static class LayerDump
    {
        public static string Of(Layer layer)
        {
            var json = new JsonText();
            json.Open('{');
            json.Key("subLayers");
            json.Open('[');
            foreach (SubLayer sub in layer.SubLayers)
            {
                json.Open('[');
                json.String(sub.Asset);
                json.Number(sub.Offset.Offset);
                json.Number(sub.Offset.Scale);
                json.Close(']');
            }
            json.Close(']');
            json.Key("root");
            Prim(json, layer.Root);
            json.Close('}');
            return json.ToString();
        }

        static void Prim(JsonText json, PrimSpec prim)
        {
            json.Open('{');
            json.Key("name");
            json.String(prim.Name);
            json.Key("specifier");
            json.String(prim.Specifier.ToString());
            json.Key("type");
            json.String(prim.TypeName);
            if (prim.IsActive != null)
            {
                json.Key("active");
                json.Bool(prim.IsActive.Value);
            }
            if (prim.IsInstanceable != null)
            {
                json.Key("instanceable");
                json.Bool(prim.IsInstanceable.Value);
            }
            Arcs(json, "references", prim.References);
            Arcs(json, "payloads", prim.Payloads);
            Names(json, "inherits", prim.Inherits);
            Names(json, "specializes", prim.Specializes);
            Names(json, "variantSetNames", prim.VariantSetNames);
            Names(json, "apiSchemas", prim.ApiSchemas);
            if (prim.VariantSelections != null)
            {
                json.Key("selections");
                json.Open('{');
                foreach (KeyValuePair<string, string> selection in prim.VariantSelections)
                {
                    json.Key(selection.Key);
                    json.String(selection.Value);
                }
                json.Close('}');
            }
            Order(json, "childOrder", prim.ChildOrder);
            Order(json, "propertyOrder", prim.PropertyOrder);
            Metadata(json, prim.Metadata);
            json.Key("properties");
            json.Open('[');
            for (int i = 0; i < prim.Properties.Count; i++) { Property(json, prim.Properties[i]); }
            json.Close(']');
            json.Key("sets");
            json.Open('{');
            foreach (VariantSetSpec set in prim.VariantSets ?? new List<VariantSetSpec>())
            {
                json.Key(set.Name);
                json.Open('[');
                foreach (PrimSpec variant in set.Variants) { Prim(json, variant); }
                json.Close(']');
            }
            json.Close('}');
            json.Key("children");
            json.Open('[');
            for (int i = 0; i < prim.Children.Count; i++) { Prim(json, prim.Children[i]); }
            json.Close(']');
            json.Close('}');
        }

        static void Property(JsonText json, PropertySpec property)
        {
            json.Open('{');
            json.Key("name");
            json.String(property.Name);
            json.Key("relationship");
            json.Bool(property.IsRelationship);
            json.Key("type");
            json.String(property.TypeName);
            json.Key("custom");
            json.Bool(property.IsCustom);
            json.Key("uniform");
            json.Bool(property.IsUniform);
            if (property.Default != null)
            {
                json.Key("default");
                json.Value(property.Default);
            }
            if (property.Samples != null)
            {
                json.Key("samples");
                json.Open('[');
                for (int i = 0; i < property.Samples.Times.Length; i++)
                {
                    json.Open('[');
                    json.Number(property.Samples.Times[i]);
                    json.Value(property.Samples.Values[i]);
                    json.Close(']');
                }
                json.Close(']');
            }
            Names(json, "targets", property.Targets);
            Metadata(json, property.Metadata);
            json.Close('}');
        }

        static void Order(JsonText json, string key, List<string> names)
        {
            if (names == null) { return; }
            json.Key(key);
            json.Open('[');
            foreach (string name in names) { json.String(name); }
            json.Close(']');
        }

        static void Metadata(JsonText json, FieldList fields)
        {
            json.Key("metadata");
            json.Open('{');
            if (fields != null)
            {
                foreach (KeyValuePair<string, object> field in fields.Fields)
                {
                    json.Key(field.Key);
                    json.Anything(field.Value);
                }
            }
            json.Close('}');
        }

        static void Names(JsonText json, string key, ListOp<string> op)
        {
            Op(json, key, op, json.String);
        }

        static void Arcs(JsonText json, string key, ListOp<ReferenceArc> op)
        {
            Op(json, key, op, delegate(ReferenceArc arc)
            {
                json.Open('[');
                json.String(arc.Asset);
                json.String(arc.Path);
                json.Number(arc.Offset.Offset);
                json.Number(arc.Offset.Scale);
                json.Close(']');
            });
        }

        static void Op<T>(JsonText json, string key, ListOp<T> op, Action<T> write)
        {
            if (op == null) { return; }
            json.Key(key);
            json.Open('{');
            if (op.IsExplicit) { Items(json, "explicit", op.Explicit ?? new List<T>(), write); }
            else
            {
                Items(json, "added", op.Added, write);
                Items(json, "prepended", op.Prepended, write);
                Items(json, "appended", op.Appended, write);
                Items(json, "deleted", op.Deleted, write);
                Items(json, "ordered", op.Ordered, write);
            }
            json.Close('}');
        }

        static void Items<T>(JsonText json, string key, List<T> items, Action<T> write)
        {
            if (items == null || (items.Count == 0 && key != "explicit")) { return; }
            json.Key(key);
            json.Open('[');
            foreach (T item in items) { write(item); }
            json.Close(']');
        }
    }
}
