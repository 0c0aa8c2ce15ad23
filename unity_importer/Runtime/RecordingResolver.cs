using System.Collections.Generic;
using Garage.Usd;

namespace Garage.Unity
{
    /// <summary>Remembers which files of a root folder were read, or would have been had they been there.</summary>
    sealed class RecordingResolver : IAssetResolver
    {
        readonly IAssetResolver inner;
        readonly HashSet<string> seen = new HashSet<string>();
        readonly List<string> files = new List<string>();

        public RecordingResolver(IAssetResolver inner)
        {
            this.inner = inner;
        }

        /// <summary>Relative to the folder, packages as wholes.</summary>
        public IList<string> Files
        {
            get { return files; }
        }

        public string Resolve(string anchor, string asset, out string reason)
        {
            string identifier = inner.Resolve(anchor, asset, out reason);
            if (identifier != null) { Record(identifier); }
            else
            {
                string package, entry, missing = null;
                AssetPaths.Split(anchor, out package, out entry);
                if (entry == null) { missing = AssetPaths.Normal(AssetPaths.Folder(package), asset); }
                if (missing != null) { Record(missing); }
            }
            return identifier;
        }

        public byte[] Read(string identifier)
        {
            Record(identifier);
            return inner.Read(identifier);
        }

        void Record(string identifier)
        {
            string file, entry;
            AssetPaths.Split(identifier, out file, out entry);
            if (seen.Add(file)) { files.Add(file); }
        }
    }
}
