using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>Reads text layers (.usda).</summary>
    sealed class UsdaReader : UsdaListReader
    {
        readonly LineMemo lines;
        int variantDepth;

        UsdaReader(byte[] bytes, string identifier) : base(bytes, identifier)
        {
            lines = new LineMemo(text, end);
        }

        public static bool Knows(byte[] bytes)
        {
            return bytes.Length >= 6 && bytes[0] == '#' && bytes[1] == 'u' && bytes[2] == 's' && bytes[3] == 'd'
                && bytes[4] == 'a' && bytes[5] == ' ';
        }

        /// <summary>The layer in these bytes. Throws UsdFormatException.</summary>
        public static Layer Read(byte[] bytes, string identifier)
        {
            if (!Knows(bytes))
            {
                throw new UsdFormatException(identifier, "line 1", "does not begin with '#usda 1.0'");
            }
            return new UsdaReader(bytes, identifier).ReadLayer();
        }

        Layer ReadLayer()
        {
            at = 6;
            if (text[at] != '1' || text[at + 1] != '.') { throw Unexpected("version 1.x of the format"); }
            while (text[at] != '\n' && at < end) { at++; }
            if (Take('(')) { ReadPrimMetadata(layer.Root); }
            for (;;)
            {
                SkipSeparators();
                if (at >= end) { break; }
                string word = TryName();
                Specifier specifier;
                if (TrySpecifier(word, out specifier))
                {
                    ReadPrim(layer.Root, specifier);
                }
                else if (word == "reorder" && TryName() == "rootPrims")
                {
                    Expect('=');
                    layer.Root.ChildOrder = NameList();
                }
                else
                {
                    throw Unexpected("a prim");
                }
            }
            return layer;
        }

        static bool TrySpecifier(string word, out Specifier specifier)
        {
            specifier = Specifier.Over;
            switch (word == null ? 0 : word.Length)
            {
                case 3:
                    specifier = Specifier.Def;
                    return word == "def";
                case 4: return word == "over";
                case 5:
                    specifier = Specifier.Class;
                    return word == "class";
                default: return false;
            }
        }

        PrimSpec ReadPrim(PrimSpec parent, Specifier specifier)
        {
            string typeName = AtQuote() ? "" : Name();
            while (Take('.')) { typeName += "." + Name(); }
            string name = QuotedString(false);
            if (name.Length == 0 || name.IndexOf('/') >= 0 || name.IndexOf('.') >= 0)
            {
                throw Error("'" + name + "' is no name of a prim");
            }
            var prim = new PrimSpec(name) { Specifier = specifier, TypeName = typeName };
            if (!parent.Children.Add(prim)) { throw Error("a second prim '" + name + "' below the same parent"); }
            layer.SpecCount++;
            Enter(name);
            if (Take('(')) { ReadPrimMetadata(prim); }
            Expect('{');
            ReadBody(prim);
            Leave();
            return prim;
        }

        void ReadBody(PrimSpec prim)
        {
            for (;;)
            {
                SkipSeparators();
                if (text[at] == '}')
                {
                    at++;
                    return;
                }
                int relativeBefore = RelativePaths;
                LineMemo.Line line;
                object known = lines.Find(at, out line);
                if (known != null && TakeKnown(known, line, prim)) { continue; }
                string word = Name();
                Specifier specifier;
                if (TrySpecifier(word, out specifier))
                {
                    PrimSpec child = ReadPrim(prim, specifier);
                    if (RelativePaths == relativeBefore) { KeepPrim(child, line, known as KnownPrim); }
                }
                else if (word == "variantSet")
                {
                    ReadVariantSet(prim);
                }
                else if (word == "reorder" && AtReorder())
                {
                    string what = Name();
                    Expect('=');
                    if (what == "nameChildren") { prim.ChildOrder = NameList(); }
                    else { prim.PropertyOrder = NameList(); }
                }
                else
                {
                    int before = prim.Properties.Count;
                    ReadProperty(prim, word);
                    bool isOneLine = at == line.Stop && RelativePaths == relativeBefore;
                    if (isOneLine && prim.Properties.Count > before) { lines.Keep(line, prim.Properties[before]); }
                }
            }
        }

        // what was read before of equal text, if the prim does not have it yet: both prims share it
        bool TakeKnown(object known, LineMemo.Line line, PrimSpec prim)
        {
            var property = known as PropertySpec;
            if (property == null) { return TakeKnownPrim(known as KnownPrim, prim); }
            at = line.Stop;
            // what belongs to it may stand on the next line
            if (Next() != '(' && prim.Properties.Add(property)) { return true; }
            at = line.Start;
            return false;
        }

        bool TakeKnownPrim(KnownPrim known, PrimSpec parent)
        {
            if (known == null || !known.IsAt(text, at, end)) { return false; }
            Enter(known.Prim.Name);
            Leave();
            if (!parent.Children.Add(known.Prim)) { return false; }
            layer.SpecCount++;
            at += known.Length;
            return true;
        }

        // the latest of the prims with the same first line
        void KeepPrim(PrimSpec prim, LineMemo.Line line, KnownPrim known)
        {
            int length = at - line.Start;
            if (!KnownPrim.MayBe(prim, length)) { return; }
            if (known == null)
            {
                known = new KnownPrim();
                lines.Keep(line, known);
            }
            known.Set(prim, line.Start, length);
        }

        bool AtReorder()
        {
            int before = at;
            string word = TryName();
            at = before;
            return word == "nameChildren" || word == "properties";
        }

        void ReadVariantSet(PrimSpec prim)
        {
            string name = QuotedString();
            VariantSetSpec set = prim.FindVariantSet(name);
            if (set == null)
            {
                prim.VariantSets = prim.VariantSets ?? new List<VariantSetSpec>();
                set = new VariantSetSpec(name);
                prim.VariantSets.Add(set);
            }
            Expect('=');
            Expect('{');
            if (variantDepth >= DeepestValue)
            {
                throw Error("variants are nested more than " + DeepestValue + " deep");
            }
            variantDepth++;
            while (!Take('}'))
            {
                string selection = QuotedString();
                PrimSpec variant = set.Find(selection);
                if (variant == null)
                {
                    variant = new PrimSpec(selection);
                    set.Variants.Add(variant);
                    layer.SpecCount++;
                }
                if (Take('(')) { ReadPrimMetadata(variant); }
                Expect('{');
                ReadBody(variant);
                SkipSeparators();
            }
            variantDepth--;
        }

        // ---- properties

        void ReadProperty(PrimSpec prim, string word)
        {
            string edit = null;
            bool custom = false, uniform = false;
            if (IsEdit(word))
            {
                edit = word;
                word = Name();
            }
            if (word == "custom")
            {
                custom = true;
                word = Name();
            }
            if (word == "uniform" || word == "varying" || word == "config")
            {
                uniform = word == "uniform";
                word = Name();
            }
            bool isRelationship = word == "rel";
            string typeName = word;
            if (!isRelationship && TakeBrackets()) { typeName = ArrayName(word); }
            string name = Name();
            PropertySpec property = prim.OwnProperty(name);
            if (property == null)
            {
                property = new PropertySpec(name) { IsRelationship = isRelationship };
                property.TypeName = isRelationship ? "" : typeName;
                prim.Properties.Add(property);
            }
            else if (property.IsRelationship != isRelationship)
            {
                throw Error("'" + name + "' is both an attribute and a relationship");
            }
            property.IsCustom |= custom;
            property.IsUniform |= uniform;
            string part = Take('.') ? Name() : "default";
            if (isRelationship || part == "connect")
            {
                if (Take('=')) { property.Targets = Edited(property.Targets, edit, PathList()); }
            }
            else if (part == "default")
            {
                if (Take('=')) { property.Default = ReadValue(typeName); }
            }
            else if (part == "timeSamples")
            {
                Expect('=');
                property.Samples = ReadSamples(typeName);
            }
            else if (part == "spline")
            {
                Expect('=');
                Expect('{');
                SkipRest();
                layer.SkipSpline(name);
            }
            else
            {
                throw Error("'" + part + "' is no part of a property");
            }
            int stop = at;
            if (Next() == '(')
            {
                at++;
                ReadPropertyMetadata(property);
            }
            else
            {
                at = stop;
            }
        }

        static bool IsEdit(string word)
        {
            switch (word.Length)
            {
                case 3: return word == "add";
                case 6: return word == "append" || word == "delete";
                case 7: return word == "prepend" || word == "reorder";
                default: return false;
            }
        }

        void ReadPropertyMetadata(PropertySpec property)
        {
            for (;;)
            {
                SkipSeparators();
                if (Take(')')) { return; }
                if (AtQuote())
                {
                    property.AddField("comment", UsdValue.OfString(UsdType.String, QuotedString()));
                    continue;
                }
                string key = Name();
                if (IsEdit(key)) { key = Name(); }
                Expect('=');
                property.AddField(key == "doc" ? "documentation" : key, ReadAnything(0));
            }
        }

        TimeSamples ReadSamples(string typeName)
        {
            Expect('{');
            var times = new List<double>();
            var samples = new List<UsdValue>();
            while (!Take('}'))
            {
                times.Add(Number());
                Expect(':');
                samples.Add(ReadValue(typeName) ?? UsdValue.Blocked);
                if (!Take(',') && Next() != '}') { throw Unexpected("',' or '}'"); }
            }
            return new TimeSamples(times.ToArray(), samples.ToArray());
        }

        // ---- metadata

        void ReadPrimMetadata(PrimSpec prim)
        {
            for (;;)
            {
                SkipSeparators();
                if (Take(')')) { return; }
                if (AtQuote())
                {
                    prim.AddField("comment", UsdValue.OfString(UsdType.String, QuotedString()));
                    continue;
                }
                var line = new LineMemo.Line();
                int relativeBefore = RelativePaths;
                bool isList = text[at] == 'p' || text[at] == 'r' || text[at] == 'a';
                var known = isList ? lines.Find(at, out line) as SharedField : null;
                if (known != null && known.AddTo(prim))
                {
                    at = line.Stop;
                    continue;
                }
                string edit = null, key = Name();
                if (IsEdit(key))
                {
                    edit = key;
                    key = Name();
                }
                Expect('=');
                bool isFirst = isList && ((key == "references" && prim.References == null)
                    || (key == "inherits" && prim.Inherits == null)
                    || (key == "apiSchemas" && prim.ApiSchemas == null));
                ReadPrimField(prim, edit, key);
                bool isOneLine = at == line.Stop && RelativePaths == relativeBefore;
                if (isFirst && isOneLine) { lines.Keep(line, new SharedField(prim, key)); }
            }
        }

        // what many prims of a layer refer to alike
        sealed class SharedField
        {
            readonly ListOp<ReferenceArc> references;
            readonly ListOp<string> inherits, apiSchemas;

            public SharedField(PrimSpec prim, string key)
            {
                references = key == "references" ? prim.References : null;
                inherits = key == "inherits" ? prim.Inherits : null;
                apiSchemas = key == "apiSchemas" ? prim.ApiSchemas : null;
            }

            public bool AddTo(PrimSpec prim)
            {
                if ((references ?? prim.References) != (prim.References ?? references)) { return false; }
                if ((inherits ?? prim.Inherits) != (prim.Inherits ?? inherits)) { return false; }
                if ((apiSchemas ?? prim.ApiSchemas) != (prim.ApiSchemas ?? apiSchemas)) { return false; }
                prim.References = references ?? prim.References;
                prim.Inherits = inherits ?? prim.Inherits;
                prim.ApiSchemas = apiSchemas ?? prim.ApiSchemas;
                return true;
            }
        }

        void ReadPrimField(PrimSpec prim, string edit, string key)
        {
            // apart, as very many prims have it, and finding it among the others takes as long as reading its line
            if (key == "instanceable")
            {
                prim.IsInstanceable = Truth();
                return;
            }
            switch (key)
            {
                case "references": prim.References = Edited(prim.References, edit, ArcList()); break;
                case "payload": prim.Payloads = Edited(prim.Payloads, edit, ArcList()); break;
                case "inherits": prim.Inherits = Edited(prim.Inherits, edit, PathList()); break;
                case "specializes": prim.Specializes = Edited(prim.Specializes, edit, PathList()); break;
                case "variantSets": prim.VariantSetNames = Edited(prim.VariantSetNames, edit, NameList()); break;
                case "apiSchemas": prim.ApiSchemas = Edited(prim.ApiSchemas, edit, NameList()); break;
                case "active": prim.IsActive = Truth(); break;
                case "variants": ReadVariantSelections(prim); break;
                case "subLayers": ReadSubLayers(prim); break;
                case "relocates": ReadRelocates(prim); break;
                default: prim.AddField(key == "doc" ? "documentation" : key, ReadAnything(0)); break;
            }
        }

        // those of a prim, an older form, mean nothing to a stage
        void ReadRelocates(PrimSpec prim)
        {
            bool isOfLayer = ReferenceEquals(prim, layer.Root);
            Expect('{');
            while (!Take('}'))
            {
                string source = PathText();
                Expect(':');
                string target = PathText();
                if (isOfLayer)
                {
                    layer.Relocates.Add(new KeyValuePair<string, string>(Absolute(source, false),
                        Absolute(target, true)));
                }
                if (!Take(',') && Next() != '}') { throw Unexpected("',' or '}'"); }
            }
        }

        void ReadSubLayers(PrimSpec prim)
        {
            if (!ReferenceEquals(prim, layer.Root)) { throw Error("only a layer has subLayers"); }
            Expect('[');
            while (!Take(']'))
            {
                string asset = AssetPath();
                var offset = LayerOffset.Identity;
                if (Take('(')) { offset = ReadOffset(); }
                layer.SubLayers.Add(new SubLayer(asset, offset));
                if (!Take(',') && Next() != ']') { throw Unexpected("',' or ']'"); }
            }
        }

        void ReadVariantSelections(PrimSpec prim)
        {
            prim.VariantSelections = prim.VariantSelections ?? new Dictionary<string, string>();
            Expect('{');
            for (;;)
            {
                SkipSeparators();
                if (Take('}')) { return; }
                Name();
                string set = AtQuote() ? QuotedString() : Name();
                Expect('=');
                prim.VariantSelections[set] = QuotedString();
                Take(',');
            }
        }
    }
}
