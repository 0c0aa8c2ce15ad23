using System;
using System.Collections.Generic;

namespace Garage.Usd
{
    /// <summary>An attribute or relationship of a prim with the opinions of all layers.</summary>
    public sealed class UsdProperty
    {
        readonly PropertySpec[] specs;
        readonly Opinion[] places;

        /// <summary>The prim that it belongs to.</summary>
        public UsdPrim Prim { get; private set; }

        internal UsdProperty(UsdPrim prim, PropertySpec[] specs, Opinion[] places)
        {
            Prim = prim;
            this.specs = specs;
            this.places = places;
        }

        /// <summary>With namespaces: "primvars:st".</summary>
        public string Name
        {
            get { return specs[0].Name; }
        }

        /// <summary>Otherwise it is an attribute.</summary>
        public bool IsRelationship
        {
            get { return specs[0].IsRelationship; }
        }

        /// <summary>"color3f[]" and the like; empty for a relationship.</summary>
        public string TypeName
        {
            get
            {
                foreach (PropertySpec spec in specs)
                {
                    if (spec.TypeName.Length > 0) { return spec.TypeName; }
                }
                return "";
            }
        }

        /// <summary>The value at the earliest time: of the strongest layer, its first sample or its default.</summary>
        public UsdValue Value
        {
            get
            {
                int place;
                UsdValue value = Find(out place);
                return value;
            }
        }

        UsdValue Find(out int place)
        {
            for (place = 0; place < specs.Length; place++)
            {
                TimeSamples samples = specs[place].Samples;
                UsdValue value = samples != null && samples.Times.Length > 0 ? samples.Values[0] : specs[place].Default;
                if (value == null) { continue; }
                return ReferenceEquals(value, UsdValue.Blocked) ? null : Timed(value, place);
            }
            place = -1;
            return null;
        }

        // values that are times move with their layer
        UsdValue Timed(UsdValue value, int place)
        {
            if (value.Type == UsdType.PathExpression) { WarnOfPaths(value.Text ?? "", places[place]); }
            if (value.Type != UsdType.TimeCode) { return value; }
            LayerOffset offset = places[place].Offset;
            double[] times = (double[])((double[])value.Data).Clone();
            for (int i = 0; i < times.Length; i++) { times[i] = offset.Scale * times[i] + offset.Offset; }
            return new UsdValue(UsdType.TimeCode, value.IsArray, times);
        }

        // paths in an expression stay those of its layer, and what it takes of weaker ones is not put in
        void WarnOfPaths(string expression, Opinion place)
        {
            bool isRelative = false;
            foreach (string part in expression.Split(' ', '(', ')', '~'))
            {
                isRelative |= part.Length > 0 && "/%+&-".IndexOf(part[0]) < 0;
            }
            if (!isRelative && place.Node.Parent == null && expression.IndexOf("%_", StringComparison.Ordinal) < 0)
            {
                return;
            }
            Prim.Stage.Composer.Library.Warn("<" + Prim.Path + "." + Name + ">: the path expression '" + expression
                + "' is as its layer says it");
        }

        /// <summary>
        /// The samples of the strongest layer that has any, in the time of the stage; null where none has.
        /// </summary>
        public TimeSamples Samples
        {
            get
            {
                for (int i = 0; i < specs.Length; i++)
                {
                    TimeSamples samples = specs[i].Samples;
                    if (samples != null && samples.Times.Length > 0)
                    {
                        LayerOffset offset = places[i].Offset;
                        if (offset.Offset == 0 && offset.Scale == 1) { return samples; }
                        var times = new double[samples.Times.Length];
                        for (int k = 0; k < times.Length; k++)
                        {
                            times[k] = offset.Scale * samples.Times[k] + offset.Offset;
                        }
                        return new TimeSamples(times, samples.Values);
                    }
                    if (specs[i].Default != null) { return null; }
                }
                return null;
            }
        }

        /// <summary>Targets of a relationship or connections of an attribute, as paths of the stage.</summary>
        public IList<string> Targets
        {
            get
            {
                var targets = new List<string>();
                for (int i = specs.Length - 1; i >= 0; i--)
                {
                    if (specs[i].Targets == null) { continue; }
                    Opinion place = places[i];
                    specs[i].Targets.Converted(delegate(string path) { return Prim.InPrototype(place.PathInRoot(path)); })
                        .ApplyTo(targets);
                }
                return targets;
            }
        }

        /// <summary>A field such as "interpolation" or "colorSpace" as text, or null.</summary>
        public string MetadataText(string name)
        {
            var value = Metadata(name) as UsdValue;
            return value == null ? null : value.Text;
        }

        /// <summary>A field of the strongest layer that has it: a UsdValue, a UsdDictionary, or null.</summary>
        public object Metadata(string name)
        {
            foreach (PropertySpec spec in specs)
            {
                object value = spec.Metadata == null ? null : spec.Metadata.Find(name);
                if (value != null) { return value; }
            }
            return null;
        }

        /// <summary>
        /// The identifier of the asset that the value names, for UsdStage.Read; null with the reason where there is
        /// none.
        /// </summary>
        public string ResolvedAsset(out string reason)
        {
            int place;
            UsdValue value = Find(out place);
            reason = "has no value";
            if (value == null || string.IsNullOrEmpty(value.Text)) { return null; }
            return Prim.Stage.Composer.Library.Resolver.Resolve(places[place].Layer.Identifier, value.Text, out reason);
        }
    }
}
