using System;
using System.Collections.Generic;
using System.Text;

namespace Garage.Usd
{
    /// <summary>Reads binary layers (.usdc) of the versions 0.4 to 0.x.</summary>
    sealed class CrateReader
    {
        enum Field
        {
            Other, Specifier, TypeName, Active, Instanceable, References, Payload, Inherits, Specializes,
            VariantSetNames, VariantSelection, ApiSchemas, PrimChildren, PrimOrder, PropertyOrder, Default, Samples,
            Custom, Variability, Targets, SubLayers, SubLayerOffsets, Relocates, Spline, Ignored,
        }

        static readonly Dictionary<string, Field> Fields = new Dictionary<string, Field>
        {
            { "specifier", Field.Specifier }, { "typeName", Field.TypeName }, { "active", Field.Active },
            { "instanceable", Field.Instanceable }, { "references", Field.References }, { "payload", Field.Payload },
            { "inheritPaths", Field.Inherits }, { "specializes", Field.Specializes },
            { "variantSetNames", Field.VariantSetNames }, { "variantSelection", Field.VariantSelection },
            { "apiSchemas", Field.ApiSchemas }, { "primChildren", Field.PrimChildren },
            { "primOrder", Field.PrimOrder },
            { "propertyOrder", Field.PropertyOrder }, { "default", Field.Default }, { "timeSamples", Field.Samples },
            { "custom", Field.Custom }, { "variability", Field.Variability }, { "targetPaths", Field.Targets },
            { "connectionPaths", Field.Targets }, { "subLayers", Field.SubLayers },
            { "subLayerOffsets", Field.SubLayerOffsets }, { "layerRelocates", Field.Relocates },
            { "relocates", Field.Ignored }, { "properties", Field.Ignored }, { "variantSetChildren", Field.Ignored },
            { "variantChildren", Field.Ignored }, { "targetChildren", Field.Ignored },
            { "connectionChildren", Field.Ignored }, { "spline", Field.Spline },
        };

        readonly CrateBytes bytes;
        readonly string file;
        readonly Layer layer;
        readonly Dictionary<string, KeyValuePair<long, long>> sections
            = new Dictionary<string, KeyValuePair<long, long>>();
        string[] tokens;
        int[] strings;
        Field[] fieldKinds;
        string[] fieldNames;
        ulong[] fieldReps;
        int[] fieldSets;
        object[] fieldValues;
        bool[] fieldIsRead;
        readonly DeclaredTypes declared;
        CratePaths paths;
        CrateValues values;

        CrateReader(byte[] data, string identifier)
        {
            bytes = new CrateBytes(data, identifier);
            file = identifier;
            layer = new Layer(identifier);
            declared = new DeclaredTypes(bytes, layer);
        }

        public static bool Knows(byte[] data)
        {
            return data.Length >= 8 && Encoding.ASCII.GetString(data, 0, 8) == "PXR-USDC";
        }

        /// <summary>The layer in these bytes. Throws UsdFormatException.</summary>
        public static Layer Read(byte[] data, string identifier)
        {
            return new CrateReader(data, identifier).ReadLayer();
        }

        UsdFormatException Error(string section, string reason)
        {
            return new UsdFormatException(file, section, reason);
        }

        Layer ReadLayer()
        {
            int major = bytes.Byte(8), version = bytes.Byte(9);
            if (major != 0 || version < 4)
            {
                throw new UsdFormatException(file, "byte 8",
                    "version " + major + "." + version + " of the format is not supported");
            }
            ReadSections();
            ReadTokens();
            ReadStrings();
            ReadFields();
            paths = new CratePaths(bytes, file, Section("PATHS"), tokens);
            values = new CrateValues(bytes, version, tokens, strings, paths.Text, layer);
            ReadSpecs();
            return layer;
        }

        void ReadSections()
        {
            long place = bytes.Long(16);
            int count = bytes.Count(place, 32);
            if (count > 64) { throw bytes.Error(place, "a table of contents of " + count + " sections"); }
            place += 8;
            for (int i = 0; i < count; i++, place += 32)
            {
                var name = new StringBuilder();
                for (int k = 0; k < 16 && bytes.Byte(place + k) != 0; k++) { name.Append((char)bytes.Byte(place + k)); }
                long start = bytes.Long(place + 16), size = bytes.Long(place + 24);
                sections[name.ToString()] = new KeyValuePair<long, long>(start, size);
            }
        }

        long Section(string name)
        {
            KeyValuePair<long, long> section;
            if (!sections.TryGetValue(name, out section)) { throw Error(name, "the section is missing"); }
            if (section.Key < 0 || section.Value < 0 || section.Key > bytes.Length - section.Value)
            {
                throw Error(name, "the section lies beyond the end of the file");
            }
            return section.Key;
        }

        int CountOf(string section, long place, long most)
        {
            long count = bytes.Long(place);
            if (count < 0 || count > most)
            {
                throw Error(section, "a count of " + count + " is more than the file holds");
            }
            return (int)count;
        }

        void ReadTokens()
        {
            long place = Section("TOKENS");
            long size = bytes.Long(place + 8), packed = bytes.Long(place + 16);
            byte[] text = bytes.Unpack(place + 24, packed, size);
            int count = CountOf("TOKENS", place, size);
            bytes.Charge(place, 60L * count + 2 * size);
            tokens = new string[count];
            int start = 0;
            for (int i = 0; i < count; i++)
            {
                int end = start;
                while (end < size && text[end] != 0) { end++; }
                if (start >= size) { throw Error("TOKENS", "there are fewer tokens than " + count); }
                tokens[i] = Encoding.UTF8.GetString(text, start, end - start);
                start = end + 1;
            }
        }

        void ReadStrings()
        {
            long place = Section("STRINGS");
            strings = new int[bytes.Count(place, 4)];
            bytes.Copy(place + 8, strings, 4);
        }

        void ReadFields()
        {
            long place = Section("FIELDS");
            int count = CountOf("FIELDS", place, 1024L * bytes.Length);
            place += 8;
            int[] names = bytes.PackedInts(ref place, count);
            byte[] reps = bytes.Unpack(place + 8, bytes.Long(place), 8L * count);
            bytes.Charge(place, 40L * count);
            fieldReps = new ulong[count];
            Buffer.BlockCopy(reps, 0, fieldReps, 0, 8 * count);
            fieldNames = new string[count];
            fieldKinds = new Field[count];
            fieldValues = new object[count];
            fieldIsRead = new bool[count];
            for (int i = 0; i < count; i++)
            {
                if ((uint)names[i] >= (uint)tokens.Length) { throw Error("FIELDS", "there is no token " + names[i]); }
                fieldNames[i] = tokens[names[i]];
                Field kind;
                fieldKinds[i] = Fields.TryGetValue(fieldNames[i], out kind) ? kind : Field.Other;
            }
            place = Section("FIELDSETS");
            count = CountOf("FIELDSETS", place, 1024L * bytes.Length);
            place += 8;
            fieldSets = bytes.PackedInts(ref place, count);
        }

        // ---- specs

        void ReadSpecs()
        {
            long place = Section("SPECS");
            int count = CountOf("SPECS", place, paths.Count);
            place += 8;
            int[] ofPath = bytes.PackedInts(ref place, count);
            int[] sets = bytes.PackedInts(ref place, count);
            int[] types = bytes.PackedInts(ref place, count);
            bytes.Charge(place, 16L * paths.Count);
            var specs = new int[paths.Count];
            for (int i = 0; i < count; i++)
            {
                if ((uint)ofPath[i] >= (uint)specs.Length || specs[ofPath[i]] != 0)
                {
                    throw Error("SPECS", "a path is missing or has two specs");
                }
                specs[ofPath[i]] = i + 1;
            }
            CountChildren(specs, types);
            propertyOfSet = new PropertySpec[fieldSets.Length];
            var prims = new PrimSpec[paths.Count];
            foreach (int path in paths.Order)
            {
                int spec = specs[path] - 1;
                if (spec < 0) { continue; }
                PrimSpec parent = paths.ParentOf(path) < 0 ? null : prims[paths.ParentOf(path)];
                bytes.Charge(place, 120);
                switch (types[spec])
                {
                    case 7:
                        if (paths.ParentOf(path) != -1) { throw Error("SPECS", "a root that is no root"); }
                        prims[path] = layer.Root;
                        Reserve(layer.Root, path);
                        ReadPrimFields(layer.Root, sets[spec]);
                        break;
                    case 6: case 10:
                        if (parent == null) { throw Error("SPECS", "<" + paths.Text(path) + "> has no parent"); }
                        prims[path] = MakePrim(parent, path, types[spec] == 10);
                        Reserve(prims[path], path);
                        ReadPrimFields(prims[path], sets[spec]);
                        break;
                    case 1: case 8:
                        if (parent == null) { throw Error("SPECS", "<" + paths.Text(path) + "> has no parent"); }
                        ReadProperty(parent, paths.Element(path), types[spec] == 8, sets[spec]);
                        break;
                }
            }
            if (layerOffsets != null)
            {
                for (int i = 0; i < layer.SubLayers.Count && i < layerOffsets.Length; i++)
                {
                    layer.SubLayers[i] = new SubLayer(layer.SubLayers[i].Asset, layerOffsets[i]);
                }
            }
            foreach (KeyValuePair<PrimSpec, string[]> order in childOrders) { order.Key.Children.Order(order.Value); }
        }

        // by the number of a path: how many prims and properties are below it
        int[] childCounts, propertyCounts;

        void CountChildren(int[] specs, int[] types)
        {
            childCounts = new int[specs.Length];
            propertyCounts = new int[specs.Length];
            for (int path = 0; path < specs.Length; path++)
            {
                if (specs[path] == 0 || paths.ParentOf(path) < 0) { continue; }
                if (paths.IsProperty(path)) { propertyCounts[paths.ParentOf(path)]++; }
                else if (types[specs[path] - 1] == 6) { childCounts[paths.ParentOf(path)]++; }
            }
        }

        void Reserve(PrimSpec prim, int path)
        {
            prim.Children.Reserve(childCounts[path]);
            prim.Properties.Reserve(propertyCounts[path]);
        }

        LayerOffset[] layerOffsets;
        readonly List<KeyValuePair<PrimSpec, string[]>> childOrders = new List<KeyValuePair<PrimSpec, string[]>>();

        PrimSpec MakePrim(PrimSpec parent, int path, bool isVariant)
        {
            string element = paths.Element(path);
            layer.SpecCount++;
            if (!isVariant)
            {
                var prim = new PrimSpec(element);
                if (element.Length == 0 || !parent.Children.Add(prim))
                {
                    throw Error("SPECS", "a second prim <" + paths.Text(path) + ">");
                }
                return prim;
            }
            int equals = element.IndexOf('=');
            if (element.Length < 3 || element[0] != '{' || equals < 0 || element[element.Length - 1] != '}')
            {
                throw Error("SPECS", "'" + element + "' is no variant");
            }
            string name = element.Substring(1, equals - 1);
            VariantSetSpec set = parent.FindVariantSet(name);
            if (set == null)
            {
                set = new VariantSetSpec(name);
                parent.VariantSets = parent.VariantSets ?? new List<VariantSetSpec>();
                parent.VariantSets.Add(set);
            }
            var variant = new PrimSpec(element.Substring(equals + 1, element.Length - equals - 2));
            set.Variants.Add(variant);
            return variant;
        }

        // the last property that was made of a set of fields: others of the same name share it
        PropertySpec[] propertyOfSet;

        object FieldValue(int field)
        {
            if (!fieldIsRead[field])
            {
                fieldValues[field] = values.Read(fieldReps[field], 0, 0);
                fieldIsRead[field] = true;
            }
            return fieldValues[field];
        }

        int FirstField(int set)
        {
            if ((uint)set >= (uint)fieldSets.Length) { throw Error("SPECS", "there is no set of fields " + set); }
            return set;
        }

        // the field at a place of the sets, or -1 at the end of its set
        int FieldAt(int place)
        {
            if (place >= fieldSets.Length || fieldSets[place] == -1) { return -1; }
            if ((uint)fieldSets[place] >= (uint)fieldReps.Length)
            {
                throw Error("FIELDSETS", "there is no field " + fieldSets[place]);
            }
            bytes.Charge(0, 8);
            return fieldSets[place];
        }

        T ValueOf<T>(int field) where T : class
        {
            object value = FieldValue(field);
            var wanted = value as T;
            if (wanted == null && value != null && !ReferenceEquals(value, UsdValue.Blocked))
            {
                throw Error("FIELDS", "'" + fieldNames[field] + "' has a value of the wrong type");
            }
            return wanted;
        }

        double NumberOf(int field)
        {
            var value = ValueOf<UsdValue>(field);
            return value == null ? 0 : value.Number(0);
        }

        string TextOf(int field)
        {
            var value = ValueOf<UsdValue>(field);
            return value == null ? "" : value.Text ?? "";
        }

        List<string> TextsOf(int field)
        {
            var value = ValueOf<UsdValue>(field);
            return value == null ? null : new List<string>(value.Texts);
        }

        ListOp<string> NamesOf(int field)
        {
            // a bare list stands for a whole one
            var value = FieldValue(field) as UsdValue;
            return value != null && value.Data is string[] ? ListOp<string>.Whole(new List<string>(value.Texts))
                : ValueOf<ListOp<string>>(field);
        }

        void ReadPrimFields(PrimSpec prim, int set)
        {
            int field;
            for (int place = FirstField(set); (field = FieldAt(place)) >= 0; place++)
            {
                switch (fieldKinds[field])
                {
                    case Field.Specifier: prim.Specifier = (Specifier)((int)NumberOf(field) % 3 & 3); break;
                    case Field.TypeName: prim.TypeName = TextOf(field); break;
                    case Field.Active: prim.IsActive = NumberOf(field) != 0; break;
                    case Field.Instanceable: prim.IsInstanceable = NumberOf(field) != 0; break;
                    case Field.References: prim.References = ValueOf<ListOp<ReferenceArc>>(field); break;
                    case Field.Payload: prim.Payloads = ValueOf<ListOp<ReferenceArc>>(field); break;
                    case Field.Inherits: prim.Inherits = NamesOf(field); break;
                    case Field.Specializes: prim.Specializes = NamesOf(field); break;
                    case Field.VariantSetNames: prim.VariantSetNames = NamesOf(field); break;
                    case Field.VariantSelection:
                        prim.VariantSelections = ValueOf<Dictionary<string, string>>(field);
                        break;
                    case Field.ApiSchemas: prim.ApiSchemas = NamesOf(field); break;
                    case Field.PrimChildren:
                        var names = ValueOf<UsdValue>(field);
                        if (names != null) { childOrders.Add(new KeyValuePair<PrimSpec, string[]>(prim, names.Texts)); }
                        break;
                    case Field.PrimOrder: prim.ChildOrder = TextsOf(field); break;
                    case Field.PropertyOrder: prim.PropertyOrder = TextsOf(field); break;
                    case Field.SubLayers:
                        foreach (string asset in TextsOf(field) ?? new List<string>())
                        {
                            if (ReferenceEquals(prim, layer.Root))
                            {
                                layer.SubLayers.Add(new SubLayer(asset, LayerOffset.Identity));
                            }
                        }
                        break;
                    case Field.SubLayerOffsets: layerOffsets = ValueOf<LayerOffset[]>(field); break;
                    case Field.Relocates:
                        layer.Relocates.AddRange(ValueOf<List<KeyValuePair<string, string>>>(field)
                            ?? new List<KeyValuePair<string, string>>());
                        break;
                    case Field.Other: prim.AddField(fieldNames[field], FieldValue(field)); break;
                }
            }
        }

        void ReadProperty(PrimSpec prim, string name, bool isRelationship, int set)
        {
            PropertySpec property = propertyOfSet[FirstField(set)];
            bool isKnown = property != null && property.Name == name && property.IsRelationship == isRelationship;
            if (!isKnown) { property = new PropertySpec(name) { IsRelationship = isRelationship }; }
            if (!prim.Properties.Add(property)) { throw Error("SPECS", "a second property '" + name + "'"); }
            if (isKnown) { return; }
            propertyOfSet[set] = property;
            int field;
            for (int place = FirstField(set); (field = FieldAt(place)) >= 0; place++)
            {
                switch (fieldKinds[field])
                {
                    case Field.TypeName: property.TypeName = TextOf(field); break;
                    case Field.Default:
                        property.Default = FieldValue(field) as UsdValue;
                        break;
                    case Field.Samples: property.Samples = ValueOf<TimeSamples>(field); break;
                    case Field.Custom: property.IsCustom = NumberOf(field) != 0; break;
                    case Field.Variability: property.IsUniform = NumberOf(field) == 1 && !isRelationship; break;
                    case Field.Targets: property.Targets = NamesOf(field); break;
                    case Field.Spline: layer.SkipSpline(name); break;
                    case Field.Other: property.AddField(fieldNames[field], FieldValue(field)); break;
                }
            }
            declared.Apply(property);
        }
    }
}
