using System;
using System.Collections.Generic;
using System.IO;

namespace Garage.Usd
{
    /// <summary>A composed stage: its prims with what all layers together say of them.</summary>
    public sealed class UsdStage
    {
        const long LeastPrims = 20000;
        const long PrimsPerSpec = 100;

        readonly Dictionary<string, UsdPrim> prototypes = new Dictionary<string, UsdPrim>();
        readonly List<UsdPrim> prototypeList = new List<UsdPrim>();
        readonly Layer rootLayer;
        long primsMade;

        internal readonly Composer Composer;

        /// <summary>The parent of the root prims, "/".</summary>
        public UsdPrim Root { get; private set; }

        UsdStage(Layer root, IAssetResolver resolver)
        {
            rootLayer = root;
            var library = new LayerLibrary(resolver);
            library.Add(root);
            Composer = new Composer(library);
            Root = new UsdPrim(this, null, "/", Composer.RootOf(library.StackOf(root.Identifier, null)), null, null);
        }

        /// <summary>
        /// Opens a .usda, .usdc or .usdz; it may refer to files in its folder and below. Throws UsdFormatException.
        /// </summary>
        public static UsdStage Open(string path)
        {
            return Open(path, Path.GetDirectoryName(Path.GetFullPath(path)));
        }

        /// <summary>
        /// Opens a .usda, .usdc or .usdz of a root folder; it may refer to files anywhere in that folder. Throws
        /// UsdFormatException.
        /// </summary>
        public static UsdStage Open(string path, string root)
        {
            var resolver = new FolderResolver(root);
            string name = resolver.NameOf(path), reason = "is not in the root folder " + root;
            string identifier = name == null ? null : resolver.Resolve("", name, out reason);
            if (identifier == null) { throw new UsdFormatException(path, "file", reason); }
            return Open(resolver.Read(identifier), identifier, resolver);
        }

        /// <summary>Opens a .usdz that is in memory. Throws UsdFormatException.</summary>
        public static UsdStage OpenPackage(byte[] bytes, string name)
        {
            var package = new UsdzPackage(bytes, name);
            var resolver = new FolderResolver("");
            resolver.Add(name, package);
            return Open(package.Read(package.First), name + "[" + package.First + "]", resolver);
        }

        /// <summary>
        /// Opens the layer in these bytes, which the resolver knows by the identifier. Throws UsdFormatException.
        /// </summary>
        public static UsdStage Open(byte[] root, string identifier, IAssetResolver resolver)
        {
            return new UsdStage(LayerReader.Read(root, identifier), resolver);
        }

        /// <summary>The root layer, as errors name it.</summary>
        public string Identifier
        {
            get { return rootLayer.Identifier; }
        }

        /// <summary>What was left out, such as references to files that do not exist.</summary>
        public IList<string> Warnings
        {
            get { return Composer.Library.Warnings; }
        }

        /// <summary>Metres of one unit; 0.01 where the root layer does not say, or says no length.</summary>
        public double MetersPerUnit
        {
            get
            {
                double metres = rootLayer.Number("metersPerUnit", 0.01);
                return metres > 0 && metres < 1e9 ? metres : 0.01;
            }
        }

        /// <summary>Whether +Z points up; otherwise +Y does.</summary>
        public bool IsZUp
        {
            get { return rootLayer.Text("upAxis") == "Z"; }
        }

        /// <summary>Of the root layer; 24 where it does not say.</summary>
        public double TimeCodesPerSecond
        {
            get { return rootLayer.TimeCodesPerSecond; }
        }

        /// <summary>Shared children of instances, in the order in which they were met.</summary>
        public IList<UsdPrim> Prototypes
        {
            get { return prototypeList; }
        }

        /// <summary>What references to the stage mean by default, or null.</summary>
        public UsdPrim DefaultPrim
        {
            get
            {
                string name = rootLayer.Text("defaultPrim");
                return string.IsNullOrEmpty(name) ? null : PrimAt(name[0] == '/' ? name : "/" + name);
            }
        }

        /// <summary>The bytes of an asset that an attribute gave as an identifier.</summary>
        public byte[] Read(string identifier)
        {
            return Composer.Library.Resolver.Read(identifier);
        }

        /// <summary>The prim at an absolute path, also within instances; null where there is none.</summary>
        public UsdPrim PrimAt(string path)
        {
            if (string.IsNullOrEmpty(path) || path[0] != '/') { return null; }
            UsdPrim prim = Root;
            foreach (string name in path.Split('/'))
            {
                if (name.Length == 0) { continue; }
                UsdPrim next = null;
                if (ReferenceEquals(prim, Root) && name.StartsWith("__Prototype_", StringComparison.Ordinal))
                {
                    int number;
                    if (int.TryParse(name.Substring(12), out number) && number > 0 && number <= prototypeList.Count)
                    {
                        next = prototypeList[number - 1];
                    }
                }
                prim = next ?? (prim.Prototype ?? prim).Child(name);
                if (prim == null) { return null; }
            }
            return prim;
        }

        internal void CountPrim(string path)
        {
            if (++primsMade > LeastPrims + PrimsPerSpec * Composer.Library.SpecCount)
            {
                throw new UsdFormatException(rootLayer.Identifier, "<" + path + ">",
                    "the references of the stage make more prims than its layers can need");
            }
        }

        internal UsdPrim PrototypeOf(string key, UsdPrim instance)
        {
            UsdPrim prototype;
            if (!prototypes.TryGetValue(key, out prototype))
            {
                prototype = new UsdPrim(this, null, "/__Prototype_" + (prototypeList.Count + 1),
                    instance.SharedPart(), instance.SourcePath, null);
                prototypes.Add(key, prototype);
                prototypeList.Add(prototype);
            }
            return prototype;
        }
    }
}
