using System;
using System.Collections.Generic;
using System.IO;

namespace Garage.Usd
{
    /// <summary>Finds the files that layers name.</summary>
    public interface IAssetResolver
    {
        /// <summary>
        /// The identifier of an asset as the layer with the identifier anchor names it; null, with the reason, where
        /// there is no such file or it may not be read.
        /// </summary>
        string Resolve(string anchor, string asset, out string reason);

        /// <summary>The bytes of a resolved asset.</summary>
        byte[] Read(string identifier);
    }

    /// <summary>
    /// Asset paths and the identifiers that come of them: "folder/a.usda", "folder/b.usdz[textures/c.png]".
    /// </summary>
    public static class AssetPaths
    {
        /// <summary>
        /// A path relative to a folder, in the plain form without "." and ".."; null where it leads out of it.
        /// </summary>
        public static string Normal(string folder, string path)
        {
            if (path.Length == 0 || path[0] == '/' || path.IndexOf('\\') >= 0 || path.IndexOf(':') >= 0
                || path.IndexOf('\0') >= 0)
            {
                return null;
            }
            var parts = new List<string>();
            foreach (string part in (folder + "/" + path).Split('/'))
            {
                if (part.Length == 0 || part == ".") { continue; }
                if (part != "..")
                {
                    parts.Add(part);
                    continue;
                }
                if (parts.Count == 0) { return null; }
                parts.RemoveAt(parts.Count - 1);
            }
            return string.Join("/", parts.ToArray());
        }

        /// <summary>Splits "a.usdz[b]" into package and entry; the entry is null where there is none.</summary>
        public static void Split(string identifier, out string package, out string entry)
        {
            int bracket = identifier.IndexOf('[');
            bool packed = bracket > 0 && identifier.EndsWith("]", StringComparison.Ordinal);
            package = packed ? identifier.Substring(0, bracket) : identifier;
            entry = packed ? identifier.Substring(bracket + 1, identifier.Length - bracket - 2) : null;
        }

        /// <summary>The path without its last element; empty where it has one alone.</summary>
        public static string Folder(string path)
        {
            int slash = path.LastIndexOf('/');
            return slash < 0 ? "" : path.Substring(0, slash);
        }

        /// <summary>Whether the path is that of a .usdz.</summary>
        public static bool IsPackage(string path)
        {
            return path.EndsWith(".usdz", StringComparison.OrdinalIgnoreCase);
        }
    }

    /// <summary>
    /// The files of a root folder and what is below it; absolute paths are refused, and so are such as lead out of the
    /// folder by ".." or over a link. Identifiers are relative to the folder.
    /// </summary>
    public sealed class FolderResolver : IAssetResolver
    {
        readonly string root;
        readonly Dictionary<string, UsdzPackage> packages = new Dictionary<string, UsdzPackage>();
        // whether files and folders are links, which C# cannot tell the targets of on all of Unity's platforms
        readonly Dictionary<string, bool> areLinks = new Dictionary<string, bool>();

        /// <summary>Of a folder of the file system.</summary>
        public FolderResolver(string root)
        {
            this.root = root;
        }

        /// <summary>The name by which the folder knows a file, its path from there; null where it is not in it.</summary>
        public string NameOf(string path)
        {
            StringComparison rule = Path.DirectorySeparatorChar == '\\' ? StringComparison.OrdinalIgnoreCase
                : StringComparison.Ordinal;
            string above = Path.GetFullPath(root).Replace('\\', '/').TrimEnd('/') + "/";
            string full = Path.GetFullPath(path).Replace('\\', '/');
            return full.StartsWith(above, rule) && full.Length > above.Length ? full.Substring(above.Length) : null;
        }

        /// <summary>Knows a package that is in memory, as if it were a file of the folder.</summary>
        internal void Add(string name, UsdzPackage package)
        {
            packages.Add(name, package);
        }

        /// <summary>
        /// As IAssetResolver; links are followed in what the caller itself asks for, by an empty anchor. Throws
        /// UsdFormatException where a package is damaged.
        /// </summary>
        public string Resolve(string anchor, string asset, out string reason)
        {
            reason = null;
            string anchorFile, anchorEntry, file, entry;
            AssetPaths.Split(anchor, out anchorFile, out anchorEntry);
            AssetPaths.Split(asset, out file, out entry);
            string normal = AssetPaths.Normal(AssetPaths.Folder(anchorEntry ?? anchorFile), file);
            if (normal == null)
            {
                reason = "is not a relative path within " + (anchorEntry != null ? "the package"
                    : "the root folder");
                return null;
            }
            if (anchorEntry != null)
            {
                UsdzPackage around = Package(anchorFile);
                // a path that does not begin with a dot may also be one from the root of the package
                if (!around.Has(normal) && file[0] != '.') { normal = AssetPaths.Normal("", file) ?? normal; }
                if (entry != null || AssetPaths.IsPackage(normal)) { reason = "is a package within a package"; }
                else if (!around.Has(normal)) { reason = "is not in the package"; }
                return reason == null ? anchorFile + "[" + normal + "]" : null;
            }
            if (!File.Exists(PathOf(normal)))
            {
                reason = "does not exist";
                return null;
            }
            if (LeadsOverLink(normal, anchor.Length == 0))
            {
                reason = "leads over a link, which may lead out of the root folder";
                return null;
            }
            if (!AssetPaths.IsPackage(normal)) { return normal; }
            UsdzPackage package = Package(normal);
            string inner = entry == null ? package.First : AssetPaths.Normal("", entry);
            if (inner == null || !package.Has(inner))
            {
                reason = "is not in the package";
                return null;
            }
            return normal + "[" + inner + "]";
        }

        bool LeadsOverLink(string file, bool isTrusted)
        {
            for (int slash = 0; slash >= 0;)
            {
                slash = file.IndexOf('/', slash + 1);
                string part = slash < 0 ? file : file.Substring(0, slash);
                if (isTrusted) { areLinks[part] = false; }
                else if (!areLinks.ContainsKey(part)) { areLinks.Add(part, IsLink(PathOf(part))); }
                if (areLinks[part]) { return true; }
            }
            return false;
        }

        static bool IsLink(string path)
        {
            try
            {
                return (File.GetAttributes(path) & FileAttributes.ReparsePoint) != 0;
            }
            catch (Exception failure)
            {
                if (failure is IOException || failure is UnauthorizedAccessException) { return true; }
                throw;
            }
        }

        /// <summary>As IAssetResolver. Throws UsdFormatException where the file cannot be read.</summary>
        public byte[] Read(string identifier)
        {
            string file, entry;
            AssetPaths.Split(identifier, out file, out entry);
            if (entry != null) { return Package(file).Read(entry); }
            return ReadFile(file);
        }

        byte[] ReadFile(string file)
        {
            try
            {
                return File.ReadAllBytes(PathOf(file));
            }
            catch (Exception failure)
            {
                if (failure is IOException || failure is UnauthorizedAccessException)
                {
                    throw new UsdFormatException(file, "file", failure.Message);
                }
                throw;
            }
        }

        string PathOf(string file)
        {
            return Path.Combine(root, file);
        }

        UsdzPackage Package(string file)
        {
            UsdzPackage package;
            if (!packages.TryGetValue(file, out package))
            {
                package = new UsdzPackage(ReadFile(file), file);
                packages.Add(file, package);
            }
            return package;
        }
    }
}
